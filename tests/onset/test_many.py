"""Onsets of many machines at once, against `onset_speed` machine by machine."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotorcalc import PRESETS, onset_speed
from rotorcalc.numerics import routh
from rotorcalc.onset.many import _has_hump, _peaks, onset_speeds, sure_onsets
from tests.machines import ROTORS, SHEET, balanced, log_uniform, machines, with_rotor
from tests.onset.test_search import rounding

few = settings(max_examples=10, suppress_health_check=[HealthCheck.too_slow])
QUIET = with_rotor(shaft_stiffness=1e6, disk_damping=1e5)


@few
@given(
    st.lists(
        machines(damped=True, journals=True, load=st.none() | log_uniform(1e-4, 1e6))
        | machines(damped=True)
        | machines(journals=True),
        min_size=1,
        max_size=6,
    )
)
def test_certain_onsets_are_those_of_onset_speed(many):
    for machine, speed in zip(many, sure_onsets(many), strict=True):
        if not math.isnan(speed):
            expected = onset_speed(machine).speed
            error = rounding(machine, expected) if math.isfinite(expected) else 0.0
            assert speed == pytest.approx(expected, rel=error)


def test_onsets_of_all_kinds_of_machines_are_certain():
    """Also machines without an onset; an onset at speed 0 is left to the single search."""
    many = [QUIET, *map(balanced, ROTORS.values()), *(p.machine for p in PRESETS.values()), QUIET]
    expected = [onset_speed(machine).speed for machine in many]
    assert sure_onsets(many) == pytest.approx(expected, rel=1e-12)
    assert np.isnan(sure_onsets([replace(SHEET, load=0.0)])).all()


@pytest.mark.parametrize("many", [[], [QUIET], [QUIET, QUIET]])
def test_machines_without_an_onset_get_infinity(many):
    assert list(sure_onsets(many)) == [math.inf] * len(many)


def test_doubtful_onsets_are_left_to_the_single_search(monkeypatch):
    """Near the onset first, and with all that is in doubt each onset is found one by one."""
    many = [balanced(rotor) for rotor in ROTORS.values()]
    expected = [onset_speed(machine).speed for machine in many]
    for share in (1e-6, 1.0):
        monkeypatch.setattr(routh, "ROUNDING", share)
        assert np.isnan(sure_onsets(many)).all()
        assert onset_speeds(many) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("doubt", "peaks"),
    [
        ([-5, -4, -3, -2, 1], []),
        ([-5, -3, -4, -2, 1], [1]),
        ([-2, -3, -4, -2, 1], []),
        ([-5, -4, -2, -3, 1], [2]),
        ([-5, 1, -4, -3, -5], []),
        ([-5, -4, -3, -2, -2], [3]),
    ],
)
def test_peaks_are_those_before_the_first_uncertain_speed(doubt, peaks):
    rows, places = _peaks(np.array([doubt, [1, -3, -2, -3, 1]]))
    assert list(places) == peaks
    assert list(rows) == [0] * len(peaks)


@pytest.mark.parametrize("tops", [(-0.01, 0.01), (0.001, -0.3), (-1e-3, -1e-3), (2e-3, 1e-3)])
def test_a_hump_between_two_speeds_is_found_in_its_row(tops):
    """Each row rises to its top at 2.3 or 6.7, between two speeds."""
    speeds, middle = np.tile(np.arange(1.0, 9.0), (2, 1)), np.array([2.3, 6.7])

    def values(speed, rows):
        return np.array(tops)[rows, None] - (speed - middle[rows, None]) ** 2

    found = values(speeds, np.arange(2))
    assert np.all(found < 0.0)
    assert list(_has_hump(values, speeds, found)) == [top > 0.0 for top in tops]


def test_a_hump_below_zero_leaves_no_doubt():
    """Midspan damping quenches its whirl, all but: the growth rises and falls below zero."""
    humped = with_rotor(disk_damping=1e5)
    assert np.all(np.isinf(sure_onsets([humped] * 2)))
    assert np.isinf(onset_speed(humped).speed)
