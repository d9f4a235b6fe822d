"""The film of a machine with its dimensions: scaling, units, shapes, and what is no speed."""

import math
from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotorcalc import JournalBearing, Machine, Oil, Rotor, analyse, coefficients, onset_speed
from rotorcalc.coefficients import (
    BULK_FLOW,
    LAMINAR,
    equilibrium,
    film_field,
    film_forces,
    middle_pressure,
    modified_sommerfeld,
    stiffness_and_damping,
    unloading,
)
from rotorcalc.films import short
from rotorcalc.frames import rotate
from tests.machines import EPS, RPM, SHEET, farthest, log_uniform, machines

speeds = st.floats(10.0, 3000.0)


def units(machine):
    bearing, mu = machine.bearing, machine.viscosity
    return mu, bearing.radius, bearing.length, bearing.radial_clearance


@given(machines(load=log_uniform(1, 1e6)), speeds)
def test_sommerfeld_number_is_that_of_equation_5_8(machine, speed):
    mu, R, L, C = units(machine)
    sigma = modified_sommerfeld(machine, speed)
    assert sigma * 4 * machine.static_load * C**2 == pytest.approx(
        mu * speed * L**3 * R, rel=16 * EPS
    )


@given(machines(), st.lists(speeds, min_size=1, max_size=4))
def test_coefficients_alone_are_those_of_the_equilibrium(machine, several):
    K, C = stiffness_and_damping(machine, several)
    state = equilibrium(machine, several)
    assert np.array_equal(K, state.stiffness)
    assert np.array_equal(C, state.damping)


@given(machines(), speeds)
def test_film_carries_the_load(machine, speed):
    """Eq. 5.5 at the equilibrium's ε = F_o, along −X."""
    mu, R, L, C = units(machine)
    state = equilibrium(machine, speed)
    force = short.static_force(state.film.eccentricity_ratio) * mu * speed * R * L**3 / C**2
    # ε is right to EPS, the film's thickness to EPS/(1 − ε).
    error = 1e-14 + 16 * EPS / float(state.film.minimum_thickness)
    assert np.linalg.norm(force) == pytest.approx(machine.static_load, rel=4 * error)
    phi = state.film.attitude_angle
    assert force[0] * np.cos(phi) - force[1] * np.sin(phi) == pytest.approx(
        -machine.static_load, rel=4 * error
    )


@given(machines(), speeds)
def test_coefficients_are_the_radial_ones_with_their_dimensions(machine, speed):
    """Eqs. 5.30 and 5.31 as printed, turned by Eq. 5.16."""
    mu, R, L, C = units(machine)
    state = equilibrium(machine, speed)
    eps, phi = state.film.eccentricity_ratio, state.film.attitude_angle
    K = mu * R * L**3 * speed / C**3 * rotate(short.radial_stiffness(eps), phi)
    damping = mu * R * L**3 / C**3 * rotate(short.radial_damping(eps), phi)
    error = 64 * EPS / float(state.film.minimum_thickness)
    assert state.stiffness == pytest.approx(K, abs=error * np.abs(K).max())
    assert state.damping == pytest.approx(damping, abs=error * np.abs(damping).max())


@given(machines(), speeds)
def test_coefficients_in_units_of_the_load_are_those_of_equation_5_32(machine, speed):
    state = equilibrium(machine, speed)
    C, load = machine.bearing.radial_clearance, machine.static_load
    error = 64 * EPS / float(state.film.minimum_thickness)
    k, c = state.film.k, state.film.c
    assert state.stiffness * C / load == pytest.approx(k, abs=error * np.abs(k).max())
    assert state.damping * C * speed / load == pytest.approx(c, abs=error * np.abs(c).max())


@given(machines(), speeds)
def test_power_flow_and_film_have_their_dimensions(machine, speed):
    mu, R, L, C = units(machine)
    state = equilibrium(machine, speed)
    eps, phi = float(state.film.eccentricity_ratio), float(state.film.attitude_angle)
    couple = 0.5 * eps * C * machine.static_load * math.sin(phi)
    torque = 2 * math.pi * mu * speed * R**3 * L / (C * math.sqrt((1 - eps) * (1 + eps))) + couple
    error = 1e-13 + 64 * EPS / (1 - eps)
    assert state.drag_torque == pytest.approx(torque, rel=error)
    assert state.power_loss == pytest.approx(torque * speed, rel=error)
    assert state.friction_coefficient == pytest.approx(torque / R / machine.static_load, rel=error)
    assert state.side_flow == pytest.approx(speed * R * L * C * eps, rel=16 * EPS)
    assert state.minimum_film_thickness == pytest.approx(C * (1 - eps), rel=error)


def test_petroffs_torque_without_load():
    """A centred journal in its film: 2πμΩR³L/C."""
    mu, R, L, C = units(SHEET)
    state = equilibrium(replace(SHEET, load=0.0), 600.0)
    assert state.drag_torque == pytest.approx(2 * math.pi * mu * 600 * R**3 * L / C, rel=8 * EPS)
    assert state.friction_coefficient == math.inf


# Units


