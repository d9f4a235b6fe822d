"""Inputs: kept values to the core's records and back, and a visitor's units and back."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc import PRESETS, heat
from rotorcalc.units import SI, SYSTEMS, US
from ui.bearing import Values
from ui.computed import computed_from
from ui.input_record import Input
from ui.inputs import (
    GROUPS,
    INPUTS,
    PRESET_VALUES,
    SUPPLY,
    inputs_of,
    machine_of,
    speeds_of,
    usual,
    values_of,
)
from ui.preview import Preview


def _flat(tree: object) -> list[object]:
    """Return the leaves of a machine's records."""
    if hasattr(tree, "__dataclass_fields__"):
        return [leaf for name in tree.__dataclass_fields__ for leaf in _flat(getattr(tree, name))]
    return [tree]


@pytest.mark.parametrize("preset", PRESETS)
def test_a_presets_machine_survives_values_and_back(preset: str) -> None:
    machine = PRESETS[preset].machine
    again = machine_of(PRESET_VALUES[preset])
    # Values are kept to fourteen digits, so that a link shows 150 and not 150.00000000000003.
    for kept, original in zip(_flat(again), _flat(machine), strict=True):
        same = pytest.approx(original, rel=1e-13) if isinstance(original, float) else original
        assert kept == same
    speed, top = speeds_of(PRESET_VALUES[preset])
    assert speed == pytest.approx(PRESETS[preset].speed, rel=1e-13)
    assert top == pytest.approx(PRESETS[preset].top_speed, rel=1e-13)


@pytest.mark.parametrize("preset", PRESETS)
def test_values_come_back_from_their_machine_exactly(preset: str) -> None:
    values = PRESET_VALUES[preset]
    assert values_of(machine_of(values), *speeds_of(values)) == values


@pytest.mark.parametrize("preset", PRESETS)
def test_a_preset_lies_within_the_sliders(preset: str) -> None:
    values = PRESET_VALUES[preset]
    for key, item in inputs_of(values).items():
        assert item.problem(values[key]) == "", key


@pytest.mark.parametrize("key", INPUTS)
@pytest.mark.parametrize("units", SYSTEMS)
@given(data=st.data())
def test_a_reading_survives_conversion_and_back(key: str, units: str, data: st.DataObject) -> None:
    item = INPUTS[key]
    value = data.draw(st.floats(item.low, item.high))
    there_and_back = item.stored(item.shown(value, SYSTEMS[units]), SYSTEMS[units])
    # Of a temperature near 0 °C, which is 32 °F, only the absolute error is small.
    assert there_and_back == pytest.approx(value, rel=1e-12, abs=1e-12 * item.high)


@pytest.mark.parametrize(
    ("key", "value", "shown"),
    [
        ("mass", 0.45359237, 1.0),
        ("load", 4.4482216152605, 1.0),
        ("T", 100.0, 212.0),
        ("D", 25.4, 1.0),
        ("C", 25.4, 1.0),
        ("mu", 6.894757293168361, 1.0),
        ("k", 175.12683524647636, 1.0),
        ("alpha", 0.018, 0.01),
        ("rpm", 3000.0, 3000.0),
    ],
)
def test_us_units(key: str, value: float, shown: float) -> None:
    assert INPUTS[key].shown(value, US) == pytest.approx(shown, rel=1e-12)
    assert INPUTS[key].stored(shown, US) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("key", INPUTS)
def test_si_needs_no_arithmetic(key: str) -> None:
    assert INPUTS[key].shown(0.1 + 0.2, SI) == 0.1 + 0.2
    assert INPUTS[key].stored(0.1 + 0.2, SI) == 0.1 + 0.2


def test_every_input_has_a_group_a_name_and_an_explanation() -> None:
    for item in INPUTS.values():
        assert item.group in GROUPS
        assert item.help.endswith((".", ")"))
        for units in SYSTEMS.values():
            assert item.label in item.name(units)
            unit = item.unit(units).name
            assert item.name(units) == (item.words if unit == "-" else f"{item.words} [{unit}]")


@pytest.mark.parametrize("word", ["1e999", "9" * 400, "-1e999"])
def test_an_overflowing_stiffness_is_not_read_as_a_rigid_shaft(word: str) -> None:
    with pytest.raises(ValueError, match="too large a number"):
        INPUTS["k"].taken(word, SI)
    assert INPUTS["k"].taken("rigid", SI) == INPUTS["k"].taken("inf", SI) == math.inf


