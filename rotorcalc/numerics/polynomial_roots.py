"""Roots of real polynomials: bounds of their errors, refinement in floats and in many digits.

Polynomials are arrays (..., n+1) of the coefficients from the constant to that of λⁿ. Evaluated by
Horner's scheme they have the rounding error of their terms, however unequal the roots are; the
eigenvalues of a matrix have that of the largest.
"""

import cmath
import math
from decimal import Decimal, getcontext
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.numerics.routh import ROUNDING

# Simultaneous steps in floats at most, and the rounding of Horner's scheme over that of one term.
_STEPS, _AT_ROUNDING = 60, 4 * float(np.finfo(float).eps)
# Angle by which starting values are turned: real ones can then leave the axis as a pair.
_TURN = 0.01
# Newton's steps in many digits at most, and the digits that rounding errors may take.
_EXACT_STEPS, _GUARD = 100, 20
# Steps after which a root may be one of a pair so close that its place is lost in rounding.
_PATIENCE = 20
# Angle by which starting values on a circle are turned, so that no two circles' are in line.
_ASKEW = 0.7
# Real and imaginary part in many digits.
_Complex: TypeAlias = tuple[Decimal, Decimal]
# Angle from the real axis within which an approximate root may be real.
_BESIDE = 1e-3


def error_bounds(polynomial: Array, roots: ComplexArray) -> Array:
    """Return radii of circles around approximate roots that together hold all roots, (..., n).

    The coefficients' own rounding errors are included. A circle apart from all others holds one
    root, a group of k that overlap holds k.

    Notes
    -----
    Source: B. T. Smith, Error bounds for zeros of a polynomial based upon Gerschgorin's theorems,
    J. ACM 17 (1970): n |p(λ_i)/(a_n Π (λ_i − λ_j))|.
    """
    n = roots.shape[-1]
    value, _, size = _horner(polynomial, roots)
    # The diagonal, 0, becomes 1 and drops out of the product.
    others: ComplexArray = roots[..., :, None] - roots[..., None, :] + np.eye(n)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        product: Array = np.prod(np.abs(others), axis=-1)
        return n * (np.abs(value) + ROUNDING * size) / (np.abs(polynomial[..., -1:]) * product)


def simultaneous_roots(polynomial: Array, start: ComplexArray) -> ComplexArray:
    """Return all roots of polynomials (m, n+1), each to rounding of its own terms, (m, n).

    Newton's method for all roots at once, each repelled by the others, from starting values (m, n)
    of any quality. A root that rounding hides is somewhere in its uncertainty.

    Notes
    -----
    Source: O. Aberth, Iteration methods for finding all zeros of a polynomial simultaneously, Math.
    Comp. 27 (1973).
    """
    n = start.shape[-1]
    # Real polynomials keep real iterates real, and conjugates conjugate: none begins as either.
    roots = start * np.array([cmath.exp(1j * _TURN * i) for i in range(1, n + 1)])
    itself = np.eye(n, dtype=bool)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for _ in range(_STEPS):
            value, slope, size = _horner(polynomial, roots)
            others = np.where(itself, np.inf, roots[..., :, None] - roots[..., None, :])
            newton = value / slope
            step = newton / (1.0 - newton * np.sum(1.0 / others, axis=-1))
            moves = np.isfinite(step) & (np.abs(value) > _AT_ROUNDING * size)
            if not np.any(moves):
                break
            roots = roots - np.where(moves, step, 0.0)
    return roots


def _horner(polynomial: Array, at: ComplexArray) -> tuple[ComplexArray, ComplexArray, Array]:
    """Return value and slope of polynomials, and the sum of their terms' sizes, (..., n)."""
    modulus = np.abs(at)
    value, slope, size = np.zeros_like(at), np.zeros_like(at), np.zeros_like(modulus)
    with np.errstate(invalid="ignore", over="ignore"):
        for a in np.moveaxis(polynomial, -1, 0)[::-1, ..., None]:
            slope = slope * at + value
            value = value * at + a
            size = size * modulus + np.abs(a)
    return value, slope, size


