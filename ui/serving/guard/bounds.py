"""How much one visitor, one address and all of them may ask.

Websockets are counted, their messages are handed on no faster than a bucket's tokens come back, and
files are taken as long as there is room. Streamlit has no such bounds: each message is a run of a
page, in a thread of its own where another is under way.
"""

import asyncio
import time
from collections import Counter
from dataclasses import dataclass
from ipaddress import IPv6Address, ip_address, ip_network
from typing import cast

from starlette.types import ASGIApp, Message, Receive, Scope, Send
from streamlit import runtime
from streamlit.runtime.memory_uploaded_file_manager import MemoryUploadedFileManager

from ui.serving.guard.browsers import UPLOADS
from ui.serving.guard.refusal import below_base, count, header, refuse
from ui.serving.settings import Limits

_MEGABYTE = 1 << 20
_ADDRESSES = 4096  # remembered, beside those that have a websocket open
_POLICY_VIOLATION, _UNSUPPORTED = 1008, 1003  # RFC 6455, section 7.4.1
_FAST = "Too many messages"


class Bucket:
    """Tokens that come back at a rate, and heap up to a burst."""

    def __init__(self, rate: float, burst: float) -> None:
        self._rate, self._burst, self._tokens = rate, burst, float(burst)
        self._at = time.monotonic()

    def reserve(self) -> float:
        """Take a token, there or not yet; return in how many seconds it is there."""
        self._fill()
        self._tokens -= 1
        return max(0.0, -self._tokens / self._rate)

    def give_back(self) -> None:
        """Give back a token that was reserved and not used."""
        self._tokens += 1

    def take(self) -> bool:
        """Take a token if there is one."""
        self._fill()
        if self._tokens < 1:
            return False
        self._tokens -= 1
        return True

    def _fill(self) -> None:
        now = time.monotonic()
        self._tokens = min(self._burst, self._tokens + (now - self._at) * self._rate)
        self._at = now


@dataclass
class Address:
    """What comes from one address."""

    openings: Bucket
    messages: Bucket
    sockets: int = 0


class Paced:
    """A websocket whose messages are handed on as its buckets allow, and which ends in a flood.

    It is read all the time: that it has been closed would else be seen only after all that came
    before.
    """

    def __init__(
        self, receive: Receive, send: Send, *, buckets: tuple[Bucket, ...], limits: Limits
    ) -> None:
        self._receive, self._send, self._buckets = receive, send, buckets
        self._most, self._most_bytes = limits.waiting, limits.waiting_megabytes * _MEGABYTE
        self._waiting: asyncio.Queue[Message] = asyncio.Queue()
        self._bytes = 0
        self._end: Message | None = None
        self._begun = self._closed = False
        self._reading = asyncio.create_task(self._read())

    async def receive(self) -> Message:
        """Return the next message when its time has come, or at once that there is no more."""
        if self._end is not None and self._begun:
            return self._end
        message = await self._waiting.get()
        self._begun = True  # the first message is that a websocket is wanted
        if message["type"] != "websocket.receive":
            return message
        self._bytes -= len(message["bytes"])
        pause = max(bucket.reserve() for bucket in self._buckets)
        if pause > 0:
            await asyncio.wait({self._reading}, timeout=pause)
        if self._end is None:
            return message
        # Else a flood of websockets, each closed in turn, would leave its address in debt.
        for bucket in self._buckets:
            bucket.give_back()
        return self._end

    async def send(self, message: Message) -> None:
        """Send, as long as the guard has not closed the websocket itself."""
        if not self._closed:
            await self._send(message)

    def close(self) -> None:
        """Stop reading."""
        self._reading.cancel()

    async def _read(self) -> None:
        while self._end is None:
            message = await self._receive()
            if message["type"] == "websocket.disconnect":
                self._end = message
            elif message["type"] == "websocket.receive":
                await self._judge(message)
            self._waiting.put_nowait(self._end or message)

    async def _judge(self, message: Message) -> None:
        """Count a message, and close the websocket where it is one too many."""
        data = message.get("bytes")
        if data is None:
            await self._close(_UNSUPPORTED, "Not a message of a page")
            return
        self._bytes += len(data)
        if self._waiting.qsize() >= self._most or self._bytes > self._most_bytes:
            await self._close(_POLICY_VIOLATION, _FAST)

    async def _close(self, code: int, why: str) -> None:
        count(why)
        self._end = {"type": "websocket.disconnect", "code": code, "reason": why}
        self._closed = True
        await self._send({"type": "websocket.close", "code": code, "reason": why})


class Bounds:
    """Lets through what the limits allow."""

    def __init__(self, app: ASGIApp, limits: Limits) -> None:
        self._app, self._limits = app, limits
        self._addresses: dict[str, Address] = {}
        self._sockets = 0
        self._arriving: Counter[str] = Counter()  # bytes of files on their way, by session

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer as the app does, within the bounds."""
        if scope["type"] == "websocket":
            await self._socket(scope, receive, send)
        elif scope["type"] == "http" and below_base(scope).startswith(UPLOADS):
            await self._upload(scope, receive, send)
        else:
            await self._app(scope, receive, send)

    async def _socket(self, scope: Scope, receive: Receive, send: Send) -> None:
        limits, address = self._limits, self._address(scope)
        if why := self._no_socket(address):
            # Not 503: a proxy would take this replica for one that is gone.
            await refuse(scope, receive, send, status=429, why=why, **{"Retry-After": "10"})
            return
        own = Bucket(limits.messages, limits.messages_burst)
        paced = Paced(receive, send, buckets=(own, address.messages), limits=limits)
        self._sockets += 1
        address.sockets += 1
        try:
            await self._app(scope, paced.receive, paced.send)
        finally:
            self._sockets -= 1
            address.sockets -= 1
            paced.close()

    def _no_socket(self, address: Address) -> str:
        """Return why an address gets no other websocket, "" where it does."""
        if self._sockets >= self._limits.sockets:
            return "This server has no room for another page"
        if address.sockets >= self._limits.sockets_address or not address.openings.take():
            return "Too many pages from one address"
        return ""

    def _address(self, scope: Scope) -> Address:
        """Return what comes from a request's address; uvicorn has heeded a proxy that it trusts."""
        name = network((scope.get("client") or ("", 0))[0])
        if name not in self._addresses:
            self._forget()
            limits = self._limits
            self._addresses[name] = Address(
                openings=Bucket(limits.openings_address, limits.sockets_address),
                messages=Bucket(limits.messages_address, limits.messages_address_burst),
            )
        return self._addresses[name]

    def _forget(self) -> None:
        """Forget the address known longest of those with no websocket, where there are many."""
        if len(self._addresses) >= _ADDRESSES:
            gone = (name for name, address in self._addresses.items() if not address.sockets)
            self._addresses.pop(next(gone, ""), None)

    async def _upload(self, scope: Scope, receive: Receive, send: Send) -> None:
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


def network(address: str) -> str:
    """Return under what an address is counted: itself, of IPv6 the 64 bits that a house has."""
    try:
        known = ip_address(address)
    except ValueError:
        return address
    if not isinstance(known, IPv6Address):
        return address
    mapped = known.ipv4_mapped
    return str(mapped or ip_network((known, 64), strict=False))


def _stored() -> Counter[str]:
    """Return how many bytes of files Streamlit keeps, by session."""
    manager = cast("MemoryUploadedFileManager", runtime.get_instance().uploaded_file_mgr)
    kept = manager.file_storage.items()
    return Counter(
        {session: sum(len(file.data) for file in files.values()) for session, files in kept}
    )
