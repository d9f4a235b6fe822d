"""Static equilibrium of a journal on recesses, and the film's stiffness and damping there.

The unknowns are the journal's position and the flow Q_k = q y_k through each restrictor, over that
at zero recess pressure, q (`restrictors`). What passes the restrictor leaves the recess over the
lands (`influence`), and the film carries the load:

    q y = G P − 12 S g w,    gᵀ P + 12 S D w = (W, 0),    w = (y, −x)/2,    W = F_o/(p_s R L)

solved by Newton's method for all operating points at once.
"""

import functools
from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

import numpy as np
from scipy.interpolate import CubicSpline

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.hydrostatic.influence import Influence
from rotorcalc.films.hydrostatic.mesh import lands_of
from rotorcalc.films.hydrostatic.restrictors import Restrictors
from rotorcalc.films.hydrostatic.table import THINNEST, Table, table
from rotorcalc.geometry import Hydrostatic
from rotorcalc.machine import JournalBearing

# Newton's steps; the size of the last, in C, of which the square is left; the longest over the
# smallest film.
_MOST_STEPS, _SETTLED, _LONGEST = 60, 1e-7, 0.7
# The smallest film on the way to an equilibrium, in C: just inside the table's outermost ring.
_CLOSEST = 0.021
# Eccentricities of the load's curve at rest.
_PLACES = 65
# Where the heaviest load is sought: eccentricities, directions, and speeds over that at which
# rotation turns the force by 45° in the centre; and the share of it that is answered for.
_ECCENTRICITIES, _DIRECTIONS = np.linspace(0.4, 0.95, 12), np.linspace(0.0, 0.5 * np.pi, 17)
_SPEEDS, _SURE = np.array([0.01, 0.03, 0.08, 0.2, 0.5]), 0.93
# Speeds over the same, at which equilibria under one load are known for Newton's method to begin.
_KNOTS = np.geomspace(1e-3, 1e3, 49)
# Shares of a load by which an equilibrium is followed that Newton's method misses.
_SHARES = (0.4, 0.6, 0.75, 0.85, 0.93, 1.0)
_NO_FLOWS = "no balance of the recesses' flows found"
# Rotation acts on the film as the velocity w = (y, −x)/2 does.
_TURN = np.array([[0.0, 0.5], [-0.5, 0.0]])


@dataclass(frozen=True, eq=False)
class Balance:
    """Journals in equilibrium, n of them.

    Attributes
    ----------
    position : array, (n, 2)
        The journal's centre, in C.
    pressure : array, (n, N)
        The recesses', in p_s.
    flow : array, (n, N)
        Through the restrictors, of which the sum is in (L/D) p_s C³/(6μ).
    stiffness : array, (n, 2, 2)
        In p_s R L/C.
    damping : array, (n, 2, 2)
        In μR³L/C³.
    """

    position: Array
    pressure: Array
    flow: Array
    stiffness: Array
    damping: Array


@dataclass(frozen=True, eq=False)
class Bearing:
    """Lands and restrictors together.

    Attributes
    ----------
    table : Table
        The lands' matrices.
    restrictors : Restrictors
        The restrictors.
    size : float
        Flow through a restrictor at zero recess pressure, q.
    eccentricity, load : array, (k,)
        Rising eccentricity ratios of the journal at rest and its loads, in p_s R L, to the highest.
    """

    table: Table
    restrictors: Restrictors
    size: float
    eccentricity: Array
    load: Array

    @cached_property
    def heaviest(self) -> float:
        """The heaviest load that is carried at every speed, F_o/(p_s R L)."""
        return _SURE * min(float(self.load[-1]), _carried_in_rotation(self))

    @cached_property
    def turning(self) -> float:
        """μΩ(R/C)²/p_s at which rotation turns the force by 45° in the centre."""
        _, centred = held(self, np.zeros(1), np.zeros((1, 2)))
        return 2.0 * float(centred.stiffness[0, 0, 0] / centred.damping[0, 0, 0])


