"""Modes: eigenvalues against the equations of motion, and branches that keep their identity."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotorcalc import PRESETS, Rotor, modes
from rotorcalc.coefficients import equilibrium
from tests.machines import (
    EPS,
    RPM,
    SHEET,
    characteristic_polynomial,
    log_uniform,
    machines,
    unstable_roots,
    with_rotor,
)

WITH_JOURNALS = with_rotor(journal_mass=10.0, disk_damping=500.0)
MODELS = [
    pytest.param(SHEET, False, 4, id="rigid"),
    pytest.param(SHEET, True, 6, id="flexible"),
    pytest.param(WITH_JOURNALS, False, 4, id="rigid with damping"),
    pytest.param(WITH_JOURNALS, True, 8, id="with journal mass"),
    pytest.param(
        with_rotor(shaft_stiffness=math.inf, journal_mass=10.0), True, 4, id="rigid shaft"
    ),
]
SPEEDS = [600 * RPM, 6000 * RPM, 12000 * RPM]

eigenvalue = st.complex_numbers(min_magnitude=1e-3, max_magnitude=1e6, allow_nan=False)


def film(machine, speed):
    state = equilibrium(machine, speed)
    return state.stiffness, state.damping


def eigenvalues(machine, speed, *, flexible=True):
    return modes.eigenvalues(machine.rotor, *film(machine, speed), flexible=flexible)


def by_value(lam):
    """Return eigenvalues in an order that small errors do not change."""
    return np.array(sorted(lam, key=lambda v: (round(v.imag, 3), round(v.real, 3))))


# Eigenvalues


@pytest.mark.parametrize(("machine", "flexible", "states"), MODELS)
@pytest.mark.parametrize("speed", SPEEDS)
def test_characteristic_polynomial_is_that_of_the_equations_of_motion(
    machine, flexible, states, speed
):
    """Product of (λ − λ_i) against the exact determinant of the 2×2 impedance."""
    lam = eigenvalues(machine, speed, flexible=flexible) / speed
    assert lam.shape == (states,)
    exact = characteristic_polynomial(
        machine.rotor, *film(machine, speed), speed, flexible=flexible
    )
    monic = np.array([float(c / exact[0]) for c in exact])
    assert len(monic) == states + 1
    # Relative to the polynomial of the moduli, which no cancellation makes small.
    size = np.poly(-np.abs(lam)).real
    assert np.poly(lam).real / size == pytest.approx(monic / size, abs=1e-10)


@given(machines(damped=True, journals=True), st.floats(-2, 2), st.booleans())
def test_coefficients_of_the_characteristic_polynomial_are_the_exact_ones(machine, power, flexible):
    """Each to rounding of its own; det K and the like to that of their terms."""
    speed = 10.0**power * 600 * RPM
    K, C = film(machine, speed)
    found = modes.characteristic_polynomial(machine.rotor, K, C, flexible=flexible)
    exact = characteristic_polynomial(machine.rotor, K, C, speed, flexible=flexible)[::-1]
    unit = exact[0] / Fraction(float(found[0]))
    per_speed = [float(c / unit / Fraction(speed) ** i) for i, c in enumerate(exact)]
    assert found == pytest.approx(np.array(per_speed), rel=128 * EPS)


@pytest.mark.parametrize(("machine", "flexible", "states"), MODELS)
def test_free_motion_obeys_newtons_law(machine, flexible, states):
    """M q̈ + C q̇ + K q = 0 for the disk and the journal, each mode put in by itself."""
    K, C = film(machine, 6000 * RPM)
    rotor = machine.rotor
    shapes = modes.mode_shapes(rotor, K, C, flexible=flexible)
    norm = np.linalg.norm(modes.state_matrix(rotor, K, C, flexible=flexible), 2)
    assert shapes.eigenvalues.shape == (states,)
    for i, (lam, disk, journal) in enumerate(
        zip(shapes.eigenvalues, shapes.disk, shapes.journal, strict=True)
    ):
        inertia = rotor.disk_mass * lam**2 * disk + rotor.disk_damping * lam * disk
        bearing = rotor.journal_mass * lam**2 * journal + lam * (C @ journal) + K @ journal
        if states == 4:
            assert np.array_equal(disk, journal)
            balance = [inertia + bearing]
        else:
            shaft = rotor.shaft_stiffness * (disk - journal)
            balance = [inertia + shaft, bearing - shaft]
        # Av = λv to EPS ‖A‖ ‖v‖, in accelerations; forces are those of the mass or of C λ.
        rounding = 64 * EPS * norm * np.linalg.norm(shapes.vectors[:, i])
        assert np.abs(balance).max() <= rounding * (rotor.half_mass + np.abs(C).max() / np.abs(lam))
        assert np.abs(inertia).max() > 1e4 * rounding * rotor.half_mass  # or it would prove nothing


def test_eigenvalues_broadcast_over_speed():
    K, C = film(SHEET, np.array(SPEEDS))
    together = modes.eigenvalues(SHEET.rotor, K, C)
    assert together.shape == (3, 6)
    for i in range(3):
        assert by_value(together[i]) == pytest.approx(
            by_value(modes.eigenvalues(SHEET.rotor, K[i], C[i])), rel=1e-12
        )
    assert modes.eigenvalues(SHEET.rotor, K[:0], C[:0]).shape == (0, 6)


def test_rigid_isotropic_rotor_has_the_roots_of_its_quadratic():
    """With z = x + jy a film c, κ of the centre leaves Mλ² + cλ − jκ = 0 and its conjugate."""
    M, c, kappa = 100.0, 3e4, 5e6
    lam = modes.eigenvalues(Rotor(mass=2 * M), np.array([[0, kappa], [-kappa, 0]]), c * np.eye(2))
    roots = np.roots([M, c, -1j * kappa])
    assert by_value(lam) == pytest.approx(by_value([*roots, *roots.conj()]), rel=1e-12)


def test_flexible_rotor_tends_to_the_rigid_one_and_two_modes_of_the_shaft_on_the_film():
    rigid = eigenvalues(SHEET, 6000 * RPM, flexible=False)
    fast = []
    for stiffness in (1e12, 1e14):
        stiff = eigenvalues(with_rotor(shaft_stiffness=stiffness), 6000 * RPM)
        stiff = stiff[np.argsort(np.abs(stiff))]
        # The modes differ by the force of the mass over that of the shaft, once or twice, and by
        # the rounding of the largest, −K_rot/C.
        error = 2 * SHEET.rotor.half_mass * np.abs(rigid).max() ** 2 / stiffness
        error += 10 * EPS * np.abs(stiff).max() / np.abs(rigid).min()
        assert by_value(stiff[:4]) == pytest.approx(by_value(rigid), rel=error)
        fast.append(stiff[4:].real)
    C = np.linalg.eigvalsh(film(SHEET, 6000 * RPM)[1])
    # The disk does not stand quite still: C²/(K_rot M) of it.
    error = 2 * C.max() ** 2 / (1e14 * SHEET.rotor.half_mass)
    assert np.sort(fast[1]) == pytest.approx(np.sort(-1e14 / C), rel=error)


@pytest.mark.parametrize("journal_mass", [1e-2, 1e-4])
def test_a_vanishing_journal_mass_leaves_the_six_states(journal_mass):
    """The other two modes run away as −C/M_j; the rest move by as much as the mass."""
    massless = eigenvalues(SHEET, 6000 * RPM)
    lam = eigenvalues(with_rotor(journal_mass=journal_mass), 6000 * RPM)
    lam = lam[np.argsort(np.abs(lam))]
    distance = np.abs(by_value(lam[:6]) - by_value(massless)) / np.abs(by_value(massless))
    assert distance.max() <= journal_mass / 1.0  # journals of 1 kg would move a mode by itself
    assert distance.max() >= 1e-3 * journal_mass
    C = film(SHEET, 6000 * RPM)[1]
    fast = np.sort(-np.linalg.eigvalsh(C) / journal_mass)
    assert np.sort(lam[6:].real) == pytest.approx(fast, rel=2 * journal_mass)


@given(machines(damped=True, journals=True), st.floats(0.1, 3.0))
@settings(max_examples=40)
def test_refined_eigenvalues_have_the_exact_number_of_unstable_ones(machine, share):
    speed = share * 6000 * RPM
    lam = modes.refined_eigenvalues(machine.rotor, *film(machine, speed))
    growing = {(round(v.imag / speed, 6)) for v in lam[np.isfinite(lam)] if v.real > 0}
    assert len(growing) == unstable_roots(machine, speed)


@pytest.mark.parametrize(("machine", "flexible", "states"), MODELS)
@pytest.mark.parametrize("speed", SPEEDS)
def test_refined_eigenvalues_are_the_matrix_eigenvalues(machine, flexible, states, speed):
    rough = eigenvalues(machine, speed, flexible=flexible)
    refined = modes.refined_eigenvalues(machine.rotor, *film(machine, speed), flexible=flexible)
    assert refined.size > states
    error = 100 * EPS * np.abs(rough).max()
    assert np.abs(refined[:states] - rough).max() <= error
    # The rest have begun elsewhere: they are among the others, or have not settled.
    for lam in refined[states:][np.isfinite(refined[states:])]:
        assert np.abs(rough - lam).min() <= error


@pytest.mark.parametrize("stiffening", [1e2, 1e4, 1e6])
def test_refined_growth_survives_an_overwhelming_film(stiffening):
    """Mλ² + cλ − jκ = 0, κ = cΩ/2: the slow root grows by Mκ²/c³·(1 − 5(Mκ/c²)² …)."""
    M, W = 100.0, 500.0
    c = stiffening * M * W
    kappa = c * W / 2
    K, C = np.array([[0, kappa], [-kappa, 0]]), c * np.eye(2)
    refined = modes.refined_eigenvalues(Rotor(mass=2 * M), K, C)
    growth = np.nanmax(refined.real)
    # λ is right to some EPS of W, of which the growth is 1/(4·stiffening).
    assert growth == pytest.approx(
        M * kappa**2 / c**3, rel=16 * EPS * stiffening + 5 / (2 * stiffening) ** 2
    )


# What eigenvalues say


@given(eigenvalue)
def test_damping_ratio_and_frequencies_recover_the_eigenvalue(lam):
    """λ = −ζω_n ± jω_n√(1−ζ²)."""
    zeta, w = modes.damping_ratio(lam), modes.natural_frequency(lam)
    assert -zeta * w == pytest.approx(lam.real, rel=4 * EPS)
    assert modes.damped_frequency(lam) == abs(lam.imag)
    assert w**2 == pytest.approx(lam.real**2 + lam.imag**2, rel=8 * EPS)
    assert -1 <= zeta <= 1


@given(st.floats(-0.99, 0.99), log_uniform(1e-2, 1e5))
def test_logarithmic_decrement_is_that_of_a_decaying_oscillation(zeta, w):
    """δ = 2πζ/√(1−ζ²), the logarithm of two amplitudes a period apart."""
    lam = w * complex(-zeta, math.sqrt(1 - zeta**2))
    decrement = float(modes.logarithmic_decrement(lam))
    assert decrement == pytest.approx(2 * math.pi * zeta / math.sqrt(1 - zeta**2), rel=64 * EPS)
    period = 2 * math.pi / float(modes.damped_frequency(lam))
    decay = abs(np.exp(lam * 0.0)) / abs(np.exp(lam * period))
    assert math.log(decay) == pytest.approx(decrement, rel=1e-12, abs=1e-14)


def test_a_mode_that_does_not_oscillate_has_no_frequency():
    assert modes.logarithmic_decrement(-3.0) == math.inf
    assert modes.logarithmic_decrement(3.0) == -math.inf
    assert modes.damping_ratio(-3.0) == 1.0
    assert modes.damping_ratio(3.0) == -1.0
    assert modes.damped_frequency(-3.0) == 0.0


@given(st.lists(eigenvalue, min_size=1, max_size=6), log_uniform(1e-3, 1e3))
def test_ratios_do_not_depend_on_the_unit_of_time(values, scale):
    lam = np.array(values)
    assert modes.damping_ratio(scale * lam) == pytest.approx(modes.damping_ratio(lam), rel=16 * EPS)
    assert modes.natural_frequency(scale * lam) == pytest.approx(
        scale * modes.natural_frequency(lam), rel=16 * EPS
    )


def test_undamped_frequency_of_a_mass_on_a_spring():
    assert modes.undamped_frequency(400.0, 4.0) == 10.0
    assert modes.undamped_frequency([400.0, 0.0], 4.0).tolist() == [10.0, 0.0]
    assert math.isnan(modes.undamped_frequency(-1.0, 4.0))


# Branches


def crossing(n, rng):
    """Return branches over n points, two of which cross in both parts, and the rows in disorder."""
    t = np.linspace(-1, 1, n)
    branches = np.stack(
        [
            -1 + 0.3 * t + 5j + 2j * t,
            -1 - 0.3 * t + 5j - 2j * t,
            -4 + 1j * t**2,
            -0.5 + 0.1 * t + 0j,
        ],
        axis=-1,
    )
    return branches, np.stack([row[rng.permutation(4)] for row in branches])


def assert_same_rows(followed, given_rows):
    """No value is changed, lost or found twice in any row."""
    assert followed.shape == np.shape(given_rows)
    for row, values in zip(followed, given_rows, strict=True):
        assert sorted(row, key=lambda v: (v.real, v.imag)) == sorted(
            values, key=lambda v: (v.real, v.imag)
        )


@given(st.integers(0, 10**6), st.sampled_from([20, 21, 50, 101, 400]))
def test_branches_keep_their_identity_where_they_cross(seed, n):
    """With 21, 101 points two eigenvalues coincide at one of them."""
    branches, disordered = crossing(n, np.random.default_rng(seed))
    followed = modes.follow_branches(disordered)
    assert_same_rows(followed, disordered)
    first = np.lexsort((branches[0].real, -branches[0].imag))
    assert np.array_equal(followed, branches[:, first])


@pytest.mark.parametrize("machine", [SHEET, with_rotor(shaft_stiffness=1e7), WITH_JOURNALS])
def test_branches_of_a_machine_do_not_depend_on_how_densely_they_are_followed(machine):
    coarse_speeds = np.linspace(200 * RPM, 12000 * RPM, 150)
    fine_speeds = np.linspace(200 * RPM, 12000 * RPM, 149 * 8 + 1)
    coarse = modes.follow_branches(eigenvalues(machine, coarse_speeds))
    fine = modes.follow_branches(eigenvalues(machine, fine_speeds))
    assert coarse == pytest.approx(fine[::8], rel=1e-9)
    assert_same_rows(fine, eigenvalues(machine, fine_speeds))
    # Continuity: steps of an eighth shorten the longest stride to about an eighth, not to itself.
    longest = [
        np.abs(np.diff(rows[n:], axis=0)).max(axis=0) for rows, n in ((coarse, 1), (fine, 8))
    ]
    assert np.all(longest[1] <= longest[0] / 4)


@pytest.mark.parametrize("name", PRESETS)
def test_following_changes_no_value(name):
    preset = PRESETS[name]
    rows = eigenvalues(preset.machine, np.linspace(0.01, 1, 200) * preset.top_speed)
    assert_same_rows(modes.follow_branches(rows), rows)


def test_following_leaves_its_argument_alone():
    rows = eigenvalues(SHEET, np.linspace(100.0, 1000.0, 20))
    before = rows.copy()
    modes.follow_branches(rows)
    assert np.array_equal(rows, before)


@pytest.mark.parametrize("n", [0, 1, 2])
def test_short_sweeps_are_followed(n):
    rows = eigenvalues(SHEET, np.linspace(100.0, 101.0, n))
    assert_same_rows(modes.follow_branches(rows), rows)


def test_the_first_row_runs_from_the_highest_frequency_down():
    first = modes.follow_branches(eigenvalues(SHEET, np.array(SPEEDS)))[0]
    assert np.all(np.diff(first.imag) <= 0)


def test_the_least_damped_mode_has_the_smallest_decrement_not_the_slowest_decay():
    slow, ringing, real = -30.0 + 319.0j, -40.0 + 854.0j, -1.0 + 0.0j
    values = np.array([[slow, ringing, real, slow.conjugate()], [real] * 4])
    assert modes.leading(values)[0] == slow
    assert modes.least_damped(values)[0] == ringing
    assert np.isnan(modes.least_damped(values)[1])
    # Where one grows, both rules say so.
    assert modes.least_damped([slow, 1.0 + 100.0j]) == modes.leading([slow, 1.0 + 100.0j])
