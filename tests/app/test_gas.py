"""A foil bearing runs on a gas; the oil of the others waits until they are chosen again."""

import pytest

from rotorcalc import Gas, Oil
from rotorcalc.units import SI
from tests.app.session import BEARINGS_PAGE, HOME, ORBITS, PAGES, faults, session_of, visit
from ui.computed import computed_from
from ui.inputs import GAS, inputs_of, law_of, machine_of, values_of
from ui.results.table import RESULTS
from ui.sharing import address
from ui.sharing.labels import Labels
from ui.sharing.report import report

LIGHT = {
    "load": "20",
    "rpm": "30000",
    "rpm_max": "60000",
    "C": "30",
    "D": "40",
    "L": "40",
    "mass": "4",
}


def chosen(at, kind):
    at.selectbox(key="bearing_kind").set_value(kind).run()
    return session_of(at)


def is_air(values):
    """Return whether the lubricant is air, but for the rounding of its unit."""
    gas, air = machine_of(values).oil, Gas()
    assert isinstance(gas, Gas)
    return gas.viscosity(60.0) == pytest.approx(air.viscosity(60.0), rel=1e-12)


def test_a_foil_takes_air_and_leaves_the_oil_as_it_was() -> None:
    at = visit(HOME, mu="20", **LIGHT)
    visitor = chosen(at, "foil")
    assert is_air(visitor.values)
    assert law_of(visitor.values) == "Sutherland"
    assert set(GAS) < set(inputs_of(visitor.values))
    assert "mu" not in inputs_of(visitor.values)
    assert faults(at) == []
    oil = machine_of(chosen(at, "plain").values).oil
    assert isinstance(oil, Oil)
    assert oil.reference_viscosity == 0.020
    assert faults(at) == []


def test_a_foil_keeps_a_given_temperature_where_oil_was_supplied() -> None:
    at = visit(HOME, T_in="40", **LIGHT)
    visitor = chosen(at, "foil")
    assert (visitor.values["T"], visitor.values["T_in"]) == (40.0, None)
    assert any("does not cool" in one.value for one in at.warning)


def test_a_link_with_a_supply_for_a_gas_or_a_gas_for_oil_is_refused_in_words() -> None:
    cooled = address.read({"bearing": "foil", "T_in": "40"})
    assert any("runs on a gas" in problem for problem in cooled.problems)
    assert is_air(cooled.values)
    strange = address.read({"S_gas": "100"})
    assert any("a foil bearing alone takes" in problem for problem in strange.problems)


def test_a_machine_on_a_gas_is_written_and_read_again() -> None:
    values = address.read({"bearing": "foil", "S_gas": "120", **LIGHT}).values
    machine = machine_of(values)
    again = values_of(machine, 3000.0, 6000.0)
    assert machine_of(values | again) == machine
    link = address.write("sheet-1e8", values, "SI")
    assert link["S_gas"] == "120"
    assert address.read(link).values == values


def test_beside_a_foil_the_other_bearings_run_on_the_oil() -> None:
    at = visit(BEARINGS_PAGE, bearing="foil", **LIGHT)
    (table,) = at.dataframe
    assert len(table.value) > 10
    assert faults(at) == []


@pytest.mark.parametrize("path", [path for path in PAGES if path != BEARINGS_PAGE])
def test_every_page_of_a_foil_bearing_shows_what_it_has(path: str) -> None:
    assert faults(visit(path, bearing="foil", **LIGHT)) == []


def test_a_gas_has_no_balance_of_heat_but_a_loss() -> None:
    at = visit("pages/9_Heat.py", bearing="foil", **LIGHT)
    assert any("no balance of heat" in one.value for one in at.info)
    assert {one.label for one in at.metric} == {"Film temperature T", "Viscosity μ", "Power loss"}
    at = visit("pages/9_Heat.py")
    assert "Rise of the oil ΔT" in {one.label for one in at.metric}


def test_the_report_of_a_foil_bearing_leaves_out_what_is_oils() -> None:
    shown = computed_from(address.read({"bearing": "foil", **LIGHT}).values)
    page = report(shown, [], SI, "link", Labels()).decode()
    assert "Sutherland" in RESULTS["viscosity"].cited(shown)
    for words in ("Rise of the oil ΔT", "Groove flow needed"):
        assert words not in page
    assert "The film is a gas" in page


def test_a_film_known_in_a_whirl_only_has_no_nonlinear_orbit() -> None:
    at = visit(ORBITS, bearing="foil", **LIGHT)
    (said,) = [one.value for one in at.info if "No nonlinear motion" in one.value]
    assert "bearing =" not in said
