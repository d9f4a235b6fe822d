"""Reynolds' equation of a gas film on a simple elastic foundation, for many journals at once.

    ∂_β(p h³ p_β) + (D/L)² ∂_ζ(p h³ p_ζ) = Λ ∂_β(p h),   h = a + α max(p − 1, 0),

with the gap of the undeformed foil a = 1 − x cos β − y sin β in C, the pressure p in units of the
ambient one, the compressibility number Λ = 6μΩ/p_a·(R/C)² and the compliance α = p_a/(C k_f). The
foil is not pulled towards the journal: where the pressure is below ambient it stays, and carries
nothing (Heshmat, Walowit & Pinkus 1983).

Along the axis p h³ ∂p/∂ζ is ∂ψ/∂ζ at a given angle, with ψ = ∫ p h³ dp from the pressure at the
end: ambient, or, where the journal has entered the foil's own place, a < 0, that at which the foil
just gives way to it. ψ is smooth up to such an end, where the film closes.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotorcalc.arrays import Array
from rotorcalc.films.foil.bands import Band
from rotorcalc.films.foil.mesh import Mesh


@dataclass(frozen=True, eq=False)
class Films:
    """Gas films at P points, from trial pressures and positions.

    Attributes
    ----------
    mesh : Mesh
        The mesh.
    compliance : float
        α [-].
    number : array, (P,)
        Λ [-].
    position : array, (P, 2)
        x, y in C.
    pressure : array, (P, n, m)
        p in p_a inside the film.
    """

    mesh: Mesh
    compliance: float
    number: Array
    position: Array
    pressure: Array

    def at(self, number: Array) -> "Films":
        """Return the same pressures and positions at other Λ (P,)."""
        return Films(self.mesh, self.compliance, number, self.position, self.pressure)

    @cached_property
    def gap(self) -> Array:
        """Gap of the undeformed foil at all nodes, (P, n + 2)."""
        return gap(self.position, self.mesh.angle)

    @cached_property
    def rise(self) -> Array:
        """Pressure above ambient at all nodes, slit and end included, (P, n + 2, m + 1)."""
        P, n, m = self.pressure.shape
        found = np.zeros((P, n + 2, m + 1))
        found[:, 1:-1, :-1] = self.pressure - 1.0
        found[:, 1:-1, -1] = self.entry[:, 1:-1]
        return found

    @cached_property
    def entry(self) -> Array:
        """Pressure above ambient at which the foil gives way at the end, (P, n + 2)."""
        return np.maximum(-self.gap, 0.0) / self.compliance

    @cached_property
    def pressed(self) -> Array:
        """1 where the foil is pressed, else 0, (P, n + 2, m + 1)."""
        return (self.rise > 0.0).astype(float)

    @cached_property
    def wetted(self) -> Array:
        """Share of each node's cell around the bore where the foil is pressed, likewise.

        By the pressure's line from node to node: the edge of the pressed foil moves smoothly
        through the mesh, and so do stiffness and damping.
        """
        u = self.rise
        face = 0.5 * (u[:, 1:] + u[:, :-1])
        found = self.pressed.copy()
        found[:, 1:-1] = 0.5 * (
            _positive(u[:, 1:-1], face[:, 1:]) + _positive(u[:, 1:-1], face[:, :-1])
        )
        return found

    @cached_property
    def thickness(self) -> Array:
        """H in C at all nodes, (P, n + 2, m + 1)."""
        return self.gap[..., None] + self.compliance * np.maximum(self.rise, 0.0)

    @cached_property
    def _face(self) -> "_Faces":
        """The flow from each node to the next around the bore."""
        return _faces(self)

    @cached_property
    def residual(self) -> Array:
        """What flows out of each node's cell, (P, n, m)."""
        grid = self.mesh
        around = np.diff(self._face.flow, axis=1) * grid.weights[:-1]
        A = grid.slenderness * grid.step * grid.stiffness[:, :-1]
        return around + self._potential[0] @ A.T

    @cached_property
    def _potential(self) -> tuple[Array, Array]:
        """ψ and its derivative by a at the film's nodes, (P, n, m) each."""
        inside = np.s_[:, 1:-1, :-1]
        alpha = self.compliance * self.pressed[inside]
        a, u = self.gap[:, 1:-1, None], self.entry[:, 1:-1, None]
        return potential(a, self.rise[inside] - u, 1.0 + u, alpha)

    @property
    def along_potential(self) -> Array:
        """ψ at the film's nodes, (P, n, m)."""
        return self._potential[0]

    def jacobian(self, foil: complex | None = None) -> Band:
        """Return the derivatives of the residual by the pressures.

        Parameters
        ----------
        foil : complex, optional
            The compliance with which the foil answers a small whirl, where the derivatives are
            smooth in the position of the pressed part's end; None for the nodes' own.

        Returns
        -------
        Band
            For all P points.
        """
        face, w = self._face, self.mesh.weights[:-1]
        bent = self._bent(foil)
        left = (face.by_left + 0.5 * face.by_thickness * bent[:, :-1]) * w
        right = (face.by_right + 0.5 * face.by_thickness * bent[:, 1:]) * w
        here = left[:, 1:] - right[:, :-1]
        return Band(-left[:, 1:-1], here, right[:, 1:-1], self._along(foil))

    def _bent(self, foil: complex | None) -> NDArray[Any]:
        """Return the derivative of the thickness by the pressure, (P, n + 2, m)."""
        if foil is None:
            return self.compliance * self.pressed[..., :-1]
        return foil * self.wetted[..., :-1]

    def storage(self, foil: complex) -> NDArray[Any]:
        """Return the derivatives of 2Λ p h in each node's cell by the pressure, (P, n, m)."""
        p, h = self.pressure, self.thickness[:, 1:-1, :-1]
        return self._stored * (h + p * self._bent(foil)[:, 1:-1])

    @cached_property
    def storage_by_position(self) -> Array:
        """Derivatives of the same by x and y, (P, n, m, 2)."""
        normal = directions(self.mesh.angle)[1:-1, None, :]
        return -(self._stored * self.pressure)[..., None] * normal

    @property
    def _stored(self) -> Array:
        grid = self.mesh
        return 2.0 * grid.step * self.number[:, None, None] * grid.weights[:-1]

    def _along(self, foil: complex | None) -> NDArray[Any]:
        """Return the derivatives of the flow along the axis, (P, n, m, m)."""
        grid = self.mesh
        unit = grid.slenderness * grid.step
        h = self.thickness[:, 1:-1, :-1]
        conductance = self.pressure * h**3
        found = unit * grid.stiffness[:, :-1] * conductance[:, :, None, :]
        if foil is None:
            return found
        # ψ holds the foil's static answer; 3 p h² p_ζ is the flow by what the thickness differs.
        Q = self._potential[1]
        slope = Q @ grid.slopes[:, :-1].T
        other = (foil - self.compliance) * self.wetted[:, 1:-1]
        weak = grid.weights * grid.slopes.T[:-1]  # ∫ φ_i' …, lumped
        return found + unit * (weak * (slope * other)[:, :, None, :])[..., :-1]

    @cached_property
    def by_position(self) -> Array:
        """Derivatives of the residual by x and y, (P, n, m, 2)."""
        grid, face = self.mesh, self._face
        normal, middle = directions(grid.angle), directions(grid.faces)
        flow = -face.by_thickness[..., None] * middle[:, None, :]
        around = np.diff(flow, axis=1) * grid.weights[:-1, None]
        A = grid.slenderness * grid.step * grid.stiffness[:, :-1]
        along = self._potential[1] @ A.T
        return around - along[..., None] * normal[1:-1, None, :]

    @cached_property
    def load(self) -> Array:
        """∫∫ max(p − 1, 0) (cos, sin) dβ dζ over half the bearing, (P, 2): twice F/(p_a D L)."""
        return np.einsum("pnm,nmk->pk", np.maximum(self.rise[:, 1:-1], 0.0), self._normals)

    @cached_property
    def load_by_pressure(self) -> Array:
        """Derivatives of the load by the pressures, (P, n, m, 2)."""
        return self.pressed[:, 1:-1, :-1, None] * self._normals[:, :-1]

    @cached_property
    def load_in_whirl(self) -> Array:
        """The same in a small whirl, smooth where the foil's pressed part ends."""
        return self.wetted[:, 1:-1, :-1, None] * self._normals[:, :-1]

    def load_by_position(self, foil: complex | None = None) -> NDArray[Any]:
        """Return the derivatives of the load by x and y at given pressures, (P, 2, 2)."""
        yielding = self.compliance if foil is None else foil
        end = self.pressed[:, 1:-1, -1] / yielding * self.mesh.weights[-1] * self.mesh.step
        normal = directions(self.mesh.angle)[1:-1]
        return np.einsum("pn,nj,nk->pjk", end, normal, normal)

    @cached_property
    def _normals(self) -> Array:
        grid = self.mesh
        normal = directions(grid.angle)[1:-1, None, :]
        return grid.step * grid.weights[:, None] * normal

    @cached_property
    def least_thickness(self) -> Array:
        """Thinnest film in the middle plane, (P,)."""
        return self.thickness[:, 1:-1, 0].min(axis=1)


