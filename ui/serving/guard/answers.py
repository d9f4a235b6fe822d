"""What every answer says: the headers that keep a browser safe, and 404 for a missing file.

deploy/nginx.conf says the same for the files that it sends itself.
"""

import base64
import hashlib
import re
from pathlib import Path, PurePosixPath

import streamlit as st
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ui.serving.guard.refusal import below_base, refuse

_INDEX = Path(st.__file__).parent / "static" / "index.html"
_STARTS = ("http.response.start", "websocket.http.response.start")


class Answers:
    """Adds the headers, and answers 404 where Streamlit sends its page for a missing file."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._headers = [(name.lower().encode(), value.encode()) for name, value in headers()]

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer as the app does, with the headers."""

        async def marked(message: Message) -> None:
            if message["type"] in _STARTS:
                given = {name for name, _ in message.get("headers", [])}
                more = [header for header in self._headers if header[0] not in given]
                message["headers"] = [*message.get("headers", []), *more]
            await send(message)

        if scope["type"] == "http" and _names_a_file(below_base(scope)):
            await self._file(scope, receive, marked)
        else:
            await self._app(scope, receive, marked)

    async def _file(self, scope: Scope, receive: Receive, send: Send) -> None:
        missing = False

        async def unless_missing(message: Message) -> None:
            nonlocal missing
            if message["type"] == "http.response.start" and message["status"] == 200:
                missing = Headers(raw=message["headers"]).get("content-type", "")[:9] == "text/html"
                if missing:
                    await refuse(scope, receive, send, status=404, why="Not Found")
            if not missing:
                await send(message)

        await self._app(scope, receive, unless_missing)


def headers() -> list[tuple[str, str]]:
    """Return the headers of every answer."""
    return [
        ("Content-Security-Policy", policy()),
        ("X-Content-Type-Options", "nosniff"),
        ("X-Frame-Options", "SAMEORIGIN"),
        ("Referrer-Policy", "same-origin"),
        ("Permissions-Policy", "camera=(), microphone=(), geolocation=()"),
    ]


def policy() -> str:
    """Return the content security policy.

    Streamlit's page begins with one small script of its own, named by its hash; its components'
    scripts come as blobs; its styles are written as it goes. Nothing comes from another site.
    """
    scripts = re.findall(r"<script>(.*?)</script>", _INDEX.read_text("utf-8"), re.DOTALL)
    digests = (base64.b64encode(hashlib.sha256(script.encode()).digest()) for script in scripts)
    inline = " ".join(f"'sha256-{digest.decode()}'" for digest in digests)
    return (
        f"default-src 'self'; script-src 'self' blob: 'wasm-unsafe-eval' {inline}; "
        "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
        "connect-src 'self'; worker-src 'self' blob:; object-src 'none'; base-uri 'self'; "
        "form-action 'self'; frame-src 'none'; frame-ancestors 'self'"
    )


def _names_a_file(path: str) -> bool:
    return PurePosixPath(path).suffix not in ("", ".html") or path.startswith("static/")
