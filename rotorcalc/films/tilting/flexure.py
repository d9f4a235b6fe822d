"""Pads on flexures at rest: pivots that resist a tilt with a rotational stiffness.

A pad's film depends on the journal's place over it alone, and is known over the whole plane
(`plane`). So any load, κ, preload and number of pads is solved at once, without another table. At
κ = 0 the pads tilt freely, towards large κ they are fixed.

On a flexure a pad may have two films: opened by its tilt, with a film that holds it there, or left
where its flexure holds it, with less or none. Of two states this is the one that is reached from
pads that tilt freely as their flexures become stiffer, at the same load: a pad keeps its film as
long as there is one.
"""

import functools
import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films.finite.table import THINNEST
from rotorcalc.films.pads import Pad, outline
from rotorcalc.films.tilting.family import COLUMNS, PadStates, states
from rotorcalc.films.tilting.known_rests import KnownRests, lies_between
from rotorcalc.films.tilting.pivots import Pivots, places
from rotorcalc.films.tilting.plane import PadPlane, plane
from rotorcalc.films.tilting.rest import FreePads, Rest
from rotorcalc.films.tilting.settling import (
    Held,
    Settled,
    at_once,
    carefully,
    let_go,
    settled,
    towards,
)

T = TypeVar("T")
# Steps in κ/(1 + κ), and of each on its way.
_RISES, _STEPS = 5, 3
# κ, in units of the film at the heaviest load, below which a pad is free at any load.
_SOFTEST = 1e-4
# The lightest load over the heaviest.
_LIGHTEST = 1e-4
# From so many loads on, one in so many is found first.
_MANY, _APART = 100, 4
# Tilts among which other films of a pad are sought, and the farthest, in C.
_TILTS, _FAR = 64, 2.5
# A film whose highest pressure is below this is none.
_NO_PRESSURE = 1e-9
# Directions in which the heaviest load of fixed pads is sought.
_DIRECTIONS = 1440


