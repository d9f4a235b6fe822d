"""Which message is passed to Streamlit next: one page's at a time, in fair turns.

What a message starts, a thread and a run, takes the processor before it waits for its turn among
the runs, and what it draws is sent beside the others that run then. So a message waits here, where
it costs nothing, until no other page is computing. A server that has nothing else to do hands it on
at once, however many came before.

Addresses share the processor by time, in start-time fair queuing as among the runs: so many pages
of one address get no more than one of another. Of an address's pages the one goes first whose last
turn was longest ago, so that one who asks now and then need not wait for twenty who ask all the
time, nor for ever new ones.

A turn ends when its page's run steps out of the line of runs, done or aside, and after `LONGEST` in
any case: what neither computes nor ends holds up nobody.
"""

import asyncio
import time
from dataclasses import dataclass, field

LONGEST = 0.25  # seconds: a run takes some hundredths


@dataclass
class Share:
    """An address's share of the processor."""

    end: float = 0.0  # where its last turn ended, on the clock that all addresses share by

    def begin(self, clock: float) -> float:
        """Return where its next turn begins on that clock."""
        return max(self.end, clock)


@dataclass(eq=False)
class Page:
    """A page of an address."""

    share: Share
    session: str = ""  # by which the line of runs knows it, as soon as that is known
    last: float = field(init=False)  # when its last turn ended, or it was opened

    def __post_init__(self) -> None:
        self.last = time.monotonic()


@dataclass(frozen=True)
class _Turn:
    page: Page
    since: float
    longest: asyncio.TimerHandle


class Turns:
    """Gives one page its turn at a time; used in one event loop."""

    def __init__(self) -> None:
        self._clock = 0.0  # where the turn that began last began
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
        page.last = time.monotonic()
        page.share.end = page.share.begin(self._clock) + page.last - turn.since
        self._turn = None
        self._next()

    def _next(self) -> None:
        """Let the turn begin of the address that has used least, of its page that waits longest."""
        if self._turn is not None or not self._line:
            return
        page = min(self._line, key=lambda page: (page.share.begin(self._clock), page.last))
        self._clock = page.share.begin(self._clock)
        longest = asyncio.get_running_loop().call_later(LONGEST, self._end, page)
        self._turn = _Turn(page, time.monotonic(), longest)
        self._line.pop(page).set_result(None)
