"""Stiffness and damping of a bearing from those of its pads, tilts included.

A pad's force on the journal and its moment about the pivot, over R, are those of its film in ξ, η;
the moment of the pivot's stiffness is κ δ. With the rows n, t of the pad's frame T,

    K_qq = Σ Tᵀ K T,   K_qδ = Tᵀ K e_η,   K_δq = e_η K T,   K_δδ = K_ηη + κ.
"""

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.dynamics import FilmDynamics
from rotorcalc.films.tilting.rest import Rest

# Stiffness and damping that hold a pad without load, in units of the film: nothing else does, and
# it acts on nothing. Alone it returns at the rate of rotation.
_HELD = 1.0


def dynamics(rest: Rest, frames: Array, stiffness: Array, inertia: float) -> FilmDynamics:
    """Return stiffness and damping of journal and tilts, in units of the film.

    Parameters
    ----------
    rest : Rest
        Journal and pads at rest, (...).
    frames : array, (N, 2, 2)
        Rows n and t of each pad.
    stiffness : array, (...)
        κ of the pivots, in units of the film.
    inertia : float
        Of each pad, as a mass that moves with its tilt times R [kg].

    Returns
    -------
    FilmDynamics
        In the order X, Y, tilts δ.
    """
    number = len(frames)
    held: Array = np.where(rest.pads.loaded, 0.0, _HELD)
    pivots = np.broadcast_to(np.asarray(stiffness, dtype=float)[..., None], held.shape)
    return FilmDynamics(
        stiffness=joined(rest.pads.stiffness, frames, pivots + held),
        damping=joined(rest.pads.damping, frames, held),
        inertia=np.full(number, inertia),
    )


def joined(pads: Array, frames: Array, own: Array) -> Array:
    """Return (..., 2+N, 2+N) of pads' (..., N, 2, 2) and what acts on each tilt alone (..., N)."""
    number = len(frames)
    whole = np.zeros((*pads.shape[:-3], 2 + number, 2 + number))
    turned = pads @ frames  # by pad: rows in ξ, η, columns in X, Y
    whole[..., :2, :2] = (np.swapaxes(frames, -1, -2) @ turned).sum(axis=-3)
    whole[..., 2:, :2] = turned[..., 1, :]
    onto = np.swapaxes(frames, -1, -2) @ pads[..., :, 1:]  # (..., N, 2, 1)
    whole[..., :2, 2:] = np.swapaxes(onto[..., 0], -1, -2)
    each = np.arange(number) + 2
    whole[..., each, each] = pads[..., 1, 1] + own
    return whole
