"""Modes followed over a sweep, against brute force: the nearest value in steps of a hundredth."""

import math

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

from rotorcalc import analyse, modes, onset_speed
from tests import machines
from tests.onset import reference

ROWS, FINE = 24, 100


def swept(seed):
    """Return a drawn machine over its onset, or to a drawn top speed."""
    if seed % 2:
        machine, top = machines.drawn(seed)
    else:
        machine = reference.drawn(seed)
        onset = onset_speed(machine).speed
        top = 2.5 * onset if 0.0 < onset < math.inf else 1e3
    return machine, np.linspace(top / ROWS, top, ROWS)


def brute_force(machine, speeds):
    """Return the eigenvalues, each mode followed in steps too short for a doubt."""
    shares = np.linspace(0, 1, FINE, endpoint=False)
    fine = np.append((speeds[:-1, None] + np.diff(speeds)[:, None] * shares).ravel(), speeds[-1])
    rows = analyse(machine, fine).flexible_eigenvalues.copy()
    for i in range(1, len(rows)):
        step = rows[i - 1] - rows[i - 2] if i > 1 else 0.0
        ahead = rows[i - 1] + np.where(np.abs(step) < np.abs(rows[i - 1]) / 3, step, 0.0)
        distance = np.abs(ahead[:, None] - rows[i])
        distance /= np.abs(ahead[:, None]) + np.abs(rows[i])
        rows[i] = rows[i][linear_sum_assignment(distance)[1]]
    return rows[::FINE]


def wrong_steps(followed, expected):
    """Return the steps in which a value is continued by another than in the expected rows."""
    wrong = []
    for i in range(len(followed) - 1):
        place = [int(np.flatnonzero(expected[i] == z)[0]) for z in followed[i]]
        found, right = followed[i + 1], expected[i + 1][place]
        # Of two modes that meet on the real axis either may be either; nor is it to be seen which
        # is which of two that differ by rounding.
        matters = (np.abs(found - right) > 1e-6 * np.abs(right)) & (
            (found.imag == 0.0) == (right.imag == 0.0)
        )
        if np.any(matters & ~((found == right.conj()) & (followed[i].imag == 0.0))):
            wrong.append(i)
    return wrong


# Followed without speeds in between, 0, 2, 6, 9, 12 and 17 are confused in their second step.
@pytest.mark.parametrize("seed", range(20))
def test_each_mode_is_the_one_that_brute_force_follows(seed):
    machine, speeds = swept(seed)
    assert wrong_steps(analyse(machine, speeds).branches(), brute_force(machine, speeds)) == []


def test_branches_of_one_speed_and_of_a_rigid_shaft():
    sweep = analyse(machines.SHEET, 500.0)
    assert sweep.branches().shape == (1, 6)
    assert sweep.branches(flexible=False).shape == (1, 4)
    assert analyse(machines.SHEET, []).branches().shape == (0, 6)
    with pytest.raises(ValueError, match=r"speed: must have the shape \(n,\)"):
        analyse(machines.SHEET, [[1.0, 2.0]]).branches()


def test_points_that_do_not_match_the_rows_are_refused():
    with pytest.raises(ValueError, match=r"at: must have the shape \(2,\), has \(3,\)"):
        modes.follow_branches([[1.0], [2.0]], at=[1.0, 2.0, 3.0])
