"""Oils: the ISO viscosity grades, laws through two measured viscosities, density and heat.

An oil thins exponentially with temperature or by Walther's law (`Oil`). Real oils follow Walther's,
log10 log10(ν + 0.7) = A − B log10 T with ν in mm²/s and T in kelvin (ASTM D341), so an exponential
law fits a grade about one temperature only.
"""

import math
from dataclasses import replace
from typing import Literal

from numpy.typing import ArrayLike
from scipy.constants import convert_temperature

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, real_array
from rotorcalc.machine import COLDEST, HOTTEST, Oil

# Kinematic viscosity at 40 °C (ISO 3448) and at 100 °C [mm²/s], the latter of a mineral oil with a
# viscosity index of 100 (ASTM D2270).
ISO_VG: dict[str, tuple[float, float]] = {
    "ISO VG 32": (32.0, 5.362),
    "ISO VG 46": (46.0, 6.760),
    "ISO VG 68": (68.0, 8.731),
    "ISO VG 100": (100.0, 11.384),
}
LAW_NAMES = {"exponential": "exponential law", "walther": "Walther's law"}
# A round value for mineral oils [kg/m³]: it converts a grade's kinematic viscosity to the dynamic
# one, and enters the film's Reynolds number.
DENSITY = 860.0
# A usual density at 15 °C [kg/m³], with which that value holds near 50 °C.
DENSITY_AT_15 = 880.0


@checked
def iso_oil(
    grade: str, *, temperature: float, law: Literal["exponential", "walther"] = "exponential"
) -> Oil:
    """Return an oil with a grade's viscosity and its slope at one temperature.

    Parameters
    ----------
    grade : str
        A key of `ISO_VG`.
    temperature : float
        Temperature at which law and grade agree, T [°C].
    law : str
        "exponential", or "walther", with which the oil is the grade at every temperature.

    Returns
    -------
    Oil
        With this temperature as its reference; density 860 kg/m³, heat capacity that at this
        temperature.

    Raises
    ------
    ValueError
        Where the grade is unknown, or the temperature lies outside -70 to 370 °C.

    Examples
    --------
    >>> oil = iso_oil("ISO VG 32", temperature=40.0)
    >>> round(oil.reference_viscosity, 5)
    0.02752
    """
    if grade not in ISO_VG:
        raise ValueError(f"grade = {grade!r}: must be one of {', '.join(ISO_VG)}")
    if not COLDEST <= temperature <= HOTTEST:
        raise ValueError(
            f"temperature = {temperature} °C: must lie between {COLDEST:g} and {HOTTEST:g} °C, "
            "where Walther's law holds"
        )
    nu_40, nu_100 = ISO_VG[grade]
    A, B = _walther((40.0, nu_40), (100.0, nu_100))
    T = _kelvin(temperature)
    shifted = 10.0**10.0 ** (A - B * math.log10(T))  # ν + 0.7
    nu = shifted - 0.7
    return Oil(
        reference_viscosity=nu * 1e-6 * DENSITY,  # μ = νρ, ν from mm²/s
        reference_temperature=temperature,
        # −d ln ν/dT, from d log10 log10(ν + 0.7) = −B d log10 T.
        temperature_coefficient=shifted * math.log(shifted) * B / (nu * T),
        density=DENSITY,
        heat_capacity=float(heat_capacity(temperature)),
        law=law,
    )


