"""What a session keeps: values from page to page, units, presets, the link."""

import json
import math

import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc import Machine
from rotorcalc.units import US
from tests.app.session import (
    BEARINGS_PAGE,
    HOME,
    NOTES,
    OTHERS,
    PAGES,
    YOUR_DATA,
    charts,
    faults,
    move,
    open_part,
    session_of,
    visit,
)
from ui.format import literal
from ui.inputs import INPUTS, PRESET_VALUES, applies, machine_of, values_of
from ui.sharing import address

RESPONSE = "pages/5_Response.py"


def _units(at, name: str) -> None:
    open_part(at, "settings")
    at.segmented_control(key="units").set_value(name).run()


def test_a_value_survives_a_change_of_page() -> None:
    at = visit(HOME)
    move(at, "C", 85.0)
    for path in (*OTHERS, HOME):
        at.switch_page(path).run()
        assert at.select_slider(key="input_C_SI_slider").value == 85.0, path
        assert session_of(at).values["C"] == 85.0
        assert at.query_params == {"C": "85"}


def test_a_link_is_kept_on_every_page_until_a_slider_moves() -> None:
    at = visit(OTHERS[0], preset="sheet-1e7", C="80", rpm="3000", k="inf")
    before = dict(session_of(at).values)
    for path in (HOME, *OTHERS):
        at.switch_page(path).run()
        assert session_of(at).values == before
        assert _shown(at) == {key: before[key] for key in INPUTS if applies(key, before)} | {
            "load": None
        }
        assert at.selectbox(key="preset").value == "sheet-1e7"
        assert at.toggle(key="load_follows").value
        assert at.query_params == {"preset": "sheet-1e7", "C": "80", "rpm": "3000", "k": "inf"}


def test_a_moved_value_goes_into_the_address_bar_and_to_every_page() -> None:
    at = visit(HOME)
    move(at, "C", 85.0)
    moved = dict(session_of(at).values)
    assert moved["C"] == 85.0
    for path in (HOME, *OTHERS):
        at.switch_page(path).run()
        assert at.query_params == {"C": "85"}, path
        assert session_of(at).values == moved, path
        assert _shown(at)["C"] == 85.0, path


def _shown(at) -> dict[str, float | None]:
    """Return where the sliders stand."""
    return {"load": None} | {
        slider.key.removeprefix("input_").removesuffix("_SI_slider"): slider.value
        for slider in (*at.slider, *at.select_slider)
        if (slider.key or "").startswith("input_")
    }


def test_a_preset_resets_all_values() -> None:
    at = visit(HOME, C="80", cs="500")
    at.selectbox(key="preset").set_value("sheet-1e7").run()
    assert session_of(at).values == PRESET_VALUES["sheet-1e7"]
    at.selectbox(key="preset").set_value("sheet-1e8").run()
    assert session_of(at).values == PRESET_VALUES["sheet-1e8"]
    assert at.query_params == {}


@pytest.mark.parametrize("preset", PRESET_VALUES)
@pytest.mark.parametrize("typed", [False, True])
def test_switching_units_leaves_the_machine(preset: str, typed: bool) -> None:
    at = visit(HOME, preset=preset, C="81.3", load="1234.5", k="3.3e7")
    if typed:
        open_part(at, "settings")
        at.toggle(key="typed").set_value(True).run()
    before, machine = dict(session_of(at).values), machine_of(session_of(at).values).to_json()
    for units in ("US", "SI", "US", "SI"):
        _units(at, units)
        assert session_of(at).units_name == units
        assert session_of(at).values == before
        assert machine_of(session_of(at).values).to_json() == machine
        assert faults(at) == []


def test_us_units_are_shown() -> None:
    at = visit(HOME, units="US")
    labels = [slider.label for slider in (*at.slider, *at.select_slider)]
    for unit in ("lb", "mil", "in", "µreyn", "°F", "lbf/in"):
        assert any(f"[{unit}]" in label for label in labels), unit
    assert any(metric.value.endswith(" hp") for metric in at.metric)


