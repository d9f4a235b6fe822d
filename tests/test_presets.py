"""Presets: each of its source's numbers, and each analysed from end to end."""

import math
from dataclasses import fields

import numpy as np
import pytest
from scipy.constants import g

from rotorcalc import PRESETS, Machine, analyse, onset_speed
from tests.machines import RPM


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_can_be_analysed_over_its_whole_range(name):
    preset = PRESETS[name]
    assert 0 < preset.speed < preset.top_speed
    sweep = analyse(preset.machine, np.linspace(preset.top_speed / 1000, preset.top_speed, 500))
    infinite = {"critical_mass", "rigid_threshold", "flexible_threshold"}
    # A preset's film temperature is given, so nothing says how warm its oil leaves.
    assert np.all(np.isnan(sweep.outlet_temperature))
    for field in fields(sweep):
        values = getattr(sweep, field.name)
        if field.name not in {"machine", "outlet_temperature", *infinite}:
            assert np.all(np.isfinite(values)), field.name
    assert np.all(np.isfinite(sweep.flexible_eigenvalues))
    assert np.all(np.diff(sweep.eccentricity_ratio) < 0)


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_runs_below_its_onset_and_its_range_shows_it(name):
    preset = PRESETS[name]
    assert preset.speed < onset_speed(preset.machine).speed < preset.top_speed


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_has_title_and_note_and_survives_json(name):
    preset = PRESETS[name]
    assert preset.title
    assert preset.note
    assert Machine.from_json(preset.machine.to_json()) == preset.machine


@pytest.mark.parametrize(("name", "stiffness"), [("sheet-1e8", 1e8), ("sheet-1e7", 1e7)])
def test_the_sheets_rotors(name, stiffness):
    """Calculation sheet of Notes 5, DATA for rotor and BEARING GEOMETRY."""
    machine = PRESETS[name].machine
    assert machine.rotor.mass * g == pytest.approx(600 * 4.448, rel=1e-15)
    assert machine.rotor.shaft_stiffness == stiffness
    assert machine.rotor.imbalance == pytest.approx(0.2 * 60e-6, rel=1e-15)
    assert (machine.rotor.disk_damping, machine.rotor.journal_mass) == (0.0, 0.0)
    bearing = machine.bearing
    assert (bearing.diameter, bearing.length, bearing.radial_clearance) == (0.150, 0.050, 60e-6)
    assert machine.oil.reference_viscosity == pytest.approx(2.5e-6 * 6894.757, rel=1e-15)
    assert (machine.oil.reference_temperature, machine.oil.temperature_coefficient) == (50, 0.030)
    assert machine.temperature == 60.0
    assert machine.load is None
    assert PRESETS[name].top_speed == pytest.approx(12000 * RPM)


def test_the_bearing_of_fig_5_2():
    """μ = 0.019 Pa·s, L = 0.05 m, C = 0.1 mm, 3,000 rpm, L/D = 0.25."""
    preset = PRESETS["fig-5-2"]
    bearing = preset.machine.bearing
    assert preset.machine.viscosity == 0.019
    assert bearing.length == 0.05
    assert bearing.length / bearing.diameter == 0.25
    assert bearing.radial_clearance == pytest.approx(1e-4, rel=1e-15)
    assert preset.speed == pytest.approx(3000 * RPM)
    assert preset.machine.rotor.is_rigid


def test_the_bearing_of_friswells_example():
    """525 N, 100 × 30 mm, C = 0.1 mm, 0.1 Pa·s, 1500 rpm; the rotor's mass gives the load."""
    preset = PRESETS["friswell-5-5-1"]
    bearing = preset.machine.bearing
    assert preset.machine.viscosity == 0.1
    assert (bearing.diameter, bearing.length) == (0.100, 0.030)
    assert bearing.radial_clearance == pytest.approx(1e-4, rel=1e-15)
    assert preset.machine.static_load == 525.0
    assert preset.machine.rotor.half_mass * g == pytest.approx(525.0, rel=1e-15)
    assert preset.speed == pytest.approx(1500 * math.pi / 30)