@functools.lru_cache(maxsize=64)
def bearing_of(table: Table, restrictors: Restrictors) -> Bearing:
    """Return lands with restrictors, and the loads that they carry at rest."""
    q = restrictors.size(table.outflow_in_centre)
    eps = np.linspace(0.0, 1.0 - THINNEST, _PLACES)
    bearing = Bearing(table, restrictors, q, eps, eps)
    load = -_forces(bearing, np.zeros(1), np.stack([eps, 0.0 * eps], axis=-1))[0, :, 0]
    # Beyond its highest load a journal at rest falls onto the land.
    last = int(np.argmax(load)) + 1
    return replace(bearing, eccentricity=eps[:last], load=np.maximum.accumulate(load[:last]))


def bearing_with(bearing: JournalBearing, *, coarse: bool = False) -> Bearing:
    """Return the lands and restrictors of a bearing of a `Hydrostatic` geometry."""
    shape = cast("Hydrostatic", bearing.geometry)
    made = table(lands_of(bearing), coarse=coarse)
    return bearing_of(made, Restrictors(shape.restrictor, shape.pressure_ratio))


def _carried_in_rotation(bearing: Bearing) -> float:
    """Return the lowest of the highest loads at some speeds, in p_s R L.

    A slowly turning journal gives way towards the land beside the recess that carries it, where the
    film holds it less.
    """
    eps, gamma = np.meshgrid(_ECCENTRICITIES, _DIRECTIONS, indexing="ij")
    place = np.stack([eps * np.cos(gamma), eps * np.sin(gamma)], axis=-1).reshape(-1, 2)
    force = _forces(bearing, bearing.turning * _SPEEDS, place)
    return min(_highest(one.reshape(*eps.shape, 2)) for one in force)


def _highest(force: Array) -> float:
    """Return the highest load before it first falls with eccentricity, of forces over ε and γ."""
    sideways = force[..., 1]
    # On the load line rotation drives the journal aside, at 90° the film holds it back.
    after = np.argmax(sideways < 0.0, axis=1)
    rows = np.arange(len(force))
    before = np.maximum(after - 1, 0)
    a, b = sideways[rows, before], sideways[rows, after]
    share = np.where(a > b, a / np.where(a > b, a - b, 1.0), 0.0)
    load = -(force[rows, before, 0] * (1.0 - share) + force[rows, after, 0] * share)
    falls = np.flatnonzero(np.diff(load) < 0.0)
    return float(load[falls[0] if falls.size else -1])


def _forces(bearing: Bearing, S: Array, place: Array) -> Array:
    """Return the film's force at places (n, 2) at each of some S (m,), (m, n, 2), in p_s R L."""
    restrictors, q = bearing.restrictors, bearing.size
    at, _, _ = bearing.table.at(place)
    G, gT = at.conductance, at.pumping.swapaxes(1, 2)
    pump, w = 12.0 * S[:, None, None], place @ _TURN.T
    pumped, own = pump * _times(at.pumping, w), q * np.eye(G.shape[-1])
    y = np.full(pumped.shape, restrictors.centred_flow)
    for _ in range(_MOST_STEPS):
        left = q * y - _times(G, restrictors.pressure(y)) + pumped
        step = _solved(own - G * restrictors.slope(y)[..., None, :], left)
        y = y - step
        if np.abs(step).max() < _SETTLED:
            return -_times(gT, restrictors.pressure(y)) - pump * _times(at.squeeze, w)
    raise RuntimeError(_NO_FLOWS)


