"""The film of a foil bearing in tables made once: over speed at a load, over load at a speed.

A film depends on two numbers, the compressibility number Λ, which goes as the speed, and the load
W = F/(p_a D L). A machine has one load at all its speeds; curves over the load number σ have one
speed. Tables are cubic splines over ln Λ or ln W between the light end and that at which the film
in the middle plane has become as thin as `THINNEST`.
"""

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.foil.equilibrium import (
    Equilibria,
    joined,
    put,
    raised,
    refined,
    settled,
    taken,
)
from rotorcalc.films.foil.impedance import impedances
from rotorcalc.films.foil.mesh import Mesh, mesh
from rotorcalc.films.foil.results import drag, peak, side_flow
from rotorcalc.films.foil.reynolds import Films
from rotorcalc.films.foil.whirl import RATIOS, WhirlRows

# The thinnest film in the middle plane that a table reaches, in C.
THINNEST = 0.05
# The highest Λ: above it waves of the gas at half speed are too sharp for the mesh.
HIGHEST_NUMBER = 30.0
# The heaviest load, F/(p_a D L), that tables reach, the heaviest at which they were compared with
# finer ones, and the lightest that is told from none.
HEAVIEST, CHECKED, LIGHTEST = 2.0, 1.5, 1e-8
# The load that stands for none, over Λ/(1 + Λ): the place is then 1e-3 C or so from the centre.
_NEXT_TO_NONE = 1e-3
# Without load no film is too slow: below this Λ it is incompressible.
_LOWEST_UNLOADED = 1e-3
# Λ over W at which no film carries the load, though its foil be rigid.
_HOPELESS = 0.1
# Cells around and pressures along half the bearing: of the search for the table's end, of the
# table; the same of a draft.
_MESHES, _COARSE = ((96, 2), (112, 6)), ((48, 2), (64, 4))
# Knots a decade of the table, and their least and largest number; the same of a draft.
_KNOTS, _COARSE_KNOTS = (10, 20, 48), (6, 12, 20)
# Places in the search for the end, and in each of its refinements.
_SEARCHED, _REFINED, _REFINEMENTS = 20, 6, 2
# Tables over speed, and over load, that are kept, of 3 MB each.
_KEPT = 24
# So few equilibria make no table.
_TOO_FEW = 6
_NOTHING = "no gas film carries this load up to the highest compressibility number, Λ = 30"


@dataclass(frozen=True, kw_only=True)
class FoilShape:
    """What shapes all films of a bearing.

    Attributes
    ----------
    slenderness : float
        (D/L)² [-].
    compliance : float
        α = p_a/(C k_f) [-].
    loss_factor : float
        η [-].
    slit : float
        Angle of the slit from X [rad].
    coarse : bool
        Whether the mesh is a draft's.
    """

    slenderness: float
    compliance: float
    loss_factor: float
    slit: float
    coarse: bool = False

    def meshes(self) -> tuple[Mesh, Mesh]:
        """Return the meshes of the search and of the table."""
        rough, fine = _COARSE if self.coarse else _MESHES
        return mesh(self.slenderness, self.slit, *rough), mesh(self.slenderness, self.slit, *fine)


@dataclass(frozen=True, eq=False)
class Row:
    """Values of the film at places (...) of a table.

    Attributes
    ----------
    position : array, (..., 2)
        The journal's centre, in C.
    drag, side_flow : array, (...)
        In μΩR³L/C and ΩRLC.
    peak_rise, peak_angle : array, (...)
        Highest pressure above ambient, in p_a, and its angle [rad].
    middle_thickness : array, (...)
        Smallest thickness in the middle plane, in C.
    """

    position: Array
    drag: Array
    side_flow: Array
    peak_rise: Array
    peak_angle: Array
    middle_thickness: Array


@dataclass(frozen=True, eq=False)
class FoilTable:
    """The film over ln Λ or ln W.

    Attributes
    ----------
    place : array, (n,)
        Rising places of the table, ln Λ or ln W.
    films : Films
        The films at these.
    rows : CubicSpline
        What `Row` holds.
    whirl : WhirlRows
        The impedance, in p_a R L/C.
    """

    place: Array
    films: Films
    rows: CubicSpline
    whirl: WhirlRows

    @property
    def ends(self) -> tuple[float, float]:
        """Lowest and highest Λ or W."""
        return math.exp(self.place[0]), math.exp(self.place[-1])

    def row(self, place: Array) -> Row:
        """Return everything but the impedance."""
        values = np.asarray(self.rows(place))
        return Row(values[..., :2], *np.moveaxis(values[..., 2:], -1, 0))

    def nearest(self, place: float) -> Films:
        """Return the film of the table nearest to a place."""
        return taken(self.films, np.array([np.abs(self.place - place).argmin()]))


