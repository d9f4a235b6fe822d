"""Stiffness, damping and added mass of the short bearing in closed form (Eqs. 5.30 to 5.37)."""

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array
from rotorcalc.films.short.static import attitude_angle, below_one, load_square
from rotorcalc.frames import matrix, rotate


def stiffness(eps: ArrayLike) -> Array:
    """Return the dimensionless stiffness k = K·C/F_o in X, Y (Eq. 5.35, k_YY corrected).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        k [-]. At ε = 0 the direct terms take their limits 4/π and 8/π, the others are infinite.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).

    Examples
    --------
    >>> stiffness(0.5).round(4)
    array([[ 2.9233,  3.9766],
           [-0.8577,  2.2099]])
    """
    eps, s2 = below_one(eps)
    return xy_stiffness(eps, s2, *_load_units(eps, s2))


def damping(eps: ArrayLike) -> Array:
    """Return the dimensionless damping c = C·ΩC/F_o in X, Y (Eq. 5.35, c_YY corrected).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        c [-]. At ε = 0 the cross terms take their limit 8/π, the direct ones are infinite.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = below_one(eps)
    return xy_damping(eps, s2, *_load_units(eps, s2))


def film_stiffness(eps: ArrayLike) -> Array:
    """Return the stiffness in X, Y in film units (Eq. 5.35, k_YY corrected).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        K in μΩRL³/C³. At ε = 0 only the cross terms remain, ±π/4 (Eq. 5.37).

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = below_one(eps)
    return xy_stiffness(eps, s2, *film_units(eps, s2))


def film_damping(eps: ArrayLike) -> Array:
    """Return the damping in X, Y in film units (Eq. 5.35, c_YY corrected).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        C in μRL³/C³. At ε = 0 only the direct terms remain, π/2 (Eq. 5.37).

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = below_one(eps)
    return xy_damping(eps, s2, *film_units(eps, s2))


def radial_stiffness(eps: ArrayLike) -> Array:
    """Return the stiffness in (r, t) in film units (Eq. 5.30).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        [[K_rr, K_rt], [K_tr, K_tt]] in μΩRL³/C³.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = below_one(eps)
    # −∂F/∂e gives K_rr, K_tr; the static force turns with the journal, K_rt = f_t/ε, K_tt = −f_r/ε.
    K_rr = 2.0 * eps * (1.0 + eps**2) / s2**3
    K_rt = np.pi / (4.0 * s2**1.5)
    K_tr = -np.pi * (1.0 + 2.0 * eps**2) / (4.0 * s2**2.5)
    K_tt = eps / s2**2
    return matrix(K_rr, K_rt, K_tr, K_tt)


def radial_damping(eps: ArrayLike) -> Array:
    """Return the damping in (r, t) in film units (Eq. 5.31).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        [[C_rr, C_rt], [C_tr, C_tt]] in μRL³/C³.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = below_one(eps)
    C_rr = np.pi * (1.0 + 2.0 * eps**2) / (2.0 * s2**2.5)
    # C_tr = C_rt: the force is the gradient of a dissipation function (see `motion`).
    C_rt = -2.0 * eps / s2**2
    C_tt = np.pi / (2.0 * s2**1.5)
    return matrix(C_rr, C_rt, C_rt, C_tt)


def added_mass(eps: ArrayLike) -> Array:
    """Return the film's added mass in X, Y: the integrals I_ij of temporal fluid inertia.

    I_rr = (π/ε²)(1/s − 1), I_tt = (π/ε²)(1 − s), I_rt = I_tr = 2/ε − ln((1+ε)/(1−ε))/ε².
    The added mass is M_ij = α_m ρRL³/(12C)·I_ij, with α_m = 6/5 at low Reynolds number and 1 in
    bulk flow. Source: temporal inertia of the film integrated over the full half film.

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        I_ij [-]; π/2 times the identity at ε = 0.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = below_one(eps)
    s = np.sqrt(s2)
    I_rr = np.pi / (s * (1.0 + s))  # (1/s − 1)/ε² with ε² = (1−s)(1+s), so no difference is lost
    I_tt = np.pi / (1.0 + s)
    # The integrals are in (r, t): turned by φ into X, Y (Eq. 5.16).
    return rotate(matrix(I_rr, _inertia_cross(eps), _inertia_cross(eps), I_tt), attitude_angle(eps))


def _load_units(eps: Array, s2: Array) -> tuple[Array, Array]:
    """Return f_r/ε and f_t/ε of Eq. 5.33, the factors of Eq. 5.35 for k and c of Eq. 5.32."""
    root = np.sqrt(load_square(eps, s2))
    with np.errstate(divide="ignore"):  # f_t → 1 in the centre, so f_t/ε is infinite there
        return 4.0 / root, np.pi * np.sqrt(s2) / (eps * root)


def film_units(eps: Array, s2: Array) -> tuple[Array, Array]:
    """Return the same factors times F_o, in film units: ε/s⁴ and π/(4s³)."""
    return eps / s2**2, np.pi / (4.0 * s2**1.5)


def xy_stiffness(eps: Array, s2: Array, radial: Array, tangential: Array) -> Array:
    """Return Eq. 5.35 for K, scaled by `radial` and `tangential`."""
    fr2, ft2 = _direction(eps, s2)
    k_r, k_t, along = radial / s2, tangential / s2, fr2 + 1.0 + 2.0 * eps**2
    # Each line is Eq. 5.30 turned by φ (Eq. 5.16), with f_r and f_t as cosine and sine of φ.
    K_XX = k_r * along
    K_XY = k_t * along
    # Changes sign at ε² = π/(4+π), ε = 0.663: below it the cross terms have opposite signs.
    K_YX = k_t * (fr2 - s2)
    K_YY = k_r * (ft2 + s2)  # the source prints f_r²
    return matrix(K_XX, K_XY, K_YX, K_YY)


def xy_damping(eps: Array, s2: Array, radial: Array, tangential: Array) -> Array:
    """Return Eq. 5.35 for C, scaled by `radial` and `tangential`."""
    fr2, ft2 = _direction(eps, s2)
    c_r, c_t, thicker = 2.0 * radial / s2, 2.0 * tangential / s2, 2.0 + eps**2
    # C_XY = C_YX, as C_rt = C_tr in Eq. 5.31: the film's damping is symmetric at every ε.
    across = thicker * ft2 - s2
    C_XX = c_t * (thicker * fr2 + s2)
    C_XY = c_r * across
    C_YY = c_t * across  # the source prints f_r²
    return matrix(C_XX, C_XY, C_XY, C_YY)


def _direction(eps: Array, s2: Array) -> tuple[Array, Array]:
    """Return cos²φ and sin²φ, the squares of f_r and f_t of Eq. 5.33."""
    load2 = load_square(eps, s2)
    return 16.0 * eps**2 / load2, np.pi**2 * s2 / load2


def _inertia_cross(eps: Array) -> Array:
    """Return I_rt = 2/ε − ln((1+ε)/(1−ε))/ε², by its series −2Σ ε^(2n−1)/(2n+1) for small ε."""
    # Seven terms leave 2ε¹⁵/17, 1e-16 at ε = 0.1; there the closed form loses 2.5 digits.
    n = np.arange(1, 8)
    small = -2.0 * np.sum(eps[..., None] ** (2 * n - 1) / (2 * n + 1), axis=-1)
    safe = np.where(eps < 0.1, 0.5, eps)  # any ε at which the unused branch does not divide by zero
    closed = 2.0 / safe - 2.0 * np.arctanh(safe) / safe**2
    return np.where(eps < 0.1, small, closed)
