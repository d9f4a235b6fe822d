"""The page Criteria: numbers equal to the core's, its inputs kept, the button that sets u."""

import math
import re

import numpy as np
import pytest

from rotorcalc import modes
from rotorcalc.criteria import anticipated_cross_coupling, checks, imbalance_of_grade
from rotorcalc.units import SI, US, rpm
from tests.app.session import charts, faults, open_part, session_of, tours, visit
from ui import criteria
from ui.bearing import kinds
from ui.bores import NAMES
from ui.computed import computed_from
from ui.criteria import Asked
from ui.format import amount, digits, minus
from ui.results.stability import least_damped
from ui.words import criteria as words

PAGE, HOME = "pages/10_Criteria.py", "app.py"
STAGES = {"coupling": "stages", "stages": "1000_400_20_1.5_c~500_300_25_1_a"}
Q_A = float(
    anticipated_cross_coupling(1e6, speed=6000 * rpm, diameter=0.4, width=0.02, density_ratio=1.5)
    + anticipated_cross_coupling(5e5, speed=6000 * rpm, diameter=0.3, width=0.025, factor=1.5)
)


def table(at):
    """Return the texts of each row of the page's table."""
    found = [one.proto.body for one in at.get("html") if "<table class=criteria" in one.proto.body]
    rows = re.findall(r"<tr>(<th scope=row>.*?)</tr>", "".join(found))
    cells = (re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in rows)
    return [[re.sub("<small>.*</small>|<[^>]+>", "", cell) for cell in row] for row in cells]


def verdict(at):
    (found,) = [one.value for one in at.markdown if "-badge[" in one.value and ": " in one.value
                and re.match(r":(red|green|orange)-badge\[[✓✗?]", one.value)]  # fmt: skip
    return found


@pytest.mark.parametrize("units", [SI, US], ids=["SI", "US"])
def test_the_table_has_the_cores_numbers(units):
    at = visit(PAGE, preset="sheet-1e7", slowest="3000", units=units.name, **STAGES)
    machine = session_of(at).preview.computed.machine
    found = checks(machine, session_of(at).preview.computed.speed, minimum_speed=3000 * rpm,
                   cross_coupling=criteria_Q_A(at))  # fmt: skip
    rows = table(at)
    assert len(rows) == len(found)
    for row, one in zip(rows, found, strict=True):
        unit = getattr(units, one.kind)
        number = minus(digits(one.value)) if unit.name == "-" else amount(unit, one.value)
        assert row[1] == (number if math.isfinite(one.value) else "–")
        assert row[3] == {True: "✓ met", False: "✗ not met", None: "? unknown"}[one.passed]
        assert row[4] == one.source
    failed = sum(one.passed is False for one in found)
    assert f"Not met: {failed} of {len(found)}" in verdict(at)
    assert not faults(at)


def criteria_Q_A(at):
    asked = criteria.asked_of(at.session_state["rotorcalc_choices"].kept())
    return asked.cross_coupling(session_of(at).preview.computed)


def test_the_cross_coupling_is_the_sum_of_the_stages():
    at = visit(PAGE, **STAGES)
    assert criteria_Q_A(at) == pytest.approx(Q_A)
    assert any(f"**{amount(SI.stiffness, Q_A)}** of 2 stages" in one.value for one in at.caption)
    at.button(key="criteria_remove_1").click().run()
    assert at.query_params["stages"] == "1000_400_20_1.5_c"
    at.button(key="criteria_add").click().run()
    at.text_input(key="criteria_power_1_SI").set_value("0").run()
    assert any("diameter and width and density ratio missing" in one.value for one in at.warning)
    for name, word in (("diameter", "300"), ("width", "25"), ("ratio", "1")):
        at.text_input(key=f"criteria_{name}_1_SI").set_value(word).run()
    assert not at.warning
    assert criteria_Q_A(at) == pytest.approx(3.0 * 1e6 / (6000 * rpm) / (0.4 * 0.02) * 1.5)


