"""Roots of functions that cost little more at a dozen points than at one."""

from collections.abc import Callable
from typing import cast

import numpy as np
from numpy.polynomial import chebyshev
from scipy.optimize import brentq

from rotorcalc.arrays import Array, ComplexArray, IntArray

# Chebyshev points: as many as a smooth function needs over an interval of a few per cent.
_POINTS = 18
_NODES = chebyshev.chebpts1(_POINTS)
_TO_COEFFICIENTS = np.linalg.inv(chebyshev.chebvander(_NODES, _POINTS - 1))
# Both ends and the nodes; series and their slopes there.
_PLACES = np.array([-1.0, *_NODES, 1.0])
_AT_PLACES = cast("Array", chebyshev.chebvander(_PLACES, _POINTS - 1))
_SLOPES = cast("Array", chebyshev.chebder(np.eye(_POINTS)).T)
# Newton's steps at most to the roots of many series, and the length of the last.
_STEPS, _LAST = 8, 1e-15
# Parts of an interval at most in which a series is tried for all zeros of a function, and how far
# off the real interval a zero of a series may be by rounding.
_PARTS, _REAL = 24, 1e-7
# Last coefficients over the largest, below which a series equals the function up to rounding.
NOTHING = 1e-13
# Intervals at most in which a series is tried, each within the one before.
_NARROWER = 3
# Share of the function's whole change that a step beside its root takes at a jump alone, and the
# width at which the places beside a jump are one.
_JUMP, _ONE_PLACE = 0.5, 1e-14


class HiddenRootError(ValueError):
    """A function's rounding errors are as large as its change beside its root."""


def narrow_root(
    values: Callable[[Array], Array], low: float, high: float, *, noise: float = NOTHING
) -> float:
    """Return the point of a narrow interval at which a function changes sign.

    Parameters
    ----------
    values : callable
        The function: values (n,) at points (n,).
    low, high : float
        Points at which its values differ in sign, or one of them is zero.
    noise : float
        Rounding errors of the function over its largest value between the two.

    Returns
    -------
    float
        The root, to about 1e-14 of itself, or to the noise times the interval.

    Raises
    ------
    HiddenRootError
        Where the function, computed anew, has the same sign on both sides of the root.

    Notes
    -----
    The root of the Chebyshev series through the function's values at 18 places; where its last
    coefficients exceed rounding errors, as beside a kink, of that between the two places where the
    sign changes, and after some of these Brent's method on the function itself. A jump has no
    slope that would lead Brent's method to it; it is closed in by 18 places at a time.

    Examples
    --------
    >>> round(narrow_root(np.cos, 1.5, 1.6), 12)
    1.570796326795
    """
    is_jump, beside, rounding = False, np.empty((2, 2)), 0.0
    for _ in range(_NARROWER):
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        places = middle + half * _NODES
        found = values(places)
        series = _TO_COEFFICIENTS @ found
        # Errors do not shrink with the interval, as the function does towards its root.
        rounding = rounding or noise * float(np.abs(series).max())
        place = _root_of_series(series, rounding)
        if place is not None:
            return float(middle + half * place)
        changes = np.flatnonzero((found[1:] > 0.0) != (found[:-1] > 0.0))
        if len(changes) != 1:
            break
        beside = np.stack([places, found])[:, changes[0] : changes[0] + 2]
        low, high = beside[0].tolist()
        is_jump = bool(np.ptp(beside[1]) > _JUMP * np.ptp(found))
    if is_jump:
        return _at_a_jump(values, beside)

    def value(x: float) -> float:
        return float(values(np.array([x]))[0])

    try:
        # xtol only guards against zero: the root may be of any size, so rtol decides.
        return float(brentq(value, low, high, xtol=1e-300, rtol=1e-14))
    except ValueError as error:
        if value(low) * value(high) <= 0.0:
            raise
        hidden = "rounding errors hide where its sign changes"
        raise HiddenRootError(f"between {low:g} and {high:g}: {hidden}") from error


def narrow_roots(
    values: Callable[[Array], Array], low: Array, high: Array, *, noise: float = NOTHING
) -> Array:
    """Return the points of narrow intervals at which functions change sign.

    Parameters
    ----------
    values : callable
        The functions: values (m, n) of all at points (m, n).
    low, high : array, (m,)
        The intervals' ends.
    noise : float
        As in `narrow_root`.

    Returns
    -------
    array, (m,)
        The roots, as `narrow_root` gives them; NaN where a function is not equal to its series, or
        its sign does not change once.
    """
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    series = values(middle[:, None] + half[:, None] * _NODES) @ _TO_COEFFICIENTS.T
    is_equal = np.all(
        np.abs(series[:, -2:]) <= noise * np.abs(series).max(axis=1, keepdims=True), axis=1
    )
    is_above = series @ _AT_PLACES.T > 0.0
    changes = is_above[:, 1:] != is_above[:, :-1]
    known = is_equal & (np.count_nonzero(changes, axis=1) == 1)
    places = np.full(len(series), np.nan)
    places[known] = _roots_of_series(series[known], changes[known].argmax(axis=1))
    return middle + half * places


