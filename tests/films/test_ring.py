"""The floating ring against a second program, exact limits, and its two films on their own."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import fsolve

from rotorcalc import (
    FloatingRing,
    JournalBearing,
    Machine,
    Oil,
    Rotor,
    analyse,
    onset_speed,
    ring_equilibrium,
    ring_speed,
)
from rotorcalc.coefficients import dynamics, equilibrium, film_field
from rotorcalc.films import FilmUnits, film_of, film_state
from rotorcalc.films.ring import balance
from rotorcalc.films.short import motion
from tests.films.models import RINGS, points
from tests.machines import RPM, SHEET

# Journal and ring of a small turbocharger.
SMALL = JournalBearing(
    diameter=8e-3,
    length=5e-3,
    radial_clearance=10e-6,
    film="short",
    geometry=FloatingRing(outer_radius=7e-3, outer_length=7e-3, outer_clearance=35e-6),
)
MACHINE = Machine(
    oil=Oil(reference_viscosity=6e-3, reference_temperature=50.0, temperature_coefficient=0.03),
    bearing=SMALL,
    rotor=Rotor(mass=0.2),
    temperature=50.0,
    load=1.0,
)
SPEED = 20000.0 * RPM
# A ring whose films differ in all that may differ.
UNLIKE = replace(
    SMALL,
    geometry=FloatingRing(
        outer_radius=5.5e-3, outer_length=4e-3, outer_clearance=22e-6, viscosity_ratio=1.6
    ),
)
BOTH = pytest.mark.parametrize("bearing", [SMALL, UNLIKE], ids=["usual", "unlike"])


def ring(bearing=SMALL, **changes):
    film = changes.pop("film", bearing.film)
    return replace(bearing, geometry=replace(bearing.geometry, **changes), film=film)


def on(bearing, **changes):
    return replace(MACHINE, bearing=bearing, **changes)


def films(bearing, sigma):
    """Return the film of a bearing, r and the two films' states at σ."""
    film = film_of(bearing)
    at = points(bearing, sigma)
    r, inner, outer = film.films_at(at)
    inside, outside = film.pair.inside, film.pair.outside
    return (
        film, r, inside.state(replace(at, sommerfeld=inner)),
        outside.state(replace(at, sommerfeld=outer)),
    )  # fmt: skip


