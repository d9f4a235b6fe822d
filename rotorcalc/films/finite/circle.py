"""The force of a full circular film of finite length on a moving journal, one point at a time.

Of a full circle the journal's direction does not matter, so its table (`impedance`) has two
coordinates: τ, the journal's place, and χ, the film's middle m. Its splines are polynomials of the
fifth degree between two middles, which give force and slope at once, in plain floats.

The force opposes the film's closing, which is fastest at m: its direction is within 90° of m + π,
and turns with m, as the film's loss is convex (`convex`). So the velocity for a given force is one
equation for m, with a bracket of 180°, and V follows from the force's size.
"""

import functools
import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.convex import Answer
from rotorcalc.films.finite.impedance import MARGIN, Impedance, Shape, impedance
from rotorcalc.films.pads import pads_of
from rotorcalc.machine import JournalBearing

# B-splines of the fifth degree over the share t of a step, by powers of t (columns), times 120.
_SPLINES = (
    np.array([
        [1, -5, 10, -10, 5, -1],
        [26, -50, 20, 20, -20, 5],
        [66, 0, -60, 0, 30, -10],
        [26, 50, 20, -20, -20, 10],
        [1, 5, 10, 10, 5, -5],
        [0, 0, 0, 0, 0, 1],
    ])
    / 120.0
)  # fmt: skip
# The spline of a place i + t begins two coefficients before i.
_BEFORE = 2
# About how long a table and a revolution take on a laptop's core, at the tolerance of a chart.
CIRCLE_SECONDS, CIRCLE_REVOLUTION = 0.6, 0.01
_MOST_STEPS, _LAST_STEP, _TOLERANCE = 80, 1e-9, 4e-15


class _Film(NamedTuple):
    """The film at one place of the journal: its line of centres, the table's rows and share."""

    cos: float
    sin: float
    first: int
    weights: Array
    share: float
    scale: float


class _Force(NamedTuple):
    """Force along and across the line of centres at V = 1, and its derivatives by m."""

    f_r: float
    f_t: float
    d_r: float
    d_t: float


