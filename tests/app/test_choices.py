"""Tabs and choices: kept from page to page, carried by the link, checked like any input."""

from contextlib import suppress

import pytest
from streamlit.testing.v1 import AppTest

from tests.app.session import (
    BEARINGS_PAGE,
    HOME,
    ORBITS,
    PAGES,
    charts,
    faults,
    open_part,
    tabs,
    visit,
)
from ui.bearing import fields_of, kinds
from ui.choices import NAMES, Choices
from ui.inputs import INPUTS

STABILITY, EQUILIBRIUM = "pages/3_Stability.py", "pages/1_Equilibrium.py"


def _open(at: AppTest) -> str:
    ((key, first), *_) = tabs(at)
    with suppress(KeyError):
        return at.session_state[key]
    return first


def test_the_names_of_choices_are_no_inputs() -> None:
    taken = {*INPUTS, "bearing", "film", "preset", "units", "cases"}
    assert not NAMES & taken.union(*(fields_of(kind) for kind in kinds()))


@pytest.mark.parametrize("path", [path for path in PAGES if path not in (HOME, BEARINGS_PAGE)])
def test_the_open_tab_is_in_the_link_which_opens_it_elsewhere(path: str) -> None:
    at = visit(path)
    assert at.query_params == {}
    for key, label in tabs(at):
        open_part(at, key, label)
        other = visit(path, **at.query_params)
        assert _open(other) == label
        assert charts(other).keys() == charts(at).keys()
        assert other.query_params == at.query_params
        assert faults(other) == []
    assert at.query_params == {"tab": label}


def test_tabs_and_choices_are_kept_when_pages_change() -> None:
    at = visit(STABILITY)
    open_part(at, "stability_tab", "Figures of the notes")
    at.segmented_control(key="stability_over").set_value("ε").run()
    shown = charts(at)
    assert at.query_params == {"tab": "Figures of the notes", "over": "ε"}
    at.switch_page(EQUILIBRIUM).run()
    assert at.query_params == {}
    at.switch_page(STABILITY).run()
    assert at.query_params == {"tab": "Figures of the notes", "over": "ε"}
    assert charts(at) == shown


@pytest.mark.parametrize(
    ("path", "query"),
    [
        (STABILITY, {"tab": "Map", "x": "T", "y": "D"}),
        (STABILITY, {"tab": "Remedies", "vary": "L"}),
        (ORBITS, {"tab": "In time", "kick": "0.5", "revolutions": "60"}),
        ("pages/4_Root_locus.py", {"tab": "Mode", "shaft": "rigid", "spiral": "yes"}),
        ("pages/5_Response.py", {"shown": "XY"}),
        ("pages/2_Coefficients.py", {"axes": "rt", "tab": "Against ε"}),
        (HOME, {"scale": "to scale"}),
    ],
)
def test_a_link_reproduces_choices(path: str, query: dict[str, str]) -> None:
    at, usual = visit(path, **query), visit(path)
    assert at.query_params == query
    assert faults(at) == []
    assert not at.warning or path == ORBITS
    at.run()
    assert at.query_params == query
    assert charts(at) != charts(usual)


@pytest.mark.parametrize("word", ["Nowhere", "", "<b>", "1e999"])
@pytest.mark.parametrize("name", ["tab", "kick", "revolutions"])
def test_a_choice_that_a_page_does_not_have_is_named(name: str, word: str) -> None:
    at = visit(ORBITS, **{name: word})
    assert at.exception == []
    assert any(box.value.startswith(f"{name} = ") for box in at.warning)
    at.run()
    assert at.query_params == {}


@pytest.mark.parametrize("kept", [None, 1, [], {"b": [], "orbits_kick": {}}])
def test_what_a_browser_kept_of_choices_is_checked(kept: object) -> None:
    mine = Choices()
    mine.recall(kept)
    assert mine.chosen == {}


def test_a_kept_choice_outside_its_range_is_the_pages_own_again() -> None:
    at = visit(HOME)
    at.session_state["rotorcalc_choices"].recall({"orbits_kick": 1e300, "orbits_tab": "Film"})
    at.switch_page(ORBITS).run()
    assert at.slider(key="orbits_kick").value == 0.3
    assert at.exception == []
