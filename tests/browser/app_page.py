"""The app in a browser tab: opens pages, waits for the app to come to rest, reads what is shown."""

import os
import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlencode, urlsplit

from google.protobuf.message import DecodeError
from playwright.sync_api import (
    ConsoleMessage,
    Error,
    Locator,
    Page,
    Request,
    ViewportSize,
    WebSocket,
    expect,
)
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg

from ui.frame.page import PAGES

# Address of each page, by its name in the navigation.
PATHS = {
    name: "" if file == "app.py" else re.sub(r".*/\d+_(.*)\.py", r"\1", file)
    for file, name in PAGES.items()
}
# Those of the visitor's own machine; a lecture and exercises have machines of their own.
MACHINE_PAGES = [name for name in PATHS if name not in ("Lecture", "Exercises")]

TIMEOUT = int(os.environ.get("BROWSER_TIMEOUT", "60")) * 1000  # milliseconds

# At rest: connected, no run under way, nothing left over from the last run, every chart drawn; and
# so for three frames, for what has arrived is drawn a frame later.
_AT_REST = """() => {
  const app = document.querySelector('[data-testid="stApp"]');
  const rest = app && app.dataset.testScriptState === 'notRunning'
    && app.dataset.testConnectionState === 'CONNECTED'
    && document.querySelector('[data-testid="stHeading"]')
    && !document.querySelector(
      '[data-stale="true"], [data-testid="stSkeleton"], '
      + '.live-slider[data-busy], .live-chart[data-moved]')
    && !window.rotorcalcDrawing
    && [...document.querySelectorAll('.stBidiComponent')].every(
      component => component.querySelector(
        '.live-slider, .live-chart, .live-preview, .live-connection, .live-links'))
    && [...document.querySelectorAll('[data-testid="stPlotlyChart"], .live-chart')].every(
      chart => chart.offsetParent === null
        || chart.querySelector('.overplot path, .shapelayer path, .annotation'));
  window.framesAtRest = rest ? (window.framesAtRest || 0) + 1 : 0;
  return window.framesAtRest >= 3;
}"""

# What charts draw: lines' paths, points' places, and pictures such as a contour's.
_DRAWN = """() => [...document.querySelectorAll('.js-plotly-plot .overplot path')].map(
  path => (path.getAttribute('d') || '') + (path.getAttribute('transform') || ''))"""

_METRICS = """() => Object.fromEntries(
  [...document.querySelectorAll('[data-testid="stMetric"]')].map(metric =>
    ['stMetricLabel', 'stMetricValue'].map(
      part => metric.querySelector(`[data-testid="${part}"]`).innerText
        .replaceAll(/[\u200b\u2060]/g, '').trim())))"""

_INPUTS = """() => [...document.querySelectorAll('[role=slider], input[type=text]')].map(
  input => input.value ?? input.ariaValueNow)"""

_TRACES = """() => [...document.querySelectorAll('.js-plotly-plot')].map(
  chart => chart.data.map(trace => trace.name || ''))"""


