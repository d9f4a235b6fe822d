"""Motions of a journal and its floating ring: what only a ring does."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import (
    Plain,
    Rotor,
    TransientError,
    analyse,
    energy_balance,
    mode_onsets,
    ring_equilibrium,
    simulate,
)
from rotorcalc.films import OperatingPoints, film_of
from rotorcalc.films.finite.motion import FinitePadsInMotion
from rotorcalc.films.short import film_force
from rotorcalc.nonlinear.equations import film_gap
from rotorcalc.nonlinear.linear_motion import linear_theory
from rotorcalc.nonlinear.measured_onset import measured_growth
from rotorcalc.nonlinear.release import release
from rotorcalc.nonlinear.transient import last_state
from tests.films import plain_program
from tests.films.models import RINGS
from tests.films.test_finite_motion import open_circle
from tests.films.test_ring import MACHINE, SMALL, SPEED, ring
from tests.machines import ROTORS, SHEET

C, WIDER = SMALL.radial_clearance, 3.5
MU = MACHINE.viscosity
FINITE = replace(SMALL, film="finite")
BOTH = pytest.mark.parametrize("bearing", [SMALL, FINITE], ids=["short", "finite"])
# A machine on a finite ring whose whirl decays well.
SHEETS = replace(SHEET, bearing=RINGS["finite floating ring"])


def kernel(bearing=SMALL, load=1.0):
    film = film_of(bearing)
    return film, film.motion().loaded(load)


def moves(count):
    """Return places and velocities of journal and ring, both films open."""
    rng = np.random.default_rng(1)
    for _ in range(count):
        angles, eps = rng.uniform(0, 2 * np.pi, 2), rng.uniform(0, 0.9, 2)
        relative, ring_place = (
            size * e * np.array([np.cos(a), np.sin(a)])
            for size, e, a in zip((1.0, WIDER), eps, angles, strict=True)
        )
        yield (ring_place + relative).tolist(), ring_place.tolist(), rng.uniform(-0.5, 0.5, 2)


def plain_force(bearing, place, velocity):
    """Return the force of one film; of finite length by the table for pads of any arc."""
    if bearing.model == "short":
        return film_force(place, velocity)
    return np.array(FinitePadsInMotion(bearing).force(*place, *velocity))


def forces(film, r, moving, ring_place, ring_velocity):
    """Return the force of the inner film on the journal and of the outer one on the ring."""
    place, velocity = np.subtract(moving, [ring_place, ring_velocity])
    pair = film.pair
    inside = plain_force(pair.inside.bearing, place, velocity / (1.0 + r))
    drift = np.array(ring_velocity) / (WIDER * r)
    outside = plain_force(pair.outside.bearing, np.array(ring_place) / WIDER, drift)
    return (1.0 + r) * inside, pair.force * r * outside


def ratio(film, load=1.0):
    points = OperatingPoints.of(film.bearing, viscosity=MU, speed=SPEED, load=load)
    return float(film.speed_ratio(points))


@BOTH
def test_a_massless_ring_moves_so_that_both_films_load_it_alike(bearing):
    film, motion = kernel(bearing)
    r = ratio(film)
    for place, ring_place, velocity in moves(40):
        f_x, f_y, found = motion.force((*place, *velocity), ring_place, MU, SPEED)
        inside, outside = forces(film, r, (place, velocity), ring_place, found)
        size = np.hypot(f_x, f_y)
        assert inside == pytest.approx([f_x, f_y], abs=1e-12 * size)
        assert outside == pytest.approx(inside, abs=1e-8 * size)
        at = ([*place, *ring_place], [*velocity, *found], MU, SPEED)
        assert motion.forces(*at) == pytest.approx([f_x, f_y, 0.0, 0.0], abs=1e-8 * size)
        dx, dy, again = motion.velocity((*place, f_x, f_y), ring_place, MU, SPEED)
        assert [dx, dy] == pytest.approx(velocity, abs=1e-7)
        assert again == pytest.approx(found, abs=1e-7)


@BOTH
def test_a_ring_with_a_mass_is_pushed_by_both_films(bearing):
    mass = 4e-3
    film, motion = kernel(ring(bearing, ring_mass=mass))
    r, unit = ratio(film), MU * SPEED * 4e-3 * 5e-3**3 / C**2
    for place, ring_place, velocity in moves(10):
        spin = (0.1, -0.2)
        f_x, f_y, rates = motion.force((*place, *velocity), [*ring_place, *spin], MU, SPEED)
        inside, outside = forces(film, r, (place, velocity), ring_place, spin)
        assert [f_x, f_y] == pytest.approx(inside, rel=1e-12)
        assert rates[:2] == list(spin)
        pushed = unit * (outside - inside) / (mass * C * SPEED**2)
        assert rates[2:] == pytest.approx(pushed, rel=1e-9)
        at = ([*place, *ring_place], [*velocity, *spin], MU, SPEED)
        assert motion.forces(*at) == pytest.approx([f_x, f_y, *(outside - inside)], rel=1e-9)
        dx, dy, same = motion.velocity((*place, f_x, f_y), [*ring_place, *spin], MU, SPEED)
        assert [dx, dy] == pytest.approx(velocity, abs=1e-9)
        assert same == pytest.approx(rates, rel=1e-9)


def test_a_second_program_finds_the_forces_of_two_films_of_finite_length():
    film, motion = kernel(ring(FINITE, ring_mass=4e-3))
    r, outer = ratio(film), film.pair.outside.bearing
    unit = MU * SPEED * 4e-3 * 5e-3**3 / C**2
    for place, ring_place, velocity in moves(1):
        *f, rates = motion.force((*place, *velocity), [*ring_place, 0.1, -0.2], MU, SPEED)
        relative = np.subtract(place, ring_place)
        slip = np.subtract(velocity, (0.1, -0.2)) / (1.0 + r)
        inside = (1.0 + r) * circle_force(FINITE, relative, slip)
        assert np.abs(inside - f).max() < 0.01 * np.abs(inside).max()
        drift = np.array((0.1, -0.2)) / (WIDER * r)
        outside = film.pair.force * r * circle_force(outer, np.array(ring_place) / WIDER, drift)
        pushed = np.array(rates[2:]) * 4e-3 * C * SPEED**2 / unit
        assert np.abs(outside - inside - pushed).max() < 0.01 * np.abs(outside).max()


def circle_force(bearing, place, velocity):
    """Return the force of a film of finite length by the tests' own solution."""
    cut, ratio = open_circle((*place, *velocity)), bearing.length / bearing.diameter
    # From μΩR³L/C² to μΩRL³/C².
    return plain_program.force([cut], ratio, place, velocity) / (2.0 * ratio) ** 2


