"""Eigenvalues of a matrix whose fastest are so fast that their rounding error hides the slowest.

A matrix eigenvalue errs by ε |λ|max. The very narrow film of a floating ring has rates of 1e15 1/s,
whose rounding turns a slow whirl that decays into two real modes that grow. The slow eigenvalues of
A are the large ones of A⁻¹, where they have the small error. Each is taken from the matrix in which
it is the larger.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotorcalc import state_matrices
from rotorcalc.arrays import Array, BoolArray, ComplexArray
from rotorcalc.machine import Rotor

# |λ|max over |λ|min above which the inverse is solved too: below, the slowest are known to 2e-7.
_WIDE = 1e9

Found = NDArray[Any]


def inner_eigenvalues(
    rotor: Rotor, K: Array, C: Array, inertia: Array, *, bends: bool
) -> ComplexArray:
    """Return the eigenvalues of A of `state_matrices.with_inner`, fast and slow alike, (..., n)."""

    def solved(matrix: Array) -> Found:
        return np.linalg.eigvals(matrix)[..., None, :]

    found = _both_ends(solved, rotor, (K, C, inertia), bends=bends)
    return found[..., 0, :].astype(complex)


def inner_eigenpairs(
    rotor: Rotor, K: Array, C: Array, inertia: Array, *, bends: bool
) -> tuple[Found, Found]:
    """Return the eigenvalues as `inner_eigenvalues`, and eigenvectors of A, (..., n, n)."""

    def solved(matrix: Array) -> Found:
        values, vectors = np.linalg.eig(matrix)
        return np.concatenate([values[..., None, :], vectors], axis=-2)

    found = _both_ends(solved, rotor, (K, C, inertia), bends=bends)
    return found[..., 0, :], found[..., 1:, :]


def _both_ends(
    solved: Callable[[Array], Found],
    rotor: Rotor,
    film: tuple[Array, Array, Array],
    *,
    bends: bool,
) -> Found:
    """Return what `solved` finds, λ in the first row, the slow ones from A⁻¹, (..., r, n)."""
    K, C, inertia = film
    found = solved(state_matrices.with_inner(rotor, K, C, inertia, bends=bends))
    wide = _is_wide(found)
    if np.any(wide):
        wide &= state_matrices.resists(rotor, K, bends=bends)
    if not np.any(wide):
        return found
    inverse = state_matrices.inverse_with_inner(rotor, K[wide], C[wide], inertia, bends=bends)
    found = found.astype(complex)
    found[wide] = _slow_from(solved(inverse).astype(complex), found[wide])
    return found


def _is_wide(found: Found) -> BoolArray:
    size = np.abs(found[..., 0, :])
    return np.asarray(size.max(axis=-1) > _WIDE * size.min(axis=-1))


def _slow_from(inverted: ComplexArray, found: ComplexArray) -> ComplexArray:
    """Return the modes of A with the slow ones of A⁻¹, both (..., r, n), slowest first."""
    # Of the fastest the inverse may know nothing, 1/0: they are A's.
    with np.errstate(divide="ignore", invalid="ignore"):
        inverted[..., 0, :] = 1.0 / inverted[..., 0, :]
    inverted, found = _by_size(inverted), _by_size(found)
    slowest, fastest = np.abs(inverted[..., :1, :1]), np.abs(found[..., :1, -1:])
    is_slow = np.abs(inverted[..., :1, :]) < np.sqrt(slowest) * np.sqrt(fastest)
    return np.where(is_slow, inverted, found)


def _by_size(found: ComplexArray) -> ComplexArray:
    order = np.argsort(np.abs(found[..., :1, :]), axis=-1)
    return np.take_along_axis(found, order, axis=-1)
