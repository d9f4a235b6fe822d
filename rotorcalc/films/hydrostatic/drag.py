"""The shear of the film on the lands of a hydrostatic bearing.

The recesses are so much deeper than the film that their own drag is left out.
"""

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.hydrostatic.mesh import Lands

_TURN = 2.0 * np.pi


def shear(lands: Lands, position: Array) -> Array:
    """Return ∫∫ dβ dζ/(2h) over the lands, in μΩR³L/C.

    With the pressure's part, ½e F_o sin φ, it is the whole torque on the journal.

    Parameters
    ----------
    lands : Lands
        The lands: over their whole length at both ends, and between the recesses.
    position : array, (P, 2)
        The journal's positions, in C.

    Returns
    -------
    array, (P,)
        By Sommerfeld's substitution.
    """
    eps = np.hypot(position[:, 0], position[:, 1])
    gamma = np.arctan2(position[:, 1], position[:, 0])
    root = np.sqrt(1.0 - eps**2)
    at_ends = 2.0 * lands.land_ratio * _TURN / root
    pitch = _TURN / lands.recesses
    middles = pitch * np.arange(0.5, lands.recesses)
    theta, half = middles - gamma[:, None], 0.5 * lands.land_angle
    between = _substitute(theta + half, eps) - _substitute(theta - half, eps)
    between = between.sum(axis=1) / root
    return at_ends + lands.edge * between


def _substitute(theta: Array, eps: Array) -> Array:
    """Return Sommerfeld's angle, dψ = √(1−ε²) dθ/(1 − ε cos θ), continuous, of θ (P, k)."""
    turns = np.round(theta / _TURN)
    rest = theta - _TURN * turns
    steep = np.sqrt((1.0 + eps) / (1.0 - eps))[:, None]
    return _TURN * turns + 2.0 * np.arctan(steep * np.tan(0.5 * rest))
