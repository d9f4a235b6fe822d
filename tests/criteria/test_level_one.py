"""Level-one stability against closed forms, the machine with both bearings, and energy."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.constants import hp, inch, lbf
from scipy.optimize import brentq

from rotorcalc import (
    PRESETS,
    analyse,
    criteria,
    level_one,
    modes,
    onset_speed,
    rpm,
)
from rotorcalc.coefficients import dynamics
from rotorcalc.films import reduced
from tests.criteria.bores import GEOMETRIES, on
from tests.films.models import Sprung
from tests.machines import BENDING, MACHINES, ROTORS, SHEET, log_uniform, with_rotor

J = np.array([[0.0, 1.0], [-1.0, 0.0]])
SPEED = 400.0
# The same in X and Y: two springs and dampers, which only cross-coupling makes unstable.
ISOTROPIC = Sprung(stiffness=2.0, ratio=1.0, damping=0.1)


def whole_machine(machine, speed, Q):
    """Return λ of the machine with both bearings: M q̈ + C q̇ + K q = 0 over disk and journals."""
    rotor, film = machine.rotor, dynamics(machine, speed)
    k, K_f, C_f = rotor.shaft_stiffness, film.stiffness, film.damping
    K, C = np.zeros((6, 6)), np.zeros((6, 6))
    K[:2, :2] = 2 * k * np.eye(2) + Q * J
    C[:2, :2] = 2 * rotor.disk_damping * np.eye(2)
    for place in (slice(2, 4), slice(4, 6)):
        K[:2, place] = K[place, :2] = -k * np.eye(2)
        K[place, place] = k * np.eye(2) + K_f
        C[place, place] = C_f
    m = np.repeat([2 * rotor.disk_mass, rotor.journal_mass, rotor.journal_mass], 2)
    A = np.block([[np.zeros((6, 6)), np.eye(6)], [-K / m[:, None], -C / m[:, None]]])
    return np.linalg.eigvals(A)


def impedance(machine, speed, omega, Q):
    """Return the dynamic stiffness of disk and journal at a frequency, (4, 4), for one bearing."""
    rotor = machine.rotor
    K, C = reduced(dynamics(machine, speed), omega)
    D = -(omega**2) * rotor.disk_mass * np.eye(2) + 1j * omega * rotor.disk_damping * np.eye(2)
    D = D + Q / 2 * J
    Z = K + 1j * omega * C - omega**2 * rotor.journal_mass * np.eye(2)
    if rotor.is_rigid:
        return D + Z
    k = rotor.shaft_stiffness * np.eye(2)
    return np.block([[D + k, -k], [-k, Z + k]])


def least(values):
    return modes.logarithmic_decrement(values).min()


@pytest.mark.parametrize("disk_damping", [0.0, 3e3])
def test_a_rigid_rotor_on_isotropic_supports_has_a_closed_form(disk_damping):
    rotor = replace(SHEET.rotor, shaft_stiffness=math.inf, disk_damping=disk_damping)
    machine = on(ISOTROPIC, rotor)
    film, M = dynamics(machine, SPEED), rotor.half_mass
    k, c = film.stiffness[0, 0], film.damping[0, 0] + disk_damping
    found = level_one(machine, SPEED, [0.0, 1e6, 3e7])
    # At the limit the disk whirls at its natural frequency, where Q/2 r works against c ω r.
    assert found.zero_decrement == pytest.approx(2 * c * math.sqrt(k / M), rel=1e-11)
    # z = x + jy obeys M z̈ + c ż + (k − jQ/2) z = 0.
    root = np.sqrt(c * c - 4 * M * (k - 0.5j * found.cross_coupling) + 0j)
    both = np.stack([(-c + root) / (2 * M), (-c - root) / (2 * M)])
    # The root that turns from X to Y is the forward one.
    forward = np.where(both.imag > 0.0, both, np.nan + 1j)
    expected = np.nanmin(modes.logarithmic_decrement(forward), axis=0)
    assert found.forward_decrement == pytest.approx(expected, rel=1e-10)


def test_a_flexible_rotor_on_isotropic_supports_has_one_too():
    rotor = replace(SHEET.rotor, disk_damping=2e3, journal_mass=9.0)
    machine = on(ISOTROPIC, rotor)
    film = dynamics(machine, SPEED)
    k, c, k_s = film.stiffness[0, 0], film.damping[0, 0], rotor.shaft_stiffness

    def support(omega):
        journal = k + 1j * omega * c - omega**2 * rotor.journal_mass
        return k_s * journal / (k_s + journal) + 1j * omega * rotor.disk_damping

    omega = brentq(lambda w: support(w).real - rotor.disk_mass * w**2, 10.0, 1200.0, xtol=1e-12)
    found = level_one(machine, SPEED, 1.0)
    assert found.zero_decrement == pytest.approx(2 * support(omega).imag, rel=1e-10)
    at = level_one(machine, SPEED, found.zero_decrement)
    assert at.whirl_frequency == pytest.approx(omega, rel=1e-9)


@pytest.mark.parametrize("Q", [-4e6, 0.0, 5e6, 5e7])
def test_the_half_with_half_of_q_whirls_as_the_machine_with_both_bearings(Q):
    machine = with_rotor(journal_mass=15.0, disk_damping=1e3)
    found = level_one(machine, SPEED, Q)
    values = whole_machine(machine, SPEED, Q)
    # The journals' motion against each other does not move the disk: it is damped for itself.
    assert found.log_decrement == pytest.approx(least(values), rel=1e-8)
    assert found.forward_decrement.shape == ()


def test_cross_coupling_feeds_forward_whirl_and_damps_backward():
    machine = on(ISOTROPIC, replace(SHEET.rotor, journal_mass=9.0))
    found = level_one(machine, SPEED, [-1e6, 0.0, 1e6])
    # Supports alike in X and Y do not tell forward from backward.
    assert found.backward_decrement[0] == pytest.approx(found.forward_decrement[2], rel=1e-12)
    assert np.all(np.diff(found.forward_decrement) < 0.0)
    # A film drives forward: with Q against it the machine is more stable than with Q along it.
    unstable = with_rotor(shaft_stiffness=1e7)
    speed = 1.01 * onset_speed(unstable).speed
    back, none, along = level_one(unstable, speed, [-2e5, 0.0, 2e5]).forward_decrement
    assert back > 0.0 > none > along


@pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES)
def test_without_cross_coupling_the_eigenvalues_are_the_machines_own(machine):
    found = level_one(machine, SPEED, 0.0)
    assert found.log_decrement == pytest.approx(
        least(analyse(machine, SPEED).flexible_eigenvalues), rel=1e-9
    )


@pytest.mark.parametrize("geometry", ["lobes", "lemon", "ring"])
@pytest.mark.parametrize("Q", [0.0, 5e6])
def test_the_first_forward_mode_by_the_path_of_the_disk(geometry, Q):
    machine = on(GEOMETRIES[geometry], ROTORS["journal mass"])
    film, rotor = dynamics(machine, SPEED), machine.rotor
    found = level_one(machine, SPEED, Q)
    A = modes.state_matrix(rotor, film.stiffness, film.damping, inertia=film.inertia)
    place = film.stiffness.shape[-1] + 2
    A[place : place + 2, :2] -= Q / 2 * J / rotor.disk_mass
    values, shapes = np.linalg.eig(A)
    forward, backward = [], []
    for lam, (x, y) in zip(values, shapes[:2].T, strict=True):
        if lam.imag > 0.0:  # x ẏ − y ẋ, twice the area swept a second
            swept = (x * np.conj(lam * y) - y * np.conj(lam * x)).real
            (forward if swept > 0.0 else backward).append(modes.logarithmic_decrement(lam))
    assert found.forward_decrement == pytest.approx(min(forward), rel=1e-8)
    assert found.backward_decrement == pytest.approx(min(backward, default=np.inf), rel=1e-8)


@pytest.mark.parametrize("geometry", GEOMETRIES.values(), ids=GEOMETRIES)
@pytest.mark.parametrize("name", ["rigid, damped", "massless journals", "journal mass"])
def test_at_q_0_the_least_damped_mode_whirls_undamped(geometry, name):
    machine = on(geometry, ROTORS[name])
    values = analyse(machine, SPEED).flexible_eigenvalues
    found = level_one(machine, SPEED, 0.0)
    assert found.log_decrement == pytest.approx(least(values[~np.isnan(values)]), rel=1e-8)
    Q = found.zero_decrement
    around = level_one(machine, SPEED, Q * np.array([0.1, 0.5, 0.999, 1.0, 1.001]))
    assert around.forward_decrement[3] == pytest.approx(0.0, abs=1e-9)
    assert np.all(around.forward_decrement[:3] > 0.0)
    assert around.forward_decrement[4] < 0.0
    # Another method: at that frequency the forces balance on a motion that does not decay.
    Z = impedance(machine, SPEED, around.whirl_frequency[3], Q)
    *_, second, smallest = np.linalg.svd(Z)[1]
    assert smallest < 1e-8 * second


@pytest.mark.parametrize("preset", PRESETS.values(), ids=PRESETS)
def test_at_q_0_the_fluid_and_the_film_do_no_work_together(preset):
    machine = preset.machine
    Q = level_one(machine, preset.speed, 0.0).zero_decrement
    assert 0.0 < Q < math.inf
    omega = float(level_one(machine, preset.speed, Q).whirl_frequency)
    motion = np.linalg.svd(impedance(machine, preset.speed, omega, Q))[2][-1].conj()
    disk, journal = motion[:2], motion[-2:]
    K, C = reduced(dynamics(machine, preset.speed), omega)

    def work(force, motion):
        """Return the work of a force in a turn, of phasors."""
        return -math.pi * np.vdot(force, motion).imag

    fluid, film = work(-Q / 2 * J @ disk, disk), work(-(K + 1j * omega * C) @ journal, journal)
    assert fluid > 0.0
    assert fluid + film == pytest.approx(0.0, abs=1e-9 * fluid)


def test_a_machine_unstable_by_itself_has_no_room():
    onset = onset_speed(SHEET).speed
    assert level_one(SHEET, 1.01 * onset, 0.0).zero_decrement == 0.0
    assert level_one(SHEET, 0.99 * onset, 0.0).zero_decrement > 0.0
    # Without load a rigid rotor on a circular film whirls at every speed.
    unloaded = replace(with_rotor(shaft_stiffness=math.inf), load=0.0)
    assert level_one(unloaded, SPEED, 0.0).zero_decrement == 0.0


@settings(max_examples=25, deadline=None)
@given(
    k=st.one_of(st.just(math.inf), BENDING),
    journal_mass=st.sampled_from([0.0, 1e-3, 20.0]),
    disk_damping=st.sampled_from([0.0, 1e4]),
    speed=log_uniform(20.0, 5e3),
)
def test_the_smallest_q_at_which_the_decrement_vanishes(k, journal_mass, disk_damping, speed):
    machine = with_rotor(shaft_stiffness=k, journal_mass=journal_mass, disk_damping=disk_damping)
    Q_0 = level_one(machine, speed, 0.0).zero_decrement
    below = level_one(machine, speed, Q_0 * np.linspace(0.0, 0.999, 40))
    assert (Q_0 == 0.0) == (analyse(machine, speed).flexible_eigenvalues.real.max() > 0.0)
    if Q_0 > 0.0:
        assert np.all(below.forward_decrement > 0.0)
        assert level_one(machine, speed, 1.001 * Q_0).forward_decrement < 0.0


def test_q_keeps_its_shape_and_must_be_finite():
    assert level_one(SHEET, SPEED, np.zeros((2, 3))).forward_decrement.shape == (2, 3)
    with pytest.raises(ValueError, match=r"cross_coupling = .*nan.* N/m: must be finite"):
        level_one(SHEET, SPEED, [1.0, math.nan])


def test_the_anticipated_value_in_the_units_of_the_standard():
    # B C P/(D H N): C = 9.55 for W, mm and rpm gives kN/mm; C = 63 for hp and inches klbf/in.
    P, N, D, H = 2e6, 11000.0, 0.45, 0.014
    q = criteria.anticipated_cross_coupling(
        P, speed=N * rpm, diameter=D, width=H, density_ratio=1.8
    )
    assert q / 1e6 == pytest.approx(3 * 9.55 * P / (450 * 14 * N) * 1.8, rel=1e-4)
    us = 3 * 63 * (P / hp) / (D / inch * H / inch * N) * 1.8
    assert q / (1e3 * lbf / inch) == pytest.approx(us, rel=1e-3)
    blades = criteria.anticipated_cross_coupling(
        [P, P], speed=N * rpm, diameter=D, width=H, factor=1.5
    )
    assert blades == pytest.approx([q / 3.6, q / 3.6])
    with pytest.raises(ValueError, match=r"width = 0\.0 m: must be positive and finite"):
        criteria.anticipated_cross_coupling(P, speed=N * rpm, diameter=D, width=0.0)
