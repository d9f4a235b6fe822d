"""Onset and eigenvalues with films that are not the short one, against a pencil of their own."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg

from rotorcalc import analyse, modes, onset_speed, whirl_onset
from rotorcalc.coefficients import dynamics, modified_sommerfeld
from rotorcalc.films import film_coefficients
from rotorcalc.onset.growth import fastest, growth
from rotorcalc.onset.judge import is_unstable, unstable_ranges
from rotorcalc.onset.many import onset_speeds
from rotorcalc.onset.search import search_range
from tests.films.models import BEARINGS, FINITE, MOVING, SHORT_PADS
from tests.machines import ROTORS, SHEET

WHIRLING = [name for name in MOVING if name != "sprung"]


def machine_of(bearing, rotor, load=None):
    return replace(SHEET, bearing=BEARINGS[bearing], rotor=replace(ROTORS[rotor]), load=load)


def pencil(machine, speed, *, flexible=True):
    """Return the finite eigenvalues of M q̈ + C q̇ + K q = 0, as a pencil of first order.

    On a rigid shaft the disk moves with the journal; a mass of zero is left in, and gives infinite
    ones.
    """
    film, rotor = dynamics(machine, speed), machine.rotor
    rigid = rotor.is_rigid or not flexible
    first = 0 if rigid else 2  # where the film's coordinates begin
    n = film.stiffness.shape[-1] + first
    K, C = np.zeros((n, n)), np.zeros((n, n))
    K[first:, first:], C[first:, first:] = film.stiffness, film.damping
    C[:2, :2] += rotor.disk_damping * np.eye(2)
    masses = [rotor.half_mass] * 2 if rigid else [rotor.disk_mass] * 2 + [rotor.journal_mass] * 2
    M = np.diag([*masses, *film.inertia])
    if not rigid:
        tie = np.hstack([np.eye(2), -np.eye(2), np.zeros((2, n - 4))])
        K += rotor.shaft_stiffness * tie.T @ tie
    # Of λ/Ω and over the stiffness: of numbers of eleven decades rounding leaves five digits.
    unit = np.abs(K).max()
    A, B = np.zeros((2 * n, 2 * n)), np.zeros((2 * n, 2 * n))
    A[:n, n:], B[:n, :n] = np.eye(n), np.eye(n)
    A[n:, :n], A[n:, n:], B[n:, n:] = -K / unit, -C * speed / unit, M * speed**2 / unit
    values = scipy.linalg.eigvals(A, B)
    return speed * values[np.isfinite(values) & (np.abs(values) < 1e7)]


@pytest.mark.parametrize("rotor", ROTORS)
@pytest.mark.parametrize("bearing", BEARINGS)
@pytest.mark.parametrize("speed", [300.0, 900.0])
def test_eigenvalues_are_those_of_the_pencil(bearing, rotor, speed):
    machine = machine_of(bearing, rotor)
    film = dynamics(machine, speed)
    matrices = (machine.rotor, film.stiffness, film.damping)
    found = modes.eigenvalues(*matrices, inertia=film.inertia)
    refined = modes.refined_eigenvalues(*matrices, inertia=film.inertia)
    expected = pencil(machine, speed)
    near = found[np.abs(found) < 1e6 * speed]
    assert len(near) <= len(expected) + 2
    for value in near:
        assert np.abs(expected - value).min() <= 1e-5 * abs(value)
        assert np.nanmin(np.abs(refined - value)) <= 1e-6 * abs(value)
    shapes = modes.mode_shapes(*matrices, inertia=film.inertia)
    A = modes.state_matrix(*matrices, inertia=film.inertia)
    residual = A @ shapes.vectors - shapes.vectors * shapes.eigenvalues
    assert np.abs(residual).max() <= 1e-9 * np.abs(A).max() * np.abs(shapes.vectors).max()
    assert shapes.disk.shape == shapes.journal.shape == (len(found), 2)


@pytest.mark.parametrize("rotor", ROTORS)
@pytest.mark.parametrize("bearing", WHIRLING)
def test_the_onset_separates_decay_from_growth(bearing, rotor):
    machine = machine_of(bearing, rotor)
    onset = onset_speed(machine)
    top = min(onset.speed, 3e4)
    for speed in np.geomspace(0.05 * top, 0.999999 * top, 25):
        assert pencil(machine, speed).real.max() < 0.0
    if math.isfinite(onset.speed):
        values = pencil(machine, 1.000001 * onset.speed)
        assert values.real.max() > 0.0
        lead = values[np.argmax(values.real)]
        assert abs(lead.imag) == pytest.approx(onset.whirl_frequency, rel=1e-4)
        speeds = onset.speed * np.array([0.5, 0.999, 1.001, 1.1])
        assert is_unstable(machine, speeds)[:3].tolist() == [False, False, True]
        assert unstable_ranges(machine, speeds)[0, 0] == pytest.approx(onset.speed, rel=1e-9)
    assert onset_speeds([machine])[0] == pytest.approx(onset.speed, rel=1e-9)


@pytest.mark.parametrize("rotor", ["rigid", "damped", "journal mass"])
@pytest.mark.parametrize("bearing", WHIRLING)
def test_growth_has_the_sign_of_the_refined_modes(bearing, rotor):
    """Beside the onset it is refined too; elsewhere the matrix's eigenvalues tell it."""
    machine = machine_of(bearing, rotor)
    onset = min(onset_speed(machine).speed, 3e4)
    apart = np.array([1e-9, 1e-7, 1e-5, 1e-3, 0.1, 0.5])
    speeds = onset * np.concatenate([1.0 - apart, 1.0 + apart])
    found, most = growth(machine, speeds, True), fastest(machine, speeds, True)
    assert np.sign(found).tolist() == np.sign(most.real).tolist()
    assert found == pytest.approx(most.real / speeds, abs=2e-6)
    beside = np.abs(most.real) < 1e-6 * np.abs(most)
    assert found[beside] == pytest.approx((most.real / speeds)[beside], abs=1e-15)


