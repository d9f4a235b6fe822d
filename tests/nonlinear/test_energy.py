"""The energy of every motion balances, and each of its terms is what it says."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotorcalc import analyse, energy_balance, simulate
from tests.machines import ROTORS, RPM, C, balanced, machines


def released(machine, speed, kick, **how):
    """Return the motion of a journal released off its equilibrium, at the default sampling."""
    start = analyse(machine, speed).journal_position + np.asarray(kick) * C
    return simulate(machine, speed, revolutions=20, start=start, **how)


@pytest.mark.parametrize("kick", [(0.1, 0.0), (-0.7, 0.3)])
@pytest.mark.parametrize("rpm", [5000, 11500])
@pytest.mark.parametrize("kind", ROTORS)
def test_energy_balances_from_the_release_on(kind, rpm, kick):
    machine, speed = balanced(ROTORS[kind], 0.1 * C), rpm * RPM
    balance = energy_balance(machine, released(machine, speed, kick))
    assert np.abs(balance.residual).max() < 1e-7 * balance.exchanged


@given(
    machine=machines(damped=True, journals=True),
    rpm=st.floats(1000, 20000),
    distance=st.floats(0.0, 0.95),
    angle=st.floats(0.0, 2.0 * math.pi),
)
@settings(max_examples=20)
def test_energy_balances_after_any_release(machine, rpm, distance, angle):
    start = distance * machine.bearing.radial_clearance * np.exp(1j * angle)
    motion = simulate(machine, rpm * RPM, revolutions=4, start=[start.real, start.imag])
    balance = energy_balance(machine, motion)
    assert np.abs(balance.residual).max() < 1e-3 * balance.exchanged


def test_the_works_do_not_depend_on_how_densely_a_motion_is_sampled():
    machine, speed = balanced(ROTORS["journal mass, damped"], 0.1 * C), 5000 * RPM
    dense, coarse = (
        energy_balance(machine, released(machine, speed, (-0.6, 0.0), samples_per_revolution=n))
        for n in (64, 4)
    )
    for name in ("imbalance_work", "film_loss", "damper_loss"):
        assert getattr(coarse, name) == pytest.approx(
            getattr(dense, name)[::16], abs=1e-7 * dense.exchanged
        )


def test_the_residual_is_the_error_of_a_motion_integrated_loosely():
    machine, speed = balanced(ROTORS["massless journals"], 0.1 * C), 5000 * RPM
    loose, fine = (
        energy_balance(machine, released(machine, speed, (-0.6, 0.0), tolerance=tolerance))
        for tolerance in (1e-5, 1e-10)
    )
    assert np.abs(loose.residual).max() > 100.0 * np.abs(fine.residual).max()


@pytest.mark.parametrize("kind", ["rigid", "massless journals"])
def test_energy_balances_in_a_run_up(kind):
    machine = balanced(ROTORS[kind], 0.1 * C)
    motion = simulate(machine, 4000 * RPM, revolutions=20, final_speed=6000 * RPM)
    balance = energy_balance(machine, motion)
    assert np.abs(balance.residual).max() < 1e-7 * balance.exchanged


def test_a_settled_orbit_loses_in_film_and_damper_the_work_of_the_imbalance():
    machine, speed = balanced(ROTORS["damped"], 0.05 * C), 5000 * RPM
    motion = simulate(machine, speed, revolutions=60)
    balance = energy_balance(machine, motion)
    turn = slice(-65, None, 64)
    over = {
        name: np.diff(getattr(balance, name)[turn])[0]
        for name in ("imbalance_work", "load_work", "kinetic", "strain", "film_loss", "damper_loss")
    }
    assert over["imbalance_work"] == pytest.approx(
        over["film_loss"] + over["damper_loss"], rel=1e-6
    )
    for stored in ("load_work", "kinetic", "strain"):
        assert abs(over[stored]) < 1e-6 * over["imbalance_work"]
    assert over["damper_loss"] > 0.0
    # C_s ∮ v² dt of the linear ellipse, a circle's with its two semi-axes.
    X, Y = analyse(machine, speed).disk_response
    linear = np.pi * machine.rotor.disk_damping * speed * (abs(X) ** 2 + abs(Y) ** 2)
    assert over["damper_loss"] == pytest.approx(linear, rel=0.05)


def test_past_the_onset_the_film_feeds_the_whirl():
    machine, speed = balanced(ROTORS["rigid"]), 11500 * RPM
    start = analyse(machine, speed).journal_position + np.array([0.01 * C, 0.0])
    balance = energy_balance(machine, simulate(machine, speed, revolutions=30, start=start))
    fed = balance.load_work - balance.film_loss
    assert fed[-64:].mean() > 2.0 * fed[640:704].mean() > 0.0
    assert not balance.damper_loss.any()
    assert not balance.imbalance_work.any()
