"""Motions of a journal on recesses: imbalance, whirl past the onset, and the film's suction."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import analyse, onset_speed, recess_equilibrium, simulate
from rotorcalc.nonlinear.release import release
from rotorcalc.nonlinear.suction import lowest_pressure
from tests.films.test_hydrostatic import BEARING, MACHINE
from tests.machines import ROTORS, SHEET

C = BEARING.radial_clearance


def test_the_orbit_of_a_small_imbalance_is_that_of_the_linear_theory():
    machine = replace(MACHINE, rotor=replace(ROTORS["rigid"], imbalance=0.02 * C))
    expected = analyse(machine, 500.0).journal_response
    motion = simulate(machine, 500.0, revolutions=30, samples_per_revolution=16, tolerance=1e-7)
    late = slice(-16, None)
    phase = np.exp(-1j * motion.angle[late])
    found = 2.0 * np.mean(motion.journal[late] * phase[:, None], axis=0)
    assert np.abs(found - expected).max() < 1e-3 * np.abs(expected).max()


def test_past_its_onset_the_journal_whirls_until_its_film_is_thinner_than_computed():
    machine = replace(MACHINE, rotor=replace(MACHINE.rotor, imbalance=0.0))
    speed = 1.1 * onset_speed(machine).speed
    found = release(machine, speed, kick=0.1 * C, revolutions=120, tolerance=1e-6)
    assert found.spectrum.whirl_ratio == pytest.approx(found.whirl.imag / speed, abs=0.05)
    assert "closer to the wall than 0.03 of the clearance" in found.stopped
    assert found.film.min() > 0.03 * C


def test_at_rest_the_lowest_pressure_is_that_of_equilibrium_and_a_motion_may_have_less():
    fast = replace(MACHINE, load=4000.0, rotor=replace(ROTORS["rigid"], imbalance=0.0))
    rest = float(recess_equilibrium(fast, 1500.0).lowest_pressure)
    still = lowest_pressure(fast, simulate(fast, 1500.0, revolutions=1, tolerance=1e-6))
    assert still == pytest.approx(rest, rel=1e-3)
    place = analyse(fast, 1500.0).journal_position + np.array([0.3 * C, 0.0])
    moved = simulate(fast, 1500.0, revolutions=1, start=place, tolerance=1e-6)
    assert lowest_pressure(fast, moved) < min(still, -1e3)


def test_a_film_that_cavitates_keeps_no_pressure_below_ambient():
    assert math.isnan(lowest_pressure(SHEET, simulate(SHEET, 500.0, revolutions=1)))
