"""How finely the pads of a bearing were computed, and how far a finer mesh's answer lies off."""

import numpy as np

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.dynamics import reduced
from rotorcalc.films.finite.reynolds import Mesh, films, mesh
from rotorcalc.films.finite.sweeps import settled_pressures
from rotorcalc.films.finite.table import carried
from rotorcalc.films.model import Accuracy
from rotorcalc.films.tilting import linear
from rotorcalc.films.tilting.balance import Asked, Balance, balanced
from rotorcalc.films.tilting.family import PadFamily, columns, states
from rotorcalc.films.tilting.pivots import places
from rotorcalc.films.tilting.rest import FreePads, Rest


def accuracy(pads: FreePads, sommerfeld: float) -> Accuracy:
    """Return the resolution of free pads' films, and their distance from a finer solution.

    That has twice as many cells around each pad and one pressure more along it, and is solved for
    journal and tilts at the load itself; K and C are those of synchronous motion without inertia.

    Parameters
    ----------
    pads : FreePads
        The pads.
    sommerfeld : float
        σ [-].

    Returns
    -------
    Accuracy
        NaN where the finer mesh has no equilibrium.
    """
    known, pivots = pads.family.mesh, pads.pivots
    cells, along = known.links, known.shape[2]
    words = (
        f"{pivots.number} pads alike, {cells} cells around each and {along} pressures along half "
        f"of it, {len(pads.family.xi)} films of a pad that tilts freely"
    )
    fine = mesh(known.pads, known.slenderness, 2 * cells, along + 1)
    load = np.array([0.25 / sommerfeld])
    here = pads.at(load, np.zeros(1))
    start = Balance(
        here.position, here.tilt, _wet_near(pads.family, here.pads.xi, fine), load < 0.0
    )
    found = balanced(fine, pivots, Asked(load, np.zeros(1), ~here.pads.loaded), start)
    if not found.good.all():
        return Accuracy(words, np.nan, np.nan, np.nan)
    e = places(pivots, found.position, found.tilt)
    over = films(fine, e.reshape(-1, 2))
    values = columns(over, settled_pressures(over, found.wet)).reshape(1, pivots.number, -1)
    values *= here.pads.loaded[..., None]
    finer = states(e[..., 0], values, here.pads.loaded)
    K, C = _synchronous(Rest(found.position, found.tilt, finer), pads)
    known_K, known_C = _synchronous(here, pads)
    return Accuracy(
        words,
        place=float(np.hypot(*(found.position - here.position)[0])),
        stiffness=float(np.abs(known_K - K).max() / np.abs(K).max()),
        damping=float(np.abs(known_C - C).max() / np.abs(C).max()),
    )


def _synchronous(rest: Rest, pads: FreePads) -> tuple[Array, Array]:
    """Return stiffness and damping with the tilts eliminated at ν = 1."""
    found = linear.dynamics(rest, pads.pivots.frames, np.zeros(1), 0.0)
    return reduced(found, np.ones(1))


def _wet_near(family: PadFamily, xi: Array, grid: Mesh) -> BoolArray:
    """Return where films of pads at ξ (...) may be full, on a mesh, (..., flat)."""
    nearest = np.abs(xi.reshape(-1)[:, None] - family.xi).argmin(axis=1)
    return carried(family.wet[nearest], grid)
