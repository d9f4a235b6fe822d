"""Mode shapes and the root locus: eigenvectors, senses of whirl, branches in their places."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse, modes, onset_speed
from rotorcalc.coefficients import equilibrium
from rotorcalc.root_locus import root_locus
from rotorcalc.unbalance_response import orbit_ellipse

RPM = np.pi / 30


def shapes_of(machine, speed, *, flexible=True):
    state = equilibrium(machine, speed)
    return modes.mode_shapes(machine.rotor, state.stiffness, state.damping, flexible=flexible)


def locus_of(machine, speed, top, *, flexible=True):
    speeds = np.linspace(top / 240, top, 240)
    sweep = analyse(machine, speeds)
    values = sweep.flexible_eigenvalues if flexible else sweep.rigid_eigenvalues
    branches = modes.follow_branches(values)
    shapes = shapes_of(machine, speed, flexible=flexible)
    return root_locus(speeds, branches, running_speed=speed, shapes=shapes, bearing=machine.bearing)


def machines():
    stiff = PRESETS["sheet-1e8"].machine
    yield pytest.param(stiff, False, 4, id="rigid")
    yield pytest.param(stiff, True, 6, id="flexible")
    heavy = replace(stiff.rotor, journal_mass=20.0, disk_damping=300.0)
    yield pytest.param(replace(stiff, rotor=heavy), True, 8, id="journal mass")
    yield pytest.param(replace(stiff, load=0.0), True, 6, id="no load")


@pytest.mark.parametrize(("machine", "flexible", "states"), list(machines()))
def test_vectors_are_eigenvectors_of_the_state_matrix(machine, flexible, states):
    speed = np.array([500.0, 3000.0, 9000.0]) * RPM
    state = equilibrium(machine, speed)
    K, C = state.stiffness, state.damping
    shapes = modes.mode_shapes(machine.rotor, K, C, flexible=flexible)
    A = modes.state_matrix(machine.rotor, K, C, flexible=flexible)
    assert shapes.vectors.shape == (3, states, states)
    moved, scaled = A @ shapes.vectors, shapes.eigenvalues[:, None, :] * shapes.vectors
    size = np.linalg.norm(A, axis=(-2, -1))[:, None] * np.linalg.norm(shapes.vectors, axis=-2)
    assert np.max(np.linalg.norm(moved - scaled, axis=-2) / size) < 1e-13


@pytest.mark.parametrize(("machine", "flexible", "states"), list(machines()))
def test_velocities_are_the_displacements_times_lambda(machine, flexible, states):
    shapes = shapes_of(machine, 5000 * RPM, flexible=flexible)
    start = {4: 2, 6: 4, 8: 4}[states]
    disk_velocity = shapes.vectors[start : start + 2].T
    expected = shapes.eigenvalues[:, None] * shapes.disk
    assert disk_velocity == pytest.approx(expected, rel=1e-6, abs=1e-6 * np.abs(expected).max())


@pytest.mark.parametrize(("machine", "flexible", "states"), list(machines()))
def test_the_largest_displacement_is_one(machine, flexible, states):
    shapes = shapes_of(machine, 5000 * RPM, flexible=flexible)
    largest = np.maximum(np.abs(shapes.disk), np.abs(shapes.journal)).max(axis=-1)
    assert largest == pytest.approx(np.ones(states))


def test_shaft_and_film_carry_the_same_force():
    machine = PRESETS["sheet-1e7"].machine
    state = equilibrium(machine, 4000 * RPM)
    shapes = shapes_of(machine, 4000 * RPM)
    film = (state.stiffness + shapes.eigenvalues[:, None, None] * state.damping) @ shapes.journal[
        ..., None
    ]
    shaft = machine.rotor.shaft_stiffness * (shapes.disk - shapes.journal)
    assert film[..., 0] == pytest.approx(shaft, rel=1e-8, abs=1e-6 * np.abs(shaft).max())


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("part", ["disk", "journal"])
def test_the_unstable_mode_turns_forward_around_the_threshold(name, part):
    machine = PRESETS[name].machine
    onset = onset_speed(machine)
    for speed in (0.99, 1.0, 1.01):
        shapes = shapes_of(machine, speed * onset.speed)
        whirl = np.argmin(np.abs(shapes.eigenvalues - 1j * onset.whirl_frequency))
        phasors = getattr(shapes, part)[whirl]
        orbit = orbit_ellipse(phasors[0], phasors[1])
        assert orbit.semi_minor > 0.7 * orbit.semi_major


def test_a_rigid_rotors_disk_is_its_journal():
    shapes = shapes_of(PRESETS["fig-5-2"].machine, 3000 * RPM)
    assert np.array_equal(shapes.disk, shapes.journal)


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("speed", [0.1, 0.4, 1.0])
def test_locus_has_each_mode_once_and_the_running_speed_in_the_same_order(name, speed):
    preset = PRESETS[name]
    top = preset.top_speed
    locus = locus_of(preset.machine, speed * top, top)
    assert np.all((locus.branches.imag >= 0.0) | np.isnan(locus.branches))
    here = locus.here.eigenvalues
    place = np.argmin(np.abs(locus.speed - speed * top))
    shown = np.isfinite(locus.branches[place])
    near = np.abs(locus.branches[place][shown] - here[shown])
    assert np.all(near < 0.2 * np.abs(here[shown]))
    # every mode of the machine, or its mirror image, stands somewhere
    for value in shapes_of(preset.machine, speed * top).eigenvalues:
        assert np.min(np.abs(here - complex(value.real, abs(value.imag)))) < 1e-9 * abs(value)


def test_branches_keep_their_kind_beside_far_eigenvalues_that_move_fast():
    # real ones that fall from 1e5 to 1e4 1/s at the first speeds, where the whirl's are near 10
    preset = PRESETS["fig-5-2"]
    speeds = np.linspace(preset.top_speed / 240, preset.top_speed, 240)
    branches = modes.follow_branches(analyse(preset.machine, speeds).flexible_eigenvalues)
    assert np.all(branches[:, 0].imag > 0.0)
    assert np.array_equal(branches[:, 0].conj(), branches[:, 3])


def test_two_real_eigenvalues_that_meet_continue_as_one_oscillating_mode():
    preset = PRESETS["fig-5-2"]
    locus = locus_of(preset.machine, preset.speed, preset.top_speed)
    assert locus.branches.shape[1] == 3
    second, third = locus.branches[:, 1], locus.branches[:, 2]
    assert np.all(np.isfinite(second))
    assert second[0].imag == 0.0
    assert second[-1].imag > 0.0
    assert np.isnan(third[-1])


def test_the_least_damped_mode_is_the_one_that_becomes_unstable():
    machine = PRESETS["sheet-1e7"].machine
    onset = onset_speed(machine)
    locus = locus_of(machine, onset.speed, 2 * onset.speed)
    lead = locus.here.eigenvalues[locus.least_damped]
    assert lead.imag == pytest.approx(onset.whirl_frequency)
    assert lead.real == pytest.approx(0.0, abs=1e-9 * lead.imag)


def test_undamped_frequency_is_the_sheets():
    rotor = PRESETS["sheet-1e8"].machine.rotor
    found = modes.undamped_frequency([1e8, 1e7, -1.0], rotor.half_mass) / RPM
    assert found[:2] == pytest.approx([8186, 2589], abs=0.5)
    assert np.isnan(found[2])


def test_the_rigid_rotor_whirls_at_its_natural_frequency_at_the_onset():
    machine = PRESETS["fig-5-2"].machine
    onset = onset_speed(machine)
    K_eq = analyse(machine, onset.speed).equivalent_stiffness
    found = modes.undamped_frequency(K_eq, machine.rotor.half_mass)
    assert found == pytest.approx(onset.whirl_frequency, rel=1e-9)
