"""The two films of a floating ring, each a plain film of its own, in the units of the bearing.

Of a plain film between two turning surfaces the wedge is that of their summed speeds: Ω + Ω_R
inside the ring, Ω_R outside it. With r = Ω_R/Ω, in the bearing's units of μ_i, Ω, R, L and C:

    force       (1 + r) inside,     q r outside,     q = (μ_o/μ_i)(R_o/R)(L_o/L)³(C/C_o)²
    stiffness   (1 + r) inside,     q r C/C_o outside
    damping     1 inside,           q C/C_o outside
    shear       (1 − r) inside,     m r outside,     m = (μ_o/μ_i)(R_o/R)³(L_o/L)(C/C_o)

and under the load of σ the films are at σ_i = (1 + r)σ and σ_o = q r σ of their own.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol, TypeVar

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.dynamics import FilmDynamics
from rotorcalc.films.finite import CoarseFilm, FiniteFilm
from rotorcalc.films.model import Accuracy
from rotorcalc.films.short import ShortFilm
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.geometry import FloatingRing
from rotorcalc.machine import JournalBearing


class PlainFilm(Protocol):
    """What a ring asks of the film of a plain bearing; see `films.model.Film`."""

    @property
    def bearing(self) -> JournalBearing: ...  # noqa: D102
    @property
    def least_sommerfeld(self) -> float: ...  # noqa: D102
    @property
    def sommerfeld_range(self) -> tuple[float, float]: ...  # noqa: D102
    def place_and_flow(self, sommerfeld: Array) -> tuple[Array, Array]: ...  # noqa: D102
    def state(self, points: OperatingPoints) -> FilmState: ...  # noqa: D102
    def field(self, points: OperatingPoints, *, angle: Array, zeta: Array) -> FilmField: ...  # noqa: D102
    def dynamics(self, points: OperatingPoints) -> FilmDynamics: ...  # noqa: D102
    def accuracy(self, sommerfeld: float) -> Accuracy | None: ...  # noqa: D102


# One number or many.
Number = TypeVar("Number", float, Array)

_FILMS = {"short": ShortFilm, "finite": FiniteFilm, "coarse": CoarseFilm}


@dataclass(frozen=True)
class Pair:
    """The inner and the outer film of a bearing with a floating ring.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing; its geometry is a floating ring.
    """

    bearing: JournalBearing

    @cached_property
    def ring(self) -> FloatingRing:
        """The ring."""
        geometry = self.bearing.geometry
        if not isinstance(geometry, FloatingRing):
            raise ValueError(f"bearing = {geometry.kind}: has no floating ring")
        return geometry

    @cached_property
    def inside(self) -> PlainFilm:
        """The film between journal and ring."""
        one = self.bearing
        return self._film(one.diameter, one.length, one.radial_clearance)

    @cached_property
    def outside(self) -> PlainFilm:
        """The film around the ring."""
        ring = self.ring
        return self._film(2.0 * ring.outer_radius, ring.outer_length, ring.outer_clearance)

    def _film(self, diameter: float, length: float, clearance: float) -> PlainFilm:
        model = self.bearing.model
        plain = JournalBearing(
            diameter=diameter, length=length, radial_clearance=clearance, film=model
        )
        return _FILMS[model](plain)

    @property
    def alike(self) -> bool:
        """Whether both films have one curve over σ: a search for both costs little more."""
        return self.bearing.model == "short"

    @cached_property
    def wider(self) -> float:
        """C_o/C."""
        return self.ring.outer_clearance / self.bearing.radial_clearance

    @cached_property
    def force(self) -> float:
        """q: the outer film's unit of force over the inner one's, both at one speed."""
        return self._thicker * self._broader * self._longer**3 / self.wider**2

    @cached_property
    def shear(self) -> float:
        """m: the outer film's shear over the inner one's, concentric and at one speed."""
        return self._thicker * self._broader**3 * self._longer / self.wider

    @property
    def _thicker(self) -> float:
        return self.ring.viscosity_ratio

    @property
    def _broader(self) -> float:
        return self.ring.outer_radius / self.bearing.radius

    @property
    def _longer(self) -> float:
        return self.ring.outer_length / self.bearing.length

    @cached_property
    def flow(self) -> float:
        """R_oL_oC_o/(RLC): the outer film's unit of flow over the inner one's, at one speed."""
        return self._broader * self._longer * self.wider

    @cached_property
    def slenderness(self) -> float:
        """(L/R)²: the unit of force times C over that of torque."""
        return (self.bearing.length / self.bearing.radius) ** 2

    def sommerfeld(self, sigma: Number, ratio: Number) -> tuple[Number, Number]:
        """Return σ of the two films at σ of the bearing and r."""
        return (1.0 + ratio) * sigma, self.force * ratio * sigma

    def places_and_flows(self, inner: Array, outer: Array) -> tuple[Array, Array, Array, Array]:
        """Return the places of journal and ring at σ of their films, each in its own C, and flows.

        Places (..., 2) of inner and outer film, then their side flows (...), each in its own units.
        """
        if self.alike:
            place, flow = self.inside.place_and_flow(np.stack([inner, outer]))
            return place[0], place[1], flow[0], flow[1]
        place, flow = self.inside.place_and_flow(inner)
        place_o, flow_o = self.outside.place_and_flow(outer)
        return place, place_o, flow, flow_o

    def dynamics(
        self, points: OperatingPoints, inner: Array, outer: Array
    ) -> tuple[FilmDynamics, FilmDynamics]:
        """Return K and C of the inner film and of the outer one, each in its own units.

        Parameters
        ----------
        points : OperatingPoints
            The bearing's.
        inner, outer : array, (...)
            σ of the two films.

        Returns
        -------
        inside, outside : FilmDynamics
            In X, Y.
        """
        if self.alike:
            both = self.inside.dynamics(replace(points, sommerfeld=np.stack([inner, outer])))
            one, other = (
                replace(both, stiffness=K, damping=C)
                for K, C in zip(both.stiffness, both.damping, strict=True)
            )
            return one, other
        return (
            self.inside.dynamics(replace(points, sommerfeld=inner)),
            self.outside.dynamics(replace(points, sommerfeld=outer)),
        )

    def states(
        self, points: OperatingPoints, inner: Array, outer: Array
    ) -> tuple[FilmState, FilmState]:
        """Return both films in equilibrium, as `dynamics`; of the outer one all but the drag."""
        if self.alike:
            both = self.inside.state(replace(points, sommerfeld=np.stack([inner, outer])))
            values = {name: value for name, value in vars(both).items() if value is not None}
            one, other = (
                replace(both, **{name: value[i] for name, value in values.items()}) for i in (0, 1)
            )
            return one, other
        return (
            self.inside.state(replace(points, sommerfeld=inner)),
            self.outside.state(replace(points, sommerfeld=outer)),
        )
