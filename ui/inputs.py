"""The inputs of the sliders: their keys, symbols, units, ranges and groups.

A value is kept in the unit of the address bar (SI as engineers write it: mm, µm, mPa·s, rpm), under
its key there; the fields of a bearing's bore are in `ui.bearing`. `machine_of` and `values_of`
convert such values to the core's records and back: here a slider's value becomes a machine.
"""

import functools
import math
from dataclasses import dataclass
from typing import Any

from rotorcalc import PRESETS, JournalBearing, Machine, Oil, Preset, Rotor
from rotorcalc.figures import style
from rotorcalc.units import SI, Unit, Units
from ui.bearing import Values, bearing_values, shape_of
from ui.format import quoted, typed_number

# Smallest positive value: quotients by a smaller one would overflow.
_LEAST = 1e-290


@dataclass(frozen=True)
class Input:
    """An input that a visitor sets.

    `field` is its place in the core's records; `kind` names its unit in `Units`; `low`, `high` and
    `step` are in SI as engineers write it. A logarithmic input has `step` values a decade.
    `infinite` admits one value beyond `high`.
    """

    key: str
    field: str
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
        # Kept as it is: a change of unit and back would change its last digit.
        if units is SI:
            return value
        return float(self.unit(units).of(self.unit(SI).to_si(value)))

    def stored(self, reading: float, units: Units) -> float:
        """Return a visitor's reading as it is kept."""
        # As above.
        if units is SI:
            return reading
        return tidy(float(self.unit(SI).of(self.unit(units).to_si(reading))))

    def name(self, units: Units) -> str:
        """Return label, symbol and unit, as beside a slider."""
        unit = self.unit(units).name
        return f"{self.label} {self.symbol}" + ("" if unit == "-" else f" [{unit}]")

    def taken(self, sent: object, units: Units) -> float:
        """Return the value to keep of a slider's message, which is in a visitor's unit.

        Raises ValueError where it is not a number or lies outside the range.
        """
        try:
            reading = math.inf if self.infinite and sent == self.infinite else typed_number(sent)
        except ValueError as error:
            raise ValueError(f"{self.label}: {quoted(sent)} {error}") from None
        value = self.stored(reading, units)
        if problem := self.problem(value):
            raise ValueError(f"{self.name(units)} = {reading:g} {problem}")
        return value

    def problem(self, value: float | None) -> str:
        """Return the fault of a value as a text, empty where there is none."""
        if value is None:
            return "" if self.key == "load" else "is missing"
        if self.infinite and value == math.inf:
            return ""
        # Zero itself is a value of its own, no damping for instance.
        if 0.0 < value < _LEAST:
            return f"lies between 0 and {_LEAST:g}, where floating-point numbers lose precision"
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
            "mass", "rotor.mass",
            "Rotor mass", "2M", "mass", 10, 2000, 1, "Load",
            "The whole rotor's; each bearing carries half of it.",
        ),
        Input(
            "load", "load",
            "Load per bearing", "Fₒ", "force", 0, 20000, 10, "Load",
            "Static load on one bearing; without a value of its own, half the rotor's weight.",
        ),
        Input(
            "T", "temperature",
            "Film temperature", "T", "temperature", 0, 150, 0.5, "Oil",
            "μ = μᵣ exp(−α(T − Tᵣ))",
        ),
        Input(
            "mu", "oil.reference_viscosity",
            "Reference viscosity", "μᵣ", "viscosity", 1, 500, 40, "Oil",
            "Viscosity at the reference temperature.", log=True,
        ),
        Input(
            "TR", "oil.reference_temperature",
            "Reference temperature", "Tᵣ", "temperature", 0, 150, 0.5, "Oil",
            "Temperature of the reference viscosity.",
        ),
        Input(
            "alpha", "oil.temperature_coefficient",
            "Viscosity coefficient", "α", "per_temperature", 0, 0.08, 0.001, "Oil",
            "Rate at which viscosity falls with temperature.",
        ),
        Input(
            "rho", "oil.density",
            "Oil density", "ρ", "density", 500, 1500, 5, "Oil",
            "Affects the film's Reynolds number and added mass only.",
        ),
        Input(
            "C", "bearing.radial_clearance",
            "Radial clearance", "C", "film", 10, 500, 1, "Bearing",
            "Half the difference of the diameters of bearing and journal.",
        ),
        Input(
            "D", "bearing.diameter",
            "Diameter", "D", "length", 20, 600, 1, "Bearing",
            "Of the journal, D = 2R.",
        ),
        Input(
            "L", "bearing.length",
            "Length", "L", "length", 5, 300, 1, "Bearing",
            "Axial length of the bearing.",
        ),
        Input(
            "k", "rotor.shaft_stiffness",
            "Shaft stiffness", "Kᵣₒₜ", "shaft_stiffness", 1e5, 1e10, 20, "Shaft and disk",
            "Of one side of the shaft; the right end is a rigid shaft.",
            log=True, infinite="rigid",
        ),
        Input(
            "u", "rotor.imbalance",
            "Imbalance", "u", "film", 0, 100, 0.1, "Shaft and disk",
            "Distance of the disk's mass centre from the shaft's axis.",
        ),
        Input(
            "cs", "rotor.disk_damping",
            "Midspan damping", "Cₛ", "shaft_damping", 0, 1e5, 100, "Shaft and disk",
            "External damping at the disk, one side.",
        ),
        Input(
            "mj", "rotor.journal_mass",
            "Journal mass", "Mⱼ", "mass", 0, 500, 0.5, "Shaft and disk",
            "Mass lumped at each journal, subtracted from the disk's.",
        ),
        Input(
            "rpm", "speed",
            "Running speed", "Ω", "speed", 100, 30000, 10, "Speed",
            "Every chart marks the point at this speed.",
        ),
        Input(
            "rpm_max", "top_speed",
            "Top speed", "Ωₘₐₓ", "speed", 1000, 40000, 100, "Speed",
            "Charts run to this speed, or to the running speed where that is higher.",
        ),
    )
}  # fmt: skip