def zeros(
    values: Callable[[Array], Array], low: float, high: float, *, noise: float = NOTHING
) -> Array:
    """Return all points of an interval at which a smooth function vanishes.

    Parameters
    ----------
    values : callable
        The function: values (n,) at points (n,).
    low, high : float
        The interval's ends.
    noise : float
        As in `narrow_root`.

    Returns
    -------
    array, (k,)
        The zeros, rising, to about the noise times the interval.

    Raises
    ------
    ValueError
        Where no series equals the function, not even over small parts of the interval.
    """
    found, left = [np.empty(0)], [(low, high)]
    for _ in range(_PARTS):
        begin, end = left.pop()
        middle, half = 0.5 * (begin + end), 0.5 * (end - begin)
        series = _TO_COEFFICIENTS @ values(middle + half * _NODES)
        if np.all(np.abs(series[-2:]) <= noise * np.abs(series).max()):
            found.append(middle + half * _all_roots(series))
        else:
            left += [(middle, end), (begin, middle)]
        if not left:
            return np.unique(np.concatenate(found))
    raise ValueError(f"between {low:g} and {high:g}: no series equals the function")


def _all_roots(series: Array) -> Array:
    """Return the real roots of a series between its ends."""
    roots = cast("ComplexArray", chebyshev.chebroots(series))
    is_real = (np.abs(roots.imag) <= _REAL) & (np.abs(roots.real) <= 1.0 + _REAL)
    return np.clip(roots.real[is_real], -1.0, 1.0)


def _roots_of_series(series: Array, place: IntArray) -> Array:
    """Return the roots of series between one of `_PLACES` and the next; NaN without one."""
    slopes = series @ _SLOPES
    low, high = _PLACES[place], _PLACES[place + 1]
    below, above = (np.sum(series * _AT_PLACES[place + j], axis=1) for j in (0, 1))
    x = low - below * (high - low) / (above - below)
    step = np.full(len(x), np.inf)
    for _ in range(_STEPS):
        terms = cast("Array", chebyshev.chebvander(x, _POINTS - 1))
        step = np.sum(series * terms, axis=1) / np.sum(slopes * terms[:, :-1], axis=1)
        x = np.clip(x - step, low, high)
        if np.all(np.abs(step) <= _LAST):
            break
    return np.where(np.abs(step) <= 1e3 * _LAST, x, np.nan)


def _at_a_jump(values: Callable[[Array], Array], beside: Array) -> float:
    """Return the place of a jump past zero between two places and their values, (2, 2)."""
    while np.ptp(beside[0]) > _ONE_PLACE * np.abs(beside[0]).max():
        beside = _closer(values, beside)
    return float(beside[0, np.argmin(np.abs(beside[1]))])


def _closer(values: Callable[[Array], Array], beside: Array) -> Array:
    """Return two closer places with a change of sign between them, and the values there."""
    low, high = float(beside[0, 0]), float(beside[0, 1])
    places = np.linspace(low, high, _POINTS + 2)
    # The ends keep the signs that they had: there rounding may give them others now.
    found = np.concatenate([beside[1, :1], values(places[1:-1]), beside[1, 1:]])
    first = int(np.argmax((found[1:] > 0.0) != (found[:-1] > 0.0)))
    return np.stack([places, found])[:, first : first + 2]


def _root_of_series(series: Array, rounding: float) -> float | None:
    """Return the root of a series through values at the nodes, None where it is not theirs."""
    if np.any(np.abs(series[-2:]) > rounding):
        return None
    of_series = (series.tolist(),)
    ends = clenshaw(-1.0, *of_series), clenshaw(1.0, *of_series)
    # A root within rounding of an end may lie outside the series' own signs.
    if not min(ends) < 0.0 < max(ends):
        return None
    return float(brentq(clenshaw, -1.0, 1.0, args=of_series, xtol=1e-15))


def clenshaw(x: float, series: list[float]) -> float:
    """Return a Chebyshev series at one point by Clenshaw's rule, ten times as fast as NumPy."""
    last = before = 0.0
    for coefficient in series[:0:-1]:
        last, before = coefficient + 2.0 * x * last - before, last
    return series[0] + x * last - before
