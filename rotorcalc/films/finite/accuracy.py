"""How finely the film of a bore was computed, and how far a finer mesh's answer lies from it."""

import numpy as np

from rotorcalc.films.finite.equilibrium import settled
from rotorcalc.films.finite.fronts import coefficients
from rotorcalc.films.finite.reynolds import films, mesh
from rotorcalc.films.finite.sweeps import settled_pressures
from rotorcalc.films.finite.table import FilmTable, carried
from rotorcalc.films.model import Accuracy


def accuracy(found: FilmTable, sommerfeld: float) -> Accuracy:
    """Return the resolution of a bore's table, and its distance from a finer solution at one load.

    That has twice as many cells around each pad and one pressure more along each zone, and is
    solved at the load itself: what splines between the table's loads miss is included.

    Parameters
    ----------
    found : FilmTable
        The film over load.
    sommerfeld : float
        σ [-].

    Returns
    -------
    Accuracy
        NaN where the finer mesh has no equilibrium.
    """
    pads, nodes, along = found.mesh.shape
    zones = found.mesh.weights.shape[1]
    cells = nodes + 1
    words = (
        f"{pads} {'pad' if pads == 1 else 'pads'}, {cells} cells around each and {along} pressures "
        f"along half of the bearing, at {len(found.load)} loads"
    )
    fine = mesh(found.mesh.pads, found.mesh.slenderness, 2 * cells, along + zones)
    # Beyond the light end all that is compared changes no more, or in proportion.
    load = max(0.25 / sommerfeld, float(found.load[0]))
    row = found.row(np.array(0.25 / load))
    film = fine.slenderness / 4.0  # R units to film units
    wet = found.wet[[int(np.abs(np.log(found.load / load)).argmin())]]
    at = settled(fine, np.array([load / film]), row.position[None], carried(wet, fine))
    if not at.good.all():
        return Accuracy(words, np.nan, np.nan, np.nan)
    over = films(fine, at.position)
    K, C = (film * each[0] for each in coefficients(over, settled_pressures(over, at.wet)))
    table_K, table_C = found.coefficients(np.array(0.25 / load))
    return Accuracy(
        words,
        place=float(np.hypot(*(at.position[0] - row.position))),
        stiffness=float(np.abs(table_K - K).max() / np.abs(K).max()),
        damping=float(np.abs(table_C - C).max() / np.abs(C).max()),
    )
