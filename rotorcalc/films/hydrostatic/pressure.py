"""The pressure over lands and recesses of journals in equilibrium."""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from rotorcalc.arrays import Array
from rotorcalc.films.hydrostatic.influence import solutions
from rotorcalc.films.hydrostatic.mesh import Cells, Lands, Mesh, mesh

_TURN = 2.0 * np.pi
# The meshes on which the pressure is shown, and searched for its highest and lowest.
SHOWN, _SEARCHED = Cells(16, 12, 8, 8), Cells(8, 6, 4, 4)
# Positions solved in one call.
_AT_ONCE = 64


@dataclass(frozen=True, eq=False)
class Extremes:
    """Highest and lowest pressure of n journals, (n,), in p_s, and the angle of the highest [rad].

    The lowest is at most the ambient pressure at the ends, 0.
    """

    highest: Array
    angle: Array
    lowest: Array


class Around(Protocol):
    """Journals at positions (n, 2), in C, and the recess pressures around them (n, N), in p_s."""

    @property
    def position(self) -> Array: ...  # noqa: D102
    @property
    def pressure(self) -> Array: ...  # noqa: D102


class At(NamedTuple):
    """The same of journals that need not be in equilibrium."""

    position: Array
    pressure: Array


def nodal(grid: Mesh, found: Around, S: Array, velocity: Array | float = 0.0) -> Array:
    """Return the pressure at the nodes of a mesh, (n, angles, places), in p_s.

    Of journals at rest, or at velocities (n, 2), in CΩ.
    """
    solved = solutions(grid, found.position)
    x, y = found.position[:, 0], found.position[:, 1]
    # Rotation acts as the velocity (y, −x)/2.
    motion = 12.0 * S[:, None] * (velocity + 0.5 * np.stack([y, -x], axis=-1))
    by = np.concatenate([motion, found.pressure], axis=1)
    lands = (solved @ by[..., None])[..., 0]
    # In recess k, −1 on the lands, and numbered past the unknowns in a recess.
    padded = np.concatenate([lands, np.zeros((len(S), 1))], axis=1)
    return np.where(grid.is_land, padded[:, grid.unknown], found.pressure[:, grid.recess])


def extremes(lands: Lands, found: Around, S: Array, velocity: Array | float = 0.0) -> Extremes:
    """Return the highest and the lowest pressure of journals in equilibrium, or in motion.

    Parameters
    ----------
    lands : Lands
        The lands.
    found : Balance or At
        The journals.
    S : array, (n,)
        μΩ(R/C)²/p_s [-].
    velocity : array, (n, 2)
        Of the journals, in CΩ; zero at rest.

    Returns
    -------
    Extremes
        Of the pressures at the nodes of a mesh, to about 1 %.
    """
    grid = mesh(lands, _SEARCHED)
    count, moving = len(S), np.broadcast_to(velocity, (len(S), 2))
    highest, angle, lowest = np.empty(count), np.empty(count), np.empty(count)
    for i in range(0, count, _AT_ONCE):
        some = slice(i, i + _AT_ONCE)
        one = At(found.position[some], found.pressure[some])
        p = nodal(grid, one, S[some], moving[some]).reshape(len(one.position), -1)
        at = p.argmax(axis=1)
        highest[some] = p[np.arange(len(p)), at]
        angle[some] = _angle(grid, at)
        lowest[some] = np.minimum(p.min(axis=1), 0.0)
    return Extremes(highest, angle, lowest)


def _angle(grid: Mesh, node: Array) -> Array:
    """Return the angles of nodes by their numbers, of one in a recess that of its middle [rad]."""
    row, column = np.divmod(node, grid.recess.shape[1])
    recess = grid.recess[row, column]
    middle = _TURN / grid.lands.recesses * recess
    return np.where(recess < 0, grid.beta[row], middle)


def field(grid: Mesh, pressure: Array, angle: Array, zeta: Array) -> Array:
    """Return the pressure at places (n,), between nodal values of one journal, in its unit.

    Parameters
    ----------
    grid : Mesh
        The mesh.
    pressure : array, (angles, places)
        At its nodes; ambient, 0, at the end.
    angle, zeta : array, (n,)
        Angle Θ from X [rad] and ζ = z/L [-].

    Returns
    -------
    array, (n,)
        Linear between nodes in either direction.
    """
    closed = np.pad(pressure, ((0, 1), (0, 1)))
    closed[-1] = closed[0]
    start = grid.beta[0]
    around = np.append(grid.beta, start + _TURN)
    at = np.stack([start + np.mod(angle - start, _TURN), 2.0 * np.abs(zeta)], axis=-1)
    return np.asarray(RegularGridInterpolator((around, grid.zeta), closed)(at))