def test_moving_a_slider_in_us_units_keeps_si() -> None:
    at = visit(HOME, units="US")
    at.select_slider(key="input_C_US_slider").set_value(4.0).run()
    assert session_of(at).values["C"] == pytest.approx(4 * 25.4, rel=1e-12)


@pytest.mark.parametrize("units", ["SI", "US"])
def test_one_switch_reads_every_amplitude_peak_to_peak(units: str) -> None:
    at = visit(RESPONSE, units=units)
    before, values = _amplitudes(at), dict(session_of(at).values)
    assert len(before) == 2
    open_part(at, "settings")
    at.segmented_control(key="amplitude").set_value("p-p").run()
    assert session_of(at).values == values
    assert at.query_params["amplitude"] == "p-p"
    after = _amplitudes(at)
    for label, (number, unit) in before.items():
        twice, now = after[label]
        assert float(twice) == pytest.approx(2.0 * float(number), rel=1e-3)
        assert (unit[-3:], now) == ("0-p", unit.replace("0-p", "p-p"))
    other = visit(RESPONSE, **at.query_params)
    assert _amplitudes(other) == after
    titles = _titles(other)
    assert any("p-p]" in title for title in titles)
    assert not any("0-p]" in title for title in titles)
    assert faults(other) == []


def test_a_link_with_another_reading_of_amplitudes_is_reported() -> None:
    at = visit(HOME, amplitude="rms")
    assert any("`'rms'` is not one of 0-p, p-p" in box.value for box in at.warning)


def _amplitudes(at: AppTest) -> dict[str, tuple[str, str]]:
    """Return number and unit of each amplitude shown."""
    shown = {metric.label: metric.value.replace("\u2060", "") for metric in at.metric}
    parts = {label: value.partition(" ") for label, value in shown.items()}
    return {label: (number, unit) for label, (number, _, unit) in parts.items() if "-p" in unit}


def _titles(at: AppTest) -> list[str]:
    layouts = [chart["layout"] for chart in charts(at).values()]
    return [
        part["title"]["text"]
        for layout in layouts
        for name, part in layout.items()
        if "axis" in name and "title" in part
    ]


def test_a_broken_link_gets_a_message_and_keeps_the_valid_values() -> None:
    at = visit(HOME, C="-5", D="abc", mu="nan", T="70", colour="red")
    said = [box.value for box in at.warning]
    assert len(said) == 4
    for name in ("Radial clearance", "Diameter", "Reference viscosity", "colour"):
        assert any(name in words for words in said), name
    assert session_of(at).values == PRESET_VALUES["sheet-1e8"] | {"T": 70.0}


def test_a_link_refused_in_part_gets_no_verdict_until_the_rest_is_taken() -> None:
    query = {"load": "9e9", "mass": "9e9", "D": "400"}
    at = visit(HOME, **query)
    assert len(at.warning) == 2
    for page in PAGES:
        at.switch_page(page).run()
        assert [*at.metric, *at.success, *at.error, *charts(at)] == [], page
        assert faults(at) == []
    assert at.query_params == query  # read again, it is refused again
    at.switch_page(HOME).run()
    at.button(key="take").click().run()
    assert not at.warning
    assert at.query_params == {"D": "400"}
    assert at.metric


def test_a_preset_takes_the_place_of_a_refused_link() -> None:
    at = visit(HOME, C="-5")
    at.selectbox(key="preset").select("sheet-1e7").run()
    assert not at.warning
    assert at.metric


