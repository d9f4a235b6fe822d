"""Reynolds' equation over the pads of a fixed bore, for many journal positions at once.

In units of pressure μΩ(R/C)², force μΩR³L/C², lengths across the film C, time 1/Ω, ζ = 2z/L:

    ∂_β(h³ p_β) + (D/L)² ∂_ζ(h³ p_ζ) = 6 h_β + 12 h_τ

with p = 0 at the edges of the pads and at both ends, and p ≥ 0 with complementarity (Swift and
Stieber): where the film breaks and where it forms again both p and its slope are zero.

Around the bearing finite volumes, whose flux between two nodes is exact for a long bearing,
q = (6 I₂ − Δp)/I₃ with I_k = ∫h⁻ᵏ dβ; along it Gauss-Lobatto polynomials (`axial`). The matrix of
all pads at all positions is one banded symmetric positive definite one, solved by one call of
LAPACK. Pressures that must not be negative are an active set, corrected until nothing changes.
"""

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from scipy.linalg import lapack

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films.finite.axial import Axial, axial
from rotorcalc.films.pads import Pad, have_pockets

_TURN = 2.0 * math.pi
# Share of the journal's eccentricity by which the mesh is refined at the thinnest film.
_GRADING, _STEEPEST = 0.7, 0.9
# Right side by a velocity v over the weights of the force: −12 ∫ h_τ with h_τ = −v·n, and −½ ∫ n.
SQUEEZE = -24.0


@dataclass(frozen=True, eq=False)
class Mesh:
    """The pads of a bore, meshed: N pads, `links` cells around each, m pressures along it.

    Attributes
    ----------
    pads : tuple of Pad, N
        The pads.
    slenderness : float
        (D/L)² [-].
    links : int
        Number of cells around each pad; their inner nodes are the unknowns.
    bases : tuple of Axial, N
        The axial basis of each pad.
    """

    pads: tuple[Pad, ...]
    slenderness: float
    links: int
    bases: tuple[Axial, ...]

    @functools.cached_property
    def weights(self) -> Array:
        """Axial weights, (N, zones, 1, m)."""
        return np.array([basis.weights for basis in self.bases])[:, :, None, :]

    @functools.cached_property
    def axial(self) -> Array:
        """(D/L)² times the axial stiffness, (N, zones, m, m)."""
        return self.slenderness * np.array([basis.stiffness for basis in self.bases])

    @functools.cached_property
    def bands(self) -> Array:
        """Lower diagonals of `axial`, each pressure's in a row, (N, zones, m·(m + 1)).

        The last in a row is for the next node around, with which the axial term has no part.
        """
        N, zones, m, _ = self.axial.shape
        rows = np.zeros((N, zones, m, m + 1))
        for d in range(m):
            rows[:, :, : m - d, d] = np.diagonal(self.axial, d, -2, -1)
        return rows.reshape(N, zones, m * (m + 1))

    @functools.cached_property
    def outflow(self) -> Array:
        """Axial slopes at the ends, (N, zones, 1, m)."""
        return np.array([basis.outflow for basis in self.bases])[:, :, None, :]

    @functools.cached_property
    def a(self) -> Array:
        """Centres of curvature, (N, 2)."""
        return np.array([(pad.a_x, pad.a_y) for pad in self.pads])

    @functools.cached_property
    def arcs(self) -> tuple[Array, Array]:
        """Middles and half arcs, (N,)."""
        return (
            np.array([0.5 * (pad.start + pad.end) for pad in self.pads]),
            np.array([0.5 * pad.arc for pad in self.pads]),
        )

    @functools.cached_property
    def pockets(self) -> tuple[Array, Array, Array] | None:
        """Cells in each pad's pocket, (N,); its step, (N,); its depth by zone and cell."""
        if all(pad.depth == 0.0 for pad in self.pads):
            return None
        cells = np.array([
            round(self.links * (pad.step - pad.start) / pad.arc) if pad.depth > 0.0 else 0
            for pad in self.pads
        ])  # fmt: skip
        has = np.array([pad.depth > 0.0 for pad in self.pads])
        cells = np.where(has, np.clip(cells, 2, self.links - 2), 0)
        depth = np.zeros((len(self.pads), 2, self.links))
        for i, pad in enumerate(self.pads):
            depth[i, 0, : cells[i]] = pad.depth
        return cells, np.array([pad.step for pad in self.pads]), depth

    @property
    def shape(self) -> tuple[int, int, int]:
        """Unknown pressures of one position: pads, nodes around, nodes along."""
        return len(self.pads), self.links - 1, self.weights.shape[-1]


