"""A gas as a lubricant: its viscosity by Sutherland's law, its density and mean free path."""

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import zero_Celsius

from rotorcalc.arrays import Array, real_array, shown
from rotorcalc.records import Bound, Kind

# Specific gas constant of dry air [J/(kg·K)] (U.S. Standard Atmosphere 1976: R*/M_0).
AIR_CONSTANT = 287.053


@dataclass(frozen=True, kw_only=True)
class Lubricant(Kind):
    """What fills the bearings: an `Oil` or a `Gas`."""

    unwritten: ClassVar[str] = "oil"


@dataclass(frozen=True, kw_only=True)
class Gas(Lubricant):
    """A gas whose viscosity rises with temperature by Sutherland's law.

    μ = μ_R (T/T_R)^1.5 (T_R + S)/(T + S) with absolute temperatures. The defaults are those of air.

    Parameters
    ----------
    reference_viscosity : float
        Viscosity at the reference temperature, μ_R [Pa·s], positive.
    reference_temperature : float
        Reference temperature, T_R [°C].
    sutherland_temperature : float
        Sutherland's temperature, S [K], zero or more.

    Raises
    ------
    ValueError
        Naming the field, its value and its bound.

    Notes
    -----
    Air: S = 110.4 K and μ = 1.458·10⁻⁶ T^1.5/(T + S), which is 1.716·10⁻⁵ Pa·s at 0 °C. Source:
    U.S. Standard Atmosphere 1976 (NOAA-S/T 76-1562), Eq. 51. The viscosity of a gas does not depend
    on its pressure.

    Examples
    --------
    >>> air = Gas()
    >>> f"{float(air.viscosity(15.0)):.3e}"
    '1.789e-05'
    """

    kind: ClassVar[str] = "gas"

    reference_viscosity: Annotated[float, Bound("Pa·s", above=0.0)] = 1.716e-5
    # A temperature at absolute zero has no ratio to others.
    reference_temperature: Annotated[float, Bound("°C", above=-zero_Celsius)] = 0.0
    sutherland_temperature: Annotated[float, Bound("K", at_least=0.0)] = 110.4

    def viscosity(self, temperature: ArrayLike) -> Array:
        """Return the viscosity.

        Parameters
        ----------
        temperature : array_like, (...)
            Temperature of the film, T [°C].

        Returns
        -------
        array, (...)
            Viscosity, μ [Pa·s].

        Raises
        ------
        ValueError
            Where a temperature is not finite, or not above absolute zero.
        """
        T = _kelvin(temperature)
        T_R, S = self.reference_temperature + zero_Celsius, self.sutherland_temperature
        return np.asarray(self.reference_viscosity * (T / T_R) ** 1.5 * (T_R + S) / (T + S))


def air_density(temperature: ArrayLike, pressure: ArrayLike) -> Array:
    """Return the density of dry air as an ideal gas, ρ = p/(R T).

    Parameters
    ----------
    temperature : array_like, (...)
        T [°C].
    pressure : array_like, (...)
        p [Pa].

    Returns
    -------
    array, (...)
        ρ [kg/m³].

    Raises
    ------
    ValueError
        Where a temperature is not finite, or not above absolute zero.
    """
    return real_array("pressure", pressure) / (AIR_CONSTANT * _kelvin(temperature))


def mean_free_path(viscosity: ArrayLike, temperature: ArrayLike, pressure: ArrayLike) -> Array:
    """Return the mean free path of the molecules of air, λ = (μ/p) √(π R T/2).

    Parameters
    ----------
    viscosity : array_like, (...)
        μ [Pa·s].
    temperature : array_like, (...)
        T [°C].
    pressure : array_like, (...)
        p [Pa].

    Returns
    -------
    array, (...)
        λ [m]. Source: Maxwell's kinetic theory, as in Schaaf & Chambré, Flow of Rarefied Gases,
        1961.

    Raises
    ------
    ValueError
        Where a temperature is not finite, or not above absolute zero.
    """
    speed = np.sqrt(0.5 * math.pi * AIR_CONSTANT * _kelvin(temperature))
    return real_array("viscosity", viscosity) / real_array("pressure", pressure) * speed


def _kelvin(temperature: ArrayLike) -> Array:
    T = real_array("temperature", temperature)
    if not np.all(np.isfinite(T)):
        raise ValueError(f"temperature = {shown(temperature)} °C: must be finite")
    if not np.all(-zero_Celsius < T):
        raise ValueError(
            f"temperature = {shown(temperature)} °C: must be above absolute zero, "
            f"{-zero_Celsius} °C"
        )
    return T + zero_Celsius
