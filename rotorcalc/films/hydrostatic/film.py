"""The film of a hydrostatic bearing as a film model (interface in `films.model`).

Reynolds' equation of the full film on the lands, without cavitation; each recess has one pressure,
fed through a capillary or an orifice. The oil in the recesses is incompressible and without drag.
"""

import functools
import math
from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar, cast

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array
from rotorcalc.films.dynamics import NO_INERTIA, FilmDynamics
from rotorcalc.films.hydrostatic.balance import (
    Balance,
    Bearing,
    balanced,
    bearing_of,
    bearing_with,
)
from rotorcalc.films.hydrostatic.drag import shear
from rotorcalc.films.hydrostatic.mesh import Lands, lands_of, mesh
from rotorcalc.films.hydrostatic.motion import RecessesInMotion
from rotorcalc.films.hydrostatic.pressure import SHOWN, At, Extremes, extremes, nodal
from rotorcalc.films.hydrostatic.pressure import field as pressure_at
from rotorcalc.films.hydrostatic.sources import SOURCES
from rotorcalc.films.hydrostatic.table import THINNEST, finer
from rotorcalc.films.model import Accuracy, InnerMotion, Limit, Source
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.frames import vector
from rotorcalc.geometry import Hydrostatic
from rotorcalc.machine import JournalBearing

# The share of the heaviest load at which the accuracy is measured.
_A_THIRD = 1.0 / 3.0


