"""The keyphasor: one pulse a revolution, and from it the angle of rotation and the speed."""

import math

import numpy as np
from scipy.interpolate import CubicSpline

from rotorcalc.arrays import Array, IntArray

# The signal must fall this share of its span below the threshold before it can rise through it
# again: noise on a slow edge is no second pulse.
_HYSTERESIS = 0.1
# Of neighbouring revolutions; a missed pulse doubles one, an extra one halves it.
_MOST_CHANGE = 1.4
FEWEST_PULSES = 3


def pulses(time: Array, signal: Array, threshold: float | None, *, falling: bool) -> Array:
    """Return the times at which a signal passes its threshold, (k,) [s].

    Parameters
    ----------
    time, signal : array, (n,)
        The keyphasor's signal over time [s], in any unit.
    threshold : float or None
        In the signal's unit; None for the middle between its least and its largest value.
    falling : bool
        Whether the passage down through the threshold counts, of a notch, not that up.

    Returns
    -------
    array, (k,)
        Between two samples in proportion.

    Raises
    ------
    ValueError
        Where there are fewer than three, or one is missing or too many.
    """
    low, high = float(signal.min()), float(signal.max())
    level = 0.5 * (low + high) if threshold is None else threshold
    if not low < level < high:
        raise ValueError(
            f"keyphasor: no pulse passes the threshold {level:g}; its signal lies between {low:g} "
            f"and {high:g}"
        )
    above = signal - level if not falling else level - signal
    rising = _passages(above, _HYSTERESIS * min(high - level, level - low))
    share = -above[rising] / (above[rising + 1] - above[rising])
    times = time[rising] + share * (time[rising + 1] - time[rising])
    _check(times)
    return times


def turned(time: Array, pulses: Array) -> tuple[Array, Array]:
    """Return angle [rad], zero at the first pulse, and speed [rad/s] at times between pulses."""
    turns = 2.0 * math.pi * np.arange(len(pulses))
    angle = CubicSpline(pulses, turns)
    return angle(time), angle(time, 1)


def _passages(above: Array, room: float) -> IntArray:
    """Return the samples before which a signal was below −room and after which it passes zero."""
    armed, found = False, list[int]()
    below = above < -room
    crossing = (above[:-1] < 0.0) & (above[1:] >= 0.0)
    events = np.flatnonzero(crossing | below[:-1])
    for i in events:
        armed = armed or bool(below[i])
        if armed and crossing[i]:
            found.append(int(i))
            armed = False
    return np.array(found, dtype=np.intp)


def _check(times: Array) -> None:
    if len(times) < FEWEST_PULSES:
        raise ValueError(
            f"keyphasor: {len(times)} pulses, must be {FEWEST_PULSES} or more; look at its "
            "threshold"
        )
    turns = np.diff(times)
    change = turns[1:] / turns[:-1]
    odd = (change > _MOST_CHANGE) | (change < 1.0 / _MOST_CHANGE)
    if odd.any():
        at = times[1 + int(np.argmax(odd))]
        raise ValueError(
            f"keyphasor: from one revolution to the next the time of a turn changes by more than "
            f"{100 * (_MOST_CHANGE - 1):.0f} %, at {at:.6g} s: a pulse is missing or one too many; "
            "look at its threshold"
        )
