"""Peaks of the response: as high as brute force finds them, however narrow."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import analyse, orbit_ellipse
from rotorcalc.coefficients import equilibrium, stiffness_and_damping
from rotorcalc.modes import eigenvalues
from rotorcalc.unbalance_peaks import disk_peak_speeds, response_peaks
from rotorcalc.unbalance_response import Rotors, orbit_sizes, synchronous_response
from tests.machines import EPS, ROTORS, RPM, SHEET, drawn, with_rotor

# A peak that falls by less than this on one side is a ripple of a flat curve.
_RIPPLE = 1e-3


def size_of(machine, speed, at):
    sweep = analyse(machine, speed)
    orbit = sweep.disk_response if at == "disk" else sweep.journal_response
    return orbit_ellipse(orbit[..., 0], orbit[..., 1]).semi_major


@pytest.mark.parametrize("at", ["disk", "journal"])
@pytest.mark.parametrize("stiffness", [1e7, 1e8])
def test_peaks_are_maxima_of_the_orbit(at, stiffness):
    machine = with_rotor(shaft_stiffness=stiffness)
    sweep = np.linspace(500 * RPM, 20000 * RPM, 400)
    peaks = response_peaks(machine, sweep, at=at)
    assert len(peaks.speed) >= 1
    assert peaks.amplitude == pytest.approx(size_of(machine, peaks.speed, at), rel=1e-12)
    for speed, amplitude in zip(peaks.speed, peaks.amplitude, strict=True):
        near = size_of(machine, speed + np.linspace(-1, 1, 2001) * (sweep[1] - sweep[0]), at)
        assert near.max() <= amplitude * (1 + 1e-10)
    # As the documentation says, to 1e-6 of the spacing: found again with another spacing.
    other = response_peaks(machine, np.linspace(500 * RPM, 20000 * RPM, 431), at=at)
    assert other.speed == pytest.approx(peaks.speed, abs=2e-6 * (sweep[1] - sweep[0]))


def test_no_peak_is_left_out():
    machine = with_rotor(shaft_stiffness=1e7)
    sweep = np.linspace(500 * RPM, 20000 * RPM, 400)
    size = size_of(machine, sweep, "disk")
    tops = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] > size[2:])) + 1
    peaks = response_peaks(machine, sweep)
    assert peaks.speed == pytest.approx(sweep[tops], abs=sweep[1] - sweep[0])


def test_several_rotors_at_once_have_each_its_own_response_and_peaks():
    rotors = list(ROTORS.values())
    sweep = np.linspace(500 * RPM, 20000 * RPM, 400)
    state = equilibrium(SHEET, sweep)
    pair = synchronous_response(Rotors.of(rotors), state.stiffness, state.damping, sweep)
    sizes, peaks = orbit_sizes(*pair), []
    for i, rotor in enumerate(rotors):
        alone = replace(SHEET, rotor=rotor)
        for of_all, of_one in zip(
            pair, synchronous_response(rotor, state.stiffness, state.damping, sweep), strict=True
        ):
            assert np.array_equal(of_all[i], of_one)
        for at, size in zip(("disk", "journal"), sizes, strict=True):
            assert size[i] == pytest.approx(size_of(alone, sweep, at), rel=4 * EPS)
        peaks += [*response_peaks(alone, sweep).speed]
    assert len(peaks) > 2
    film = state.stiffness, state.damping
    found = disk_peak_speeds(SHEET, rotors, sweep, film, sizes[0])
    assert found == pytest.approx(np.array(peaks), rel=1e-9)


def test_a_sweep_without_a_peak_has_none():
    peaks = response_peaks(SHEET, np.linspace(10.0, 100.0, 50))
    assert peaks.speed.shape == peaks.amplitude.shape == (0,)


def test_a_peak_of_neither_disk_nor_journal_is_refused():
    with pytest.raises(ValueError, match="at = 'shaft'"):
        response_peaks(SHEET, np.linspace(10.0, 100.0, 50), at="shaft")


def crossings(machine, speeds):
    """Return each speed Ω = |Im λ|, by halving between dense speeds, and |Re λ| there."""

    def modes(speed):
        values = eigenvalues(machine.rotor, *stiffness_and_damping(machine, speed))
        values = np.take_along_axis(values, np.argsort(values.imag, axis=-1), axis=-1)
        return values[..., values.shape[-1] // 2 :]

    above = modes(speeds).imag > speeds[:, None]
    i, j = np.nonzero(above[:-1] != above[1:])
    low, high = speeds[i], speeds[i + 1]
    for _ in range(52):
        middle = 0.5 * (low + high)
        here = modes(middle)[np.arange(len(i)), j]
        left = (here.imag > middle) == above[i, j]
        low, high = np.where(left, middle, low), np.where(left, high, middle)
    return list(zip(low, np.abs(here.real), strict=True)) if len(i) else []


def brute_force(machine, low, high, points):
    """Return speed and size of the peaks of disk and journal, point by point."""
    dense = np.unique([*np.linspace(low, high, 3000), *np.geomspace(low, high, 3000)])
    spans = [(low, high)] + [
        (max(low, speed - 40 * width), min(high, speed + 40 * width))
        for speed, width in crossings(machine, dense)
        if width < 0.05 * speed
    ]
    found = {"disk": [], "journal": []}
    for first, last in spans:
        speed = np.linspace(first, last, points)
        response = synchronous_response(
            machine.rotor, *stiffness_and_damping(machine, speed), speed
        )
        for size, peaks in zip(orbit_sizes(*response), found.values(), strict=True):
            tops = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])) + 1
            peaks += [(speed[k], size[k]) for k in tops if fall(size, k) > _RIPPLE]
    return found


def fall(size, k):
    """Return by how much a curve falls from its kth point before it rises above it, relative."""
    left, right = np.flatnonzero(size[:k] > size[k]), np.flatnonzero(size[k:] > size[k])
    before = size[left[-1] if len(left) else 0 : k + 1].min()
    after = size[k : k + right[0] if len(right) else None].min()
    return 1.0 - max(before, after) / size[k]


# 42: a wide maximum between the first two speeds.
@pytest.mark.parametrize("seed", [*range(24), 42])
def test_no_peak_is_short_of_brute_force(seed):
    machine, top = drawn(seed)
    sweep = np.linspace(top / 240, top, 240)
    for at, peaks in brute_force(machine, sweep[0], sweep[-1], 8000).items():
        found = response_peaks(machine, sweep, at=at)
        for speed, size in peaks:
            near = found.amplitude[np.abs(found.speed / speed - 1.0) < 0.02]
            assert near.max(initial=0.0) > (1.0 - 1e-3) * size


def test_a_peak_a_thousandth_as_wide_as_the_spacing_keeps_its_height():
    """A soft shaft: the sweep alone gave 0.01661 m at 258.78 rpm."""
    machine = with_rotor(shaft_stiffness=1e5)
    sweep = np.linspace(40000 * RPM / 240, 40000 * RPM, 240)
    peaks = response_peaks(machine, sweep)
    assert peaks.speed[0] == pytest.approx(258.839 * RPM, rel=2e-6)
    assert peaks.amplitude[0] == pytest.approx(0.02288, rel=1e-3)
    narrow = peaks.speed[0] * (1.0 + np.linspace(-1e-4, 1e-4, 20001))
    assert size_of(machine, narrow, "disk").max() <= peaks.amplitude[0] * (1.0 + 1e-9)


@pytest.mark.parametrize("speeds", [500.0, [500.0], [500.0, 400.0], [[400.0, 500.0]], [500.0] * 3])
def test_speeds_that_do_not_rise_are_refused(speeds):
    with pytest.raises(ValueError, match=r"^speed(\[\d\] = |: must be two or more rising)"):
        response_peaks(SHEET, speeds)
