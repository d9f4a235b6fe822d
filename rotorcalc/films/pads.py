"""The pads of a fixed bore: one description of every kind, in clearances.

The film over a pad is h/C = 1 + a·n − q·n, with n = (cos β, sin β), the journal's centre q and the
pad's centre of curvature a, both from the bearing's centre in C. It is deeper in a pocket.
"""

import functools
import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.frames import vector
from rotorcalc.geometry import (
    AxialGrooves,
    Elliptical,
    Geometry,
    Lobes,
    MultiDam,
    OffsetHalves,
    PartialArc,
    Plain,
    PressureDam,
)
from rotorcalc.machine import Bearing

_TURN = 2.0 * math.pi
# Where a full circle is cut open: in the broken film at any load, behind the thinnest film (0 to
# 90°) and before the thickest (180 to 270°).
_CUT = math.radians(135.0)
# Why a film of pads may have no answer at any load.
NO_POSITION = (
    "bearing: no position of the journal was found at which its film carries a load along X, and "
    "to which it returns; move or widen its pads, or lower its preload"
)


@dataclass(frozen=True)
class Pad:
    """One pad of a bore.

    Attributes
    ----------
    start, end : float
        Angles of its edges from X in the sense of rotation [rad]; a full circle spans 2π.
    a_x, a_y : float
        Its centre of curvature from the bearing's centre, in C.
    step : float
        Angle at which its pocket ends [rad]; the pocket begins at the pad's start.
    depth : float
        Depth of the pocket, in C; 0 for none.
    axial_ratio : float
        Length of the pocket over the bearing's [-].
    track_ratio : float
        Width of a relief track in the middle of its length over the bearing's [-].
    """

    start: float
    end: float
    a_x: float = 0.0
    a_y: float = 0.0
    step: float = math.nan
    depth: float = 0.0
    axial_ratio: float = 1.0
    track_ratio: float = 0.0

    @property
    def arc(self) -> float:
        """Angle of the pad [rad]."""
        return self.end - self.start

    @property
    def is_closed(self) -> bool:
        """Whether it is a full circle, whose edges are none."""
        return math.isclose(self.arc, _TURN)


def pads_of(bearing: Bearing) -> tuple[Pad, ...]:
    """Return the pads of a bearing of any fixed kind.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.

    Returns
    -------
    tuple of Pad
        In the sense of rotation.

    Raises
    ------
    ValueError
        Where the bearing is of a kind without fixed pads.
    """
    return _pads(bearing.geometry, bearing.radial_clearance)


@functools.singledispatch
def _pads(geometry: Geometry, _clearance: float) -> tuple[Pad, ...]:
    raise ValueError(f"geometry = {geometry.kind}: has no fixed pads")


@_pads.register
def _plain(_geometry: Plain, _clearance: float) -> tuple[Pad, ...]:
    return (Pad(_CUT - _TURN, _CUT),)


@_pads.register
def _partial_arc(geometry: PartialArc, _clearance: float) -> tuple[Pad, ...]:
    half = geometry.arc / 2.0
    return (Pad(geometry.centre - half, geometry.centre + half),)


@_pads.register
def _axial_grooves(geometry: AxialGrooves, _clearance: float) -> tuple[Pad, ...]:
    pitch, half = _TURN / geometry.number, geometry.width / 2.0
    first = geometry.implied("first", 1.0) if geometry.first is None else geometry.first
    return tuple(
        Pad(first + (i - 1) * pitch + half, first + i * pitch - half)
        for i in range(round(geometry.number))
    )


@_pads.register
def _elliptical(geometry: Elliptical, _clearance: float) -> tuple[Pad, ...]:
    return tuple(_leaned(pad, geometry.preload, 0.5) for pad in _halves(geometry.groove_width))


@_pads.register
def _offset_halves(geometry: OffsetHalves, _clearance: float) -> tuple[Pad, ...]:
    lower, upper = _halves(geometry.groove_width)
    # The film is 1 − δ sin β below and 1 + δ sin β above: both converge.
    return (
        Pad(lower.start, lower.end, 0.0, -geometry.offset),
        Pad(upper.start, upper.end, 0.0, geometry.offset),
    )


@_pads.register
def _lobes(geometry: Lobes, _clearance: float) -> tuple[Pad, ...]:
    pads = _even(round(geometry.number), geometry.arc, geometry.load)
    return tuple(_leaned(pad, geometry.preload, geometry.offset) for pad in pads)


@_pads.register
def _pressure_dam(geometry: PressureDam, clearance: float) -> tuple[Pad, ...]:
    lower, upper = (_leaned(pad, geometry.preload, 0.5) for pad in _halves(geometry.groove_width))
    depth = _depth(geometry, clearance)
    pocket = _pocket(upper, geometry.pocket_arc, depth, geometry.axial_ratio)
    return replace(lower, track_ratio=geometry.track_ratio), pocket


@_pads.register
def _multi_dam(geometry: MultiDam, clearance: float) -> tuple[Pad, ...]:
    depth = _depth(geometry, clearance)
    return tuple(
        _pocket(pad, geometry.pocket_arc, depth, geometry.axial_ratio)
        for pad in _even(round(geometry.number), geometry.arc, geometry.load)
    )


def _depth(geometry: PressureDam | MultiDam, clearance: float) -> float:
    """Return the depth of a bore's pockets, in C."""
    return geometry.usual_depth if geometry.depth is None else geometry.depth / clearance