def test_without_load_a_ring_at_half_its_whirl_feels_nothing():
    _, motion = kernel(load=0.0)
    f_x, f_y, rates = motion.force((0.0, 0.0, 0.0, 0.0), [0.0, 0.0], MU, SPEED)
    assert (f_x, f_y, *rates) == (0.0, 0.0, 0.0, 0.0)


def test_in_a_run_up_the_ring_has_the_speed_of_equilibrium():
    film, motion = kernel()
    at = ((0.3, 0.2, 0.1, 0.0), [0.1, 0.2], MU)
    motion.force(*at, SPEED)
    moving = motion.force.__self__
    assert moving._ratio(MU, SPEED) == ratio(film)  # at one speed the very value
    for speed in SPEED * np.geomspace(0.05, 100.0, 25):
        points = OperatingPoints.of(SMALL, viscosity=MU, speed=speed, load=1.0)
        expected = float(film.speed_ratio(points))
        assert moving._ratio(MU, float(speed)) == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("name", ["floating ring", "floating ring, heavy"])
def test_a_run_up_passes_a_speed_as_it_moves_there_at_constant_speed(name):
    rotor = replace(SHEET.rotor, shaft_stiffness=np.inf, imbalance=6e-6)
    machine = replace(SHEET, bearing=RINGS[name], rotor=rotor)
    up = simulate(machine, 495.0, revolutions=60, final_speed=505.0, tolerance=1e-7)
    steady = simulate(machine, 500.0, revolutions=30, tolerance=1e-7)
    middle = np.argmin(np.abs(up.speed - 500.0))
    passing, orbit = up.journal[middle - 32 : middle + 32], steady.journal[-65:-1]
    assert np.ptp(passing, axis=0) == pytest.approx(np.ptp(orbit, axis=0), rel=0.03)


