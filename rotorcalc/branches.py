"""Modes followed over a sweep: each speed's eigenvalues in the order of the speed before it."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import linear_sum_assignment

from rotorcalc.arrays import Array, BoolArray, ComplexArray, complex_array

# Rows of a sweep that `follow_branches` compares at once: NumPy's overhead is spread over them, and
# few are compared in vain where two branches cross.
_ROWS_AT_ONCE = 32


def follow_branches(eigenvalues: ArrayLike) -> ComplexArray:
    """Return eigenvalues reordered so that each column is one mode followed over the sweep.

    Each step extrapolates every branch linearly and assigns the next eigenvalues to the predictions
    so that the sum of the relative distances is least. So modes keep their identity where their
    frequencies cross, even beside far larger eigenvalues.

    Parameters
    ----------
    eigenvalues : array_like, (n, m)
        λ of m modes at n neighbouring points of a sweep [1/s].

    Returns
    -------
    complex array, (n, m)
        The same values, each row reordered. The first row runs from the highest frequency down.
    """
    branches = complex_array("eigenvalues", eigenvalues).copy()
    if branches.ndim != 2:
        raise ValueError(f"eigenvalues: must have the shape (n, m), has {branches.shape}")
    order = np.lexsort((branches.real, -branches.imag))
    branches = np.take_along_axis(branches, order, axis=-1)
    i = 1
    while i < len(branches):
        # The order stays until the next row in which a branch is closer to another's value.
        rows = branches[max(i - 2, 0) : i + _ROWS_AT_ONCE]
        distance = _relative_distance(rows if i > 1 else np.concatenate([rows[:1], rows]))
        crossed = _any_crossed(distance)
        if not np.any(crossed):
            i += len(crossed)
            continue
        first = int(np.argmax(crossed))
        _, order = linear_sum_assignment(distance[first])
        branches[i + first :] = branches[i + first :, order]
        i += first + 1
    return branches


def _relative_distance(rows: ComplexArray) -> Array:
    """Return how far each branch, extrapolated, is from each value of the next row, (n, m, m)."""
    last = rows[1:-1]
    predicted = (last + _bounded(last - rows[:-2], last))[:, :, None]
    values = rows[2:, None, :]
    size = np.abs(predicted) + np.abs(values)
    return np.abs(predicted - values) / np.where(size == 0.0, 1.0, size)


def _any_crossed(distance: Array) -> BoolArray:
    """Return whether in a row some branch is closer to another's value than to its own, (n,)."""
    own = np.diagonal(distance, axis1=1, axis2=2)
    return np.any(np.min(distance, axis=2) < own, axis=1)


def _bounded(step: ComplexArray, last: ComplexArray) -> ComplexArray:
    """Return steps no longer than a third of the eigenvalue: longer extrapolations mislead."""
    length, most = np.abs(step), np.abs(last) / 3.0
    return step * np.where(length > most, most / np.where(length == 0.0, 1.0, length), 1.0)