def test_a_machine_file_comes_back_the_same() -> None:
    at = visit(HOME, C="81.3", load="1234.5", k="inf", rpm="5000")
    machine = machine_of(session_of(at).values)
    other = visit(HOME, preset="fig-5-2")
    open_part(other, "share")
    other.file_uploader(key="upload").upload("machine.json", machine.to_json().encode()).run()
    assert machine_of(session_of(other).values) == machine
    assert faults(other) == []
    assert not other.warning


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("{", "JSON"),
        ('{"version": 7}', "version"),
        ("\x00\x01", "JSON"),
        ("<b>markup</b>", "JSON"),
    ],
)
def test_a_broken_machine_file_gets_a_message(text: str, word: str) -> None:
    at = visit(HOME, C="80")
    open_part(at, "share")
    at.file_uploader(key="upload").upload("bad.json", text.encode()).run()
    (warning,) = at.warning
    assert "bad.json" in warning.value
    assert word in warning.value
    assert session_of(at).values == PRESET_VALUES["sheet-1e8"] | {"C": 80.0}


def test_a_value_out_of_a_files_range_is_reported_by_name() -> None:
    document = json.loads(machine_of(PRESET_VALUES["sheet-1e8"]).to_json())
    document["bearing"]["radial_clearance"] = 1e-6
    document["temperature"] = 70.0
    at = visit(HOME)
    open_part(at, "share")
    at.file_uploader(key="upload").upload("m.json", json.dumps(document).encode()).run()
    (warning,) = at.warning
    assert "Radial clearance" in warning.value
    assert session_of(at).values == PRESET_VALUES["sheet-1e8"] | {"T": 70.0}
    assert not at.metric
    at.button(key="take").click().run()
    assert not at.warning
    assert at.metric


def test_the_shared_link_contains_the_whole_machine() -> None:
    at = visit(HOME, preset="sheet-1e7", C="81.3", u="3.7")
    open_part(at, "share")
    query = dict(part.split("=") for part in at.code[0].value.split("?")[1].split("&"))
    again = address.read(query)
    assert again.problems == []
    assert (again.preset, again.values) == (session_of(at).preset, session_of(at).values)


def test_the_load_toggle_gives_the_weight_and_takes_it_back() -> None:
    at = visit(HOME)
    weight = machine_of(session_of(at).values).static_load
    at.toggle(key="load_follows").set_value(False).run()
    assert session_of(at).values["load"] == pytest.approx(weight, rel=1e-3)
    move(at, "load", 0.0)
    assert session_of(at).values["load"] == 0.0
    at.toggle(key="load_follows").set_value(True).run()
    assert session_of(at).values["load"] is None


@pytest.mark.parametrize("temperature", [0.0, 40.0, 60.0, 150.0])
def test_every_grade_of_the_oil_library_can_be_used(temperature: float) -> None:
    at = visit(HOME, T=str(temperature))
    open_part(at, "oil_library")
    for grade in at.selectbox(key="grade").options:
        at.selectbox(key="grade").set_value(grade).run()
        at.button(key="use_grade").click().run()
        assert at.exception == []  # out of a slider's range is told in words
        if not at.warning:
            assert session_of(at).values["TR"] == temperature


def test_a_fitted_oil_passes_through_its_two_viscosities() -> None:
    at = visit(HOME)
    open_part(at, "oil_library")
    at.number_input(key="fit_T1_SI").set_value(40.0)
    at.number_input(key="fit_μ1_SI").set_value(40.0)
    at.number_input(key="fit_T2_SI").set_value(100.0)
    at.number_input(key="fit_μ2_SI").set_value(5.0)
    at.run()
    at.button(key="use_fit").click().run()
    oil = machine_of(session_of(at).values).oil
    assert float(oil.viscosity(40.0)) == pytest.approx(0.040, rel=1e-4)
    assert float(oil.viscosity(100.0)) == pytest.approx(0.005, rel=1e-4)


def test_oils_without_a_valid_law_raise_a_valueerror() -> None:
    at = visit(HOME)
    open_part(at, "oil_library")
    at.number_input(key="fit_T2_SI").set_value(40.0).run()
    assert any("two temperatures must differ" in box.value for box in at.error)
    assert at.exception == []


