"""Systems of equations of many films at once, as one banded matrix solved by LAPACK.

The unknowns of a film are ordered angle by angle. Each is coupled to all those at its own angle and
to its own neighbours at the angles before and after; films are not coupled to each other.
"""

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack


@dataclass(frozen=True, eq=False)
class Band:
    """The matrices of P films.

    Attributes
    ----------
    before, here, after : array, (P, n, m)
        Coupling of each unknown to the one at the angle before, to itself, and to the one after;
        (P, n − 1, m) of the first and last.
    along : array, (P, n, m, m)
        Coupling of the unknowns at one angle, besides.
    """

    before: NDArray[Any]
    here: NDArray[Any]
    after: NDArray[Any]
    along: NDArray[Any]


def solved(band: Band, right: NDArray[Any]) -> NDArray[Any]:
    """Return the solutions of the systems for k right sides (P, n, m, k), the same shape."""
    P, n, m, k = right.shape
    kind = complex if any(map(np.iscomplexobj, (band.here, band.along, right))) else float
    # LAPACK's columns are rows here: column j holds rows j − m to j + m from place m on.
    stored = np.zeros((P, n, m, 3 * m + 1), dtype=kind)
    middle = 2 * m
    for j in range(m):
        stored[:, :, j, middle - j : middle - j + m] = band.along[:, :, :, j]
    stored[..., middle] += band.here
    stored[:, 1:, :, m] = band.after
    stored[:, :-1, :, 3 * m] = band.before
    solve = cast("Any", lapack.zgbsv if kind is complex else lapack.dgbsv)
    sides = np.asfortranarray(right.reshape(-1, k), dtype=kind)
    *_, found, failed = solve(
        m, m, stored.reshape(-1, 3 * m + 1).T, sides, overwrite_ab=True, overwrite_b=True
    )
    if failed:
        raise ValueError("foil: Reynolds' equation has no single solution at these points")
    return np.ascontiguousarray(found).reshape(P, n, m, k)


def applied(band: Band, fields: NDArray[Any]) -> NDArray[Any]:
    """Return the matrices times k fields (P, n, m, k)."""
    found = band.here[..., None] * fields + band.along @ fields
    found[:, 1:] += band.before[..., None] * fields[:, :-1]
    found[:, :-1] += band.after[..., None] * fields[:, 1:]
    return found
