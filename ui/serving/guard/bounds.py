"""How much one visitor, one address and all of them may ask.

Websockets are counted, their messages are handed on in turns, and files are taken as long as there
is room. Streamlit has no such bounds: each message is a run of a page, in a thread of its own where
another is under way.
"""

import asyncio
import time
from contextlib import suppress
from dataclasses import dataclass, field
from ipaddress import IPv6Address, ip_address, ip_network

from starlette.types import ASGIApp, Receive, Scope, Send

from ui.serving import one_at_a_time
from ui.serving.guard.browsers import UPLOADS
from ui.serving.guard.paced import Paced
from ui.serving.guard.refusal import below_base, refuse
from ui.serving.guard.turns import Page, Share, Turns
from ui.serving.guard.uploads import Uploads
from ui.serving.settings import Limits

_ADDRESSES = 4096  # remembered, beside those that have a websocket open


class Bucket:
    """Tokens that come back at a rate, and heap up to a burst."""

    def __init__(self, rate: float, burst: float) -> None:
        self._rate, self._burst, self._tokens = rate, burst, float(burst)
        self._at = time.monotonic()

    def take(self) -> bool:
        """Take a token if there is one."""
        now = time.monotonic()
        self._tokens = min(self._burst, self._tokens + (now - self._at) * self._rate)
        self._at = now
        if self._tokens < 1:
            return False
        self._tokens -= 1
        return True


@dataclass
class Address:
    """What comes from one address."""

    openings: Bucket
    share: Share = field(default_factory=Share)
    sockets: int = 0


class Bounds:
    """Lets through what the limits allow."""

    def __init__(self, app: ASGIApp, limits: Limits) -> None:
        self._app, self._limits = app, limits
        self._addresses: dict[str, Address] = {}
        self._sockets = 0
        self._uploads = Uploads(app, limits)
        self._turns = Turns()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer as the app does, within the bounds."""
        if scope["type"] == "websocket":
            await self._socket(scope, receive, send)
        elif scope["type"] == "http" and below_base(scope).startswith(UPLOADS):
            await self._uploads(scope, receive, send)
        else:
            await self._app(scope, receive, send)

    async def _socket(self, scope: Scope, receive: Receive, send: Send) -> None:
        limits, address = self._limits, self._address(scope)
        if why := self._no_socket(address):
            # Not 503: a proxy would take this replica for one that is gone.
            await refuse(scope, receive, send, status=429, why=why, **{"Retry-After": "10"})
            return
        self._listen()
        page = Page(address.share)
        paced = Paced(receive, send, turns=self._turns, page=page, limits=limits)
        self._sockets += 1
        address.sockets += 1
        try:
            await self._app(scope, paced.receive, paced.send)
        finally:
            await paced.close()
            self._sockets -= 1
            address.sockets -= 1

    def _listen(self) -> None:
        """Have this loop told when a session's run steps out of the line of runs."""
        loop = asyncio.get_running_loop()

        def left(session: str) -> None:
            with suppress(RuntimeError):  # the server has ended
                loop.call_soon_threadsafe(self._turns.left, session)

        one_at_a_time.PAGES.on_leaving = left

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
                openings=Bucket(limits.openings_address, limits.sockets_address)
            )
        return self._addresses[name]

    def _forget(self) -> None:
        """Forget the address known longest of those with no websocket, where there are many."""
        if len(self._addresses) >= _ADDRESSES:
            gone = (name for name, address in self._addresses.items() if not address.sockets)
            self._addresses.pop(next(gone, ""), None)


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
