"""The page Tolerances: its numbers are the core's, it refuses by name, its result has a machine."""

import base64
import csv
import io
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from streamlit.testing.v1 import AppTest

import rotorcalc as rc
from rotorcalc.comparison import usual_bores
from rotorcalc.input_sweep import InputSweep
from rotorcalc.units import SI, US
from rotorcalc.variation import value_of, varied
from tests.app.session import charts, faults, session_of, tours, visit
from tests.app.test_own import link as own_link
from tests.machines import SHEET
from ui.frame.page import PAGES
from ui.sharing.drawn import drawn_csv
from ui.words import spreads, studies
from ui.words.design import fields_of, quantity
from ui.words.one_input import Varied, changes
from ui.words.tolerances import Study, quantity_of, said

TOLERANCES = next(path for path, name in PAGES.items() if name == "Tolerances")
RPM = math.pi / 30
USUAL = {"radial_clearance": ("uniform", 51e-6, 69e-6), "temperature": ("uniform", 56.0, 64.0)}
FINITE = replace(SHEET, bearing=replace(SHEET.bearing, film="finite"))
# On a film of finite length so many are asked for before they are drawn.
SLOW = {"film": "finite", "samples": "60", "rpm": "8700"}


def study(**query: str) -> AppTest:
    return visit(TOLERANCES, **query)


def warnings(at: AppTest) -> str:
    return "\n".join(box.value for box in at.warning)


def answer(at: AppTest) -> str:
    [found] = [box.value for box in at.info if "machines drawn" in box.value]
    return found


def field(at: AppTest, label: str, place: int = 0) -> object:
    return [one for one in at.text_input if one.label == label][place]


def button(at: AppTest, key: str) -> None:
    at.button(key=key).click().run()
    assert faults(at) == []


# --- Numbers -----------------------------------------------------------------------------------


@pytest.mark.parametrize("units", [SI, US], ids=lambda units: units.name)
def test_the_answer_is_the_cores_with_the_same_seed(units) -> None:
    at = study(rpm="8700", samples="500", seed="7", units=units.name)
    found = rc.tolerance(SHEET, USUAL, 500, 7, speed=8700 * RPM)
    assert 0.2 < found.probability_unstable.value < 0.6
    assert answer(at) == said(found, units)
    [named] = [text.value for text in at.markdown if "** matters most" in text.value]
    assert named.startswith("**Radial clearance C**")


def test_quantiles_are_of_all_machines_those_without_an_onset_too() -> None:
    found = rc.tolerance(SHEET, USUAL, 20, 7, speed=8700 * RPM)
    onset = np.where(np.arange(20) < 7, RPM * (1001.0 + np.arange(20)), math.inf)
    words = said(replace(found, onset=onset), SI)
    assert "Onset: median not found; 5 % quantile 1001 rpm, 95 % quantile not found." in words
    assert words.endswith("For 13 of them no onset was found.")
    assert "quantile" not in said(replace(found, onset=np.full(20, math.inf)), SI)
    # One without an answer is left out, as the command line does.
    onset = np.array([math.nan, *RPM * (1001.0 + np.arange(19))])
    assert "median 1010 rpm" in said(replace(found, onset=onset), SI)


def test_a_link_draws_the_same_machines_and_a_seed_others() -> None:
    at = study(rpm="8700")
    field(at, "Seed").set_value("5").run()
    other = study(**at.query_params)
    assert at.query_params == {"rpm": "8700", "seed": "5"}
    assert answer(other) == answer(at)
    assert charts(other) == charts(at)
    assert answer(study(rpm="8700")) != answer(at)


def test_the_histogram_has_all_machines_and_the_unstable_ones_are_red() -> None:
    at = study(rpm="8700")
    found = rc.tolerance(SHEET, USUAL, 2000, 1, speed=8700 * RPM)
    stable, unstable = (
        sum(_array(trace["y"]))
        for trace in charts(at)["chart_tolerances_onset"]["data"]
        if trace["type"] == "bar"
    )
    assert stable + unstable == pytest.approx(100.0, rel=1e-6)
    assert unstable == pytest.approx(100.0 * found.probability_unstable.value, rel=1e-5)


def _array(packed: object) -> list[float]:
    if isinstance(packed, list):
        return packed
    return np.frombuffer(base64.b64decode(packed["bdata"]), packed["dtype"]).tolist()


