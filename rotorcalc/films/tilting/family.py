"""The films of one tilting pad in equilibrium: a family of one coordinate, made once for its shape.

In the pad's frame, its pivot at angle 0, the journal's centre lies at (ξ, η) from the pad's centre
of curvature, in C: ξ towards the pivot, η in the sense of rotation, and

    h/C = 1 − ξ cos θ − η sin θ.

A tilt of the pad moves η alone. Without friction and mass the force passes through the pivot,
F_η(ξ, η) = 0, which leaves one film for each ξ. Of two roots the one with the greater η is stable:
there the pad returns, K_ηη > 0. The family begins where the two meet, ξ_0; a pad further from the
journal carries nothing. With its pivot in the middle ξ_0 = 0, and the force begins as √ξ. With the
pivot behind the middle ξ_0 < 0, and it begins with a force.

Along the directions γ of (ξ, η) from the pivot there is one film each. Splines go over
u = √ln((1 − ξ_0)/(1 − ξ)), in which the beginning is smooth and thin films are spread.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline, PPoly

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.finite.fronts import coefficients
from rotorcalc.films.finite.results import drag, peak, side_flow
from rotorcalc.films.finite.reynolds import Films, Mesh, Solution, films, mesh, solved, stiffness
from rotorcalc.films.finite.sweeps import settled_pressures
from rotorcalc.films.finite.table import carried
from rotorcalc.films.pads import Pad, gap, outline

# The thinnest film of the family, and the lowest ξ, in C.
THINNEST, _LOWEST = 0.03, -2.0
# Cells around the pad and pressures along half of it, first and last, and films of the family.
_ROUGH, _FINE, _DRAFT = (24, 2), (80, 3, 40), (48, 2, 24)
# Directions of the rough search, and shares of the way to the wall.
_LEAST_ANGLE, _DIRECTIONS = 0.04, 48
_SHARES = np.array(
    [1e-3, 0.01, 0.03, 0.1, 0.25, 0.4, 0.55, 0.7, 0.8, 0.87, 0.92, 0.95, 0.97, 0.98, 0.99]
)
# The first direction's distance from that of no film, over that; where a beginning counts as 0.
_BESIDE, _AT_CENTRE = 1e-3, -5e-4
# Films beyond the beginning, by which it is found, and the least step in direction after it [rad].
_OVER, _APART = 4, 5e-3
# Newton's method ends at a step below the tolerance, of which the square is left.
_SCAN_SWEEPS, _MOST_STEPS, _TOLERANCE, _SETTLED = 4, 12, 1e-6, 1e-4
# Values grow about as the film's thickness at the pivot to these powers.
_POWERS = np.array([0.0, -1.75, *4 * [-2.75], *3 * [-1.75], -0.5, 0.0, -1.75, 0.0, 1.0])
COLUMNS = len(_POWERS)


@dataclass(frozen=True, eq=False)
class PadStates:
    """Films of pads, each in its pad's frame, in units of the film; leading shape (...).

    Attributes
    ----------
    xi, eta : array, (...)
        The journal's centre from the pad's centre of curvature, in C.
    force : array, (...)
        Towards the pad's pivot, −F_ξ, in μΩRL³/C².
    stiffness, damping : array, (..., 2, 2)
        In ξ, η.
    drag, side_flow, peak_pressure, peak_angle, thinnest : array, (...)
        As of a whole film; the angle from the pivot [rad].
    loaded : boolean array, (...)
        Whether the film carries anything; where it does not, all but drag and thickness are 0.
    """

    xi: Array
    eta: Array
    force: Array
    stiffness: Array
    damping: Array
    drag: Array
    side_flow: Array
    peak_pressure: Array
    peak_angle: Array
    thinnest: Array
    loaded: BoolArray


def states(xi: Array, values: Array, loaded: BoolArray) -> PadStates:
    """Return films at ξ (...) from their values in `columns`, (..., COLUMNS)."""
    return PadStates(
        xi=xi,
        eta=values[..., 0],
        force=values[..., 1],
        stiffness=values[..., 2:6].reshape(*xi.shape, 2, 2),
        damping=values[..., [6, 7, 7, 8]].reshape(*xi.shape, 2, 2),
        drag=values[..., 9],
        side_flow=values[..., 10],
        peak_pressure=values[..., 11],
        peak_angle=values[..., 12],
        thinnest=values[..., 13],
        loaded=loaded,
    )


@dataclass(frozen=True, eq=False)
class PadFamily:
    """The films of one pad in equilibrium over ξ.

    Attributes
    ----------
    mesh : Mesh
        The pad's mesh.
    first, last : float
        ξ at which the pad begins to carry, and of its thinnest film.
    xi : array, (n,)
        ξ of the films that were solved, rising.
    wet : boolean array, (n, 1, nodes, m)
        Where these are full.
    """

    mesh: Mesh
    first: float
    last: float
    xi: Array
    wet: BoolArray
    _spline: CubicSpline

    def at(self, xi: Array, *, carries: BoolArray | bool = True) -> PadStates:
        """Return the films at ξ (...), up to `last`; where they may not carry, without load."""
        loaded = (xi > self.first) & carries
        inside = np.clip(xi, self.first, self.last)
        values = self._spline(self._u(inside)) * (1.0 - inside)[..., None] ** _POWERS
        values *= loaded[..., None]
        eta = np.where(loaded, values[..., 0], self._dropped(xi))
        values[..., 0] = eta
        free = ~loaded
        if free.any():
            values[free, 9], values[free, 13] = self._without_film(xi[free], eta[free])
        return states(xi, values, loaded)

    def force(self, xi: Array) -> tuple[Array, Array]:
        """Return the force towards the pivot at ξ (...), and its derivative by ξ."""
        inside = np.clip(xi, self.first, self.last)
        u, room = self._u(inside), 1.0 - inside
        value, slope = np.moveaxis(self._force(u), -1, 0)
        power = room ** _POWERS[1]
        # dξ = 2u (1 − ξ) du
        rate = power / room * (slope / np.maximum(2.0 * u, 1e-9) - _POWERS[1] * value)
        loaded = xi > self.first
        return power * value * loaded, rate * loaded

    @functools.cached_property
    def _force(self) -> PPoly:
        """The force's column alone over u, and its derivative."""
        alone = self._spline.c[..., 1]
        derivative = np.concatenate([0.0 * alone[:1], alone[:-1] * [[3.0], [2.0], [1.0]]])
        return PPoly.construct_fast(np.stack([alone, derivative], axis=-1), self._spline.x)

    def _u(self, xi: Array) -> Array:
        return np.sqrt(np.log1p((xi - self.first) / (1.0 - xi)))

    def _dropped(self, xi: Array) -> Array:
        """Return η of a pad without load, whose film opens in the sense of rotation all over it."""
        return np.minimum(xi, 0.0) * math.tan(min(self.mesh.pads[0].end, 1.5))

    def _without_film(self, xi: Array, eta: Array) -> tuple[Array, Array]:
        """Return drag and thinnest film of pads without pressure."""
        pads = self.mesh.pads
        e = np.stack(np.broadcast_arrays(xi, eta), axis=-1)
        return film_drag(pads[0], e), gap(pads, e)