@functools.lru_cache(maxsize=128)
def mesh(pads: tuple[Pad, ...], slenderness: float, links: int, degrees: int) -> Mesh:
    """Return the mesh of a bore's pads.

    Parameters
    ----------
    pads : tuple of Pad
        The pads.
    slenderness : float
        (D/L)² [-].
    links : int
        Number of cells around each pad.
    degrees : int
        Number of pressures along half the bearing.

    Returns
    -------
    Mesh
        The mesh.
    """
    zones = 2 if have_pockets(pads) else 1
    return Mesh(pads, slenderness, links, tuple(axial(pad, degrees, zones) for pad in pads))


@dataclass(frozen=True, eq=False)
class Films:
    """The films at P positions of the journal, and the operator of Reynolds' equation over them.

    Arrays have the leading shape (P, N): positions, pads.

    Attributes
    ----------
    mesh : Mesh
        The pads.
    relative : array, (P, N, 2)
        The journal's centre from each pad's centre of curvature, in C.
    beta : array, (P, N, links + 1)
        Angles of the nodes and edges [rad].
    cos, sin : array, (P, N, links + 1)
        Of these.
    h_left, h_middle, h_right : array, (P, N, zones, links)
        Film at the ends and in the middle of each cell, in C.
    I2, I3 : array, (P, N, zones, links)
        Integrals of h⁻² and h⁻³ over each cell.
    """

    mesh: Mesh
    relative: Array
    beta: Array
    cos: Array
    sin: Array
    h_left: Array
    h_middle: Array
    h_right: Array
    I2: Array
    I3: Array

    @functools.cached_property
    def width(self) -> Array:
        """Width of each cell [rad]."""
        return self.beta[..., 1:] - self.beta[..., :-1]

    @functools.cached_property
    def means(self) -> tuple[Array, Array]:
        """Means of cos β and sin β over each cell."""
        cos, sin, width = self.cos, self.sin, self.width
        return (sin[..., 1:] - sin[..., :-1]) / width, (cos[..., :-1] - cos[..., 1:]) / width

    @functools.cached_property
    def middles(self) -> tuple[Array, Array]:
        """Cos β and sin β in the middle of each cell."""
        half = np.cos(0.5 * self.width)
        return (0.5 * (self.cos[..., 1:] + self.cos[..., :-1]) / half,
                0.5 * (self.sin[..., 1:] + self.sin[..., :-1]) / half)  # fmt: skip

    @functools.cached_property
    def conductance(self) -> Array:
        """Σ w/I₃ over the zones, (P, N, links, m)."""
        return self._by_zone(1.0 / self.I3)

    @functools.cached_property
    def entrained(self) -> Array:
        """Flux without pressure, Σ w 6I₂/I₃, (P, N, links, m)."""
        return self._by_zone(6.0 * self.I2 / self.I3)

    @functools.cached_property
    def cubes(self) -> Array:
        """∫h³ over the volume of each node, by the film at the node, (P, N, zones, nodes)."""
        width = self.width[:, :, None, :]
        h_left, h_right = self.h_left, self.h_right
        # Products, as a power takes ten times as long.
        left, right = width * h_right * h_right * h_right, width * h_left * h_left * h_left
        return 0.5 * (left[..., :-1] + right[..., 1:])

    @functools.cached_property
    def slopes(self) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """The derivatives of I₂ and I₃ by x and y, 2∫h⁻³n and 3∫h⁻⁴n."""
        sixth = (self.width / 6.0)[:, :, None, :]
        u, v, w = 1.0 / self.h_left, 1.0 / self.h_middle, 1.0 / self.h_right
        u3, v3, w3 = u * u * u, v * v * v, w * w * w
        second: list[Array] = []
        third: list[Array] = []
        for node, middle in zip((self.cos, self.sin), self.middles, strict=True):
            left = node[:, :, None, :-1] * u3
            centre = 4.0 * middle[:, :, None, :] * v3
            right = node[:, :, None, 1:] * w3
            second.append(2.0 * sixth * (left + centre + right))
            third.append(3.0 * sixth * (left * u + centre * v + right * w))
        return (second[0], second[1]), (third[0], third[1])

    def taken(self, rows: IntArray) -> "Films":
        """Return the films at some of the positions, (S,), each any number of times."""
        return Films(
            self.mesh, self.relative[rows], self.beta[rows], self.cos[rows], self.sin[rows],
            self.h_left[rows], self.h_middle[rows], self.h_right[rows], self.I2[rows],
            self.I3[rows],
        )  # fmt: skip

    def _by_zone(self, values: Array) -> Array:
        return values.swapaxes(2, 3) @ self.mesh.weights[:, :, 0]

    def axial_flow(self, p: Array) -> Array:
        """Return the axial term Σ ∫h³ A p of pressures (P, N, nodes, m)."""
        A = self.mesh.axial
        total = self.cubes[:, :, 0, :, None] * (p @ A[:, 0])
        for z in range(1, A.shape[1]):
            total += self.cubes[:, :, z, :, None] * (p @ A[:, z])
        return total


