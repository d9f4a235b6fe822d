"""The machine's records: every bound of every field, and JSON that loses nothing."""

import dataclasses
import json
import math
import struct
from dataclasses import make_dataclass, replace
from decimal import Decimal
from fractions import Fraction
from typing import Annotated

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.constants import g

from rotorcalc import JournalBearing, Machine, Oil, Rotor
from rotorcalc.geometry import MultiDam, Plain
from rotorcalc.records import Bound, Kind, Record, from_tree, to_tree
from tests.machines import EPS, SHEET, with_rotor

GOOD = {
    Oil: {
        "reference_viscosity": 0.02,
        "reference_temperature": 50.0,
        "temperature_coefficient": 0.03,
        "density": 860.0,
    },
    JournalBearing: {"diameter": 0.1, "length": 0.05, "radial_clearance": 1e-4},
    Rotor: {
        "mass": 200.0,
        "shaft_stiffness": 1e8,
        "imbalance": 1e-5,
        "disk_damping": 100.0,
        "journal_mass": 5.0,
    },
    Machine: {
        "oil": SHEET.oil,
        "bearing": SHEET.bearing,
        "rotor": SHEET.rotor,
        "temperature": 60.0,
        "load": 1000.0,
    },
}
POSITIVE = [
    (Oil, "reference_viscosity"),
    (Oil, "density"),
    (JournalBearing, "diameter"),
    (JournalBearing, "length"),
    (JournalBearing, "radial_clearance"),
    (Rotor, "mass"),
    (Rotor, "shaft_stiffness"),
]
NOT_NEGATIVE = [
    (Oil, "temperature_coefficient"),
    (Rotor, "imbalance"),
    (Rotor, "disk_damping"),
    (Rotor, "journal_mass"),
    (Machine, "load"),
]
TEMPERATURES = [(Oil, "reference_temperature"), (Machine, "temperature")]
NUMBERS = POSITIVE + NOT_NEGATIVE + TEMPERATURES
HUGE = 10**400


class Unprintable:
    def __repr__(self):
        raise RuntimeError


def made(record, **changes):
    return record(**{**GOOD[record], **changes})


def error(record, **changes):
    """Return the message with which a record refuses some values."""
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - the message is what is returned
        made(record, **changes)
    return str(caught.value)


# Bounds


@pytest.mark.parametrize(
    ("clearance", "words"),
    [
        (60.0, "radial_clearance = 60 m (6e+07 µm): must be at most a tenth of the radius, "),
        (
            0.06,
            "radial_clearance = 0.06 m (60000 µm): must be at most a tenth of the radius, ",
        ),
        (0.0076, "radial_clearance = 0.0076 m (7600 µm): must be at most a tenth of the radius, "),
    ],
)
def test_a_clearance_in_the_wrong_unit_is_refused_with_its_size(clearance, words):
    message = error(JournalBearing, diameter=0.150, radial_clearance=clearance)
    assert message.startswith(words)
    assert "0.0075 m (7500 µm); lengths are in metres" in message


def test_a_clearance_of_a_tenth_of_the_radius_is_accepted():
    bearing = made(JournalBearing, diameter=0.2, radial_clearance=0.01)
    assert bearing.radial_clearance == 0.01


@pytest.mark.parametrize("temperature", ["50", math.nan, None, [20.0, math.inf], True, {}, -1e5])
def test_viscosity_at_an_invalid_temperature_is_refused(temperature):
    with pytest.raises(ValueError, match=r"^temperature = "):
        SHEET.oil.viscosity(temperature)


@pytest.mark.parametrize(("record", "name"), POSITIVE)
@pytest.mark.parametrize("value", [0.0, -0.0, -1e-300, -5.0, -1])
def test_a_positive_field_refuses_zero_and_less(record, name, value):
    assert error(record, **{name: value}).startswith(f"{name} = {value!r} ")
    assert "must be positive" in error(record, **{name: value})