def film_drag(pad: Pad, e: Array) -> Array:
    """Return the drag of a pad without pressure at places (..., 2), in μΩR³L/C."""
    theta = np.linspace(pad.start, pad.end, 33)
    h = 1.0 - e[..., :1] * np.cos(theta) - e[..., 1:] * np.sin(theta)
    return np.asarray(np.trapezoid(1.0 / np.maximum(h, 1e-6), theta))


def generic_pad(arc: float, pivot_offset: float) -> Pad:
    """Return a pad with its pivot at angle 0."""
    return Pad(-pivot_offset * arc, (1.0 - pivot_offset) * arc)


@dataclass(frozen=True, eq=False)
class _Branch:
    """Films with F_η = 0 by falling direction γ [rad], their e, in C, and active sets."""

    gamma: Array
    e: Array
    wet: BoolArray

    def taken(self, which: BoolArray | slice) -> "_Branch":
        return _Branch(self.gamma[which], self.e[which], self.wet[which])


@functools.lru_cache(maxsize=256)
def family(arc: float, pivot_offset: float, slenderness: float, *, coarse: bool) -> PadFamily:
    """Return the films of a pad in equilibrium.

    Parameters
    ----------
    arc : float
        Angle of the pad [rad].
    pivot_offset : float
        Its pivot's place from the leading edge, over the arc [-].
    slenderness : float
        (D/L)² [-].
    coarse : bool
        Whether on a coarse mesh, for drafts.

    Returns
    -------
    PadFamily
        In units of the film.
    """
    pad = generic_pad(arc, pivot_offset)
    links, degrees, count = _DRAFT if coarse else _FINE
    rough = mesh((pad,), slenderness, *_ROUGH)
    fine = mesh((pad,), slenderness, links, degrees)
    start = _rough_branch(rough, count)
    return _made(
        fine, _begun(fine, _on_branch(fine, start.gamma, start.e, carried(start.wet, fine)))
    )


