"""Pressure and thickness of a gas film anywhere on the bearing."""

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.foil.along import rise_of
from rotorcalc.films.foil.reynolds import Films, gap


def rise_at(found: Films, angle: Array, zeta: Array) -> Array:
    """Return the pressure above ambient of one film at angles Θ and ζ = z/L (k,), in p_a."""
    grid = found.mesh
    turned = grid.angle[0] + np.mod(angle - grid.angle[0], 2.0 * np.pi)
    i = np.clip(((turned - grid.angle[0]) / grid.step).astype(int), 0, len(grid.angle) - 2)
    t = ((turned - grid.angle[i]) / grid.step)[:, None]
    psi = np.pad(found.along_potential[0], ((1, 1), (0, 1)))  # none at slit and ends
    line = (1.0 - t) * psi[i] + t * psi[i + 1]
    along = (grid.along(2.0 * zeta) * line).sum(axis=-1)
    return rise_of(along, gap(found.position, angle)[0], found.compliance)


def thickness_at(found: Films, angle: Array, rise: Array) -> Array:
    """Return the thickness where the pressure is above ambient by `rise`, in C; never below zero.

    The foil's deflection is included.
    """
    rigid = gap(found.position, angle)[0]
    return np.maximum(rigid + found.compliance * np.maximum(rise, 0.0), 0.0)
