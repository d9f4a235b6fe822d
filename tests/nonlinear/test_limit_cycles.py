"""What whirl becomes: known cycles, and the motions themselves."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, example, given, settings

from rotorcalc import (
    PRESETS,
    JournalBearing,
    Machine,
    Oil,
    Rotor,
    analyse,
    bifurcation,
    hopf,
    simulate,
)
from rotorcalc.nonlinear import transient
from rotorcalc.nonlinear.limit_cycles import start_on_cycle, sweep
from tests.films.models import Preloaded
from tests.machines import RIGID, ROTORS, SHEET, C, balanced, log_uniform, machines, near_hopf


@pytest.fixture(scope="module")
def subcritical():
    return bifurcation(near_hopf(0.06, 1.0)[0])


@pytest.fixture(scope="module")
def supercritical():
    return bifurcation(near_hopf(0.30, 1.0)[0])


@pytest.mark.parametrize("kind", ROTORS)
def test_small_cycles_follow_the_normal_form(kind):
    machine = balanced(ROTORS[kind])
    branch = bifurcation(machine, lowest=0.999, highest=1.001)
    first = branch.amplitude[0]
    assert first == pytest.approx(branch.hopf.amplitude(branch.speed[0]), rel=0.02)
    assert branch.whirl_frequency[0] == pytest.approx(branch.hopf.whirl_frequency, rel=1e-3)
    assert branch.stable[0] == (not branch.hopf.subcritical)


@pytest.mark.parametrize("kind", ROTORS)
def test_a_motion_started_on_a_cycle_stays_on_it(kind):
    """Every point of the cycle obeys the equations of motion, which know nothing of harmonics."""
    machine = balanced(ROTORS[kind])
    branch = bifurcation(machine, highest=1.2)
    place = int(np.flatnonzero(branch.stable)[4])
    speed, path = branch.speed[place], branch.paths[place]
    start = start_on_cycle(machine, branch, place)
    turns = 4.0 * speed / branch.whirl_frequency[place]
    motion = simulate(machine, speed, revolutions=math.ceil(turns), start=start)
    distance = np.hypot(*(motion.journal[:, None] - path[None]).transpose(2, 0, 1)).min(axis=1)
    gap = np.hypot(*np.diff(path, axis=0).T).max()
    assert distance.max() < 0.51 * gap
    after = np.searchsorted(motion.time, 2 * math.pi / branch.whirl_frequency[place])
    assert (
        np.abs(motion.journal[after] - motion.journal[0]).max()
        < 1.1 * np.abs(motion.journal[after + 1] - motion.journal[after]).max()
    )


def test_an_unstable_cycle_separates_decaying_motions_from_growing_ones():
    machine, speed, rest = near_hopf(0.06, 0.99)
    branch = bifurcation(machine)
    place = int(np.argmin(np.abs(np.where(branch.stable, np.inf, branch.speed) - 0.985 * speed)))
    start = start_on_cycle(machine, branch, place)
    outcome = []
    for share in (0.9, 1.1):
        scaled = transient.Start(
            **{
                name: getattr(start, name) * share for name in ("journal_velocity", "disk_velocity")
            },
            journal=rest + share * (start.journal - rest),
            disk=rest + share * (start.disk - rest),
        )
        motion = simulate(machine, branch.speed[place], revolutions=80, start=scaled)
        size = np.hypot(*(motion.journal - rest).T)
        outcome.append(size[-640:].max() / size[:640].max())
    assert outcome[0] < 0.95
    assert outcome[1] > 1.05


def test_the_branch_has_the_known_cycles():
    machine, speed, _ = near_hopf(0.30, 1.01)
    sizes, stable = bifurcation(machine).at(speed)
    assert sizes / C == pytest.approx([0.156], abs=0.002)
    assert stable.tolist() == [True]
    machine, speed, _ = near_hopf(0.06, 0.99)
    sizes, stable = bifurcation(machine).at(speed)
    assert sizes[stable] / C == pytest.approx([0.865], abs=0.004)
    assert 0.01 < float(sizes[~stable][0]) / C < 0.25


def test_between_fold_and_onset_the_history_decides_between_rest_and_whirl(subcritical):
    onset = subcritical.hopf.speed
    (fold,) = subcritical.folds
    speeds = np.linspace(0.9, 1.1, 41) * onset
    up, down = sweep(subcritical, speeds), sweep(subcritical, speeds, down=True)
    between = (speeds > fold) & (speeds < onset * (1 - 1e-9))
    assert np.all(up[speeds < onset * (1 - 1e-9)] == 0.0)
    assert np.all(down[between] > 0.5 * C)
    assert np.all(down[speeds < fold] == 0.0)
    assert up[speeds > onset * 1.001] == pytest.approx(down[speeds > onset * 1.001])


def test_slow_speed_changes_in_time_show_the_same_hysteresis(subcritical):
    machine, _, _ = near_hopf(0.06, 1.0)
    onset, start, seen = subcritical.hopf.speed, None, {}
    for direction, factors in (("up", (0.96, 0.98, 1.03)), ("down", (1.03, 0.98, 0.96, 0.92))):
        for factor in factors:
            rest = analyse(machine, factor * onset).journal_position
            start = start or transient.resting(machine, rest + np.array([0.02 * C, 0.0]))
            motion = simulate(machine, factor * onset, revolutions=250, start=start, tolerance=1e-8)
            seen[direction, factor] = np.hypot(*(motion.journal - rest).T)[-640:].max()
            start = transient.last_state(motion)
    for factor in (0.96, 0.98):
        assert seen["up", factor] < 0.02 * C
        known = sweep(subcritical, [factor * onset, 1.1 * onset], down=True)[0]
        assert seen["down", factor] == pytest.approx(known, rel=0.01)
    assert seen["down", 0.92] < 0.05 * C


def test_floquet_agrees_with_the_turns_of_the_branch(subcritical, supercritical):
    for branch in (subcritical, supercritical):
        rising = np.gradient(branch.speed) > 0.0
        flips = np.abs(branch.multiplier - 1.0) < 0.02
        assert np.all((rising == branch.stable) | flips)


REASONS = [
    "reached the highest speed asked for",
    "reached the lowest speed asked for",
    "came to within 3 % of the clearance to the wall",
    "shrank to rest at another onset",
]
LOST = "was lost: Newton's method finds no next cycle, however near"


def rigid(mass, **bearing):
    """Return a rigid rotor of a mass on thick oil and a long bearing."""
    return Machine(
        oil=Oil(reference_viscosity=0.1, reference_temperature=50, temperature_coefficient=0.03),
        bearing=JournalBearing(
            **{"diameter": 0.1, "length": 0.08, "radial_clearance": 100e-6} | bearing
        ),
        rotor=Rotor(mass=mass),
        temperature=50.0,
    )


def test_a_branch_continues_where_its_film_is_nearly_in_half_speed_whirl():
    """There the force's slopes change within a millionth of CΩ."""
    branch = bifurcation(rigid(50.0), highest=1.5)
    onset = branch.hopf.speed
    assert branch.ended == "reached the highest speed asked for"
    assert branch.speed[-1] == pytest.approx(1.5 * onset, rel=1e-12)
    assert len(branch.speed) < 60
    for factor in (1.31, 1.4, 1.499):
        sizes, stable = branch.at(factor * onset)
        assert len(sizes[stable]) == 1


