"""Films made for the tests: each breaks something that only a short circular bearing keeps.

`Sprung` has no cross-coupling, stiffness in the centre and a square bore; `Preloaded` is the short
film with a spring, so that it holds the journal without load; `Lossy` has that spring lose the
same energy in each cycle at any frequency, so that it is known by an impedance only; `Ringed` is a
short film on a ring that turns at a share of the speed on a second short film, two inner
coordinates, with mass or not.
"""

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field, replace
from typing import Annotated, ClassVar

import numpy as np
from scipy.optimize import root

from rotorcalc.films import MODELS, FilmDynamics, FilmField, FilmState, FilmUnits
from rotorcalc.films.dynamics import NO_INERTIA, reduced
from rotorcalc.films.model import FilmMotion, InnerMotion, Limit, Source
from rotorcalc.films.short import motion as short_motion
from rotorcalc.films.short import radial_damping, radial_stiffness, static_force
from rotorcalc.films.short.film import ShortFilm
from rotorcalc.films.state import OperatingPoints
from rotorcalc.frames import rotate, vector
from rotorcalc.geometry import (
    AxialGrooves,
    Elliptical,
    FloatingRing,
    Foil,
    Geometry,
    Hydrostatic,
    Lobes,
    MultiDam,
    OffsetHalves,
    PartialArc,
    PressureDam,
    TiltingPads,
)
from rotorcalc.machine import JournalBearing
from rotorcalc.records import Bound


@dataclass(frozen=True, kw_only=True)
class Sprung(Geometry):
    """A square bore full of springs and dampers, in film units."""

    kind: ClassVar[str] = "sprung"
    models: ClassVar[tuple[str, ...]] = ("short",)
    stiffness: Annotated[float, Bound("-", above=0.0)] = 2.0
    ratio: Annotated[float, Bound("-", above=0.0)] = 0.5
    damping: Annotated[float, Bound("-", above=0.0)] = 1.5


@dataclass(frozen=True, kw_only=True)
class Preloaded(Geometry):
    """A circular bore whose short film is helped by an isotropic spring, in film units."""

    kind: ClassVar[str] = "preloaded"
    models: ClassVar[tuple[str, ...]] = ("short",)
    spring: Annotated[float, Bound("-", above=0.0)] = 0.3


@dataclass(frozen=True, kw_only=True)
class Lossy(Preloaded):
    """The same, and the spring has a loss factor: its stiffness in a whirl is k(1 + jη)."""

    kind: ClassVar[str] = "lossy"
    loss: Annotated[float, Bound("-", at_least=0.0)] = 0.2


@dataclass(frozen=True, kw_only=True)
class Ringed(Geometry):
    """A ring that turns at a share of the speed between two short films."""

    kind: ClassVar[str] = "ringed"
    models: ClassVar[tuple[str, ...]] = ("short",)
    share: Annotated[float, Bound("-", above=0.0)] = 0.3
    outer_force: Annotated[float, Bound("-", above=0.0)] = 4.0
    outer_clearance: Annotated[float, Bound("m", above=0.0)] = 90e-6
    ring_mass: Annotated[float, Bound("kg", at_least=0.0)] = 0.0


