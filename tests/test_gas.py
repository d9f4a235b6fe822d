"""A gas as lubricant: Sutherland's law, JSON beside oils, and what is refused in words."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import zero_Celsius

import rotorcalc as rc
from rotorcalc import Gas, Machine
from rotorcalc.gas import air_density, mean_free_path
from tests.films.models import BEARINGS, GAS
from tests.machines import SHEET

AIRY = replace(SHEET, oil=Gas(), bearing=GAS["foil"], load=500.0, temperature=40.0)

# U.S. Standard Atmosphere 1976, tables of dynamic viscosity: at sea level and at 11 km.
TABULATED = [(288.15, 1.7894e-5), (216.65, 1.4216e-5)]


@pytest.mark.parametrize(("kelvin", "viscosity"), TABULATED)
def test_air_has_the_viscosity_of_the_standard_atmosphere(kelvin, viscosity):
    assert float(Gas().viscosity(kelvin - zero_Celsius)) == pytest.approx(viscosity, rel=1e-4)


def test_the_law_keeps_its_reference_and_rises():
    gas = Gas(reference_viscosity=2e-5, reference_temperature=100.0, sutherland_temperature=240.0)
    assert float(gas.viscosity(100.0)) == pytest.approx(2e-5, rel=1e-15)
    T = np.linspace(-150.0, 1500.0, 50)
    assert np.all(np.diff(gas.viscosity(T)) > 0.0)
    # Far above S the law is √T, far below T^1.5.
    hot = gas.viscosity(np.array([1e8, 4e8]))
    assert hot[1] / hot[0] == pytest.approx(2.0, rel=1e-4)


def test_air_at_sea_level_has_the_density_of_the_standard_atmosphere():
    assert float(air_density(15.0, 101325.0)) == pytest.approx(1.2250, rel=1e-4)


def test_the_mean_free_path_is_that_of_the_kinetic_theory():
    """μ = ½ρcλ with the mean speed of the molecules, c = √(8RT/π)."""
    mu, T = Gas().viscosity(15.0), 288.15
    path = float(mean_free_path(mu, 15.0, 101325.0))
    speed = np.sqrt(8.0 * 287.053 * T / np.pi)
    assert 0.5 * 1.2250 * speed * path == pytest.approx(float(mu), rel=1e-4)
    # The standard atmosphere's, 6.6332e-8 m, is from a diameter of molecules.
    assert path == pytest.approx(6.6332e-8, rel=0.05)


@pytest.mark.parametrize("temperature", [-273.15, np.nan, np.inf, "warm"])
def test_a_gas_has_no_viscosity_at_absolute_zero(temperature):
    with pytest.raises(ValueError, match="temperature"):
        Gas().viscosity(temperature)


def test_a_machine_keeps_its_gas_in_json():
    gas = Gas(reference_viscosity=1.9e-5, sutherland_temperature=79.0)
    tree = json.loads(replace(AIRY, oil=gas).to_json())
    assert tree["version"] == 2
    assert tree["oil"] == {
        "type": "gas", "reference_viscosity": 1.9e-5, "sutherland_temperature": 79.0
    }  # fmt: skip
    assert Machine.from_json(json.dumps(tree)).oil == gas


def test_an_oil_is_written_without_its_kind_and_read_with_it():
    tree = json.loads(SHEET.to_json())
    assert "type" not in tree["oil"]
    tree["oil"]["type"] = "oil"
    assert Machine.from_json(json.dumps(tree)) == SHEET
    tree["oil"]["type"] = "water"
    with pytest.raises(ValueError, match=r"oil\.type = 'water': must be one of .*gas.*oil"):
        Machine.from_json(json.dumps(tree))


def test_a_foil_takes_a_gas_and_every_other_bore_an_oil():
    with pytest.raises(ValueError, match=r"oil = an Oil: .*'foil' takes a Gas"):
        replace(AIRY, oil=SHEET.oil)
    for bearing in BEARINGS.values():
        with pytest.raises(ValueError, match=r"oil = a Gas: .* takes an Oil"):
            replace(SHEET, bearing=bearing, oil=Gas())


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (lambda: replace(AIRY, temperature=None, supply=rc.Supply(temperature=30.0)), "^supply: "),
        (lambda: rc.coefficients.added_mass(AIRY, 3000.0), "^bearing = foil: .* no added mass"),
        (lambda: rc.simulate(AIRY, 3000.0, revolutions=1), "^bearing = foil: .*in a steady whirl"),
        (lambda: rc.heat.flow_for_rise(AIRY, 3000.0), "^oil = a Gas: must be an Oil"),
        (lambda: Gas(reference_temperature=-273.15), "^reference_temperature = "),
        (lambda: Gas(sutherland_temperature=-1.0), "^sutherland_temperature = "),
        (lambda: replace(AIRY, temperature=-273.15), "^temperature = "),
    ],
)
def test_what_a_gas_has_not_is_refused_in_words(asked, words):
    with pytest.raises(ValueError, match=words):
        asked()


def test_the_validity_of_a_gas_film_is_checked():
    checks = {one.name: one for one in rc.validity(rc.analyse(AIRY, [2000.0, 8000.0]))}
    number = 6.0 * AIRY.viscosity * np.array([2000.0, 8000.0]) * 1250.0**2 / 101325.0
    found = checks["Compressibility number, 6μΩ(R/C)²/pₐ"]
    assert found.value == pytest.approx(number)
    assert found.level.tolist() == ["good", "caution"]
    slip = checks["Molecules' mean free path over smallest film, λ/h"]
    film = rc.analyse(AIRY, 2000.0).minimum_film_thickness
    assert slip.value[0] == pytest.approx(7.2e-8 / film, rel=0.1)
    reynolds = next(one for name, one in checks.items() if name.startswith("Reynolds"))
    air = 101325.0 / (287.053 * 313.15)
    assert reynolds.value[0] == pytest.approx(air * 2000.0 * 0.075 * 60e-6 / AIRY.viscosity)
    assert not any(name.startswith("Heat") for name in checks)
