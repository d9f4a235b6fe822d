"""Caches for costly functions, bounded in bytes."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from functools import partial
from typing import Generic, TypeVar, cast

import numpy as np

from ui.jobs.process import Progress
from ui.jobs.queue import LONG, Turns, wait_while
from ui.serving import one_at_a_time

T = TypeVar("T")

THE_SAME = "Another visitor has asked for the same computation: its result will stand here too."


class Cached(Generic[T]):
    """A costly function that is computed in a queue, its latest results cached up to a size."""

    def __init__(
        self, work: Callable[..., T], *, entries: int, megabytes: float, turns: Turns = LONG
    ) -> None:
        self._work, self._turns = work, turns
        self._entries, self._bytes = entries, megabytes * 1e6
        self._found: OrderedDict[object, tuple[T, int]] = OrderedDict()
        self._size = 0  # their sum: to go through all of them is to hash every machine anew
        self._under_way: set[object] = set()
        self._changed = threading.Condition()

    def __call__(self, *args: Hashable, tell: Progress | None = None) -> T:
        """Return a cached result, or compute it in its turn and report the progress.

        Who asks for what is under way already waits for it outside the line; if that computation
        fails or its visitor leaves, the next who waits takes it over.
        """
        while (found := self._look(args)) is None:
            if self._begin(args):
                return self._compute(args, tell)
            with one_at_a_time.PAGES.aside():
                wait_while(lambda: THE_SAME if args in self._under_way else "", self._changed)
        return found[0]

    def known(self, *args: Hashable) -> T | None:
        """Return a cached result, None where it would have to be computed."""
        found = self._look(args)
        return None if found is None else found[0]

    def several(
        self, asked: Iterable[tuple[Hashable, ...]], together: Callable[..., Sequence[T]],
        *more: Hashable, turns: Turns | None = None,
    ) -> int:  # fmt: skip
        """Compute what is neither known nor under way, as much as one order gives; return how much.

        `together` takes those requests and `more`, and returns results in their order, one at
        least. One by one each answer would wait for this process, which other pages keep busy.
        """
        begun = tuple(filter(self._begin, asked))
        if not begun:
            return 0
        try:
            with one_at_a_time.PAGES.aside():
                found = (turns or self._turns).run(together, (begun, *more), None)
            for key, result in zip(begun, found, strict=False):
                self._keep(key, result)
            return len(found)
        finally:
            self._end(*begun)

    def _begin(self, key: object) -> bool:
        """Start a computation, unless another has started or finished it meanwhile."""
        with self._changed:
            if key in self._under_way or key in self._found:
                return False
            self._under_way.add(key)
            return True

    def _compute(self, args: tuple[Hashable, ...], tell: Progress | None) -> T:
        try:
            with one_at_a_time.PAGES.aside():
                result = self._turns.run(self._work, args, tell)
            self._keep(args, result)
            return result
        finally:
            self._end(args)

    def _end(self, *keys: object) -> None:
        with self._changed:
            self._under_way.difference_update(keys)
            self._changed.notify_all()

    @property
    def size(self) -> int:
        """Bytes of the cached results."""
        return self._size

    def __len__(self) -> int:
        return len(self._found)

    def _look(self, key: object) -> tuple[T, int] | None:
        with self._changed:
            if key in self._found:
                self._found.move_to_end(key)
            return self._found.get(key)

    def _keep(self, key: object, result: T) -> None:
        size = size_of(result)
        with self._changed:
            self._found[key] = result, size
            self._size += size
            while len(self._found) > self._entries or (
                len(self._found) > 1 and self._size > self._bytes
            ):
                self._size -= self._found.popitem(last=False)[1][1]


def size_of(result: object) -> int:
    """Return roughly the bytes of a result: its arrays, and a little for each other part."""
    if isinstance(result, np.ndarray):
        return result.nbytes
    if is_dataclass(result):
        return sum(size_of(getattr(result, item.name)) for item in fields(result))
    if isinstance(result, Mapping):
        return sum(size_of(item) for item in cast("Mapping[object, object]", result).values())
    if isinstance(result, tuple | list | partial):
        held = result.args if isinstance(result, partial) else cast("list[object]", result)
        return sum(size_of(item) for item in held)
    return 64
