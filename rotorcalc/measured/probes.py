r"""Two probes at any two angles, and the load's axes X and Y.

Angles count from X, the direction of the load, in the sense of rotation. Seen so that the shaft
turns counterclockwise, with the load down, a probe 45° to the right of the top stands at 135°, one
45° to the left of the top at 225°:

         left 225°   180°   135° right
                  \   |   /
                   \  |  /
             270° ----o---- 90°  Y
                      |
                     0°  X, load

A probe reads the displacement towards itself, X cos α + Y sin α.
"""

import math
from collections.abc import Sequence

import numpy as np

from rotorcalc.arrays import Array

# 45° right and left of the top, as most machines have them.
USUAL_ANGLES = (math.radians(135.0), math.radians(225.0))
# Of the angle between two probes; nearer to parallel, errors of the readings grow sixfold.
_LEAST_SINE = 0.17


def checked_angles(angles: Sequence[float]) -> tuple[float, float]:
    """Return two angles [rad], or raise ValueError where they cannot give X and Y."""
    first, second = (float(angle) for angle in angles)
    for angle in (first, second):
        if not -2.0 * math.pi <= angle <= 2.0 * math.pi:
            raise ValueError(f"angles: {angle} rad, must be −2π to 2π")
    if abs(math.sin(second - first)) < _LEAST_SINE:
        raise ValueError(
            f"angles: {math.degrees(first):g}° and {math.degrees(second):g}° are nearly parallel; "
            "two probes must stand 10° or more from one line"
        )
    return first, second


def to_axes(angles: tuple[float, float]) -> Array:
    """Return the matrix that turns two readings into X and Y, (2, 2)."""
    a, b = angles
    rows = [[math.sin(b), -math.sin(a)], [-math.cos(b), math.cos(a)]]
    return np.array(rows) / math.sin(b - a)


def to_probes(angles: tuple[float, float]) -> Array:
    """Return the matrix that turns X and Y into two readings, (2, 2)."""
    return np.array([[math.cos(angle), math.sin(angle)] for angle in angles])
