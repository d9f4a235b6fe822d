"""The onset of machines of every size, against a judge that counts unstable roots in 60 digits."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotorcalc import JournalBearing, Machine, Oil, Rotor, onset_speed
from rotorcalc.coefficients import modified_sommerfeld
from tests.machines import SHEET, with_rotor
from tests.onset.reference import drawn, unstable_roots

_NEAR = 1e-7
# What the film does between two speeds of the check is no narrower.
_CHECKED = 15

# Machines whose onset was once taken from rounding errors: C 10 µm, large journals, a soft shaft.
CORNERS = [
    Machine(
        oil=Oil(reference_viscosity=0.05, reference_temperature=50, temperature_coefficient=0.03),
        bearing=JournalBearing(diameter=diameter, length=0.3, radial_clearance=10e-6),
        rotor=Rotor(mass=50.0, shaft_stiffness=1e5, journal_mass=journal_mass, disk_damping=C_s),
        temperature=40.0,
    )
    for diameter in (0.55, 0.6, 0.65)
    for journal_mass in (0.1, 0.12)
    for C_s in (0.0, 1.0, 300.0)
]


def assert_is_the_onset(machine, *, flexible=True):
    onset = onset_speed(machine, flexible)
    lowest = 0.01 / float(modified_sommerfeld(machine, 1.0))
    highest = 1e9 * lowest
    if math.isfinite(onset.speed):
        highest = onset.speed * (1 - _NEAR)
        assert unstable_roots(machine, onset.speed * (1 + _NEAR), flexible=flexible) > 0
    for speed in np.geomspace(min(lowest, 1e-3 * highest), highest, _CHECKED):
        assert unstable_roots(machine, speed, flexible=flexible) == 0
    return onset


@pytest.mark.parametrize("damped", [False, True])
@settings(max_examples=40, suppress_health_check=[HealthCheck.too_slow])
@given(st.integers(0, 10**6), st.booleans())
def test_the_onset_is_right_to_a_ten_millionth(damped, seed, flexible):
    assert_is_the_onset(drawn(seed, damped=damped), flexible=flexible)


@pytest.mark.parametrize("machine", CORNERS)
def test_the_onset_is_right_where_floats_leave_doubt(machine):
    onset = assert_is_the_onset(machine)
    assert 0.0 < onset.whirl_frequency < onset.speed


def test_an_onset_names_the_method_that_found_it():
    assert onset_speed(SHEET).method == "closed form"
    assert onset_speed(with_rotor(journal_mass=10.0)).method == "closed form"
    assert onset_speed(with_rotor(disk_damping=2e3)).method == "polynomial"
    assert onset_speed(with_rotor(disk_damping=1e5)).method == "polynomial"  # there is none
    assert onset_speed(CORNERS[1]).method == "extended precision"


@pytest.mark.parametrize("flexible", ["rigid", "", 2, None, 0.5])
def test_a_word_for_flexible_is_refused(flexible):
    with pytest.raises(ValueError, match=r"flexible = .*must be True or False"):
        onset_speed(SHEET, flexible)


@pytest.mark.parametrize("flexible", [np.True_, np.False_])
def test_numpys_truth_is_accepted(flexible):
    assert onset_speed(SHEET, flexible) == onset_speed(SHEET, bool(flexible))


def test_an_onset_always_has_its_whirl_frequency():
    """Routh's row gives ω² as a ratio of differences; on this machine rounding made it negative."""
    machine = Machine(
        oil=Oil(
            reference_viscosity=0.0004946736371951582, reference_temperature=40,
            temperature_coefficient=0.03,
        ),
        bearing=JournalBearing(
            diameter=0.11060086487103017, length=0.03735970198211385,
            radial_clearance=5.400238211517415e-06,
        ),
        rotor=Rotor(
            mass=40905.252749569416, shaft_stiffness=8450.721825840576,
            disk_damping=0.001204308673140075, journal_mass=0.23312464118718015,
        ),
        temperature=40,
    )  # fmt: skip
    onset = onset_speed(machine)
    assert onset.whirl_frequency == pytest.approx(onset.speed / 2, rel=1e-3)
