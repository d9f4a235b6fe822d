"""What every film model keeps, whatever its bore: the seam's contract, over all models."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc import Gas, Machine, analyse, film_curves
from rotorcalc.coefficients import (
    dynamics,
    equilibrium,
    film_forces,
    over_whirl_ratio,
    stiffness_and_damping,
    unloading,
)
from rotorcalc.films import FilmMotion, FilmUnits, film_of, reduced
from tests.films.models import BEARINGS, GAS, MOVING, Preloaded, Ringed, Sprung, points
from tests.machines import ROTORS, SHEET, log_uniform

MOVES = pytest.mark.parametrize("bearing", [BEARINGS[name] for name in MOVING], ids=MOVING)
EVERY = BEARINGS | GAS
ALL = pytest.mark.parametrize("bearing", EVERY.values(), ids=list(EVERY))
SIGMA = np.array([0.2, 0.5, 1.0, 4.0, 30.0])
STEP = 1e-6


def machine_on(bearing, **changes):
    oil = Gas() if bearing.geometry.lubricant == "gas" else SHEET.oil
    return replace(SHEET, bearing=bearing, **{"oil": oil} | changes)


def motion_at(film, at):
    motion = film.motion()
    loaded = getattr(motion, "loaded", None)
    return motion if loaded is None else loaded(float(at.load))


def journal_force(film, at, place, velocity, inner=()):
    """Return the film's force on the journal in film units, inner states given."""
    motion = motion_at(film, at)
    if isinstance(motion, FilmMotion):
        return np.array(motion.force(*place, *velocity))
    f_x, f_y, _ = motion.force(
        (*place, *velocity), list(inner), float(at.viscosity), float(at.speed)
    )
    return np.array([f_x, f_y])


def resting(film, at):
    motion = film.motion()
    return () if isinstance(motion, FilmMotion) else motion.rest(at).tolist()


@MOVES
@pytest.mark.parametrize("sigma", SIGMA)
def test_at_rest_the_film_force_equals_the_load(bearing, sigma):
    film, at = film_of(bearing), points(bearing, sigma)
    place = film.state(at).position
    inner = resting(film, at)
    force = journal_force(film, at, place.tolist(), (0.0, 0.0), inner)
    assert force == pytest.approx([-0.25 / sigma, 0.0], abs=1e-9 * 0.25 / sigma)


@MOVES
@pytest.mark.parametrize("sigma", SIGMA)
def test_inner_states_rest_in_equilibrium(bearing, sigma):
    film, at = film_of(bearing), points(bearing, sigma)
    motion = motion_at(film, at)
    if isinstance(motion, FilmMotion):
        assert film.inner == 0
        return
    rest = motion.rest(at).tolist()
    assert len(rest) == motion.states
    place = film.state(at).position.tolist()
    *_, rates = motion.force((*place, 0.0, 0.0), rest, float(at.viscosity), float(at.speed))
    assert rates == pytest.approx([0.0] * motion.states, abs=1e-8)


@pytest.mark.parametrize(
    "name", [name for name in MOVING if name not in {"ringed", "floating ring"}]
)
def test_stiffness_and_damping_are_the_derivatives_of_the_force(name):
    """A massless ring cannot be held while the journal moves; its series is tested below."""
    bearing = BEARINGS[name]
    film, at = film_of(bearing), points(bearing, 0.7)
    found = film.dynamics(at)
    rest, inner = film.state(at).position, resting(film, at)
    for j in (0, 1):
        step = STEP * np.eye(2)[j]
        ahead, behind = (
            journal_force(film, at, (rest + s * step).tolist(), (0.0, 0.0), inner) for s in (1, -1)
        )
        assert -(ahead - behind) / (2 * STEP) == pytest.approx(
            found.stiffness[:2, j], rel=1e-6, abs=1e-6
        )
        ahead, behind = (
            journal_force(film, at, rest.tolist(), (s * step).tolist(), inner) for s in (1, -1)
        )
        assert -(ahead - behind) / (2 * STEP) == pytest.approx(
            found.damping[:2, j], rel=1e-6, abs=1e-6
        )


@pytest.mark.parametrize("mass", [0.0, 1.5])
def test_a_ring_is_two_films_in_series(mass):
    bearing = replace(BEARINGS["ringed"], geometry=Ringed(ring_mass=mass))
    found = dynamics(machine_on(bearing), 600.0)
    omega = np.array([150.0, 300.0, 600.0])
    K, C = reduced(replace_leading(found, 3), omega)
    for i, w in enumerate(omega):
        Z = found.stiffness + 1j * w * found.damping
        inside = -Z[:2, 2:]
        outside = Z[2:, 2:] - inside - w**2 * mass * np.eye(2)
        series = np.linalg.inv(np.linalg.inv(inside) + np.linalg.inv(outside))
        assert K[i] + 1j * w * C[i] == pytest.approx(series, rel=1e-10)


