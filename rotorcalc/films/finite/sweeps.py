"""Where the films at fixed positions of the journal are full: the active set, sweep by sweep."""

import numpy as np

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films.finite.reynolds import Films, Solution, solved

_MOST_SWEEPS = 40


def settled_pressures(found: Films, wet: BoolArray, *, sweeps: int = _MOST_SWEEPS) -> Solution:
    """Return pressures at fixed positions, the active set corrected until nothing changes.

    Parameters
    ----------
    found : Films
        The films at P positions.
    wet : boolean array, (P, N, nodes, m)
        The active set to begin with.
    sweeps : int
        Number of corrections at most. A position that has settled is not solved again.

    Returns
    -------
    Solution
        Without adjoint pressures.
    """
    at = solved(found, wet, adjoint=False)
    rows = np.arange(len(wet))
    for _ in range(sweeps):
        after = at.next_wet
        changed = (after[rows] != at.wet[rows]).any(axis=(1, 2, 3))
        rows = rows[changed]
        if not rows.size:
            break
        again = solved(found.taken(rows), after[rows], adjoint=False)
        at = Solution(
            _with(at.pressure, rows, again.pressure), after, _with(at.excess, rows, again.excess),
            at.adjoint, _with(at.force, rows, again.force),
        )  # fmt: skip
    return at


def _with(values: Array, rows: IntArray, others: Array) -> Array:
    """Return values with some rows in place."""
    values = values.copy()
    values[rows] = others
    return values