@pytest.mark.parametrize("stiffness", [np.inf, 1e6])
@pytest.mark.parametrize("place", [0.5, 1.5, 4.0])
def test_a_journal_released_far_off_takes_its_ring_along(stiffness, place):
    """Where the ring's equilibrium would leave it no film, both films are equally thin at first."""
    machine = replace(MACHINE, rotor=Rotor(mass=0.2, shaft_stiffness=stiffness))
    motion = simulate(machine, SPEED, revolutions=8, start=(place * C, 0.0))
    gap = film_gap(SMALL, motion.journal / C, motion.inner / C)
    assert np.all(gap > 0.0)
    ring_at = ring_equilibrium(machine, SPEED).outer.position if place < 0.9 else (
        np.array([place * C * WIDER / (1.0 + WIDER), 0.0])
    )  # fmt: skip
    assert motion.inner[0] == pytest.approx(ring_at, abs=1e-12)
    relative = np.hypot(*(motion.journal - motion.inner).T) / C
    around = np.hypot(*motion.inner.T) / (WIDER * C)
    assert gap == pytest.approx(np.minimum(1.0 - relative, WIDER * (1.0 - around)), rel=1e-12)


def test_a_release_gives_the_thinner_of_the_two_films():
    found = release(MACHINE, SPEED, kick=2.0 * C, revolutions=16, tolerance=1e-6)
    motion = found.motion
    gap = C * film_gap(SMALL, motion.journal / C, motion.inner / C)
    assert np.array_equal(found.film, gap)
    assert found.film.max() < C
    # The linear motion begins where the nonlinear one does.
    assert found.linear[0] == pytest.approx(motion.journal[0], abs=1e-12)


def test_a_start_that_leaves_the_journal_no_film_is_refused():
    start = last_state(simulate(MACHINE, SPEED, revolutions=1))
    away = replace(start, inner=np.array([2.0 * C, 0.0]))
    with pytest.raises(ValueError, match=r"start\.inner = .*: leaves no film"):
        simulate(MACHINE, SPEED, revolutions=1, start=away)


def test_above_its_onset_the_journal_whirls_in_its_ring_and_the_films_hold_it():
    """The limit cycle that such machines run on: at the inner film's frequency, films open."""
    inner, _ = mode_onsets(MACHINE)
    speed = 1.3 * inner.speed
    motion = simulate(
        MACHINE, speed, revolutions=120, samples_per_revolution=16, start=(0.3 * C, 0.3 * C)
    )
    late = motion.journal[-1024:] - motion.journal[-1024:].mean(axis=0)
    spectrum = np.abs(np.fft.fft(late @ [1.0, 1.0j]))
    whirl = 16.0 * np.fft.fftfreq(len(late))[np.argmax(spectrum)]
    assert whirl == pytest.approx(inner.whirl_ratio, abs=0.03)
    swing = np.hypot(*(motion.journal - motion.inner)[-1024:].T) / C
    assert 0.05 < swing.max() < 0.95


def balanced(kind):
    return replace(ROTORS[kind], imbalance=0.0)