@dataclass(frozen=True)
class FlexurePads:
    """Pads with a stiffness of their pivots, at any load and κ.

    Attributes
    ----------
    pivots : Pivots
        The pads.
    slenderness : float
        (D/L)² [-].
    coarse : bool
        Whether on a coarse mesh, for drafts.
    """

    pivots: Pivots
    slenderness: float
    coarse: bool

    @property
    def heaviest(self) -> float:
        """The heaviest load, in units of the film."""
        return heaviest(self.pivots, self.slenderness, coarse=self.coarse)

    @property
    def lightest_sommerfeld(self) -> float:
        """σ of a load that hardly moves the journal."""
        return 0.25 / (_LIGHTEST * self.heaviest)

    def at(self, load: Array, stiffness: Array) -> Rest:
        """Return journal and pads at loads and κ of the pivots (...), in units of the film.

        Raises
        ------
        ValueError
            Where nothing holds the journal.
        """
        w, kappa = np.broadcast_arrays(load, stiffness)
        # A page asks for one set of speeds several times over.
        return _at(self, w.shape, w.tobytes(), kappa.tobytes())

    def solved(self, w: Array, kappa: Array) -> Rest:
        """Return the same at loads and κ (...), not remembered as one question."""
        flat, k = w.reshape(-1), kappa.reshape(-1)
        # Without load κ in units of it has no meaning, and the pads hold the journal together.
        stiff = k > _SOFTEST * np.minimum(1.0, flat / self.heaviest)
        number = self.pivots.number
        found = _Columns(
            np.empty((flat.size, 2)),
            np.empty((flat.size, number)),
            np.empty((flat.size, number, COLUMNS)),
            np.empty((flat.size, number), dtype=bool),
        )
        for rows, at in (
            (np.flatnonzero(~stiff), self._tilting_freely),
            (np.flatnonzero(stiff), self._on_flexures),
        ):
            if rows.size:
                _put(found, rows, at(Held(flat[rows], k[rows])))
        return _shaped(self.pivots, found, w.shape)

    def other_films(self, rest: Rest, stiffness: Array) -> BoolArray:
        """Return which pads (..., N) could have another film where the journal stands.

        Tilts at which the film's moment passes κ δ from above hold a pad: more than one do.
        """
        xi, kappa = rest.pads.xi[..., None], stiffness[..., None, None]
        untilted = rest.position @ self.pivots.frames[:, 1].T
        low, high = _ends_of_tilt(self._films.pad, xi)
        eta = low + (high - low) * np.linspace(0.0, 1.0, _TILTS)
        e = np.stack(np.broadcast_arrays(xi, eta), axis=-1)
        left = self._films.forces(e)[0][..., 1] - kappa * (eta - untilted[..., None])
        held = (left[..., :-1] > 0.0) & (left[..., 1:] <= 0.0)
        return held.sum(axis=-1) > 1

    @property
    def _free(self) -> FreePads:
        return FreePads.of(self.pivots, self.slenderness, coarse=self.coarse)

    @property
    def _films(self) -> PadPlane:
        return films_of(self.pivots, self.slenderness, coarse=self.coarse)

    def _tilting_freely(self, held: Held) -> "_Columns":
        return _flat(self._free.at(held.load, held.stiffness))

    def _on_flexures(self, held: Held) -> "_Columns":
        if self.pivots.preload == 0.0 and np.any(held.load == 0.0):
            raise ValueError(
                "preload = 0: without load pads on flexures have no film; give them a load or a "
                "preload"
            )
        pad, found = self._films, self._settled(held)
        if not found.good.all():
            lost = held.at(np.flatnonzero(~found.good))
            load = float(lost.load[0])
            sigma = 0.25 / load if load > 0.0 else math.inf
            raise ValueError(
                f"sommerfeld = {sigma:.4g}: on flexures of this stiffness, "
                f"{lost.stiffness[0]:.3g} of the film's, nothing was found to hold the journal; "
                "raise the preload, or let the load point between pads"
            )
        values, loaded = pad.columns(places(self.pivots, found.position, found.tilt))
        loaded &= values[..., 11] > _NO_PRESSURE
        return _Columns(found.position, found.tilt, values, loaded)

    def _settled(self, held: Held) -> Settled:
        """Return journal and pads at rest, between known rests where there are any."""
        # Loads of one machine give one number but for its rounding.
        with np.errstate(divide="ignore"):
            first, *others = {f"{one:.9g}" for one in held.stiffness / held.load}
        if others:
            return self._from_free(held)
        known, found = _known(self, first), _nothing(held.load.size, self.pivots.number)
        for rows in _by_turns(held.load):
            _put(found, rows, self._beside(known, held.at(rows)))
        return found

    def _beside(self, known: KnownRests, held: Held) -> Settled:
        """Return rests between known ones where these stand alike, others anew; all are known."""
        between = known.between(held.load)
        found = _nothing(held.load.size, self.pivots.number)
        near = np.flatnonzero(between.near)
        if near.size:
            start = _started(between.start[near])
            _put(found, near, at_once(self._films, self.pivots, held.at(near), start))
        anew = np.flatnonzero(~(between.near & lies_between(found, between)))
        if anew.size:
            _put(found, anew, self._from_free(held.at(anew)))
        good = np.flatnonzero(found.good)
        known.add(held.load[good], found.at(good))
        return found

    def _from_free(self, held: Held) -> Settled:
        free = self._free.at(held.load, held.stiffness)
        start = Settled(free.position, free.tilt, held.load < 0.0)
        return raised(self._films, self.pivots, held, start)


@functools.lru_cache(maxsize=64)
def _known(pads: FlexurePads, _ratio: str) -> KnownRests:
    """Return what is known at one κ in units of the load, at first nothing."""
    return KnownRests(pads.pivots.number)


def _ends_of_tilt(pad: Pad, xi: Array) -> tuple[Array, Array]:
    """Return the least and the largest η at which a pad leaves the journal a film, (...)."""
    theta = np.linspace(pad.start, pad.end, _TILTS)
    with np.errstate(divide="ignore"):
        meets = (1.0 - THINNEST - xi * np.cos(theta)) / np.sin(theta)
    low = np.where(theta < 0.0, meets, -np.inf).max(axis=-1, keepdims=True)
    high = np.where(theta > 0.0, meets, np.inf).min(axis=-1, keepdims=True)
    return np.maximum(low, -_FAR), np.minimum(high, _FAR)


def _by_turns(load: Array) -> tuple[IntArray, ...]:
    """Return rows of loads (P,): of many some of all sizes first, between which the others lie."""
    order = np.argsort(load)
    if len(load) < _MANY:
        return (order,)
    first = np.zeros(len(load), dtype=bool)
    first[::_APART] = first[-1] = True
    return order[first], order[~first]


def _started(at: Array) -> Settled:
    return Settled(at[:, :2], at[:, 2:], np.zeros(len(at), dtype=bool))


def _nothing(count: int, number: int) -> Settled:
    return _started(np.zeros((count, 2 + number)))


