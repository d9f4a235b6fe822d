"""The guard's rules, each by itself: buckets, paced websockets, names and Origins."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any

import pytest
import streamlit as st
from starlette.types import Message, Receive, Scope, Send
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg

from tests.waiting import finished
from ui.serving.guard import bounds, browsers, turns
from ui.serving.guard.bounds import Bucket, network
from ui.serving.guard.browsers import OwnBrowser
from ui.serving.guard.paced import Paced
from ui.serving.guard.strangers import is_own_name, is_own_origin
from ui.serving.guard.turns import Page, Share, Turns
from ui.serving.settings import Limits


class Socket:
    """A websocket without a network: incoming messages are queued, outgoing ones recorded."""

    def __init__(self, *messages: Message) -> None:
        self.coming: asyncio.Queue[Message] = asyncio.Queue()
        self.sent: list[Message] = []
        for message in messages:
            self.coming.put_nowait(message)

    async def receive(self) -> Message:
        return await self.coming.get()

    async def send(self, message: Message) -> None:
        self.sent.append(message)

    def paced(self, line: Turns) -> Paced:
        page = Page(Share(), session="page")
        return Paced(self.receive, self.send, turns=line, page=page, limits=Limits(waiting=5))


@pytest.fixture(autouse=True)
def _patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let no turn end by itself."""
    monkeypatch.setattr(turns, "LONGEST", 1e6)


def _taken() -> Turns:
    """Return turns of which another page has one, until it leaves."""
    line = Turns()
    line.ask(Page(Share(), session="other"))
    return line


def _said(data: bytes | None = b"run") -> Message:
    return {"type": "websocket.receive", "bytes": data, "text": None}


_WANTED = {"type": "websocket.connect"}
_GONE = {"type": "websocket.disconnect", "code": 1001}


def _run(work: Callable[[], Coroutine[Any, Any, None]]) -> None:
    finished(work())


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    now = [0.0]
    monkeypatch.setattr(bounds.time, "monotonic", lambda: now[0])
    return now


def test_a_bucket_admits_its_burst_and_then_its_rate(clock: list[float]) -> None:
    bucket = Bucket(rate=2, burst=3)
    assert [bucket.take() for _ in range(5)] == [True, True, True, False, False]
    clock[0] = 0.5
    assert [bucket.take() for _ in range(2)] == [True, False]
    clock[0] = 100.0
    assert [bucket.take() for _ in range(4)] == [True, True, True, False]


def test_each_message_waits_for_a_turn_of_its_own() -> None:
    async def go() -> None:
        socket = Socket(_WANTED, *(_said(bytes([i])) for i in range(3)))
        line = _taken()
        one = socket.paced(line)
        assert await one.receive() == _WANTED
        for number, before in enumerate(("other", "page", "page")):
            message = asyncio.create_task(one.receive())
            for _ in range(10):
                await asyncio.sleep(0)
            assert not message.done()
            line.left(before)
            assert (await message)["bytes"][0] == number
        await one.close()

    _run(go)


@pytest.mark.parametrize("flood", [[b"run"] * 20, [bytes(1 << 20)] * 4])
def test_a_flood_ends_its_page_and_its_websocket_stays_unread(flood: list[bytes]) -> None:
    async def go() -> None:
        socket = Socket(_WANTED, *map(_said, flood))
        one = socket.paced(_taken())
        assert [(await one.receive())["type"] for _ in range(2)][-1] == "websocket.disconnect"
        await one.send({"type": "websocket.send", "bytes": b"a page"})
        closing = asyncio.create_task(one.close())
        for _ in range(3):
            socket.coming.put_nowait(_said())
            unread = socket.coming.qsize()
            await asyncio.sleep(0)
            assert socket.coming.qsize() == unread
        assert socket.sent == []  # a close neither: uvicorn would read on until its answer
        closing.cancel()

    _run(go)


def test_a_closed_page_is_noticed_before_its_waiting_messages() -> None:
    async def go() -> None:
        socket = Socket(_WANTED, *(_said() for _ in range(4)))
        line = _taken()
        one = socket.paced(line)
        assert await one.receive() == _WANTED
        waiting = asyncio.create_task(one.receive())
        await asyncio.sleep(0)
        socket.coming.put_nowait(_GONE)
        assert await waiting == _GONE
        assert await one.receive() == _GONE
        await one.close()
        line.left("other")
        assert line.ask(Page(Share())).done()  # it waits no more

    _run(go)


def test_a_websocket_closed_at_once_still_passes_on_its_connection() -> None:
    async def go() -> None:
        one = Socket(_WANTED, _GONE).paced(Turns())
        await asyncio.sleep(0.01)
        assert [await one.receive() for _ in range(2)] == [_WANTED, _GONE]

    _run(go)


