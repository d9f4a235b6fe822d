"""One judge of stability: ranges and verdicts against exact counts of unstable roots."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from rotorcalc import analyse, onset_speed
from rotorcalc.coefficients import modified_sommerfeld
from rotorcalc.onset.judge import is_unstable, unstable_ranges
from rotorcalc.unbalance_curves import response_family
from rotorcalc.unbalance_curves import unstable_ranges as ranges_of_sweep
from rotorcalc.variation import varied
from tests.machines import RPM, SHEET, with_rotor
from tests.onset.reference import drawn, unstable_roots

wide = settings(max_examples=40, suppress_health_check=[HealthCheck.too_slow])
seeds = st.integers(0, 10**6)


@wide
@given(seeds, st.floats(-2, 3), st.booleans())
def test_the_stability_verdict_agrees_with_sixty_digits(seed, power, flexible):
    machine = drawn(seed)
    speeds = np.array([1.0, 1.5]) * 10.0**power / float(modified_sommerfeld(machine, 1.0))
    expected = [unstable_roots(machine, speed, flexible=flexible) > 0 for speed in speeds]
    assert is_unstable(machine, speeds, flexible=flexible).tolist() == expected
    assert bool(is_unstable(machine, speeds[0], flexible=flexible)) == expected[0]


@wide
@given(seeds)
@example(114539)  # one end sure in floats, the other not
@example(424)  # the sign at one end is that of a rounding error
def test_the_first_range_begins_at_the_onset(seed):
    machine = drawn(seed)
    known = onset_speed(machine)
    onset = known.speed
    top = 2.5 * onset if 0.0 < onset < math.inf else 1e3
    speeds = np.linspace(top / 240, top, 240)
    ranges = unstable_ranges(machine, speeds)
    assert np.array_equal(unstable_ranges(machine, speeds, onset=known), ranges)
    if math.isinf(onset):
        assert ranges.shape == (0, 2)
    else:
        assert ranges[0, 0] == pytest.approx(max(onset, top / 240), rel=1e-9)


@wide
@given(seeds)
def test_ranges_separate_stable_from_unstable_speeds(seed):
    machine = drawn(seed, damped=True)
    onset = onset_speed(machine).speed
    top = 20 * onset if 0.0 < onset < math.inf else 1e3
    ranges = unstable_ranges(machine, np.linspace(top / 50, top, 50))
    for edge, beyond in [(e, s) for row in ranges for e, s in zip(row, (-1, 1), strict=True)]:
        if top / 50 < edge < top:
            assert unstable_roots(machine, edge * (1 + beyond * 1e-7)) == 0
            assert unstable_roots(machine, edge * (1 - beyond * 1e-7)) > 0


def test_a_machine_with_journal_mass_is_not_called_stable():
    machine = varied(
        with_rotor(shaft_stiffness=1e7),
        {"shaft_stiffness": 1e6, "radial_clearance": 20e-6, "journal_mass": 0.1, "length": 0.075},
    )
    speeds = np.linspace(50, 12000, 240) * RPM
    ranges = ranges_of_sweep(analyse(machine, speeds))
    assert ranges == pytest.approx(np.array([[onset_speed(machine).speed, 12000 * RPM]]))


def test_a_range_between_two_speeds_of_the_sweep_is_found():
    """Damping that all but quenches the whirl leaves it a range of its own."""
    machine, ranges = _narrow()
    first, last = ranges[0]
    coarse = np.array([0.5 * first, 0.99 * first, 1.01 * last, 1.5 * last])
    assert not np.any(is_unstable(machine, coarse))
    assert unstable_ranges(machine, coarse)[0] == pytest.approx(ranges[0], rel=1e-9)


def _narrow():
    """Return a machine whose first range is narrower than a hundredth, and its ranges."""
    low, high = 1e3, 1e5
    for _ in range(60):
        damping = math.sqrt(low * high)
        machine = with_rotor(shaft_stiffness=1e7, disk_damping=damping)
        ranges = unstable_ranges(machine, np.linspace(100, 40000, 400) * RPM)
        width = ranges[0, 1] / ranges[0, 0] - 1 if len(ranges) else 0.0
        if 1e-4 < width < 1e-2:
            return machine, ranges
        low, high = (damping, high) if width > 1e-2 else (low, damping)
    raise AssertionError("no narrow range")


def test_a_family_is_judged_as_its_machines_are():
    rotors = [
        replace(SHEET.rotor, disk_damping=c, journal_mass=m) for c in (0, 5e3) for m in (0, 9)
    ]
    family = response_family(SHEET, np.linspace(500, 20000, 40) * RPM, rotors=rotors)
    for rotor, unstable in zip(rotors, family.unstable, strict=True):
        onset = onset_speed(replace(SHEET, rotor=rotor)).speed
        assert np.array_equal(unstable, family.speed > onset)


@pytest.mark.parametrize("speed", [3.0, [], [[1.0, 2.0]], [2.0, 1.0], [1.0, 1.0]])
def test_speeds_that_do_not_rise_are_refused(speed):
    with pytest.raises(ValueError, match=r"rising speeds|greater than the speed before it"):
        unstable_ranges(SHEET, speed)
