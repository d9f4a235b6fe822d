"""The app with a server's parts: health, log, and the name of the replica."""

import asyncio
import gc
import importlib
import platform
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

import streamlit as st
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse
from starlette.routing import Route
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from streamlit.url_util import make_url_path

from rotorcalc import __version__
from ui.jobs import queue
from ui.serving import guard, health, log, settings, version
from ui.serving.own_origin import OwnOrigin

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
    """Return the routes beside the pages: health and previews."""
    base = st.get_option("server.baseUrlPath") or ""
    health_route = Route(make_url_path(base, "healthz"), answer_health)
    if settings.live() != "drag":
        return [health_route]
    preview = importlib.import_module("ui.live.preview")
    return [health_route, Route(preview.path(), preview.answer)]


def middleware() -> list[Middleware]:
    """Return the middleware between server and visitors."""
    name = settings.replica()
    named = [Middleware(NamedReplica, name=name)] if name else []
    return [*named, *guard.middleware(), Middleware(OwnOrigin)]


async def answer_health(_: Request) -> JSONResponse:
    """Answer whether the core computes correctly, and how long it took."""
    start = time.perf_counter()
    try:
        await asyncio.wait_for(asyncio.to_thread(health.check), health.TIMEOUT)
    except Exception as error:  # noqa: BLE001 - whatever it is, this server is not well
        log.event("unhealthy", **log.described(error))
        return JSONResponse({"status": "bad", "why": type(error).__name__}, status_code=503)
    took = round((time.perf_counter() - start) * 1e3, 1)
    return JSONResponse(
        {"status": "good", "milliseconds": took, "version": __version__,
         "commit": version.commit()},
        headers={"Cache-Control": "no-store"},
    )  # fmt: skip


@asynccontextmanager
async def life(_: st.App) -> AsyncIterator[None]:
    """Write the log's first line and its last."""
    log.begin()
    await asyncio.to_thread(_warm)
    log.event(
        "start", version=__version__, commit=version.commit(), replica=settings.replica(),
        python=platform.python_version(), streamlit=st.__version__, live=settings.live(),
        heavy_jobs=settings.heavy_jobs(),
    )  # fmt: skip
    yield
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
    health.check()
    gc.collect()
    gc.freeze()
    gc.set_threshold(*_COLLECT_AFTER)
