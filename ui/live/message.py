"""The messages of a moved slider, and their acknowledgement."""

from collections.abc import Callable

import streamlit as st

# Takes a slider's name, its value, which is untrusted, and whether it is still being dragged.
Move = Callable[[str, object, bool], None]

_ECHO = "live_echo"


def taken(key: str, on_move: Move) -> None:
    """Pass on the message of a component, and keep its number."""
    sent = st.session_state[key]["moved"]
    if isinstance(sent, dict):
        st.session_state[_ECHO] = sent.get("number")
        on_move(str(sent.get("name")), sent.get("value"), bool(sent.get("dragging")))


def echo() -> object:
    """Return the number of the last message taken."""
    return st.session_state.get(_ECHO)
