"""How a request is turned away: with a status and a sentence, before a websocket is one."""

from starlette.datastructures import Headers
from starlette.responses import PlainTextResponse
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket
from streamlit import config
from streamlit.url_util import make_url_path

from ui.serving import log

_REFUSALS = log.Rarely()


async def refuse(
    scope: Scope, receive: Receive, send: Send, *, status: int, why: str, **headers: str
) -> None:
    """Answer a request, or a websocket's, with a status and why."""
    count(why)
    answer = PlainTextResponse(f"{why}\n", status, headers={"Cache-Control": "no-store"} | headers)
    if scope["type"] == "websocket":
        await WebSocket(scope, receive, send).send_denial_response(answer)
    else:
        await answer(scope, receive, send)


def count(why: str) -> None:
    """Count a refusal, and write now and then how many there were."""
    _, times = _REFUSALS.count(why)
    if times:
        log.event("refused", why=why, times=times)


def header(scope: Scope, name: str) -> str | None:
    """Return a request's header."""
    return Headers(scope=scope).get(name)


def below_base(scope: Scope) -> str:
    """Return a request's path below the app's own, without a slash before it."""
    base = make_url_path(config.get_option("server.baseUrlPath") or "", "")
    return scope["path"].removeprefix(base).lstrip("/")
