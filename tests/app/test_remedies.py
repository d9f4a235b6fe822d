"""Remedies: the onset wanted makes sense for any machine, a solved value is applied and undone."""

import math
from dataclasses import replace

import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc import Machine, onset_speed
from tests.app.session import charts, faults, session_of, visit
from tests.films.models import BEARINGS
from tests.machines import SHEET
from ui.computed import computed_from
from ui.inputs import machine_of, values_of
from ui.sharing import address

STABILITY = "pages/3_Stability.py"
RPM = math.pi / 30


def _remedies(**query: str) -> AppTest:
    return visit(STABILITY, tab="Remedies", **query)


def _offers(at: AppTest) -> list[str]:
    return [button.label for button in at.button if (button.key or "").startswith("remedy_")]


def _machine(at: AppTest) -> Machine:
    return machine_of(session_of(at).values)


def _answer(at: AppTest) -> str:
    [text] = [one.value for one in at.markdown if one.value.startswith("Wanted: ")]
    return text


@pytest.mark.parametrize(
    ("query", "wanted"),
    [
        ({}, 1.2),  # of today's onset, as 20 % above the running speed is less
        ({"rpm": "10000"}, 12000.0),
        ({"rpm": "8000"}, 9600.0),
        ({"load": "0"}, 7200.0),
    ],
)
def test_an_applied_value_gives_the_onset_wanted_and_is_undone(
    query: dict[str, str], wanted: float
) -> None:
    at = _remedies(**query)
    before = dict(session_of(at).values)
    today = onset_speed(_machine(at)).speed
    target = wanted * (today if wanted < 10.0 else RPM)
    assert target > today
    at.button(key="remedy_0").click().run()
    assert faults(at) == []
    assert onset_speed(_machine(at)).speed == pytest.approx(target, rel=1e-4)
    assert target > computed_from(session_of(at).values).speed
    at.button(key="undo").click().run()
    assert session_of(at).values == before
    at.button(key="redo").click().run()
    assert onset_speed(_machine(at)).speed == pytest.approx(target, rel=1e-4)


def test_without_load_load_and_preload_are_offered() -> None:
    at = _remedies(load="0")
    assert _answer(at).startswith("Wanted: an onset of 7200 rpm")
    assert "Load per bearing **" in _answer(at)
    [cure] = [box.value for box in at.info if "whirls at any speed" in box.value]
    assert "**load**" in cure
    assert "**preload**" in cure
    assert _offers(at)


def test_a_preload_can_be_applied() -> None:
    machine = replace(SHEET, bearing=BEARINGS["preloaded"])
    at = _remedies(
        vary="spring",
        margin="5",
        **address.write("sheet-1e8", values_of(machine, 600.0, 1200.0), "SI"),
    )
    today = onset_speed(_machine(at)).speed
    assert _offers(at)
    at.button(key="remedy_0").click().run()
    assert _machine(at).bearing.geometry != machine.bearing.geometry
    assert onset_speed(_machine(at)).speed == pytest.approx(1.05 * today, rel=1e-4)


@pytest.mark.parametrize("word", ["abc", "-5", "1e9", "nan", ""])
def test_a_margin_that_makes_no_sense_gets_no_answer(word: str) -> None:
    at = _remedies()
    at.text_input(key="stability_margin").set_value(word).run()
    assert any(box.value.startswith("Margin [%] = ") for box in at.warning)
    assert _offers(at) == []
    assert "chart_solution" not in charts(at)


@pytest.mark.parametrize("word", ["0", "-3", "inf"])
def test_a_speed_that_makes_no_sense_gets_no_answer(word: str) -> None:
    at = _remedies(wanted="at a given speed", target=word)
    assert any(box.value.startswith("Speed [rpm] = ") for box in at.warning)
    assert _offers(at) == []


def test_the_onset_wanted_is_in_the_link() -> None:
    at = _remedies(wanted="at a given speed", target="9000", vary="L")
    assert "an onset of 9000 rpm" in _answer(at)
    query = dict(at.query_params)
    assert _answer(_remedies(**{k: v for k, v in query.items() if k != "tab"})) == _answer(at)


def test_an_onset_that_is_higher_already_says_how_far_the_input_may_go() -> None:
    at = _remedies(wanted="above the running speed")
    assert "higher already, 8919 rpm" in _answer(at)
    assert "would lower it" in _answer(at)