class Second:
    """Two short films in metres and newtons: pressure by quadrature, the ring by its own balance.

    A film is (μ, R, L, C); its surfaces turn at Ω_a inside and Ω_b outside.
    """

    nodes, weights = np.polynomial.legendre.leggauss(120)

    def __init__(self, machine, speed):
        b, g, mu = machine.bearing, machine.bearing.geometry, machine.viscosity
        self.load, self.speed = machine.static_load, speed
        self.inner = mu, b.radius, b.length, b.radial_clearance
        self.outer = mu * g.viscosity_ratio, g.outer_radius, g.outer_length, g.outer_clearance
        self.scale = np.array([b.radial_clearance] * 2 + [g.outer_clearance] * 2 + [speed])

    def film(self, film, wedge, place, velocity=(0.0, 0.0)):
        """Return angles, weights, pressure along the length, and thickness, where p > 0."""
        mu, _, L, C = film
        a = 6.0 * mu * (-wedge * place[1] - 2.0 * velocity[0])
        b = 6.0 * mu * (wedge * place[0] - 2.0 * velocity[1])

        def pressure(beta):
            # h³ ∂²p/∂z² = 6μ(Ω_a + Ω_b) ∂h/∂β + 12μ ∂h/∂t, h = C − x cos β − y sin β.
            h = C - place[0] * np.cos(beta) - place[1] * np.sin(beta)
            return -(a * np.cos(beta) + b * np.sin(beta)) * L**3 / (12.0 * h**3), h

        beta = math.atan2(-b, -a) + 0.5 * np.pi * self.nodes
        return beta, 0.5 * np.pi * self.weights, pressure

    def force(self, film, wedge, place, velocity=(0.0, 0.0)):
        beta, weight, pressure = self.film(film, wedge, place, velocity)
        p = pressure(beta)[0] * weight * film[1]
        return -np.array([np.sum(p * np.cos(beta)), np.sum(p * np.sin(beta))])

    def torque(self, film, faster, slower, place, *, inner_surface):
        """Return the torque of a film on its inner surface, or on its outer one, in N·m."""
        mu, R, L, _ = film
        beta, weight, pressure = self.film(film, faster + slower, place)
        around = np.linspace(0.0, 2.0 * np.pi, 4000, endpoint=False)
        shear = np.mean(mu * R * (faster - slower) / pressure(around)[1]) * 2.0 * np.pi * L
        step = 1e-5
        slope = (pressure(beta + step)[0] - pressure(beta - step)[0]) / (2.0 * step) / R
        flow = np.sum(0.5 * pressure(beta)[1] * slope * weight)
        return R**2 * (shear + flow if inner_surface else -shear + flow)

    def unbalanced(self, unknown):
        x, y, p, q, spin = unknown * self.scale
        load = np.array([self.load, 0.0])
        inner = self.force(self.inner, self.speed + spin, (x, y)) + load
        outer = self.force(self.outer, spin, (p, q)) + load
        # On the ring: the reaction of the inner film's outer surface, and the outer film's drag.
        turn = self.torque(self.inner, self.speed, spin, (x, y), inner_surface=False)
        hold = self.torque(self.outer, spin, 0.0, (p, q), inner_surface=True)
        return np.array([*inner / self.load, *outer / self.load, (turn + hold) / abs(hold)])

    def solved(self, start):
        found, _, _, words = fsolve(self.unbalanced, start, xtol=1e-14, full_output=True)
        assert np.abs(self.unbalanced(found)).max() < 1e-10, words
        return found * self.scale

    def coefficients(self, place, spin):
        """Return K and C of journal and ring, (4, 4), by central differences."""
        inner, ring_place = place[:2], place[2:]

        def forces(displaced, velocity):
            slip = velocity[:2] - velocity[2:]
            f = self.force(
                self.inner, self.speed + spin, inner + displaced[:2] - displaced[2:], slip
            )
            g = self.force(self.outer, spin, ring_place + displaced[2:], velocity[2:])
            return np.concatenate([f, g - f])

        K, C, still = np.empty((4, 4)), np.empty((4, 4)), np.zeros(4)
        for j in range(4):
            step = 1e-6 * self.scale[3 * (j > 1)] * np.eye(4)[j]
            K[:, j] = (forces(-step, still) - forces(step, still)) / (2.0 * step[j])
            step *= spin
            C[:, j] = (forces(still, -step) - forces(still, step)) / (2.0 * step[j])
        return K, C


@BOTH
@pytest.mark.parametrize("speed", [1500.0 * RPM, SPEED, 150000.0 * RPM])
def test_a_second_program_finds_the_same(bearing, speed):
    machine = on(bearing)
    second, sweep = Second(machine, speed), equilibrium(machine, speed)
    sigma = float(sweep.film.sommerfeld)
    _, r, inside, outside = films(bearing, sigma)
    start = np.array([*inside.position, *outside.position, float(r)])
    x, y, p, q, spin = second.solved(1.01 * start)
    assert spin / speed == pytest.approx(float(r), rel=1e-9)
    C, C_o = bearing.radial_clearance, bearing.geometry.outer_clearance
    assert [x / C, y / C] == pytest.approx(inside.position, abs=1e-9)
    assert [p / C_o, q / C_o] == pytest.approx(outside.position, abs=1e-9)
    assert [(x + p) / C, (y + q) / C] == pytest.approx(sweep.film.position, abs=1e-9)
    torque = second.torque(second.inner, speed, spin, (x, y), inner_surface=True)
    assert torque == pytest.approx(float(sweep.drag_torque), rel=1e-9)
    K, D = second.coefficients(np.array([x, y, p, q]), spin)
    found = dynamics(machine, speed)
    assert found.stiffness == pytest.approx(K, abs=1e-8 * np.abs(K).max())
    assert found.damping == pytest.approx(D, abs=1e-8 * np.abs(D).max())


