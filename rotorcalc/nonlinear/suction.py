"""The lowest pressure of a full film around a journal in motion.

The film of a hydrostatic bearing stays full in the model, at rest and in motion. Where its pressure
falls below ambient oil cavitates sooner or later, which the model leaves out: so it is said.
"""

import math

import numpy as np

from rotorcalc import heat
from rotorcalc.arguments import checked
from rotorcalc.films import film_of
from rotorcalc.films.hydrostatic import HydrostaticFilm
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.transient import Transient

# Parts of a motion, in each of which the moment with the thinnest film is looked at.
_PARTS = 64


@checked
def lowest_pressure(machine: Machine, motion: Transient) -> float:
    """Return the lowest pressure of a film that does not cavitate, over a motion.

    Parameters
    ----------
    machine : Machine
        The machine.
    motion : Transient
        Its motion.

    Returns
    -------
    float
        Above ambient [Pa], at most 0; at the moments with the thinnest film in each of 64 parts of
        the motion. NaN on a film of which the model keeps no pressure below ambient.
    """
    film, C = film_of(machine.bearing), machine.bearing.radial_clearance
    if not isinstance(film, HydrostaticFilm):
        return math.nan
    gap = film.gap(motion.journal / C)
    parts = np.array_split(np.arange(len(gap)), min(_PARTS, len(gap)))
    at = np.array([part[np.argmin(gap[part])] for part in parts])
    speed = motion.speed[at]
    lowest = film.lowest_pressure(
        place=motion.journal[at] / C,
        velocity=motion.journal_velocity_at(at) / (C * speed[:, None]),
        viscosity=np.broadcast_to(heat.viscosity(machine, speed), speed.shape),
        speed=speed,
    )
    return float(lowest.min())