def scaled(machine, length, mass, time):
    """Return the same machine in other units; the given load keeps gravity out of it."""
    oil, bearing, rotor = machine.oil, machine.bearing, machine.rotor
    return Machine(
        oil=Oil(
            reference_viscosity=oil.reference_viscosity * mass / (length * time),
            reference_temperature=oil.reference_temperature,
            temperature_coefficient=oil.temperature_coefficient,
            density=oil.density * mass / length**3,
        ),
        bearing=JournalBearing(
            diameter=bearing.diameter * length,
            length=bearing.length * length,
            radial_clearance=bearing.radial_clearance * length,
        ),
        rotor=Rotor(
            mass=rotor.mass * mass,
            shaft_stiffness=rotor.shaft_stiffness * mass / time**2,
            imbalance=rotor.imbalance * length,
            disk_damping=rotor.disk_damping * mass / time,
            journal_mass=rotor.journal_mass * mass,
        ),
        temperature=machine.temperature,
        load=machine.static_load * mass * length / time**2,
    )


# Exponents of length, mass and time in the dimension of each field of a Sweep.
DIMENSIONS = {
    "speed": (0, 0, -1),
    "sommerfeld": (0, 0, 0),
    "journal_position": (1, 0, 0),
    "eccentricity_ratio": (0, 0, 0),
    "attitude_angle": (0, 0, 0),
    "minimum_film_thickness": (1, 0, 0),
    "power_loss": (2, 1, -3),
    "side_flow": (3, 0, -1),
    "drag_torque": (2, 1, -2),
    "friction_coefficient": (0, 0, 0),
    "peak_pressure": (-1, 1, -2),
    "viscosity": (-1, 1, -1),
    "stiffness": (0, 1, -2),
    "damping": (0, 1, -1),
    "equivalent_stiffness": (0, 1, -2),
    "whirl_ratio": (0, 0, 0),
    "critical_mass": (0, 1, 0),
    "rigid_threshold": (0, 0, -1),
    "flexible_threshold": (0, 0, -1),
    "rigid_eigenvalues": (0, 0, -1),
    "flexible_eigenvalues": (0, 0, -1),
    "disk_response": (1, 0, 0),
    "journal_response": (1, 0, 0),
}
# Rounding of ε where the film is thin, and of small differences near a resonance.
UNIT_ERROR = 1e-10


def test_every_result_has_its_dimension():
    sweep = analyse(SHEET, 600.0)
    later = {"rigid_eigenvalues", "flexible_eigenvalues"}
    # Temperatures have a unit of their own, in which the film's given one does not change.
    given = {"machine", "temperature", "outlet_temperature"}
    assert {field.name for field in fields(sweep)} | later == {*given, *DIMENSIONS}


@settings(max_examples=40)
@given(
    machines(damped=True, journals=True),
    st.floats(0.02, 1.0),
    st.tuples(log_uniform(1e-3, 1e3), log_uniform(1e-3, 1e3), log_uniform(1e-3, 1e3)),
)
def test_all_results_follow_the_units(machine, share, scales):
    """Nothing but the weight, which the load replaces, knows a metre, a kilogram or a second."""
    speed = share * 6000 * RPM
    here = analyse(replace(machine, load=machine.static_load), speed)
    there = analyse(scaled(machine, *scales), speed / scales[2])
    for name, powers in DIMENSIONS.items():
        unit = math.prod(s**p for s, p in zip(scales, powers, strict=True))
        one, other = np.asarray(getattr(here, name)), np.asarray(getattr(there, name)) / unit
        if name.endswith("eigenvalues"):
            # A matrix eigenvalue rounds as the largest one does.
            assert farthest(one, other) <= 1e4 * EPS * np.abs(one).max(), name
        elif np.all(np.isfinite(one)):
            assert np.abs(one - other).max() <= UNIT_ERROR * np.abs(one).max(), name
        else:
            assert np.array_equal(one, other), name


@settings(max_examples=20)
@given(
    machines(damped=True, journals=True),
    st.tuples(log_uniform(1e-3, 1e3), log_uniform(1e-3, 1e3), log_uniform(1e-3, 1e3)),
)
def test_onset_follows_the_units(machine, scales):
    here = onset_speed(replace(machine, load=machine.static_load))
    there = onset_speed(scaled(machine, *scales))
    if math.isinf(here.speed):
        assert math.isinf(there.speed)
    else:
        assert there.speed * scales[2] == pytest.approx(here.speed, rel=1e-6)
        assert there.whirl_frequency * scales[2] == pytest.approx(here.whirl_frequency, rel=1e-6)
        assert there.eccentricity_ratio == pytest.approx(here.eccentricity_ratio, rel=1e-6)


# Field, forces, added mass, unloading


