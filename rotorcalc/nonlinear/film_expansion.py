"""Second and third derivatives of a film's force about a journal in equilibrium.

They are those of polynomials through the force at Chebyshev points on lines through the state of
equilibrium (x, x') = (x_0, 0), so they exist for every film model with a force on a moving journal.
The admissible length of a line depends on its direction: the force is singular at the wall, and not
smooth where squeeze and wedge cancel, as in a plain bearing at half-speed whirl. So each line is
shortened step by step. On too long a line the polynomial does not converge, on too short a one
rounding dominates: the length is taken at which the result changes least, and the polynomial's last
coefficients vanish. For changes alone do not tell: from far away a force that turns round at the
rest is odd, and its second derivative is zero on any line that is too long.
"""

from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.nonlinear.film_forces import Forces

# The first length over the distance to the wall, the ratio of successive lengths, their number.
_FARTHEST, _SHORTER, _MOST_REACHES = 0.9, 0.6, 40
# The search ends where the change, once below this share of the derivative, has grown tenfold.
_RESOLVED = 1e-6
# Directions in the plane of a whirl, four over half a turn: they resolve its first three harmonics.
_PHASES = np.pi * np.arange(4) / 4.0


class WhirlDerivatives(NamedTuple):
    """Derivatives along a whirl Q: D²F(Q, Q), D²F(Q, Q̄) and D³F(Q, Q, Q̄), each (d,)."""

    QQ: ComplexArray
    QQ_: Array
    QQQ_: ComplexArray


class FilmExpansion:
    """The film's forces about d coordinates at rest, positions in C and velocities in CΩ.

    Parameters
    ----------
    force : callable
        The d forces from d places and d velocities, as (f_x, f_y) from (x, y, x', y'), in the
        film's unit.
    place : array, (d,)
        Equilibrium of the journal, and of the film's inner coordinates, in C.
    gap : float
        Minimum film thickness there, in C: the distance to the wall.
    points : int
        Points on a line.
    """

    def __init__(self, force: Forces, place: Array, gap: float, points: int) -> None:
        self.force, self.gap = force, gap
        self.rest = np.concatenate([place, np.zeros_like(place)])
        self.nodes = np.cos(np.pi * (np.arange(points) + 0.5) / points)
        fit = np.linalg.inv(chebyshev.chebvander(self.nodes, points - 1))
        self.slopes = np.stack([_at_middle(points, order) @ fit for order in (2, 3)])
        # A polynomial's last coefficients, each as the derivatives at the middle that it may give.
        self.tail = np.stack([points**order * fit[-2:] for order in (2, 3)])

    def along(self, direction: Array) -> Array:
        """Return the second and third derivatives of the forces along a direction, (2, d)."""
        size = float(np.linalg.norm(direction))
        unit = direction / size
        # A line mostly along velocity hardly approaches the wall: its length is bounded anyway.
        reach = _FARTHEST * self.gap / max(float(np.linalg.norm(unit[: len(unit) // 2])), 0.1)
        last = best = self._tried(unit, reach)[0]
        least = np.full(2, np.inf)
        for _ in range(_MOST_REACHES):
            reach *= _SHORTER
            found, doubt = self._tried(unit, reach)
            # Second and third derivative each take the length at which they are least in doubt.
            change = np.maximum(np.abs(found - last).max(axis=1), doubt)
            best = np.where((change < least)[:, None], found, best)
            least, last = np.minimum(change, least), found
            if np.all(least < _RESOLVED * np.abs(best).max(axis=1)) and np.all(change > 10 * least):
                break
        return best * np.array([[size**2], [size**3]])

    def second(self, u: ComplexArray, v: ComplexArray) -> ComplexArray:
        """Return the second derivative D²F(u, v), complex (d,)."""
        return (
            self._second(u.real, v.real)
            - self._second(u.imag, v.imag)
            + 1j * (self._second(u.real, v.imag) + self._second(u.imag, v.real))
        )

    def whirl(self, Q: ComplexArray) -> WhirlDerivatives:
        """Return the derivatives along a whirl Re{Q e^{jθ}}, harmonics of those along its lines."""
        lines = np.array([self.along(np.real(Q * np.exp(1j * phase))) for phase in _PHASES])
        second, third = lines[:, 0], lines[:, 1]
        turn = np.exp(-1j * _PHASES)[:, None]
        # On u = Re{Q e^{jθ}} D²F(u, u) = ½D²F(Q, Q̄) + ½Re{D²F(Q, Q) e^{2jθ}}, and
        # D³F(u, u, u) has the first harmonic ¾Re{D³F(Q, Q, Q̄) e^{jθ}}.
        return WhirlDerivatives(
            QQ=4.0 * np.mean(turn**2 * second, axis=0),
            QQ_=2.0 * np.mean(second, axis=0),
            QQQ_=8.0 / 3.0 * np.mean(turn * third, axis=0),
        )

    def _second(self, u: Array, v: Array) -> Array:
        sizes = float(np.linalg.norm(u)), float(np.linalg.norm(v))
        if 0.0 in sizes:
            return np.zeros(len(self.rest) // 2)
        u, v = u / sizes[0], v / sizes[1]
        total, difference = self._curvature(u + v), self._curvature(u - v)
        return sizes[0] * sizes[1] * (total - difference) / 4.0

    def _curvature(self, direction: Array) -> Array:
        if not np.any(direction):
            return np.zeros(len(self.rest) // 2)
        return self.along(direction)[0]

    def _tried(self, unit: Array, reach: float) -> tuple[Array, Array]:
        """Return both derivatives by a polynomial over a line of this reach, and what it omits."""
        states = self.rest + reach * self.nodes[:, None] * unit
        forces = np.array([self.force(*state) for state in states.tolist()])
        scale = np.array([reach**2, reach**3])
        found, left = self.slopes @ forces, np.abs(self.tail @ forces).max(axis=(1, 2))
        return found / scale[:, None], left / scale


def _at_middle(points: int, order: int) -> Array:
    """Return the derivatives of an order of Chebyshev's polynomials at 0."""
    return np.array([
        chebyshev.chebval(0.0, chebyshev.chebder(row, order)) for row in np.eye(points)
    ], dtype=float)  # fmt: skip