def test_a_missing_value_is_named() -> None:
    with pytest.raises(ValueError, match="Radial clearance"):
        machine_of(PRESET_VALUES["sheet-1e8"] | {"C": None})


def test_a_refused_balance_is_said_in_the_sidebars_words_and_a_visitors_units() -> None:
    # An oil that does not thin is as hot as its flow leaves it: 306 °C at 6000 rpm.
    values = PRESET_VALUES["sheet-1e8"] | {
        "T": None, "T_in": 45.0, "flow": 0.5, "share": 1.0, "alpha": 0.0,
    }  # fmt: skip
    held = Preview(values, computed_from(values), None, US, dark=False)
    with pytest.raises(ValueError, match="the film would be hotter than") as refused:
        held.at("rpm", "12000")
    words = f"{refused.value}"
    assert words.startswith("Supply temperature Tᵢₙ = 113 °F, Groove flow q = ")
    assert "hotter than 698 °F" in words
    assert not any(unit in words for unit in ("rad/s", "m³/s", "°C", " W "))


@pytest.mark.parametrize(("rpm", "top_rpm"), [(12000, 12000), (20000, 20000), (20010, 25000)])
def test_the_charts_run_to_a_round_number_above_the_running_speed(rpm: int, top_rpm: int) -> None:
    speed, top = speeds_of(PRESET_VALUES["sheet-1e8"] | {"rpm": rpm})
    assert speed == pytest.approx(rpm * math.pi / 30)
    assert top == pytest.approx(top_rpm * math.pi / 30)


# Of the smallest and the largest machines that are known to run in such bearings.
@pytest.mark.parametrize(
    "machine",
    [
        {"mass": 0.05, "D": 3.0, "L": 1.5, "C": 3.0, "rpm": 300000.0},
        {"mass": 0.1, "D": 7.0, "L": 5.0, "C": 15.0, "rpm": 150000.0, "k": 1e6},
        {"mass": 23000.0, "load": 112814.91, "D": 400.0, "L": 263.1, "C": 195.0, "rpm": 3000.0},
        {"mass": 100000.0, "D": 1200.0, "L": 900.0, "C": 2000.0, "load": 2e6, "rpm": 1500.0},
    ],
)
def test_small_and_large_machines_lie_within_the_sliders(machine: dict[str, float]) -> None:
    assert all(not INPUTS[key].problem(value) for key, value in machine.items())
    values = PRESET_VALUES["sheet-1e8"] | machine
    assert computed_from(values).onset.speed > 0.0


@pytest.mark.parametrize("seed", range(60))
def test_any_machine_of_the_whole_ranges_is_analysed(seed: int) -> None:
    values = _drawn(np.random.default_rng(seed), supplied=seed % 3 == 0)
    computed = computed_from(values)
    if not heat.has_film(computed.machine, computed.speed):  # too hot: no balance
        with pytest.raises(ValueError, match="supply"):
            _ = computed.point
        assert computed.onset.speed >= 0.0
        return
    assert isinstance(computed.is_stable, bool | np.bool_)
    assert computed.onset.speed >= 0.0
    assert not np.any(np.isnan(computed.point.flexible_eigenvalues))


def _drawn(random: np.random.Generator, *, supplied: bool) -> Values:
    """Draw values of the sliders, their ends and zeros included, that make a machine."""
    absent = dict.fromkeys(("T",) if supplied else SUPPLY)
    while True:
        drawn = {k: _place(i, random) for k, i in INPUTS.items()}
        values = PRESET_VALUES["sheet-1e8"] | drawn | absent
        try:
            machine_of(values)
        except ValueError:  # no disk, or too wide a clearance
            continue
        return values


def _place(item: Input, random: np.random.Generator) -> float:
    if random.random() < 0.3:
        return float(random.choice([item.low, math.inf if item.infinite else item.high]))
    if item.step:
        return random.uniform(item.low, item.high)
    low = item.least or item.low
    return low * (item.high / low) ** random.random()


@pytest.mark.parametrize("preset", PRESETS)
def test_a_slider_at_a_stop_lies_about_a_value_of_its_range(preset: str) -> None:
    values = PRESET_VALUES[preset]
    for key, item in inputs_of(values).items():
        assert (item.least or item.low) <= usual(key, values) <= item.high
