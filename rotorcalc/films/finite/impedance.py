"""The force of one pad of finite length on a journal in any motion, tabulated for its shape.

Wedge and squeeze drive the film together, G = 6h_β + 12h_τ = −V cos(θ − m), with θ from the closest
approach; the film converges most at its middle, m. As nothing but p ≥ 0 makes the problem
nonlinear, the force is V times a function of the journal's place over the pad and of m alone. That
function depends on the pad's arc, its relief track and L/D, not on its preload nor on where in the
bore it lies, so that bores share tables.

The table's coordinates are dense where the film changes fast:

    τ = atanh s, e = s + (E − 1)s³, E(γ) at the wall: each step thins the film by one factor;
    γ, the journal's direction from the pad's middle;
    χ, which is m, stretched where an end of the film passes the closest approach.

Forces times (1 − s²)^1.5 are all of one order. Splines of the fifth degree join them. A pad is
symmetric about its middle, and e < 0 stands for the opposite direction.

Source: Childs, Moes and van Leeuwen, Journal bearing impedance descriptions for rotordynamic
applications, J. Lubr. Technol. 99 (1977), there for plain bearings, in two coordinates.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films.finite.reynolds import (
    Films,
    Mesh,
    banded,
    films,
    force_weights,
    mesh,
    refilled,
)
from rotorcalc.films.pads import Pad

# Cells around a pad, pressures along half of it; places between centre and wall, directions over
# half a turn, and films' middles over a whole one. With them stiffness and damping at rest are
# those of the linear theory to 0.1 % as a rule, to 0.5 % in nine states of ten.
_CELLS, _DEGREES = 64, 3
_PLACES, _DIRECTIONS, _MIDDLES = 22, 32, 40
# The farthest place of the table over the way to the wall.
_FARTHEST = 0.985
_DEGREE = 5
# Rows beyond an end of the table from which its splines' coefficients no longer feel the end.
_BEYOND, MARGIN = 8, 6
_TURN = 2.0 * math.pi
_GRADING = 0.9
# E(γ) is 2/(c + 1/2 + √((c − 1/2)² + soft²)), c the cosine beside the pad: smoothly the larger of c
# and ½ in the denominator; over the pad, c = 1, this is scaled to 1.
_BEHIND, _SOFT = 0.5, 0.125
_IN_FRONT = 1.0 + _BEHIND + math.hypot(1.0 - _BEHIND, _SOFT)
_LEAST = 1e-9
_MOST_SWEEPS = 200


@dataclass(frozen=True)
class Shape:
    """What the impedance of a pad depends on.

    Attributes
    ----------
    arc : float
        Angle of the pad [rad]; 2π where it is a full circle.
    track_ratio : float
        Width of its relief track over the bearing's length [-].
    slenderness : float
        (D/L)² [-].
    """

    arc: float
    track_ratio: float
    slenderness: float

    @property
    def is_closed(self) -> bool:
        """Whether it is a full circle."""
        return math.isclose(self.arc, _TURN)

    def distance(self, share: Array, gamma: Array) -> Array:
        """Return e at shares of the way to the wall.

        E(γ), just below where the journal touches the pad, is 1 over it, 1/cos beside it and a
        smooth curve behind it, where nothing is touched; near the centre all directions are equal.
        """
        away = np.abs(np.mod(gamma + math.pi, _TURN) - math.pi) - 0.5 * self.arc
        over = np.cos(np.maximum(away, 0.0)) - _BEHIND
        E = _IN_FRONT / (over + 2.0 * _BEHIND + np.hypot(over, _SOFT))
        return share + (E - 1.0) * share**3


@dataclass(frozen=True, eq=False)
class Impedance:
    """A pad's force over place and direction of motion, as splines' coefficients.

    Attributes
    ----------
    shape : Shape
        The pad's shape.
    coefficients : array
        Of the radial force, then of the tangential one, along the first axis.
    step : float
        Step of τ.
    directions : int
        Steps of γ over a turn; 1 where the force does not depend on it.
    rows : int
        Rows of one of the two forces.
    """

    shape: Shape
    coefficients: Array
    step: float
    directions: int
    rows: int

    def place(self, e: float, gamma: float) -> tuple[float, float, float]:
        """Return the share of the way to the wall, and the rows of τ and γ in the table."""
        away = max(abs(math.remainder(gamma, _TURN)) - 0.5 * self.shape.arc, 0.0)
        over = math.cos(away) - _BEHIND
        # E(γ) − 1, as `distance` has it for arrays, and the root s of e = s + (E − 1)s³.
        more = _IN_FRONT / (over + 2.0 * _BEHIND + math.hypot(over, _SOFT)) - 1.0
        share = e
        if more > _LEAST:
            root = math.sqrt(3.0 * more)
            share = 2.0 / root * math.sinh(math.asinh(1.5 * e * root) / 3.0)
        share = min(share, _FARTHEST)
        row = math.atanh(share) / self.step - 0.5 + _BEYOND
        return share, row, gamma % _TURN / _TURN * self.directions + MARGIN

    def middle(self, share: float, theta: float) -> tuple[float, float]:
        """Return the column of the film's middle θ in the table, and its derivative by θ."""
        g = _GRADING * share * share
        b = g / (1.0 + math.sqrt(1.0 - g * g))
        u = 2.0 * theta + math.pi
        chi = 0.5 * (u + 2.0 * math.atan2(b * math.sin(u), 1.0 - b * math.cos(u)) - math.pi)
        scale = _MIDDLES / _TURN
        slope = (1.0 - b * b) / (1.0 - 2.0 * b * math.cos(u) + b * b)
        return chi % _TURN * scale + MARGIN, slope * scale

    def scaled(self, rows: list[tuple[float, float, float]]) -> list[float]:
        """Return the table's values at places (τ, γ, χ) in rows and columns."""
        found = ndimage.map_coordinates(
            self.coefficients, np.array(rows).T, order=_DEGREE, prefilter=False
        )
        return found.tolist()


