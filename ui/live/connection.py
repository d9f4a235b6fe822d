"""The browser's connection: fast reconnection, and the state kept for another server.

A session is lost with its server. Its state beside the address bar is sent to the browser with each
run of the whole page, and returned with the first run on a server without that session; see
`connection.js`.
"""

from typing import Any

import streamlit as st
from streamlit.components.v2 import component
from streamlit.url_util import make_url_path

from ui.live import assets

_KEY = "live_connection"
_component = component("rotorcalc.connection", js=assets.module("connection"), isolate_styles=False)


def show(kept: dict[str, Any] | None) -> object:
    """Send the browser the state to keep, if any; return the state it kept, which is untrusted.

    None before its connection was lost for the first time.
    """
    health = make_url_path(st.get_option("server.baseUrlPath") or "", "_stcore/health")
    state = _component(key=_KEY, data={"kept": kept, "health": health}, on_kept_change=lambda: None)
    return state.kept