@pytest.mark.parametrize(("record", "name"), NOT_NEGATIVE)
@pytest.mark.parametrize("value", [-1e-300, -5.0, -1])
def test_a_nonnegative_field_refuses_negative_numbers(record, name, value):
    assert error(record, **{name: value}).startswith(f"{name} = {value!r} ")
    assert "must be at least 0 " in error(record, **{name: value})


@pytest.mark.parametrize(("record", "name"), NOT_NEGATIVE)
def test_a_nonnegative_field_accepts_zero(record, name):
    assert getattr(made(record, **{name: 0}), name) == 0.0


@pytest.mark.parametrize(("record", "name"), POSITIVE)
def test_a_positive_field_accepts_the_smallest_positive_number(record, name):
    # With the smallest mass there is no journal to take out of it, and a journal has its clearance.
    others = {"mass": {"journal_mass": 0.0}, "diameter": {"radial_clearance": 1e-303}}.get(name, {})
    assert getattr(made(record, **{name: 1e-300}, **others), name) == 1e-300


@pytest.mark.parametrize(("record", "name"), TEMPERATURES)
def test_a_temperature_ends_at_absolute_zero(record, name):
    assert getattr(made(record, **{name: -273.15}), name) == -273.15
    assert error(record, **{name: -273.16}) == (f"{name} = -273.16 °C: must be at least -273.15 °C")


@pytest.mark.parametrize(("record", "name"), NUMBERS)
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, np.nan, np.float32(np.nan)])
def test_a_number_that_is_not_finite_is_refused(record, name, value):
    if name == "shaft_stiffness" and value == math.inf:
        assert made(record, shaft_stiffness=value).is_rigid
    else:
        message = error(record, **{name: value})
        assert message.startswith(f"{name} = ")
        assert repr(value) in message
        assert "must be finite" in message or "must be positive" in message


@pytest.mark.parametrize(("record", "name"), NUMBERS)
@pytest.mark.parametrize(
    "value",
    ["1.0", b"1", True, False, [1.0], (1.0,), {}, 1j, Decimal(1), np.ones(2), Unprintable()],
)
def test_a_value_that_is_not_a_number_is_refused(record, name, value):
    message = error(record, **{name: value})
    assert message.startswith(f"{name} = ")
    assert "must be a number in " in message


@pytest.mark.parametrize(("record", "name"), [pair for pair in NUMBERS if pair[1] != "load"])
def test_none_is_refused_except_as_a_load(record, name):
    assert error(record, **{name: None}).startswith(f"{name} = None: must be a number")
    assert made(Machine, load=None).load is None


@pytest.mark.parametrize(("record", "name"), NUMBERS)
@pytest.mark.parametrize(
    "value",
    [HUGE, -HUGE, 10**5000, -(10**5000), Fraction(HUGE)],
    ids=["huge", "-huge", "unprintable", "-unprintable", "fraction"],
)
def test_an_integer_beyond_the_largest_float_is_refused_and_not_read_as_infinity(
    record, name, value
):
    assert error(record, **{name: value}).startswith(f"{name} = ")
    assert "too large for a number" in error(record, **{name: value})


@pytest.mark.parametrize(
    "value", [3, np.float32(3), np.float64(3), np.int64(3), np.uint8(3), Fraction(3)]
)
def test_any_real_number_is_kept_as_a_float(value):
    mass = Rotor(mass=value).mass
    assert type(mass) is float
    assert mass == 3.0


@pytest.mark.parametrize("name", ["oil", "bearing", "rotor"])
@pytest.mark.parametrize("value", [None, {}, "oil", 1.0, Unprintable()])
def test_a_component_of_the_wrong_type_is_refused(name, value):
    kinds = {"oil": "Gas or Oil", "bearing": "CoefficientTable or JournalBearing"}
    kind = kinds.get(name, "Rotor")
    message = error(Machine, **{name: value})
    assert message.startswith(f"{name} = ")
    assert message.endswith(f"must be {kind}")


@pytest.mark.parametrize("film", ["Short", "", 1, ["short"], {}])
def test_an_unknown_film_model_is_refused(film):
    message = error(JournalBearing, film=film)
    assert message == f"film = {film!r}: must be one of ('short', 'finite', 'coarse')"