def films(mesh: Mesh, position: Array) -> Films:
    """Return the films at positions of the journal, on a mesh refined at the thinnest.

    Parameters
    ----------
    mesh : Mesh
        The pads.
    position : array, (P, 2)
        The journal's centre, in C.

    Returns
    -------
    Films
        The films.
    """
    beta = _nodes(mesh, position)
    cos, sin = np.cos(beta), np.sin(beta)
    relative = position[:, None, :] - mesh.a
    e_x, e_y = relative[..., 0, None], relative[..., 1, None]
    node = (1.0 - e_x * cos - e_y * sin)[:, :, None, :]
    width = beta[..., 1:] - beta[..., :-1]
    # cos of the middle from those of the ends: (cos a + cos b)/2 = cos((a+b)/2) cos((b−a)/2).
    half = np.cos(0.5 * width)
    middle = (1.0 - 0.5 * (2.0 - (node[:, :, 0, 1:] + node[:, :, 0, :-1])) / half)[:, :, None, :]
    left, right = node[..., :-1], node[..., 1:]
    if mesh.pockets is not None:
        depth = mesh.pockets[2]
        left, middle, right = left + depth, middle + depth, right + depth
    sixth = (width / 6.0)[:, :, None, :]
    u, v, w = 1.0 / left, 1.0 / middle, 1.0 / right
    u2, v2, w2 = u * u, v * v, w * w
    I2 = sixth * (u2 + 4.0 * v2 + w2)
    I3 = sixth * (u2 * u + 4.0 * v2 * v + w2 * w)
    return Films(mesh, relative, beta, cos, sin, left, middle, right, I2, I3)


def _nodes(mesh: Mesh, position: Array) -> Array:
    """Return the nodes' angles, (P, N, links + 1): even in Sommerfeld's angle ψ."""
    q = position[:, None, :] - mesh.a
    e = np.minimum(_GRADING * np.hypot(q[..., 0], q[..., 1]), _STEEPEST)
    b = (e / (1.0 + np.sqrt(1.0 - e * e)))[..., None]
    gamma = np.arctan2(q[..., 1], q[..., 0])
    middle, half = mesh.arcs
    start = np.mod(middle - gamma + math.pi, _TURN) - math.pi - half
    # ψ of θ from the thinnest film: tan(ψ/2) = √((1+e)/(1−e)) tan(θ/2).
    edges = start[..., None] + np.stack([np.zeros_like(half), 2.0 * half], axis=-1)
    psi = edges + 2.0 * np.arctan2(b * np.sin(edges), 1.0 - b * np.cos(edges))
    share = np.linspace(0.0, 1.0, mesh.links + 1)
    along = psi[..., :1] + (psi[..., 1:] - psi[..., :1]) * share
    if mesh.pockets is not None:
        along = _with_steps(mesh, along, psi, start, b)
    theta = along - 2.0 * np.arctan2(b * np.sin(along), 1.0 + b * np.cos(along))
    return theta + gamma[..., None] + (middle - half - gamma - start)[..., None]