@dataclass(frozen=True)
class _TestFilm:
    """What these films have in common: nothing is known of pressure, flow or drag.

    Without inner coordinates a film is its state's stiffness and damping, and a force.
    """

    bearing: JournalBearing
    inner: int = field(default=0, init=False)
    frequency_dependent: bool = field(default=False, init=False)
    can_whirl: bool = field(default=True, init=False)
    sommerfeld_range: tuple[float, float] = field(default=(0.03, 1e3), init=False)
    least_sommerfeld: float = field(default=0.0, init=False)

    @property
    def curve(self) -> Hashable:
        return self.bearing.geometry

    @property
    def limits(self) -> tuple[Limit, ...]:
        return ()

    @property
    def sources(self) -> Mapping[str, Source]:
        return {"eccentricity": Source("a film of the tests")}

    def field(self, points, *, angle, zeta):
        angle, zeta, _ = np.broadcast_arrays(angle, zeta, points.sommerfeld)
        unknown = np.full(angle.shape, np.nan)
        return FilmField(
            angle=angle, zeta=zeta, thickness=unknown, pressure=unknown,
            cavitated=np.zeros(angle.shape, dtype=bool),
        )  # fmt: skip

    def dynamics(self, points):
        state = self.state(points)
        return FilmDynamics(state.stiffness, state.damping, NO_INERTIA)

    def drag_and_flow(self, points):
        state = self.state(points)
        return state.drag, state.side_flow

    def motion(self):
        return FilmMotion(self._force, self._velocity)

    def accuracy(self, sommerfeld):  # noqa: ARG002 - the seam's
        return None

    def added_mass(self, points):  # noqa: ARG002 - the seam's
        raise ValueError("bearing: its film's added mass is not known")

    def state_at(self, points, position, K, C):
        unknown = np.full(points.sommerfeld.shape, np.nan)
        return FilmState(
            sommerfeld=points.sommerfeld,
            position=position,
            attitude_angle=np.arctan2(position[..., 1], position[..., 0]),
            minimum_thickness=self.gap(position),
            stiffness=K,
            damping=C,
            side_flow=unknown,
            drag=unknown,
            peak_pressure=unknown,
            peak_angle=unknown,
        )


@dataclass(frozen=True)
class SprungFilm(_TestFilm):
    """No cross-coupling, stiffness in the centre, a square wall."""

    can_whirl: bool = field(default=False, init=False)

    @property
    def sommerfeld_range(self):
        return 0.26 / self.bearing.geometry.stiffness, 1e3

    @property
    def _matrices(self):
        shape = self.bearing.geometry
        K = np.diag([shape.stiffness, shape.ratio * shape.stiffness])
        return K, shape.damping * np.eye(2)

    def state(self, points):
        K, C = self._matrices
        x = 0.25 / points.sommerfeld / K[0, 0]
        if np.any(x >= 1.0):
            raise ValueError(f"sommerfeld = {np.min(points.sommerfeld):.3g}: the journal touches")
        shape = (*points.sommerfeld.shape, 2, 2)
        return self.state_at(
            points, vector(x, 0.0 * x), np.broadcast_to(K, shape), np.broadcast_to(C, shape)
        )

    def _force(self, x, y, dx, dy):
        (k_x, k_y), c = np.diag(self._matrices[0]).tolist(), self.bearing.geometry.damping
        return -k_x * x - c * dx, -k_y * y - c * dy

    def _velocity(self, x, y, f_x, f_y, near=None):  # noqa: ARG002 - as all films take it
        (k_x, k_y), c = np.diag(self._matrices[0]).tolist(), self.bearing.geometry.damping
        return -(f_x + k_x * x) / c, -(f_y + k_y * y) / c

    def gap(self, position):
        return 1.0 - np.abs(np.asarray(position, float)).max(axis=-1)

    def outline(self, angle):
        ray = vector(np.cos(angle), np.sin(angle))
        return ray / np.abs(ray).max(axis=-1, keepdims=True)


