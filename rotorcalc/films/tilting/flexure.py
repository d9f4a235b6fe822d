"""Pads on flexures at rest: pivots that resist a tilt with a rotational stiffness.

In units of the film the stiffness κ changes with viscosity and speed, in units of the load it does
not: κ C/F_o. So for a given load one table over the load in units of the film, 1/(4σ), holds every
speed. Towards light loads it ends at free pads, towards heavy ones at fixed pads. Each film is
found from that of free pads by raising κ in a few steps.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films.finite.reynolds import Mesh, films, mesh
from rotorcalc.films.finite.table import carried, settled_pressures, table
from rotorcalc.films.load_splines import GROWTH
from rotorcalc.films.tilting.balance import Asked, Balance, balanced, rows_of
from rotorcalc.films.tilting.family import COLUMNS, PadFamily, columns, states
from rotorcalc.films.tilting.pivots import Pivots, places
from rotorcalc.films.tilting.rest import FreePads, Rest

# Loads of the table per decade; the lightest over the heaviest, and κ there, where pads are free.
_PER_DECADE, _LIGHTEST, _FREE = 8, 1e-4, 3e-3
# Loads put between two about which a tilt, in C, turns off its course: a pad takes up its film.
_MORE, _BEND = 3, 0.02
# From so many κ in units of the load on in one question they are solved without tables.
_MANY = 8
# κ, in units of the film, below which a pad is free at any load.
_SOFTEST = 1e-4
# The load from which on values grow about as its power.
_HEAVY = 0.1
# Cells around a pad and pressures along half of it while κ is raised, and steps in κ/(1 + κ).
_ROUGH, _RISES, _ROUNDS = (24, 2), 5, 4
# Share of the loads that must be found.
_ENOUGH = 0.7
# A film whose highest pressure is below this is none.
_NO_PRESSURE = 1e-9


@dataclass(frozen=True, eq=False)
class FlexureTable:
    """Journal and pads over the load, in units of the film, at one κ in units of the load."""

    pivots: Pivots
    load: Array
    loaded: BoolArray
    _free: Array
    _between: PchipInterpolator

    @classmethod
    def through(
        cls, pivots: Pivots, load: Array, values: Array, loaded: BoolArray, free: Array
    ) -> "FlexureTable":
        """Return a table of values (P, 2 + 14 N) at rising loads, and of free pads without load.

        A pad takes up and loses its film at once: between loads no value leaves the range of its
        neighbours, as splines of the third degree would, and damping stays damping.
        """
        return cls(
            pivots, load, loaded, free, PchipInterpolator(np.log(load), values / _growth(load))
        )

    def at(self, load: Array) -> tuple[Array, BoolArray]:
        """Return values at loads (P,), and which pads have a film."""
        if load.size and load.max() > self.load[-1] * (1.0 + 1e-6):
            raise ValueError(
                f"sommerfeld = {0.25 / load.max():.4g}: must be at least "
                f"{0.25 / self.load[-1]:.4g} on flexures of this stiffness; at heavier loads the "
                "pads' films were not found"
            )
        inside = np.clip(load, self.load[0], self.load[-1])
        values = self._between(np.log(inside)) * _growth(inside)
        share = np.minimum(load / self.load[0], 1.0)[:, None]
        values = share * values + (1.0 - share) * self._free
        nearest = np.abs(np.log(inside)[:, None] - np.log(self.load)).argmin(axis=-1)
        return values, self.loaded[nearest]


def _growth(load: Array) -> Array:
    return ((1.0 + load / _HEAVY) ** GROWTH)[:, None]


def _rest(pivots: Pivots, values: Array, loaded: BoolArray) -> Rest:
    """Return journal and pads of the position and of the columns of each pad, (..., 2 + 14 N)."""
    position = values[..., :2]
    pads = values[..., 2:].reshape(*values.shape[:-1], pivots.number, COLUMNS)
    n, t = pivots.frames[:, 0], pivots.frames[:, 1]
    found = states(pivots.preload + position @ n.T, pads, loaded)
    return Rest(position=position, tilt=found.eta - position @ t.T, pads=found)


@functools.lru_cache(maxsize=64)
def heaviest(pivots: Pivots, slenderness: float, *, coarse: bool) -> float:
    """Return the load that pads carry both free and fixed, in units of the film."""
    free = FreePads.of(pivots, slenderness, coarse=coarse).heaviest
    try:
        fixed = table(pivots.tilted(np.zeros(pivots.number)), slenderness, coarse=coarse)
    except ValueError:  # fixed alone they hold no journal at any load
        return free
    return min(free, 0.25 / fixed.least_sommerfeld)


@functools.lru_cache(maxsize=128)
def flexure_table(
    pivots: Pivots, slenderness: float, stiffness: float, *, coarse: bool
) -> FlexureTable:
    """Return journal and pads over the load.

    Parameters
    ----------
    pivots : Pivots
        The pads.
    slenderness : float
        (D/L)² [-].
    stiffness : float
        κ of the pivots in units of the load, k_θ C/(F_o R²) [-].
    coarse : bool
        Whether on a coarse mesh, for drafts.

    Returns
    -------
    FlexureTable
        In units of the film.

    Raises
    ------
    ValueError
        Where too few of its films were found.
    """
    free = FreePads.of(pivots, slenderness, coarse=coarse)
    most = heaviest(pivots, slenderness, coarse=coarse)
    least = min(_LIGHTEST * most, _FREE / stiffness)
    load = np.geomspace(least, most, math.ceil(_PER_DECADE * math.log10(most / least)))
    found = _raised(free, load, stiffness * load)
    good = found.good
    if good.sum() < _ENOUGH * len(load) or not good[0]:
        raise ValueError(
            f"preload = {pivots.preload:g}: on flexures of this stiffness the pads' films were "
            "not found at every load; raise the preload"
        )
    load, found = load[good], _only(found, good, pivots.number)
    more, start = _between(load, found)
    if more.size:
        asked = Asked.of(more, stiffness * more, pivots)
        also = balanced(free.family.mesh, pivots, asked, start)
        load, found = _merged(load, found, more[also.good], _only(also, also.good, pivots.number))
    values, loaded = _values(free.family.mesh, pivots, found)
    return FlexureTable.through(pivots, load, values, loaded, _flat(free.unloaded))


def _merged(load: Array, found: Balance, more: Array, also: Balance) -> tuple[Array, Balance]:
    """Return loads in order, and what was found at them."""
    loads = np.append(load, more)
    order, number = np.argsort(loads), found.tilt.shape[1]
    rows = rows_of(order, number)
    return loads[order], Balance(
        np.concatenate([found.position, also.position])[order],
        np.concatenate([found.tilt, also.tilt])[order],
        np.concatenate([found.wet, also.wet])[rows],
        np.concatenate([found.good, also.good])[order],
    )


def _between(load: Array, found: Balance) -> tuple[Array, Balance]:
    """Return loads between those where a tilt turns off its course, and where to begin there."""
    bend = np.abs(np.diff(found.tilt, n=2, axis=0)).max(axis=1) > _BEND
    near = np.append(bend, False) | np.append(False, bend)
    i = np.repeat(np.flatnonzero(near), _MORE)
    t = np.tile(np.arange(1, _MORE + 1) / (_MORE + 1.0), int(near.sum()))
    number = found.tilt.shape[1]
    rows = rows_of(i, number)
    more = load[i] ** (1.0 - t) * load[i + 1] ** t
    t = t[:, None]
    position = (1.0 - t) * found.position[i] + t * found.position[i + 1]
    tilt = (1.0 - t) * found.tilt[i] + t * found.tilt[i + 1]
    return more, Balance(position, tilt, found.wet[rows], found.good[i])


def _only(found: Balance, good: BoolArray, number: int) -> Balance:
    return Balance(
        found.position[good], found.tilt[good], found.wet[np.repeat(good, number)], good[good]
    )


def _flat(rest: Rest) -> Array:
    """Return position and pads of rests (P,) in columns, as `_rest` takes them."""
    pads = rest.pads
    each = np.concatenate(
        [
            np.stack([pads.eta, pads.force], axis=-1),
            pads.stiffness.reshape(*pads.xi.shape, 4),
            np.stack([pads.damping[..., 0, 0], pads.damping[..., 0, 1], pads.damping[..., 1, 1],
                      pads.drag, pads.side_flow, pads.peak_pressure, pads.peak_angle,
                      pads.thinnest], axis=-1),
        ],
        axis=-1,
    )  # fmt: skip
    return np.concatenate([rest.position, each.reshape(len(each), -1)], axis=-1)


def _values(grid: Mesh, pivots: Pivots, found: Balance) -> tuple[Array, BoolArray]:
    """Return the columns of films in balance, (P, 2 + 14 N), and which pads have a film."""
    e = places(pivots, found.position, found.tilt)
    over = films(grid, e.reshape(-1, 2))
    each = columns(over, settled_pressures(over, found.wet))
    loaded = each[:, 11].reshape(e.shape[:2]) > _NO_PRESSURE
    return np.column_stack([found.position, each.reshape(len(e), -1)]), loaded


def _raised(free: FreePads, load: Array, stiffness: Array) -> Balance:
    """Return pads in balance at loads and κ (P,) in units of the film, from free pads'."""
    pivots, fine = free.pivots, free.family.mesh
    start = free.at(load, stiffness)
    rough = mesh(fine.pads, fine.slenderness, *_ROUGH)
    found = Balance(
        start.position, start.tilt, wet_near(free.family, start.pads.xi, rough), load < 0.0
    )
    for share in np.linspace(0.0, 1.0, _RISES + 1)[1:]:
        part = share * stiffness / (1.0 + stiffness)
        found = balanced(rough, pivots, Asked.of(load, part / (1.0 - part), pivots), found)
    asked = Asked.of(load, stiffness, pivots)
    for _ in range(_ROUNDS):
        if found.good.all() or not found.good.any():
            break
        near = _nearest(found.good)
        rows = rows_of(near, pivots.number)
        again = Balance(found.position[near], found.tilt[near], found.wet[rows], found.good)
        found = balanced(rough, pivots, asked, again)
    last = Balance(found.position, found.tilt, carried(found.wet, fine), found.good)
    return balanced(fine, pivots, asked, last)


