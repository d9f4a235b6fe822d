"""The forces of two films on a moving journal and its ring, one point at a time.

Both films are plain ones, short or of finite length, each in its own units and at the place and
velocity of its inner surface in the outer one: the journal's in the ring, the ring's in the
bearing. In a frame that turns at half the sum of its surfaces' speeds a film sees squeeze only, so
the force of a film with one turning surface serves both. The ring moves
freely but keeps turning at the speed of static equilibrium: its spin is slow to change. A massless
ring moves so that both films load it alike. Of all its velocities that one makes the sum of both
films' potentials the least (`convex`), so there is one and Newton's method finds it.

Positions in C, velocities in CΩ, forces in μΩRL³/C².
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol, TypeAlias

import numpy as np
from scipy.interpolate import CubicSpline

from rotorcalc.arrays import Array
from rotorcalc.films import convex
from rotorcalc.films.convex import Answer
from rotorcalc.films.finite import CircleInMotion, Shape
from rotorcalc.films.ring import balance
from rotorcalc.films.ring.pair import Pair
from rotorcalc.films.short import motion as short
from rotorcalc.films.units import FilmUnits
from rotorcalc.machine import JournalBearing

# Loads per decade at which r is known, between which a run-up has it from a spline, to some 1e-8.
_PER_DECADE, _LIGHT = 40, 1e8
# About how long a revolution takes on two films of finite length.
REVOLUTION = 0.03
# A force so small in film units that no motion comes of it.
_NOTHING = 1e-9

_Vector: TypeAlias = tuple[float, float]
_Motion: TypeAlias = tuple[float, float, float, float]


class PlainMotion(Protocol):
    """The force of a plain film on a moving surface; see `short.motion`, which is one."""

    def force(self, x: float, y: float, dx: float, dy: float) -> _Vector: ...  # noqa: D102
    def answer(self, x: float, y: float, dx: float, dy: float) -> Answer: ...  # noqa: D102
    def velocity(  # noqa: D102
        self, x: float, y: float, f_x: float, f_y: float, near: list[float] | None = None
    ) -> _Vector: ...


def plain_motion(bearing: JournalBearing) -> PlainMotion:
    """Return the force of a plain bearing's film on a moving journal."""
    return short if bearing.model == "short" else CircleInMotion(bearing)


