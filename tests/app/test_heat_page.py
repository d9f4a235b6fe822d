"""The page Heat, and every other page with the film's temperature from a supply of oil."""

import math
import re

import pytest

from rotorcalc import PRESETS, analyse
from rotorcalc.units import SI, US
from tests.app.session import (
    BEARINGS_PAGE,
    faults,
    open_part,
    session_of,
    texts,
    tours,
    visit,
)
from ui.bores import NAMES
from ui.computed import computed_from
from ui.format import amount
from ui.frame.page import PAGES
from ui.inputs import PRESET_VALUES
from ui.sharing import address
from ui.sharing.report_charts import charts, left_out, sections
from ui.words.verdict import verdict

HEAT = next(path for path, name in PAGES.items() if name == "Heat")
SUPPLY = {"T_in": "45", "flow": "10", "share": "0.9"}
# Each page with some bore, each bore on some page.
KINDS = list(NAMES)
ROUND = [(path, KINDS[place % len(KINDS)]) for place, path in enumerate(PAGES, start=1)]


@pytest.mark.usefixtures("coarse_maps")
@pytest.mark.parametrize(("path", "kind"), ROUND)
def test_every_page_works_with_a_supply(path, kind):
    # Without the table of a film of finite length, but where a bore has pockets.
    film = {} if "dam" in kind else {"film": "short"}
    at = visit(path, bearing=kind, **film, **SUPPLY)
    for tab in tours(at):
        assert not faults(at), tab


@pytest.mark.parametrize("preset", PRESETS)
def test_heat_of_every_preset(preset):
    at = visit(HEAT, preset=preset, T_in="45", flow="10", law="walther")
    for tab in tours(at):
        assert not faults(at), tab


def test_a_given_temperature_says_what_rise_and_what_flow_it_means():
    at = visit(HEAT)
    open_part(at, "validity")
    [said] = [text for text in texts(at) if "min alone would warm by" in text]
    # 11.1735 kW, 0.67957 l/min, 860 kg/m³ and 2000 J/(kg·K)
    assert "573.6 K" in said
    assert "18.81 l/min" in said
    [panel] = [text for text in texts(at) if "rise of the oil in the film" in text]
    [line] = [line for line in panel.split("\n\n") if "rise of the oil" in line]
    assert "573.6" in line
    assert "18.81 l/min" in line
    assert not faults(at)


def test_a_supply_can_be_had_on_the_page():
    at = visit(HEAT, tab="Balance")
    at.button(key="use_supply").click().run()
    assert session_of(at).values["T_in"] is not None
    assert not faults(at)
    assert not [button for button in at.button if button.key == "use_supply"]


def test_bearings_are_compared_at_the_temperature_of_their_own_balance():
    at = visit(BEARINGS_PAGE, **SUPPLY)
    [table] = at.dataframe
    film = next(column for name, column in table.value.items() if name.startswith("Film"))
    assert film.iloc[0] == pytest.approx(
        float(computed_from(session_of(at).values).point.temperature)
    )
    assert film.nunique() == len(film)


def test_the_report_has_the_balance_of_a_supply():
    given = computed_from(PRESET_VALUES["sheet-1e8"])
    supplied = computed_from(address.read(SUPPLY).values)
    missing = {"temperatures", "balance"}
    drawn = [{one.key for one in sections(c)["Heat"]} for c in (given, supplied)]
    assert drawn == [{"rise", "viscosity"}, {"rise", "viscosity"} | missing]
    assert any("temperature is given" in words for words in left_out(given, "Heat"))
    assert charts(supplied, [], US).keys() > missing


def test_a_machine_whose_oil_ends_before_an_onset_is_not_said_never_to_whirl():
    # An oil that does not thin: by the side flow alone the film is at 370 °C below the onset.
    computed = computed_from(address.read({"T_in": "45", "flow": "0.5", "alpha": "0"}).values)
    assert math.isinf(computed.onset.speed)
    with pytest.raises(ValueError, match="hotter"):
        analyse(computed.machine, 1.01 * computed.onset.searched_to)
    words = verdict(computed, SI).sentence
    assert f"no whirl up to {amount(SI.speed, computed.onset.searched_to)}" in words


def test_us_units_have_rises_in_degrees_fahrenheit():
    at = visit(HEAT, units="US")
    open_part(at, "validity")
    said = " ".join(texts(at))
    assert "holds the rise at 36 °F" in said
    # 574 K, and the 23 K by which the film's viscosity halves.
    assert re.search(r"rise of the oil in the film, in °F: \*\*103\d\*\* \(limit 41\.\d+\)", said)
