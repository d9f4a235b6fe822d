"""The hydrostatic film: identities and limits, a second program, another mesh."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.constants import degree

from rotorcalc import Hydrostatic, Machine, analyse, onset_speed
from rotorcalc.coefficients import equilibrium, operating_points, stiffness_and_damping
from rotorcalc.films import film_of
from rotorcalc.films.hydrostatic.balance import balanced, bearing_of, held
from rotorcalc.films.hydrostatic.mesh import Lands
from rotorcalc.films.hydrostatic.pressure import extremes
from rotorcalc.films.hydrostatic.restrictors import Restrictors
from rotorcalc.films.hydrostatic.table import extrapolated, table
from rotorcalc.machine import JournalBearing
from tests.films.models import points
from tests.films.plain_recesses import Recessed, results
from tests.machines import ROTORS, SHEET, log_uniform

FOUR = Lands(recesses=4, land_ratio=0.25, land_angle=30 * degree, slenderness=1.0)
SIX = Lands(recesses=6, land_ratio=0.125, land_angle=15 * degree, slenderness=4.0)
BEARING = JournalBearing(
    diameter=0.100, length=0.100, radial_clearance=50e-6, geometry=Hydrostatic()
)
MACHINE: Machine = replace(SHEET, bearing=BEARING)


def on(lands, kind="capillary", ratio=0.5):
    return bearing_of(table(lands), Restrictors(kind, ratio))


CAPILLARY, ORIFICE = on(FOUR), on(FOUR, "orifice")
BOTH = pytest.mark.parametrize("bearing", [CAPILLARY, ORIFICE], ids=["capillary", "orifice"])


def at(*places):
    return np.array(places, dtype=float)


def test_a_worked_case_of_an_orifice_bearing():
    force, found = held(ORIFICE, at(0.05), at((0.2, 0.1)))
    assert force[0] == pytest.approx([-0.2645, -0.1002], abs=2e-4)
    assert found.stiffness[0].ravel() == pytest.approx([1.281, 0.067, -0.156, 1.226], abs=4e-3)
    assert found.damping[0].ravel() == pytest.approx([4.642, 0.046, 0.046, 4.467], abs=0.014)


@pytest.mark.parametrize(("lands", "kind", "number", "place", "cells"), [
    (FOUR, "orifice", 0.05, (0.2, 0.1), (48, 16)),
    (SIX, "capillary", 0.5, (0.4, 0.2), (96, 32)),
])  # fmt: skip
def test_a_second_program_agrees(lands, kind, number, place, cells):
    def make(factor):
        return Recessed(
            lands.recesses, lands.land_ratio, lands.land_angle, lands.slenderness, 0.4,
            kind == "orifice", *(factor * n for n in cells),
        )  # fmt: skip

    F, K, C, flow = results(make, place, number)
    force, found = held(on(lands, kind, 0.4), at(number), at(place))
    assert np.abs(force[0] - F).max() < 2e-3 * np.abs(F).max()
    assert np.abs(found.stiffness[0] - K).max() < 5e-3 * np.abs(K).max()
    assert np.abs(found.damping[0] - C).max() < 5e-3 * np.abs(C).max()
    # There the whole bearing is solved, here a half of it.
    assert 2.0 * found.flow.sum() == pytest.approx(float(flow), rel=5e-3)


@BOTH
def test_in_the_centre_the_film_whirls_at_half_speed(bearing):
    S = np.array([1e-6, 0.1, 1.0, 20.0])
    found = balanced(bearing, S, np.zeros(4))
    K, C = found.stiffness, found.damping
    assert np.abs(found.position).max() < 1e-13
    assert K[:, 0, 0] == pytest.approx(K[0, 0, 0], rel=1e-6)
    assert K[:, 1, 1] == pytest.approx(K[:, 0, 0], rel=1e-6)
    assert K[:, 0, 1] == pytest.approx(C[:, 0, 0] * S / 2.0, rel=1e-6, abs=1e-6)
    assert K[:, 1, 0] == pytest.approx(-K[:, 0, 1], rel=1e-6, abs=1e-6)
    assert found.pressure == pytest.approx(0.5)


@BOTH
@settings(max_examples=20)
@given(st.floats(0.0, 0.9), st.floats(-math.pi, math.pi), st.floats(0.0, 10.0))
def test_stiffness_is_the_derivative_of_the_force(bearing, eps, gamma, S):
    place = at((eps * math.cos(gamma), eps * math.sin(gamma)))
    step = 1e-5 * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
    force, _ = held(bearing, np.full(4, S), place + step)
    K = np.stack([force[1] - force[0], force[3] - force[2]], axis=-1) / 2e-5
    found = held(bearing, at(S), place)[1].stiffness[0]
    # Across an edge of the table's grid the second derivatives differ.
    assert np.abs(found - K).max() < 1e-4 * np.abs(K).max()


@BOTH
@pytest.mark.parametrize("turns", [1, 2, 3])
def test_every_recess_is_like_the_first(bearing, turns):
    S, place, angle = at(0.7), at((0.5, 0.2)), 0.5 * np.pi * turns
    Q = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    force, found = held(bearing, S, place)
    turned, other = held(bearing, S, place @ Q.T)
    assert turned == pytest.approx(force @ Q.T, rel=1e-6)
    assert other.pressure == pytest.approx(np.roll(found.pressure, turns, axis=1), rel=1e-6)
    assert other.stiffness[0] == pytest.approx(Q @ found.stiffness[0] @ Q.T, rel=1e-5)


@BOTH
def test_at_rest_a_journal_sinks_onto_the_recess_under_it(bearing):
    found = balanced(bearing, at(1e-12), at(0.4))
    assert found.position[0, 0] > 0.1
    assert abs(found.position[0, 1]) < 1e-9
    lower, side, upper, other = found.pressure[0]
    assert lower > 0.5 > upper
    assert side == pytest.approx(other, rel=1e-6)
    assert np.all(np.isfinite(found.stiffness))
    assert np.diag(found.stiffness[0]).min() > 0.0


def rowe(lands, kind, beta):
    """Stiffness of a centred bearing with thin lands (Rowe 2012), in p_s R L/C."""
    N, a, wide = lands.recesses, lands.land_ratio, lands.land_angle
    z = beta / (1.0 - beta) * (1.0 if kind == "capillary" else 0.5)
    between = 2.0 * N * a * (1.0 - a) / (lands.slenderness * math.pi * wide)
    sin2 = math.sin(math.pi / N) ** 2
    share = 3.0 * N**2 * sin2 * beta / (2.0 * math.pi * (z + 1.0 + 2.0 * between * sin2))
    return 2.0 * (1.0 - a) * share


@pytest.mark.parametrize("kind", ["capillary", "orifice"])
@pytest.mark.parametrize("ratio", [0.3, 0.6])
def test_with_thin_lands_the_stiffness_is_rowes(kind, ratio):
    apart = []
    for a in (0.25, 0.04):
        lands = replace(FOUR, land_ratio=a)
        bearing = on(lands, kind, ratio)
        K = balanced(bearing, at(1e-9), at(0.0)).stiffness[0, 0, 0]
        apart.append(abs(K / rowe(lands, kind, ratio) - 1.0))
    thick, thin = apart
    assert 0.03 < thick < 0.09
    assert thin < 0.006


@pytest.mark.parametrize("lands", [FOUR, SIX], ids=["four", "six"])
def test_the_table_gives_what_is_solved_directly(lands):
    eps, gamma = np.array([0.05, 0.4, 0.7, 0.9, 0.96]), np.array([0.3, 2.0, -1.1, 4.0, 0.78])
    place = eps[:, None] * np.stack([np.cos(gamma), np.sin(gamma)], axis=-1)
    made = table(lands)
    direct, (found, *_) = extrapolated(lands, made.cells, place), made.at(place)
    for name in ("conductance", "pumping", "squeeze"):
        own, other = getattr(found, name), getattr(direct, name)
        assert np.abs(own - other).max() < 1e-4 * np.abs(other).max()


@pytest.mark.parametrize("sigma", [0.1, 10.0])
@pytest.mark.parametrize("film", ["finite", "coarse"])
def test_another_mesh_agrees(sigma, film):
    found = film_of(replace(BEARING, film=film)).accuracy(sigma)
    assert "recess" in found.mesh
    assert found.place < 1e-3
    assert found.stiffness < (0.004 if film == "finite" else 0.01)
    assert found.damping < (0.004 if film == "finite" else 0.02)


@pytest.mark.parametrize("kind", ["capillary", "orifice"])
def test_a_second_program_finds_the_force_on_a_moving_journal(kind):
    place, velocity, speed = (0.2, 0.3), (0.3, -0.2), 600.0
    motion, S = moving(kind), 0.01 * speed * 1e6 / 2e6
    rough, fine = (
        Recessed(4, 0.25, 30 * degree, 1.0, 0.5, kind == "orifice", n * 48, n * 16).solved(
            place, velocity, S
        )
        for n in (1, 2)
    )
    force, P = (b + (b - a) / 3.0 for a, b in zip(rough[:2], fine[:2], strict=True))
    *found, _ = motion.force((*place, *velocity), [], 0.01, speed)
    # From p_s R L to μΩRL³/C².
    assert found == pytest.approx(0.25 * force / S, abs=3e-3 * 0.25 * np.abs(force).max() / S)
    pressure = motion.force.__self__.recess_pressure((*place, *velocity), 0.01, speed)
    assert pressure == pytest.approx(P, abs=4e-3 * np.abs(P).max())


def moving(kind="capillary"):
    bearing = replace(BEARING, geometry=Hydrostatic(restrictor=kind))
    return film_of(bearing).motion()


MOVES = st.tuples(
    st.floats(0.0, 0.97), st.floats(-math.pi, math.pi), *[st.floats(-3.0, 3.0)] * 2
).map(lambda m: (m[0] * math.cos(m[1]), m[0] * math.sin(m[1]), *m[2:]))


@pytest.mark.parametrize("kind", ["capillary", "orifice"])
@settings(max_examples=40)
@given(MOVES, log_uniform(1.0, 1e4))
def test_the_velocity_of_a_moving_journal_is_that_of_the_force(kind, moves, speed):
    motion = moving(kind)
    f_x, f_y, rates = motion.force(moves, [], 0.01, speed)
    dx, dy, same = motion.velocity((*moves[:2], f_x, f_y), [], 0.01, speed)
    assert rates == same == []
    assert (dx, dy) == pytest.approx(moves[2:], abs=1e-8)


@pytest.mark.parametrize("kind", ["capillary", "orifice"])
def test_the_recesses_never_drive_the_motion_that_they_resist(kind):
    random, motion = np.random.default_rng(3), moving(kind)
    for place in random.uniform(-0.6, 0.6, (20, 2)):
        one, other = random.normal(0.0, 1.0, (2, 2))
        forces = [motion.force((*place, *v), [], 0.01, 500.0)[:2] for v in (one, other)]
        assert np.subtract(*forces) @ (one - other) < 0.0


def test_behind_capillaries_the_force_is_linear_in_the_velocity():
    motion, place, S = moving(), (0.4, -0.3), 0.01 * 300.0 * 1e6 / 2e6
    force, there = held(CAPILLARY, at(S), at(place))
    for velocity in ((0.2, 0.1), (-3.0, 5.0)):
        *found, _ = motion.force((*place, *velocity), [], 0.01, 300.0)
        expected = force[0] / S - there.damping[0] @ velocity
        assert found == pytest.approx(0.25 * expected, rel=1e-9)


@pytest.mark.parametrize("kind", ["capillary", "orifice"])
def test_rotation_acts_on_the_pressure_as_a_velocity_does(kind):
    film = film_of(replace(BEARING, geometry=Hydrostatic(restrictor=kind)))
    place = at((0.5, 0.4), (0.5, 0.4), (0.5, 0.4))
    turning = 0.5 * np.array([0.4, -0.5])
    velocity = at((0.0, 0.0), turning, -turning)
    lowest = film.lowest_pressure(
        place=place, velocity=velocity, viscosity=at(0.01, 0.01, 0.01), speed=at(4e3, 2e3, 2e3)
    )
    fast, moving_too, at_half_speed = lowest
    assert moving_too == pytest.approx(fast, rel=1e-9)
    assert fast < -1e6
    assert at_half_speed == 0.0  # in half-speed whirl there is neither wedge nor squeeze


def test_one_place_of_the_table_is_that_of_many():
    made, random = table(SIX), np.random.default_rng(2)
    angle, eps = random.uniform(-4.0, 4.0, 30), np.linspace(0.0, 0.98, 30)
    place = eps[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    many, *_ = made.at(place)
    for i, (x, y) in enumerate(place.tolist()):
        one = made.point(x, y)
        for name in ("conductance", "pumping", "squeeze"):
            expected = getattr(many, name)[i]
            size = np.abs(expected).max()
            assert getattr(one, name) == pytest.approx(expected, abs=1e-12 * size)
    # An integrator's trial step out of the bore finds the outermost place, and none without number.
    assert made.point(1.5, 0.0).squeeze == pytest.approx(made.point(0.98, 0.0).squeeze)
    with pytest.raises(ArithmeticError, match="no film"):
        made.point(math.nan, 0.0)
    with pytest.raises(ArithmeticError, match="flows"):
        moving().force((0.1, 0.1, math.nan, 0.0), [], 0.01, 500.0)


def test_the_motion_on_recesses_goes_to_another_process():
    motion = moving("orifice")
    state = (0.2, 0.1, 0.0, 0.1), [], 0.01, 500.0
    sent = pickle.dumps(motion.force)
    assert len(sent) < 2000
    assert pickle.loads(sent)(*state) == motion.force(*state)  # noqa: S301 - our own


@BOTH
def test_behind_the_thinnest_film_of_a_fast_journal_the_pressure_is_negative(bearing):
    S = np.array([1e-3, 5.0])
    _, there = held(bearing, S, at((0.6, 0.0), (0.6, 0.0)))
    slow, fast = 0, 1
    found = extremes(FOUR, there, S)
    assert found.lowest[slow] == 0.0
    assert found.angle[slow] == 0.0
    assert 0.5 < found.highest[slow] < 1.0
    assert found.lowest[fast] < -1.0
    assert -np.pi / 2 < math.remainder(found.angle[fast], 2 * np.pi) < 0.0


def test_the_field_has_the_recess_pressures_and_the_film_between_them():
    film, here = film_of(BEARING), operating_points(MACHINE, np.array([200.0, 900.0]))
    found, S = film.balance(here)
    unit = (BEARING.radius / BEARING.length) ** 2 / S
    middles = 0.5 * np.pi * np.arange(4) + 0.1
    one = replace(
        here, speed=here.speed[:, None], sommerfeld=here.sommerfeld[:, None], load=here.load
    )
    field = film.field(one, angle=middles, zeta=np.full(4, 0.2))
    assert field.pressure == pytest.approx(unit[:, None] * found.pressure, rel=1e-12)
    ends = film.field(one, angle=middles, zeta=0.5)
    assert np.abs(ends.pressure).max() < 1e-12
    assert not field.cavitated.any()
    state = film.state(here)
    around = film.field(one, angle=np.linspace(-3.1, 3.1, 400), zeta=0.0)
    assert state.peak_pressure == pytest.approx(around.pressure.max(axis=1), rel=0.01)
    assert state.minimum_thickness == pytest.approx(around.thickness.min(axis=1), rel=1e-3)
    with pytest.raises(ValueError, match="zeta"):
        film.field(here, angle=0.0, zeta=0.6)


def test_the_force_of_the_field_carries_the_load():
    film, here = film_of(BEARING), operating_points(MACHINE, np.array(500.0))
    angle = np.linspace(-np.pi, np.pi, 721)[:-1] + 1e-3
    zeta = (np.arange(100) + 0.5) / 200.0
    p = film.field(here, angle=angle[:, None], zeta=zeta).pressure
    area = (angle[1] - angle[0]) * 0.01
    force = [-(p * np.cos(angle)[:, None]).sum() * area, -(p * np.sin(angle)[:, None]).sum() * area]
    assert force[0] == pytest.approx(-0.25 / float(here.sommerfeld), rel=3e-3)
    assert abs(force[1]) < 3e-3 * abs(force[0])


def test_the_journals_torque_is_the_shear_of_the_lands_and_a_couple():
    """The bearing's torque is that of the same shear; the two differ by load times eccentricity."""
    here = equilibrium(MACHINE, 300.0)
    x, y = here.film.position
    beta = np.linspace(-np.pi, np.pi, 100001)[:-1] + 1e-5
    h = 1.0 - x * np.cos(beta) - y * np.sin(beta)
    between = np.abs((beta + np.pi / 4) % (np.pi / 2) - np.pi / 4) > np.pi / 6
    shear = np.mean(np.where(between, 1.0, 0.5) / h) * 2.0 * np.pi
    unit = MACHINE.viscosity * 300.0 * BEARING.radius**3 * BEARING.length
    torque = unit / BEARING.radial_clearance * shear
    couple = 0.5 * y * BEARING.radial_clearance * MACHINE.static_load
    assert float(here.drag_torque) == pytest.approx(torque + couple, rel=1e-4)


