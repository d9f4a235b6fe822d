"""Units of display: SI as engineers write it, and US customary; factors from scipy.constants."""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy import constants
from scipy.constants import gallon, hp, inch, lb, lbf, liter, mil, minute, psi

from rotorcalc.arrays import Array

# The speed of one revolution a minute [rad/s]: 6000 * rpm is 6000 rpm.
rpm = 2 * constants.pi / minute
_REYN = lbf / inch**2  # Pa·s in a reyn, lbf·s/in²


@dataclass(frozen=True)
class Unit:
    """A unit of display, and its conversion from SI.

    Attributes
    ----------
    name : str
        As readers see it.
    per_si : float
        How many of this unit make one SI unit.
    offset : float
        Reading of this unit at the SI quantity's zero.
    in_si : float or None
        One of this unit in SI, where its readings are multiplied by that: 150 * degree is a float
        that 150 / (1 / degree) can miss by its last bit. None to divide by `per_si`.
    """

    name: str
    per_si: float = 1.0
    offset: float = 0.0
    in_si: float | None = None

    def of(self, value: ArrayLike) -> Array:
        """Return an SI value in this unit, shape (...)."""
        return np.asarray(value, dtype=float) * self.per_si + self.offset

    def to_si(self, reading: float) -> float:
        """Return the SI value of a reading in this unit."""
        above = reading - self.offset
        return above / self.per_si if self.in_si is None else above * self.in_si


@dataclass(frozen=True)
class Units:
    """The unit of display of each kind of quantity."""

    name: str
    mass: Unit
    force: Unit
    length: Unit
    film: Unit
    amplitude: Unit
    viscosity: Unit
    temperature: Unit
    per_temperature: Unit
    rise: Unit
    density: Unit
    heat_capacity: Unit
    shaft_stiffness: Unit
    shaft_damping: Unit
    stiffness: Unit
    damping: Unit
    power: Unit
    flow: Unit
    pressure: Unit
    torque: Unit
    rotational_stiffness: Unit
    inertia: Unit
    foundation: Unit
    speed: Unit = Unit("rpm", 1 / rpm)
    frequency: Unit = Unit("Hz", 1 / (2 * constants.pi))
    angle: Unit = Unit("°", 1 / constants.degree, in_si=constants.degree)
    growth: Unit = Unit("1/s")
    percent: Unit = Unit("%", 100.0)
    number: Unit = Unit("-")


SI = Units(
    name="SI",
    mass=Unit("kg"),
    force=Unit("N"),
    length=Unit("mm", 1e3),
    film=Unit("µm", 1e6),
    amplitude=Unit("µm 0-p", 1e6),
    viscosity=Unit("mPa·s", 1e3),
    temperature=Unit("°C"),
    per_temperature=Unit("1/°C"),
    rise=Unit("K"),
    density=Unit("kg/m³"),
    heat_capacity=Unit("J/(kg·K)"),
    shaft_stiffness=Unit("N/m"),
    shaft_damping=Unit("N·s/m"),
    stiffness=Unit("MN/m", 1e-6),
    damping=Unit("kN·s/m", 1e-3),
    power=Unit("kW", 1e-3),
    flow=Unit("l/min", minute / liter),
    pressure=Unit("MPa", 1e-6),
    torque=Unit("N·m"),
    rotational_stiffness=Unit("N·m/rad"),
    inertia=Unit("kg·m²"),
    foundation=Unit("GN/m³", 1e-9),
)

US = Units(
    name="US",
    mass=Unit("lb", 1 / lb),
    force=Unit("lbf", 1 / lbf),
    length=Unit("in", 1 / inch),
    # A mil is a thousandth of an inch.
    film=Unit("mil", 1 / mil),
    amplitude=Unit("mil 0-p", 1 / mil),
    viscosity=Unit("µreyn", 1e6 / _REYN),
    # A difference of 1 °C is 1.8 °F, so a coefficient takes the factor without the offset.
    temperature=Unit("°F", 1.8, 32.0),
    per_temperature=Unit("1/°F", 1 / 1.8),
    rise=Unit("°F", 1.8),
    density=Unit("lb/ft³", constants.foot**3 / lb),
    heat_capacity=Unit("Btu/(lb·°F)", lb / (1.8 * constants.Btu)),
    # scipy's lbf and inch are in N and m: one N/m is inch/lbf of a lbf/in.
    shaft_stiffness=Unit("lbf/in", inch / lbf),
    shaft_damping=Unit("lbf·s/in", inch / lbf),
    stiffness=Unit("klbf/in", 1e-3 * inch / lbf),
    damping=Unit("lbf·s/in", inch / lbf),
    power=Unit("hp", 1 / hp),
    flow=Unit("gpm", minute / gallon),
    pressure=Unit("psi", 1 / psi),
    torque=Unit("lbf·in", 1 / (lbf * inch)),
    rotational_stiffness=Unit("lbf·in/rad", 1 / (lbf * inch)),
    inertia=Unit("lb·in²", 1 / (lb * inch**2)),
    foundation=Unit("lbf/in³", inch**3 / lbf),
)

SYSTEMS = {"SI": SI, "US": US}
# Readings of a vibration over its amplitude: zero to peak, and peak to peak.
AMPLITUDES = {"0-p": 1.0, "p-p": 2.0}


@cache
def with_amplitudes(units: Units, reading: str) -> Units:
    """Return units in which amplitudes are read zero to peak, or peak to peak.

    Parameters
    ----------
    units : Units
        The units.
    reading : str
        "0-p" or "p-p".

    Returns
    -------
    Units
        The same, the unit of amplitudes named after the reading.

    Raises
    ------
    ValueError
        Where the reading is neither.
    """
    if reading not in AMPLITUDES:
        raise ValueError(f"reading = {reading!r}: must be {' or '.join(map(repr, AMPLITUDES))}")
    film = units.film
    return replace(
        units, amplitude=Unit(f"{film.name} {reading}", film.per_si * AMPLITUDES[reading])
    )
