"""Files that visitors send, taken as long as there is room.

A file is counted with its id, its name and its record, from when it is announced: many small ones
fill a server too, and of many at once each would find room.
"""

import asyncio
from collections import Counter
from sys import getsizeof
from typing import cast

from starlette.types import ASGIApp, Receive, Scope, Send
from streamlit import runtime
from streamlit.runtime.memory_uploaded_file_manager import MemoryUploadedFileManager
from streamlit.runtime.uploaded_file_manager import UploadedFileRec

from ui.serving.guard.browsers import UPLOADS
from ui.serving.guard.refusal import below_base, header, refuse
from ui.serving.settings import Limits

SLOWEST = 30.0  # seconds for a whole file; a machine's is a kilobyte
RECORD = 1024  # bytes that a file takes beside its content and its words, amply
_MEGABYTE = 1 << 20


class Uploads:
    """Lets through the files for which a page, and the server, have room."""

    def __init__(self, app: ASGIApp, limits: Limits) -> None:
        self._app, self._limits = app, limits
        self._arriving: Counter[str] = Counter()  # bytes of files on their way, by session

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer as the app does, where there is room."""
        if scope["method"] != "PUT":
            await self._app(scope, receive, send)
        elif refusal := _unmeasured(scope):
            status, why = refusal
            await refuse(scope, receive, send, status=status, why=why)
        else:
            await self._take(scope, receive, send)

    async def _take(self, scope: Scope, receive: Receive, send: Send) -> None:
        path = below_base(scope)
        session, size = path.removeprefix(UPLOADS).split("/")[0], _size(scope, path)
        if why := self._no_room(session, size):
            await refuse(scope, receive, send, status=413, why=why)
            return
        self._arriving[session] += size
        try:
            async with asyncio.timeout(SLOWEST):
                await self._app(scope, receive, send)
        except TimeoutError:  # its room is another's
            why = f"A file comes within {SLOWEST:g} s"
            await refuse(scope, receive, send, status=408, why=why, Connection="close")
        finally:
            self._arriving -= Counter({session: size})

    def _no_room(self, session: str, size: int) -> str:
        """Return why a file is not taken, "" where it is."""
        limits, stored = self._limits, _stored()
        if stored[session] + self._arriving[session] + size > limits.upload_session * _MEGABYTE:
            return "This page holds too many files: reload it"
        if stored.total() + self._arriving.total() + size > limits.upload * _MEGABYTE:
            return "This server holds too many files"
        return ""


def _unmeasured(scope: Scope) -> tuple[int, str] | None:
    """Return status and reason where a request does not tell its length, or tells it twice."""
    # A body in chunks ends where it likes, whatever length is named beside it (RFC 9112, 6.3).
    if header(scope, "transfer-encoding") is not None:
        return 400, "A file comes whole, not in chunks"
    if not (header(scope, "content-length") or "").isdecimal():
        return 411, "A file comes with its length"
    return None


def _size(scope: Scope, path: str) -> int:
    """Return what a file on its way will take [bytes]; its path holds its id."""
    return int(header(scope, "content-length") or 0) + getsizeof(path) + RECORD


def _stored() -> Counter[str]:
    """Return how many bytes Streamlit keeps for files, by session."""
    manager = cast("MemoryUploadedFileManager", runtime.get_instance().uploaded_file_mgr)
    kept = manager.file_storage.items()
    return Counter({session: sum(map(_taken, files.values())) for session, files in kept})


def _taken(file: UploadedFileRec) -> int:
    # Four bytes a letter where one of them needs four: the length of a name is not its size.
    return sum(map(getsizeof, (file.file_id, file.name, file.type, file.data))) + RECORD
