"""Results in a row on a page, each above a popover that explains it."""

import streamlit as st

from rotorcalc.units import Units
from ui.computed import Computed
from ui.results.record import Result
from ui.results.table import RESULTS
from ui.words import citation


def row_key(keys: tuple[str, ...]) -> str:
    """Return the key of a row of results."""
    return f"results_{keys[0]}"


def show_results(computed: Computed, baseline: Computed | None, units: Units, *keys: str) -> None:
    """Show results in a row, each above a popover that explains it.

    The page's style lays out the pairs: a column each would be an element more.
    """
    with st.container(key=row_key(keys)):
        for key in keys:
            result = RESULTS[key]
            change = None if baseline is None else result.change(computed, baseline)
            st.metric(
                result.label,
                result.shown(computed, units),
                change,
                delta_color="off",
                delta_arrow="off",
            )
            _explain(result, computed, units)


def _explain(result: Result, computed: Computed, units: Units) -> None:
    # A column is too narrow for whose calculation sheet it is.
    label = citation.capital(result.cited(computed).removeprefix("The notes' "))
    opened = st.popover(
        label,
        type="tertiary",
        key=f"explain_{result.key}",
        on_change="rerun",
    )
    if opened.open:
        with opened:
            own = result.is_own(computed)
            if not own:
                _explain_other(result, computed)
            elif computed.unloaded:
                st.latex(result.equation)
                st.caption("Without load: the limit of a vanishing load.")
            else:
                st.latex(result.equation)
                st.latex(f"= {result.filled(computed)}")
            st.markdown(f"{result.label}: **{result.shown(computed, units)}**")
            if own and result.remark:
                st.caption(result.remark)


def _explain_other(result: Result, computed: Computed) -> None:
    """Show what was solved where that is not the notes' equation."""
    origin = result.origin(computed)
    if origin and origin.tex:
        st.latex(origin.tex)
    else:
        st.caption("The model of this bearing's film gives it.")