@pytest.mark.parametrize("journal_mass", [100.0, 100.1, 1e300])
def test_journals_that_leave_no_disk_are_refused(journal_mass):
    message = error(Rotor, journal_mass=journal_mass)
    assert message.startswith(f"journal_mass = {journal_mass:g} kg: must be less than half ")
    assert "100 kg" in message


def test_journals_that_leave_the_least_disk_are_accepted():
    assert made(Rotor, journal_mass=math.nextafter(100.0, 0)).disk_mass > 0


@pytest.mark.parametrize("temperature", [1e5, 1e308, -273.15])
def test_a_temperature_that_leaves_no_finite_viscosity_is_refused(temperature):
    oil = made(Oil, temperature_coefficient=4.0 if temperature < 0 else 0.03)
    message = error(Machine, oil=oil, temperature=temperature)
    assert message.startswith(f"temperature = {temperature!r} °C: gives the oil a viscosity of ")


@pytest.mark.parametrize("record", GOOD)
def test_records_take_keywords_only_and_no_others(record):
    with pytest.raises(TypeError):
        record(*GOOD[record].values())
    with pytest.raises(TypeError):
        made(record, colour="red")


# Records


@pytest.mark.parametrize("record", GOOD)
def test_records_are_frozen_equal_by_value_and_hashable(record):
    one, other = made(record), made(record)
    assert one == other
    assert hash(one) == hash(other)
    assert one is not other
    name = next(iter(GOOD[record]))
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(one, name, GOOD[record][name])


@pytest.mark.parametrize(("record", "name"), NUMBERS)
def test_a_record_with_one_field_changed_is_another(record, name):
    one, other = made(record), made(record, **{name: GOOD[record][name] * 1.5})
    assert one != other
    assert len({one, other}) == 2


def test_integers_and_floats_make_the_same_machine():
    assert with_rotor(mass=300) == with_rotor(mass=300.0)
    assert hash(with_rotor(mass=300)) == hash(with_rotor(mass=300.0))


def test_defaults():
    rotor = Rotor(mass=10.0)
    assert (rotor.shaft_stiffness, rotor.imbalance) == (math.inf, 0.0)
    assert (rotor.disk_damping, rotor.journal_mass) == (0.0, 0.0)
    assert Machine(oil=SHEET.oil, bearing=SHEET.bearing, rotor=rotor, temperature=60).load is None


# Properties


def test_viscosity_falls_by_the_coefficient_per_degree():
    oil = made(Oil)
    assert oil.viscosity(50.0) == 0.02
    # d ln μ/dT = −α, whatever T.
    assert np.diff(np.log(oil.viscosity(np.arange(20.0, 121.0)))) == pytest.approx(
        -0.03 * np.ones(100), rel=1e-12
    )
    assert oil.viscosity(np.zeros((2, 3))).shape == (2, 3)
    assert made(Machine, oil=oil, temperature=60.0).viscosity == oil.viscosity(60.0)


@given(st.floats(1, 1e5), st.floats(1e3, 1e12), st.none() | st.floats(0, 1e7))
def test_load_and_sag(mass, stiffness, load):
    machine = replace(with_rotor(mass=mass, shaft_stiffness=stiffness), load=load)
    assert machine.static_load == (mass / 2 * g if load is None else load)
    assert machine.static_sag * stiffness == pytest.approx(machine.static_load, rel=2 * EPS)


def test_a_rigid_shaft_does_not_sag():
    assert with_rotor(shaft_stiffness=math.inf).static_sag == 0.0
    assert with_rotor(shaft_stiffness=math.inf).rotor.is_rigid
    assert not SHEET.rotor.is_rigid


def test_masses_add_up():
    rotor = made(Rotor)
    assert rotor.half_mass == 100.0
    assert rotor.disk_mass + rotor.journal_mass == rotor.half_mass
    assert made(JournalBearing).radius == 0.05


# JSON