@BOTH
def test_the_equilibrium_of_the_ring_has_both_films_with_dimensions(bearing):
    machine = on(bearing)
    found, second = ring_equilibrium(machine, SPEED), Second(machine, SPEED)
    _, r, inside, outside = films(bearing, float(equilibrium(machine, SPEED).film.sommerfeld))
    x, y, p, q, spin = second.solved(1.01 * np.array([*inside.position, *outside.position, r]))
    assert float(found.ring_speed) == pytest.approx(spin, rel=1e-9)
    assert float(ring_speed(machine, SPEED)) == float(found.ring_speed)
    assert float(found.speed_ratio) == pytest.approx(spin / SPEED, rel=1e-9)
    K, C = second.coefficients(np.array([x, y, p, q]), spin)
    torque = second.torque(second.outer, spin, 0.0, (p, q), inner_surface=True)
    parts = (
        (found.inner, (x, y), -K[:2, 2:], -C[:2, 2:], second.inner[3]),
        (found.outer, (p, q), K[2:, 2:] - K[:2, :2], C[2:, 2:] - C[:2, :2], second.outer[3]),
    )
    for part, place, stiffness, damping, clearance in parts:
        assert part.position == pytest.approx(place, abs=1e-9 * clearance)
        eps = math.hypot(*place) / clearance
        assert float(part.eccentricity_ratio) == pytest.approx(eps, abs=1e-9)
        assert float(part.attitude_angle) == pytest.approx(math.atan2(place[1], place[0]), abs=1e-8)
        thinnest = clearance * (1.0 - eps)
        assert float(part.minimum_film_thickness) == pytest.approx(thinnest, rel=1e-8)
        assert part.stiffness == pytest.approx(stiffness, abs=1e-7 * np.abs(stiffness).max())
        assert part.damping == pytest.approx(damping, abs=1e-7 * np.abs(damping).max())
    whole = equilibrium(machine, SPEED)
    assert float(found.inner.drag_torque) == pytest.approx(float(whole.drag_torque), rel=1e-12)
    assert float(found.outer.drag_torque) == pytest.approx(torque, rel=1e-8)
    for name in ("power_loss", "side_flow"):
        both = getattr(found.inner, name) + getattr(found.outer, name)
        assert float(both) == pytest.approx(float(getattr(whole, name)), rel=1e-9)
    assert float(found.inner.peak_pressure) == pytest.approx(float(whole.peak_pressure), rel=1e-12)


def test_a_ring_has_the_shape_of_the_speeds():
    speeds = np.array([[600.0, 900.0], [1200.0, 2000.0]])
    spins, found = ring_speed(MACHINE, speeds), ring_equilibrium(MACHINE, speeds)
    assert spins.shape == found.outer.power_loss.shape == (2, 2)
    assert found.inner.position.shape == (2, 2, 2)
    assert found.outer.stiffness.shape == (2, 2, 2, 2)
    assert ring_speed(MACHINE, 900.0).shape == ()
    for function in (ring_speed, ring_equilibrium):
        with pytest.raises(ValueError, match="bearing = plain: has no floating ring"):
            function(SHEET, 600.0)


def test_without_load_the_equilibrium_of_the_ring_is_finite():
    found = ring_equilibrium(replace(MACHINE, load=0.0), np.array([600.0, 2000.0]))
    for part in (found.inner, found.outer):
        assert np.all(part.position == 0.0)
        assert np.all(np.isfinite(part.stiffness))
        assert np.all(part.power_loss > 0.0)


@pytest.mark.parametrize("film", ["short", "finite"])
@BOTH
def test_without_load_the_ring_turns_as_concentric_shear_has_it(bearing, film):
    """Shaw & Nussdorfer 1949: 1/(1 + (μ_o/μ_i)(R_o/R)³(L_o/L)(C/C_o))."""
    one, g = ring(bearing, film=film), bearing.geometry
    holds = g.viscosity_ratio * g.outer_length / one.length * one.radial_clearance
    holds *= (g.outer_radius / one.radius) ** 3 / g.outer_clearance
    r = film_of(one).speed_ratio(points(one, np.inf))
    assert float(r) == pytest.approx(1.0 / (1.0 + holds), rel=1e-12)
    state = film_state(one, np.inf)
    assert state.position == pytest.approx([0.0, 0.0], abs=1e-15)
    assert float(state.attitude_angle) == pytest.approx(math.pi / 2, abs=0.02)


