"""The film of one bore over load, in a table made once: cubic splines over the load's logarithm.

All films of a bore depend on the load alone, in units of the film, F_o/(μΩRL³/C²) = 1/(4σ). Towards
no load everything is linear in the load: a bore whose pads are parts of one circle is then without
pressure, at its centre, and any other holds the journal stiffly. The heavy end is where the film
has become as thin as `THINNEST`.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.finite.equilibrium import ASTRAY, Equilibria, scan, settled
from rotorcalc.films.finite.fronts import coefficients
from rotorcalc.films.finite.results import drag, peak, side_flow
from rotorcalc.films.finite.reynolds import Mesh, films, mesh
from rotorcalc.films.finite.sweeps import settled_pressures
from rotorcalc.films.load_splines import CoefficientSplines, LoadSplines, half_whirl
from rotorcalc.films.pads import NO_POSITION, Pad, are_concentric, gap, have_pockets, resting

# The thinnest film that the table reaches, in C.
THINNEST = 0.03
# The lightest load of the table over that at a quarter of the way to the wall.
_LIGHTEST = 0.05
# The load about which a film turns from a light one's behaviour to a heavy one's, over that.
_HEAVY = 4.0 / _LIGHTEST
# Cells around a pad and pressures along half the bearing in the scan and the first solution; in the
# last one, with the number of loads, by the number of pads, or of pockets where there are any: pads
# with pockets take up and lose their films more suddenly than others, and with several of them the
# pressure along the axis counts for more than that around the pads.
_SCAN, _COARSE = (16, 2), (24, 2)
_SMOOTH, _MANY_PADS = {1: (160, 3, 26), 2: (96, 3, 26)}, (80, 3, 26)
_DAM, _DAMS = (96, 3, 24), (56, 4, 24)
# While a bore changes: about a third of the time.
_COARSE_ARC, _COARSE_SMOOTH = (96, 2, 16), (48, 2, 16)
_COARSE_DAM, _COARSE_DAMS = (48, 2, 20), (32, 2, 16)
# From so many pads on, and with pockets, a table takes longer than two pads' does.
_MANY = 4
# A bore with pockets has two zones along it.
_ZONES_OF_DAMS = 2
# Number of them up to a quarter of the way to the wall, where the film is nearly linear.
_LIGHT_LOADS = 6
# The load that stands for none in a bore without preload, where no load is no film, over the
# lightest.
_NEXT_TO_NONE = 1e-5
_ROUGH = 5
# With pockets light films are far wider than the scan's, and grow by a node a step.
_ROUGH_WITH_POCKETS = 8
# So few equilibria make no table.
_TOO_FEW = 8


@dataclass(frozen=True, eq=False)
class Row:
    """Values of the film at loads (...), in film units.

    Attributes
    ----------
    position : array, (..., 2)
        The journal's centre, in C.
    drag, side_flow, peak_pressure, peak_angle : array, (...)
        In μΩR³L/C, ΩRLC, μΩ(L/C)² and rad.
    """

    position: Array
    drag: Array
    side_flow: Array
    peak_pressure: Array
    peak_angle: Array


@dataclass(frozen=True, eq=False)
class FilmTable:
    """The film of a bore over load, 1/(4σ).

    Attributes
    ----------
    mesh : Mesh
        The mesh of the solutions.
    load : array, (n,)
        Rising loads of the table, after no load [-].
    position : array, (n, 2)
        The journal's centre at those, in C.
    wet : boolean array, (n, N, nodes, m)
        Where the film is full.
    thinnest : float
        The smallest film at the heaviest load, in C.
    """

    mesh: Mesh
    load: Array
    position: Array
    wet: BoolArray
    thinnest: float
    _rows: LoadSplines
    _coefficients: CoefficientSplines
    _angles: Array

    @property
    def least_sommerfeld(self) -> float:
        """σ of the heaviest load."""
        return 0.25 / float(self.load[-1])

    @property
    def lightest_sommerfeld(self) -> float:
        """σ of the lightest load; beyond it the film is linear in the load."""
        return 0.25 / float(self.load[0])

    def coefficients(self, sommerfeld: Array) -> tuple[Array, Array]:
        """Return stiffness and damping at σ, (..., 2, 2)."""
        return self._coefficients.at(self._load(sommerfeld))

    def row(self, sommerfeld: Array) -> Row:
        """Return everything but the coefficients at σ."""
        load = self._load(sommerfeld)
        values = self._rows.at(load)
        return Row(
            values[..., :2], values[..., 2], values[..., 3], values[..., 4], self._angle(load)
        )

    def place_and_flow(self, sommerfeld: Array) -> tuple[Array, Array]:
        """Return the journal's centre and the side flow at σ, as in `row`."""
        values = self._rows.at(self._load(sommerfeld))
        return values[..., :2], values[..., 3]

    def drag_and_flow(self, sommerfeld: Array) -> tuple[Array, Array]:
        """Return drag and side flow at σ, as in `row`."""
        values = self._rows.at(self._load(sommerfeld))
        return values[..., 2], values[..., 3]

    def direction(self, position: Array) -> Array:
        """Return the direction from the bore's centre to positions, at the centre its limit."""
        x, y = position[..., 0], position[..., 1]
        slope = self.position[0] - self._rows.unloaded[:2]
        near = np.hypot(x, y) < 1e-9
        return np.where(near, np.arctan2(slope[1], slope[0]), np.arctan2(y, x))

    def _load(self, sommerfeld: Array) -> Array:
        load = 0.25 / np.asarray(sommerfeld, dtype=float)
        heaviest = float(self.load[-1])
        if load.size and load.max() > heaviest * (1.0 + 1e-9):
            raise ValueError(
                f"sommerfeld = {0.25 / load.max():.4g}: must be at least "
                f"{self.least_sommerfeld:.4g} in this bore; there the smallest film is "
                f"{self.thinnest:.3g} of the clearance, and a heavier load presses the journal "
                "closer to the pad than the finite film is computed"
            )
        return load

    def _angle(self, load: Array) -> Array:
        """Return the place of the highest pressure: where it moves to another pad, the nearer's."""
        x = np.log(np.clip(load, self.load[0], self.load[-1]))
        knots = np.log(self.load)
        i = np.clip(np.searchsorted(knots, x) - 1, 0, len(knots) - 2)
        t = (x - knots[i]) / (knots[i + 1] - knots[i])
        low, high = self._angles[i], self._angles[i + 1]
        near = np.where(t < 0.5, low, high)
        return np.where(np.abs(high - low) < 0.5, low + t * (high - low), near)


