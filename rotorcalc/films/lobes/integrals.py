"""Integrals of the film over part of a pad, in closed form, for arrays and for plain floats.

With c = cos ψ, s = sin ψ and q² = 1 − e²: h = q²/(1 + e c), sin θ = q s/(1 + e c), and

    ∫cosᵃθ sinᵇθ/h³ dθ = ∫(c+e)ᵃ sᵇ dψ qᵇ⁻⁵, a + b = 2;    /h⁴: qᵇ⁻⁷, a + b = 3.

Where the journal is farther than a clearance from the pad's centre, or nearly, and the pad is not
near it, the integrand is smooth and Gauss's quadrature takes over.
"""

import math

import numpy as np

from rotorcalc.arrays import Array

# Eccentricity from the pad's centre above which quadrature is used on pieces of the pad that stay
# this angle [rad] away from the closest approach: 1/q⁷ would cancel digits there.
_FAR, _AWAY = 0.99, 0.1
# The cubes over h⁴ cancel digits from here on already. Pieces that stay away by this share of their
# half width more have them by quadrature, which is exact there.
_FAR_FOR_CUBES, _SHARE = 0.8, 0.3
# Nearer to the pad than this the force is held: only trial steps of an integrator come there.
_NEAREST = 1e-9
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(32)
_POINTS = tuple(zip(_NODES.tolist(), _WEIGHTS.tolist(), strict=True))
# Where the film is thin at an end, and 1/h is singular not far beyond it, the pieces are divided,
# the closer the nearer to both ends; the thickness, in C, from which that is not needed.
_PARTS, _THICK = np.array([-1.0, -0.8, 0.0, 0.8, 1.0]), 0.25
_HALVES = 0.5 * np.diff(_PARTS)[:, None]
_DENSE_NODES = (0.5 * (_PARTS[1:] + _PARTS[:-1])[:, None] + _HALVES * _NODES).ravel()
_DENSE_WEIGHTS = (_HALVES * _WEIGHTS).ravel()
_DENSE_POINTS = tuple(zip(_DENSE_NODES.tolist(), _DENSE_WEIGHTS.tolist(), strict=True))


def squares(e: float, low: float, high: float) -> tuple[float, float, float]:
    """Return ∫cos²θ/h³, ∫sin θ cos θ/h³ and ∫sin²θ/h³ between two angles.

    Parameters
    ----------
    e : float
        Distance of the journal from the pad's centre of curvature, in C.
    low, high : float
        Angles from the place of closest approach [rad].

    Returns
    -------
    (float, float, float)
        The integrals.
    """
    if e > _FAR and _is_away(low, high):
        return _quadrature(e, low, high)
    e = min(e, 1.0 - _NEAREST)
    q2 = (1.0 - e) * (1.0 + e)
    q = math.sqrt(q2)
    b = e / (1.0 + q)
    p0, s0, c0 = _psi(b, e, q, low)
    p1, s1, c1 = _psi(b, e, q, high)
    width, sines, products = p1 - p0, s1 - s0, s1 * c1 - s0 * c0
    q3 = q2 * q
    cc = ((0.5 + e * e) * width + 2.0 * e * sines + 0.5 * products) / (q3 * q2)
    sc = (-0.5 * (c1 * c1 - c0 * c0) - e * (c1 - c0)) / (q2 * q2)
    return cc, sc, 0.5 * (width - products) / q3


def _psi(b: float, e: float, q: float, theta: float) -> tuple[float, float, float]:
    """Return ψ, sin ψ and cos ψ at θ."""
    s, c = math.sin(theta), math.cos(theta)
    h = 1.0 - e * c
    return theta + 2.0 * math.atan2(b * s, 1.0 - b * c), q * s / h, (c - e) / h


def _is_away(low: float, high: float) -> bool:
    turn = 2.0 * math.pi
    nearest = math.remainder(0.5 * (low + high), turn)
    return abs(nearest) - 0.5 * (high - low) > _AWAY


