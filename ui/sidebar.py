"""The sidebar: presets, inputs in groups, pin and compare, share and keep, settings."""

import streamlit as st

from rotorcalc import PRESETS
from rotorcalc.figures.units import SYSTEMS
from ui.inputs import GROUPS, INPUTS, OPEN_GROUPS, machine_of
from ui.state import state
from ui.widgets import show_input


def draw() -> None:
    """Draw the sidebar."""
    with st.sidebar:
        _presets()
        for group in GROUPS:
            with st.expander(group, expanded=group in OPEN_GROUPS):
                _inputs(group)


def _presets() -> None:
    kept = state()
    if st.session_state.get("preset") != kept.preset:
        st.session_state["preset"] = kept.preset
    st.selectbox(
        "Preset",
        options=list(PRESETS),
        format_func=lambda key: PRESETS[key].title,
        key="preset",
        help=PRESETS[kept.preset].note,
        on_change=lambda: kept.set_preset(st.session_state["preset"]),
    )


def _inputs(group: str) -> None:
    for item in INPUTS.values():
        if item.group != group:
            continue
        if item.key == "load":
            _load()
        else:
            show_input(item)


def _load() -> None:
    kept = state()
    follows = kept.values["load"] is None
    if st.session_state.get("load_follows") != follows:
        st.session_state["load_follows"] = follows
    st.toggle("Load is half the rotor's weight", key="load_follows", on_change=_toggle_load)
    if not follows:
        show_input(INPUTS["load"])


def _toggle_load() -> None:
    kept = state()
    if st.session_state["load_follows"]:
        kept.set_value("load", None)
    else:
        kept.set_value("load", round(machine_of(kept.values | {"mj": 0.0}).static_load, 1))
