"""Flow through the lands of a hydrostatic bearing, for many positions of the journal at once.

Lengths across the film in C, pressures in the supply pressure p_s, time in 1/Ω, ζ = 2z/L; with
S = μΩ(R/C)²/p_s Reynolds' equation of the full film is

    ∂_β(h³ p_β) + (D/L)² ∂_ζ(h³ p_ζ) = S (6 h_β + 12 h_τ) = −12 S w·(cos β, sin β)

as h = 1 − x cos β − y sin β: rotation acts as the velocity (y, −x)/2 does, and
w = (x' + y/2, y' − x/2). It is linear, so at one position outflow of the recesses and force on the
journal follow from the recess pressures P and w by three matrices,

    Q = G P − 12 S g w,    F = −gᵀ P − 12 S D w

By finite volumes, b the integrals of (cos β, sin β) and A the conductances, l of the nodes on lands
and r of whole recesses,

    G = A_rr − A_rl A_ll⁻¹ A_lr,    g = b_r − A_rl A_ll⁻¹ b_l,    D = b_lᵀ A_ll⁻¹ b_l

All are products of Y = L⁻¹ (b_l, −A_lr) with itself, where A_ll = L Lᵀ: half a solution is enough.

Forces are in p_s R L, flows, of both ends together, in (L/D) p_s C³/(6μ). The pressure of a recess
pushes the journal by the same g by which the journal's motion pumps its flow: reciprocity.
"""

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from scipy.linalg import lapack

from rotorcalc.arrays import Array, IntArray
from rotorcalc.films.hydrostatic.mesh import Mesh

# Gauss's points and weights on [0, 1] for ∫h⁻³ along a link.
_POINTS = 0.5 * np.array([1.0 - np.sqrt(0.6), 1.0, 1.0 + np.sqrt(0.6)])
_SHARES = np.array([5.0, 8.0, 5.0]) / 18.0
# Positions solved in one call: their matrices stay within some ten megabytes.
_AT_ONCE = 24
_TOUCHES = "the journal touches the lands"


@dataclass(frozen=True, eq=False)
class Influence:
    """The three matrices of P positions.

    Attributes
    ----------
    conductance : array, (P, N, N)
        G: outflow of each recess by the pressure of each.
    pumping : array, (P, N, 2)
        g: force by the recess pressures, and flow by the motion.
    squeeze : array, (P, 2, 2)
        D: force by the motion between recesses at ambient pressure.
    """

    conductance: Array
    pumping: Array
    squeeze: Array


def influence(mesh: Mesh, position: Array) -> Influence:
    """Return the matrices at positions (P, 2) of the journal, in C."""
    parts = [
        _influence(mesh, position[i : i + _AT_ONCE]) for i in range(0, len(position), _AT_ONCE)
    ]
    return Influence(
        np.concatenate([one.conductance for one in parts]),
        np.concatenate([one.pumping for one in parts]),
        np.concatenate([one.squeeze for one in parts]),
    )


def _influence(mesh: Mesh, position: Array) -> Influence:
    band, right = _assembled(mesh, *conductances(mesh, position))
    Y = _halfway(band, right)
    product = Y @ Y.swapaxes(1, 2)
    # A recess conducts to its land nodes only: their sum is its diagonal.
    to_lands = right[:, :, 2:].sum(axis=1)
    diagonal = to_lands[:, :, None] * np.eye(mesh.lands.recesses)
    return Influence(
        conductance=diagonal - product[:, 2:, 2:],
        pumping=_over_recesses(mesh) + product[:, 2:, :2],
        squeeze=product[:, :2, :2],
    )


def _halfway(band: Array, right: Array) -> Array:
    """Return Yᵀ, (P, 2 + N, u), from the lower band of A_ll and the right sides."""
    count, unknowns, columns = right.shape
    factor, halve = cast("Any", lapack.dpbtrf), cast("Any", lapack.dtbtrs)
    L, info = factor(band.reshape(count * unknowns, -1).T, lower=1, overwrite_ab=1)
    if info:
        raise ValueError(_TOUCHES)
    Y, _ = halve(L, right.reshape(count * unknowns, columns), uplo="L")
    return np.asarray(Y).T.reshape(columns, count, unknowns).swapaxes(0, 1)


def _over_recesses(mesh: Mesh) -> Array:
    """Return b_r, (N, 2): the integrals over whole recesses."""
    inside = mesh.recess[..., None] == np.arange(mesh.lands.recesses)
    return np.einsum("jnm,nmk->kj", mesh.weights, inside.astype(float))


