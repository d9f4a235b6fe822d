"""What moves an onset: the inputs to choose from, the map, the sensitivities.

Inputs go here by their keys in `ui.inputs`, those of a bearing's bore by theirs in `ui.bearing`;
the core names them by the fields of its records.
"""

import math
from contextlib import suppress
from functools import lru_cache

import numpy as np
import streamlit as st

from rotorcalc import Machine, design, rpm, variation
from rotorcalc.figures.design import Quantity
from rotorcalc.records import Bound
from rotorcalc.units import SI, Units
from ui.bearing import Field
from ui.bearing import fields_of as bore_fields
from ui.choices import choice
from ui.computed import Computed
from ui.format import amount
from ui.inputs import GAS, INPUTS, OIL, inputs_of, usual, values_of
from ui.jobs import cache, work
from ui.jobs.bar import show_progress
from ui.words.citation import without_load

# Whose effect goes by ratios: drawn and searched over a logarithmic axis.
_BY_RATIO = {"mass", "load", "mu", "C", "D", "L", "k", "flow", "cp"}
# How far an axis reaches from the machine's value, as a factor; of a bore's field the first that
# makes a bore.
_REACH = 10.0
_FACTORS = (_REACH, 5.0, 3.0, 2.0, 1.5, 1.2, 1.1)
# The widest clearance of a valid bearing over its radius, to rounding.
_WIDEST = 0.1 * (1.0 - 1e-9)
# Where a zero or infinite input depends on a running speed [rad/s], which an onset does not.
_SPEED = 6000 * rpm
# Cells a side of a map: where the onset has a closed form, and where it has none.
_FINE, _COARSE = 60, 11
_WHILE_DRAGGING = 30
_onset_map = cache.Cached(work.onset_map, entries=32, megabytes=8)
_sensitivities = cache.Cached(design.sensitivities, entries=64, megabytes=4)
TORNADO = (
    "Each input is varied alone by ±10 %, a temperature by the degrees shown. A load of zero is "
    "raised to 10 % of half the weight, a midspan damping of zero to 10 % of the critical damping, "
    "a journal mass of zero to 10 % of half the rotor's. Rotor mass changes the load too where "
    "that is half the weight."
)


def fields_of(machine: Machine) -> dict[str, str]:
    """Return the core's names of the inputs that move a machine's onset, by their keys.

    A number of pads is none: between two whole numbers there is no machine.
    """
    gas = machine.bearing.geometry.lubricant == "gas"
    own = {key: item.field for key, item in INPUTS.items() if key not in (OIL if gas else GAS)}
    named = own | {
        key: f"bearing.geometry.{field.name}"
        for key, field in bore_fields(machine.bearing.geometry.kind).items()
        if isinstance(field.rule.check, Bound) and not field.rule.check.whole
    }
    moving = design.inputs_of(machine)
    return {key: field for key, field in named.items() if field in moving}


def bore_field(machine: Machine, key: str) -> Field:
    """Return a field of the machine's bore."""
    return bore_fields(machine.bearing.geometry.kind)[key]


def name(machine: Machine, key: str) -> str:
    """Return an input's label and symbol."""
    if key not in INPUTS:
        return bore_field(machine, key).label
    return INPUTS[key].words


def quantity(key: str, machine: Machine, units: Units) -> Quantity:
    """Return an input as an axis about the machine's value, where that gives valid machines.

    Its ends are round, so that it seldom changes while the input is dragged.
    """
    if key not in INPUTS:
        return _bore_quantity(key, machine, units)
    item, is_log = INPUTS[key], key in _BY_RATIO
    low, high = item.low, item.high
    if not item.step:
        values = values_of(machine, _SPEED, _SPEED)
        now = values[key]
        about = now if isinstance(now, float) and 0.0 < now < math.inf else usual(key, values)
        about = _round(about)
        low, high = max(low, about / _REACH if is_log else 0.0), min(high, about * _REACH)
    low, high = (item.unit(SI).to_si(end) for end in (low, high))
    least, most = _valid(key, machine)
    return Quantity(
        item.label, item.symbol, item.unit(units), max(low, least), min(high, most), log=is_log
    )


def _round(value: float) -> float:
    """Return the nearest of 1, 3, 10 … to a number, by ratio."""
    power = 10.0 ** math.floor(math.log10(value))
    return min((power, 3.0 * power, 10.0 * power), key=lambda one: abs(math.log(value / one)))


def _bore_quantity(key: str, machine: Machine, units: Units) -> Quantity:
    field, now = bore_field(machine, key), value_of(machine, key)
    # A share or an angle has a linear slider; and what is zero has no ratios.
    item = inputs_of(values_of(machine, _SPEED, _SPEED)).get(key)
    if now <= 0.0 or (item is not None and item.step):
        return _over_its_slider(key, machine, units)
    ends = [
        next((end for factor in _FACTORS if _makes(machine, key, end := now * factor**sign)), now)
        for sign in (-1, 1)
    ]
    return Quantity(field.label, "", field.unit(units), *ends, log=True)


