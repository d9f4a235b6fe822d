"""Limit cycles of a journal and its floating ring, from either whirl's onset."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import Plain, bifurcation, hopf, mode_onsets, ring_speed, simulate
from rotorcalc.nonlinear.collocation import Balance
from rotorcalc.nonlinear.continuation import small_cycle
from rotorcalc.nonlinear.limit_cycles import start_on_cycle
from tests.films.models import BEARINGS
from tests.films.test_ring import MACHINE, SMALL, ring
from tests.machines import ROTORS, SHEET

C, WIDER, MU = SMALL.radial_clearance, 3.5, MACHINE.viscosity
HEAVY = replace(MACHINE, bearing=ring(SMALL, ring_mass=4e-3))


@pytest.fixture(scope="module")
def inner_whirl():
    """The cycles of the inner film's whirl, past its fold."""
    return bifurcation(MACHINE, highest=1.1)


@pytest.fixture(scope="module", params=[MACHINE, HEAVY], ids=["massless", "heavy"])
def begun(request):
    """Machine, onset and first cycles of both whirls."""
    machine = request.param
    return [
        (machine, onset, bifurcation(machine, onset=onset, lowest=0.999, highest=1.01))
        for onset in mode_onsets(machine)
    ]


def test_at_either_onset_a_whirl_of_the_linear_frequency_begins(begun):
    for machine, onset, branch in begun:
        speed, found = branch.speed[0], branch.hopf
        assert branch.whirl_frequency[0] / speed == pytest.approx(onset.whirl_ratio, rel=1e-4)
        r = float(ring_speed(machine, onset.speed)) / onset.speed
        limit = 0.5 * (1.0 + r) if onset.mode == "inner film" else 0.5 * r
        assert onset.whirl_ratio == pytest.approx(limit, rel=0.1)
        # The journal whirls in the ring in the one, and with it in the other.
        share = branch.inner_amplitude[0] / branch.amplitude[0]
        assert share < 0.6 if onset.mode == "inner film" else share == pytest.approx(1.0, abs=0.05)
        assert branch.amplitude[0] == pytest.approx(found.amplitude(speed), rel=0.01)


@pytest.mark.parametrize("first", [1, 2])
def test_a_branch_may_turn_back_at_its_first_cycles(begun, first):
    """The fold of a parabola through the onset is its top, wherever the first cycle lies."""
    _, _, branch = begun[0]
    size = 0.02e-6 * np.arange(first, first + 4)
    speed = branch.hopf.speed * (1.0 + 1e-4 * size * (0.05e-6 - size) / 1e-15)
    turned = replace(branch, speed=speed, amplitude=size)
    assert turned.fold_amplitudes == pytest.approx([0.025e-6], rel=1e-6)
    assert turned.folds == pytest.approx([branch.hopf.speed * (1.0 + 0.625e-4)], rel=1e-12)
    # A branch that goes on as it began has none, above the onset or below it.
    for way in (1.0, -1.0):
        assert not len(replace(branch, speed=branch.hopf.speed + way * size, amplitude=size).folds)


def test_its_size_grows_as_the_square_root_of_the_distance_from_the_onset(begun):
    for machine, onset, branch in begun:
        found = branch.hopf
        distances = []
        for size in (0.02, 0.04):
            cycle = small_cycle(Balance(machine), found, size)
            swing = cycle.path[:, :2] - cycle.path[:, :2].mean(axis=0)
            distances.append((cycle.speed - onset.speed) / np.hypot(*swing.T).max() ** 2)
        # Of the next order, a², two sizes rid the answer.
        slope = (4.0 * distances[0] - distances[1]) / 3.0
        assert -found.growth_slope * slope == pytest.approx(found.lyapunov, rel=5e-3)
        assert found.lyapunov_error < 1e-3 * abs(found.lyapunov)


def test_a_motion_far_from_the_cycle_ends_on_it_as_fast_as_its_multiplier_says(inner_whirl):
    speed, omega = float(inner_whirl.speed[-1]), float(inner_whirl.whirl_frequency[-1])
    assert inner_whirl.stable[-1]
    motion = simulate(MACHINE, speed, revolutions=150, start=(0.3 * C, 0.3 * C), tolerance=1e-7)
    turn = round(64 * speed / omega)
    for moved, path in (
        (motion.journal, inner_whirl.paths[-1]),
        (motion.inner, inner_whirl.inner_paths[-1]),
    ):
        size, far = np.ptp(path, axis=0).max(), distance(moved[: 2 * turn], path)
        middle, end = (distance(moved[i - 2 * turn : i], path) for i in (64 * 90, 64 * 150))
        assert far > 0.2 * size
        assert end < 0.02 * size
        decay = (end / middle) ** (turn / (64 * 60))
        assert 1.0 - decay == pytest.approx(1.0 - inner_whirl.multiplier[-1], rel=0.15)
    away = motion.journal[-64 * 8 :] - motion.journal[-64 * 8 :].mean(axis=0)
    turns = np.unwrap(np.arctan2(away[:, 1], away[:, 0]))
    assert np.polyfit(motion.time[-64 * 8 :], turns, 1)[0] == pytest.approx(omega, rel=0.01)


def distance(points, path):
    """Return the largest distance of points from a closed path, by its Fourier series."""
    m = len(path)
    dense = 128.0 * np.fft.irfft(np.fft.rfft(path, axis=0), n=128 * m, axis=0)
    return float(np.hypot(*(points[:, None] - dense[None]).transpose(2, 0, 1)).min(axis=1).max())


FLEXIBLE = replace(
    SHEET,
    rotor=replace(ROTORS["massless journals"], imbalance=0.0),
    bearing=BEARINGS["floating ring, heavy"],
)


