"""The Campbell diagram: every mode once, its direction by another way, its critical speeds."""

import numpy as np
import pytest

from rotorcalc import amplification, analyse, onset_speed, rpm
from rotorcalc.coefficients import stiffness_and_damping
from rotorcalc.criteria import campbell
from tests.criteria.bores import GEOMETRIES, on
from tests.machines import MACHINES, ROTORS, SHEET, with_rotor

SPEEDS = np.linspace(100.0, 1200.0, 56)


@pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES)
def test_every_oscillating_mode_is_there_once(machine):
    found = campbell(machine, SPEEDS)
    values = analyse(machine, SPEEDS).flexible_eigenvalues
    for here, modes in zip(values, found.eigenvalue, strict=True):
        waves, shown = here[here.imag > 0.0], modes[modes.imag > 0.0]
        # To the digits of a matrix eigenvalue: massless journals have very fast ones.
        assert np.sort(shown.imag) == pytest.approx(np.sort(waves.imag), rel=1e-6)
    assert np.array_equal(np.isfinite(found.frequency), found.eigenvalue.imag > 0.0)
    assert np.array_equal(np.isfinite(found.frequency), np.isfinite(found.log_decrement))
    assert not np.any(found.forward & np.isnan(found.frequency))


def test_the_direction_is_that_of_the_motion_itself():
    machine = with_rotor(shaft_stiffness=np.inf)
    found = campbell(machine, SPEEDS)
    for i, j in np.argwhere(np.isfinite(found.frequency)):
        lam = found.eigenvalue[i, j]
        K, C = stiffness_and_damping(machine, SPEEDS[i])
        Z = lam**2 * machine.rotor.half_mass * np.eye(2) + lam * C + K
        X, Y = np.linalg.svd(Z)[2][-1].conj()
        # Angular momentum of x = Re X e^{λt}, y = Re Y e^{λt} about the equilibrium.
        x, y, dx, dy = X.real, Y.real, (lam * X).real, (lam * Y).real
        assert found.forward[i, j] == (x * dy - y * dx > 0.0)


def test_the_unstable_mode_whirls_forward_at_half_the_speed():
    onset = onset_speed(SHEET)
    found = campbell(SHEET, np.array([0.98, 0.999, 1.001, 1.02]) * onset.speed)
    unstable = found.log_decrement < 0.0
    assert np.array_equal(unstable.any(axis=1), [False, False, True, True])
    j = int(np.flatnonzero(unstable[2])[0])
    assert np.all(found.forward[:, j])
    assert found.frequency[1:3, j].mean() == pytest.approx(onset.whirl_frequency, rel=1e-3)
    assert found.frequency[2, j] / found.speed[2] == pytest.approx(0.5, abs=0.03)


@pytest.mark.parametrize("k", [1e7, 1e8])
def test_a_mode_meets_the_running_speed_near_the_critical_speed(k):
    machine = with_rotor(shaft_stiffness=k)
    found = campbell(machine, SPEEDS)
    for speed, mode in zip(found.crossing_speed, found.crossing_mode, strict=True):
        at = campbell(machine, np.array([speed, speed * 1.001]))
        distance = np.nanmin(np.abs(at.frequency[0] - speed))
        assert distance < 1e-3 * speed
        assert found.log_decrement[0, mode] > 0.0
    peak = amplification(machine).critical_speed[0]
    assert np.min(np.abs(found.crossing_speed - peak)) < 0.02 * peak


@pytest.mark.parametrize("geometry", GEOMETRIES.values(), ids=GEOMETRIES)
@pytest.mark.parametrize("name", ["rigid, damped", "journal mass"])
def test_other_bores_have_forward_and_backward_modes(geometry, name):
    found = campbell(on(geometry, ROTORS[name]), np.linspace(200.0, 800.0, 13))
    assert found.frequency.shape == found.forward.shape
    assert np.any(found.forward[-1])
    if name == "journal mass":
        assert np.any(np.isfinite(found.frequency[-1]) & ~found.forward[-1])


def test_a_rigid_shaft_by_choice():
    found = campbell(SHEET, SPEEDS, flexible=False)
    rigid = campbell(with_rotor(shaft_stiffness=np.inf), SPEEDS)
    assert found.frequency == pytest.approx(rigid.frequency, nan_ok=True)


def test_speeds_must_rise():
    with pytest.raises(ValueError, match=r"speed\[1\] = 100 rad/s: must be greater"):
        campbell(SHEET, [6000 * rpm, 100.0])