def test_the_small_ring_of_a_turbocharger():
    _, r, inside, outside = films(SMALL, float(equilibrium(MACHINE, SPEED).film.sommerfeld))
    assert balance.unloaded(film_of(SMALL).pair) == pytest.approx(0.3180915, abs=5e-8)
    assert float(r) == pytest.approx(0.31514, abs=5e-6)
    assert float(inside.eccentricity_ratio) == pytest.approx(0.01540, abs=5e-6)
    assert float(outside.eccentricity_ratio) == pytest.approx(0.15509, abs=5e-6)


@pytest.mark.parametrize("name", RINGS)
def test_torques_on_the_ring_balance(name):
    """By the drag that each plain film has of its own, which of a finite one is integrated."""
    bearing = RINGS[name]
    sigma = np.array([0.2, 0.5, 2.0, 20.0])
    _, r, inside, outside = films(bearing, sigma)
    g, R, L, C = bearing.geometry, bearing.radius, bearing.length, bearing.radial_clearance
    load = (L / R) ** 2 / (4.0 * sigma)
    # A plain film's drag at the speed Ω ± Ω_R of its shear, and e F sin φ less on its outer side.
    couple = 0.5 * load * inside.position[:, 1]
    turning = (1.0 - r) / (1.0 + r) * ((1.0 + r) * inside.drag - couple) - couple
    unit = (
        g.viscosity_ratio * (g.outer_radius / R) ** 3 * g.outer_length / L * C / g.outer_clearance
    )
    assert turning == pytest.approx(
        unit * r * outside.drag, rel=2e-3 if "finite" in name else 1e-12
    )
    assert np.all(np.diff(r) > 0.0)


@pytest.mark.parametrize("film", ["short", "finite"])
def test_an_outer_film_too_thin_to_move_leaves_a_plain_bearing(film):
    """It holds the ring where it is and lets it hardly turn."""
    clearance = 1e-9 * SMALL.radial_clearance if film == "short" else 1e-3 * SMALL.radial_clearance
    held = ring(SMALL, outer_clearance=clearance, film=film)
    plain = JournalBearing(diameter=8e-3, length=5e-3, radial_clearance=10e-6, film=film)
    sigma = np.array([0.1, 1.0, 30.0])
    found, expected = film_state(held, sigma), film_state(plain, sigma)
    near = {"rel": 1e-6, "abs": 1e-6} if film == "short" else {"rel": 4e-3, "abs": 4e-3}
    for name in ("position", "stiffness", "damping", "drag", "side_flow", "peak_pressure"):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), **near), name


def test_a_wide_outer_film_lets_the_ring_turn_with_the_journal():
    free = ring(SMALL, outer_clearance=6.9e-4, viscosity_ratio=1e-6)
    assert float(film_of(free).speed_ratio(points(free, np.inf))) > 0.999


def test_a_short_finite_ring_is_the_short_one():
    short = JournalBearing(
        diameter=0.1, length=0.01, radial_clearance=1e-4, film="short",
        geometry=FloatingRing(outer_radius=0.08, outer_length=0.016, outer_clearance=2.5e-4),
    )  # fmt: skip
    sigma = np.array([0.3, 1.0, 5.0])
    one, other = film_state(short, sigma), film_state(replace(short, film="finite"), sigma)
    for name in ("position", "stiffness", "damping", "drag", "side_flow"):
        size = np.abs(getattr(one, name)).max()
        assert getattr(other, name) == pytest.approx(getattr(one, name), abs=0.03 * size), name


