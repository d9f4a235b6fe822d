"""The film of a fixed bore of finite length as a film model (interface in `films.model`)."""

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.dynamics import NO_INERTIA, FilmDynamics
from rotorcalc.films.finite.accuracy import accuracy
from rotorcalc.films.finite.circle import (
    CIRCLE_REVOLUTION,
    CIRCLE_SECONDS,
    CircleInMotion,
    is_circle,
)
from rotorcalc.films.finite.direct_motion import SOLVED_REVOLUTION, SolvedPadsInMotion
from rotorcalc.films.finite.motion import APART, REVOLUTION, SECONDS, THINNEST, FinitePadsInMotion
from rotorcalc.films.finite.pressure import Pressures
from rotorcalc.films.finite.sources import SOURCES
from rotorcalc.films.finite.table import FilmTable, table
from rotorcalc.films.model import Accuracy, FilmMotion, Limit, Source
from rotorcalc.films.pads import gap, have_pockets, outline, pads_of, walls_of
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.machine import JournalBearing


@dataclass(frozen=True)
class FiniteFilm:
    """The film of one bearing of finite length, from the table of its bore.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing; its bore and L/D enter, and of a dam depth over clearance.
    """

    bearing: JournalBearing

    inner: int = field(default=0, init=False)
    frequency_dependent: bool = field(default=False, init=False)
    can_whirl: bool = field(default=True, init=False)
    _coarse: ClassVar[bool] = False

    @cached_property
    def _table(self) -> FilmTable:
        ratio = self.bearing.diameter / self.bearing.length
        return table(pads_of(self.bearing), ratio**2, coarse=self._coarse)

    @property
    def curve(self) -> Hashable:
        """The mesh, the bore's pads and L/D."""
        ratio = self.bearing.diameter / self.bearing.length
        return "coarse" if self._coarse else "finite", pads_of(self.bearing), ratio

    @property
    def sommerfeld_range(self) -> tuple[float, float]:
        """σ of the table's heaviest load, and of its lightest, which hardly moves the journal."""
        return self._table.least_sommerfeld, self._table.lightest_sommerfeld

    @property
    def least_sommerfeld(self) -> float:
        """σ of the table's heaviest load."""
        return self._table.least_sommerfeld

    @property
    def sources(self) -> Mapping[str, Source]:
        """What was solved."""
        return SOURCES

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Depth of a pocket: the film in it is taken as laminar and without inertia."""
        depth = max(pad.depth for pad in pads_of(self.bearing))
        if depth == 0.0:
            return ()
        return (
            Limit(
                "Depth of the pocket over clearance, d/C", depth, 5.0, 10.0,
                "in a deep pocket the flow is turbulent and its inertia counts",
            ),
        )  # fmt: skip

    def state(self, points: OperatingPoints) -> FilmState:
        """Return the film in static equilibrium.

        Raises
        ------
        ValueError
            Where the load is heavier than the table's heaviest.
        """
        found = self._table
        row = found.row(points.sommerfeld)
        K, C = found.coefficients(points.sommerfeld)
        return FilmState(
            sommerfeld=points.sommerfeld,
            position=row.position,
            attitude_angle=found.direction(row.position),
            minimum_thickness=gap(found.mesh.pads, row.position),
            stiffness=K,
            damping=C,
            side_flow=row.side_flow,
            drag=row.drag,
            peak_pressure=row.peak_pressure,
            peak_angle=row.peak_angle,
        )

    def place_and_flow(self, sommerfeld: Array) -> tuple[Array, Array]:
        """Return the journal's centre at σ, (..., 2), in C, and the side flow: of `state` alone."""
        return self._table.place_and_flow(sommerfeld)

    def dynamics(self, points: OperatingPoints) -> FilmDynamics:
        """Return stiffness and damping only."""
        K, C = self._table.coefficients(points.sommerfeld)
        return FilmDynamics(stiffness=K, damping=C, inertia=NO_INERTIA)

    def drag_and_flow(self, points: OperatingPoints) -> tuple[Array, Array]:
        """Return drag and side flow only."""
        return self._table.drag_and_flow(points.sommerfeld)

    def field(self, points: OperatingPoints, *, angle: ArrayLike, zeta: ArrayLike) -> FilmField:
        """Return thickness and pressure in static equilibrium; NaN where there is no pad.

        Raises
        ------
        ValueError
            Where ζ lies outside the bearing.
        """
        sigma, angle, zeta = np.broadcast_arrays(points.sommerfeld, angle, zeta)
        if not np.all(np.abs(zeta) <= 0.5):
            raise ValueError("zeta = z/L: must lie within the bearing, -0.5 to 0.5")
        shape = sigma.shape
        thickness, pressure = np.full(shape, np.nan), np.zeros(shape)
        cavitated: BoolArray = np.zeros(shape, dtype=bool)
        for each in np.unique(sigma):
            here = sigma == each
            solved = self._pressures(float(each))
            thickness[here], pressure[here], cavitated[here] = solved.at(angle[here], zeta[here])
        return FilmField(
            angle=angle, zeta=zeta, thickness=thickness, pressure=pressure, cavitated=cavitated
        )

    def _pressures(self, sigma: float) -> Pressures:
        """Return the pressures on the mesh at one operating point."""
        found = self._table
        position = found.row(np.array(sigma)).position
        nearest = np.abs(np.log(found.load * 4.0 * min(sigma, 1e300))).argmin()
        return Pressures.at_position(found.mesh, position, found.wet[nearest])

    def added_mass(self, points: OperatingPoints) -> Array:  # noqa: ARG002 - the seam's
        """Refuse: the added mass of a finite film is not computed."""
        raise ValueError(
            "film = 'finite': the added mass is not computed; that of a short plain bearing is"
        )

    def motion(self) -> FilmMotion:
        """Return the force on a moving journal, and its inverse, in plain floats."""
        if have_pockets(pads_of(self.bearing)):
            solved = SolvedPadsInMotion(self.bearing)
            return FilmMotion(
                force=solved.force,
                velocity=solved.velocity,
                thinnest=THINNEST,
                revolution=SOLVED_REVOLUTION,
                apart=0.012,
            )
        if is_circle(self.bearing):
            circle = CircleInMotion(self.bearing)
            return FilmMotion(
                force=circle.force,
                velocity=circle.velocity,
                thinnest=THINNEST,
                tables=(circle.shape,),
                seconds=CIRCLE_SECONDS,
                revolution=CIRCLE_REVOLUTION,
                apart=APART,
            )
        moving = FinitePadsInMotion(self.bearing)
        return FilmMotion(
            force=moving.force,
            velocity=moving.velocity,
            thinnest=THINNEST,
            tables=moving.shapes,
            seconds=SECONDS * len(moving.shapes),
            revolution=REVOLUTION,
            apart=APART,
        )

    def accuracy(self, sommerfeld: float) -> Accuracy:
        """Return the table's mesh, and its distance from a solution on a finer one."""
        return accuracy(self._table, sommerfeld)

    def gap(self, position: ArrayLike) -> Array:
        """Return the smallest distance from the journal to the bore."""
        return gap(walls_of(self.bearing), position)

    def outline(self, angle: ArrayLike) -> Array:
        """Return where the journal's centre touches the bore."""
        return outline(walls_of(self.bearing), angle)


@dataclass(frozen=True)
class CoarseFilm(FiniteFilm):
    """The same on a mesh so coarse that K and C are known to some 4 % only: for drafts."""

    _coarse: ClassVar[bool] = True
