"""The force of tilting pads on a moving journal, one point at a time, for integration.

A pad's film is that of a fixed one at (ξ, η) in motion (ξ', η'), from its impedance
(`films.finite.impedance`), with η' = q'·t + δ'. Wedge and squeeze drive it together,

    G = 6h_β + 12h_τ = −V cos(β − M),   V cos M = 6η + 12ξ',   V sin M = 12η' − 6ξ,

and the force is V times a function of place and M. Of a free pad without inertia it passes through
the pivot, which at any place is so at one M. So its force is proportional to 6η + 12ξ', and its
tilt follows; where that is negative there is no pressure, and the pad stays as it is unless its
film would have one. A pad with inertia has its tilt's rate as a state; one on a flexure without
inertia turns as fast as its moments balance, F_η = κ δ + c δ', with a friction c far below the
film's.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import NamedTuple, cast

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films import convex
from rotorcalc.films.convex import Answer
from rotorcalc.films.finite.impedance import Impedance, Shape, impedance
from rotorcalc.films.finite.motion import driven, pad_answers, placed
from rotorcalc.films.pads import Pad
from rotorcalc.films.tilting.family import generic_pad
from rotorcalc.films.tilting.pivots import Pivots, pivots_of
from rotorcalc.films.units import FilmUnits
from rotorcalc.geometry import TiltingPads
from rotorcalc.machine import JournalBearing

# About how long the table of a pad and a revolution take on a laptop's core, and a revolution with
# inertia of the pads, whose motion is fast.
SECONDS, REVOLUTION, HEAVY_REVOLUTION = 2.0, 0.2, 0.6
# Damping of a flexure, in μR³L/C³: above what the table's rounding may take away without a film.
_FRICTION = 5e-4
_MOST_STEPS, _TOLERANCE = 200, 1e-11
# Damping of a journal without mass where no pad presses on it: some velocity has any force.
_SUPPORT = 1e-7
# The farthest a film's middle lies from the pivot [rad].
_FARTHEST = 1.56


class Moving(NamedTuple):
    """Pads in motion, in the equation's units: F and C (N, 2), (N, 2, 2), Φ and δ' (N,).

    Where tilts follow the journal, C and Φ are those of its motion alone.
    """

    force: Array
    damping: Array
    potential: Array
    rates: Array


# The pads in motion over the journal's velocity in each pad's frame, (N, 2).
_Pads = Callable[[Array], Moving]


class _Films:
    """The films of pads at places (ξ, η) (N, 2), in any motion, from their table."""

    def __init__(self, table: Impedance, pad: Pad, at: Array) -> None:
        """Find the places in the table, which no velocity changes."""
        self._table = table
        self._placed = [placed(table, pad, *one) for one in at.tolist()]

    def moving(self, velocity: Array) -> tuple[Array, Array, Array]:
        """Return F (N, 2), C (N, 2, 2) and Φ (N,) at velocities (N, 2)."""
        pairs = zip(self._placed, velocity.tolist(), strict=True)
        drives = [driven(self._table, at, *one) for at, one in pairs]
        found = np.array(pad_answers(self._table, drives))
        return found[:, :2], found[:, 2:6].reshape(-1, 2, 2), found[:, 6]


@dataclass(frozen=True)
class PadsInMotion:
    """The pads of a bearing, and their force on a moving journal.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing.
    """

    bearing: JournalBearing
    # The last point's films' middles or tilts' rates, and the journal's velocity: how soon the next
    # are found, not what.
    _last: list[Array] = field(default_factory=list["Array"], init=False, repr=False, compare=False)
    _velocity: list[float] = field(
        default_factory=list["float"], init=False, repr=False, compare=False
    )

    def __reduce__(self) -> tuple[type, tuple[JournalBearing]]:
        """Return the bearing, with which another process makes the table again."""
        return type(self), (self.bearing,)

    @cached_property
    def _pivots(self) -> Pivots:
        return pivots_of(self.bearing)

    @cached_property
    def _frames(self) -> Array:
        return self._pivots.frames

    @cached_property
    def _onto_journal(self) -> tuple[Array, Array]:
        """Sums of the pads' forces and damping on the journal, as matrices (2N, 2) and (4N, 4)."""
        T = self._frames
        return T.reshape(-1, 2), np.einsum("nai,nbj->nabij", T, T).reshape(-1, 4)

    @cached_property
    def _pad(self) -> Pad:
        return generic_pad(self._pivots.arc, self._pivots.offset)

    @cached_property
    def _unit(self) -> float:
        """The film's unit of force over that of the table, μΩR³L/C²."""
        return (self.bearing.diameter / self.bearing.length) ** 2 / 4.0

    @property
    def shape(self) -> Shape:
        """The shape of a pad, which has a table."""
        return Shape(round(self._pad.arc, 9), 0.0, 4.0 * self._unit)

    @cached_property
    def _table(self) -> Impedance:
        return impedance(self.shape)

    @cached_property
    def _numbers(self) -> tuple[float, float]:
        """Stiffness of a pivot and inertia of a pad, as of a displacement δ R: [N/m], [kg]."""
        shape, square = cast("TiltingPads", self.bearing.geometry), self.bearing.radius**2
        return shape.rotational_stiffness / square, shape.pad_inertia / square

    @property
    def states(self) -> int:
        """Number of inner states: tilts, and their rates where pads have inertia."""
        return self._pivots.number * (2 if self._numbers[1] > 0.0 else 1)

    def force(
        self, moving: tuple[float, float, float, float], inner: list[float], mu: float, speed: float
    ) -> tuple[float, float, list[float]]:
        """Return the force on a moving journal and the rates of the inner states.

        As `InnerMotion.force`: from (x, y, x', y') in C and CΩ, in μΩRL³/C².
        """
        found = self._pads(moving[:2], inner, mu, speed)(self._frames @ np.array(moving[2:]))
        f_x, f_y = self._unit * (found.force.ravel() @ self._onto_journal[0])
        return float(f_x), float(f_y), self._rates(found, inner, mu, speed)

    def velocity(
        self, moving: tuple[float, float, float, float], inner: list[float], mu: float, speed: float
    ) -> tuple[float, float, list[float]]:
        """Return the journal's velocity at a force on it, and the rates of the inner states.

        As `InnerMotion.velocity`: from (x, y, f_x, f_y), as `convex.velocity`.
        """
        pads, seen = self._pads(moving[:2], inner, mu, speed), dict[tuple[float, float], Moving]()
        v_x, v_y = convex.velocity(
            partial(self._answer, pads, seen), moving[2], moving[3], self._velocity
        )
        return v_x, v_y, self._rates(seen[v_x, v_y], inner, mu, speed)

    def _answer(
        self, pads: _Pads, seen: dict[tuple[float, float], Moving], v_x: float, v_y: float
    ) -> Answer:
        """Return force, damping and potential over the journal's velocity, and keep the pads'."""
        found = seen[v_x, v_y] = pads(self._frames @ np.array([v_x, v_y]))
        force, damping = self._onto_journal
        unit, support = self._unit, self._unit * _SUPPORT
        f_x, f_y = (found.force.ravel() @ force).tolist()
        xx, xy, yx, yy = (found.damping.ravel() @ damping).tolist()
        return Answer(
            unit * f_x - support * v_x, unit * f_y - support * v_y,
            unit * xx + support, unit * xy, unit * yx, unit * yy + support,
            unit * float(found.potential.sum()) + 0.5 * support * (v_x * v_x + v_y * v_y),
        )  # fmt: skip

    def _rates(self, found: Moving, inner: list[float], mu: float, speed: float) -> list[float]:
        stiffness, mass = self._numbers
        if mass == 0.0:
            return found.rates.tolist()
        number, C = self._pivots.number, self.bearing.radial_clearance
        unit = float(FilmUnits(self.bearing, mu, speed).force)
        pushed = self._unit * unit * found.force[:, 1] - stiffness * C * np.array(inner[:number])
        return [*inner[number:], *(pushed / (mass * C * speed**2)).tolist()]

    def _pads(self, place: tuple[float, ...], inner: list[float], mu: float, speed: float) -> _Pads:
        """Return the pads' motion over the journal's, at its place and in their states."""
        number, (stiffness, mass) = self._pivots.number, self._numbers
        tilt, at = np.array(inner[:number]), self._frames @ np.array(place)
        at[:, 0] += self._pivots.preload
        at[:, 1] += tilt
        if mass > 0.0:
            return partial(self._heavy, self._films(at), np.array(inner[number:]))
        if stiffness == 0.0:
            return partial(self._free, at, *self._through_the_pivots(at))
        unit = float(FilmUnits(self.bearing, mu, speed).stiffness)
        return partial(self._sprung, self._films(at), stiffness / (unit * self._unit) * tilt)

    def _films(self, at: Array) -> _Films:
        return _Films(self._table, self._pad, at)

    def _heavy(self, films: _Films, rates: Array, way: Array) -> Moving:
        """Return pads with inertia, whose tilts' rates are given."""
        return Moving(*films.moving(way + np.stack([0.0 * rates, rates], axis=-1)), rates)

    def _through_the_pivots(self, at: Array) -> tuple[Array, Array]:
        """Return M at which the force passes through the pivot, and −F_ξ/(6η + 12ξ') there."""
        films, xi, eta = self._films(at), at[:, 0], at[:, 1]
        middle = self._last[0] if self._last else np.zeros(len(at))
        low, high = np.full(len(at), -_FARTHEST), np.full(len(at), _FARTHEST)
        for _ in range(_MOST_STEPS):
            cos, sin = np.cos(middle), np.sin(middle)
            # V = 1
            velocity = np.stack([cos - 6.0 * eta, sin + 6.0 * xi], axis=-1) / 12.0
            force, damping, _ = films.moving(velocity)
            slope = (damping[:, 1, 0] * sin - damping[:, 1, 1] * cos) / 12.0
            behind = force[:, 1] < 0.0  # the film's middle lies too far behind the pivot
            low, high = np.where(behind, low, middle), np.where(behind, middle, high)
            step = -force[:, 1] / np.minimum(slope, -1e-12)
            after = middle + step
            # A step below rounding leaves the bounds where it began from one of them.
            inside = (after > low) & (after < high) | (np.abs(step) <= _TOLERANCE)
            after = np.where(inside, after, 0.5 * (low + high))
            away = np.minimum(np.abs(after - middle), high - low)
            if np.all(away <= _TOLERANCE):
                self._last[:] = [middle]
                return middle, -force[:, 0] / cos
            middle = after
        raise ArithmeticError("no film of a pad was found whose force passes through its pivot")

    def _free(self, at: Array, M: Array, resistance: Array, way: Array) -> Moving:
        """Return free pads without inertia."""
        xi, eta = at[:, 0], at[:, 1]
        closing = 6.0 * eta + 12.0 * way[:, 0]  # V cos M
        pressed = np.maximum(closing, 0.0)
        # Without pressure the pad stays, unless that would build one at either end.
        most = np.maximum(-closing, 0.0)
        ahead, behind = most / np.tan(-self._pad.start), most / np.tan(self._pad.end)
        still: Array = np.clip(12.0 * way[:, 1] - 6.0 * xi, -ahead, behind)
        turning = np.where(closing > 0.0, pressed * np.tan(M), still)
        zero = np.zeros_like(pressed)
        damping = np.zeros((len(at), 2, 2))
        damping[:, 0, 0] = 12.0 * resistance * (closing > 0.0)
        return Moving(
            force=np.stack([-resistance * pressed, zero], axis=-1),
            damping=damping,
            potential=resistance * pressed**2 / 24.0,
            rates=(turning + 6.0 * xi) / 12.0 - way[:, 1],
        )

    def _sprung(self, films: _Films, moment: Array, way: Array) -> Moving:
        """Return pads on flexures without inertia, whose rates balance their moments."""
        rates = self._last[0] if self._last else np.zeros(len(moment))
        low, high = np.full(len(moment), -np.inf), np.full(len(moment), np.inf)
        for _ in range(_MOST_STEPS):
            force, C, potential = films.moving(way + np.stack([0.0 * rates, rates], axis=-1))
            left = force[:, 1] - moment - _FRICTION * rates
            low, high = np.where(left > 0.0, rates, low), np.where(left > 0.0, high, rates)
            resists = np.maximum(C[:, 1, 1], 0.0) + _FRICTION
            step = left / resists
            after = rates + step
            outside = np.isfinite(low) & np.isfinite(high) & ((after <= low) | (after >= high))
            outside &= np.abs(step) > _TOLERANCE * (1.0 + np.abs(rates))
            after[outside] = 0.5 * (low[outside] + high[outside])
            away = np.minimum(np.abs(after - rates), high - low)
            if np.all(away <= _TOLERANCE * (1.0 + np.abs(rates))):
                self._last[:] = [rates]
                damping = C - C[:, :, 1:] * (C[:, 1, :] / resists[:, None])[:, None, :]
                lost = potential + moment * rates + 0.5 * _FRICTION * rates**2
                return Moving(force, damping, lost, rates)
            rates = after
        raise ArithmeticError("no rate of a pad's tilt was found that balances its moments")