def _nearest(good: BoolArray) -> IntArray:
    """Return for each place the nearest that is good, (P,)."""
    places_good = np.flatnonzero(good)
    return places_good[np.abs(np.arange(len(good))[:, None] - places_good).argmin(axis=1)]


def wet_near(family: PadFamily, xi: Array, grid: Mesh) -> BoolArray:
    """Return where films of pads at ξ (...) may be full, on a mesh, (..., flat)."""
    nearest = np.abs(xi.reshape(-1)[:, None] - family.xi).argmin(axis=1)
    return carried(family.wet[nearest], grid)


@functools.lru_cache(maxsize=64)
def unloaded_table(pivots: Pivots, slenderness: float, *, coarse: bool) -> FlexureTable:
    """Return the pads without load over κ in units of the film: all alike, the journal centred."""
    if pivots.preload == 0.0:
        raise ValueError(
            "preload = 0: without load pads on flexures have no film; give them a load or a preload"
        )
    free = FreePads.of(pivots, slenderness, coarse=coarse)
    kappa = np.geomspace(1e-3, 1e3, 9 * _PER_DECADE)
    found = _raised(free, np.zeros_like(kappa), kappa)
    if not found.good.all():
        raise ValueError(
            f"preload = {pivots.preload:g}: without load the pads' films on flexures were not found"
        )
    values, loaded = _values(free.family.mesh, pivots, found)
    return FlexureTable.through(pivots, kappa, values, loaded, _flat(free.unloaded))


