"""What a browser sends when a slider is moved, and how it learns that it has been answered."""

from collections.abc import Callable

import streamlit as st

# Gets a slider's name, what it sent, which may be anything, and whether it is still dragged.
Move = Callable[[str, object, bool], None]

_ECHO = "live_echo"


def taken(key: str, on_move: Move) -> None:
    """Pass on what the component of a key sent, and keep its number."""
    sent = st.session_state[key]["moved"]
    if isinstance(sent, dict):
        st.session_state[_ECHO] = sent.get("number")
        on_move(str(sent.get("name")), sent.get("value"), bool(sent.get("dragging")))


def echo() -> object:
    """Return the number of what was taken last."""
    return st.session_state.get(_ECHO)
