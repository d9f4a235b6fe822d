"""Motions of a journal and its floating ring: what only a ring does."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import Rotor, bifurcation, hopf, mode_onsets, ring_equilibrium, simulate
from rotorcalc.films import OperatingPoints, film_of
from rotorcalc.films.short import film_force
from rotorcalc.nonlinear.equations import film_gap
from rotorcalc.nonlinear.release import release
from rotorcalc.nonlinear.transient import last_state
from tests.films.models import RINGS
from tests.films.test_ring import MACHINE, SMALL, SPEED, ring
from tests.machines import SHEET

C, WIDER = SMALL.radial_clearance, 3.5
MU = MACHINE.viscosity


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


def forces(film, r, moving, ring_place, ring_velocity):
    """Return the force of the inner film on the journal and of the outer one on the ring."""
    place, velocity = np.subtract(moving, [ring_place, ring_velocity])
    inside = film_force(place, velocity / (1.0 + r))
    outside = film_force(np.array(ring_place) / WIDER, np.array(ring_velocity) / (WIDER * r))
    return (1.0 + r) * inside, film.pair.force * r * outside


def ratio(film, load=1.0):
    points = OperatingPoints.of(film.bearing, viscosity=MU, speed=SPEED, load=load)
    return float(film.speed_ratio(points))


def test_a_massless_ring_moves_so_that_both_films_load_it_alike():
    film, motion = kernel()
    r = ratio(film)
    for place, ring_place, velocity in moves(40):
        f_x, f_y, found = motion.force((*place, *velocity), ring_place, MU, SPEED)
        inside, outside = forces(film, r, (place, velocity), ring_place, found)
        size = np.hypot(f_x, f_y)
        assert inside == pytest.approx([f_x, f_y], abs=1e-12 * size)
        assert outside == pytest.approx(inside, abs=1e-8 * size)
        dx, dy, again = motion.velocity((*place, f_x, f_y), ring_place, MU, SPEED)
        assert [dx, dy] == pytest.approx(velocity, abs=1e-7)
        assert again == pytest.approx(found, abs=1e-7)


def test_a_ring_with_a_mass_is_pushed_by_both_films():
    mass = 4e-3
    film, motion = kernel(ring(ring_mass=mass))
    r, unit = ratio(film), MU * SPEED * 4e-3 * 5e-3**3 / C**2
    for place, ring_place, velocity in moves(10):
        spin = (0.1, -0.2)
        f_x, f_y, rates = motion.force((*place, *velocity), [*ring_place, *spin], MU, SPEED)
        inside, outside = forces(film, r, (place, velocity), ring_place, spin)
        assert [f_x, f_y] == pytest.approx(inside, rel=1e-12)
        assert rates[:2] == list(spin)
        pushed = unit * (outside - inside) / (mass * C * SPEED**2)
        assert rates[2:] == pytest.approx(pushed, rel=1e-9)
        dx, dy, same = motion.velocity((*place, f_x, f_y), [*ring_place, *spin], MU, SPEED)
        assert [dx, dy] == pytest.approx(velocity, abs=1e-9)
        assert same == pytest.approx(rates, rel=1e-9)


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


@pytest.mark.parametrize("computation", [bifurcation, hopf])
def test_limit_cycles_are_refused_in_words(computation):
    with pytest.raises(ValueError, match="inner coordinates"):
        computation(MACHINE)
