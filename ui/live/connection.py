"""The browser's connection: fast reconnection, and what the browser keeps for another server.

A session goes with its server. What it held beside the address bar is told to the browser here with
each run of the whole page, and comes back with the first run that a server without that session
makes; `connection.js` says how.
"""

from typing import Any

import streamlit as st
from streamlit.components.v2 import component
from streamlit.url_util import make_url_path

from ui.live import assets

_KEY = "live_connection"
_component = component("rotorcalc.connection", js=assets.module("connection"), isolate_styles=False)


def show(kept: dict[str, Any] | None) -> object:
    """Give the browser what to keep, or nothing yet; return what it kept, which is untrusted.

    It kept nothing, None, before its connection was lost for the first time.
    """
    health = make_url_path(st.get_option("server.baseUrlPath") or "", "_stcore/health")
    state = _component(key=_KEY, data={"kept": kept, "health": health}, on_kept_change=lambda: None)
    return state.kept