def _rough_branch(rough: Mesh, count: int) -> _Branch:
    """Return directions γ and distances e of films about evenly spaced in u, and their sets."""
    gamma0 = _first_direction(rough)
    gamma = np.linspace(_LEAST_ANGLE, gamma0 * (1.0 - _BESIDE), _DIRECTIONS)
    wall = outline(rough.pads, gamma)
    reach = np.minimum(np.hypot(wall[:, 0], wall[:, 1]), _LOWEST / np.minimum(np.cos(gamma), -1e-9))
    e = _SHARES[:, None] * reach
    turning, wet = _turning(rough, e, np.broadcast_to(gamma, e.shape))
    # At each direction the force passes behind the pivot near the wall, before it near the centre.
    rises = (turning[:-1] > 0.0) & (turning[1:] <= 0.0)
    has = rises.any(axis=0)
    last = len(rises) - 1 - rises[::-1].argmax(axis=0)
    row, column = last[has], np.flatnonzero(has)
    low, high = turning[row, column], turning[row + 1, column]
    t = low / (low - high)
    at = (1.0 - t) * e[row, column] + t * e[row + 1, column]
    return _evenly(rough, _Branch(gamma[has], at, wet[row, column]), count)


def _evenly(rough: Mesh, found: _Branch, count: int) -> _Branch:
    """Return a branch at directions that are about even in u, and some beyond its beginning."""
    gamma, e = found.gamma, found.e
    position = np.stack([e * np.cos(gamma), e * np.sin(gamma)], axis=-1)
    xi, film = position[:, 0], gap(rough.pads, position)
    start = int(np.argmin(xi))
    order = np.arange(start, -1, -1)
    u = np.sqrt(np.maximum.accumulate(np.log((1.0 - xi[start]) / (1.0 - xi[order]))))
    end = float(np.interp(-THINNEST, -np.minimum.accumulate(film[order]), u))
    evenly = np.interp(np.linspace(0.0, end, count), u, gamma[order])
    directions = np.concatenate([gamma[start + 1 : start + 1 + _OVER][::-1], evenly])
    nearest = np.abs(directions[:, None] - gamma).argmin(axis=1)
    return _Branch(directions, np.interp(directions, gamma, e), found.wet[nearest])


def _first_direction(rough: Mesh) -> float:
    """Return the direction in which the film vanishes, its force passing through the pivot."""
    gamma = np.linspace(_LEAST_ANGLE, math.pi, 4 * _DIRECTIONS)
    turning, _ = _turning(rough, np.full_like(gamma, _SHARES[0])[None], gamma[None])
    first = int(np.argmax(turning[0] < 0.0))  # thinnest far behind, it is too late
    a, b = turning[0, first - 1 : first + 1]
    return float(gamma[first - 1] + a / (a - b) * (gamma[first] - gamma[first - 1]))


def _turning(rough: Mesh, e: Array, gamma: Array) -> tuple[Array, BoolArray]:
    """Return F_η of films at distances and directions (...), and their active sets."""
    position = np.stack([e * np.cos(gamma), e * np.sin(gamma)], axis=-1)
    found = films(rough, position.reshape(-1, 2))
    full = np.ones((e.size, *rough.shape), dtype=bool)
    at = settled_pressures(found, full, sweeps=_SCAN_SWEEPS)
    return at.force[:, 1].reshape(e.shape), at.next_wet.reshape(*e.shape, *rough.shape)