def test_the_file_has_every_machine_and_what_draws_it_again() -> None:
    given = (("bearing.radial_clearance", ("uniform", 51e-6, 69e-6)),)
    asked = Study(SHEET, 8700 * RPM, given, 50, 3)
    found = rc.tolerance(SHEET, dict(given), 50, 3, speed=asked.speed)
    axes = {one: quantity_of(asked, found, one, US) for one in found.fields}
    lines = list(csv.reader(io.StringIO(drawn_csv(found, given, axes, US).decode("utf-8-sig"))))
    head = {line[0]: line[1] for line in lines if line[0].startswith("#")}
    assert head["# Seed"] == "3"
    assert head["# Spread of bearing.radial_clearance, in SI"] == "uniform 5.1e-05 6.9e-05"
    assert head["# Radial clearance C [mil]"] == "2.3622"
    names, *rows = [line for line in lines if not line[0].startswith("#")]
    assert names == ["Radial clearance C [mil]", "Onset [rpm]", "Margin [%]",
                     "At the running speed"]  # fmt: skip
    onset = np.array([float(row[1]) for row in rows])
    np.testing.assert_allclose(onset, found.onset / RPM, rtol=1e-9)
    assert [row[3] == "unstable" for row in rows] == found.unstable.tolist()


# --- What is asked -----------------------------------------------------------------------------


def test_by_itself_the_spreads_are_about_the_present_machine() -> None:
    at = study()
    assert [field(at, "Low [µm]").value, field(at, "High [µm]").value] == ["51", "69"]
    session_of(at).set_value("C", 100.0)
    at.run()
    assert [field(at, "Low [µm]").value, field(at, "High [µm]").value] == ["85", "115"]
    assert "spreads" not in at.query_params


def test_inputs_are_added_changed_and_removed_and_stand_in_the_link() -> None:
    at = study(bearing="elliptical", film="short")
    button(at, "spread_add")
    button(at, "spread_add")
    at.selectbox(key="spread_3_input").set_value("k").run()
    at.selectbox(key="spread_3_distribution").set_value("lognormal").run()
    assert field(at, "Median [N/m]").value == "1e+08"
    at.selectbox(key="spread_0_distribution").set_value("normal").run()
    assert field(at, "Mean [µm]").value == "60"
    assert field(at, "Std. dev. [µm]").value == "4.5"  # two of them on each side of ±15 %
    button(at, "spread_1_remove")
    [text] = [at.query_params["spreads"]]
    assert text.startswith("C~normal~60~4.5~~load~uniform~")
    other = study(**at.query_params)
    assert [one.value for one in other.text_input] == [one.value for one in at.text_input]
    assert faults(at) == []


def test_in_other_units_the_spread_is_the_same_and_a_deviation_has_no_offset() -> None:
    at = study(spreads="T~normal~60~5", units="US")
    assert field(at, "Mean [°F]").value == "140"
    assert field(at, "Std. dev. [°F]").value == "9"
    field(at, "Std. dev. [°F]").set_value("18").run()
    assert at.query_params["spreads"] == "T~normal~60~10"


@pytest.mark.parametrize(
    ("query", "words"),
    [
        ({"spreads": "C~uniform~70~50"},
         "Radial clearance C: high = 50 µm must be at least low = 70 µm."),
        ({"spreads": "C~uniform~-5~50"}, "Radial clearance C: low = −5 µm: must be positive"),
        ({"spreads": "C~normal~60~-4"}, "std. dev. = −4 µm must be at least 0"),
        ({"spreads": "C~lognormal~60~0.5"}, "ratio = 0.5 must be at least 1"),
        ({"spreads": "C~triangular~50~80~70"}, "high = 70 µm must be at least most likely = 80 µm"),
        ({"spreads": "C~uniform~abc~50"}, "Radial clearance C: low = `'abc'` is not a number."),
        ({"spreads": "C~uniform~50~1e400"}, "high = `'1e400'` is too large a number"),
        ({"spreads": "C~uniform~50~9000"}, "Radial clearance C: high = 9000 µm: must be"),
        ({"spreads": "C~normal~60~40"}, "the first sample 9: Radial clearance C = −7.525 µm: must"),
        ({"spreads": "C~uniform~50"}, "The spread of Radial clearance C is left out"),
        ({"spreads": "preload~uniform~0~1"}, "The spread of `'preload'` is left out: this machine"),
        ({"samples": "0"}, "Machines drawn = `'0'` must be a whole number between 1 and 100000"),
        ({"samples": "1e7"}, "are drawn in a notebook, by `rc.tolerance("),
        ({"samples": "1.5"}, "must be a whole number"),
        ({"seed": "-1"}, "Seed = `'-1'` must be a whole number between 0 and"),
        ({"samples": "900", "bearing": "foil"}, "between 1 and 100, as others share this server"),
    ],
)  # fmt: skip
def test_what_cannot_be_drawn_is_refused_by_name_and_stays_on_the_page(
    query: dict[str, str], words: str
) -> None:
    at = study(**query)
    assert faults(at) == []
    assert words in warnings(at), warnings(at)
    if "left out" not in words:
        assert not [box for box in at.info if "machines drawn" in box.value]
        assert charts(at) == {}
    shown = [one.value for one in at.text_input]
    *_, typed = query.get("spreads", "").split("~")
    assert typed in shown or "left out" in words
    assert {key: at.query_params[key] for key in query} == query