def test_another_film_has_its_branch():
    bearing = replace(SHEET.bearing, geometry=Preloaded(spring=0.3))
    machine = replace(SHEET, bearing=bearing)
    branch = bifurcation(machine, highest=1.1)
    assert branch.ended in REASONS
    assert branch.stable[0] == (not branch.hopf.subcritical)
    place = int(np.flatnonzero(branch.stable)[-1])
    speed, path = branch.speed[place], branch.paths[place]
    start = start_on_cycle(machine, branch, place)
    balanced = replace(machine, rotor=replace(machine.rotor, imbalance=0.0))
    motion = simulate(balanced, speed, revolutions=6, start=start)
    distance = np.hypot(*(motion.journal[:, None] - path[None]).transpose(2, 0, 1)).min(axis=1)
    assert distance.max() < 0.51 * np.hypot(*np.diff(path, axis=0).T).max()


def test_a_branch_ends_on_the_lowest_speed_too(subcritical):
    lowest = 0.5 + 0.5 * float(subcritical.folds[0] / subcritical.hopf.speed)
    branch = bifurcation(near_hopf(0.06, 1.0)[0], lowest=lowest)
    assert branch.ended == "reached the lowest speed asked for"
    assert branch.speed[-1] == pytest.approx(lowest * branch.hopf.speed, rel=1e-12)
    known, _ = subcritical.at(branch.speed[-1])
    assert branch.amplitude[-1] == pytest.approx(min(known), rel=0.01)


