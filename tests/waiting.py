"""Wait for what another thread does, without guessing how long it takes."""

import threading
import time
from collections.abc import Callable

PATIENCE = 60.0  # seconds; what is waited for takes milliseconds, but the machine may be busy


def until(holds: Callable[[], object]) -> None:
    """Return once it holds; fail where it does not come to hold."""
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.001)


def take(event: threading.Event) -> None:
    """Wait for an event; fail where it does not come."""
    assert event.wait(PATIENCE)
