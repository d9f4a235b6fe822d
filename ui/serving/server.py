"""The app with a server's parts: health, log, and the name of the replica."""

import asyncio
import gc
import importlib
import platform
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from pathlib import Path

import streamlit as st
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, RedirectResponse
from starlette.routing import Route
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from streamlit.url_util import make_url_path

from rotorcalc import __version__
from ui.jobs import queue
from ui.serving import guard, log, pulse, settings, spare, version
from ui.serving.own_origin import OwnOrigin
from ui.serving.pulse import PULSE

_PAGES = Path(__file__).parents[2] / "pages"
_HEADER = b"x-rotorcalc-replica"
# What the pages import, for the first visitor not to wait for it.
_WARM = (
    "ui.frame.page", "ui.words.design", "ui.words.stability", "ui.words.root_locus",
    "ui.words.response", "ui.words.orbits", "ui.words.on_demand", "ui.notes", "ui.live",
    "ui.sharing.export", "ui.sharing.report",
)  # fmt: skip
# New objects until Python looks for lost ones, its own 700 cost a page a seventh of its time; and
# how often it looks at older ones: 320,000 objects of closed sessions are some 30 MB.
_COLLECT_AFTER = (20_000, 4, 4)


class NamedReplica:
    """Names the replica in a header, so that a proxy can keep a visitor on it."""

    def __init__(self, app: ASGIApp, name: str) -> None:
        self._app = app
        self._header = (_HEADER, name.encode())

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on the app's answer, with the header added."""

        async def named(message: Message) -> None:
            if message["type"] in ("http.response.start", "websocket.accept"):
                message["headers"] = [*message.get("headers", []), self._header]
            await send(message)

        await self._app(scope, receive, named)


def routes() -> list[Route]:
    """Return the routes beside the pages: health, previews, and addresses in lower case."""
    base = st.get_option("server.baseUrlPath") or ""
    stems = (path.stem.partition("_")[2] for path in _PAGES.glob("*_*.py"))
    names = [name for name in stems if name != name.lower()]
    beside = [
        Route(make_url_path(base, "healthz"), answer_health),
        *(Route(make_url_path(base, name.lower()), _leading_to(name)) for name in names),
    ]
    if settings.live() != "drag":
        return beside
    preview = importlib.import_module("ui.live.preview")
    return [*beside, Route(preview.path(), preview.answer)]


def _leading_to(name: str) -> Callable[[Request], Awaitable[RedirectResponse]]:
    """Return what leads to a page from its address in lower case, as typed from a blackboard.

    Streamlit would say that there is no such page. What is said of the address is relative: a proxy
    may know the app by another one.
    """

    async def answer(request: Request) -> RedirectResponse:
        query = request.url.query
        return RedirectResponse(f"{name}?{query}" if query else name)

    return answer


def middleware() -> list[Middleware]:
    """Return the middleware between server and visitors."""
    name = settings.replica()
    named = [Middleware(NamedReplica, name=name)] if name else []
    return [*named, *guard.middleware(), Middleware(OwnOrigin)]


class StartError(RuntimeError):
    """The server is not well when it starts, so it does not."""


async def answer_health(_: Request) -> JSONResponse:
    """Answer what is wrong with this server, or that nothing is."""
    faults = PULSE.faults()
    status = {"status": "bad", "why": faults} if faults else {"status": "good"}
    return JSONResponse(
        status | {"version": __version__, "commit": version.commit()},
        status_code=503 if faults else 200,
        headers={"Cache-Control": "no-store"},
    )


@asynccontextmanager
async def life(_: st.App) -> AsyncIterator[None]:
    """Start where all is well, and look after it until the end; log the first line and the last."""
    log.begin()
    spare.begin()
    await asyncio.to_thread(_warm)
    if faults := await PULSE.look(pulse.AT_START):
        pulse.tell(f"STATUS=cannot start: {faults}")
        raise StartError(f"the server cannot start: {faults}")
    log.event(
        "start", version=__version__, commit=version.commit(), replica=settings.replica(),
        python=platform.python_version(), streamlit=st.__version__, live=settings.live(),
        heavy_jobs=settings.heavy_jobs(), docs=settings.docs(),
    )  # fmt: skip
    pulse.tell("READY=1")
    looking = asyncio.create_task(PULSE.go_on())
    yield
    pulse.tell("STOPPING=1")
    looking.cancel()
    for turns in queue.LINES:
        turns.end()
    log.event("stop")


def _warm() -> None:
    """Import and compute what every visitor needs, and exempt it from garbage collection.

    Otherwise each full collection goes through all objects of all imported modules, and every
    session waits for it.
    """
    for turns in queue.LINES:
        turns.begin()
    for name in _WARM:
        importlib.import_module(name)
    gc.collect()
    gc.freeze()
    gc.set_threshold(*_COLLECT_AFTER)
