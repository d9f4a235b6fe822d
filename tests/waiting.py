"""Wait for what another thread does, without guessing how long it takes."""

import asyncio
import threading
import time
from collections.abc import Callable, Coroutine
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

T = TypeVar("T")

PATIENCE = 60.0  # seconds; what is waited for takes milliseconds, but the machine may be busy


def until(holds: Callable[[], object]) -> None:
    """Return once it holds; fail where it does not come to hold.

    Looks are first a millisecond apart, then ever longer: each may ask a server.
    """
    end = time.monotonic() + PATIENCE
    pause = 0.001
    while not holds():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(pause)
        pause = min(1.5 * pause, 0.1)


def take(event: threading.Event) -> None:
    """Wait for an event; fail where it does not come."""
    assert event.wait(PATIENCE)


def finished(work: Coroutine[Any, Any, T]) -> T:
    """Run a coroutine to its end, in a thread: a browser's test leaves a loop in this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, work).result()
