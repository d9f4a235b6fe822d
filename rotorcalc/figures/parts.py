"""The parts of a bearing that move, give way or are supplied, as lines of its cross-section.

Pads tilt, a ring floats and turns, a foil is pressed outward; recesses hold pressure. What does not
move is drawn by `figures.bore`.
"""

import math

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.bearing_parts import Parts
from rotorcalc.figures.bore import pad_lines
from rotorcalc.films.pads import Pad

# Radius of the housing around tilting pads or a foil, over the bore's, and of a recess's bottom.
HOUSING, RECESS = 1.12, 1.07
# Thickness of a ring as drawn, over the radius of the bore around it.
RING = 0.1
# Bumps of a foil around the bore.
_BUMPS = 48
_AROUND = np.linspace(0.0, 2.0 * np.pi, 361)


def moving(
    parts: Parts, at: int, *, journal: float, gap: float, ring: float = RING
) -> dict[str, Array]:
    """Return the lines of what moves, at one of the speeds.

    Parameters
    ----------
    parts : Parts
        The parts.
    at : int
        Which of the speeds.
    journal, gap, ring : float
        The journal's radius, the clearance C and a ring's thickness as drawn.

    Returns
    -------
    dict of str to array, (n, 2)
        By the names of the traces, in X and Y; NaN between lines of one trace.
    """
    if parts.pads is not None:
        lines = pad_lines(parts.pads[at], journal=journal, gap=gap)
        return {"pads": apart([one.surface for one in lines])}
    if parts.ring is not None:
        centre, inside = gap * parts.ring[at], journal + gap
        around = np.concatenate((_arc(inside + ring), _arc(inside)[::-1]))
        return {"ring": centre + np.concatenate((around, around[:1]))}
    if parts.foil is not None:
        radius = journal + gap * (1.0 + parts.foil[at])
        angle = np.linspace(0.0, 2.0 * np.pi, len(radius))
        return {"foil": radius[:, None] * _arc(1.0, angle), "bumps": _bumps(radius, angle)}
    return {}


def still(parts: Parts, *, journal: float, gap: float) -> dict[str, Array]:
    """Return the lines of what stands still around the moving parts.

    Parameters
    ----------
    parts : Parts
        The parts.
    journal, gap : float
        The journal's radius and the clearance C as drawn.

    Returns
    -------
    dict of str to array, (n, 2)
        By the names of the traces, in X and Y; NaN between lines of one trace.
    """
    if parts.pads is not None and parts.pivots is not None:
        # From the pad, which does not move there when it tilts, to the housing.
        ends = [
            np.array([journal + gap * thickness(pad, angle), HOUSING])
            for pad, angle in zip(parts.pads[0], parts.pivots.tolist(), strict=True)
        ]
        lines = [
            end[:, None] * _arc(1.0, np.array([angle]))
            for end, angle in zip(ends, parts.pivots, strict=True)
        ]
        return {"housing": _arc(HOUSING), "pivots": apart(lines)}
    if parts.recesses is not None:
        return {"recesses": apart([_recess(*ends) for ends in parts.recesses])}
    if parts.slit is not None:
        ends = np.array([journal + gap, HOUSING])
        return {"housing": _arc(HOUSING), "slit": ends[:, None] * _arc(1.0, np.array([parts.slit]))}
    return {}


def thickness(pad: Pad, angle: float) -> float:
    """Return the film's thickness on a pad at an angle from X, the journal centred, in C."""
    return 1.0 + pad.a_x * math.cos(angle) + pad.a_y * math.sin(angle)


def apart(lines: list[Array]) -> Array:
    """Return lines as one, with NaN between them."""
    between = np.full((1, 2), np.nan)
    return np.concatenate([piece for line in lines for piece in (line, between)][:-1])


def _recess(start: float, end: float) -> Array:
    """Return a recess: down from the bore, along its bottom and up."""
    angle = np.linspace(start, end, max(2, round(np.degrees(end - start) / 2.0)))
    ends = _arc(1.0, angle[[0, -1]])
    return np.concatenate((ends[:1], _arc(RECESS, angle), ends[1:]))


def _bumps(foil: Array, angle: Array) -> Array:
    """Return the bumps between a foil and its housing."""
    up = 0.5 - 0.5 * np.cos(_BUMPS * angle)
    return (foil + up * (HOUSING - foil))[:, None] * _arc(1.0, angle)


def _arc(radius: float, angle: Array = _AROUND) -> Array:
    return radius * np.stack((np.cos(angle), np.sin(angle)), axis=-1)
