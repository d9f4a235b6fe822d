"""The speed of a floating ring: that at which its two films turn it with equal torques.

The journal drags the ring by the shear of the inner film, the bearing holds it by that of the outer
one; and in either film the pressure's flow, whose loss is half the load times the displacement
across it, resists too. With r = Ω_R/Ω, in μ_iΩR³L/C:

    (1 − r)·2π/s_i − ½y_i F = m r·2π/s_o + ½(C_o/C)y_o F,    F = (L/R)²/(4σ),  s² = 1 − x² − y²

with the place (x, y) of each film in its own clearance. Without load r = 1/(1 + m). What turns the
ring over what holds it falls with r, so there is one root at most: none where the load is so heavy
that the inner film would hold the ring rather than turn it.

Source: Shaw & Nussdorfer 1949, NACA Report 866, for r without load.
"""

import functools
import math

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from rotorcalc.arrays import Array
from rotorcalc.films.ring.pair import Pair
from rotorcalc.films.short.static import place_and_root

# A step of ln r below this is the last: the slope is known to seven digits, which leaves 1e-14.
_SETTLED, _BESIDE, _MOST_STEPS = 1e-7, 1e-7, 100
# r below which no film is left to hold a ring.
_LEAST = 1e-280
# Loads at which r of two tables is known for the search to begin, up to one so light that it counts
# as none: their ln σ lies from the heaviest on.
_KNOTS, _LIGHT = 193, 12.0
# As much above the least load number of a film is its heaviest load.
_INSIDE = 1.0 + 1e-9


def unloaded(pair: Pair) -> float:
    """Return r without load, 1/(1 + m)."""
    return 1.0 / (1.0 + pair.shear)


def speed_ratio(pair: Pair, sigma: Array) -> Array:
    """Return r = Ω_R/Ω at σ of the bearing.

    Parameters
    ----------
    pair : Pair
        The two films.
    sigma : array, (...)
        Modified Sommerfeld number of the bearing, σ [-]; infinite without load.

    Returns
    -------
    array, (...)
        To some 1e-14.

    Raises
    ------
    RuntimeError
        Where the search does not converge.

    Notes
    -----
    Newton's method for the logarithm of what turns the ring over what holds it, over ln r: nearly
    straight for r → 0, where r goes as a power of the load. A step out of the interval that is
    known to hold the root is replaced by its middle. Of one operating point on short films the
    search is in plain floats, a fifth of the time.
    """
    if pair.alike and sigma.size == 1 and np.isfinite(sigma).all():
        return np.full(sigma.shape, _of_one(pair, float(sigma.item())))
    if pair.alike:
        return _found(pair, sigma, np.full(sigma.shape, math.log(unloaded(pair))))
    path = _path(pair)
    return _found(pair, sigma, path(np.clip(np.log(sigma), path.x[0], path.x[-1])))


@functools.lru_cache(maxsize=64)
def _path(pair: Pair) -> CubicSpline:
    """Return ln r over ln σ, close enough to begin with."""
    ln_sigma = math.log(least_sommerfeld(pair)) + np.linspace(0.0, _LIGHT, _KNOTS)
    start = np.full_like(ln_sigma, math.log(unloaded(pair)))
    return CubicSpline(ln_sigma, np.log(_found(pair, np.exp(ln_sigma), start)))


def _found(pair: Pair, sigma: Array, start: Array) -> Array:
    """Return r at σ, from ln r near it."""
    slowest = pair.outside.least_sommerfeld * _INSIDE / (pair.force * sigma)
    low: Array = np.log(np.clip(slowest, _LEAST, 0.999))
    high = np.zeros_like(low)
    z = np.maximum(start, 0.5 * low)
    settled = np.zeros(np.shape(z), dtype=bool)
    # The same steps as in `_of_one`: a change of one is a change of both.
    for _ in range(_MOST_STEPS):
        value, beside = _excess(pair, sigma, np.stack([z, z + _BESIDE]))
        low, high = np.where(value > 0.0, z, low), np.where(value < 0.0, z, high)
        with np.errstate(divide="ignore", invalid="ignore"):  # flat where the ring nearly stalls
            after = z - _BESIDE * value / (beside - value)
        close = np.abs(after - z) <= _SETTLED
        after = np.where(close | ((after > low) & (after < high)), after, 0.5 * (low + high))
        # A point that has settled stays, so that its answer does not depend on its neighbours.
        z = np.where(settled, z, np.maximum(after, low))
        settled |= close
        if settled.all():
            return np.exp(z)
    raise RuntimeError(f"no speed of the ring found within {_MOST_STEPS} steps")