@dataclass(frozen=True)
class PreloadedFilm(_TestFilm):
    """The short film and a spring: it holds the journal without load too."""

    sommerfeld_range: tuple[float, float] = field(default=(1e-2, 1e3), init=False)

    def _forces(self, eps):
        radial, tangential = np.moveaxis(static_force(eps), -1, 0)
        return radial - self.bearing.geometry.spring * eps, tangential

    def _eccentricity(self, sigma):
        """Solve for ε by halving: the force on the journal is the load."""
        load = 0.25 / np.asarray(sigma, float)
        low, high = np.zeros(load.shape), np.where(load > 0.0, 1.0 - 1e-9, 0.0)
        for _ in range(54):
            middle = 0.5 * (low + high)
            over = np.hypot(*self._forces(middle)) > load
            low, high = np.where(over, low, middle), np.where(over, middle, high)
        return high

    def state(self, points):
        eps = self._eccentricity(points.sommerfeld)
        # At the centre the angle of its limit.
        radial, tangential = self._forces(np.maximum(eps, 1e-9))
        phi = np.arctan2(tangential, -radial)
        K = rotate(radial_stiffness(eps), phi) + self.bearing.geometry.spring * np.eye(2)
        position = vector(eps * np.cos(phi), eps * np.sin(phi))
        found = self.state_at(points, position, K, rotate(radial_damping(eps), phi))
        return replace(found, attitude_angle=phi)

    def _force(self, x, y, dx, dy):
        spring = self.bearing.geometry.spring
        f_x, f_y = short_motion.force(x, y, dx, dy)
        return f_x - spring * x, f_y - spring * y

    def _velocity(self, x, y, f_x, f_y, near=None):
        spring = self.bearing.geometry.spring
        return short_motion.velocity(x, y, f_x + spring * x, f_y + spring * y, near)

    def gap(self, position):
        return 1.0 - np.hypot(*np.moveaxis(np.asarray(position, float), -1, 0))

    def outline(self, angle):
        return vector(np.cos(angle), np.sin(angle))


@dataclass(frozen=True)
class LossyFilm(PreloadedFilm):
    """The same with structural damping, which has a meaning in a whirl only."""

    frequency_dependent: bool = field(default=True, init=False)

    @property
    def _lost(self):
        shape = self.bearing.geometry
        return shape.spring * shape.loss * np.eye(2)

    def state(self, points):
        found = super().state(points)
        return replace(found, damping=found.damping + self._lost)

    def dynamics(self, points):
        synchronous = self.state(points)
        film = synchronous.damping - self._lost

        def at(whirl_ratio):
            nu = np.asarray(whirl_ratio)[..., None, None]
            return synchronous.stiffness + 0.0 * nu, film + self._lost / nu

        return FilmDynamics(synchronous.stiffness, synchronous.damping, NO_INERTIA, at)

    def motion(self):
        raise ValueError("bearing: its spring's loss is known in a whirl only, not in any motion")


@dataclass(frozen=True)
class RingedFilm(_TestFilm):
    """Two short films in series, the ring between them with or without mass."""

    inner: int = field(default=2, init=False)
    frequency_dependent: bool = field(default=True, init=False)

    @property
    def curve(self) -> Hashable:
        # A ring's inertia goes with the speed squared.
        return None if self.bearing.geometry.ring_mass > 0.0 else self.bearing.geometry

    @property
    def _numbers(self):
        shape = self.bearing.geometry
        return shape.share, shape.outer_force, shape.outer_clearance / self.bearing.radial_clearance

    def _films(self, points):
        """Return the states of inner and outer film, each at its own σ."""
        share, outer_force, _ = self._numbers
        film = ShortFilm(self.bearing)

        def at(factor):
            return film.state(replace(points, sommerfeld=factor * points.sommerfeld))

        return at(1.0 + share), at(outer_force * share)

    def state(self, points):
        inside, outside = self._films(points)
        _, _, wider = self._numbers
        units = FilmUnits(self.bearing, points.viscosity, points.speed)
        film = self.dynamics(points)
        stiffness, damping = (
            np.asarray(unit)[..., None, None] for unit in (units.stiffness, units.damping)
        )
        machine = FilmDynamics(film.stiffness * stiffness, film.damping * damping, film.inertia)
        K, C = reduced(machine, points.speed)
        position = inside.position + wider * outside.position
        return self.state_at(points, position, K / stiffness, C / damping)

    def dynamics(self, points):
        share, outer_force, wider = self._numbers
        inside, outside = self._films(points)
        mass = self.bearing.geometry.ring_mass
        return FilmDynamics(
            stiffness=_in_series(
                (1.0 + share) * inside.stiffness, outer_force * share / wider * outside.stiffness
            ),
            damping=_in_series(inside.damping, outer_force / wider * outside.damping),
            inertia=np.array([mass, mass]),
        )

    def motion(self):
        kernel = self._kernel
        return InnerMotion(
            states=kernel.states, rest=self._rest, force=kernel.force, velocity=kernel.velocity
        )

    @property
    def _kernel(self):
        return _RingKernel(self.bearing, *self._numbers, self.bearing.geometry.ring_mass)

    def _rest(self, points):
        _, outer = self._films(points)
        still = np.zeros((*np.shape(points.sommerfeld), self._kernel.states - 2))
        return np.concatenate([self._kernel.wider * outer.position, still], axis=-1)

    def gap(self, position):
        _, _, wider = self._numbers
        return 1.0 + wider - np.hypot(*np.moveaxis(np.asarray(position, float), -1, 0))

    def outline(self, angle):
        _, _, wider = self._numbers
        return (1.0 + wider) * vector(np.cos(angle), np.sin(angle))


