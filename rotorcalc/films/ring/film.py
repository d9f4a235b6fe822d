"""The floating ring as a film model (interface in `films.model`)."""

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array
from rotorcalc.films.dynamics import FilmDynamics
from rotorcalc.films.finite import APART, CIRCLE_SECONDS, THINNEST
from rotorcalc.films.model import Accuracy, InnerMotion, Limit, Source
from rotorcalc.films.ring import balance
from rotorcalc.films.ring.motion import REVOLUTION, RingInMotion
from rotorcalc.films.ring.pair import Pair
from rotorcalc.films.ring.series import in_series, synchronous
from rotorcalc.films.ring.sources import SOURCES
from rotorcalc.films.ring.starts import RingStarts, thinnest
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.films.units import FilmUnits
from rotorcalc.frames import vector
from rotorcalc.machine import JournalBearing

# How far above the heaviest load's σ a range of them begins. The ring's speed goes as the fourth
# power of that distance: closer, K of a short outer film spans more decades than numbers have.
_TURNING = 1e-3


@dataclass(frozen=True)
class RingFilm:
    """Two plain films with a ring between them, whose place is two inner coordinates.

    The ring keeps its speed of rotation in a small motion: its spin is slow to change.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing; its geometry is a floating ring.
    """

    bearing: JournalBearing

    inner: int = field(default=2, init=False)
    frequency_dependent: bool = field(default=True, init=False)
    can_whirl: bool = field(default=True, init=False)

    @cached_property
    def pair(self) -> Pair:
        """The two films."""
        return Pair(self.bearing)

    @property
    def curve(self) -> Hashable:
        """The ratios of the two films; None with a mass, whose inertia goes with the speed."""
        pair = self.pair
        if pair.ring.ring_mass > 0.0:
            return None
        # The short film has one curve over σ for every L/D.
        shape = None if self.bearing.model == "short" else self._outer_length
        ratios = pair.force, pair.shear, pair.wider, pair.slenderness
        return "floating ring", self.bearing.model, ratios, shape

    @property
    def least_sommerfeld(self) -> float:
        """σ of the heaviest load that both films carry while the ring turns."""
        return self._least

    @cached_property
    def _least(self) -> float:
        return balance.least_sommerfeld(self.pair)

    @property
    def sommerfeld_range(self) -> tuple[float, float]:
        """σ at which either film may begin to feed a whirl, and at which both are light.

        At the heaviest load itself the ring does not turn, and its outer film has no finite K.
        """
        r = balance.unloaded(self.pair)
        fastest = np.array([1.0 + r, self.pair.force * r])
        ranges = self.pair.inside.sommerfeld_range, self.pair.outside.sommerfeld_range
        heavy, light = np.array(ranges).T / fastest
        turning = (1.0 + _TURNING) * self.least_sommerfeld
        return max(turning, float(heavy.min())), float(light.max())

    @property
    def sources(self) -> Mapping[str, Source]:
        """What the two films are, and how they are put together."""
        return SOURCES

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Length over diameter of both films, where they are short ones."""
        if self.bearing.model != "short":
            return ()
        ratios = {
            "Length over diameter, L/D": self.bearing.length / self.bearing.diameter,
            "Length over diameter of the outer film": self._outer_length,
        }
        return tuple(
            Limit(
                name, ratio, 0.5, 1.0,
                "the short bearing neglects the circumferential pressure flow; it overestimates "
                "the force of longer bearings",
            )
            for name, ratio in ratios.items()
        )  # fmt: skip

    @property
    def _outer_length(self) -> float:
        """L/D of the outer film."""
        return 0.5 * self.pair.ring.outer_length / self.pair.ring.outer_radius

    def speed_ratio(self, points: OperatingPoints) -> Array:
        """Return the speed of the ring over that of the journal, r = Ω_R/Ω [-], (...).

        Raises
        ------
        ValueError
            Where the load is so heavy that a film does not carry it or the ring does not turn.
        """
        sigma = np.asarray(points.sommerfeld, dtype=float)
        if sigma.size and (least := sigma.min()) < self.least_sommerfeld * (1.0 - 1e-12):
            raise ValueError(
                f"sommerfeld = {least:.4g}: must be at least {self.least_sommerfeld:.4g} with this "
                "ring; a heavier load presses a surface through its film, or stops the ring"
            )
        return balance.speed_ratio(self.pair, sigma)

    def films_at(self, points: OperatingPoints) -> tuple[Array, Array, Array]:
        """Return r, and σ of the inner and of the outer film, each (...)."""
        ratio = self.speed_ratio(points)
        return ratio, *self.pair.sommerfeld(points.sommerfeld, ratio)

    def states(self, points: OperatingPoints) -> tuple[FilmState, FilmState]:
        """Return the inner and the outer film in static equilibrium, each in its own units.

        Of μ_i, Ω + Ω_R, R, L, C inside, and of μ_o, Ω_R, R_o, L_o, C_o outside.
        """
        _, inner, outer = self.films_at(points)
        inside = self.pair.inside.state(replace(points, sommerfeld=inner))
        return inside, self.pair.outside.state(replace(points, sommerfeld=outer))

    def state(self, points: OperatingPoints) -> FilmState:
        """Return the film in static equilibrium; pressure and its place are the inner film's.

        Raises
        ------
        ValueError
            Where the load is so heavy that a film does not carry it or the ring does not turn.
        """
        ratio, inner, outer = self.films_at(points)
        inside, outside = self.pair.states(points, inner, outer)
        place, place_o = inside.position, outside.position
        position = place + self.pair.wider * place_o
        matrices = self._matrices(ratio, inside, outside)
        K, C = synchronous(*matrices, self._mass(points))
        # At the centre the direction is its limit, which is that of either film.
        centred = np.hypot(position[..., 0], position[..., 1]) < 1e-12
        direction = np.arctan2(position[..., 1], position[..., 0])
        return FilmState(
            sommerfeld=points.sommerfeld,
            position=position,
            attitude_angle=np.where(centred, inside.attitude_angle, direction),
            minimum_thickness=np.minimum(thinnest(place), self.pair.wider * thinnest(place_o)),
            stiffness=K,
            damping=C,
            side_flow=self._flow(ratio, inside.side_flow, outside.side_flow),
            drag=self._drag(points.sommerfeld, ratio, place),
            peak_pressure=(1.0 + ratio) * inside.peak_pressure,
            peak_angle=inside.peak_angle,
        )

    def dynamics(self, points: OperatingPoints) -> FilmDynamics:
        """Return stiffness and damping of journal and ring, and the ring's mass."""
        ratio, inner, outer = self.films_at(points)
        K, C = self._matrices(ratio, *self.pair.dynamics(points, inner, outer))
        return FilmDynamics(K, C, np.full(2, self.pair.ring.ring_mass))

    def drag_and_flow(self, points: OperatingPoints) -> tuple[Array, Array]:
        """Return the drag on the journal, which makes the loss of both films, and their flow."""
        ratio, inner, outer = self.films_at(points)
        place, _, *flows = self.pair.places_and_flows(inner, outer)
        return self._drag(points.sommerfeld, ratio, place), self._flow(ratio, *flows)

    def _matrices(
        self, ratio: Array, inside: FilmState | FilmDynamics, outside: FilmState | FilmDynamics
    ) -> tuple[Array, Array]:
        """Return stiffness and damping of journal and ring, (..., 4, 4), in film units."""
        r, unit = ratio[..., None, None], self.pair.force / self.pair.wider
        K = in_series((1.0 + r) * inside.stiffness, unit * r * outside.stiffness)
        return K, in_series(inside.damping, unit * outside.damping)

    def _mass(self, points: OperatingPoints) -> Array:
        """Return the ring's mass times Ω² over the unit of stiffness, (...)."""
        unit = FilmUnits(self.bearing, points.viscosity, points.speed).stiffness
        mass = self.pair.ring.ring_mass * points.speed**2 / unit
        return np.broadcast_to(mass, np.shape(points.sommerfeld))

    def _drag(self, sigma: Array, ratio: Array, place: Array) -> Array:
        """Return the torque on the journal: what turns the ring, and the inner film's couple."""
        load = self.pair.slenderness / (4.0 * sigma)
        return (1.0 - ratio) * balance.shear(place) + 0.5 * load * place[..., 1]

    def _flow(self, ratio: Array, inner: Array, outer: Array) -> Array:
        return (1.0 + ratio) * inner + self.pair.flow * ratio * outer

    def field(self, points: OperatingPoints, *, angle: ArrayLike, zeta: ArrayLike) -> FilmField:
        """Return thickness and pressure of the inner film in static equilibrium.

        Raises
        ------
        ValueError
            Where ζ lies outside the bearing.
        """
        ratio, inner, _ = self.films_at(points)
        found = self.pair.inside.field(
            replace(points, sommerfeld=inner), angle=np.asarray(angle), zeta=np.asarray(zeta)
        )
        return replace(found, pressure=(1.0 + ratio) * found.pressure)

    def added_mass(self, points: OperatingPoints) -> Array:  # noqa: ARG002 - the seam's
        """Refuse: the added mass of two films in series is not computed."""
        raise ValueError(
            "bearing: the added mass of a floating ring's films is not computed; that of a short "
            "plain bearing is"
        )

    def motion(self) -> InnerMotion:
        """Return the force on a moving journal and the motion of the ring."""
        return self._motion(0.0)

    def _motion(self, load: float) -> InnerMotion:
        moving, starts = RingInMotion(self.pair, load), RingStarts(self.pair)
        closed_form = self.bearing.model == "short"
        return InnerMotion(
            states=moving.states,
            rest=starts.rest,
            force=moving.force,
            velocity=moving.velocity,
            loaded=self._motion,
            beside=starts.beside,
            gap=starts.gap,
            share=starts.share,
            forces=moving.forces,
            smooth=moving.smooth,
            thinnest=0.0 if closed_form else THINNEST,
            tables=moving.shapes or None,
            seconds=CIRCLE_SECONDS * len(moving.shapes),
            revolution=0.0 if closed_form else REVOLUTION,
            apart=0.0 if closed_form else APART,
        )

    def accuracy(self, sommerfeld: float) -> Accuracy | None:
        """Return the distance of both films' tables from finer solutions; None for short films."""
        points = OperatingPoints.at_sommerfeld(self.bearing, sommerfeld)
        _, inner, outer = self.films_at(points)
        one, other = (
            self.pair.inside.accuracy(float(inner)),
            self.pair.outside.accuracy(float(outer)),
        )
        if one is None or other is None:
            return None
        return Accuracy(
            mesh=f"each film: {one.mesh}",
            place=one.place + self.pair.wider * other.place,
            stiffness=max(one.stiffness, other.stiffness),
            damping=max(one.damping, other.damping),
        )

    def gap(self, position: ArrayLike) -> Array:
        """Return how far the journal is from pressing through both films, 1 + C_o/C − |place|.

        The ring moves out of its way until the outer film is closed too.
        """
        place = np.asarray(position, dtype=float)
        return 1.0 + self.pair.wider - np.hypot(place[..., 0], place[..., 1])

    def outline(self, angle: ArrayLike) -> Array:
        """Return the circle of both clearances together."""
        return (1.0 + self.pair.wider) * vector(np.cos(angle), np.sin(angle))
