"""A second program for recessed bearings: uniform grid, whole bearing, sparse LU, differences.

Written for the tests alone, in other variables than the package's: both halves of the bearing, the
Couette flow as such, forces by summing the pressure, stiffness and damping as differences of them.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import root
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu


@dataclass(frozen=True)
class Recessed:
    """A bearing: N recesses, lands, L/D, restrictors, and the grid's cells around and along."""

    recesses: int
    land_ratio: float
    land_angle: float
    slenderness: float
    pressure_ratio: float
    orifice: bool
    around: int
    along: int

    @property
    def angle(self):
        return 2.0 * np.pi / self.around * np.arange(self.around)

    @cached_property
    def numbers(self):
        """Unknown of each node: recesses first, then lands; −1 at the ends."""
        zeta = np.linspace(-1.0, 1.0, self.along + 1)
        pitch = 2.0 * np.pi / self.recesses
        from_middle = np.abs((self.angle + 0.5 * pitch) % pitch - 0.5 * pitch)
        over = from_middle <= 0.5 * (pitch - self.land_angle) + 1e-9
        inside = np.abs(zeta) <= 1.0 - 2.0 * self.land_ratio + 1e-9
        recess = over[:, None] & inside
        which = np.rint(self.angle / pitch).astype(int) % self.recesses
        found = np.where(recess, which[:, None], -2)
        found[:, [0, -1]] = -1
        land = found == -2
        found[land] = self.recesses + np.arange(np.count_nonzero(land))
        return found

    def operator(self, place):
        """Conductances between all unknowns, and to the ends."""
        db, dz, u = 2.0 * np.pi / self.around, 2.0 / self.along, self.numbers
        h = lambda b: 1.0 - place[0] * np.cos(b) - place[1] * np.sin(b)  # noqa: E731
        share = np.full(self.along + 1, dz)
        share[[0, -1]] = 0.5 * dz
        links = [
            (u, np.roll(u, -1, axis=0), h(self.angle + 0.5 * db)[:, None] ** 3 * share / db),
            (u[:, :-1], u[:, 1:], np.broadcast_to(
                self.slenderness * h(self.angle)[:, None] ** 3 * db / dz, u[:, 1:].shape)),
        ]  # fmt: skip
        size = u.max() + 1
        a, b, c = (np.concatenate([one[k].ravel() for one in links]) for k in range(3))
        differ = a != b
        a, b, c = a[differ], b[differ], c[differ]
        both = (a >= 0) & (b >= 0)
        ends = np.zeros(size)
        for mine, other in ((a, b), (b, a)):
            np.add.at(ends, mine[(mine >= 0) & (other < 0)], c[(mine >= 0) & (other < 0)])
        rows = np.concatenate([a[both], b[both], a[both], b[both], np.arange(size)])
        columns = np.concatenate([b[both], a[both], a[both], b[both], np.arange(size)])
        values = np.concatenate([-c[both], -c[both], c[both], c[both], ends])
        return coo_matrix((values, (rows, columns)), shape=(size, size)).tocsc(), ends

    def summed(self, values):
        """Sum nodal values (around,) times area over each unknown's nodes."""
        db, dz, u = 2.0 * np.pi / self.around, 2.0 / self.along, self.numbers
        every = np.broadcast_to(values[:, None], u.shape)
        return np.bincount(u[u >= 0], every[u >= 0], minlength=u.max() + 1) * db * dz

    def solved(self, place, velocity, number):
        """Return force in p_s R L, recess pressures, flows through restrictors and to the ends."""
        N, beta, (x, y) = self.recesses, self.angle, place
        db = 2.0 * np.pi / self.around
        edge = beta - 0.5 * db
        h_edge = 1.0 - x * np.cos(edge) - y * np.sin(edge)
        couette = 6.0 * (np.roll(h_edge, -1) - h_edge) / db
        squeeze = -12.0 * (velocity[0] * np.cos(beta) + velocity[1] * np.sin(beta))
        source = -number * self.summed(couette + squeeze)
        A, ends = self.operator(place)
        lu, to_recess = splu(A[N:, N:]), A[N:, :N].toarray()
        own = lu.solve(source[N:])
        unit = lu.solve(-to_recess)

        def left(P):
            """Flow in less flow out of each recess."""
            p = np.concatenate([P, own + unit @ P])
            return self.restricted(P) - (A @ p - source)[:N]

        P = root(left, np.full(N, self.pressure_ratio), tol=1e-12).x
        p = np.concatenate([P, own + unit @ P])
        force = [-0.5 * p @ self.summed(f(beta)) for f in (np.cos, np.sin)]
        return np.array(force), P, self.restricted(P), float(ends @ p)

    def restricted(self, P):
        beta, G = self.pressure_ratio, self._centred
        if self.orifice:
            return G * beta / np.sqrt(1.0 - beta) * np.sign(1.0 - P) * np.sqrt(np.abs(1.0 - P))
        return G * beta / (1.0 - beta) * (1.0 - P)

    @cached_property
    def _centred(self):
        """Outflow of one recess in the centre at rest with all at unit pressure."""
        N = self.recesses
        A, ends = self.operator((0.0, 0.0))
        p = np.concatenate([np.ones(N), splu(A[N:, N:]).solve(-A[N:, :N] @ np.ones(N))])
        return float(ends @ p) / N


def results(make, place, number):
    """Return force, stiffness, damping and flow for vanishing cells, by two grids of a factor 2."""
    rough, fine = (_on(make(factor), np.asarray(place), number) for factor in (1, 2))
    return [b + (b - a) / 3.0 for a, b in zip(rough, fine, strict=True)]


def _on(one, place, number, step=1e-4):
    axes, still = step * np.eye(2), np.zeros(2)
    f, _, supplied, leaving = one.solved(place, still, number)

    def force(dx, dv):
        return one.solved(place + dx, dv, number)[0]

    K = [(force(-d, still) - force(d, still)) / (2.0 * step) for d in axes]
    C = [(f - force(still, d)) / (step * number) for d in axes]  # it is nearly linear in velocity
    assert abs(supplied.sum() - leaving) < 1e-9 * leaving
    return f, np.array(K).T, np.array(C).T, np.array(leaving)
