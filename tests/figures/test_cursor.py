"""What charts say of the value that a browser marks in all of a page's charts."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse, onset_speed, thresholds
from rotorcalc.figures import SI, US, Chart, cursor, modes, response, root_locus, stability, style
from rotorcalc.figures import equilibrium as place
from rotorcalc.root_locus import root_locus as locus_of
from rotorcalc.unbalance_curves import clearance_orbit, orbits
from tests.figures.charts import beside

RPM = math.pi / 30
PRESET = PRESETS["sheet-1e8"]
SWEEP = analyse(PRESET.machine, np.linspace(PRESET.top_speed / 60, PRESET.top_speed, 60))
POINT = analyse(PRESET.machine, PRESET.speed)


def said(chart: Chart) -> dict:
    return chart["layout"]["meta"]["cursor"]


def over_speed(units) -> Iterator[Chart]:
    crossing = stability.Crossing(onset_speed(PRESET.machine), closed_form=True)
    found = thresholds.at_each_speed(SWEEP), thresholds.at_each_speed(POINT)
    for draw in (stability.threshold, stability.whirl_frequency, stability.critical_mass):
        yield draw(*found, crossing, units)
    for draw in (place.power_loss, place.side_flow, place.position_over_speed):
        yield draw(SWEEP, POINT, units)
    locus = locus_of(
        SWEEP.speed,
        SWEEP.branches(),
        running_speed=PRESET.speed,
        shapes=POINT.mode_shapes(),
        bearing=PRESET.machine.bearing,
    )
    yield modes.growth(modes.OverSpeed(locus, crossing.onset, units))


@pytest.mark.parametrize("units", [SI, US], ids=["SI", "US"])
def test_charts_over_speed_say_their_axis_unit_and_speed(units) -> None:
    for chart in over_speed(units):
        assert said(chart) == {
            "quantity": "speed", "unit": "rpm", "axis": "x",
            "now": pytest.approx(PRESET.speed / RPM),
        }  # fmt: skip
        assert "Running speed" in chart["layout"]["xaxis"]["title"]["text"]


def test_an_overview_says_so_too_and_what_it_leaves_out() -> None:
    whole = next(over_speed(SI))
    small = style.small(whole)
    assert said(small) == said(whole)
    assert small["layout"]["meta"]["whole"]["annotations"] == whole["layout"]["annotations"]
    assert small["layout"]["annotations"] == []


def test_an_animation_says_the_speed_of_each_frame() -> None:
    steps, here = orbits(SWEEP, points=49), orbits(POINT)
    charts = [
        response.scrubber(steps, here, SI),
        response.played_in_clearance(
            clearance_orbit(POINT), SWEEP.journal_position, here, steps, SI
        ),
    ]
    for chart in charts:
        labels = [step["label"] for step in chart["layout"]["sliders"][0]["steps"]]
        assert [f"{stop:.0f}" for stop in said(chart)["frames"]] == labels
        assert len(labels) == len(chart["frames"])
        assert np.all(np.diff(said(chart)["frames"]) > 0.0)


def test_the_orbit_in_the_clearance_moves_about_its_speeds_equilibrium() -> None:
    steps = orbits(SWEEP, points=49)
    chart = response.played_in_clearance(
        clearance_orbit(POINT), SWEEP.journal_position, orbits(POINT), steps, SI
    )
    for speed in (5, 40):
        stop = int(np.argmin(np.abs(said(chart)["frames"] - float(SWEEP.speed[speed]) / RPM)))
        path = chart["frames"][stop]["data"][0]
        centre = 1e6 * SWEEP.journal_position[speed]
        # An ellipse's middle is the mean of its points, of which the last is the first.
        assert np.mean(path["x"][:-1]) == pytest.approx(centre[1], abs=1e-3)
        assert np.mean(path["y"][:-1]) == pytest.approx(centre[0], abs=1e-3)


def test_the_line_along_which_a_speed_moves_has_its_speeds() -> None:
    locus = locus_of(
        SWEEP.speed,
        SWEEP.branches(),
        running_speed=PRESET.speed,
        shapes=POINT.mode_shapes(),
        bearing=PRESET.machine.bearing,
    )
    chart = root_locus.plane(locus, onset_speed(PRESET.machine), SI)
    lines = [trace for trace in chart["data"] if trace["name"] == said(chart)["along"]]
    told = np.concatenate([line["customdata"] for line in lines])
    assert np.nanmax(told) == pytest.approx(PRESET.top_speed / RPM)


def test_a_case_behind_changes_nothing_of_it() -> None:
    chart, other = list(over_speed(SI))[3:5]
    assert said(beside(chart, other)) == said(chart)


def test_a_chart_keeps_what_else_its_meta_holds() -> None:
    chart = style.chart([], style.axis("x", 0.0, 1.0), style.axis("y", 0.0, 1.0), meta={"a": 1})
    both = cursor.marked(chart, "speed", "rpm", 5.0, axis="y")
    assert both["layout"]["meta"]["a"] == 1
    assert said(both)["axis"] == "y"
    assert "cursor" not in chart["layout"]["meta"]


@pytest.mark.parametrize(("against", "field"), [("ε", "eccentricity_ratio"), ("σ", "sommerfeld")])
def test_a_chart_over_what_follows_from_the_speed_says_how(against: str, field: str) -> None:
    chart = style.chart([], style.axis("x", 0.0, 1.0), style.axis("y", 0.0, 1.0))
    found = said(cursor.over_film(chart, SWEEP, POINT, SI, against))
    assert found["to"].tolist() == getattr(SWEEP, field).tolist()
    assert found["at"] == pytest.approx(SWEEP.speed / RPM)
    unloaded = replace(PRESET.machine, load=0.0)
    without = analyse(unloaded, SWEEP.speed), analyse(unloaded, PRESET.speed)
    assert cursor.over_film(chart, *without, SI, against) == chart