def _on_branch(fine: Mesh, gamma: Array, e: Array, wet: BoolArray) -> _Branch:
    """Return where F_η = 0 in directions γ, by Newton's method along them."""
    n = np.stack([np.cos(gamma), np.sin(gamma)], axis=-1)
    e, wet, step = e.copy(), wet.copy(), np.full_like(e, np.inf)
    rows = np.arange(len(e))
    for _ in range(_MOST_STEPS):
        position = e[rows, None] * n[rows]
        found = films(fine, position)
        at = solved(found, wet[rows])
        slope = -(stiffness(found, at)[:, 1] * n[rows]).sum(axis=-1)
        longest = 0.5 * np.minimum(e[rows], gap(fine.pads, position))
        # Without any film there is no way to one.
        step[rows] = np.where(slope < 0.0, -at.force[:, 1] / np.minimum(slope, -1e-300), np.nan)
        e[rows] += np.nan_to_num(np.clip(step[rows], -longest, longest))
        after = at.next_wet
        moves = (after != wet[rows]).any(axis=(1, 2, 3)) | (np.abs(step[rows]) > _TOLERANCE)
        wet[rows] = after
        rows = rows[moves]
        if not rows.size:
            break
    good = np.abs(step) <= _SETTLED * e
    return _Branch(gamma[good], e[good], wet[good])


def _begun(fine: Mesh, found: _Branch) -> _Branch:
    """Return a branch from where it begins: where ξ is least, stable and unstable films meet."""
    xi = found.e * np.cos(found.gamma)
    start = int(np.argmin(xi))
    if start == 0 or xi[start] > _AT_CENTRE:
        return found.taken(slice(start, None))
    along, distance = (CubicSpline(-found.gamma, values) for values in (xi, found.e))
    turns = np.asarray(along.derivative().roots(extrapolate=False))
    turn = turns[np.abs(turns + found.gamma[start]).argmin()]
    first = _on_branch(fine, -turn[None], distance(turn[None]), found.wet[start : start + 1])
    if not first.e.size:
        return found.taken(slice(start, None))
    rest = found.taken(found.gamma < first.gamma[0] - _APART)
    return _Branch(
        np.append(first.gamma, rest.gamma), np.append(first.e, rest.e),
        np.concatenate([first.wet, rest.wet]),
    )  # fmt: skip


def _made(fine: Mesh, found: _Branch) -> PadFamily:
    """Return splines through the films of a branch."""
    position = np.stack([np.cos(found.gamma), np.sin(found.gamma)], axis=-1) * found.e[:, None]
    over = films(fine, position)
    at = settled_pressures(over, found.wet)
    values, xi = columns(over, at), position[:, 0]
    values /= (1.0 - xi)[:, None] ** _POWERS
    first = float(xi[0])
    if first > _AT_CENTRE:  # it begins without a force, at the centre
        first = min(first - 1e-6, 0.0)
        values = np.concatenate([_without_load(values[:3], np.sqrt(xi[:3] - first)), values])
    u = np.sqrt(np.log1p((xi - first) / (1.0 - xi)))
    u = np.append(0.0, u) if len(values) > len(u) else u
    return PadFamily(fine, first, float(xi[-1]), xi, at.wet, CubicSpline(u, values))


def _without_load(values: Array, u: Array) -> Array:
    """Return the row at u = 0 of a family that begins without a force, from its first three."""
    row = np.linalg.solve(np.vander(u, increasing=True).T, [1.0, 0.0, 0.0]) @ values
    row[[0, 1, 10, 11]] = 0.0  # η, force, flow and pressure
    return row[None]


def columns(over: Films, at: Solution) -> Array:
    """Return what `PadStates` holds of solutions, in film units, (P, columns)."""
    film = over.mesh.slenderness / 4.0  # from μΩR³L/C² and its like
    K, C = coefficients(over, at)
    highest = peak(over, at.pressure)
    thinnest = gap(over.mesh.pads, over.relative[:, 0])
    return np.column_stack([
        over.relative[:, 0, 1], -film * at.force[:, 0], film * K.reshape(-1, 4),
        film * C[:, [0, 0, 1], [0, 1, 1]], drag(over, at.pressure),
        side_flow(over, at.pressure), film * highest.pressure, highest.angle, thinnest,
    ])  # fmt: skip
