"""What moves an onset: the inputs to choose from, the map, the sensitivities, the solved values.

Inputs go here by their keys in `ui.inputs`; the core names them by the fields of its records.
"""

import math
from functools import lru_cache

import streamlit as st

from rotorcalc import Machine, design, rpm, variation
from rotorcalc.figures.design import Quantity
from rotorcalc.units import SI, Units
from ui.choices import choice
from ui.computed import Computed
from ui.format import amount, digits
from ui.inputs import INPUTS, usual, values_of
from ui.jobs import cache, work

# The core's names for the inputs that move an onset.
FIELDS = {key: item.field for key, item in INPUTS.items() if item.field in design.INPUTS}
_KEYS = {name: key for key, name in FIELDS.items()}
# Whose effect goes by ratios: drawn and searched over a logarithmic axis.
_BY_RATIO = {"mass", "load", "mu", "C", "D", "L", "k"}
# How far an axis reaches from the machine's value, as a factor.
_REACH = 10.0
# The widest clearance of a valid bearing over its radius, to rounding.
_WIDEST = 0.1 * (1.0 - 1e-9)
# Where a zero or infinite input depends on a running speed [rad/s], which an onset does not.
_SPEED = 6000 * rpm
# Cells a side of a map: where the onset has a closed form, and where it has none.
_FINE, _COARSE = 60, 11
_WHILE_DRAGGING = 30
_onset_map = cache.Cached(work.onset_map, entries=32, megabytes=8)
_sensitivities = cache.Cached(design.sensitivities, entries=64, megabytes=4)
_solution = cache.Cached(work.solution, entries=64, megabytes=4)
TORNADO = (
    "Each input is varied alone by ±10 %, a temperature by the degrees shown. Beside each input: "
    "the onset's change for less / more. Rotor mass changes the load too where that is half the "
    "weight. Inputs at zero or infinity are left out."
)


def quantity(key: str, machine: Machine, units: Units) -> Quantity:
    """Return an input as an axis about the machine's value, where that gives valid machines."""
    item, is_log = INPUTS[key], key in _BY_RATIO
    low, high = item.low, item.high
    if not item.step:
        values = values_of(machine, _SPEED, _SPEED)
        now = values[key]
        about = now if isinstance(now, float) and 0.0 < now < math.inf else usual(key, values)
        low, high = max(low, about / _REACH if is_log else 0.0), min(high, about * _REACH)
    low, high = (item.unit(SI).to_si(end) for end in (low, high))
    least, most = _valid(key, machine)
    return Quantity(
        item.label, item.symbol, item.unit(units), max(low, least), min(high, most), log=is_log
    )


def _valid(key: str, machine: Machine) -> tuple[float, float]:
    """Return between which values [SI] an input leaves a disk, and a clearance that is small."""
    rotor, bearing = machine.rotor, machine.bearing
    if key == "mass":
        return 2.1 * rotor.journal_mass, math.inf
    if key == "mj":
        return 0.0, 0.95 * rotor.half_mass
    if key == "D":
        return 2.0 / _WIDEST * bearing.radial_clearance, math.inf
    return -math.inf, _WIDEST * bearing.radius if key == "C" else math.inf


def choose_input(label: str, default: str, key: str, without: str = "") -> str:
    """Show a choice of the inputs that affect the onset; return the chosen one's key."""
    options = [name for name in FIELDS if name != without]
    default = default if default in options else options[0]
    first = choice(key, default, options.__contains__)
    chosen = st.selectbox(
        label,
        options,
        index=options.index(first or default),
        format_func=lambda name: f"{INPUTS[name].label} {INPUTS[name].symbol}",
        key=key,
    )
    return chosen or default


