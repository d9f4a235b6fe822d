"""A second, plain program for gas films, which shares nothing with the package's.

Finite volumes on an even grid of half the bearing: pressures at angles between the slit's sides and
in the middles of cells along the axis. The flow between two cells is that of p² with the mean
thickness. All derivatives are those of a step in the complex plane, the equations are solved by
sparse factors, and the loads along X and Y are balanced by Newton's method with them.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import splu

TINY = 1e-40


@dataclass(frozen=True)
class Gas:
    """One film: D/L, α, Λ, the slit's angle, and cells around and along half the bearing."""

    ratio: float
    compliance: float
    number: float
    slit: float = np.pi
    around: int = 120
    along: int = 16

    @property
    def beta(self):
        return self.slit + 2 * np.pi * np.arange(1, self.around) / self.around

    def rigid(self, q, beta):
        return (1.0 - q[0] * np.cos(beta) - q[1] * np.sin(beta))[:, None]

    def bent(self, p):
        """Return the foil's deflection under pressures."""
        return self.compliance * np.where(p.real > 1.0, p - 1.0, 0.0)

    def outflow(self, p, d, q):
        """Return what leaves each cell, (n, m), under pressures p and deflections d."""
        step, width = 2 * np.pi / self.around, 1.0 / self.along
        h = self.rigid(q, self.beta) + d
        slit = self.rigid(q, np.array([self.slit])) + np.zeros(self.along)
        P = np.concatenate([np.ones((1, self.along)), p, np.ones((1, self.along))])
        H = np.concatenate([slit, h, slit])
        mean, square = 0.5 * (H[1:] + H[:-1]), 0.5 * P**2
        carried = 0.5 * self.number * (P[1:] * H[1:] + P[:-1] * H[:-1])
        around = carried - mean**3 * np.diff(square, axis=0) / step
        cubes = (0.5 * (h[:, 1:] + h[:, :-1])) ** 3
        along = -cubes * np.diff(0.5 * p**2, axis=1) / width
        # At the end half a cell is left, there the pressure is ambient; the foil is as in the cell.
        end = h[:, -1:] ** 3 * (0.5 * p[:, -1:] ** 2 - 0.5) / (0.5 * width)
        zero = np.zeros((len(p), 1))
        along = np.concatenate([zero, along, end], axis=1)
        return np.diff(around, axis=0) * width + self.ratio**2 * step * np.diff(along, axis=1)

    def stored(self, p, d, q):
        cell = 2 * np.pi / self.around / self.along
        return 2.0 * self.number * cell * p * (self.rigid(q, self.beta) + d)

    def load(self, p):
        cell = 2 * np.pi / self.around / self.along
        over = np.where(p.real > 1.0, p - 1.0, 0.0).sum(axis=1) * cell
        return np.array([over @ np.cos(self.beta), over @ np.sin(self.beta)])

    def drag(self, p, q):
        """Return ∫∫(1/h + 3 h p_β/Λ) over half the bearing, in μΩR³L/C."""
        h = self.rigid(q, self.beta) + self.bent(p)
        slit = self.rigid(q, np.array([self.slit])) + np.zeros(self.along)
        H, P = np.concatenate([slit, h, slit]), np.pad(p, ((1, 1), (0, 0)), constant_values=1.0)
        shear = 2 * np.pi / self.around * (1.0 / H[1:]).sum()
        pressed = (0.5 * (H[1:] + H[:-1]) * np.diff(P, axis=0)).sum()
        return (shear + 3.0 * pressed / self.number) / self.along

    def side_flow(self, p, q):
        """Return the volume at ambient density that leaves at both ends, in ΩRLC."""
        h = self.rigid(q, self.beta)[:, 0] + self.bent(p)[:, -1]
        slope = h**3 * (0.5 * p[:, -1] ** 2 - 0.5) * 2.0 * self.along
        return 0.5 * self.ratio**2 / self.number * 2 * np.pi / self.around * slope.sum()

    def by_cells(self, function, values):
        """Return the derivatives of a function of the cells' values, each of few neighbours."""
        n, m = values.shape
        i, j = np.indices((n, m))
        rows, columns, entries = [], [], []
        for a in range(3):
            for b in range(3):
                some = (i % 3 == a) & (j % 3 == b)
                slope = function(values + 1j * TINY * some).imag / TINY
                # Each cell belongs to the one changed cell among itself and its neighbours.
                owner_i, owner_j = i + (a - i + 1) % 3 - 1, j + (b - j + 1) % 3 - 1
                inside = (owner_i >= 0) & (owner_i < n) & (owner_j >= 0) & (owner_j < m)
                rows.append((i * m + j)[inside])
                columns.append((owner_i * m + owner_j)[inside])
                entries.append(slope[inside])
        every = [np.concatenate(each) for each in (entries, rows, columns)]
        return coo_matrix((every[0], (every[1], every[2])), shape=(n * m, n * m)).tocsc()

    def by_position(self, function, q):
        return np.stack(
            [function(q + 1j * TINY * np.eye(2)[k]).imag.ravel() / TINY for k in (0, 1)], axis=-1
        )

    def settled(self, p, q, load):
        """Return pressures and position that carry a load F/(p_a D L), from near ones."""
        for _ in range(60):
            r = self.outflow(p, self.bent(p), q).ravel()
            factors = splu(self.by_cells(lambda v, q=q: self.outflow(v, self.bent(v), q), p))
            B = self.by_position(lambda v, p=p: self.outflow(p, self.bent(p), v), q)
            G = self.weights(p)
            first, each = factors.solve(r), factors.solve(B)
            dq = np.linalg.solve(-G @ each, [2 * load, 0.0] - self.load(p) + G @ first)
            dp = (-first - each @ dq).reshape(p.shape)
            # No step leaves less than a third of a film.
            h = self.rigid(q, self.beta) + self.bent(p)
            thinner = 1.0 - self.rigid(dq, self.beta) - self.compliance * (p > 1.0) * dp
            most = max(np.abs(dp).max(), np.abs(dq).max())
            share = min(1.0, 0.4 / most, 1.0 / max((thinner / h).max() / 0.67, 1e-9))
            p, q = p + share * dp, q + share * dq
            if max(np.abs(dp).max(), np.abs(dq).max()) < 1e-9:
                return p, q
        raise RuntimeError("no equilibrium")

    def weights(self, p):
        """Return the derivatives of the load by the pressures, (2, n m)."""
        cell = 2 * np.pi / self.around / self.along
        pressed = (p.real > 1.0) * cell
        return np.stack([(pressed * f(self.beta)[:, None]).ravel() for f in (np.cos, np.sin)])

    def equilibrium(self, load, steps=1):
        """Return pressures and position at a load that is raised in steps."""
        p, q = np.full((self.around - 1, self.along), 1.0 + 1e-6), np.array([0.02, 0.05])
        for share in np.arange(1, steps + 1) / steps:
            p, q = self.settled(p, q, share * load)
        return p, q

    def impedance(self, p, q, nu, loss=0.0):
        """Return Z = K + iνC, in p_a R L/C."""
        foil = diags((self.compliance / (1 + 1j * loss) * (p > 1.0)).ravel())
        d = self.bent(p)
        J = sum(
            unit * (self.by_cells(lambda v, f=f: f(v, d, q), p)
                    + self.by_cells(lambda v, f=f: f(p, v, q), d) @ foil)
            for unit, f in ((1.0, self.outflow), (1j * nu, self.stored))
        )  # fmt: skip
        B = self.by_position(lambda v: self.outflow(p, d, v), q)
        B = B + 1j * nu * self.by_position(lambda v: self.stored(p, d, v), q)
        return self.weights(p) @ splu(J.tocsc()).solve(-B)
