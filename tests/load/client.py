"""A visitor without a browser, who speaks Streamlit's websocket protocol by its own classes.

It opens a page cold, keeps what the server sends (elements by their place, the address bar), moves
sliders, opens tabs and goes to other pages as the app's browser side does, and counts runs, errors,
bytes and the time from each action until its run has ended.
"""

import asyncio
import gzip
import json
import time
from contextlib import suppress
from dataclasses import dataclass, field
from http.client import HTTPConnection
from http.cookies import SimpleCookie
from typing import Any, Self
from urllib.parse import parse_qsl, urlencode, urlsplit, urlunsplit

from streamlit.proto.BackMsg_pb2 import BackMsg
from streamlit.proto.BidiComponent_pb2 import BidiComponent
from streamlit.proto.Element_pb2 import Element
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg
from streamlit.proto.WidgetStates_pb2 import WidgetState, WidgetStates
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

from ui.choices import NAMES

TIMEOUT = 30.0  # seconds for a run; one takes a few hundredths
SLIDERS, PREVIEW = "rotorcalc.sliders", "rotorcalc.preview"
CONNECTION = "rotorcalc.connection"
_SUCCESS = ForwardMsg.FINISHED_SUCCESSFULLY, ForwardMsg.FINISHED_FRAGMENT_RUN_SUCCESSFULLY
# As streamlit/components/v2/bidi_component/main.py names the widget of a component's triggers.
_TRIGGERS = "$$STREAMLIT_INTERNAL_KEY_{}__events"


class ServerError(Exception):
    """A page that failed, a run that never ended, or a connection that was lost."""


@dataclass
class Tally:
    """What a visitor has seen."""

    runs: int = 0
    errors: list[str] = field(default_factory=list)
    latencies: list[float] = field(default_factory=list)  # seconds
    received: int = 0  # bytes
    under_way: int = 0
    most_under_way: int = 0
    previewed: int = 0  # previews received while dragging