@pytest.mark.parametrize("grade", ["4W/N", "G 2.5"])
def test_the_button_sets_what_the_grade_permits_and_undo_takes_it_back(grade):
    at = visit(PAGE, grade=grade)
    visitor = session_of(at)
    before, machine = dict(visitor.values), visitor.preview.computed.machine
    at.button(key="criteria_set").click().run()
    allowed = float(imbalance_of_grade(grade, rotor=machine.rotor, speed=6000 * rpm))
    kept = visitor.preview.computed.machine.rotor.imbalance
    assert allowed * (1 - 1e-5) < kept <= allowed
    assert table(at)[-1][3] == "✓ met"
    # A link with six digits opens the same machine, which meets its grade there too.
    other = visit(PAGE, **at.query_params)
    assert table(other)[-1] == table(at)[-1]
    at.button(key="undo").click().run()
    assert visitor.values == before
    assert table(at)[-1][3] == "✗ not met"


def test_a_grade_that_no_slider_reaches_is_refused_in_words():
    at = visit(PAGE, grade="G 40", rpm="100")
    before = dict(session_of(at).values)
    at.button(key="criteria_set").click().run()
    assert session_of(at).values == before
    assert any("lies outside 0 to 1000 µm; it was left" in one.value for one in at.warning)


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ({"slowest": "7000"}, "must be at most the maximum speed, 6000 rpm"),
        ({"fastest": "abc"}, "`'abc'` is not a number"),
        ({"fastest": "1e9"}, "lies outside 1 to 400000 rpm"),
        ({"coupling": "given", "qa": "-1"}, "lies outside 0 to"),
        ({"coupling": "stages", "stages": "1_2_0_1_c"}, "Width H [mm] = `'0'` lies outside"),
        ({"grade": "G 7"}, "is not among this page's choices"),
    ],
)  # fmt: skip
def test_what_cannot_be_used_is_named_with_its_bound_and_kept(query, said):
    at = visit(PAGE, **query)
    assert any(said in one.value for one in at.warning)
    assert not at.exception
    if "grade" not in query:
        assert {key: at.query_params[key] for key in query} == query
        assert not table(at)


# Nothing resonates, nothing oscillates much, no cross-coupling destabilises it, it is unstable.
EXTREMES = (
    {"k": "inf"}, {"cs": "200000"}, {"rpm": "10000"}, {"load": "0"}, {"u": "0"},
    {"coupling": "given", "qa": "0"}, {"rpm": "100"}, {"k": "inf", "cs": "1e7", "u": "0"},
)  # fmt: skip


@pytest.mark.parametrize("query", EXTREMES, ids=str)
def test_extremes_are_said_in_words(query):
    at = visit(PAGE, **query)
    assert verdict(at)
    for tab in tours(at):
        assert not faults(at), tab
        assert not at.warning, tab
    if query == {"coupling": "given", "qa": "0"}:
        open_part(at, "criteria_tab", "Table")
        assert table(at)[2][3] == "? unknown"


@pytest.mark.parametrize("kind", NAMES)
def test_every_bearing_has_its_criteria(kind):
    # Without the table of a film of finite length, where a bore can be short.
    film = {"film": "short"} if "short" in kinds()[kind].models else {}
    at = visit(PAGE, bearing=kind, coupling="given", qa="1", **film)
    assert len(table(at)) >= 6
    for tab in tours(at):
        assert not faults(at), tab


def test_a_machine_whose_film_has_no_answer_says_so():
    at = visit(PAGE, T_in="40", load="0")
    assert "no oil leaves" in at.error[0].value
    assert not at.exception


def test_an_analysis_that_refuses_is_named(monkeypatch):
    def refuse(*_, **__):
        raise ValueError("cross_coupling: no mode was found at 628.318531 rad/s")

    for name in ("checks", "level_one", "amplification", "campbell"):
        monkeypatch.setattr(criteria, name, refuse)
    for cache in (criteria._checks, criteria._level, criteria._amplification, criteria._campbell):
        cache.cache_clear()
    at = visit(PAGE)
    assert (
        verdict(at) == ":orange-badge[? Not judged] cross_coupling: no mode was found at 6000 rpm."
    )
    assert not table(at)
    for tab in tours(at):
        assert not at.exception, tab
        assert len(at.warning) == (tab != "Table"), tab


