"""Stability by the characteristic polynomial: the verdict of the eigenvalues, faster."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from rotorcalc import modes
from rotorcalc.coefficients import stiffness_and_damping
from rotorcalc.numerics import routh
from tests.machines import BENDING, RPM, machines, with_rotor

SPEEDS = np.linspace(500, 20000, 40) * RPM


def is_unstable(rotor, K, C):
    return routh.margin(modes.characteristic_polynomial(rotor, K, C)) > 0.0


@settings(max_examples=60)
@given(machines(stiffness=BENDING, damped=True, journals=True))
def test_the_verdict_is_that_of_the_refined_eigenvalues(machine):
    K, C = stiffness_and_damping(machine, SPEEDS)
    values = modes.refined_eigenvalues(machine.rotor, K, C)
    growth = np.nanmax(values.real, axis=-1)
    clear = np.abs(growth) > 1e-12 * np.nanmax(np.abs(values), axis=-1)
    assert np.array_equal(is_unstable(machine.rotor, K, C)[clear], (growth > 0.0)[clear])


@pytest.mark.parametrize("stiffness", [math.inf, 1e8])
def test_an_unloaded_rotor_without_damper_is_stable_at_no_speed(stiffness):
    machine = replace(with_rotor(shaft_stiffness=stiffness), load=0.0)
    assert np.all(is_unstable(machine.rotor, *stiffness_and_damping(machine, SPEEDS)))


def test_with_a_light_journal_stability_still_changes_once():
    """One rate is then a million times the others."""
    machine = with_rotor(journal_mass=1e-4)
    at = 9000 * RPM * np.linspace(0.98, 1.0, 1001)  # its onset lies there
    unstable = is_unstable(machine.rotor, *stiffness_and_damping(machine, at))
    assert not unstable[0]
    assert unstable[-1]
    assert np.count_nonzero(np.diff(unstable)) == 1


def test_a_crossing_is_judged_as_both_of_its_ends_are():
    machine = with_rotor(disk_damping=5e3, journal_mass=10.0)
    K, C = stiffness_and_damping(machine, np.linspace(3000, 20000, 12) * RPM)
    polynomials = modes.characteristic_polynomial(machine.rotor, K, C)
    judged = [[routh.surely_between(a, b) for a in polynomials] for b in polynomials]
    decays = routh.margin_bounds(polynomials)[1] <= 0.0
    crossed = routh.surely_crossed(polynomials)
    assert np.array_equal(judged, crossed[:, None] & decays)
    assert crossed.any()
    assert decays.any()
