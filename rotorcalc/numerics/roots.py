"""Roots of functions that cost little more at a dozen points than at one."""

from collections.abc import Callable

import numpy as np
from numpy.polynomial import chebyshev
from scipy.optimize import brentq

from rotorcalc.arrays import Array

# Chebyshev points: as many as a smooth function needs over an interval of a few per cent.
_POINTS = 18
_NODES = chebyshev.chebpts1(_POINTS)
_TO_COEFFICIENTS = np.linalg.inv(chebyshev.chebvander(_NODES, _POINTS - 1))
# Last coefficients over the largest, below which a series equals the function up to rounding.
_NOTHING = 1e-13
# Intervals at most in which a series is tried, each within the one before.
_NARROWER = 3


def narrow_root(
    values: Callable[[Array], Array], low: float, high: float, *, noise: float = _NOTHING
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

    Notes
    -----
    The root of the Chebyshev series through the function's values at 18 places; where its last
    coefficients exceed rounding errors, as beside a kink, of that between the two places where the
    sign changes, and after some of these Brent's method on the function itself.

    Examples
    --------
    >>> round(narrow_root(np.cos, 1.5, 1.6), 12)
    1.570796326795
    """
    for _ in range(_NARROWER):
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        places = middle + half * _NODES
        found = values(places)
        place = _root_of_series(found, noise)
        if place is not None:
            return float(middle + half * place)
        changes = np.flatnonzero((found[1:] > 0.0) != (found[:-1] > 0.0))
        if len(changes) != 1:
            break
        low, high = places[changes[0] : changes[0] + 2].tolist()
    # xtol only guards against zero: the root may be of any size, so rtol decides.
    return float(
        brentq(lambda x: float(values(np.array([x]))[0]), low, high, xtol=1e-300, rtol=1e-14)
    )


def _root_of_series(values: Array, noise: float) -> float | None:
    """Return the root of the series through values at the nodes, None where it is not theirs."""
    series = _TO_COEFFICIENTS @ values
    if np.any(np.abs(series[-2:]) > noise * np.abs(series).max()):
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