def choose_target(computed: Computed, units: Units) -> float:
    """Show a field for the target onset; return it [rad/s]."""
    key = "stability_target"
    if not st.session_state.get("stability_target_typed"):
        st.session_state[key] = float(round(1.2 * float(units.speed.of(computed.speed)), -1))
    target = st.number_input(
        f"Target onset [{units.speed.name}]",
        min_value=10.0,
        max_value=1e6,
        step=100.0,
        format="%.0f",
        key=key,
        persist_state="session",
        on_change=lambda: st.session_state.update(stability_target_typed=True),
        help="By default 1.2 times the running speed.",
    )
    return units.speed.to_si(target)


def value(computed: Computed, key: str) -> float:
    """Return a machine's value of an input in SI."""
    return variation.value_of(computed.machine, FIELDS[key])


def names(units: Units) -> dict[str, str]:
    """Return the names of the core's inputs for the tornado chart."""
    step = f"{design.TEMPERATURE_STEP * units.temperature.per_si:g} {units.temperature.name}"
    return {name: f"{INPUTS[key].label} {INPUTS[key].symbol}" for name, key in _KEYS.items()} | {
        "temperature": f"{INPUTS['T'].label} {INPUTS['T'].symbol} ±{step}"
    }


def onset_map(computed: Computed, x: str, y: str, units: Units) -> design.OnsetMap:
    """Return the onset over two inputs, with its progress shown where each cell takes long."""
    machine = computed.machine
    axes = [_axis(key, machine, units) for key in (x, y)]
    if computed.onset.method == "closed form" and "cs" not in {x, y}:
        return _onset_map(machine, *axes, _FINE)
    bar = st.progress(0.0, "The onset at every point of the map …")
    found = _onset_map(machine, *axes, _COARSE, tell=bar.progress)
    bar.empty()
    return found


def coarse_map(computed: Computed, x: str, y: str, units: Units) -> design.OnsetMap:
    """Return a coarser map for each value of a dragged slider, some 40 ms.

    Raises ValueError where the onset has no closed form, and a map takes too long.
    """
    if computed.onset.method != "closed form" or "cs" in {x, y}:
        raise ValueError("the map is computed when the slider is released")
    machine = computed.machine
    return _coarse_map(machine, *(_axis(key, machine, units) for key in (x, y)))


@lru_cache(maxsize=8)
def _coarse_map(machine: Machine, x: work.Axis, y: work.Axis) -> design.OnsetMap:
    return work.onset_map(machine, x, y, _WHILE_DRAGGING)


def _axis(key: str, machine: Machine, units: Units) -> work.Axis:
    axis = quantity(key, machine, units)
    return FIELDS[key], axis.low, axis.high, axis.log


def sensitivities(computed: Computed) -> design.Sensitivities:
    """Return the onset's change with each input."""
    return _sensitivities(computed.machine)


def solution(computed: Computed, key: str, target: float, units: Units) -> design.OnsetSolution:
    """Return the values of an input that put the onset at a speed."""
    axis = quantity(key, computed.machine, units)
    return _solution(computed.machine, FIELDS[key], target, axis.low, axis.high)


def answer(found: design.OnsetSolution, axis: Quantity, now: float, units: Units) -> str:
    """Return a text with the values that meet the target, or the range that can be reached."""
    speed = amount(units.speed, found.target)
    if len(found.solutions):
        values = " or ".join(f"**{axis.text(value)}**" for value in found.solutions)
        return f"{axis.words} {values} puts the onset at {speed}; now it is {_now(axis, now)}."
    low, high = (float(units.speed.of(end)) for end in found.reachable)
    ends = f"{axis.text(axis.low)} and {axis.text(axis.high)}"
    if low == high:
        return f"{axis.words} does not affect the onset of this machine."
    reached = f"{digits(low)} and {_speed_word(high)} {units.speed.name}"
    return (
        f"No value of the {axis.words.lower()} between {ends} puts the onset at {speed}: it stays "
        f"between {reached}."
    )


def _now(axis: Quantity, value: float) -> str:
    return "infinite" if math.isinf(value) else axis.text(value)


def _speed_word(rpm: float) -> str:
    return "infinity," if math.isinf(rpm) else digits(rpm)