@pytest.mark.parametrize("speed", [60.0, 600.0])
def test_pressure_field_carries_the_load(speed):
    """∫∫ p cos θ_load R dθ dz over the unwrapped bearing, the trapezoidal rule on its period."""
    zeta, weights = np.polynomial.legendre.leggauss(3)
    theta, weight = np.polynomial.legendre.leggauss(200)
    field = film_field(SHEET, speed, theta=(theta + 1) * np.pi / 2, zeta=zeta / 2)
    R, L = SHEET.bearing.radius, SHEET.bearing.length
    p = (field.pressure @ (weights / 2)) * weight * np.pi / 2 * R * L
    towards = np.cos(field.theta - field.load_theta)
    across = np.sin(field.theta - field.load_theta)
    assert p @ towards == pytest.approx(SHEET.static_load, rel=1e-12)
    assert p @ across == pytest.approx(0.0, abs=1e-12 * SHEET.static_load)
    assert field.axial_position == pytest.approx(zeta / 2 * L)
    assert not field.cavitated.any()


def test_pressure_field_has_its_peak_where_it_says():
    state = equilibrium(SHEET, 600.0)
    theta = np.linspace(0, 2 * np.pi, 36001)
    field = film_field(SHEET, 600.0, theta=theta)
    top = int(np.argmax(field.pressure[:, 0]))
    assert theta[top] == pytest.approx(float(field.peak_theta), abs=theta[1])
    assert field.pressure[top, 0] == pytest.approx(float(state.peak_pressure), rel=1e-6)
    assert field.thickness.min() == pytest.approx(float(state.minimum_film_thickness), rel=1e-6)
    inside = np.abs(np.sin(theta)) > 1e-6  # the film's ends belong to either half
    assert np.array_equal(field.cavitated[inside], theta[inside] > np.pi)
    assert np.array_equal(field.pressure[inside, 0] > 0, theta[inside] < np.pi)


@given(st.floats(-3, 3))
def test_forces_are_those_of_equation_5_5(power):
    mu, R, L, C = units(SHEET)
    forces = film_forces(SHEET, 600.0, sommerfeld=10.0**power)
    expected = short.static_force(forces.eccentricity_ratio) * mu * 600 * R * L**3 / C**2
    assert forces.radial == pytest.approx(expected[0], rel=1e-10)
    assert forces.tangential == pytest.approx(expected[1], rel=1e-10)
    assert forces.total == pytest.approx(float(np.hypot(*expected)), rel=1e-10)


@pytest.mark.parametrize(("factor", "value"), [(LAMINAR, 1.2), (BULK_FLOW, 1.0)])
def test_added_mass_has_its_dimension(factor, value):
    _, R, L, C = units(SHEET)
    added = coefficients.added_mass(SHEET, 600.0, factor=factor)
    eps = equilibrium(SHEET, 600.0).film.eccentricity_ratio
    expected = value * SHEET.oil.density * R * L**3 / (12 * C) * short.added_mass(eps)
    assert added.mass == pytest.approx(expected, rel=1e-12)
    assert added.to_rotor == pytest.approx(np.trace(expected) / 2 / SHEET.rotor.half_mass)


def test_unloading_ends_without_direct_stiffness():
    """Eq. 5.37: K_XY = −K_YX = (Ω/2)·C_XX and no direct stiffness."""
    end = unloading(SHEET, 600.0, sommerfeld=math.inf)
    assert np.array_equal(np.diag(end.stiffness), [0, 0])
    assert end.stiffness[0, 1] == -end.stiffness[1, 0]
    assert end.whirl_damping == pytest.approx(end.stiffness[0, 1] * np.eye(2), rel=8 * EPS)


# Shapes and bad speeds


@pytest.mark.parametrize("shape", [(), (3,), (2, 3), (0,)])
def test_equilibrium_broadcasts(shape):
    state = equilibrium(SHEET, np.full(shape, 600.0))
    one = equilibrium(SHEET, 600.0)
    for field in fields(state):
        if field.name == "film":
            continue
        values, single = np.asarray(getattr(state, field.name)), getattr(one, field.name)
        assert values.shape == shape + np.shape(single)
        # Functions of arrays and of scalars may round otherwise.
        assert np.all(np.abs(values - single) <= 1e-13 * np.abs(single).max())


BAD_SPEEDS = [
    0.0,
    -0.0,
    -5.0,
    math.nan,
    math.inf,
    -math.inf,
    "600",
    "fast",
    None,
    True,
    1j,
    [1.0, -2.0],
    [1.0, [2.0]],
    [600.0, None],
    10**400,
    object(),
]


@pytest.mark.parametrize("speed", BAD_SPEEDS, ids=[f"bad{n}" for n in range(len(BAD_SPEEDS))])
@pytest.mark.parametrize("function", [analyse, equilibrium, modified_sommerfeld])
def test_a_speed_that_is_not_a_number_is_refused_by_name(function, speed):
    with pytest.raises(ValueError, match=r"^speed = "):
        function(SHEET, speed)


def test_pressure_at_several_speeds_is_that_of_each():
    speeds, theta = np.array([60.0, 300.0, 900.0]), np.linspace(0.0, 2.0 * np.pi, 37)
    for speed, pressure in zip(speeds, middle_pressure(SHEET, speeds, angle=theta), strict=True):
        field = film_field(
            SHEET,
            float(speed),
            theta=theta + float(film_field(SHEET, float(speed), theta=0.0).load_theta),
        )
        assert pressure == pytest.approx(field.pressure[:, 0], rel=1e-9, abs=1e-3)
