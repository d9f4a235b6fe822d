"""Inputs: kept values to the core's records and back, and a visitor's units and back."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc import PRESETS
from rotorcalc.units import SI, SYSTEMS, US
from ui.inputs import GROUPS, INPUTS, PRESET_VALUES, machine_of, speeds_of, values_of


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
    for key, item in INPUTS.items():
        assert item.problem(PRESET_VALUES[preset][key]) == "", key


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
            assert item.unit(units).name in item.name(units)


@pytest.mark.parametrize("word", ["1e999", "9" * 400, "-1e999"])
def test_an_overflowing_stiffness_is_not_read_as_a_rigid_shaft(word: str) -> None:
    with pytest.raises(ValueError, match="too large a number"):
        INPUTS["k"].taken(word, SI)
    assert INPUTS["k"].taken("rigid", SI) == INPUTS["k"].taken("inf", SI) == math.inf


def test_a_missing_value_is_named() -> None:
    with pytest.raises(ValueError, match="Radial clearance"):
        machine_of(PRESET_VALUES["sheet-1e8"] | {"C": None})


@pytest.mark.parametrize(("rpm", "top_rpm"), [(12000, 12000), (20000, 20000), (20010, 25000)])
def test_the_charts_run_to_a_round_number_above_the_running_speed(rpm: int, top_rpm: int) -> None:
    speed, top = speeds_of(PRESET_VALUES["sheet-1e8"] | {"rpm": rpm})
    assert speed == pytest.approx(rpm * math.pi / 30)
    assert top == pytest.approx(top_rpm * math.pi / 30)
