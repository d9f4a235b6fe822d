"""Whose messages are handed on next: one page's at a time, of who has used least."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any

import pytest
from starlette.types import ASGIApp, Receive, Scope, Send
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg

from tests.app.session import visit
from tests.app.test_guard import Socket
from tests.waiting import PATIENCE, finished
from ui.serving import one_at_a_time
from ui.serving.guard import turns
from ui.serving.guard.bounds import Bounds
from ui.serving.guard.turns import Page, Share, Turns
from ui.serving.settings import Limits

_SCOPE = {"type": "websocket", "client": ("192.0.2.1", 1), "headers": []}
_WANTED = {"type": "websocket.connect"}


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Return a clock that stands still, by which no turn ends by itself."""
    now = [0.0]
    monkeypatch.setattr(turns.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(turns, "LONGEST", 1e6)
    return now


def _page(session: str, address: Share | None = None) -> Page:
    return Page(address or Share(), session=session)


def _said(name: str) -> dict[str, Any]:
    return {"type": "websocket.receive", "bytes": name.encode(), "text": None}


def _run(work: Callable[[], Coroutine[Any, Any, None]]) -> None:
    finished(asyncio.wait_for(work(), PATIENCE))


def test_one_page_has_its_turn_at_a_time(clock: list[float]) -> None:
    async def go() -> None:
        line = Turns()
        first, second = line.ask(_page("first")), line.ask(_page("second"))
        assert first.done()
        assert not second.done()
        line.left("second")  # it has no turn to end
        assert not second.done()
        line.left("first")
        assert second.done()

    _run(go)


def test_an_idle_server_gives_every_turn_at_once(clock: list[float]) -> None:
    async def go() -> None:
        line, page = Turns(), _page("page")
        for _ in range(1000):
            assert line.ask(page).done()
            clock[0] += 0.02
            line.left("page")

    _run(go)


def test_an_occasional_request_goes_before_continuous_ones(clock: list[float]) -> None:
    async def go(address: Share | None) -> None:
        line = Turns()
        seldom = _page("seldom", address)
        clock[0] += 1.0
        crowd = [_page(str(i), address) for i in range(20)]
        asked = {page.session: line.ask(page) for page in crowd}
        for number in range(200):
            (at,) = (name for name, called in asked.items() if called.done())
            if number % 40 == 5:  # comes last, while another has its turn
                called = line.ask(seldom)
            clock[0] += 0.02
            line.left(at)
            if number % 40 == 5:
                assert called.done()
                clock[0] += 0.02
                line.left("seldom")
            asked[at] = line.ask(crowd[int(at)])

    _run(lambda: go(None))
    _run(lambda: go(Share()))


def test_new_pages_wait_behind_established_ones(clock: list[float]) -> None:
    async def go() -> None:
        line, address = Turns(), Share()
        visitor = _page("visitor", address)
        clock[0] += 1.0
        line.ask(_page("busy", address))
        new = [line.ask(_page(f"new {i}", address)) for i in range(20)]
        called = line.ask(visitor)
        line.left("busy")
        assert called.done()
        assert not any(one.done() for one in new)

    _run(go)


def test_many_pages_of_one_address_share_as_much_as_one_of_another(clock: list[float]) -> None:
    async def go() -> None:
        line, crowded = Turns(), Share()
        pages = {str(i): _page(str(i), crowded) for i in range(20)} | {"alone": _page("alone")}
        asked = {name: line.ask(page) for name, page in pages.items()}
        given = dict.fromkeys(pages, 0)
        for _ in range(400):
            (at,) = (name for name, called in asked.items() if called.done())
            given[at] += 1
            clock[0] += 0.02
            line.left(at)
            asked[at] = line.ask(pages[at])
        assert given.pop("alone") == pytest.approx(200, abs=1)
        assert max(given.values()) - min(given.values()) <= 1

    _run(go)


def test_idle_time_earns_no_credit(clock: list[float]) -> None:
    async def go() -> None:
        line, early, late = Turns(), _page("early"), _page("late")
        for _ in range(100):
            line.ask(early)
            clock[0] += 1.0
            line.left("early")
        got = []
        asked = {"early": line.ask(early), "late": line.ask(late)}
        for _ in range(10):
            (at,) = (name for name, called in asked.items() if called.done())
            got.append(at)
            asked[at] = line.ask({"early": early, "late": late}[at])
            clock[0] += 1.0
            line.left(at)
        assert got.count("early") == pytest.approx(5, abs=1)

    _run(go)


def test_a_turn_ends_after_the_longest_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(turns, "LONGEST", 0.01)

    async def go() -> None:
        line = Turns()
        line.ask(_page("hangs"))
        await line.ask(_page("other"))

    _run(go)


def test_a_closed_page_gives_up_its_turn_and_its_place_in_line(clock: list[float]) -> None:
    async def go() -> None:
        line = Turns()
        first, second, third = (_page(name) for name in ("first", "second", "third"))
        asked = [line.ask(page) for page in (first, second, third)]
        line.forget(second)
        line.forget(first)
        assert [called.done() for called in asked] == [True, False, True]
        line.left("third")
        assert line.ask(first).done()

    _run(go)


def test_a_page_reports_the_end_of_its_run(monkeypatch: pytest.MonkeyPatch) -> None:
    gone: list[str] = []
    monkeypatch.setattr(one_at_a_time.PAGES, "on_leaving", gone.append)
    visit("pages/1_Equilibrium.py")
    assert gone


def test_a_visitors_message_passes_next_during_a_flood(
    clock: list[float],
) -> None:
    async def go() -> None:
        handed: list[str] = []
        bounds = Bounds(_streamlit(handed), Limits())
        names = ["visitor", *(f"hostile {i}" for i in range(20))]
        sockets = {name: Socket(_WANTED, _said(name)) for name in names}
        tasks = []
        for socket in sockets.values():
            clock[0] += 0.02
            tasks.append(asyncio.create_task(bounds(_SCOPE, socket.receive, socket.send)))
            await _settle()
        for number in range(300):
            await _settle()
            at = handed[-1]
            if at != "visitor":
                sockets[at].coming.put_nowait(_said(at))
            if number % 50 == 30:
                assert at != "visitor"
                sockets["visitor"].coming.put_nowait(_said("visitor"))
                await _settle()
                assert handed[-1] == at  # nobody else's while a page has its turn
            clock[0] += 0.02
            one_at_a_time.PAGES.on_leaving("a session that has no turn")
            await _settle()
            assert handed[-1] == at
            one_at_a_time.PAGES.on_leaving(at)
            await _settle()
            assert (handed[-1] == "visitor") is (number % 50 == 30)
        assert len(handed) == 301
        for task in tasks:
            task.cancel()

    _run(go)


def _streamlit(handed: list[str]) -> ASGIApp:
    """Return what keeps whose messages it has got, and begins a session as Streamlit does."""

    async def app(_: Scope, receive: Receive, send: Send) -> None:
        await receive()
        while (message := await receive())["type"] == "websocket.receive":
            begun = ForwardMsg()
            begun.new_session.initialize.session_id = message["bytes"].decode()
            await send({"type": "websocket.send", "bytes": begun.SerializeToString()})
            handed.append(message["bytes"].decode())

    return app


async def _settle() -> None:
    """Let all tasks go on until they wait."""
    for _ in range(20):
        await asyncio.sleep(0)