def test_the_supply_leaves_at_the_ends_whatever_the_speed():
    film = film_of(BEARING)
    slow, fast = (equilibrium(MACHINE, one).side_flow for one in (1e-3, 800.0))
    assert float(slow) == pytest.approx(float(fast), rel=0.3)
    here = operating_points(MACHINE, np.array(400.0))
    angle, h = np.linspace(-np.pi, np.pi, 1441)[:-1], 1e-3
    near = film.field(here, angle=angle, zeta=0.5 - h)
    # −h³ p_ζ/12 at both ends over the circle, in ΩRLC: ζ = z/L there.
    leaving = 2.0 / 12.0 * np.mean(near.thickness**3 * near.pressure / h) * 2.0 * np.pi
    assert film.drag_and_flow(here)[1] == pytest.approx(leaving, rel=0.02)


def test_a_heavier_load_than_the_supply_carries_is_refused_in_words():
    most = film_of(BEARING)._bearing.heaviest * 2e6 * 0.05 * 0.1
    equilibrium(replace(MACHINE, load=0.999 * most), np.array([1.0, 300.0, 3000.0]))
    with pytest.raises(ValueError, match=r"static load = .* at most .* supplied at 2e\+06 Pa"):
        equilibrium(replace(MACHINE, load=1.001 * most), 300.0)


