"""Eigenvalues whose growth is certain: against the judge, exact counts and sixty digits."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from rotorcalc import PRESETS, analyse, modes
from rotorcalc.coefficients import modified_sommerfeld
from rotorcalc.onset import eigenvalues
from rotorcalc.onset.judge import is_unstable
from tests.machines import with_rotor
from tests.onset.reference import drawn, exact_roots, unstable_roots

wide = settings(max_examples=40, suppress_health_check=[HealthCheck.too_slow])
seeds = st.integers(0, 10**6)


def speeds_at(machine, sigma):
    return np.asarray(sigma) / float(modified_sommerfeld(machine, 1.0))


def values_of(sweep, flexible):
    return sweep.flexible_eigenvalues if flexible else sweep.rigid_eigenvalues


@wide
@given(seeds, st.booleans())
@example(15, True)  # LAPACK: +2.6e-4 1/s, true −4.9e-7
@example(22, True)
def test_growth_never_contradicts_the_judge(seed, flexible):
    machine = drawn(seed)
    sweep = analyse(machine, speeds_at(machine, np.geomspace(1e-2, 1e3, 13)))
    grows = values_of(sweep, flexible).real.max(axis=-1) > 0.0
    assert grows.tolist() == is_unstable(machine, sweep.speed, flexible=flexible).tolist()
    shapes = sweep.mode_shapes(flexible=flexible)
    assert np.array_equal(shapes.eigenvalues.real.max(axis=-1) > 0.0, grows)


@wide
@given(seeds, st.floats(-2, 3), st.booleans())
def test_as_many_modes_grow_as_sixty_digits_count(seed, power, flexible):
    machine = drawn(seed)
    speed = float(speeds_at(machine, 10.0**power))
    values = values_of(analyse(machine, speed), flexible)
    assert np.sum(values.real > 0.0) == unstable_roots(machine, speed, flexible=flexible)


@wide
@given(seeds, st.floats(-2, 3), st.booleans())
@example(15, 0.0, True)
def test_every_real_part_is_that_of_sixty_digits(seed, power, flexible):
    """By the larger of a thousandth of itself and what two close roots share by rounding."""
    machine = drawn(seed)
    speed = float(speeds_at(machine, 10.0**power))
    values = values_of(analyse(machine, speed), flexible)
    for root in exact_roots(machine, speed, flexible=flexible):
        near = values[np.argmin(np.abs(values - complex(root)))]
        assert abs(near.real - float(root.real)) <= 1e-3 * abs(float(root.real))
        if root.imag > 0 and near.imag > 0.0:
            zeta = -float(root.real / mpmath.fabs(root))
            assert modes.damping_ratio(near) == pytest.approx(zeta, rel=2e-3)


@wide
@given(seeds, st.floats(-2, 3))
def test_complex_eigenvalues_are_exact_conjugates(seed, power):
    machine = drawn(seed)
    values = analyse(machine, speeds_at(machine, 10.0**power)).flexible_eigenvalues
    assert set(values.tolist()) == set(values.conj().tolist())


@given(st.sampled_from(range(40)), st.booleans())
def test_one_speed_gives_what_a_sweep_gives(seed, flexible):
    machine = drawn(seed)
    speeds = speeds_at(machine, [0.1, 10.0, 1e3])
    together = values_of(analyse(machine, speeds), flexible)
    for speed, values in zip(speeds, together, strict=True):
        one = values_of(analyse(machine, speed), flexible)
        assert np.sort_complex(one) == pytest.approx(np.sort_complex(values), rel=1e-6)


@given(seeds)
@settings(max_examples=20)
def test_shapes_have_the_eigenvalues_of_the_sweep(seed):
    machine = drawn(seed)
    sweep = analyse(machine, speeds_at(machine, [0.1, 10.0, 1e3]))
    shapes = sweep.mode_shapes()
    for one, other in zip(shapes.eigenvalues, sweep.flexible_eigenvalues, strict=True):
        assert np.sort_complex(one) == pytest.approx(np.sort_complex(other), rel=1e-6)


@pytest.mark.parametrize("name", PRESETS)
def test_ordinary_machines_are_not_computed_in_many_digits(monkeypatch, name):
    monkeypatch.setattr(eigenvalues, "ExactPolynomial", None)
    monkeypatch.setattr(eigenvalues, "simultaneous_roots", None)
    preset = PRESETS[name]
    sweep = analyse(preset.machine, np.linspace(0.005, 1, 200) * preset.top_speed)
    rotor, K, C = preset.machine.rotor, sweep.stiffness, sweep.damping
    assert np.array_equal(sweep.flexible_eigenvalues, modes.eigenvalues(rotor, K, C))


def test_without_load_the_whirl_grows_at_any_speed():
    """Mλ² + (c − jκ/λ …): growth Mκ²/c³ to first order in Mκ/c², κ = cΩ/2, of a rigid rotor."""
    machine = with_rotor(mass=2e-6, shaft_stiffness=math.inf)
    machine = type(machine)(oil=machine.oil, bearing=machine.bearing, rotor=machine.rotor,
                            temperature=60.0, load=0.0)  # fmt: skip
    sweep = analyse(machine, 1e-3)
    c, M = float(sweep.damping[0, 0]), machine.rotor.half_mass
    kappa = c * 1e-3 / 2
    growth = float(np.max(sweep.rigid_eigenvalues.real))
    assert growth == pytest.approx(M * kappa**2 / c**3, rel=1e-9)
