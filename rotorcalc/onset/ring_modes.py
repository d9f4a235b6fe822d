"""The two whirls of a rotor on floating rings: in the inner film, and in the outer one.

Either film feeds a whirl slower than half of its surfaces' summed speeds: the inner one whirls near
½(Ω + Ω_R), the outer one near ½Ω_R, the light rotor in the centre at these. In the first the
journal moves in the ring, in the second it moves with the ring; that tells the two apart at any
load. Both may grow at once, and the onset of the first is the machine's: limit cycles of the
nonlinear films hold such machines far above it.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, ComplexArray
from rotorcalc.coefficients import checked_speed, dynamics
from rotorcalc.display import Result
from rotorcalc.machine import Machine
from rotorcalc.numerics.roots import HiddenRootError, narrow_root
from rotorcalc.onset.eigenvalues import certain_mode_shapes
from rotorcalc.onset.search import first_crossing, search_speeds, where_film
from rotorcalc.ring import ring_film, ring_speed

INNER, OUTER = "inner film", "outer film"
# The journal moves in the ring where it moves more than half as much as the ring itself does: in
# the inner film's whirl it does nearly all, with a heavy rotor as much as the ring, in the outer
# film's some hundredths.
_MOVES = 0.5
# Its imaginary part too is no number, so that no limit is near it.
_NO_WHIRL = complex(math.nan, math.nan)
# What counts as decay where a machine has no such mode.
_NONE = -1.0


@dataclass(frozen=True)
class ModeOnset(Result):
    """Where one of the two whirls sets in.

    Attributes
    ----------
    mode : str
        "inner film" or "outer film".
    speed : float
        Lowest running speed at which it grows, Ω_s [rad/s]; infinite where none was found, NaN
        where rounding errors hide it.
    whirl_frequency : float
        Its frequency there, ω_s [rad/s]; NaN where there is none.
    whirl_ratio : float
        ω_s/Ω_s [-]; NaN where there is none.
    searched_to : float
        An onset above this speed would not have been found [rad/s].
    """

    mode: str
    speed: float
    whirl_frequency: float
    whirl_ratio: float
    searched_to: float


@dataclass(frozen=True, eq=False)
class RingWhirl(Result):
    """The two whirls at running speeds, each of shape (...), beside their limits.

    Attributes
    ----------
    speed : array
        Running speed, Ω [rad/s].
    inner_limit, outer_limit : array
        ½(1 + r) and ½r, r = Ω_R/Ω: the whirl ratios of a light rotor without load [-].
    inner_whirl_ratio, outer_whirl_ratio : array
        Im λ/Ω of the two modes [-]; NaN where it does not oscillate.
    inner_growth, outer_growth : array
        Re λ/Ω of the two [-].
    """

    speed: Array
    inner_limit: Array
    outer_limit: Array
    inner_whirl_ratio: Array
    outer_whirl_ratio: Array
    inner_growth: Array
    outer_growth: Array


@checked
def mode_onsets(machine: Machine, flexible: bool = True) -> tuple[ModeOnset, ModeOnset]:
    """Return the lowest speeds at which each of the two whirls on floating rings grows.

    Parameters
    ----------
    machine : Machine
        The machine; its bearing has a floating ring.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    pair of ModeOnset
        Of the inner film and of the outer one; the lower speed is that of `onset_speed`. At speed 0
        where it whirls at any speed, as without load.

    Raises
    ------
    ValueError
        Where the bearing has no floating ring.
    """
    ring_film(machine.bearing)
    speeds = search_speeds(machine, flexible)
    inner, outer = (_onset_of(machine, mode, speeds, flexible) for mode in (INNER, OUTER))
    return inner, outer


@checked
def ring_whirl(machine: Machine, speed: ArrayLike, flexible: bool = True) -> RingWhirl:
    """Return the two whirls on floating rings from the eigenvalues, and their limits.

    Of the modes of either kind it is the one that grows fastest, or where none grows the one
    nearest to its limit: a flexible shaft's own are others.

    Parameters
    ----------
    machine : Machine
        The machine; its bearing has a floating ring.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    RingWhirl
        Its fields have the shape (...).

    Raises
    ------
    ValueError
        As `ring_speed`.
    """
    Omega = checked_speed(speed)
    r = ring_speed(machine, Omega) / Omega
    values, is_inner = _whirls(machine, Omega, flexible)
    limits = 0.5 * (1.0 + r), 0.5 * r
    inner, outer = (
        _growing_or_nearest(np.where(kind, values, _NO_WHIRL), limit)
        for kind, limit in zip((is_inner, ~is_inner), limits, strict=True)
    )
    return RingWhirl(
        speed=Omega,
        inner_limit=limits[0],
        outer_limit=limits[1],
        inner_whirl_ratio=inner.imag,
        outer_whirl_ratio=outer.imag,
        inner_growth=inner.real,
        outer_growth=outer.real,
    )


def _onset_of(machine: Machine, mode: str, speeds: Array, flexible: bool) -> ModeOnset:
    """Return the onset of one mode, the first among rising speeds."""

    def growth(at: Array) -> Array:
        return _growing(machine, mode, at, flexible).real

    bracket = first_crossing(where_film(machine, growth), speeds)
    last = float(speeds[-1])
    if bracket is None:
        return ModeOnset(mode, math.inf, math.nan, math.nan, last)
    low, high = bracket
    # Without load a mode grows at any speed, at the first as later.
    try:
        speed = narrow_root(growth, low, high) if low > 0.0 else 0.0
    except HiddenRootError:
        return ModeOnset(mode, math.nan, math.nan, math.nan, last)
    ratio = float(_growing(machine, mode, np.array([speed or high]), flexible)[0].imag)
    return ModeOnset(mode, speed, ratio * speed, ratio, last)


def _growing(machine: Machine, mode: str, speed: Array, flexible: bool) -> ComplexArray:
    """Return λ/Ω of the mode of a kind that grows fastest at speeds (n,)."""
    values, is_inner = _whirls(machine, speed, flexible)
    kind = is_inner if mode == INNER else ~is_inner
    growth = np.where(kind & ~np.isnan(values), values.real, -np.inf)
    place = np.argmax(growth, axis=-1)[..., None]
    found = np.take_along_axis(values, place, axis=-1)[..., 0]
    return np.where(np.isinf(growth.max(axis=-1)), _NONE, found)


def _whirls(machine: Machine, speed: Array, flexible: bool) -> tuple[ComplexArray, BoolArray]:
    """Return λ/Ω of all modes, NaN where they do not oscillate, and whether the journal moves."""
    shapes = certain_mode_shapes(machine, speed, dynamics(machine, speed), flexible=flexible)
    in_ring, of_ring = (
        np.sum(np.abs(one) ** 2, axis=-1) for one in (shapes.journal - shapes.inner, shapes.inner)
    )
    values = shapes.eigenvalues / speed[..., None]
    oscillates = values.imag > 0.0
    return np.where(oscillates, values, _NO_WHIRL), in_ring > _MOVES**2 * of_ring


def _growing_or_nearest(values: ComplexArray, limit: Array) -> ComplexArray:
    """Return of λ/Ω (..., n) the one that grows fastest, else the one nearest to (...)."""
    growth, distance = values.real, np.abs(values.imag - limit[..., None])
    nearness = np.where(np.isnan(distance), -np.inf, -distance)
    grows = np.any(growth > 0.0, axis=-1, keepdims=True)
    place = np.argmax(np.where(grows, np.where(growth > 0.0, growth, -np.inf), nearness), axis=-1)
    return np.take_along_axis(values, place[..., None], axis=-1)[..., 0]
