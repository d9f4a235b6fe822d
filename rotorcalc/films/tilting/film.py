"""The film of a tilting-pad bearing as a film model (interface in `films.model`)."""

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar, cast

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.dynamics import FilmDynamics, reduced
from rotorcalc.films.finite.pressure import Pressures
from rotorcalc.films.finite.reynolds import mesh
from rotorcalc.films.model import Accuracy, InnerMotion, Limit, Source
from rotorcalc.films.pads import gap
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.films.tilting import linear, pivots
from rotorcalc.films.tilting.accuracy import accuracy
from rotorcalc.films.tilting.family import PadFamily, family
from rotorcalc.films.tilting.flexure import FlexurePads
from rotorcalc.films.tilting.motion import HEAVY_REVOLUTION, REVOLUTION, SECONDS, PadsInMotion
from rotorcalc.films.tilting.pivots import Pivots, pivots_of
from rotorcalc.films.tilting.rest import FreePads, Rest, Resting
from rotorcalc.films.tilting.words import SOURCES
from rotorcalc.films.units import FilmUnits
from rotorcalc.geometry import TiltingPads
from rotorcalc.machine import JournalBearing

# Share of the film over its pivot below which a pad at rest is in the journal's way.
_HALF = 0.5


@dataclass(frozen=True)
class TiltingFilm:
    """The film of one bearing of tilting pads of finite length.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing.
    """

    bearing: JournalBearing

    frequency_dependent: bool = field(default=True, init=False)
    # Massless pads are no springs alone: lightly loaded ones may drive a slow whirl.
    can_whirl: bool = field(default=True, init=False)
    _coarse: ClassVar[bool] = False

    @property
    def _shape(self) -> TiltingPads:
        return cast("TiltingPads", self.bearing.geometry)

    @cached_property
    def _pivots(self) -> Pivots:
        return pivots_of(self.bearing)

    @property
    def _slenderness(self) -> float:
        return (self.bearing.diameter / self.bearing.length) ** 2

    @cached_property
    def _family(self) -> PadFamily:
        one = self._pivots
        return family(one.arc, one.offset, self._slenderness, coarse=self._coarse)

    @cached_property
    def _pads(self) -> Resting:
        if self._shape.rotational_stiffness > 0.0:
            return FlexurePads(self._pivots, self._slenderness, self._coarse)
        return FreePads.of(self._pivots, self._slenderness, coarse=self._coarse)

    @property
    def inner(self) -> int:
        """Number of pads: each has its tilt."""
        return self._pivots.number

    @property
    def curve(self) -> Hashable:
        """The mesh, the pads and L/D; pads with inertia or a stiffness depend on more than σ."""
        shape = self._shape
        if shape.pad_inertia > 0.0 or shape.rotational_stiffness > 0.0:
            return None
        return "tilting", self._coarse, self._pivots, self._slenderness

    @property
    def sommerfeld_range(self) -> tuple[float, float]:
        """σ of the heaviest load, and of one that hardly moves the journal."""
        return self.least_sommerfeld, self._pads.lightest_sommerfeld

    @property
    def least_sommerfeld(self) -> float:
        """σ at which the thinnest film is 3 % of the clearance."""
        return 0.25 / self._pads.heaviest

    @property
    def sources(self) -> Mapping[str, Source]:
        """What was solved."""
        return SOURCES

    @property
    def limits(self) -> tuple[Limit, ...]:
        """None of the bearing alone; where pads carry nothing the state says so."""
        return ()

    def _rest(self, points: OperatingPoints) -> Rest:
        load = 0.25 / np.asarray(points.sommerfeld, dtype=float)
        least = self.least_sommerfeld
        if load.size and load.max() > 0.25 / least * (1.0 + 1e-9):
            raise ValueError(
                f"sommerfeld = {0.25 / load.max():.4g}: must be at least {least:.4g} on these "
                "pads; there a film is 0.03 of the clearance thin, or the last pad beside the load "
                "line gives up its film and nothing holds the journal across"
            )
        return self._pads.at(load, np.broadcast_to(self._stiffness(points), load.shape))

    def _stiffness(self, points: OperatingPoints) -> Array:
        """Return κ of the pivots, in units of the film, (...)."""
        unit = FilmUnits(self.bearing, points.viscosity, points.speed).stiffness
        return np.asarray(self._shape.rotational_stiffness / (self.bearing.radius**2 * unit))

    def state(self, points: OperatingPoints) -> FilmState:
        """Return the film in static equilibrium, its coefficients in synchronous motion.

        Raises
        ------
        ValueError
            Where the load is heavier than the heaviest.
        """
        rest = self._rest(points)
        K, C = self._synchronous(rest, points)
        pads, position = rest.pads, rest.position
        highest = pads.peak_pressure.argmax(axis=-1)[..., None]
        angle = np.take_along_axis(self._pivots.angle + pads.peak_angle, highest, axis=-1)
        return FilmState(
            sommerfeld=points.sommerfeld,
            position=position,
            attitude_angle=np.arctan2(position[..., 1], position[..., 0]),
            minimum_thickness=pads.thinnest.min(axis=-1),
            stiffness=K,
            damping=C,
            side_flow=pads.side_flow.sum(axis=-1),
            drag=pads.drag.sum(axis=-1),
            peak_pressure=np.take_along_axis(pads.peak_pressure, highest, axis=-1)[..., 0],
            peak_angle=angle[..., 0],
            unloaded_pads=~pads.loaded,
        )

    def _synchronous(self, rest: Rest, points: OperatingPoints) -> tuple[Array, Array]:
        """Return stiffness and damping with the tilts eliminated at running speed."""
        found = self._dynamics(rest, points)
        units = FilmUnits(self.bearing, points.viscosity, points.speed)
        k, c = (np.asarray(unit)[..., None, None] for unit in (units.stiffness, units.damping))
        whole = FilmDynamics(found.stiffness * k, found.damping * c, found.inertia)
        K, C = reduced(whole, np.broadcast_to(points.speed, np.shape(points.sommerfeld)))
        return K / k, C / c

    def _dynamics(self, rest: Rest, points: OperatingPoints) -> FilmDynamics:
        inertia = self._shape.pad_inertia / self.bearing.radius**2
        return linear.dynamics(rest, self._pivots.frames, self._stiffness(points), inertia)

    def dynamics(self, points: OperatingPoints) -> FilmDynamics:
        """Return stiffness, damping and inertia of journal and tilts, these as displacements δ R.

        A pad without load is held by a spring and a damper of its own, which act on nothing else.
        """
        return self._dynamics(self._rest(points), points)

    def tilts(self, points: OperatingPoints) -> Array:
        """Return the tilt of each pad at rest [rad], (..., N)."""
        return self._rest(points).tilt * self.bearing.radial_clearance / self.bearing.radius

    def other_films(self, points: OperatingPoints) -> BoolArray:
        """Return which pads could have another film where the journal stands, (..., N)."""
        rest, pads = self._rest(points), self._pads
        if not isinstance(pads, FlexurePads):  # of a free pad the other film does not hold it
            return np.zeros(rest.tilt.shape, dtype=bool)
        kappa = np.broadcast_to(self._stiffness(points), rest.tilt.shape[:-1])
        return pads.other_films(rest, kappa)

    def drag_and_flow(self, points: OperatingPoints) -> tuple[Array, Array]:
        """Return drag and side flow only."""
        pads = self._rest(points).pads
        return pads.drag.sum(axis=-1), pads.side_flow.sum(axis=-1)

    def field(self, points: OperatingPoints, *, angle: ArrayLike, zeta: ArrayLike) -> FilmField:
        """Return thickness and pressure in static equilibrium; NaN where there is no pad.

        Raises
        ------
        ValueError
            Where ζ lies outside the bearing.
        """
        angle, zeta, _ = np.broadcast_arrays(angle, zeta, points.sommerfeld)
        if not np.all(np.abs(zeta) <= 0.5):
            raise ValueError("zeta = z/L: must lie within the bearing, -0.5 to 0.5")
        thickness, pressure = np.full(angle.shape, np.nan), np.zeros(angle.shape)
        cavitated: BoolArray = np.zeros(angle.shape, dtype=bool)
        rest = self._rest(points)
        keys = np.concatenate([rest.position, rest.tilt], axis=-1)
        where, each = np.unique(keys.reshape(-1, keys.shape[-1]), axis=0, return_inverse=True)
        number = np.broadcast_to(each.reshape(keys.shape[:-1]), angle.shape)
        for i, (position, tilt) in enumerate(zip(where[:, :2], where[:, 2:], strict=True)):
            here = number == i
            solved = self._pressures(position, tilt)
            thickness[here], pressure[here], cavitated[here] = solved.at(angle[here], zeta[here])
        return FilmField(
            angle=angle, zeta=zeta, thickness=thickness, pressure=pressure, cavitated=cavitated
        )

    def _pressures(self, position: Array, tilt: Array) -> Pressures:
        """Return the pressures of pads at tilts (N,), where the journal is at a position (2,)."""
        one = self._family.mesh
        grid = mesh(self._pivots.tilted(tilt), self._slenderness, one.links, one.shape[2])
        return Pressures.at_position(grid, position, np.ones(grid.shape, dtype=bool))

    def added_mass(self, points: OperatingPoints) -> Array:  # noqa: ARG002 - the seam's
        """Refuse: the added mass of the pads' films is not computed."""
        raise ValueError(
            "bearing: the added mass of the pads' films is not computed; that of a short plain "
            "bearing is"
        )

    def motion(self) -> InnerMotion:
        """Return the force on a moving journal with the pads' tilts as states."""
        moving = PadsInMotion(self.bearing)
        return InnerMotion(
            states=moving.states,
            rest=self._resting_states,
            force=moving.force,
            velocity=moving.velocity,
            beside=self._states_beside,
            gap=self._gap_of_states,
            tables=(moving.shape,),
            seconds=SECONDS,
            revolution=REVOLUTION if self._shape.pad_inertia == 0.0 else HEAVY_REVOLUTION,
        )

    def _resting_states(self, points: OperatingPoints) -> Array:
        """Return the tilts at rest, in C, and their rates where pads have inertia."""
        tilt = self._rest(points).tilt
        if self._shape.pad_inertia == 0.0:
            return tilt
        return np.concatenate([tilt, np.zeros_like(tilt)], axis=-1)

    def _states_beside(self, points: OperatingPoints, journal: Array) -> Array:
        """Return the states at rest, or of pads that have tilted for a journal far off.

        Where the tilts at rest would leave it less than half of the film over their pivots.
        """
        rest = self._resting_states(points)
        tilt = rest[..., : self.inner]
        e = pivots.places(self._pivots, journal, tilt)
        last = self._family.last
        follows = self._family.at(np.minimum(e[..., 0], last)).eta - (e[..., 1] - tilt)
        close = gap(self._family.mesh.pads, e) < _HALF * (1.0 - e[..., 0])
        moved = np.where(close, follows, tilt)
        still = np.zeros((*moved.shape[:-1], rest.shape[-1] - self.inner))
        return np.concatenate([moved, still], axis=-1)

    def _gap_of_states(self, journal: Array, states: Array) -> Array:
        """Return the thinnest film at places of the journal and states of the pads."""
        e = pivots.places(self._pivots, journal, states[..., : self.inner])
        return gap(self._family.mesh.pads, e).min(axis=-1)

    def accuracy(self, sommerfeld: float) -> Accuracy:
        """Return the mesh of the pads, and their distance from a solution on a finer one.

        On flexures, that of free pads.
        """
        free = FreePads.of(self._pivots, self._slenderness, coarse=self._coarse)
        return accuracy(free, sommerfeld)

    def gap(self, position: ArrayLike) -> Array:
        """Return the least distance from the journal to a pivot's place on its pad."""
        return pivots.gap(self._pivots, position)

    def outline(self, angle: ArrayLike) -> Array:
        """Return where the journal's centre meets a pivot's place."""
        return pivots.outline(self._pivots, angle)


@dataclass(frozen=True)
class CoarseTiltingFilm(TiltingFilm):
    """The same on a coarse mesh: for drafts."""

    _coarse: ClassVar[bool] = True
