"""Tilting pads: a second program, symmetry, limits, frequency, and small motions."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from rotorcalc import (
    JournalBearing,
    Machine,
    TiltingPads,
    analyse,
    onset_speed,
    simulate,
    validity,
)
from rotorcalc.coefficients import dynamics, equilibrium, stiffness_and_damping
from rotorcalc.films import FilmDynamics, film_of, film_state, reduced
from rotorcalc.films.state import OperatingPoints
from rotorcalc.films.tilting.family import family
from rotorcalc.films.tilting.pivots import pivots_of
from rotorcalc.modes import state_matrix
from tests.films import plain_program
from tests.machines import ROTORS, SHEET

DEGREE = math.pi / 180
MANY = (3, 4, 5, 6)


def on(geometry, ratio=0.5):
    return JournalBearing(
        diameter=0.1, length=0.1 * ratio, radial_clearance=1e-4, geometry=geometry
    )


def at_sigma(bearing, sigma):
    return OperatingPoints.at_sommerfeld(bearing, sigma)


def coefficients_at(film, sigma, whirl_ratio):
    """Return k and c in units of the load, tilts eliminated at a whirl ratio."""
    found = film.dynamics(at_sigma(film.bearing, sigma))
    free = FilmDynamics(found.stiffness, found.damping, np.zeros(film.inner))
    return [4.0 * sigma * one for one in reduced(free, whirl_ratio)]


@pytest.mark.parametrize(
    ("whirl_ratio", "k_XX", "k_YY"),
    [(1.0, 3.749, 2.611), (0.5, 5.130, 3.827), (1e-4, 6.034, 4.504)],
)
def test_five_pads_with_the_load_between(whirl_ratio, k_XX, k_YY):
    """Numbers on which three programs agree: two of finite volumes, one of this project before."""
    film = film_of(on(TiltingPads()))
    state = film.state(at_sigma(film.bearing, 0.5))
    assert state.position == pytest.approx([0.2389, 0.0], abs=2e-4)
    k, c = coefficients_at(film, 0.5, whirl_ratio)
    assert np.diag(k) == pytest.approx([k_XX, k_YY], rel=3e-3)
    if whirl_ratio == 1.0:
        assert np.diag(c) == pytest.approx([5.420, 4.454], rel=3e-3)


@pytest.mark.parametrize("load", ["on pad", "between pads"])
@pytest.mark.parametrize("number", MANY)
def test_pads_that_stand_evenly_about_the_load_couple_nothing(number, load):
    film = film_of(on(TiltingPads(number=number, load=load, arc=50 * DEGREE)))
    state = film.state(at_sigma(film.bearing, np.array([0.1, 0.5, 5.0, np.inf])))
    assert np.all(state.position[:, 1] == 0.0)
    for whirl_ratio in (0.3, 1.0):
        for one in coefficients_at(film, 0.5, whirl_ratio):
            assert abs(one[0, 1]) + abs(one[1, 0]) < 1e-12 * one[0, 0]


@pytest.mark.parametrize(
    ("geometry", "sigma"),
    [
        (TiltingPads(), 0.5),
        (TiltingPads(preload=0.1), 0.15),  # the upper pad carries nothing
        (TiltingPads(number=4, arc=75 * DEGREE, pivot_offset=0.6, load="on pad"), 1.0),
    ],
)
def test_a_second_program_agrees(geometry, sigma):
    """Forces and moments of the tilted pads, and K and C from differences of each pad's force."""
    film = film_of(on(geometry))
    state = film.state(at_sigma(film.bearing, sigma))
    tilts = film.tilts(at_sigma(film.bearing, sigma)) * 0.05 / 1e-4
    pivots = pivots_of(film.bearing)
    arc, pad = geometry.arc, (-geometry.pivot_offset * geometry.arc, 0.0)
    pad = (pad[0], pad[0] + arc, 0.0, 0.0)
    force, K, C = np.zeros(2), np.zeros((2, 2)), np.zeros((2, 2))
    for angle, tilt, unloaded in zip(pivots.angle, tilts, state.unloaded_pads, strict=True):
        n, t = (math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))
        place = np.array([
            geometry.preload + np.dot(state.position, n), np.dot(state.position, t) + tilt
        ])  # fmt: skip
        f = plain_program.force([pad], 0.5, place)
        if unloaded:
            assert np.abs(f).max() < 1e-9
            continue
        assert abs(f[1]) < 2e-3 * abs(f[0])
        force += np.array([n, t]).T @ f
        k, c = plain_program.coefficients([pad], 0.5, place)
        Z = k + 1j * c
        z = Z[0, 0] - Z[0, 1] * Z[1, 0] / Z[1, 1]
        K, C = K + z.real * np.outer(n, n), C + z.imag * np.outer(n, n)
    assert force == pytest.approx([-0.25 / sigma, 0.0], abs=3e-3 * 0.25 / sigma)
    assert np.abs(K - state.stiffness).max() < 5e-3 * np.abs(K).max()
    assert np.abs(C - state.damping).max() < 5e-3 * np.abs(C).max()


