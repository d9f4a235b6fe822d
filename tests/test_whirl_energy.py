"""The energy of the whirl, against quadrature and the modes' growth."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc import (
    Machine,
    modes,
    onset_speed,
    whirl_energy,
)
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.coefficients import equilibrium
from rotorcalc.onset import Onset
from tests.films.models import RINGS
from tests.machines import MACHINES, SHEET, with_rotor

finite = st.floats(-10.0, 10.0)
numbers = st.tuples(finite, finite, finite, finite)


each_machine = pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES.keys())


def _orbit(x: ComplexArray, frequency: float) -> tuple[Array, Array, float]:
    """Return positions and velocities over one turn, and the step of time."""
    t = np.arange(64) * 2.0 * np.pi / frequency / 64
    wave = np.exp(1j * frequency * t)[:, None]
    return (x * wave).real, (1j * frequency * x * wave).real, float(t[1])


@given(K=numbers, C=numbers, x=numbers, frequency=st.floats(0.1, 100.0))
def test_work_is_the_integral_of_force_times_velocity_over_a_turn(
    K: tuple[float, ...], C: tuple[float, ...], x: tuple[float, ...], frequency: float
) -> None:
    stiffness, damping = np.reshape(K, (2, 2)), np.reshape(C, (2, 2))
    orbit = np.array([x[0] + 1j * x[1], x[2] + 1j * x[3]])
    position, velocity, dt = _orbit(orbit, frequency)
    by_stiffness = -np.sum((position @ stiffness.T) * velocity) * dt
    by_damping = np.sum((velocity @ damping.T) * velocity) * dt
    tolerance = 1e-12 * (1.0 + np.sum(np.abs(orbit)) ** 2) * max(1.0, frequency) * 1e3
    assert whirl_energy.stiffness_work(stiffness, orbit) == pytest.approx(
        by_stiffness, abs=tolerance
    )
    assert whirl_energy.damping_work(damping, orbit, frequency) == pytest.approx(
        by_damping, abs=tolerance
    )


@given(x=numbers)
def test_orbit_area_is_that_of_the_polygon_through_the_orbit(x: tuple[float, ...]) -> None:
    orbit = np.array([x[0] + 1j * x[1], x[2] + 1j * x[3]])
    position, velocity, dt = _orbit(orbit, 1.0)
    area = np.sum(position[:, 0] * velocity[:, 1]) * dt
    assert whirl_energy.orbit_area(orbit) == pytest.approx(
        area, abs=1e-11 * (1.0 + np.abs(orbit).max() ** 2)
    )


def test_orbit_area_distinguishes_forward_from_backward() -> None:
    assert whirl_energy.orbit_area([1.0, -1.0j]) == pytest.approx(np.pi)
    assert whirl_energy.orbit_area([1.0, 1.0j]) == pytest.approx(-np.pi)


@each_machine
def test_gain_and_loss_meet_at_the_onset(machine: Machine) -> None:
    onset = onset_speed(machine)
    energy = whirl_energy.whirl_energy(
        machine, onset.speed, whirl_energy.whirl_orbit(machine, onset)
    )
    loss = energy.film_loss + energy.disk_loss
    assert energy.fed_in == pytest.approx(loss, rel=1e-9)
    assert energy.fed_in > 0.0
    assert (energy.disk_loss > 0.0) == (machine.rotor.disk_damping > 0.0)


@pytest.mark.parametrize("name", ["floating ring", "floating ring, heavy"])
def test_gain_and_loss_meet_at_the_onset_of_a_film_that_depends_on_the_whirl(name: str) -> None:
    machine = replace(SHEET, bearing=RINGS[name])
    onset = onset_speed(machine)
    orbit = whirl_energy.whirl_orbit(machine, onset)
    energy = whirl_energy.whirl_energy(machine, np.array([0.5, 1.0]) * onset.speed, orbit)
    loss = energy.film_loss + energy.disk_loss
    assert energy.fed_in[1] == pytest.approx(loss[1], rel=1e-7)
    assert energy.fed_in[0] < loss[0]
    # With the film's synchronous coefficients they do not meet.
    state = equilibrium(machine, onset.speed)
    other = whirl_energy.stiffness_work(state.stiffness, orbit.journal)
    assert other != pytest.approx(float(energy.fed_in[1]), rel=0.1)


@each_machine
@pytest.mark.parametrize("factor", [0.3, 0.9, 1.0, 1.3])
def test_energy_gain_minus_loss_gives_every_modes_growth(machine: Machine, factor: float) -> None:
    """Hold the identity in `whirl_energy`'s notes, on shapes from the eigenvectors."""
    rotor, state = machine.rotor, equilibrium(machine, factor * onset_speed(machine).speed)
    shapes = modes.mode_shapes(rotor, state.stiffness, state.damping)
    for lam, disk, journal in zip(shapes.eigenvalues, shapes.disk, shapes.journal, strict=True):
        if lam.imag <= 0.0:
            continue
        gain = whirl_energy.stiffness_work(state.stiffness, journal)
        loss = whirl_energy.damping_work(
            state.damping, journal, lam.imag
        ) + whirl_energy.damping_work(rotor.disk_damping * np.eye(2), disk, lam.imag)
        moved = rotor.journal_mass * np.abs(journal) ** 2 + rotor.disk_mass * np.abs(disk) ** 2
        growth = 2.0 * np.pi * lam.imag * lam.real * moved.sum()
        assert gain - loss == pytest.approx(growth, abs=1e-7 * (abs(gain) + abs(loss)))


def test_the_orbit_of_the_onset_solves_the_equation_of_whirl() -> None:
    """Eq. 5.43: the film's force balances the rotor's inertia on the orbit."""
    machine = with_rotor(shaft_stiffness=math.inf)
    onset = onset_speed(machine)
    orbit, state = whirl_energy.whirl_orbit(machine, onset), equilibrium(machine, onset.speed)
    Z = state.stiffness + 1j * onset.whirl_frequency * state.damping
    inertia = machine.rotor.half_mass * onset.whirl_frequency**2
    np.testing.assert_allclose(Z @ orbit.journal, inertia * orbit.journal, rtol=1e-9)
    np.testing.assert_allclose(orbit.disk, orbit.journal, rtol=1e-12)
    assert whirl_energy.orbit_area(orbit.journal) == pytest.approx(1.0)


def test_without_load_damping_dissipates_nothing() -> None:
    machine = replace(SHEET, load=0.0)
    orbit = whirl_energy.whirl_orbit(machine, onset_speed(machine))
    energy = whirl_energy.whirl_energy(machine, np.array([10.0, 100.0]), orbit)
    assert np.all(energy.fed_in > 0.0)
    assert np.all(energy.film_loss == 0.0)


def test_without_onset_there_is_no_orbit() -> None:
    never = Onset(
        speed=math.inf,
        whirl_frequency=math.nan,
        eccentricity_ratio=math.nan,
        method="polynomial",
    )
    with pytest.raises(ValueError, match="without an onset"):
        whirl_energy.whirl_orbit(SHEET, never)