@dataclass(frozen=True, eq=False)
class FlexurePads:
    """Pads with a stiffness of their pivots, at any load and κ."""

    pivots: Pivots
    slenderness: float
    coarse: bool

    @property
    def heaviest(self) -> float:
        """The heaviest load, in units of the film."""
        return heaviest(self.pivots, self.slenderness, coarse=self.coarse)

    @property
    def lightest_sommerfeld(self) -> float:
        """σ of the table's lightest load."""
        return 0.25 / (_LIGHTEST * self.heaviest)

    def at(self, load: Array, stiffness: Array) -> Rest:
        """Return journal and pads at loads and κ of the pivots (...), in units of the film."""
        w, kappa = np.broadcast_arrays(load, stiffness)
        flat, k = w.reshape(-1), kappa.reshape(-1)
        values = np.empty((flat.size, 2 + COLUMNS * self.pivots.number))
        loaded: BoolArray = np.ones((flat.size, self.pivots.number), dtype=bool)
        none = flat == 0.0
        if none.any():
            found = unloaded_table(self.pivots, self.slenderness, coarse=self.coarse)
            values[none], loaded[none] = found.at(np.minimum(k[none], found.load[-1]))
        left = ~none & (k > 0.0)
        soft = left & (k * self.heaviest < _SOFTEST * flat)
        if soft.any():
            rest = self._free.at(flat[soft], k[soft])
            values[soft], loaded[soft] = _flat(rest), rest.pads.loaded
        left &= ~soft
        ratio = np.zeros_like(flat)
        # Loads of one machine give one number but for its rounding.
        ratio[left] = [float(f"{one:.9g}") for one in k[left] / flat[left]]
        if len(np.unique(ratio[left])) > _MANY:
            solved = np.flatnonzero(left)
            solved = solved[np.argsort(flat[solved])]
            good, found, films_there = self._solved(flat[solved], k[solved])
            values[solved[good]], loaded[solved[good]] = found, films_there
            left[solved[good]] = False
        for each in np.unique(ratio[left]):
            here = left & (ratio == each)
            table_there = flexure_table(
                self.pivots, self.slenderness, float(each), coarse=self.coarse
            )
            values[here], loaded[here] = table_there.at(flat[here])
        shape = w.shape
        return _rest(self.pivots, values.reshape(*shape, -1), loaded.reshape(*shape, -1))

    @property
    def _free(self) -> FreePads:
        return FreePads.of(self.pivots, self.slenderness, coarse=self.coarse)

    def _solved(self, load: Array, stiffness: Array) -> tuple[BoolArray, Array, BoolArray]:
        """Return where balances were found at rising loads and κ, their values and pads' films.

        Of many κ in units of the load each would need a table of its own.
        """
        found = _raised(self._free, load, stiffness)
        good = found.good
        some = _only(found, good, self.pivots.number)
        return good, *_values(self._free.family.mesh, self.pivots, some)