def _positive(one: Array, other: Array) -> Array:
    """Return the share of a line from one value to another that is above zero."""
    size = np.abs(one) + np.abs(other)
    above = np.maximum(one, 0.0) + np.maximum(other, 0.0)
    return np.divide(above, size, out=np.zeros_like(size), where=size > 0.0)


@dataclass(frozen=True, eq=False)
class _Faces:
    """Flow −p h³ p_β + Λ p h between neighbouring nodes, (P, n + 1, m), and its derivatives."""

    flow: Array
    by_left: Array
    by_right: Array
    by_thickness: Array


def _faces(found: Films) -> _Faces:
    grid = found.mesh
    u = found.rise[..., :-1]
    p = 1.0 + 0.5 * (u[:, 1:] + u[:, :-1])
    bent = 0.5 * found.compliance * np.maximum(u, 0.0)
    h = gap(found.position, grid.faces)[..., None] + bent[:, 1:] + bent[:, :-1]
    slope = (u[:, 1:] - u[:, :-1]) / grid.step
    number = found.number[:, None, None]
    square = h * h
    carried = h * (number - square * slope)
    pushed = p * square * h / grid.step
    return _Faces(
        flow=p * carried,
        by_left=0.5 * carried + pushed,
        by_right=0.5 * carried - pushed,
        by_thickness=p * (number - 3.0 * square * slope),
    )


