"""Charts of recesses over speed: a line each, below the supply; powers that add up."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import Hydrostatic, analyse, recess_equilibrium
from rotorcalc.coefficients import film_field
from rotorcalc.figures import SI, US, film, recesses
from rotorcalc.machine import Machine
from tests.figures.charts import check_case_is_behind, check_plotly_takes_it, curves_in_window
from tests.machines import SHEET

SPEEDS = np.linspace(20.0, 1200.0, 30)
THETA, ZETA = np.linspace(0.0, 2.0 * np.pi, 91), np.linspace(-0.5, 0.5, 11)


def on(load: float = 1334.0, **shape) -> Machine:
    bearing = replace(SHEET.bearing, geometry=Hydrostatic(**shape))
    return replace(SHEET, load=load, bearing=bearing)


def charts(machine: Machine, units=SI):
    over, here = recess_equilibrium(machine, SPEEDS), recess_equilibrium(machine, 600.0)
    p_s = machine.bearing.geometry.supply_pressure
    return recesses.pressures(over, here, p_s, units), recesses.powers(over, here, units)


@pytest.mark.parametrize("units", [SI, US])
def test_each_recess_has_a_line_and_a_mark_below_the_supply(units):
    machine = on(recesses=6, supply_pressure=3e6)
    pressures, _ = charts(machine, units)
    check_plotly_takes_it(pressures)
    assert curves_in_window(pressures)
    supply, *lines, marks = pressures["data"]
    assert [line["name"] for line in lines] == [
        "1, 0°", "2, 60°", "3, 120°", "4, 180°", "5, 240°", "6, 300°",
    ]  # fmt: skip
    looks = {(line["line"]["color"], line["line"]["dash"]) for line in lines}
    assert len(looks) == len(lines)
    found = units.pressure.of(recess_equilibrium(machine, 600.0).pressure)
    assert marks["y"] == pytest.approx(found)
    assert np.all(supply["y"] > np.max(marks["y"]))


def test_the_powers_of_pump_and_friction_add_up():
    _, powers = charts(on())
    check_plotly_takes_it(powers)
    pump, friction, together, _ = powers["data"]
    assert together["y"] == pytest.approx(pump["y"] + friction["y"])
    loss = SI.power.of(analyse(on(), SPEEDS).power_loss)
    assert friction["y"] == pytest.approx(loss)


def test_another_number_of_recesses_stands_behind():
    for chart, other in zip(charts(on()), charts(on(recesses=3, load=2000.0)), strict=True):
        check_case_is_behind(chart, other)


def test_a_film_under_suction_is_drawn_below_zero_and_not_as_cavitated():
    heavy = on(4000.0, supply_pressure=2.5e6, pressure_ratio=0.2)
    speed = 1200.0
    lowest = float(SI.pressure.of(recess_equilibrium(heavy, speed).lowest_pressure))
    assert lowest < 0.0
    point = analyse(heavy, speed)
    around = film.film_around(film_field(heavy, speed, theta=THETA), point, SI)
    unwrapped = film.pressure_map(film_field(heavy, speed, theta=THETA, zeta=ZETA), point, SI)
    assert around["layout"]["yaxis2"]["range"][0] <= lowest
    assert unwrapped["data"][0]["zmin"] <= np.nanmin(unwrapped["data"][0]["z"])
    for chart in (around, unwrapped):
        assert not [one for one in chart["layout"]["annotations"] if "cavitated" in one["text"]]


def test_without_load_the_recesses_keep_their_pressure():
    free = on(0.0)
    around = film.film_around(film_field(free, 600.0, theta=THETA), analyse(free, 600.0), SI)
    assert not [one for one in around["layout"]["annotations"] if "no pressure" in one["text"]]
    assert np.max(around["data"][1]["y"]) == pytest.approx(1.0)
