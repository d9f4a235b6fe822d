"""What follows a held thumb: charts and numbers, in one message and past all other elements."""

from collections.abc import Callable
from typing import Any

import streamlit as st
from streamlit.components.v2 import component

from ui.live import assets
from ui.live.chart import encoded

_KEY = "live_feed"
_component = component("rotorcalc.feed", js=assets.module("feed"), isolate_styles=False)


def show(follow: Callable[[], dict[str, Any]], *, on_move: Callable[[str, object], None]) -> None:
    """Take what live sliders send while they are held, and send what `follow` returns.

    That is {"charts": {key: chart}, "rows": {key: numbers as text}}. `on_move` gets the slider's
    name and what it sent, which may be anything. To be called in a fragment: then nothing else of
    the page is run or sent.
    """

    def moved() -> None:
        sent = st.session_state[_KEY]["moved"]
        if isinstance(sent, dict):
            st.session_state[f"{_KEY}_number"] = sent.get("number")
            on_move(str(sent.get("name")), sent.get("value"))

    number = st.session_state.get(f"{_KEY}_number")
    message = {} if number is None else {"number": number, **follow()}
    st.session_state[f"{_KEY}_number"] = None  # a page's whole run sends no more than an empty one
    _component(key=_KEY, data=encoded(message), on_moved_change=moved)
