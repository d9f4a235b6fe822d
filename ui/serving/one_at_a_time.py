"""One page at a time in a process, and a fair share of it for each visitor.

Python computes one thing at a time. Two pages that run side by side take turns every few
milliseconds, and both come as late as the later one would after the other; with ten visitors
nobody's page comes soon. Here a page runs to its end before the next begins. What waits for
something other than the processor steps aside, and keeps its place in the line.

Who has used less goes before who has used more, so that one who asks without end waits for the
others, and they for one page of his at most. It is start-time fair queuing: a page's place is where
its visitor's last one ended, on a clock that stands at the place of the page that runs, or now if
that is later (P. Goyal, H. M. Vin, H. Cheng, IEEE/ACM Trans. Networking 5 (1997) 690).

A visitor who asks again while waiting has the earlier page taken out of the line: Streamlit has
told its thread to stop, which it would learn only when its turn has come.
"""

import heapq
import itertools
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from streamlit.runtime.scriptrunner import StopException, get_script_run_ctx

_MANY = 1000  # visitors remembered, until those are forgotten whose last page the clock has passed


@dataclass(order=True)
class _Place:
    """A thread's place in the line: on the clock, then by its number, which no other has."""

    begin: float
    number: int
    visitor: str = field(compare=False)
    called: threading.Event = field(default_factory=threading.Event, compare=False)
    replaced: bool = field(default=False, compare=False)


class Gate:
    """Admits one thread at a time: of those who wait who has used least, then in order of arrival.

    `visitor` names whose thread it is that asks; one without a name has used nothing.
    """

    def __init__(self, visitor: Callable[[], str] = lambda: "") -> None:
        self._visitor = visitor
        self.on_leaving: Callable[[str], None] = _unheard  # called with who goes or steps aside
        self._mine = threading.local()
        self._change = threading.Lock()
        self._taken = False
        self._number = itertools.count()
        self._clock = 0.0
        self._ends: dict[str, float] = {}  # where on the clock each visitor's last page ended
        self._line: list[_Place] = []  # of those who wait
        self._new: dict[str, _Place] = {}  # of them each visitor's who has not been in yet

    @contextmanager
    def through(self, visitor: str = "") -> Iterator[None]:
        """Wait until nobody else is in, and let nobody else in meanwhile; who is in, is.

        Raises StopException where the visitor has asked for another page meanwhile.
        """
        if getattr(self._mine, "inside", False):
            yield
            return
        self._enter(self._place(visitor or self._visitor()))
        try:
            yield
        finally:
            self._leave()

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Let others in meanwhile, where this thread is in."""
        if not getattr(self._mine, "inside", False):
            yield
            return
        place = self._mine.place
        self._leave()
        try:
            yield
        finally:
            self._enter(_Place(place.begin, place.number, place.visitor), again=True)

    def _place(self, visitor: str) -> _Place:
        """Return a visitor's new place."""
        with self._change:
            begin = max(self._clock, self._ends.get(visitor, 0.0))
            return _Place(begin, next(self._number), visitor)

    def _enter(self, place: _Place, *, again: bool = False) -> None:
        """Wait for one's turn at a place, a new one or that of a thread that was aside."""
        with self._change:
            if place.visitor and not again:
                self._replace(place)
            if self._taken:
                heapq.heappush(self._line, place)
            else:
                self._take(place)
        place.called.wait()
        if place.replaced:
            raise StopException
        self._mine.inside, self._mine.place, self._mine.since = True, place, time.monotonic()

    def _replace(self, place: _Place) -> None:
        """Put a visitor's new place where an older one was, if it still waits."""
        older = self._new.get(place.visitor)
        if older is not None:
            self._line.remove(older)
            heapq.heapify(self._line)
            older.replaced = True
            older.called.set()
        self._new[place.visitor] = place

    def _take(self, place: _Place) -> None:
        """Let a thread in."""
        self._taken = True
        self._clock = max(self._clock, place.begin)
        if self._new.get(place.visitor) is place:
            del self._new[place.visitor]
        place.called.set()

    def _leave(self) -> None:
        self._mine.inside = False
        used, place = time.monotonic() - self._mine.since, self._mine.place
        with self._change:
            if place.visitor:
                self._charge(place, used)
            self._taken = False
            if self._line:
                self._take(heapq.heappop(self._line))
        self.on_leaving(place.visitor)

    def _charge(self, place: _Place, used: float) -> None:
        """Write down where on the clock a visitor's page has ended."""
        self._ends[place.visitor] = max(place.begin, self._ends.get(place.visitor, 0.0)) + used
        if len(self._ends) > _MANY:
            self._ends = {who: end for who, end in self._ends.items() if end > self._clock}


def _unheard(_: str) -> None:
    """Tell nobody."""


def _session() -> str:
    """Return the session whose page this thread runs, or ""."""
    context = get_script_run_ctx(suppress_warning=True)
    return "" if context is None else context.session_id


PAGES = Gate(_session)
