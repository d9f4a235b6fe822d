"""Nonlinear motion on films of finite length: linear theory, energy, the short film, whirl."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import TransientError, analyse, energy_balance, onset_speed, simulate
from rotorcalc.films import film_of
from rotorcalc.geometry import AxialGrooves, Elliptical, MultiDam, Plain, PressureDam
from rotorcalc.nonlinear.collocation import Balance
from rotorcalc.nonlinear.continuation import small_cycle
from rotorcalc.nonlinear.hopf import hopf
from rotorcalc.nonlinear.measured_onset import measured_growth
from rotorcalc.nonlinear.release import release
from tests.machines import ROTORS, SHEET, C

TABLED = [Plain(), AxialGrooves(), Elliptical()]
MOVED = ["rigid", "massless journals", "journal mass, damped"]
ALL = pytest.mark.parametrize("geometry", [*TABLED, PressureDam(), MultiDam()])
KINDS = pytest.mark.parametrize("kind", MOVED)
SPEED = 500.0


def machine_on(geometry, kind="rigid", *, imbalance=0.0, ratio=0.5, film="finite"):
    """Return the sheet's machine with another bore and length."""
    bearing = replace(SHEET.bearing, geometry=geometry, film=film, length=0.15 * ratio)
    return replace(SHEET, bearing=bearing, rotor=replace(ROTORS[kind], imbalance=imbalance))


@ALL
@KINDS
def test_a_small_whirl_grows_as_the_eigenvalues_say(geometry, kind):
    machine = machine_on(geometry, kind)
    values = analyse(machine, SPEED).flexible_eigenvalues
    expected = max((value for value in values if value.imag > 0.0), key=lambda value: value.real)
    assert abs(measured_growth(machine, SPEED) - expected.real) < 5e-3 * abs(expected)


@ALL
@KINDS
def test_a_balanced_journal_rests_where_it_is_in_equilibrium(geometry, kind):
    machine = machine_on(geometry, kind)
    rest = analyse(machine, SPEED).journal_position
    motion = simulate(machine, SPEED, revolutions=1, tolerance=1e-6)
    assert np.abs(motion.journal - rest).max() < 1e-3 * C


# A wide motion over pockets takes seconds.
@pytest.mark.parametrize(("geometry", "kind"), [
    *((geometry, kind) for geometry in TABLED for kind in MOVED),
    (PressureDam(), "massless journals"),
    (MultiDam(), "massless journals"),
])  # fmt: skip
def test_the_energy_of_a_wide_motion_balances(geometry, kind):
    machine = machine_on(geometry, kind, imbalance=0.05 * C)
    rest = analyse(machine, SPEED).journal_position
    motion = simulate(machine, SPEED, revolutions=1, start=rest + np.array([-0.3, 0.1]) * C)
    balance = energy_balance(machine, motion)
    assert np.abs(balance.residual).max() < 1e-6 * balance.exchanged


def test_a_very_short_plain_bearing_moves_as_the_short_film_lets_it():
    """Both lengths carry the same load per length: their orbits differ by the order of (L/D)²."""
    apart = []
    for ratio in (0.2, 0.1):
        paths = []
        for film in ("finite", "short"):
            # σ, and the mass over the film's force, stay as they are.
            share = (2.0 * ratio) ** 3
            rotor = replace(ROTORS["rigid"], mass=SHEET.rotor.mass * share)
            machine = replace(machine_on(Plain(), ratio=ratio, film=film), rotor=rotor)
            start = (0.4 * C, -0.2 * C)
            paths.append(simulate(machine, SPEED, revolutions=3, start=start).journal)
        apart.append(float(np.abs(paths[0] - paths[1]).max()) / C)
    assert apart[0] < 0.1
    assert apart[1] < 0.4 * apart[0]


def test_small_limit_cycles_begin_at_the_linear_onset():
    machine = machine_on(AxialGrooves())
    onset, balance = hopf(machine), Balance(machine)
    assert onset.speed == pytest.approx(onset_speed(machine).speed)
    cycles = [small_cycle(balance, onset, size) for size in (0.01, 0.02)]
    for cycle in cycles:
        assert cycle.speed == pytest.approx(onset.speed, rel=5e-3)
        assert cycle.ratio * cycle.speed == pytest.approx(onset.whirl_frequency, rel=5e-3)


def test_a_motion_ends_where_the_film_is_thinner_than_computed():
    machine = machine_on(Plain())
    too_heavy = replace(machine, load=1e7)
    with pytest.raises(TransientError, match=r"closer to the wall than 0\.02 of the clearance"):
        simulate(too_heavy, SPEED, revolutions=5, start=(0.0, 0.5 * C), tolerance=1e-6)
    thin = film_of(machine.bearing).outline(np.array(1.0)) * 0.99 * C
    with pytest.raises(ValueError, match=r"computed down to 0\.02 of the clearance"):
        simulate(machine, SPEED, revolutions=1, start=thin)
    with pytest.raises(ValueError, match="must be at least"):  # no equilibrium to release it from
        release(too_heavy, SPEED, kick=0.1 * C, revolutions=20)
