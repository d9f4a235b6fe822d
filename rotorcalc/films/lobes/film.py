"""Short bearings of pads as a film model (interface in `films.model`)."""

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.dynamics import NO_INERTIA, FilmDynamics
from rotorcalc.films.lobes.motion import PadsInMotion
from rotorcalc.films.lobes.static import (
    NEXT_TO_NONE,
    coefficients,
    equilibrium,
    friction,
    peak,
    range_of,
    refuse_heavy,
)
from rotorcalc.films.model import FilmMotion, Limit, Source
from rotorcalc.films.pads import Pad, are_concentric, gap, outline, pads_of, walls_of
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.machine import JournalBearing

_CLOSED = "closed form of short pads"
_SOURCES: dict[str, Source] = {
    "film": Source("short pads, at ambient pressure in the grooves and where they cavitate"),
    "eccentricity": Source("force balance", r"F_X(x,y)=-F_o,\quad F_Y(x,y)=0"),
    "attitude": Source("force balance", r"\tan\varphi=\frac yx"),
    "thickness": Source(
        "arcs of the pads",
        r"\frac hC=1+a_x\cos\beta+a_y\sin\beta-x\cos\beta-y\sin\beta",
    ),
    "pressure": Source(
        _CLOSED,
        r"p=-\frac{3\mu\Omega L^2}{C^2}\,\frac{\partial_\beta h}{h^3}"
        r"\left(\frac14-\frac{z^2}{L^2}\right)",
        remark="ambient at both ends",
    ),
    "force": Source(_CLOSED),
    "drag": Source(
        "shear of the pads",
        r"T=\frac{\mu\Omega R^3L}{C}\sum\left[\int\frac{d\beta}h"
        r"+\left(\frac LD\right)^2\int\frac{(\partial_\beta h)^2}{h^3}d\beta\right]",
    ),
    "flow": Source("axial flow",
                   r"Q=\tfrac12\Omega RLC\sum(h_{start}-h_{end})"),
    "stiffness": Source(_CLOSED),
    "damping": Source(_CLOSED),
    "k": Source(_CLOSED),
    "c": Source(_CLOSED),
    "XY": Source(_CLOSED),
    "rt": Source(_CLOSED),
}  # fmt: skip


