"""A bearing's own coefficients in the app: every page, links, files, undo, cases, and the ends."""

import csv
import math
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import rotorcalc as rc
from rotorcalc import PRESETS, CoefficientTable, Machine, Supply, analyse, read_coefficients, rpm
from rotorcalc.units import SI
from tests.app.session import HOME, OTHERS, charts, faults, session_of, texts, tours, visit
from ui import own
from ui.computed import computed_from
from ui.inputs import inputs_of, machine_of, values_of
from ui.results.table import RESULTS
from ui.sharing import address, export, machine_file, report
from ui.sharing.labels import Labels

SHEET = PRESETS["sheet-1e7"].machine
FIRST, LAST, SPEED = 200.0, 1500.0, 400.0


@cache
def table(rows=20, first=FIRST, last=LAST):
    sweep = analyse(SHEET, np.geomspace(first, last, rows))
    return CoefficientTable(speed=sweep.speed, stiffness=sweep.stiffness, damping=sweep.damping)


def machine(**changes):
    of_table = {name: changes.pop(name) for name in ("rows", "first", "last") if name in changes}
    # Values of few digits: a link has fourteen.
    rotor = replace(SHEET.rotor, mass=272.0, imbalance=12e-6, **changes)
    return replace(SHEET, bearing=table(**of_table), rotor=rotor)


def link(speed=SPEED, top=900.0, **changes):
    """Return the query parameters of the machine's link."""
    return address.write("sheet-1e8", values_of(machine(**changes), speed, top), "SI")


def said(at):
    return " ".join(texts(at))


@pytest.mark.parametrize("page", [HOME, *OTHERS])
def test_every_page_and_tab_shows_what_is_known_and_says_what_is_not(page, coarse_maps):
    at = visit(page, **link())
    for tab in tours(at):
        assert not faults(at), tab


@pytest.mark.parametrize(
    ("page", "words"),
    [
        ("pages/1_Equilibrium.py", "not where the journal rests"),
        ("pages/9_Heat.py", "no balance of heat"),
        ("pages/6_Orbits.py", "hold for small motions only"),
        ("pages/7_Bearings.py", "which own coefficients do not name"),
    ],
)
def test_a_page_that_needs_a_film_says_so_in_a_sentence(page, words):
    at = visit(page, **link())
    assert words in said(at)
    assert not at.error


def test_the_sidebar_says_what_the_bearing_is_and_leads_back():
    at = visit("pages/3_Stability.py", **link())
    assert "Own coefficients: 20 rows, 1909.86 to 14323.9 rpm" in said(at)
    assert "Oil and film temperature change nothing" in said(at)
    known = inputs_of(session_of(at).values)
    assert {"D", "L", "C", "T", "mu"}.isdisjoint(known)
    assert {"rpm", "load", "mass", "k"} <= set(known)
    [choice] = [one for one in at.selectbox if one.key == "bearing_kind"]
    assert choice.value == "own-coefficients"
    choice.select("plain").run()
    assert not faults(at)
    assert machine_of(session_of(at).values).bearing == PRESETS["sheet-1e8"].machine.bearing
    [undo] = [one for one in at.button if one.key == "undo"]
    undo.click().run()
    assert machine_of(session_of(at).values).bearing == table()


def test_the_entry_takes_a_table_says_what_gives_way_and_can_be_undone():
    at = visit("pages/3_Stability.py", rpm="30000", T_in="40", flow="5")
    session_of(at).set_bearing(table())
    at.run()
    assert not faults(at)
    assert "left out" in said(at)
    assert "The running speed was 30000 rpm" in said(at)
    values = session_of(at).values
    found = machine_of(values)
    assert found.bearing == table()
    assert found.supply is None
    assert found.temperature == 40.0
    assert FIRST <= values["rpm"] * math.pi / 30 <= LAST
    [undo] = [one for one in at.button if one.key == "undo"]
    undo.click().run()
    assert machine_of(session_of(at).values).supply == Supply(temperature=40.0, flow=5 / 6e4)


def test_the_speed_s_slider_and_the_charts_end_at_the_table_s_ends():
    at = visit(HOME, **link(top=3000.0))
    rpm = inputs_of(session_of(at).values)["rpm"]
    assert FIRST <= rpm.low * math.pi / 30 < FIRST * 1.00001
    assert LAST * 0.99999 < rpm.high * math.pi / 30 <= LAST
    sweep = computed_from(session_of(at).values).sweep
    assert (sweep.speed[0], sweep.speed[-1]) == (FIRST, LAST)


def test_a_speed_beyond_the_ends_is_said_in_words():
    at = visit(HOME, **link(speed=1700.0))
    assert not at.exception
    assert "own coefficients, which are given from" in said(at)
    assert "rpm" in at.error[0].value