@pytest.mark.parametrize("machine", [MACHINE, FLEXIBLE], ids=["rigid", "flexible, heavy ring"])
def test_a_motion_started_on_a_cycle_stays_on_it(machine):
    branch = bifurcation(machine, lowest=0.99, highest=1.01)
    speed, period = float(branch.speed[2]), 2.0 * math.pi / branch.whirl_frequency[2]
    start = start_on_cycle(machine, branch, 2)
    turns = math.ceil(speed * period / (2.0 * math.pi))
    motion = simulate(machine, speed, revolutions=turns, start=start)
    clearance = machine.bearing.radial_clearance
    assert branch.amplitude[2] > 0.05 * clearance
    assert distance(motion.journal, branch.paths[2]) < 1e-4 * clearance
    assert distance(motion.inner[:, :2], branch.inner_paths[2]) < 1e-4 * clearance


def test_a_plain_second_program_finds_all_forces_in_balance(inner_whirl):
    """By sums over the films' angles, from the cycle's path alone."""
    for place in (0, len(inner_whirl.speed) // 2, -1):
        speed, omega = inner_whirl.speed[place], inner_whirl.whirl_frequency[place]
        journal, ring_at = inner_whirl.paths[place], inner_whirl.inner_paths[place]
        r = float(ring_speed(MACHINE, speed))
        inside = summed(SMALL.length, SMALL.radius, C, (journal - ring_at, omega), speed + r)
        outer = SMALL.geometry
        outside = summed(
            outer.outer_length, outer.outer_radius, outer.outer_clearance, (ring_at, omega), r
        )
        mass = MACHINE.rotor.half_mass * rate(rate(journal, omega), omega)
        load = [MACHINE.static_load, 0.0]
        size = np.abs(inside).max()
        assert np.abs(inside + load - mass).max() < 2e-3 * size
        assert np.abs(outside - inside).max() < 2e-3 * size


def rate(path, omega):
    """Return the velocity along a closed path."""
    k = 1j * np.arange(len(path) // 2 + 1)[:, None]
    return omega * np.fft.irfft(k * np.fft.rfft(path, axis=0), n=len(path), axis=0)


def summed(length, radius, gap, whirl, turning):
    """Return the force of a short film by a sum over its angle, pressure above ambient only."""
    (place, omega), angle = whirl, np.linspace(0.0, 2.0 * np.pi, 4001)[:-1]
    outward = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    along = np.stack([-np.sin(angle), np.cos(angle)], axis=-1)
    h = gap - place @ outward.T
    squeeze = -rate(place, omega) @ outward.T - 0.5 * turning * place @ along.T
    pressure = np.maximum(-MU * length**3 * squeeze / h**3, 0.0)
    return -pressure @ outward * radius * (angle[1] - angle[0])


def test_stable_cycles_are_those_that_rise_with_the_speed(inner_whirl):
    rising = np.gradient(inner_whirl.speed) > 0.0
    turns = np.abs(inner_whirl.multiplier - 1.0) < 0.02
    assert np.all((rising == inner_whirl.stable) | turns)
    assert inner_whirl.stable[-1]
    assert not inner_whirl.stable[0]
    # Below the fold it is the size that grows or decays.
    assert not inner_whirl.beats[~inner_whirl.stable].any()


def test_while_the_inner_film_whirls_that_of_the_outer_one_begins_unstable(begun):
    """The whirl that grows about it has a frequency of its own."""
    for _, onset, branch in begun:
        if onset.mode == "outer film":
            assert not branch.stable.any()
            assert branch.beats.all()


def test_the_stable_cycle_at_a_speed_is_the_branch_between_two_cycles(inner_whirl):
    last = inner_whirl.held_at(float(inner_whirl.speed[-1]))
    assert last.amplitude == pytest.approx(inner_whirl.amplitude[-1], rel=1e-9)
    assert last.inner_amplitude == pytest.approx(inner_whirl.inner_amplitude[-1], rel=1e-9)
    speed = 0.5 * (inner_whirl.speed[-1] + inner_whirl.speed[-2])
    held = inner_whirl.held_at(float(speed))
    for value, values in (
        (held.whirl_frequency, inner_whirl.whirl_frequency),
        (held.thinnest, inner_whirl.thinnest),
    ):
        assert value == pytest.approx(values[-2:].mean(), rel=1e-9)
    assert inner_whirl.held_at(0.5 * float(inner_whirl.speed.min())) is None


def test_a_ring_that_stands_in_a_narrow_film_has_the_cycles_of_a_plain_bearing():
    loaded = replace(MACHINE, load=20.0)
    narrow = replace(loaded, bearing=ring(SMALL, outer_clearance=C / 100.0))
    plain = replace(loaded, bearing=replace(SMALL, geometry=Plain()))
    found = [hopf(narrow, onset=mode_onsets(narrow)[0]), hopf(plain)]
    assert found[0].speed == pytest.approx(found[1].speed, rel=0.02)
    assert found[0].lyapunov == pytest.approx(found[1].lyapunov, rel=0.1)
    inside, alone = (
        small_cycle(Balance(one), onset, 0.3)
        for one, onset in zip((narrow, plain), found, strict=True)
    )
    away = inside.path[:, :2] - alone.path
    assert np.abs(away).max() < 0.03 * np.ptp(alone.path, axis=0).max()
    assert np.abs(inside.path[:, 2:]).max() < 0.01


def test_pads_that_tilt_are_refused_in_words():
    tilting = replace(SHEET, bearing=BEARINGS["tilting pads"])
    for computation in (bifurcation, hopf):
        with pytest.raises(ValueError, match="inner coordinates"):
            computation(tilting)