@pytest.mark.parametrize("mass", [0.0, 12.0])
@pytest.mark.parametrize("kind", ["rigid", "massless journals"])
def test_on_films_of_finite_length_a_small_whirl_grows_as_the_eigenvalues_say(mass, kind):
    machine = replace(SHEETS, bearing=ring(SHEETS.bearing, ring_mass=mass), rotor=balanced(kind))
    whirl = linear_theory(machine, 500.0).whirl
    assert abs(measured_growth(machine, 500.0) - whirl.real) < 5e-3 * abs(whirl)
    rest = ring_equilibrium(machine, 500.0)
    still = simulate(machine, 500.0, revolutions=1, tolerance=1e-6)
    gap = machine.bearing.radial_clearance
    assert np.abs(still.inner[:, :2] - rest.outer.position).max() < 2e-3 * gap
    place = rest.inner.position + rest.outer.position
    assert np.abs(still.journal - place).max() < 2e-3 * gap


@pytest.mark.parametrize("mass", [0.0, 12.0])
def test_on_films_of_finite_length_the_energy_of_a_wide_motion_balances(mass):
    gap = SHEETS.bearing.radial_clearance
    rotor = replace(ROTORS["massless journals"], imbalance=0.05 * gap)
    machine = replace(SHEETS, bearing=ring(SHEETS.bearing, ring_mass=mass), rotor=rotor)
    rest = analyse(machine, 500.0).journal_position
    motion = simulate(machine, 500.0, revolutions=1, start=rest + np.array([-0.4, 0.2]) * gap)
    balance = energy_balance(machine, motion)
    assert np.abs(balance.residual).max() < 1e-6 * balance.exchanged


def test_the_orbit_of_a_small_imbalance_is_that_of_the_linear_theory():
    gap = SHEETS.bearing.radial_clearance
    machine = replace(SHEETS, rotor=replace(ROTORS["rigid"], imbalance=0.01 * gap))
    expected = analyse(machine, 400.0).journal_response
    motion = simulate(machine, 400.0, revolutions=30, tolerance=1e-7)
    late = slice(-64, None)
    phase = np.exp(-1j * motion.angle[late])
    found = 2.0 * np.mean(motion.journal[late] * phase[:, None], axis=0)
    assert np.abs(found - expected).max() < 0.01 * np.abs(expected).max()


def test_in_a_narrow_outer_film_the_ring_stands_and_the_journal_moves_as_in_a_plain_bearing():
    narrow = ring(FINITE, outer_clearance=C / 50.0)
    plain = replace(FINITE, geometry=Plain())
    orbits = [
        simulate(replace(MACHINE, bearing=one), SPEED, revolutions=6, start=(0.5 * C, 0.2 * C))
        for one in (narrow, plain)
    ]
    inside, alone = (one.journal for one in orbits)
    assert np.abs(alone - alone[0]).max() > 0.3 * C
    assert np.abs(inside - alone).max() < 0.03 * C


def test_a_ring_of_two_very_short_finite_films_moves_as_one_of_short_films():
    small = ring(replace(SMALL, length=5e-4), outer_length=7e-4)
    machine, start = replace(MACHINE, bearing=small, load=1e-3), (0.5 * C, 0.2 * C)
    moved = [
        simulate(replace(machine, bearing=replace(small, film=film)), SPEED, revolutions=2,
                 start=start, tolerance=1e-7)
        for film in ("short", "finite")
    ]  # fmt: skip
    short, finite = (np.concatenate([one.journal, one.inner], axis=1) for one in moved)
    assert np.abs(finite - short).max() < 0.02 * np.ptp(short, axis=0).max()


def test_a_motion_on_films_of_finite_length_ends_where_either_is_thinner_than_computed():
    machine = replace(MACHINE, bearing=ring(FINITE, ring_mass=4e-3), load=1.0)
    start = last_state(simulate(machine, SPEED, revolutions=1))
    for away in (np.array([0.0, 0.985 * WIDER * C]), np.array([0.985 * C, 0.0])):
        ring_place = np.array([*away, 0.0, 0.0])
        journal = away if away[1] else np.zeros(2)
        thin = replace(start, journal=journal, disk=journal, inner=ring_place)
        with pytest.raises(TransientError, match=r"thinner than 0\.02 of its clearance"):
            simulate(machine, SPEED, revolutions=1, start=thin)
