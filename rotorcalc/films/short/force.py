"""The short bearing's force at any position and velocity of the journal."""

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, real_array
from rotorcalc.frames import vector


def film_force(position: ArrayLike, velocity: ArrayLike) -> Array:
    """Return the nonlinear force of the film on the journal in X, Y.

    The film carries over the half circumference that the journal's rotation and motion together
    put under pressure. With x, y in C and ' = d/d(Ωt): A = x' + y/2, B = y' − x/2, the journal's
    velocity relative to half-speed whirl, and V = √(A² + B²). The half film is centred on the
    direction of (A, B); a is the journal's position along the edge of that half, 90° ahead, and b
    against (A, B). The force vanishes with V: at half-speed whirl about the centre.

    Parameters
    ----------
    position : array_like, (..., 2)
        Journal centre from the bearing's centre, (x, y) in C, inside the clearance circle.
    velocity : array_like, (..., 2)
        Its velocity, (x', y') in CΩ.

    Returns
    -------
    array, (..., 2)
        Force in μΩRL³/C².

    Raises
    ------
    ValueError
        Where the position lies outside the clearance circle, the velocity is not finite, or
        their shapes do not end with 2 or do not broadcast.

    Notes
    -----
    Source: Eq. 5.25 integrated over its positive half, 0 < z' < π, for any velocity; its value at
    rest is Eq. 5.5 and its derivatives are Eqs. 5.30 and 5.31.
    """
    x, y = np.moveaxis(real_array("position", position, ends=(2,)), -1, 0)
    dx, dy = np.moveaxis(real_array("velocity", velocity, ends=(2,)), -1, 0)
    try:
        x, y, dx, dy = np.broadcast_arrays(x, y, dx, dy)
    except ValueError as error:
        raise ValueError(
            f"velocity: has the leading shape {dx.shape}, which does not fit the positions' "
            f"{x.shape}; give one for each position"
        ) from error
    kappa2 = 1.0 - x**2 - y**2
    if not np.all(kappa2 > 0.0):
        raise ValueError("position: must lie inside the clearance circle, x² + y² < 1")
    # Reynolds' right-hand side at angle Θ is A cos Θ + B sin Θ, positive within 90° of (A, B).
    A, B = dx + y / 2.0, dy - x / 2.0
    V = np.hypot(A, B)
    if not np.all(np.isfinite(V)):
        raise ValueError("velocity: must be finite")
    still = V == 0.0  # any direction will do, as the factor V makes the force zero
    sin, cos = A / np.where(still, 1.0, V), -B / np.where(still, 1.0, V)
    a, b = x * cos + y * sin, -x * sin + y * cos
    kappa = np.sqrt(kappa2)
    G = 2.0 / kappa * np.arctan2(kappa, b)  # ∫ dz'/H over the half; arctan2 is π/2 − atan(b/κ)
    # 1 − a² = κ² + b² is positive inside the clearance circle, as a² + b² = x² + y² < 1.
    F_a = V / 2.0 * a * (3.0 * b * G - 4.0 - 2.0 * b**2 / (1.0 - a**2)) / kappa2**2
    F_b = V / 2.0 * (G / kappa2 + 3.0 * b * (b * G - 2.0) / kappa2**2)
    return vector(F_a * cos - F_b * sin, F_a * sin + F_b * cos)
