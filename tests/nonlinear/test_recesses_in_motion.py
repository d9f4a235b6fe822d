"""Motions of a journal on recesses: imbalance, whirl past the onset, and the film's suction."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import Hydrostatic, analyse, onset_speed, recess_equilibrium, simulate
from rotorcalc.nonlinear.collocation import Balance, Cycle
from rotorcalc.nonlinear.continuation import small_cycle
from rotorcalc.nonlinear.hopf import hopf
from rotorcalc.nonlinear.release import release
from rotorcalc.nonlinear.suction import lowest_pressure
from rotorcalc.nonlinear.transient import start_on_mode
from tests.films.test_hydrostatic import BEARING, MACHINE
from tests.machines import ROTORS, SHEET

C = BEARING.radial_clearance


def test_the_orbit_of_a_small_imbalance_is_that_of_the_linear_theory():
    machine = replace(MACHINE, rotor=replace(ROTORS["rigid"], imbalance=0.02 * C))
    expected = analyse(machine, 500.0).journal_response
    motion = simulate(machine, 500.0, revolutions=20, samples_per_revolution=16, tolerance=1e-6)
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


# A rigid rotor without imbalance, and its onset: of both restrictors.
FREE = {
    kind: replace(
        MACHINE,
        bearing=replace(BEARING, geometry=Hydrostatic(restrictor=kind)),
        rotor=replace(ROTORS["rigid"], imbalance=0.0),
    )
    for kind in ("capillary", "orifice")
}


def test_limit_cycles_begin_at_the_onset_as_the_normal_form_has_them():
    machine = FREE["orifice"]
    onset, balance = hopf(machine), Balance(machine)
    assert onset.subcritical
    sizes = (0.05, 0.1)
    below = []
    for size in sizes:
        cycle = small_cycle(balance, onset, size)
        below.append((onset.speed - cycle.speed) / size**2)
    expected = onset.lyapunov / onset.growth_slope
    # The next order is the square of the size.
    assert (4.0 * below[0] - below[1]) / 3.0 == pytest.approx(expected, rel=0.01)


def test_a_whirl_smaller_than_the_cycle_dies_and_a_larger_one_grows():
    """The motion in time knows nothing of harmonics: it crosses the cycle found by collocation."""
    machine = FREE["capillary"]
    onset = hopf(machine)
    cycle = small_cycle(Balance(machine), onset, 0.3)
    sizes = []
    for share in (0.8, 1.2):
        start = start_on_mode(machine, cycle.speed, 0.3 * share * C)
        motion = simulate(
            machine, cycle.speed, revolutions=60, samples_per_revolution=16, start=start,
            tolerance=1e-6,
        )  # fmt: skip
        away = np.hypot(*(motion.journal - analyse(machine, cycle.speed).journal_position).T)
        sizes.append(away[-320:].max() / away[320:640].max())
    assert sizes[0] < 0.99
    assert sizes[1] > 1.01


def test_the_derivative_by_speed_at_which_a_cycle_is_corrected_is_that_of_the_residual():
    machine = FREE["orifice"]
    balance, angle = Balance(machine), np.linspace(0.0, 2.0 * np.pi, 10)[:9]
    path = 0.3 * np.stack([np.cos(angle) + 0.5, np.sin(angle)], axis=-1)
    cycle, step = Cycle(path, 0.45, 2000.0), 1e-4
    _, jacobian = balance.residual(cycle)
    ahead, behind = (
        balance.residual(cycle._replace(speed=2000.0 * math.exp(sign * step)))[0]
        for sign in (1.0, -1.0)
    )
    expected = (ahead - behind) / (2.0 * step)
    assert jacobian[:, -1] == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())
