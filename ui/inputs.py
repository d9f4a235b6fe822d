"""The quantities that a visitor moves: their keys, symbols, units, ranges and groups.

A value is kept in the unit of the address bar (SI as engineers write it: mm, µm, mPa·s, rpm), under
its key there. `machine_of` and `values_of` lead from such values to the core's records and back.
"""

import math
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass

from rotorcalc import PRESETS, JournalBearing, Machine, Oil, Preset, Rotor
from rotorcalc.figures import style
from rotorcalc.units import SI, Unit, Units

# The least of a positive value: below it what is divided by it has no room.
_LEAST = 1e-290

# None for a load that follows the rotor's weight.
Values = dict[str, float | None]


@dataclass(frozen=True)
class Input:
    """A quantity that a visitor moves.

    `kind` names its unit in `Units`; `low`, `high` and `step` are in SI as engineers write it. A
    logarithmic input has `step` values a decade. `infinite` admits one value beyond `high`.
    """

    key: str
    label: str
    symbol: str
    kind: str
    low: float
    high: float
    step: float
    group: str
    help: str
    log: bool = False
    infinite: str = ""

    def unit(self, units: Units) -> Unit:
        """Return the unit in which a visitor sees this input."""
        return getattr(units, self.kind)

    def shown(self, value: float, units: Units) -> float:
        """Return a kept value in a visitor's unit."""
        if units is SI:
            return value
        return float(self.unit(units).of(self.unit(SI).to_si(value)))

    def stored(self, reading: float, units: Units) -> float:
        """Return a visitor's reading as it is kept."""
        if units is SI:
            return reading
        return float(self.unit(SI).of(self.unit(units).to_si(reading)))

    def name(self, units: Units) -> str:
        """Return label, symbol and unit, as beside a slider."""
        unit = self.unit(units).name
        return f"{self.label} {self.symbol}" + ("" if unit == "-" else f" [{unit}]")

    def taken(self, sent: object, units: Units) -> float:
        """Return what a slider sent, in a visitor's unit, as it is kept.

        Raises ValueError in words where it is no number or lies outside the range.
        """
        try:
            reading = math.inf if self.infinite and sent == self.infinite else float(str(sent))
        except ValueError:
            raise ValueError(f"{self.label}: {quoted(sent)} is no number") from None
        value = self.stored(reading, units)
        if problem := self.problem(value):
            raise ValueError(f"{self.name(units)} = {reading:g} {problem}")
        return value

    def problem(self, value: float | None) -> str:
        """Return what is wrong with a value, in words, or nothing."""
        if value is None:
            return "" if self.key == "load" else "is missing"
        if self.infinite and value == math.inf:
            return ""
        if 0.0 < value < _LEAST:
            return f"lies between 0 and {_LEAST:g}, where numbers lose their digits"
        if self.low <= value <= self.high:
            return ""
        unit = self.unit(SI).name
        return f"lies outside {self.low:g} to {self.high:g} {unit}"


GROUPS = ("Speed", "Load", "Oil", "Bearing", "Shaft and disk")
OPEN_GROUPS = ("Speed", "Load", "Oil", "Bearing")

INPUTS: dict[str, Input] = {
    item.key: item
    for item in (
        Input(
            "mass", "Rotor mass", "2M", "mass", 10, 2000, 1, "Load",
            "The whole rotor's; each bearing carries half of it.",
        ),
        Input(
            "load", "Load per bearing", "Fₒ", "force", 0, 20000, 10, "Load",
            "Static load on one bearing; without a value of its own, half the rotor's weight.",
        ),
        Input(
            "T", "Film temperature", "T", "temperature", 0, 150, 0.5, "Oil",
            "μ = μᵣ exp(−α(T − Tᵣ))",
        ),
        Input(
            "mu", "Reference viscosity", "μᵣ", "viscosity", 1, 500, 40, "Oil",
            "Viscosity at the reference temperature.", log=True,
        ),
        Input(
            "TR", "Reference temperature", "Tᵣ", "temperature", 0, 150, 0.5, "Oil",
            "Temperature at which the reference viscosity holds.",
        ),
        Input(
            "alpha", "Viscosity coefficient", "α", "per_temperature", 0, 0.08, 0.001, "Oil",
            "How fast the oil thins as it warms.",
        ),
        Input(
            "rho", "Oil density", "ρ", "density", 500, 1500, 5, "Oil",
            "Enters the film's Reynolds number and added mass only.",
        ),
        Input(
            "C", "Radial clearance", "C", "film", 10, 500, 1, "Bearing",
            "Half the difference of the diameters of bearing and journal.",
        ),
        Input("D", "Diameter", "D", "length", 20, 600, 1, "Bearing", "Of the journal, D = 2R."),
        Input("L", "Length", "L", "length", 5, 300, 1, "Bearing", "Axial length of the bearing."),
        Input(
            "k", "Shaft stiffness", "Kᵣₒₜ", "shaft_stiffness", 1e5, 1e10, 20, "Shaft and disk",
            "Of one side of the shaft; the right end is a rigid shaft.",
            log=True, infinite="rigid",
        ),
        Input(
            "u", "Imbalance", "u", "film", 0, 100, 0.1, "Shaft and disk",
            "Distance of the disk's mass centre from the shaft's axis.",
        ),
        Input(
            "cs", "Midspan damping", "Cₛ", "shaft_damping", 0, 1e5, 100, "Shaft and disk",
            "External damping at the disk, one side.",
        ),
        Input(
            "mj", "Journal mass", "Mⱼ", "mass", 0, 500, 0.5, "Shaft and disk",
            "Mass lumped at each journal, taken out of the disk.",
        ),
        Input(
            "rpm", "Running speed", "Ω", "speed", 100, 30000, 10, "Speed",
            "The speed of the point that every chart marks.",
        ),
        Input(
            "rpm_max", "Top speed", "Ωₘₐₓ", "speed", 1000, 40000, 100, "Speed",
            "Charts run to this speed, or to the running speed where that is higher.",
        ),
    )
}  # fmt: skip

