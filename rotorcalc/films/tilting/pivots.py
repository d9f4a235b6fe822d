"""Where the pads of a tilting-pad bearing stand, and in which frame each has its film.

A pad's frame lies in its pivot's direction n = (cos β, sin β) and t = (−sin β, cos β). There the
journal's centre q is at

    ξ = m + q·n,   η = q·t + δ

from the pad's centre of curvature, with the preload m and the tilt δ as a displacement: the angle
times R/C. So a tilted pad is a fixed one whose centre of curvature lies at −m n − δ t.
"""

import functools
from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array
from rotorcalc.films.pads import Pad
from rotorcalc.frames import vector
from rotorcalc.geometry import TiltingPads
from rotorcalc.machine import JournalBearing


@dataclass(frozen=True)
class Pivots:
    """The pads of a bearing, in the sense of rotation.

    Attributes
    ----------
    number : int
        Number of pads, N.
    on_pad : bool
        Whether the load points at a pivot.
    arc : float
        Angle of each [rad].
    offset : float
        The pivot's place from the leading edge, over the arc [-].
    preload : float
        m [-].
    """

    number: int
    on_pad: bool
    arc: float
    offset: float
    preload: float

    @functools.cached_property
    def angle(self) -> Array:
        """Angles of the pivots from X [rad], (N,), those above the load line as exact mirrors."""
        pitch = 2.0 * np.pi / self.number
        place = np.arange(self.number) + (0.0 if self.on_pad else 0.5)
        return pitch * np.where(place > self.number / 2.0, place - self.number, place)

    @functools.cached_property
    def frames(self) -> Array:
        """Rows n and t of each pad's frame, (N, 2, 2)."""
        cos, sin = np.cos(self.angle), np.sin(self.angle)
        sin[np.abs(sin) < 1e-15] = 0.0
        cos[np.abs(cos) < 1e-15] = 0.0
        return np.stack([vector(cos, sin), vector(-sin, cos)], axis=-2)

    def tilted(self, tilt: Array) -> tuple[Pad, ...]:
        """Return the pads at tilts δ (N,), in C, as those of a fixed bore."""
        starts = self.angle - self.offset * self.arc
        n, t = np.moveaxis(self.frames, 1, 0)
        centres = (-self.preload * n - tilt[:, None] * t).tolist()
        return tuple(
            Pad(start, start + self.arc, a_x, a_y)
            for start, (a_x, a_y) in zip(starts.tolist(), centres, strict=True)
        )


@functools.lru_cache(maxsize=256)
def pivots_of(bearing: JournalBearing) -> Pivots:
    """Return the pads of a tilting-pad bearing."""
    shape = cast("TiltingPads", bearing.geometry)
    return Pivots(
        number=round(shape.number),
        on_pad=shape.load == "on pad",
        arc=shape.arc,
        offset=shape.pivot_offset,
        preload=shape.preload,
    )


def places(pivots: Pivots, position: Array, tilt: Array) -> Array:
    """Return (ξ, η) of the journal in each pad's frame, (..., N, 2).

    Parameters
    ----------
    pivots : Pivots
        The pads.
    position : array, (..., 2)
        The journal's centre, in C.
    tilt : array, (..., N)
        δ of the pads, in C.
    """
    found: Array = np.einsum("nai,...i->...na", pivots.frames, position)
    return found + vector(pivots.preload + 0.0 * tilt, tilt)


def gap(pivots: Pivots, position: ArrayLike) -> Array:
    """Return the least distance from the journal to a pivot's place on its pad.

    Parameters
    ----------
    pivots : Pivots
        The pads; they tilt away from the journal until it meets their pivots.
    position : array_like, (..., 2)
        The journal's centre, in C.

    Returns
    -------
    array, (...)
        In C; negative where the journal would cut into a pad at any tilt.
    """
    place = np.asarray(position, dtype=float)
    return (1.0 - pivots.preload - place @ pivots.frames[:, 0].T).min(axis=-1)


def outline(pivots: Pivots, angle: ArrayLike) -> Array:
    """Return where the journal's centre meets a pivot's place, in directions Θ: a polygon.

    Parameters
    ----------
    pivots : Pivots
        The pads.
    angle : array_like, (...)
        Directions from X in the sense of rotation [rad].

    Returns
    -------
    array, (..., 2)
        In C.
    """
    ray = vector(np.cos(angle), np.sin(angle))
    towards = (ray @ pivots.frames[:, 0].T).max(axis=-1)
    return (1.0 - pivots.preload) * ray / towards[..., None]
