"""The gas film of a foil bearing as a film model (interface in `films.model`)."""

import math
from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar, NoReturn

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from rotorcalc.arrays import Array, real_array
from rotorcalc.films.dynamics import NO_INERTIA, FilmDynamics
from rotorcalc.films.foil.accuracy import accuracy
from rotorcalc.films.foil.equilibrium import raised
from rotorcalc.films.foil.points import Conditions, groups, named, solved_at
from rotorcalc.films.foil.pressure import rise_at, thickness_at
from rotorcalc.films.foil.sources import SOURCES
from rotorcalc.films.foil.table import (
    HEAVIEST,
    HIGHEST_NUMBER,
    LIGHTEST,
    THINNEST,
    FoilShape,
    over_speed,
)
from rotorcalc.films.foil.whirl import RATIOS, Whirl
from rotorcalc.films.model import Accuracy, Limit, Source
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.frames import vector
from rotorcalc.geometry import Foil
from rotorcalc.machine import JournalBearing

# Λ at which ranges and errors are told of that no speed belongs to.
_USUAL_NUMBER = 1.0
# ε beyond which the rough mesh does not place a journal that on the table's lies within 1.
_SURELY = 1.02


@dataclass(frozen=True)
class FoilFilm:
    """The film of one foil bearing, from tables over speed at each load.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing, with a bore of kind "foil".
    """

    bearing: JournalBearing

    inner: int = field(default=0, init=False)
    frequency_dependent: bool = field(default=True, init=False)
    can_whirl: bool = field(default=True, init=False)
    # At any σ there is a load light enough: see `turning_bounds`.
    least_sommerfeld: float = field(default=0.0, init=False)
    _coarse: ClassVar[bool] = False

    @cached_property
    def _bore(self) -> Foil:
        shape = self.bearing.geometry
        if not isinstance(shape, Foil):
            raise ValueError(f"bearing = {shape.kind}: must be a foil bearing")
        return shape

    @cached_property
    def _foil(self) -> FoilShape:
        return FoilShape(
            slenderness=(self.bearing.diameter / self.bearing.length) ** 2,
            compliance=self._bore.compliance(self.bearing.radial_clearance),
            loss_factor=self._bore.loss_factor,
            slit=self._bore.slit,
            coarse=self._coarse,
        )

    @property
    def curve(self) -> Hashable:
        """None: k and c depend on the load and the ambient pressure too, not on σ alone."""
        return None

    @property
    def sommerfeld_range(self) -> tuple[float, float]:
        """σ at Λ = 1 from the heaviest load to a very light one."""
        unit = _USUAL_NUMBER / (12.0 * self._foil.slenderness)
        return unit / HEAVIEST, unit / 1e-3

    @property
    def sources(self) -> Mapping[str, Source]:
        """What was solved."""
        return SOURCES

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Compliance: of so soft a foil the deflection is many times the clearance."""
        return (
            Limit(
                "Compliance of the foil, pₐ/(C k)", self._foil.compliance, 2.0, 5.0,
                "a soft foil deflects by many clearances, and its own bending, which the model "
                "neglects, then counts",
            ),
        )  # fmt: skip

    def turning_bounds(self, load: float) -> tuple[float, float]:
        """Return the least and the largest μΩ [Pa] at which the film has an answer at a load [N].

        Raises
        ------
        ValueError
            Where it carries the load at no speed.
        """
        bearing, p_a = self.bearing, self._bore.ambient_pressure
        unit = p_a * (bearing.radial_clearance / bearing.radius) ** 2 / 6.0  # Λ = μΩ/unit
        W = load / (p_a * bearing.diameter * bearing.length)
        lowest = 0.0 if W < LIGHTEST else over_speed(self._foil, named(W)).ends[0]
        return lowest * unit, HIGHEST_NUMBER * unit

    def state(self, points: OperatingPoints) -> FilmState:
        """Return the film in static equilibrium.

        Raises
        ------
        ValueError
            Below the lift-off speed of a load, and where load or speed are beyond the tables.
        """
        at = self._conditions(points)
        size = len(at.number)
        position, phi = np.empty((size, 2)), np.empty(size)
        drag, flow, peak, angle = np.empty((4, size))
        K, C = np.empty((2, size, 2, 2))
        for group in groups(self._foil, at):
            i, row, unit = group.where, group.table.row(group.place), self._unit(group.number)
            position[i] = group.light[:, None] * row.position
            phi[i] = np.arctan2(row.position[:, 1], row.position[:, 0])
            drag[i], angle[i] = row.drag, row.peak_angle
            flow[i], peak[i] = group.light * row.side_flow, group.light * unit * row.peak_rise
            K[i], C[i] = (
                unit[:, None, None] * each for each in group.table.whirl.synchronous(group.place)
            )
        shape = at.shape
        return FilmState(
            sommerfeld=at.sommerfeld.reshape(shape),
            position=position.reshape(*shape, 2),
            attitude_angle=phi.reshape(shape),
            # That of the undeformed foil, which is the film's at the ends of the bearing.
            minimum_thickness=np.maximum(1.0 - np.hypot(*position.T), 0.0).reshape(shape),
            stiffness=K.reshape(*shape, 2, 2),
            damping=C.reshape(*shape, 2, 2),
            side_flow=flow.reshape(shape),
            drag=drag.reshape(shape),
            peak_pressure=peak.reshape(shape),
            peak_angle=angle.reshape(shape),
        )

    def surely_touches(self, points: OperatingPoints) -> bool:
        """Return whether the journal lies beyond the undeformed foil at one operating point.

        By one equilibrium on the mesh of the search, without a table, so told only where that
        leaves no doubt.
        """
        at = self._conditions(points)
        if at.number[0] > HIGHEST_NUMBER or not LIGHTEST < at.load[0] < HEAVIEST:
            return False
        rough, _ = self._foil.meshes()
        found = raised(rough, self._foil.compliance, at.number, at.load, THINNEST)
        return bool(found.good[0]) and math.hypot(*found.films.position[0]) > _SURELY

    def dynamics(self, points: OperatingPoints) -> FilmDynamics:
        """Return the impedance over the whirl ratio, and stiffness and damping at ν = 1.

        Raises
        ------
        ValueError
            As `state` does.
        """
        at = self._conditions(points)
        values, slopes = np.empty((2, len(at.number), len(RATIOS), 8))
        for group in groups(self._foil, at):
            whirl = group.table.whirl.at(group.place)
            unit = self._unit(group.number)[:, None, None]
            values[group.where], slopes[group.where] = unit * whirl.values, unit * whirl.slopes
        shape = (*at.shape, len(RATIOS), 8)
        whirl = Whirl(values.reshape(shape), slopes.reshape(shape))
        K, C = whirl(np.ones(at.shape))
        return FilmDynamics(K, C, NO_INERTIA, whirl)

    def drag_and_flow(self, points: OperatingPoints) -> tuple[Array, Array]:
        """Return drag and side flow only."""
        at = self._conditions(points)
        drag, flow = np.empty((2, len(at.number)))
        for group in groups(self._foil, at):
            row = group.table.row(group.place)
            drag[group.where], flow[group.where] = row.drag, group.light * row.side_flow
        return drag.reshape(at.shape), flow.reshape(at.shape)

    def field(self, points: OperatingPoints, *, angle: ArrayLike, zeta: ArrayLike) -> FilmField:
        """Return thickness, the foil's deflection included, and pressure in static equilibrium.

        Raises
        ------
        ValueError
            Where ζ lies outside the bearing, and as `state` does.
        """
        number, load, angle, zeta = self._places(points, angle, zeta)
        thickness, pressure = np.empty(angle.shape), np.empty(angle.shape)
        for here, films in solved_at(self._foil, number, load):
            rise = rise_at(films, angle[here], zeta[here])
            thickness[here] = thickness_at(films, angle[here], rise)
            pressure[here] = self._unit(films.number) * rise
        return FilmField(
            angle=angle,
            zeta=zeta,
            thickness=thickness,
            pressure=pressure,
            cavitated=np.zeros(angle.shape, dtype=bool),  # a gas does not break
        )

    def deflection(self, points: OperatingPoints, *, angle: ArrayLike, zeta: ArrayLike) -> Array:
        """Return the foil's deflection in static equilibrium at angles Θ [rad] and ζ, in C.

        Raises
        ------
        ValueError
            As `field` does.
        """
        number, load, angle, zeta = self._places(points, angle, zeta)
        found = np.empty(angle.shape)
        for here, films in solved_at(self._foil, number, load):
            found[here] = films.compliance * np.maximum(
                rise_at(films, angle[here], zeta[here]), 0.0
            )
        return found

    def added_mass(self, points: OperatingPoints) -> NoReturn:  # noqa: ARG002 - the seam's
        """Refuse: a gas has next to no inertia, and its film stores itself in another way."""
        raise ValueError(
            "bearing = foil: a gas film has no added mass worth the name; that it can be squeezed "
            "is in its stiffness and damping, which depend on the whirl's frequency"
        )

    def motion(self) -> NoReturn:
        """Refuse: the pressure itself, which fills and empties, would be the state."""
        raise ValueError(
            "bearing = foil: its force is known in a steady whirl, not in an arbitrary motion: the "
            "film stores gas, and the foil's loss factor is defined at one frequency only"
        )

    def accuracy(self, sommerfeld: float) -> Accuracy:
        """Return the mesh, and how far a finer one is from the answer at σ and Λ = 1."""
        load = _USUAL_NUMBER / (12.0 * sommerfeld * self._foil.slenderness)
        return accuracy(self._foil, _USUAL_NUMBER, named(min(max(load, 1e-3), 1.0)))

    def gap(self, position: ArrayLike) -> Array:
        """Return how far the journal is from where it presses the foil as hard as it may, in C.

        A foil gives way: a journal may lie beyond the bore's radius, ε > 1. Its wall is taken where
        the foil alone, without a film, carries the heaviest load of this model; with a film the
        journal lies further inside.
        """
        return self._wall - np.hypot(*np.moveaxis(real_array("position", position), -1, 0))

    def outline(self, angle: ArrayLike) -> Array:
        """Return the places of that wall, in C."""
        ray = real_array("angle", angle)
        return self._wall * vector(np.cos(ray), np.sin(ray))

    @cached_property
    def _wall(self) -> float:
        """Where a journal at rest presses the foil with the heaviest load, in C."""
        loaded = 2.0 * HEAVIEST * self._foil.compliance

        def over(x: float) -> float:
            # ∫ (x cos β − 1) cos β dβ over the arc of contact, cos β > 1/x.
            half = math.acos(1.0 / x)
            return x * half + math.sin(half) * (x * math.cos(half) - 2.0) - loaded

        return brentq(over, 1.0, 4.0 + 2.0 * loaded)

    def _conditions(self, points: OperatingPoints) -> Conditions:
        return Conditions.of(self.bearing, self._bore, points)

    def _unit(self, number: Array) -> Array:
        """Return p_a over μΩ(L/C)²: of a pressure, and of stiffness and damping in p_a R L/C."""
        return 1.5 * self._foil.slenderness / number

    def _places(
        self, points: OperatingPoints, angle: ArrayLike, zeta: ArrayLike
    ) -> tuple[Array, Array, Array, Array]:
        """Return Λ, W, Θ and ζ at places around the bearing, of one shape."""
        at = self._conditions(points)
        number, load = at.number.reshape(at.shape), at.load.reshape(at.shape)
        number, load, angle, zeta = np.broadcast_arrays(
            number, load, np.asarray(angle, float), np.asarray(zeta, float)
        )
        if not np.all(np.abs(zeta) <= 0.5):
            raise ValueError("zeta = z/L: must lie within the bearing, -0.5 to 0.5")
        return number, load, angle, zeta


@dataclass(frozen=True)
class CoarseFoilFilm(FoilFilm):
    """The same on a coarse mesh: for drafts."""

    _coarse: ClassVar[bool] = True