@pytest.mark.parametrize(("lands", "kind", "ratio"), [
    (FOUR, "capillary", 0.2), (FOUR, "orifice", 0.7), (SIX, "orifice", 0.5),
])  # fmt: skip
def test_the_heaviest_load_is_carried_at_every_speed(lands, kind, ratio):
    """A slow journal gives way to the side: there much less is carried than at rest."""
    bearing = on(lands, kind, ratio)
    S = np.concatenate([[1e-9], np.geomspace(1e-3, 100.0, 60)])
    found = balanced(bearing, S, np.full(len(S), bearing.heaviest))
    force, _ = held(bearing, S, found.position)
    assert force == pytest.approx(np.broadcast_to([-bearing.heaviest, 0.0], force.shape), abs=1e-9)
    assert np.linalg.det(found.stiffness).min() > 0.0
    assert np.abs(np.diff(found.position, axis=0)).max() < 0.3


def test_it_refuses_what_it_does_not_compute():
    film = film_of(BEARING)
    with pytest.raises(ValueError, match="added mass"):
        film.added_mass(points(BEARING, 1.0))
    with pytest.raises(ValueError, match="land_angle"):
        Hydrostatic(recesses=6, land_angle=60 * degree)
    with pytest.raises(ValueError, match="restrictor"):
        Hydrostatic(restrictor="valve")


def test_a_rigid_rotor_without_load_whirls_at_half_speed_from_twice_its_frequency_on():
    free = replace(MACHINE, load=0.0, rotor=ROTORS["rigid"])
    K, _ = stiffness_and_damping(free, 100.0)
    found = onset_speed(free)
    assert found.speed == pytest.approx(2.0 * math.sqrt(K[0, 0] / free.rotor.half_mass), rel=1e-6)
    assert found.whirl_frequency == pytest.approx(found.speed / 2.0, rel=1e-6)


def test_below_the_onset_every_mode_decays_and_above_it_one_grows():
    loaded = replace(MACHINE, rotor=replace(MACHINE.rotor, shaft_stiffness=2e8))
    onset = onset_speed(loaded)
    assert 0.4 < onset.whirl_frequency / onset.speed < 0.55
    rates = analyse(loaded, onset.speed * np.array([0.999, 1.001])).flexible_eigenvalues.real
    assert rates[0].max() < 0.0 < rates[1].max()
