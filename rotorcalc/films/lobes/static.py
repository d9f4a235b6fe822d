"""Short pads in static equilibrium: positions, stiffness and damping, flow, drag, highest pressure.

Everything is exact but the position, which Newton's method finds; it starts from a table of the
bore, made once.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from rotorcalc.arrays import Array
from rotorcalc.films.load_splines import CoefficientSplines, LoadSplines, half_whirl
from rotorcalc.films.lobes.integrals import moments
from rotorcalc.films.pads import NO_POSITION, Pad, are_concentric, gap, resting
from rotorcalc.films.rough_positions import crossings, net

_TURN = 2.0 * np.pi
# Shares of the way to the wall and directions of the first search, and the number of loads.
_SHARES = np.concatenate([np.linspace(0.05, 0.9, 18), 1.0 - np.geomspace(0.08, 1e-3, 18)])
_DIRECTIONS = np.radians(np.arange(-70.0, 171.0, 10.0))
_KNOTS = 400
# Newton's error is squared by each step: after one of 1e-8 of the film the next is rounding.
_MOST_STEPS, _TOLERANCE, _LONGEST = 60, 1e-8, 0.5
# A load so light that its journal lies where an unloaded one would, over the film's stiffness.
NEXT_TO_NONE = 1e-9


@dataclass(frozen=True, eq=False)
class Answer:
    """What short pads do to a resting journal at positions (n, 2), in film units.

    Attributes
    ----------
    force : array, (n, 2)
        On the journal, in μΩRL³/C².
    stiffness, damping : array, (n, 2, 2)
        In μΩRL³/C³ and μRL³/C³.
    flow, loss : array, (n,)
        Side flow in ΩRLC; the drag of the axial flow over (L/D)², in μΩR³L/C.
    """

    force: Array
    stiffness: Array
    damping: Array
    flow: Array
    loss: Array


def answer(pads: tuple[Pad, ...], position: Array) -> Answer:
    """Return what pads do to a resting journal.

    Parameters
    ----------
    pads : tuple of Pad
        The pads.
    position : array, (n, 2)
        The journal's centre, in C.

    Returns
    -------
    Answer
        At each position.
    """
    n = len(position)
    force, K, C = np.zeros((n, 2)), np.zeros((n, 2, 2)), np.zeros((n, 2, 2))
    flow, loss = np.zeros(n), np.zeros(n)
    for pad in pads:
        e, gamma, start = _from_pad(pad, position)
        for low, high in _pressed(start, pad.arc):
            on = np.flatnonzero(high > low)
            if on.size:
                part = _part(e[on], gamma[on], low[on], high[on])
                for total, each in zip((force, K, C, flow, loss), part, strict=True):
                    total[on] += each
    return Answer(force, K, C, flow, loss)


def _part(
    e: Array, gamma: Array, low: Array, high: Array
) -> tuple[Array, Array, Array, Array, Array]:
    """Return what one part of a pad that is under pressure adds to each field of `Answer`."""
    _, (cc, sc, ss), (_, c2s, cs2, s3) = moments(e, low, high)
    a, Q = 6.0 * e, _frame(gamma)
    local = np.stack([a * sc, a * ss], axis=-1) / 12.0
    stiffness = np.stack([
        -0.5 * sc - 0.25 * a * c2s, 0.5 * cc - 0.25 * a * cs2,
        -0.5 * ss - 0.25 * a * cs2, 0.5 * sc - 0.25 * a * s3,
    ], axis=-1).reshape(-1, 2, 2)  # fmt: skip
    damping = np.stack([cc, sc, sc, ss], axis=-1).reshape(-1, 2, 2)
    turned = Q.swapaxes(-1, -2)
    # What the film's convergence leaves to the sides: ½(h at its start − h at its end).
    flow = 0.5 * e * (np.cos(high) - np.cos(low))
    force = (Q @ local[..., None])[..., 0]
    return force, Q @ stiffness @ turned, Q @ damping @ turned, flow, e * e * ss


def shear(pads: tuple[Pad, ...], position: Array) -> Array:
    """Return ∫dβ/h over the pads at positions (n, 2), the drag of the shear in μΩR³L/C."""
    total = np.zeros(len(position))
    for pad in pads:
        e, _, start = _from_pad(pad, position)
        total += moments(e, start, start + pad.arc)[0]
    return total


def _from_pad(pad: Pad, position: Array) -> tuple[Array, Array, Array]:
    """Return e and γ of the journal from a pad's centre, and θ of the pad's start."""
    q = position - np.array([pad.a_x, pad.a_y])
    gamma = np.arctan2(q[:, 1], q[:, 0])
    return np.hypot(q[:, 0], q[:, 1]), gamma, pad.start - gamma


def _frame(gamma: Array) -> Array:
    cos, sin = np.cos(gamma), np.sin(gamma)
    return np.stack([cos, -sin, sin, cos], axis=-1).reshape(-1, 2, 2)


def _pressed(start: Array, arc: float) -> list[tuple[Array, Array]]:
    """Return the parts of a pad where the film converges, −π < θ < 0 and a turn later."""
    low = -np.pi + _TURN * np.floor((start + np.pi) / _TURN)
    return [
        (np.maximum(low + i * _TURN, start), np.minimum(low + i * _TURN + np.pi, start + arc))
        for i in (0, 1)
    ]


def peak(pads: tuple[Pad, ...], position: Array) -> tuple[Array, Array]:
    """Return the highest pressure, in μΩ(L/C)², and its angle Θ from X [rad], (n,) each.

    p = ¾ e (−sin θ)/h³ is highest where cos θ = 6e/(1 + √(1+24e²)), or at an edge of the pad.
    """
    best, where = np.full(len(position), -1.0), np.zeros(len(position))
    for pad in pads:
        e, gamma, start = _from_pad(pad, position)
        top = -np.arccos(np.minimum(6.0 * e / (1.0 + np.sqrt(1.0 + 24.0 * e * e)), 1.0))
        for i, (low, high) in enumerate(_pressed(start, pad.arc)):
            turn = _TURN * (np.floor((start + np.pi) / _TURN) + i)
            theta = np.clip(top + turn, low, np.maximum(high, low))
            h = 1.0 - e * np.cos(theta)
            p = np.where(high > low, -0.75 * e * np.sin(theta) / h**3, -1.0)
            where = np.where(p > best, theta + gamma, where)
            best = np.maximum(p, best)
    return np.maximum(best, 0.0), where


def equilibrium(pads: tuple[Pad, ...], load: Array) -> Array:
    """Return the journal's positions under loads along X.

    Parameters
    ----------
    pads : tuple of Pad
        The pads.
    load : array, (n,)
        1/(4σ), in μΩRL³/C².

    Returns
    -------
    array, (n, 2)
        In C.

    Raises
    ------
    ValueError
        Where a load presses the journal onto the pad.
    """
    loads, places, between = _start(pads)
    refuse_heavy(pads, load)
    start = np.asarray(between(np.log(np.clip(load, loads[1], loads[-1]))))
    share = np.minimum(load / loads[1], 1.0)[:, None]
    return _newton(pads, load, places[0] + share * (start - places[0]))


def refuse_heavy(pads: tuple[Pad, ...], load: Array) -> None:
    """Raise ValueError where a load presses the journal onto the pad."""
    loads, places, _ = _start(pads)
    if load.size and load.max() > loads[-1] * (1.0 + 1e-9):
        raise ValueError(
            f"sommerfeld = {0.25 / load.max():.4g}: must be at least {0.25 / loads[-1]:.4g} in "
            f"this bore; there the smallest film is {float(gap(pads, places[-1])):.2g} of the "
            "clearance"
        )


def range_of(pads: tuple[Pad, ...]) -> tuple[float, float]:
    """Return the lightest and the heaviest load of the table, 1/(4σ)."""
    loads, *_ = _start(pads)
    return float(loads[1]), float(loads[-1])


@functools.lru_cache(maxsize=256)
def coefficients(pads: tuple[Pad, ...]) -> CoefficientSplines:
    """Return stiffness and damping of pads over the load, from four hundred exact equilibria."""
    load, found, _ = _knots(pads)
    scale = 20.0 * range_of(pads)[0]
    return CoefficientSplines.through(load, found.stiffness, found.damping, scale=scale)


@functools.lru_cache(maxsize=256)
def friction(pads: tuple[Pad, ...]) -> LoadSplines:
    """Return shear, loss and flow (as `shear` and `Answer`) over the load, from the same."""
    load, found, shears = _knots(pads)
    rows = np.column_stack([shears, found.loss, found.flow])
    if are_concentric(pads):  # without load there is no wedge
        rows[0, 1:] = 0.0
    return LoadSplines.through(load, rows, scale=20.0 * range_of(pads)[0])


@functools.lru_cache(maxsize=8)
def _knots(pads: tuple[Pad, ...]) -> tuple[Array, Answer, Array]:
    """Return loads (n,), and what pads do without load and at these, (n+1, ...), with the shear."""
    loads, places, _ = _start(pads)
    # From loads so light that what is not linear in them is below the splines' own error.
    load = np.exp(np.linspace(math.log(1e-3 * loads[1]), math.log(loads[-1]), _KNOTS))
    centre = places[:1]
    if are_concentric(pads):
        centre = _newton(pads, NEXT_TO_NONE * loads[1:2], NEXT_TO_NONE * places[1:2])
    position = np.concatenate([centre, equilibrium(pads, load)])
    found = answer(pads, position)
    if are_concentric(pads):
        found.stiffness[0] = half_whirl(found.damping[0])
    return load, found, shear(pads, position)


@functools.lru_cache(maxsize=256)
def _start(pads: tuple[Pad, ...]) -> tuple[Array, Array, CubicSpline]:
    """Return loads, none first, their positions, and positions over the logarithm of the load."""
    position = net(pads, _SHARES, _DIRECTIONS)
    force = answer(pads, position.reshape(-1, 2)).force.reshape(position.shape)
    loads, places, _ = crossings(force, position, apart=1.02)
    if not are_concentric(pads):
        places[0] = _newton(pads, np.zeros(1), np.zeros((1, 2)))[0]
    if len(loads) < 3:
        raise ValueError(NO_POSITION)
    places[1:] = _newton(pads, loads[1:], places[1:])
    # Dense enough that a single step of Newton's method remains.
    rough = CubicSpline(np.log(loads[1:]), places[1:])
    ln = np.linspace(math.log(loads[1]), math.log(loads[-1]), _KNOTS)
    dense = _newton(pads, np.exp(ln), np.asarray(rough(ln)))
    if not resting(pads, dense, answer(pads, dense).stiffness).all():
        raise ValueError(NO_POSITION)
    spline = CubicSpline(ln, dense)
    return loads, places, spline


def _newton(pads: tuple[Pad, ...], load: Array, start: Array) -> Array:
    """Return equilibria at loads, from positions near them; no step crosses half of the film."""
    position, active, concentric = start.copy(), np.arange(len(load)), are_concentric(pads)
    for _ in range(_MOST_STEPS):
        at = answer(pads, position[active])
        rest = at.force + np.stack([load[active], np.zeros(active.size)], axis=-1)
        try:
            step = np.linalg.solve(at.stiffness, rest[..., None])[..., 0]
        except np.linalg.LinAlgError as error:  # a film that resists no motion
            raise ValueError(NO_POSITION) from error
        size = np.hypot(step[:, 0], step[:, 1])
        room = _LONGEST * gap(pads, position[active])
        position[active] += step * np.minimum(1.0, room / np.maximum(size, 1e-300))[:, None]
        if concentric:  # a light load's film is as thin a wedge as its journal is near the centre
            room = np.minimum(room, np.hypot(position[active, 0], position[active, 1]))
        active = active[size > _TOLERANCE * room]
        if not active.size:
            return position
    raise ValueError(NO_POSITION)
