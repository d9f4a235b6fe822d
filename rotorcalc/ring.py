"""The floating ring of a machine's bearing: its speed and its two films, with dimensions.

Scales what `films.ring` knows by this machine's oil, bearing, load and speed.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.coefficients import operating_points
from rotorcalc.display import Result
from rotorcalc.films import FilmState, FilmUnits, film_of
from rotorcalc.films.ring import RingFilm, balance
from rotorcalc.machine import Bearing, Machine


@dataclass(frozen=True, eq=False)
class RingFilmEquilibrium(Result):
    """One of a ring's two films in static equilibrium, fields of leading shape (...).

    Attributes
    ----------
    sommerfeld : array
        Modified Sommerfeld number of this film, σ [-]; infinite without load.
    position : array, (..., 2)
        Centre of its inner surface from that of its outer one, in X, Y [m].
    eccentricity_ratio : array
        Their distance over this film's clearance, ε [-].
    attitude_angle : array
        Direction of the one from the other, from the load line, φ [rad].
    minimum_film_thickness : array
        [m].
    stiffness : array, (..., 2, 2)
        K_ij in X, Y [N/m].
    damping : array, (..., 2, 2)
        C_ij in X, Y [N·s/m].
    drag_torque : array
        Torque on its inner surface, against the rotation [N·m].
    power_loss : array
        What it dissipates [W].
    side_flow : array
        Oil that leaves it at both ends together [m³/s].
    peak_pressure : array
        Highest pressure above ambient [Pa].
    """

    sommerfeld: Array
    position: Array
    eccentricity_ratio: Array
    attitude_angle: Array
    minimum_film_thickness: Array
    stiffness: Array
    damping: Array
    drag_torque: Array
    power_loss: Array
    side_flow: Array
    peak_pressure: Array


@dataclass(frozen=True, eq=False)
class RingEquilibrium(Result):
    """A floating ring in static equilibrium, fields of leading shape (...).

    Attributes
    ----------
    speed : array
        Running speed of the journal, Ω [rad/s].
    ring_speed : array
        Speed of the ring, Ω_R [rad/s].
    speed_ratio : array
        r = Ω_R/Ω [-].
    inner : RingFilmEquilibrium
        The film between journal and ring.
    outer : RingFilmEquilibrium
        The film between ring and bearing.
    """

    speed: Array
    ring_speed: Array
    speed_ratio: Array
    inner: RingFilmEquilibrium
    outer: RingFilmEquilibrium


@checked
def ring_speed(machine: Machine, speed: ArrayLike) -> Array:
    """Return the speed of rotation of a machine's floating ring in static equilibrium.

    Parameters
    ----------
    machine : Machine
        The machine; its bearing has a floating ring.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    array, (...)
        Ω_R [rad/s].

    Raises
    ------
    ValueError
        Where a speed is not positive and finite, the bearing has no ring, or the load is so heavy
        that a film does not carry it or the ring does not turn.
    """
    points = operating_points(machine, speed)
    return ring_film(machine.bearing).speed_ratio(points) * points.speed


@checked
def unloaded_speed_ratio(bearing: Bearing) -> float:
    """Return the ring's speed over the shaft's without load, the most that it can be.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing, with a floating ring.

    Returns
    -------
    float
        r₀ = 1/(1 + m), m the outer film's shear over the inner one's at equal speeds [-].

    Raises
    ------
    ValueError
        Where the bearing has no floating ring.
    """
    return balance.unloaded(ring_film(bearing).pair)


@checked
def ring_equilibrium(machine: Machine, speed: ArrayLike) -> RingEquilibrium:
    """Return the static equilibrium of a machine's floating ring and of its two films.

    Parameters
    ----------
    machine : Machine
        The machine; its bearing has a floating ring.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    RingEquilibrium
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        As `ring_speed`.
    """
    film, points = ring_film(machine.bearing), operating_points(machine, speed)
    spin = film.speed_ratio(points) * points.speed
    inside, outside = film.states(points)
    ring, Omega, mu = film.pair.ring, points.speed, points.viscosity
    return RingEquilibrium(
        speed=Omega,
        ring_speed=spin,
        speed_ratio=spin / Omega,
        inner=_with_dimensions(
            inside, _Turning(film.pair.inside.bearing, mu, Omega, spin, machine.static_load)
        ),
        outer=_with_dimensions(
            outside,
            _Turning(
                film.pair.outside.bearing, ring.viscosity_ratio * mu, spin, 0.0 * spin,
                machine.static_load,
            ),
        ),
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class _Turning:
    """A plain film whose inner and outer surface turn at Ω_a and Ω_b, under a load."""

    bearing: Bearing
    viscosity: Array | float
    inner_speed: Array
    outer_speed: Array
    load: float

    @property
    def units(self) -> FilmUnits:
        """Of the summed speeds, which make the wedge."""
        return FilmUnits(self.bearing, self.viscosity, self.inner_speed + self.outer_speed)

    def torques(self, place: Array) -> tuple[Array, Array]:
        """Return what the film takes from the inner surface and gives to the outer one [N·m]."""
        shares = (self.inner_speed - self.outer_speed) / (self.inner_speed + self.outer_speed)
        shear = shares * balance.shear(place) * self.units.torque
        couple = self.load * self.bearing.radial_clearance * place[..., 1]  # F e sin φ
        return shear + 0.5 * couple, shear - 0.5 * couple


def _with_dimensions(state: FilmState, film: _Turning) -> RingFilmEquilibrium:
    units, C = film.units, film.bearing.radial_clearance
    taken, given = film.torques(state.position)
    return RingFilmEquilibrium(
        sommerfeld=state.sommerfeld,
        position=state.position * C,
        eccentricity_ratio=state.eccentricity_ratio,
        attitude_angle=state.attitude_angle,
        minimum_film_thickness=state.minimum_thickness * C,
        stiffness=state.stiffness * np.asarray(units.stiffness)[..., None, None],
        damping=state.damping * np.asarray(units.damping)[..., None, None],
        drag_torque=taken,
        power_loss=taken * film.inner_speed - given * film.outer_speed,
        side_flow=state.side_flow * units.flow,
        peak_pressure=state.peak_pressure * units.pressure,
    )


def ring_film(bearing: Bearing) -> RingFilm:
    """Return the film of a bearing with a floating ring, or raise ValueError."""
    film = film_of(bearing)
    if not isinstance(film, RingFilm):
        raise ValueError(f"bearing = {bearing.geometry.kind}: has no floating ring")
    return film
