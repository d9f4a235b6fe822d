"""What a gas film says besides its force: drag, flow, highest pressure."""

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.foil.reynolds import Films, potential

# Places along half the bearing at which the shear of the film is taken, and steps to find them.
_PLACES, _STEPS = 8, 30


def drag(found: Films) -> Array:
    """Return the torque on the journal, ∫∫ (1/h + 3 h p_β/Λ) dβ dζ, in μΩR³L/C, (P,).

    The film fills the whole bore. Where the foil touches the journal at the ends this is the film's
    shear up to there: dry friction is not known.
    """
    grid = found.mesh
    nodes, weights = np.polynomial.legendre.leggauss(_PLACES)
    shear = (1.0 / thickness_along(found, 0.5 * (nodes + 1.0))) @ (0.5 * weights)
    # The slit is a node of half a cell on each of its sides, at ambient pressure.
    slit = grid.step / found.gap[:, 0]
    between = 0.5 * (found.thickness[:, 1:] + found.thickness[:, :-1])
    pressed = np.einsum("pnm,m->p", between * np.diff(found.rise, axis=1), grid.weights)
    return grid.step * shear.sum(axis=1) + slit + 3.0 * pressed / found.number


def thickness_along(found: Films, zeta: Array) -> Array:
    """Return the thickness at places 0 ≤ ζ ≤ 1 (k,) between the slit's sides, (P, n, k), in C.

    ψ is a polynomial along the axis; towards a closed end the thickness is no such thing.
    """
    psi = found.along_potential @ found.mesh.along(zeta)[:, :-1].T
    a = found.gap[:, 1:-1, None] + 0.0 * psi
    below = psi < 0.0
    if not below.all():
        p = 1.0 + found.entry[:, 1:-1, None]
        v = _risen(psi, np.maximum(a, 0.0), p, found.compliance)
        a = np.where(below, a, np.maximum(a, 0.0) + found.compliance * v)
    return a


def _risen(psi: Array, a: Array, p: Array, alpha: float) -> Array:
    """Return the pressure above that at the end where ψ has values, zero where they are below 0."""
    goal = np.maximum(psi, 0.0)
    # ψ grows ever faster: from above it Newton's method comes down to the root.
    v = np.minimum(goal / np.maximum(p * a**3, 1e-300), (4.0 * goal / (p * alpha**3)) ** 0.25)
    for _ in range(_STEPS):
        value, _ = potential(a, v, p, alpha)
        slope = (p + v) * (a + alpha * v) ** 3
        step = np.divide(value - goal, slope, out=np.zeros_like(v), where=slope > 0.0)
        v = v - step
        if np.all(np.abs(step) <= 1e-9 * (v + 1e-9)):
            break
    return v


def side_flow(found: Films) -> Array:
    """Return the gas that leaves at both ends, less what enters there, in ΩRLC, (P,).

    ½ (D/L)²/Λ ∫ −∂ψ/∂ζ dβ at the end: a volume at ambient density. The slit supplies it.
    """
    grid = found.mesh
    leaving = found.along_potential @ grid.outflow[:-1]
    return 0.5 * grid.slenderness / found.number * grid.step * leaving.sum(axis=1)


def peak(found: Films) -> tuple[Array, Array]:
    """Return the highest pressure above ambient, in p_a, and its angle Θ [rad], (P,) each.

    Of a parabola through the highest node of the middle plane and its neighbours.
    """
    u = found.rise[..., 0]
    top = 1 + u[:, 1:-1].argmax(axis=1)
    rows = np.arange(len(u))
    below, here, above = (u[rows, top + i] for i in (-1, 0, 1))
    bend = below - 2.0 * here + above
    with np.errstate(divide="ignore", invalid="ignore"):
        shift = np.where(bend < 0.0, np.clip(0.5 * (below - above) / bend, -0.5, 0.5), 0.0)
    angle = found.mesh.angle[top] + shift * found.mesh.step
    return here - 0.25 * (below - above) * shift, angle
