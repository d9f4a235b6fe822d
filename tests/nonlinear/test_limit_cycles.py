"""What whirl becomes: known cycles, and the motions themselves."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse, bifurcation, hopf, simulate
from rotorcalc.nonlinear import limit_cycles, transient
from rotorcalc.nonlinear.limit_cycles import sweep
from tests.machines import ROTORS, SHEET, C, balanced, near_hopf


@pytest.fixture(scope="module")
def subcritical():
    return bifurcation(near_hopf(0.06, 1.0)[0])


@pytest.fixture(scope="module")
def supercritical():
    return bifurcation(near_hopf(0.30, 1.0)[0])


@pytest.mark.parametrize("kind", ROTORS)
def test_cycles_are_born_as_the_normal_form_says(kind):
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
    start = limit_cycles.start_on_cycle(machine, branch, place)
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


def test_an_unstable_cycle_parts_the_motions_that_die_from_those_that_grow():
    machine, speed, rest = near_hopf(0.06, 0.99)
    branch = bifurcation(machine)
    place = int(np.argmin(np.abs(np.where(branch.stable, np.inf, branch.speed) - 0.985 * speed)))
    start = limit_cycles.start_on_cycle(machine, branch, place)
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


def test_between_fold_and_onset_the_machine_rests_or_whirls_by_its_history(subcritical):
    onset = subcritical.hopf.speed
    (fold,) = subcritical.folds
    speeds = np.linspace(0.9, 1.1, 41) * onset
    up, down = sweep(subcritical, speeds), sweep(subcritical, speeds, down=True)
    between = (speeds > fold) & (speeds < onset * (1 - 1e-9))
    assert np.all(up[speeds < onset * (1 - 1e-9)] == 0.0)
    assert np.all(down[between] > 0.5 * C)
    assert np.all(down[speeds < fold] == 0.0)
    assert up[speeds > onset * 1.001] == pytest.approx(down[speeds > onset * 1.001])


def test_sweeping_in_time_shows_the_same_hysteresis(subcritical):
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


def test_the_imbalance_plays_no_part():
    speeds = [
        bifurcation(replace(SHEET, rotor=replace(SHEET.rotor, imbalance=u)), highest=1.01).speed
        for u in (0.0, 0.2 * C)
    ]
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-9)


def test_progress_is_told_and_what_it_raises_ends_the_work():
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


def test_machines_without_an_onset_are_refused_in_words():
    with pytest.raises(ValueError, match="whirls at any speed"):
        hopf(replace(SHEET, load=0.0))
    with pytest.raises(ValueError, match="has no onset"):
        bifurcation(replace(SHEET, rotor=replace(SHEET.rotor, disk_damping=1e5)))
    with pytest.raises(ValueError, match="either side of 1"):
        bifurcation(SHEET, lowest=1.2)