def held(bearing: Bearing, S: Array, place: Array) -> tuple[Array, Balance]:
    """Return the film's force on journals held at places, and recesses and coefficients there.

    Parameters
    ----------
    bearing : Bearing
        The bearing.
    S : array, (n,)
        μΩ(R/C)²/p_s [-].
    place : array, (n, 2)
        The journals' centres, in C.

    Returns
    -------
    force : array, (n, 2)
        In p_s R L.
    balance : Balance
        With the flows of the recesses balanced.

    Raises
    ------
    RuntimeError
        Where no balance of the flows is found.
    """
    N = bearing.table.lands.recesses
    y = np.full((len(S), N), bearing.restrictors.centred_flow)
    for _ in range(_MOST_STEPS):
        left, J, _ = _balances(bearing, S, place, y)
        step = _solved(J[:, :N, :N], left[:, :N])
        y = y - step
        if np.abs(step).max(initial=0.0) < _SETTLED:
            return -left[:, N:], _answer(bearing, S, place, y)
    raise RuntimeError(_NO_FLOWS)


def balanced(bearing: Bearing, S: Array, load: Array) -> Balance:
    """Return the journals' equilibria.

    Parameters
    ----------
    bearing : Bearing
        The bearing.
    S : array, (n,)
        μΩ(R/C)²/p_s [-].
    load : array, (n,)
        F_o/(p_s R L) [-], at most `heaviest`.

    Returns
    -------
    Balance
        With stiffness and damping.

    Raises
    ------
    RuntimeError
        Where no equilibrium is found with a film thicker than `THINNEST`.
    """
    place, y, good = _settled(bearing, S, load, _beginning(bearing, S, load))
    if not good.all():
        bad = np.flatnonzero(~good)
        place[bad], y[bad] = _followed(bearing, S[bad], load[bad])
    if np.hypot(place[:, 0], place[:, 1]).max(initial=0.0) > 1.0 - THINNEST:
        raise RuntimeError("the film is thinner than the table reaches")
    # Without load the centre itself, not what rounding leaves of it.
    place[load == 0.0] = 0.0
    return _answer(bearing, S, place, y)


def _settled(
    bearing: Bearing, S: Array, load: Array, start: tuple[Array, Array]
) -> tuple[Array, Array, BoolArray]:
    """Return positions and flows by Newton's method, and whether they are in equilibrium."""
    place, y = start
    good = np.zeros(len(S), dtype=bool)
    for _ in range(_MOST_STEPS):
        left, J, _ = _balances(bearing, S, place, y)
        left[:, -2] -= load
        place, y, size = _stepped(place, y, _solved(J, left))
        good = size < _SETTLED
        if good.all():
            break
    return place, y, good


def _followed(bearing: Bearing, S: Array, load: Array) -> tuple[Array, Array]:
    """Return positions and flows in equilibrium, from a lighter load step by step."""
    start, good = _start(bearing, S, _SHARES[0] * load), np.zeros(len(S), dtype=bool)
    for share in _SHARES:
        place, y, good = _settled(bearing, S, share * load, start)
        start = place, y
    if not good.all():
        raise RuntimeError("no equilibrium of the journal found")
    return start


def _beginning(bearing: Bearing, S: Array, load: Array) -> tuple[Array, Array]:
    """Return positions and flows near the equilibria, under one load from those that are known."""
    path = _path(bearing, float(load[0])) if load.size and np.all(load == load[0]) else None
    if path is None:
        return _start(bearing, S, load)
    found = path(np.log(np.clip(S / bearing.turning, _KNOTS[0], _KNOTS[-1])))
    return found[:, :2], found[:, 2:]


@functools.lru_cache(maxsize=64)
def _path(bearing: Bearing, load: float) -> CubicSpline | None:
    """Return positions and flows under a load over ln of `_KNOTS`; None where some are missed."""
    S, W = bearing.turning * _KNOTS, np.full(len(_KNOTS), load)
    place, y, good = _settled(bearing, S, W, _start(bearing, S, W))
    if not good.all():
        return None
    return CubicSpline(np.log(_KNOTS), np.concatenate([place, y], axis=1))


