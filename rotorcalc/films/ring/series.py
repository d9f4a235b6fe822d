"""Stiffness and damping of two films in series, a ring between them."""

import numpy as np

from rotorcalc.arrays import Array, ComplexArray


def in_series(inside: Array, outside: Array) -> Array:
    """Return the matrix of journal and ring, (..., 4, 4), from those of the two films.

    Parameters
    ----------
    inside, outside : array, (..., 2, 2)
        Stiffness or damping of the film between journal and ring, and of that around the ring.

    Returns
    -------
    array, (..., 4, 4)
        In the order X, Y of the journal, X, Y of the ring.
    """
    both = np.empty((*inside.shape[:-2], 4, 4))
    both[..., :2, :2] = inside
    both[..., :2, 2:] = both[..., 2:, :2] = -inside
    both[..., 2:, 2:] = inside + outside
    return both


def synchronous(K: Array, C: Array, mass: Array) -> tuple[Array, Array]:
    """Return the journal's stiffness and damping in synchronous motion, the ring eliminated.

    Parameters
    ----------
    K, C : array, (..., 4, 4)
        Of journal and ring, in film units.
    mass : array, (...)
        The ring's mass times Ω² over the unit of stiffness.

    Returns
    -------
    K, C : array, (..., 2, 2)
        In film units.
    """
    Z: ComplexArray = K + 1j * C
    of_ring = Z[..., 2:, 2:] - mass[..., None, None] * np.eye(2)
    left = Z[..., :2, :2] - Z[..., :2, 2:] @ np.linalg.solve(of_ring, Z[..., 2:, :2])
    return left.real, left.imag
