"""Whether all roots of a polynomial lie in Re λ < 0, without its roots: Routh, Hurwitz, Kharitonov.

Polynomials are arrays (..., n+1) of the coefficients from the constant to that of λⁿ, n even; of
floats, or of `decimal.Decimal` where double precision does not suffice.

The Hurwitz matrix of a stable polynomial is totally nonnegative, so elimination in it, which is
Routh's scheme, has a relative error no larger than that of the coefficients, each by itself.
Kharitonov: all polynomials with coefficients within given bounds are stable if four of them are.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotorcalc.arrays import Array, BoolArray

# Relative error of float coefficients and of Routh's scheme together, generously: 3e-14.
ROUNDING = 128 * float(np.finfo(float).eps)
# Signs of the deviations in Kharitonov's four polynomials, from the constant term on.
_KHARITONOV = np.tile([[-1, -1, 1, 1], [1, 1, -1, -1], [1, -1, -1, 1], [-1, 1, 1, -1]], 3)


def determinant(polynomial: NDArray[Any]) -> Array:
    """Return Hurwitz's last determinant over the product of the coefficients in Routh's scheme.

    At most 1; it vanishes where a pair of roots lies on the imaginary axis, and is smooth in the
    coefficients.
    """
    with np.errstate(invalid="ignore", over="ignore"):  # a row that begins with zero gives NaN
        return np.prod(_left(polynomial), axis=0)


def margin(polynomial: NDArray[Any]) -> Array:
    """Return a number that is negative where all roots lie in Re λ < 0, else 1.

    The closer to 0, the closer a pair of roots is to the imaginary axis.
    """
    left = _left(polynomial)
    decay = np.all((polynomial > 0).astype(bool), axis=-1) & np.all(left > 0.0, axis=0)
    # The last element vanishes first, as a pair of roots reaches the axis.
    return np.where(decay, -left[-1], 1.0)


def margin_bounds(polynomial: Array) -> tuple[Array, Array]:
    """Return the least and the largest `margin` of a polynomial within its rounding errors.

    Kharitonov's four polynomials surround the one that they bound: where all four have a root past
    the axis it has one too.
    """
    margins = margin(_bounds(polynomial))
    return np.min(margins, axis=-1), np.max(margins, axis=-1)


def surely_crossed(polynomial: Array) -> BoolArray:
    """Return whether a first pair of roots is past the imaginary axis despite rounding errors."""
    # Of the polynomial itself too: where a second pair is close behind, the sign changes again.
    past = np.all(determinant(_bounds(polynomial)) < 0.0, axis=-1)
    return past & (determinant(polynomial) < 0.0)


def surely_between(before: Array, after: Array) -> bool:
    """Return whether all roots of one polynomial surely decay, and one pair of another's does not.

    As `margin_bounds` and `surely_crossed` tell of each, in one of Routh's schemes for both.
    """
    bounds = _bounds(np.stack([before, after]))
    with np.errstate(invalid="ignore", over="ignore"):
        left = _left(np.concatenate([*bounds, after[None]]))
        past = np.prod(left[:, 4:], axis=0) < 0.0
    decays = np.all(bounds[0] > 0.0) and np.all(left[:, :4] > 0.0)
    return bool(decays and np.all(past))


def exact_determinant(polynomial: NDArray[np.object_]) -> Any:
    """Return `determinant` of one polynomial of decimals as a decimal."""
    return np.prod(_scheme(polynomial)[1])


def axis_frequency(polynomial: NDArray[Any]) -> Array:
    """Return ω of the roots ±jω of a polynomial whose `determinant` vanishes, else NaN.

    Source: the row of Routh's scheme above the one that vanishes, a λ² + b, divides it.
    """
    above, _ = _scheme(polynomial)
    square = np.asarray(above[1] / above[0], dtype=float)
    return np.sqrt(np.where(square > 0.0, square, np.nan))


def _bounds(polynomial: Array) -> Array:
    """Return Kharitonov's polynomials, (..., 4, n+1)."""
    # For positive coefficients; a polynomial with any other is unstable whatever its bounds.
    signs = _KHARITONOV[:, : polynomial.shape[-1]]
    return polynomial[..., None, :] * (1.0 + ROUNDING * signs)


def _left(polynomial: NDArray[Any]) -> Array:
    """Return Routh's first column over the coefficients of λⁿ⁻² … λ, (n-2, ...).

    The share of each that elimination leaves, at most 1; with positive coefficients all are
    positive where all roots lie in Re λ < 0.
    """
    return _scheme(polynomial)[1].astype(float)


def _scheme(polynomial: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return the row of λ² in Routh's scheme, (2, ...), and the column of `_left`."""
    # The first two rows hold every other coefficient, from λⁿ and from λⁿ⁻¹ downwards.
    falling = polynomial.transpose(-1, *range(polynomial.ndim - 1))[::-1]
    above, row = falling[0::2], falling[1::2]
    left = np.empty((len(falling) - 3, *falling.shape[1:]), dtype=polynomial.dtype)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for step, whole in enumerate(falling[2:-1]):
            below = above[1:].copy()
            below[: len(row) - 1] -= above[0] / row[0] * row[1:]
            left[step] = below[0] / whole
            above, row = row, below
    return above, left