def test_charts_have_the_cores_numbers():
    at = visit(PAGE, tab="Level one", coupling="given", qa="1", preset="sheet-1e7")
    data = {one["name"]: one for one in charts(at)["chart_level_one"]["data"]}
    row = next(one for one in criteria.judged(session_of(at).preview.computed, Asked(given=1e6))
               if one.name.startswith("Log"))  # fmt: skip
    mark = next(one for name, one in data.items() if "at Q" in name and one["mode"] == "markers")
    assert value(mark["x"]) == pytest.approx(1.0)
    assert value(mark["y"]) == pytest.approx(row.value)
    open_part(at, "criteria_tab", "Critical speeds")
    data = {one["name"]: one for one in charts(at)["chart_critical_speeds"]["data"]}
    found = criteria.critical(session_of(at).preview.computed, Asked()).found
    peak = next(one for name, one in data.items() if "critical" in name)
    assert value(peak["x"]) == pytest.approx(float(SI.speed.of(found.critical_speed[0])))
    line = next(one for one in data.values() if one["name"] == "disk")
    assert array(line["y"]).max() == pytest.approx(value(peak["y"]), rel=1e-4)


def array(given):
    import base64

    if isinstance(given, dict):
        return np.frombuffer(base64.b64decode(given["bdata"]), given["dtype"])
    return np.asarray(given, dtype=float)


def value(given):
    return float(array(given)[0])


def test_a_balanced_rotor_has_its_response_over_its_imbalance():
    link = {"preset": "sheet-1e7"}
    given, none = (computed_from(session_of(visit(HOME, **link, **u)).values)
                   for u in ({}, {"u": "0"}))  # fmt: skip
    over = criteria.critical(none, Asked())
    shown = criteria.critical(given, Asked())
    u = given.machine.rotor.imbalance
    assert over.is_balanced
    assert over.found.amplitude * u == pytest.approx(shown.found.amplitude)
    assert over.here * u == pytest.approx(shown.here)


def test_words_of_stages_are_read_as_written_whatever_is_typed():
    for text in ("", "~", "1_2", "a_b_c_d_e_f", "1_2_3_4_a~", "~" * 50, "_" * 50):
        stages = criteria.words_of_stages(text)
        assert 1 <= len(stages) <= criteria.MOST_STAGES
        assert all(len(stage) == 5 and stage[-1] in criteria.KINDS for stage in stages)
        assert criteria.words_of_stages(criteria.text_of_stages(stages)) == stages


def test_the_verdict_counts_what_is_met():
    rows = [words.Row("A", "1", "at most 2", state, "S", "") for state in ("good", "good")]
    assert words.sentence(rows) == "All 2 criteria are met."
    rows.append(words.Row("Q_0/Q_A", "–", "at least 2", "unknown", "S", ""))
    assert words.sentence(rows) == "Met: 2 of 3. Unknown: Q₀/Qₐ."
    rows.append(words.Row("Margin", "1 %", "at least 2 %", "failed", "S", ""))
    assert words.sentence(rows).startswith("Not met: 1 of 4: margin, 1 %, must be at least 2 %.")


def test_the_cards_are_of_the_least_damped_mode_that_the_criteria_name():
    # At 6000 rpm a backward mode loses the smallest share in a period, and another decays slowest.
    computed = computed_from(session_of(visit(HOME)).values)
    zeta = float(modes.damping_ratio(least_damped(computed)))
    swings = computed.point.flexible_eigenvalues
    assert zeta == pytest.approx(modes.damping_ratio(swings[swings.imag > 0.0]).min())
    found = criteria.stability(computed, Asked()).here
    decrement = 2.0 * math.pi * zeta / math.sqrt(1.0 - zeta**2)
    assert decrement == pytest.approx(found.backward_decrement)
    assert found.forward_decrement > found.backward_decrement
