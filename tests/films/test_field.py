"""The film's field, forces and friction, each against the load or the torque that it must give."""

import dataclasses
import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, simpson

from rotorcalc import PRESETS, JournalBearing, Machine, analyse, films
from rotorcalc.coefficients import equilibrium, film_field, film_forces
from rotorcalc.films import short

BEARING = JournalBearing(diameter=0.150, length=0.050, radial_clearance=60e-6)
MACHINES = [(preset.machine, preset.speed) for preset in PRESETS.values()]
THETA = np.linspace(0.0, 2.0 * np.pi, 1441)
ZETA = np.linspace(-0.5, 0.5, 21)
eccentricities = st.floats(0.0, 0.98)
sommerfelds = st.floats(1e-3, 1e4)


def _unloaded(machine: Machine) -> Machine:
    return dataclasses.replace(machine, load=0.0)


@given(sommerfelds)
def test_pressure_seam_integrates_to_the_load(sigma: float) -> None:
    """In X, Y, with no use of θ: at Θ the film pushes the journal towards Θ + π."""
    state = films.film_state(BEARING, sigma)
    start = float(state.attitude_angle)

    def pushed(direction: float) -> float:
        def ring(angle: float) -> float:
            middle = (
                films.film_of(BEARING)
                .field(films.OperatingPoints.at_sommerfeld(BEARING, sigma), angle=angle, zeta=0.0)
                .pressure
            )
            return float(middle) * math.cos(angle - direction)

        edges = (start - math.pi, float(state.peak_angle) - 2.0 * math.pi, start)
        return -sum(
            quad(ring, a, b, epsabs=1e-12, epsrel=1e-9, limit=400)[0]
            for a, b in itertools.pairwise(edges)
        )

    # A parabola over the length holds two thirds of its height.
    load = 0.25 / sigma
    assert 2 / 3 * pushed(0.0) == pytest.approx(-load, rel=1e-6)
    assert 2 / 3 * pushed(math.pi / 2) == pytest.approx(0.0, abs=1e-6 * load)


@pytest.mark.parametrize(("machine", "speed"), MACHINES)
def test_dimensional_field_integrates_to_the_load(machine: Machine, speed: float) -> None:
    field = film_field(machine, speed, theta=THETA, zeta=ZETA)
    line = simpson(field.pressure, x=field.axial_position, axis=1) * machine.bearing.radius
    F_r = simpson(line * np.cos(THETA), x=THETA)
    F_t = simpson(line * np.sin(THETA), x=THETA)
    point = film_forces(machine, speed, sommerfeld=equilibrium(machine, speed).film.sommerfeld)
    assert F_r == pytest.approx(float(point.radial), rel=1e-5)
    assert F_t == pytest.approx(float(point.tangential), rel=1e-5)
    assert math.hypot(F_r, F_t) == pytest.approx(machine.static_load, rel=1e-5)
    # The resultant points against the load: at θ of the load, the way from the film to the journal.
    towards = math.atan2(F_t, F_r) % (2 * math.pi)
    assert towards == pytest.approx(float(field.load_theta), abs=1e-5)


@pytest.mark.parametrize(("machine", "speed"), MACHINES)
def test_field_agrees_with_the_sweep(machine: Machine, speed: float) -> None:
    point = analyse(machine, speed)
    field = film_field(machine, speed, theta=THETA, zeta=ZETA)
    assert field.thickness.min() == pytest.approx(float(point.minimum_film_thickness), rel=1e-12)
    assert field.pressure.max() <= point.peak_pressure * (1 + 1e-12)
    at_peak = film_field(machine, speed, theta=field.peak_theta)
    assert float(at_peak.pressure[0, 0]) == pytest.approx(float(point.peak_pressure), rel=1e-12)
    assert np.all(field.pressure[:, [0, -1]] == 0.0)
    assert np.all(field.pressure[field.cavitated] == 0.0)
    assert list(THETA[field.cavitated][[0, -1]]) == [THETA[721], THETA[1439]]