def solutions(mesh: Mesh, position: Array) -> Array:
    """Return the pressures on the lands by unit motions and by unit recess pressures.

    Parameters
    ----------
    mesh : Mesh
        The mesh.
    position : array, (P, 2)
        The journal's positions, in C.

    Returns
    -------
    array, (P, u, 2 + N)
        A_ll⁻¹ b_l and −A_ll⁻¹ A_lr, by unknown.
    """
    around, along = conductances(mesh, position)
    band, right = _assembled(mesh, around, along)
    solve = cast("Any", lapack.dpbsv)
    count, unknowns, columns = right.shape
    _, x, info = solve(
        band.reshape(count * unknowns, -1).T, right.reshape(count * unknowns, columns), lower=1,
        overwrite_ab=1,
    )  # fmt: skip
    if info:
        raise ValueError(_TOUCHES)
    return np.asarray(x).reshape(right.shape)


def conductances(mesh: Mesh, position: Array) -> tuple[Array, Array]:
    """Return conductances from each node to the next around and along, (P, n, m) each.

    Around the bearing 1/∫h⁻³ dβ of the link, exact for a long bearing; along it (D/L)² ∫h³ dβ over
    the node's part of the circle.
    """
    at = mesh.beta[:, None] + mesh.step[:, None] * _POINTS
    inverse = (1.0 / _cubed(_thickness(at, position))) @ _SHARES * mesh.step
    around = mesh.length / inverse[..., None]
    # Either half of a link belongs to the node at its end.
    halves = [mesh.beta[:, None] + mesh.step[:, None] * (i + _POINTS) / 2.0 for i in (0, 1)]
    ahead, behind = (
        _cubed(_thickness(one, position)) @ _SHARES * mesh.step / 2.0 for one in halves
    )
    cubes = ahead + np.roll(behind, 1, axis=1)
    along = mesh.lands.slenderness * cubes[..., None] / np.diff(mesh.zeta)
    return around, along


def _cubed(h: Array) -> Array:
    return h * h * h  # a tenth of the time of a power


def _thickness(beta: Array, position: Array) -> Array:
    """Return the film at angles (...) for positions (P, 2), (P, ...), in C."""
    x, y = (position[:, j].reshape(-1, *[1] * beta.ndim) for j in (0, 1))
    return 1.0 - x * np.cos(beta) - y * np.sin(beta)


def _assembled(mesh: Mesh, around: Array, along: Array) -> tuple[Array, Array]:
    """Return the lower band of A_ll, (P, u, width), and the right sides, (P, u, 2 + N)."""
    count, u, N = len(around), mesh.unknown, mesh.lands.recesses
    links = [(u, np.roll(u, -1, axis=0), around), (u[:, :-1], u[:, 1:], along[:, :, :-1])]
    inner = [_between_unknowns(a, b, c, mesh.count) for a, b, c in links]
    width = 1 + max(int((high - low).max()) for low, high, _ in inner)
    band = np.zeros((count, mesh.count, width))
    for low, high, value in inner:
        band[:, low, high - low] = -value
    total = around + np.roll(around, 1, axis=1) + along
    total[:, :, 1:] += along[:, :, :-1]
    band[:, u[mesh.is_land], 0] = total[:, mesh.is_land]
    right = np.zeros((count, mesh.count, 2 + N))
    right[:, u[mesh.is_land], :2] = mesh.weights[:, mesh.is_land].T
    recess = mesh.recess
    pairs = [
        (recess, np.roll(u, -1, axis=0), around),
        (np.roll(recess, -1, axis=0), u, around),
        (recess[:, :-1], u[:, 1:], along[:, :, :-1]),
        (recess[:, 1:], u[:, :-1], along[:, :, :-1]),
    ]
    for which, node, value in pairs:
        touches = (which >= 0) & (node < mesh.count)
        # A land node may touch one recess twice only from two sides: each side is one term here.
        right[:, node[touches], 2 + which[touches]] += value[:, touches]
    return band, right


def _between_unknowns(a: IntArray, b: IntArray, value: Array, count: int) -> tuple[Any, Any, Array]:
    inner = (a < count) & (b < count)
    low, high = np.minimum(a[inner], b[inner]), np.maximum(a[inner], b[inner])
    return low, high, value[:, inner]
