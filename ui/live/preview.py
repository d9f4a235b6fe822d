"""The preview in a browser: what a page shows, at the value of a slider being dragged.

While a slider is dragged the browser requests charts, numbers and texts at the slider's value from
`path()`, with the token of the page's session, and draws the answer; Streamlit takes no part, and
nothing is stored. So it requests a chart at another running speed that is marked on the page, where
it cannot draw it itself. The value on release comes through Streamlit, by this component: then only
the fragment that holds it runs, and the sidebar stays as it is.
"""

import asyncio
import gzip
from collections.abc import Collection, Mapping
from typing import Any, Protocol
from weakref import WeakValueDictionary

import streamlit as st
from starlette.requests import Request
from starlette.responses import Response
from streamlit.components.v2 import component
from streamlit.url_util import make_url_path

from ui.live import assets
from ui.live.chart import encoded
from ui.live.message import Move, echo, taken
from ui.serving import one_at_a_time

_TOKEN = "x-rotorcalc-page"  # noqa: S105 - a header's name
_KEY = "live_preview"
_component = component("rotorcalc.preview", js=assets.module("preview"), isolate_styles=False)


class Preview(Protocol):
    """A visitor's page as last drawn."""

    def at(self, name: str, value: str, charts: Collection[str] = ()) -> dict[str, Any]:
        """Return {"charts": {key: chart}, "texts": {key: text}, "rows": {key: cells}} at a value.

        Of all that a page shows, or of some of its charts alone.

        Raises ValueError, in words for the visitor, where the value gives no valid machine.
        """
        ...


# The preview of each session's last page, for as long as the session keeps it.
_previews: WeakValueDictionary[str, Preview] = WeakValueDictionary()
# A page sends one request at a time.
_asking: set[str] = set()


def show(
    preview: Preview | None, token: str, frame: int, values: Mapping[str, object], on_move: Move
) -> None:
    """Let sliders send through here, and show a page's preview while they are dragged, if any.

    `values` are the sliders' by name, as they show them; `token` is the session's secret, and
    `frame` the number of the frame that holds the sliders.
    """
    if preview is not None:
        _previews[token] = preview
    common = {
        "address": path(), "token": token, "frame": frame, "echo": echo(),
        "available": preview is not None,
        "scripts": {"markdown": assets.script("markdown"), "katex": assets.katex()},
    }  # fmt: skip
    # A list: Streamlit would look through a dictionary for data frames, at some cost.
    _component(key=_KEY, data=[common, values], on_moved_change=lambda: taken(_KEY, on_move))


def path() -> str:
    """Return where the server answers."""
    return make_url_path(st.get_option("server.baseUrlPath") or "", "preview")


async def answer(request: Request) -> Response:
    """Answer with a preview, in a separate thread so that the server can serve others."""
    token = request.headers.get(_TOKEN, "")
    preview = _previews.get(token)
    if preview is None:
        # The session is on another replica, or gone: the slider then sends through Streamlit.
        return Response(status_code=204)
    if token in _asking:
        # The page's own slider never sends a second one before the first is answered.
        return Response(status_code=429)
    name, value = (request.query_params.get(key, "") for key in ("name", "value"))
    charts = request.query_params.getlist("chart")
    _asking.add(token)
    try:
        content = await asyncio.to_thread(_packed, token, preview, name, value, charts)
    finally:
        _asking.discard(token)
    headers = {"Cache-Control": "no-store", "Content-Encoding": "gzip"}
    return Response(content, media_type="application/json", headers=headers)


def _packed(token: str, preview: Preview, name: str, value: str, charts: list[str]) -> bytes:
    try:
        with one_at_a_time.PAGES.through(token):
            shown = preview.at(name, value, charts)
    except ValueError as error:
        shown = {"charts": {}, "texts": {}, "rows": {}, "refused": f"{error}"}
    # Compressed at the fastest level; Streamlit would use the smallest, ten times slower.
    return gzip.compress(encoded(shown), compresslevel=1, mtime=0)
