"""What a solution of Reynolds' equation says besides its force: flow, drag, highest pressure."""

from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.finite.reynolds import Films, differences


@dataclass(frozen=True, eq=False)
class Peak:
    """The highest pressure at each position, (P,): its size, in μΩ(R/C)², and its angle Θ [rad]."""

    pressure: Array
    angle: Array


def side_flow(found: Films, p: Array) -> Array:
    """Return the oil that leaves at the ends of the lands, in ΩRLC.

    ((D/L)²/12) ∫ −h³ p_ζ dβ at either end of the bearing, and into a relief track.

    Parameters
    ----------
    found : Films
        The films at P positions.
    p : array, (P, N, nodes, m)
        Their pressures.

    Returns
    -------
    array, (P,)
        Side flow.
    """
    mesh = found.mesh
    slope = (p[:, :, None] * mesh.outflow).sum(axis=-1)  # −p_ζ at both ends together
    return mesh.slenderness / 24.0 * (found.cubes * slope).sum(axis=(1, 2, 3))


def drag(found: Films, p: Array) -> Array:
    """Return the torque on the journal, Σ ∫(1/h + ½h p_β) dβ over the pads, in μΩR³L/C.

    Shear over the whole pad, in the broken film too, and none in the grooves.

    Parameters
    ----------
    found : Films
        The films at P positions.
    p : array, (P, N, nodes, m)
        Their pressures.

    Returns
    -------
    array, (P,)
        Drag torque.
    """
    sixth = (found.width / 6.0)[:, :, None, :]
    shear = sixth * (1.0 / found.h_left + 4.0 / found.h_middle + 1.0 / found.h_right)
    total = (shear * _shares(found)[:, :, None]).sum(axis=(1, 2, 3))
    # The mean over ζ of the pressure's steps is half of their integral from −1 to 1.
    step = (differences(p)[:, :, None] * found.mesh.weights).sum(axis=-1) / 2.0
    return total + 0.5 * (found.h_middle * step).sum(axis=(1, 2, 3))


def _shares(found: Films) -> Array:
    """Return the share of the bearing's length that each zone of each pad takes, (N, zones)."""
    pads, zones = found.mesh.pads, found.mesh.weights.shape[1]
    shares = np.zeros((len(pads), zones))
    for i, pad in enumerate(pads):
        shares[i, 0] = 1.0 - pad.track_ratio
        if pad.depth > 0.0:
            shares[i] = pad.axial_ratio, 1.0 - pad.axial_ratio
    return shares


def peak(found: Films, p: Array) -> Peak:
    """Return the highest pressure, of a parabola through the highest node and its neighbours.

    Parameters
    ----------
    found : Films
        The films at P positions.
    p : array, (P, N, nodes, m)
        Their pressures, highest in the middle of the bearing or of a land.

    Returns
    -------
    Peak
        Of every position.
    """
    middle = np.pad(p[..., 0], ((0, 0), (0, 0), (1, 1)))
    flat = middle[:, :, 1:-1].reshape(len(p), -1).argmax(axis=1)
    pad, node = np.divmod(flat, p.shape[2])
    rows = np.arange(len(p))
    x0, x1, x2 = (found.beta[rows, pad, node + i] for i in (0, 1, 2))
    p0, p1, p2 = (middle[rows, pad, node + i] for i in (0, 1, 2))
    # p = p1 + b t + c t² about the highest node.
    left, right = (p1 - p0) / (x1 - x0), (p2 - p1) / (x2 - x1)
    c = (right - left) / (x2 - x0)
    b = left + c * (x1 - x0)
    with np.errstate(divide="ignore", invalid="ignore"):  # no pressure at all
        t = np.where(c < 0.0, np.clip(-b / (2.0 * c), x0 - x1, x2 - x1), 0.0)
    return Peak(p1 + b * t + c * t * t, x1 + t)