def test_the_oil_library_is_in_the_units_shown() -> None:
    at = visit(HOME, units="US")
    open_part(at, "oil_library")
    assert {"T1 [°F]", "μ1 [µreyn]"} <= {field.label for field in at.number_input}
    assert any("140 °F" in caption.value for caption in at.caption)
    at.number_input(key="fit_T1_US").set_value(104.0)
    at.number_input(key="fit_T2_US").set_value(212.0)
    at.run()
    at.button(key="use_fit").click().run()
    oil = machine_of(session_of(at).values).oil
    assert oil.reference_temperature == pytest.approx(40.0)
    thick, thin = (at.number_input(key=f"fit_μ{place}_US").value for place in "12")
    for T, shown in ((40.0, thick), (100.0, thin)):
        assert US.viscosity.of(oil.viscosity(T)) == pytest.approx(shown, rel=1e-4)


LIMITS: tuple[dict[str, float], ...] = (
    {}, {"load": 0.0}, {"k": math.inf}, {"u": 0.0}, {"rpm": 100.0}, {"load": 20000.0, "rpm": 500.0},
)  # fmt: skip


@pytest.mark.parametrize("path", [path for path in PAGES if path != BEARINGS_PAGE])
def test_every_result_explains_itself_at_the_limits_too(path: str) -> None:
    at = visit(path)
    explained = [key for one in at.get("popover") if (key := one.key or "").startswith("explain_")]
    assert explained or path in (NOTES, YOUR_DATA)
    for key in explained:
        at.session_state[key] = True
    for values in LIMITS:
        session_of(at).values = PRESET_VALUES["sheet-1e8"] | values
        at.run()
        equations = "".join(text.value for text in at.markdown).count("$$\n") // 2
        assert equations >= len(explained), values
        assert faults(at) == [], values


def test_a_machine_read_from_values_is_the_machine() -> None:
    values = PRESET_VALUES["sheet-1e8"]
    machine = machine_of(values)
    assert Machine.from_json(machine.to_json()) == machine
    assert values_of(machine, 1.0, 2.0)["C"] == values["C"]


def test_a_lost_session_is_restored_from_what_its_browser_kept() -> None:
    at = visit(HOME, C="71", preset="sheet-1e7")
    visitor = session_of(at)
    visitor.typed, visitor.image_format = True, "svg"
    visitor.ask_for("orbits_run_up", "name")
    kept = json.loads(json.dumps(visitor.kept(), allow_nan=False))
    other = session_of(visit(HOME, C="72"))
    other.recall(kept)
    assert (other.typed, other.image_format) == (True, "svg")
    assert (other.asked, other.begun) == ({"orbits_run_up": "name"}, {"orbits_run_up"})


@pytest.mark.parametrize(
    "kept",
    [
        None, 1, "kept", [], {}, {"typed": "yes", "image_format": [], "asked": 2},
        {"asked": {"a": 1}, "chosen": {"b": "c"}},
        {"chosen": {"orbits_kick": 1e300}, "image_format": "exe", "labels": {"title": 3}},
        {"states": "kept", "place": 0}, {"states": ["C=85"], "place": 1},
        {"states": [1], "place": 0},
        {"states": ["C=85"], "place": -1}, {"states": ["C=85"], "place": "0"}, {"labels": ["a"]},
    ],
)  # fmt: skip
def test_state_kept_by_a_browser_is_checked_like_any_input(kept: object) -> None:
    visitor = session_of(visit(HOME, C="72"))
    visitor.recall(kept)
    assert (visitor.typed, visitor.image_format, visitor.asked) == (False, "png", {})
    assert not visitor.history.can_undo


def test_the_reason_a_file_is_refused_stands_whole_and_without_markup() -> None:
    said = literal("version = None: this program reads versions 1 and 2 `**bold**`\n# end")
    assert said == "`version = None: this program reads versions 1 and 2 '**bold**' # end`"
    assert len(literal("x" * 10**6)) < 500
