"""Whose messages are handed to Streamlit next: one page's at a time, of who has used least.

What a message starts, a thread and a run, takes the processor before it waits for its turn among
the runs, and what it draws is sent beside the others that run then. So a message waits here, where
it costs nothing, until no other page is computing. A server that has nothing else to do hands it on
at once, however many came before.

It is start-time fair queuing, as among the runs (`one_at_a_time`), at two levels: addresses share
the processor, and the pages of each what comes to it. So many pages of one address get no more than
one of another, and of them who asks least goes first.

A turn ends when its page's run steps out of the line of runs, done or aside, and after `LONGEST` in
any case: what neither computes nor ends holds up nobody.
"""

import asyncio
import itertools
import time
from dataclasses import dataclass, field

LONGEST = 0.25  # seconds: a run takes some hundredths


@dataclass(eq=False)
class Sharer:
    """One who shares the processor: an address, or a page with the others of its address."""

    end: float = 0.0  # where its last turn ended, on the clock that it shares by
    clock: float = 0.0  # that its own pages share by: where the last turn of them began
    number: int = field(default_factory=itertools.count().__next__)

    def begin(self, clock: float) -> float:
        """Return where its next turn begins on the clock that it shares by."""
        return max(self.end, clock)


@dataclass(eq=False)
class Page(Sharer):
    """A page of an address."""

    address: Sharer = field(kw_only=True)
    session: str = ""  # by which the line of runs knows it, as soon as that is known


@dataclass(frozen=True)
class _Turn:
    page: Page
    since: float
    longest: asyncio.TimerHandle


class Turns:
    """Gives one page its turn at a time; used in one event loop."""

    def __init__(self) -> None:
        self._clock = 0.0  # that addresses share by
        self._line: dict[Page, asyncio.Future[None]] = {}
        self._turn: _Turn | None = None

    def ask(self, page: Page) -> asyncio.Future[None]:
        """Ask for a page's next turn; the future is done when it begins."""
        called = asyncio.get_running_loop().create_future()
        self._line[page] = called
        self._next()
        return called

    def left(self, session: str) -> None:
        """End the turn of a session's page: its run has stepped out of the line of runs."""
        if self._turn is not None and self._turn.page.session in ("", session):
            self._end(self._turn.page)

    def forget(self, page: Page) -> None:
        """End a page's turn and its waiting for one: it has been closed."""
        self._line.pop(page, None)
        self._end(page)

    def _end(self, page: Page) -> None:
        """End a page's turn, if it has it, and let the next begin."""
        turn = self._turn
        if turn is None or turn.page is not page:
            return
        turn.longest.cancel()
        used = time.monotonic() - turn.since
        page.end = page.begin(page.address.clock) + used
        page.address.end = page.address.begin(self._clock) + used
        self._turn = None
        self._next()

    def _next(self) -> None:
        """Let the turn begin of who has used least, then of who was there first."""
        if self._turn is not None or not self._line:
            return
        page = min(self._line, key=self._place)
        address = page.address
        self._clock, address.clock = address.begin(self._clock), page.begin(address.clock)
        longest = asyncio.get_running_loop().call_later(LONGEST, self._end, page)
        self._turn = _Turn(page, time.monotonic(), longest)
        self._line.pop(page).set_result(None)

    def _place(self, page: Page) -> tuple[float, int, float, int]:
        """Return where the turns of a page's address and its own begin, each with its age.

        Where they begin at once the elder goes first, before a flood of ever new pages.
        """
        address = page.address
        return (
            address.begin(self._clock), address.number, page.begin(address.clock), page.number,
        )  # fmt: skip
