"""Stiffness and damping with the film's fronts between the nodes of the mesh.

The pressures of the active set end on a node, the film between two. Where p and its slope vanish,
p = ½k s² at a distance s, k = 6|h'|/h³, and of the discrete pressures the same parabola, which ends
half a cell before or beyond: the last wet node, of pressure p_i on cells of width Δ, is

    s = (p_i/(kΔ²) + ½) Δ,   ½Δ ≤ s ≤ 3/2 Δ,

from the front. Perturbed pressures vanish at the unperturbed front, as its motion is of second
order; so the operator for them ends there. That removes the error of first order in Δ, which
jumps as the front passes nodes, from stiffness and damping.
"""

from dataclasses import dataclass, replace

import numpy as np

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films.finite.reynolds import (
    Films,
    Solution,
    banded,
    front_flux,
    stiffness,
)


@dataclass(frozen=True, eq=False)
class _Fronts:
    """The cells in which the film ends, each by position, pad, cell and axial place.

    Attributes
    ----------
    at : tuple of arrays
        Indices of the cells in arrays (P, N, links, m).
    conductance : array
        Σ w h³/s of the part that is wet.
    cos, sin : array
        In the middle of that part.
    weight : array
        Axial weight, Σ w.
    """

    at: tuple[IntArray, IntArray, IntArray, IntArray]
    conductance: Array
    cos: Array
    sin: Array
    weight: Array


def coefficients(found: Films, at: Solution) -> tuple[Array, Array]:
    """Return stiffness and damping of a solution whose active set has settled.

    Parameters
    ----------
    found : Films
        The films at P positions.
    at : Solution
        Their pressures, none negative.

    Returns
    -------
    K, C : array, (P, 2, 2)
        In μΩR³L/C³ and μR³L/C³; C is symmetric.
    """
    fronts = _fronts(found, at.pressure, at.wet)
    G = found.conductance.copy()
    G[fronts.at] = fronts.conductance
    loads = _weights(found, fronts)
    adjoint = banded(found, G, at.wet, loads)
    K = stiffness(found, replace(at, adjoint=adjoint)) + _correction(found, fronts, at, adjoint)
    C = np.empty_like(K)
    for i in (0, 1):
        for j in range(i, 2):
            C[:, i, j] = C[:, j, i] = 24.0 * (adjoint[i] * loads[j]).sum(axis=(1, 2, 3))
    return K, C


def _fronts(found: Films, p: Array, wet: BoolArray) -> _Fronts:
    P, N, node, q = np.nonzero(wet[:, :, :-1] != wet[:, :, 1:])
    behind = wet[P, N, node, q]  # the film breaks here; elsewhere it forms
    last = np.where(behind, node, node + 1)
    cell = node + 1
    width = found.width[P, N, cell]
    weights = found.mesh.weights[N, :, 0, q]
    e = found.relative[P, N]
    beta = found.beta[P, N, last + 1]
    cos, sin = np.cos(beta), np.sin(beta)
    depth = found.h_middle[P, N, :, cell] - found.h_middle[P, N, -1:, cell]
    h = (1.0 - e[:, 0] * cos - e[:, 1] * sin)[:, None] + depth
    slope = np.abs(e[:, 0] * sin - e[:, 1] * cos)
    k = 6.0 * slope * weights.sum(axis=1) / (weights * h**3).sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = np.fmin(p[P, N, last, q] / (k * width**2), 1.0) + 0.5
    s = reach * width
    beta = beta + np.where(behind, 0.5, -0.5) * s
    cos, sin = np.cos(beta), np.sin(beta)
    h = (1.0 - e[:, 0] * cos - e[:, 1] * sin)[:, None] + depth
    conductance = (weights * h**3).sum(axis=1) / s
    return _Fronts((P, N, cell, q), conductance, cos, sin, weights.sum(axis=1))


def _weights(found: Films, fronts: _Fronts) -> tuple[Array, Array]:
    """Return the weights of pressures in the force, with the film ending at its fronts."""
    mean_cos, mean_sin = found.means
    shape = found.conductance.shape
    cos = np.broadcast_to(mean_cos[..., None], shape).copy()
    sin = np.broadcast_to(mean_sin[..., None], shape).copy()
    cos[fronts.at], sin[fronts.at] = fronts.cos, fronts.sin
    w = -0.5 * found.mesh.weights.sum(axis=1)
    return np.diff(sin, axis=2) * w, -np.diff(cos, axis=2) * w


def _correction(found: Films, fronts: _Fronts, at: Solution, adjoint: Array) -> Array:
    """Return what the cells with fronts add to the stiffness of whole cells."""
    P, N, cell, q = fronts.at
    # λ after the cell less λ before it; one of them is at a dry node, zero.
    before, after = adjoint[:, P, N, cell - 1, q], adjoint[:, P, N, cell, q]
    whole = front_flux(found, at.pressure, fronts.at)
    K = np.empty((len(at.force), 2, 2))
    for j, n in enumerate((fronts.cos, fronts.sin)):
        change = -6.0 * n * fronts.weight - whole[j]
        for i in (0, 1):
            terms = -change * (after[i] - before[i])
            K[:, i, j] = np.bincount(P, weights=terms, minlength=len(K))
    return K