@dataclass(frozen=True)
class _RingKernel:
    """The nonlinear forces of the two films, and what the ring does."""

    bearing: JournalBearing
    share: float
    outer_force: float
    wider: float
    mass: float

    @property
    def states(self):
        return 4 if self.mass > 0.0 else 2

    def inside(self, place, velocity, ring, ring_velocity):
        """Force of the inner film on the journal."""
        one = 1.0 + self.share
        relative = [p - r for p, r in zip(place, ring, strict=True)]
        slip = [(v - w) / one for v, w in zip(velocity, ring_velocity, strict=True)]
        return [one * f for f in short_motion.force(*relative, *slip)]

    def outside(self, ring, ring_velocity):
        """Force of the outer film on the ring."""
        place = [r / self.wider for r in ring]
        slip = [w / (self.wider * self.share) for w in ring_velocity]
        return [self.outer_force * self.share * f for f in short_motion.force(*place, *slip)]

    def follows(self, ring, f):
        """Velocity of a massless ring: the outer film carries what the inner one does."""
        place, unit = [r / self.wider for r in ring], self.outer_force * self.share
        found = short_motion.velocity(*place, *(g / unit for g in f))
        return [self.wider * self.share * v for v in found]

    def held(self, place, velocity, ring):
        """Velocity of a massless ring while the journal moves as it does."""

        def unbalanced(w):
            return np.subtract(self.inside(place, velocity, ring, w), self.outside(ring, w))

        found = root(unbalanced, np.zeros(2), tol=1e-13)
        assert np.abs(found.fun).max() < 1e-9
        return found.x.tolist()

    def pushed(self, outer, inner, viscosity, speed):
        """Acceleration of the ring, in CΩ²."""
        unit = float(FilmUnits(self.bearing, viscosity, speed).force)
        scale = unit / (self.mass * self.bearing.radial_clearance * speed**2)
        return [scale * (b - a) for a, b in zip(inner, outer, strict=True)]

    def force(self, moving, inner, viscosity, speed):
        place, velocity, ring = moving[:2], moving[2:], inner[:2]
        if self.mass == 0.0:
            ring_velocity = self.held(place, velocity, ring)
            return *self.inside(place, velocity, ring, ring_velocity), ring_velocity
        f = self.inside(place, velocity, ring, inner[2:])
        pushed = self.pushed(self.outside(ring, inner[2:]), f, viscosity, speed)
        return *f, [*inner[2:], *pushed]

    def velocity(self, moving, inner, viscosity, speed):
        place, f, ring = moving[:2], moving[2:], inner[:2]
        ring_velocity = inner[2:] if self.mass > 0.0 else self.follows(ring, f)
        one = 1.0 + self.share
        relative = [p - r for p, r in zip(place, ring, strict=True)]
        slip = [one * v for v in short_motion.velocity(*relative, *(g / one for g in f))]
        found = [w + v for w, v in zip(ring_velocity, slip, strict=True)]
        if self.mass == 0.0:
            return *found, ring_velocity
        pushed = self.pushed(self.outside(ring, ring_velocity), f, viscosity, speed)
        return *found, [*ring_velocity, *pushed]


def _in_series(inside, outside):
    """Return the 4×4 matrix of journal and ring from those of the two films."""
    rows = [
        np.concatenate([inside, -inside], axis=-1),
        np.concatenate([-inside, inside + outside], axis=-1),
    ]
    return np.concatenate(rows, axis=-2)


