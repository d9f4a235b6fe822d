"""The pressure over the pads of a bore at one position of the journal, at any place."""

from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.finite.reynolds import Films, Mesh, films
from rotorcalc.films.finite.sweeps import settled_pressures

_TURN = 2.0 * np.pi


@dataclass(frozen=True, eq=False)
class Pressures:
    """Pressures on the mesh of a bore at one position of the journal.

    Attributes
    ----------
    films : Films
        The films, P = 1.
    pressure : array, (N, nodes + 2, m)
        With the pads' edges, in μΩ(R/C)².
    """

    films: Films
    pressure: Array

    @classmethod
    def at_position(cls, mesh: Mesh, position: Array, wet: BoolArray) -> "Pressures":
        """Return the pressures at a position (2,), from an active set (N, nodes, m) near it."""
        found = films(mesh, position[None])
        p = settled_pressures(found, wet[None]).pressure[0]
        return cls(found, np.pad(p, ((0, 0), (1, 1), (0, 0))))

    def at(self, angle: Array, zeta: Array) -> tuple[Array, Array, BoolArray]:
        """Return thickness and pressure at places, (n,), and whether the film is broken there.

        Parameters
        ----------
        angle, zeta : array, (n,)
            Angle Θ from X [rad] and ζ = z/L [-].

        Returns
        -------
        thickness, pressure : array, (n,)
            In C, NaN beside the pads, and in μΩ(L/C)², zero there.
        cavitated : boolean array, (n,)
            False beside the pads.
        """
        thickness, pressure = np.full(angle.shape, np.nan), np.zeros(angle.shape)
        cavitated: BoolArray = np.zeros(angle.shape, dtype=bool)
        mesh = self.films.mesh
        for i, pad in enumerate(mesh.pads):
            from_start = np.mod(angle - pad.start, _TURN)
            on = (from_start <= pad.arc) & (2.0 * np.abs(zeta) >= pad.track_ratio)
            beta = from_start[on] + pad.start
            basis = mesh.bases[i].at(2.0 * zeta[on])
            nodes, p = self.films.beta[0, i], self.pressure[i]
            columns = np.empty_like(basis)
            for q in range(p.shape[1]):
                columns[:, q] = np.interp(beta, nodes, p[:, q])
            # Between the nodes a polynomial along the bearing may swing below zero at a front.
            found = np.maximum((basis * columns).sum(axis=-1), 0.0)
            e_x, e_y = self.films.relative[0, i]
            pocket = (beta < pad.step) & (2.0 * np.abs(zeta[on]) < pad.axial_ratio)
            h = 1.0 - e_x * np.cos(beta) - e_y * np.sin(beta)
            thickness[on] = h + np.where(pocket, pad.depth, 0.0)
            pressure[on] = found * mesh.slenderness / 4.0
            cavitated[on] = found <= 0.0
        return thickness, pressure, cavitated
