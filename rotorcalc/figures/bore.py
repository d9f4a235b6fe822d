"""The bore of a bearing as lines: its pads, with their pockets, and a small picture of them."""

import functools
import math
from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.bearing_parts import recess_ends
from rotorcalc.figures import style
from rotorcalc.films.pads import Pad, pads_of
from rotorcalc.films.tilting.pivots import pivots_of
from rotorcalc.geometry import FloatingRing, Foil, Geometry, Hydrostatic, TiltingPads
from rotorcalc.machine import Bearing

# Clearance over the bore's radius in a small picture, and the deepest pocket drawn there, in C.
_SHOWN, _DEEPEST = 0.3, 1.0
# Depth of a groove as drawn, over the radius there.
_GROOVE = 0.07
_STEP, _LEAST = math.radians(2.0), 1e-6
_TURN, _MIDDLE = 2.0 * math.pi, np.zeros(2)


@dataclass(frozen=True, eq=False)
class PadLines:
    """One pad as lines in X, Y.

    Attributes
    ----------
    surface : array, (n, 2)
        The pad's surface, over a pocket the land beside it.
    pocket : array, (m, 2)
        The pocket's bottom and its step; empty where there is none.
    centre : array, (2,)
        The pad's centre of curvature.
    """

    surface: Array
    pocket: Array
    centre: Array


def pad_lines(
    pads: tuple[Pad, ...], *, journal: float, gap: float, deepest: float = math.inf
) -> tuple[PadLines, ...]:
    """Return pads as lines, about the bearing's centre.

    Parameters
    ----------
    pads : tuple of Pad
        The pads.
    journal : float
        The journal's radius as drawn.
    gap : float
        The clearance C as drawn; a journal of that radius then touches a pad where it does in fact.
    deepest : float
        Deeper pockets are drawn as deep, in C.

    Returns
    -------
    tuple of PadLines
        In the unit of the radius.
    """
    return tuple(_lines(pad, journal, gap, deepest) for pad in pads)


def _lines(pad: Pad, journal: float, gap: float, deepest: float) -> PadLines:
    centre = gap * np.array([pad.a_x, pad.a_y])
    radius = journal + gap
    pocket = np.empty((0, 2))
    if pad.depth > 0.0:
        deep = radius + gap * min(pad.depth, deepest)
        bottom = _arc(centre, deep, pad.start, pad.step)
        # From the pad's leading edge down, along the bottom, and up the step.
        ends = _arc(centre, radius, pad.start, pad.step)[[0, -1]]
        pocket = np.concatenate((ends[:1], bottom, ends[1:]))
    return PadLines(_arc(centre, radius, pad.start, pad.end), pocket, centre)


def closed(lines: tuple[PadLines, ...]) -> Array:
    """Return the surfaces of pads and the grooves between them as one closed line.

    Parameters
    ----------
    lines : tuple of PadLines
        In the sense of rotation.

    Returns
    -------
    array, (n, 2)
        Its last point is its first. A groove's depth is not to scale.
    """
    parts: list[Array] = []
    for one, following in zip(lines, (*lines[1:], lines[0]), strict=True):
        parts += [one.surface, _groove(one.surface[-1], following.surface[0])]
    return np.concatenate((*parts, lines[0].surface[:1]))


def _groove(end: Array, start: Array) -> Array:
    """Return the bottom of the groove from one pad's end to the next one's start."""
    from_, to = np.arctan2(end[1], end[0]), np.arctan2(start[1], start[0])
    width = (to - from_) % (2.0 * math.pi)
    if not _LEAST < width < 2.0 * math.pi - _LEAST:  # the pads meet
        return np.empty((0, 2))
    share = np.linspace(0.0, 1.0, max(2, math.ceil(width / _STEP) + 1))
    ends = np.hypot(*end), np.hypot(*start)
    radius = (1.0 + _GROOVE) * (ends[0] + share * (ends[1] - ends[0]))
    angle = from_ + share * width
    return radius[:, None] * np.stack((np.cos(angle), np.sin(angle)), axis=-1)