@checked
def fitted_oil(
    *,
    temperatures: tuple[float, float],
    viscosities: tuple[float, float],
    density: float = DENSITY,
    law: Literal["exponential", "walther"] = "exponential",
) -> Oil:
    """Return the law through two viscosities, the exponential by α = ln(μ_1/μ_2)/(T_2 − T_1).

    Parameters
    ----------
    temperatures : (float, float)
        Two different temperatures, T_1 and T_2 [°C].
    viscosities : (float, float)
        Viscosities there, μ_1 and μ_2 [Pa·s], positive, the warmer one the thinner.
    density : float
        Density, ρ [kg/m³].
    law : str
        "exponential" or "walther" (ASTM D341), the latter for kinematic viscosities above
        0.3 mm²/s.

    Returns
    -------
    Oil
        With T_1 as its reference temperature.

    Raises
    ------
    ValueError
        Where the temperatures are equal, a viscosity is not positive, or the oil would thicken as
        it warms.

    Examples
    --------
    >>> oil = fitted_oil(temperatures=(50.0, 60.0), viscosities=(0.02, 0.015))
    >>> round(float(oil.viscosity(60.0)), 6)
    0.015
    """
    (T_1, T_2), (mu_1, mu_2) = temperatures, viscosities
    if T_1 == T_2:
        raise ValueError(f"temperatures = {T_1} and {T_2} °C: must differ")
    if not (mu_1 > 0.0 and mu_2 > 0.0):
        raise ValueError(f"viscosities = {mu_1} and {mu_2} Pa·s: must be positive")
    alpha = math.log(mu_1 / mu_2) / (T_2 - T_1)
    if law == "walther":
        nu_1, nu_2 = mu_1 / density * 1e6, mu_2 / density * 1e6
        if min(nu_1, nu_2) <= 0.3:
            raise ValueError(
                f"viscosities = {mu_1:g} and {mu_2:g} Pa·s: Walther's law needs kinematic ones "
                f"above 0.3 mm²/s, these are {nu_1:.3g} and {nu_2:.3g}"
            )
        _, B = _walther((T_1, nu_1), (T_2, nu_2))
        alpha = (nu_1 + 0.7) * math.log(nu_1 + 0.7) * B / (nu_1 * _kelvin(T_1))
    return Oil(
        reference_viscosity=mu_1,
        reference_temperature=T_1,
        temperature_coefficient=alpha,
        density=density,
        law=law,
    )


@checked
def by_other_law(oil: Oil) -> Oil | None:
    """Return an oil by the other law with the same viscosity and slope at its reference.

    Parameters
    ----------
    oil : Oil
        The oil.

    Returns
    -------
    Oil or None
        None where it is too thin for Walther's law.
    """
    try:
        return replace(oil, law="walther" if oil.law == "exponential" else "exponential")
    except ValueError:
        return None


@checked
def density(temperature: ArrayLike, *, at_15: float = DENSITY_AT_15) -> Array:
    """Return the density of a mineral oil, ρ = ρ_15 (1 − 65·10⁻⁵ (T − 15)).

    Parameters
    ----------
    temperature : array_like, (...)
        T [°C].
    at_15 : float
        Density at 15 °C, ρ_15 [kg/m³].

    Returns
    -------
    array, (...)
        ρ [kg/m³]. Source: DIN 51757, with the expansion usual for lubricating oils.
    """
    return at_15 * (1.0 - 65e-5 * (real_array("temperature", temperature) - 15.0))


@checked
def heat_capacity(temperature: ArrayLike, *, at_15: float = DENSITY_AT_15) -> Array:
    """Return the heat capacity of a mineral oil, c = (1683 + 3.39 T)/√(ρ_15/1000).

    Parameters
    ----------
    temperature : array_like, (...)
        T [°C].
    at_15 : float
        Density at 15 °C, ρ_15 [kg/m³].

    Returns
    -------
    array, (...)
        c [J/(kg·K)]. Source: Cragoe, Thermal Properties of Petroleum Products, Miscellaneous
        Publication 97 of the Bureau of Standards, 1929: (0.402 + 0.00081 T)/√s cal/(g·°C).
    """
    return (1683.0 + 3.39 * real_array("temperature", temperature)) / math.sqrt(at_15 / 1000.0)


def _walther(one: tuple[float, float], other: tuple[float, float]) -> tuple[float, float]:
    """Return A and B of Walther's law through two pairs of temperature and viscosity [mm²/s]."""
    (T_1, w_1), (T_2, w_2) = ((T, math.log10(math.log10(nu + 0.7))) for T, nu in (one, other))
    B = (w_1 - w_2) / math.log10(_kelvin(T_2) / _kelvin(T_1))
    return w_1 + B * math.log10(_kelvin(T_1)), B


def _kelvin(temperature: float) -> float:
    return float(convert_temperature(temperature, "C", "K"))
