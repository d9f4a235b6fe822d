"""The recesses of a hydrostatic bearing on the page Equilibrium, live, in files and refused."""

import csv
import html
import math
import re
from dataclasses import replace

import pytest

from rotorcalc import PRESETS, TransientError, onset_speed
from rotorcalc.units import SI, US
from tests.app.session import (
    HOME,
    ORBITS,
    charts,
    faults,
    open_part,
    session_of,
    tabs,
    texts,
    visit,
)
from tests.films.test_hydrostatic import MACHINE
from ui.computed import computed_from
from ui.format import amount, digits
from ui.inputs import values_of
from ui.jobs import work
from ui.sharing import export, report
from ui.sharing.labels import Labels
from ui.words import run_up

PAGE = "pages/1_Equilibrium.py"
VARIED = "t the running speed, (the load alone varied|with any load)"
TAB = ("equilibrium_tab", "Recesses")


def test_the_tab_has_each_recess_and_powers_that_agree_with_the_page():
    at = visit(PAGE, bearing="hydrostatic", recesses="3", units="US")
    open_part(at, *TAB)
    open_part(at, "validity")
    assert not faults(at)
    computed = computed_from(session_of(at).values)
    found, said = computed.recesses_here, " ".join(texts(at))
    assert said.count("° | ") == 3
    for pressure in found.pressure:
        assert f"| {digits(float(US.pressure.of(pressure)))} |" in said
    assert f"Side flow: {amount(US.flow, found.flow)}" in said
    assert f"delivers **{amount(US.flow, found.flow)}**" in said
    assert f"Power loss: {amount(US.power, found.friction_power)}" in said
    assert float(found.flow) == pytest.approx(float(found.recess_flow.sum()))
    assert "At rest the journal floats" in said
    assert "through the grooves" not in said
    assert "through the restrictors holds the rise" in said


def test_a_bearing_without_recesses_has_no_such_tab():
    assert TAB not in tabs(visit(PAGE))
    # Nor after the bearing was changed with the tab open.
    at = visit(PAGE, bearing="hydrostatic")
    open_part(at, *TAB)
    session_of(at).set_value("bearing", "plain")
    at.run()
    assert not faults(at)
    assert TAB not in tabs(at)


def test_the_page_is_live_while_an_input_is_dragged():
    at = visit(PAGE, bearing="hydrostatic")
    open_part(at, *TAB)
    moved = session_of(at).preview.at("supply_pressure", "4")
    assert "at 4 MPa" in moved["texts"]["said_powers"]["words"]
    assert all(moved["charts"].values())


def test_at_rest_the_stiffness_is_that_of_a_still_shaft_whatever_the_oil():
    machines = [visit(PAGE, bearing="hydrostatic", T=T) for T in ("40", "80")]
    warm, hot = (computed_from(session_of(at).values).at_rest.stiffness for at in machines)
    assert warm == pytest.approx(hot, rel=1e-6, abs=1e-6 * hot[0, 0])
    assert abs(warm[0, 1]) < 1e-6 * warm[0, 0]


def test_a_centred_journal_is_held_by_the_supply_and_driven_at_half_speed():
    at = visit("pages/2_Coefficients.py", bearing="hydrostatic")
    open_part(at, "coefficients_tab", "Why only cross-coupling")
    said = " ".join(texts(at))
    assert "the whirl ratio is ½" in said
    assert "Nothing pushes it back" not in said
    centred = computed_from(session_of(at).values).centred
    half = centred.whirl_damping[0, 0]
    assert centred.stiffness[0, 1] == pytest.approx(half, rel=1e-3)
    assert centred.stiffness[0, 0] > 0.1 * half
    plain = visit("pages/2_Coefficients.py")
    open_part(plain, "coefficients_tab", "Why only cross-coupling")
    assert "Nothing pushes it back" in " ".join(texts(plain))


def test_curves_over_the_load_are_said_to_be_those_of_the_running_speed():
    for page, tab in (
        ("pages/2_Coefficients.py", ("coefficients_tab", "Against σ")),
        ("pages/3_Stability.py", ("stability_tab", "Figures of the notes")),
        (PAGE, ("equilibrium_tab", "Locus")),
    ):
        for bearing, one_speed in (("hydrostatic", True), ("plain", False)):
            at = visit(page, bearing=bearing)
            open_part(at, *tab)
            assert any(re.search(VARIED, one.value) for one in at.caption) == one_speed