def _with_steps(mesh: Mesh, along: Array, psi: Array, start: Array, b: Array) -> Array:
    """Return ψ of the nodes with one on the step of each pocket."""
    cells, step, _ = cast("tuple[Array, Array, Array]", mesh.pockets)
    for i, pad in enumerate(mesh.pads):
        if pad.depth > 0.0:
            theta = start[:, i] + (step[i] - pad.start)
            b_i = b[:, i, 0]
            at = theta + 2.0 * np.arctan2(b_i * np.sin(theta), 1.0 - b_i * np.cos(theta))
            before = np.linspace(0.0, 1.0, int(cells[i]) + 1)
            after = np.linspace(0.0, 1.0, mesh.links - int(cells[i]) + 1)[1:]
            first, last = psi[:, i, :1], psi[:, i, 1:]
            along[:, i] = np.concatenate(
                [
                    first + (at[:, None] - first) * before,
                    at[:, None] + (last - at[:, None]) * after,
                ],
                axis=-1,
            )
    return along


@dataclass(frozen=True, eq=False)
class Solution:
    """Pressures at P positions, the force, and what the sensitivities need.

    Attributes
    ----------
    pressure : array, (P, N, nodes, m)
        Pressure, zero in the broken film.
    wet : boolean array, (P, N, nodes, m)
        Where the film is full.
    excess : array, (P, N, nodes, m)
        Right side less the operator's left: positive at a dry node that must fill again.
    adjoint : array, (2, P, N, nodes, m)
        Pressures that the force's own weights would give; none of them (0, …) where not asked for.
    force : array, (P, 2)
        Force on the journal in X, Y.
    """

    pressure: Array
    wet: BoolArray
    excess: Array
    adjoint: Array
    force: Array

    @property
    def next_wet(self) -> BoolArray:
        """The active set after one correction."""
        return np.where(self.wet, self.pressure > 0.0, self.excess > 0.0)


def solved(
    found: Films, wet: BoolArray, squeeze: Array | None = None, *, adjoint: bool = True
) -> Solution:
    """Return the pressures of an active set, and the adjoint ones.

    Parameters
    ----------
    found : Films
        The films.
    wet : boolean array, (P, N, nodes, m)
        Where pressure is unknown; it is zero elsewhere.
    squeeze : array, (P, 2), optional
        The journal's velocity in X, Y, in CΩ.
    adjoint : bool
        Whether sensitivities will be asked of the solution.

    Returns
    -------
    Solution
        Pressures of either sign.
    """
    G, Q = found.conductance, found.entrained
    right = Q[:, :, :-1] - Q[:, :, 1:]
    loads = force_weights(found)
    if squeeze is not None:
        right = right + SQUEEZE * (
            squeeze[:, 0, None, None, None] * loads[0] + squeeze[:, 1, None, None, None] * loads[1]
        )
    p, *others = banded(found, G, wet, [right, *loads] if adjoint else [right])
    excess = right - flow_out(found, G, p)
    force = np.stack([np.einsum("pnsq,pnsq->p", p, load) for load in loads], axis=-1)
    return Solution(p, wet, excess, np.array(others), force)


def force_weights(found: Films) -> tuple[Array, Array]:
    """Return the weights of the pressures in the force in X and Y, −½∫ hat·(cos, sin)."""
    cos, sin = found.means
    w = -0.5 * found.mesh.weights.sum(axis=1)
    # ∫ hat·cos = mean sin after the node less before it: exact for pressures linear in between.
    return (sin[..., 1:] - sin[..., :-1])[..., None] * w, (cos[..., :-1] - cos[..., 1:])[
        ..., None
    ] * w


