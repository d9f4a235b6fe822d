"""The nonlinear motion on every film model: its rest, its small motions, its wall and energy."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from rotorcalc import analyse, energy_balance, simulate
from rotorcalc.coefficients import dynamics
from rotorcalc.films import film_of
from rotorcalc.nonlinear.equations import Start, resting
from rotorcalc.nonlinear.linear_motion import linear_motion, linear_theory
from rotorcalc.nonlinear.measured_onset import measured_growth
from rotorcalc.nonlinear.release import release
from rotorcalc.nonlinear.transient import last_state, start_on_mode
from tests.films.models import BEARINGS, MOVING
from tests.machines import ROTORS, SHEET, C

ALL = pytest.mark.parametrize("name", MOVING)
KINDS = pytest.mark.parametrize("kind", ["rigid", "massless journals", "journal mass, damped"])
SPEED = 500.0


def machine_on(name, kind, imbalance=0.0):
    rotor = replace(ROTORS[kind], imbalance=imbalance)
    return replace(SHEET, bearing=BEARINGS[name], rotor=rotor)


def linear_motion_of(machine, time, kick):
    """Return the journal's displacement by the linear pencil M q'' + C q' + K q = 0, from rest.

    q holds disk, journal (one for a rigid shaft) and inner coordinates, put together here anew;
    those without mass are of first order.
    """
    rotor, film = machine.rotor, dynamics(machine, SPEED)
    n, rigid = film.inertia.size, rotor.is_rigid
    first = 0 if rigid else 2  # where the film's coordinates begin
    size = first + 2 + n
    K, D, M = np.zeros((size, size)), np.zeros((size, size)), np.zeros(size)
    K[first:, first:], D[first:, first:] = film.stiffness, film.damping
    M[first + 2 :] = film.inertia
    M[:2] = rotor.half_mass if rigid else rotor.disk_mass
    D[:2, :2] += rotor.disk_damping * np.eye(2)
    if not rigid:
        M[2:4] = rotor.journal_mass
        k = rotor.shaft_stiffness * np.eye(2)
        K[:4, :4] += np.block([[k, -k], [-k, k]])
    heavy, light = np.flatnonzero(M > 0.0), np.flatnonzero(M == 0.0)
    # States: all places, then the velocities of what has mass.
    places = np.eye(size)
    velocity = np.zeros((size, size + len(heavy)))
    velocity[heavy, size + np.arange(len(heavy))] = 1.0
    if len(light):
        rest = -K[light] @ np.hstack([places, np.zeros((size, len(heavy)))])
        rest -= D[np.ix_(light, heavy)] @ velocity[heavy]
        velocity[light] = np.linalg.solve(D[np.ix_(light, light)], rest)
    pull = -np.hstack([K[heavy], np.zeros((len(heavy), len(heavy)))]) - D[heavy] @ velocity
    A = np.vstack([velocity, pull / M[heavy, None]])
    start = np.zeros(len(A))
    start[: first + 2] = np.tile(kick, (first + 2) // 2)
    step = expm(A * (time[1] - time[0]))
    states = [start]
    for _ in time[1:]:
        states.append(step @ states[-1])
    return np.array(states)[:, first : first + 2]


@ALL
@KINDS
def test_a_balanced_machine_rests_in_its_equilibrium(name, kind):
    machine = machine_on(name, kind)
    rest = analyse(machine, SPEED).journal_position
    motion = simulate(machine, SPEED, revolutions=1, tolerance=1e-6)
    assert np.abs(motion.journal - rest).max() < 1e-6 * C


@ALL
@KINDS
def test_a_small_motion_is_the_linear_theory(name, kind):
    machine = machine_on(name, kind)
    rest, kick = analyse(machine, SPEED).journal_position, np.array([1e-5 * C, -2e-5 * C])
    motion = simulate(machine, SPEED, revolutions=3, start=rest + kick)
    expected = linear_motion_of(machine, motion.time, kick)
    assert np.abs(motion.journal - rest - expected).max() < 1e-3 * np.abs(kick).max()


@ALL
@KINDS
def test_energy_balances_on_every_film(name, kind):
    machine = machine_on(name, kind, 0.05 * C)
    rest = analyse(machine, SPEED).journal_position
    motion = simulate(machine, SPEED, revolutions=1, start=rest + np.array([-0.2, 0.1]) * C)
    balance = energy_balance(machine, motion)
    assert np.abs(balance.residual).max() < 1e-6 * balance.exchanged


@ALL
def test_a_motion_continues_from_its_last_state(name):
    machine = machine_on(name, "massless journals", 0.1 * C)
    whole = simulate(machine, SPEED, revolutions=2)
    half = simulate(machine, SPEED, revolutions=1)
    rest = simulate(machine, SPEED, revolutions=1, start=last_state(half))
    assert rest.journal == pytest.approx(whole.journal[64:], abs=1e-6 * C)
    assert (half.inner is None) == (film_of(machine.bearing).inner == 0)


def test_a_heavy_ring_passes_through_a_speed_as_it_moves_there_at_constant_speed():
    """A slow run-up: the ring's velocities change their unit with the speed."""
    machine = machine_on("ringed, heavy", "rigid", 0.1 * C)
    up = simulate(machine, 0.99 * SPEED, revolutions=60, final_speed=1.01 * SPEED, tolerance=1e-7)
    steady = simulate(machine, SPEED, revolutions=30, tolerance=1e-7)
    orbit = steady.inner[-65:-1] - steady.inner[-65:-1].mean(axis=0)
    middle = np.argmin(np.abs(up.speed - SPEED))
    passing = up.inner[middle - 32 : middle + 32] - up.inner[middle - 32 : middle + 32].mean(axis=0)
    assert np.abs(passing).max(axis=0) == pytest.approx(np.abs(orbit).max(axis=0), rel=0.03)


