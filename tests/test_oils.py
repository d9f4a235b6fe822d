"""Oils: the grades' viscosities where the standards give them, and the laws that touch them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc.machine import Oil
from rotorcalc.oils import DENSITY, ISO_VG, density, fitted_oil, heat_capacity, iso_oil


@pytest.mark.parametrize("grade", ISO_VG)
@pytest.mark.parametrize(("temperature", "column"), [(40.0, 0), (100.0, 1)])
def test_a_grade_has_its_standard_viscosities(grade, temperature, column):
    oil = iso_oil(grade, temperature=temperature)
    nu = oil.reference_viscosity / DENSITY * 1e6
    assert nu == pytest.approx(ISO_VG[grade][column], rel=1e-12)


@pytest.mark.parametrize("grade", ISO_VG)
def test_the_law_of_a_grade_has_its_slope_too(grade):
    below, at, above = (iso_oil(grade, temperature=T) for T in (59.99, 60.0, 60.01))
    slope = math.log(below.reference_viscosity / above.reference_viscosity) / 0.02
    assert at.temperature_coefficient == pytest.approx(slope, rel=1e-7)


def test_thicker_grades_are_thicker_at_every_temperature():
    for T in (10.0, 60.0, 120.0):
        viscosities = [iso_oil(grade, temperature=T).reference_viscosity for grade in ISO_VG]
        assert viscosities == sorted(viscosities)


@given(
    T_1=st.floats(0, 70),
    T_2=st.floats(71, 150),
    mu_1=st.floats(0.02, 1.0),
    thinning=st.floats(1, 50),
)
def test_the_fit_passes_through_both_viscosities(T_1, T_2, mu_1, thinning):
    oil = fitted_oil(temperatures=(T_1, T_2), viscosities=(mu_1, mu_1 / thinning))
    assert float(oil.viscosity(T_1)) == pytest.approx(mu_1, rel=1e-12)
    assert float(oil.viscosity(T_2)) == pytest.approx(mu_1 / thinning, rel=1e-12)


@pytest.mark.parametrize(
    ("temperatures", "viscosities", "words"),
    [
        ((50.0, 50.0), (0.02, 0.01), "must differ"),
        ((50.0, 60.0), (0.0, 0.01), "must be positive"),
        ((50.0, 60.0), (0.01, 0.02), "temperature_coefficient"),
    ],
)
def test_an_impossible_fit_raises_a_valueerror(temperatures, viscosities, words):
    with pytest.raises(ValueError, match=words):
        fitted_oil(temperatures=temperatures, viscosities=viscosities)


def test_an_unknown_grade_is_refused_by_name():
    with pytest.raises(ValueError, match="ISO VG 33"):
        iso_oil("ISO VG 33", temperature=40.0)


@pytest.mark.parametrize("temperature", [-200.0, -70.1, 371.0, math.nan, "40", None])
@pytest.mark.parametrize("grade", ISO_VG)
def test_a_grade_has_no_law_outside_walthers_range(grade, temperature):
    with pytest.raises(ValueError, match=r"^temperature = "):
        iso_oil(grade, temperature=temperature)


@pytest.mark.parametrize("temperature", [-70.0, 370.0])
@pytest.mark.parametrize("grade", ISO_VG)
def test_a_grade_has_a_law_at_the_ends_of_the_range(grade, temperature):
    oil = iso_oil(grade, temperature=temperature)
    assert 0.0 < oil.reference_viscosity < math.inf
    assert oil.temperature_coefficient > 0.0


@pytest.mark.parametrize("grade", ISO_VG)
def test_by_walthers_law_an_oil_is_its_grade_at_every_temperature(grade):
    oil = iso_oil(grade, temperature=60.0, law="walther")
    nu = oil.viscosity([40.0, 100.0]) / DENSITY * 1e6
    assert nu == pytest.approx(ISO_VG[grade], rel=1e-12)
    for T in (-20.0, 10.0, 80.0, 150.0):
        other = iso_oil(grade, temperature=T)
        assert oil.viscosity(T) == pytest.approx(other.reference_viscosity, rel=1e-12)
        assert oil.thinning(T) == pytest.approx(other.temperature_coefficient, rel=1e-12)


@given(
    st.sampled_from(["exponential", "walther"]), st.floats(-60, 300), st.floats(0.002, 2.0),
    st.floats(0.005, 0.06),
)  # fmt: skip
def test_a_viscosity_gives_its_temperature_back(law, T, mu, alpha):
    oil = Oil(
        reference_viscosity=mu, reference_temperature=40.0, temperature_coefficient=alpha, law=law
    )
    there = oil.viscosity(T)
    if 1e-7 < float(there) < 1e6:
        assert float(oil.temperature(there)) == pytest.approx(T, abs=1e-6 * (1.0 + abs(T)))
        step = 1e-4
        slope = np.log(oil.viscosity(T - step) / oil.viscosity(T + step)) / (2.0 * step)
        assert oil.thinning(T) == pytest.approx(slope, rel=1e-5)


@given(
    T_1=st.floats(0, 70), T_2=st.floats(71, 150), mu_1=st.floats(0.02, 1.0),
    thinning=st.floats(1.01, 20),
)  # fmt: skip
def test_walthers_law_passes_through_both_viscosities(T_1, T_2, mu_1, thinning):
    oil = fitted_oil(temperatures=(T_1, T_2), viscosities=(mu_1, mu_1 / thinning), law="walther")
    assert float(oil.viscosity(T_1)) == pytest.approx(mu_1, rel=1e-11)
    assert float(oil.viscosity(T_2)) == pytest.approx(mu_1 / thinning, rel=1e-11)


def test_walthers_law_refuses_what_is_thinner_than_oils():
    with pytest.raises(ValueError, match=r"0\.3 mm²/s"):
        fitted_oil(temperatures=(40.0, 100.0), viscosities=(0.01, 2e-4), law="walther")
    with pytest.raises(ValueError, match=r"0\.3 mm²/s"):
        Oil(reference_viscosity=2e-4, reference_temperature=40.0, temperature_coefficient=0.03,
            law="walther")  # fmt: skip


def test_density_and_heat_capacity_of_mineral_oils():
    assert density([15.0, 50.0]) == pytest.approx([880.0, 860.0], rel=1e-4)
    # Cragoe's table: 0.402 + 0.00081 T over √s in cal/(g·°C), 4.186 J each.
    assert heat_capacity(100.0) == pytest.approx((0.402 + 0.081) / 0.88**0.5 * 4186.0, rel=1e-3)
