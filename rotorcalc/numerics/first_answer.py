"""Results from the first value on at which a function gives any."""

from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

from rotorcalc.arrays import Array

T = TypeVar("T")
# So many values are asked together at least, where there are as many: a film may make a table for
# all of them, and another for a few.
_TOGETHER = 12
# How many values beyond the first that is answered alone are tried as the first of all.
_BESIDE = 8


def from_first_answer(ask: Callable[[Array], T], values: Array) -> T:
    """Return the results of a function from the first value on at which it gives any.

    A film refuses too heavy a load or too low a speed, at which the journal nears the wall: it is
    asked at rising σ or speeds.

    Parameters
    ----------
    ask : callable
        Returns the results at an array of values, or raises ValueError where it refuses one.
    values : array, (n,)
        Rising. From the first that is not refused on, none is.

    Returns
    -------
    object
        What `ask` returns at the values that it does not refuse.

    Raises
    ------
    ValueError
        As `ask` does where it refuses the last value too.
    """
    # All at once first: only where some are refused is the first found.
    with suppress(ValueError):
        return ask(values)
    refused, answered = 0, len(values) - 1
    while answered - refused > 1:
        middle = (refused + answered) // 2
        try:
            ask(values[middle :: max(1, (len(values) - middle) // _TOGETHER)])
            answered = middle
        except ValueError:
            refused = middle
    # A few values may be answered by another table than many, which ends some per cent elsewhere.
    for start in range(answered, min(answered + _BESIDE, len(values) - 1)):
        with suppress(ValueError):
            return ask(values[start:])
    return ask(values[min(answered + _BESIDE, len(values) - 1) :])
