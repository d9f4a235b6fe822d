"""Amplification factors against a closed form and a plain search; separation margins."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import PRESETS, Supply, amplification, onset_speed
from rotorcalc.coefficients import stiffness_and_damping
from rotorcalc.criteria import required_margin
from rotorcalc.unbalance_peaks import response_peaks
from tests.criteria.bores import GEOMETRIES, on
from tests.films.models import Sprung
from tests.machines import MACHINES, SHEET, with_rotor

SOFT = with_rotor(shaft_stiffness=1e7)


def jeffcott(zeta):
    """Return a rotor in bearings that hardly yield, with a damper at the disk."""
    rotor = replace(SHEET.rotor, shaft_stiffness=1e7)
    critical = 2.0 * math.sqrt(rotor.shaft_stiffness * rotor.half_mass)
    rigid_film = Sprung(stiffness=1e9, ratio=1.0, damping=1.0)
    return on(rigid_film, replace(rotor, disk_damping=zeta * critical))


@pytest.mark.parametrize("zeta", [1e-3, 0.01, 0.05, 0.1, 0.2, 0.3, 0.35])
def test_a_single_degree_of_freedom_has_a_closed_form(zeta):
    machine = jeffcott(zeta)
    natural = math.sqrt(machine.rotor.shaft_stiffness / machine.rotor.half_mass)
    found = amplification(machine)
    assert found.critical_speed.shape == (1,)
    # With s = (ω_n/Ω)² the response is u/√((s − 1)² + 4ζ²s).
    top, half = 1.0 - 2.0 * zeta**2, 2.0 * zeta * math.sqrt(1.0 - zeta**2)
    assert found.critical_speed[0] == pytest.approx(natural / math.sqrt(top), rel=1e-6)
    expected = natural / np.sqrt([top + half, top - half])
    assert found.half_power_speed[0] == pytest.approx(expected, rel=1e-6)
    amplitude = machine.rotor.imbalance / half
    assert found.amplitude[0] == pytest.approx(amplitude, rel=1e-6)
    if zeta < 0.02:
        assert found.amplification_factor[0] == pytest.approx(1.0 / (2.0 * zeta), rel=2 * zeta)


def test_a_flat_peak_has_no_amplification():
    # Above ζ = sin(π/8) the response never falls to half the power of its peak.
    found = amplification(jeffcott(0.45), maximum_speed=250.0)
    assert np.isinf(found.half_power_speed[0, 1])
    assert found.amplification_factor[0] == 0.0
    assert found.required_margin[0] == 0.0
    assert found.passed[0]


def plain_size(machine, speed):
    """Return the disk's semi-major axis by solving for disk and journal, speed by speed."""
    rotor, k = machine.rotor, machine.rotor.shaft_stiffness * np.eye(2)
    sizes = []
    for omega in speed:
        K, C = stiffness_and_damping(machine, omega)
        D = k + (1j * omega * rotor.disk_damping - omega**2 * rotor.disk_mass) * np.eye(2)
        Z = K + 1j * omega * C - omega**2 * rotor.journal_mass * np.eye(2) + k
        force = rotor.disk_mass * rotor.imbalance * omega**2 * np.array([1.0, -1.0j, 0.0, 0.0])
        disk = np.linalg.solve(np.block([[D, -k], [-k, Z]]), force)[:2]
        turns = np.exp(1j * np.linspace(0.0, math.pi, 361))
        sizes.append(np.hypot(*(np.real(x * turns) for x in disk)).max())
    return np.array(sizes)


@pytest.mark.parametrize("machine", [SHEET, SOFT], ids=["stiff", "soft"])
def test_a_plain_search_finds_the_same_factor(machine):
    found = amplification(machine)
    low, high = found.half_power_speed[0]
    speed = np.linspace(0.9 * low, 1.1 * high, 401)
    size = plain_size(machine, speed)
    over = speed[size >= math.sqrt(0.5) * size.max()]
    step = speed[1] - speed[0]
    assert [over[0], over[-1]] == pytest.approx([low, high], abs=1.1 * step)
    assert speed[size.argmax()] == pytest.approx(found.critical_speed[0], abs=1.1 * step)
    assert size.max() == pytest.approx(found.amplitude[0], rel=2e-3)


@pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES)
@pytest.mark.parametrize("at", ["disk", "journal"])
def test_the_range_that_follows_from_the_machine_holds_its_peaks(machine, at):
    found = amplification(machine, at=at)
    speeds = np.linspace(20.0, 1.1 * max([600.0, *found.critical_speed]), 500)
    peaks = response_peaks(machine, speeds, at=at)
    assert found.critical_speed == pytest.approx(peaks.speed, rel=1e-5)
    assert found.amplitude == pytest.approx(peaks.amplitude, rel=1e-6)
    low, high = found.half_power_speed.T
    assert np.all((low < found.critical_speed) & (found.critical_speed < high))


