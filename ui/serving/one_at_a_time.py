"""One page at a time in a process.

Python computes one thing at a time. Two pages that run side by side take turns every few
milliseconds, and both come as late as the later one would after the other; with ten visitors
nobody's page comes soon. Here a page runs to its end before the next begins. What waits for
something other than the processor steps aside, and keeps its place in the line.
"""

import heapq
import itertools
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager


class Gate:
    """Admits one thread at a time, in order of arrival, also after stepping aside."""

    def __init__(self) -> None:
        self._mine = threading.local()
        self._change = threading.Lock()
        self._taken = False
        self._number = itertools.count()
        # Those who wait: since when they have been here, and what they wait for.
        self._line: list[tuple[float, int, threading.Event]] = []

    @contextmanager
    def through(self) -> Iterator[None]:
        """Wait until nobody else is in, and let nobody else in meanwhile; who is in, is."""
        if getattr(self._mine, "inside", False):
            yield
            return
        self._mine.since = time.monotonic()
        self._enter()
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
        self._leave()
        try:
            yield
        finally:
            self._enter()

    def _enter(self) -> None:
        called = threading.Event()
        with self._change:
            if self._taken:
                heapq.heappush(self._line, (self._mine.since, next(self._number), called))
            else:
                self._taken = True
                called.set()
        called.wait()
        self._mine.inside = True

    def _leave(self) -> None:
        self._mine.inside = False
        with self._change:
            if self._line:
                heapq.heappop(self._line)[-1].set()
            else:
                self._taken = False


PAGES = Gate()
