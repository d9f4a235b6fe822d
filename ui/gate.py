"""One page at a time in a process.

Python computes one thing at a time. Two pages that run side by side take turns every few
milliseconds, and both come as late as the later one would after the other; with ten visitors
nobody's page comes soon. Here a page runs to its end before the next begins. What waits for
something other than the processor steps aside.
"""

import threading
from collections.abc import Iterator
from contextlib import contextmanager


class Gate:
    """Lets one thread through at a time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._mine = threading.local()

    @contextmanager
    def through(self) -> Iterator[None]:
        """Wait until nobody else is in, and let nobody else in meanwhile; who is in, is."""
        if getattr(self._mine, "inside", False):
            yield
            return
        with self._lock:
            self._mine.inside = True
            try:
                yield
            finally:
                self._mine.inside = False

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Let others in meanwhile, where this thread is in."""
        if not getattr(self._mine, "inside", False):
            yield
            return
        self._mine.inside = False
        self._lock.release()
        try:
            yield
        finally:
            self._lock.acquire()
            self._mine.inside = True


PAGES = Gate()