@functools.lru_cache(maxsize=64)
def _at(pads: FlexurePads, shape: tuple[int, ...], load: bytes, stiffness: bytes) -> Rest:
    w, kappa = (np.frombuffer(one).reshape(shape) for one in (load, stiffness))
    return pads.solved(w, kappa)


def raised(pad: PadPlane, pivots: Pivots, held: Held, start: Settled) -> Settled:
    """Return pads at rest at loads and κ (P,), from those of free pads, as κ rises."""
    found, share = start, held.stiffness / (1.0 + held.stiffness)
    for part in np.linspace(0.0, 1.0, _RISES + 1)[1:-1]:
        softer = part * share / (1.0 - part * share)
        found = towards(pad, pivots, Held(held.load, softer), found, steps=_STEPS)
    found = settled(pad, pivots, held, found)
    for again in (carefully, let_go):
        bad = np.flatnonzero(~found.good)
        if bad.size:
            begin = (start if again is carefully else found).at(bad)
            _put(found, bad, again(pad, pivots, held.at(bad), begin))
    return found


def films_of(pivots: Pivots, slenderness: float, *, coarse: bool) -> PadPlane:
    """Return the films of the pads of a bearing."""
    return plane(pivots.arc, slenderness, coarse=coarse).turned_to(pivots.offset)


@functools.lru_cache(maxsize=256)
def heaviest(pivots: Pivots, slenderness: float, *, coarse: bool) -> float:
    """Return the load that pads carry both free and fixed, in units of the film."""
    free = FreePads.of(pivots, slenderness, coarse=coarse).heaviest
    return min(free, _heaviest_on(pivots, films_of(pivots, slenderness, coarse=coarse)))


def _heaviest_on(pivots: Pivots, pad: PadPlane) -> float:
    """Return the load of fixed pads at their thinnest film, infinite where they hold no journal.

    The journal is on the line along which the thinnest film is `THINNEST`, where the force on it
    points against the load.
    """
    angle = np.linspace(-0.5 * math.pi, 0.5 * math.pi, _DIRECTIONS)
    room = 1.0 - THINNEST
    # 1 + a·n − q·n = t is the touching of a bore smaller by t.
    smaller = tuple(
        Pad(one.start, one.end, one.a_x / room, one.a_y / room)
        for one in pivots.tilted(np.zeros(pivots.number))
    )
    position = room * outline(smaller, angle)
    F, _, _ = pad.forces(places(pivots, position, np.zeros((len(angle), pivots.number))))
    f_x, f_y = np.einsum("nai,pna->ip", pivots.frames, F)
    turns = np.flatnonzero((np.diff(np.sign(f_y)) != 0.0) & (f_x[1:] < 0.0))
    t = f_y[turns] / (f_y[turns] - f_y[turns + 1])
    return float(np.min(-(1.0 - t) * f_x[turns] - t * f_x[turns + 1], initial=math.inf))


@dataclass(frozen=True, eq=False)
class _Columns:
    """Rests at P loads: positions (P, 2), tilts, values (P, N, 14) and which pads have a film."""

    position: Array
    tilt: Array
    values: Array
    loaded: BoolArray


def _put(found: T, rows: IntArray, new: T) -> None:
    """Write rows of a record's arrays."""
    for name, values in vars(new).items():
        getattr(found, name)[rows] = values


def _flat(rest: Rest) -> _Columns:
    pads = rest.pads
    values = np.stack(
        [
            pads.eta, pads.force, *np.moveaxis(pads.stiffness.reshape(*pads.xi.shape, 4), -1, 0),
            pads.damping[..., 0, 0], pads.damping[..., 0, 1], pads.damping[..., 1, 1],
            pads.drag, pads.side_flow, pads.peak_pressure, pads.peak_angle, pads.thinnest,
        ],
        axis=-1,
    )  # fmt: skip
    return _Columns(rest.position.copy(), rest.tilt.copy(), values, pads.loaded.copy())


def _shaped(pivots: Pivots, found: _Columns, shape: tuple[int, ...]) -> Rest:
    """Return rests in a shape (...)."""
    xi = places(pivots, found.position, found.tilt)[..., 0]
    pads: PadStates = states(
        xi.reshape(*shape, -1),
        found.values.reshape(*shape, *found.values.shape[1:]),
        found.loaded.reshape(*shape, -1),
    )
    return Rest(found.position.reshape(*shape, 2), found.tilt.reshape(*shape, -1), pads)
