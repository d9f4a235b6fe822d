"""Charts of the imbalance response, and the functions of the core that prepare them."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from rotorcalc import PRESETS, Machine, Rotor, analyse, onset_speed
from rotorcalc.figures import SI, US, Units, response
from rotorcalc.unbalance_curves import (
    ResponseCurves,
    clearance_orbit,
    damping_variants,
    journal_mass_variants,
    orbits,
    response_curves,
    response_family,
    unstable_ranges,
)
from rotorcalc.unbalance_peaks import response_peaks
from rotorcalc.unbalance_response import orbit_ellipse, orbit_points
from rotorcalc.variation import damping_reference
from tests.figures.charts import (
    beside,
    check_case_is_behind,
    check_plotly_takes_it,
    curves_in_window,
)
from tests.films.models import BEARINGS
from tests.machines import machines

SHEET = PRESETS["sheet-1e8"].machine
SPEED = 600.0
SPEEDS = np.linspace(5.0, 1250.0, 240)


def _with_rotor(**changes: Any) -> Machine:
    return replace(SHEET, rotor=replace(SHEET.rotor, **changes))


MACHINES: dict[str, Machine] = {key: preset.machine for key, preset in PRESETS.items()} | {
    "no load": replace(SHEET, load=0.0),
    "balanced": _with_rotor(imbalance=0.0),
    "rigid": _with_rotor(shaft_stiffness=np.inf),
    "damped": _with_rotor(disk_damping=5e4, journal_mass=20.0),
    "shaken": _with_rotor(imbalance=1e-3),
}


def _curves(machine: Machine) -> ResponseCurves:
    peaks = {at: response_peaks(machine, SPEEDS, at=at) for at in ("disk", "journal")}
    sweep, point = analyse(machine, SPEEDS), analyse(machine, SPEED)
    return response_curves(sweep, point, disk_peaks=peaks["disk"], journal_peaks=peaks["journal"])


def _charts(machine: Machine, units: Units) -> Iterator[dict[str, Any]]:
    sweep, point, curves = analyse(machine, SPEEDS), analyse(machine, SPEED), _curves(machine)
    yield response.amplitude(curves, "axes", units)
    yield response.amplitude(curves, "XY", units)
    yield response.phase(curves, units)
    yield response.in_clearance(clearance_orbit(point), sweep.journal_position, units)
    yield response.at_running_speed(orbits(point), units)
    yield response.scrubber(orbits(sweep), orbits(point), units)
    for varied, variants in (("damping", damping_variants), ("mass", journal_mass_variants)):
        family = response_family(machine, SPEEDS, rotors=variants(machine))
        yield response.family(family, "disk", varied, curves, units)
        yield response.family(family, "journal", varied, curves, units)


@pytest.mark.parametrize("units", [SI, US], ids=lambda units: units.name)
@pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES.keys())
def test_every_chart_is_a_plotly_figure(machine: Machine, units: Units) -> None:
    for chart in _charts(machine, units):
        check_plotly_takes_it(chart)
        assert curves_in_window(chart)
        for axis in (chart["layout"]["xaxis"], chart["layout"]["yaxis"]):
            assert np.all(np.isfinite(axis["range"]))
            assert axis["range"][0] != axis["range"][1]


def test_a_case_stands_behind_every_chart() -> None:
    pinned_charts = _charts(MACHINES["damped"], SI)
    for chart, pinned in zip(_charts(SHEET, SI), pinned_charts, strict=True):
        check_case_is_behind(chart, pinned)


def test_the_scrubber_starts_at_the_running_speed_and_moves_the_right_traces() -> None:
    chart = response.scrubber(orbits(analyse(SHEET, SPEEDS)), orbits(analyse(SHEET, SPEED)), SI)
    (slider,) = chart["layout"]["sliders"]
    names = [frame["name"] for frame in chart["frames"]]
    assert [step["args"][0] for step in slider["steps"]] == [[name] for name in names]
    labels = [step["label"] for step in slider["steps"]]
    assert len(set(labels)) == len(labels)
    assert labels[slider["active"]] == f"{float(SI.speed.of(SPEED)):.0f}"
    start = chart["frames"][slider["active"]]
    for place, moved in zip(start["traces"], start["data"], strict=True):
        assert_allclose(chart["data"][place]["x"], moved["x"], rtol=1e-6)
        assert_allclose(chart["data"][place]["y"], moved["y"], rtol=1e-6, atol=1e-6)
    other = response.scrubber(
        orbits(analyse(MACHINES["damped"], SPEEDS)), orbits(analyse(MACHINES["damped"], SPEED)), SI
    )
    both = beside(chart, other)
    place = both["frames"][slider["active"]]["traces"][0]
    assert_allclose(both["data"][place]["x"], start["data"][0]["x"], rtol=1e-6)


def test_x_points_down_and_arrowheads_follow_the_orbit() -> None:
    """A forward circle of one: down at the start, then right, as seen with Y to the right."""
    sweep = analyse(SHEET, SPEED)
    circle = orbit_points(1e-6, -1e-6j)
    seen = replace(orbits(sweep), disk=circle, journal=circle)
    chart = response.at_running_speed(seen, SI)
    low, high = chart["layout"]["yaxis"]["range"]
    assert low > high
    path, start, arrows, *_ = chart["data"]
    assert_allclose([start["x"][0], start["y"][0]], [0.0, 1.0], atol=1e-12)
    assert path["x"][1] > 0.0
    # An eighth of a turn on it is at lower right and heads to upper right; then the opposite.
    assert_allclose(arrows["marker"]["angle"], [45.0, -135.0], atol=3.0)


def test_orbit_points_lie_on_the_ellipse_of_their_phasors() -> None:
    x, y = 2.0 + 1.0j, 0.5 - 3.0j
    points = orbit_points(x, y, points=721)
    radius = np.hypot(points[:, 0], points[:, 1])
    ellipse = orbit_ellipse(x, y)
    assert_allclose(radius.max(), ellipse.semi_major, rtol=1e-4)
    assert_allclose(radius.min(), abs(ellipse.semi_minor), rtol=1e-4)
    assert_allclose(points[0], points[-1], atol=1e-12)
    assert_allclose(points[0], [x.real, y.real])
    area = np.sum(points[:-1, 0] * points[1:, 1] - points[1:, 0] * points[:-1, 1]) / 2.0
    assert_allclose(area, np.pi * ellipse.semi_major * ellipse.semi_minor, rtol=1e-4)


@pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES.keys())
def test_the_unstable_range_begins_at_the_onset(machine: Machine) -> None:
    ranges = unstable_ranges(analyse(machine, SPEEDS))
    onset = onset_speed(machine).speed
    if onset >= SPEEDS[-1]:
        assert len(ranges) == 0
        return
    assert_allclose(ranges[0, 0], max(onset, SPEEDS[0]), rtol=1e-4)
    assert ranges[-1, 1] == SPEEDS[-1]


@given(machines(), st.floats(100.0, 5000.0))
def test_unstable_ranges_are_the_speeds_above_the_onset(machine: Machine, top: float) -> None:
    sweep = analyse(machine, np.linspace(top / 50, top, 50))
    onset = onset_speed(machine).speed
    inside = np.zeros(50, dtype=bool)
    for first, last in unstable_ranges(sweep):
        inside |= (first <= sweep.speed) & (sweep.speed <= last)
    clear = np.abs(sweep.speed - onset) > 1e-6 * onset
    assert np.array_equal(inside[clear], (sweep.speed > onset)[clear])


@pytest.mark.parametrize("at", ["disk", "journal"])
@pytest.mark.parametrize("key", ["sheet-1e8", "sheet-1e7", "damped"])
def test_peaks_are_where_the_orbit_is_largest(key: str, at: str) -> None:
    machine = MACHINES[key]
    peaks = response_peaks(machine, SPEEDS, at=at)
    spacing = SPEEDS[1] - SPEEDS[0]
    assert len(peaks.speed)
    for speed, amplitude in zip(peaks.speed, peaks.amplitude, strict=True):
        h = 1e-3 * spacing
        near = analyse(machine, speed + h * np.array([-1.0, 0.0, 1.0]))
        body = near.disk_response if at == "disk" else near.journal_response
        size = orbit_ellipse(body[:, 0], body[:, 1]).semi_major
        assert_allclose(size[1], amplitude, rtol=1e-12)
        assert size[1] == size.max()
        slope, bend = (size[2] - size[0]) / (2 * h), (size[0] - 2 * size[1] + size[2]) / h**2
        assert abs(slope / bend) < 1e-4 * spacing


@pytest.mark.parametrize("C", [10e-6, 60e-6])
def test_curves_reach_their_peaks_however_narrow(C: float) -> None:
    machine = replace(SHEET, bearing=replace(SHEET.bearing, radial_clearance=C))
    curves = _curves(machine)
    assert len(curves.disk_peaks.speed)
    assert_allclose(curves.disk.ellipse.semi_major.max(), curves.disk_peaks.amplitude.max())
    family = response_family(machine, SPEEDS, rotors=[machine.rotor])
    assert_allclose(family.disk.max(), curves.disk_peaks.amplitude.max())
    size = curves.disk.ellipse.semi_major
    assert np.count_nonzero(size > size.max() / 2.0) >= 5
    assert set(SPEEDS) <= set(family.speed)


def test_a_peak_at_the_axis_has_a_mark_but_no_label() -> None:
    curves = _curves(SHEET)
    small = replace(
        curves.journal_peaks,
        speed=np.array([60.0]), amplitude=np.array([1e-3 * curves.disk_peaks.amplitude.max()]),
    )  # fmt: skip
    for peaks, labels in ((small, 1), (curves.journal_peaks, 2)):
        chart = response.amplitude(replace(curves, journal_peaks=peaks), "axes", SI)
        assert (
            len([one for one in chart["layout"]["annotations"] if "0-p" in one["text"]]) == labels
        )
        assert any(trace["name"] == "peak of the journal" for trace in chart["data"])


def test_labels_of_peaks_close_to_each_other_do_not_overlap() -> None:
    curves = _curves(SHEET)
    sizes = curves.disk_peaks.amplitude.max() * np.array([0.5, 0.48])
    for shares, below in (([0.5, 0.6], 1), ([0.1, 0.6], 0)):
        speeds = SPEEDS[-1] * np.array(shares)
        close = replace(curves.journal_peaks, speed=speeds, amplitude=sizes)
        chart = response.amplitude(replace(curves, journal_peaks=close), "axes", SI)
        labels = chart["layout"]["annotations"]
        assert sum(one["yanchor"] == "top" and "0-p" in one["text"] for one in labels) == below


def test_peaks_do_not_depend_on_how_dense_the_sweep_is() -> None:
    dense = response_peaks(SHEET, np.linspace(5.0, 1250.0, 1000))
    coarse = response_peaks(SHEET, np.linspace(5.0, 1250.0, 60))
    assert_allclose(coarse.speed, dense.speed, rtol=1e-6)


def test_the_lag_at_the_running_speed_lies_on_its_curve() -> None:
    for machine in MACHINES.values():
        curves = _curves(machine)
        for body, here in ((curves.disk, curves.disk_here), (curves.journal, curves.journal_here)):
            at = [np.interp(SPEED, curves.speed, body.lag[:, i]) for i in range(2)]
            assert_allclose(here.lag, at, atol=0.05)


def test_the_journals_path_surrounds_its_equilibrium_and_gives_its_reach() -> None:
    orbit = clearance_orbit(analyse(SHEET, SPEED))
    assert_allclose(orbit.path[:-1].mean(axis=0), orbit.centre, rtol=1e-9)
    assert_allclose(np.hypot(*orbit.wall.T), orbit.clearance)
    farthest = np.hypot(*orbit.path.T).max() / orbit.clearance
    assert orbit.closest == pytest.approx(1.0 - farthest, abs=1e-12)
    assert orbit.closest > 0.0
    assert clearance_orbit(analyse(MACHINES["shaken"], SPEED)).closest < 0.0
    square = replace(MACHINES["shaken"], bearing=BEARINGS["sprung"])
    wall = clearance_orbit(analyse(square, SPEED)).wall
    assert_allclose(np.abs(wall).max(axis=1), orbit.clearance)


def test_a_family_contains_each_rotors_own_response() -> None:
    rotors = damping_variants(SHEET)
    family = response_family(SHEET, SPEEDS, rotors=rotors)
    assert family.rotors[0] == SHEET.rotor
    for i, rotor in enumerate(rotors):
        alone = analyse(replace(SHEET, rotor=rotor), family.speed)
        ellipse = orbit_ellipse(alone.disk_response[:, 0], alone.disk_response[:, 1])
        assert_allclose(family.disk[i], ellipse.semi_major, rtol=1e-12)
        onset = onset_speed(replace(SHEET, rotor=rotor)).speed
        assert np.all(family.unstable[i] == (onset < family.speed))


def test_variants_differ_in_one_input_and_keep_the_rotors_mass() -> None:
    for rotor in damping_variants(SHEET):
        assert replace(rotor, disk_damping=0.0) == replace(SHEET.rotor, disk_damping=0.0)
    masses = [rotor.journal_mass for rotor in journal_mass_variants(SHEET)]
    assert len(set(masses)) == len(masses) == 5
    rotor: Rotor = SHEET.rotor
    critical = 2.0 * np.sqrt(rotor.shaft_stiffness * rotor.half_mass)
    assert_allclose(damping_reference(SHEET), critical)
    centred = analyse(replace(SHEET, load=0.0), 100.0).damping
    assert_allclose(damping_reference(MACHINES["rigid"]), centred[0, 0], rtol=1e-12)
