"""The criteria together: values by other ways, verdicts, and words where none is due."""

from dataclasses import fields, replace

import numpy as np
import pytest
from scipy.constants import mil

from rotorcalc import (
    PRESETS,
    CoefficientTable,
    amplification,
    analyse,
    criteria,
    level_one,
    onset_speed,
    rpm,
)
from rotorcalc.units import Units
from tests.criteria.bores import GEOMETRIES, on
from tests.films.models import Sprung
from tests.machines import SHEET, with_rotor

TOP = 6000 * rpm
SOFT = with_rotor(shaft_stiffness=1e7)
VIBRATION, CLEARANCE = "Vibration at the bearings", "Scaled response"


def named(rows, name):
    """Return the criterion whose name begins with a word."""
    (found,) = [row for row in rows if row.name.startswith(name)]
    return found


def sizes(machine, speeds):
    """Return the journal's semi-major axis at speeds from points of its orbit."""
    turns = np.exp(1j * np.linspace(0.0, np.pi, 721))
    journal = analyse(machine, speeds).journal_response[..., None] * turns
    return np.hypot(journal[..., 0, :].real, journal[..., 1, :].real).max(axis=-1)


def test_the_vibration_limit():
    # inspection-for-industry.com: √(12000/N) mil, at most 1 mil.
    speed = np.array([3000.0, 12000.0, 18000.0, 48000.0]) * rpm
    expected = [1.0, 1.0, (12 / 18) ** 0.5, 0.5]
    assert criteria.vibration_limit(speed) / mil == pytest.approx(expected)


@pytest.mark.parametrize("preset", PRESETS.values(), ids=PRESETS)
def test_every_criterion_has_value_limit_unit_source_and_verdict(preset):
    rows = criteria.checks(preset.machine, preset.speed, cross_coupling=1e6)
    kinds = {field.name for field in fields(Units)} - {"name"}
    for row in rows:
        assert row.source
        assert row.kind in kinds
        if row.unjudged:
            assert row.passed is None
            assert row.unjudged.endswith(".")
        else:
            above = row.value > row.limit
            assert row.passed == (not above if row.at_most else above or row.value == row.limit)


def test_margins_and_stability_are_those_of_their_own_functions():
    Q_A, low = 1.2e6, 3200 * rpm
    rows = criteria.checks(SOFT, 4000 * rpm, minimum_speed=low, cross_coupling=Q_A)
    found = amplification(SOFT, minimum_speed=low, maximum_speed=4000 * rpm)
    margin = named(rows, "Separation")
    assert margin.value == found.separation_margin[0]
    assert margin.limit == found.required_margin[0]
    assert margin.speed == found.critical_speed[0]
    assert margin.passed
    assert margin.remark == f"Amplification factor {found.amplification_factor[0]:.3g}."
    stability = level_one(SOFT, 4000 * rpm, Q_A)
    assert named(rows, "Log").value == stability.forward_decrement
    assert named(rows, "Log").limit == 0.1
    assert named(rows, "Q_0/Q_A").value == stability.zero_decrement / Q_A
    assert named(rows, "Q_0/Q_A").passed is False
    easier = criteria.checks(SOFT, 4000 * rpm, cross_coupling=0.5 * Q_A)
    assert named(easier, "Q_0/Q_A").passed


@pytest.mark.parametrize("machine", [SHEET, SOFT], ids=["stiff", "soft"])
def test_vibration_and_clearance_by_points_of_the_orbits(machine):
    low, top = 3600 * rpm, 4000 * rpm
    rows = criteria.checks(machine, top, minimum_speed=low)
    vibration, clearance = named(rows, VIBRATION), named(rows, CLEARANCE)
    p_p = 2.0 * sizes(machine, np.linspace(low, top, 301)).max()
    assert vibration.value == pytest.approx(p_p, rel=1e-4)
    assert vibration.limit == mil
    everywhere = 2.0 * sizes(machine, np.linspace(0.02 * top, top, 4001)).max()
    scaled = min(mil / p_p, 6.0) * everywhere
    assert clearance.value == pytest.approx(scaled / (2.0 * 60e-6), rel=1e-4)
    assert clearance.limit == 0.75


def test_the_clearance_check_does_not_depend_on_the_imbalance_given():
    rows = [
        named(criteria.checks(with_rotor(SOFT, imbalance=u), 4000 * rpm), CLEARANCE).value
        for u in (24e-6, 36e-6, 48e-6)
    ]
    assert rows == pytest.approx([rows[0]] * 3, rel=1e-9)
    # The factor ends at 6: a well balanced rotor gains room.
    fine = named(criteria.checks(with_rotor(SOFT, imbalance=1e-6), 4000 * rpm), CLEARANCE)
    assert fine.value < 0.9 * rows[0]
    assert fine.remark == "The response is scaled by 6."


