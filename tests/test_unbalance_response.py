"""Imbalance response against independently assembled equations of motion and sampled orbits."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from rotorcalc import PRESETS, analyse, orbit_ellipse, unstable_ranges
from rotorcalc.coefficients import equilibrium
from rotorcalc.unbalance_response import (
    orbit_points,
    phase_lag,
    synchronous_response,
)
from tests.machines import BENDING, EPS, RPM, SHEET, machines, with_rotor

phasors = st.complex_numbers(max_magnitude=1e3, allow_nan=False, allow_subnormal=False).map(
    lambda z: z if abs(z) > 1e-100 else 0j
)


def response(machine, speed):
    state = equilibrium(machine, speed)
    return synchronous_response(machine.rotor, state.stiffness, state.damping, speed)


def motion(phasor, turn):
    """Return Re{P e^{jΩt}} at Ωt = turn."""
    return np.real(np.asarray(phasor)[..., None] * np.exp(1j * turn))


# Ellipses

TURN = np.linspace(0, 2 * np.pi, 4001)
# A largest distance among points at most half a step from it is too small by its square's half.
SAMPLING = 0.5 * (TURN[1] / 2) ** 2 * 1.01


@given(phasors, phasors)
@example(1.0, 0.0)
@example(0.0, 1j)
@example(0.0, 0.0)
def test_axes_are_the_largest_and_smallest_distance_of_the_orbit(x, y):
    orbit = orbit_ellipse(x, y)
    distance = np.hypot(motion(x, TURN), motion(y, TURN))
    size = orbit.semi_major + 1e-300
    assert distance.max() <= size * (1 + 8 * EPS)
    assert distance.max() >= orbit.semi_major * (1 - SAMPLING) - 8 * EPS * size
    assert distance.min() >= abs(orbit.semi_minor) - 8 * EPS * size
    # Near the smallest the distance is √(b² + (a sin)²).
    assert distance.min() <= math.hypot(orbit.semi_minor, size * TURN[1] / 2) * (1 + 8 * EPS)


@given(phasors, phasors)
def test_inclination_points_along_the_major_axis(x, y):
    """Along it the orbit reaches its semi-major axis, across it the semi-minor one."""
    orbit = orbit_ellipse(x, y)
    cos, sin = math.cos(orbit.inclination), math.sin(orbit.inclination)
    along, across = abs(x * cos + y * sin), abs(-x * sin + y * cos)
    size = orbit.semi_major + 1e-300
    assert along == pytest.approx(orbit.semi_major, abs=32 * EPS * size)
    # Its angle is off by EPS/√b where the backward circle is small, and across² is what is exact.
    assert across == pytest.approx(abs(orbit.semi_minor), abs=64 * EPS * size)


@given(phasors, phasors)
def test_the_sign_of_the_minor_axis_is_the_sense_of_whirl(x, y):
    """∮ x dy encloses π a b, positive where the orbit turns from X to Y."""
    orbit = orbit_ellipse(x, y)
    area = math.pi * (x * np.conj(y)).imag
    assert math.pi * orbit.semi_major * orbit.semi_minor == pytest.approx(
        area, abs=64 * EPS * orbit.semi_major**2
    )
    X, Y = motion(x, TURN), motion(y, TURN)
    sampled = np.sum(X[:-1] * np.diff(Y) - Y[:-1] * np.diff(X)) / 2
    # A polygon inside an ellipse: less by (2π/n)²/6.
    assert sampled == pytest.approx(area, rel=TURN[1] ** 2 / 5, abs=1e-10 * orbit.semi_major**2)


@given(phasors, phasors)
def test_forward_and_backward_circles_add_up_to_the_orbit(x, y):
    orbit = orbit_ellipse(x, y)
    turning = orbit.forward * np.exp(1j * TURN) + orbit.backward * np.exp(-1j * TURN)
    error = 32 * EPS * (abs(x) + abs(y))
    assert np.abs(turning.real - motion(x, TURN)).max() <= error
    assert np.abs(turning.imag - motion(y, TURN)).max() <= error


def test_a_forward_circle_is_cos_and_sin():
    orbit = orbit_ellipse(2.0, -2.0j)  # x = 2 cos Ωt, y = 2 sin Ωt
    assert (orbit.semi_major, orbit.semi_minor) == (2.0, 2.0)
    assert (orbit.forward, orbit.backward) == (2.0, 0.0)


def test_a_backward_circle_is_sin_and_cos():
    """As the source's imbalance (sin, cos) turns, Eq. 5.1."""
    orbit = orbit_ellipse(-2.0j, 2.0)
    assert (orbit.semi_major, orbit.semi_minor) == (2.0, -2.0)
    assert orbit.forward == 0.0


