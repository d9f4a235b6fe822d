"""The force of short pads on a moving journal, one point at a time, for time integration.

With G = A sin β + B cos β, A = 6e_x − 12y', B = −(6e_y + 12x'), the mean pressure along a pad is
−G/(12h³) where G < 0, in film units: over half a turn, cut off at the pad's edges. The force is
minus the gradient, with respect to the velocity, of the convex function Φ = Σ∫G²/(288h³) dβ, half
of what the film would absorb; so the velocity for a given force is the minimum of Φ + f·v, and
Newton's method with a shortened step finds it from anywhere.
"""

import math
from dataclasses import dataclass
from typing import TypeAlias

from rotorcalc.films.lobes.integrals import squares
from rotorcalc.films.pads import Pad

_TURN = 2.0 * math.pi
_MOST_STEPS, _MOST_HALVES = 100, 60
_TOLERANCE, _ROUNDING = 1e-13, 2e-9
# Share of the decrease that a Newton step promises which must be found; of the film's damping at a
# clear gap what is added where no pad is under pressure.
_ENOUGH, _SUPPORT = 1e-4, 1e-6


# Force in X and Y, damping C_XX, C_XY, C_YY, and Φ.
_Answer: TypeAlias = tuple[float, float, float, float, float, float]


@dataclass(frozen=True)
class PadsInMotion:
    """The pads of a short bearing, and their force on a moving journal.

    Attributes
    ----------
    pads : tuple of Pad
        The pads; without pockets.
    """

    pads: tuple[Pad, ...]

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
        f_x, f_y, *_ = self._answer(x, y, dx, dy)
        return f_x, f_y

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
            Solution of the last search, from which this one starts and which it replaces.

        Returns
        -------
        (float, float)
            Velocity in X and Y, in CΩ.

        Raises
        ------
        ArithmeticError
            Where the search does not converge, as for a force of NaN.
        """
        dx, dy = (near[0], near[1]) if near else (0.0, 0.0)
        scale, last = math.hypot(f_x, f_y), math.inf
        found = self._answer(x, y, dx, dy)
        for _ in range(_MOST_STEPS):
            g_x, g_y = f_x - found[0], f_y - found[1]
            left = math.hypot(g_x, g_y)
            # Either exact, or rounding keeps the force from coming closer.
            if left <= _TOLERANCE * scale or 2.0 * last <= 2.0 * left <= _ROUNDING * scale:
                if near is not None:
                    near[:] = (dx, dy)
                return dx, dy
            last = left
            dx, dy, found = self._lower(x, y, (dx, dy, f_x, f_y), found)
        raise ArithmeticError(f"no velocity found for the film force ({f_x}, {f_y}) at ({x}, {y})")

    def _lower(
        self, x: float, y: float, at: tuple[float, float, float, float], found: _Answer
    ) -> tuple[float, float, _Answer]:
        """Return a velocity at which Φ + f·v is lower, and what the film answers there."""
        dx, dy, f_x, f_y = at
        g_x, g_y = f_x - found[0], f_y - found[1]
        step_x, step_y = _newton(found, g_x, g_y)
        slope, far = g_x * step_x + g_y * step_y, math.hypot(g_x, g_y)
        before = found[5] + f_x * dx + f_y * dy
        share = 1.0
        for _ in range(_MOST_HALVES):
            v_x, v_y = dx + share * step_x, dy + share * step_y
            there = self._answer(x, y, v_x, v_y)
            after = there[5] + f_x * v_x + f_y * v_y
            # Near the minimum the decrease is below rounding; its gradient still tells.
            left = math.hypot(f_x - there[0], f_y - there[1])
            if left <= 0.5 * far or after <= before + _ENOUGH * share * slope:
                return v_x, v_y, there
            share *= 0.5
        return dx, dy, found  # as near as rounding allows, or not at all: the caller judges

    def _answer(self, x: float, y: float, dx: float, dy: float) -> _Answer:
        """Return force, damping C_XX, C_XY, C_YY, and Φ."""
        f_x = f_y = c_xx = c_xy = c_yy = total = 0.0
        for pad in self.pads:
            e_x, e_y = x - pad.a_x, y - pad.a_y
            e = math.hypot(e_x, e_y)
            cos, sin = (e_x / e, e_y / e) if e > 0.0 else (1.0, 0.0)
            A, B = 6.0 * e_x - 12.0 * dy, -6.0 * e_y - 12.0 * dx
            # Along and across the line of centres: G = a sin θ + b cos θ.
            a, b = A * cos - B * sin, A * sin + B * cos
            cc, sc, ss = _pressed(pad, e, math.atan2(sin, cos), math.atan2(b, a))
            f_r, f_t = (a * sc + b * cc) / 12.0, (a * ss + b * sc) / 12.0
            f_x += f_r * cos - f_t * sin
            f_y += f_r * sin + f_t * cos
            c_xx += cc * cos * cos - 2.0 * sc * cos * sin + ss * sin * sin
            c_yy += cc * sin * sin + 2.0 * sc * cos * sin + ss * cos * cos
            c_xy += (cc - ss) * cos * sin + sc * (cos * cos - sin * sin)
            total += (a * f_t + b * f_r) / 24.0
        return f_x, f_y, c_xx, c_xy, c_yy, total


def _newton(found: _Answer, g_x: float, g_y: float) -> tuple[float, float]:
    """Return −C⁻¹ g, the way to the minimum of Φ + f·v."""
    _, _, xx, xy, yy, _ = found
    determinant = xx * yy - xy * xy
    if determinant <= 1e-12 * (xx + yy) ** 2:  # no pad, or hardly one, is under pressure
        xx, yy = xx + _SUPPORT, yy + _SUPPORT
        determinant = xx * yy - xy * xy
    return (xy * g_y - yy * g_x) / determinant, (xy * g_x - xx * g_y) / determinant


def _pressed(pad: Pad, e: float, gamma: float, delta: float) -> tuple[float, float, float]:
    """Return the integrals over the part of a pad where G = V sin(θ + δ) is negative."""
    start = pad.start - gamma
    end = start + pad.arc
    # −π < θ + δ < 0, in the turn before the pad's start and in those after it.
    low = -math.pi - delta
    low += _TURN * math.floor((start - low) / _TURN)
    cc = sc = ss = 0.0
    for _ in range(3):
        first, last = max(low, start), min(low + math.pi, end)
        if last > first:
            more = squares(e, first, last)
            cc, sc, ss = cc + more[0], sc + more[1], ss + more[2]
        low += _TURN
        if low >= end:
            break
    return cc, sc, ss
