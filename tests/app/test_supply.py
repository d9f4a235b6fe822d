"""A supply of oil in place of the film temperature: its switch, sliders, link, file and history."""

import math
from dataclasses import replace

import pytest

from rotorcalc import PRESETS, Rotor, analyse
from rotorcalc.units import SI
from tests.app.session import HOME, faults, session_of, visit
from ui.computed import Computed
from ui.inputs import PRESET_VALUES, has_supply, input_named, machine_of, speeds_of
from ui.results.table import RESULTS
from ui.sharing import address
from ui.supply import other
from ui.words import citation, root_locus
from ui.words.verdict import verdict

SHEET = PRESET_VALUES["sheet-1e8"]


def read(**query):
    link = address.read(query)
    return link.values, link.problems


@pytest.mark.parametrize("preset", PRESETS)
def test_switching_to_a_supply_and_back_keeps_the_film_at_the_running_speed(preset):
    values = PRESET_VALUES[preset]
    supplied = values | other(values)
    machine, (speed, _) = machine_of(supplied), speeds_of(supplied)
    assert machine.temperature is None
    point = analyse(machine, speed)
    assert float(point.temperature) == pytest.approx(values["T"], abs=0.06)
    assert float(point.outlet_temperature) - machine.supply.temperature < 20.1
    back = supplied | other(supplied)
    assert not has_supply(back)
    assert machine_of(back).temperature == pytest.approx(values["T"], abs=0.11)


@pytest.mark.parametrize(
    ("query", "supply"),
    [
        ({"T_in": "45"}, (45.0, 0.0, 1.0)),
        ({"T_in": "45", "flow": "12.5", "share": "0.8"}, (45.0, 12.5 / 60e3, 0.8)),
        ({"T_in": "0", "flow": "0", "preset": "sheet-1e7"}, (0.0, 0.0, 1.0)),
    ],
)
def test_a_link_with_a_supply_is_read_and_written_alike(query, supply):
    values, problems = read(**query)
    assert not problems
    found = machine_of(values).supply
    assert (found.temperature, found.flow, found.heat_share) == pytest.approx(supply)
    written = address.write(query.get("preset", "sheet-1e8"), values, "SI")
    assert read(**written) == (values, [])
    assert "T" not in written


@pytest.mark.parametrize(
    ("query", "words"),
    [
        ({"flow": "3"}, "belongs to a supply"),
        ({"share": "0.5"}, "belongs to a supply"),
        ({"T_in": "40", "T": "60"}, "follows from the supply"),
        ({"T_in": "400"}, "0 to 150 °C; the film's temperature is given instead."),
        ({"T_in": "40", "share": "1.5"}, "lies outside 0 to 1; 1 is used."),
        ({"T_in": "40", "flow": "x"}, "is not a number; 0 is used."),
        ({"T": "none"}, "Film temperature (T) is missing"),
        ({"law": "linear"}, "is not one of exponential, walther"),
    ],
)
def test_a_link_that_contradicts_itself_is_refused_in_words(query, words):
    values, problems = read(**query)
    assert any(words in problem for problem in problems)
    machine_of(values)


def test_a_film_temperature_is_no_input_with_a_supply():
    supplied = SHEET | other(SHEET)
    with pytest.raises(ValueError, match="is not an input"):
        input_named("T", supplied)
    with pytest.raises(ValueError, match="is not an input"):
        input_named("flow", SHEET)


def test_the_switch_the_sliders_and_undo():
    at = visit(HOME)
    visitor = session_of(at)
    at.toggle(key="oil_supply").set_value(True).run()
    assert not faults(at)
    assert has_supply(visitor.values)
    assert "T_in" in at.query_params
    assert "Tᵢₙ" in next(one.value for one in at.caption if "Changed" in one.value)
    at.button(key="undo").click().run()
    assert visitor.values == SHEET
    assert not at.toggle(key="oil_supply").value
    at.button(key="redo").click().run()
    at.toggle(key="oil_supply").set_value(False).run()
    assert not faults(at)
    assert math.isclose(visitor.values["T"], 60.0, abs_tol=0.11)


def test_where_no_balance_exists_the_page_says_why():
    at = visit(HOME, T_in="40", load="0")
    assert "no oil leaves" in at.error[0].value


def test_where_the_oil_runs_out_before_an_onset_no_word_claims_that_there_is_none():
    # So heavy a load on so light a rotor whirls at speeds at which the oil would burn.
    machine = replace(machine_of(SHEET | other(SHEET)), load=1e6, rotor=Rotor(mass=0.01))
    shown = Computed(machine, 300.0, 600.0)
    assert shown.onset_is_unknown
    said = [
        verdict(shown, SI).sentence,
        citation.without_onset(shown),
        root_locus.crossing(shown, shown.onset, SI),
    ]
    for words, there in zip(said, ["too little to carry", "As far as", "as far as"], strict=True):
        assert there in words
    never = ["never", "no speed makes", "cannot make"]
    assert not any(words in one.lower() for one in said for words in never)
    at_onset = [result.shown(shown, SI) for result in RESULTS.values() if result.at_onset]
    assert len(at_onset) > 2
    assert {*at_onset} == {"not found"}