# Each visitor's L/D with all bores: a table has some 40 kB.
@functools.lru_cache(maxsize=1024)
def table(pads: tuple[Pad, ...], slenderness: float, *, coarse: bool = False) -> FilmTable:
    """Return the film of a bore over load.

    Parameters
    ----------
    pads : tuple of Pad
        The pads.
    slenderness : float
        (D/L)² [-].
    coarse : bool
        Whether the mesh is so coarse that K and C are known to some 4 % only.

    Returns
    -------
    FilmTable
        Made once for pads and slenderness.

    Raises
    ------
    ValueError
        Where no equilibria are found.
    """
    return _tabulated(pads, slenderness, _resolution(pads, coarse))


def _resolution(pads: tuple[Pad, ...], coarse: bool) -> tuple[int, int, int]:
    dams = sum(pad.depth > 0.0 for pad in pads)
    if dams == 1:
        return _COARSE_DAM if coarse else _DAM
    if dams:
        return _COARSE_DAMS if coarse else _DAMS
    if coarse:
        return _COARSE_ARC if len(pads) == 1 else _COARSE_SMOOTH
    return _SMOOTH.get(len(pads), _MANY_PADS)


def takes_long(pads: tuple[Pad, ...]) -> bool:
    """Return whether a table of pads takes longer than that of two smooth ones."""
    return len(pads) >= _MANY or have_pockets(pads)


def _tabulated(pads: tuple[Pad, ...], slenderness: float, fine: tuple[int, int, int]) -> FilmTable:
    zones = _ZONES_OF_DAMS if have_pockets(pads) else 1
    *last, count = fine
    grids = [mesh(pads, slenderness, n, zones * m) for n, m in (_SCAN, _COARSE, last)]
    concentric = zones == 1 and are_concentric(pads)
    load, start, wet = _loads(grids[0], count, lightest=_NEXT_TO_NONE if concentric else 0.0)
    # Rough positions are good enough to go on from.
    steps = _ROUGH if zones == 1 else _ROUGH_WITH_POCKETS
    rough = settled(grids[1], load, start, carried(wet, grids[1]), steps=steps)
    near = carried(rough.wet, grids[2])
    # A film that is too wide shrinks at once.
    found = _followed(grids[2], load, rough.position, near if zones == 1 else _wider(near))
    return _made(grids[2], found, concentric)


