"""The journal's velocity for a given force of a film, where the film's loss is convex.

At any place the force of a film whose pressures are those of Reynolds' equation, none negative, is
minus the gradient, with respect to the velocity v, of a convex function Φ, half of what the film
would absorb. So the velocity for a given force f is the minimum of Φ + f·v, and Newton's method
with a shortened step finds it from anywhere.
"""

import math
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

_MOST_STEPS, _MOST_HALVES = 100, 60
_TOLERANCE, _ROUNDING = 1e-13, 2e-9
# Share of the decrease that a Newton step promises which must be found; of the film's damping at a
# clear gap what is added where no pad is under pressure.
_ENOUGH, _SUPPORT = 1e-4, 1e-6


class Answer(NamedTuple):
    """Force in X and Y, damping C_ij = −∂F_i/∂v_j, and Φ, in film units."""

    f_x: float
    f_y: float
    xx: float
    xy: float
    yx: float
    yy: float
    potential: float


# What the film answers at a velocity (x', y') of the journal at one place.
Answers: TypeAlias = Callable[[float, float], Answer]


def velocity(
    answers: Answers,
    f_x: float,
    f_y: float,
    near: list[float] | None = None,
    *,
    scale: float = 0.0,
) -> tuple[float, float]:
    """Return the velocity at which the film's force on the journal is the given one.

    Parameters
    ----------
    answers : callable
        The film's force, damping and potential from the velocity.
    f_x, f_y : float
        Force of the film in X and Y, in film units.
    near : list or None
        Solution of the last search, from which this one starts and which it replaces.
    scale : float
        Size of the forces beside which that is to be found, where it is small or none.

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
    scale, last = max(scale, math.hypot(f_x, f_y)), math.inf
    found = answers(dx, dy)
    for _ in range(_MOST_STEPS):
        left = math.hypot(f_x - found.f_x, f_y - found.f_y)
        # Either exact, or rounding keeps the force from coming closer.
        if left <= _TOLERANCE * scale or 2.0 * last <= 2.0 * left <= _ROUNDING * scale:
            if near is not None:
                near[:] = (dx, dy)
            return dx, dy
        last = left
        dx, dy, found = _lower(answers, (dx, dy, f_x, f_y), found)
    raise ArithmeticError(
        f"no velocity found for the film force ({f_x:.3g}, {f_y:.3g}): pads only push, and a "
        "journal without mass follows no other force; give the journals a mass. It stopped"
    )


def _lower(
    answers: Answers, at: tuple[float, float, float, float], found: Answer
) -> tuple[float, float, Answer]:
    """Return a velocity at which Φ + f·v is lower, and what the film answers there."""
    dx, dy, f_x, f_y = at
    g_x, g_y = f_x - found.f_x, f_y - found.f_y
    step_x, step_y = _newton(found, g_x, g_y)
    slope, far = g_x * step_x + g_y * step_y, math.hypot(g_x, g_y)
    before = found.potential + f_x * dx + f_y * dy
    share = 1.0
    for _ in range(_MOST_HALVES):
        v_x, v_y = dx + share * step_x, dy + share * step_y
        there = answers(v_x, v_y)
        after = there.potential + f_x * v_x + f_y * v_y
        # Near the minimum the decrease is below rounding; its gradient still tells.
        left = math.hypot(f_x - there.f_x, f_y - there.f_y)
        if left <= 0.5 * far or after <= before + _ENOUGH * share * slope:
            return v_x, v_y, there
        share *= 0.5
    return dx, dy, found  # as near as rounding allows, or not at all: the caller judges


def _newton(found: Answer, g_x: float, g_y: float) -> tuple[float, float]:
    """Return −C⁻¹ g, the way to the minimum of Φ + f·v."""
    _, _, xx, xy, yx, yy, _ = found
    determinant = xx * yy - xy * yx
    if determinant <= 1e-12 * (xx + yy) ** 2:  # no pad, or hardly one, is under pressure
        xx, yy = xx + _SUPPORT, yy + _SUPPORT
        determinant = xx * yy - xy * yx
    return (xy * g_y - yy * g_x) / determinant, (yx * g_x - xx * g_y) / determinant
