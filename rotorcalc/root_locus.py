"""The root locus: a machine's modes followed over speed, and their eigenvalues at one speed.

Complex eigenvalues of a real matrix come in conjugate pairs, each pair one motion; the locus keeps
the half with Im λ ≥ 0. Source: the notes' calculation sheet, eigenvalues over speed.
"""

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.display import Result
from rotorcalc.machine import Bearing
from rotorcalc.mode_names import mode_names
from rotorcalc.modes import ModeShapes, least_damped_place


@dataclass(frozen=True, eq=False)
class Locus(Result):
    """Eigenvalues over speed, one column per mode, and the same modes at the running speed.

    The modes keep one order in all fields: at the lowest speed the oscillating ones by rising
    frequency, then the others.

    Attributes
    ----------
    speed : array, (n,)
        Ω [rad/s].
    branches : complex array, (n, m)
        λ [1/s]; NaN at speeds at which another column holds the conjugate.
    running_speed : float
        Ω [rad/s].
    here : ModeShapes
        The m modes at the running speed.
    moving : tuple of str
        What moves in each of these where it is not the rotor alone (`mode_names`), else "".
    """

    speed: Array
    branches: ComplexArray
    running_speed: float
    here: ModeShapes
    moving: tuple[str, ...]

    def name(self, mode: int) -> str:
        """Return a mode's number, and what moves in it where it is not the rotor alone."""
        part = self.moving[mode]
        return f"mode {mode + 1}" + (f", {part}" if part else "")

    @property
    def least_damped(self) -> int:
        """Index of the oscillating mode with the smallest log decrement at that speed."""
        return int(least_damped_place(self.here.eigenvalues))


@checked
def root_locus(
    speed: Array,
    branches: ComplexArray,
    *,
    running_speed: float,
    shapes: ModeShapes,
    bearing: Bearing,
) -> Locus:
    """Return followed eigenvalues and the modes at the running speed, in one order.

    Parameters
    ----------
    speed : array, (n,)
        Rising speeds, Ω [rad/s].
    branches : complex array, (n, m)
        λ followed over them [1/s], as `modes.follow_branches` returns them.
    running_speed : float
        Ω [rad/s].
    shapes : ModeShapes
        All m modes at the running speed.
    bearing : JournalBearing or CoefficientTable
        The bearing, whose parts may move too.

    Returns
    -------
    Locus
        The half with Im λ ≥ 0.
    """
    # The modes at the running speed are assigned to the branches by their distance at the nearest
    # speed of the sweep.
    nearest = branches[np.argmin(np.abs(speed - running_speed))]
    _, here = linear_sum_assignment(np.abs(nearest[:, None] - shapes.eigenvalues[None, :]))
    first = branches[0]
    # Real eigenvalues rank as if of infinite frequency: last, the slowest decay first.
    order = np.lexsort((-first.real, np.where(first.imag > 0.0, first.imag, np.inf)))
    followed = np.take_along_axis(branches[:, order], _images_last(branches[:, order]), axis=1)
    here = here[order][_images_last(shapes.eigenvalues[here[order]][None, :])[0]]
    # A column of conjugates at every speed is dropped; one that begins real stays, blank where it
    # becomes the conjugate of another.
    kept = np.any(followed.imag >= 0.0, axis=0)
    shown = shapes.ordered(here[kept])
    return Locus(
        speed=speed,
        branches=np.where(followed.imag < 0.0, np.nan, followed)[:, kept],
        running_speed=running_speed,
        here=shown,
        moving=mode_names(bearing, shown),
    )


def _images_last(values: ComplexArray) -> NDArray[np.intp]:
    """Return columns in an order, row by row, in which no conjugate comes before its mode.

    Where two real eigenvalues meet they leave the axis as a conjugate pair, in arbitrary order.
    """
    n, m = values.shape
    places: NDArray[np.intp] = np.zeros((n, 1), dtype=np.intp) + np.arange(m, dtype=np.intp)
    for j, k in itertools.combinations(range(m), 2):
        swap = (values[:, j].imag < 0.0) & (values[:, j] == values[:, k].conj())
        places[swap, j], places[swap, k] = k, j
    return places