@pytest.mark.parametrize("preset", PRESETS.values(), ids=PRESETS)
def test_a_rotor_without_imbalance_has_the_same_critical_speeds(preset):
    machine = preset.machine
    bare = replace(machine, rotor=replace(machine.rotor, imbalance=0.0))
    one, other = amplification(machine), amplification(bare)
    assert np.array_equal(one.critical_speed, other.critical_speed)
    assert np.array_equal(one.amplification_factor, other.amplification_factor)
    assert np.all(other.amplitude == 0.0)


@pytest.mark.parametrize("geometry", GEOMETRIES.values(), ids=GEOMETRIES)
def test_other_bores_have_critical_speeds_too(geometry):
    machine = on(geometry, SOFT.rotor)
    found = amplification(machine, minimum_speed=400.0, maximum_speed=420.0)
    assert found.critical_speed.size >= 1
    # Film and shaft in series are softer than the shaft.
    alone = math.sqrt(1e7 / SOFT.rotor.half_mass)
    assert found.critical_speed[0] < alone
    assert np.all(np.isfinite(found.required_margin))


def test_a_machine_with_an_oil_supply_is_asked_where_its_film_has_a_temperature():
    warm = replace(SOFT, temperature=None, supply=Supply(temperature=40.0, flow=2e-4))
    found = amplification(warm)
    assert found.critical_speed[0] == pytest.approx(
        response_peaks(warm, np.linspace(50.0, 500.0, 400)).speed[0], rel=1e-5
    )
    assert np.all(np.isfinite(found.half_power_speed))


def test_the_margins_that_the_standard_requires():
    AF = np.array([0.0, 2.49, 2.5, 3.5, 5.0, 18.4, 19.0, 1e6])
    below = [0.0, 0.0, 0.0, 8.5, 17 * (1 - 1 / 3.5), 17 * (1 - 1 / 16.9), 16.0, 16.0]
    assert 100 * required_margin(AF, above=False) == pytest.approx(below)
    above = [0.0, 0.0, 10.0, 18.5, 10 + 17 * (1 - 1 / 3.5), 10 + 17 * (1 - 1 / 16.9), 26.0, 26.0]
    assert 100 * required_margin(AF, above=True) == pytest.approx(above)


def test_margins_are_taken_of_the_minimum_and_of_the_maximum_speed():
    N_c = float(amplification(SOFT).critical_speed[0])

    def margin(minimum, maximum):
        found = amplification(SOFT, minimum_speed=minimum * N_c, maximum_speed=maximum * N_c)
        return found.separation_margin[0], found.required_margin[0], bool(found.passed[0])

    assert margin(1.25, 1.5) == pytest.approx((0.2, 0.16, True))
    assert margin(1.1, 1.5) == pytest.approx((0.1 / 1.1, 0.16, False))
    assert margin(0.5, 0.75) == pytest.approx((1 / 3, 0.26, True))
    assert margin(0.5, 0.9) == pytest.approx((1 / 9, 0.26, False))
    # Between the two it has none, and needs one.
    assert margin(0.9, 1.1) == pytest.approx((0.0, 0.16, False))
    one = amplification(SOFT, maximum_speed=1.25 * N_c)
    assert one.separation_margin[0] == pytest.approx(0.2)
    none = amplification(SOFT)
    assert np.isnan(none.separation_margin[0])
    assert not none.passed[0]


def test_a_critical_speed_above_the_onset_is_marked():
    # Heavy journals have a resonance of their own, far above the onset.
    machine = with_rotor(shaft_stiffness=1e8, journal_mass=60.0)
    found = amplification(machine, np.linspace(50.0, 6000.0, 600))
    onset = onset_speed(machine).speed
    assert list(found.stable) == [N_c < onset for N_c in found.critical_speed]
    assert False in found.stable


def test_arguments_are_refused_in_words():
    with pytest.raises(ValueError, match=r"at = 'shaft': must be 'disk' or 'journal'"):
        amplification(SHEET, at="shaft")
    with pytest.raises(ValueError, match=r"minimum_speed = 500 rad/s: must be at most the max"):
        amplification(SHEET, minimum_speed=500.0, maximum_speed=400.0)
    with pytest.raises(ValueError, match=r"speeds: must be two or more rising speeds"):
        amplification(SHEET, [100.0])
