"""Static equilibrium of many gas films at once: Newton's method, the load raised in steps.

The journal's position and all pressures are unknown together. Each film goes its own way from no
load to its own: a step that succeeds makes the next one longer, one that fails is halved.
"""

from dataclasses import dataclass, replace

import numpy as np

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films.foil.along import rise_along
from rotorcalc.films.foil.mesh import Mesh
from rotorcalc.films.foil.newton import newton_step, stepped
from rotorcalc.films.foil.reynolds import Films, gap

# The first share of the load, how steps grow, and where a load is given up.
_FIRST, _GROWTH, _SMALLEST = 0.05, 2.0, 1e-4
# Load, F/(p_a D L), that is a light one for any film: half of it is the first step at most.
_LIGHT = 0.05
# Steps of Newton's method for one share of the load, and over all shares together.
_STEPS, _ALL = 12, 400
# Change of pressure [p_a] and position [C] at convergence, whose square is the error, and on the
# way to a load.
_SETTLED, _NEARLY = 1e-5, 1e-3
# Thickness that a guess has at least, in C.
_OPEN = 1e-2


@dataclass(frozen=True, eq=False)
class Equilibria:
    """Films in equilibrium with their loads.

    Attributes
    ----------
    films : Films
        Pressures and positions.
    good : boolean array, (P,)
        Where an equilibrium was found; elsewhere the last one on the way to it.
    """

    films: Films
    good: BoolArray


def taken(films: Films, places: IntArray | BoolArray) -> Films:
    """Return the films at some places."""
    return replace(
        films,
        number=films.number[places],
        position=films.position[places],
        pressure=films.pressure[places],
    )


def joined(one: Films, other: Films) -> Films:
    """Return two sets of films as one."""
    return replace(
        one,
        number=np.concatenate([one.number, other.number]),
        position=np.concatenate([one.position, other.position]),
        pressure=np.concatenate([one.pressure, other.pressure]),
    )


def refined(films: Films, fine: Mesh) -> Films:
    """Return films on another mesh, by lines around the bore and ψ's polynomial along it."""
    old, angle = films.mesh, fine.angle[1:-1]
    along = np.pad(rise_along(films, fine.zeta[:-1]), ((0, 0), (1, 1), (0, 0)))
    i = np.clip(np.searchsorted(old.angle, angle) - 1, 0, len(old.angle) - 2)
    t = ((angle - old.angle[i]) / old.step)[:, None]
    rise = (1.0 - t) * along[:, i] + t * along[:, i + 1]
    # Between two angles the line may lie below the journal's surface.
    least = (_OPEN - gap(films.position, angle)[..., None]) / films.compliance
    closed = films.compliance * np.maximum(rise, 0.0) < least * films.compliance
    return replace(films, mesh=fine, pressure=1.0 + np.where(closed, least, rise))


def put(films: Films, places: IntArray, some: Films) -> Films:
    """Return films with some of them replaced."""
    position, pressure = films.position.copy(), films.pressure.copy()
    position[places], pressure[places] = some.position, some.pressure
    return replace(films, position=position, pressure=pressure)


def settled(
    films: Films, load: Array, *, steps: int = _STEPS, change: float = _SETTLED
) -> Equilibria:
    """Return the equilibria at loads F/(p_a D L) (P,) that Newton's method finds from films.

    It takes as many steps, and ends where the last one changes them by less.
    """
    goal = np.stack([2.0 * load, np.zeros_like(load)], axis=-1)
    good = np.zeros(len(load), dtype=bool)
    near = change * np.minimum(1.0, 20.0 * load)
    for _ in range(steps):
        left = np.flatnonzero(~good)
        if not left.size:
            break
        some = taken(films, left)
        pressure, position = newton_step(some, goal[left])
        moved = np.maximum(np.abs(pressure).max(axis=(1, 2)), np.abs(position).max(axis=1))
        after, share = stepped(some, pressure, position)
        films = put(films, left, after)
        good[left] = (moved < near[left]) & (share == 1.0)
    return Equilibria(films, good)


def raised(mesh: Mesh, compliance: float, number: Array, load: Array, least: float) -> Equilibria:
    """Return the equilibria of films at loads, each load raised from none.

    Parameters
    ----------
    mesh : Mesh
        The mesh.
    compliance : float
        α [-].
    number, load : array, (P,)
        Λ and F/(p_a D L) [-].
    least : float
        Thickness in the middle plane, in C, below which a film is given up.

    Returns
    -------
    Equilibria
        At the loads where `good`.
    """
    films = _started(mesh, compliance, number)
    share, step = np.zeros(len(load)), np.minimum(_FIRST, 0.5 * _LIGHT / load)
    before, known = np.zeros(len(load)), films  # the last equilibrium but one
    lost = np.zeros(len(load), dtype=bool)
    for _ in range(_ALL):
        left = np.flatnonzero(~lost & (share < 1.0))
        if not left.size:
            break
        at = np.minimum(share[left] + step[left], 1.0)
        guess = _ahead(taken(known, left), taken(films, left), before[left], share[left], at)
        found = settled(guess, at * load[left], change=_NEARLY)
        won, missed = left[found.good], left[~found.good]
        known = put(known, won, taken(films, won))
        films = put(films, won, taken(found.films, found.good))
        before[won], share[won] = share[won], at[found.good]
        step[won] *= _GROWTH
        step[missed] *= 0.4
        thin = films.least_thickness < least
        lost |= (step < _SMALLEST) | thin
    return Equilibria(films, (share >= 1.0) & ~lost)


def resting(mesh: Mesh, compliance: float, number: Array) -> Films:
    """Return the films about a centred journal, which carry nothing."""
    P, (n, m) = len(number), mesh.shape
    return Films(mesh, compliance, number, np.zeros((P, 2)), np.ones((P, n, m)))


def _started(mesh: Mesh, compliance: float, number: Array) -> Films:
    """Return films about a journal that is all but centred."""
    films = resting(mesh, compliance, number)
    position = np.tile([1e-3, 2e-3], (len(number), 1))
    # Above ambient by a rounding: the side from which the foil begins to move.
    return replace(films, position=position, pressure=films.pressure + 1e-9)


def _ahead(before: Films, here: Films, low: Array, share: Array, at: Array) -> Films:
    """Return the films where the line through two equilibria leads, if they stay full."""
    ratio = np.where(share > low, (at - share) / np.where(share > low, share - low, 1.0), 0.0)
    ratio = np.where(low > 0.0, ratio, 0.0)
    ahead, _ = stepped(
        here,
        ratio[:, None, None] * (here.pressure - before.pressure),
        ratio[:, None] * (here.position - before.position),
    )
    return ahead
