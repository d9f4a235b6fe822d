"""Sliders that send while they move, each with a field to type its value in."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import streamlit as st
from streamlit.components.v2 import component

from ui.live import assets

_component = component("rotorcalc.sliders", js=assets.module("slider"), isolate_styles=False)


@dataclass(frozen=True)
class Slider:
    """A slider as it is shown.

    `step` lies between two places, or is the number of places a decade where `log`; `beyond` is the
    word for one more place above `high`.
    """

    name: str
    label: str
    help: str
    value: float
    low: float
    high: float
    step: float
    log: bool
    beyond: str = ""


def show(
    sliders: Sequence[Slider],
    *,
    key: str,
    on_move: Callable[[str, object, bool], None],
    while_held: bool = True,
) -> None:
    """Show some sliders below each other, one element of the page.

    `on_move` gets a slider's name, what it sent, which may be anything, and whether the thumb is
    still held. What is sent while held goes to the page's feed instead, where it has one.
    """

    def moved() -> None:
        sent = st.session_state[key]["moved"]
        if isinstance(sent, dict):
            st.session_state[f"{key}_echo"] = sent.get("number")
            on_move(str(sent.get("name")), sent.get("value"), bool(sent.get("held")))

    _component(
        key=key,
        # A list: Streamlit would look through a dictionary for data frames, at some cost.
        data=[
            [_sent(slider) for slider in sliders],
            {"whileHeld": while_held, "echo": st.session_state.get(f"{key}_echo")},
        ],
        on_moved_change=moved,
    )  # fmt: skip


def _sent(slider: Slider) -> dict[str, Any]:
    return vars(slider) | ({"value": slider.beyond} if math.isinf(slider.value) else {})
