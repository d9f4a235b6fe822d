"""Whether all roots of a polynomial decay, without its roots: Routh, Hurwitz and Kharitonov.

Polynomials are arrays (..., n+1) of the coefficients from the constant to that of λⁿ, n even.

Hurwitz's matrix of a polynomial whose roots all decay is totally nonnegative, and so elimination
in it, which is Routh's scheme, is as good as the coefficients are, each to its own size.
Kharitonov: all polynomials whose coefficients lie between bounds decay if four of them do.
"""

import numpy as np

from rotorcalc.arrays import Array, BoolArray

# To how much the coefficients are known, relative, with what Routh's scheme rounds.
_ROUNDING = 128 * float(np.finfo(float).eps)
# To which side each coefficient lies in Kharitonov's four polynomials, from the constant on.
_KHARITONOV = np.tile([[-1, -1, 1, 1], [1, 1, -1, -1], [1, -1, -1, 1], [-1, 1, 1, -1]], 3)


def decays(polynomial: Array) -> BoolArray:
    """Return whether all roots of polynomials decay: whether Routh's first column is positive."""
    return np.all(polynomial > 0.0, axis=-1) & np.all(_left(polynomial) > 0.0, axis=0)


def determinant(polynomial: Array) -> Array:
    """Return Hurwitz's last determinant, over what it were had Routh's scheme nothing to take away.

    It vanishes where a first pair of roots meets the imaginary axis, smooth in the coefficients.
    """
    return np.prod(_left(polynomial), axis=0)


def doubt(polynomial: Array) -> Array:
    """Return a number that is negative where all roots surely decay, whatever rounding does, or 1.

    The nearer to 0, the nearer a pair of roots to the imaginary axis.
    """
    left = _left(_bounds(polynomial))
    decay = np.all(left > 0.0, axis=(0, -1)) & np.all(polynomial > 0.0, axis=-1)
    return np.where(decay, -np.min(left[-1], axis=-1), 1.0)


def surely_crossed(polynomial: Array) -> BoolArray:
    """Return whether a first pair of roots is past the imaginary axis, whatever rounding does."""
    return np.all(determinant(_bounds(polynomial)) < 0.0, axis=-1)


def _bounds(polynomial: Array) -> Array:
    """Return Kharitonov's polynomials, (..., 4, n+1)."""
    signs = _KHARITONOV[:, : polynomial.shape[-1]]
    return polynomial[..., None, :] * (1.0 + _ROUNDING * signs)


def _left(polynomial: Array) -> Array:
    """Return Routh's first column over the coefficients of λⁿ⁻² … λ, (n-2, ...).

    What elimination leaves of each, at most 1; all are positive where all roots decay and all
    coefficients are positive.
    """
    falling = np.moveaxis(polynomial, -1, 0)[::-1]
    above, row = falling[0::2], falling[1::2]
    left: list[Array] = []
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for whole in falling[2:-1]:
            below = above[1:].copy()
            below[: len(row) - 1] -= above[0] / row[0] * row[1:]
            left.append(below[0] / whole)
            above, row = row, below
    return np.stack(left)
