"""The force of pads of finite length on a moving journal, one point at a time, for integration.

Each pad's force is the speed of its wedge and squeeze, V, times its impedance (`impedance`); the
tables are made when the first force is asked for.
"""

import math
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from rotorcalc.films import convex
from rotorcalc.films.convex import Answer
from rotorcalc.films.finite.impedance import Impedance, Shape, impedance
from rotorcalc.films.pads import Pad, pads_of
from rotorcalc.machine import JournalBearing

# Gap below which the force is held, in C.
THINNEST = 0.02
# How far stiffness and damping at rest may be from the film's own, over their largest entry.
APART = 0.005
# About how long a table and a revolution take on a laptop's core, at the tolerance of a chart.
SECONDS, REVOLUTION = 2.0, 0.03
# Difference of a film's middle for derivatives, in columns of the table.
_BESIDE = 1e-3


class Drive(NamedTuple):
    """What one pad's film is driven by: G = 6h_β + 12h_τ = a sin θ + b cos θ, θ from `cos`, `sin`.

    V is `speed`, and a = −V sin m, b = −V cos m. `row`, `turn` and `column` are its place in the
    pad's table, `slope` the column's derivative by m, `scale` the force over the table's value.
    """

    cos: float
    sin: float
    cos_m: float
    sin_m: float
    speed: float
    scale: float
    row: float
    turn: float
    column: float
    slope: float


class Placed(NamedTuple):
    """The journal's place from a pad's centre of curvature, and in the pad's table."""

    e_x: float
    e_y: float
    cos: float
    sin: float
    share: float
    row: float
    turn: float
    scale: float


@dataclass(frozen=True)
class FinitePadsInMotion:
    """The pads of a bearing of finite length, and their force on a moving journal.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing; without pockets.
    """

    bearing: JournalBearing

    def __reduce__(self) -> tuple[type, tuple[JournalBearing]]:
        """Return the bearing, with which another process makes the tables again."""
        return type(self), (self.bearing,)

    @cached_property
    def _by_shape(self) -> dict[Shape, list[Pad]]:
        groups: dict[Shape, list[Pad]] = {}
        for pad in pads_of(self.bearing):
            shape = Shape(round(pad.arc, 9), pad.track_ratio, 4.0 * self._unit)
            groups.setdefault(shape, []).append(pad)
        return groups

    @property
    def shapes(self) -> tuple[Shape, ...]:
        """The pads' different shapes, each of which has a table."""
        return tuple(self._by_shape)

    @cached_property
    def _groups(self) -> list[tuple[Impedance, list[Pad]]]:
        """Each table, with the pads that it is for."""
        return [(impedance(shape), pads) for shape, pads in self._by_shape.items()]

    @cached_property
    def _unit(self) -> float:
        """The film's unit of force over that of the tables, μΩR³L/C²."""
        return (self.bearing.diameter / self.bearing.length) ** 2 / 4.0

    def force(self, x: float, y: float, dx: float, dy: float) -> tuple[float, float]:
        """Return the film's force on a moving journal.

        Parameters
        ----------
        x, y : float
            Journal centre from the bearing's centre, in C.
        dx, dy : float
            Its velocity, in CΩ.

        Returns
        -------
        (float, float)
            Force in X and Y, in μΩRL³/C².
        """
        f_x = f_y = 0.0
        for table, pads in self._groups:
            drives = [drive(table, pad, (x, y, dx, dy)) for pad in pads]
            found = table.scaled(
                [
                    (one.row + half, one.turn, one.column)
                    for half in (0, table.rows)
                    for one in drives
                ]
            )
            for one, f_r, f_t in zip(drives, found, found[len(drives) :], strict=False):
                size = one.scale * one.speed * self._unit
                f_x += size * (f_r * one.cos - f_t * one.sin)
                f_y += size * (f_r * one.sin + f_t * one.cos)
        return f_x, f_y

    def velocity(
        self, x: float, y: float, f_x: float, f_y: float, near: list[float] | None = None
    ) -> tuple[float, float]:
        """Return the velocity at which the film's force on the journal is the given one.

        As `convex.velocity`, of which the journal's place (x, y), in C, is given.
        """
        return convex.velocity(partial(self._answer, x, y), f_x, f_y, near)

    def _answer(self, x: float, y: float, dx: float, dy: float) -> Answer:
        total = np.zeros(7)
        for table, pads in self._groups:
            drives = [drive(table, pad, (x, y, dx, dy)) for pad in pads]
            total += np.sum(pad_answers(table, drives), axis=0)
        return Answer(*(total * self._unit).tolist())