@dataclass(frozen=True)
class HydrostaticFilm:
    """The film of one hydrostatic bearing.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing, of a `Hydrostatic` geometry.
    """

    bearing: JournalBearing

    inner: int = field(default=0, init=False)
    frequency_dependent: bool = field(default=False, init=False)
    can_whirl: bool = field(default=True, init=False)
    curve: Hashable = field(default=None, init=False)
    # At rest and at any speed there is an equilibrium, and whirl at about half speed.
    sommerfeld_range: tuple[float, float] = field(default=(1e-3, 1e3), init=False)
    least_sommerfeld: float = field(default=0.0, init=False)
    limits: tuple[Limit, ...] = field(default=(), init=False)
    _coarse: ClassVar[bool] = False

    @property
    def sources(self) -> Mapping[str, Source]:
        """What was solved."""
        return SOURCES

    @property
    def shape(self) -> Hydrostatic:
        """The bearing's geometry."""
        return cast("Hydrostatic", self.bearing.geometry)

    @cached_property
    def lands(self) -> Lands:
        """The lands."""
        return lands_of(self.bearing)

    @cached_property
    def _bearing(self) -> Bearing:
        return bearing_with(self.bearing, coarse=self._coarse)

    def balance(self, points: OperatingPoints) -> tuple[Balance, Array]:
        """Return the equilibria at operating points, flattened to (n,), and μΩ(R/C)²/p_s.

        Raises
        ------
        ValueError
            Where the load is too heavy for the supply pressure.
        """
        one, p_s = self.bearing, self.shape.supply_pressure
        number = points.viscosity * points.speed * (one.radius / one.radial_clearance) ** 2 / p_s
        load = points.load / (p_s * one.radius * one.length)
        S, W, _ = np.broadcast_arrays(number, load, points.sommerfeld)
        self._check(W)
        try:
            found = _balanced(self._bearing, S.tobytes(), W.tobytes())
        except RuntimeError as error:
            raise ValueError(
                f"static load = {np.max(points.load):.4g} N: on recesses supplied at "
                f"{p_s:.4g} Pa no equilibrium was found in which the smallest film is at "
                f"least {THINNEST} of the clearance"
            ) from error
        return found, S.ravel()

    def _check(self, W: Array) -> None:
        heaviest = self._bearing.heaviest
        if W.size and W.max() > heaviest:
            one, p_s = self.bearing, self.shape.supply_pressure
            unit = p_s * one.radius * one.length
            raise ValueError(
                f"static load = {W.max() * unit:.4g} N: must be at most {heaviest * unit:.4g} N on "
                f"recesses supplied at {p_s:.4g} Pa; a heavier load presses the journal onto the "
                "land at rest or at a low speed, as the recess under it is at nearly the supply "
                f"pressure. A supply at {_above(p_s * W.max() / heaviest):.4g} Pa or more "
                "carries it"
            )

    def state(self, points: OperatingPoints) -> FilmState:
        """Return the film in static equilibrium.

        Raises
        ------
        ValueError
            Where the load is too heavy for the supply pressure.
        """
        found, S = self.balance(points)
        shape = _shape(points)
        dynamic, (drag, flow) = self.dynamics(points), self.drag_and_flow(points)
        highest = self.extremes(points)
        position = found.position.reshape(*shape, 2)
        return FilmState(
            sommerfeld=np.broadcast_to(points.sommerfeld, shape),
            position=position,
            attitude_angle=_direction(position, dynamic.stiffness),
            minimum_thickness=self.gap(position),
            stiffness=dynamic.stiffness,
            damping=dynamic.damping,
            side_flow=flow,
            drag=drag,
            peak_pressure=(self._slender / S * highest.highest).reshape(shape),
            peak_angle=highest.angle.reshape(shape),
        )

    @property
    def _slender(self) -> float:
        """(R/L)²: p_s over S is μΩ(R/C)², the film's units have L for R."""
        return (self.bearing.radius / self.bearing.length) ** 2

    def extremes(self, points: OperatingPoints) -> Extremes:
        """Return the highest and the lowest pressure at operating points, in p_s, (n,)."""
        found, S = self.balance(points)
        return _extremes(self.lands, found, S.tobytes())

    def dynamics(self, points: OperatingPoints) -> FilmDynamics:
        """Return stiffness and damping only.

        Raises
        ------
        ValueError
            Where the load is too heavy for the supply pressure.
        """
        found, S = self.balance(points)
        shape = (*_shape(points), 2, 2)
        return FilmDynamics(
            stiffness=(self._slender / S[:, None, None] * found.stiffness).reshape(shape),
            damping=(self._slender * found.damping).reshape(shape),
            inertia=NO_INERTIA,
        )

    def drag_and_flow(self, points: OperatingPoints) -> tuple[Array, Array]:
        """Return drag and side flow only: what the supply delivers leaves at both ends."""
        found, S = self.balance(points)
        shape = _shape(points)
        W = 4.0 * points.sommerfeld  # S/W = 4σ(R/L)²
        pressure_flow = 0.5 * found.position[:, 1].reshape(shape) / (W * self._slender)
        drag = shear(self.lands, found.position).reshape(shape) + pressure_flow
        return drag, (found.flow.sum(axis=1) / (12.0 * S)).reshape(shape)

    def field(self, points: OperatingPoints, *, angle: ArrayLike, zeta: ArrayLike) -> FilmField:
        """Return thickness and pressure in static equilibrium, recesses included.

        The thickness is that of the lands' film; a recess is much deeper.

        Raises
        ------
        ValueError
            Where ζ lies outside the bearing, or the load is too heavy for the supply pressure.
        """
        angle, zeta = np.asarray(angle, dtype=float), np.asarray(zeta, dtype=float)
        if not np.all(np.abs(zeta) <= 0.5):
            raise ValueError("zeta = z/L: must lie within the bearing, -0.5 to 0.5")
        found, S = self.balance(points)
        shape = np.broadcast_shapes(_shape(points), angle.shape, zeta.shape)
        which = np.broadcast_to(np.arange(len(S)).reshape(_shape(points)), shape)
        angle, zeta = np.broadcast_to(angle, shape), np.broadcast_to(zeta, shape)
        grid = mesh(self.lands, SHOWN)
        nodes = nodal(grid, found, S) * (self._slender / S[:, None, None])
        pressure = np.empty(shape)
        for k in range(len(S)):
            here = which == k
            pressure[here] = pressure_at(grid, nodes[k], angle[here], zeta[here])
        x, y = found.position[which, 0], found.position[which, 1]
        return FilmField(
            angle=angle,
            zeta=zeta,
            thickness=1.0 - x * np.cos(angle) - y * np.sin(angle),
            pressure=pressure,
            cavitated=np.zeros(shape, dtype=bool),
        )

    def added_mass(self, points: OperatingPoints) -> Array:  # noqa: ARG002 - the seam's
        """Refuse: the added mass of lands and recesses is not computed."""
        raise ValueError(
            "bearing: the added mass of lands and recesses is not computed; that of a short plain "
            "bearing is"
        )

    def lowest_pressure(
        self, *, place: Array, velocity: Array, viscosity: Array, speed: Array
    ) -> Array:
        """Return the lowest pressure of the film around moving journals, (n,).

        Parameters
        ----------
        place, velocity : array, (n, 2)
            Of the journals, in C and CΩ.
        viscosity, speed : array, (n,)
            μ [Pa·s] and Ω [rad/s].

        Returns
        -------
        array, (n,)
            Above ambient [Pa], at most 0.
        """
        moving = self._moving
        S = np.array([moving.number(*one) for one in zip(viscosity, speed, strict=True)])
        rows = zip(
            np.concatenate([place, velocity], axis=1).tolist(), viscosity, speed, strict=True
        )
        P = np.array([moving.recess_pressure(tuple(at), mu, omega) for at, mu, omega in rows])
        lowest = extremes(self.lands, At(place, P), S, velocity).lowest
        return self.shape.supply_pressure * lowest

    @cached_property
    def _moving(self) -> RecessesInMotion:
        return RecessesInMotion(self.bearing, coarse=self._coarse)

    def motion(self) -> InnerMotion:
        """Return the force on a moving journal; at each instant the recesses' flows balance.

        It has no inner states, but depends on viscosity and speed over the supply pressure.
        """
        moving = RecessesInMotion(self.bearing, coarse=self._coarse)
        return InnerMotion(
            states=0,
            rest=moving.rest,
            force=moving.force,
            velocity=moving.velocity,
            thinnest=THINNEST,
        )

    @property
    def _finer(self) -> Bearing:
        return bearing_of(finer(self.lands), self._bearing.restrictors)

    def accuracy(self, sommerfeld: float) -> Accuracy:
        """Return the table's mesh, and its distance from one with half as large cells.

        At a third of the heaviest load; the speed, against the supply, is that of σ.
        """
        made = self._bearing.table
        W = np.array([_A_THIRD * self._bearing.heaviest])
        S = 4.0 * W * min(sommerfeld, 1e9) * self._slender
        one, other = balanced(self._bearing, S, W), balanced(self._finer, S, W)
        cells = made.cells
        return Accuracy(
            f"{cells.recess} and {2 * cells.recess} cells over each recess, {cells.land} and "
            f"{2 * cells.land} over each land, extrapolated, at {made.positions} positions of the "
            "journal",
            place=float(np.hypot(*(one.position - other.position)[0])),
            stiffness=_apart(one.stiffness, other.stiffness),
            damping=_apart(one.damping, other.damping),
        )

    def gap(self, position: ArrayLike) -> Array:
        """Return the minimum film thickness, 1 − ε."""
        place = np.asarray(position, dtype=float)
        return 1.0 - np.hypot(place[..., 0], place[..., 1])

    def outline(self, angle: ArrayLike) -> Array:
        """Return the clearance circle, of radius 1."""
        return vector(np.cos(angle), np.sin(angle))


