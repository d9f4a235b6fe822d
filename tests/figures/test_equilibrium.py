"""Charts of the static equilibrium: valid for Plotly, and their point where the records say."""

import dataclasses
import math
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest

from rotorcalc import PRESETS, FloatingRing, Machine, TiltingPads, analyse, film_curves
from rotorcalc.coefficients import equilibrium, film_field, film_forces
from rotorcalc.figures import SI, US, Chart, Units, film, plane
from rotorcalc.figures import equilibrium as place
from tests.figures.charts import (
    check_case_is_behind,
    check_plotly_takes_it,
    curves_in_window,
    notes,
)

RPM = math.pi / 30
SIGMA = np.geomspace(1e-2, 1e2, 61)
THETA, ZETA = np.linspace(0.0, 2.0 * np.pi, 91), np.linspace(-0.5, 0.5, 11)


def _records(machine: Machine, speed: float, top: float) -> SimpleNamespace:
    """Return what the page hands to its charts."""
    point = analyse(machine, speed)
    return SimpleNamespace(
        point=point,
        sweep=analyse(machine, np.linspace(top / 60, top, 60)),
        curves=film_curves(machine.bearing, SIGMA),
        marks=equilibrium(machine, np.array([100.0, 200.0, 500.0, 1000.0]) * RPM),
        field=film_field(machine, speed, theta=THETA, zeta=ZETA),
        forces=film_forces(machine, speed, sommerfeld=point.sommerfeld),
        force_curves=film_forces(machine, speed, sommerfeld=SIGMA),
    )


CASES = {key: _records(p.machine, p.speed, p.top_speed) for key, p in PRESETS.items()}
_SHEET = PRESETS["sheet-1e8"]
CASES["no load"] = _records(
    dataclasses.replace(_SHEET.machine, load=0.0), _SHEET.speed, _SHEET.top_speed
)
CASES["next to no load"] = _records(
    dataclasses.replace(_SHEET.machine, load=0.1), _SHEET.speed, _SHEET.top_speed
)
CASES["near the wall"] = _records(
    dataclasses.replace(_SHEET.machine, load=2e4), 100 * RPM, _SHEET.top_speed
)
LOADED = [key for key in CASES if key != "no load"]

CHARTS: dict[str, Callable[[SimpleNamespace, Units], Chart]] = {
    "locus": lambda r, u: place.locus(place.Path(r.curves, r.sweep, r.marks, OUTLINE), r.point, u),
    "over speed": lambda r, u: place.position_over_speed(r.sweep, r.point, u),
    "over sommerfeld": lambda r, u: place.position_over_sommerfeld(r.curves, r.sweep, r.point, u),
    "power": lambda r, u: place.power_loss(r.sweep, r.point, u),
    "flow": lambda r, u: place.side_flow(r.sweep, r.point, u),
    "friction": lambda r, u: place.friction_coefficient(r.sweep, r.point, u),
    "torque": lambda r, u: place.drag_torque(r.sweep, r.point, u),
    "thinnest": lambda r, u: place.minimum_film_thickness(r.sweep, r.point, u),
    "film": lambda r, u: film.film_around(r.field, r.point, u),
    "pressure": lambda r, u: film.pressure_map(r.field, r.point, u),
    "forces": lambda r, u: film.forces(r.force_curves, r.forces, r.sweep, r.point, u),
    "balance": lambda r, u: film.force_balance(r.forces, r.sweep, r.point, u),
}
OUTLINE = plane.arc(0.0, 2.0 * math.pi, 1.0)
UNITS = [pytest.param(SI, id="SI"), pytest.param(US, id="US")]


def _mark(chart: Chart, name: str = "running speed", axis: str = "y") -> tuple[float, float]:
    """Return where a chart's point lies, in the units of its axes."""
    (trace,) = (
        trace
        for trace in chart["data"]
        if trace.get("name") == name
        and trace["mode"] == "markers"
        and trace.get("yaxis", "y") == axis
    )
    return float(trace["x"][0]), float(trace["y"][0])


def _texts(chart: Chart) -> str:
    return " ".join(note["text"] for note in chart["layout"].get("annotations", []))


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("name", CHARTS)
def test_plotly_takes_every_chart(name: str, case: str, units: Units) -> None:
    chart = CHARTS[name](CASES[case], units)
    check_plotly_takes_it(chart)
    assert curves_in_window(chart) or notes(chart)
    title = chart["layout"]["xaxis"]["title"]["text"]
    assert title
    words = _texts(chart) + title
    assert "nan" not in words.lower()
    assert "inf " not in words.lower()


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("name", CHARTS)
def test_ranges_are_fixed_and_hold_the_point(name: str, case: str, units: Units) -> None:
    chart = CHARTS[name](CASES[case], units)
    for axis in ("x", "y", "y2"):
        layout = chart["layout"].get(f"{axis[0]}axis{axis[1:]}")
        if layout is None:
            continue
        low, high = sorted(layout["range"])
        assert math.isfinite(low)
        assert low < high < math.inf
        for trace in chart["data"]:
            on = axis == "x" or trace.get("yaxis", "y") == axis
            if on and trace.get("mode") == "markers" and trace["name"] != "components":
                values = np.asarray(trace[axis[0]], dtype=float)
                values = values[np.isfinite(values)]
                shown = np.log10(values) if layout["type"] == "log" else values
                assert np.all((low - 1e-9 <= shown) & (shown <= high + 1e-9))


