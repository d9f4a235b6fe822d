"""Slow whirls beside the very fast rates of a narrow film, against sixty digits."""

import math

import mpmath
import numpy as np
import pytest
from mpmath import mp

from rotorcalc import (
    FloatingRing,
    JournalBearing,
    Machine,
    Oil,
    Rotor,
    mode_onsets,
    modes,
    onset_speed,
    state_matrices,
    wide_spectra,
)
from rotorcalc.coefficients import dynamics
from rotorcalc.onset.growth import growth
from tests.machines import RPM


def narrow(*, share=0.01, film="short", **rotor):
    """Return a machine whose outer film is this share of the inner one."""
    ring = FloatingRing(
        outer_radius=1.31 * 0.02815,
        outer_length=0.986 * 0.0444,
        outer_clearance=share * 51.3e-6,
        ring_mass=0.00187,
    )
    bearing = JournalBearing(
        diameter=0.0563, length=0.0444, radial_clearance=51.3e-6, film=film, geometry=ring
    )
    oil = Oil(reference_viscosity=0.0962, reference_temperature=90.0, temperature_coefficient=0.025)
    rotor = {"mass": 6.73, **rotor}
    return Machine(oil=oil, bearing=bearing, rotor=Rotor(**rotor), temperature=90.0)


def heavy(film=None):
    """Return a heavy rotor on a ring whose outer film is a hundred and fiftieth of the inner."""
    D = 0.0739734007583426
    ring = FloatingRing(
        outer_radius=1.7685370560804612 * D / 2,
        outer_length=1.0059373934222915 * 0.049656036605177235,
        outer_clearance=0.006830460699281248 * 6.93085448941868e-05,
        ring_mass=0.04904320056822405,
    )
    bearing = JournalBearing(
        diameter=D, length=0.049656036605177235, radial_clearance=6.93085448941868e-05,
        film=film, geometry=ring,
    )  # fmt: skip
    oil = Oil(
        reference_viscosity=0.02769255883842011,
        reference_temperature=90.0,
        temperature_coefficient=0.025,
    )
    rotor = Rotor(mass=292.54593477723125, journal_mass=8.541854761704526)
    return Machine(oil=oil, bearing=bearing, rotor=rotor, temperature=90.0)


def exact(machine, speed):
    """Return the eigenvalues of a rigid rotor on a ring in sixty digits, slowest first."""
    film = dynamics(machine, speed)
    mass = [machine.rotor.half_mass] * 2 + film.inertia.tolist()
    n = len(mass)
    with mp.workdps(60):
        A = mpmath.zeros(2 * n)
        for i in range(n):
            A[i, n + i] = 1
            for j in range(n):
                A[n + i, j] = -mp.mpf(float(film.stiffness[i, j])) / mp.mpf(mass[i])
                A[n + i, n + j] = -mp.mpf(float(film.damping[i, j])) / mp.mpf(mass[i])
        return in_order([complex(v) for v in mp.eig(A, left=False, right=False)])


def in_order(values):
    return np.array(sorted(values, key=lambda v: (round(math.log(abs(v)), 5), v.imag)))


@pytest.mark.parametrize("rpm", [0.12, 10900.0])
def test_slow_and_fast_eigenvalues_are_those_of_sixty_digits(rpm):
    machine = narrow()
    true = exact(machine, rpm * RPM)
    assert abs(true[-1]) > 1e14 * abs(true[0])
    film = dynamics(machine, rpm * RPM)
    matrices = (machine.rotor, film.stiffness, film.damping)
    found = in_order(modes.eigenvalues(*matrices, inertia=film.inertia))
    assert np.abs(found / true - 1.0).max() < 1e-7
    shapes = modes.mode_shapes(*matrices, inertia=film.inertia)
    assert in_order(shapes.eigenvalues) == pytest.approx(found, rel=1e-9)
    # The forces on journal and ring balance in each slow mode: its shape is its own.
    mass = np.diag([machine.rotor.half_mass] * 2 + film.inertia.tolist())
    for i in np.argsort(np.abs(shapes.eigenvalues))[:4]:
        lam = shapes.eigenvalues[i]
        motion = np.concatenate([shapes.journal[i], shapes.inner[i]])
        parts = [film.stiffness @ motion, lam * (film.damping @ motion), lam**2 * (mass @ motion)]
        assert np.abs(sum(parts)).max() < 1e-6 * np.abs(parts).max()


@pytest.mark.parametrize(
    ("machine", "onset"),
    [
        pytest.param(narrow(film=None), 10844.389 * RPM, id="a hundredth"),
        pytest.param(heavy(), 991.09485, id="heavy"),
        pytest.param(heavy("short"), 1034.52656, id="heavy, its ring hardly turning at first"),
    ],
)
def test_a_ring_with_a_very_narrow_outer_film_has_its_true_onset(machine, onset):
    """Decay just below it and growth just above, in sixty digits; the inner film's is the same."""
    found = onset_speed(machine)
    assert found.speed == pytest.approx(onset, rel=1e-6)
    below, above = (exact(machine, found.speed * (1.0 + x)).real.max() for x in (-1e-6, 1e-6))
    assert below < 0.0 < above
    inner, outer = mode_onsets(machine)
    assert inner.speed == pytest.approx(found.speed, rel=1e-9)
    assert math.isinf(outer.speed)


def test_a_pole_that_only_the_transposed_matrix_shows_is_passed_aside(monkeypatch):
    """The bad first guesses of the state matrix alone lead to such a one."""
    monkeypatch.setattr(wide_spectra, "_WIDE", math.inf)
    assert [one.mode for one in mode_onsets(heavy())] == ["inner film", "outer film"]


def test_far_below_its_onset_no_speed_grows():
    machine = narrow()
    assert np.all(growth(machine, np.geomspace(1e-2, 1100.0, 40), True) < 0.0)


def test_a_stiffness_without_an_inverse_keeps_the_eigenvalues_of_the_state_matrix():
    """In a batch with others; a part that nothing holds has an eigenvalue of zero."""
    machine = narrow()
    film = dynamics(machine, np.array([500.0, 500.0]))
    K = film.stiffness.copy()
    K[1, :, 0] = 0.0
    found = modes.eigenvalues(machine.rotor, K, film.damping, inertia=film.inertia)
    A = modes.state_matrix(machine.rotor, K, film.damping, inertia=film.inertia)
    assert np.array_equal(found[1], np.linalg.eigvals(A[1]).astype(complex))
    alone = modes.eigenvalues(machine.rotor, K[0], film.damping[0], inertia=film.inertia)
    assert found[0] == pytest.approx(alone, rel=1e-12)


@pytest.mark.parametrize("bends", [False, True])
@pytest.mark.parametrize("inertia", [[0.0, 0.0], [0.3, 0.2]])
def test_the_inverse_of_the_state_matrix_is_that(bends, inertia):
    """With and without masses of the inner coordinates, on a rigid shaft and one that bends."""
    draw = np.random.default_rng(3)
    K, C = draw.normal(size=(2, 3, 4, 4)) + 3.0 * np.eye(4)
    rotor = Rotor(mass=4.0, shaft_stiffness=5.0, journal_mass=0.5, disk_damping=0.2)
    A = state_matrices.with_inner(rotor, K, C, np.array(inertia), bends=bends)
    inverse = state_matrices.inverse_with_inner(rotor, K, C, np.array(inertia), bends=bends)
    assert A @ inverse == pytest.approx(np.broadcast_to(np.eye(A.shape[-1]), A.shape), abs=1e-10)