def test_a_text_message_closes_the_websocket() -> None:
    async def go() -> None:
        socket = Socket(_WANTED, _said(None))
        one = socket.paced(Turns())
        assert [(await one.receive())["type"] for _ in range(2)][-1] == "websocket.disconnect"
        await one.close()
        assert socket.sent[0]["code"] == 1003

    _run(go)


def test_the_browser_of_an_open_page_is_known_however_many_come_after(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A page's browser may send files; of closed pages the last few are remembered."""
    known = {f"{i}" * 43: f"session {i}" for i in range(6)}

    async def app(scope: Scope, _: Receive, send: Send) -> None:
        begins = ForwardMsg()
        begins.new_session.initialize.session_id = known[_secret_of(scope)]
        await send({"type": "websocket.send", "bytes": begins.SerializeToString()})
        if _secret_of(scope) == "0" * 43:
            await leaves.wait()

    async def go() -> list[bool]:
        first = asyncio.create_task(one(_page("0" * 43), _never, _unheard))
        await asyncio.sleep(0)
        for secret in list(known)[1:]:
            await one(_page(secret), _never, _unheard)
        found = [one._owns(secret, session) for secret, session in known.items()]
        leaves.set()
        await first
        assert not one._open
        return found

    monkeypatch.setattr(browsers, "_KEPT", 2)
    leaves, one = asyncio.Event(), OwnBrowser(app)
    assert finished(go()) == [True, False, False, True, True, True]


def _page(secret: str) -> Scope:
    cookie = f"{browsers.COOKIE}={secret}".encode()
    return {"type": "websocket", "path": "/_stcore/stream", "headers": [(b"cookie", cookie)]}


def _secret_of(scope: Scope) -> str:
    return dict(scope["headers"])[b"cookie"].decode().partition("=")[2]


async def _never() -> Message:
    raise AssertionError("nothing comes")


async def _unheard(_: Message) -> None:
    pass


def test_ipv6_addresses_of_one_network_count_as_one() -> None:
    assert (
        network("2001:db8:1:2:3:4:5:6") == network("2001:db8:1:2::9") != network("2001:db8:1:3::")
    )
    assert network("::ffff:192.0.2.1") == network("192.0.2.1") != network("192.0.2.2")
    assert network("testclient") == "testclient"


@pytest.mark.parametrize(
    ("origin", "host", "own"),
    [
        ("http://rotor.example.org", "rotor.example.org", True),
        ("https://rotor.example.org", "rotor.example.org", True),
        ("https://Rotor.example.org", "rotor.example.org:443", True),
        ("http://localhost:8501", "localhost:8501", True),
        ("http://localhost:8502", "localhost:8501", False),
        ("http://localhost:8501", "rotor.example.org", False),
        ("http://127.0.0.1", "rotor.example.org", False),
        ("https://rotor.example.org.evil.example", "rotor.example.org", False),
        ("https://evil.example/rotor.example.org", "rotor.example.org", False),
        ("https://rotor.example.org@evil.example", "rotor.example.org", False),
        ("file://rotor.example.org", "rotor.example.org", False),
        ("http://[", "rotor.example.org", False),
        ("null", "rotor.example.org", False),
        ("", "rotor.example.org", False),
        ("http://rotor.example.org", None, False),
    ],
)
def test_an_origin_is_own_where_it_is_the_host(origin: str, host: str | None, own: bool) -> None:
    assert is_own_origin(origin, host) is own


@pytest.mark.parametrize(
    ("allowed", "address", "host", "own"),
    [
        (["rotor.example.org"], "127.0.0.1", "rotor.example.org:8501", True),
        (["rotor.example.org"], "127.0.0.1", "localhost", False),
        (["*"], "localhost", "any.example", True),
        ([], "localhost", "localhost:8501", True),
        ([], "127.0.0.1", "[::1]:8501", True),
        ([], "localhost", "evil.example", False),
        ([], "localhost", "localhost.evil.example", False),
        ([], "localhost", "[", False),
        ([], "localhost", None, False),
        ([], "0.0.0.0", "laptop.local", True),  # noqa: S104
    ],
)
def test_a_server_answers_to_its_own_names_only(
    allowed: list[str], address: str, host: str | None, own: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    options = {
        "server.allowedHosts": allowed, "server.address": address,
        "server.corsAllowedOrigins": [],
    }  # fmt: skip
    monkeypatch.setattr(st.config, "get_option", options.__getitem__)
    assert is_own_name(host) is own
