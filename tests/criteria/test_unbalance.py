"""Residual unbalance: grades of ISO 21940-11 and API's 4W/N, both ways."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import inch, lb, oz

from rotorcalc import criteria, rpm
from tests.machines import ROTORS, SHEET, with_rotor

OZ_IN = oz * inch


def test_the_comparison_of_a_rotor_of_1000_lb_at_15000_rpm():
    # energy-tech.com, article 18389: 4W/N 0.13 oz·in in each of two planes, G 2.5 1.0 oz·in in all.
    speed = 15000 * rpm
    api = criteria.permissible_eccentricity("4W/N", speed=speed) * 500 * lb
    assert api / OZ_IN == pytest.approx(0.13, abs=0.005)
    assert api / OZ_IN == pytest.approx(4 * 500 / 15000, rel=1e-12)
    iso = criteria.permissible_eccentricity("G 2.5", speed=speed) * 1000 * lb
    assert iso / OZ_IN == pytest.approx(1.0, abs=0.05)
    # The article's factor of a grade, in oz·in of lb over rpm.
    assert iso / OZ_IN == pytest.approx(2.5 * 6.015 * 1000 / 15000, rel=1e-4)


def test_the_si_form_of_4w_over_n():
    # 6350 W/N in g·mm, W in kg and N in rpm.
    unbalance = criteria.permissible_eccentricity("4W/N", speed=6000 * rpm) * 120.0
    assert unbalance * 1e6 == pytest.approx(6350 * 120.0 / 6000, rel=1e-12)


def test_4w_over_n_is_a_grade_of_0_665_at_every_speed():
    speed = np.array([10.0, 1e3, 1e4])
    e = criteria.permissible_eccentricity("4W/N", speed=speed)
    assert e * speed * 1e3 == pytest.approx(np.full(3, 0.665), abs=5e-4)


@pytest.mark.parametrize("rotor", ROTORS.values(), ids=ROTORS)
@pytest.mark.parametrize("grade", criteria.GRADES)
def test_an_imbalance_of_a_grade_has_that_grade(grade, rotor):
    u = float(criteria.imbalance_of_grade(grade, rotor=rotor, speed=700.0))
    balanced = replace(rotor, imbalance=u)
    assert criteria.balance_quality(balanced, speed=700.0) == pytest.approx(criteria.GRADES[grade])
    met = criteria.grade_of_imbalance(balanced, speed=700.0)
    assert met == ("G 1" if grade == "4W/N" else grade)
    # The unbalance is the disk's, and the whole rotor's mass times the mass centre's distance.
    e = criteria.permissible_eccentricity(grade, speed=700.0)
    assert rotor.disk_mass * u == pytest.approx(rotor.half_mass * e, rel=1e-14)


def test_an_imbalance_above_the_coarsest_grade_has_none():
    rotor = with_rotor(imbalance=1e-3).rotor
    assert criteria.grade_of_imbalance(rotor, speed=1000.0) is None
    assert criteria.grade_of_imbalance(replace(rotor, imbalance=0.0), speed=1000.0) == "G 0.4"


def test_an_unknown_grade_is_refused_with_those_known():
    with pytest.raises(ValueError, match=r"grade = 'G 3': must be .*G 2\.5"):
        criteria.imbalance_of_grade("G 3", rotor=SHEET.rotor, speed=100.0)
