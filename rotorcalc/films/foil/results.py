"""What a gas film says besides its force: drag, flow, highest pressure."""

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.foil.along import rise_along
from rotorcalc.films.foil.reynolds import Films

# Places along half the bearing at which the shear of the film is taken.
_PLACES = 8


def drag(found: Films) -> Array:
    """Return the torque on the journal, ∫∫ (1/h + 3 h p_β/Λ) dβ dζ, in μΩR³L/C, (P,).

    The film fills the whole bore. Where the foil touches the journal at the ends this is the film's
    shear up to there: dry friction is not known.
    """
    grid = found.mesh
    nodes, weights = np.polynomial.legendre.leggauss(_PLACES)
    rise = rise_along(found, 0.5 * (nodes + 1.0))
    h = found.gap[:, 1:-1, None] + found.compliance * np.maximum(rise, 0.0)
    shear = (1.0 / h) @ (0.5 * weights)
    # The slit is a node of half a cell on each of its sides, at ambient pressure.
    slit = grid.step / found.gap[:, 0]
    between = 0.5 * (found.thickness[:, 1:] + found.thickness[:, :-1])
    pressed = np.einsum("pnm,m->p", between * np.diff(found.rise, axis=1), grid.weights)
    return grid.step * shear.sum(axis=1) + slit + 3.0 * pressed / found.number


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
