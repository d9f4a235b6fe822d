"""Friswell, Penny, Garvey and Lees, Dynamics of Rotating Machines (2010), example 5.5.1.

A short bearing of 100 mm diameter, 30 mm length and 0.1 mm radial clearance, oil of 0.1 Pa·s,
525 N at 1500 rpm. The numbers, and the order of the matrix's elements, are those of the open cases
of the program's design: X along the load, Y at +90° in the sense of rotation.
"""

import math

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse

MACHINE = PRESETS["friswell-5-5-1"].machine


@pytest.fixture(scope="module")
def example():
    return analyse(MACHINE, 1500 * math.pi / 30)


def test_eccentricity_ratio(example):
    assert example.eccentricity_ratio == pytest.approx(0.2663, rel=0, abs=0.5e-4)


@pytest.mark.parametrize(
    ("i", "j", "printed", "half_a_unit"),
    [
        (0, 0, 8.815, 0.5e-3),
        (0, 1, 25.06, 0.5e-2),
        (1, 0, -16.39, 0.5e-2),
        (1, 1, 12.81, 0.5e-2),
    ],
)
def test_stiffness(example, i, j, printed, half_a_unit):
    """In MN/m."""
    assert example.stiffness[i, j] / 1e6 == pytest.approx(printed, rel=0, abs=half_a_unit)


def test_the_cross_stiffness_exceeds_the_direct_one(example):
    assert np.all(np.abs(np.diag(example.stiffness)) < example.stiffness[0, 1])
