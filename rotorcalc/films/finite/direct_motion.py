"""The force of pads with pockets on a moving journal: Reynolds' equation solved at each point.

A pocket's step drives the film beside wedge and squeeze, so its pads have no table of two
coordinates and a direction (`impedance`). Their pressures are solved for the journal's place and
velocity, from the active set of the point before, which is seldom more than a node away.
"""

from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

import numpy as np

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films import convex
from rotorcalc.films.convex import Answer
from rotorcalc.films.finite.reynolds import (
    SQUEEZE,
    Films,
    Mesh,
    banded,
    films,
    force_weights,
    mesh,
    refilled,
)
from rotorcalc.films.pads import pads_of
from rotorcalc.machine import JournalBearing

# Cells around a pad, pressures along half of it. Stiffness and damping at rest are then those of
# the film's own table to 0.5 % as a rule; to 4 %, as both are, where several pads take up films.
_CELLS, _DEGREES = 64, 5
# About how long a revolution takes on a laptop's core, at the tolerance of a chart.
SOLVED_REVOLUTION = 0.2
_MOST_SWEEPS, _FEW_SWEEPS = 200, 12
# Determinant of the damping over its trace's square, below which it resists in one direction only.
_LEAST = 1e-12


class _Place(NamedTuple):
    """The films at one place of the journal, the flux of their wedge, and the force's weights."""

    films: Films
    wedge: Array
    weights: tuple[Array, Array]


@dataclass(frozen=True)
class SolvedPadsInMotion:
    """The pads of a bearing of finite length, solved for each motion of the journal.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing.
    """

    bearing: JournalBearing
    # Where the film was full at the point before: how soon the next is found, not what it is.
    _wet: list[BoolArray] = field(
        default_factory=list["BoolArray"], init=False, repr=False, compare=False
    )

    def __reduce__(self) -> tuple[type, tuple[JournalBearing]]:
        """Return the bearing, with which another process begins anew."""
        return type(self), (self.bearing,)

    @property
    def _unit(self) -> float:
        """The film's unit of force over that of the equation, μΩR³L/C²."""
        return (self.bearing.diameter / self.bearing.length) ** 2 / 4.0

    @property
    def _mesh(self) -> Mesh:
        return mesh(pads_of(self.bearing), 4.0 * self._unit, _CELLS, _DEGREES)

    def force(self, x: float, y: float, dx: float, dy: float) -> tuple[float, float]:
        """Return the film's force on a moving journal, as `FinitePadsInMotion.force`."""
        place = self._place(x, y)
        pressure, *_ = self._pressure(place, dx, dy)
        f_x, f_y = (float((pressure * weight).sum()) for weight in place.weights)
        return self._unit * f_x, self._unit * f_y

    def velocity(
        self, x: float, y: float, f_x: float, f_y: float, near: list[float] | None = None
    ) -> tuple[float, float]:
        """Return the velocity at which the film's force is the given one, as `convex.velocity`.

        Where the film stays full as it is, the force is linear in the velocity: both are found
        together. Where no such film settles, the convex search does it.
        """
        place = self._place(x, y)
        found = self._with_film(place, np.array([f_x, f_y])) if self._wet else None
        if found is None:
            found = convex.velocity(partial(self._answer, place), f_x, f_y, near)
        if near is not None:
            near[:] = found
        return found

    def _with_film(self, place: _Place, force: Array) -> tuple[float, float] | None:
        """Return the velocity, and keep the film that is full there; None where none settles."""
        weights = np.stack(place.weights)
        flat, wet, G = weights.reshape(2, -1), self._wet[0], place.films.conductance
        for _ in range(_FEW_SWEEPS):
            still, *moved = banded(place.films, G, wet, [place.wedge, *weights])
            C: Array = -SQUEEZE * np.stack(moved).reshape(2, -1) @ flat.T
            # Without a film that resists in all directions there is no one velocity.
            if not np.linalg.det(C) > _LEAST * np.trace(C) ** 2:
                return None
            v = np.asarray(np.linalg.solve(C, flat @ still.ravel() - force / self._unit), float)
            drive = SQUEEZE * v
            pressure = still + drive[0] * moved[0] + drive[1] * moved[1]
            right = place.wedge + drive[0] * weights[0] + drive[1] * weights[1]
            after = refilled(place.films, wet, pressure, right)
            if np.array_equal(after, wet):
                self._wet[:] = [wet]
                return float(v[0]), float(v[1])
            wet = after
        return None

    def _place(self, x: float, y: float) -> _Place:
        found = films(self._mesh, np.array([[x, y]]))
        Q = found.entrained
        return _Place(found, Q[:, :, :-1] - Q[:, :, 1:], force_weights(found))

    def _answer(self, place: _Place, dx: float, dy: float) -> Answer:
        pressure, right, adjoint = self._pressure(place, dx, dy, place.weights)
        flat = np.reshape(place.weights, (2, -1))
        force, C = flat @ pressure.ravel(), -SQUEEZE * adjoint.reshape(2, -1) @ flat.T
        potential = (pressure * right).sum() / (-2.0 * SQUEEZE)
        return Answer(*(self._unit * np.array([*force, *C.ravel(), potential])).tolist())

    def _pressure(
        self, place: _Place, dx: float, dy: float, also: tuple[Array, ...] = ()
    ) -> tuple[Array, Array, Array]:
        """Return the pressures, the right side that they balance, and those of other right sides.

        The others are solved where the film is full.
        """
        w_x, w_y = place.weights
        right = place.wedge + SQUEEZE * (dx * w_x + dy * w_y)
        wet = self._wet[0] if self._wet else right > 0.0
        G = place.films.conductance
        for _ in range(_MOST_SWEEPS):
            pressure, *others = banded(place.films, G, wet, [right, *also])
            after = refilled(place.films, wet, pressure, right)
            if np.array_equal(after, wet):
                self._wet[:] = [wet]
                return pressure, right, np.array(others)
            wet = after
        raise ArithmeticError("the film of a pad in motion has not settled")
