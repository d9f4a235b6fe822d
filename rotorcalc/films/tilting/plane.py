"""The film of one pad at every place of the journal over it: a table made once for its shape.

At rest a pad's film depends on the journal's place over the pad alone, e = (ξ, η). A flexure's
stiffness, the preload, the load and the number of pads only decide at which place the journal
stands. So force, stiffness, damping and the rest are tabulated over the plane, for the pad's arc
and L/D; the pivot's place on the pad turns the frame.

In polar coordinates from the pad's centre of curvature, γ from the pad's middle, the film converges
on some part of the pad for −a < γ < π + a, with the half arc a; elsewhere it opens all over the pad
and carries nothing. Over the distance the coordinate is τ = atanh s, e = s + (E − 1)s³, with E(γ)
at the wall: each step towards it thins the film by one factor. Divided by the powers that they
follow towards the wall, the centre and both ends of γ, all values change slowly, and cubic
splines join them. Damping is tabulated as its Cholesky factor, C = L Lᵀ: between places too it
takes energy.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import NdBSpline, make_interp_spline

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.finite.reynolds import Films, films, mesh, solved
from rotorcalc.films.finite.table import carried
from rotorcalc.films.pads import Pad, gap
from rotorcalc.films.tilting.family import COLUMNS, columns, film_drag

# Cells around the pad and pressures along half of it, places between centre and wall, directions.
_ROUGH, _FINE, _DRAFT = (24, 2), (80, 3, 26, 60), (48, 2, 18, 40)
# The first place and the farthest, over the way to the wall.
_NEAREST, _FARTHEST = 1e-3, 0.985
# Where the first active set ends behind the thinnest film, as the sine of the angle from it.
_BROKEN = -0.2
_MOST_SWEEPS = 40
_DEGREE = 3
# What is tabulated: F_ξ, F_η, K, L, then drag, side flow, highest pressure and its angle.
_FORCES, _ALL = 9, 13
# The powers that these follow: of 1 − s² towards the wall, of s at the centre, and of the distance
# from either end of the directions, where the film is a wedge at one edge of the pad.
_WALL = np.array([*2 * [-1.5], *4 * [-2.5], *3 * [-1.25], -0.5, 0.0, -2.0, 0.0])
_CENTRE = np.array([*2 * [1.0], *7 * [0.0], 0.0, 1.0, 1.0, 0.0])
_END = np.array([*2 * [4.0], *4 * [3.0], *3 * [1.5], 0.0, 3.0, 2.0, 0.0])
# E(γ) is 1/c for the cosine c beside the pad, where the journal touches the pad's edge; behind it
# some places away it stays about 4: smoothly the larger of c and ¼ in the denominator.
_BEHIND, _SOFT = 0.25, 0.125
_OVER = 1.0 + _BEHIND + math.hypot(1.0 - _BEHIND, _SOFT)
_LEAST = 1e-9
_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class PadShape:
    """What the films of a pad depend on: its arc [rad], and (D/L)² [-]."""

    arc: float
    slenderness: float

    def distance(self, share: Array, gamma: Array) -> Array:
        """Return e = s + (E − 1)s³ at shares s of the way to the wall, and directions."""
        return share + self._more(gamma) * share**3

    def share(self, e: Array, gamma: Array) -> Array:
        """Return s at distances and directions."""
        root = np.sqrt(3.0 * np.maximum(self._more(gamma), _LEAST))
        return 2.0 / root * np.sinh(np.arcsinh(1.5 * e * root) / 3.0)

    def _more(self, gamma: Array) -> Array:
        """Return E(γ) − 1; E is 1 over the pad."""
        away = np.abs(np.mod(gamma + math.pi, _TURN) - math.pi) - 0.5 * self.arc
        over = np.cos(np.maximum(away, 0.0)) - _BEHIND
        return _OVER / (over + 2.0 * _BEHIND + np.hypot(over, _SOFT)) - 1.0


@dataclass(frozen=True, eq=False)
class PadPlane:
    """The films of a pad over the plane, its frame turned into that of a pivot.

    Attributes
    ----------
    shape : PadShape
        The pad's shape.
    turned : float
        Angle from the pivot to the pad's middle [rad].
    """

    shape: PadShape
    turned: float
    _forces: NdBSpline
    _others: NdBSpline

    def forces(self, e: Array) -> tuple[Array, Array, Array]:
        """Return force (..., 2), K and C (..., 2, 2) at places (..., 2) in the pivot's frame."""
        values = self._at(self._forces, e, slice(0, _FORCES))
        return self._in_pivots_frame(values)

    def columns(self, e: Array) -> tuple[Array, BoolArray]:
        """Return what `family.columns` does, (..., columns), and where there is a film (...)."""
        F, K, C = self.forces(e)
        others = self._at(self._others, e, slice(_FORCES, _ALL))
        loaded = self._place(e)[2]
        pad = self.pad
        dry = film_drag(pad, e)
        out = np.empty((*e.shape[:-1], COLUMNS))
        out[..., 0], out[..., 1] = e[..., 1], -F[..., 0]
        out[..., 2:6] = K.reshape(*e.shape[:-1], 4)
        out[..., 6], out[..., 7], out[..., 8] = C[..., 0, 0], C[..., 0, 1], C[..., 1, 1]
        out[..., 9] = np.where(loaded, others[..., 0], dry)
        out[..., 10:12] = others[..., 1:3]
        out[..., 12] = others[..., 3] + self.turned
        out[..., 13] = gap((pad,), e)
        return out, loaded

    @property
    def pad(self) -> Pad:
        """The pad, its pivot at angle 0."""
        half = 0.5 * self.shape.arc
        return Pad(self.turned - half, self.turned + half)

    def turned_to(self, pivot_offset: float) -> "PadPlane":
        """Return the same films with the pivot at an offset from the pad's leading edge."""
        turned = (0.5 - pivot_offset) * self.shape.arc
        return PadPlane(self.shape, turned, self._forces, self._others)

    def _place(self, e: Array) -> tuple[Array, Array, BoolArray]:
        """Return s and γ of places, and where the film converges on some part of the pad."""
        half = 0.5 * self.shape.arc
        gamma = np.arctan2(e[..., 1], e[..., 0]) - self.turned + half
        gamma = gamma - _TURN * np.floor(gamma / _TURN) - half
        r = np.hypot(e[..., 0], e[..., 1])
        s = np.minimum(self.shape.share(r, gamma), _FARTHEST)
        return s, gamma, (gamma < math.pi + half) & (r > 0.0)

    def _at(self, spline: NdBSpline, e: Array, which: slice) -> Array:
        s, gamma, loaded = self._place(e)
        half = 0.5 * self.shape.arc
        inside = np.minimum(gamma, math.pi + half)
        values = spline(np.stack([np.arctanh(np.maximum(s, _NEAREST)), inside], axis=-1))
        values *= _growth(self.shape, s, inside, which)
        return values * loaded[..., None]

    def _in_pivots_frame(self, values: Array) -> tuple[Array, Array, Array]:
        cos, sin = math.cos(self.turned), math.sin(self.turned)
        T = np.array([[cos, -sin], [sin, cos]])  # from the middle's frame to the pivot's
        K = values[..., 2:6].reshape(*values.shape[:-1], 2, 2)
        L = np.zeros_like(K)
        L[..., 0, 0], L[..., 1, 0], L[..., 1, 1] = np.moveaxis(values[..., 6:9], -1, 0)
        turned = T @ L
        return values[..., :2] @ T.T, T @ K @ T.T, turned @ np.swapaxes(turned, -1, -2)