@dataclass(frozen=True, eq=False)
class RingInMotion:
    """The two films of a ring that keeps its speed of rotation.

    Attributes
    ----------
    pair : Pair
        The two films.
    load : float
        Static load per bearing [N], from which the ring's speed follows.
    """

    pair: Pair
    load: float
    # Where the last searches for a velocity ended.
    _slip: list[float] = field(default_factory=list[float])
    _drift: list[float] = field(default_factory=list[float])
    _held: list[float] = field(default_factory=list[float])
    # Viscosity, speed and r of the last point; at one speed those of all.
    _last: list[float] = field(default_factory=list[float])

    def __reduce__(self) -> tuple[type, tuple[Pair, float]]:
        """Return what another process makes it from again."""
        return type(self), (self.pair, self.load)

    @cached_property
    def _inner_film(self) -> PlainMotion:
        return plain_motion(self.pair.inside.bearing)

    @cached_property
    def _outer_film(self) -> PlainMotion:
        return plain_motion(self.pair.outside.bearing)

    @property
    def shapes(self) -> tuple[Shape, ...]:
        """The shapes of films of finite length, each of which has a table."""
        both = self._inner_film, self._outer_film
        found = [one.shape for one in both if isinstance(one, CircleInMotion)]
        return tuple(dict.fromkeys(found))

    @property
    def states(self) -> int:
        """Number of inner states: the ring's position, and its velocity where it has a mass."""
        return 4 if self._mass > 0.0 else 2

    @property
    def _mass(self) -> float:
        return self.pair.ring.ring_mass

    def _ratio(self, viscosity: float, speed: float) -> float:
        """Return r = Ω_R/Ω in static equilibrium."""
        if self._last[:2] != [viscosity, speed]:
            unit = float(FilmUnits(self.pair.bearing, viscosity, speed).force)
            sigma = 0.25 * unit / self.load if self.load > 0.0 else math.inf
            if not self._last:
                ratio = float(balance.speed_ratio(self.pair, np.array(sigma)))
            else:
                ratio = math.exp(self._over_sigma(math.log(sigma)))
            self._last[:] = viscosity, speed, ratio
        return self._last[2]

    @cached_property
    def _over_sigma(self) -> Callable[[float], float]:
        """Return ln r as a function of ln σ, for a run-up."""
        low = math.log(balance.least_sommerfeld(self.pair))
        ln_sigma = np.linspace(low, low + math.log(_LIGHT), int(_PER_DECADE * math.log10(_LIGHT)))
        ratio = balance.speed_ratio(self.pair, np.exp(ln_sigma))
        spline = CubicSpline(ln_sigma, np.log(ratio))
        return lambda x: float(spline(min(x, float(ln_sigma[-1]))))

    def force(
        self,
        moving: tuple[float, float, float, float],
        inner: list[float],
        viscosity: float,
        speed: float,
    ) -> tuple[float, float, list[float]]:
        """Return the force on the journal and the derivatives of the ring's states.

        Parameters
        ----------
        moving : (x, y, x', y')
            Place and velocity of the journal.
        inner : list of float
            The ring's place, and its velocity where it has a mass.
        viscosity, speed : float
            μ [Pa·s] and Ω [rad/s].

        Returns
        -------
        (float, float, list of float)
            f_x, f_y, and the derivatives by the angle of rotation.
        """
        x, y, dx, dy = moving
        r, (p, q) = self._ratio(viscosity, speed), inner[:2]
        if self._mass > 0.0:
            u, v = inner[2:]
            f = self._inside((x - p, y - q), (dx - u, dy - v), r)
            return *f, [u, v, *self._pushed(f, ((p, q), (u, v), r), viscosity, speed)]
        w = self._followed((x - p, y - q), (dx, dy), (p, q), r)
        f = self._inside((x - p, y - q), (dx - w[0], dy - w[1]), r)
        return *f, [*w]

    def velocity(
        self,
        moving: tuple[float, float, float, float],
        inner: list[float],
        viscosity: float,
        speed: float,
    ) -> tuple[float, float, list[float]]:
        """Return the journal's velocity and the same derivatives from the film's force on it.

        As `force`, with (x, y, f_x, f_y) of the journal.
        """
        x, y, f_x, f_y = moving
        r, (p, q) = self._ratio(viscosity, speed), inner[:2]
        one = 1.0 + r
        a, b = self._inner_film.velocity(x - p, y - q, f_x / one, f_y / one, self._slip)
        if self._mass > 0.0:
            u, v = inner[2:]
            rates = [u, v, *self._pushed((f_x, f_y), ((p, q), (u, v), r), viscosity, speed)]
        else:
            u, v = self._drifting((p, q), (f_x, f_y), r)
            rates = [u, v]
        return u + one * a, v + one * b, rates

    def forces(
        self, places: list[float], velocities: list[float], viscosity: float, speed: float
    ) -> list[float]:
        """Return the forces of the films on journal and ring, each in any motion.

        As `InnerMotion.forces`: the inner film pushes the ring against the journal.
        """
        x, y, p, q = places
        dx, dy, u, v = velocities
        r = self._ratio(viscosity, speed)
        f_x, f_y = self._inside((x - p, y - q), (dx - u, dy - v), r)
        g_x, g_y = self._outside((p, q), (u, v), r)
        return [f_x, f_y, g_x - f_x, g_y - f_y]

    def smooth(self, places: Array, velocities: Array, viscosity: float, speed: float) -> Array:
        """Return how far both films are from a wall and from their half speed whirl, (m,).

        There a film's force has no derivative; as `InnerMotion.smooth`.
        """
        r, wide = self._ratio(viscosity, speed), self.pair.wider
        place, velocity = places[:, 2:], velocities[:, 2:]
        slip = places[:, :2] - place, velocities[:, :2] - velocity
        return np.minimum(_smooth(*slip, 1.0, 1.0 + r), _smooth(place, velocity, wide, r))

    def _inside(self, place: _Vector, velocity: _Vector, r: float) -> _Vector:
        """Return the force of the inner film on the journal, which moves so in the ring."""
        one = 1.0 + r
        f_x, f_y = self._inner_film.force(*place, velocity[0] / one, velocity[1] / one)
        return one * f_x, one * f_y

    def _outside(self, place: _Vector, velocity: _Vector, r: float) -> _Vector:
        """Return the force of the outer film on the ring."""
        wide, unit = self.pair.wider, self.pair.force * r
        at, to = wide * r, (place[0] / wide, place[1] / wide)
        f_x, f_y = self._outer_film.force(*to, velocity[0] / at, velocity[1] / at)
        return unit * f_x, unit * f_y

    def _drifting(self, place: _Vector, f: _Vector, r: float) -> _Vector:
        """Return the velocity at which the outer film's force on the ring is the given one."""
        wide, unit = self.pair.wider, self.pair.force * r
        a, b = self._outer_film.velocity(
            place[0] / wide, place[1] / wide, f[0] / unit, f[1] / unit, self._drift
        )
        return wide * r * a, wide * r * b

    def _pushed(
        self, f: _Vector, ring: tuple[_Vector, _Vector, float], viscosity: float, speed: float
    ) -> _Vector:
        """Return the ring's acceleration, in CΩ²: the inner film pushes it against the journal."""
        g_x, g_y = self._outside(*ring)
        bearing = self.pair.bearing
        unit = float(FilmUnits(bearing, viscosity, speed).force)
        scale = unit / (self._mass * bearing.radial_clearance * speed * speed)
        return scale * (g_x - f[0]), scale * (g_y - f[1])

    def _followed(self, inside: _Vector, velocity: _Vector, outside: _Vector, r: float) -> _Vector:
        """Return the velocity of a massless ring while the journal moves as it does."""
        one, wide, unit = 1.0 + r, self.pair.wider, self.pair.force * r
        at = wide * r
        X, Y = outside[0] / wide, outside[1] / wide
        inner, outer = self._inner_film, self._outer_film

        def both(u: float, v: float) -> Answer:
            i = inner.answer(*inside, (velocity[0] - u) / one, (velocity[1] - v) / one)
            o = outer.answer(X, Y, u / at, v / at)
            more = unit / at
            return Answer(
                unit * o.f_x - one * i.f_x, unit * o.f_y - one * i.f_y,
                more * o.xx + i.xx, more * o.xy + i.xy, more * o.yx + i.yx, more * o.yy + i.yy,
                unit * at * o.potential + one * one * i.potential,
            )  # fmt: skip

        f = self._inside(inside, velocity, r)
        scale = _NOTHING + math.hypot(*f)
        return convex.velocity(both, 0.0, 0.0, self._held, scale=scale)


def _smooth(place: Array, velocity: Array, clearance: float, speed: float) -> Array:
    """Return the distance of one film from its wall and from half its speed of whirl, (m,)."""
    (x, y), (dx, dy), half = place.T, velocity.T, 0.5 * speed
    return np.minimum(np.hypot(dx + half * y, dy - half * x), clearance - np.hypot(x, y))
