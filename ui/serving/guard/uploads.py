"""Files that visitors send, taken as long as there is room."""

from collections import Counter
from typing import cast

from starlette.types import ASGIApp, Receive, Scope, Send
from streamlit import runtime
from streamlit.runtime.memory_uploaded_file_manager import MemoryUploadedFileManager

from ui.serving.guard.browsers import UPLOADS
from ui.serving.guard.refusal import below_base, header, refuse
from ui.serving.settings import Limits

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
            return
        session = below_base(scope).removeprefix(UPLOADS).split("/")[0]
        length = header(scope, "content-length")
        if length is None or not length.isdecimal():
            why = "A file comes with its length"
            await refuse(scope, receive, send, status=411, why=why)
        elif why := self._no_room(session, int(length)):
            await refuse(scope, receive, send, status=413, why=why)
        else:
            self._arriving[session] += int(length)
            try:
                await self._app(scope, receive, send)
            finally:
                self._arriving -= Counter({session: int(length)})

    def _no_room(self, session: str, size: int) -> str:
        """Return why a file is not taken, "" where it is."""
        limits, stored = self._limits, _stored()
        if stored[session] + self._arriving[session] + size > limits.upload_session * _MEGABYTE:
            return "This page holds too many files: reload it"
        if stored.total() + self._arriving.total() + size > limits.upload * _MEGABYTE:
            return "This server holds too many files"
        return ""


def _stored() -> Counter[str]:
    """Return how many bytes of files Streamlit keeps, by session."""
    manager = cast("MemoryUploadedFileManager", runtime.get_instance().uploaded_file_mgr)
    kept = manager.file_storage.items()
    return Counter(
        {session: sum(len(file.data) for file in files.values()) for session, files in kept}
    )
