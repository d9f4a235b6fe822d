"""Nonlinear orbits: the kernels are the film's force, small motions are the linear theory's."""

import itertools
import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import root

from rotorcalc import PRESETS, analyse, orbit_ellipse
from rotorcalc.films import FilmMotion, short
from rotorcalc.films.short import ShortFilm, motion
from rotorcalc.nonlinear.equations import Equations
from rotorcalc.nonlinear.transient import (
    TOLERANCE,
    Start,
    TransientError,
    last_state,
    simulate,
    start_on_mode,
)
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
    force = motion.force(*position, *velocity)
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
    found = motion.velocity(*position, *motion.force(*position, *velocity))
    assert found == pytest.approx(velocity, abs=1e-10)


@given(
    eps=st.floats(0.0, 0.995),
    angle=st.floats(0.0, 2.0 * math.pi),
    velocity=st.tuples(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0)),
    begins=st.floats(0.01, math.pi - 0.01),
)
def test_the_velocity_found_does_not_depend_on_the_starting_point(eps, angle, velocity, begins):
    position = (eps * math.cos(angle), eps * math.sin(angle))
    found = motion.velocity(*position, *motion.force(*position, *velocity), [begins])
    assert found == pytest.approx(velocity, abs=1e-10)


def test_a_search_starts_from_the_last_solution_and_needs_one_step(monkeypatch):
    looks, near, impedance = [], [], motion._impedance
    force = motion.force(0.3, -0.6, 0.1, 0.4)
    monkeypatch.setattr(motion, "_impedance", lambda *at: looks.append(at) or impedance(*at))
    counts = []
    for _ in range(3):
        looks.clear()
        found = motion.velocity(0.3, -0.6, *force, near)
        assert found == pytest.approx((0.1, 0.4), abs=1e-14)
        counts.append(len(looks))
    assert counts[0] > 2
    assert counts[1:] == [1, 1]


@pytest.mark.parametrize("force", [(math.nan, 1.0), (0.0, math.inf), (math.inf, math.nan)])
def test_no_velocity_is_found_for_a_force_of_nan_and_the_last_solution_is_kept(force):
    near = [1.0]
    with pytest.raises(ArithmeticError, match="no velocity found"):
        motion.velocity(0.3, -0.6, *force, near)
    assert near == [1.0]


@pytest.mark.parametrize("t", [-5.2, -0.6, 0.0, 1.7, 3.2, 5.6, 5.7])
def test_the_impedance_comes_with_its_own_slopes(t):
    h = 1e-4  # from t = 5 on by the series
    before, here, after = (motion._impedance(t + step) for step in (-h, 0.0, h))
    assert 2.0 * here[1] == pytest.approx((after[0] - before[0]) / (2.0 * h), rel=1e-6)
    assert here[2] == pytest.approx((after[1] - before[1]) / h, rel=1e-6)


@pytest.mark.parametrize("rpm", range(3000, 9000, 500))
def test_a_massless_journal_stays_at_rest_to_rounding_at_any_speed(rpm):
    motion = simulate(balanced(SHEET.rotor), rpm * RPM, revolutions=20)
    rest = analyse(SHEET, rpm * RPM).journal_position
    assert np.abs(motion.journal - rest).max() < 1e-13 * C


@pytest.mark.parametrize("kind", ROTORS)
def test_a_machine_without_imbalance_rests_in_its_equilibrium(kind):
    machine = balanced(ROTORS[kind])
    motion = simulate(machine, 6000 * RPM, revolutions=20)
    rest = analyse(machine, 6000 * RPM).journal_position
    error = 20 * TOLERANCE * C  # as much in each revolution as the integrator may err in a step
    assert np.abs(motion.journal - rest).max() < error
    sag = np.array([machine.static_sag, 0.0])
    assert np.abs(motion.disk - rest - sag).max() < error


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


def test_below_a_subcritical_onset_a_small_kick_decays_and_a_large_one_does_not():
    machine, speed, rest = near_hopf(0.06, 0.99)
    assert last_amplitude(machine, speed, rest, kick=0.01, revolutions=800) < 0.001
    large = last_amplitude(machine, speed, rest, kick=0.25, revolutions=1200)
    assert large == pytest.approx(0.865, abs=0.002)


def test_massless_journals_are_the_limit_of_light_ones():
    speed, rotor = 5000 * RPM, replace(SHEET.rotor, imbalance=0.1 * C)
    massless = simulate(replace(SHEET, rotor=rotor), speed, revolutions=20)
    gaps = []
    for mass in (0.4, 0.1):
        light = replace(SHEET, rotor=replace(rotor, journal_mass=mass))
        motion = simulate(light, speed, revolutions=20)
        gaps.append(np.abs(motion.journal - massless.journal)[640:].max() / C)
    assert gaps[1] < 2e-3
    assert gaps[0] / gaps[1] == pytest.approx(4.0, rel=0.1)  # in proportion to the mass


# A motion that visits much of the clearance, and for which another integrator is told its rates.
FAR = np.array([0.5, -0.3]) * C


