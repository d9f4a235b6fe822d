"""The network between a visitor and a server: it can be cut, and it can fall silent."""

import asyncio
import threading
from collections.abc import Coroutine
from contextlib import suppress
from typing import Any, Self


class Line:
    """Forwards a port of this machine to another one, until it is cut or silenced.

    A connection that was there when the line fell silent never passes on anything again.
    """

    def __init__(self, to: int) -> None:
        self._to = to
        self._loop = asyncio.new_event_loop()
        self._server: asyncio.Server | None = None
        self._writers: list[asyncio.StreamWriter] = []
        self._silences = 0
        self._silent = False
        self.port = 0

    def __enter__(self) -> Self:
        self._thread = threading.Thread(target=self._run)
        self._thread.start()
        self.mend()
        return self

    def __exit__(self, *_: object) -> None:
        self.cut()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()

    def mend(self) -> None:
        """Pass on what comes by new connections."""
        self._do(self._mend())

    def cut(self) -> None:
        """End all connections and refuse new ones."""
        self._do(self._cut())

    def fall_silent(self) -> None:
        """Take what comes and pass on nothing, as where packets are lost."""
        self._silent = True
        self._silences += 1

    def _run(self) -> None:
        self._loop.run_forever()
        self._loop.run_until_complete(self._end())
        self._loop.close()

    def _do(self, work: Coroutine[Any, Any, None]) -> None:
        asyncio.run_coroutine_threadsafe(work, self._loop).result(10)

    async def _end(self) -> None:
        left = asyncio.all_tasks() - {asyncio.current_task()}
        for task in left:
            task.cancel()
        await asyncio.gather(*left, return_exceptions=True)

    async def _mend(self) -> None:
        self._silent = False
        if self._server is None:
            self._server = await asyncio.start_server(self._connected, "127.0.0.1", self.port)
            self.port = self._server.sockets[0].getsockname()[1]

    async def _cut(self) -> None:
        if self._server is not None:
            self._server.close()
        self._server = None
        for writer in self._writers:
            writer.transport.abort()
        self._writers.clear()

    async def _connected(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._writers.append(writer)
        if self._silent:
            return
        try:
            onward = await asyncio.open_connection("127.0.0.1", self._to)
        except OSError:  # no server
            writer.transport.abort()
            return
        self._writers.append(onward[1])
        silences = self._silences
        await asyncio.gather(
            self._pass_on(reader, onward[1], silences), self._pass_on(onward[0], writer, silences)
        )

    async def _pass_on(
        self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, silences: int
    ) -> None:
        with suppress(OSError):
            while data := await reader.read(1 << 16):
                if self._silences == silences:
                    writer.write(data)
                    await writer.drain()
        if self._silences == silences:
            writer.close()
