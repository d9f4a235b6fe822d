"""A film that is known by its impedance alone: onset, eigenvalues and response, against Nyquist."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import analyse, onset_speed, simulate
from rotorcalc.coefficients import dynamics
from rotorcalc.films import film_of, reduced
from rotorcalc.nonlinear.linear_motion import linear_theory
from rotorcalc.onset import growth
from rotorcalc.onset.judge import is_unstable, unstable_ranges
from tests.films.models import BEARINGS, Lossy, Preloaded
from tests.machines import ROTORS, SHEET

ALL = pytest.mark.parametrize("rotor", ROTORS)
# A damped disk on a shaft that bends, and the loss, hold down every whirl.
WHIRLS = pytest.mark.parametrize("rotor", [name for name in ROTORS if name != "damped"])


def machine_of(rotor="rigid", geometry=None):
    bearing = replace(BEARINGS["lossy"], geometry=geometry or Lossy())
    return replace(SHEET, bearing=bearing, rotor=ROTORS[rotor])


def balance(machine, speed, lam, omega):
    """Return the matrix whose determinant vanishes for a motion e^{λt} of the film at ω, (n, 2, 2).

    Multiplied by the flexibility of the shaft, so that it has no poles.
    """
    K, C = reduced(dynamics(machine, speed), omega)
    r, lam = machine.rotor, np.asarray(lam)[..., None, None]
    disk = lam * r.disk_damping + lam**2 * r.disk_mass
    soft = 1.0 + disk / r.shaft_stiffness
    own = disk + lam**2 * r.journal_mass * soft
    return (K + lam * C) * soft + own * np.eye(2)


def growing_modes(machine, speed):
    """Return how many modes grow, by Nyquist's curve of the determinant from ω = 0 to ∞."""
    omega = np.geomspace(1e-6, 1e5, 200_001) * speed
    turned = np.unwrap(np.angle(np.linalg.det(balance(machine, speed, 1j * omega, omega))))[-1]
    degree = analyse(machine, speed).flexible_eigenvalues.shape[-1]
    return round(degree / 2.0 - turned / np.pi)


@WHIRLS
def test_nyquist_tells_the_same_of_both_sides_of_the_onset(rotor):
    machine = machine_of(rotor)
    onset = onset_speed(machine)
    assert onset.method == "eigenvalues"
    for share in (0.2, 0.7, 0.999):
        assert growing_modes(machine, share * onset.speed) == 0
        assert not is_unstable(machine, share * onset.speed)
    assert growing_modes(machine, 1.001 * onset.speed) == 2
    assert is_unstable(machine, 1.001 * onset.speed)


@WHIRLS
def test_at_the_onset_a_whirl_neither_grows_nor_decays(rotor):
    machine = machine_of(rotor)
    onset = onset_speed(machine)
    omega = np.array(onset.whirl_frequency)
    W = balance(machine, onset.speed, 1j * omega, omega)
    assert abs(np.linalg.det(W)) < 1e-7 * np.linalg.norm(W) ** 2
    (first, _), *_ = unstable_ranges(machine, np.linspace(0.1, 1.2, 12) * onset.speed)
    assert first == pytest.approx(onset.speed, rel=1e-9)


def test_nyquist_confirms_that_there_is_no_onset():
    machine = machine_of("damped")
    assert onset_speed(machine).speed == np.inf
    assert [growing_modes(machine, speed) for speed in (300.0, 1000.0, 3000.0, 3e4)] == [0] * 4


@ALL
def test_without_loss_it_is_the_film_of_constant_coefficients(rotor):
    lossless, plain = machine_of(rotor, Lossy(loss=0.0)), machine_of(rotor, Preloaded())
    assert onset_speed(lossless).speed == pytest.approx(onset_speed(plain).speed, rel=1e-9)
    found, known = (
        np.sort_complex(analyse(machine, 600.0).flexible_eigenvalues)
        for machine in (lossless, plain)
    )
    assert found == pytest.approx(known, rel=1e-9)


def test_loss_raises_the_onset():
    speeds = [onset_speed(machine_of(geometry=Lossy(loss=loss))).speed for loss in (0.0, 0.1, 0.3)]
    assert speeds[0] < speeds[1] < speeds[2]


@ALL
def test_each_mode_is_that_of_the_coefficients_at_its_own_frequency(rotor):
    machine = machine_of(rotor)
    shapes = analyse(machine, 700.0).mode_shapes()
    assert np.all(np.isfinite(shapes.eigenvalues))
    for value, journal in zip(shapes.eigenvalues, shapes.journal, strict=True):
        W = balance(machine, 700.0, value, abs(value))
        size = np.linalg.norm(W)
        assert abs(np.linalg.det(W)) < 1e-8 * size**2
        assert np.linalg.norm(W @ journal) < 1e-6 * size * np.linalg.norm(journal)


def test_the_response_is_that_of_the_synchronous_impedance():
    machine = machine_of()
    sweep = analyse(machine, np.array([300.0, 600.0]))
    K, C = reduced(dynamics(machine, sweep.speed), sweep.speed)
    assert sweep.stiffness == pytest.approx(K)
    assert sweep.damping == pytest.approx(C)
    assert film_of(machine.bearing).frequency_dependent


@pytest.mark.parametrize(
    "asked", [lambda m: simulate(m, 600.0, revolutions=1), lambda m: linear_theory(m, 600.0)]
)
def test_a_motion_in_time_is_refused_in_words(asked):
    with pytest.raises(ValueError, match=r"^bearing.* in a whirl .*only"):
        asked(machine_of())


def test_where_no_mode_settles_the_onset_is_refused_in_words(monkeypatch):
    nothing = complex(math.nan, math.nan)
    monkeypatch.setattr(growth, "impedance_eigenvalues", lambda *_, **__: np.full((2, 4), nothing))
    with pytest.raises(ValueError, match=r"speed = 100 rad/s: on this film no mode"):
        growth.fastest(machine_of(), np.array([100.0, 200.0]), True)