def potential(a: Array, v: Array, p: Array, alpha: Array | float) -> tuple[Array, Array]:
    """Return ψ = ∫ (p + v)(a + αv)³ dv from 0 to v, and 3 ∫ (p + v)(a + αv)² dv, where a > 0.

    Parameters
    ----------
    a : array, (...)
        Gap at the lower end of the integral, in C: below zero it is zero.
    v : array, (...)
        Pressure above that at the lower end, in p_a.
    p : array, (...)
        Pressure at the lower end, in p_a.
    alpha : array, (...)
        α, or 0 where the foil does not move [-].
    """
    a = np.maximum(a, 0.0)
    b = alpha * v
    # Powers of a and b = αv: each integral is a polynomial in them times v.
    psi = v * (
        p * (a**3 + a * b * (1.5 * a + b) + 0.25 * b**3)
        + v * (0.5 * a**3 + a * b * (a + 0.75 * b) + 0.2 * b**3)
    )
    by_gap = (
        3.0
        * v
        * (p * (a * a + a * b + b * b / 3.0) + v * (0.5 * a * a + a * b * 2.0 / 3.0 + 0.25 * b * b))
    )
    return psi, by_gap


def directions(angle: Array) -> Array:
    """Return (cos, sin) of angles (k,), (k, 2)."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def gap(position: Array, angle: Array) -> Array:
    """Return the gap of the undeformed foil at angles (k,), (..., k), in C."""
    return 1.0 - position @ directions(angle).T