@pytest.mark.parametrize("offset", [0.5, 0.55, 0.6])
def test_a_pads_films_are_the_stable_ones(offset):
    """The second root, with the pad tilted the other way, has K_ηη below 0."""
    one = family(60 * DEGREE, offset, 4.0, coarse=True)
    assert one.first == 0.0 if offset == 0.5 else one.first < 0.0
    xi = np.linspace(one.first, one.last, 200)[1:]
    films = one.at(xi)
    assert np.all(films.stiffness[:, 1, 1] > 0.0)
    assert np.all(np.diff(films.force) > 0.0)
    force, slope = one.force(xi)
    step = 1e-6
    assert np.gradient(force, xi)[60:-60] == pytest.approx(slope[60:-60], rel=0.05)
    reduced = (
        films.stiffness[:, 0, 0]
        - films.stiffness[:, 0, 1] * films.stiffness[:, 1, 0] / (films.stiffness[:, 1, 1])
    )
    assert np.median(np.abs(reduced / slope - 1.0)) < 5e-3
    assert not one.at(np.array(one.first - step)).loaded


def test_a_pads_films_are_known_to_half_a_per_cent():
    for geometry in (TiltingPads(), TiltingPads(pivot_offset=0.6, load="on pad")):
        for sigma in (0.05, 0.5, 5.0):
            found = film_of(on(geometry, 1.0)).accuracy(sigma)
            assert found.place < 5e-4
            assert max(found.stiffness, found.damping) < 5e-3


def test_one_pad_alone_holds_no_journal():
    with pytest.raises(ValueError, match="preload = 0: only the pad under the load"):
        film_state(on(TiltingPads(number=3, preload=0.0, load="on pad")), 1.0)


def test_without_preload_upper_pads_carry_nothing():
    film = film_of(on(TiltingPads(preload=0.0)))
    state = film.state(at_sigma(film.bearing, np.array([0.5, np.inf])))
    assert state.unloaded_pads.tolist() == [[False, True, True, True, False]] * 2
    assert np.all(np.isfinite(state.stiffness))


def test_a_load_between_two_films_of_a_pad_is_carried():
    """A pad with its pivot behind its middle gives up its film with a force left."""
    film = film_of(on(TiltingPads(pivot_offset=0.55, preload=0.1)))
    load = np.geomspace(0.1, 2.0, 300)
    rest = film._rest(at_sigma(film.bearing, 0.25 / load))
    carried = (rest.pads.force * pivots_of(film.bearing).frames[:, 0, 0]).sum(axis=-1)
    assert carried == pytest.approx(load, rel=1e-8)


def machine(geometry, **changes) -> Machine:
    return replace(SHEET, bearing=replace(SHEET.bearing, geometry=geometry), **changes)


def test_preload_keeps_a_machine_from_whirling():
    """A light pad's damping is as 1 − 1/(4ν²), below 0 for a whirl slower than half the speed."""
    assert math.isinf(onset_speed(machine(TiltingPads())).speed)
    assert math.isinf(onset_speed(machine(TiltingPads(number=4))).speed)
    whirls = onset_speed(machine(TiltingPads(preload=0.0)))
    assert 0.4 < whirls.whirl_frequency / whirls.speed < 0.5
    for share, grows in ((0.99, False), (1.01, True)):
        film = dynamics(machine(TiltingPads(preload=0.0)), share * whirls.speed)
        A = state_matrix(SHEET.rotor, film.stiffness, film.damping, inertia=film.inertia)
        assert (np.linalg.eigvals(A).real.max() > 0.0) == grows