def flow_out(found: Films, G: Array, p: Array) -> Array:
    """Return the operator on pressures: what flows out of the volume of each node.

    Parameters
    ----------
    found : Films
        The films.
    G : array, (P, N, links, m)
        Their conductance around the pads.
    p : array, (P, N, nodes, m)
        Pressures.

    Returns
    -------
    array, (P, N, nodes, m)
        Flow, in the equation's units.
    """
    flux = np.empty_like(G)
    flux[:, :, 1:-1] = p[:, :, :-1] - p[:, :, 1:]
    flux[:, :, 0], flux[:, :, -1] = -p[:, :, 0], p[:, :, -1]
    flux *= G
    return flux[:, :, 1:] - flux[:, :, :-1] + found.axial_flow(p)


def refilled(found: Films, wet: BoolArray, p: Array, right: Array) -> BoolArray:
    """Return where the film is full after one correction of the active set.

    Parameters
    ----------
    found : Films
        The films.
    wet : boolean array, (P, N, nodes, m)
        Where the film was taken as full.
    p, right : array, (P, N, nodes, m)
        Pressures there, and the right side that they balance.

    Returns
    -------
    boolean array, (P, N, nodes, m)
        Without the nodes of negative pressure, with those that more oil reaches than leaves.
    """
    return np.where(wet, p > 0.0, right - flow_out(found, found.conductance, p) > 0.0)


def banded(found: Films, G: Array, wet: BoolArray, values: Sequence[Array]) -> Array:
    """Return solutions of the operator on the wet nodes for right sides.

    Parameters
    ----------
    found : Films
        The films.
    G : array, (P, N, links, m)
        The conductance around the pads.
    wet : boolean array, (P, N, nodes, m)
        Where pressure is unknown; it is zero elsewhere.
    values : k arrays, (P, N, nodes, m)
        The right sides.

    Returns
    -------
    array, (k, P, N, nodes, m)
        Pressures.
    """
    x = np.zeros((len(values), *wet.shape))
    nodes = _part(wet)
    if not nodes.at.size:
        return x
    m = wet.shape[-1]
    bands = _matrix(found, G, nodes).reshape(-1, m + 1)
    right = np.stack([value.reshape(-1, m).take(nodes.at, axis=0) for value in values])
    right = right.reshape(len(values), -1)
    dry = ~wet.reshape(-1, m).take(nodes.at, axis=0)
    _cut_off(np.flatnonzero(dry), bands, right)
    solve = cast("Any", lapack.dpbsv)
    _, solution, info = solve(bands.T, right.T, lower=1, overwrite_ab=1, overwrite_b=1)
    if info != 0:
        raise ValueError(
            "position: the journal must lie inside the bore, where every pad leaves it a film"
        )
    x.reshape(len(values), -1, m)[:, nodes.at] = np.asarray(solution).T.reshape(len(x), -1, m)
    return x


@dataclass(frozen=True, eq=False)
class _Nodes:
    """The nodes that have a part in the matrix: those of which any pressure is wet.

    Pad by pad, as each has an axial term of its own.

    Attributes
    ----------
    kept : boolean array, (N, P, nodes)
        Which they are.
    at : array, (K,)
        Their places among all nodes, (P, N, nodes).
    before : array, (K,)
        Places of the cells before them among all cells, (P, N, links); the next is after them.
    linked : boolean array, (K,)
        Whether the next one is next to it around its pad.
    """

    kept: BoolArray
    at: IntArray
    before: IntArray
    linked: BoolArray


def _part(wet: BoolArray) -> _Nodes:
    _, N, nodes, _ = wet.shape
    kept: BoolArray = np.any(wet.swapaxes(0, 1), axis=-1)
    pad, position, node = kept.nonzero()
    film = position * N + pad
    at = film * nodes + node
    beside = np.zeros_like(kept)
    beside[..., :-1] = kept[..., 1:]
    return _Nodes(kept, at, at + film, beside[kept])


def _matrix(found: Films, G: Array, nodes: _Nodes) -> Array:
    """Return the operator's lower diagonals, each pressure's in a row, (K, m, m + 1)."""
    m = G.shape[-1]
    rows = np.empty((nodes.at.size, m * (m + 1)))
    first = 0
    for n, of_pad in enumerate(found.mesh.bands):
        cubes = found.cubes[:, n].swapaxes(1, 2)[nodes.kept[n]]
        np.matmul(cubes, of_pad, out=rows[first : first + len(cubes)])
        first += len(cubes)
    bands = rows.reshape(-1, m, m + 1)
    around = G.reshape(-1, m)
    after = around.take(nodes.before + 1, axis=0)
    bands[..., 0] += around.take(nodes.before, axis=0) + after
    bands[..., m] = np.where(nodes.linked[:, None], -after, 0.0)
    return bands


