"""Heavy computations: a few at once in a process, the others in line, and what they found kept.

Python computes one thing at a time, so ten visitors' maps at once would come ten times later, and
every other visitor's page with them. Here they come one after the other, each as soon as it can,
and who waits is told how many are ahead.
"""

import threading
from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields, is_dataclass
from functools import update_wrapper
from typing import Generic, ParamSpec, TypeVar, cast

import numpy as np
import streamlit as st
from streamlit.runtime.scriptrunner import get_script_run_ctx

from ui import settings

P = ParamSpec("P")
T = TypeVar("T")

# Who would be further back than this is asked to come again.
LONGEST_LINE = 30
_LOOK = 0.25  # seconds between two looks at the line
BUSY = "Many visitors ask for long computations just now. Try again in a minute."


class Turns:
    """A line of computations, of which the first `limit` run."""

    def __init__(self, limit: int, longest: int = LONGEST_LINE) -> None:
        self._limit = limit
        self._longest = longest
        self._line: list[object] = []
        self._changed = threading.Condition()
        self._mine = threading.local()

    @contextmanager
    def turn(self) -> Iterator[None]:
        """Wait for a turn, and hold it; a turn within a turn is the same one."""
        if getattr(self._mine, "held", False):
            yield
            return
        ticket = object()
        try:
            self._join(ticket)
            self._wait(ticket)
            self._mine.held = True
            yield
        finally:
            self._mine.held = False
            self._leave(ticket)

    def ahead(self, ticket: object) -> int:
        """Return how many must end before a computation begins."""
        return max(self._line.index(ticket) + 1 - self._limit, 0)

    def _join(self, ticket: object) -> None:
        with self._changed:
            full = len(self._line) >= self._limit + self._longest
            if not full:
                self._line.append(ticket)
        if full:
            if _nobody_looks():  # a held thumb: it asks again
                raise ValueError(BUSY)
            st.warning(BUSY)
            st.stop()

    def _leave(self, ticket: object) -> None:
        with self._changed:
            if ticket in self._line:
                self._line.remove(ticket)
                self._changed.notify_all()

    def _wait(self, ticket: object) -> None:
        with self._changed:
            ahead = self.ahead(ticket)
        if not ahead:
            return
        place = None if _nobody_looks() else st.empty()
        while ahead:
            if place is not None:  # where a visitor has gone on meanwhile, this ends the run
                place.info(_words(ahead))
            with self._changed:
                self._changed.wait(_LOOK)
                ahead = self.ahead(ticket)
        if place is not None:
            place.empty()


TURNS = Turns(settings.heavy_jobs())


class Kept(Generic[P, T]):
    """A heavy function that computes in its turn, and keeps the last results up to a size."""

    def __init__(self, work: Callable[P, T], entries: int, megabytes: float) -> None:
        self._work = work
        self._entries, self._bytes = entries, megabytes * 1e6
        self._found: OrderedDict[object, tuple[T, int]] = OrderedDict()
        self._lock = threading.Lock()
        update_wrapper(self, work)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> T:
        """Return a kept result, or compute it when its turn has come."""
        key = (args, tuple(kwargs.items()))
        if (found := self._look(key)) is not None:
            return found[0]
        with TURNS.turn():
            # Somebody ahead may have asked for the same.
            if (found := self._look(key)) is not None:
                return found[0]
            result = self._work(*args, **kwargs)
        self._keep(key, result)
        return result

    @property
    def size(self) -> int:
        """Bytes of the results kept."""
        with self._lock:
            return sum(size for _, size in self._found.values())

    def __len__(self) -> int:
        return len(self._found)

    def _look(self, key: object) -> tuple[T, int] | None:
        with self._lock:
            if key in self._found:
                self._found.move_to_end(key)
            return self._found.get(key)

    def _keep(self, key: object, result: T) -> None:
        with self._lock:
            self._found[key] = result, size_of(result)
            while len(self._found) > self._entries or (
                len(self._found) > 1 and sum(size for _, size in self._found.values()) > self._bytes
            ):
                self._found.popitem(last=False)


def heavy(*, entries: int, megabytes: float) -> Callable[[Callable[P, T]], Kept[P, T]]:
    """Return a decorator for a heavy function of hashable arguments."""
    return lambda work: Kept(work, entries, megabytes)


def size_of(result: object) -> int:
    """Return about how many bytes a result takes: its arrays, and a little for each other part."""
    if isinstance(result, np.ndarray):
        return result.nbytes
    if is_dataclass(result):
        return sum(size_of(getattr(result, item.name)) for item in fields(result))
    if isinstance(result, Mapping):
        return sum(size_of(item) for item in cast("Mapping[object, object]", result).values())
    if isinstance(result, tuple | list):
        return sum(size_of(item) for item in cast("list[object]", result))
    return 64


def _nobody_looks() -> bool:
    """Return whether there is no page to write on."""
    return get_script_run_ctx(suppress_warning=True) is None


def _words(ahead: int) -> str:
    others = "one of another visitor comes" if ahead == 1 else f"{ahead} of other visitors come"
    return f"This computation waits for its turn: {others} first."
