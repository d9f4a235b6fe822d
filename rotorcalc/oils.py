"""Oils: the ISO viscosity grades, and an oil law through two measured viscosities.

The machine's oil thins exponentially with temperature (`Oil`). Real oils follow Walther's law,
log10 log10(ν + 0.7) = A − B log10 T with ν in mm²/s and T in kelvin (ASTM D341), so an exponential
law fits a grade about one temperature only.
"""

import math

from scipy.constants import convert_temperature

from rotorcalc.arguments import checked
from rotorcalc.machine import Oil

# Kinematic viscosity at 40 °C (ISO 3448) and at 100 °C [mm²/s], the latter of a mineral oil with a
# viscosity index of 100 (ASTM D2270).
ISO_VG: dict[str, tuple[float, float]] = {
    "ISO VG 32": (32.0, 5.362),
    "ISO VG 46": (46.0, 6.760),
    "ISO VG 68": (68.0, 8.731),
    "ISO VG 100": (100.0, 11.384),
}
# A round value for mineral oils [kg/m³]: it converts a grade's kinematic viscosity to the dynamic
# one, and enters the film's Reynolds number.
DENSITY = 860.0
# The range of the charts of ASTM D341 [°C].
_COLDEST, _HOTTEST = -70.0, 370.0


@checked
def iso_oil(grade: str, *, temperature: float) -> Oil:
    """Return the exponential law with a grade's viscosity and its slope at one temperature.

    Parameters
    ----------
    grade : str
        A key of `ISO_VG`.
    temperature : float
        Temperature at which law and grade agree, T [°C].

    Returns
    -------
    Oil
        With this temperature as its reference; density 860 kg/m³.

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
    if not _COLDEST <= temperature <= _HOTTEST:
        raise ValueError(
            f"temperature = {temperature} °C: must lie between {_COLDEST:g} and {_HOTTEST:g} °C, "
            "where Walther's law holds"
        )
    A, B = _walther(*ISO_VG[grade])
    T = _kelvin(temperature)
    shifted = 10.0**10.0 ** (A - B * math.log10(T))  # ν + 0.7
    nu = shifted - 0.7
    return Oil(
        reference_viscosity=nu * 1e-6 * DENSITY,  # μ = νρ, ν from mm²/s
        reference_temperature=temperature,
        # −d ln ν/dT, from d log10 log10(ν + 0.7) = −B d log10 T.
        temperature_coefficient=shifted * math.log(shifted) * B / (nu * T),
        density=DENSITY,
    )


@checked
def fitted_oil(
    *, temperatures: tuple[float, float], viscosities: tuple[float, float], density: float = DENSITY
) -> Oil:
    """Return the exponential law through two viscosities, α = ln(μ_1/μ_2)/(T_2 − T_1).

    Parameters
    ----------
    temperatures : (float, float)
        Two different temperatures, T_1 and T_2 [°C].
    viscosities : (float, float)
        Viscosities there, μ_1 and μ_2 [Pa·s], positive, the warmer one the thinner.
    density : float
        Density, ρ [kg/m³].

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
    return Oil(
        reference_viscosity=mu_1,
        reference_temperature=T_1,
        temperature_coefficient=math.log(mu_1 / mu_2) / (T_2 - T_1),
        density=density,
    )


def _walther(nu_40: float, nu_100: float) -> tuple[float, float]:
    """Return A and B of Walther's law through the viscosities at 40 and 100 °C."""
    w_40, w_100 = (math.log10(math.log10(nu + 0.7)) for nu in (nu_40, nu_100))
    B = (w_40 - w_100) / math.log10(_kelvin(100.0) / _kelvin(40.0))
    return w_40 + B * math.log10(_kelvin(40.0)), B


def _kelvin(temperature: float) -> float:
    return float(convert_temperature(temperature, "C", "K"))
