"""Results in a row on a page, each above a popover that explains it."""

import streamlit as st

from rotorcalc.films import film_of
from rotorcalc.films.model import Source
from rotorcalc.units import Units
from ui.computed import Computed
from ui.results.record import Result
from ui.results.table import RESULTS


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
    source = film_of(computed.machine.bearing).sources.get(result.source)
    own = result.is_of(computed)
    opened = st.popover(
        result.number if own else source.equation if source else "Film model",
        type="tertiary",
        key=f"explain_{result.key}",
        on_change="rerun",
    )
    if opened.open:
        with opened:
            if not own:
                _explain_other(source)
            elif computed.unloaded:
                st.latex(result.equation)
                st.caption("Without load: the limit ε → 0.")
            else:
                st.latex(result.equation)
                st.latex(f"= {result.filled(computed)}")
            st.markdown(f"{result.label}: **{result.shown(computed, units)}**")
            if own and result.remark:
                st.caption(result.remark)


def _explain_other(source: Source | None) -> None:
    """Show by which equation another film than the notes' answers, where it has one."""
    if source and source.tex:
        st.latex(source.tex)
    else:
        st.caption("The model of this bearing's film gives it.")