def rates_of_a_rigid_rotor(machine, speed):
    """Return the rates of Eq. 5.1 in SI on the array's closed form, apart from the package's."""
    b, M = machine.bearing, machine.rotor.half_mass
    unit = machine.viscosity * speed * b.radius * b.length**3 / C**2

    def rates(t, state):
        film = unit * short.film_force(state[:2] / C, state[2:] / (C * speed))
        turning = np.array([math.cos(speed * t), math.sin(speed * t)])
        load = np.array([machine.static_load, 0.0])
        return [*state[2:], *((film + load) / M + machine.rotor.imbalance * speed**2 * turning)]

    return rates


def rates_with_massless_journals(machine, speed):
    """Return the rates of disk and journal; the velocity from a general root finder."""
    b, rotor = machine.bearing, machine.rotor
    unit = machine.viscosity * speed * b.radius * b.length**3 / C**2

    def rates(t, state):
        disk, velocity, journal = state[:2], state[2:4], state[4:]
        shaft = rotor.shaft_stiffness * (disk - journal)
        found = root(
            lambda v: unit * short.film_force(journal / C, v) + shaft, [0.0, 0.0], tol=1e-13
        )
        turning = np.array([math.cos(speed * t), math.sin(speed * t)])
        force = rotor.half_mass * rotor.imbalance * speed**2 * turning - shaft
        force[0] += machine.static_load
        return [*velocity, *(force / rotor.half_mass), *(found.x * C * speed)]

    return rates


@pytest.mark.parametrize(
    ("kind", "rates", "revolutions"),
    [
        ("rigid", rates_of_a_rigid_rotor, 8),
        ("massless journals", rates_with_massless_journals, 2),
    ],
)
def test_two_integrators_agree(kind, rates, revolutions):
    machine, speed = balanced(ROTORS[kind], 0.1 * C), 5000 * RPM
    motion = simulate(machine, speed, revolutions=revolutions, start=FAR)
    state = [*motion.disk[0], 0.0, 0.0] + ([*FAR] if kind != "rigid" else [])
    other = solve_ivp(
        rates(machine, speed), (0.0, motion.time[-1]), state, method="DOP853",
        t_eval=motion.time, rtol=1e-9, atol=1e-14,
    )  # fmt: skip
    place = slice(0, 2) if kind == "rigid" else slice(4, 6)
    assert np.abs(other.y[place].T - motion.journal).max() < 1e-6 * C


@pytest.mark.parametrize("kind", ["rigid", "massless journals", "journal mass"])
def test_the_error_falls_with_the_tolerance_and_is_below_a_millionth_by_default(kind):
    machine, speed = balanced(ROTORS[kind], 0.1 * C), 5000 * RPM

    def motion(tolerance):
        found = simulate(
            machine, speed, revolutions=200, samples_per_revolution=8, start=FAR,
            tolerance=tolerance,
        )  # fmt: skip
        return found.journal

    reference = motion(1e-13)
    errors = [np.abs(motion(tol) - reference).max() / C for tol in (1e-6, 1e-8, 1e-10)]
    assert errors[0] > 10.0 * errors[1] > 100.0 * errors[2]
    assert errors[2] < 1e-8  # of the clearance; asked for is 1e-6 of the motion


@pytest.mark.parametrize("kind", ["rigid", "massless journals"])
def test_an_error_allowed_in_clearances_leaves_a_motion_right_to_some_millionths_of_one(kind):
    machine = balanced(ROTORS[kind], 0.1 * C)

    def motion(tolerance, absolute=None):
        found = simulate(
            machine, 5000 * RPM, revolutions=40, samples_per_revolution=8, start=FAR,
            tolerance=tolerance, absolute=absolute,
        )  # fmt: skip
        return found.journal

    reference = motion(1e-11)
    errors = [np.abs(motion(1e-7, absolute) - reference).max() / C for absolute in (None, 1e-7)]
    assert errors[0] < errors[1] < 1e-5
    assert errors[0] < 1e-6


def test_a_stiff_motion_does_not_keep_to_short_explicit_steps(monkeypatch):
    calls = itertools.count()

    def force(*state):
        next(calls)
        return motion.force(*state)

    monkeypatch.setattr(ShortFilm, "motion", lambda _: FilmMotion(force, motion.velocity))
    preset = PRESETS["friswell-5-5-1"]
    rest = analyse(preset.machine, preset.speed).journal_position
    start = rest - np.array([0.3 * preset.machine.bearing.radial_clearance, 0.0])
    simulate(
        preset.machine, preset.speed, revolutions=40, start=start, tolerance=1e-7, absolute=1e-7
    )
    assert next(calls) < 4000  # 10800 where LSODA goes on explicitly


@pytest.mark.parametrize("kind", ROTORS)
def test_the_journal_stays_inside_under_any_start(kind):
    rotor = replace(ROTORS[kind], imbalance=C)
    machine = replace(SHEET, rotor=rotor, load=50_000.0)
    motion = simulate(machine, 9000 * RPM, revolutions=20, start=(-0.99 * C, 0.0))
    distance = np.hypot(*motion.journal.T)
    assert 0.95 * C < distance.max() < C