positive = st.floats(5e-324, 1.7976931348623157e308)
not_negative = st.floats(0.0, 1.7976931348623157e308)
temperatures = st.floats(-273.15, 1.7976931348623157e308)


@st.composite
def any_machine(draw):
    """Draw a machine from the whole range that its fields accept."""
    mass = draw(st.floats(1e-323, 1.7976931348623157e308))
    journals = draw(st.just(0.0) | st.floats(0.0, mass / 2, exclude_max=True))
    oil = Oil(
        reference_viscosity=draw(positive),
        reference_temperature=draw(temperatures),
        temperature_coefficient=draw(st.just(0.0) | st.floats(0.0, 10.0)),
        density=draw(positive),
    )
    temperature = draw(st.just(oil.reference_temperature) | temperatures)
    diameter = draw(st.floats(1e-300, 1.7976931348623157e308))
    with np.errstate(over="ignore", under="ignore"):
        assume(0 < float(oil.viscosity(temperature)) < math.inf)
    return Machine(
        oil=oil,
        bearing=JournalBearing(
            diameter=diameter,
            length=draw(positive),
            radial_clearance=draw(st.floats(5e-324, diameter / 20.0)),
        ),
        rotor=Rotor(
            mass=mass,
            shaft_stiffness=draw(positive | st.just(math.inf)),
            imbalance=draw(not_negative),
            disk_damping=draw(not_negative),
            journal_mass=journals,
        ),
        temperature=temperature,
        load=draw(st.none() | not_negative | st.just(-0.0)),
    )


def bits(record):
    """Return every field of a record and its parts, floats as their bits."""
    values = []
    for field in dataclasses.fields(record):
        value = getattr(record, field.name)
        if dataclasses.is_dataclass(value):
            values += bits(value)
        else:
            values.append(struct.pack("<d", value) if isinstance(value, float) else value)
    return values


@given(any_machine())
def test_json_returns_every_bit(machine):
    text = machine.to_json()
    back = Machine.from_json(text)
    assert back == machine
    assert hash(back) == hash(machine)
    assert bits(back) == bits(machine)
    assert back.to_json() == text


@given(any_machine())
def test_json_is_strict_and_plain(machine):
    def refuse(word):
        raise AssertionError(word)

    document = json.loads(machine.to_json(), parse_constant=refuse)
    load = [] if machine.load is None else ["load"]
    assert list(document) == ["version", "oil", "bearing", "rotor", "temperature", *load]
    assert document["version"] == 2


def test_json_leaves_defaults_out():
    machine = replace(SHEET, rotor=Rotor(mass=100.0), load=None)
    written = json.loads(machine.to_json())
    assert written["rotor"] == {"mass": 100.0}
    assert written["bearing"].keys() == {"diameter", "length", "radial_clearance"}
    assert "load" not in written


def test_an_infinite_value_other_than_the_default_is_written_as_inf():
    class_ = make_dataclass(
        "Stiff",
        [("k", Annotated[float, Bound("N/m", infinite=True)])],
        bases=(Record,),
        frozen=True,
        kw_only=True,
    )
    assert to_tree(class_(k=math.inf)) == {"k": "inf"}
    assert from_tree(class_, {"k": "inf"}, where="") == class_(k=math.inf)


def test_version_1_is_read():
    """As it was written before a bearing had a geometry: every field, and the film by its name."""
    tree = {
        "version": 1,
        "oil": {"reference_viscosity": 0.0172368925, "reference_temperature": 50.0,
                "temperature_coefficient": 0.03, "density": 860.0},
        "bearing": {"diameter": 0.15, "length": 0.05, "radial_clearance": 6e-05, "film": "short"},
        "rotor": {"mass": 272.1422, "shaft_stiffness": "inf", "imbalance": 0.0,
                  "disk_damping": 0.0, "journal_mass": 0.0},
        "temperature": 60.0,
        "load": None,
    }  # fmt: skip
    machine = Machine.from_json(json.dumps(tree))
    assert machine.rotor == Rotor(mass=272.1422)
    assert machine.bearing.geometry == Plain()
    assert machine.bearing.film is None
    assert json.loads(machine.to_json())["version"] == 2


