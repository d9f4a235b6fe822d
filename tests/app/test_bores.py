"""The bearing in the sidebar: its kind, its film model, and the inputs of each bore."""

import json
import math
import re
from collections.abc import Iterator
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from streamlit.testing.v1 import AppTest

from rotorcalc import onset_speed
from rotorcalc.comparison import KINDS
from rotorcalc.units import SI, US
from tests.app.session import (
    HOME,
    comparison,
    faults,
    move,
    open_part,
    session_of,
    slider,
    slider_keys,
    visit,
)
from ui.bearing import KIND, defaults_of, fields_of
from ui.bores import BORES, NAMES, Pick, Values, bore_inputs, with_pick
from ui.input_record import Input
from ui.inputs import GAS, INPUTS, PRESET_VALUES, input_named, machine_of, on_lubricant, usual
from ui.session import changed
from ui.widgets import _moved

PADS = [kind for kind in NAMES if kind != "plain"]
_REFUSALS = (
    "must be at least",
    "must be at most",
    "no gas film",
    "below the lift-off speed",
    "no position of the journal was found",
)
every_bore = pytest.mark.parametrize("kind", PADS)


SHEET = PRESET_VALUES["sheet-1e8"]


def of_kind(kind: str, **values: object) -> Values:
    return on_lubricant(SHEET | defaults_of(kind, SHEET)) | values  # type: ignore[operator]


def light(kind: str) -> dict[str, str]:
    """Return a load that a film of air lifts."""
    return {"load": "20", "rpm": "20000"} if kind == "foil" else {}


def sliders(values: Values) -> list[Input]:
    return [item for item in bore_inputs(values) if isinstance(item, Input)]


def picks(values: Values) -> list[Pick]:
    return [item for item in bore_inputs(values) if isinstance(item, Pick)]


def choose(at: AppTest, kind: str) -> None:
    at.selectbox(key="bearing_kind").set_value(kind).run()


def refused_in_words(at: AppTest) -> bool:
    """Return whether the film has no answer at this speed and load, and the page says just that."""
    said = [error.value for error in at.error]
    return len(said) == 1 and any(word in said[0] for word in _REFUSALS) and not at.exception


def test_every_fixed_bore_of_the_core_can_be_chosen() -> None:
    assert set(NAMES) == set(BORES) == {kind.kind for kind in KINDS}


@pytest.mark.parametrize("kind", NAMES)
def test_every_field_of_a_bore_has_an_input(kind: str) -> None:
    items, fields = bore_inputs(of_kind(kind)), fields_of(kind)
    assert {item.key for item in items} == set(fields)
    for item in items:
        assert item.help.endswith("."), item.key
        if isinstance(item, Input):
            field = fields[item.key]
            assert item.field == f"bearing.geometry.{field.name}"
            assert item.unit(SI) == field.unit(SI)
            assert bool(item.follows) == field.rule.optional
            assert item.label == field.label


@every_bore
def test_the_ends_of_each_slider_make_a_bearing(kind: str) -> None:
    values = of_kind(kind)
    for item in sliders(values):
        for end in (item.low, item.high):
            assert item.problem(end) == ""
            machine_of(values | {item.key: end})
        # What a slider shows at first lies on it.
        now = values[item.key]
        assert now is None or item.low <= float(now) <= item.high
        assert item.low <= usual(item.key, values) <= item.high


@every_bore
@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_no_way_along_sliders_and_picks_leads_to_an_impossible_bore(
    kind: str, data: st.DataObject
) -> None:
    values = of_kind(kind)
    for _ in range(data.draw(st.integers(1, 12))):
        item = data.draw(st.sampled_from(bore_inputs(values)))
        if isinstance(item, Pick):
            values = with_pick(values, item, data.draw(st.sampled_from(item.options)))
        else:
            share = data.draw(st.integers(0, 1000)) / 1000
            reading = item.low + share * (item.high - item.low)
            values = values | {item.key: item.taken(min(reading, item.high), SI)}
        machine_of(values)


