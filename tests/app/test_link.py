"""The address bar: what is written is read back, and what cannot be read is named."""

import math
import string

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rotorcalc import PRESETS
from rotorcalc.records import Bound, Choice
from rotorcalc.units import SYSTEMS, US
from tests.films.models import BEARINGS
from ui.bearing import KIND, Field, Value, Values, bearing_values, fields_of
from ui.input_record import Input, tidy
from ui.inputs import (
    DEFAULT_PRESET,
    GAS,
    INPUTS,
    LAW,
    LAWS,
    OPTIONAL,
    PRESET_VALUES,
    SUPPLY,
    has_gas,
    inputs_of,
    machine_of,
    on_lubricant,
)
from ui.sharing import address


def _number(item: Input) -> st.SearchStrategy[float | None]:
    """Draw what a slider, a typed field or a file can give."""
    numbers: st.SearchStrategy[float | None] = (
        st.floats(item.low, item.high).map(tidy).filter(lambda value: not item.problem(value))
    )
    if item.infinite:
        numbers |= st.just(math.inf)
    return numbers | st.none() if item.key == "load" else numbers


@st.composite
def drawn_values(draw: st.DrawFn, preset: str) -> Values:
    drawn = {key: draw(_number(item)) for key, item in INPUTS.items()}
    values = {
        key: value if draw(st.booleans()) else PRESET_VALUES[preset][key]
        for key, value in drawn.items()
    }
    values["mj"] = min(values["mj"], tidy(0.49 * values["mass"]))
    absent = ("T",) if draw(st.booleans()) else SUPPLY
    values |= {key: drawn[key] for key in ("T", *SUPPLY)} | dict.fromkeys(absent)
    values[LAW] = draw(st.sampled_from(sorted(LAWS)))
    if values[LAW] == "walther":  # which neither so thin an oil has, nor one far from its reference
        values["mu"] = max(values["mu"], tidy(1e-3 * values["rho"]))
        values["T_in" if values["T"] is None else "T"] = values["TR"]
    # µm: less than a tenth of the radius
    values["C"] = min(values["C"], tidy(49.0 * values["D"]))
    bearing = bearing_values(BEARINGS[draw(st.sampled_from(sorted(BEARINGS)))])
    share = draw(st.floats(0.3, 1.0))
    for key, field in fields_of(bearing[KIND]).items():
        bearing[key] = draw(_of_bore(field, bearing[key], share))
    if "outer_radius" in bearing:  # around the journal
        bearing["outer_radius"] = max(bearing["outer_radius"], tidy(0.6 * values["D"]))
    values = values | bearing
    return on_lubricant(values) | ({"T": 20.0} if has_gas(values) and values["T"] is None else {})


def _of_bore(field: Field, usual: Value, share: float) -> st.SearchStrategy[Value]:
    """Draw a value of a bore's field; bounded ones shrink together, so that its parts fit."""
    check = field.rule.check
    if isinstance(check, Choice):
        return st.sampled_from(check.words)
    assert isinstance(check, Bound)
    if check.whole:
        return st.sampled_from([float(usual), float(usual) - 1.0])
    if math.isinf(check.below):
        return st.floats(1e-3, 1e3) | st.just(usual)
    if usual:
        return st.just(max(check.at_least, share * float(usual)))
    return st.just(usual) | st.floats(1e-3, 0.9)


@pytest.mark.parametrize("preset", PRESETS)
@given(data=st.data(), units=st.sampled_from(sorted(SYSTEMS)))
def test_a_link_reads_back_as_it_was_written(preset: str, data: st.DataObject, units: str) -> None:
    values = data.draw(drawn_values(preset))
    params = address.write(preset, values, units)
    again = address.read(params)
    assert again.problems == []
    assert (again.preset, again.units) == (preset, units)
    assert again.values == values
    assert address.write(again.preset, again.values, again.units) == params


@pytest.mark.parametrize("preset", PRESETS)
def test_the_link_of_a_preset_names_only_the_preset(preset: str) -> None:
    expected = {} if preset == DEFAULT_PRESET else {"preset": preset}
    assert address.write(preset, PRESET_VALUES[preset], "SI") == expected


@pytest.mark.parametrize("key", INPUTS)
@pytest.mark.parametrize(
    "word",
    ["", "abc", "nan", "-inf", "1e999", "-1e300", "9" * 400, "0x10", "<b>1</b>", "1;2", "1 2", "`"],
)
def test_a_value_that_cannot_be_used_is_named_and_the_rest_is_kept(key: str, word: str) -> None:
    other = "T" if key != "T" else "D"
    read = address.read({key: word, other: "77"})
    (problem,) = read.problems
    assert INPUTS[key].label in problem
    assert f"({key} = " in problem
    assert len(problem) < 250
    assert read.values == PRESET_VALUES[DEFAULT_PRESET] | {other: 77.0}


