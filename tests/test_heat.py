"""The film's temperature: heat made is heat carried, in every bore, and what follows from it."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq

import rotorcalc as rc
from rotorcalc import design, heat, oils
from rotorcalc.films import OperatingPoints, film_of
from rotorcalc.geometry import MultiDam, OffsetHalves
from rotorcalc.nonlinear.collocation import Balance, Cycle
from rotorcalc.nonlinear.equations import Equations
from rotorcalc.onset.closed_form import covers
from rotorcalc.onset.many import onset_speeds
from rotorcalc.onset.search import searched_onset
from rotorcalc.validity import HEAT

RING = rc.FloatingRing.around(0.150, 0.050, 60e-6)
BORES = [
    (rc.Plain(), "short"), (rc.Plain(), "finite"), (rc.PartialArc(), "finite"),
    (rc.PartialArc(), "short"), (rc.AxialGrooves(), "finite"), (rc.AxialGrooves(), "short"),
    (rc.Elliptical(), "finite"), (rc.Elliptical(), "short"), (OffsetHalves(), "finite"),
    (OffsetHalves(), "short"), (rc.Lobes(), "finite"), (rc.Lobes(), "short"),
    (rc.PressureDam(), "finite"), (MultiDam(), "finite"), (RING, "short"), (RING, "finite"),
]  # fmt: skip
NAMES = [f"{geometry.kind} {film}" for geometry, film in BORES]
SHEET = rc.PRESETS["sheet-1e8"].machine
SPEEDS = np.linspace(100.0, 900.0, 9)


def supplied(machine=SHEET, *, temperature=40.0, flow=0.0, heat_share=1.0):
    supply = rc.Supply(temperature=temperature, flow=flow, heat_share=heat_share)
    return dataclasses.replace(machine, temperature=None, supply=supply)


def on(geometry, film, machine=SHEET):
    bearing = dataclasses.replace(machine.bearing, geometry=geometry, film=film)
    return dataclasses.replace(machine, bearing=bearing)


def settled_at(machine, temperature):
    return dataclasses.replace(machine, temperature=temperature, supply=None)


@pytest.mark.parametrize(("geometry", "film"), BORES, ids=NAMES)
@pytest.mark.parametrize(("flow", "share"), [(0.0, 1.0), (5e-5, 0.9)])
def test_the_oil_carries_what_the_film_makes(geometry, film, flow, share):
    machine = supplied(on(geometry, film), flow=flow, heat_share=share)
    sweep = rc.analyse(machine, SPEEDS)
    heat_of = machine.oil.density * machine.oil.heat_capacity
    rise = sweep.outlet_temperature - 40.0
    carried = heat_of * (sweep.side_flow + flow) * rise
    assert carried == pytest.approx(share * sweep.power_loss, rel=1e-9)
    # The film lies half-way, and its viscosity is the oil's there.
    assert 2.0 * (sweep.temperature - 40.0) == pytest.approx(rise, rel=1e-9)
    assert np.array_equal(sweep.viscosity, machine.oil.viscosity(sweep.temperature))
    same = rc.analyse(settled_at(machine, float(sweep.temperature[4])), SPEEDS[4])
    # To rounding, as of many speeds at once or of one.
    assert same.power_loss == pytest.approx(sweep.power_loss[4], rel=1e-13)
    np.testing.assert_allclose(same.stiffness, sweep.stiffness[4], rtol=1e-13)


@pytest.mark.parametrize("name", rc.PRESETS)
def test_every_preset_has_a_balance(name):
    machine = supplied(rc.PRESETS[name].machine, flow=1e-4)
    balance = rc.heat_balance(machine, 200.0)
    assert balance.carried == pytest.approx(balance.power_loss, rel=1e-9)
    assert np.isfinite(rc.onset_speed(machine).speed)


@pytest.mark.parametrize(("geometry", "film"), BORES, ids=NAMES)
def test_loss_and_loss_over_flow_fall_as_the_film_warms(geometry, film):
    """σ·drag and σ·drag/flow rise with σ: there is never more than one balance."""
    model = film_of(on(geometry, film).bearing)
    low, high = max(model.least_sommerfeld, 1e-6), 1e4 * model.sommerfeld_range[1]
    sigma = np.geomspace(1.0001 * low, high, 3000)
    drag, flow = model.drag_and_flow(OperatingPoints.at_sommerfeld(model.bearing, sigma))
    assert np.all(np.diff(sigma * drag) > 0.0)
    assert np.all(np.diff(sigma * drag / flow) > 0.0)


@pytest.mark.parametrize(("geometry", "film"), BORES[::3], ids=NAMES[::3])
def test_the_balance_is_the_root_that_a_search_over_given_temperatures_finds(geometry, film):
    machine = supplied(on(geometry, film), flow=1e-5)

    def excess(T):
        point = rc.analyse(settled_at(machine, T), 500.0)
        return T - 40.0 - point.power_loss / (2 * 860.0 * 2000.0 * (point.side_flow + 1e-5))

    root = brentq(excess, 40.0, 200.0, xtol=1e-12, rtol=1e-14)
    assert heat.film_temperature(machine, 500.0) == pytest.approx(root, rel=1e-11)


def test_without_a_slope_of_viscosity_heat_changes_nothing():
    oil = dataclasses.replace(SHEET.oil, temperature_coefficient=0.0)
    given = dataclasses.replace(SHEET, oil=oil)
    machine = supplied(given, flow=1e-4)
    assert rc.onset_speed(machine).speed == pytest.approx(rc.onset_speed(given).speed, rel=1e-12)
    assert np.array_equal(rc.analyse(machine, SPEEDS).damping, rc.analyse(given, SPEEDS).damping)


def test_all_heat_lost_elsewhere_or_a_flood_of_oil_leave_the_film_at_the_supply():
    assert np.all(heat.film_temperature(supplied(heat_share=0.0), SPEEDS) == 40.0)
    assert heat.film_temperature(supplied(flow=1e3), SPEEDS) == pytest.approx(40.0, abs=1e-4)
    cold = rc.onset_speed(settled_at(SHEET, 40.0)).speed
    assert rc.onset_speed(supplied(heat_share=0.0)).speed == pytest.approx(cold, rel=1e-12)


def test_an_exercise_on_a_rotor_of_460_kg_in_both_conventions():
    """Bearings 101.6 × 50.8 mm, C 0.102 mm, oil of 80 mPa·s at 40 °C and 7 at 100 °C, in at 30."""
    oil = dataclasses.replace(
        oils.fitted_oil(temperatures=(40.0, 100.0), viscosities=(0.08, 0.007)), heat_capacity=1950.0
    )
    bearing = rc.JournalBearing(diameter=0.1016, length=0.0508, radial_clearance=0.102e-3)
    machine = rc.Machine(
        oil=oil, bearing=bearing, rotor=rc.Rotor(mass=460.0), supply=rc.Supply(temperature=30.0)
    )
    speed = 2.0 * np.pi * np.array([20.0, 60.0, 100.0])
    mean = heat.film_temperature(machine, speed)
    assert mean == pytest.approx([42.60, 57.57, 66.24], abs=0.005)

    def excess(T, omega):  # all heat leaves at the film's temperature
        point = rc.analyse(settled_at(machine, T), omega)
        return T - 30.0 - point.power_loss / (860.0 * 1950.0 * point.side_flow)

    out = [brentq(excess, 30.0, 150.0, args=(omega,)) for omega in speed]
    assert out == pytest.approx([48.17, 64.59, 73.62], abs=0.005)


def test_a_textbook_example_by_raimondi_and_boyds_charts():
    """Budynas and Nisbett, Shigley's Mechanical Engineering Design, section 12-7 and Eq. 12-15.

    μ = 4 µreyn, 30 rev/s, 500 lbf on 1.5 × 1.5 in, c = 0.0015 in. From the charts S = 0.135,
    fr/c = 3.50, Q/(rcNl) = 4.28, Q_s/Q = 0.655; ΔT = 0.103 P (fr/c)/((1 − Q_s/2Q) Q/(rcNl)) in °F,
    where the side flow leaves at the mean temperature: a flow Q − 3Q_s/2 besides it in our balance.
    The equation has ρ = 0.0311 lbm/in³ and c = 0.42 Btu/(lbm·°F). Raimondi and Boyd let the film
    begin where it is thickest, opposite to the line of centres at 53°: here a groove is there.
    """
    inch, pound = 0.0254, 4.4482216
    mu = 4e-6 * 6894.757
    oil = rc.Oil(
        reference_viscosity=mu, reference_temperature=50.0, temperature_coefficient=0.0,
        density=0.0311 * 0.45359237 / inch**3, heat_capacity=0.42 * 4186.8,
    )  # fmt: skip
    bearing = rc.JournalBearing(
        diameter=1.5 * inch, length=1.5 * inch, radial_clearance=0.0015 * inch,
        geometry=rc.AxialGrooves(number=1, width=math.radians(1.0), first=math.radians(233.0)),
    )  # fmt: skip
    whole = 4.28 * 0.75 * 0.0015 * 30.0 * 1.5 * inch**3
    machine = rc.Machine(
        oil=oil, bearing=bearing, rotor=rc.Rotor(mass=10.0), load=500.0 * pound,
        supply=rc.Supply(temperature=40.0, flow=whole * (1.0 - 1.5 * 0.655)),
    )  # fmt: skip
    sweep = rc.analyse(machine, 30.0 * 2.0 * np.pi)
    rise = 0.103 * 222.0 * 3.50 / ((1.0 - 0.5 * 0.655) * 4.28) / 1.8
    assert rise == pytest.approx(15.5, abs=0.1)
    # Charts are read to two digits.
    assert float(sweep.outlet_temperature) - 40.0 == pytest.approx(rise, rel=0.03)
    assert float(sweep.side_flow) == pytest.approx(0.655 * whole, rel=0.03)


def test_the_curves_of_heat_cross_at_the_balance():
    machine = supplied(flow=1e-5)
    T = float(heat.film_temperature(machine, 600.0))
    at = heat.heat_curves(machine, 600.0, [T - 1.0, T, T + 1.0])
    assert at.made[1] == pytest.approx(at.carried[1], rel=1e-9)
    assert at.made[0] > at.carried[0]
    assert at.made[2] < at.carried[2]


@pytest.mark.parametrize("machine", [SHEET, supplied(temperature=60.0)])
def test_the_flow_for_a_rise_gives_that_rise(machine):
    flow = float(heat.flow_for_rise(machine, 600.0, rise=20.0))
    balanced = supplied(temperature=60.0 if machine.supply else 50.0, flow=flow)
    sweep = rc.analyse(balanced, 600.0)
    assert float(sweep.outlet_temperature - balanced.supply.temperature) == pytest.approx(20.0)


@pytest.mark.parametrize(
    ("machine", "words"),
    [
        (dataclasses.replace(supplied(), load=0.0), "no oil leaves"),
        (
            supplied(dataclasses.replace(on(rc.Plain(), "finite"), load=3e6), temperature=60.0),
            "carry the load",
        ),
        (supplied(dataclasses.replace(SHEET, load=1e-6)), "hotter than 370"),
    ],
)
def test_where_there_is_no_balance_it_is_said_in_words(machine, words):
    with pytest.raises(ValueError, match=words):
        rc.analyse(machine, 1500.0)
    assert not heat.has_film(machine, 1500.0)


@pytest.mark.parametrize("values", [{}, {"temperature": 60.0, "supply": rc.Supply(temperature=40)}])
def test_a_machine_has_a_temperature_or_a_supply(values):
    with pytest.raises(ValueError, match="temperature"):
        rc.Machine(oil=SHEET.oil, bearing=SHEET.bearing, rotor=SHEET.rotor, **values)


@pytest.mark.parametrize(
    ("field", "value"),
    [("flow", -1e-9), ("heat_share", 1.1), ("heat_share", -0.1), ("temperature", 371.0),
     ("temperature", -71.0), ("temperature", math.nan), ("flow", "1")],
)  # fmt: skip
def test_a_supply_names_what_is_wrong(field, value):
    with pytest.raises(ValueError, match=f"^{field} = "):
        rc.Supply(**{"temperature": 40.0, field: value})


def test_a_supply_is_kept_in_json():
    machine = supplied(flow=1e-4, heat_share=0.8)
    assert rc.Machine.from_json(machine.to_json()) == machine
    assert '"temperature": null' not in machine.to_json()


@pytest.mark.parametrize("flow", [0.0, 1e-6, 1e-5, 1e-3])
@pytest.mark.parametrize("inlet", [10.0, 60.0])
def test_the_onset_is_where_the_machine_of_that_temperature_turns_unstable(inlet, flow):
    machine = supplied(temperature=inlet, flow=flow)
    onset = rc.onset_speed(machine)
    assert onset.method == "closed form"
    assert onset.speed == pytest.approx(searched_onset(machine).speed, rel=1e-12)
    for factor, grows in ((1.0 - 1e-7, False), (1.0 + 1e-7, True)):
        T = heat.film_temperature(machine, factor * onset.speed)
        sweep = rc.analyse(settled_at(machine, float(T)), factor * onset.speed)
        assert (sweep.flexible_eigenvalues.real.max() > 0.0) == grows
    # Below it the machine is stable throughout.
    below = rc.analyse(machine, np.linspace(0.02, 0.999, 60) * onset.speed)
    assert np.all(below.flexible_eigenvalues.real < 0.0)


@pytest.mark.parametrize(("geometry", "film"), [BORES[i] for i in (1, 6, 11, 12)])
def test_the_onset_in_other_bores_is_at_the_temperature_of_its_speed(geometry, film):
    machine = supplied(on(geometry, film), flow=1e-5)
    onset = rc.onset_speed(machine).speed
    there = rc.onset_speed(heat.settled(machine, onset))
    assert onset == pytest.approx(there.speed, rel=1e-9)


def test_midspan_damping_and_journal_mass_have_their_onset_too():
    rotor = dataclasses.replace(SHEET.rotor, disk_damping=2e3, journal_mass=5.0)
    machine = supplied(dataclasses.replace(SHEET, rotor=rotor))
    onset = rc.onset_speed(machine)
    assert onset.speed == pytest.approx(
        rc.onset_speed(heat.settled(machine, onset.speed)).speed, rel=1e-9
    )
    [[first, _]] = rc.unstable_ranges(machine, np.linspace(0.5, 1.3, 20) * onset.speed)
    assert first == pytest.approx(onset.speed, rel=1e-9)


def test_many_machines_have_the_onsets_of_each_alone():
    oil = dataclasses.replace(SHEET.oil, temperature_coefficient=0.05)
    machines = [
        supplied(dataclasses.replace(SHEET, oil=one), temperature=T, flow=flow)
        for one in (SHEET.oil, oil) for T in (20.0, 70.0) for flow in (0.0, 1e-5, 1e-3)
    ]  # fmt: skip
    assert all(map(covers, machines))
    alone = [rc.onset_speed(one).speed for one in machines]
    assert onset_speeds(machines) == pytest.approx(alone, rel=1e-12)


@pytest.mark.parametrize("film", ["short", "finite"])
def test_an_onset_beyond_the_oils_range_is_not_claimed(film):
    # So heavy a load on so light a rotor whirls at speeds at which the oil would burn.
    machine = supplied(on(rc.Plain(), film, dataclasses.replace(SHEET, load=1e6)))
    machine = dataclasses.replace(machine, rotor=rc.Rotor(mass=0.01))
    onset = rc.onset_speed(machine)
    assert math.isinf(onset.speed)
    assert heat.has_film(machine, 0.999 * onset.searched_to)
    assert not heat.has_film(machine, 1.001 * onset.searched_to)


@pytest.mark.parametrize("field", ["supply.temperature", "supply.flow"])
def test_a_supply_for_an_onset_is_found(field):
    machine = supplied(flow=1e-5)
    low, high = (5.0, 90.0) if field == "supply.temperature" else (1e-7, 1e-2)
    middle = rc.varied(machine, {field: 0.5 * (low + high)})
    target = rc.onset_speed(middle).speed
    found = rc.solve_onset(machine, vary=field, target=target, low=low, high=high)
    onsets = [rc.onset_speed(rc.varied(machine, {field: value})).speed for value in found.solutions]
    assert len(onsets) >= 1
    assert onsets == pytest.approx([target] * len(onsets), rel=1e-9)


def test_sensitivities_vary_the_supply_in_place_of_the_film():
    machine = supplied(flow=1e-5)
    names = {one.field for one in rc.sensitivities(machine).inputs}
    assert {"supply.temperature", "supply.flow", "oil.heat_capacity"} <= names
    assert "temperature" not in design.inputs_of(machine)
    with pytest.raises(ValueError, match=r"supply\.temperature"):
        rc.varied(machine, {"temperature": 50.0})


def test_bearings_are_compared_each_at_its_own_temperature():
    machine = supplied(flow=1e-4)
    found = rc.compare_bearings(machine, [rc.Plain(), rc.Elliptical()], speed=600.0)
    assert found[0].temperature != found[1].temperature
    for one in found:
        own = dataclasses.replace(machine, bearing=one.bearing)
        assert one.temperature == pytest.approx(float(heat.film_temperature(own, 600.0)))


def test_the_line_of_heat():
    def line(machine, speed):
        [found] = [one for one in rc.validity(rc.analyse(machine, speed)) if one.name == HEAT]
        return found

    point = rc.analyse(SHEET, 628.3)
    given = line(SHEET, 628.3)
    assert given.value == pytest.approx(float(point.power_loss / (1.72e6 * point.side_flow)))
    assert given.caution == pytest.approx(math.log(2.0) / 0.03)
    assert given.worst == "caution"
    warm = line(supplied(), 628.3)
    assert warm.value == pytest.approx(2.0 * float(heat.film_temperature(supplied(), 628.3)) - 80.0)
    assert warm.worst == "outside"  # 100 K: the viscosity falls twentyfold
    assert line(supplied(flow=1e-3), 300.0).worst == "good"


def test_a_run_up_has_the_viscosity_of_each_speed():
    machine = supplied()
    thinning = Equations(machine, 200.0, 900.0, turned=100.0).thinning
    speed = np.array([200.0, 333.0, 640.0, 900.0])
    ratio = [thinning(one / 200.0) for one in speed]
    mu = np.asarray(heat.viscosity(machine, speed))
    assert ratio == pytest.approx(mu / mu[0], rel=1e-7)


def test_a_cycles_balance_knows_how_the_oil_thins_with_speed():
    machine = supplied()
    balance, m = Balance(machine), 9
    phase = 2.0 * np.pi * np.arange(m) / m
    path = 0.2 * np.column_stack([1.0 + np.cos(phase), np.sin(phase)])
    cycle = Cycle(path, 0.49, 800.0)
    _, slopes = balance.residual(cycle)
    up, down = (
        balance.residual(cycle._replace(speed=800.0 * math.exp(h)))[0] for h in (1e-5, -1e-5)
    )
    assert slopes[:, -1] == pytest.approx((up - down) / 2e-5, rel=1e-5, abs=1e-9)


def test_whirl_and_orbits_run_at_the_temperature_of_their_speed():
    machine = supplied()
    onset = rc.onset_speed(machine)
    assert rc.hopf(machine).speed == onset.speed
    # Warming takes some of the growth: at given temperature it rises faster with speed.
    there = rc.hopf(heat.settled(machine, onset.speed))
    assert rc.hopf(machine).lyapunov == pytest.approx(there.lyapunov, rel=1e-9)
    assert rc.hopf(machine).growth_slope != pytest.approx(there.growth_slope, rel=1e-3)
    one, other = (
        rc.simulate(each, 500.0, revolutions=3) for each in (machine, heat.settled(machine, 500.0))
    )
    assert np.array_equal(one.journal, other.journal)
