"""The validity panel: where the model holds for this machine, and where it is strained."""

import math
import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import streamlit as st

from rotorcalc.arrays import Array
from rotorcalc.units import Units
from rotorcalc.validity import HEAT, Check
from ui.computed import Computed
from ui.format import digits, lower
from ui.preview import Preview, Text
from ui.words import citation
from ui.words.heat import needed

_BADGES = {"good": "green", "caution": "orange", "outside": "red"}
_FILM = ":small[Film: {}; laminar, isoviscous, aligned, rigid walls. Orbits: small.]"
_OWN = (
    "Own coefficients are taken as they are: whether they hold for this load, oil and temperature "
    "is not known here. They are synchronous, the same for a whirl at any frequency, and hold for "
    "small motions."
)
WORDS = {"good": "holds", "caution": "strained", "outside": "outside"}


def worst(computed: Computed) -> Check:
    """Return the assumption that a machine satisfies worst at its running speed."""
    return max(computed.checks, key=lambda check: list(_BADGES).index(check.worst))


def headline(computed: Computed) -> str:
    """Return the worst of the assumptions in a few words, and how many more do not hold well."""
    if computed.has_own:
        return "Own coefficients"
    check = worst(computed)
    if check.worst == "good":
        return "The model holds"
    # Short where it can be: on the line of the verdict it takes no height.
    name = lower(re.split("[:,]", check.name)[0])
    state = "Model strained" if check.worst == "caution" else "The model is outside its range"
    others = sum(one.worst != "good" for one in computed.checks) - 1
    return f"{state}: {name}{f' and {others} more' if others else ''}"


def level(computed: Computed) -> str:
    """Return the verdict on the worst of the assumptions; "unknown" of own coefficients."""
    return "unknown" if computed.has_own else worst(computed).worst


def badge(computed: Computed) -> str:
    """Return the headline in its colour, Markdown."""
    if computed.has_own:
        return f":gray-badge[{headline(computed)}]"
    return f":{_BADGES[worst(computed).worst]}-badge[{headline(computed)}]"


def panel(computed: Computed, units: Units) -> Text:
    """Return each assumption with its number and limits."""
    if computed.has_own:
        return Text(_OWN)
    lines = (_line(check, computed, units) for check in computed.checks)
    return Text("\n\n".join([*lines, _FILM.format(citation.film(computed))]))


def draw(preview: Preview, set_film: Callable[[str], None]) -> None:
    """Show all assumptions in an expander; the worst of them stands with the verdict.

    `set_film` takes a film model over.
    """
    opened = st.expander("Where the model holds", key="validity", on_change="rerun")
    if not opened.open:  # every run of the page would pay for what nobody reads
        return
    with opened:
        preview.say("assumptions", lambda c: panel(c, preview.units))
        if preview.computed.of_finite_length is not None:
            preview.say("short_error", short_error)
            st.button(
                "Use the film of finite length", key="use_finite",
                on_click=set_film, args=("finite",),
            )  # fmt: skip


def short_error(computed: Computed) -> Text | None:
    """Return by how much a short bearing's film misses that of finite length on this machine."""
    finite = computed.of_finite_length
    if finite is None:
        return None
    try:
        onset = _onset_error(computed.onset.speed, finite.onset.speed)
        film = computed.point.minimum_film_thickness / finite.point.minimum_film_thickness
    except ValueError as error:
        return Text(f"On the film of finite length: {error}.")
    thick = "" if film == 1.0 else f", and the smallest film {_by(float(film), 'thick', 'thin')}"
    return Text(f"The short bearing {onset}{thick}, by the film of finite length.")


def _onset_error(short: float, finite: float) -> str:
    """Return in words how a short bearing's onset compares with that of finite length."""
    if short == finite:  # both at any speed, or none
        return "has the same onset here"
    if math.isinf(short):
        return "finds no onset here, where there is one"
    if math.isinf(finite):
        return "finds an onset here, where there is none"
    if finite == 0.0:
        return "finds an onset here, where the machine whirls at any speed"
    return f"puts the onset **{_by(short / finite, 'high', 'low')}** here"


def _by(ratio: float, more: str, less: str) -> str:
    """Return in words by how much a ratio differs from one."""
    return f"{abs(100.0 * (ratio - 1.0)):.2g} % too {more if ratio > 1.0 else less}"


def _line(check: Check, computed: Computed, units: Units) -> str:
    seen = read(check, units)
    badge = f":{_BADGES[check.worst]}-badge[{WORDS[check.worst]}]"
    text = f"{badge} {seen.name}: **{number(seen.value)}** ({limits(seen)})"
    if check.worst == "good":
        return text
    remedy = f" {needed(computed, units)}" if check.name == HEAT else ""
    return f"{text}: {check.reason}.{remedy}"


def read(check: Check, units: Units) -> Check:
    """Return an assumption in the units of display: that of heat has one, the others are ratios."""
    if check.name != HEAT:
        return check
    value, caution, limit = map(units.rise.of, (check.value, check.caution, check.limit))
    name = f"{HEAT.removesuffix('K')}{units.rise.name}"
    return replace(check, name=name, value=value, caution=caution, limit=limit)


def limits(check: Check) -> str:
    """Return in words from which numbers on an assumption is strained, and fails."""
    some = [f"{digits(float(one))}" for one in (check.caution, check.limit) if np.isfinite(one)]
    return f"limit{'s' if len(some) > 1 else ''} {' and '.join(some)}" if some else "no limit"


def number(value: Array) -> str:
    """Return a number of an assumption, a dash where it is infinite."""
    return digits(float(value)) if np.isfinite(value) else "–"