def _over_its_slider(key: str, machine: Machine, units: Units) -> Quantity:
    """Return a bore's field as a linear axis: its slider's, as far as that makes bores."""
    field = bore_field(machine, key)
    values = values_of(machine, _SPEED, _SPEED)
    item = inputs_of(values)[key]
    ends = (item.low, item.high) if item.step else (0.0, _REACH * usual(key, values))
    low, high = (_farthest(machine, key, item.unit(SI).to_si(end)) for end in ends)
    return Quantity(field.label, "", field.unit(units), low, high)


def _farthest(machine: Machine, key: str, end: float) -> float:
    """Return an end of a field's slider, or how near to it a machine can be, in tenths."""
    now = value_of(machine, key)
    ways = (end + (now - end) * tenths / 10.0 for tenths in range(10))
    return next((there for there in ways if _makes(machine, key, there)), now)


def _makes(machine: Machine, key: str, value: float) -> bool:
    """Return whether a value of a bore's field makes a machine; a record knows no upper end."""
    try:
        variation.varied(machine, {fields_of(machine)[key]: value})
    except ValueError:
        return False
    return True


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


def choose_input(machine: Machine, label: str, default: str, key: str, without: str = "") -> str:
    """Show a choice of the inputs that affect the onset; return the chosen one's key."""
    options = [one for one in fields_of(machine) if one != without]
    default = default if default in options else options[0]
    first = choice(key, default, options.__contains__)
    chosen = st.selectbox(
        label,
        options,
        index=options.index(first or default),
        format_func=lambda one: name(machine, one),
        key=key,
    )
    return chosen or default


def value_of(machine: Machine, key: str) -> float:
    """Return a machine's value of an input in SI."""
    return variation.value_of(machine, fields_of(machine)[key])


def names(machine: Machine, units: Units) -> dict[str, str]:
    """Return the names of the core's inputs for the tornado chart."""
    step = f"{design.TEMPERATURE_STEP * units.temperature.per_si:g} {units.temperature.name}"
    return {
        field: f"{name(machine, key)} ±{step}" if key in ("T", "T_in") else name(machine, key)
        for key, field in fields_of(machine).items()
    }


def onset_map(computed: Computed, x: str, y: str, units: Units) -> design.OnsetMap:
    """Return the onset over two inputs, with its progress shown where each cell takes long."""
    machine = computed.machine
    axes = [_axis(key, machine, units) for key in (x, y)]
    if computed.onset.method == "closed form" and "cs" not in {x, y}:
        return _onset_map(machine, *axes, _FINE)
    bar, tell = show_progress("The onset at every point of the map …")
    found = _onset_map(machine, *axes, _COARSE, tell=tell)
    bar.empty()
    return found


def sides(computed: Computed, onsets: design.OnsetMap, units: Units) -> str:
    """Return in words what of a map is stable at the running speed, and how coarse it is."""
    rows, columns = onsets.speed.shape
    coarse = (
        f" The onset is computed at {columns} × {rows} points, and interpolated between them."
        if rows <= _COARSE + 1
        else ""
    )
    return f"{_sides(computed, onsets, units)}{coarse}"


def _sides(computed: Computed, onsets: design.OnsetMap, units: Units) -> str:
    speed = onsets.speed[~np.isnan(onsets.speed)]
    running = amount(units.speed, computed.speed)
    if not np.any(speed < computed.speed):
        return f"All machines of this map are **stable** at {running}."
    if not np.any(speed >= computed.speed):
        why = f": {without_load(computed)}" if not speed.any() else ""
        return f"All machines of this map are **unstable** at {running}{why}."
    return f"Shaded: **unstable** at {running}. Along the red line the onset is {running}."


def coarse_map(computed: Computed, x: str, y: str, units: Units) -> design.OnsetMap:
    """Return a coarser map for each value of a dragged slider, some 40 ms.

    Raises ValueError where the onset has no closed form, and a map takes too long.
    """
    if computed.onset.method != "closed form" or "cs" in {x, y}:
        raise ValueError("the map is computed when the slider is released")
    machine = computed.machine
    axes = [_axis(key, machine, units) for key in (x, y)]
    with suppress(ValueError):
        # Its own values of the two inputs do not matter: while one is dragged the map stays.
        machine = variation.varied(machine, {field: low for field, low, *_ in axes})
    return _coarse_map(machine, *axes)


@lru_cache(maxsize=8)
def _coarse_map(machine: Machine, x: work.Axis, y: work.Axis) -> design.OnsetMap:
    return work.onset_map(machine, x, y, _WHILE_DRAGGING)


def _axis(key: str, machine: Machine, units: Units) -> work.Axis:
    axis = quantity(key, machine, units)
    return fields_of(machine)[key], axis.low, axis.high, axis.log


def sensitivities(computed: Computed) -> design.Sensitivities:
    """Return the onset's change with each input."""
    return _sensitivities(computed.machine)