def test_the_wall_is_where_the_gap_closes():
    """In the square bore's corner the journal may be farther off than the clearance."""
    machine = machine_on("sprung", "rigid")
    motion = simulate(machine, SPEED, revolutions=1, start=(0.9 * C, 0.9 * C))
    assert np.hypot(*motion.journal[0]) > C
    with pytest.raises(ValueError, match="its film has no thickness left"):
        simulate(machine, SPEED, revolutions=1, start=(1.01 * C, 0.0))


@pytest.mark.parametrize(("inner", "words"), [(np.zeros(3), "4 numbers"), (math.nan, "4 numbers")])
def test_inner_states_of_another_number_are_refused(inner, words):
    machine = machine_on("ringed, heavy", "rigid")
    still = np.zeros(2)
    start = Start(still, still, still, still, inner=inner)
    with pytest.raises(ValueError, match=words):
        simulate(machine, SPEED, revolutions=1, start=start)


@ALL
@KINDS
def test_the_linear_motion_is_that_of_the_pencil_and_of_the_small_motion(name, kind):
    machine = machine_on(name, kind, 1e-5 * C)
    rest = analyse(machine, SPEED).journal_position
    if math.isnan(linear_theory(machine, SPEED).whirl.real):  # no mode oscillates
        start = resting(machine, rest + np.array([2e-5 * C, 0.0]))
    else:
        start = start_on_mode(machine, SPEED, 2e-5 * C)
    motion = simulate(machine, SPEED, revolutions=2, start=start)
    expected = linear_motion(machine, SPEED, start, motion.time)
    size = np.abs(expected).max()
    assert np.abs(motion.journal - rest - expected).max() < 1e-3 * size


@ALL
@KINDS
def test_growth_is_measured_on_every_film(name, kind):
    machine = machine_on(name, kind)
    whirl = linear_theory(machine, SPEED).whirl
    measured = measured_growth(machine, SPEED)
    if math.isnan(whirl.real):  # no mode oscillates
        assert math.isnan(measured)
    else:
        assert measured == pytest.approx(whirl.real, abs=1e-5 * abs(whirl))


@ALL
def test_a_release_is_followed_on_every_film(name):
    machine = machine_on(name, "massless journals", 0.02 * C)
    found = release(machine, SPEED, kick=1e-3 * C, revolutions=16, tolerance=1e-6)
    assert found.stopped == ""
    assert found.film.min() > 0.0
    assert np.abs(found.linear - found.motion.journal).max() < 0.05 * found.size.max()