def _quadrature(e: float, low: float, high: float) -> tuple[float, float, float]:
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    cc = sc = ss = 0.0
    thinnest = 1.0 - e * max(math.cos(low), math.cos(high))
    for node, weight in _POINTS if thinnest > _THICK else _DENSE_POINTS:
        c, s = math.cos(middle + half * node), math.sin(middle + half * node)
        h = max(1.0 - e * c, _NEAREST)
        w = weight * half / (h * h * h)
        cc, sc, ss = cc + w * c * c, sc + w * s * c, ss + w * s * s
    return cc, sc, ss


def moments(e: Array, low: Array, high: Array) -> tuple[Array, Array, Array]:
    """Return integrals of 1/h, of the squares over h³ and of the cubes over h⁴, of many pads.

    Parameters
    ----------
    e, low, high : array, (n,)
        As of `squares`; nothing is integrated where `high` is not above `low`.

    Returns
    -------
    first : array, (n,)
        ∫dθ/h.
    second : array, (3, n)
        As `squares` gives them.
    third : array, (4, n)
        ∫cos³θ/h⁴, ∫cos²θ sin θ/h⁴, ∫cos θ sin²θ/h⁴ and ∫sin³θ/h⁴.
    """
    high = np.maximum(high, low)
    middle = np.mod(0.5 * (low + high) + np.pi, 2.0 * np.pi) - np.pi
    half = 0.5 * (high - low)
    room = _AWAY + np.where(e > _FAR, 0.0, _SHARE * half)
    far = (e > _FAR_FOR_CUBES) & (np.abs(middle) - half > room)
    found = _closed(np.where(far, 0.0, np.minimum(e, 1.0 - _NEAREST)), low, high)
    if far.any():
        found[:, far] = _by_quadrature(e[far], low[far], high[far])
    found[:, high <= low] = 0.0
    return found[0], found[1:4], found[4:]


def _closed(e: Array, low: Array, high: Array) -> Array:
    q2 = (1.0 - e) * (1.0 + e)
    q = np.sqrt(q2)
    b = e / (1.0 + q)
    ends: list[Array] = []
    for theta in (low, high):
        s, c = np.sin(theta), np.cos(theta)
        h = 1.0 - e * c
        psi = theta + 2.0 * np.arctan2(b * s, 1.0 - b * c)
        s, c = q * s / h, (c - e) / h
        ends.append(_antiderivatives(psi, s, c, e))
    powers = np.stack([q, q**5, q**4, q**3, q**7, q**6, q**5, q**4])
    return (ends[1] - ends[0]) / powers


def _antiderivatives(psi: Array, s: Array, c: Array, e: Array) -> Array:
    half, other, cube = 0.5 * (psi + s * c), 0.5 * (psi - s * c), s**3 / 3.0
    return np.stack([
        psi,
        half + 2.0 * e * s + e * e * psi,
        -0.5 * (c + e) ** 2,
        other,
        s - cube + 3.0 * e * half + 3.0 * e * e * s + e**3 * psi,
        -((c + e) ** 3) / 3.0,
        cube + e * other,
        c**3 / 3.0 - c,
    ])  # fmt: skip


def _by_quadrature(e: Array, low: Array, high: Array) -> Array:
    half = 0.5 * (high - low)
    theta = 0.5 * (low + high)[:, None] + half[:, None] * _DENSE_NODES
    c, s = np.cos(theta), np.sin(theta)
    h = np.maximum(1.0 - e[:, None] * c, _NEAREST)
    w = half[:, None] * _DENSE_WEIGHTS
    squares_, cubes = w / h**3, w / h**4
    return np.stack([
        (w / h).sum(-1), (squares_ * c * c).sum(-1), (squares_ * s * c).sum(-1),
        (squares_ * s * s).sum(-1), (cubes * c**3).sum(-1), (cubes * c * c * s).sum(-1),
        (cubes * c * s * s).sum(-1), (cubes * s**3).sum(-1),
    ])  # fmt: skip