@pytest.mark.parametrize("inertia", [0.0, 2e-4])
def test_a_small_motion_is_the_linear_theorys(inertia):
    """Journal and tilts from a place beside their rest, by the full forces and by the matrix."""
    one = machine(TiltingPads(pad_inertia=inertia), rotor=replace(ROTORS["rigid"], imbalance=0.0))
    speed, C = 600.0, SHEET.bearing.radial_clearance
    rest = equilibrium(one, speed).film.position * C
    start = rest + 1e-3 * C * np.array([0.6, 0.8])
    # The tables of motion know the rest itself to some 2e-5 C.
    found, still = (simulate(one, speed, revolutions=1, start=each) for each in (start, rest))
    film = dynamics(one, speed)
    A = state_matrix(one.rotor, film.stiffness, film.damping, inertia=film.inertia)
    q = np.zeros(len(A))
    q[:2] = start - rest
    for i in (16, 32, 64):
        expected = (expm(A * found.time[i]) @ q)[:2]
        assert np.abs(found.journal[i] - still.journal[i] - expected).max() < 1.5e-2 * 1e-3 * C


def _same_matrix(found, expected):
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-14 * np.abs(expected).max())


def test_coefficients_depend_on_the_whirl_ratio():
    one, ratio = machine(TiltingPads()), np.array([0.25, 0.5, 1.0])
    K, C = stiffness_and_damping(one, 600.0, whirl_ratio=ratio)
    assert K.shape == C.shape == (3, 2, 2)
    # By symmetry the cross terms are zero, but for the rounding of the direct ones.
    _same_matrix(K[2], stiffness_and_damping(one, 600.0)[0])
    for i, each in enumerate(ratio):
        k, c = reduced(dynamics(one, 600.0), each * 600.0)
        _same_matrix(K[i], k)
        _same_matrix(C[i], c)
    assert K[0, 0, 0] > K[1, 0, 0] > K[2, 0, 0]
    for wrong in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(ValueError, match=r"whirl_ratio = .*must be positive and finite"):
            stiffness_and_damping(one, 600.0, whirl_ratio=[0.5, wrong])


def test_a_heavier_pads_own_motion_is_slower():
    """A pad's tilt and rate are states; its fastest motion is C_ηη over its inertia."""
    fastest = []
    for inertia in (1e-6, 1e-5):
        film = dynamics(machine(TiltingPads(pad_inertia=inertia)), 600.0)
        A = state_matrix(SHEET.rotor, film.stiffness, film.damping, inertia=film.inertia)
        assert np.all(film.inertia == inertia / SHEET.bearing.radius**2)
        fastest.append(np.abs(np.linalg.eigvals(A)).max())
        own = np.diag(film.damping)[2:].max() / film.inertia[0]
        assert fastest[-1] == pytest.approx(own, rel=0.05)
    assert fastest[0] == pytest.approx(10.0 * fastest[1], rel=0.05)


def test_the_assumptions_name_pads_that_carry_nothing():
    for preload, level in ((0.3, "good"), (0.0, "caution")):
        checks = validity(analyse(machine(TiltingPads(preload=preload)), 600.0))
        (found,) = (check for check in checks if check.name == "Pads that carry nothing")
        assert found.worst == level


def test_a_journal_set_far_off_finds_its_pads_out_of_its_way():
    """At rest the upper pads are tilted as no journal so near to them would leave them."""
    film = film_of(on(TiltingPads()))
    points, motion = at_sigma(film.bearing, 0.5), film.motion()
    for place in ([0.5, 0.3], [-0.6, 0.1], [0.0, -0.65]):
        states = motion.beside(points, np.array(place))
        assert motion.gap(np.array(place), states) > 0.2 * film.gap(place)
    rest = film.state(points)
    assert motion.beside(points, rest.position) == pytest.approx(motion.rest(points))
    gap = motion.gap(rest.position, motion.rest(points))
    assert gap == pytest.approx(rest.minimum_thickness, rel=1e-3)
