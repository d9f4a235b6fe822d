"""Results in a row on a page, each above a popover that explains it."""

from functools import partial

import streamlit as st

from rotorcalc.units import Units
from ui.computed import Computed
from ui.format import display
from ui.preview import Preview, Text
from ui.results.record import Result
from ui.results.table import RESULTS
from ui.words import citation

# A word joiner, of no width.
_JOINED = "\u2060"


def row_key(keys: tuple[str, ...]) -> str:
    """Return the key of a row of results, by which the page's style knows how many they are."""
    return f"results_{len(keys)}_{keys[0]}"


def show_results(preview: Preview, *keys: str) -> None:
    """Show results in a row, each above a popover that explains it.

    The page's style lays out the pairs: a column each would be an element more.
    """
    row = row_key(keys)
    preview.rows[row] = [partial(_cells, RESULTS[key], preview) for key in keys]
    with st.container(key=row):
        for key in keys:
            result = RESULTS[key]
            number, change, source = _cells(result, preview, preview.computed)
            st.metric(
                result.label,
                number,
                change or None,
                delta_color="off",
                delta_arrow="off",
            )
            _explain(result, source, preview)


def _cells(result: Result, preview: Preview, computed: Computed) -> tuple[str, str, str]:
    """Return a result's number, its change from the first case, and its source."""
    first, change = preview.first, ""
    if first and (difference := result.change(computed, first.computed, preview.units)):
        change = f"{difference} vs {first.case.name}"
    # A narrow column has no room for whose sheet it is, and what is done on it.
    source = citation.capital(result.cited(computed).removeprefix("The notes' calculation "))
    # A narrow column breaks before a unit, but not within "0-p".
    number = result.shown(computed, preview.units).replace("-p", f"-{_JOINED}p")
    if result.is_doubtful(computed):
        number = f"({number})"
    return number, change, source


def _explain(result: Result, label: str, preview: Preview) -> None:
    opened = st.popover(
        label,
        type="tertiary",
        key=f"explain_{result.key}",
        on_change="rerun",
    )
    if opened.open:
        with opened:
            preview.say(
                f"explain_{result.key}",
                lambda computed: Text(explanation(result, computed, preview.units)),
            )


def explanation(result: Result, computed: Computed, units: Units) -> str:
    """Return a result's equation with this machine's numbers, Markdown."""
    own, cited = result.is_own(computed), [display(result.cites)] if result.cites else []
    if not own:
        lines = [_other(result, computed)]
        if result.source:
            lines.append(f":small[{citation.solution(computed)}]")
    elif computed.unloaded:
        lines = [
            *cited,
            display(result.equation),
            ":small[Without load: the limit as the load vanishes.]",
        ]
    else:
        lines = [*cited, display(result.equation), display(f"= {result.filled(computed)}")]
    lines.append(f"{result.label}: **{result.shown(computed, units)}**")
    if own and result.remark:
        lines.append(f":small[{result.remark}]")
    return "\n\n".join(lines)


def _other(result: Result, computed: Computed) -> str:
    """Return what was solved where that is not the notes' equation."""
    origin = result.origin(computed)
    if origin and origin.tex:
        return display(origin.tex)
    return ":small[The model of this bearing's film gives it.]"
