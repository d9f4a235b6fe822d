"""Newton's method for pressures and position of many gas films at once."""

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.foil.bands import solved
from rotorcalc.films.foil.reynolds import Films, gap

# Share of a pressure and of a thickness that a step leaves at least.
_KEEP = 0.3
# Largest change of a pressure, in p_a, and of the position, in C, in a step.
_LONGEST = 0.5


def newton_step(found: Films, load: Array) -> tuple[Array, Array]:
    """Return the changes of pressure (P, n, m) and position (P, 2) towards a load (P, 2)."""
    P = len(found.number)
    right = np.concatenate([found.residual[..., None], found.by_position], axis=-1)
    answer = solved(found.jacobian(), right)
    G = found.load_by_pressure.reshape(P, -1, 2)
    answers = np.swapaxes(G, 1, 2) @ answer.reshape(P, -1, 3)
    # p changes by −J⁻¹(r + B δ), and the load must become the one given.
    left: Array = found.load_by_position() - answers[..., 1:]
    short = (load - found.load + answers[..., 0])[..., None]
    change = np.asarray(np.linalg.solve(left, short)[..., 0], dtype=np.float64)
    pressure: Array = -answer[..., 0] - (answer[..., 1:] @ change[:, None, :, None])[..., 0]
    return pressure, change


def stepped(found: Films, pressure: Array, position: Array) -> tuple[Films, Array]:
    """Return the films after a step, shortened where it would empty them, and its shares (P,)."""
    share = _LONGEST / np.maximum(
        _LONGEST, np.maximum(np.abs(pressure).max(axis=(1, 2)), np.abs(position).max(axis=1))
    )
    lost = np.maximum(-pressure / (1.0 - _KEEP) / found.pressure, 0.0).max(axis=(1, 2))
    h = found.thickness[:, 1:-1, :-1]
    thinner = -gap(position, found.mesh.angle)[:, 1:-1, None] + 1.0
    thinner = thinner - found.compliance * found.pressed[:, 1:-1, :-1] * pressure
    gone = np.maximum(thinner / (1.0 - _KEEP) / h, 0.0).max(axis=(1, 2))
    share = np.minimum(share, 1.0 / np.maximum(1.0, np.maximum(lost, gone)))
    return (
        Films(
            found.mesh,
            found.compliance,
            found.number,
            found.position + share[:, None] * position,
            found.pressure + share[:, None, None] * pressure,
        ),
        share,
    )
