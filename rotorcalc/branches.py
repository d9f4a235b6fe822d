"""Modes followed over a sweep: each speed's eigenvalues in the order of the speed before it."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import linear_sum_assignment

from rotorcalc.arrays import Array, BoolArray, ComplexArray, complex_array, real_array

# How many times nearer its own value than any other a branch must be for the order to be clear.
_CLEAR = 3.0
# Difference of two values over their size at which they are one.
_SAME = 1e-7
# Points put at a time into an interval whose order is not clear, and how often: to 1/256 of it.
_WITHIN, _DEPTH = 3, 4

# A row of eigenvalues with the two before it, in one order but for the last; and their points.
_Triple: TypeAlias = tuple[ComplexArray, ComplexArray, ComplexArray]
_Points: TypeAlias = tuple[float, float, float]
# Eigenvalues (k, m) at k further points of the sweep.
More: TypeAlias = Callable[[Array], ComplexArray]


def follow_branches(
    eigenvalues: ArrayLike, *, at: ArrayLike | None = None, more: More | None = None
) -> ComplexArray:
    """Return eigenvalues reordered so that each column is one mode followed over the sweep.

    Each step extrapolates every branch linearly and assigns the next eigenvalues to the predictions
    so that the sum of the relative distances is least. So modes keep their identity where their
    frequencies cross, even beside far larger eigenvalues.

    Parameters
    ----------
    eigenvalues : array_like, (n, m)
        λ of m modes at n neighbouring points of a sweep [1/s].
    at : array_like, (n,), optional
        The points, such as speeds; by default equally spaced.
    more : callable, optional
        λ (k, m) at k further points. Steps in which a branch is not far nearer its own value than
        another's are then followed in smaller ones.

    Returns
    -------
    complex array, (n, m)
        The same values, each row reordered. The first row runs from the highest frequency down.
        Of two modes that meet on the real axis and leave it, which is which is arbitrary.
    """
    values = complex_array("eigenvalues", eigenvalues)
    if values.ndim != 2:
        raise ValueError(f"eigenvalues: must have the shape (n, m), has {values.shape}")
    points = np.arange(float(len(values))) if at is None else real_array("at", at)
    if points.shape != values.shape[:1]:
        raise ValueError(f"at: must have the shape ({len(values)},), has {points.shape}")
    if len(values) == 0:
        return values.copy()
    place = np.lexsort((values[0].real, -values[0].imag))
    orders = _orders(values, points, more)
    reordered = np.flatnonzero(np.any(orders != np.arange(len(place)), axis=1))
    branches = values[:, place]
    for i in reordered.tolist():  # the order stays until the next of these rows
        place = orders[i][place]
        branches[i + 1 :] = values[i + 1 :, place]
    return branches


def _orders(values: ComplexArray, points: Array, more: More | None) -> NDArray[np.intp]:
    """Return which value of each row continues each of the row before it, (n-1, m)."""
    n, m = values.shape
    same = np.arange(m, dtype=np.intp)
    orders: NDArray[np.intp] = np.tile(same, (n - 1, 1))
    # Before the first row the branches are taken as constant.
    before, spans = np.concatenate([values[:1], values[:-2]]), np.diff(points, prepend=points[0])
    distance = _relative_distance(before[: n - 1], values[:-1], values[1:], _ratios(spans))
    follows = np.any(_rivals(distance), axis=(1, 2))
    moved = False
    for i in range(n - 1):
        # Where the row before was reordered, so is what its values are extrapolated from.
        if follows[i] or moved:
            last = values[max(i - 1, 0)].copy()
            if i > 0:
                last[orders[i - 1]] = values[i - 1]
            ends = (float(points[max(i - 1, 0)]), float(points[i]), float(points[i + 1]))
            orders[i] = _order((last, values[i], values[i + 1]), ends, more, _DEPTH)
            moved = not np.array_equal(orders[i], same)
    return orders


def _order(triple: _Triple, points: _Points, more: More | None, depth: int) -> NDArray[np.intp]:
    """Return which value of the third row continues each of the second, by the first and it."""
    (last, here, there), (before, begin, end) = triple, points
    ratio = _ratios(np.array([begin - before, end - begin]))
    distance = _relative_distance(last[None], here[None], there[None], ratio)[0]
    order = np.asarray(linear_sum_assignment(distance)[1], dtype=np.intp)
    if more is None or depth == 0 or _is_clear(distance[:, order], here, there[order]):
        return order
    inner = begin + (end - begin) / (_WITHIN + 1) * np.arange(1.0, _WITHIN + 1)
    rows, ends = [*more(inner), there], [*inner.tolist(), end]
    place = np.arange(len(order), dtype=np.intp)
    for row, point in zip(rows, ends, strict=True):
        order = _order((last, here, row), (before, begin, point), more, depth - 1)
        place = order[place]
        last = np.empty_like(row)
        last[order] = here
        here, before, begin = row, begin, point
    return place


def _is_clear(distance: Array, here: ComplexArray, there: ComplexArray) -> bool:
    """Return whether every branch is far nearer its own value than another's, distance (m, m)."""
    # Two that meet on the real axis or leave it are one another's images: either may be either.
    met = (here[:, None] == here.conj()) & (there.imag == 0.0)
    left = (there[:, None] == there.conj()) & (here.imag == 0.0)
    # So are modes that coincide before and after, as those of pads that are alike.
    alike = _coincide(here) & _coincide(there)
    return not np.any(_rivals(distance) & ~met & ~left & ~alike)


def _coincide(values: ComplexArray) -> BoolArray:
    """Return which values are one but for rounding, (m, m)."""
    size = np.abs(values[:, None]) + np.abs(values)
    return np.abs(values[:, None] - values) <= _SAME * size


def _rivals(distance: Array) -> BoolArray:
    """Return which values a branch is not far farther from than from its own, (..., m, m)."""
    own = np.diagonal(distance, axis1=-2, axis2=-1)[..., None]
    far = _CLEAR * np.maximum(own, own.swapaxes(-1, -2)) < distance
    return ~far & ~np.eye(distance.shape[-1], dtype=bool)


def _relative_distance(
    before: ComplexArray, here: ComplexArray, there: ComplexArray, ratio: Array
) -> Array:
    """Return how far each branch, extrapolated, is from each value of the next row, (n, m, m)."""
    predicted = (here + _bounded(ratio[:, None] * (here - before), here))[:, :, None]
    values = there[:, None, :]
    size = np.abs(predicted) + np.abs(values)
    return np.abs(predicted - values) / np.where(size == 0.0, 1.0, size)


def _ratios(spans: Array) -> Array:
    """Return each span over the one before it, (n-1,); 0 where that has no length."""
    return np.where(
        spans[:-1] == 0.0, 0.0, spans[1:] / np.where(spans[:-1] == 0.0, 1.0, spans[:-1])
    )


def _bounded(step: ComplexArray, last: ComplexArray) -> ComplexArray:
    """Return steps no longer than a third of the eigenvalue: longer extrapolations mislead."""
    length, most = np.abs(step), np.abs(last) / 3.0
    return step * np.where(length > most, most / np.where(length == 0.0, 1.0, length), 1.0)