def _loads(coarse: Mesh, count: int, *, lightest: float) -> tuple[Array, Array, BoolArray]:
    """Return the loads of the table, in R units, and positions and films near their equilibria.

    The first stands for no load: `lightest` times the next.
    """
    load, position, wet = scan(coarse)
    if len(load) < 3:
        raise ValueError(NO_POSITION)
    film = gap(coarse.pads, position)
    heavy = np.log(load[1:])
    # The film thins as the load rises, by its logarithm; preloaded bores start from a thin one.
    thinning = np.minimum.accumulate(np.log(film[1:]))
    heaviest = math.exp(float(np.interp(-math.log(THINNEST), -thinning, heavy)))
    light = np.linspace(math.log(_LIGHTEST), 0.0, _LIGHT_LOADS, endpoint=False)
    # A journal that even a light load presses close to a pad; but for rounding they are the same.
    if heaviest <= (1.0 + 1e-9) * load[1]:
        raise ValueError(NO_POSITION)
    heavier = np.linspace(0.0, math.log(heaviest / load[1]), count - _LIGHT_LOADS)
    loads: Array = load[1] * np.exp(np.concatenate([light, heavier]))
    loads = np.append(lightest * loads[0], loads)
    share = np.minimum(loads / load[1], 1.0)[:, None]
    ln = np.log(np.maximum(loads, load[1]))
    there = np.stack([np.interp(ln, heavy, position[1:, j]) for j in (0, 1)], axis=-1)
    nearest = np.abs(ln[:, None] - heavy).argmin(axis=1) + 1
    return loads, share * there, wet[nearest]


def _followed(grid: Mesh, load: Array, start: Array, wet: BoolArray) -> Equilibria:
    """Return equilibria up to the heaviest found, those that Newton's method misses from others."""
    found = settled(grid, load, start, wet)
    for _ in range(3):
        bad = np.flatnonzero(~found.good)
        if not bad.size:
            return found
        # From the nearest lighter load that was found, or the nearest heavier one.
        good = np.flatnonzero(found.good)
        if not good.size:
            break
        near = good[np.abs(bad[:, None] - good - 0.25).argmin(axis=1)]
        again = settled(grid, load[bad], found.position[near], found.wet[near])
        found.position[bad], found.wet[bad] = again.position, again.wet
        found.good[bad] = again.good
    return _up_to_the_first_without(found.good, found)


def _up_to_the_first_without(good: BoolArray, found: Equilibria) -> Equilibria:
    """Return equilibria up to the heaviest below which all are good."""
    last = len(good) if good.all() else int(np.argmin(good))
    if last < _TOO_FEW:
        raise ValueError(NO_POSITION)
    return Equilibria(found.load[:last], found.position[:last], found.wet[:last], found.good[:last])


def carried(wet: BoolArray, fine: Mesh) -> BoolArray:
    """Return an active set of a coarse mesh on a finer one, by the places of its nodes.

    Parameters
    ----------
    wet : boolean array, (P, N, nodes, m)
        The active set at P positions.
    fine : Mesh
        The finer mesh.

    Returns
    -------
    boolean array
        As large as the finer mesh asks for.
    """
    _, nodes, m = fine.shape
    around = (np.arange(nodes) + 1.0) / (nodes + 1.0) * (wet.shape[2] + 1.0) - 1.0
    i = np.clip(np.rint(around).astype(int), 0, wet.shape[2] - 1)
    q = np.minimum(np.rint(np.arange(m) / m * wet.shape[3]).astype(int), wet.shape[3] - 1)
    return np.ascontiguousarray(wet[:, :, i][..., q])


def _wider(wet: BoolArray) -> BoolArray:
    """Return an active set with a node more around the pads at each of its ends."""
    wide = wet.copy()
    wide[:, :, 1:] |= wet[:, :, :-1]
    wide[:, :, :-1] |= wet[:, :, 1:]
    return wide


def _made(grid: Mesh, found: Equilibria, concentric: bool) -> FilmTable:
    """Return the table of equilibria, the first of them without load unless concentric."""
    over = films(grid, found.position)
    at = settled_pressures(over, found.wet)
    stiffness, damping = coefficients(over, at)
    rests = resting(grid.pads, found.position, stiffness)
    astray = np.hypot(at.force[1:, 0] + found.load[1:], at.force[1:, 1])
    rests[1:] &= astray <= ASTRAY * found.load[1:]
    if not rests.all():
        return _made(grid, _up_to_the_first_without(rests, found), concentric)
    # R units to film units: force, stiffness, damping and pressure over 4(L/D)².
    film = grid.slenderness / 4.0
    K, C = film * stiffness, film * damping
    highest = peak(over, at.pressure)
    rows = np.column_stack([
        found.position, drag(over, at.pressure), side_flow(over, at.pressure),
        film * highest.pressure,
    ])  # fmt: skip
    if concentric:
        # Without load there is no pressure: place, flow and the rest of K vanish.
        rows[0, [0, 1, 3, 4]] = 0.0
        if any(pad.is_closed for pad in grid.pads):
            C[0, [0, 1], [1, 0]] = 0.0  # by symmetry; the mesh is cut open on one side only
        K[0] = half_whirl(C[0])
    load = film * found.load[1:]
    return FilmTable(
        mesh=grid,
        load=load,
        position=rows[1:, :2],
        wet=at.wet[1:],
        thinnest=float(gap(grid.pads, rows[-1, :2])),
        _rows=LoadSplines.through(load, rows),
        _coefficients=CoefficientSplines.through(load, K, C, scale=_HEAVY * float(load[0])),
        _angles=highest.angle[1:],
    )
