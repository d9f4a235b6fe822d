"""Journal and pads at rest, solved on the mesh: Newton's method on position and tilts together.

At each load the journal's balance, Σ F + F_o = 0, and each pad's, F_η = κ δ, are met at once. The
films of all pads at all loads are those of one pad at many places, in one batch. A tilt is
eliminated pad by pad, so that two equations are left:

    dδ = (F_η − κ δ − e_η K T dq)/(K_ηη + κ).
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films.finite.reynolds import Films, Mesh, Solution, films, solved, stiffness
from rotorcalc.films.pads import gap
from rotorcalc.films.tilting.pivots import Pivots, places

# A step is at most this share of any pad's film.
_LONGEST, _MOST_STEPS = 0.5, 40
# A film so thin is given up.
_CLOSED = 1e-4
# The errors of forces and moments, over load and stiffness, at which a step is the last.
_TOLERANCE, _CHANGES = 1e-5, 2


@dataclass(frozen=True, eq=False)
class Balance:
    """Journal and pads in balance at P loads, on a mesh of one pad.

    Attributes
    ----------
    position : array, (P, 2)
        The journal's centre, in C.
    tilt : array, (P, N)
        δ of the pads, in C.
    wet : boolean array, (P·N, 1, nodes, m)
        Where the films of the pads are full.
    good : boolean array, (P,)
        Whether the balance was met.
    """

    position: Array
    tilt: Array
    wet: BoolArray
    good: BoolArray


def rows_of(loads: IntArray, number: int) -> IntArray:
    """Return where the films of the pads at some loads lie among those of all, (P·N,)."""
    each: IntArray = loads[:, None] * number + np.arange(number)
    return each.reshape(-1)


class Asked(NamedTuple):
    """What is to balance at P loads.

    Attributes
    ----------
    load, stiffness : array, (P,)
        Loads and κ of the pivots, in units of the film.
    held : boolean array, (P, N)
        Pads without load, which keep their tilt.
    """

    load: Array
    stiffness: Array
    held: BoolArray

    @classmethod
    def of(cls, load: Array, stiffness: Array, pivots: Pivots) -> "Asked":
        """Return loads and κ at which no pad is held."""
        return cls(load, stiffness, np.zeros((len(load), pivots.number), dtype=bool))

    def at(self, rows: IntArray) -> "Asked":
        """Return some of them."""
        return Asked(self.load[rows], self.stiffness[rows], self.held[rows])


def balanced(grid: Mesh, pivots: Pivots, asked: Asked, start: Balance) -> Balance:
    """Return journal and pads in balance, from a start nearby.

    Parameters
    ----------
    grid : Mesh
        The mesh of one pad.
    pivots : Pivots
        The pads.
    asked : Asked
        Loads and κ.
    start : Balance
        Where to begin.

    Returns
    -------
    Balance
        Not all of it good.
    """
    position, tilt, wet = start.position.copy(), start.tilt.copy(), start.wet.copy()
    good, number = np.zeros(len(position), dtype=bool), pivots.number
    unit = grid.slenderness / 4.0  # from units of the equation to those of the film
    asked = Asked(asked.load / unit, asked.stiffness / unit, asked.held)
    for _ in range(_MOST_STEPS):
        e = places(pivots, position, tilt)
        inside = gap(grid.pads, e.reshape(-1, 2)).reshape(tilt.shape).min(axis=1) > _CLOSED
        active = np.flatnonzero(~good & inside)
        if not active.size:
            break
        e = e[active]
        rows = rows_of(active, number)
        found = films(grid, e.reshape(-1, 2))
        at = solved(found, wet[rows])
        step, turn, error = _newton((found, at), pivots, asked.at(active), tilt[active])
        # Where nothing holds the journal there is no step.
        moves = np.isfinite(step).all(axis=1) & np.isfinite(turn).all(axis=1)
        position[active[moves]] += step[moves]
        tilt[active[moves]] += turn[moves]
        after = at.next_wet
        changed = (after != wet[rows]).sum(axis=(1, 2, 3)).reshape(-1, number).max(axis=1)
        wet[rows] = after
        good[active] = moves & (changed <= _CHANGES) & (error < _TOLERANCE)
    return Balance(position, tilt, wet, good)


def _newton(
    solution: tuple[Films, Solution], pivots: Pivots, asked: Asked, tilt: Array
) -> tuple[Array, Array, Array]:
    """Return the steps of position (P, 2) and tilts (P, N), and the error (P,)."""
    (found, at), (load, stiff, held) = solution, asked
    shape, T = tilt.shape, pivots.frames
    K = stiffness(found, at).reshape(*shape, 2, 2)
    F = at.force.reshape(*shape, 2)
    moment = np.where(held, 0.0, F[..., 1] - stiff[:, None] * tilt)
    # A pad that is held does not turn: its film is as of a fixed one.
    yields = np.where(held, np.inf, K[..., 1, 1] + stiff[:, None])
    with np.errstate(divide="ignore", invalid="ignore"):
        alone = moment / yields
        follows = K[..., 1, :] / yields[..., None]
        reduced = K - K[..., :, 1:] * follows[..., None, :]
        force = F - K[..., 1] * alone[..., None]
        journal = np.einsum("nai,pna->pi", T, force)
        journal[:, 0] += load
        step = _solved(np.einsum("nai,pnab,nbj->pij", T, reduced, T), journal)
        turn = alone - np.einsum("pnb,nbj,pj->pn", follows, T, step)
    moved = np.einsum("nai,pi->pna", T, step)
    moved[..., 1] += turn
    room = gap(found.mesh.pads, found.relative[:, 0]).reshape(shape)
    size = np.hypot(moved[..., 0], moved[..., 1])
    share = np.minimum(1.0, (_LONGEST * room / np.maximum(size, 1e-300)).min(axis=1))
    left = np.abs(journal).max(axis=1) + np.abs(moment).max(axis=1)
    stiffest = np.abs(K).max(axis=(1, 2, 3))
    error = np.minimum(left / (load + stiffest), size.max(axis=1)) + (share < 1.0)
    return step * share[:, None], turn * share[:, None], error


def _solved(K: Array, force: Array) -> Array:
    """Return K⁻¹ F of matrices (P, 2, 2), where K is singular not finite."""
    determinant = K[:, 0, 0] * K[:, 1, 1] - K[:, 0, 1] * K[:, 1, 0]
    x = K[:, 1, 1] * force[:, 0] - K[:, 0, 1] * force[:, 1]
    y = K[:, 0, 0] * force[:, 1] - K[:, 1, 0] * force[:, 0]
    return np.stack([x, y], axis=-1) / determinant[:, None]
