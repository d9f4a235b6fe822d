"""The pressure of a gas film between its nodes along the axis.

ψ is a polynomial along the axis. The pressure is none towards an end where the foil gives way to
the journal and the film closes: there it goes as the fourth root of the distance.
"""

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.foil.reynolds import Films, potential

_STEPS, _SETTLED = 30, 1e-9


def rise_along(found: Films, zeta: Array) -> Array:
    """Return the pressure above ambient between the slit's sides, in p_a.

    Parameters
    ----------
    found : Films
        The films at P points.
    zeta : array, (k,)
        Places along half the bearing, 0 ≤ ζ ≤ 1.

    Returns
    -------
    array, (P, n, k)
        At the angles of the mesh.
    """
    psi = found.along_potential @ found.mesh.along(zeta)[:, :-1].T
    return rise_of(psi, found.gap[:, 1:-1, None], found.compliance)


def rise_of(psi: Array, a: Array, alpha: float) -> Array:
    """Return the pressure above ambient where ψ has values and the undeformed gap is a."""
    entry = np.maximum(-a, 0.0) / alpha
    # Below ambient the foil does not move: ψ = a³(u + ½u²).
    cubes = np.maximum(a, 0.0) ** 3 + 0.0 * psi
    share = np.divide(psi, cubes, out=np.zeros_like(psi), where=(psi < 0.0) & (cubes > 0.0))
    below = np.sqrt(np.maximum(1.0 + 2.0 * share, 0.0)) - 1.0
    return np.where(psi < 0.0, below, entry + _risen(psi, a, 1.0 + entry, alpha))


def _risen(psi: Array, a: Array, p: Array, alpha: float) -> Array:
    """Return the pressure above that at the end where ψ has values, zero where they are below 0."""
    goal, a = np.maximum(psi, 0.0), np.maximum(a, 0.0)
    # ψ grows ever faster: from above it Newton's method comes down to the root.
    v = np.minimum(goal / np.maximum(p * a**3, 1e-300), (4.0 * goal / (p * alpha**3)) ** 0.25)
    for _ in range(_STEPS):
        value, _ = potential(a, v, p, alpha)
        slope = (p + v) * (a + alpha * v) ** 3
        step = np.divide(value - goal, slope, out=np.zeros_like(v), where=slope > 0.0)
        v = v - step
        if np.all(np.abs(step) <= _SETTLED * (v + _SETTLED)):
            break
    return v
