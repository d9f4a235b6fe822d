"""Memory for large arrays that come and go."""

import functools

import numpy as np

# Just below the largest block, 32 MiB, from which the GNU C library still draws a conclusion.
_BLOCK = 32_000_000


@functools.cache
def keep_freed_memory() -> None:
    """Have freed arrays' memory kept for the next ones; called by whatever makes many.

    The GNU C library gives large blocks back to the system as soon as they are freed, and the pages
    of the next array come new and cleared: a quarter of the time of a table of films. Once a block
    is freed it keeps all that are smaller, up to twice its size together. This one is never
    touched, so it takes no memory itself. Other C libraries take no notice of it.
    """
    np.empty(_BLOCK, dtype=np.uint8)