def _ends(at: AppTest, kind: str) -> Iterator[object]:
    """Move each slider of a bore to both ends, and back; pick each number and word."""
    own = {item.key for item in bore_inputs(session_of(at).values)}
    for key in slider_keys(at):
        if key.split("_", 1)[1].rsplit("_", 2)[0] in own:
            was = slider(at, key)[0].value
            for end in slider(at, key)[1:]:
                slider(at, key)[0].set_value(end).run()
                yield key, end
            slider(at, key)[0].set_value(was)  # with the next run
    for item in picks(of_kind(kind)):
        for option in item.options:
            at.segmented_control(key=f"pick_{item.key}").set_value(option).run()
            assert session_of(at).values[item.key] == option
            yield item.key, option


@pytest.mark.parametrize(
    ("kind", "units"), [*((kind, "SI") for kind in PADS), ("pressure-dam", "US")]
)
def test_home_shows_both_ends_of_every_slider_of_a_bore(kind: str, units: str) -> None:
    at = visit(HOME, units=units, **light(kind))
    choose(at, kind)
    for item in sliders(of_kind(kind)):
        if item.follows:
            at.toggle(key=f"{item.key}_follows").set_value(False).run()
            assert faults(at) == [], item.key
    seen = 0
    for moved in _ends(at, kind):
        seen += 1
        assert faults(at) == [] or refused_in_words(at), moved
    assert seen == 2 * len(sliders(of_kind(kind))) + sum(
        len(item.options) for item in picks(of_kind(kind))
    )


@every_bore
def test_changing_the_kind_keeps_the_rest_of_the_machine_and_is_undone(kind: str) -> None:
    at = visit(HOME, D="120", L="60", C="75", load="4000")
    before = dict(session_of(at).values)
    choose(at, kind)
    after = session_of(at).values
    kept = INPUTS.keys() - GAS.keys()
    assert {key: after[key] for key in kept} == {key: before[key] for key in kept}
    assert {key: after[key] for key in GAS} == (GAS if kind == "foil" else dict.fromkeys(GAS))
    assert after[KIND] == kind
    at.button(key="undo").click().run()
    assert session_of(at).values == before
    assert at.selectbox(key="bearing_kind").value == "plain"
    at.button(key="redo").click().run()
    assert session_of(at).values == after
    assert at.selectbox(key="bearing_kind").value == kind


@every_bore
def test_a_moved_bore_is_in_the_link_and_in_the_file(kind: str) -> None:
    at = visit(HOME)
    choose(at, kind)
    for item in sliders(session_of(at).values):
        if not item.follows:
            move(at, item.key, slider(at, f"input_{item.key}_SI_slider")[1])
    values = session_of(at).values
    assert values != of_kind(kind)
    again = visit(HOME, **session_of(at).link())
    assert session_of(again).values == values
    assert session_of(again).problems == session_of(again).refused == []
    fresh = visit(HOME)
    open_part(fresh, "share")
    text = machine_of(values).to_json()
    fresh.file_uploader(key="upload").upload("machine.json", text.encode()).run()
    assert machine_of(session_of(fresh).values) == machine_of(values)
    assert fresh.selectbox(key="bearing_kind").value == kind


@every_bore
def test_a_bore_without_load_has_a_page_in_us_units_and_beside_it_as_a_case(kind: str) -> None:
    at = visit(HOME, load="0", units="US")
    choose(at, kind)
    assert faults(at) == []
    at.button(key="keep").click().run()
    assert session_of(at).cases[0].values == session_of(at).values
    choose(at, "plain")
    assert comparison(at)["Bearing"] == f"Plain circular | {NAMES[kind]}"
    assert faults(at) == []


def test_what_was_changed_of_a_bore_is_named() -> None:
    preset = "sheet-1e8"
    assert changed(preset, of_kind("elliptical")) == [KIND]
    assert changed(preset, of_kind("elliptical", preload=0.3)) == [KIND, "preload"]
    at = visit(HOME, bearing="elliptical", preload="0.3", film="short")
    (said,) = [one.value for one in at.caption if "Changed" in one.value]
    assert said == (
        "Changed from the preset: bearing: elliptical (two-lobe), film: short bearing, preload."
    )
    at = visit(HOME, film="finite")
    assert any("film: finite length" in one.value for one in at.caption)


