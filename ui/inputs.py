"""The inputs of the sliders: their keys, symbols, units, ranges and groups.

A value is kept in the unit of the address bar (SI as engineers write it: mm, µm, mPa·s, rpm), under
its key there; the fields of a bearing's bore are in `ui.bearing`. `machine_of` and `values_of`
convert such values to the core's records and back: here a slider's value becomes a machine.
"""

import functools
import math
from dataclasses import dataclass
from typing import Any

from scipy.constants import g

from rotorcalc import PRESETS, JournalBearing, Machine, Oil, Preset, Rotor
from rotorcalc.figures import style
from rotorcalc.units import SI, Unit, Units
from ui.bearing import Values, bearing_values, shape_of
from ui.format import quoted, short, typed_number

# Smallest positive value: quotients by a smaller one would overflow.
_LEAST = 1e-290


@dataclass(frozen=True)
class Input:
    """An input that a visitor sets.

    `field` is its place in the core's records; `kind` names its unit in `Units`; `low` to `high` is
    what is admitted, in SI as engineers write it. Its scale is logarithmic, from `least` where
    `low` is zero, or linear where it has a `step`: a temperature, whose zero is arbitrary.
    `infinite` is the word for one value beyond `high`.
    """

    key: str
    field: str
    label: str
    symbol: str
    kind: str
    low: float
    high: float
    group: str
    help: str
    least: float = 0.0
    step: float = 0.0
    infinite: str = ""

    def unit(self, units: Units) -> Unit:
        """Return the unit in which a visitor sees this input."""
        return getattr(units, self.kind)

    def shown(self, value: float, units: Units) -> float:
        """Return a kept value in a visitor's unit."""
        # Kept as it is: a change of unit and back would change its last digit.
        if units.name == SI.name:
            return float(value)
        return float(self.unit(units).of(self.unit(SI).to_si(value)))

    def stored(self, reading: float, units: Units) -> float:
        """Return a visitor's reading as it is kept."""
        # As above.
        if units.name == SI.name:
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
        if problem := self.problem(value, units):
            raise ValueError(f"{self.name(units)} = {short(reading)} {problem}")
        return value

    def problem(self, value: float | None, units: Units = SI) -> str:
        """Return the fault of a kept value as a text, empty where there is none."""
        if value is None:
            return "" if self.key == "load" else "is missing"
        if self.infinite and value == math.inf:
            return ""
        # Zero itself is a value of its own, no damping for instance.
        if 0.0 < value < _LEAST:
            return f"lies between 0 and {_LEAST:g}, where floating-point numbers lose precision"
        if self.low <= value <= self.high:
            return ""
        low, high = (short(self.shown(end, units)) for end in (self.low, self.high))
        return f"lies outside {low} to {high} {self.unit(units).name}"

    def words(self, value: float, units: Units) -> str:
        """Return a kept value as a field shows it, in a visitor's unit."""
        return self.infinite if math.isinf(value) else short(self.shown(value, units))


# What moves an onset of whirl stands together at the top.
GROUPS = ("Speed and whirl", "Bearing", "Oil", "Rotor")
OPEN_GROUPS = ("Speed and whirl", "Bearing")

INPUTS: dict[str, Input] = {
    item.key: item
    for item in (
        Input(
            "rpm", "speed",
            "Running speed", "Ω", "speed", 10, 300_000, "Speed and whirl",
            "The speed for which all results hold; every chart marks it.",
        ),
        Input(
            "load", "load",
            "Load per bearing", "Fₒ", "force", 0, 2e6, "Speed and whirl",
            "Static load on one bearing, half the rotor's weight unless given.",
            least=0.01,
        ),
        Input(
            "T", "temperature",
            "Film temperature", "T", "temperature", 0, 150, "Speed and whirl",
            "μ = μᵣ exp(−α(T − Tᵣ))", step=1,
        ),
        Input(
            "C", "bearing.radial_clearance",
            "Radial clearance", "C", "film", 3, 2000, "Speed and whirl",
            "Half the difference of the diameters of bearing and journal.",
        ),
        Input(
            "k", "rotor.shaft_stiffness",
            "Shaft stiffness", "Kᵣₒₜ", "shaft_stiffness", 1e3, 1e11, "Speed and whirl",
            "Stiffness of one side of the shaft. The right end of the slider is a rigid shaft.",
            infinite="rigid",
        ),
        Input(
            "D", "bearing.diameter",
            "Diameter", "D", "length", 3, 1200, "Bearing",
            "Diameter of the journal, D = 2R.",
        ),
        Input(
            "L", "bearing.length",
            "Length", "L", "length", 1, 1200, "Bearing",
            "Axial length of the bearing.",
        ),
        Input(
            "mu", "oil.reference_viscosity",
            "Reference viscosity", "μᵣ", "viscosity", 0.1, 5000, "Oil",
            "Viscosity at the reference temperature.",
        ),
        Input(
            "TR", "oil.reference_temperature",
            "Reference temperature", "Tᵣ", "temperature", 0, 150, "Oil",
            "Temperature of the reference viscosity.", step=1,
        ),
        Input(
            "alpha", "oil.temperature_coefficient",
            "Viscosity coefficient", "α", "per_temperature", 0, 0.15, "Oil",
            "Rate at which viscosity falls with temperature.", least=0.005,
        ),
        Input(
            "rho", "oil.density",
            "Oil density", "ρ", "density", 500, 1500, "Oil",
            "Affects the film's Reynolds number and added mass only.",
        ),
        Input(
            "mass", "rotor.mass",
            "Rotor mass", "2M", "mass", 0.05, 1e5, "Rotor",
            "The whole rotor's; each bearing carries half of it.",
        ),
        Input(
            "u", "rotor.imbalance",
            "Imbalance", "u", "film", 0, 1000, "Rotor",
            "Distance of the disk's mass centre from the shaft's axis.", least=0.001,
        ),
        Input(
            "cs", "rotor.disk_damping",
            "Midspan damping", "Cₛ", "shaft_damping", 0, 1e7, "Rotor",
            "External damping at the disk, one side.", least=0.001,
        ),
        Input(
            "mj", "rotor.journal_mass",
            "Journal mass", "Mⱼ", "mass", 0, 4e4, "Rotor",
            "Mass lumped at each journal, subtracted from the disk's.", least=1e-4,
        ),
        Input(
            "rpm_max", "top_speed",
            "Top speed", "Ωₘₐₓ", "speed", 100, 400_000, "Rotor",
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


def usual(key: str, values: Values) -> float:
    """Return the kept value about which an input's slider lies while it is zero or infinite.

    An estimate from the machine, so that one drag leads from zero to an effect that can be seen.
    """
    item, half_mass = INPUTS[key], number(values, "mass") / 2
    speed = SI.speed.to_si(number(values, "rpm"))
    found = {
        "load": half_mass * g,
        "k": 2 * half_mass * speed**2,
        "u": 0.1 * number(values, "C"),
        "cs": 0.2 * half_mass * speed,
        "mj": 0.1 * half_mass,
    }.get(key, math.sqrt((item.least or item.low) * item.high))
    return min(max(float(f"{found:.2g}"), item.least or item.low), item.high)


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