@pytest.mark.parametrize("angle", np.linspace(-1.5, 1.5, 7))
def test_a_straight_line_has_its_own_angle(angle):
    orbit = orbit_ellipse(3 * np.exp(0.7j) * math.cos(angle), 3 * np.exp(0.7j) * math.sin(angle))
    assert orbit.semi_major == pytest.approx(3, rel=8 * EPS)
    assert orbit.semi_minor == pytest.approx(0, abs=8 * EPS)
    assert math.tan(orbit.inclination) == pytest.approx(math.tan(angle), rel=200 * EPS)


def test_ellipses_and_points_broadcast():
    orbit = orbit_ellipse(np.ones((4, 1)), -1j * np.ones(3))
    for name in ("semi_major", "semi_minor", "inclination", "forward", "backward"):
        assert getattr(orbit, name).shape == (4, 3)
    assert orbit_points(np.ones((4, 1)), -1j * np.ones(3), points=9).shape == (4, 3, 9, 2)


@given(phasors, phasors)
def test_points_draw_the_orbit(x, y):
    drawn, turn = orbit_points(x, y, points=37), np.linspace(0, 2 * np.pi, 37)
    error = 16 * EPS * (abs(x) + abs(y))
    assert drawn[:, 0] == pytest.approx(motion(x, turn), abs=error)
    assert drawn[:, 1] == pytest.approx(motion(y, turn), abs=error)


# Synchronous response


def assembled(machine, speed):
    """Return (disk, journal) from the 4×4 system of the sheet's equations of motion.

    m_d Ẍ + C_s Ẋ + K_rot(X − x) = m_d u Ω² (cos, sin) and M_j ẍ + Cẋ + Kx + K_rot(x − X) = 0.
    """
    rotor, state, identity = machine.rotor, equilibrium(machine, speed), np.eye(2)
    k = rotor.shaft_stiffness
    disk = (k - rotor.disk_mass * speed**2 + 1j * speed * rotor.disk_damping) * identity
    journal = (k - rotor.journal_mass * speed**2) * identity
    journal = journal + state.stiffness + 1j * speed * state.damping
    A = np.block([[disk, -k * identity], [-k * identity, journal]])
    force = rotor.disk_mass * rotor.imbalance * speed**2
    solution = np.linalg.solve(A, [force, -1j * force, 0, 0])
    return solution[:2], solution[2:], np.linalg.cond(A / np.abs(A).max())


@settings(max_examples=60)
@given(machines(stiffness=BENDING, damped=True, journals=True), st.floats(0.05, 3))
def test_response_obeys_the_equations_of_motion(machine, share):
    speed = share * 6000 * RPM
    disk, journal = response(machine, speed)
    expected_disk, expected_journal, condition = assembled(machine, speed)
    error = 64 * EPS * condition * np.abs(expected_disk).max()
    assert disk == pytest.approx(expected_disk, abs=error)
    assert journal == pytest.approx(expected_journal, abs=error)


@settings(max_examples=60)
@given(machines(stiffness=BENDING, damped=True, journals=True), st.floats(0.05, 3))
def test_response_leaves_no_force_unbalanced(machine, share):
    """Put into disk and journal one by one, so that no inverse enters."""
    speed = share * 6000 * RPM
    rotor, state = machine.rotor, equilibrium(machine, speed)
    disk, journal = response(machine, speed)
    shaft = rotor.shaft_stiffness * (disk - journal)
    inertia = (1j * speed * rotor.disk_damping - rotor.disk_mass * speed**2) * disk
    load = rotor.disk_mass * rotor.imbalance * speed**2 * np.array([1, -1j])
    film = (state.stiffness + 1j * speed * state.damping) @ journal
    own = -rotor.journal_mass * speed**2 * journal
    # The shaft's force is a small difference where it is stiff.
    rounding = 64 * EPS * rotor.shaft_stiffness * np.abs(disk).max()
    size = max(np.abs(force).max() for force in (shaft, inertia, load, film, own))
    assert np.abs(inertia + shaft - load).max() <= rounding + 1e-11 * size
    assert np.abs(own + film - shaft).max() <= rounding + 1e-11 * size


@pytest.mark.parametrize("speed", [600 * RPM, 6000 * RPM, 12000 * RPM])
def test_a_rigid_shaft_is_the_limit_of_stiff_ones(speed):
    rigid, at_journal = response(with_rotor(shaft_stiffness=math.inf, journal_mass=10.0), speed)
    assert np.array_equal(rigid, at_journal)
    size = np.abs(rigid).max()
    for stiffness in (1e11, 1e13, 1e15):
        disk, journal = response(with_rotor(shaft_stiffness=stiffness, journal_mass=10.0), speed)
        # The film's impedance and the disk's, 1e9 N/m at the most, over K_rot.
        assert np.abs(disk - rigid).max() <= 1e9 / stiffness * size
        # A flexible journal's own mass does not carry the imbalance, and a rigid one's does not.
        assert np.abs(journal - rigid).max() <= 1e9 / stiffness * size


