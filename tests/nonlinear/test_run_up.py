"""A run-up and a run-down: where whirl appears and disappears, and the linear theory's delay."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorcalc import analyse, bifurcation, modes, onset_speed, simulate
from rotorcalc.nonlinear import run_up as module
from rotorcalc.nonlinear.limit_cycles import start_on_cycle
from rotorcalc.nonlinear.measured_onset import growth_curve
from rotorcalc.nonlinear.release import affordable_revolutions
from rotorcalc.nonlinear.run_up import Passage, RunUp, delay, run_up
from rotorcalc.nonlinear.signals import Waterfall
from tests.machines import ROTORS, RPM, SHEET, C, balanced, near_hopf

SUBCRITICAL, *_ = near_hopf(0.06, 1.0)
SUPERCRITICAL, *_ = near_hopf(0.3, 1.0)


def _run(machine, low, high, revolutions):
    onset = onset_speed(machine).speed
    return run_up(machine, low * onset, high * onset, revolutions=revolutions)


@pytest.fixture(scope="module")
def slow():
    return _run(SUBCRITICAL, 0.92, 1.05, 2500)


@pytest.fixture(scope="module")
def branch():
    return bifurcation(SUBCRITICAL, lowest=0.8, highest=1.03)


def test_rising_slowly_whirl_appears_at_the_onset_and_later_the_faster():
    """Past the onset it needs time to grow: n = ∫ Re λ dΩ / Ω̇, so the delay is as √Ω̇."""
    onset = onset_speed(SUBCRITICAL).speed
    late = []
    for revolutions in (1000, 4000):
        found = _run(SUBCRITICAL, 0.99, 1.08, revolutions)
        late.append(found.whirls_from / onset - 1.0)
        shows = delay(SUBCRITICAL, onset, found.acceleration, factor=100.0).speed
        # Of one push; where more than one adds up, whirl shows a little earlier.
        assert 0.7 < late[-1] / (shows / onset - 1.0) < 1.05
    assert late[0] == pytest.approx(2.0 * late[1], rel=0.2)
    assert 0.0 < late[1] < 0.02


def test_falling_whirl_of_a_subcritical_onset_lasts_to_the_fold(slow, branch):
    (fold,) = branch.folds
    onset = branch.hopf.speed
    assert fold < 0.985 * onset < onset < slow.whirls_from
    # Below the fold it dies, as late as whirl grows above the onset.
    assert 0.97 * fold < slow.whirls_down_to < 1.003 * fold
    # Between fold and onset: rest as the speed rises, the stable cycle as it falls.
    between = np.linspace(fold + 0.2 * (onset - fold), onset, 10)
    falling = np.interp(between, slow.down.speed[::-1], slow.down.amplitude[::-1])
    stable = branch.stable
    cycle = np.interp(between, branch.speed[stable], branch.zero_to_peak[stable])
    assert_allclose(falling, cycle, rtol=0.02)
    rising = np.interp(between, slow.up.speed, slow.up.amplitude)
    assert rising.max() < 0.01 * C < 0.4 * C < falling.min()


def test_zero_to_peak_is_half_the_range_of_a_motion_on_the_cycle(branch):
    place = int(np.flatnonzero(branch.stable)[5])
    speed, start = float(branch.speed[place]), start_on_cycle(SUBCRITICAL, branch, place)
    motion = simulate(SUBCRITICAL, speed, revolutions=8, start=start)
    range_ = np.ptp(motion.journal, axis=0).max()
    assert branch.zero_to_peak[place] == pytest.approx(0.5 * range_, rel=2e-3)


def test_whirl_of_a_supercritical_onset_ends_where_it_began():
    onset = onset_speed(SUPERCRITICAL).speed
    found = _run(SUPERCRITICAL, 0.94, 1.06, 2000)
    assert onset < found.whirls_from < 1.03 * onset
    # Falling it dies towards the onset, above which alone it lives.
    assert 0.985 * onset < found.whirls_down_to < 1.02 * onset
    below = found.down.speed < 0.96 * onset
    assert found.down.amplitude[below].max() < 0.01 * C


def test_spectra_stand_at_the_speeds_of_the_motion_beside_the_linear_theorys_whirl(slow):
    for passage, way in ((slow.up, 1.0), (slow.down, -1.0)):
        assert np.all(way * np.diff(passage.speed) > 0.0)
        assert np.all(way * np.diff(passage.seen.speed) > 0.0)
        assert passage.seen.amplitude.shape == (300, len(passage.seen.order))
    i = 150
    whirl = complex(modes.leading(analyse(SUBCRITICAL, slow.up.seen.speed[i]).flexible_eigenvalues))
    assert slow.up.whirl_order[i] == pytest.approx(whirl.imag / slow.up.seen.speed[i])
    # The whirl's line is the whirl's order: of a spectrum at the end of the run-up.
    order = slow.up.seen.order[np.argmax(slow.up.seen.amplitude[-1])]
    assert order == pytest.approx(0.5, abs=0.03)


@pytest.mark.parametrize("rotor", ROTORS.values(), ids=ROTORS.keys())
def test_pushes_disturb_any_rotor_by_about_a_thousandth_of_the_clearance(rotor):
    machine = balanced(rotor)
    speed = 0.6 * onset_speed(machine).speed
    still, pushed = (
        simulate(machine, speed, revolutions=100, pushes=v, tolerance=1e-7)
        for v in (0.0, module.PUSHES * C * speed)
    )
    noise = np.hypot(*(pushed.journal - still.journal[0]).T)
    assert 1e-4 * C < noise.max() < 1e-2 * C
    assert np.hypot(*(still.journal - still.journal[0]).T).max() < 1e-5 * C


def test_progress_goes_on_through_both_ways_and_bad_requests_are_refused():
    told = []
    run_up(balanced(SHEET.rotor), 600.0, 700.0, revolutions=64, progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0
    for speeds in ((0.0, 700.0), (700.0, 600.0), (600.0, math.inf), (math.nan, 700.0)):
        with pytest.raises(ValueError, match="must be positive, finite, and rise"):
            run_up(SHEET, *speeds, revolutions=64)
    with pytest.raises(ValueError, match="revolutions = 63: must be 64 or more"):
        run_up(SHEET, 600.0, 700.0, revolutions=63)
    with pytest.raises(ValueError, match=r"pushes = -1\.0 m/s: must be zero or more"):
        simulate(SHEET, 600.0, revolutions=1, pushes=-1.0)


def test_near_the_onset_the_delay_is_that_of_a_growth_rate_that_rises_evenly():
    machine = balanced(SHEET.rotor)
    onset = onset_speed(machine).speed
    beside = onset * (1.0 + 1e-5 * np.array([-1.0, 1.0]))
    rates = modes.leading(analyse(machine, beside).flexible_eigenvalues).real
    slope = float(np.diff(rates)[0] / np.diff(beside)[0])
    for acceleration in (0.1, 1.0):
        found = delay(machine, onset, acceleration, factor=100.0)
        expected = math.sqrt(2.0 * math.log(100.0) * acceleration / slope)
        assert found.speed - onset == pytest.approx(expected, rel=0.03)
        assert found.rate == pytest.approx(0.01 * slope * onset, rel=0.03)
    assert math.isnan(delay(machine, onset, 1e6, factor=100.0).speed)
    for wrong in ({"onset": math.inf}, {"acceleration": 0.0}, {"factor": 1.0}):
        with pytest.raises(ValueError, match=f"{next(iter(wrong))} = .*: must be above"):
            delay(machine, **{"onset": onset, "acceleration": 1.0, "factor": 9.0} | wrong)


def test_growth_measured_lies_on_the_curve_of_the_eigenvalues():
    found = growth_curve(balanced(ROTORS["rigid"]), 11000 * RPM)
    on_curve = np.interp(found.measured_speed, found.speed, found.rate)
    assert found.measured == pytest.approx(on_curve, abs=1e-3 * np.abs(on_curve).max())
    assert math.isnan(found.running_speed)


def test_a_release_is_followed_for_800_swings_of_the_fastest_mode_and_16_revolutions_at_least():
    for speed in (10.0, 100.0, 600.0):
        point = analyse(SHEET, speed)
        swings = np.abs(point.flexible_eigenvalues.imag).max() / speed
        most = affordable_revolutions(point)
        assert most == 16 or most * max(swings, 1.0) == pytest.approx(800, rel=0.04)
    assert affordable_revolutions(analyse(SHEET, 1.0)) == 16


def test_a_whirl_far_below_half_speed_is_seen_where_the_linear_theory_has_it():
    """On a floating ring the first whirl is at 0.17 of the speed."""
    order, speed = np.linspace(0.0, 1.5, 97), np.array([900.0, 1000.0])
    line = np.exp(-(((order - 0.17) / 0.01) ** 2))
    seen = Waterfall(speed=speed, order=order, amplitude=C * np.outer([0.01, 0.5], line))
    passage = Passage(speed, np.zeros(2), seen, np.array([0.18, 0.17]))
    whirls = RunUp(passage, passage, 1.0, C).whirls_from
    assert whirls == 1000.0
    # Without such a mode it may be a slow change of the mean position.
    other = Passage(speed, np.zeros(2), seen, np.array([0.5, 1.3]))
    assert math.isnan(RunUp(other, other, 1.0, C).whirls_from)
