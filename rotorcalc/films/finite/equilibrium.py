"""The journal's equilibrium on a bore's film at many loads, by Newton's method on all together.

A coarse scan of positions inside the bore finds where the force points against the load; between
its places positions are interpolated over the load. From there Newton's method moves position and
active set at once: the same factorisation gives force and stiffness.
"""

from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.finite.reynolds import Films, Mesh, Solution, films, solved, stiffness
from rotorcalc.films.finite.sweeps import settled_pressures
from rotorcalc.films.pads import gap
from rotorcalc.films.rough_positions import crossings, net

# Shares of the way to the wall, and directions [rad], of the scan.
_SHARES = np.array([0.25, 0.5, 0.7, 0.84, 0.93, 0.965, 0.98])
_DIRECTIONS = np.radians(np.arange(-60.0, 151.0, 15.0))
_SCAN_SWEEPS = 3
# A step is at most this share of the film left, so that it never crosses the wall.
_LONGEST = 0.6
_MOST_STEPS = 30
# The force's error over the load, or over the film's stiffness times C, at which a step is last:
# its square is what remains. So few nodes of the active set may still change.
_TOLERANCE, _CHANGES = 1e-4, 2
# Close to a pad the film is so stiff that any step is small: there the force must be this close to
# the load, or to the film's stiffness times its thickness cubed, which is alike everywhere.
ASTRAY = 0.1


@dataclass(frozen=True, eq=False)
class Equilibria:
    """Positions of the journal at loads, with their films.

    Attributes
    ----------
    load : array, (P,)
        In μΩR³L/C².
    position : array, (P, 2)
        In C.
    wet : boolean array, (P, N, nodes, m)
        Where the film is full.
    good : boolean array, (P,)
        Whether the force carries the load there.
    """

    load: Array
    position: Array
    wet: BoolArray
    good: BoolArray


def scan(mesh: Mesh) -> tuple[Array, Array, BoolArray]:
    """Return loads and positions of rough equilibria, from light to heavy.

    Parameters
    ----------
    mesh : Mesh
        A coarse mesh of the bore.

    Returns
    -------
    load : array, (k,)
        In μΩR³L/C², rising.
    position : array, (k, 2)
        In C.
    wet : boolean array, (k, N, nodes, m)
        Where the film is full near there.
    """
    places = net(mesh.pads, _SHARES, _DIRECTIONS)
    position = places.reshape(-1, 2)
    found = films(mesh, position)
    wet = np.ones((len(position), *mesh.shape), dtype=bool)
    at = settled_pressures(found, wet, sweeps=_SCAN_SWEEPS)
    load, place, near = crossings(at.force.reshape(places.shape), places)
    return load, place, at.next_wet[near]


def settled(
    mesh: Mesh, load: Array, start: Array, wet: BoolArray, *, steps: int = _MOST_STEPS
) -> Equilibria:
    """Return equilibria at loads, from positions near them.

    Parameters
    ----------
    mesh : Mesh
        The bore's mesh.
    load : array, (P,)
        In μΩR³L/C².
    start : array, (P, 2)
        Where to begin, in C.
    wet : boolean array, (P, N, nodes, m)
        The active set to begin with.
    steps : int
        Number of Newton's steps at most.

    Returns
    -------
    Equilibria
        Not all of them good.
    """
    position, wet = start.copy(), wet.copy()
    good, active = np.zeros(len(load), dtype=bool), np.flatnonzero(gap(mesh.pads, position) > 0.0)
    for _ in range(steps):
        if not active.size:
            break
        found = films(mesh, position[active])
        at = solved(found, wet[active])
        step, error = _newton(mesh, found, at, load[active])
        position[active] += step
        after = at.next_wet
        still = (after != wet[active]).sum(axis=(1, 2, 3)) <= _CHANGES
        wet[active] = after
        good[active] = still & (error < _TOLERANCE)
        active = active[~good[active]]
    return Equilibria(load, position, wet, good)


def _newton(mesh: Mesh, found: Films, at: Solution, load: Array) -> tuple[Array, Array]:
    """Return Newton's step of each position, no longer than its film allows, and its error."""
    K = stiffness(found, at)
    rest = at.force + np.stack([load, np.zeros_like(load)], axis=-1)
    stiffest = np.abs(K).max(axis=(1, 2))
    determinant = K[:, 0, 0] * K[:, 1, 1] - K[:, 0, 1] * K[:, 1, 0]
    x = K[:, 1, 1] * rest[:, 0] - K[:, 0, 1] * rest[:, 1]
    y = K[:, 0, 0] * rest[:, 1] - K[:, 1, 0] * rest[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):  # it never settles, which is noticed
        step = np.stack([x, y], axis=-1) / determinant[:, None]
    position = found.relative[:, 0] + mesh.a[0]
    film = gap(mesh.pads, position)
    size, left = np.hypot(step[:, 0], step[:, 1]), np.hypot(rest[:, 0], rest[:, 1])
    with np.errstate(invalid="ignore"):
        error = np.minimum(left / (load + stiffest), size)
    error[left > ASTRAY * (load + stiffest * film**3)] = np.inf
    return step * np.minimum(1.0, _LONGEST * film / np.maximum(size, 1e-300))[:, None], error
