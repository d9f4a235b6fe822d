"""The short bearing in static equilibrium: σ, ε, attitude angle and force (Eqs. 5.5 to 5.8)."""

import functools
import math

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, real_array
from rotorcalc.frames import vector

# Table of ln(ε/s) from which the search for ε starts, by linear interpolation. Beyond ±12 the curve
# is straight, so one point at either end, past the smallest and the largest double, is enough.
_LN_W = np.concatenate([[-800.0], np.linspace(-12.0, 12.0, 2401), [200.0]])

# A step of ln(ε/s) no longer than this is the last. The error that Newton's step leaves is below 12
# times its square, the one that Halley's leaves below a fifth of its cube.
_NEWTON, _HALLEY = 1e-8, 1e-5

# One of Halley's steps suffices; this many mean that something is wrong.
_MOST_ITERATIONS = 50


def modified_sommerfeld(eps: ArrayLike) -> Array:
    """Return the modified Sommerfeld number at which the journal sits at ε (Eq. 5.8).

    σ = μΩLR/(4F_o)·(L/C)² = (1−ε²)²/(ε√(16ε² + π²(1−ε²)))

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε ≤ 1.

    Returns
    -------
    array, (...)
        Modified Sommerfeld number, σ [-]; infinite at ε = 0, zero at ε = 1.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1].

    Examples
    --------
    >>> round(float(modified_sommerfeld(0.5)), 6)
    0.333164
    """
    eps = checked_eccentricity(eps)
    s2 = s_squared(eps)
    with np.errstate(divide="ignore"):  # σ = ∞ in the centre
        return s2**2 / (eps * np.sqrt(load_square(eps, s2)))


def eccentricity_ratio(sigma: ArrayLike) -> Array:
    """Return the eccentricity ratio at a modified Sommerfeld number: Eq. 5.8 solved for ε.

    Parameters
    ----------
    sigma : array_like, (...)
        Modified Sommerfeld number, σ [-], zero or more; infinite without load.

    Returns
    -------
    array, (...)
        Eccentricity ratio, ε [-]. σ(ε) returns σ to 1e-12 relative over σ = 1e-6 … 1e6.

    Raises
    ------
    ValueError
        Where σ is negative or NaN.
    RuntimeError
        Where the search does not converge.

    Notes
    -----
    With w = ε/s, s² = 1 − ε², Eq. 5.8 reads g(ln w) = 0,

        g = ln w + ln((1+w²)√(π²+16w²)) + ln σ.

    g is convex and increases with a slope between 1 and 4. So from any start Newton's first step
    lands to the right of the root and all later ones descend to it, and the residual g brackets the
    root: it lies between ln w and ln w − g. The start is interpolated in a table, to 9e-6; there
    Halley's step, Newton's with the curve's bend, is the only one.

    Examples
    --------
    >>> round(float(eccentricity_ratio(0.333164)), 6)
    0.5
    """
    sigma = real_array("sigma", sigma)
    if sigma.size and not sigma.min() >= 0.0:
        worst = sigma[~(sigma >= 0.0)].flat[0]
        raise ValueError(f"sigma = {worst}: must be zero or positive")
    curve = _curve()
    with np.errstate(divide="ignore"):  # at the curve's ends ε rounds to 0 and 1
        ln_load = np.minimum(np.maximum(-np.log(sigma), curve[0]), curve[-1])
    ln_w = np.interp(ln_load, curve, _LN_W)
    for _ in range(_MOST_ITERATIONS):
        value, slope, bend = _ln_load(ln_w)
        step = (value - ln_load) / slope
        ln_w = ln_w - step * (1.0 + 0.5 * step * bend / slope)
        if (np.abs(step) <= _HALLEY).all():
            w = np.exp(ln_w)
            return w / np.sqrt(1.0 + w * w)
    raise RuntimeError(f"no eccentricity ratio found within {_MOST_ITERATIONS} iterations")


