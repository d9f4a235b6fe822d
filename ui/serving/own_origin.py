"""The app's own origin, allowed to speak to Streamlit's script in the browser, and no other.

That script takes some messages, such as to connect anew, from the page around it, where its server
names that page's origin. By default that is Streamlit's own cloud. Here it is the app itself, as
its visitor calls it: `ui/live/connection.js` sends such messages.
"""

import streamlit as st
from starlette.datastructures import Headers
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Receive, Scope, Send
from streamlit.url_util import make_url_path

# The rest of Streamlit's own answer.
REST = {
    "useExternalAuthToken": False,
    "enableCustomParentMessages": False,
    "enforceDownloadInNewTab": False,
    "metricsUrl": "",
    "blockErrorDialogs": False,
    "resourceCrossOriginMode": None,
}


class OwnOrigin:
    """Answers in Streamlit's place which origins may speak to its script."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer as the app does, but to that question."""
        if scope["type"] != "http" or scope["path"] != path():
            await self._app(scope, receive, send)
            return
        host = Headers(scope=scope).get("host", "")
        # A proxy may hold the certificate, so the app cannot tell which of the two it is.
        origins = [f"http://{host}", f"https://{host}"]
        answer = JSONResponse(
            REST | {"allowedOrigins": origins}, headers={"Cache-Control": "no-cache"}
        )
        await answer(scope, receive, send)


def path() -> str:
    """Return where Streamlit's script asks."""
    return make_url_path(st.get_option("server.baseUrlPath") or "", "_stcore/host-config")
