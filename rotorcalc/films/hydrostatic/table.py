"""The three matrices of `influence` over the whole gap, from solutions at some hundred positions.

They depend on the lands alone: load, speed, oil, clearance, supply and restrictors enter later, so
one table answers for all of them. The positions lie on rings around the bore's centre, at

    u = ε/(1 + √(1 − ε²)),

in which the film's functions are smooth: their m-th harmonic in the direction γ falls as uᵐ. The
lands look the same from every recess and in a mirror, so a wedge of each ring is enough. Fourier
series along the rings and polynomials across them, continued through the centre, fill a fine grid
in (u, γ), and bicubic Hermite polynomials the places between.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from rotorcalc.arrays import Array, ComplexArray, IntArray
from rotorcalc.films.hydrostatic.influence import Influence, influence
from rotorcalc.films.hydrostatic.mesh import Cells, Lands, mesh

# The thinnest film that is answered for, and that of the outermost ring, in C.
THINNEST, _OUTERMOST = 0.03, 0.02
# Each position is solved on a mesh and on one twice as fine, which their difference corrects.
FINE, COARSE, _FINER = Cells(8, 6, 4, 4), Cells(4, 3, 2, 2), Cells(16, 12, 8, 8)
# Rings, and the size at which a harmonic is left out of a ring.
_RINGS, _COARSE_RINGS, _LEFT_OUT = 11, 8, 1e-5
# The grid: steps in u, and directions.
_STEPS, _DIRECTIONS = 32, 128
_TURN = 2.0 * math.pi


def inside(eccentricity: Array | float) -> Array | float:
    """Return u of an eccentricity ratio, ε."""
    return eccentricity / (1.0 + np.sqrt(1.0 - eccentricity**2))


_TOP = float(inside(1.0 - _OUTERMOST))


@dataclass(frozen=True, eq=False)
class Table:
    """The matrices of a bearing's lands at any position.

    Attributes
    ----------
    lands : Lands
        The lands.
    cells : Cells
        The coarser of the two meshes.
    positions : int
        Number of positions at which they were solved.
    """

    lands: Lands
    cells: Cells
    positions: int
    _centre: Array
    _grid: Array

    @property
    def outflow_in_centre(self) -> float:
        """Outflow of one recess of the centred bearing, all recesses at the supply pressure."""
        return float(self.at(np.zeros((1, 2)))[0].conductance[0, 0].sum())

    def at(self, position: Array) -> tuple[Influence, Influence, Influence]:
        """Return the matrices at positions (P, 2), up to `_OUTERMOST`, and their ∂/∂x and ∂/∂y."""
        x, y = position[:, 0], position[:, 1]
        square = x**2 + y**2
        s = np.sqrt(1.0 - square)
        # In the centre, where all directions are alike, that of a line of the grid.
        u, gamma = np.sqrt(square) / (1.0 + s), np.where(square > 1e-24, np.arctan2(y, x), 0.0)
        r, r_u, r_g = _interpolated(self._grid, u, gamma)
        u = u[:, None]
        # f = f(0) + u r; along ε and across it, dε/du = 2(1 − u²)/(1 + u²)².
        along = (r + u * r_u) * (1.0 + u**2) ** 2 / (2.0 * (1.0 - u**2))
        across = r_g * (1.0 + u**2) / 2.0
        cos, sin = np.cos(gamma)[:, None], np.sin(gamma)[:, None]
        f = self._centre + u * r
        f_x, f_y = cos * along - sin * across, sin * along + cos * across
        # The last three are those of s³D.
        for one, place in ((f_x, x), (f_y, y)):
            one[:, -3:] = (one[:, -3:] + 3.0 * f[:, -3:] * (place / s**2)[:, None]) / s[
                :, None
            ] ** 3
        f[:, -3:] /= s[:, None] ** 3
        return self._matrices(f), self._matrices(f_x), self._matrices(f_y)

    @functools.cached_property
    def _around(self) -> Array:
        """The grid with its first direction again behind the last."""
        return np.concatenate([self._grid, self._grid[:, :1]], axis=1)

    def point(self, x: float, y: float) -> Influence:
        """Return the matrices at one position, without a leading axis, ten times as fast as `at`.

        Beyond the outermost ring, where only an integrator's trial steps come, those on it.
        """
        eps = math.hypot(x, y)
        if not math.isfinite(eps):
            raise ArithmeticError(f"no film around a journal at ({x}, {y})")
        s = math.sqrt(1.0 - min(eps, 1.0 - _OUTERMOST) ** 2)
        u, gamma = math.sqrt((1.0 - s) / (1.0 + s)), math.atan2(y, x) if eps > 1e-12 else 0.0
        a, b = u * _STEPS / _TOP, gamma % _TURN / _TURN * _DIRECTIONS
        i, j = min(int(a), _STEPS - 1), min(int(b), _DIRECTIONS - 1)
        by_u, by_g = _ends(a - i, _TOP / _STEPS), _ends(b - j, _TURN / _DIRECTIONS)
        # By ends in u and γ, then by derivatives in γ and u, as `_product`.
        weights = np.array([p * q for p_ in (by_u[:2], by_u[2:]) for q_ in (by_g[:2], by_g[2:])
                            for q in q_ for p in p_])  # fmt: skip
        corners = self._around[i : i + 2, j : j + 2].reshape(16, -1)
        f = self._centre + u * (weights @ corners)
        f[-3:] /= s**3
        pairs, place = _places(self.lands.recesses)
        xx, xy, yy = f[-3:].tolist()
        return Influence(f[place], f[pairs:-3].reshape(-1, 2), np.array([[xx, xy], [xy, yy]]))

    def _matrices(self, values: Array) -> Influence:
        pairs, place = _places(self.lands.recesses)
        N = self.lands.recesses
        return Influence(
            conductance=values[:, place],
            pumping=values[:, pairs : pairs + 2 * N].reshape(-1, N, 2),
            squeeze=values[:, [[-3, -2], [-2, -1]]],
        )


@functools.cache
def _places(N: int) -> tuple[int, IntArray]:
    """Return how many pairs N recesses make, and the place of each in the table, (N, N)."""
    pairs = N * (N + 1) // 2
    place = np.empty((N, N), dtype=np.intp)
    rows, columns = np.triu_indices(N)
    place[rows, columns] = place[columns, rows] = np.arange(pairs)
    return pairs, place


@functools.lru_cache(maxsize=16)
def table(lands: Lands, *, coarse: bool = False) -> Table:
    """Return the table of a bearing's lands, made once.

    Parameters
    ----------
    lands : Lands
        The lands.
    coarse : bool
        Whether the mesh is so coarse that C is known to some 1 % only.

    Returns
    -------
    Table
        The matrices over the gap.
    """
    cells, rings = (COARSE, _COARSE_RINGS) if coarse else (FINE, _RINGS)
    return tabulated(lands, cells, rings)


@functools.lru_cache(maxsize=16)
def finer(lands: Lands) -> Table:
    """Return a table from a mesh of half as large cells, to compare with."""
    return tabulated(lands, _FINER, _RINGS)


def tabulated(lands: Lands, cells: Cells, rings: int) -> Table:
    """Return a table from solutions on a mesh and on a number of rings."""
    # Chebyshev's points of a diameter; the other half follows from the harmonics' symmetry.
    u = _TOP * np.cos(np.pi * (np.arange(rings) + 0.5) / (2 * rings))
    numbers = [_directions(float(one), lands.recesses) for one in u]
    wedges = [_wedge(one, n, lands.recesses) for one, n in zip(u, numbers, strict=True)]
    solved = _solved(lands, cells, np.concatenate([np.zeros((1, 2)), *wedges]).tobytes())
    centre = _values(solved, slice(0, 1))[0]
    harmonics = np.zeros((rings, max(numbers) // 2 + 1, len(centre)), dtype=complex)
    begin = 1
    for ring, (wedge, n) in enumerate(zip(wedges, numbers, strict=True)):
        around = _unfolded(solved, slice(begin, begin + len(wedge)), n, lands.recesses)
        begin += len(wedge)
        s = (1.0 - u[ring] ** 2) / (1.0 + u[ring] ** 2)
        f = _values(around)
        f[:, -3:] *= s**3
        found = np.fft.rfft((f - centre) / u[ring], axis=0) / n
        # Of an even number the last harmonic is known by its cosine alone.
        harmonics[ring, : (n - 1) // 2 + 1] = found[: (n - 1) // 2 + 1]
    return Table(lands, cells, begin, centre, _filled(u, harmonics))


# What takes long is kept of many lands: it is a hundredth of a table.
@functools.lru_cache(maxsize=512)
def _solved(lands: Lands, cells: Cells, position: bytes) -> Influence:
    return extrapolated(lands, cells, np.frombuffer(position).reshape(-1, 2))


def extrapolated(lands: Lands, cells: Cells, position: Array) -> Influence:
    """Return the matrices for vanishing cells, whose error is proportional to their square."""
    twice = Cells(2 * cells.recess, 2 * cells.land, 2 * cells.inside, 2 * cells.outside)
    rough, fine = (influence(mesh(lands, one), position) for one in (cells, twice))
    return Influence(
        fine.conductance + (fine.conductance - rough.conductance) / 3.0,
        fine.pumping + (fine.pumping - rough.pumping) / 3.0,
        fine.squeeze + (fine.squeeze - rough.squeeze) / 3.0,
    )


def _directions(u: float, recesses: int) -> int:
    """Return the number of positions of a ring, a multiple of that of the recesses."""
    harmonics = math.log(_LEFT_OUT) / math.log(u)
    return recesses * max(math.ceil(2.0 * harmonics / recesses), math.ceil(12 / recesses))


def _wedge(u: float, n: int, recesses: int) -> Array:
    """Return the positions of a ring from the load line to half a pitch of the recesses."""
    gamma = 2.0 * np.pi / n * np.arange(n // (2 * recesses) + 1)
    eps = 2.0 * u / (1.0 + u * u)
    return eps * np.stack([np.cos(gamma), np.sin(gamma)], axis=-1)


def _unfolded(found: Influence, wedge: slice, n: int, recesses: int) -> Influence:
    """Return the matrices at all n positions of a ring from those of its wedge."""
    pitch = n // recesses
    q = np.arange(n)
    turns = (q + pitch // 2) // pitch
    past = q - turns * pitch
    side, base = np.where(past < 0, -1, 1), np.abs(past)
    # The recess that stands to the wedge's position as recess k does to position q.
    k = (side[:, None] * (np.arange(recesses) - turns[:, None])) % recesses
    angle = 2.0 * np.pi / recesses * turns
    cos, sin = np.cos(angle), np.sin(angle)
    Q = np.moveaxis(np.array([[cos, -side * sin], [sin, side * cos]]), -1, 0)
    b = base[:, None, None]
    return Influence(
        conductance=found.conductance[wedge][b, k[:, :, None], k[:, None, :]],
        pumping=found.pumping[wedge][base[:, None], k] @ Q.swapaxes(1, 2),
        squeeze=Q @ found.squeeze[wedge][base] @ Q.swapaxes(1, 2),
    )


def _values(found: Influence, rows: slice = slice(None)) -> Array:
    """Return the independent elements of the matrices, (P, F)."""
    G, g, D = found.conductance[rows], found.pumping[rows], found.squeeze[rows]
    i, j = np.triu_indices(G.shape[-1])
    return np.concatenate([G[:, i, j], g.reshape(len(g), -1), D[:, [0, 0, 1], [0, 1, 1]]], axis=1)


def _filled(u: Array, harmonics: ComplexArray) -> Array:
    """Return r, ∂r/∂u, ∂r/∂γ and ∂²r/∂u∂γ on the grid, (steps + 1, directions, 4, F)."""
    rings, count, functions = harmonics.shape
    m: Array = np.arange(count, dtype=float)
    # Through the centre: r(−u, γ) = −r(u, γ + π).
    across = np.concatenate([harmonics, -((-1.0) ** m)[:, None] * harmonics])
    places = np.concatenate([u, -u]) / _TOP
    fit = np.linalg.inv(chebyshev.chebvander(places, 2 * rings - 1))
    grid = np.linspace(0.0, 1.0, _STEPS + 1)
    value = chebyshev.chebvander(grid, 2 * rings - 1) @ fit
    slope = chebyshev.chebvander(grid, 2 * rings - 2) @ chebyshev.chebder(fit) / _TOP
    by_u = np.stack([value, slope], axis=1) @ across.reshape(2 * rings, -1)
    by_u = by_u.reshape(_STEPS + 1, 2, count, functions)
    gamma = 2.0 * np.pi / _DIRECTIONS * np.arange(_DIRECTIONS)
    double = np.where(m > 0, 2.0, 1.0)
    cos, sin = double * np.cos(m * gamma[:, None]), double * np.sin(m * gamma[:, None])
    # Re(a e^{jmγ}) and its derivative by γ.
    left = np.stack([
        np.concatenate([cos, -sin], axis=-1), np.concatenate([-m * sin, -m * cos], axis=-1)
    ], axis=1).reshape(2 * _DIRECTIONS, -1)  # fmt: skip
    right = np.concatenate([by_u.real, by_u.imag], axis=-2)
    found = (left @ right).reshape(_STEPS + 1, 2, _DIRECTIONS, 2, functions)
    return np.ascontiguousarray(found.transpose(0, 2, 3, 1, 4)).reshape(
        _STEPS + 1, _DIRECTIONS, 4, functions
    )


def _interpolated(grid: Array, u: Array, gamma: Array) -> tuple[Array, Array, Array]:
    """Return r, ∂r/∂u and ∂r/∂γ at places, (P, F) each."""
    du, dg = _TOP / _STEPS, _TURN / _DIRECTIONS
    a, b = u / du, np.mod(gamma, _TURN) / dg
    i, j = np.minimum(a.astype(int), _STEPS - 1), np.floor(b).astype(int)
    value_u, slope_u = _hermite(a - i, du)
    value_g, slope_g = _hermite(b - j, dg)
    node = i * _DIRECTIONS + j % _DIRECTIONS
    beside = i * _DIRECTIONS + (j + 1) % _DIRECTIONS
    nodes = np.stack([node, beside, node + _DIRECTIONS, beside + _DIRECTIONS], axis=-1)
    functions = grid.shape[-1]
    corners = grid.reshape(-1, 4 * functions).take(nodes, axis=0).reshape(-1, 16, functions)
    pairs = ((value_u, value_g), (slope_u, value_g), (value_u, slope_g))
    weights = np.stack([_product(one, other) for one, other in pairs], axis=1)
    found = weights @ corners
    return found[:, 0], found[:, 1], found[:, 2]


def _hermite(t: Array, step: float) -> tuple[Array, Array]:
    """Return the weights of value and slope at either end, (P, 2, 2), for a value and a slope."""
    s, both = 1.0 - t, np.empty((2, len(t), 2, 2))
    value, slope = both
    value[:, 0, 0], value[:, 0, 1] = s * s * (1.0 + 2.0 * t), step * t * s * s
    value[:, 1, 0], value[:, 1, 1] = t * t * (1.0 + 2.0 * s), -step * s * t * t
    slope[:, 1, 0] = 6.0 * t * s / step
    slope[:, 0, 0] = -slope[:, 1, 0]
    slope[:, 0, 1], slope[:, 1, 1] = s * (1.0 - 3.0 * t), t * (1.0 - 3.0 * s)
    return value, slope


def _ends(t: float, step: float) -> tuple[float, float, float, float]:
    """Return the weights of value and slope at one end, then at the other, of one place."""
    s = 1.0 - t
    return s * s * (1.0 + 2.0 * t), step * t * s * s, t * t * (1.0 + 2.0 * s), -step * s * t * t


def _product(by_u: Array, by_g: Array) -> Array:
    """Return weights of both directions: by ends in u and γ, then by derivatives in γ and u."""
    return (by_u[:, :, None, None, :] * by_g[:, None, :, :, None]).reshape(-1, 16)