def _cut_off(dry: IntArray, bands: Array, right: Array) -> None:
    """Make some of the unknowns of a matrix, given by its lower diagonals, zero on their own."""
    bands[dry] = 0.0
    bands[dry, 0] = 1.0
    right[:, dry] = 0.0
    for d in range(1, bands.shape[1]):
        bands[dry[dry >= d] - d, d] = 0.0


def stiffness(found: Films, at: Solution) -> Array:
    """Return −∂F_i/∂x_j of a solution with its active set, (P, 2, 2).

    Parameters
    ----------
    found : Films
        The films.
    at : Solution
        Pressures and adjoint pressures on them.

    Returns
    -------
    array, (P, 2, 2)
        In μΩR³L/C³.
    """
    dp, moved = differences(at.pressure), _moved_flow(found, at.pressure)
    weights = found.mesh.weights[:, :, 0].swapaxes(1, 2)
    dI2, dI3 = found.slopes
    K = np.empty((at.force.shape[0], 2, 2))
    for i, adjoint in enumerate(at.adjoint):
        across = differences(adjoint)
        along = np.einsum("pnsq,pnsq->pns", adjoint, moved)
        # Σ w λ/I₃ and Σ w λ q/I₃ of each cell, by zone: q = (6 I₂ − Δp)/I₃ is its flux.
        a = (across @ weights).swapaxes(2, 3) / found.I3
        b = (6.0 * found.I2 * a - ((across * dp) @ weights).swapaxes(2, 3) / found.I3) / found.I3
        for j, n in enumerate((found.cos, found.sin)):
            K[:, i, j] = np.einsum("pns,pns->p", along, n[:, :, 1:-1])
            K[:, i, j] += np.einsum("pnzc,pnzc->p", dI3[j], b)
            K[:, i, j] -= 6.0 * np.einsum("pnzc,pnzc->p", dI2[j], a)
    return K


def _moved_flow(found: Films, p: Array) -> Array:
    """Return by what the axial flow of each pressure changes, over (cos, sin) of its node.

    It is A p times the derivative of ∫h³: with ∂h = −n, −3 n h² over the node's volume.
    """
    width = found.width[:, :, None, :]
    left, right = width * found.h_right**2, width * found.h_left**2
    change = -1.5 * (left[..., :-1] + right[..., 1:])
    A = found.mesh.axial
    total = change[:, :, 0, :, None] * (p @ A[:, 0])
    for z in range(1, A.shape[1]):
        total += change[:, :, z, :, None] * (p @ A[:, z])
    return total


def differences(p: Array) -> Array:
    """Return differences over the cells, with zero at the pads' edges."""
    out = np.empty((*p.shape[:2], p.shape[2] + 1, p.shape[3]))
    np.subtract(p[:, :, 1:], p[:, :, :-1], out=out[:, :, 1:-1])
    out[:, :, 0], out[:, :, -1] = p[:, :, 0], -p[:, :, -1]
    return out


def front_flux(
    found: Films, p: Array, cells: tuple[IntArray, IntArray, IntArray, IntArray]
) -> tuple[Array, Array]:
    """Return the derivatives by x and y of the flux of some cells (P, N, links, m), Σ w q."""
    P, N, cell, q = cells
    weights = found.mesh.weights[N, :, 0, q]
    inverse = 1.0 / found.I3[P, N, :, cell]
    dp = differences(p)[P, N, cell, q]
    flux = (6.0 * found.I2[P, N, :, cell] - dp[:, None]) * inverse
    dI2, dI3 = found.slopes
    x, y = (
        (weights * (6.0 * dI2[j][P, N, :, cell] - flux * dI3[j][P, N, :, cell]) * inverse).sum(
            axis=1
        )
        for j in (0, 1)
    )
    return x, y
