"""The force of short pads on a moving journal, one point at a time, for time integration.

With G = A sin β + B cos β, A = 6e_x − 12y', B = −(6e_y + 12x'), the mean pressure along a pad is
−G/(12h³) where G < 0, in film units: over half a turn, cut off at the pad's edges. The potential of
the force is Φ = Σ∫G²/(288h³) dβ (`films.convex`).
"""

import math
from dataclasses import dataclass
from functools import partial

from rotorcalc.films import convex
from rotorcalc.films.convex import Answer
from rotorcalc.films.lobes.integrals import squares
from rotorcalc.films.pads import Pad

_TURN = 2.0 * math.pi


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

        As `convex.velocity`, of which the journal's place (x, y), in C, is given.
        """
        return convex.velocity(partial(self._answer, x, y), f_x, f_y, near)

    def _answer(self, x: float, y: float, dx: float, dy: float) -> Answer:
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
        return Answer(f_x, f_y, c_xx, c_xy, c_xy, c_yy, total)


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