@pytest.mark.parametrize("word", ["inf", "Infinity"])
def test_a_rigid_shaft_is_written_as_infinity(word: str) -> None:
    read = address.read({"k": word})
    assert (read.values["k"], read.problems) == (math.inf, [])
    assert address.write(read.preset, read.values, "SI") == {"k": "inf"}


@pytest.mark.parametrize("key", INPUTS)
@given(data=st.data())
def test_a_link_keeps_a_reading_in_other_units_without_rounding(
    key: str, data: st.DataObject
) -> None:
    item = INPUTS[key]
    low, high = item.shown(item.low, US), item.shown(item.high, US)
    reading = float(f"{data.draw(st.floats(low, high)):.3g}")
    values = PRESET_VALUES[DEFAULT_PRESET] | {key: item.stored(reading, US)}
    word = address.write(DEFAULT_PRESET, values, "SI").get(key, "0")
    mantissa = word.split("e")[0].replace(".", "").strip("-0")
    assert len(mantissa) <= 14


def test_a_link_with_a_rounded_reading_is_read_as_the_reading() -> None:
    assert address.read({"C": "88.899999999999991"}).values["C"] == 88.9


def test_three_and_a_half_mil_are_88_9_micrometres_in_a_link() -> None:
    values = PRESET_VALUES[DEFAULT_PRESET] | {"C": INPUTS["C"].stored(3.5, US)}
    assert address.write(DEFAULT_PRESET, values, "SI") == {"C": "88.9"}


@pytest.mark.parametrize("key", INPUTS)
def test_both_ends_are_in_and_beyond_them_is_out(key: str) -> None:
    item = INPUTS[key]
    for end, beyond in ((item.low, -math.inf), (item.high, math.inf)):
        # No end of another input leaves this without a disk, or with too wide a clearance.
        given_values = {"mass": "1e5", "D": "1200", key: repr(float(end))}
        supply = {"T_in": "40"} if key in SUPPLY else {"bearing": "foil"} if key in GAS else {}
        assert address.read(supply | given_values).problems == []
        outside = math.nextafter(end, beyond)
        assert len(address.read(supply | {key: repr(outside)}).problems) == 1


def test_a_journal_mass_that_leaves_no_disk_is_named() -> None:
    read = address.read({"mj": "140", "C": "80"})
    (problem,) = read.problems
    assert "Journal mass Mⱼ" in problem
    assert "140" in problem
    assert read.values == PRESET_VALUES[DEFAULT_PRESET] | {"C": 80.0}


def test_a_link_whose_mass_leaves_no_disk_still_gives_a_machine() -> None:
    read = address.read({"mass": "10", "mj": "4"})
    assert read.problems == []
    read = address.read({"mass": "10", "mj": "5"})
    assert len(read.problems) == 1
    machine_of(read.values)


@pytest.mark.parametrize("word", ["none", "", "<script>", "sheet-1e9", "x" * 5000])
def test_an_unknown_preset_or_system_of_units_is_named(word: str) -> None:
    for key in ("preset", "units"):
        read = address.read({key: word, "C": "80"})
        (problem,) = read.problems
        assert problem.startswith(f"{key} = ")
        assert len(problem) < 250
        assert read.preset == DEFAULT_PRESET
        assert read.units == "SI"
        assert read.values["C"] == 80.0


def test_the_weight_can_be_named() -> None:
    assert address.read({"preset": "friswell-5-5-1", "load": "weight"}).values["load"] is None


@given(
    st.dictionaries(
        st.sampled_from([*INPUTS, "preset", "units"]) | st.text(max_size=20),
        st.text(max_size=40) | st.text(string.digits + ".e-+", max_size=12),
    )
)
@example({"C": "1_0"})
@example({"C": "١٢٠"})
def test_no_link_breaks_the_program(params: dict[str, str]) -> None:
    read = address.read(params)
    machine_of(read.values)
    assert all(not item.problem(read.values[key]) for key, item in inputs_of(read.values).items())
    named = " ".join(read.problems)
    for key in params.keys() - {"preset", "units"}:
        assert key not in INPUTS or read.values[key] is not None or key in OPTIONAL or key in named


@given(st.text(max_size=300))
def test_quoted_input_is_never_markup(word: str) -> None:
    shown = address.quoted(word)
    assert shown.startswith("`")
    assert shown.endswith("`")
    assert "`" not in shown[1:-1]
    assert "\n" not in shown
    assert len(shown) < 60