@pytest.mark.parametrize("case", CASES)
def test_locus_marks_the_journal_with_x_down(case: str) -> None:
    r = CASES[case]
    chart = CHARTS["locus"](r, SI)
    eps, phi = float(r.point.eccentricity_ratio), float(r.point.attitude_angle)
    assert _mark(chart) == pytest.approx((eps * math.sin(phi), eps * math.cos(phi)), abs=1e-12)
    low, high = chart["layout"]["yaxis"]["range"]
    assert low > high, "X points down"
    assert chart["layout"]["xaxis"]["scaleanchor"] == "y"
    path = next(trace for trace in chart["data"] if trace["name"] == "up to the top speed")
    assert np.hypot(path["x"], path["y"]) == pytest.approx(r.sweep.eccentricity_ratio, abs=1e-12)
    assert np.all(path["x"] >= 0.0), "the journal moves in the sense of rotation"


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("case", LOADED)
def test_position_is_the_records(case: str, units: Units) -> None:
    point = CASES[case].point
    eps, phi = float(point.eccentricity_ratio), math.degrees(float(point.attitude_angle))
    for name, across in (
        ("over speed", float(point.speed) / RPM),
        ("over sommerfeld", float(point.sommerfeld)),
    ):
        chart = CHARTS[name](CASES[case], units)
        assert _mark(chart) == pytest.approx((across, eps))
        assert _mark(chart, axis="y2") == pytest.approx((across, phi))


@pytest.mark.parametrize(
    ("name", "field", "kind"),
    [
        ("power", "power_loss", "power"),
        ("flow", "side_flow", "flow"),
        ("friction", "friction_coefficient", "number"),
        ("torque", "drag_torque", "torque"),
        ("thinnest", "minimum_film_thickness", "film"),
    ],
)
@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("case", CASES)
def test_costs_are_the_records(case: str, units: Units, name: str, field: str, kind: str) -> None:
    r, unit = CASES[case], getattr(units, kind)
    chart = CHARTS[name](r, units)
    expected = float(r.point.speed) / RPM, float(unit.of(getattr(r.point, field)))
    assert _mark(chart) == pytest.approx(expected)
    assert unit.name in chart["layout"]["yaxis"]["title"]["text"]
    line = next(trace for trace in chart["data"] if trace["name"] == field.replace("_", " "))
    np.testing.assert_allclose(line["y"], unit.of(getattr(r.sweep, field)))


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("case", LOADED)
def test_film_marks_its_thinnest_place_and_its_peak(case: str, units: Units) -> None:
    r = CASES[case]
    chart = CHARTS["film"](r, units)
    thinnest = float(units.film.of(r.point.minimum_film_thickness))
    peak = math.degrees(float(r.field.peak_theta)), float(units.pressure.of(r.point.peak_pressure))
    assert _mark(chart, "thinnest film") == pytest.approx((180.0, thinnest))
    assert _mark(chart, "highest pressure", "y2") == pytest.approx(peak)
    load = next(shape for shape in chart["layout"]["shapes"] if shape["type"] == "line")
    assert load["x0"] == pytest.approx(180.0 - math.degrees(float(r.point.attitude_angle)))
    (broken,) = (shape for shape in chart["layout"]["shapes"] if shape["type"] == "rect")
    assert (broken["x0"], broken["x1"]) == pytest.approx((180.0, 360.0))


@pytest.mark.parametrize("case", LOADED)
def test_pressure_map_leaves_the_cavitated_half_empty(case: str) -> None:
    r = CASES[case]
    chart = CHARTS["pressure"](r, SI)
    contour = chart["data"][0]
    empty = np.isnan(contour["z"])
    assert np.array_equal(empty.any(axis=0), contour["x"] > 180.0 + 1e-9)
    assert np.nanmax(contour["z"]) <= float(SI.pressure.of(r.point.peak_pressure)) * (1 + 1e-6)
    assert contour["zmax"] == chart["data"][0]["contours"]["end"]
    assert float(SI.pressure.of(r.point.peak_pressure)) <= contour["zmax"]
    assert _mark(chart, "highest pressure")[1] == 0.0