MODELS["sprung", "short"] = SprungFilm
MODELS["preloaded", "short"] = PreloadedFilm
MODELS["lossy", "short"] = LossyFilm
MODELS["ringed", "short"] = RingedFilm

# By name, what every contract test runs over; the short bearing first.
_PLAIN = JournalBearing(diameter=0.150, length=0.050, radial_clearance=60e-6)
BEARINGS = {
    "short": _PLAIN,
    "sprung": replace(_PLAIN, geometry=Sprung()),
    "preloaded": replace(_PLAIN, geometry=Preloaded()),
    "lossy": replace(_PLAIN, geometry=Lossy()),
    "ringed": replace(_PLAIN, geometry=Ringed()),
    "ringed, heavy": replace(_PLAIN, geometry=Ringed(ring_mass=1.5)),
}
# A floating ring of the usual proportions, on each film model, and one with its mass.
_AROUND = FloatingRing.around(_PLAIN.diameter, _PLAIN.length, _PLAIN.radial_clearance)
SHORT_RINGS = {
    "floating ring, heavy": replace(
        _PLAIN, geometry=replace(_AROUND, ring_mass=12.0), film="short"
    ),
    "floating ring": replace(_PLAIN, geometry=_AROUND, film="short"),
}
RINGS = {"finite floating ring": replace(_PLAIN, geometry=_AROUND), **SHORT_RINGS}

# Every fixed bore on the film of finite length.
FINITE = {
    "finite": replace(_PLAIN, film="finite"),
    "partial arc": replace(_PLAIN, geometry=PartialArc()),
    "axial grooves": replace(_PLAIN, geometry=AxialGrooves()),
    "elliptical": replace(_PLAIN, geometry=Elliptical()),
    "offset halves": replace(_PLAIN, geometry=OffsetHalves()),
    "lobes": replace(_PLAIN, geometry=Lobes()),
    "pressure dam": replace(_PLAIN, geometry=PressureDam()),
    "multi dam": replace(_PLAIN, geometry=MultiDam()),
}
# Bores of pads on the short film in closed form.
SHORT_PADS = {
    f"short {name}": replace(FINITE[name], film="short")
    for name in ("partial arc", "axial grooves", "elliptical", "offset halves", "lobes")
}
# Pads on flexures, and pads that tilt freely.
PADS = {
    "flexure pads": replace(_PLAIN, geometry=TiltingPads(number=4, rotational_stiffness=2e4)),
    "heavy tilting pads": replace(_PLAIN, geometry=TiltingPads(load="on pad", pad_inertia=2e-4)),
    "tilting pads": replace(_PLAIN, geometry=TiltingPads()),
}
# Those above run on oil, as the machines of the tests do; these on gas.
GAS = {"foil": replace(_PLAIN, length=0.150, geometry=Foil.usual(60e-6))}
# A supply that carries every load of the tests.
RECESSED = {"hydrostatic": replace(_PLAIN, geometry=Hydrostatic(supply_pressure=15e6))}
# Those whose film has the same force in any motion as at rest, to rounding.
MOVING = [name for name in BEARINGS | SHORT_PADS | SHORT_RINGS | RECESSED if name != "lossy"]
BEARINGS |= FINITE | SHORT_PADS | RINGS | PADS | RECESSED


def points(bearing, sigma, *, viscosity=None, speed=600.0):
    """Return operating points at σ with a real oil or gas and speed, as inner masses need them."""
    if viscosity is None:
        viscosity = 0.0127 if bearing.geometry.lubricant == "oil" else 2e-5
    unit = float(FilmUnits(bearing, viscosity, speed).force)
    load = np.where(np.isinf(sigma), 0.0, unit / (4.0 * np.asarray(sigma, float)))
    return OperatingPoints(
        sommerfeld=np.asarray(sigma, float),
        viscosity=np.array(viscosity),
        speed=np.array(speed),
        load=load,
    )
