"""The mesh of a hydrostatic bearing's lands: half of the bearing, unrolled.

Lines of nodes lie on the recesses' edges and are dense beside them: the pressure's slope is without
bound in the recesses' corners. Recess k has its middle at the angle 2πk/N from the load line; ζ =
2z/L runs from the middle plane, 0, to the end, 1, where the pressure is ambient.
"""

import functools
import math
from dataclasses import dataclass
from typing import cast

import numpy as np

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.geometry import Hydrostatic, recess_angle
from rotorcalc.machine import JournalBearing

_TURN = 2.0 * math.pi
# The share of cosine spacing, which is dense at the edges, in the spacing of the nodes.
_DENSE = 0.85


@dataclass(frozen=True)
class Lands:
    """What the lands' flow depends on besides the journal's position.

    Attributes
    ----------
    recesses : int
        Number of recesses, N.
    land_ratio : float
        Axial length of the land at either end over the bearing's length, a/L [-].
    land_angle : float
        Angle of the lands between the recesses [rad].
    slenderness : float
        (D/L)² [-].
    """

    recesses: int
    land_ratio: float
    land_angle: float
    slenderness: float

    @property
    def recess_angle(self) -> float:
        """Angle of a recess [rad]."""
        return recess_angle(self.recesses, self.land_angle)

    @property
    def edge(self) -> float:
        """ζ of the recesses' edge."""
        return 1.0 - 2.0 * self.land_ratio


def lands_of(bearing: JournalBearing) -> Lands:
    """Return the lands of a bearing of a `Hydrostatic` geometry."""
    shape, ratio = cast("Hydrostatic", bearing.geometry), bearing.diameter / bearing.length
    return Lands(int(shape.recesses), shape.land_ratio, shape.land_angle, ratio**2)


@dataclass(frozen=True)
class Cells:
    """Numbers of cells: over a recess and a land around, over a recess and a land along."""

    recess: int
    land: int
    inside: int
    outside: int


@dataclass(frozen=True, eq=False)
class Mesh:
    """Nodes of the lands; n angles, m places along half the bearing, the end left out.

    Attributes
    ----------
    lands : Lands
        The lands.
    beta : array, (n,)
        Angles of the nodes from the load line, rising [rad].
    zeta : array, (m + 1,)
        Places along the bearing, from the middle, 0, to the end, 1.
    recess : int array, (n, m)
        The recess in which a node lies, −1 on a land.
    """

    lands: Lands
    beta: Array
    zeta: Array
    recess: IntArray

    @functools.cached_property
    def step(self) -> Array:
        """Angles from each node to the next, (n,), the last one to the first node."""
        return np.diff(self.beta, append=self.beta[0] + _TURN)

    @functools.cached_property
    def middle(self) -> Array:
        """Middles of the links from each node to the next, (n,)."""
        return self.beta + 0.5 * self.step

    @functools.cached_property
    def length(self) -> Array:
        """Share of the half length that belongs to each node, (m,)."""
        edges = 0.5 * (self.zeta[1:] + self.zeta[:-1])
        return np.diff(edges, prepend=0.0)

    @functools.cached_property
    def is_land(self) -> BoolArray:
        """Whether a node is on a land, (n, m)."""
        return self.recess < 0

    @functools.cached_property
    def unknown(self) -> IntArray:
        """Number of a land node among the unknowns, (n, m); in a recess past them all.

        The circle is folded, angles from both sides in turn, so that it makes a narrow band.
        """
        n = len(self.beta)
        folded = np.empty(n, dtype=np.intp)
        folded[0::2], folded[1::2] = np.arange((n + 1) // 2), n - 1 - np.arange(n // 2)
        found = np.full(self.recess.shape, self.count)
        place = self.is_land[folded]
        rows = np.full(place.shape, self.count)
        rows[place] = np.arange(self.count)
        found[folded] = rows
        return found

    @property
    def count(self) -> int:
        """Number of unknown pressures."""
        return int(np.count_nonzero(self.is_land))

    @functools.cached_property
    def weights(self) -> Array:
        """Integrals of cos β and sin β over each node's part of the half bearing, (2, n, m)."""
        edges = np.concatenate([self.middle[-1:] - _TURN, self.middle])
        around = np.stack([np.diff(np.sin(edges)), -np.diff(np.cos(edges))])
        return around[:, :, None] * self.length


@functools.lru_cache(maxsize=32)
def mesh(lands: Lands, cells: Cells) -> Mesh:
    """Return the mesh of a bearing's lands.

    Parameters
    ----------
    lands : Lands
        The lands.
    cells : Cells
        Numbers of cells.

    Returns
    -------
    Mesh
        With as many cells in each recess and on each land.
    """
    half = 0.5 * lands.recess_angle
    over_recess = half * _both_ends(cells.recess)
    over_land = half + lands.land_angle * 0.5 * (1.0 + _both_ends(cells.land))
    period = np.concatenate([over_recess[:-1], over_land[:-1]])
    starts = _TURN / lands.recesses * np.arange(lands.recesses)
    beta = (starts[:, None] + period).ravel()
    zeta = np.concatenate([
        lands.edge * _one_end(cells.inside)[:-1],
        1.0 - 2.0 * lands.land_ratio * _one_end(cells.outside)[::-1],
    ])  # fmt: skip
    # A node at either end of the recess, and the line on its edge, belong to it.
    around = np.tile(np.arange(len(period)) <= cells.recess, lands.recesses)
    which = np.repeat(np.arange(lands.recesses), len(period))
    along = np.arange(len(zeta) - 1) <= cells.inside
    recess = np.where(around[:, None] & along, which[:, None], -1)
    return Mesh(lands, beta, zeta, recess)


def _both_ends(cells: int) -> Array:
    """Return places from −1 to 1, dense at both."""
    s = np.linspace(-1.0, 1.0, cells + 1)
    return (1.0 - _DENSE) * s + _DENSE * np.sin(0.5 * np.pi * s)


def _one_end(cells: int) -> Array:
    """Return places from 0 to 1, dense at 1."""
    s = np.linspace(0.0, 1.0, cells + 1)
    return (1.0 - _DENSE) * s + _DENSE * np.sin(0.5 * np.pi * s)
