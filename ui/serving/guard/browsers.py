"""A session belongs to the browser that began it.

Streamlit gives a session to whoever names its id, and takes files for it. Here a browser holds a
random secret in a cookie, which no script reads, and a session is only its own browser's: to any
other its id is worth nothing.
"""

import hashlib
import re
import secrets
from collections import Counter, OrderedDict
from http.cookies import CookieError, SimpleCookie

from google.protobuf.message import DecodeError
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from streamlit import config
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg
from streamlit.url_util import make_url_path

from ui.serving.guard.refusal import below_base, header, refuse

COOKIE = "rotorcalc_browser"
UPLOADS = "_stcore/upload_file/"
_SECRET = re.compile(r"[A-Za-z0-9_-]{43}")
_PROTOCOLS = b"sec-websocket-protocol"
# Sessions whose browser is remembered, beside those that are open: far more than are kept after
# their tab is closed.
_KEPT = 4096


class OwnBrowser:
    """Gives each browser its secret, and its sessions to no other."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._owners: OrderedDict[str, bytes] = OrderedDict()
        self._open: Counter[str] = Counter()  # their websockets

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer as the app does, to a session's own browser."""
        if scope["type"] == "websocket":
            await self._socket(scope, receive, send)
        elif scope["type"] == "http" and below_base(scope).startswith(UPLOADS):
            await self._upload(scope, receive, send)
        elif scope["type"] == "http" and _secret(scope) is None:
            await self._app(scope, receive, _giving(scope, send, secrets.token_urlsafe()))
        else:
            await self._app(scope, receive, send)

    async def _socket(self, scope: Scope, receive: Receive, send: Send) -> None:
        known = _secret(scope)
        secret = known or secrets.token_urlsafe()
        # streamlit, the token against forged requests, and a session that is to be taken up again
        words = [word.strip() for word in (header(scope, _PROTOCOLS.decode()) or "").split(",")]
        if len(words) > 2 and not self._owns(secret, words[2]):
            headers = [item for item in scope["headers"] if item[0] != _PROTOCOLS]
            own = (_PROTOCOLS, ", ".join(words[:2]).encode("latin-1"))
            scope = {**scope, "headers": [*headers, own]}
        begun = ""

        async def noting(message: Message) -> None:
            nonlocal begun
            if not begun and (begun := session_begun(message)):
                self._note(secret, begun)
            await send(message)

        onward = noting if known else _giving(scope, noting, secret)
        try:
            await self._app(scope, receive, onward)
        finally:
            self._open -= Counter({begun: 1})

    async def _upload(self, scope: Scope, receive: Receive, send: Send) -> None:
        session = below_base(scope).removeprefix(UPLOADS).split("/")[0]
        if scope["method"] in ("PUT", "DELETE") and not self._owns(_secret(scope), session):
            why = "A file goes to a session of one's own"
            await refuse(scope, receive, send, status=403, why=why)
        else:
            await self._app(scope, receive, send)

    def _owns(self, secret: str | None, session: str) -> bool:
        owner = self._owners.get(session)
        if secret is None or owner is None:
            return False
        return secrets.compare_digest(_digest(secret), owner)

    def _note(self, secret: str, session: str) -> None:
        self._owners[session] = _digest(secret)
        self._owners.move_to_end(session)
        self._open[session] += 1
        if len(self._owners) > _KEPT + len(self._open):
            del self._owners[next(known for known in self._owners if known not in self._open)]


def _digest(secret: str) -> bytes:
    return hashlib.sha256(secret.encode()).digest()


def _secret(scope: Scope) -> str | None:
    """Return the secret that a request's browser holds, or nothing."""
    try:
        cookie = SimpleCookie(header(scope, "cookie") or "").get(COOKIE)
    except CookieError:
        return None
    return cookie.value if cookie and _SECRET.fullmatch(cookie.value) else None


def session_begun(message: Message) -> str:
    """Return the session that a message to a browser begins or takes up again, or ""."""
    try:
        return ForwardMsg.FromString(message.get("bytes") or b"").new_session.initialize.session_id
    except DecodeError:
        return ""


def _giving(scope: Scope, send: Send, secret: str) -> Send:
    """Return a way to send that gives a page's browser its secret."""
    path = make_url_path(config.get_option("server.baseUrlPath") or "", "")
    secure = "; Secure" if scope["scheme"] in ("https", "wss") else ""
    cookie = f"{COOKIE}={secret}; Path={path or '/'}; HttpOnly; SameSite=Lax{secure}".encode()

    async def giving(message: Message) -> None:
        if message["type"] == "websocket.accept" or _is_page(message):
            message["headers"] = [*message.get("headers", []), (b"set-cookie", cookie)]
        await send(message)

    return giving


def _is_page(message: Message) -> bool:
    if message["type"] != "http.response.start":
        return False
    return Headers(raw=message["headers"]).get("content-type", "").startswith("text/html")
