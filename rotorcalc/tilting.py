"""The tilting pads of a machine's bearing: how far each tilts, and which carry nothing."""

from typing import cast

from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.coefficients import operating_points
from rotorcalc.films import film_of
from rotorcalc.films.tilting import TiltingFilm
from rotorcalc.geometry import TiltingPads
from rotorcalc.machine import Machine


@checked
def pad_tilts(machine: Machine, speed: ArrayLike) -> Array:
    """Return how far each pad of a machine's bearing tilts in static equilibrium.

    Parameters
    ----------
    machine : Machine
        A machine on `TiltingPads`, free or on flexures.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    array, (..., pads)
        From the pad whose surface is centred on its pivot's radius, positive where the leading edge
        opens [rad]; the first pad is the one at the load line or behind it.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite, the bearing has no tilting pads, or the film has
        no answer there.
    """
    points = operating_points(machine, speed)
    if not isinstance(machine.bearing.geometry, TiltingPads):
        raise ValueError(f"bearing = {machine.bearing.geometry.kind}: has no tilting pads")
    return cast("TiltingFilm", film_of(machine.bearing)).tilts(points)
