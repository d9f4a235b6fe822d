"""Recess pressures, flows and powers of hydrostatic bearings, with dimensions."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import atmosphere, degree

from rotorcalc import (
    Hydrostatic,
    JournalBearing,
    Machine,
    Supply,
    heat_balance,
    recess_equilibrium,
    recess_pressure,
    validity,
)
from rotorcalc.analysis import analyse
from rotorcalc.coefficients import equilibrium
from tests.machines import SHEET

SHAPE = Hydrostatic(supply_pressure=3e6)
BEARING = JournalBearing(diameter=0.1, length=0.1, radial_clearance=50e-6, geometry=SHAPE)
MACHINE: Machine = replace(SHEET, bearing=BEARING)
SPEED = np.array([[1.0, 100.0, 400.0], [700.0, 1000.0, 1500.0]])


def on(**changes):
    return replace(MACHINE, bearing=replace(BEARING, geometry=replace(SHAPE, **changes)))


def test_without_load_every_recess_is_at_the_pressure_ratio():
    found = recess_pressure(replace(on(pressure_ratio=0.4), load=0.0), SPEED)
    assert found.shape == (2, 3, 4)
    assert found == pytest.approx(0.4 * 3e6, rel=1e-9)


def test_the_recess_under_the_load_has_the_highest_pressure():
    found = recess_pressure(MACHINE, 100.0)
    assert found.shape == (4,)
    assert found.argmax() == 0
    assert found.argmin() == 2
    assert recess_pressure(on(recesses=6), SPEED[0]).shape == (3, 6)


@pytest.mark.parametrize("restrictor", ["capillary", "orifice"])
def test_what_passes_a_restrictor_follows_from_its_pressure_drop(restrictor):
    machine = on(restrictor=restrictor, pressure_ratio=0.6)
    found, p_s = recess_equilibrium(machine, SPEED), 3e6
    drop = 1.0 - found.pressure / p_s
    law = drop if restrictor == "capillary" else np.sqrt(drop)
    factor = found.recess_flow / law
    assert factor == pytest.approx(factor.flat[0], rel=1e-8)
    free = recess_equilibrium(replace(machine, load=0.0), 1.0)
    centred = 0.4 if restrictor == "capillary" else math.sqrt(0.4)
    assert free.recess_flow == pytest.approx(factor.flat[0] * centred, rel=1e-8)


def test_flow_and_friction_are_those_of_the_film():
    found, film = recess_equilibrium(MACHINE, SPEED), equilibrium(MACHINE, SPEED)
    assert found.flow == pytest.approx(film.side_flow, rel=1e-12)
    assert found.recess_flow.sum(axis=-1) == pytest.approx(found.flow, rel=1e-12)
    assert found.friction_power == pytest.approx(film.power_loss, rel=1e-12)
    assert found.pump_power == pytest.approx(3e6 * found.flow, rel=1e-12)


def test_flow_goes_with_supply_pressure_and_the_cube_of_the_clearance():
    free = replace(MACHINE, load=0.0)
    one = float(recess_equilibrium(free, 100.0).flow)
    wide = replace(free, bearing=replace(BEARING, radial_clearance=100e-6))
    assert float(recess_equilibrium(wide, 100.0).flow) == pytest.approx(8.0 * one)
    strong = replace(on(supply_pressure=6e6), load=0.0)
    assert float(recess_equilibrium(strong, 100.0).flow) == pytest.approx(2.0 * one)


def test_a_thin_land_passes_the_flow_of_parallel_plates():
    """Q = π D p C³/(12 μ a) at both ends of lands so short that they are straight."""
    shape = {"land_ratio": 0.03, "land_angle": 3 * degree}
    machine = replace(on(**shape), load=0.0)
    found = float(recess_equilibrium(machine, 1.0).flow)
    a, p = 0.03 * 0.1, 0.5 * 3e6
    plates = 2.0 * math.pi * 0.1 * p * (50e-6) ** 3 / (12.0 * machine.viscosity * a)
    assert found == pytest.approx(plates, rel=0.02)


def test_suction_of_the_film_is_given_and_warned_of():
    heavy = replace(on(supply_pressure=5e6, pressure_ratio=0.2), load=12000.0)
    found = recess_equilibrium(heavy, np.array([0.1, 200.0]))
    assert found.has_suction.tolist() == [False, True]
    assert found.lowest_pressure[1] < -1e4
    [check] = [one for one in validity(analyse(heavy, 200.0)) if "Suction" in one.name]
    assert float(check.value) == pytest.approx(-found.lowest_pressure[1] / atmosphere)
    assert check.worst != "good"
    [check] = [one for one in validity(analyse(MACHINE, SPEED)) if "Suction" in one.name]
    assert check.worst == "good"


def test_no_speed_at_all_has_no_answer_rather_than_a_fault():
    # As where a machine has no peak of its response below its top speed.
    assert recess_equilibrium(MACHINE, np.empty(0)).pressure.shape == (0, 4)
    assert analyse(MACHINE, np.empty(0)).stiffness.shape == (0, 2, 2)


def test_a_bearing_without_recesses_is_refused():
    with pytest.raises(ValueError, match="plain: has no recesses"):
        recess_pressure(SHEET, 100.0)
    with pytest.raises(ValueError, match="no recesses"):
        recess_equilibrium(SHEET, 100.0)


def test_the_supplied_oil_carries_the_heat():
    warm = replace(MACHINE, temperature=None, supply=Supply(temperature=40.0))
    found = heat_balance(warm, 300.0)
    film = recess_equilibrium(warm, 300.0)
    rise = film.friction_power / (warm.oil.volumetric_heat * film.flow)
    assert float(found.outlet_temperature) == pytest.approx(40.0 + float(rise), rel=1e-6)