def test_cases_of_two_bores_are_told_apart() -> None:
    at = visit(HOME, bearing="lobes", preload="0.3")
    at.button(key="keep").click().run()
    choose(at, "elliptical")
    rows = comparison(at)
    assert rows["Bearing"] == "Elliptical (two-lobe) | Lobed"
    assert rows["Number of pads"] == "– | 3"
    assert rows["Load points"] == "– | on pad"
    assert rows["Preload"] == "0.5 | 0.3"
    assert rows["Arc of a pad [°]"] == "– | 100"


@pytest.mark.parametrize(
    ("kind", "key", "value"),
    [
        ("pressure-dam", "depth", 150.0),
        ("multi-dam", "depth", 112.5),
        ("axial-grooves", "first", 90.0),
    ],
)
def test_a_value_that_follows_from_others_is_given_as_it_is(
    kind: str, key: str, value: float
) -> None:
    at = visit(HOME, bearing=kind, C="75")
    assert f"input_{key}_SI_slider" not in slider_keys(at)
    machine = machine_of(session_of(at).values)
    at.toggle(key=f"{key}_follows").set_value(False).run()
    assert session_of(at).values[key] == pytest.approx(value)
    assert f"input_{key}_SI_slider" in slider_keys(at)
    assert faults(at) == []
    given = machine_of(session_of(at).values)
    assert given != machine
    at.toggle(key=f"{key}_follows").set_value(True).run()
    assert machine_of(session_of(at).values) == machine


def test_more_pads_are_narrower_where_they_must_be() -> None:
    at = visit(HOME, bearing="lobes")
    at.segmented_control(key="pick_number").set_value(4.0).run()
    assert session_of(at).values["arc"] == pytest.approx(100 * 3 / 4)
    assert any("narrower" in one.value for one in at.warning)
    at.segmented_control(key="pick_number").set_value(3.0).run()
    assert session_of(at).values["arc"] == pytest.approx(75)
    assert not at.warning


def test_a_film_model_is_chosen_where_there_are_two() -> None:
    at = visit(HOME)
    control = at.segmented_control(key="film_model")
    assert control.value == "short"
    control.set_value("finite").run()
    assert machine_of(session_of(at).values).bearing.model == "finite"
    assert session_of(at).link()["film"] == "finite"
    at.segmented_control(key="film_model").set_value("short").run()
    assert "film" not in session_of(at).link()
    choose(at, "pressure-dam")
    assert not any(one.key == "film_model" for one in at.segmented_control)


