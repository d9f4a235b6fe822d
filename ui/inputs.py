"""The inputs of the sliders: their keys, symbols, units, ranges and groups.

A value is kept in the unit of the address bar (SI as engineers write it: mm, µm, mPa·s, rpm), under
its key there. `INPUTS` has those of every machine, `ui.bores` those of each kind of bore.
`machine_of` and `values_of` convert such values to the core's records and back: here a slider's
value becomes a machine, a bore's by `ui.bearing.shape_of`.
"""

import math
import re
from dataclasses import replace
from typing import Any

from scipy.constants import g

from rotorcalc import PRESETS, Gas, Machine, Oil, Preset, Rotor, Supply
from rotorcalc.coefficient_table import OWN
from rotorcalc.figures import style
from rotorcalc.units import SI, Units
from ui.bearing import (
    KIND,
    Values,
    bearing_of,
    bearing_values,
    defaults_of,
    kinds,
    without_shape,
)
from ui.bores import Pick, bore_inputs
from ui.format import amount, quoted
from ui.input_record import Input, tidy
from ui.own import TABLE, speeds_within

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
            least=0.01, follows="Load is half the rotor's weight",
        ),
        Input(
            "T", "temperature",
            "Film temperature", "T", "temperature", 0, 150, "Speed and whirl",
            "Gives the oil's viscosity, at every speed the same.", step=1,
        ),
        Input(
            "T_in", "supply.temperature",
            "Supply temperature", "Tᵢₙ", "temperature", 0, 150, "Speed and whirl",
            "Temperature of the oil that comes to the bearing; the film is warmer by half the "
            "oil's rise.", step=1,
        ),
        Input(
            "flow", "supply.flow",
            "Groove flow", "q", "flow", 0, 5000, "Speed and whirl",
            "What passes one bearing's grooves besides the side flow of its film.", least=0.001,
        ),
        Input(
            "share", "supply.heat_share",
            "Heat carried by the oil", "s", "number", 0, 1, "Speed and whirl",
            "Share of the loss that leaves with the oil; the rest leaves by shaft and housing.",
            step=0.01,
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
            "Affects the film's Reynolds number, its added mass and the heat that oil carries.",
        ),
        Input(
            "cp", "oil.heat_capacity",
            "Heat capacity", "c", "heat_capacity", 500, 5000, "Oil",
            "Heat that warms a unit mass of the oil by one degree.",
        ),
        Input(
            "mu_gas", "oil.reference_viscosity",
            "Reference viscosity", "μᵣ", "viscosity", 1e-3, 1, "Oil",
            "Viscosity of the gas at the reference temperature.",
        ),
        Input(
            "TR_gas", "oil.reference_temperature",
            "Reference temperature", "Tᵣ", "temperature", -50, 150, "Oil",
            "Temperature of the reference viscosity.", step=1,
        ),
        Input(
            "S_gas", "oil.sutherland_temperature",
            "Sutherland's temperature", "S", "rise", 0, 1000, "Oil",
            "By Sutherland's law the viscosity rises with temperature: the more, the greater this "
            "is.", least=1,
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
# The law of the oil's viscosity among the kept values, and its words.
LAW = "law"
LAWS = {"exponential": "Exponential", "walther": "Walther (ASTM D341)"}
# Inputs of a supply of oil, and what they are in a link that does not name them. With a supply
# there is no given film temperature; without one these are None.
SUPPLY: Values = {"T_in": None, "flow": 0.0, "share": 1.0}
# Inputs of an oil alone, and of a gas alone with what they are for air.
OIL = ("mu", "TR", "alpha", "rho", "cp")
_AIR = Gas()
GAS: Values = {
    "mu_gas": tidy(_AIR.reference_viscosity * 1e3), "TR_gas": _AIR.reference_temperature,
    "S_gas": _AIR.sutherland_temperature,
}  # fmt: skip
# Inputs that may be None: a value that follows from others, or one of what the machine has not.
OPTIONAL = frozenset(("load", "T", *SUPPLY, *GAS))
# Inputs that change nothing of own coefficients, which are those of one bearing, oil and load.
_OF_FILM = frozenset(("T", "D", "L", "C", *SUPPLY, *GAS, *OIL))

# Quantities that messages of the core have in SI, by their units there.
_KINDS = {
    "rad/s": "speed", "m³/s": "flow", "°C": "temperature", "W": "power", "N": "force",
    "Pa": "pressure",
}  # fmt: skip
_QUANTITY = re.compile(rf"(-?\d[\d.]*(?:e[+-]?\d+)?) ({'|'.join(_KINDS)})(?![\w·/])")

# Inputs that are not part of a machine: the speeds at which it is analysed.
_SPEEDS = ("speed", "top_speed")


def number(values: Values, key: str) -> float:
    """Return a kept number, or raise ValueError where it is missing."""
    value = values[key]
    if value is None or isinstance(value, str):
        raise ValueError(f"{INPUTS[key].label if key in INPUTS else key}: missing")
    return value


def values_of(machine: Machine, speed: float, top_speed: float) -> Values:
    """Return the kept values of a machine and its speeds [rad/s]."""
    speeds = {"speed": speed, "top_speed": top_speed}
    values: Values = {}
    oil = machine.oil
    for key, item in INPUTS.items():
        if key in (OIL if isinstance(oil, Gas) else GAS):
            continue
        value = speeds[item.field] if item.field in speeds else _at(machine, item.field)
        if value is not None and math.isnan(value):  # not known of own coefficients
            value = _at(PRESETS[DEFAULT_PRESET].machine, item.field)
        values[key] = None if value is None else tidy(float(item.unit(SI).of(value)))
    lubricant = {} if isinstance(oil, Gas) else dict.fromkeys(GAS) | {LAW: oil.law}
    return values | lubricant | bearing_values(machine.bearing)


def _at(machine: Machine, field: str) -> float | None:
    """Return the value of a record's field; a load that follows the weight has none."""
    record, _, name = field.rpartition(".")
    return getattr(getattr(machine, record) if record else machine, name, None)


def preset_values(preset: Preset) -> Values:
    """Return the kept values of a preset."""
    return values_of(preset.machine, preset.speed, preset.top_speed)


PRESET_VALUES: dict[str, Values] = {key: preset_values(preset) for key, preset in PRESETS.items()}


def usual_values(preset: str, like: Values) -> Values:
    """Return a preset's values, with a bearing of another kind as it is by itself.

    Where other values have a supply of oil, so has the preset, by itself.
    """
    values = PRESET_VALUES[preset]
    kind = like[KIND]
    if values[KIND] != kind:
        values = without_shape(values) | defaults_of(str(kind), values)
    if has_gas(values):
        return values | GAS
    return values | {"T": None} | SUPPLY if has_supply(like) else values


def has_supply(values: Values) -> bool:
    """Return whether the film's temperature follows from a supply of oil."""
    return values.get("T_in") is not None


def has_gas(values: Values) -> bool:
    """Return whether the bearing runs on a gas."""
    return kinds()[str(values[KIND])].lubricant == "gas"


def on_lubricant(values: Values) -> Values:
    """Return values with what their bearing's lubricant needs: air in a foil, no supply of oil.

    The film keeps its temperature where that is given; else it takes the supply's.
    """
    if not has_gas(values):
        return values | dict.fromkeys(GAS)
    T = values["T_in"] if has_supply(values) else values["T"]
    gas = {key: usual if values.get(key) is None else values[key] for key, usual in GAS.items()}
    return values | dict.fromkeys(SUPPLY) | {"T": T} | gas


def law_of(values: Values) -> str:
    """Return the law of the lubricant's viscosity in words."""
    return "Sutherland" if has_gas(values) else LAWS[str(values[LAW])]


def has_own(values: Values) -> bool:
    """Return whether the bearing is known by its own coefficients alone."""
    return values[KIND] == OWN


def applies(key: str, values: Values) -> bool:
    """Return whether an input changes a machine."""
    return _belongs(key, values) and not (has_own(values) and key in _OF_FILM)


def _belongs(key: str, values: Values) -> bool:
    """Return whether a machine has an input: film temperature or supply, those of oil or of gas."""
    if key in OIL or key in GAS:
        return (key in GAS) == has_gas(values)
    if key == "T":
        return not has_supply(values)
    return key not in SUPPLY or has_supply(values)


def machine_of(values: Values) -> Machine:
    """Return the machine that kept values describe, or raise ValueError in the sidebar's words."""
    try:
        return _machine_of(values)
    except ValueError as error:
        raise ValueError(in_words(f"{error}", values)) from error


def in_words(message: str, values: Values) -> str:
    """Return a message of the core with its fields' names as the sidebar has them."""
    for item in inputs_of(values).values():
        for name in (item.field, item.field.rpartition(".")[2]):
            if message.startswith(f"{name} = "):
                message = f"{item.words}{message.removeprefix(name)}"
        message = message.replace(f", {item.field} = ", f", {item.words} = ")
    return message


def in_units(message: str, units: Units) -> str:
    """Return a message of the core with its speeds, flows and temperatures in a visitor's units."""
    return _QUANTITY.sub(lambda found: _converted(found[1], found[2], units), message)


def as_shown(message: str, values: Values, units: Units) -> str:
    """Return a message of the core in the sidebar's words and a visitor's units."""
    return in_units(in_words(message, values), units)


def _converted(number: str, si: str, units: Units) -> str:
    return amount(getattr(units, _KINDS[si]), float(number))


def _machine_of(values: Values) -> Machine:
    records: dict[str, dict[str, Any]] = {
        "oil": {},
        "bearing": {},
        "rotor": {},
        "supply": {},
        "": {},
    }
    for key, item in INPUTS.items():
        record, _, name = item.field.rpartition(".")
        if item.field not in _SPEEDS and (record != "oil" or _belongs(key, values)):
            left_out = key in OPTIONAL and values[key] is None
            records[record][name] = None if left_out else item.unit(SI).to_si(number(values, key))
    supply = records["supply"]
    return Machine(
        oil=Gas(**records["oil"])
        if has_gas(values)
        else Oil(**records["oil"], law=str(values[LAW])),
        bearing=bearing_of(values, records["bearing"]),
        rotor=Rotor(**records["rotor"]),
        supply=None if supply["temperature"] is None else Supply(**supply),
        **records[""],
    )


def inputs_of(values: Values) -> dict[str, Input]:
    """Return the inputs of a machine's sliders by their keys, its bore's among them."""
    own = {key: fitting(item, values) for key, item in INPUTS.items() if applies(key, values)}
    return own | {item.key: item for item in bore_inputs(values) if not isinstance(item, Pick)}


def fitting(item: Input, values: Values) -> Input:
    """Return an input with the range that a machine leaves it: own coefficients end somewhere."""
    if item.key != "rpm" or not has_own(values) or not isinstance(values.get(TABLE), str):
        return item
    low, high = speeds_within(str(values[TABLE]))
    return replace(item, low=low, high=high)


def usual(key: str, values: Values) -> float:
    """Return the kept value about which an input's slider lies while it is zero or infinite.

    An estimate from the machine, so that one drag leads from zero to an effect that can be seen.
    """
    item, half_mass = input_named(key, values), number(values, "mass") / 2
    if item.step:
        return (item.low + item.high) / 2
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


def input_named(name: str, values: Values) -> Input:
    """Return a machine's input by its key, or raise ValueError."""
    found = inputs_of(values).get(name)
    if found is None:
        raise ValueError(f"{quoted(name)} is not an input")
    return found