def exact_roots(polynomial: NDArray[np.object_], start: ComplexArray) -> ComplexArray:
    """Return the roots of a polynomial of decimals (n+1,) from values near them, rounded, (n,).

    Computed in the precision of the current context, so that real and imaginary part are each right
    to a float's digits. A real root is exactly real, and pairs are exactly conjugate.

    Raises
    ------
    RuntimeError
        Where Newton's method does not converge, or finds a root twice.
    """
    if polynomial[0] != 0 and (len(np.unique(start)) < len(start) or not np.all(start)):
        # What is zero, or the same twice, has been lost beside roots many orders larger.
        upper, beside = start[:0], _newton_polygon(polynomial)
    else:
        upper = start[start.imag > _BESIDE * np.abs(start)]
        # Whether a root beside the real axis is real, and on which side it is, is yet to be seen.
        beside = start[np.abs(start.imag) <= _BESIDE * np.abs(start)]
    near = [(Decimal(z.real), Decimal(z.imag)) for z in [*upper.tolist(), *beside.tolist()]]
    falling: list[Decimal] = polynomial[::-1].tolist()
    moving = set(range(len(near)))
    for count in range(_EXACT_STEPS):
        for i in tuple(moving):
            images = [(x, -y) for x, y in near[: len(upper)]]
            near[i], settled = _step(falling, near[i], near[:i] + near[i + 1 :] + images)
            if not settled and count >= _PATIENCE:
                near[i], settled = _hidden(falling, near[i])
            if settled:
                moving.remove(i)
        if not moving:
            return _rounded(near, len(start))
    raise RuntimeError(f"roots of a polynomial not found within {_EXACT_STEPS} steps")


def _newton_polygon(polynomial: NDArray[np.object_]) -> ComplexArray:
    """Return starting values of the right sizes for the roots of a polynomial, however unequal.

    Notes
    -----
    Source: D. A. Bini, Numerical computation of polynomial zeros by means of Aberth's method,
    Numer. Algorithms 13 (1996): the radii are the slopes of the convex hull of log |a_k| over k.
    """
    points = [(k, float(abs(a).ln())) for k, a in enumerate(polynomial) if a != 0]
    found: list[complex] = []
    k, here = points[0]
    while k < points[-1][0]:
        slope, last = max(((there - here) / (j - k), j) for j, there in points if j > k)
        count = last - k
        angles = (2 * math.pi * i / count + _ASKEW * (k + 1) for i in range(count))
        found += [cmath.rect(math.exp(-slope), angle) for angle in angles]
        k, here = next(point for point in points if point[0] == last)
    return np.array(found)


def _step(polynomial: list[Decimal], z: _Complex, others: list[_Complex]) -> tuple[_Complex, bool]:
    """Return Aberth's next approximation of a root, and whether it differs by rounding only."""
    x, y = z
    # Value u + jv and slope a + jb, written out: a class of complex numbers takes twice the time.
    u = v = a = b = Decimal(0)
    for coefficient in polynomial:
        a, b = a * x - b * y + u, a * y + b * x + v
        u, v = u * x - v * y + coefficient, u * y + v * x
    for other_x, other_y in others:
        p, q = x - other_x, y - other_y
        square = p * p + q * q
        # The slope of the polynomial over λ − λ_other: p' − p/(λ − λ_other).
        a, b = a - (u * p + v * q) / square, b - (v * p - u * q) / square
    square = a * a + b * b
    p, q = (u * a + v * b) / square, (v * a - u * b) / square
    x, y = x - p, y - q
    small = Decimal(10) ** (_GUARD - getcontext().prec) * max(abs(x), abs(y))
    return (x, y if abs(y) > small else Decimal(0)), max(abs(p), abs(q)) <= small


def _hidden(polynomial: list[Decimal], z: _Complex) -> tuple[_Complex, bool]:
    """Return an approximate root, and whether its real part is known though its place is not.

    Where the value is lost in the rounding of its terms, as about a double root, a step's rounding
    error is the square root of theirs. Within that of the real axis a root is real; within that of
    the imaginary axis nothing is known.
    """
    x, y = z
    modulus = (x * x + y * y).sqrt()
    u = v = size = Decimal(0)
    for coefficient in polynomial:
        u, v = u * x - v * y + coefficient, u * y + v * x
        size = size * modulus + abs(coefficient)
    digits = getcontext().prec
    error = Decimal(10) ** (1 - digits // 2) * modulus
    lost = max(abs(u), abs(v)) <= Decimal(10) ** (3 - digits) * size
    return (x, y if abs(y) > error else Decimal(0)), lost and abs(x) > error


def _rounded(roots: list[_Complex], n: int) -> ComplexArray:
    """Return real roots and those of the upper half with their conjugates, n in all."""
    found = [complex(float(x), float(y)) for x, y in roots if y >= 0]
    found += [z.conjugate() for z in found if z.imag > 0.0]
    if len(found) != n:
        raise RuntimeError(f"found {len(found)} of a polynomial's {n} roots")
    return np.array(found)
