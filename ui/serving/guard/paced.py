"""A websocket whose messages are handed on in its page's turns, and which ends in a flood."""

import asyncio
from collections import deque

from starlette.types import Message, Receive, Send

from ui.serving.guard.browsers import session_begun
from ui.serving.guard.refusal import count
from ui.serving.guard.turns import Page, Turns
from ui.serving.settings import Limits

_HELD = 3.0  # seconds for which a flood's websocket is left open; the server's end waits for it
_MEGABYTE = 1 << 20
_POLICY_VIOLATION, _UNSUPPORTED = 1008, 1003  # RFC 6455, section 7.4.1


class Paced:
    """A page's websocket.

    Each message has a turn of its own: of two that came together Streamlit would begin a run of the
    first too. It is read all the time: that it has been closed would else be seen only after all
    that came before.
    """

    def __init__(
        self, receive: Receive, send: Send, *, turns: Turns, page: Page, limits: Limits
    ) -> None:
        self._receive, self._send, self._turns, self._page = receive, send, turns, page
        self._most, self._most_bytes = limits.waiting, limits.waiting_megabytes * _MEGABYTE
        self._waiting: deque[Message] = deque()
        self._bytes = 0
        self._came = asyncio.Event()  # whether anything waits, or there is no more
        self._end: Message | None = None
        self._refusal: Message | None = None  # where the guard closes the websocket itself
        self._begun = False
        self._reading = asyncio.create_task(self._read())

    async def receive(self) -> Message:
        """Return the next message when its time has come, or at once that there is no more."""
        if not self._begun:  # the first message is that a websocket is wanted
            self._begun = True
            await self._came.wait()
            return self._next()
        await self._turn()
        if self._end is not None:
            return self._end
        message = self._next()
        self._bytes -= len(message["bytes"])
        return message

    async def send(self, message: Message) -> None:
        """Send, as long as the guard has not closed the websocket itself."""
        if not self._page.session:
            self._page.session = session_begun(message)
        if self._refusal is None:
            await self._send(message)

    async def close(self) -> None:
        """Stop reading, give up the turn, and close the websocket where the guard does so.

        A flood's is first left open and unread, which costs nothing: its sender can neither go on
        nor come back. Then uvicorn cuts it off, since nothing is said: after a close it would read
        for ten seconds, or until the sender agrees, all that comes.
        """
        self._reading.cancel()
        self._turns.forget(self._page)
        if self._refusal is None:
            return
        if self._refusal["code"] == _POLICY_VIOLATION:
            await asyncio.sleep(_HELD)
        else:
            await self._send(self._refusal)

    async def _turn(self) -> None:
        """Wait for a message and then for the page's turn, or for the end."""
        await self._came.wait()
        if self._end is None:
            called = self._turns.ask(self._page)
            await asyncio.wait({called, self._reading}, return_when=asyncio.FIRST_COMPLETED)

    def _next(self) -> Message:
        message = self._waiting.popleft()
        if not self._waiting and self._end is None:
            self._came.clear()
        return message

    async def _read(self) -> None:
        while self._end is None:
            message = await self._receive()
            if message["type"] == "websocket.disconnect":
                self._end = message
            elif message["type"] == "websocket.receive" and (why := self._too_much(message)):
                self._refuse(*why)
            else:
                self._waiting.append(message)
            self._came.set()

    def _too_much(self, message: Message) -> tuple[int, str] | None:
        """Count a message; return code and reason where it is one too many, or none of a page."""
        data = message.get("bytes")
        if data is None:
            return _UNSUPPORTED, "Not a message of a page"
        self._bytes += len(data)
        if len(self._waiting) >= self._most or self._bytes > self._most_bytes:
            return _POLICY_VIOLATION, "Too many messages"
        return None

    def _refuse(self, code: int, why: str) -> None:
        count(why)
        closing = {"code": code, "reason": why}
        self._end = {"type": "websocket.disconnect", **closing}
        self._refusal = {"type": "websocket.close", **closing}