def test_a_branch_may_shrink_to_rest_at_another_onset():
    """Midspan damping ends this machine's instability at a higher speed: there it can rest."""
    machine = Machine(
        oil=Oil(reference_viscosity=0.02, reference_temperature=50, temperature_coefficient=0.03),
        bearing=JournalBearing(diameter=0.1, length=0.05, radial_clearance=40e-6),
        rotor=Rotor(mass=100.0, shaft_stiffness=3e5, disk_damping=20.0),
        temperature=50.0,
    )
    branch = bifurcation(machine)
    assert branch.ended == "shrank to rest at another onset"
    square = branch.amplitude[-2:] ** 2
    end = branch.speed[-1] + np.diff(branch.speed)[-1] * square[1] / (square[0] - square[1])
    growth = [
        analyse(machine, factor * end).flexible_eigenvalues.real.max() for factor in (0.999, 1.001)
    ]
    assert growth[0] > 0.0 > growth[1]


@settings(max_examples=15)
@given(machine=machines(stiffness=RIGID | log_uniform(1e5, 1e10), damped=True, journals=True))
@example(machine=rigid(2000.0, length=0.02))
@example(machine=rigid(0.5, radial_clearance=200e-6))
def test_a_branch_reaches_the_bound_or_names_why_it_ended(machine):
    try:
        branch = bifurcation(machine)
    except ValueError:
        assume(False)
    ratio = branch.speed / branch.hopf.speed
    assert np.all((ratio > 0.5 - 1e-9) & (ratio < 1.5 + 1e-9))
    as_said = {
        "reached the highest speed asked for": ratio[-1] == pytest.approx(1.5),
        "reached the lowest speed asked for": ratio[-1] == pytest.approx(0.5),
        "came to within 3 % of the clearance to the wall": branch.eccentricity_ratio[-1] > 0.97,
        "shrank to rest at another onset": branch.amplitude[-1] < 0.1 * branch.hopf.clearance,
    }
    assert list(as_said) == REASONS
    # Now and then Newton's method loses a drawn machine's branch: that is a named end too.
    assert as_said.get(branch.ended, branch.ended == LOST)


def test_imbalance_does_not_affect_the_result():
    speeds = [
        bifurcation(replace(SHEET, rotor=replace(SHEET.rotor, imbalance=u)), highest=1.01).speed
        for u in (0.0, 0.2 * C)
    ]
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-9)


def test_progress_is_reported_and_its_exception_ends_the_work():
    told = []
    bifurcation(SHEET, highest=1.05, progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0

    def stop(share):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        bifurcation(SHEET, progress=stop)


@pytest.mark.parametrize("name", PRESETS)
def test_every_preset_has_its_cycles(name):
    branch = bifurcation(PRESETS[name].machine)
    assert branch.hopf.subcritical
    assert len(branch.folds) == 1
    assert branch.stable[-1]
    assert branch.eccentricity_ratio.max() < 1.0


def test_machines_without_an_onset_raise_a_valueerror():
    with pytest.raises(ValueError, match="whirls at any speed"):
        hopf(replace(SHEET, load=0.0))
    with pytest.raises(ValueError, match="has no onset"):
        bifurcation(replace(SHEET, rotor=replace(SHEET.rotor, disk_damping=1e5)))
    with pytest.raises(ValueError, match="either side of 1"):
        bifurcation(SHEET, lowest=1.2)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (lambda branch: sweep(branch, 900.0), "two or more rising speeds"),
        (lambda branch: sweep(branch, [[800.0, 900.0]]), "two or more rising speeds"),
        (lambda branch: sweep(branch, [900.0, 800.0]), r"speed\[1\] = 800 rad/s: must be greater"),
        (lambda branch: sweep(branch, ["900", "950"]), "speed"),
        (lambda branch: branch.at("900"), "speed = '900'"),
        (lambda branch: branch.hopf.amplitude("900"), "speed = '900'"),
        (
            lambda branch: start_on_cycle(SHEET, branch, 9999),
            "place = 9999: must be 0 to",
        ),
        (lambda branch: start_on_cycle(SHEET, branch, -1), "place = -1: must be 0 to"),
        (lambda branch: start_on_cycle(branch, branch, 0), "machine = a Bifurcation"),
    ],
)
def test_what_no_branch_answers_is_refused_in_words(subcritical, asked, words):
    with pytest.raises(ValueError, match=words):
        asked(subcritical)
