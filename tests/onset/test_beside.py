"""Onsets beside a known one, against the search over all speeds."""

import math
from dataclasses import replace

import pytest

from rotorcalc import onset_speed
from rotorcalc.onset.beside import edge, onset_between
from tests.machines import SHEET, with_rotor

DAMPED = with_rotor(disk_damping=3e3, journal_mass=5.0)


@pytest.mark.parametrize("machine", [SHEET, DAMPED, replace(SHEET, load=900.0)])
def test_it_is_the_onset_of_the_search_between_two_speeds_about_it(machine):
    onset = onset_speed(machine).speed
    assert onset_between(machine, 0.95 * onset, 1.04 * onset) == pytest.approx(onset, rel=1e-12)
    assert edge(machine, 0.999 * onset) > 0.0 > edge(machine, 1.001 * onset)


def test_it_is_no_number_where_none_lies_between():
    onset = onset_speed(DAMPED).speed
    assert math.isnan(onset_between(DAMPED, 0.90 * onset, 0.95 * onset))
    assert math.isnan(onset_between(DAMPED, 1.05 * onset, 1.10 * onset))
