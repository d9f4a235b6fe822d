"""The browser's connection: fast reconnection, and the state kept for another session.

A session is lost with its server, and left behind when its page is reloaded. Its state beside the
address bar is sent to the browser with each run, and returned to the session that follows: with
that one's first run where the server was lost, and after it where the page was reloaded. See
`connection.js`.
"""

from collections.abc import Callable
from typing import Any

import streamlit as st
from streamlit.components.v2 import component
from streamlit.url_util import make_url_path

from ui.live import assets

_KEY = "live_connection"
_component = component("rotorcalc.connection", js=assets.module("connection"), isolate_styles=False)


def show(on_reload: Callable[[object], None]) -> object:
    """Look after the connection; return the state that the browser kept, which is untrusted.

    None before its connection was lost for the first time. What it kept over a reload is passed on
    later.
    """
    health = make_url_path(st.get_option("server.baseUrlPath") or "", "_stcore/health")
    state = _component(
        key=_KEY, data={"health": health}, on_kept_change=lambda: None,
        on_reloaded_change=lambda: on_reload(st.session_state[_KEY]["reloaded"]),
    )  # fmt: skip
    return state.kept


def keep(state: dict[str, Any], when: str) -> None:
    """Send the browser the state to keep; `when` names the place in a run."""
    _component(key=f"live_kept_{when}", data={"kept": state})
