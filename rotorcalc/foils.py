"""The foil of a foil bearing: how far it is pressed back, and from which speed on the film lifts.

Below its lift-off speed a journal rubs on the foil. Here that is the speed at which the film in the
bearing's middle plane has become as thin as the model computes it, a twentieth of the clearance.
"""

from typing import cast

from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, real_array
from rotorcalc.coefficients import operating_points
from rotorcalc.films import film_of, turning_bounds
from rotorcalc.films.foil import FoilFilm
from rotorcalc.geometry import Foil
from rotorcalc.machine import Machine


@checked
def foil_deflection(
    machine: Machine, speed: float, angle: ArrayLike, *, zeta: ArrayLike = 0.0
) -> Array:
    """Return how far the foil is pressed back in static equilibrium.

    Parameters
    ----------
    machine : Machine
        A machine on a `Foil` bearing.
    speed : float
        Running speed, Ω [rad/s], positive.
    angle : array_like, (...)
        Angles Θ around the bearing from X in the sense of rotation [rad].
    zeta : array_like, (...)
        Axial position from the bearing's middle, ζ = z/L [-]; broadcast with the angles.

    Returns
    -------
    array, (...)
        Deflection away from the journal [m]; 0 where the film's pressure is below ambient.

    Raises
    ------
    ValueError
        Where the bearing has no foil, the speed is not positive and finite or below lift-off, or ζ
        lies outside the bearing.
    """
    film = _film(machine)
    points = operating_points(machine, speed)
    found = film.deflection(points, angle=real_array("angle", angle), zeta=real_array("zeta", zeta))
    return found * machine.bearing.radial_clearance


@checked
def lift_off_speed(machine: Machine) -> float:
    """Return the lowest speed at which the gas film carries a machine's load.

    Parameters
    ----------
    machine : Machine
        A machine on a `Foil` bearing.

    Returns
    -------
    float
        Ω [rad/s]; 0 without load.

    Raises
    ------
    ValueError
        Where the bearing has no foil, or its film carries the load at no speed.
    """
    _film(machine)
    return turning_bounds(machine.bearing, machine.static_load)[0] / machine.viscosity


def _film(machine: Machine) -> FoilFilm:
    if not isinstance(machine.bearing.geometry, Foil):
        raise ValueError(f"bearing = {machine.bearing.geometry.kind}: has no foil")
    return cast("FoilFilm", film_of(machine.bearing))