def test_the_imbalance_of_a_grade_meets_it():
    rotor = SHEET.rotor
    for grade in criteria.GRADES:
        u = float(criteria.imbalance_of_grade(grade, rotor=rotor, speed=TOP))
        fits = criteria.checks(with_rotor(imbalance=u), TOP, grade=grade)[-1]
        over = criteria.checks(with_rotor(imbalance=1.01 * u), TOP, grade=grade)[-1]
        assert (fits.passed, over.passed) == (True, False)
        assert grade in fits.source


def test_what_cannot_be_judged_says_why():
    still = criteria.checks(with_rotor(imbalance=0.0), TOP)
    assert named(still, VIBRATION).unjudged == "The rotor has no imbalance."
    assert named(still, "Distance").passed
    assert named(still, "Q_0/Q_A").unjudged == "No anticipated cross-coupling was given."
    assert named(still, "Log").name == (
        "Log decrement of the first forward mode without cross-coupling"
    )
    flat = criteria.checks(PRESETS["friswell-5-5-1"].machine, 1500 * rpm)
    assert named(flat, "Separation").unjudged.startswith("The response has no peak")
    fast = criteria.checks(SHEET, 1.05 * onset_speed(SHEET).speed)
    assert named(fast, CLEARANCE).unjudged.startswith("The machine is unstable")
    assert named(fast, "Log").passed is False


def test_a_backward_mode_that_is_damped_less_is_said():
    # At 6000 rpm the sheet's backward mode is damped less than its forward ones.
    found = level_one(SHEET, TOP, 0.0)
    row = named(criteria.checks(SHEET, TOP), "Log")
    assert row.value == found.forward_decrement > found.backward_decrement
    assert row.remark == f"A backward mode is damped less: δ = {found.backward_decrement:.3g}."
    along = level_one(SHEET, TOP, 2e7)
    assert along.forward_decrement < along.backward_decrement
    assert not named(criteria.checks(SHEET, TOP, cross_coupling=2e7), "Log").remark
    soft = named(criteria.checks(SOFT, 4000 * rpm), "Log")
    assert soft.passed
    assert soft.remark.endswith(", below 0.1.")


def test_a_machine_that_a_backward_mode_makes_unstable_never_passes():
    # The sheet's own film, its cross terms of the other sign: it drives against the shaft.
    onset = onset_speed(SOFT).speed
    film = analyse(SOFT, np.array([1.0, 1.05, 1.1]) * onset)
    sign = np.array([[1.0, -1.0], [-1.0, 1.0]])
    table = CoefficientTable(
        speed=film.speed, stiffness=sign * film.stiffness, damping=sign * film.damping
    )
    row = named(criteria.checks(replace(SOFT, bearing=table), 1.05 * onset), "Log")
    assert row.value < 0.0
    assert row.passed is False
    assert "a backward mode grows" in row.remark


def test_of_two_modes_that_grow_the_faster_one_is_the_value():
    # A film that drives every motion: without Q both modes grow, and Q feeds the forward one.
    I = np.eye(2)  # noqa: E741 - the unit matrix
    table = CoefficientTable(
        speed=np.array([100.0, 1000.0]), stiffness=[1e8 * I] * 2, damping=[-1e4 * I] * 2
    )
    machine = replace(SOFT, bearing=table)
    found = level_one(machine, 500.0, 1e4)
    assert found.forward_decrement < found.backward_decrement < 0.0
    row = named(criteria.checks(machine, 500.0, cross_coupling=1e4), "Log")
    assert row.value == found.forward_decrement
    assert "backward" not in row.remark


@pytest.mark.parametrize("geometry", GEOMETRIES.values(), ids=GEOMETRIES)
def test_other_bores_are_judged_too(geometry):
    rows = criteria.checks(on(geometry, SOFT.rotor), 2000 * rpm, cross_coupling=1e5)
    assert {row.passed for row in rows} <= {True, False}
    assert len(rows) >= 6


def test_speeds_at_which_the_film_has_no_answer_are_left_out():
    # At so low a speed this film's journal touches the wall.
    machine = on(Sprung(), SOFT.rotor)
    with pytest.raises(ValueError, match="touches"):
        analyse(machine, 1.0)
    found = amplification(machine, maximum_speed=TOP)
    assert found.critical_speed.size
    assert np.all(np.isfinite(found.half_power_speed))
    assert len(criteria.checks(machine, TOP)) >= 6


def test_a_cross_coupling_of_zero_is_no_missing_one():
    rows = criteria.checks(SHEET, TOP, cross_coupling=0.0)
    assert named(rows, "Q_0").unjudged == "The anticipated cross-coupling is zero."
    assert named(criteria.checks(SHEET, TOP), "Q_0").unjudged.startswith("No anticipated")


def test_arguments_are_refused_in_words():
    with pytest.raises(ValueError, match=r"cross_coupling = -1\.0 N/m: must be zero or more"):
        criteria.checks(SHEET, TOP, cross_coupling=-1.0)
    with pytest.raises(ValueError, match=r"minimum_speed = 700 rad/s: must be at most"):
        criteria.checks(SHEET, TOP, minimum_speed=700.0)
    heavy = replace(SHEET, load=0.0)
    assert len(criteria.checks(heavy, TOP)) >= 6