@functools.lru_cache(maxsize=_KEPT)
def over_speed(foil: FoilShape, load: float) -> FoilTable:
    """Return the film over ln Λ at one load.

    Parameters
    ----------
    foil : FoilShape
        The bearing.
    load : float
        F/(p_a D L) [-], zero or more.

    Returns
    -------
    FoilTable
        Made once for each bearing and load.

    Raises
    ------
    ValueError
        Where the film does not carry the load at the highest Λ.
    """
    light = load < LIGHTEST

    def path(place: Array) -> tuple[Array, Array]:
        number = np.exp(place)
        W = _NEXT_TO_NONE * number / (1.0 + number) if light else np.full_like(number, load)
        return number, W

    lowest = _LOWEST_UNLOADED if light else _HOPELESS * load
    return _tabulated(foil, path, math.log(HIGHEST_NUMBER), math.log(lowest))


@functools.lru_cache(maxsize=_KEPT)
def over_load(foil: FoilShape, number: float) -> FoilTable:
    """Return the film over ln W at one Λ.

    Parameters
    ----------
    foil : FoilShape
        The bearing.
    number : float
        Λ [-].

    Returns
    -------
    FoilTable
        Made once for each bearing and Λ.
    """

    def path(place: Array) -> tuple[Array, Array]:
        return np.full_like(place, number), np.exp(place)

    heaviest = min(HEAVIEST, number / _HOPELESS)
    lightest = _NEXT_TO_NONE * number / (1.0 + number)
    return _tabulated(foil, path, math.log(lightest), math.log(heaviest))


_Path = Callable[[Array], tuple[Array, Array]]


def _tabulated(foil: FoilShape, path: _Path, easy: float, hard: float) -> FoilTable:
    """Return the table from the easy end of a path as far to the hard one as films reach."""
    rough, fine = foil.meshes()
    known, films = _reached(rough, foil.compliance, path, (easy, hard))
    per_decade, least, most = _COARSE_KNOTS if foil.coarse else _KNOTS
    first, last = float(known[0]), float(known[-1])
    decades = abs(last - first) / math.log(10.0)
    place = _line(first, last, min(max(math.ceil(per_decade * decades), least), most))
    at = _settled(refined(_between(films, known, place), fine), *path(place))
    kept = np.arange(_leading(at.good))
    if len(kept) < _TOO_FEW:
        raise ValueError(_NOTHING)
    rising = kept[np.argsort(place[kept])]
    return _of(foil, place[rising], taken(at.films, rising))


def _reached(
    grid: Mesh, alpha: float, path: _Path, ends: tuple[float, float]
) -> tuple[Array, Films]:
    """Return places from the easy end to the last that films reach, and the films."""
    place = _line(*ends, _SEARCHED)
    at = raised(grid, alpha, *path(place), THINNEST)
    kept = _leading(at.good)
    if kept == 0:
        raise ValueError(_NOTHING)
    known, films = place[:kept], taken(at.films, np.arange(kept))
    if kept == len(place):
        return known, films
    lost = float(place[kept])
    for _ in range(_REFINEMENTS):
        place = _line(float(known[-1]), lost, _REFINED + 2)[1:-1]
        at = raised(grid, alpha, *path(place), THINNEST)
        kept = _leading(at.good)
        known = np.append(known, place[:kept])
        films = joined(films, taken(at.films, np.arange(kept)))
        lost = float(place[kept]) if kept < len(place) else lost
    return known, films


def _line(start: float, stop: float, number: int) -> Array:
    return np.asarray(np.linspace(start, stop, number), dtype=np.float64)


def _leading(good: BoolArray) -> int:
    """Return how many at the beginning are good."""
    return len(good) if good.all() else int(np.argmin(good))


def _between(films: Films, known: Array, place: Array) -> Films:
    """Return films on the line between the known ones beside each place."""
    sign = math.copysign(1.0, known[-1] - known[0])
    i = np.clip(np.searchsorted(sign * known, sign * place) - 1, 0, len(known) - 2)
    t = (place - known[i]) / (known[i + 1] - known[i])
    low, high = taken(films, i), taken(films, i + 1)
    return replace(
        low,
        position=low.position + t[:, None] * (high.position - low.position),
        pressure=low.pressure + t[:, None, None] * (high.pressure - low.pressure),
    )


def _settled(guess: Films, number: Array, load: Array) -> Equilibria:
    """Return the equilibria near guesses; where these fail the load is raised once more."""
    at = settled(replace(guess, number=number), load)
    bad = np.flatnonzero(~at.good)
    if not bad.size:
        return at
    again = raised(guess.mesh, guess.compliance, number[bad], load[bad], 0.5 * THINNEST)
    good = at.good.copy()
    good[bad] = again.good
    return Equilibria(put(at.films, bad, again.films), good)


def _of(foil: FoilShape, place: Array, films: Films) -> FoilTable:
    highest, angle = peak(films)
    rows = np.column_stack(
        [
            films.position, drag(films), side_flow(films),
            highest, np.unwrap(angle), films.least_thickness,
        ]
    )  # fmt: skip
    Z = impedances(films, RATIOS, foil.loss_factor)
    return FoilTable(place, films, CubicSpline(place, rows), WhirlRows.through(place, Z))
