"""Thickness, pressure, flow and drag of the short bearing's film (Eqs. 5.19 and 5.25)."""

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, real_array
from rotorcalc.films.short.static import below_one, checked_eccentricity


def film_thickness(eps: ArrayLike, theta: ArrayLike) -> Array:
    """Return the film's thickness, H = 1 + ε cos θ (Eq. 5.19).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-].
    theta : array_like, (...)
        Angle from the thickest film in the sense of rotation, θ [rad].

    Returns
    -------
    array, (...)
        Film thickness, H = h/C [-].

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1].
    """
    return 1.0 + checked_eccentricity(eps) * np.cos(real_array("theta", theta))


def pressure(eps: ArrayLike, theta: ArrayLike, zeta: ArrayLike = 0.0) -> Array:
    """Return the film's pressure above ambient in static equilibrium (Eq. 5.25).

    p = 3ε sin θ/H³·(1/4 − ζ²) over 0 ≤ θ ≤ π; the cavitated half is at ambient pressure.

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.
    theta : array_like, (...)
        Angle from the thickest film in the sense of rotation, θ [rad].
    zeta : array_like, (...)
        Axial position from the bearing's middle, ζ = z/L [-], −1/2 ≤ ζ ≤ 1/2.

    Returns
    -------
    array, (...)
        Pressure, p in μΩ(L/C)².

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1) or ζ outside the bearing.
    """
    eps, _ = below_one(eps)
    theta = real_array("theta", theta)
    zeta = real_array("zeta", zeta)
    if not np.all(np.abs(zeta) <= 0.5):
        raise ValueError("zeta = z/L: must lie within the bearing, -0.5 to 0.5")
    H = film_thickness(eps, theta)
    # Half Sommerfeld (Gümbel) condition: ambient pressure where the film diverges, θ > π.
    wedge = np.maximum(np.sin(theta), 0.0)
    return 3.0 * eps * wedge / H**3 * (0.25 - zeta**2)


def peak_position(eps: ArrayLike) -> Array:
    """Return where the pressure is highest: cos θ = −6ε/(1 + √(1+24ε²)).

    Source: Eq. 5.25 with ∂p/∂θ = 0, H cos θ + 3ε sin²θ = 0.

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε ≤ 1.

    Returns
    -------
    array, (...)
        Angle from the thickest film in the sense of rotation, θ [rad], from π/2 at ε = 0 to π.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1].
    """
    eps = checked_eccentricity(eps)
    # 2ε cos²θ − cos θ − 3ε = 0; the other root exceeds 1. Rationalised, so that ε = 0 gives π/2.
    return np.arccos(-6.0 * eps / (1.0 + np.sqrt(1.0 + 24.0 * eps**2)))


def peak_pressure(eps: ArrayLike) -> Array:
    """Return the highest pressure of the film above ambient, in its middle plane (Eq. 5.25).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (...)
        Pressure, p in μΩ(L/C)².

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    return pressure(eps, peak_position(eps))


def side_flow(eps: ArrayLike) -> Array:
    """Return the oil that leaves at both ends together: ε, in ΩRLC.

    A flow of ½ΩRL·C(1+ε) enters the converging film at θ = 0, ½ΩRL·C(1−ε) leaves it at θ = π; the
    difference leaves at the two ends. Source: continuity with the flow of Eq. 5.22.

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε ≤ 1.

    Returns
    -------
    array, (...)
        Side flow in ΩRLC.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1].
    """
    return checked_eccentricity(eps)


@checked
def drag(eps: ArrayLike, *, length_to_radius: float) -> Array:
    """Return the film's torque on the journal: 2π/s + ½ε f_t (L/R)², in μΩR³L/C.

    The first term is the shear of Couette flow over the whole circumference; the second, half the
    couple of the load, ½e·F_o sin φ, is the dissipation of the axial pressure flow. Torque times
    speed is the whole power that the film dissipates.

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.
    length_to_radius : float
        Length over radius, L/R [-].

    Returns
    -------
    array, (...)
        Drag torque in μΩR³L/C.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = below_one(eps)
    s = np.sqrt(s2)
    # ∫ dθ/H over the full circumference.
    shear = 2.0 * np.pi / s
    # f_t of Eq. 5.5; e·F_t is in CΩμRL³/C² = (L/R)² of the unit of torque.
    couple = 0.5 * eps * (np.pi * eps / (4.0 * s2 * s))
    return shear + couple * length_to_radius**2