@pytest.mark.parametrize("rotor", ROTORS)
@pytest.mark.parametrize("load", [None, 0.0])
def test_a_film_that_cannot_whirl_has_no_onset(rotor, load):
    machine = machine_of("sprung", rotor, load)
    onset = onset_speed(machine)
    assert (onset.speed, onset.method) == (math.inf, "film")
    assert math.isnan(onset.whirl_frequency)
    assert np.all(np.isinf(onset_speeds([machine] * 5)))
    assert not np.any(is_unstable(machine, [10.0, 1e3, 1e5]))
    assert unstable_ranges(machine, [10.0, 1e3, 1e5]).shape == (0, 2)


@pytest.mark.parametrize("rotor", ["rigid", "massless journals", "journal mass"])
def test_a_film_with_stiffness_in_the_centre_is_stable_without_load(rotor):
    """κ in film units: M(Ω/2)² = κ μΩRL³/C³ of a rigid rotor, and any other balances there too."""
    machine = machine_of("preloaded", rotor, load=0.0)
    onset = onset_speed(machine)
    assert onset.speed > 0.0
    assert onset.whirl_frequency == pytest.approx(onset.speed / 2, rel=1e-9)
    assert pencil(machine, 0.9999 * onset.speed).real.max() < 0.0
    assert pencil(machine, 1.0001 * onset.speed).real.max() > 0.0
    if rotor == "rigid":
        b = machine.bearing
        unit = machine.viscosity * b.radius * b.length**3 / b.radial_clearance**3
        kappa = b.geometry.spring
        expected = 4.0 * kappa * unit / machine.rotor.half_mass
        assert onset.speed == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("bearing", ["ringed", "ringed, heavy"])
def test_a_sweep_has_the_inner_coordinates_eigenvalues(bearing):
    machine = machine_of(bearing, "massless journals")
    sweep = analyse(machine, [300.0, 900.0])
    for speed, values in zip(sweep.speed, sweep.flexible_eigenvalues, strict=True):
        expected = pencil(machine, speed)
        for value in values[np.abs(values) < 1e6 * speed]:
            assert np.abs(expected - value).min() <= 1e-5 * abs(value)
    assert sweep.rigid_eigenvalues.shape == (2, sweep.flexible_eigenvalues.shape[1] - 2)


@pytest.mark.parametrize("name", BEARINGS)
def test_an_onset_by_eigenvalues_says_how_far_it_was_searched(name):
    """Every other way excludes an onset above what it searches."""
    onset = onset_speed(machine_of(name, "massless journals"))
    assert math.isfinite(onset.searched_to) == (onset.method == "eigenvalues")
    assert onset.searched_to > onset.speed or math.isinf(onset.speed)


@pytest.mark.parametrize("name", [*FINITE, *SHORT_PADS])
def test_the_search_begins_where_the_film_first_feeds_a_whirl(name):
    """At the heaviest loads of a table floats decide nothing, and nothing is to be decided."""
    machine = machine_of(name, "massless journals")
    lowest = search_range(machine)[0] * modified_sommerfeld(machine, 1.0)
    heavier_to_lighter = whirl_onset(*film_coefficients(machine.bearing, [lowest, 1.2 * lowest]))
    stiff, fed = heavier_to_lighter.whirl_ratio
    assert stiff == 0.0 < fed
    assert onset_speed(machine).method == "polynomial"