@dataclass(frozen=True)
class CoarseHydrostaticFilm(HydrostaticFilm):
    """The same on a mesh so coarse that C is known to some 1 % only: for drafts."""

    _coarse: ClassVar[bool] = True


# A sweep asks state, coefficients and flow at the same points one after another.
@functools.lru_cache(maxsize=64)
def _balanced(bearing: Bearing, S: bytes, load: bytes) -> Balance:
    return balanced(bearing, np.frombuffer(S), np.frombuffer(load))


# Of the same equilibria: a sweep's state asks, and then the check of its validity.
@functools.lru_cache(maxsize=16)
def _extremes(lands: Lands, found: Balance, S: bytes) -> Extremes:
    return extremes(lands, found, np.frombuffer(S))


def _shape(points: OperatingPoints) -> tuple[int, ...]:
    return np.broadcast_shapes(
        points.sommerfeld.shape, points.viscosity.shape, points.speed.shape, points.load.shape
    )


def _direction(position: Array, K: Array) -> Array:
    """Return the direction of positions, at the centre that in which a small load moves it."""
    x, y = position[..., 0], position[..., 1]
    limit = np.arctan2(-K[..., 1, 0], K[..., 1, 1])
    return np.where(np.hypot(x, y) < 1e-12, limit, np.arctan2(y, x))


def _above(pressure: float) -> float:
    """Return a pressure rounded up to three digits."""
    digit = 10.0 ** (math.floor(math.log10(pressure)) - 2)
    return math.ceil(pressure / digit) * digit


def _apart(one: Array, other: Array) -> float:
    return float(np.abs(one - other).max() / np.abs(other).max())
