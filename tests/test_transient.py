"""Nonlinear orbits: the kernels are the film's force, small motions are the linear theory's."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc import analyse, orbit_ellipse
from rotorcalc.films import short, short_motion
from rotorcalc.transient import TransientError, simulate, start_on_mode
from tests.machines import ROTORS, RPM, SHEET, C, balanced, near_hopf


def last_amplitude(machine, speed, rest, *, kick, revolutions):
    """Return the largest distance from rest over the last ten revolutions, in clearances."""
    motion = simulate(
        machine, speed, revolutions=revolutions, samples_per_revolution=32,
        start=rest + np.array([kick * C, 0.0]),
    )  # fmt: skip
    return np.hypot(*(motion.journal - rest).T)[-320:].max() / C


@given(
    eps=st.floats(0.0, 0.97),
    angle=st.floats(0.0, 2.0 * math.pi),
    velocity=st.tuples(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0)),
)
def test_the_plain_force_is_the_film_force(eps, angle, velocity):
    position = (eps * math.cos(angle), eps * math.sin(angle))
    force = short_motion.force(*position, *velocity)
    expected = short.film_force(position, velocity)
    # The array's closed form loses κ⁻⁴ rounding errors where the film is slack.
    assert force == pytest.approx(expected, rel=1e-9, abs=1e-9 * (1.0 + np.hypot(*expected)))


@given(
    eps=st.floats(0.0, 0.995),
    angle=st.floats(0.0, 2.0 * math.pi),
    velocity=st.tuples(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0)),
)
def test_the_velocity_for_a_force_gives_that_force(eps, angle, velocity):
    position = (eps * math.cos(angle), eps * math.sin(angle))
    found = short_motion.velocity(*position, *short_motion.force(*position, *velocity))
    assert found == pytest.approx(velocity, abs=1e-10)


@pytest.mark.parametrize("kind", ROTORS)
def test_a_machine_without_imbalance_rests_in_its_equilibrium(kind):
    machine = balanced(ROTORS[kind])
    motion = simulate(machine, 6000 * RPM, revolutions=20)
    rest = analyse(machine, 6000 * RPM).journal_position
    assert np.abs(motion.journal - rest).max() < 1e-9 * C
    sag = np.array([machine.static_sag, 0.0])
    assert np.abs(motion.disk - rest - sag).max() < 1e-9 * C


@pytest.mark.parametrize("kind", ROTORS)
def test_a_small_imbalance_draws_the_linear_ellipse(kind):
    machine = balanced(ROTORS[kind], 0.001 * C)
    speed = 5000 * RPM
    motion = simulate(machine, speed, revolutions=200, samples_per_revolution=32)
    linear = analyse(machine, speed)
    for path, response in (
        (motion.journal, linear.journal_response),
        (motion.disk, linear.disk_response),
    ):
        turn = path[-33:-1]
        radius = np.hypot(*(turn - turn.mean(axis=0)).T)
        ellipse = orbit_ellipse(response[0], response[1])
        assert radius.max() == pytest.approx(float(ellipse.semi_major), rel=0.01)


@pytest.mark.parametrize("rpm", [5000, 11500])
@pytest.mark.parametrize("kind", ROTORS)
def test_a_small_whirl_grows_and_turns_as_its_eigenvalue_says(kind, rpm):
    machine = balanced(ROTORS[kind])
    speed = rpm * RPM
    start = start_on_mode(machine, speed, 1e-5 * C)
    motion = simulate(machine, speed, revolutions=12, start=start)
    values = analyse(machine, speed).flexible_eigenvalues
    expected = max((value for value in values if value.imag > 0.0), key=lambda value: value.real)
    x, y = (motion.disk - start_rest(machine, speed)).T
    signal = x + 1j * y
    # One complex exponential by its forward part: least squares on log amplitude and phase.
    growth = np.polyfit(motion.time, np.log(np.abs(signal)), 1)[0]
    turning = np.polyfit(motion.time, np.unwrap(np.angle(signal)), 1)[0]
    assert growth == pytest.approx(expected.real, abs=0.01 * abs(expected))
    assert turning == pytest.approx(expected.imag, rel=0.01)


def start_rest(machine, speed):
    return analyse(machine, speed).journal_position + np.array([machine.static_sag, 0.0])


def test_above_a_supercritical_onset_kicks_small_and_large_end_on_one_cycle():
    machine, speed, rest = near_hopf(0.30, 1.01)
    small = last_amplitude(machine, speed, rest, kick=0.01, revolutions=900)
    large = last_amplitude(machine, speed, rest, kick=0.30, revolutions=900)
    assert small == pytest.approx(0.156, abs=0.002)
    assert large == pytest.approx(0.156, abs=0.002)


def test_below_a_subcritical_onset_a_small_kick_dies_and_a_large_one_does_not():
    machine, speed, rest = near_hopf(0.06, 0.99)
    assert last_amplitude(machine, speed, rest, kick=0.01, revolutions=800) < 0.001
    large = last_amplitude(machine, speed, rest, kick=0.25, revolutions=1200)
    assert large == pytest.approx(0.865, abs=0.002)


def test_massless_journals_are_the_limit_of_light_ones():
    speed, rotor = 5000 * RPM, replace(SHEET.rotor, imbalance=0.1 * C)
    massless = simulate(replace(SHEET, rotor=rotor), speed, revolutions=20)
    light = simulate(replace(SHEET, rotor=replace(rotor, journal_mass=0.01)), speed, revolutions=20)
    assert np.abs(light.journal - massless.journal).max() < 2e-3 * C


def test_samples_are_evenly_spaced_in_the_angle_of_rotation():
    motion = simulate(SHEET, 5000 * RPM, revolutions=3, samples_per_revolution=10)
    assert motion.time.shape == (31,)
    assert motion.time[-1] == pytest.approx(3 * 60 / 5000, rel=1e-12)
    up = simulate(SHEET, 3000 * RPM, revolutions=50, final_speed=4000 * RPM)
    assert up.speed[-1] == pytest.approx(4000 * RPM, rel=1e-12)
    assert np.gradient(up.speed, up.time)[1:-1] == pytest.approx(
        (up.speed[-1] - up.speed[0]) / up.time[-1], rel=1e-3
    )


def test_progress_is_told_and_what_it_raises_ends_the_work():
    told = []
    simulate(SHEET, 5000 * RPM, revolutions=60, progress=told.append)
    assert told[-1] == 1.0
    assert told == sorted(told)

    def stop(share):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        simulate(SHEET, 5000 * RPM, revolutions=60, progress=stop)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"revolutions": 0}, "revolutions = 0"),
        ({"revolutions": 1.5}, "revolutions = 1.5"),
        ({"revolutions": True}, "revolutions = True"),
        ({"revolutions": 10**6}, "at most 5000"),
        ({"samples_per_revolution": 0}, "samples_per_revolution = 0"),
        ({"speed": 0.0}, "speed"),
        ({"speed": math.nan}, "speed"),
        ({"start": (C, 0.0)}, "less than the radial clearance"),
        ({"start": (math.nan, 0.0)}, "finite"),
        ({"start": (0.0, 0.0, 0.0)}, "shape"),
    ],
)
def test_a_bad_request_is_refused_in_words(changes, words):
    asked = {"speed": 5000 * RPM, "revolutions": 5} | changes
    with pytest.raises(ValueError, match=words):
        simulate(SHEET, asked.pop("speed"), **asked)


def test_a_motion_that_cannot_go_on_is_told_with_time_place_and_what_was_computed(monkeypatch):
    calls = itertools.count()

    def fails_once(x, y, f_x, f_y, *near):
        if next(calls) == 200:
            raise ArithmeticError("no velocity found")
        return short_motion.velocity(x, y, f_x, f_y, *near)

    monkeypatch.setattr("rotorcalc.motion.film_motion", lambda _: (short_motion.force, fails_once))
    with pytest.raises(TransientError, match=r"found after .* s, with the journal at") as failure:
        simulate(SHEET, 5000 * RPM, revolutions=40)
    assert len(failure.value.partial.time) >= 1