def test_report_and_csv_have_every_recess():
    shown = computed_from(session_of(visit(PAGE, bearing="hydrostatic", recesses="6")).values)
    page = report.report(shown, [], SI, "link", Labels()).decode()
    text = html.unescape(page[: page.index("<script>")])
    for pressure in shown.recesses_here.pressure:
        assert f">{digits(float(SI.pressure.of(pressure)))}<" in text
    assert f">{amount(SI.power, shown.recesses_here.total_power)}<" in text
    lines = export.sweep_csv(shown, SI).decode("utf-8-sig").splitlines()
    head, *_, last = csv.reader(line for line in lines if not line.startswith(("#", '"#')))
    there = dict(zip(head, map(float, last), strict=True))
    found = shown.recesses
    assert there["Recess 6, 300°: pressure [MPa]"] == pytest.approx(1e-6 * found.pressure[-1, 5])
    flows = [value for name, value in there.items() if re.match(r"Recess .*: flow", name)]
    assert len(flows) == 6
    assert sum(flows) == pytest.approx(there["Side flow per bearing Q [l/min]"])
    assert there["Pump power per bearing [kW]"] == pytest.approx(1e-3 * found.pump_power[-1])


def test_a_bearing_without_recesses_has_none_in_its_files():
    shown = computed_from(session_of(visit(PAGE)).values)
    assert "Recess" not in export.sweep_csv(shown, SI).decode("utf-8-sig")
    assert "<h2>Recesses" not in report.report(shown, [], SI, "link", Labels()).decode()


@pytest.mark.parametrize("preset", PRESETS)
def test_every_preset_runs_on_recesses_at_the_usual_supply(preset):
    at = visit(HOME, preset=preset, bearing="hydrostatic")
    assert not faults(at)
    assert not at.error


@pytest.mark.parametrize("units", ["SI", "US"])
def test_too_heavy_a_load_says_which_supply_would_carry_it(units):
    at = visit(PAGE, bearing="hydrostatic", load="20000", units=units)
    [error] = [box.value for box in at.error]
    pressure = (SI if units == "SI" else US).pressure
    assert "_" not in error
    assert f"{pressure.name} or more carries it" in error
    # That it does.
    at = visit(PAGE, bearing="hydrostatic", load="20000", supply_pressure="8.58")
    assert not at.error
    assert math.isfinite(session_of(at).preview.computed.point.eccentricity_ratio)
    assert values_of(session_of(at).preview.computed.machine, 1.0, 1.0)["load"] == 20000.0


def test_a_journal_on_recesses_is_released_at_once_and_suction_in_its_motion_is_said():
    at = visit(ORBITS, bearing="hydrostatic", rpm="300")
    assert not faults(at)
    assert set(charts(at)) == {"chart_orbits_path", "chart_orbits_time"}
    assert "keeps the film full" not in " ".join(texts(at))
    for tab in ("Spectrum", "Onset three ways"):
        open_part(at, "orbits_tab", tab)
        assert not faults(at)
    open_part(at, "orbits_tab", "Limit cycles")
    assert any(button.key == "orbits_cycles" for button in at.button)
    at = visit(ORBITS, bearing="hydrostatic")
    assert re.search("pressure falls to −.* suction, .* keeps the film full", " ".join(texts(at)))


def test_a_run_up_that_ends_at_the_wall_says_at_which_speed(monkeypatch):
    """On recesses the whirl past the onset grows until the film is thinner than computed."""
    balanced = replace(MACHINE, rotor=replace(MACHINE.rotor, imbalance=0.0))
    onset = onset_speed(balanced).speed
    asked = run_up.AskRun(balanced, 0.9 * onset, 1.2 * onset, 320)
    monkeypatch.setattr(run_up, "_runs", lambda *request, tell: work.run_up(*request, tell))
    with pytest.raises(TransientError, match=r"^At \d+ rpm the journal came .* below this speed"):
        run_up._run(asked, SI, None)
    computed = computed_from(values_of(balanced, 1300.0, 1700.0))
    assert run_up._takes(computed, asked) > 3.0
    plain = computed_from(values_of(PRESETS["sheet-1e8"].machine, 600.0, 1200.0))
    assert run_up._takes(plain, asked) < 1.0


def test_recesses_have_no_grooves_through_which_a_flow_is_needed() -> None:
    for kind, labels in (("hydrostatic", set()), ("plain", {"Groove flow needed"})):
        at = visit("pages/9_Heat.py", bearing=kind)
        assert {one.label for one in at.metric if "Groove" in one.label} == labels
