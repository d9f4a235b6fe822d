"""Rough equilibria: where the force of a film on a net of positions points against a load.

Newton's method of each film starts from them.
"""

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.pads import Pad, outline

# Radius, in C, up to which a journal is looked for where no pad is in its way.
_FARTHEST = 1.2


def net(pads: tuple[Pad, ...], shares: Array, directions: Array) -> Array:
    """Return positions inside a bore.

    Parameters
    ----------
    pads : tuple of Pad
        The pads.
    shares : array, (s,)
        Shares of the way to the wall, or to a circle about the bore where it is open beside a pad.
    directions : array, (d,)
        Angles from X in the sense of rotation [rad].

    Returns
    -------
    array, (s, d, 2)
        In C.
    """
    wall = outline(pads, directions)
    reach = np.minimum(np.hypot(wall[:, 0], wall[:, 1]), _FARTHEST)
    ray = np.stack([reach * np.cos(directions), reach * np.sin(directions)], axis=-1)
    return shares[:, None, None] * ray


def crossings(
    force: Array, position: Array, *, apart: float = 1.0
) -> tuple[Array, Array, list[int]]:
    """Return where F_y turns from pushing on to pushing back, once on each share's row.

    Parameters
    ----------
    force, position : array, (s, d, 2)
        Force of the film at the positions of a net.
    apart : float
        The least factor between two loads.

    Returns
    -------
    load : array, (k,)
        Rising loads, after no load, in the force's unit.
    position : array, (k, 2)
        In C.
    near : list of int, k
        The net's nearest positions, counted along its rows.
    """
    loads, places, near = [0.0], [np.zeros(2)], [0]
    for row, (F, at) in enumerate(zip(force, position, strict=True)):
        stable = (F[:-1, 1] > 0.0) & (F[1:, 1] <= 0.0) & (F[:-1, 0] < 0.0)
        for i in np.flatnonzero(stable)[:1]:
            t = F[i, 1] / (F[i, 1] - F[i + 1, 1])
            load = -(F[i, 0] + t * (F[i + 1, 0] - F[i, 0]))
            if load > apart * loads[-1]:
                loads.append(float(load))
                places.append(at[i] + t * (at[i + 1] - at[i]))
                near.append(row * len(F) + int(i) + int(t > 0.5))
    near[0] = near[min(1, len(near) - 1)]
    return np.array(loads), np.array(places), near
