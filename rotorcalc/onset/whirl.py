"""The whirl threshold of a rotor on given film coefficients, and the record of an onset.

Model: the film's linear force coefficients about static equilibrium; a symmetric rotor. At the
threshold one mode whirls undamped, at the whirl ratio ω̄ = ω_s/Ω_s times the running speed.

Source: San Andrés, Notes 5, Eqs. 5.41 to 5.50.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, real_array
from rotorcalc.display import Result

# How an onset was found, from the most accurate and fastest method on.
Method: TypeAlias = Literal[
    "closed form", "polynomial", "extended precision", "eigenvalues", "film"
]

# A film's drive of a whirl over k_eq² below which it is rounding: about (1e-14)².
_ROUNDING = 1e-28


@dataclass(frozen=True, eq=False)
class WhirlOnset(Result):
    """The threshold of whirl at one equilibrium, dimensionless, each of shape (...).

    Attributes
    ----------
    equivalent_stiffness : array
        k_eq = K_eq·C/F_o [-] (Eq. 5.45).
    whirl_ratio : array
        ω̄ = ω_s/Ω_s [-] (Eq. 5.46); 0 where the film cannot whirl.
    critical_mass : array
        p_s² = M_c CΩ²/F_o [-]; infinite where the film cannot whirl.
    threshold_speed : array
        p_s = Ω_s√(MC/F_o) [-] of a rigid rotor; infinite where the film cannot whirl.
    """

    equivalent_stiffness: Array
    whirl_ratio: Array
    critical_mass: Array
    threshold_speed: Array


@dataclass(frozen=True)
class Onset:
    """The lowest speed at which a machine becomes unstable.

    Attributes
    ----------
    speed : float
        Running speed at the onset, Ω_s [rad/s]; infinite where there is none.
    whirl_frequency : float
        Frequency of the whirl there, ω_s [rad/s]; NaN where there is none.
    eccentricity_ratio : float
        Eccentricity ratio there, ε [-]; NaN where there is none.
    method : str
        How it was found: by the "closed form" of `onset.closed_form`; from the characteristic
        "polynomial", in "extended precision" where floats are not conclusive; from the
        "eigenvalues" where the film depends on the whirl's frequency; from the "film" alone where
        it cannot whirl.
    searched_to : float
        An onset above this speed would not have been found [rad/s]; infinite where the method
        proves that there is none. The "eigenvalues" do not, and a table of coefficients ends.
    searched_from : float
        An onset below this speed would not have been found [rad/s]: the first of a table of
        coefficients, else 0. An onset at this speed is one at or below it: the machine is unstable
        from there on.
    """

    speed: float
    whirl_frequency: float
    eccentricity_ratio: float
    method: Method
    searched_to: float = math.inf
    searched_from: float = 0.0


def whirl_onset(k: ArrayLike, c: ArrayLike) -> WhirlOnset:
    """Return the threshold of whirl of a rigid rotor on given film coefficients.

    Parameters
    ----------
    k, c : array_like, (..., 2, 2)
        Dimensionless stiffness k = K·C/F_o and damping c = C·ΩC/F_o in X, Y [-] (Eq. 5.32). In
        another common unit, such as the film's own, k_eq and p_s² come out in that unit. Of a
        centred film the cross stiffness and direct damping of Eq. 5.32 are infinite: the onset is
        then the limit for a vanishing load, where K_XY = −K_YX = ΩC_XX/2 = ΩC_YY/2 (Eq. 5.37).

    Returns
    -------
    WhirlOnset
        Eqs. 5.45 and 5.46; its fields have the leading shape (...).

    Examples
    --------
    >>> from rotorcalc.films import short
    >>> onset = whirl_onset(short.stiffness(0.5), short.damping(0.5))
    >>> round(float(onset.whirl_ratio), 6), round(float(onset.threshold_speed), 6)
    (0.51464, 2.541731)
    """
    k_XX, k_XY, k_YX, k_YY = _elements("k", k)
    c_XX, c_XY, c_YX, c_YY = _elements("c", c)
    with np.errstate(invalid="ignore"):
        # Eq. 5.45
        k_eq = (k_XX * c_YY + k_YY * c_XX - c_YX * k_XY - c_XY * k_YX) / (c_XX + c_YY)
        # Eq. 5.46
        drives = (k_eq - k_XX) * (k_eq - k_YY) - k_XY * k_YX
        ratio2 = drives / (c_XX * c_YY - c_XY * c_YX)
        # A film that is alike in all directions and without cross-coupling leaves rounding only.
        none = drives <= _ROUNDING * k_eq**2
    # Without load: k_XX, k_YY, c_XY, c_YX are finite beside k_XY = −k_YX = c_XX/2 → ∞, which leave
    # the mean of the direct terms in Eq. 5.45 and 1/4 in Eq. 5.46.
    centred = np.isinf(k_XY)
    if np.any(centred):
        k_eq = np.where(centred, 0.5 * (k_XX + k_YY), k_eq)
        ratio2 = np.where(centred, 0.25, ratio2)
    can_whirl = (ratio2 > 0.0) & ~none  # else no real whirl frequency exists: stable at any mass
    p_s2 = np.where(can_whirl, k_eq / np.where(can_whirl, ratio2, 1.0), np.inf)
    return WhirlOnset(
        equivalent_stiffness=k_eq,
        whirl_ratio=np.sqrt(np.where(can_whirl, ratio2, 0.0)),
        critical_mass=p_s2,
        # A negative equivalent stiffness leaves no mass, and so no speed, at which it is stable.
        threshold_speed=np.sqrt(np.maximum(p_s2, 0.0)),
    )


def flexible_threshold(
    threshold_speed: ArrayLike, equivalent_stiffness: ArrayLike, sag_ratio: ArrayLike
) -> Array:
    """Return the threshold speed of a flexible rotor, p_sf = p_s/√(1 + k_eq Γ/C) (Eq. 5.50).

    The shaft lies in series with the film and lowers the natural frequency; the whirl ratio is
    that of the rigid rotor. Holds for massless journals without midspan damping.

    Parameters
    ----------
    threshold_speed : array_like, (...)
        Of the rigid rotor, p_s [-] or Ω_s [rad/s].
    equivalent_stiffness : array_like, (...)
        k_eq [-].
    sag_ratio : array_like, (...)
        Static sag over clearance, Γ/C [-]; k_eq Γ/C = K_eq/K_rot, so K_eq and 1/K_rot serve too.

    Returns
    -------
    array, (...)
        p_sf or Ω_sf, in the unit of `threshold_speed`.
    """
    k_eq = real_array("equivalent_stiffness", equivalent_stiffness)
    softening = 1.0 + k_eq * real_array("sag_ratio", sag_ratio)
    # So negative a stiffness leaves a rigid rotor's threshold at 0 or infinity, which stays.
    softening = np.where(softening > 0.0, softening, 1.0)
    return real_array("threshold_speed", threshold_speed) / np.sqrt(softening)


def _elements(name: str, coefficients: ArrayLike) -> tuple[Array, Array, Array, Array]:
    m = real_array(name, coefficients, ends=(2, 2))
    return m[..., 0, 0], m[..., 0, 1], m[..., 1, 0], m[..., 1, 1]