def replace_leading(found, count):
    """Return dynamics repeated over a leading axis."""
    return replace(
        found,
        stiffness=np.broadcast_to(found.stiffness, (count, *found.stiffness.shape)),
        damping=np.broadcast_to(found.damping, (count, *found.damping.shape)),
    )


@ALL
def test_the_state_is_synchronous(bearing):
    machine, speed = machine_on(bearing), np.array([300.0, 600.0, 1200.0])
    state = equilibrium(machine, speed)
    K, C = stiffness_and_damping(machine, speed)
    assert state.stiffness == pytest.approx(K, rel=1e-10)
    assert state.damping == pytest.approx(C, rel=1e-10)


@ALL
def test_over_the_whirl_ratio_the_synchronous_coefficients_stand_at_one(bearing):
    machine = machine_on(bearing)
    over = over_whirl_ratio(machine, 600.0, whirl_ratio=[0.5, 1.0, 1.5])
    K, C = stiffness_and_damping(machine, 600.0)
    assert over.stiffness[1] == pytest.approx(K, rel=1e-10)
    assert over.damping[1] == pytest.approx(C, rel=1e-10)
    if not film_of(bearing).frequency_dependent:
        assert np.array_equal(over.stiffness[0], over.stiffness[2])
    with pytest.raises(ValueError, match="whirl_ratio"):
        over_whirl_ratio(machine, 600.0, whirl_ratio=0.0)


@ALL
@given(st.floats(-10.0, 10.0))
def test_the_gap_closes_on_the_outline(bearing, angle):
    film = film_of(bearing)
    edge = film.outline(np.array(angle))
    assert float(film.gap(edge)) == pytest.approx(0.0, abs=1e-12)
    assert math.atan2(edge[1], edge[0]) == pytest.approx(
        math.remainder(angle, 2 * math.pi), abs=1e-9
    )
    assert float(film.gap(0.5 * edge)) > 0.0


@ALL
def test_a_journal_at_rest_stays_off_the_wall(bearing):
    film = film_of(bearing)
    state = film.state(points(bearing, SIGMA))
    assert np.all(film.gap(state.position) > 0.0)


@ALL
def test_arrays_of_points_answer_as_each_alone(bearing):
    film = film_of(bearing)
    sigma = SIGMA[:4].reshape(2, 2)
    whole = film.dynamics(points(bearing, sigma))
    assert whole.stiffness.shape == (2, 2, 2 + film.inner, 2 + film.inner)
    alone = film.dynamics(points(bearing, sigma[1, 0]))
    assert whole.stiffness[1, 0] == pytest.approx(alone.stiffness, rel=1e-10)
    assert whole.damping[1, 0] == pytest.approx(alone.damping, rel=1e-10)
    assert film.state(points(bearing, sigma)).position.shape == (2, 2, 2)


@ALL
def test_a_film_over_sigma_is_the_machines_own_at_its_speed(bearing):
    """A heavy ring's film depends on the speed too, not on σ alone."""
    machine = machine_on(bearing)
    point = analyse(machine, 700.0)
    here = film_curves(bearing, point.sommerfeld, viscosity=machine.viscosity, speed=700.0)
    per_load = bearing.radial_clearance / machine.static_load
    assert here.film.k == pytest.approx(point.stiffness * per_load, rel=1e-9)
    assert here.film.c == pytest.approx(point.damping * per_load * 700.0, rel=1e-9)
    forces = film_forces(machine, 700.0, sommerfeld=point.sommerfeld)
    assert forces.total == pytest.approx(machine.static_load, rel=1e-9)
    unloaded = unloading(machine, 700.0, sommerfeld=point.sommerfeld)
    assert unloaded.stiffness == pytest.approx(point.stiffness, rel=1e-9)


@ALL
def test_drag_and_flow_alone_are_those_of_the_state(bearing):
    film, at = film_of(bearing), points(bearing, SIGMA)
    state, (drag, flow) = film.state(at), film.drag_and_flow(at)
    assert np.array_equal(drag, state.drag, equal_nan=True)
    assert np.array_equal(flow, state.side_flow, equal_nan=True)


