"""What a film model answers: the film at one modified Sommerfeld number, dimensionless.

This record is the seam between the bearings and all that uses them. Nothing that reads it may
assume a circular bearing: the journal's position is (x, y), not an eccentricity alone.
"""

from dataclasses import dataclass

import numpy as np

from rotorcalc.typing import Array


@dataclass(frozen=True, eq=False)
class FilmState:
    """The film in static equilibrium, dimensionless.

    Stiffness and damping are in units of the film, not of the load as k and c of Eq. 5.32 are:
    those grow without bound as the load vanishes, these stay finite.

    Attributes
    ----------
    sommerfeld : array, (...)
        Modified Sommerfeld number, σ [-] (Eq. 5.8); infinite without load.
    position : array, (..., 2)
        Journal centre in X, Y from the bearing's centre, in radial clearances, C.
    minimum_thickness : array, (...)
        Smallest film thickness, in C.
    stiffness : array, (..., 2, 2)
        Stiffness in X, Y, in μΩRL³/C³.
    damping : array, (..., 2, 2)
        Damping in X, Y, in μRL³/C³.
    side_flow : array, (...)
        Oil that leaves at both ends together, in ΩRLC.
    drag : array, (...)
        Torque of the film on the journal, in μΩR³L/C.
    """

    sommerfeld: Array
    position: Array
    minimum_thickness: Array
    stiffness: Array
    damping: Array
    side_flow: Array
    drag: Array

    @property
    def eccentricity_ratio(self) -> Array:
        """Eccentricity ratio, ε = e/C [-], shape (...)."""
        return np.hypot(self.position[..., 0], self.position[..., 1])

    @property
    def attitude_angle(self) -> Array:
        """Attitude angle, φ [rad], from the load line to the line of centres, shape (...)."""
        return np.arctan2(self.position[..., 1], self.position[..., 0])

    @property
    def k(self) -> Array:
        """Stiffness in units of the load, k = K·C/F_o [-] (Eq. 5.32), shape (..., 2, 2).

        Not a number, or infinite, without load.
        """
        return self._per_load(self.stiffness)

    @property
    def c(self) -> Array:
        """Damping in units of the load, c = C·ΩC/F_o [-] (Eq. 5.32), shape (..., 2, 2).

        Not a number, or infinite, without load.
        """
        return self._per_load(self.damping)

    def _per_load(self, coefficients: Array) -> Array:
        # F_o = μΩRL³/(4σC²), so one film unit is 4σ units of the load.
        with np.errstate(invalid="ignore"):
            return 4.0 * self.sommerfeld[..., None, None] * coefficients
