"""The mesh of a foil bearing's film: nodes around the bore, a polynomial along half of it.

Pressures stand at the nodes of Gauss and Lobatto along the axis, even in ζ = 2z/L, and at evenly
spaced angles from the slit around to the slit. There and at the ends the gas is ambient.
"""

import functools
from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.finite.axial import derivatives, lagrange, lobatto


@dataclass(frozen=True, eq=False)
class Mesh:
    """A mesh of n angles with m unknown pressures along half the bearing at each.

    Attributes
    ----------
    slenderness : float
        (D/L)² [-].
    angle : array, (n + 2,)
        Angles of the nodes from X, the slit first and last [rad].
    step : float
        Angle between two nodes [rad].
    zeta : array, (m + 1,)
        Places along the axis, 0 ≤ ζ ≤ 1; the last is the end.
    weights : array, (m + 1,)
        Lumped integrals of the basis over 0 ≤ ζ ≤ 1.
    stiffness : array, (m, m + 1)
        Integrals of products of its derivatives.
    outflow : array, (m + 1,)
        −∂/∂ζ at the end, by value at the nodes.
    slopes : array, (m + 1, m + 1)
        Derivatives of the basis by ζ at the nodes.
    """

    slenderness: float
    angle: Array
    step: float
    zeta: Array
    weights: Array
    stiffness: Array
    outflow: Array
    slopes: Array

    @property
    def shape(self) -> tuple[int, int]:
        """Number of angles, n, and of pressures along half the bearing, m."""
        return len(self.angle) - 2, len(self.zeta) - 1

    @property
    def faces(self) -> Array:
        """Angles midway between the nodes, (n + 1,) [rad]."""
        return 0.5 * (self.angle[1:] + self.angle[:-1])

    def along(self, zeta: Array) -> Array:
        """Return the basis at places |ζ| ≤ 1, (k, m + 1)."""
        nodes = np.concatenate([-self.zeta[:0:-1], self.zeta])
        values = lagrange(nodes, np.abs(zeta).reshape(-1))
        m = len(self.zeta) - 1
        found = values[:, m:].copy()
        found[:, 1:] += values[:, m - 1 :: -1]  # even in ζ
        return found


@functools.lru_cache(maxsize=64)
def mesh(slenderness: float, slit: float, around: int, along: int) -> Mesh:
    """Return a mesh.

    Parameters
    ----------
    slenderness : float
        (D/L)² [-].
    slit : float
        Angle of the slit from X [rad].
    around, along : int
        Number of cells around the bore, and of unknown pressures along half of it.

    Returns
    -------
    Mesh
        With `around` − 1 angles between the slit's two sides.
    """
    angle = np.linspace(slit, slit + 2.0 * np.pi, around + 1)
    nodes, weights = lobatto(2 * along)
    # Even functions: the values at ±ζ are one.
    fold = np.zeros((2 * along + 1, along + 1))
    for q in range(along + 1):
        fold[along + q, q] = fold[along - q, q] = 1.0
    slope = derivatives(nodes) @ fold
    stiffness = 0.5 * slope.T @ (weights[:, None] * slope)
    return Mesh(
        slenderness=slenderness,
        angle=angle,
        step=2.0 * np.pi / around,
        zeta=nodes[along:],
        weights=0.5 * fold.T @ weights,
        stiffness=stiffness[:-1],
        outflow=-slope[-1],
        slopes=slope[along:],
    )
