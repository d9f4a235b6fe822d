"""In which order tests are handed out to run side by side: what is long first, in equal shares."""

from collections.abc import Sequence
from itertools import accumulate, islice
from typing import TypeVar

T = TypeVar("T")

# Seconds of a test on average, by its folder, of folders with long ones. In this order those who
# share a server or a browser come together, and the servers' do not begin beside `make lint docs`.
LONG = {"app": 0.6, "deploy": 4.6, "browser": 8.6}


def shared_out(tests: Sequence[tuple[T, str]], workers: int) -> list[T]:
    """Return tests, each given with its folder, in the order in which workers get them.

    pytest-xdist cuts the order into parts of equal number. Each part begins with an equal share of
    what is long and ends with what is short: who is done early then takes over short ones, and
    nobody waits at the end for a long one that began late.
    """
    long = [(test, LONG[own]) for name in LONG for test, own in tests if own == name]
    short = iter([test for test, own in tests if own not in LONG])
    ends = list(accumulate(seconds for _, seconds in long))
    shares: list[list[T]] = [[] for _ in range(workers)]
    for (test, seconds), end in zip(long, ends, strict=True):
        # A test belongs to the share in which its middle lies.
        shares[int(workers * (end - 0.5 * seconds) / ends[-1])].append(test)
    order: list[T] = []
    for i, share in enumerate(shares):
        part = (len(tests) - len(order)) // (workers - i)
        order += share
        order += islice(short, max(0, part - len(share)))
    return order + list(short)
