"""Validity: each assumption is judged by its own number, and the sheet's machine keeps to most."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse
from rotorcalc.validity import ROUGHNESS, validity
from tests.films.models import BEARINGS

SHEET = PRESETS["sheet-1e8"]


def judged(machine, speed=SHEET.speed):
    return {check.name.split(",")[0]: check for check in validity(analyse(machine, speed))}


def with_bearing(**changes):
    return replace(SHEET.machine, bearing=replace(SHEET.machine.bearing, **changes))


def test_the_sheets_machine_has_the_numbers_of_its_geometry():
    checks = judged(SHEET.machine)
    assert checks["Length over diameter"].value == pytest.approx(1 / 3)
    # ρΩRC/μ = 860 · 628.3185 · 0.075 · 60e-6 / 0.01276940
    assert checks["Reynolds number of the film"].value == pytest.approx(190.42, abs=0.005)
    assert checks["Static sag over clearance"].value == pytest.approx(0.2224)
    assert checks["Reynolds number of the film"].caution == pytest.approx(41.1 * math.sqrt(1250))


@pytest.mark.parametrize(
    ("length", "level"), [(0.050, "good"), (0.100, "caution"), (0.160, "outside")]
)
def test_length_over_diameter_is_judged(length, level):
    assert judged(with_bearing(length=length))["Length over diameter"].worst == level


def test_a_thin_film_is_outside_when_it_reaches_the_roughness():
    heavy = replace(SHEET.machine, load=5e7)
    film = judged(heavy)["Smallest film over roughness of 1 µm"]
    assert film.value == pytest.approx(
        float(analyse(heavy, SHEET.speed).minimum_film_thickness) / ROUGHNESS
    )
    assert film.worst == "outside"
    assert judged(heavy)["Smallest film over clearance"].worst == "outside"


def test_an_orbit_that_reaches_the_wall_is_outside():
    rotor = replace(SHEET.machine.rotor, imbalance=100e-6)
    wild = replace(SHEET.machine, rotor=rotor)
    assert (
        judged(wild, speed=7900 * math.pi / 30)["Imbalance orbit over clearance"].worst == "outside"
    )
    still = replace(SHEET.machine, rotor=replace(rotor, imbalance=0.0))
    assert judged(still)["Imbalance orbit over clearance"].value == 0.0


def test_an_orbit_larger_than_a_thin_film_is_outside():
    heavy = replace(SHEET.machine, load=1e6)
    still = analyse(heavy, SHEET.speed)
    film = float(still.minimum_film_thickness) / heavy.bearing.radial_clearance
    assert film < 0.09
    whirling = judged(heavy)["Imbalance orbit over clearance"]
    size = float(whirling.value) / heavy.rotor.imbalance  # linear in the imbalance
    for share, worst in ((0.9, "good"), (1.1, "outside")):
        rotor = replace(heavy.rotor, imbalance=share * film / size)
        check = judged(replace(heavy, rotor=rotor))["Imbalance orbit over clearance"]
        assert (check.worst, float(check.limit)) == (worst, pytest.approx(film))


def test_a_fast_thin_oil_leaves_the_laminar_range():
    thin = replace(SHEET.machine, temperature=150.0)
    assert judged(thin, speed=3000.0)["Reynolds number of the film"].worst == "outside"


def test_a_flexible_rotor_sags_past_the_clearance():
    assert judged(PRESETS["sheet-1e7"].machine)["Static sag over clearance"].worst == "caution"


def test_a_film_models_own_assumptions_are_judged_where_it_has_some():
    assert "Length over diameter" in judged(SHEET.machine)
    sprung = replace(SHEET.machine, bearing=BEARINGS["sprung"])
    assert "Length over diameter" not in judged(sprung)
    assert judged(sprung)["Reynolds number of the film"].worst == "good"


def test_a_sweep_is_judged_speed_by_speed_as_each_speed_alone():
    speeds = [200.0, 600.0, 1200.0, 3000.0]
    machine = replace(SHEET.machine, temperature=110.0)
    for i, speed in enumerate(speeds):
        for check, alone in zip(
            validity(analyse(machine, speeds)), validity(analyse(machine, speed)), strict=True
        ):
            assert check.value.shape == check.level.shape == check.limit.shape == (4,)
            assert check.level[i] == alone.worst, check.name
            assert check.value[i] == pytest.approx(float(alone.value), rel=1e-12)


def test_the_worst_verdict_of_a_sweep_is_that_of_its_worst_speed():
    thin = replace(SHEET.machine, temperature=150.0)
    checks = validity(analyse(thin, [10.0, 400.0, 3000.0]))
    reynolds = next(check for check in checks if check.name.startswith("Reynolds"))
    # ρΩRC/μ = 4.51 s · Ω: 45, 1804 and 13530 against 1453 and 2000.
    assert reynolds.level.tolist() == ["good", "caution", "outside"]
    assert reynolds.worst == "outside"


def test_all_checks_print_within_a_screen():
    checks = repr(validity(analyse(SHEET.machine, np.linspace(100.0, 900.0, 50))))
    assert checks.count("\n") == 0
    assert len(checks) < 8 * 100
    assert "Static sag over clearance, Γ/C: good" in checks
