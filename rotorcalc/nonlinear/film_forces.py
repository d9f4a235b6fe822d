"""The film's forces on the journal and on its inner coordinates, at one speed.

Limit cycles and the Hopf bifurcation balance these with the rotor: of a film without inner
coordinates the force on the journal, of a floating ring that and the force on the ring.

Positions in C, velocities in CΩ, forces in μΩRL³/C².
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from rotorcalc import heat
from rotorcalc.arrays import Array
from rotorcalc.coefficients import equilibrium, operating_points
from rotorcalc.films import InnerMotion, OperatingPoints, film_of, journal_motion
from rotorcalc.films.dynamics import NO_INERTIA
from rotorcalc.films.model import AllForces, Smooth
from rotorcalc.machine import Bearing, Machine

# Forces (d) from d places and d velocities, one after the other.
Forces: TypeAlias = Callable[..., Sequence[float]]


@dataclass(frozen=True)
class FilmForces:
    """The forces of a film on d coordinates, the journal's and its own.

    Attributes
    ----------
    of : callable
        The forces from d places and d velocities.
    smooth : callable
        From places and velocities (m, d) how far each is from where they have no derivative, (m,).
    """

    of: Forces
    smooth: Callable[[Array, Array], Array]

    def at(self, states: Array) -> Array:
        """Return the forces in states (m, 2d), (m, d)."""
        return np.array([self.of(*state) for state in states.tolist()])


def film_forces(machine: Machine, speed: float) -> FilmForces:
    """Return the film's forces at a speed.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s].

    Returns
    -------
    FilmForces
        Its smooth places are those of a plain bearing where the film says no others.

    Raises
    ------
    ValueError
        Where the film gives no forces on parts that move on their own.
    """
    bearing, mu = machine.bearing, float(heat.viscosity(machine, speed))
    motion = film_of(bearing).motion()
    if isinstance(motion, InnerMotion) and motion.forces is not None:
        if motion.loaded is not None:
            motion = motion.loaded(machine.static_load)
        if motion.forces is not None and motion.smooth is not None:
            return _with_inner(motion.forces, motion.smooth, mu, speed)
    gap = film_of(bearing).gap

    def smooth(place: Array, velocity: Array) -> Array:
        (x, y), (dx, dy) = place.T, velocity.T
        # A plain bearing's force has a kink where velocity and half speed whirl cancel.
        return np.minimum(np.hypot(dx + 0.5 * y, dy - 0.5 * x), gap(place))

    return FilmForces(journal_motion(bearing, viscosity=mu, speed=speed).force, smooth)


def _with_inner(forces: AllForces, smooth: Smooth, mu: float, speed: float) -> FilmForces:
    def of(*state: float) -> list[float]:
        half = len(state) // 2
        return forces(list(state[:half]), list(state[half:]), mu, speed)

    return FilmForces(of, lambda place, velocity: smooth(place, velocity, mu, speed))


def rest_of(machine: Machine, speed: float) -> Array:
    """Return where journal and inner coordinates are in static equilibrium.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s].

    Returns
    -------
    array, (d,)
        Their places, in C.
    """
    film = film_of(machine.bearing)
    place = equilibrium(machine, speed).film.position
    motion = film.motion()
    if not isinstance(motion, InnerMotion) or film.inner == 0:
        return place
    return np.concatenate([place, motion.rest(operating_points(machine, speed))[: film.inner]])


def inertia_of(bearing: Bearing) -> Array:
    """Return the inertia of the film's inner coordinates.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.

    Returns
    -------
    array, (d − 2,)
        Of a ring its mass in X and in Y [kg].
    """
    film = film_of(bearing)
    if film.inner == 0:
        return NO_INERTIA
    # They do not depend on the operating point; at a light load a film has an answer.
    light = OperatingPoints.at_sommerfeld(bearing, film.sommerfeld_range[1])
    return film.dynamics(light).inertia


def has_forces(bearing: Bearing) -> bool:
    """Return whether the film gives the forces from which limit cycles are found.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.

    Returns
    -------
    bool
        False where parts of it move on their own and their forces are not given.

    Raises
    ------
    ValueError
        Where the film's force on a moving journal is not known at all.
    """
    motion = film_of(bearing).motion()
    return not isinstance(motion, InnerMotion) or motion.states == 0 or motion.forces is not None


def refuse_unknown(bearing: Bearing) -> None:
    """Refuse a film that does not give the forces from which limit cycles are found.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.

    Raises
    ------
    ValueError
        Where it does not.
    """
    if not has_forces(bearing):
        raise ValueError(
            f"bearing = {bearing.geometry.kind}: its film does not give the forces on its inner "
            "coordinates, parts that move on their own, from which limit cycles are found"
        )
