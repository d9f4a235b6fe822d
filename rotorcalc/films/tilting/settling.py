"""Journal and pads on flexures come to rest: implicit steps in time, from a start.

Nothing has mass; what the forces do not balance moves against the damping of the films,

    Σ Tᵀ F + F_o = Σ Tᵀ C ė,   F_η − κ δ = (C ė)_η,   ė = T q̇ + (0, δ̇),

in steps Δt that grow as the balance comes near, till they are Newton's. A plain Newton's method
loses its way where a pad gives up one film for another; in time the pad snaps over. The tilts are
eliminated pad by pad, so that two equations are left.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films.pads import gap
from rotorcalc.films.tilting.linear import joined
from rotorcalc.films.tilting.pivots import Pivots, places
from rotorcalc.films.tilting.plane import PadPlane

# A step is at most this share of any pad's film, and about the way to its centre of curvature:
# there the force has no derivatives.
_LONGEST, _FROM_CENTRE = 0.5, 1e-6
# Δt, in 1/Ω: the first one, the factor by which it grows, and the most steps, in haste, with care
# and from nearby; the least, and the factor by which it falls where the balance gets worse.
_HASTE, _CARE, _NEARBY = (30.0, 4.0, 120), (0.3, 1.5, 240), (1e6, 4.0, 8)
_LEAST, _FALLS, _EVEN = 0.1, 0.25, 1.5
# Force and moment left, over load and stiffness: where no step follows, and what is enough after
# the last.
_TOLERANCE, _ENOUGH, _BESIDE = 1e-9, 1e-6, 1e-2
# Damping of each tilt besides the film's, so that a pad without one moves in time too. A pad that
# gives way, K_ηη + κ < 0, goes its way in time, which a longer step would turn back: the share of
# the time in which its motion grows by a factor e.
_FRICTION, _SHARE = 0.02, 0.5
# Share of its tilt to which a pad is let go from a balance that does not hold.
_LET_GO = 0.5


class Held(NamedTuple):
    """What P journals are to balance: load and κ of the pivots (P,), in units of the film."""

    load: Array
    stiffness: Array

    def at(self, rows: IntArray) -> "Held":
        """Return some of them."""
        return Held(self.load[rows], self.stiffness[rows])


@dataclass(frozen=True, eq=False)
class Settled:
    """Journals and pads at P loads.

    Attributes
    ----------
    position : array, (P, 2)
        The journal's centre, in C.
    tilt : array, (P, N)
        δ of the pads, in C.
    good : boolean array, (P,)
        Whether forces and moments balance, and hold what they balance.
    """

    position: Array
    tilt: Array
    good: BoolArray

    def at(self, rows: IntArray) -> "Settled":
        """Return some of them."""
        return Settled(self.position[rows], self.tilt[rows], self.good[rows])


def settled(pad: PadPlane, pivots: Pivots, held: Held, start: Settled) -> Settled:
    """Return where journals and pads come to rest.

    Parameters
    ----------
    pad : PadPlane
        The films of one pad.
    pivots : Pivots
        The pads.
    held : Held
        Loads and κ.
    start : Settled
        Where to begin.

    Returns
    -------
    Settled
        Not all of it good.
    """
    return _resting(pad, pivots, held, start, _HASTE)


def carefully(pad: PadPlane, pivots: Pivots, held: Held, start: Settled) -> Settled:
    """Return the same by shorter steps."""
    return _resting(pad, pivots, held, start, _CARE)


def at_once(pad: PadPlane, pivots: Pivots, held: Held, start: Settled) -> Settled:
    """Return the same from a start nearby."""
    return _resting(pad, pivots, held, start, _NEARBY)


def let_go(pad: PadPlane, pivots: Pivots, held: Held, start: Settled) -> Settled:
    """Return the same from a balance that does not hold: pads that give way have begun to."""
    _, K, _ = pad.forces(places(pivots, start.position, start.tilt))
    gives = K[..., 1, 1] + held.stiffness[:, None] < 0.0
    begun = np.where(gives, _LET_GO * start.tilt, start.tilt)
    return settled(pad, pivots, held, Settled(start.position, begun, start.good))


def towards(pad: PadPlane, pivots: Pivots, held: Held, start: Settled, *, steps: int) -> Settled:
    """Return journal and pads after some steps, on the way to other κ."""
    first, grows, _ = _HASTE
    found, _ = _in_time(pad, pivots, held, start, (first, grows, steps))
    return found


def _resting(
    pad: PadPlane, pivots: Pivots, held: Held, start: Settled, pace: tuple[float, float, int]
) -> Settled:
    found, error = _in_time(pad, pivots, held, start, pace)
    good = np.flatnonzero(error <= _ENOUGH)
    found.good[good] = _stays(pad, pivots, held.stiffness[good], found.at(good))
    return found


def _in_time(
    pad: PadPlane, pivots: Pivots, held: Held, start: Settled, pace: tuple[float, float, int]
) -> tuple[Settled, Array]:
    """Return journal and pads after steps in time, none of them good, and their errors (P,)."""
    position, tilt = start.position.copy(), start.tilt.copy()
    first, grows, most = pace
    dt, last = np.full(len(position), first), np.full(len(position), np.inf)
    for _ in range(most):
        active = np.flatnonzero(last > _TOLERANCE)
        if not active.size:
            break
        at = position[active], tilt[active]
        step, turn, error = _step(pad, pivots, held.at(active), at, dt[active])
        with np.errstate(divide="ignore", invalid="ignore"):
            nearer = np.fmin(_EVEN * last[active] / error, grows)
        dt[active] = np.maximum(_LEAST, dt[active] * np.maximum(nearer, _FALLS))
        last[active] = error
        moves = (error > _TOLERANCE) & np.isfinite(step).all(axis=1) & np.isfinite(turn).all(axis=1)
        position[active[moves]] += step[moves]
        tilt[active[moves]] += turn[moves]
    return Settled(position, tilt, np.zeros(len(position), dtype=bool)), last


def _step(
    pad: PadPlane, pivots: Pivots, held: Held, at: tuple[Array, Array], dt: Array
) -> tuple[Array, Array, Array]:
    """Return steps of position (P, 2) and tilts (P, N), and the error (P,)."""
    T, kappa, (position, tilt) = pivots.frames, held.stiffness[:, None], at
    e = places(pivots, position, tilt)
    F, still, C = pad.forces(e)
    K = _in_a_step(still, C, kappa, dt)
    moment, yields = F[..., 1] - kappa * tilt, K[..., 1, 1] + kappa
    alone = moment / yields
    follows = K[..., 1, :] / yields[..., None]
    force = _on_journal(T, F, held.load)
    left = _on_journal(T, F - K[..., 1] * alone[..., None], held.load)
    reduced = K - K[..., :, 1:] * follows[..., None, :]
    step = _solved(np.einsum("nai,pnab,nbj->pij", T, reduced, T), left)
    turn = alone - np.einsum("pnb,nbj,pj->pn", follows, T, step)
    moved = np.einsum("nai,pi->pna", T, step)
    moved[..., 1] += turn
    share = _share_of(pad, e, moved)
    error = np.abs(force).max(axis=1) + np.abs(moment).max(axis=1)
    error /= held.load + _BESIDE * np.abs(still).max(axis=(1, 2, 3))
    return step * share, turn * share, error


def _in_a_step(K: Array, C: Array, kappa: Array, dt: Array) -> Array:
    """Return K + C/Δt of pads (P, N, 2, 2), Δt no longer than a pad takes that gives way."""
    resists = C[..., 1, 1] + _FRICTION
    own = K[..., 1, 1] + kappa
    slowest = np.where(own < 0.0, _SHARE * resists / np.maximum(-own, 1e-300), np.inf)
    rate = 1.0 / np.minimum(dt, slowest.min(axis=1))
    total = K + C * rate[:, None, None, None]
    total[..., 1, 1] += _FRICTION * rate[:, None]
    return total


def _share_of(pad: PadPlane, e: Array, moved: Array) -> Array:
    """Return the share (P, 1) of a step of all pads (P, N, 2) that is taken."""
    far = np.hypot(e[..., 0], e[..., 1]) + _FROM_CENTRE
    longest = np.minimum(_LONGEST * gap((pad.pad,), e), far)
    size = np.maximum(np.hypot(moved[..., 0], moved[..., 1]), 1e-300)
    return np.minimum(1.0, (longest / size).min(axis=1))[:, None]


def _on_journal(T: Array, F: Array, load: Array) -> Array:
    """Return the force of pads (P, N, 2) and the load on the journal, (P, 2)."""
    force = np.einsum("nai,pna->pi", T, F)
    force[:, 0] += load
    return force


def _solved(K: Array, force: Array) -> Array:
    """Return K⁻¹ F of matrices (P, 2, 2), where K is singular not finite."""
    determinant = K[:, 0, 0] * K[:, 1, 1] - K[:, 0, 1] * K[:, 1, 0]
    x = K[:, 1, 1] * force[:, 0] - K[:, 0, 1] * force[:, 1]
    y = K[:, 0, 0] * force[:, 1] - K[:, 1, 0] * force[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.stack([x, y], axis=-1) / determinant[:, None]


def _stays(pad: PadPlane, pivots: Pivots, kappa: Array, at: Settled) -> BoolArray:
    """Return where journal and pads stay: no motion leaves without a whirl, as from a saddle."""
    _, K, C = pad.forces(places(pivots, at.position, at.tilt))
    T, number = pivots.frames, pivots.number
    own = np.broadcast_to(kappa[:, None], (len(kappa), number))
    whole = joined(K, T, own), joined(C, T, np.full_like(own, _FRICTION))
    rates = np.linalg.eigvals(-np.linalg.solve(whole[1], whole[0]))
    leaves = (rates.real > 0.0) & (np.abs(rates.imag) < 1e-9)
    return np.logical_not(leaves.any(axis=1))