def _grading(share: Array) -> Array:
    g = _GRADING * share * share  # even, as e < 0 stands for the opposite direction
    return g / (1.0 + np.sqrt(1.0 - g * g))


@functools.lru_cache(maxsize=32)
def impedance(shape: Shape) -> Impedance:
    """Return the impedance of a pad, made once for its shape: some seconds."""
    return tabulated(shape)


def tabulated(shape: Shape) -> Impedance:
    """Return the impedance of a pad from solutions of Reynolds' equation."""
    step = math.atanh(_FARTHEST) / (_PLACES - 0.5)
    # Half a step from the centre, where directions have no meaning.
    share = np.tanh((np.arange(_PLACES) + 0.5) * step)
    chi = np.arange(_MIDDLES) * _TURN / _MIDDLES
    b = _grading(share)[:, None]
    u = 2.0 * chi + math.pi
    middle = 0.5 * (u - 2.0 * np.arctan2(b * np.sin(u), 1.0 + b * np.cos(u)) - math.pi)
    found = _closed(shape, share, middle) if shape.is_closed else _open(shape, share, middle)
    found *= (1.0 - share[:, None, None] ** 2) ** 1.5
    whole = _extended(found)
    coefficients = [ndimage.spline_filter(one, order=_DEGREE) for one in whole]
    return Impedance(shape, np.concatenate(coefficients), step, found.shape[2], whole.shape[1])


def _open(shape: Shape, share: Array, middle: Array) -> Array:
    """Return radial and tangential force, (2, places, directions, middles), of an open pad."""
    gamma = np.arange(_DIRECTIONS + 1) * math.pi / _DIRECTIONS
    half = 0.5 * shape.arc
    grid = _mesh(shape, Pad(-half, half, track_ratio=shape.track_ratio))
    e = shape.distance(share[:, None], gamma)
    found = np.empty((2, _PLACES, _DIRECTIONS + 1, _MIDDLES))
    wet = None
    for i in range(_PLACES):
        middles = np.broadcast_to(middle[i], (len(gamma), _MIDDLES))
        # The last place's films are near those of the next.
        found[:, i], wet = _forces(grid, e[i], gamma, middles, wet)
    # The mirrored motion has the mirrored force.
    other = found[:, :, -2:0:-1][..., -np.arange(_MIDDLES) % _MIDDLES]
    return np.concatenate([found, other * np.array([1.0, -1.0])[:, None, None, None]], axis=2)


