"""The queues of long computations: the first of each run, in separate processes.

Ten visitors' maps at once would come ten times later. Here they come one after the other, each as
soon as it can, and who waits is told how many are ahead. Short ones do not wait behind long ones.

A process that has ended or hangs is replaced: a free one when the server next looks at itself, one
at work as soon as its signs of life stay away, and its computation begins again, once.
"""

import math
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from queue import Empty, LifoQueue
from typing import Any

import streamlit as st
from streamlit.runtime.scriptrunner import get_script_run_ctx

from ui.jobs.process import NICER, Worker, WorkerError
from ui.jobs.work import Progress
from ui.serving import log, settings

# A request that would be further back than this in the queue is refused.
LONGEST_LINE = 30

_LOOK = 0.25  # seconds between two looks at the line
# Seconds for which it is told that a process at work was lost: the server looks at itself every
# five seconds, and it is replaced within a moment.
_TOLD = 15.0

BUSY = "Many visitors ask for long computations just now. Try again in a minute."


class Turns:
    """A queue of computations, of which the first `limit` run, each in a separate process.

    `name` is what the log and the health check call them.
    """

    def __init__(
        self,
        limit: int,
        longest: int = LONGEST_LINE,
        hire: Callable[[], Worker] = Worker,
        *,
        name: str = "long computations",
    ) -> None:
        self.name = name
        self._limit = limit
        self._longest = longest
        self._hire = hire
        self._line: list[object] = []
        self._changed = threading.Condition()
        # The last one used first: its caches are warm. Several threads take and give at once.
        self._idle: LifoQueue[Worker] = LifoQueue()
        self._at_work: list[Worker] = []
        self._lost_at = -math.inf  # when a process at work was last replaced

    def run(self, work: Callable[..., Any], args: tuple[Any, ...], tell: Progress | None) -> Any:
        """Return `work(*args)` of a process, in its turn.

        Where its process ends or hangs it begins again, once, behind the others: it may be what
        ended the process.
        """
        try:
            return self._run(work, args, tell)
        except WorkerError as error:
            self._lost_at = time.monotonic()
            log.event("replaced", what=self.name, why=str(error))
        return self._run(work, args, tell)

    def _run(self, work: Callable[..., Any], args: tuple[Any, ...], tell: Progress | None) -> Any:
        with self.turn() as worker:
            self._at_work.append(worker)
            try:
                return worker.run(work, args, tell)
            finally:
                self._at_work.remove(worker)

    @contextmanager
    def turn(self) -> Iterator[Worker]:
        """Wait for a turn, and hold it with a free process."""
        ticket = object()
        worker = None
        try:
            self._join(ticket)
            self._wait(ticket)
            worker = self._free() or self._hire()
            yield worker
        finally:
            self._put_back(worker)
            self._leave(ticket)

    @property
    def is_free(self) -> bool:
        """Whether nothing runs and nobody waits."""
        return not self._line

    def begin(self) -> None:
        """Start a process before it is needed."""
        with self.turn():
            pass

    def end(self) -> None:
        """End the free processes."""
        while worker := self._free():
            worker.close()

    def inspect(self) -> str:
        """Return what is wrong with the processes, or ""; replace free ones that do not answer."""
        silent = any(worker.silent for worker in tuple(self._at_work))
        lost = time.monotonic() - self._lost_at < _TOLD
        if self._replace_free() or silent or lost:
            return f"a process for {self.name} does not answer"
        return ""

    def _replace_free(self) -> int:
        """Replace the free processes that do not answer, and return how many there were."""
        with self._changed:  # as many turns as are free: nobody starts a process meanwhile
            tickets = [object() for _ in range(self._limit - len(self._line))]
            self._line.extend(tickets)
        try:
            free = [self._idle.get_nowait() for _ in range(min(self._idle.qsize(), len(tickets)))]
            lost = [worker for worker in free if not worker.answers()]
            for worker in lost:
                worker.close()
                log.event("replaced", what=self.name, why="a free process did not answer")
            for worker in reversed(free):
                self._idle.put(self._hire() if worker in lost else worker)
            return len(lost)
        finally:
            for ticket in tickets:
                self._leave(ticket)

    def ahead(self, ticket: object) -> int:
        """Return how many computations must end before one begins."""
        return max(self._line.index(ticket) + 1 - self._limit, 0)

    def _free(self) -> Worker | None:
        """Return a free process that has not ended, if there is one."""
        with suppress(Empty):
            while (worker := self._idle.get_nowait()).ended:
                worker.close()
            return worker
        return None

    def _join(self, ticket: object) -> None:
        with self._changed:
            full = len(self._line) >= self._limit + self._longest
            if not full:
                self._line.append(ticket)
        if full:
            if _nobody_looks():  # a preview: it is asked for again
                raise ValueError(BUSY)
            st.warning(BUSY)
            st.stop()

    def _put_back(self, worker: Worker | None) -> None:
        if worker is not None and worker.idle:
            self._idle.put(worker)
        elif worker is not None:  # left in the middle of something
            worker.close()

    def _leave(self, ticket: object) -> None:
        with self._changed:
            if ticket in self._line:
                self._line.remove(ticket)
                self._changed.notify_all()

    def _wait(self, ticket: object) -> None:
        def why() -> str:
            ahead = self.ahead(ticket)
            return _words(ahead) if ahead else ""

        wait_while(why, self._changed)


def wait_while(why: Callable[[], str], changed: threading.Condition) -> None:
    """Wait while there is a reason to, and show it to a visitor."""
    with changed:
        words = why()
    if not words:
        return
    place = None if _nobody_looks() else st.empty()
    while words:
        with changed:
            changed.wait(_LOOK)
            words = why()
        if words and place is not None:  # where a visitor has gone on meanwhile, this ends it
            place.info(words)
    if place is not None:
        place.empty()


# Computations about as short as a page have their own process; longer ones have lower priority.
SHORT = Turns(1, hire=partial(Worker, nicer=0), name="releases")
LONG = Turns(settings.heavy_jobs())
# Rows of the comparison come in tens: one process has all their tables, and stands back behind the
# pages as long computations do, whose process computes the slowest rows beside it while it is free.
ROWS = Turns(1, hire=partial(Worker, nicer=NICER - 1), name="comparisons")
LINES = SHORT, LONG, ROWS


def _nobody_looks() -> bool:
    """Return whether there is no page to write on."""
    return get_script_run_ctx(suppress_warning=True) is None


def _words(ahead: int) -> str:
    others = "one of another visitor comes" if ahead == 1 else f"{ahead} of other visitors come"
    return f"This computation waits for its turn: {others} first."