DEFAULT_PRESET = "sheet-1e8"


# Inputs that are not part of a machine: the speeds at which it is analysed.
_SPEEDS = ("speed", "top_speed")


def number(values: Values, key: str) -> float:
    """Return a kept number, or raise ValueError where it is missing."""
    value = values[key]
    if value is None or isinstance(value, str):
        raise ValueError(f"{INPUTS[key].label}: missing")
    return value


def tidy(value: float) -> float:
    """Return a value without the rounding that a change of unit leaves in its last digits."""
    return float(f"{value:.14g}")


def values_of(machine: Machine, speed: float, top_speed: float) -> Values:
    """Return the kept values of a machine and its speeds [rad/s]."""
    speeds = {"speed": speed, "top_speed": top_speed}
    values: Values = {}
    for key, item in INPUTS.items():
        value = speeds[item.field] if item.field in speeds else _at(machine, item.field)
        values[key] = None if value is None else tidy(float(item.unit(SI).of(value)))
    return values | bearing_values(machine.bearing)


def _at(machine: Machine, field: str) -> float | None:
    """Return the value of a record's field; a load that follows the weight has none."""
    return functools.reduce(getattr, field.split("."), machine)  # type: ignore[return-value]


def preset_values(preset: Preset) -> Values:
    """Return the kept values of a preset."""
    return values_of(preset.machine, preset.speed, preset.top_speed)


PRESET_VALUES: dict[str, Values] = {key: preset_values(preset) for key, preset in PRESETS.items()}


def machine_of(values: Values) -> Machine:
    """Return the machine that kept values describe, or raise ValueError in the sidebar's words."""
    try:
        return _machine_of(values)
    except ValueError as error:
        raise ValueError(_in_words(f"{error}")) from error


def _in_words(message: str) -> str:
    """Return a message of the core with a field's name as the sidebar has it."""
    field, _, _ = message.partition(" = ")
    for item in INPUTS.values():
        if field == item.field.rpartition(".")[2]:
            return f"{item.label} {item.symbol}{message.removeprefix(field)}"
    return message


def _machine_of(values: Values) -> Machine:
    records: dict[str, dict[str, Any]] = {"oil": {}, "bearing": {}, "rotor": {}, "": {}}
    for key, item in INPUTS.items():
        record, _, name = item.field.rpartition(".")
        if item.field not in _SPEEDS:
            # None is a load that follows the rotor's weight; no other input may be missing.
            load = name == "load" and values[key] is None
            records[record][name] = None if load else item.unit(SI).to_si(number(values, key))
    geometry, film = shape_of(values)
    return Machine(
        oil=Oil(**records["oil"]),
        bearing=JournalBearing(**records["bearing"], geometry=geometry, film=film),
        rotor=Rotor(**records["rotor"]),
        **records[""],
    )


def speeds_of(values: Values) -> tuple[float, float]:
    """Return the running speed and the top speed of the charts [rad/s].

    A running speed above the top speed takes the charts to the next round number, not along.
    """
    speed, top = (number(values, key) for key in ("rpm", "rpm_max"))
    top = max(top, style.ceiling(speed)) if speed > top else top
    return SI.speed.to_si(speed), SI.speed.to_si(top)


def input_named(name: str) -> Input:
    """Return an input by its key, or raise ValueError."""
    if name not in INPUTS:
        raise ValueError(f"{quoted(name)} is not an input")
    return INPUTS[name]