def test_disk_at_its_undamped_resonance_has_a_finite_response():
    """At ω² = K_rot/m the shaft holds the disk as a rigid body would: only the film damps it."""
    speed = math.sqrt(SHEET.rotor.shaft_stiffness / SHEET.rotor.disk_mass)
    disk, journal = response(SHEET, speed)
    expected_disk, expected_journal, condition = assembled(SHEET, speed)
    assert disk == pytest.approx(expected_disk, rel=64 * EPS * condition)
    # There the shaft's force is the imbalance's: K_rot x = −m u Ω², whatever the film.
    u = SHEET.rotor.imbalance
    assert journal == pytest.approx(-u * np.array([1, -1j]), rel=1e-12)
    assert expected_journal == pytest.approx(journal, rel=64 * EPS * condition)


def test_response_is_proportional_to_the_imbalance():
    double = with_rotor(imbalance=2 * SHEET.rotor.imbalance)
    for one, two in zip(response(SHEET, 500.0), response(double, 500.0), strict=True):
        assert np.array_equal(2 * one, two)
    assert np.all(np.array(response(with_rotor(imbalance=0.0), 500.0)) == 0)


def test_response_broadcasts():
    speeds = np.linspace(100.0, 1000.0, 6).reshape(2, 3)
    disk, journal = response(SHEET, speeds)
    assert disk.shape == journal.shape == (2, 3, 2)
    assert disk[1, 2] == pytest.approx(response(SHEET, 1000.0)[0], rel=1e-12)


def test_imbalance_drives_a_free_disk_forward_and_opposite():
    """A shaft next to nothing: far above its resonance the disk turns about its mass centre."""
    disk, _ = response(with_rotor(shaft_stiffness=1.0), 6000 * RPM)
    orbit = orbit_ellipse(*disk)
    assert orbit.semi_minor == pytest.approx(SHEET.rotor.imbalance, rel=1e-6)
    assert disk == pytest.approx(-SHEET.rotor.imbalance * np.array([1, -1j]), rel=1e-6)


@pytest.mark.parametrize("name", PRESETS)
def test_far_above_resonance_the_disk_is_opposite_to_its_imbalance(name):
    preset = PRESETS[name]
    speeds = np.geomspace(0.1, 1000, 4000) * preset.speed
    lag = phase_lag(analyse(preset.machine, speeds).disk_response)
    assert lag[-1] == pytest.approx([math.pi, math.pi], abs=0.05)
    assert np.abs(np.diff(lag, axis=0)).max() < math.pi / 2


@pytest.mark.parametrize("stiffness", [2e5, 1e6, 3e6])
def test_on_a_soft_shaft_the_disk_lags_from_zero_to_half_a_turn(stiffness):
    """The film, stiff beside the shaft, turns the response by K_rot over its own stiffness."""
    machine = with_rotor(shaft_stiffness=stiffness)
    resonance = math.sqrt(stiffness / machine.rotor.disk_mass)
    speeds = resonance * np.geomspace(0.01, 10.0, 4000)
    lag = phase_lag(analyse(machine, speeds).disk_response)
    film = 0.5 * SHEET.static_load / SHEET.bearing.radial_clearance  # any k_ij is more
    assert lag[0] == pytest.approx([0, 0], abs=stiffness / film)
    assert lag[-1] == pytest.approx([math.pi, math.pi], abs=stiffness / film)
    assert np.abs(np.diff(lag, axis=0)).max() < math.pi / 2


def test_phase_lag_is_the_delay_of_the_orbit():
    lag = np.array([[0.3, 0.3], [0.4, 0.4]])
    late = np.exp(-1j * lag) * np.array([1, -1j])
    assert phase_lag(late) == pytest.approx(lag, rel=8 * EPS)


@given(machines(stiffness=BENDING), st.floats(0.2, 3))
@settings(max_examples=40)
def test_load_direction_sets_the_axes_and_not_the_size(machine, share):
    """Zero load: a centred film is the same in all directions, and so is its orbit a circle."""
    unloaded = replace(machine, load=0.0)
    disk, journal = response(unloaded, share * 6000 * RPM)
    for orbit in (orbit_ellipse(*disk), orbit_ellipse(*journal)):
        assume(orbit.semi_major > 1e-12)
        assert orbit.semi_minor == pytest.approx(orbit.semi_major, rel=1e-9)


def test_unstable_ranges_are_of_a_sweep_or_of_a_machine_with_speeds():
    speeds = np.linspace(10.0, 1256.0, 60)
    machine = PRESETS["sheet-1e7"].machine
    assert_array_equal(unstable_ranges(machine, speeds), unstable_ranges(analyse(machine, speeds)))
    with pytest.raises(ValueError, match="speed = None: a machine needs rising speeds"):
        unstable_ranges(machine)
    with pytest.raises(ValueError, match="speed: a sweep has its own"):
        unstable_ranges(analyse(machine, speeds), speeds)