@pytest.mark.parametrize("name", RINGS)
def test_flows_thickness_and_pressure_are_those_of_the_two_films(name):
    bearing, sigma = RINGS[name], np.array([0.3, 2.0])
    film, r, inside, outside = films(bearing, sigma)
    at = points(bearing, sigma)
    state, mu, speed = film.state(at), float(at.viscosity), float(at.speed)
    g, C = bearing.geometry, bearing.radial_clearance
    around = JournalBearing(
        diameter=2 * g.outer_radius, length=g.outer_length, radial_clearance=g.outer_clearance
    )
    units = FilmUnits(bearing, mu, speed)
    inner, outer = FilmUnits(bearing, mu, (1 + r) * speed), FilmUnits(around, mu, r * speed)
    flow = inside.side_flow * inner.flow + outside.side_flow * outer.flow
    assert state.side_flow * units.flow == pytest.approx(flow, rel=1e-12)
    thinnest = np.minimum(
        inside.minimum_thickness * C, outside.minimum_thickness * g.outer_clearance
    )
    assert state.minimum_thickness * C == pytest.approx(thinnest, rel=1e-12)
    assert state.peak_pressure * units.pressure == pytest.approx(
        inside.peak_pressure * inner.pressure, rel=1e-12
    )
    for i in (0, 1):
        field = film.field(points(bearing, sigma[i]), angle=state.peak_angle[i], zeta=0.0)
        assert float(field.pressure) == pytest.approx(state.peak_pressure[i], rel=5e-3)


def test_a_field_of_pressure_carries_the_load():
    theta = np.linspace(0.0, 2.0 * np.pi, 2001)
    nodes, weights = np.polynomial.legendre.leggauss(4)
    field = film_field(MACHINE, SPEED, theta=theta, zeta=0.5 * nodes)
    along = field.pressure @ (0.5 * weights) * SMALL.length
    Theta = theta - field.load_theta
    for part, load in ((np.cos, 1.0), (np.sin, 0.0)):
        force = np.trapezoid(along * part(Theta), theta) * SMALL.radius
        assert force == pytest.approx(load, abs=1e-5)


def test_the_loss_is_that_of_both_films():
    sweep = analyse(MACHINE, SPEED)
    second = Second(MACHINE, SPEED)
    _, r, inside, outside = films(SMALL, float(sweep.sommerfeld))
    C, C_o = second.inner[3], second.outer[3]
    spin, place, place_o = float(r) * SPEED, inside.position * C, outside.position * C_o
    on_journal, on_ring = (
        second.torque(second.inner, SPEED, spin, place, inner_surface=surface)
        for surface in (True, False)
    )
    of_outer = second.torque(second.outer, spin, 0.0, place_o, inner_surface=True)
    losses = on_journal * SPEED + on_ring * spin, of_outer * spin
    assert sum(losses) == pytest.approx(float(sweep.power_loss), rel=1e-9)
    assert min(losses) > 0.0


@pytest.mark.parametrize("length", [2.5e-3, 5e-3, 12e-3])
def test_the_heaviest_load_is_where_the_inner_film_no_longer_turns_the_ring(length):
    """There 2π/s = ½εf_t(L/R)², which is (L/R)²ε/s = 16s/ε: ε/s = 4R/L."""
    bearing = replace(SMALL, length=length)
    w = 4.0 * bearing.radius / bearing.length
    stall = 1.0 / (w * (1.0 + w * w) * math.sqrt(math.pi**2 + 16.0 * w * w))
    assert film_of(bearing).least_sommerfeld == pytest.approx(stall, rel=1e-4)
    near = film_of(bearing).speed_ratio(points(bearing, 1.01 * stall))
    assert 0.0 < float(near) < 1e-6


