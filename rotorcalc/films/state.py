"""The operating points of a film and the film's state there, dimensionless.

Nothing that reads these records may assume a circular bearing: the journal's position is (x, y),
not an eccentricity alone.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, BoolArray, real_array
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.display import Result
from rotorcalc.films.units import FilmUnits
from rotorcalc.frames import vector
from rotorcalc.machine import Bearing


@dataclass(frozen=True, eq=False)
class OperatingPoints:
    """Operating points of a film: arrays that broadcast to one shape (...).

    Attributes
    ----------
    sommerfeld : array
        Modified Sommerfeld number, σ [-] (Eq. 5.8), positive; infinite without load.
    viscosity : array
        Viscosity of the oil in the film, μ [Pa·s].
    speed : array
        Running speed, Ω [rad/s].
    load : array
        Static load per bearing, F_o [N].
    """

    sommerfeld: Array
    viscosity: Array
    speed: Array
    load: Array

    @classmethod
    def of(
        cls, bearing: Bearing, *, viscosity: ArrayLike, speed: ArrayLike, load: ArrayLike
    ) -> "OperatingPoints":
        """Return the points of a bearing at speeds and loads."""
        mu, omega, F = (np.asarray(one, dtype=float) for one in (viscosity, speed, load))
        with np.errstate(divide="ignore"):  # without load σ = ∞, the centred journal
            sigma = FilmUnits(bearing, mu, omega).force / (4.0 * F)  # Eq. 5.8
        return cls(sommerfeld=np.asarray(sigma), viscosity=mu, speed=omega, load=F)

    @classmethod
    def at_sommerfeld(
        cls,
        bearing: Bearing,
        sommerfeld: ArrayLike,
        *,
        viscosity: ArrayLike = 1.0,
        speed: ArrayLike = 1.0,
    ) -> "OperatingPoints":
        """Return points with these σ, positive, at μ [Pa·s] and Ω [rad/s]: the load fits.

        Raises
        ------
        ValueError
            Where one of them is not positive, or the bearing is a table over speed alone.
        """
        if isinstance(bearing, CoefficientTable):
            raise ValueError(
                f"bearing = {bearing.geometry.kind}: is a table over speed, which knows neither a "
                "Sommerfeld number nor the journal's place"
            )
        sigma = _positive("sommerfeld", sommerfeld)
        mu, omega = _positive("viscosity", viscosity), _positive("speed", speed)
        unit = FilmUnits(bearing, mu, omega).force
        return cls(
            sommerfeld=sigma,
            viscosity=mu,
            speed=omega,
            load=np.asarray(unit / (4.0 * sigma)),
        )


def _positive(name: str, given: ArrayLike) -> Array:
    values = real_array(name, given)
    if values.size and not values.min() > 0.0:
        raise ValueError(f"{name} = {values[~(values > 0.0)].flat[0]}: must be positive")
    return values


@dataclass(frozen=True, eq=False)
class FilmState(Result):
    """The film in static equilibrium, dimensionless.

    Stiffness and damping are in units of the film, not of the load as k and c of Eq. 5.32 are:
    those grow without bound as the load vanishes, these stay finite.

    Attributes
    ----------
    sommerfeld : array, (...)
        Modified Sommerfeld number, σ [-] (Eq. 5.8); infinite without load.
    position : array, (..., 2)
        Journal centre in X, Y from the bearing's centre, in radial clearances, C.
    attitude_angle : array, (...)
        From the load line to the line of centres, φ [rad]; at the centre its limit there.
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
    peak_pressure : array, (...)
        Highest pressure above ambient, in μΩ(L/C)².
    peak_angle : array, (...)
        Where that is: angle Θ around the bearing from X in the sense of rotation [rad].
    unloaded_pads : boolean array, (..., pads), or None
        Which tilting pads carry nothing; None of other bearings.
    """

    sommerfeld: Array
    position: Array
    attitude_angle: Array
    minimum_thickness: Array
    stiffness: Array
    damping: Array
    side_flow: Array
    drag: Array
    peak_pressure: Array
    peak_angle: Array
    unloaded_pads: BoolArray | None = None

    @property
    def eccentricity_ratio(self) -> Array:
        """Eccentricity ratio, ε = e/C [-], shape (...)."""
        return np.hypot(self.position[..., 0], self.position[..., 1])

    @property
    def force(self) -> Array:
        """Static force of the film on the journal in (r, t), in μΩRL³/C², shape (..., 2).

        It carries the load, F_r = −F_o cos φ and F_t = F_o sin φ (Eq. 5.4).
        """
        load = 0.25 / self.sommerfeld  # F_o = μΩRL³/(4σC²), Eq. 5.8
        return vector(-load * np.cos(self.attitude_angle), load * np.sin(self.attitude_angle))

    @property
    def k(self) -> Array:
        """Stiffness in units of the load, k = K·C/F_o [-] (Eq. 5.32), shape (..., 2, 2).

        NaN or infinite without load.
        """
        return self._per_load(self.stiffness)

    @property
    def c(self) -> Array:
        """Damping in units of the load, c = C·ΩC/F_o [-] (Eq. 5.32), shape (..., 2, 2).

        NaN or infinite without load.
        """
        return self._per_load(self.damping)

    def _per_load(self, coefficients: Array) -> Array:
        # F_o = μΩRL³/(4σC²), so one film unit is 4σ units of the load.
        with np.errstate(invalid="ignore"):  # ∞ · 0 = NaN where a coefficient vanishes without load
            return 4.0 * self.sommerfeld[..., None, None] * coefficients


@dataclass(frozen=True, eq=False)
class FilmField(Result):
    """Thickness and pressure of the film over the bearing's surface, dimensionless.

    Attributes
    ----------
    angle : array, (...)
        Angle Θ around the bearing from X in the sense of rotation [rad].
    zeta : array, (...)
        Axial position from the bearing's middle, ζ = z/L [-].
    thickness : array, (...)
        Film thickness, in C.
    pressure : array, (...)
        Pressure above ambient, in μΩ(L/C)².
    cavitated : boolean array, (...)
        Whether the film is cavitated there.
    """

    angle: Array
    zeta: Array
    thickness: Array
    pressure: Array
    cavitated: BoolArray