class Visitor:
    """One browser tab with the app.

    `address` is the app's, without a page's name; `port` is where on this machine it is reached,
    where the address names another.
    """

    def __init__(
        self, address: str, *, port: int | None = None, cookies: dict[str, str] | None = None
    ) -> None:
        self.address = address.rstrip("/")
        self._at = {} if port is None else {"host": "127.0.0.1", "port": port}
        self.cookies = dict(cookies or {})
        self.query = ""
        self.tally = Tally()
        self.session_id = ""
        self.moved: list[tuple[str, float | str]] = []  # the slider moved last, and where it was
        self._page_name = ""
        self._page_hash = ""
        self._widgets: dict[str, WidgetState] = {}
        self._shown: dict[tuple[int, ...], Any] = {}
        self._named: dict[tuple[int, ...], str] = {}  # of what is shown the components' names
        self._touched: set[tuple[int, ...]] = set()
        self._parts: dict[tuple[int, ...], str] = {}  # the fragment that drew what is shown
        self._run_parts: list[str] = []  # the fragments that run, none where the whole page does
        self._by_themselves: set[str] = set()  # the fragments that run from time to time
        self._answers: HTTPConnection | None = None
        self._socket: ClientConnection | None = None
        self._reading: asyncio.Task[None] | None = None
        self._finished = asyncio.Event()

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    # --- What a visitor does ------------------------------------------------------------------

    async def open(self, page: str = "", query: str = "", **handshake: str) -> None:
        """Open a page cold by its name in the address; `handshake` are headers of the request."""
        self._page_name, self.query = page, query
        await self._connect(handshake)
        await self._run()

    async def reconnect(self) -> None:
        """Come back after a lost connection, as the browser does: same tab, same address bar.

        Streamlit's script then asks for a run only where one was under way, the last one was a
        fragment's, or something runs by itself.
        """
        asks = self.tally.under_way or self._run_parts or self._by_themselves
        await self.close()
        self._page_name = ""
        self._keep()
        await self._connect({})
        if asks:
            await self._run()

    async def close(self) -> None:
        """Close the tab."""
        if self._answers is not None:
            self._answers.close()
            self._answers = None
        if self._socket is not None:
            await self._socket.close()
        if self._reading is not None:
            await self._reading
        self._socket = self._reading = None

    async def go(self, label: str) -> None:
        """Follow a link to another page, by its label."""
        links = (element.page_link for element in self.elements("page_link"))
        link = next(link for link in links if link.label == label)
        self._page_hash = link.page_script_hash
        # As links.js does.
        query = {key: word for key, word in parse_qsl(self.query) if key not in NAMES}
        self.query = link.query_string or urlencode(query)
        await self._run(by_history=not link.query_string)

    async def slide(self, label: str, value: float | str, *, dragging: bool = False) -> None:
        """Send a value by a slider, live or Streamlit's own, and wait until its run has ended."""
        if (found := self.live_slider(label)) is not None:
            number = time.perf_counter() * 1e3
            sent = {"name": found["name"], "value": value, "dragging": dragging, "number": number}
            await self._trigger(*self._components(PREVIEW)[0], sent)
            if number != self.preview_data()["echo"]:
                raise self._failed(f"{label}: the answer is to something else")
            return
        own = next(e.slider for e in self.elements("slider") if e.slider.label.startswith(label))
        state = self._widgets.setdefault(own.id, WidgetState(id=own.id))
        state.double_array_value.data[:] = [float(value)]
        await self._run()

    async def preview(self, label: str, value: float | str) -> dict[str, Any]:
        """Ask what a slider's value would give while it is dragged, and return the answer."""
        found = self.live_slider(label)
        assert found is not None
        start = time.perf_counter()
        status, body = await asyncio.to_thread(self.ask, found["name"], value)
        self.tally.latencies.append(time.perf_counter() - start)
        self.tally.received += len(body)
        if status != 200:
            raise self._failed(f"{label} = {value}, dragged: answered with {status}")
        self.tally.previewed += 1
        return json.loads(body)

    def ask(self, name: str, value: float | str, token: str = "") -> tuple[int, bytes]:
        """Ask for a page's preview, with its token or another; return status and body."""
        known = self.preview_data()
        if self._answers is None:
            parts = urlsplit(self.address)
            host, port = self._at.get("host", parts.hostname), self._at.get("port", parts.port)
            self._answers = HTTPConnection(host, port, timeout=TIMEOUT)
        headers = {
            "Host": urlsplit(self.address).netloc,
            "Cookie": "; ".join(f"{key}={value}" for key, value in self.cookies.items()),
            "X-Rotorcalc-Page": token or known["token"],
        }
        path = f"{known['address']}?{urlencode({'name': name, 'value': value})}"
        self._answers.request("GET", path, headers=headers)
        answer = self._answers.getresponse()
        body = answer.read()
        return answer.status, gzip.decompress(body) if answer.status == 200 else body

    async def open_tab(self, label: str) -> None:
        """Open one of the page's tabs."""
        row = next(row for row, labels in self.tab_rows() if label in labels)
        self._widgets[row] = WidgetState(id=row, string_value=label)
        part = next(
            self._parts[path]
            for path, block in self._shown.items()
            if not isinstance(block, Element) and block.tab_container.id == row
        )
        await self._run(part=part)

    async def rerun(self) -> None:
        """Run the page again."""
        await self._run()

    # --- What a visitor sees ------------------------------------------------------------------

    def elements(self, kind: str) -> list[Element]:
        """Return the page's elements of a kind, in their order."""
        return [
            item
            for _, item in sorted(self._shown.items())
            if isinstance(item, Element) and item.WhichOneof("type") == kind
        ]

    def live_slider(self, label: str) -> dict[str, Any] | None:
        """Return what a live slider shows, by the first words of its label."""
        sliders = self.live_sliders()
        return next((item for item in sliders if item["label"].startswith(label)), None)

    def live_sliders(self) -> list[dict[str, Any]]:
        """Return what every live slider shows."""
        values = json.loads(self._components(PREVIEW)[0][0].json)[1]
        groups = (json.loads(group.json)[0] for group, _ in self._components(SLIDERS))
        return [item | {"value": values[item["name"]]} for group in groups for item in group]

    def preview_data(self) -> dict[str, Any]:
        """Return the page's message to its preview: address, token and last echo."""
        return json.loads(self._components(PREVIEW)[0][0].json)[0]

    def tab_rows(self) -> list[tuple[str, list[str]]]:
        """Return the page's rows of tabs: the id of each and its labels."""
        rows = [
            (path, block.tab_container.id)
            for path, block in sorted(self._shown.items())
            if not isinstance(block, Element) and block.HasField("tab_container")
        ]
        return [(key, self._labels(path)) for path, key in rows if key]

    def texts(self) -> list[str]:
        """Return what the page says in headings, paragraphs, alerts and results."""
        said = [element.markdown.body for element in self.elements("markdown")]
        said += [element.heading.body for element in self.elements("heading")]
        said += [element.alert.body for element in self.elements("alert")]
        said += [f"{e.metric.label} {e.metric.body}" for e in self.elements("metric")]
        return said

    def _components(self, name: str) -> list[tuple[BidiComponent, str]]:
        """Return the components of a name, each with the fragment that drew it."""
        return [
            (self._shown[path].bidi_component, self._parts[path])
            for path in sorted(path for path, known in self._named.items() if known == name)
        ]

    def _labels(self, row: tuple[int, ...]) -> list[str]:
        return [
            block.tab.label
            for path, block in sorted(self._shown.items())
            if path[:-1] == row and not isinstance(block, Element) and block.HasField("tab")
        ]

    # --- The wire -----------------------------------------------------------------------------

    async def _connect(self, headers: dict[str, str]) -> None:
        parts = urlsplit(self.address)
        scheme = "wss" if parts.scheme == "https" else "ws"
        path = f"{parts.path}/_stcore/stream"
        words = ["streamlit", self.cookies.get("_streamlit_xsrf") or "-"]
        cookies = "; ".join(f"{key}={value}" for key, value in self.cookies.items())
        self._socket = await connect(
            urlunsplit((scheme, parts.netloc, path, "", "")),
            origin=headers.pop("Origin", f"{parts.scheme}://{parts.netloc}"),  # type: ignore[arg-type]
            subprotocols=[*words, self.session_id] if self.session_id else words,  # type: ignore[arg-type]
            additional_headers=headers | ({"Cookie": cookies} if cookies else {}),
            compression=None,
            max_size=None,
            open_timeout=TIMEOUT,
            proxy=None,
            **self._at,
        )
        assert self._socket.response is not None
        for header in self._socket.response.headers.get_all("Set-Cookie"):
            self.cookies |= {key: morsel.value for key, morsel in SimpleCookie(header).items()}
        self._reading = asyncio.create_task(self._read(self._socket))

    def _keep(self) -> None:
        """Act as connection.js: send the kept state with the next run."""
        shown = {
            component.id: json.loads(component.json)
            for component, _ in self._components(CONNECTION)
        }
        kept = [data["kept"] for data in shown.values() if "kept" in data]
        (place,) = [place for place, data in shown.items() if "health" in data]
        if kept:
            state = json.dumps({"kept": kept[-1]})
            self._widgets[place] = WidgetState(id=place, json_value=state)

    async def _trigger(self, component: BidiComponent, part: str, value: dict[str, Any]) -> None:
        key = _TRIGGERS.format(component.id)
        sent = json.dumps([{"event": "moved", "value": value}])
        await self._run(WidgetState(id=key, json_trigger_value=sent), part=part)

    async def _run(self, *triggers: WidgetState, part: str = "", by_history: bool = False) -> None:
        """Ask for a run of the page, or of a fragment of it, and wait until it has ended."""
        if self._socket is None:
            raise self._failed("not connected")
        message = BackMsg()
        asked = message.rerun_script
        asked.query_string, asked.page_script_hash = self.query, self._page_hash
        asked.page_name, asked.fragment_id = self._page_name, part
        asked.is_history_navigation = by_history
        asked.widget_states.CopyFrom(WidgetStates(widgets=[*self._widgets.values(), *triggers]))
        asked.context_info.url = f"{self.address}/{self._page_name}"
        asked.context_info.color_scheme = "light"
        asked.context_info.timezone = "UTC"
        before = len(self.tally.errors)
        self._finished.clear()
        self.tally.under_way += 1
        self.tally.most_under_way = max(self.tally.most_under_way, self.tally.under_way)
        start = time.perf_counter()
        try:
            await self._socket.send(message.SerializeToString())
            await asyncio.wait_for(self._finished.wait(), TIMEOUT)
        except (ConnectionClosed, TimeoutError) as error:
            raise self._failed(f"{type(error).__name__}: {error}") from error
        self.tally.latencies.append(time.perf_counter() - start)
        if self.tally.errors[before:]:
            raise ServerError(self.tally.errors[-1])

    async def _read(self, socket: ClientConnection) -> None:
        with suppress(ConnectionClosed):
            async for frame in socket:
                self.tally.received += len(frame)
                if isinstance(frame, bytes):
                    self._take(ForwardMsg.FromString(frame))
        if not self._finished.is_set():
            self._failed(f"connection lost: {socket.close_code} {socket.close_reason}")
            self._finished.set()

    def _take(self, message: ForwardMsg) -> None:
        kind = message.WhichOneof("type")
        self._by_themselves |= {message.auto_rerun.fragment_id} - {""}
        if kind == "delta":
            self._place(message)
        elif kind == "new_session":
            self._touched.clear()
            self._run_parts = list(message.metadata.run.fragment_ids)
            if not self._run_parts:
                self._by_themselves.clear()
            self.session_id = message.new_session.initialize.session_id or self.session_id
        elif kind == "navigation":
            self._page_hash = message.navigation.page_script_hash
        elif kind == "page_info_changed":
            self.query = message.page_info_changed.query_string
        elif kind == "page_not_found":
            self._failed("page not found")
        elif kind == "script_finished":
            self._end(message.script_finished)

    def _place(self, message: ForwardMsg) -> None:
        path, delta = tuple(message.metadata.delta_path), message.delta
        self._named.pop(path, None)
        kind = delta.WhichOneof("type")
        if kind == "add_block":
            self._shown[path] = delta.add_block
        elif kind == "new_element":
            self._shown[path] = element = delta.new_element
            kind = element.WhichOneof("type")
            if kind == "bidi_component":
                self._named[path] = element.bidi_component.component_name
            elif kind == "exception":
                self._failed(f"exception: {element.exception.message}")
        self._touched.add(path)
        self._parts[path] = delta.fragment_id

    def _end(self, status: int) -> None:
        """Forget what the run has not drawn again, and let the next action begin."""
        if status == ForwardMsg.FINISHED_EARLY_FOR_RERUN:
            return
        if status not in _SUCCESS:
            self._failed(f"run ended with {ForwardMsg.ScriptFinishedStatus.Name(status)}")
        for path in self._shown.keys() - self._touched:
            if not self._run_parts or self._parts[path] in self._run_parts:
                del self._shown[path]
                self._named.pop(path, None)
        self.tally.runs += 1
        self.tally.under_way = 0
        self._finished.set()

    def _failed(self, words: str) -> ServerError:
        self.tally.errors.append(words)
        return ServerError(words)