def place_and_root(sigma: float) -> tuple[float, float, float]:
    """Return x, y [C] and s = √(1 − ε²) at one σ, positive and finite, in plain floats.

    As `eccentricity_ratio`, from a start that needs no table: g of its notes lies above both of its
    straight ends, so from where the nearer of them is zero Newton's steps descend to the root.
    """
    ln_load = -math.log(sigma)
    ln_w = min(ln_load - math.log(math.pi), 0.25 * (ln_load - math.log(4.0)))
    for _ in range(_MOST_ITERATIONS):
        w2 = math.exp(2.0 * ln_w)
        a, b = 1.0 + w2, math.pi**2 + 16.0 * w2
        value = ln_w + math.log(a * math.sqrt(b)) - ln_load
        step = value / (4.0 - 2.0 / a - math.pi**2 / b)
        ln_w -= step
        if abs(step) <= _NEWTON:
            w = math.exp(ln_w)
            s = 1.0 / math.sqrt(1.0 + w * w)
            # cos φ = 4w/√(16w² + π²) and sin φ = π/√(…), Eq. 5.7 with w = ε/s.
            share = w * s / math.hypot(4.0 * w, math.pi)
            return 4.0 * w * share, math.pi * share, s
    raise RuntimeError(f"no eccentricity ratio found within {_MOST_ITERATIONS} iterations")


def attitude_angle(eps: ArrayLike) -> Array:
    """Return the attitude angle, tan φ = π√(1−ε²)/(4ε) (Eq. 5.7, its sign corrected).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε ≤ 1.

    Returns
    -------
    array, (...)
        Attitude angle, φ [rad], from the load line to the line of centres in the sense of rotation.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1].
    """
    eps = checked_eccentricity(eps)
    # arctan2: 90° in the centre, where tan φ is infinite. f_r < 0 < f_t, hence the sign.
    return np.arctan2(np.pi * np.sqrt(s_squared(eps)), 4.0 * eps)


def static_force(eps: ArrayLike) -> Array:
    """Return the static force of the film on the journal in (r, t) (Eq. 5.5).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2)
        (f_r, f_t) in μΩRL³/C²; f_r < 0 pushes the journal back to the centre, f_t > 0 forward.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = below_one(eps)
    return vector(-(eps**2) / s2**2, np.pi * eps / (4.0 * s2**1.5))


@functools.cache
def _curve() -> Array:
    return _ln_load(_LN_W)[0]


def _ln_load(ln_w: Array) -> tuple[Array, Array, Array]:
    """Return ln(1/σ) of Eq. 5.8, its slope over ln w and that one's slope, w = ε/s."""
    # 1/σ = w(1+w²)√(π²+16w²): Eq. 5.8 with ε = w/√(1+w²). Its slope is 1 + 2w²/a + 16w²/b.
    w2 = np.exp(2.0 * ln_w)
    a, b = 1.0 + w2, np.pi**2 + 16.0 * w2
    p, q = 2.0 / a, np.pi**2 / b
    bend = p * (2.0 - p) + 2.0 * q * (1.0 - q)
    return ln_w + np.log(a * np.sqrt(b)), 4.0 - p - q, bend


def checked_eccentricity(eps: ArrayLike) -> Array:
    """Return ε as an array, or raise ValueError where it lies outside [0, 1]."""
    eps = real_array("eps", eps)
    if eps.size and not (eps.min() >= 0.0 and eps.max() <= 1.0):
        worst = eps[~((eps >= 0.0) & (eps <= 1.0))].flat[0]
        raise ValueError(f"eps = {worst}: the eccentricity ratio must lie between 0 and 1")
    return eps


def below_one(eps: ArrayLike) -> tuple[Array, Array]:
    """Return ε and s² = 1 − ε², or raise ValueError where ε reaches 1 and forces are infinite."""
    eps = checked_eccentricity(eps)
    if eps.size and eps.max() == 1.0:
        raise ValueError("eps = 1: the journal touches the wall, the film's force is infinite")
    return eps, s_squared(eps)


def s_squared(eps: Array) -> Array:
    """Return s² = 1 − ε², without cancellation as ε tends to 1."""
    # 1 − ε is exact near ε = 1, the square of ε would be rounded.
    return (1.0 - eps) * (1.0 + eps)


def load_square(eps: Array, s2: Array) -> Array:
    """Return 16ε² + π²(1−ε²), whose root Eqs. 5.6 to 5.8 share."""
    return 16.0 * eps**2 + np.pi**2 * s2