@dataclass(frozen=True)
class LobesFilm:
    """The film of one short bearing of pads, in closed form.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing; its bore enters, and L/D in the drag only.
    """

    bearing: JournalBearing

    inner: int = field(default=0, init=False)
    frequency_dependent: bool = field(default=False, init=False)
    can_whirl: bool = field(default=True, init=False)

    @cached_property
    def _pads(self) -> tuple[Pad, ...]:
        return pads_of(self.bearing)

    @property
    def curve(self) -> Hashable:
        """The bore's pads."""
        return "short pads", self._pads

    @property
    def sommerfeld_range(self) -> tuple[float, float]:
        """σ of the heaviest load, and of one that hardly moves the journal."""
        light, heavy = range_of(self._pads)
        return 0.25 / heavy, 2.5 / light

    @property
    def least_sommerfeld(self) -> float:
        """σ of the heaviest load."""
        return 0.25 / range_of(self._pads)[1]

    @property
    def sources(self) -> Mapping[str, Source]:
        """What was integrated."""
        return _SOURCES

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Length over diameter, and over the pads: the flow around the journal is neglected."""
        ratio = self.bearing.length / self.bearing.diameter
        arc = min(pad.arc for pad in self._pads)
        reason = (
            "the short bearing neglects the circumferential pressure flow; it overestimates "
            "the force of longer bearings"
        )
        return (
            Limit("Length over diameter, L/D", ratio, 0.5, 1.0, reason),
            Limit(
                "Length over arc of a pad", 2.0 * ratio / arc, 0.5, 1.0,
                "the pressure falls to ambient within about half a length of a pad's edge, which "
                "the short bearing neglects",
            ),
        )  # fmt: skip

    def _positions(self, sommerfeld: Array) -> Array:
        """Return positions (n, 2) at σ (n,)."""
        load = 0.25 / sommerfeld
        if not are_concentric(self._pads):
            return equilibrium(self._pads, load)
        # Without load there is no film: the limit is that of a very light one.
        least = NEXT_TO_NONE * range_of(self._pads)[0]
        position = equilibrium(self._pads, np.maximum(load, least))
        return position * np.minimum(load / least, 1.0)[:, None]

    def state(self, points: OperatingPoints) -> FilmState:
        """Return the film in static equilibrium.

        Raises
        ------
        ValueError
            Where the load presses the journal onto a pad.
        """
        sigma = np.asarray(points.sommerfeld)
        position = self._positions(sigma.ravel())
        shape = sigma.shape
        light = np.hypot(position[:, 0], position[:, 1]) < 1e-12
        toward = np.where(light[:, None], self._limit, position)
        pressure, where = peak(self._pads, position)
        K, C = self._coefficients(points)
        drag, flow = self.drag_and_flow(points)
        return FilmState(
            sommerfeld=points.sommerfeld,
            position=position.reshape(*shape, 2),
            attitude_angle=np.arctan2(toward[:, 1], toward[:, 0]).reshape(shape),
            minimum_thickness=gap(self._pads, position).reshape(shape),
            stiffness=K,
            damping=C,
            side_flow=flow,
            drag=drag,
            peak_pressure=pressure.reshape(shape),
            peak_angle=where.reshape(shape),
        )

    def drag_and_flow(self, points: OperatingPoints) -> tuple[Array, Array]:
        """Return drag and side flow only, from splines as stiffness and damping."""
        load = 0.25 / np.asarray(points.sommerfeld)
        refuse_heavy(self._pads, load)
        values = friction(self._pads).at(load)
        ratio = self.bearing.length / self.bearing.diameter
        return values[..., 0] + ratio**2 * values[..., 1], values[..., 2]

    @cached_property
    def _limit(self) -> Array:
        """The direction in which a light load moves the journal from the centre."""
        load = np.array([NEXT_TO_NONE * range_of(self._pads)[0]])
        centre = (
            np.zeros(2) if are_concentric(self._pads) else equilibrium(self._pads, 0.0 * load)[0]
        )
        return 1e9 * (equilibrium(self._pads, 1e3 * load)[0] - centre)

    def dynamics(self, points: OperatingPoints) -> FilmDynamics:
        """Return stiffness and damping only."""
        K, C = self._coefficients(points)
        return FilmDynamics(K, C, NO_INERTIA)

    def _coefficients(self, points: OperatingPoints) -> tuple[Array, Array]:
        """Return stiffness and damping, from splines through exact ones: a hundred times faster."""
        load = 0.25 / np.asarray(points.sommerfeld)
        refuse_heavy(self._pads, load)
        return coefficients(self._pads).at(load)

    def field(self, points: OperatingPoints, *, angle: ArrayLike, zeta: ArrayLike) -> FilmField:
        """Return thickness and pressure in static equilibrium; NaN where there is no pad.

        Raises
        ------
        ValueError
            Where ζ lies outside the bearing.
        """
        place = self.state(points).position
        x, y, angle, zeta = np.broadcast_arrays(place[..., 0], place[..., 1], angle, zeta)
        if not np.all(np.abs(zeta) <= 0.5):
            raise ValueError("zeta = z/L: must lie within the bearing, -0.5 to 0.5")
        thickness, pressure = np.full(angle.shape, np.nan), np.zeros(angle.shape)
        cavitated: BoolArray = np.zeros(angle.shape, dtype=bool)
        cos, sin = np.cos(angle), np.sin(angle)
        for pad in self._pads:
            on = np.mod(angle - pad.start, 2.0 * np.pi) <= pad.arc
            e_x, e_y = x - pad.a_x, y - pad.a_y
            h = 1.0 - e_x * cos - e_y * sin
            wedge = np.maximum(e_y * cos - e_x * sin, 0.0)  # −∂h/∂β
            thickness = np.where(on, h, thickness)
            pressure = np.where(on, 3.0 * wedge / h**3 * (0.25 - zeta**2), pressure)
            cavitated = np.where(on, e_y * cos - e_x * sin < -1e-12, cavitated)
        return FilmField(
            angle=angle, zeta=zeta, thickness=thickness, pressure=pressure, cavitated=cavitated
        )

    def added_mass(self, points: OperatingPoints) -> Array:  # noqa: ARG002 - the seam's
        """Refuse: the added mass of pads is not computed."""
        raise ValueError(
            "bearing: the added mass of its film is not computed; that of a short plain bearing is"
        )

    def motion(self) -> FilmMotion:
        """Return the force on a moving journal, and its inverse, in plain floats."""
        moving = PadsInMotion(self._pads)
        return FilmMotion(force=moving.force, velocity=moving.velocity)

    def accuracy(self, sommerfeld: float) -> None:
        """Return None: the film is a closed form."""

    def gap(self, position: ArrayLike) -> Array:
        """Return the smallest distance from the journal to the bore."""
        return gap(walls_of(self.bearing), position)

    def outline(self, angle: ArrayLike) -> Array:
        """Return where the journal's centre touches the bore."""
        return outline(walls_of(self.bearing), angle)
