"""The server's look at itself, every few seconds, and its beat to whoever watches over it.

`/healthz` answers with what the last look has found. systemd, or `deploy/watch.py` in a container,
is told by sd_notify's protocol when the server is ready and that it lives; where the beat stays
away it ends the server and starts it anew. A server whose event loop hangs gives no beat. One that
has computed or drawn nothing well for 45 s gives none either: it may only be busy before.
"""

import asyncio
import importlib
import logging
import os
import socket
import time
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import partial

from ui.jobs import queue
from ui.serving import health, log, own_visit, settings

_LOOK = 5.0  # seconds between two looks, of some 25 ms of the processor
_BEAT = 2.0  # seconds between two beats
# Seconds for a part, after which it is taken for hung; at the start there is much to import.
_PATIENCE, AT_START = 15.0, 30.0
_TOO_OLD = 45.0  # seconds after the last good look
# Other faults mend themselves: a process for computations is replaced.
_VITAL = {"core", "files", "pages"}


class Pulse:
    """What a server finds when it looks at itself."""

    def __init__(self) -> None:
        self._found: dict[str, str] = {"server": "starts"}
        self._looked = self._well = time.monotonic()
        # Its own thread: those that requests share may all wait for something.
        self._pool = ThreadPoolExecutor(1, "pulse")

    def faults(self) -> dict[str, str]:
        """Return what is wrong, by its part of the server."""
        age = time.monotonic() - self._looked
        if age > _TOO_OLD:
            return {"server": f"has not looked at itself for {age:.0f} s"}
        return self._found

    async def look(self, patience: float = _PATIENCE) -> dict[str, str]:
        """Look at each part, and return what is wrong."""
        call = asyncio.get_running_loop().run_in_executor
        parts: dict[str, Callable[[], Awaitable[str | None]]] = {
            "core": lambda: call(self._pool, health.check),
            "files": lambda: call(self._pool, _publish),
            "pages": own_visit.fault_of,
        }
        for turns in queue.LINES:
            parts[turns.name] = partial(call, self._pool, turns.inspect)
        found = {part: await _fault(of, patience) for part, of in parts.items()}
        before, self._found = self._found, {part: why for part, why in found.items() if why}
        self._looked = time.monotonic()
        if not self._found.keys() & _VITAL:
            self._well = self._looked
        if self._found and self._found != before:
            log.event("unhealthy", level=logging.WARNING, why=self._found)
        return self._found

    async def go_on(self) -> None:
        """Look and beat until cancelled."""
        await asyncio.gather(self._looks(), self._beats())

    async def _looks(self) -> None:
        while True:
            await asyncio.sleep(_LOOK)
            await self.look()

    async def _beats(self) -> None:
        while True:
            if time.monotonic() - self._well < _TOO_OLD:
                tell("WATCHDOG=1")
            await asyncio.sleep(_BEAT)


PULSE = Pulse()


def tell(words: str) -> None:
    """Tell who has started this server, if it asked to be told, as sd_notify does."""
    if not (address := os.environ.get("NOTIFY_SOCKET")):
        return
    if address.startswith("@"):  # one without a file
        address = f"\0{address[1:]}"
    with suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as there:
        there.setblocking(False)  # a missed beat is no harm, a hung server is
        there.sendto(words.encode(), address)


def _publish() -> None:
    """Put the live components' scripts where Streamlit serves them, where there are any."""
    if settings.live() != "off":
        importlib.import_module("ui.live.assets").publish()


async def _fault(look: Callable[[], Awaitable[str | None]], patience: float) -> str:
    """Return what is wrong with a part, or ""."""
    try:
        return await asyncio.wait_for(look(), patience) or ""
    except TimeoutError:
        return f"no answer in {patience:g} s"
    except Exception as error:  # noqa: BLE001 - whatever it is, this part is not well
        return f"{type(error).__name__}: {error}"