def _halves(groove_width: float) -> tuple[Pad, Pad]:
    """Return the loaded pad and the unloaded one."""
    half = (math.pi - groove_width) / 2.0
    return Pad(-half, half), Pad(math.pi - half, math.pi + half)


def _even(number: int, arc: float, load: str) -> tuple[Pad, ...]:
    """Return pads evenly spaced, the first loaded in its middle or the load before it."""
    pitch = _TURN / number
    first = 0.0 if load == "on pad" else pitch / 2.0
    return tuple(
        Pad(first + i * pitch - arc / 2.0, first + i * pitch + arc / 2.0) for i in range(number)
    )


def _leaned(pad: Pad, preload: float, offset: float) -> Pad:
    """Return a pad moved towards its point at an offset from its leading edge."""
    closest = pad.start + offset * pad.arc
    a_x, a_y = -preload * math.cos(closest), -preload * math.sin(closest)
    return Pad(pad.start, pad.end, a_x, a_y)


def _pocket(pad: Pad, arc: float, depth: float, axial_ratio: float) -> Pad:
    return replace(pad, step=pad.start + arc, depth=depth, axial_ratio=axial_ratio)


def walls_of(bearing: Bearing) -> tuple[Pad, ...]:
    """Return what the journal can touch: the pads, and of a partial arc the whole circle."""
    pads = pads_of(bearing)
    return (Pad(0.0, _TURN),) if isinstance(bearing.geometry, PartialArc) else pads


def are_concentric(pads: tuple[Pad, ...]) -> bool:
    """Return whether pads are parts of one circle: without pockets or load they have no film."""
    return all(pad.a_x == pad.a_y == 0.0 for pad in pads)


def have_pockets(pads: tuple[Pad, ...]) -> bool:
    """Return whether any pad has a pocket."""
    return any(pad.depth > 0.0 for pad in pads)


def gap(pads: tuple[Pad, ...], position: ArrayLike) -> Array:
    """Return the smallest film thickness over pads, outside their pockets.

    Parameters
    ----------
    pads : tuple of Pad
        The pads.
    position : array_like, (..., 2)
        The journal's centre, in C.

    Returns
    -------
    array, (...)
        In C; negative where the journal would cut into a pad.
    """
    place = np.asarray(position, dtype=float)[..., None, :]
    _, middle, half, a = _arrays(pads)
    q = place - a
    e = np.hypot(q[..., 0], q[..., 1])
    # The angle of closest approach from the pad's middle, as far as the pad reaches.
    away = np.abs(np.arctan2(q[..., 1], q[..., 0]) - middle)
    away = np.abs(np.mod(away + np.pi, _TURN) - np.pi)
    return (1.0 - e * np.cos(np.maximum(away - half, 0.0))).min(axis=-1)


def outline(pads: tuple[Pad, ...], angle: ArrayLike) -> Array:
    """Return where the journal's centre touches a pad, in directions from the bearing's centre.

    Parameters
    ----------
    pads : tuple of Pad
        The pads, open over less than 180°.
    angle : array_like, (...)
        Directions from X in the sense of rotation [rad].

    Returns
    -------
    array, (..., 2)
        In C.
    """
    ray = np.asarray(angle, dtype=float)[..., None]
    start, middle, half, a = _arrays(pads)
    n_x, n_y = np.cos(ray), np.sin(ray)
    along = n_x * a[:, 0] + n_y * a[:, 1]
    # On a pad's own arc contact is at |q − a| = 1, beyond it at one of the pad's edges.
    circle = along + np.sqrt(along**2 + 1.0 - (a**2).sum(axis=-1))
    touch = np.arctan2(circle * n_y - a[:, 1], circle * n_x - a[:, 0])
    on_pad = np.abs(np.mod(touch - middle + np.pi, _TURN) - np.pi) <= half + 1e-12
    reach = np.where(on_pad, circle, np.inf)
    for edge in (start, start + 2.0 * half):
        away = np.cos(edge - ray)
        room = 1.0 + a[:, 0] * np.cos(edge) + a[:, 1] * np.sin(edge)
        with np.errstate(divide="ignore"):
            line = np.where(away > 0.0, room / away, np.inf)
        reach = np.minimum(reach, np.where(half < np.pi - 1e-9, line, np.inf))
    r = reach.min(axis=-1)
    with np.errstate(invalid="ignore"):
        return vector(r * n_x[..., 0], r * n_y[..., 0])


def resting(pads: tuple[Pad, ...], position: Array, stiffness: Array) -> BoolArray:
    """Return where a journal in equilibrium stays: inside the bore, and not on a saddle.

    A saddle, det K < 0, is left without whirl, by itself, on any rotor.

    Parameters
    ----------
    pads : tuple of Pad
        The pads.
    position : array, (n, 2)
        The journal's centre, in C.
    stiffness : array, (n, 2, 2)
        In any unit.

    Returns
    -------
    boolean array, (n,)
        Of each position.
    """
    stays = np.linalg.det(stiffness) > 0.0
    # Beside a single pad the bore is relieved, but no wider.
    return stays & (np.hypot(position[:, 0], position[:, 1]) < 1.0) if len(pads) == 1 else stays


@functools.lru_cache(maxsize=256)
def _arrays(pads: tuple[Pad, ...]) -> tuple[Array, Array, Array, Array]:
    """Return starts, middles, half arcs and centres of curvature of pads."""
    start = np.array([pad.start for pad in pads])
    half = np.array([pad.arc / 2.0 for pad in pads])
    a = np.array([(pad.a_x, pad.a_y) for pad in pads])
    return start, start + half, half, a