DEFAULT_PRESET = "sheet-1e8"


def _number(values: Mapping[str, float | None], key: str) -> float:
    value = values[key]
    if value is None:
        raise ValueError(f"{INPUTS[key].label}: missing")
    return value


def _tidy(value: float) -> float:
    """Return a value without the rounding that a change of unit adds in its last digits."""
    return float(f"{value:.14g}")


def values_of(machine: Machine, speed: float, top_speed: float) -> Values:
    """Return the kept values of a machine and its speeds [rad/s]."""
    oil, bearing, rotor = machine.oil, machine.bearing, machine.rotor
    in_si: dict[str, float | None] = {
        "mass": rotor.mass, "load": machine.load, "T": machine.temperature,
        "mu": oil.reference_viscosity, "TR": oil.reference_temperature,
        "alpha": oil.temperature_coefficient, "rho": oil.density,
        "C": bearing.radial_clearance, "D": bearing.diameter, "L": bearing.length,
        "k": rotor.shaft_stiffness, "u": rotor.imbalance, "cs": rotor.disk_damping,
        "mj": rotor.journal_mass, "rpm": speed, "rpm_max": top_speed,
    }  # fmt: skip
    return {
        key: None if value is None else _tidy(float(INPUTS[key].unit(SI).of(value)))
        for key, value in in_si.items()
    }


def preset_values(preset: Preset) -> Values:
    """Return the kept values of a preset."""
    return values_of(preset.machine, preset.speed, preset.top_speed)


PRESET_VALUES: dict[str, Values] = {key: preset_values(preset) for key, preset in PRESETS.items()}


def machine_of(values: Mapping[str, float | None]) -> Machine:
    """Return the machine that kept values describe, or raise the core's ValueError."""
    si = {
        key: None if value is None else INPUTS[key].unit(SI).to_si(value)
        for key, value in values.items()
    }
    return Machine(
        oil=Oil(
            reference_viscosity=_number(si, "mu"),
            reference_temperature=_number(si, "TR"),
            temperature_coefficient=_number(si, "alpha"),
            density=_number(si, "rho"),
        ),
        bearing=JournalBearing(
            diameter=_number(si, "D"),
            length=_number(si, "L"),
            radial_clearance=_number(si, "C"),
        ),
        rotor=Rotor(
            mass=_number(si, "mass"),
            shaft_stiffness=_number(si, "k"),
            imbalance=_number(si, "u"),
            disk_damping=_number(si, "cs"),
            journal_mass=_number(si, "mj"),
        ),
        temperature=_number(si, "T"),
        load=si["load"],
    )


def speeds_of(values: Mapping[str, float | None]) -> tuple[float, float]:
    """Return the running speed and the top speed of the charts [rad/s].

    A running speed above the top speed takes the charts to the next round number, not along.
    """
    speed, top = (_number(values, key) for key in ("rpm", "rpm_max"))
    top = max(top, style.ceiling(speed)) if speed > top else top
    return SI.speed.to_si(speed), SI.speed.to_si(top)


def input_named(name: str) -> Input:
    """Return an input by its key, or raise ValueError in words."""
    if name not in INPUTS:
        raise ValueError(f"{quoted(name)} is no input")
    return INPUTS[name]


def quoted(word: object) -> str:
    """Return what a visitor typed, short, and with nothing that a page could take for markup."""
    text = reprlib.repr(word).replace("`", "'")
    return f"`{text}`"
