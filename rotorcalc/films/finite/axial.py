"""Bases for the pressure along the bearing's axis: Gauss-Lobatto polynomials, even in ζ.

ζ = 2z/L runs from −1 to 1. The film is symmetric about the middle plane and at ambient pressure at
both ends. Integrals are lumped at the nodes; those of products of derivatives are exact.
"""

import functools
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from rotorcalc.arrays import Array
from rotorcalc.films.pads import Pad


@dataclass(frozen=True, eq=False)
class Axial:
    """A basis of m pressures along the axis of one pad, in one or two zones.

    Attributes
    ----------
    weights : array, (zones, m)
        Lumped integrals of the basis over −1 ≤ ζ ≤ 1, by zone.
    stiffness : array, (zones, m, m)
        Integrals of products of its derivatives, by zone.
    outflow : array, (zones, m)
        −dp/dζ at the ends where the oil leaves, both together, by pressure.
    pieces : tuple
        Of each piece: its edges in |ζ|, its nodes' places in it, and their indices, −1 at p = 0.
    """

    weights: Array
    stiffness: Array
    outflow: Array
    pieces: tuple[tuple[float, float, Array, tuple[int, ...]], ...]

    def at(self, zeta: Array) -> Array:
        """Return the basis at places |ζ| ≤ 1, (n, m)."""
        zeta = np.abs(zeta)
        found = np.zeros((zeta.size, self.weights.shape[1]))
        for low, high, nodes, indices in self.pieces:
            inside = (zeta >= low) & (zeta <= high)
            values, total = lagrange(nodes, zeta[inside]), np.zeros((inside.sum(), found.shape[1]))
            for column, index in enumerate(indices):
                if index >= 0:  # two columns share a pressure: the basis is even
                    total[:, index] += values[:, column]
            found[inside] = total
        return found


@functools.lru_cache(maxsize=512)
def axial(pad: Pad, degrees: int, zones: int) -> Axial:
    """Return the basis of a pad.

    Parameters
    ----------
    pad : Pad
        The pad.
    degrees : int
        Number of pressures along half the bearing.
    zones : int
        2 where any pad of the bearing has a pocket, else 1.

    Returns
    -------
    Axial
        With m = `degrees` pressures.
    """
    if zones == 1 or pad.depth == 0.0:
        return _widened(_whole(pad, degrees), zones)
    return _two_zones(pad.axial_ratio, degrees)


def _widened(one: Axial, zones: int) -> Axial:
    """Return a basis of one zone as one of more, the others without extent."""

    def wide(a: Array) -> Array:
        return np.concatenate([a, np.zeros((zones - 1, *a.shape[1:]))])

    return Axial(wide(one.weights), wide(one.stiffness), wide(one.outflow), one.pieces)


def _whole(pad: Pad, m: int) -> Axial:
    """Return the basis over the whole length, or over two lands beside a relief track."""
    t = pad.track_ratio
    nodes, weights = lobatto(2 * m)
    D = derivatives(nodes)
    # Even functions: the pressures at ±ζ are one unknown; half of the domain stands for both.
    fold = np.zeros((2 * m + 1, m))
    for q in range(m):
        fold[m + q, q] = fold[m - q, q] = 1.0
    E = D @ fold
    A = E.T @ (weights[:, None] * E)
    w = fold.T @ weights
    half = (1.0 - t) / 2.0 if t > 0.0 else 1.0
    lands = 2 if t > 0.0 else 1
    places = nodes * half + (1.0 + t) / 2.0 if t > 0.0 else nodes
    indices = (-1, *range(m - 1, 0, -1), *range(m), -1)
    pieces = ((t, 1.0, places, indices),)
    ends = -2.0 * E[-1]  # both ends of a land
    return Axial(
        (lands * half * w)[None], (lands / half * A)[None], (lands / half * ends)[None], pieces
    )


def _two_zones(ratio: float, m: int) -> Axial:
    """Return the basis over a pocket, |ζ| ≤ ratio, and over the lands beside it."""
    inner, outer = (m + 1) // 2, m - (m + 1) // 2
    weights, stiffness, outflow = np.zeros((2, m)), np.zeros((2, m, m)), np.zeros((2, m))
    nodes, w = lobatto(2 * inner)
    fold = np.zeros((2 * inner + 1, m))
    for q in range(inner + 1):
        fold[inner + q, q] = fold[inner - q, q] = 1.0
    E = derivatives(nodes) @ fold
    weights[0], stiffness[0] = ratio * (fold.T @ w), E.T @ (w[:, None] * E) / ratio
    lands, v = lobatto(outer)
    # The first node is the pocket's edge, shared by both zones; the last is the end, p = 0.
    take = np.zeros((outer + 1, m))
    take[np.arange(outer), inner + np.arange(outer)] = 1.0
    half = (1.0 - ratio) / 2.0
    G = derivatives(lands) @ take
    weights[1], stiffness[1] = 2.0 * half * (take.T @ v), 2.0 / half * (G.T @ (v[:, None] * G))
    outflow[1] = -2.0 / half * G[-1]
    inside = (*range(inner, 0, -1), *range(inner + 1))
    outside = (*range(inner, inner + outer), -1)
    pieces = (
        (0.0, ratio, nodes * ratio, inside),
        (ratio, 1.0, ratio + half * (lands + 1.0), outside),
    )
    return Axial(weights, stiffness, outflow, pieces)


@functools.cache
def lobatto(degree: int) -> tuple[Array, Array]:
    """Return Gauss-Lobatto nodes on [−1, 1], (degree + 1,), and their weights."""
    P = legendre.Legendre.basis(degree)
    nodes = np.concatenate([[-1.0], np.sort(np.real(P.deriv().roots())), [1.0]])
    nodes = 0.5 * (nodes - nodes[::-1])  # symmetric to the last bit
    return nodes, 2.0 / (degree * (degree + 1) * P(nodes) ** 2)


def derivatives(nodes: Array) -> Array:
    """Return the derivatives of Lagrange's polynomials at their nodes, (n, n)."""
    distance = nodes[:, None] - nodes
    np.fill_diagonal(distance, 1.0)
    scale = distance.prod(axis=1)
    D = scale[:, None] / (scale[None, :] * distance)
    np.fill_diagonal(D, 0.0)
    np.fill_diagonal(D, -D.sum(axis=1))
    return D


def lagrange(nodes: Array, x: Array) -> Array:
    """Return Lagrange's polynomials at places x, (len(x), n)."""
    found = np.ones((x.size, nodes.size))
    for j, node in enumerate(nodes):
        for k, other in enumerate(nodes):
            if k != j:
                found[:, j] *= (x - other) / (node - other)
    return found
