"""The guard's bounds on files, with Streamlit's own store and no network."""

import asyncio
from collections.abc import Callable
from types import SimpleNamespace

import pytest
from starlette.types import Message, Receive, Scope, Send
from streamlit.runtime.memory_uploaded_file_manager import MemoryUploadedFileManager
from streamlit.runtime.uploaded_file_manager import UploadedFileRec

from tests.waiting import finished
from ui.serving.guard import uploads
from ui.serving.guard.uploads import Uploads
from ui.serving.settings import Limits

KILOBYTE, MEGABYTE = 1 << 10, 1 << 20


class Desk:
    """A server that takes files when a test lets it, behind the bounds."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.store = MemoryUploadedFileManager("upload_file")
        self.open, self.asked = asyncio.Event(), 0
        there = SimpleNamespace(uploaded_file_mgr=self.store)
        monkeypatch.setattr(uploads.runtime, "get_instance", lambda: there)
        self._bounds = Uploads(self._app, Limits())

    async def put(
        self, *, length: int | None, name: str = "1", page: str = "page", chunked: bool = False
    ) -> int:
        """Announce a file, and return the status of the answer."""
        sent: list[Message] = []

        async def send(message: Message) -> None:
            sent.append(message)

        headers = [] if length is None else [(b"content-length", str(length).encode())]
        if chunked:
            headers.append((b"transfer-encoding", b"chunked"))
        path = f"/_stcore/upload_file/{page}/{name}"
        scope = {"type": "http", "method": "PUT", "path": path, "headers": headers}
        await self._bounds(scope, _nothing, send)
        return sent[0]["status"]

    def filled(self, count: int, *, name: str = "", size: int = 1) -> None:
        """Keep files of a page."""
        for number in range(count):
            file = UploadedFileRec(f"{number}", name, "", bytes(size))
            self.store.add_file("page", file)

    async def _app(self, _: Scope, __: Receive, send: Send) -> None:
        self.asked += 1
        await self.open.wait()
        await send({"type": "http.response.start", "status": 204, "headers": []})


async def _nothing() -> Message:
    raise AssertionError("the guard reads no body")


@pytest.fixture
def desk(monkeypatch: pytest.MonkeyPatch) -> Desk:
    return Desk(monkeypatch)


async def _at_once(desk: Desk, count: int, page: Callable[[int], str]) -> list[int]:
    """Announce files of nearly a megabyte, all of them before one has come."""
    puts = [
        asyncio.create_task(desk.put(length=900 * KILOBYTE, page=page(i))) for i in range(count)
    ]
    for _ in range(5):
        await asyncio.sleep(0)
    desk.open.set()
    return await asyncio.gather(*puts)


@pytest.mark.parametrize(
    ("page", "room"), [(lambda _: "page", 4), (lambda number: f"page {number % 12}", 36)]
)
def test_of_many_files_at_once_only_those_are_taken_for_which_there_is_room(
    page: Callable[[int], str], room: int, desk: Desk
) -> None:
    told = finished(_at_once(desk, 60, page))
    assert told.count(204) == desk.asked == room
    assert told.count(413) == 60 - room


def test_a_file_in_chunks_is_refused_whatever_length_it_names(desk: Desk) -> None:
    desk.open.set()
    assert finished(desk.put(length=5, chunked=True)) == 400
    assert finished(desk.put(length=None, chunked=True)) == 400
    assert finished(desk.put(length=None)) == 411
    assert desk.asked == 0
    assert finished(desk.put(length=5)) == 204


@pytest.mark.parametrize(
    ("count", "name"), [(4000, ""), (64, "n" * 64 * KILOBYTE), (16, "\U0001d4a9" * 64 * KILOBYTE)]
)
def test_many_small_files_and_long_names_fill_a_page_too(count: int, name: str, desk: Desk) -> None:
    desk.open.set()
    desk.filled(count // 2, name=name)
    assert finished(desk.put(length=100)) == 204
    desk.filled(count, name=name)
    assert finished(desk.put(length=100)) == 413


def test_the_id_of_a_file_counts_while_it_arrives(desk: Desk) -> None:
    async def go() -> list[int]:
        long = "9" * 60_000
        puts = [asyncio.create_task(desk.put(length=1, name=long)) for _ in range(100)]
        for _ in range(5):
            await asyncio.sleep(0)
        desk.open.set()
        return await asyncio.gather(*puts)

    assert finished(go()).count(204) == 4 * MEGABYTE // 61_100


def test_a_file_that_does_not_come_gives_up_its_room(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def go() -> list[int]:
        waiting = [desk.put(length=MEGABYTE, page=f"{i // 3}") for i in range(31)]
        told = await asyncio.gather(*waiting)
        desk.open.set()
        return [*told, await desk.put(length=MEGABYTE, page="last")]

    monkeypatch.setattr(uploads, "SLOWEST", 0.01)
    assert finished(go()) == [408] * 31 + [204]