@dataclass(frozen=True)
class CircleInMotion:
    """A full circular film, and its force on a moving journal.

    Attributes
    ----------
    bearing : JournalBearing
        The plain bearing.
    """

    bearing: JournalBearing

    def __reduce__(self) -> tuple[type, tuple[JournalBearing]]:
        """Return the bearing, with which another process makes the table again."""
        return type(self), (self.bearing,)

    @property
    def shape(self) -> Shape:
        """The film's shape, which has a table."""
        return Shape(round(2.0 * math.pi, 9), 0.0, 4.0 * self._unit)

    @cached_property
    def _unit(self) -> float:
        """The film's unit of force over that of the table, μΩR³L/C²."""
        return (self.bearing.diameter / self.bearing.length) ** 2 / 4.0

    @cached_property
    def _table(self) -> Impedance:
        return impedance(self.shape)

    @cached_property
    def _polynomials(self) -> Array:
        return polynomials(self.shape)

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
        film = self._film(x, y)
        V, m = _driven(film, (x, y, dx, dy))
        f_r, f_t, *_ = self._at(film, m)
        size = V * self._unit
        return size * (f_r * film.cos - f_t * film.sin), size * (f_r * film.sin + f_t * film.cos)

    def answer(self, x: float, y: float, dx: float, dy: float) -> Answer:
        """Return the force, its derivatives by velocity and its potential, in film units."""
        film = self._film(x, y)
        V, m = _driven(film, (x, y, dx, dy))
        f_r, f_t, d_r, d_t = self._at(film, m)
        c, s, cos, sin, u = film.cos, film.sin, math.cos(m), math.sin(m), self._unit
        # F = V f(m), and V (cos m, sin m) = 12 v + ... along and across the line of centres.
        rr, rt = 12.0 * (f_r * cos - d_r * sin), 12.0 * (f_r * sin + d_r * cos)
        tr, tt = 12.0 * (f_t * cos - d_t * sin), 12.0 * (f_t * sin + d_t * cos)
        # From (r, t) to X, Y, C = −∂F/∂v.
        r_x, r_y, t_x, t_y = rr * c - rt * s, rr * s + rt * c, tr * c - tt * s, tr * s + tt * c
        return Answer(
            u * V * (f_r * c - f_t * s), u * V * (f_r * s + f_t * c),
            u * (t_x * s - r_x * c), u * (t_y * s - r_y * c),
            -u * (r_x * s + t_x * c), -u * (r_y * s + t_y * c),
            -u * V * V * (f_r * cos + f_t * sin) / 24.0,
        )  # fmt: skip

    def velocity(
        self, x: float, y: float, f_x: float, f_y: float, near: list[float] | None = None
    ) -> tuple[float, float]:
        """Return the velocity at which the film's force on the journal is the given one.

        Parameters
        ----------
        x, y : float
            Journal centre from the bearing's centre, in C.
        f_x, f_y : float
            Force of the film in X and Y, in μΩRL³/C².
        near : list or None
            In it one search leaves the starting value of the next.

        Returns
        -------
        (float, float)
            Velocity in X and Y, in CΩ.

        Raises
        ------
        ArithmeticError
            Where the search does not converge, or the force is not finite.
        """
        size = math.hypot(f_x, f_y)
        if size == 0.0:  # half-speed whirl: neither wedge nor squeeze
            return -0.5 * y, 0.5 * x
        film = self._film(x, y)
        c, s = film.cos, film.sin
        F_r, F_t = (f_x * c + f_y * s) / size, (f_y * c - f_x * s) / size
        opposite = math.atan2(-F_t, -F_r)
        low, high = opposite - 0.5 * math.pi, opposite + 0.5 * math.pi
        m = opposite + (near[0] if near else 0.0)
        for _ in range(_MOST_STEPS):
            f_r, f_t, d_r, d_t = self._at(film, m)
            error = math.atan2(F_r * f_t - F_t * f_r, F_r * f_r + F_t * f_t)
            if error > 0.0:
                high = m
            else:
                low = m
            turn = (f_r * d_t - f_t * d_r) / (f_r * f_r + f_t * f_t)
            after = m - error / turn if turn > 0.0 else math.nan
            if abs(after - m) <= _LAST_STEP or high - low <= _TOLERANCE:
                if near is not None:
                    near[:] = (after - opposite,)
                # Along the force to first order in the last step.
                along = F_r * f_r + F_t * f_t + (after - m) * (F_r * d_r + F_t * d_t)
                V = size / (self._unit * along) / 12.0
                v_r, v_t = V * math.cos(after), V * math.sin(after)
                return v_r * c - v_t * s - 0.5 * y, v_r * s + v_t * c + 0.5 * x
            m = after if low < after < high else 0.5 * (low + high)
        raise ArithmeticError(f"no velocity found for the film force ({f_x}, {f_y})")

    def _film(self, x: float, y: float) -> _Film:
        e = math.hypot(x, y)
        if not math.isfinite(e):
            raise ArithmeticError(f"no film around a journal at ({x}, {y})")
        cos, sin = (x / e, y / e) if e > 0.0 else (1.0, 0.0)
        share, row, _ = self._table.place(e, 0.0)
        i = math.floor(row)
        t = row - i
        weights = _SPLINES @ np.array([1.0, t, t * t, t**3, t**4, t**5])
        return _Film(cos, sin, i - _BEFORE, weights, share, (1.0 - share * share) ** -1.5)

    def _at(self, film: _Film, m: float) -> _Force:
        """Return the force at V = 1 of the film with its middle at m, in μΩR³L/C²."""
        if not math.isfinite(m):
            raise ArithmeticError(f"no force of the film with its middle at {m}")
        column, slope = self._table.middle(film.share, m)
        j = math.floor(column)
        t = column - j
        rows = self._polynomials[film.first : film.first + 6, j - _BEFORE]
        a0, a1, a2, a3, a4, a5, b0, b1, b2, b3, b4, b5 = (film.weights @ rows).tolist()
        k, by_m = film.scale, film.scale * slope
        return _Force(
            k * (a0 + t * (a1 + t * (a2 + t * (a3 + t * (a4 + t * a5))))),
            k * (b0 + t * (b1 + t * (b2 + t * (b3 + t * (b4 + t * b5))))),
            by_m * (a1 + t * (2.0 * a2 + t * (3.0 * a3 + t * (4.0 * a4 + t * 5.0 * a5)))),
            by_m * (b1 + t * (2.0 * b2 + t * (3.0 * b3 + t * (4.0 * b4 + t * 5.0 * b5)))),
        )


def _driven(film: _Film, motion: tuple[float, float, float, float]) -> tuple[float, float]:
    """Return V and m of the journal's motion (x, y, x', y') in C and CΩ.

    Wedge and squeeze together close the film by V cos(θ − m)/12, θ from the line of centres.
    """
    x, y, dx, dy = motion
    A, B = 12.0 * dx + 6.0 * y, 12.0 * dy - 6.0 * x
    along, across = A * film.cos + B * film.sin, B * film.cos - A * film.sin
    return math.hypot(A, B), math.atan2(across, along)


def is_circle(bearing: JournalBearing) -> bool:
    """Return whether a bearing's bore is one full circle."""
    (first, *others) = pads_of(bearing)
    return first.is_closed and not others and first.a_x == first.a_y == 0.0


@functools.lru_cache(maxsize=32)
def polynomials(shape: Shape) -> Array:
    """Return a circle's table as polynomials over the share of a step in χ.

    Parameters
    ----------
    shape : Shape
        A full circle.

    Returns
    -------
    array, (rows, steps, 12)
        By row of τ and step of χ, powers 0 to 5 of the radial force, then of the tangential one;
        rows as coefficients of splines.
    """
    table = impedance(shape)
    # In the journal's direction the table is constant.
    both = table.coefficients[:, MARGIN].reshape(2, table.rows, -1)
    windows = np.lib.stride_tricks.sliding_window_view(both, 6, axis=2)
    return np.concatenate(list(windows @ _SPLINES), axis=-1)