def test_the_verdict_says_where_the_search_ended():
    at = visit(HOME, **link(first=200.0, last=420.0))
    assert "where its own coefficients end" in said(at)
    late = visit(HOME, **link(speed=900.0, first=700.0, last=1500.0))
    assert "where its own coefficients begin" in said(late)
    assert not faults(at)
    assert not faults(late)


def test_the_threshold_chart_says_no_more_than_the_verdict():
    at = visit("pages/3_Stability.py", **link(first=200.0, last=420.0))
    notes = [note["text"] for note in charts(at)["chart_threshold"]["layout"]["annotations"]]
    assert f"stable up to {420.0 / rpm:.0f} rpm" in notes


def test_link_and_file_give_the_machine_back_to_the_last_bit():
    at = visit(HOME, **link())
    assert machine_of(session_of(at).values) == machine()
    written = machine_file.write(machine(), session_of(at), Labels())
    assert Machine.from_json(written.decode()) == machine()
    loaded = machine_file.read(written.decode(), session_of(at))
    assert not loaded.problems
    assert machine_of(loaded.link.values) == machine()


def test_a_long_table_is_in_the_file_and_a_link_says_so():
    many = machine(rows=60)
    values = values_of(many, SPEED, 900.0)
    params = address.write("sheet-1e8", values, "SI")
    assert params["table"] == own.TOO_LONG
    at = visit(HOME, **params)
    assert not at.exception
    assert "more rows than a link carries" in said(at)
    assert "nothing is computed yet" in said(at)
    loaded = machine_file.read(
        machine_file.write(many, session_of(at), Labels()).decode(), session_of(at)
    )
    assert machine_of(loaded.link.values) == many


@pytest.mark.parametrize("broken", ["", "x", "äöü", "AAAA" * 30, own.TOO_LONG])
def test_a_broken_link_is_refused_in_words(broken):
    at = visit(HOME, **(link() | {"table": broken}))
    assert not at.exception
    assert session_of(at).refused
    without = link()
    del without["table"]
    at = visit(HOME, **without)
    assert "the table of stiffness and damping is missing" in said(at)


def test_a_case_with_own_coefficients_stands_beside_a_computed_bearing():
    at = visit("pages/2_Coefficients.py", **link())
    session_of(at).keep("Mine")
    session_of(at).set_kind("plain")
    for page in (HOME, *OTHERS[:5]):
        at.switch_page(page).run()
        assert not faults(at), page
    assert len(session_of(at).cases) == 1
    assert "Mine" in session_of(at).link()["cases"]


def test_coefficients_as_csv_are_the_table_s_rows_or_the_sweep():
    computed = computed_from(values_of(machine(), SPEED, 900.0))
    read = read_coefficients(export.coefficients_csv(computed).decode())
    assert tuple(read.speed) == table().speed
    assert np.array_equal(read.stiffness, table().stiffness)
    of_film = computed_from(values_of(SHEET, SPEED, 900.0))
    read = read_coefficients(export.coefficients_csv(of_film).decode())
    assert np.array_equal(read.damping, of_film.sweep.damping)
    assert b"BearingElement" in export.ross_file(computed)


def test_csv_and_report_have_what_is_known():
    computed = computed_from(values_of(machine(), SPEED, 900.0))
    rows = list(csv.reader(export.sweep_csv(computed, SI).decode("utf-8-sig").splitlines()))
    heads = next(row for row in rows if row[0].startswith("Running speed"))
    assert ["# Bearing", "Own coefficients"] in rows
    assert any(row[0] == "# Coefficients" and "20 rows" in row[1] for row in rows)
    last = dict(zip(heads, rows[-1], strict=True))
    assert last["Eccentricity ratio ε [-]"] == "nan"
    assert math.isfinite(float(last["Stiffness K_XX [MN/m]"]))
    page = report.report(computed, (), SI, "", Labels()).decode()
    assert "Own coefficients" in page
    body = page.split("</style>")[-1].split("<script")[0]
    assert not re.search(r">\s*(nan|none|inf)", body, re.IGNORECASE)
    assert "known by its own coefficients alone" in body
    # Neither an oil nor its film, of which nothing is known, stands among inputs and results.
    for words in ("Viscosity", "laminar", "Film temperature"):
        assert words not in body.split("Conventions")[0].split("Static equilibrium")[0]
    assert "of one viscosity" not in body


def test_what_was_not_found_up_to_the_last_row_is_no_absence():
    # The film's own rows end below the rigid shaft's onset.
    computed = computed_from(values_of(machine(last=700.0), 600.0, 700.0))
    assert math.isinf(computed.rigid_onset.speed)
    assert computed.rigid_onset.searched_to < math.inf
    assert RESULTS["rigid_onset"].shown(computed, SI) == "not found"
    [one] = rc.batch.results([rc.batch.Case(1, "", computed.machine, 600.0)])
    assert one.values["onset_searched_to [rad/s]"] == computed.onset.searched_to