def test_interleaved_integrations_do_not_affect_each_other():
    machines = [balanced(ROTORS[kind], 0.1 * C) for kind in ("rigid", "massless journals")] * 2
    alone = [simulate(machine, 5000 * RPM, revolutions=20).journal for machine in machines[:2]] * 2
    with ThreadPoolExecutor(4) as threads:
        together = list(
            threads.map(lambda one: simulate(one, 5000 * RPM, revolutions=20).journal, machines)
        )
    assert all(np.array_equal(a, b) for a, b in zip(alone, together, strict=True))


def test_a_motion_continues_from_its_last_state():
    machine = balanced(ROTORS["journal mass"])
    whole = simulate(machine, 5000 * RPM, revolutions=4, start=FAR)
    half = simulate(machine, 5000 * RPM, revolutions=2, start=FAR)
    rest = simulate(machine, 5000 * RPM, revolutions=2, start=last_state(half))
    assert rest.journal == pytest.approx(whole.journal[128:], abs=1e-8 * C)


def test_samples_are_evenly_spaced_in_the_angle_of_rotation():
    motion = simulate(SHEET, 5000 * RPM, revolutions=3, samples_per_revolution=10)
    assert motion.time.shape == (31,)
    assert motion.time[-1] == pytest.approx(3 * 60 / 5000, rel=1e-12)
    up = simulate(SHEET, 3000 * RPM, revolutions=50, final_speed=4000 * RPM)
    assert up.speed[-1] == pytest.approx(4000 * RPM, rel=1e-12)
    assert np.gradient(up.speed, up.time)[1:-1] == pytest.approx(
        (up.speed[-1] - up.speed[0]) / up.time[-1], rel=1e-3
    )


def test_progress_is_reported_and_its_exception_ends_the_work():
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
        ({"revolutions": 10**6}, "at most 20000"),
        ({"samples_per_revolution": 0}, "samples_per_revolution = 0"),
        ({"speed": 0.0}, "speed"),
        ({"speed": math.nan}, "speed"),
        ({"start": (C, 0.0)}, "film has no thickness left"),
        ({"start": (math.nan, 0.0)}, "finite"),
        ({"start": (0.0, 0.0, 0.0)}, "must be two numbers, X and Y, has the shape"),
        ({"start": [[0.0], [0.0]]}, "must be two numbers"),
        ({"start": [0.0, [0.0, 0.0]]}, "start = .*: must be an array of numbers"),
        ({"start": "rest"}, "start = 'rest': must be a number or an array"),
        ({"start": 0.0}, "must be two numbers"),
        (
            {
                "start": Start(
                    **dict.fromkeys(("journal", "disk", "journal_velocity"), np.zeros(2)),
                    disk_velocity=np.zeros(3),
                )
            },
            "start.disk_velocity",
        ),
        ({"speed": [600.0, 500.0]}, "speed = .*: must be"),
        ({"speed": "600"}, "speed = '600'"),
        ({"final_speed": [600.0, 500.0]}, "final_speed = .*: must be"),
        ({"tolerance": "tight"}, "tolerance = 'tight'"),
        ({"tolerance": 1e-16}, "tolerance"),
        ({"tolerance": math.nan}, "tolerance"),
        ({"absolute": 0.0}, "absolute = 0.0: must lie within"),
        ({"final_speed": -1.0}, "final_speed = -1.0 rad/s: must be positive"),
    ],
)
def test_a_bad_request_raises_a_valueerror(changes, words):
    asked = {"speed": 5000 * RPM, "revolutions": 5} | changes
    with pytest.raises(ValueError, match=words):
        simulate(SHEET, asked.pop("speed"), **asked)


def test_a_failed_integration_reports_time_place_and_the_motion_so_far(monkeypatch):
    calls = itertools.count()

    def fails_from_then_on(x, y, f_x, f_y, *near):
        if next(calls) >= 200:
            raise ArithmeticError("no velocity found")
        return motion.velocity(x, y, f_x, f_y, *near)

    monkeypatch.setattr(ShortFilm, "motion", lambda _: FilmMotion(motion.force, fails_from_then_on))
    with pytest.raises(TransientError, match=r"found after .* s, with the journal at") as failure:
        simulate(SHEET, 5000 * RPM, revolutions=40)
    assert len(failure.value.partial.time) >= 1


def test_a_failed_integrator_reports_once_and_keeps_valid_states(monkeypatch):
    """In the error alone: SciPy's own warning would be an error here."""
    good = simulate(SHEET, 5000 * RPM, revolutions=3, start=FAR)
    rates = Equations.motion

    def breaking(self):
        motion = rates(self)
        return lambda state, angle: motion(state, angle if angle < 9.0 else math.nan)

    monkeypatch.setattr(Equations, "motion", breaking)
    with pytest.raises(TransientError, match=r"gave up|no velocity") as failure:
        simulate(SHEET, 5000 * RPM, revolutions=3, start=FAR)
    partial = failure.value.partial
    assert 60 < len(partial.time) <= 93  # 9 rad
    assert partial.journal == pytest.approx(good.journal[: len(partial.time)], abs=1e-8 * C)
