"""Work in parts: one function of each part, here or on any executor, with its progress."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")


def in_parts(
    function: Callable[[T], R],
    parts: Sequence[T],
    *,
    executor: Executor | None = None,
    progress: Callable[[float], object] | None = None,
) -> Iterator[R]:
    """Yield a function's value for each part, in the order of the parts.

    Parameters
    ----------
    function : callable
        Of one part. For processes and other machines it stands in a module, as they import it.
    parts : sequence
        The parts; they do not depend on the executor, so neither does an answer.
    executor : concurrent.futures.Executor, optional
        Computes parts at the same time; by default one after the other.
    progress : callable, optional
        Called with the share that is done, from above 0 to 1.

    Yields
    ------
    object
        Values. Where the caller stops early, an executor drops what it has not begun.
    """
    each = (executor.map if executor else map)(function, parts)
    for done, one in enumerate(each, start=1):
        yield one
        if progress is not None:
            progress(done / len(parts))
