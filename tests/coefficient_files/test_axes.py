"""Axes of a file: what they change, what they cannot change, and what looks wrong in them."""

import itertools

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse, read_coefficients
from rotorcalc.coefficient_files import written
from rotorcalc.coefficient_files.axes import LOAD_AXES, TURNS
from tests.coefficient_files.tables import SPEED, C, K, same

EVERY = list(itertools.product(LOAD_AXES, TURNS))


def _in_axes(coefficients, load_axis, turns):
    """Return coefficients in a user's axes, by the displacement and force of a moving journal.

    Unlike the program, which multiplies matrices, this moves a journal along each axis of the user.
    """
    X = np.array(LOAD_AXES[load_axis])
    turned = complex(*X) * (1j if turns == "x to y" else -1j)
    Y = np.array([turned.real, turned.imag])
    out = np.empty_like(coefficients)
    for j, step in enumerate(np.eye(2)):
        moved = np.array([step @ X, step @ Y])
        force = coefficients @ moved
        out[..., j] = force[..., :1] * X + force[..., 1:] * Y
    return out


@pytest.mark.parametrize(("load_axis", "turns"), EVERY)
def test_a_table_in_any_axes_comes_into_those_of_the_load(load_axis, turns):
    file = written(SPEED, *(_in_axes(part, load_axis, turns) for part in (K, C)))
    read = read_coefficients(file, load_axis=load_axis, turns=turns)
    same(read, rtol=0.0)
    assert not read.warnings


@pytest.mark.parametrize(("load_axis", "turns"), EVERY)
def test_eigenvalues_do_not_depend_on_axes(load_axis, turns):
    """λ² M + λ C + K has them: a journal of 5 tonnes, at each speed."""
    read = read_coefficients(written(SPEED, K, C), load_axis=load_axis, turns=turns)
    for before, after in zip(_eigenvalues(K, C), _eigenvalues(read.stiffness, read.damping),
                             strict=True):  # fmt: skip
        np.testing.assert_allclose(np.poly(after), np.poly(before), rtol=1e-9)


def _eigenvalues(K, C):
    n, one = len(K), np.broadcast_to(np.eye(2), K.shape)
    state = np.block([[np.zeros((n, 2, 2)), one], [-K / 5e3, -C / 5e3]])
    return np.linalg.eigvals(state)


def test_the_wrong_sense_of_rotation_turns_the_sign_of_the_cross_coupling_and_is_said():
    file = written(SPEED, K, C)
    right, wrong = (read_coefficients(file, turns=turns) for turns in TURNS)
    mirrored = right.stiffness * [[1.0, -1.0], [-1.0, 1.0]]
    np.testing.assert_array_equal(wrong.stiffness, mirrored)
    assert not right.warnings
    [said] = wrong.warnings
    assert "against the rotation" in said


def test_a_load_along_the_other_axis_is_doubted_and_negative_damping_said():
    file = written(SPEED, K * [[2.0, 1.0], [1.0, 1.0]], C - 2e6 * np.eye(2))
    said = " ".join(read_coefficients(file, load_axis="-y").warnings)
    assert "much stiffer across the load" in said
    assert "damping is negative in one direction" in said
    assert "At 3 of 3 speeds" in said


@pytest.mark.parametrize("preset", PRESETS)
def test_the_program_doubts_none_of_its_own_films(preset):
    sweep = analyse(PRESETS[preset].machine, np.geomspace(50.0, 2000.0, 20))
    assert not read_coefficients(written(sweep.speed, sweep.stiffness, sweep.damping)).warnings


def test_a_file_can_say_its_axes_and_what_is_given_counts_more():
    file = written(SPEED, K, C)
    assert read_coefficients(file).said_axes == ("+x", "x to y")
    drawn = file.replace("along +x", "along -y").replace("from x to y", "from y to x")
    given = read_coefficients(file, load_axis="-y", turns="y to x")
    said = read_coefficients(drawn)
    assert said.said_axes == ("-y", "y to x")
    np.testing.assert_array_equal(said.stiffness, given.stiffness)
    assert np.any(said.stiffness != K)
    same(read_coefficients(drawn, load_axis="+x", turns="x to y"), rtol=0.0)
    assert read_coefficients(file[file.index("speed [") :]).said_axes is None


def test_unknown_axes_are_refused():
    file = written(SPEED, K, C)
    with pytest.raises(ValueError, match="load_axis = 'down': must be '\\+x' or"):
        read_coefficients(file, load_axis="down")
    with pytest.raises(ValueError, match="turns = 'left': must be"):
        read_coefficients(file, turns="left")
