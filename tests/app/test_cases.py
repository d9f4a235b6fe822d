"""Cases: kept, named, compared in the units of their quantities, carried by the link."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc.figures.cases import COLOURS
from rotorcalc.units import US
from tests.app.session import (
    HOME,
    OTHERS,
    PAGES,
    charts,
    comparison,
    faults,
    move,
    open_part,
    session_of,
    tours,
    visit,
)
from tests.app.test_bearings import query
from tests.app.test_link import drawn_values
from ui import cases
from ui.cases import Case
from ui.computed import computed_from
from ui.inputs import DEFAULT_PRESET, PRESET_VALUES
from ui.results.table import RESULTS
from ui.sharing import address

# The drawing of the axes shows no machine, the sample file one alone; these results are computed
# once a visitor asks.
ALONE = {"campbell", "conventions", "orbits_hysteresis", "orbits_waterfall", "orbits_cycles"} | {
    *("own_sample_K", "own_sample_C"),
    *(f"tolerances_{name}" for name in ("onset", "margin", "ranking", "cloud")),
}
DEFAULT = PRESET_VALUES[DEFAULT_PRESET]
TWO = "Wide~3~C~95~~Thin oil~1~T~90~mu~9"


def _of_cases(figure: dict) -> dict[str, set[str]]:
    """Return the colours of each case's lines and marks in a chart, by the case's name."""
    found: dict[str, set[str]] = {}
    for trace in figure["data"]:
        if (group := trace.get("legendgroup")) and ": " in trace["name"]:
            found.setdefault(group, set()).add(trace["line"]["color"])
            assert trace["marker"]["line"]["color"] == trace["line"]["color"]
    return found


@pytest.mark.parametrize("path", PAGES)
def test_every_chart_draws_and_names_every_case_in_its_colour(path: str) -> None:
    at = visit(path, cases=TWO)
    for label in tours(at):
        for key, figure in charts(at).items():
            if key.removeprefix("chart_") in ALONE:
                continue
            colours = _of_cases(figure)
            assert colours.keys() <= {"Wide", "Thin oil"}, (label, key)
            assert colours, (label, key)
            assert all(
                colours[name] == {colour} for name, colour in _COLOURS.items() if name in colours
            )
            named = {
                t["name"]: t["line"]["color"]
                for t in figure["data"]
                if t.get("showlegend") and t.get("legendgroup")
            }
            assert named == {name: _COLOURS[name] for name in colours}, (label, key)
            assert figure["layout"].get("showlegend", True)
        assert faults(at) == [], label


_COLOURS = {"Wide": COLOURS[2], "Thin oil": COLOURS[0]}


def test_keeping_a_machine_and_moving_on_compares_them() -> None:
    at = visit(HOME)
    at.button(key="keep").click().run()
    move(at, "C", 85.0)
    rows = comparison(at)
    assert rows["Radial clearance C [µm]"] == "85 | 60"
    kept, live = computed_from(DEFAULT), computed_from(DEFAULT | {"C": 85.0})
    rise = (live.onset.speed - kept.onset.speed) * 30.0 / 3.141592653589793
    said = rows["Onset of whirl Ωₒₙ"]
    assert said.startswith(RESULTS["onset_speed"].shown(live, at.session_state["rotorcalc"].units))
    assert f"−{abs(rise):.0f} rpm |" in said
    assert any(metric.delta == f"−{abs(rise):.0f} rpm vs A" for metric in at.metric)
    assert len(rows) == 1 + 8  # only one input differs


def test_a_difference_is_in_the_unit_of_its_quantity() -> None:
    kept, live = computed_from(DEFAULT), computed_from(DEFAULT | {"C": 85.0})
    units = session_of(visit(HOME)).units
    margin = RESULTS["margin"]
    points = 100.0 * (margin.value(live) - margin.value(kept))
    assert points < -10.0  # not to be confused with a per cent of the margin
    assert margin.change(live, kept, units) == f"−{abs(points):.4g} % points"
    assert RESULTS["margin"].change(kept, kept, units) == "no change"
    film = RESULTS["minimum_film_thickness"]
    mil = (film.value(live) - film.value(kept)) / 25.4e-6
    assert film.change(live, kept, US) == f"{'+' if mil > 0 else '−'}{abs(mil):.4g} mil"
    never = computed_from(DEFAULT | {"cs": 1e5})
    assert RESULTS["onset_speed"].change(never, kept, units) == ""


def test_cases_survive_a_change_of_page_and_of_units_and_a_new_session() -> None:
    at = visit(HOME, cases=TWO, units="US")
    before = session_of(at).cases
    assert [(case.name, case.colour) for case in before] == list(_COLOURS.items())
    assert before[1].values == DEFAULT | {"T": 90.0, "mu": 9.0}
    at.switch_page(OTHERS[0]).run()
    assert session_of(at).cases == before
    assert at.query_params == {"cases": TWO, "units": "US"}
    assert session_of(visit(OTHERS[1], **at.query_params)).cases == before


def test_eight_cases_fill_the_table_and_the_colours_and_no_more_are_taken() -> None:
    at = visit(HOME)
    for clearance in range(61, 69):
        move(at, "C", float(clearance))
        at.button(key="keep").click().run()
    kept = session_of(at).cases
    assert [case.name for case in kept] == list("ABCDEFGH")
    assert [case.colour for case in kept] == list(COLOURS)
    assert at.button(key="keep").disabled
    assert len(comparison(at)["Radial clearance C [µm]"].split(" | ")) == 9
    with pytest.raises(ValueError, match="8 cases already"):
        cases.added(kept, "I", DEFAULT)


def test_a_removed_case_frees_its_colour_and_the_others_keep_theirs() -> None:
    at = visit(HOME, cases=TWO)
    open_part(at, "cases")
    at.button(key=f"case_{COLOURS[2]}_drop").click().run()
    assert [(case.name, case.colour) for case in session_of(at).cases] == [("Thin oil", COLOURS[0])]
    at.button(key="keep").click().run()
    assert session_of(at).cases[1].colour == COLOURS[1]


def test_a_used_case_is_the_live_machine() -> None:
    at = visit(HOME, cases=TWO)
    open_part(at, "cases")
    at.button(key=f"case_{COLOURS[0]}_use").click().run()
    assert session_of(at).values == DEFAULT | {"T": 90.0, "mu": 9.0}
    assert at.slider(key="input_T_SI_slider").value == 90.0
    move(at, "T", 80.0)
    assert session_of(at).cases[1].values["T"] == 90.0  # the case stays as it was kept


@pytest.mark.parametrize("name", ["", "Wide", "<b>", "a~b", "a\nb", "$x$", "[a](b)"])
def test_a_name_that_is_taken_or_holds_markup_is_refused_in_words(name: str) -> None:
    at = visit(HOME, cases=TWO)
    open_part(at, "cases")
    at.text_input(key=f"case_{COLOURS[0]}_name").set_value(name).run()
    assert [case.name for case in session_of(at).cases] == ["Wide", "Thin oil"]
    assert at.exception == []
    (said,) = [box.value for box in at.warning]
    assert "case" in said
    assert at.text_input(key=f"case_{COLOURS[0]}_name").value == "Thin oil"


def test_a_name_of_more_than_24_letters_is_refused() -> None:
    assert Case("x" * 24, DEFAULT, COLOURS[0]).name == "x" * 24
    with pytest.raises(ValueError, match="24 letters"):
        Case("x" * 25, DEFAULT, COLOURS[0])


@pytest.mark.parametrize(
    ("text", "kept", "word"),
    [
        ("A~1~C~-5", ["A"], "Radial clearance"),
        ("A~1~colour~red", ["A"], "colour"),
        ("<script>~1~C~80", [], "left out"),
        ("A~1~C~80~~A~2~C~90", ["A"], "already"),
        ("~~".join(f"{i}~1" for i in range(9)), [f"{i}" for i in range(8)], "8 cases"),
    ],
)
def test_what_a_link_says_of_cases_is_checked_and_named(text: str, kept: list, word: str) -> None:
    read = address.read({"cases": text, "C": "80"})
    assert [case.name for case in read.cases] == kept
    assert len({case.colour for case in read.cases}) == len(kept)
    assert word in " ".join(read.problems)
    assert read.values == DEFAULT | {"C": 80.0}


@given(st.text(max_size=60) | st.text("~A1C80.-", max_size=60))
def test_no_text_of_cases_breaks_the_program(text: str) -> None:
    read = address.read({"cases": text})
    for case in read.cases:
        computed_from(case.values)


@given(data=st.data(), preset=st.sampled_from(sorted(PRESET_VALUES)))
def test_cases_of_a_link_read_back_as_they_were_written(data: st.DataObject, preset: str) -> None:
    names = data.draw(st.lists(st.text("Aé1 .-=", min_size=1, max_size=24).map(str.strip)
                               .filter(bool), unique=True, max_size=8))  # fmt: skip
    colours = data.draw(st.permutations(COLOURS))
    kept = tuple(
        Case(name, data.draw(drawn_values(preset)), colour)
        for name, colour in zip(names, colours, strict=False)
    )
    again = address.read(address.write(preset, PRESET_VALUES[preset], "SI", kept))
    assert again.problems == []
    assert again.cases == kept


def test_a_case_whose_film_has_no_answer_is_named_and_the_page_stays() -> None:
    touching = query("sprung") | {"load": "200000", "rpm": "100"}
    given = "~".join(f"{key}~{word}" for key, word in touching.items())
    at = visit(HOME, cases=f"A~1~rpm~100~~B~2~{given}")
    assert at.exception == []
    assert at.metric
    (box,) = at.warning
    assert re.fullmatch(r"Case B is not shown: .*the journal touches\.", box.value)