@pytest.mark.parametrize("sent", ["", "much", None, [1], True, math.nan, 2.0, -1, "0.5<b>", "inf"])
def test_only_values_of_a_bore_in_range_are_kept(
    sent: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    visitor = session_of(visit(HOME, bearing="elliptical"))
    before = dict(visitor.values)
    monkeypatch.setattr("ui.widgets.session", lambda: visitor)
    _moved("preload", visitor.units, sent, dragging=False)
    assert visitor.values == before
    assert len(visitor.problems) == 1


def test_the_slider_of_another_bore_moves_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    visitor = session_of(visit(HOME, bearing="elliptical"))
    before = dict(visitor.values)
    monkeypatch.setattr("ui.widgets.session", lambda: visitor)
    for name in ("arc", "pocket_arc", "number", "bearing", "<b>"):
        _moved(name, visitor.units, 50.0, dragging=False)
        assert "is not an input" in visitor.problems[0]
    assert visitor.values == before


def test_a_value_beyond_its_slider_is_kept_as_the_link_has_it() -> None:
    at = visit(HOME, bearing="lobes", number="9", arc="8", preload="0.97")
    values = session_of(at).values
    assert (values["number"], values["arc"], values["preload"]) == (9.0, 8.0, 0.97)
    assert at.segmented_control(key="pick_number").value == 9.0
    assert faults(at) == [] or refused_in_words(at)
    at.button(key="keep").click().run()
    assert session_of(at).values == values


@every_bore
def test_live_sliders_and_the_preview_have_the_bores_inputs(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROTORCALC_LIVE", "drag")
    at = visit(HOME, **light(kind))
    choose(at, kind)
    visitor = session_of(at)
    groups = [
        element.proto for element in at.get("bidi_component")
        if element.proto.component_name == "rotorcalc.sliders"
    ]  # fmt: skip
    names = {item["name"] for group in groups for item in json.loads(group.json)[0]}
    own = sliders(visitor.values)
    assert {item.key for item in own if not item.follows} <= names
    assert faults(at) == []
    assert visitor.preview is not None
    for item in own:
        shown = visitor.preview.at(item.key, str((item.low + 2 * item.high) / 3))
        assert shown["charts"]["chart_cross_section"] is not None
    # In a presentation its sliders are among those in use.
    item = next(one for one in own if not one.follows)
    _moved_to(at, item, monkeypatch)
    at.button(key="present").click().run()
    assert faults(at) == []
    assert item.key in at.multiselect(key="in_use").value


def _moved_to(at: AppTest, item: Input, monkeypatch: pytest.MonkeyPatch) -> None:
    visitor = session_of(at)
    monkeypatch.setattr("ui.widgets.session", lambda: visitor)
    _moved(item.key, visitor.units, item.high, dragging=False)
    monkeypatch.undo()
    monkeypatch.setenv("ROTORCALC_LIVE", "drag")
    at.run()


def test_us_units_convert_a_pockets_depth() -> None:
    item = input_named("depth", of_kind("pressure-dam"))
    assert item.shown(25.4, US) == pytest.approx(1.0)
    assert item.stored(1.0, US) == pytest.approx(25.4)


def test_typed_values_of_a_bore_are_read(monkeypatch: pytest.MonkeyPatch) -> None:
    at = visit(HOME, bearing="elliptical")
    open_part(at, "settings")
    at.toggle(key="typed").set_value(True).run()
    at.text_input(key="input_preload_SI_typed").set_value("0,35").run()
    assert session_of(at).values["preload"] == 0.35
    at.text_input(key="input_preload_SI_typed").set_value("1.5").run()
    assert session_of(at).values["preload"] == 0.35
    assert any("Preload m = 1.5 lies outside 0 to 0.9" in one.value for one in at.warning)


def said_of_the_short_film(at: AppTest) -> list[str]:
    return [one.value for one in at.markdown if one.value.startswith("The short bearing ")]


def test_the_panel_has_the_short_bearings_own_error_and_leads_to_the_finite_film() -> None:
    at = visit(HOME, L="150")
    assert said_of_the_short_film(at) == []
    open_part(at, "validity")
    (said,) = said_of_the_short_film(at)
    short = machine_of(session_of(at).values)
    finite = replace(short, bearing=replace(short.bearing, film="finite"))
    error = 100.0 * (onset_speed(short).speed / onset_speed(finite).speed - 1.0)
    assert error > 1.0
    assert f"puts the onset **{error:.2g} % too high** here" in said
    at.button(key="use_finite").click().run()
    assert machine_of(session_of(at).values) == finite
    assert said_of_the_short_film(at) == []
    assert not any(one.key == "use_finite" for one in at.button)
    at.button(key="undo").click().run()
    assert machine_of(session_of(at).values) == short
    assert faults(at) == []


def test_the_error_of_the_short_film_is_that_of_a_textbooks_example() -> None:
    # Jindal, Machine Design, ex. 17-2: h_min 8 µm by the chart, 13.8 µm by the short bearing.
    at = visit(
        HOME, D="60", L="60", C="40", load="6000", mass="1200", rpm="1260", mu="6.293", T="50",
        TR="50",
    )  # fmt: skip
    open_part(at, "validity")
    (said,) = said_of_the_short_film(at)
    found = re.search(r"the smallest film (\d+) % too thick", said)
    assert found
    assert float(found[1]) == pytest.approx(72, abs=12)


@pytest.mark.parametrize(
    ("query", "word"),
    [
        ({"load": "0"}, "has the same onset here"),
        ({"bearing": "elliptical", "film": "short"}, "puts the onset"),
        ({"bearing": "elliptical", "film": "short", "preload": "0.9"}, "has the same onset here"),
        ({"load": "2e6", "D": "30", "L": "10", "C": "200"}, "On the film of finite length"),
    ],
)
def test_what_the_finite_film_says_of_the_short_one_is_in_words(
    query: dict[str, str], word: str
) -> None:
    at = visit(HOME, **query)
    open_part(at, "validity")
    assert any(word in one.value for one in at.markdown)
    assert faults(at) == []


@pytest.mark.parametrize("kind", ["elliptical", "pressure-dam"])
def test_a_film_of_finite_length_has_no_error_of_a_short_one(kind: str) -> None:
    at = visit(HOME, bearing=kind)
    open_part(at, "validity")
    assert said_of_the_short_film(at) == []
    assert not any(one.key == "use_finite" for one in at.button)


@pytest.mark.parametrize(("query", "words"), [
    ({"bearing": "pressure-dam"}, ("∂p/∂n = 0", "2 pads, 96 cells", "twice as fine", "K by")),
    ({"bearing": "elliptical", "load": "0"}, ("∂p/∂n = 0", "2 pads, 96 cells", "twice as fine")),
    ({"bearing": "elliptical", "film": "short"}, ("at ambient pressure in the grooves",)),
])  # fmt: skip
def test_a_popover_has_what_was_solved_on_which_mesh(
    query: dict[str, str], words: tuple[str, ...]
) -> None:
    at = visit(HOME, **query)
    open_part(at, "explain_minimum_film_thickness")
    (said,) = [one.value for one in at.markdown if "Smallest film h: **" in one.value]
    assert all(word in said for word in words), said
    assert ("Mesh" in said) == ("film" not in query)
    assert faults(at) == []


SLOW = {
    "pressure-dam": {"bearing": "pressure-dam"},
    "multi-dam": {"bearing": "multi-dam"},
    "four grooves": {"bearing": "axial-grooves", "number": "4", "width": "15"},
}


@pytest.mark.parametrize("name", SLOW)
def test_while_a_slow_bore_is_dragged_its_film_is_coarse_says_so_and_is_refined_on_release(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROTORCALC_LIVE", "drag")
    at = visit(HOME, **SLOW[name])
    visitor = session_of(at)
    assert visitor.preview is not None
    item = sliders(visitor.values)[0]
    value = item.low + 0.4 * (item.high - item.low)

    def said(key: str, moved: float) -> str:
        assert visitor.preview is not None
        return visitor.preview.at(key, f"{moved}")["texts"]["said_verdict"]["words"]

    assert "Coarse mesh" in said(item.key, value)
    # Neither the bore as it is nor another speed asks for another table.
    assert "Coarse mesh" not in said(item.key, float(visitor.values[item.key] or 0.0))
    assert "Coarse mesh" not in said("rpm", 5000.0)
    monkeypatch.setattr("ui.widgets.session", lambda: visitor)
    _moved(item.key, visitor.units, value, dragging=False)
    monkeypatch.undo()
    at.run()
    computed = visitor.preview.computed
    assert computed.machine.bearing.model == "finite"
    assert visitor.values[item.key] == pytest.approx(value)
    assert not any("Coarse mesh" in one.value for one in (*at.success, *at.error, *at.warning))
    fine = onset_speed(machine_of(visitor.values)).speed
    assert computed.onset.speed == fine
    draft = replace(computed.machine, bearing=replace(computed.machine.bearing, film="coarse"))
    assert onset_speed(draft).speed == pytest.approx(fine, rel=0.05)


@pytest.mark.parametrize("kind", ["elliptical", "lobes", "plain"])
def test_a_quick_bore_is_dragged_as_it_is(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROTORCALC_LIVE", "drag")
    preview = session_of(visit(HOME, bearing=kind, film="finite")).preview
    assert preview is not None
    assert "Coarse mesh" not in preview.at("L", "47")["texts"]["said_verdict"]["words"]


def test_a_link_may_ask_for_the_coarse_mesh() -> None:
    at = visit(HOME, bearing="pressure-dam", film="coarse")
    assert any("Coarse mesh" in one.value for one in (*at.success, *at.warning))
    at.segmented_control(key="film_model").set_value("finite").run()
    assert session_of(at).values["film"] is None
    assert faults(at) == []
