"""The texts of the notes page, and its tables of equations and of checks."""

import datetime as dt
import functools
import re
from itertools import groupby
from pathlib import Path

from rotorcalc.validation import Case, validate
from ui.format import digits, minus
from ui.notes.equations import EQUATIONS, Equation

CONVENTIONS_ALT = (
    "A journal in its bearing, seen along the shaft. The load pulls down along X; Y points right; "
    "the shaft turns counterclockwise, from X to Y. The journal's centre lies below the bearing's "
    "and to its right, at the attitude angle φ from X towards Y. r points along the line of "
    "centres, t at a right angle ahead of it. The film is thickest opposite to r, where θ begins, "
    "and thinnest at r."
)


# A symbol with an index, as checks and titles name it.
_INDEXED = re.compile(r"(?<![A-Za-z_])([A-Za-zΑ-Ωα-ω])_([A-Za-z]+)")


@functools.cache
def text(name: str) -> str:
    """Return a text of this folder, Markdown."""
    return Path(__file__).with_name(f"{name}.md").read_text(encoding="utf-8")


@functools.cache
def equations() -> str:
    """Return the list of equations, Markdown."""
    return "\n\n".join(
        f"#### {group}\n\n" + "\n\n".join(_equation(item) for item in items)
        for group, items in EQUATIONS.items()
    )


def _equation(item: Equation) -> str:
    # An equation without a number in the notes is named by its source.
    number = f"**Eq. {item.number}**" if item.number[0].isdigit() else f"*{item.number}*"
    functions = ", ".join(f"`{name}`" for name in item.functions)
    return (
        f"{number} · {_typeset(item.title)}\n\n$$\n{item.latex}\n$$\n\n{functions} · {item.pages}"
    )


@functools.lru_cache(maxsize=1)
def checked() -> tuple[tuple[Case, ...], dt.datetime]:
    """Return all checks, computed once per process, and when that was."""
    return validate(), dt.datetime.now(dt.UTC)


def verdict(cases: tuple[Case, ...], when: dt.datetime) -> str:
    """Return how many checks hold, and when they were computed, in a sentence."""
    failed = sum(not case.holds for case in cases)
    if failed:
        return f"{failed} of {len(cases)} checks fail. Do not trust this copy of the program."
    return f"All {len(cases)} checks hold, computed by this server on {when:%d %B %Y at %H:%M} UTC."


def checks(cases: tuple[Case, ...]) -> str:
    """Return the checks as tables, Markdown."""
    return "\n\n".join(
        f"#### {group}\n\n"
        "| Check | Value | Reference | Difference | Allowed | Unit | Source | Verdict |\n"
        "|:--|--:|--:|--:|--:|:--|:--|:--|\n" + "\n".join(_row(case) for case in members)
        for group, members in groupby(cases, key=lambda case: case.group)
    )


def _row(case: Case) -> str:
    cells = (
        _typeset(case.name.replace("|", r"\|")),
        _number(case.value),
        _number(case.reference),
        _small(case.difference),
        _small(case.tolerance),
        case.unit,
        _typeset(case.source.replace("|", r"\|")),
        "✓ holds" if case.holds else "✗ **fails**",
    )
    return f"| {' | '.join(cells)} |"


def _typeset(text: str) -> str:
    return _INDEXED.sub(r"$\1_{\2}$", text)


def _number(value: float) -> str:
    if value == 0.0:
        return "0"
    # Nine digits show the printed ones and those in which the program differs.
    return minus(digits(float(f"{value:.3g}")) if abs(value) < 1e-4 else f"{value:.9g}")


def _small(value: float) -> str:
    return "0" if value == 0.0 else minus(digits(float(f"{value:.2g}")))