@pytest.mark.parametrize("geometry", usual_bores(SHEET.bearing), ids=lambda one: one.kind)
def test_every_input_of_every_bore_can_spread_and_be_swept_about_its_value(geometry) -> None:
    oil = rc.Gas() if geometry.lubricant == "gas" else SHEET.oil
    bearing = replace(SHEET.bearing, geometry=geometry, film=None)
    machine = replace(SHEET, bearing=bearing, oil=oil)
    for key in fields_of(machine):
        spread = spreads.usual_spread(machine, key)
        [(name, (_, low, high))] = spreads.given(machine, (spread,), SI)
        now = value_of(machine, name)
        assert low < high
        assert low * (1 - 1e-9) <= now <= high * (1 + 1e-9)
        axis = quantity(key, machine, SI)
        assert axis.low < axis.high


@pytest.mark.parametrize(
    ("geometry", "key", "last", "step"),
    [
        (rc.Elliptical(preload=0.5), "preload", 0.9, 0.05),
        (rc.TiltingPads(), "preload", 0.9, 0.1),
        (rc.PartialArc(arc=math.radians(150.0)), "centre", 45.0, 5.0),
    ],
    ids=["preload", "of pads", "angle"],
)
def test_shares_and_angles_are_swept_in_round_linear_steps(geometry, key, last, step) -> None:
    machine = replace(SHEET, bearing=replace(SHEET.bearing, geometry=geometry, film=None))
    axis = quantity(key, machine, SI)
    assert not axis.log
    varied = Varied(key, axis)
    values = axis.unit.of(varied.values(machine, varied.points(machine)))
    assert values[-1] == pytest.approx(last)
    assert np.diff(values)[1:-1] == pytest.approx(step)
    assert values / step == pytest.approx(np.round(values / step), abs=1e-9)


def test_of_own_coefficients_the_rotor_spreads() -> None:
    at = visit(TOLERANCES, **own_link())
    shown = [box.value for box in at.selectbox if (box.key or "").endswith("_input")]
    assert shown == ["mass", "k"]
    for label in tours(at):
        assert faults(at) == [], label


# --- A result and its machine -------------------------------------------------------------------


def test_a_slow_study_is_drawn_on_request_and_says_whose_it_is_when_the_machine_moves_on() -> None:
    at = study(**SLOW)
    assert re.search(
        r"60 machines will be drawn .* about 1\ss", "".join(m.value for m in at.markdown)
    )
    assert charts(at) == {}
    button(at, "tolerances_draw")
    first = answer(at)
    found = rc.tolerance(FINITE, USUAL, 60, 1, speed=8700 * RPM)
    assert first == said(found, SI)
    assert "earlier machine" not in warnings(at)
    session_of(at).set_value("L", 60.0)
    at.run()
    assert answer(at) == first
    assert "Length L [mm] was 50, now 60" in warnings(at)
    assert at.button(key="tolerances_draw")
    session_of(at).set_value("L", 50.0)
    at.run()
    assert answer(at) == first
    assert "earlier machine" not in warnings(at)
    field(at, "Seed").set_value("2").run()
    assert "seed was 1, now 2" in warnings(at)
    field(at, "Seed").set_value("x").run()
    assert "Seed = `'x'` is not a number" in warnings(at)
    assert answer(at) == first


