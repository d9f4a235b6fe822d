"""Frames of reference: from radial and tangential (r, t) to the load's X and Y.

X points along the static load, Y at +90° in the sense of rotation; r points along the line of
centres, at the attitude angle φ from X, and t at +90° from r. Source: notes, Eqs. 5.11 and 5.16.
"""

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, real_array

# Types of a film's own results, two matrices and a vector per speed: they need no conversion.
_SURELY_NUMBERS = frozenset({float, np.float64, np.ndarray})


def matrix(xx: ArrayLike, xy: ArrayLike, yx: ArrayLike, yy: ArrayLike) -> Array:
    """Return the 2×2 matrices [[xx, xy], [yx, yy]].

    Parameters
    ----------
    xx, xy, yx, yy : array_like, (...)
        Elements, in any one unit.

    Returns
    -------
    array, (..., 2, 2)
        The matrices.
    """
    matrices = np.empty((*np.broadcast(xx, xy, yx, yy).shape, 2, 2))
    if not {type(xx), type(xy), type(yx), type(yy)} <= _SURELY_NUMBERS:
        xx, xy = real_array("xx", xx), real_array("xy", xy)
        yx, yy = real_array("yx", yx), real_array("yy", yy)
    matrices[..., 0, 0], matrices[..., 0, 1] = xx, xy
    matrices[..., 1, 0], matrices[..., 1, 1] = yx, yy
    return matrices


def vector(x: ArrayLike, y: ArrayLike) -> Array:
    """Return the vectors (x, y), shape (..., 2), from their components, shape (...)."""
    vectors = np.empty((*np.broadcast(x, y).shape, 2))
    if not {type(x), type(y)} <= _SURELY_NUMBERS:
        x, y = real_array("x", x), real_array("y", y)
    vectors[..., 0], vectors[..., 1] = x, y
    return vectors


def rotate(coefficients: ArrayLike, angle: ArrayLike) -> Array:
    """Return force coefficients in (X, Y) from those in (r, t) (Eq. 5.16).

    Parameters
    ----------
    coefficients : array_like, (..., 2, 2)
        Stiffness, damping or added mass in (r, t).
    angle : array_like, (...)
        Angle from X to r, φ [rad]. With −φ the function converts from (X, Y) to (r, t).

    Returns
    -------
    array, (..., 2, 2)
        The same in (X, Y): Q K Qᵀ with Q of Eq. 5.11.
    """
    phi = real_array("angle", angle)
    cos, sin = np.cos(phi), np.sin(phi)
    # The columns of Q are the unit vectors r and t in X, Y.
    Q = matrix(cos, -sin, sin, cos)
    return Q @ real_array("coefficients", coefficients, ends=(2, 2)) @ Q.swapaxes(-1, -2)