def _of_one(pair: Pair, sigma: float) -> float:
    """Return r at one σ of a bearing with short films, as `speed_ratio` does of many."""

    def excess(ln_ratio: float) -> float:
        """Return `_excess`."""
        turns, couples, holds = _torques_of_one(pair, sigma, math.exp(ln_ratio))
        # A ring at the journal's speed is not turned at all.
        return math.log(turns / (couples + holds)) if turns > 0.0 else -math.inf

    slowest = pair.outside.least_sommerfeld * _INSIDE / (pair.force * sigma)
    low, high = math.log(min(max(slowest, _LEAST), 0.999)), 0.0
    z = max(math.log(unloaded(pair)), 0.5 * low)
    # The same steps as in `speed_ratio`: a change of one is a change of both.
    for _ in range(_MOST_STEPS):
        value, beside = excess(z), excess(z + _BESIDE)
        low, high = (z if value > 0.0 else low), (z if value < 0.0 else high)
        rise = beside - value
        after = z - _BESIDE * value / rise if rise else math.inf
        if abs(after - z) <= _SETTLED:
            return math.exp(max(after, low))
        z = max(after if low < after < high else 0.5 * (low + high), low)
    raise RuntimeError(f"no speed of the ring found within {_MOST_STEPS} steps")


@functools.lru_cache(maxsize=64)
def least_sommerfeld(pair: Pair) -> float:
    """Return σ of the heaviest load under which both films carry and turn the ring.

    Either the load presses a surface closer than its film is computed, or the inner film no longer
    turns the ring.
    """
    outer = pair.outside.least_sommerfeld * _INSIDE

    def surplus(ln_sigma: float) -> float:
        """Return `_excess` at the slowest r, positive where the ring turns faster than that."""
        sigma = math.exp(ln_sigma)
        ratio = outer / (pair.force * sigma)
        if ratio >= 1.0:
            return -1.0
        turns, couples, holds = _torques_of_one(pair, sigma, ratio)
        return math.log(turns / (couples + holds))

    heavy = math.log(max(pair.inside.least_sommerfeld * _INSIDE, 1e-12))
    if surplus(heavy) > 0.0:
        return math.exp(heavy)
    light = max(heavy, 0.0)
    while surplus(light) <= 0.0:
        light += 2.0
    return math.exp(float(brentq(surplus, heavy, light, xtol=1e-13))) * _INSIDE


def torques(pair: Pair, sigma: Array, ratio: Array) -> tuple[Array, Array, Array]:
    """Return the terms of the balance: inner shear, both couples, outer shear.

    Parameters
    ----------
    pair : Pair
        The two films.
    sigma, ratio : array, (...)
        σ of the bearing, and r.

    Returns
    -------
    turns, couples, holds : array, (...)
        In μ_iΩR³L/C.
    """
    inner, outer, *_ = pair.places_and_flows(*pair.sommerfeld(sigma, ratio))
    load = pair.slenderness / (4.0 * sigma)
    couples = 0.5 * load * (inner[..., 1] + pair.wider * outer[..., 1])
    return (1.0 - ratio) * shear(inner), couples, pair.shear * ratio * shear(outer)


def _torques_of_one(pair: Pair, sigma: float, ratio: float) -> tuple[float, float, float]:
    """Return `torques` at one operating point; on short films in plain floats."""
    if not pair.alike:
        turns, couples, holds = torques(pair, np.array(sigma), np.array(ratio))
        return float(turns), float(couples), float(holds)
    (_, y, s), (_, y_o, s_o) = (place_and_root(one) for one in pair.sommerfeld(sigma, ratio))
    couples = 0.5 * pair.slenderness / (4.0 * sigma) * (y + pair.wider * y_o)
    return (1.0 - ratio) * math.tau / s, couples, pair.shear * ratio * math.tau / s_o


def shear(place: Array) -> Array:
    """Return the shear of a full circular film around a journal at a place, ∫dθ/H = 2π/s."""
    return 2.0 * np.pi / np.sqrt(1.0 - np.sum(place * place, axis=-1))


def _excess(pair: Pair, sigma: Array, ln_ratio: Array) -> Array:
    """Return ln of what turns the ring over what holds it."""
    turns, couples, holds = torques(pair, sigma, np.exp(ln_ratio))
    return np.log(turns / (couples + holds))