def _growth(shape: PadShape, s: Array, gamma: Array, which: slice) -> Array:
    """Return the powers that the values follow, (..., columns)."""
    half = 0.5 * shape.arc
    end = np.sin(math.pi * (gamma + half) / (math.pi + shape.arc))
    of = 1.0 - s * s, np.maximum(s, _LEAST), np.maximum(end, _LEAST)
    wall, centre, ends = (np.log(one)[..., None] for one in of)
    return np.exp(wall * _WALL[which] + centre * _CENTRE[which] + ends * _END[which])


@functools.lru_cache(maxsize=32)
def plane(arc: float, slenderness: float, *, coarse: bool) -> PadPlane:
    """Return the films of a pad, in the frame of its middle; made once for its shape.

    Parameters
    ----------
    arc : float
        Angle of the pad [rad].
    slenderness : float
        (D/L)² [-].
    coarse : bool
        Whether on a coarse mesh, for drafts.

    Returns
    -------
    PadPlane
        In units of the film.
    """
    links, degrees, places, directions = _DRAFT if coarse else _FINE
    shape = PadShape(arc, slenderness)
    half = 0.5 * arc
    tau = np.linspace(0.0, math.atanh(_FARTHEST), places)
    s = np.maximum(np.tanh(tau), _NEAREST)[:, None]
    gamma = np.linspace(-half, math.pi + half, directions + 2)[1:-1]
    s, gamma = np.broadcast_arrays(s, gamma)
    values = _solved(shape, s.ravel(), gamma.ravel(), (links, degrees)).reshape(*s.shape, _ALL)
    values = values / _growth(shape, s, gamma, slice(0, _ALL))
    along = make_interp_spline(np.arctanh(s[:, 0]), values, _DEGREE)
    across = make_interp_spline(gamma[0], along.c, _DEGREE, axis=1)
    knots, c = (along.t, across.t), np.moveaxis(across.c, 0, 1)
    return PadPlane(
        shape, 0.0,
        NdBSpline(knots, np.ascontiguousarray(c[..., :_FORCES]), _DEGREE),
        NdBSpline(knots, np.ascontiguousarray(c[..., _FORCES:]), _DEGREE),
    )  # fmt: skip


def _solved(shape: PadShape, s: Array, gamma: Array, resolution: tuple[int, int]) -> Array:
    """Return the values of films at places (P,), (P, _ALL), each settled on its mesh."""
    half = 0.5 * shape.arc
    pad = Pad(-half, half)
    e = shape.distance(s, gamma)
    place = np.stack([e * np.cos(gamma), e * np.sin(gamma)], axis=-1)
    rough, fine = (mesh((pad,), shape.slenderness, *n) for n in (_ROUGH, resolution))
    over = films(rough, place)
    ahead = np.sin(gamma[:, None, None, None] - over.beta[:, :, 1:-1, None])
    wet = _full(over, np.broadcast_to(ahead > _BROKEN, (len(s), *rough.shape)))
    over = films(fine, place)
    at = solved(over, _full(over, carried(wet, fine)), adjoint=False)
    found = columns(over, at)
    film = shape.slenderness / 4.0
    c_xx, c_xy, c_yy = found[:, 6:9].T
    first = np.sqrt(c_xx)
    second = c_xy / first
    third = np.sqrt(np.maximum(c_yy - second**2, 0.0))
    return np.column_stack([
        film * at.force, found[:, 2:6], first, second, third, found[:, 9:13]
    ])  # fmt: skip


def _full(found: Films, guess: BoolArray) -> BoolArray:
    """Return where films are full, by corrections of those alone that still change."""
    wet, active = guess.copy(), np.arange(len(guess))
    for _ in range(_MOST_SWEEPS):
        after = solved(found.taken(active), wet[active], adjoint=False).next_wet
        changed = (after != wet[active]).any(axis=(1, 2, 3))
        wet[active] = after
        active = active[changed]
        if not active.size:
            break
    return wet
