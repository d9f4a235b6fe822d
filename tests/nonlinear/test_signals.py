"""Signals made up of known parts are taken apart again, and real motions as the theory says."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc import Transient, analyse, simulate
from rotorcalc.nonlinear.signals import free_modes, growth, poincare_points, spectrum, waterfall
from tests.machines import ROTORS, RPM, SHEET, C, balanced, near_hopf, with_rotor

SPEED = 600.0


def made(circles, *, revolutions=40, samples=32, growth=0.0):
    """Return a motion of circles {order: radius} about a place off the centre."""
    angle = np.linspace(0.0, 2.0 * math.pi * revolutions, revolutions * samples + 1)
    time = angle / SPEED
    signal = (0.3 + 0.2j) * C + np.exp(growth * time) * sum(
        radius * np.exp(1j * order * angle) for order, radius in circles.items()
    )
    path = np.stack([signal.real, signal.imag], axis=-1)
    return Transient(
        time=time, journal=path, disk=2.0 * path, disk_velocity=path,
        speed=np.full_like(angle, SPEED), angle=angle, _journal_velocity=lambda rows: path[rows],
    )  # fmt: skip


@given(
    order=st.floats(0.3, 0.7),
    whirl=st.floats(0.05, 0.8),
    synchronous=st.floats(0.05, 0.8),
)
def test_lines_between_the_points_of_a_spectrum_are_found(order, whirl, synchronous):
    found = spectrum(made({order: whirl * C, 1.0: synchronous * C}))
    assert found.whirl_ratio == pytest.approx(order, abs=1e-3)
    assert found.whirl == pytest.approx(whirl * C, rel=0.01)
    assert found.synchronous == pytest.approx(synchronous * C, rel=0.01)


def test_a_slow_whirl_is_found_where_it_is_looked_for():
    motion = made({0.17: 0.4 * C, 1.0: 0.1 * C})
    assert spectrum(motion, slowest=0.12).whirl_ratio == pytest.approx(0.17, abs=1e-3)
    assert math.isnan(spectrum(motion).whirl_ratio)


def test_a_backward_circle_stands_at_a_negative_order():
    found = spectrum(made({-1.0: 0.4 * C, 1.0: 0.1 * C}))
    assert found.order[np.argmax(found.amplitude)] == -1.0
    assert found.synchronous == pytest.approx(0.1 * C, rel=1e-6)
    assert math.isnan(found.whirl_ratio)
    assert found.whirl == 0.0


def test_the_last_revolutions_alone_and_the_disk_can_be_taken():
    whole, end = (spectrum(made({0.5: 1e-6}, growth=20.0), last=n) for n in (None, 8))
    assert end.whirl > 1.2 * whole.whirl
    assert spectrum(made({1.0: 1e-6}), of="disk").synchronous == pytest.approx(2e-6)


def test_poincare_points_of_a_synchronous_orbit_are_one_point_of_half_speed_whirl_two():
    assert np.ptp(poincare_points(made({1.0: C})), axis=0) == pytest.approx([0, 0], abs=1e-12)
    points = poincare_points(made({0.5: C}))
    assert points[0::2] == pytest.approx(np.tile(points[0], (21, 1)))
    assert np.hypot(*(points[1] - points[0])) == pytest.approx(2.0 * C)


@given(
    rate=st.floats(-60.0, 60.0),
    order=st.floats(0.3, 0.7),
    other=st.floats(0.9, 1.4),
)
def test_a_growth_rate_is_measured_beside_other_modes(rate, order, other):
    motion = made({order: 1e-3 * C, other: 1e-4 * C}, growth=rate, revolutions=12)
    value = growth(motion)
    assert value.real == pytest.approx(rate, abs=1e-3)
    assert value.imag == pytest.approx(order * SPEED, rel=1e-6)


@pytest.mark.parametrize("rpm", [5000, 11500])
@pytest.mark.parametrize("kind", ROTORS)
def test_the_early_transient_measures_the_eigenvalue(kind, rpm):
    machine, speed = balanced(ROTORS[kind]), rpm * RPM
    linear = analyse(machine, speed)
    start = linear.journal_position + np.array([1e-4 * C, 0.0])
    motion = simulate(machine, speed, revolutions=12, start=start)
    waves = linear.flexible_eigenvalues[linear.flexible_eigenvalues.imag > 0.0]
    expected = waves[np.argmax(waves.real)]
    assert growth(motion) == pytest.approx(complex(expected), rel=1e-5)
    # Without being told where the rest is, that is the mode that neither grows nor turns.
    assert np.abs(free_modes(motion)).min() < 1e-2


def test_a_settled_whirl_has_its_own_ratio_and_the_synchronous_line_beside_it():
    motion = simulate(SHEET, 11500 * RPM, revolutions=120, tolerance=1e-8)
    found = spectrum(motion, last=60)
    assert found.whirl_ratio == pytest.approx(0.5, abs=0.005)
    assert found.whirl > 20.0 * found.synchronous > 0.0


def test_a_run_up_shows_whirl_from_the_onset_on_and_the_imbalance_throughout():
    motion = simulate(
        with_rotor(imbalance=2e-6), 7500 * RPM, revolutions=400, samples_per_revolution=16,
        final_speed=11000 * RPM, tolerance=1e-7,
    )  # fmt: skip
    seen = waterfall(motion, spectra=40, width=24)
    assert seen.amplitude.shape == (40, len(seen.order))
    assert np.all(np.diff(seen.speed) > 0.0)
    whirl = seen.amplitude[:, np.argmin(np.abs(seen.order - 0.5))]
    assert np.all(whirl[seen.speed < 8800 * RPM] < 0.01 * C)
    assert np.all(whirl[seen.speed > 10000 * RPM] > 0.3 * C)
    synchronous = seen.amplitude[:, np.argmin(np.abs(seen.order - 1.0))]
    assert np.all(synchronous[seen.speed < 8800 * RPM] > 1e-3 * C)


def test_bad_requests_raise_a_valueerror():
    motion = made({1.0: C}, revolutions=3)
    with pytest.raises(ValueError, match="must be 4 or more"):
        spectrum(motion)
    with pytest.raises(ValueError, match="width = 99"):
        waterfall(made({1.0: C}), width=99)
    with pytest.raises(ValueError, match="of = 'shaft'"):
        poincare_points(motion, of="shaft")
    machine, speed, _ = near_hopf(0.3, 0.9)
    with pytest.raises(ValueError, match="two revolutions"):
        growth(simulate(machine, speed, revolutions=1))
