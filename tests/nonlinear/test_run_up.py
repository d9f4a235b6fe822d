"""A run-up's spectra beside the linear theory, and how long a release is worth following."""

import math

import numpy as np
import pytest

from rotorcalc import analyse, modes
from rotorcalc.nonlinear import run_up as module
from rotorcalc.nonlinear.measured_onset import growth_curve
from rotorcalc.nonlinear.release import affordable_revolutions
from rotorcalc.nonlinear.run_up import run_up
from tests.machines import ROTORS, RPM, SHEET, C, balanced


def test_a_balanced_rotor_gets_a_small_imbalance_and_whirls_past_its_onset(monkeypatch):
    monkeypatch.setattr(module, "REVOLUTIONS", 400)
    told = []
    found = run_up(balanced(SHEET.rotor), 12000 * RPM, progress=told.append)
    assert told[-1] == 1.0
    assert 3600 * RPM < found.seen.speed[0] < found.seen.speed[-1] < 12000 * RPM
    i = np.argmin(np.abs(found.seen.speed - 6000 * RPM))
    whirl = complex(modes.leading(analyse(SHEET, found.seen.speed[i]).flexible_eigenvalues))
    assert found.whirl_order[i] == pytest.approx(whirl.imag / found.seen.speed[i])
    near_half = np.abs(found.seen.order - 0.5) < 0.05
    assert found.seen.amplitude[-1, near_half].max() > 0.1 * C
    assert found.seen.amplitude[i].max() < 0.01 * C


def test_growth_measured_lies_on_the_curve_of_the_eigenvalues():
    found = growth_curve(balanced(ROTORS["rigid"]), 11000 * RPM)
    on_curve = np.interp(found.measured_speed, found.speed, found.rate)
    assert found.measured == pytest.approx(on_curve, abs=1e-3 * np.abs(on_curve).max())
    assert math.isnan(found.running_speed)


def test_a_release_is_followed_for_800_swings_of_the_fastest_mode_and_16_revolutions_at_least():
    for speed in (10.0, 100.0, 600.0):
        point = analyse(SHEET, speed)
        swings = np.abs(point.flexible_eigenvalues.imag).max() / speed
        most = affordable_revolutions(point)
        assert most == 16 or most * max(swings, 1.0) == pytest.approx(800, rel=0.04)
    assert affordable_revolutions(analyse(SHEET, 1.0)) == 16