def drive(table: Impedance, pad: Pad, motion: tuple[float, float, float, float]) -> Drive:
    """Return what drives a pad's film, of the journal's motion (x, y, x', y') in C and CΩ."""
    return driven(table, placed(table, pad, *motion[:2]), *motion[2:])


def placed(table: Impedance, pad: Pad, x: float, y: float) -> Placed:
    """Return the journal's place (x, y), in C, over a pad and in its table."""
    e_x, e_y = x - pad.a_x, y - pad.a_y
    e = math.hypot(e_x, e_y)
    cos, sin = (e_x / e, e_y / e) if e > 0.0 else (1.0, 0.0)
    share, row, turn = table.place(e, math.atan2(e_y, e_x) - 0.5 * (pad.start + pad.end))
    return Placed(e_x, e_y, cos, sin, share, row, turn, (1.0 - share * share) ** -1.5)


def driven(table: Impedance, at: Placed, dx: float, dy: float) -> Drive:
    """Return what drives the film of a pad at a velocity of the journal, in CΩ."""
    e_x, e_y, cos, sin, share, row, turn, scale = at
    A, B = 6.0 * e_x - 12.0 * dy, -6.0 * e_y - 12.0 * dx
    # Along and across the line of centres.
    a, b = A * cos - B * sin, A * sin + B * cos
    # G = −V cos(θ − m): the film converges most at its middle m.
    m = math.atan2(-a, -b)
    column, slope = table.middle(share, m)
    return Drive(
        cos, sin, math.cos(m), math.sin(m), math.hypot(a, b), scale, row, turn, column, slope
    )


def pad_answers(table: Impedance, drives: list[Drive]) -> list[tuple[float, ...]]:
    """Return the fields of `Answer` for each of some pads, in μΩR³L/C² and its like."""
    found = table.scaled([
        (one.row + half, one.turn, one.column + beside)
        for one in drives
        for half in (0, table.rows)
        for beside in (0.0, _BESIDE, -_BESIDE)
    ])  # fmt: skip
    return [_pad_answer(one, found[6 * i : 6 * i + 6]) for i, one in enumerate(drives)]


def _pad_answer(at: Drive, found: list[float]) -> tuple[float, ...]:
    """Return the fields of `Answer` for one pad, from its table's six values."""
    f_r, f_t = (at.scale * found[0], at.scale * found[3])
    by_middle = at.scale * at.slope / (2.0 * _BESIDE)
    d_r, d_t = by_middle * (found[1] - found[2]), by_middle * (found[4] - found[5])
    # a = −V sin m = −12 v_t + ..., b = −V cos m = −12 v_r + ..., and F = V f(m).
    cos_m, sin_m = at.cos_m, at.sin_m
    rr, rt = 12.0 * (d_r * sin_m - f_r * cos_m), -12.0 * (d_r * cos_m + f_r * sin_m)
    tr, tt = 12.0 * (d_t * sin_m - f_t * cos_m), -12.0 * (d_t * cos_m + f_t * sin_m)
    c, s = at.cos, at.sin
    # From (r, t) to X, Y: C = T C_rt Tᵀ.
    r_x, r_y, t_x, t_y = rr * c - rt * s, rr * s + rt * c, tr * c - tt * s, tr * s + tt * c
    V = at.speed
    return (
        V * (f_r * c - f_t * s), V * (f_r * s + f_t * c),
        r_x * c - t_x * s, r_y * c - t_y * s, r_x * s + t_x * c, r_y * s + t_y * c,
        -V * V * (f_r * cos_m + f_t * sin_m) / 24.0,
    )  # fmt: skip