def test_a_geometry_is_named_by_its_kind():
    tree = document()
    tree["bearing"]["geometry"] = {"type": "plain"}
    assert Machine.from_json(json.dumps(tree)) == SHEET
    tree["bearing"]["geometry"] = {"type": "square"}
    assert refusal(json.dumps(tree)).startswith("bearing.geometry.type = 'square': must be one of")
    tree["bearing"]["geometry"] = {}
    assert refusal(json.dumps(tree)).startswith("bearing.geometry.type = None: must be one of")
    tree["bearing"]["geometry"] = "plain"
    assert refusal(json.dumps(tree)).startswith("bearing.geometry = 'plain': must be a JSON object")


def test_a_film_model_that_the_geometry_lacks_is_named():
    with pytest.raises(ValueError, match="film = 'short': a bearing of kind 'multi-dam' has"):
        replace(SHEET.bearing, geometry=MultiDam(), film="short")


def document(**changes):
    """Return the sheet's machine as a JSON tree with some of its branches changed."""
    return {**json.loads(SHEET.to_json()), **changes}


def refusal(text):
    """Return the message with which text is refused."""
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - the message is what is returned
        Machine.from_json(text)
    return str(caught.value)


def test_json_may_be_bytes_and_in_any_order():
    shuffled = json.dumps(dict(reversed(document().items())))
    assert Machine.from_json(shuffled) == SHEET
    assert Machine.from_json(shuffled.encode()) == SHEET


@pytest.mark.parametrize("key", ["oil", "bearing", "rotor", "temperature"])
def test_a_missing_key_is_named(key):
    tree = document()
    del tree[key]
    message = refusal(json.dumps(tree))
    # A supply may take the temperature's place, so what is wrong is that there is neither.
    assert message.startswith("temperature = None" if key == "temperature" else f"{key}: missing")


@pytest.mark.parametrize("part", ["oil", "bearing", "rotor"])
def test_a_missing_or_unknown_key_is_named_with_its_record(part):
    defaulted = {"density", "shaft_stiffness", "imbalance"}
    for key in document()[part].keys() - defaulted:
        branch = document()[part]
        del branch[key]
        assert refusal(json.dumps(document(**{part: branch}))) == f"{part}.{key}: missing"
    branch = {**document()[part], "colour": 1}
    assert refusal(json.dumps(document(**{part: branch}))).startswith(
        f"{part}.colour: unknown key; known are "
    )


def test_an_unknown_key_is_named_and_shortened():
    assert refusal(json.dumps(document(colour=1))).startswith("colour: unknown key")
    long = refusal(json.dumps(document(**{"x" * 10**6: 1})))
    assert "xxxx: unknown key" in long
    assert len(long) < 300


def test_an_error_about_any_key_can_be_encoded_as_text():
    """A lone surrogate, which JSON can spell, is in no text that a page can send."""
    message = refusal('{"version": 1, "\\ud800": 1}')
    assert message.encode("utf-8")
    assert message.startswith("\\ud800: unknown key")


def test_a_key_given_twice_is_named():
    text = SHEET.to_json().replace('"temperature": 60.0', '"temperature": 60, "temperature": 61')
    assert refusal(text) == "temperature: given twice"
    text = SHEET.to_json().replace('"mass"', '"imbalance": 0, "mass"')
    assert refusal(text) == "imbalance: given twice"


def test_an_object_of_very_many_keys_is_refused_without_comparing_each_with_each():
    """Pairwise comparison would take hours."""
    text = json.dumps({str(n): 0 for n in range(500_000)})
    assert refusal(text).startswith("version = None")


@pytest.mark.parametrize(
    "version", ["0", "3", "1.5", '"1"', "null", "true", "[1]", "{}", "-1", "1e999", "1.0000001"]
)
def test_another_version_is_named(version):
    text = SHEET.to_json().replace('"version": 2', f'"version": {version}')
    assert refusal(text).startswith("version = ")
    assert "this program reads versions 1 and 2" in refusal(text)