def _closed(shape: Shape, share: Array, middle: Array) -> Array:
    """Return the same of a full circle, where the journal's direction does not matter."""
    grid = _mesh(shape, Pad(-math.pi, math.pi))
    # The circle is cut open opposite the middle of the converging film.
    e = np.repeat(share, _MIDDLES)
    found, _ = _forces(grid, e, -middle.ravel(), middle.reshape(-1, 1))
    return found.reshape(2, _PLACES, 1, _MIDDLES)


def _mesh(shape: Shape, pad: Pad) -> Mesh:
    cells = 2 * _CELLS if shape.is_closed else _CELLS
    return mesh((pad,), shape.slenderness, cells, _DEGREES)


def _extended(found: Array) -> Array:
    """Return a table with rows beyond its ends: periodic, and through the centre e < 0."""
    middles = found.shape[3]
    # At e < 0 both axes of the frame are turned round, and the film's middle with them.
    through = -np.roll(found[:, :_BEYOND], (-(found.shape[2] // 2), -middles // 2), (2, 3))
    outside = 2.0 * found[:, -1:] - found[:, -2 : -_BEYOND - 2 : -1]
    whole = np.concatenate([through[:, ::-1], found, outside], axis=1)
    return np.pad(whole, ((0, 0), (0, 0), (MARGIN, MARGIN), (MARGIN, MARGIN)), mode="wrap")


def _forces(
    grid: Mesh, e: Array, gamma: Array, middle: Array, wet: BoolArray | None = None
) -> tuple[Array, BoolArray]:
    """Return radial and tangential force, (2, P, D), and the active set, (P·D, 1, nodes, m).

    At places (P,) and for films that converge most at `middle` (P, D): G = −cos(θ − middle). The
    search begins with an active set, or where G would press.
    """
    cos, sin = np.cos(gamma)[:, None, None, None], np.sin(gamma)[:, None, None, None]
    found = films(grid, np.stack([e * cos[:, 0, 0, 0], e * sin[:, 0, 0, 0]], axis=-1))
    loads = force_weights(found)
    radial, tangential = cos * loads[0] + sin * loads[1], cos * loads[1] - sin * loads[0]
    # The wedge, G = sin θ, by its exact flux; squeeze by the weights of the force.
    Q = found.entrained
    wedge = (Q[:, :, :-1] - Q[:, :, 1:]) / (6.0 * e[:, None, None, None])
    m = middle[:, :, None, None]
    right = -wedge * np.sin(m) - 2.0 * radial * np.cos(m)
    flat = (right.shape[0] * right.shape[1], 1, *right.shape[2:])
    if wet is None:
        theta = found.beta[:, :, 1:-1, None] - gamma[:, None, None, None]
        wet = np.broadcast_to(np.cos(theta - m) > 0.0, right.shape).reshape(flat)
    rows = np.repeat(np.arange(len(e)), middle.shape[1])
    p, wet = _settled(found, rows, right.reshape(flat), wet.copy())
    p = p.reshape(right.shape)
    return np.stack([(p * radial).sum(axis=(2, 3)), (p * tangential).sum(axis=(2, 3))]), wet


def _settled(found: Films, rows: IntArray, right: Array, wet: BoolArray) -> tuple[Array, BoolArray]:
    """Return pressures (S, 1, nodes, m) of films at some rows, and their active sets."""
    p, active = np.zeros_like(right), np.arange(len(rows))
    for _ in range(_MOST_SWEEPS):
        here = found.taken(rows[active])
        now = banded(here, here.conductance, wet[active], [right[active]])[0]
        after = refilled(here, wet[active], now, right[active])
        p[active] = now
        changed = (after != wet[active]).any(axis=(1, 2, 3))
        wet[active] = after
        active = active[changed]
        if not active.size:
            return p, wet
    raise ArithmeticError("the film of a pad in motion has not settled")