def _start(bearing: Bearing, S: Array, load: Array) -> tuple[Array, Array]:
    """Return positions near the equilibria, the film a spring that rotation turns, and flows."""
    rest = np.interp(load, bearing.load, bearing.eccentricity)
    first = bearing.load[1] / bearing.eccentricity[1]
    spring = np.where(rest > 1e-6, load / np.maximum(rest, 1e-6), first)
    at, _, _ = bearing.table.at(np.stack([rest, 0.0 * rest], axis=-1))
    # Of a rigid film without recess pressures; the cross stiffness is half of its damping.
    cross = 6.0 * S * at.squeeze[:, 1, 1]
    z = load / (spring - 1j * cross)
    flow = np.full((len(S), bearing.table.lands.recesses), bearing.restrictors.centred_flow)
    return np.stack([z.real, z.imag], axis=-1), flow


def _balances(bearing: Bearing, S: Array, place: Array, y: Array) -> tuple[Array, Array, Influence]:
    """Return the balances of flow and the force against the load, (n, N + 2).

    And their derivatives by y and by the position, (n, N + 2, N + 2), and the lands' matrices.
    """
    (n, N), restrictors, q = y.shape, bearing.restrictors, bearing.size
    P, dP = restrictors.pressure(y), restrictors.slope(y)
    at, *along = bearing.table.at(place)
    G, g, D = at.conductance, at.pumping, at.squeeze
    pump, w = 12.0 * S[:, None], place @ _TURN.T
    left, J = np.empty((n, N + 2)), np.empty((n, N + 2, N + 2))
    left[:, :N] = q * y - _times(G, P) + pump * _times(g, w)
    left[:, N:] = _times(g.swapaxes(1, 2), P) + pump * _times(D, w)
    J[:, :N, :N] = q * np.eye(N) - G * dP[:, None, :]
    J[:, N:, :N] = g.swapaxes(1, 2) * dP[:, None, :]
    # By the position: through w, and through the matrices along x and y.
    J[:, :N, N:] = pump[..., None] * (g @ _TURN)
    J[:, N:, N:] = pump[..., None] * (D @ _TURN)
    for j, by in enumerate(along, start=N):
        J[:, :N, j] += pump * _times(by.pumping, w) - _times(by.conductance, P)
        J[:, N:, j] += pump * _times(by.squeeze, w) + _times(by.pumping.swapaxes(1, 2), P)
    return left, J, at


def _solved(matrix: Array, right: Array) -> Array:
    return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0], dtype=float)


def _times(matrix: Array, vector: Array) -> Array:
    return (matrix @ vector[..., None])[..., 0]


def _stepped(place: Array, y: Array, step: Array) -> tuple[Array, Array, Array]:
    """Return unknowns after a step, cut short where it crosses most of the film, and its size."""
    N = y.shape[1]
    moves = step[:, N:]
    room = 1.0 - np.hypot(place[:, 0], place[:, 1])
    size = np.hypot(moves[:, 0], moves[:, 1])
    share = np.minimum(1.0, _LONGEST * room / np.maximum(size, 1e-300))[:, None]
    place, y = place - share * moves, y - share * step[:, :N]
    far = np.hypot(place[:, 0], place[:, 1])
    place = place * np.minimum(1.0, (1.0 - _CLOSEST) / np.maximum(far, 1e-300))[:, None]
    return place, y, np.maximum(size, np.abs(step[:, :N]).max(axis=1))


def _answer(bearing: Bearing, S: Array, place: Array, y: Array) -> Balance:
    """Return the equilibria with stiffness and damping, flows balanced in every motion."""
    N = y.shape[1]
    _, J, at = _balances(bearing, S, place, y)
    moved = np.concatenate([J[:, :N, N:], 12.0 * at.pumping], axis=2)
    changed = J[:, N:, :N] @ np.linalg.solve(J[:, :N, :N], -moved)
    return Balance(
        position=place,
        pressure=bearing.restrictors.pressure(y),
        flow=bearing.size * y,
        stiffness=J[:, N:, N:] + changed[:, :, :2],
        damping=12.0 * at.squeeze + changed[:, :, 2:],
    )