def _arc(centre: Array, radius: float, start: float, end: float) -> Array:
    angle = np.linspace(start, end, max(2, math.ceil((end - start) / _STEP) + 1))
    return centre + radius * np.stack((np.cos(angle), np.sin(angle)), axis=-1)


@functools.lru_cache(maxsize=256)
def picture(bearing: Bearing) -> str:
    """Return a small picture of a bearing's bore, the journal in its middle, as SVG.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.

    Returns
    -------
    str
        An SVG image: X, along the load, points down, Y to the right. The clearance is exaggerated.

    Raises
    ------
    ValueError
        Where nothing is known of the bore's shape.
    """
    journal = 1.0 - _SHOWN
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1.4 -1.4 2.8 2.8" width="96" '
        f'height="96" fill="none" stroke-linejoin="round"><circle r="{journal:g}" '
        f'fill="{style.JOURNAL}" fill-opacity="0.25" stroke="{style.JOURNAL}" stroke-width="0.04"/>'
        f"{''.join(_strokes(bearing.geometry, bearing))}</svg>"
    )


@functools.singledispatch
def _strokes(_geometry: Geometry, bearing: Bearing) -> list[str]:
    """Return the lines of a bore of fixed pads, as SVG."""
    lines = pad_lines(pads_of(bearing), journal=1.0 - _SHOWN, gap=_SHOWN, deepest=_DEEPEST)
    strokes = [_path(one.surface, style.GREY, 0.07) for one in lines]
    return strokes + [_path(one.pocket, style.UNSTABLE, 0.05) for one in lines if len(one.pocket)]


@_strokes.register
def _tilting(_geometry: TiltingPads, bearing: Bearing) -> list[str]:
    pivots = pivots_of(bearing)
    journal = 1.0 - _SHOWN
    lines = pad_lines(pivots.tilted(np.zeros(pivots.number)), journal=journal, gap=_SHOWN)
    supports = [
        np.array([journal + _SHOWN, 1.2])[:, None] * np.array([[math.cos(one), math.sin(one)]])
        for one in pivots.angle.tolist()
    ]
    return [
        *(_path(one.surface, style.GREY, 0.09) for one in lines),
        *(_path(one, style.UNSTABLE, 0.07) for one in supports),
        _path(_arc(_MIDDLE, 1.2, 0.0, _TURN), style.GREY, 0.04),
    ]


@_strokes.register
def _ringed(_geometry: FloatingRing, _bearing: Bearing) -> list[str]:
    circles = ((0.84, 0.05), (0.96, 0.05), (1.12, 0.07))
    return [_path(_arc(_MIDDLE, radius, 0.0, _TURN), style.GREY, wide) for radius, wide in circles]


@_strokes.register
def _sprung(geometry: Foil, _bearing: Bearing) -> list[str]:
    half = math.radians(6.0)
    foil = _arc(_MIDDLE, 1.0, geometry.slit + half, geometry.slit + _TURN - half)
    angle = np.linspace(0.0, _TURN, 361)
    bumps = 1.06 - 0.06 * np.cos(24.0 * angle)
    waves = bumps[:, None] * np.stack((np.cos(angle), np.sin(angle)), axis=-1)
    housing = _arc(_MIDDLE, 1.15, 0.0, _TURN)
    return [
        _path(foil, style.GREY, 0.07), _path(waves, style.GREY, 0.03),
        _path(housing, style.GREY, 0.04),
    ]  # fmt: skip


@_strokes.register
def _recessed(geometry: Hydrostatic, _bearing: Bearing) -> list[str]:
    circle = _path(_arc(_MIDDLE, 1.0, 0.0, _TURN), style.GREY, 0.05)
    recesses = [_arc(_MIDDLE, 1.12, *ends) for ends in recess_ends(geometry).tolist()]
    return [circle, *(_path(one, style.UNSTABLE, 0.09) for one in recesses)]


def _path(places: Array, colour: str, width: float) -> str:
    # On the screen Y points right and X down, as SVG's second axis does.
    points = " ".join(f"{y:.3f},{x:.3f}" for x, y in places)
    return f'<polyline points="{points}" stroke="{colour}" stroke-width="{width:g}"/>'
