"""The energy of every motion balances, and each of its terms is what it says."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import analyse, energy_balance, simulate
from rotorcalc.nonlinear.energy import film_force
from tests.machines import ROTORS, RPM, SHEET, C, balanced

RESOLVED = 512  # samples a revolution, for the instant in which the film takes hold


@pytest.mark.parametrize("rpm", [5000, 11500])
@pytest.mark.parametrize("kind", ROTORS)
def test_energy_balances_over_any_interval(kind, rpm):
    machine, speed = balanced(ROTORS[kind], 0.1 * C), rpm * RPM
    start = analyse(machine, speed).journal_position + np.array([0.1 * C, 0.0])
    motion = simulate(
        machine, speed, revolutions=20, samples_per_revolution=RESOLVED, start=start
    )  # fmt: skip
    balance = energy_balance(machine, motion)
    after = balance.residual[RESOLVED:]
    assert np.abs(after - after[0]).max() < 2e-8 * balance.exchanged
    assert np.abs(balance.residual).max() < 1e-4 * balance.exchanged


@pytest.mark.parametrize("kind", ["rigid", "massless journals"])
def test_energy_balances_in_a_run_up(kind):
    machine = balanced(ROTORS[kind], 0.1 * C)
    motion = simulate(
        machine, 4000 * RPM, revolutions=20, samples_per_revolution=RESOLVED, final_speed=6000 * RPM
    )  # fmt: skip
    balance = energy_balance(machine, motion)
    assert np.abs(balance.residual).max() < 1e-7 * balance.exchanged


def test_a_settled_orbit_takes_from_the_imbalance_and_the_film_what_the_damper_takes():
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


def test_the_film_carries_the_load_at_rest():
    machine = replace(SHEET, rotor=replace(SHEET.rotor, imbalance=0.0))
    motion = simulate(machine, 5000 * RPM, revolutions=1)
    force = film_force(machine, motion)
    assert force == pytest.approx(
        np.tile([-machine.static_load, 0.0], (65, 1)), abs=1e-6 * machine.static_load
    )
