"""A slider that sends while it moves, with a field to type its value in."""

import math
from collections.abc import Callable

import streamlit as st
from streamlit.components.v2 import component

from ui.live import assets

_component = component("rotorcalc.slider", js=assets.module("slider"), isolate_styles=False)


def show(  # noqa: PLR0913 - what a slider shows, and where it sends
    label: str,
    value: float,
    bounds: tuple[float, float, float],
    *,
    log: bool,
    beyond: str,
    key: str,
    help: str,  # noqa: A002 - as Streamlit calls it
    on_move: Callable[[object, bool], None],
    name: str = "",
    while_held: bool = True,
) -> None:
    """Show a slider.

    `bounds` are the lowest and the highest value and the step between, or the number of steps a
    decade where `log`; `beyond` is the word for one more place above them. `on_move` gets what was
    sent, which may be anything, and whether the thumb is still held; with a `name` what is sent
    while held goes through the page's feed under it, if there is one.
    """
    low, high, step = bounds

    def moved() -> None:
        sent = st.session_state[key]["moved"]
        if isinstance(sent, dict):
            st.session_state[f"{key}_echo"] = sent.get("number")
            on_move(sent.get("value"), bool(sent.get("held")))

    _component(
        key=key,
        data={
            "label": label, "help": help, "low": low, "high": high, "step": step, "log": log,
            "beyond": beyond, "whileHeld": while_held, "name": name, "follow": name != "",
            "value": beyond if math.isinf(value) else value,
            "echo": st.session_state.get(f"{key}_echo"),
        },
        on_moved_change=moved,
    )  # fmt: skip
