"""How finely the films of a foil bearing were computed, and how far a finer mesh's lies from it."""

import math

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.foil.equilibrium import refined, settled
from rotorcalc.films.foil.impedance import impedance
from rotorcalc.films.foil.mesh import mesh
from rotorcalc.films.foil.table import FoilShape, over_speed
from rotorcalc.films.model import Accuracy


def accuracy(foil: FoilShape, number: float, load: float) -> Accuracy:
    """Return the resolution of a table over speed, and its distance from a finer solution.

    That has twice as many cells around the bore and two pressures more along half of it, and is
    solved at the place itself: what splines miss is included.

    Parameters
    ----------
    foil : FoilShape
        The bearing.
    number, load : float
        Λ and W [-], which the table holds.

    Returns
    -------
    Accuracy
        NaN where the finer mesh has no equilibrium.
    """
    found, place = over_speed(foil, load), math.log(number)
    near = found.nearest(place)
    around, along = near.mesh.shape
    words = (
        f"{around + 1} cells around the bore and {along} pressures along half of the bearing, at "
        f"{len(found.place)} places"
    )
    fine = mesh(near.mesh.slenderness, foil.slit, 2 * (around + 1), along + 2)
    at = settled(refined(near.at(np.array([number])), fine), np.array([load]), steps=30)
    if not at.good.all():
        return Accuracy(words, np.nan, np.nan, np.nan)
    Z = impedance(at.films, 1.0, foil.loss_factor)[0]
    K, C = found.whirl.synchronous(np.array(place))
    return Accuracy(
        words,
        place=float(np.hypot(*(at.films.position[0] - found.row(np.array(place)).position))),
        stiffness=_apart(K, Z.real),
        damping=_apart(C, Z.imag),
    )


def _apart(one: Array, other: Array) -> float:
    return float(np.abs(one - other).max() / np.abs(other).max())
