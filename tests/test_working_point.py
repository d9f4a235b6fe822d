"""Load and stiffness from other quantities: put back, they give what was known."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rotorcalc as rc
from tests.machines import SHEET, with_rotor

SPEED = 6000 * rc.rpm
WARM = replace(SHEET, temperature=None, supply=rc.Supply(temperature=45.0, flow=2e-5))
ELLIPSE = replace(SHEET, bearing=replace(SHEET.bearing, geometry=rc.Elliptical(preload=0.4)))


@pytest.mark.parametrize("machine", [SHEET, WARM, ELLIPSE], ids=["short", "supply", "elliptical"])
def test_the_load_for_an_eccentricity_gives_it(machine: rc.Machine) -> None:
    load = rc.load_for(machine, SPEED, eccentricity_ratio=0.3)
    found = rc.analyse(replace(machine, load=load), SPEED)
    assert found.eccentricity_ratio == pytest.approx(0.3, rel=1e-10)


@pytest.mark.parametrize("machine", [SHEET, WARM, ELLIPSE], ids=["short", "supply", "elliptical"])
def test_the_load_for_a_sommerfeld_number_gives_it(machine: rc.Machine) -> None:
    load = rc.load_for(machine, SPEED, sommerfeld=0.7)
    found = rc.analyse(replace(machine, load=load), SPEED)
    assert found.sommerfeld == pytest.approx(0.7, rel=1e-10)


@given(S=st.floats(1e-3, 10.0))
def test_the_classical_number_is_its_formula(S: float) -> None:
    load = rc.load_for(SHEET, SPEED, classical_sommerfeld=S)
    b, N = SHEET.bearing, SPEED / (2.0 * math.pi)
    formula = SHEET.viscosity * N * b.length * b.diameter / load
    assert formula * (b.radius / b.radial_clearance) ** 2 == pytest.approx(S, rel=1e-12)


def test_the_textbooks_example_has_its_number() -> None:
    """Friswell and others, example 5.5.1: 525 N, ε = 0.266."""
    preset = rc.PRESETS["friswell-5-5-1"]
    load = rc.load_for(preset.machine, preset.speed, eccentricity_ratio=0.2663)
    assert load == pytest.approx(525.0, rel=1e-3)


def test_the_stiffness_for_a_natural_frequency_gives_it() -> None:
    machine = with_rotor(journal_mass=10.0)
    K = rc.stiffness_for(machine, natural_frequency=500.0)
    # On a film so stiff that the journal stands still the disk swings at that frequency.
    stiff = rc.varied(machine, {"shaft_stiffness": K, "oil.reference_viscosity": 1e9})
    values = rc.analyse(stiff, SPEED).flexible_eigenvalues
    assert np.min(np.abs(values - 500.0j)) < 0.01
    assert rc.stiffness_for(machine, natural_frequency=math.inf) == math.inf


@pytest.mark.parametrize(
    ("known", "words"),
    [
        ({}, "exactly one of eccentricity_ratio, sommerfeld, classical_sommerfeld"),
        ({"sommerfeld": 1.0, "eccentricity_ratio": 0.5}, "exactly one"),
        ({"eccentricity_ratio": 0.0}, "eccentricity_ratio = 0: must be positive"),
        ({"eccentricity_ratio": 1.5}, "no load gives this eccentricity ratio"),
        ({"sommerfeld": math.inf}, "sommerfeld = inf: must be positive and finite"),
        ({"sommerfeld": "1"}, "sommerfeld = '1': must be a number"),
    ],
)
def test_what_gives_no_load_is_named(known: dict, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        rc.load_for(SHEET, SPEED, **known)
    with pytest.raises(ValueError, match="natural_frequency = 0 rad/s"):
        rc.stiffness_for(SHEET, natural_frequency=0.0)