@pytest.mark.parametrize("film", ["short", "finite", "coarse"])
def test_a_load_beyond_the_heaviest_is_refused_in_words(film):
    bearing = ring(film=film)
    least = film_of(bearing).least_sommerfeld
    with pytest.raises(ValueError, match=r"sommerfeld = .*: must be at least .* with this ring"):
        film_state(bearing, 0.99 * least)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"outer_radius": 4e-3}, r"outer_radius = 0.004 m \(4 mm\): must be greater .* 0.004 m"),
        ({"outer_radius": 3e-3}, r"outer_radius = 0.003 m .*journal's radius"),
        ({"outer_clearance": 8e-4}, r"outer_clearance = 0.0008 m .*a tenth of the outer radius"),
        ({"outer_clearance": 0.0}, "outer_clearance = 0.0 m: must be positive"),
        ({"outer_length": math.nan}, "outer_length = nan m: must be finite"),
        ({"viscosity_ratio": 0.0}, "viscosity_ratio = 0.0 -: must be positive"),
        ({"ring_mass": -1.0}, "ring_mass = -1.0 kg: must be at least 0"),
    ],
)
def test_a_ring_that_cannot_be_is_refused_in_words(changes, words):
    with pytest.raises(ValueError, match=words):
        ring(**changes)


def test_a_ring_of_usual_proportions_goes_around_any_journal():
    for R in (1e-3, 4e-3, 75e-3):
        sizes = {"diameter": 2 * R, "length": R, "radial_clearance": 1e-3 * R}
        bearing = JournalBearing(**sizes, geometry=FloatingRing.around(*sizes.values()))
        assert 0.3 < float(film_of(bearing).speed_ratio(points(bearing, np.inf))) < 0.4
    with pytest.raises(TypeError):
        FloatingRing()


def test_many_points_answer_as_each_alone():
    film = film_of(SMALL)
    sigma = np.geomspace(1.001 * film.least_sommerfeld, 1e4, 60)
    whole = film.speed_ratio(points(SMALL, sigma))
    alone = [float(film.speed_ratio(points(SMALL, one))) for one in sigma]
    assert whole == pytest.approx(alone, rel=1e-13)


def test_the_short_films_answer_is_its_force_and_its_derivatives():
    rng = np.random.default_rng(3)
    for _ in range(50):
        angle, eps = rng.uniform(0, 2 * np.pi), rng.uniform(0, 0.95)
        x, y = eps * np.cos(angle), eps * np.sin(angle)
        v = rng.uniform(-1, 1, 2)
        found = motion.answer(x, y, *v)
        assert (found.f_x, found.f_y) == pytest.approx(motion.force(x, y, *v), rel=1e-13)
        size = abs(found.xx) + abs(found.yy)
        for j, (column, f) in enumerate((((found.xx, found.yx), 0), ((found.xy, found.yy), 1))):
            step = 1e-6 * np.eye(2)[j]
            ahead, behind = motion.answer(x, y, *(v + step)), motion.answer(x, y, *(v - step))
            slope = -(np.array(ahead[:2]) - np.array(behind[:2])) / 2e-6
            assert slope == pytest.approx(column, abs=1e-7 * size)
            potential = -(ahead.potential - behind.potential) / 2e-6
            assert potential == pytest.approx(found[f], abs=1e-7 * size)


def test_a_film_without_a_wedge_has_no_force():
    still = motion.answer(0.2, 0.1, -0.05, 0.1)
    assert still[:2] == (0.0, 0.0)
    assert still.potential == 0.0
    assert still.xx > 0.0 < still.yy


def test_a_motion_goes_to_another_process_and_returns():
    moving = film_of(SMALL).motion().loaded(1.0)
    at = ((0.3, 0.2, 0.1, 0.0), [0.1, 0.2], 6e-3, SPEED)
    before = moving.force(*at)
    again = pickle.loads(pickle.dumps(moving.force))(*at)  # noqa: S301 - our own
    assert again == before


def test_a_ring_of_next_to_no_mass_is_one_of_none():
    light = onset_speed(on(ring(ring_mass=1e-9)))
    assert light.speed == pytest.approx(onset_speed(MACHINE).speed, rel=1e-6)


@BOTH
def test_one_operating_point_in_floats_is_one_of_many(bearing):
    film = film_of(bearing)
    # Closer to where the ring stops, r < 1e-9, the array loses digits in 1 − ε.
    sigma = film.least_sommerfeld * (1.0 + np.geomspace(0.05, 1e10, 40))
    many = film.speed_ratio(points(bearing, sigma))
    each = [film.speed_ratio(points(bearing, one)) for one in sigma]
    np.testing.assert_allclose(each, many, rtol=1e-10)