class AppPage:
    """One tab with the app; `faults` collects what a visitor's console and network must not see."""

    def __init__(self, page: Page, url: str) -> None:
        self.page = page
        self.url = url
        self.faults: list[str] = []
        self.session = ""  # by which the server knows the tab
        self._begun = 0
        page.set_default_timeout(TIMEOUT)
        page.on("console", self._heard)
        page.on("pageerror", self._failed)
        page.on("request", self._requested)
        page.on("websocket", self._connected)

    def open(self, name: str, **query: str) -> None:
        """Open a page cold, by its own address."""
        self.page.goto(f"{self.url}/{PATHS[name]}?{urlencode(query)}".rstrip("?"))
        self.rest()

    def rest(self) -> None:
        """Wait until the app is at rest."""
        self.page.evaluate("() => { window.framesAtRest = 0; }")
        self.page.wait_for_function(_AT_REST, polling=50)

    @contextmanager
    def run(self) -> Iterator[None]:
        """Wait, after what is done inside, until the app has run and is at rest again.

        A run that had begun before may end meanwhile: it is not the one that is waited for.
        """
        before = self._begun
        yield
        end = time.monotonic() + TIMEOUT / 1000
        while self._begun == before:
            assert time.monotonic() < end, "nothing happened: the app did not run"
            self.page.wait_for_timeout(20)  # lets the websocket's messages in
        self.rest()

    def leave(self, size: ViewportSize) -> None:
        """Make the tab as good as new for what opens in it next, once nothing is held in it."""
        # A page keeps its state when it is left; a listener of its own event comes after it.
        # Streamlit keeps in all tabs of a browser whether the sidebar was open.
        self.page.evaluate(
            """() => addEventListener('pagehide', () => {
              sessionStorage.clear();
              localStorage.clear();
            })"""
        )
        self.page.mouse.move(0, 0)
        self.page.emulate_media(color_scheme="light", reduced_motion="no-preference")
        self.page.set_viewport_size(size)

    def go(self, name: str) -> None:
        """Go to a page by the navigation."""
        with self.run():
            self.page.get_by_test_id("stMain").get_by_role("link", name=name, exact=True).click()
        expect(self.page).to_have_url(re.compile(rf"/{PATHS[name]}(\?|$)"))

    def open_tab(self, label: str) -> None:
        """Open one of the page's tabs."""
        tab = self.page.get_by_role("tab", name=label, exact=True)
        if tab.get_attribute("aria-selected") != "true":
            with self.run():
                tab.click()

    def open_group(self, label: str) -> None:
        """Open a closed group of the sidebar, and wait until it has slid open."""
        group = self.page.get_by_test_id("stSidebar").get_by_test_id("stExpander")
        group = group.filter(has=self.page.get_by_text(label, exact=True))
        group.locator("summary").click()
        self.page.wait_for_function(
            "group => group.querySelector('details[open]')"
            " && group.getAnimations({ subtree: true }).length === 0",
            arg=group.element_handle(),
        )

    def open_popover(self, label: str) -> Locator:
        """Open a popover by its button, and return what it holds."""
        with self.run():
            self.page.get_by_role("button", name=label, exact=True).click()
        body = self.page.get_by_test_id("stPopoverBody")
        expect(body).to_be_visible()
        return body

    def close_popover(self) -> None:
        """Close the open popover."""
        with self.run():
            self.page.keyboard.press("Escape")
        expect(self.page.get_by_test_id("stPopoverBody")).to_have_count(0)

    def slider(self, label: str) -> Locator:
        """Return a slider by the first words of its label."""
        return self.page.get_by_role("slider", name=re.compile(f"^{re.escape(label)}"))

    def value(self, label: str) -> str:
        """Return the value at which a slider stands."""
        return self.slider(label).get_attribute("aria-valuetext") or ""

    def changes(self, read: Callable[[], Any], before: Any) -> bool:
        """Wait until what is read differs from what it was."""
        end = time.monotonic() + TIMEOUT / 1000
        while read() == before and time.monotonic() < end:
            self.page.wait_for_timeout(50)
        return read() != before

    def stands(self, read: Callable[[], Any]) -> bool:
        """Wait until what is read stays as it is for half a second; on its way may be some more."""

        def still() -> bool:
            before = read()
            self.page.wait_for_timeout(500)
            return read() == before

        return self.changes(still, False)

    def press(self, label: str, key: str) -> None:
        """Press a key on a slider."""
        slider = self.slider(label)
        slider.focus()
        with self.run():
            slider.press(key)

    def charts(self) -> Locator:
        """Return the charts, however they are drawn."""
        return self.page.locator(".live-chart, [data-testid='stPlotlyChart']")

    def tabs(self) -> list[str]:
        """Return the labels of the page's tabs."""
        return self.page.get_by_role("tab").all_inner_texts()

    def metrics(self) -> dict[str, str]:
        """Return the results shown."""
        return self.page.evaluate(_METRICS)

    def shown(self) -> dict[str, object]:
        """Return the page's address and inputs, its results, its open tab, cases, and undo."""
        return {
            "address": self.page.url,
            "inputs": self.page.evaluate(_INPUTS),
            "results": self.metrics(),
            "tab": self.page.locator("[role=tab][aria-selected=true]").all_inner_texts(),
            "cases": self.page.locator("table.cases").all_inner_texts(),
            "undo": self.page.get_by_role("button", name="Undo", exact=True).is_enabled(),
            "changes": self.page.get_by_test_id("stMetricDelta").all_inner_texts(),
        }

    def drawn(self) -> list[str]:
        """Return what the charts draw, as paths."""
        return self.page.evaluate(_DRAWN)

    def traces(self) -> list[list[str]]:
        """Return the names of each chart's traces."""
        return self.page.evaluate(_TRACES)

    def query(self) -> dict[str, str]:
        """Return the parameters in the address bar."""
        return {key: words[0] for key, words in parse_qs(urlsplit(self.page.url).query).items()}

    def overflow(self) -> int:
        """Return by how many pixels the page is wider than the window."""
        return self.page.evaluate(
            """() => Math.max(...[document.documentElement,
                 document.querySelector('[data-testid="stMain"]')].map(
                   element => element.scrollWidth - element.clientWidth))"""
        )

    def save(self, label: str, folder: Path) -> Path:
        """Press a download button, and return the file."""
        with self.page.expect_download() as started:
            self.page.get_by_role("button", name=label).click()
        path = folder / started.value.suggested_filename
        started.value.save_as(path)
        return path

    def _heard(self, message: ConsoleMessage) -> None:
        if message.type == "error" and not _is_streamlits_search(message):
            self.faults.append(f"console: {message.text} ({message.location.get('url')})")

    def _failed(self, error: Error) -> None:
        # Plotly's own: an animation that is stopped rejects its promise, with nothing, at any time.
        if str(error) != "undefined":
            self.faults.append(f"page error: {error}")

    def _requested(self, request: Request) -> None:
        parts = urlsplit(request.url)
        if parts.scheme not in ("data", "blob", "file") and parts.hostname != "127.0.0.1":
            self.faults.append(f"request: {request.url}")

    def _connected(self, socket: WebSocket) -> None:
        if urlsplit(socket.url).hostname != "127.0.0.1":
            self.faults.append(f"websocket: {socket.url}")
        socket.on("framereceived", self._received)

    def _received(self, frame: bytes | str) -> None:
        with suppress(DecodeError):
            if isinstance(frame, bytes):
                message = ForwardMsg.FromString(frame)
                self._begun += message.HasField("new_session")
                self.session = message.new_session.initialize.session_id or self.session


def _is_streamlits_search(message: ConsoleMessage) -> bool:
    """Tell whether Streamlit looks for its server below a page's address first, and finds none."""
    address = urlsplit(message.location.get("url", ""))
    pages = "|".join(filter(None, PATHS.values()))
    return "404" in message.text and bool(
        re.fullmatch(rf"/({pages})/_stcore/(health|host-config)", address.path)
    )