def test_a_journal_in_a_ring_meets_its_load_beyond_the_clearance() -> None:
    ring = FloatingRing.around(0.15, 0.05, 60e-6)
    bearing = dataclasses.replace(_SHEET.machine.bearing, geometry=ring)
    machine, speed = dataclasses.replace(_SHEET.machine, bearing=bearing), _SHEET.speed
    point, sweep = analyse(machine, speed), analyse(machine, np.array([0.5, 1.5]) * speed)
    at, curves = (
        film_forces(machine, speed, sommerfeld=sigma)
        for sigma in (point.sommerfeld, np.geomspace(0.03, 30.0, 21))
    )
    place = float(point.eccentricity_ratio)
    assert place > 1.0
    chart = film.forces(curves, at, sweep, point, SI)
    assert _mark(chart) == pytest.approx((place, float(SI.force.of(at.total))))
    assert chart["layout"]["xaxis"]["range"][1] >= np.max(curves.eccentricity_ratio) > place


def test_words_on_cavitated_film_stand_where_there_is_room_for_them() -> None:
    bearing = dataclasses.replace(_SHEET.machine.bearing, geometry=TiltingPads())
    pads, wide = dataclasses.replace(_SHEET.machine, bearing=bearing), CASES["sheet-1e8"]
    narrow = film_field(pads, _SHEET.speed, theta=np.linspace(0.0, math.tau, 181))
    assert narrow.cavitated.any()
    for field, machine, has_room in ((narrow, pads, False), (wide.field, _SHEET.machine, True)):
        chart = film.film_around(field, analyse(machine, _SHEET.speed), SI)
        assert ("cavitated:<br>ambient pressure" in notes(chart)) == has_room
        assert film.has_narrow_cavitation(field) != has_room


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("case", LOADED)
def test_forces_meet_the_load_at_the_point(case: str, units: Units) -> None:
    r = CASES[case]
    chart = CHARTS["forces"](r, units)
    load = float(units.force.of(r.point.machine.static_load))
    assert _mark(chart) == pytest.approx((float(r.point.eccentricity_ratio), load))
    parts = next(trace for trace in chart["data"] if trace["name"] == "components")
    assert math.hypot(*parts["y"]) == pytest.approx(load)
    total = next(trace for trace in chart["data"] if trace["name"] == "resultant <i>F</i>")
    if 0.01 < r.point.eccentricity_ratio < 0.88:
        on_curve = np.interp(parts["x"][0], total["x"][::-1], np.log(total["y"][::-1]))
        assert on_curve == pytest.approx(math.log(load), abs=0.02)


@pytest.mark.parametrize("case", LOADED)
def test_balance_is_a_right_angled_triangle_over_the_load(case: str) -> None:
    r = CASES[case]
    x, y = _mark(CHARTS["balance"](r, SI))
    assert math.hypot(x, y - 0.5) == pytest.approx(0.5)
    assert math.atan2(x, y) == pytest.approx(float(r.point.attitude_angle))


@pytest.mark.parametrize("case", LOADED)
def test_the_corner_of_the_balance_at_another_speed_is_that_of_its_forces(case: str) -> None:
    r = CASES[case]
    chart = CHARTS["balance"](r, SI)
    along = chart["layout"]["meta"]["cursor"]["along"]
    (line,) = (trace for trace in chart["data"] if trace["name"] == along)
    other = _at(r, speed=float(r.sweep.speed[20]))
    assert line["customdata"][20] == pytest.approx(other.point.speed / RPM)
    corner = line["x"][20], line["y"][20]
    assert corner == pytest.approx(_mark(CHARTS["balance"](other, SI)), abs=1e-9)


def _at(r: SimpleNamespace, speed: float) -> SimpleNamespace:
    point = analyse(r.point.machine, speed)
    forces = film_forces(r.point.machine, speed, sommerfeld=point.sommerfeld)
    return SimpleNamespace(point=point, forces=forces, sweep=r.sweep)


@pytest.mark.parametrize(
    "name", ["locus", "over sommerfeld", "film", "pressure", "forces", "balance"]
)
def test_the_chart_says_that_there_is_no_load(name: str) -> None:
    assert "no load" in _texts(CHARTS[name](CASES["no load"], SI))


@pytest.mark.parametrize("name", CHARTS)
def test_another_machine_stands_behind(name: str) -> None:
    live, pinned = CHARTS[name](CASES["sheet-1e8"], SI), CHARTS[name](CASES["fig-5-2"], SI)
    check_case_is_behind(live, pinned)


def test_without_load_the_point_stands_at_the_far_end_of_sigma() -> None:
    chart = CHARTS["over sommerfeld"](CASES["no load"], SI)
    far = 10.0 ** chart["layout"]["xaxis"]["range"][1]
    assert _mark(chart) == pytest.approx((far, 0.0))
    assert _mark(chart, axis="y2") == pytest.approx((far, 90.0))