def test_a_spread_that_is_none_is_named_beside_its_input_and_the_old_answer_is_dimmed() -> None:
    at = study()
    first = answer(at)
    assert dimmed_texts(at) == []
    field(at, "Low [µm]").set_value("abc").run()
    assert faults(at) == []
    reason = "Radial clearance C: low = `'abc'` is not a number"
    beside, above = [box.value for box in at.warning if reason in box.value][::-1]
    assert beside == f"{reason}."
    assert above.startswith(f"Nothing was drawn: {reason}. This result is of an earlier machine")
    assert first in dimmed_texts(at)
    field(at, "Low [µm]").set_value("51").run()
    assert answer(at) == first
    assert dimmed_texts(at) == []
    assert not at.warning


def dimmed_texts(at: AppTest) -> list[str]:
    """Return the texts in containers whose key says that they are of a former result."""

    def texts(block, inside):
        inside = inside or "former_" in getattr(block.proto, "id", "")
        for child in block.children.values():
            if hasattr(child, "children"):
                yield from texts(child, inside)
            elif inside and child.type in ("info", "alert"):
                yield child.value

    return list(texts(at.main, False))


def test_a_slow_study_that_is_refused_keeps_its_reason_and_is_not_begun_again() -> None:
    at = study(**SLOW, spreads="C~normal~60~30")
    button(at, "tolerances_draw")
    for _ in range(2):
        assert "no valid machine" in warnings(at)
        assert session_of(at).asked == {}
        at.run()
    field(at, "Std. dev. [µm]").set_value("5").run()
    assert "no valid machine" not in warnings(at)
    assert at.button(key="tolerances_draw")


@pytest.mark.parametrize("kind", ["plain", "elliptical", "pressure-dam", "tilting-pads", "foil"])
def test_as_many_machines_are_drawn_as_take_under_a_minute(kind: str) -> None:
    geometry = {one.kind: one for one in usual_bores(SHEET.bearing)}[kind]
    bearing = replace(SHEET.bearing, geometry=geometry, film=None)
    machine = replace(SHEET, bearing=bearing, oil=rc.Gas() if kind == "foil" else SHEET.oil)
    for fields in (("temperature",), ("bearing.diameter", "temperature")):
        most, usual = studies.most_samples(machine, fields), studies.usual_samples(machine, fields)
        assert 40 <= usual <= most
        assert studies.cost(machine, fields) * most <= 60.0


# --- Sweep -------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", ["C", "preload"])
def test_a_sweep_is_the_machine_at_each_value(key: str) -> None:
    at = visit(TOLERANCES, tab="Sweep", vary=key, bearing="elliptical", film="short")
    assert faults(at) == []
    assert set(charts(at)) == {f"chart_sweep_{name}" for name in
                               ("onset", "margin", "log_decrement", "film")}  # fmt: skip
    [line] = [
        trace for trace in charts(at)["chart_sweep_onset"]["data"] if trace["name"] == "onset"
    ]
    x, y = (np.array(_array(line[axis])) for axis in "xy")
    machine = session_of(at).preview.computed.machine
    path, unit = {"C": ("radial_clearance", 1e-6), "preload": ("preload", 1.0)}[key]
    for place in (0, len(x) // 2):
        one = varied(machine, {path: x[place] * unit})
        assert y[place] == pytest.approx(rc.onset_speed(one).speed / RPM, rel=1e-6, nan_ok=True)


@pytest.mark.parametrize(
    ("onsets", "words"),
    [
        ([2.0, 2.0, 0.5], "**stable** below and **unstable** above."),
        ([0.5, 2.0, 2.0], "**unstable** below and **stable** above."),
        ([2.0, 0.5, 2.0], "**stable** below the first change, **unstable** above it, and so on."),
    ],
)
def test_on_which_side_of_each_change_a_machine_is_stable(onsets: list[float], words: str) -> None:
    values, none = np.array([40e-6, 60e-6, 90e-6]), np.zeros(3)
    found = InputSweep("radial_clearance", 1.0, values, np.array(onsets), none, none, none)
    said = changes(Varied("C", quantity("C", SHEET, SI)), found)
    assert said.endswith(words)
    assert said.count(" and between ") == (onsets[0] == onsets[-1])


def test_a_slow_sweep_is_computed_on_request() -> None:
    at = visit(TOLERANCES, tab="Sweep", vary="D", bearing="foil")
    assert charts(at) == {}
    said = "".join(text.value for text in at.markdown)
    assert re.search(r"smallest film over the diameter.* about \d+\ss", said)
    assert at.button(key="tolerances_sweep")
    assert faults(at) == []