@given(eccentricities)
def test_peak_is_where_the_pressure_turns(eps: float) -> None:
    peak = float(short.peak_position(eps))
    near = peak + np.array([-1e-4, 1e-4]) * (math.pi - peak)
    assert np.all(short.pressure(eps, near) <= short.peak_pressure(eps))
    H = 1.0 + eps * math.cos(peak)
    assert H * math.cos(peak) + 3.0 * eps * math.sin(peak) ** 2 == pytest.approx(0.0, abs=1e-12)


@given(sommerfelds)
def test_static_force_of_a_state_is_the_closed_form(sigma: float) -> None:
    state = films.film_state(BEARING, sigma)
    expected = short.static_force(state.eccentricity_ratio)
    np.testing.assert_allclose(state.force, expected, rtol=1e-9)


@given(st.sampled_from(MACHINES), st.lists(sommerfelds, min_size=1, max_size=5))
def test_forces_follow_speed_and_meet_the_load(
    case: tuple[Machine, float], sigmas: list[float]
) -> None:
    machine, speed = case
    sigma = np.array(sigmas)
    once, twice = (film_forces(machine, n * speed, sommerfeld=sigma) for n in (1.0, 2.0))
    np.testing.assert_allclose(twice.total, 2.0 * once.total, rtol=1e-12)
    point = film_forces(machine, speed, sommerfeld=analyse(machine, speed).sommerfeld)
    assert float(point.total) == pytest.approx(machine.static_load, rel=1e-12)
    assert float(point.eccentricity_ratio) == analyse(machine, speed).eccentricity_ratio


@pytest.mark.parametrize(("machine", "speed"), MACHINES)
def test_friction_is_the_torque_per_radius_and_load(machine: Machine, speed: float) -> None:
    sweep = analyse(machine, np.array([0.5, 1.0, 2.0]) * speed)
    product = sweep.friction_coefficient * machine.static_load * machine.bearing.radius
    np.testing.assert_allclose(product * sweep.speed, sweep.power_loss, rtol=1e-12)
    np.testing.assert_allclose(sweep.drag_torque * sweep.speed, sweep.power_loss, rtol=1e-12)


@pytest.mark.parametrize(("machine", "speed"), MACHINES)
def test_friction_of_a_light_load_is_petroff(machine: Machine, speed: float) -> None:
    light = dataclasses.replace(machine, load=1e-3)
    R, L, C = light.bearing.radius, light.bearing.length, light.bearing.radial_clearance
    petroff = 2.0 * math.pi * light.viscosity * speed * R**2 * L / (C * 1e-3)
    assert float(analyse(light, speed).friction_coefficient) == pytest.approx(petroff, rel=1e-6)


@pytest.mark.parametrize(("machine", "speed"), MACHINES)
def test_without_load_there_is_no_pressure_and_no_friction_coefficient(
    machine: Machine, speed: float
) -> None:
    free = _unloaded(machine)
    point = analyse(free, speed)
    field = film_field(free, speed, theta=THETA, zeta=ZETA)
    assert point.friction_coefficient == math.inf
    assert point.drag_torque > 0.0
    assert point.peak_pressure == 0.0
    assert np.all(field.pressure == 0.0)
    np.testing.assert_allclose(field.thickness, machine.bearing.radial_clearance, rtol=1e-15)
    forces = film_forces(free, speed, sommerfeld=math.inf)
    assert forces.total == forces.radial == forces.tangential == 0.0


def test_field_refuses_places_outside_the_bearing() -> None:
    with pytest.raises(ValueError, match="zeta"):
        films.film_of(BEARING).field(
            films.OperatingPoints.at_sommerfeld(BEARING, 1.0), angle=0.0, zeta=0.6
        )
    with pytest.raises(ValueError, match="speed"):
        film_field(MACHINES[0][0], 0.0, theta=0.0)