def test_a_missing_version_is_named():
    tree = document()
    del tree["version"]
    assert refusal(json.dumps(tree)).startswith("version = None")


@pytest.mark.parametrize("value", ["300", None, True, [300], {"kg": 300}, "inf", "nan"])
def test_a_value_of_the_wrong_type_is_named(value):
    rotor = {**document()["rotor"], "mass": value}
    assert refusal(json.dumps(document(rotor=rotor))).startswith("mass = ")
    assert "must be a number in kg" in refusal(json.dumps(document(rotor=rotor)))


@pytest.mark.parametrize("value", [-1, 0, -1e300])
def test_a_value_out_of_its_bound_is_named(value):
    rotor = {**document()["rotor"], "mass": value}
    assert refusal(json.dumps(document(rotor=rotor))).startswith(f"mass = {float(value)!r} kg")


@pytest.mark.parametrize("part", ["oil", "bearing", "rotor"])
@pytest.mark.parametrize("value", [None, 1, "x", [], True])
def test_a_record_that_is_not_an_object_is_named(part, value):
    assert refusal(json.dumps(document(**{part: value}))).startswith(f"{part} = ")


@pytest.mark.parametrize("word", ["NaN", "Infinity", "-Infinity"])
@pytest.mark.parametrize("field", ["mass", "shaft_stiffness", "temperature"])
def test_nan_and_infinity_are_refused_as_not_json(word, field):
    text = SHEET.to_json()
    value = text.split(f'"{field}": ')[1].split(",")[0].split("\n")[0]
    assert refusal(text.replace(f'"{field}": {value}', f'"{field}": {word}')).startswith(word)


@pytest.mark.parametrize(
    "number",
    ["1e999", "-1e999", "9" * 10**6, "-" + "9" * 10**6],
    ids=["1e999", "-1e999", "digits", "-digits"],
)
@pytest.mark.parametrize("field", ["mass", "shaft_stiffness", "journal_mass"])
def test_an_overflowing_number_is_named_and_not_read_as_a_rigid_shaft(number, field):
    tree = document()
    tree["rotor"][field] = "here"
    text = json.dumps(tree).replace('"here"', number)
    assert refusal(text).startswith(f"rotor.{field}: too large for a number")


def test_a_number_with_a_million_decimals_is_read():
    text = SHEET.to_json().replace("60.0", f"60.{'0' * 10**6}")
    assert Machine.from_json(text) == SHEET


@pytest.mark.parametrize(
    "text",
    ["[" * 10**5, '{"a":' * 10**5, "[" * 900 + "]" * 900, "[[[]]]"],
    ids=["open lists", "open objects", "closed lists", "few lists"],
)
def test_deep_nesting_is_refused(text):
    assert "machine" in refusal(text)


@pytest.mark.parametrize(
    "text", ["", " ", "{", "null", "1", '"x"', "[]", "{}", "{'a': 1}", "\ufeff{}"]
)
def test_text_that_is_not_a_machine_is_refused(text):
    assert "machine" in refusal(text) or "version" in refusal(text)


@pytest.mark.parametrize(
    "value", [None, 1, 1.5, {}, [], object(), b"\xff\xfe", b"\x80", b"\xff" * 9]
)
def test_a_file_that_is_not_text_is_refused(value):
    assert refusal(value).startswith("no JSON text of a machine: ")


@given(st.text() | st.binary())
def test_any_text_is_refused_with_a_valueerror(text):
    assert refusal(text)


def test_the_default_film_by_its_name_is_the_default():
    named = replace(SHEET.bearing, film="short")
    assert named == SHEET.bearing
    assert hash(named) == hash(SHEET.bearing)
    assert named.model == "short"


def test_a_kind_is_found_among_the_others_whenever_it_is_defined():
    class Shape(Kind):
        pass

    class Round(Shape):
        kind = "round"

    assert Shape.kinds() == {"round": Round}

    class Square(Shape):
        kind = "square"

    assert Shape.kinds() == {"round": Round, "square": Square}
    Shape.kinds().clear()
    assert len(Shape.kinds()) == 2