@ALL
def test_a_film_says_below_which_load_number_it_has_no_answer(bearing):
    film = film_of(bearing)
    if film.least_sommerfeld > 0.0:
        film.state(points(bearing, np.array([1.0001 * film.least_sommerfeld])))
        with pytest.raises(ValueError, match="sommerfeld"):
            film.state(points(bearing, np.array([0.5 * film.least_sommerfeld])))


@ALL
def test_without_load_position_and_coefficients_are_finite(bearing):
    sweep = analyse(machine_on(bearing, load=0.0), np.array([300.0, 600.0]))
    assert np.all(np.isfinite(sweep.journal_position))
    assert np.all(np.isfinite(sweep.stiffness))


@ALL
@pytest.mark.parametrize("rotor", ROTORS)
def test_the_response_is_that_of_all_coordinates_together(bearing, rotor):
    """Disk, journal and inner coordinates solved at jΩ, none eliminated."""
    machine = machine_on(bearing, rotor=replace(ROTORS[rotor], imbalance=1e-5))
    for speed in (300.0, 900.0):
        sweep = analyse(machine, speed)
        film, r = sweep.dynamics, machine.rotor
        n = film.inner
        # A rigid shaft is a very stiff one.
        k = 1e9 * np.abs(film.stiffness).max() if r.is_rigid else r.shaft_stiffness
        A = np.zeros((4 + n, 4 + n), dtype=complex)
        A[2:, 2:] = film.stiffness + 1j * speed * film.damping
        mass = [r.disk_mass] * 2 + [r.journal_mass] * 2 + list(film.inertia)
        A -= np.diag(np.array(mass) * speed**2)
        for i in (0, 1):
            A[i, i] += k + 1j * speed * r.disk_damping
            A[i + 2, i + 2] += k
            A[i, i + 2] -= k
            A[i + 2, i] -= k
        force = np.zeros(4 + n, dtype=complex)
        force[:2] = r.disk_mass * r.imbalance * speed**2 * np.array([1.0, -1.0j])
        found = np.linalg.solve(A, force)
        size = np.abs(found[:4]).max()
        assert np.abs(sweep.disk_response - found[:2]).max() < 1e-5 * size
        assert np.abs(sweep.journal_response - found[2:4]).max() < 1e-5 * size


@ALL
@pytest.mark.parametrize("rotor", ROTORS)
def test_a_sweep_has_the_free_motions_of_all_coordinates(bearing, rotor):
    machine = machine_on(bearing, rotor=ROTORS[rotor])
    speed = np.array([300.0, 600.0])
    sweep = analyse(machine, speed)
    inner = sweep.dynamics.inner
    more = inner + int(np.count_nonzero(sweep.dynamics.inertia))
    assert sweep.rigid_eigenvalues.shape == (2, 4 + more)
    states = 4 if machine.rotor.is_rigid else 8 if machine.rotor.journal_mass else 6
    assert sweep.flexible_eigenvalues.shape == (2, states + more)
    shapes = analyse(machine, 600.0).mode_shapes()
    found = np.sort_complex(sweep.flexible_eigenvalues[1])
    assert np.sort_complex(shapes.eigenvalues) == pytest.approx(found, rel=1e-6)


@ALL
def test_a_machine_keeps_its_bearing_in_json(bearing):
    machine = machine_on(bearing)
    back = Machine.from_json(machine.to_json())
    assert back == machine
    assert hash(back) == hash(machine)


@pytest.mark.parametrize("geometry", [Sprung(stiffness=3.0), Preloaded(), Ringed(ring_mass=2.0)])
def test_a_geometry_is_written_by_its_kind_and_what_differs_from_its_default(geometry):
    machine = machine_on(replace(SHEET.bearing, geometry=geometry))
    tree = json.loads(machine.to_json())["bearing"]["geometry"]
    assert tree.pop("type") == geometry.kind
    assert tree == {
        name: value
        for name, value in vars(geometry).items()
        if value != getattr(type(geometry), name)
    }


@given(log_uniform(1e-6, 1e3), log_uniform(1e-6, 1e6))
def test_the_units_fit_together(viscosity, speed):
    units = FilmUnits(SHEET.bearing, viscosity, speed)
    C, R, L = SHEET.bearing.radial_clearance, SHEET.bearing.radius, SHEET.bearing.length
    assert units.stiffness * C == pytest.approx(units.force)
    assert units.damping * speed == pytest.approx(units.stiffness)
    assert units.pressure * R * L == pytest.approx(units.force)
    assert units.torque * L**2 == pytest.approx(units.force * R**2 * C)
    assert units.flow == pytest.approx(speed * R * L * C)
