"""Charts of tolerances and of one input: all machines are on them, and the running speed."""

from dataclasses import replace

import numpy as np
import pytest

import rotorcalc as rc
from rotorcalc.figures import input_sweep as sweeps
from rotorcalc.figures import tolerances as draw
from rotorcalc.figures.design import Quantity
from rotorcalc.input_sweep import input_sweep
from rotorcalc.units import SI, US
from tests.machines import RPM, SHEET, with_rotor

C = Quantity("Radial clearance", "C", SI.film, 40e-6, 90e-6, log=True)
SPREADS = {"radial_clearance": ("uniform", 50e-6, 80e-6), "temperature": ("normal", 60.0, 4.0)}


@pytest.fixture(scope="module")
def found() -> rc.Tolerance:
    return rc.tolerance(SHEET, SPREADS, 600, 1, speed=8700 * RPM)


def _bars(chart: dict) -> list[dict]:
    return [trace for trace in chart["data"] if trace["type"] == "bar"]


def _line(chart: dict, words: str) -> dict:
    [line] = [trace for trace in chart["data"] if trace["name"].startswith(words)]
    return line


@pytest.mark.parametrize("units", [SI, US], ids=lambda units: units.name)
def test_bars_hold_each_machine_once_and_divide_at_the_running_speed(found, units) -> None:
    for chart, at in (
        (draw.onset_histogram(found, 8900 * RPM, units), 8700.0),
        (draw.margin_histogram(found, units), 0.0),
    ):
        stable, unstable = _bars(chart)
        assert sum(stable["y"]) + sum(unstable["y"]) == pytest.approx(100.0)
        assert sum(unstable["y"]) == pytest.approx(100.0 * found.unstable.mean())
        width = stable["width"]
        assert np.all(stable["x"][stable["y"] > 0.0] > at - width)
        assert np.all(unstable["x"][unstable["y"] > 0.0] < at + width)
        assert _line(chart, "running speed")["x"] == pytest.approx([at, at])
        low, high = chart["layout"]["xaxis"]["range"]
        assert low < at < high


def test_a_running_speed_far_away_is_an_arrow(found: rc.Tolerance) -> None:
    slow = replace(found, speed=500 * RPM)
    chart = draw.onset_histogram(slow, 8900 * RPM, SI)
    [note] = chart["layout"]["annotations"]
    assert note["text"] == "← running speed, 500 rpm"
    assert chart["layout"]["xaxis"]["range"][0] > 5000.0


def test_indices_stand_in_their_order_with_their_errors(found: rc.Tolerance) -> None:
    names = {"bearing.radial_clearance": "Clearance", "temperature": "Temperature"}
    chart = draw.ranking(found, names)
    [bars] = chart["data"]
    assert chart["layout"]["yaxis"]["ticktext"][-1] == "Clearance"
    first = found.influences[0]
    assert bars["x"][-1] == pytest.approx(first.index)
    assert bars["error_x"]["array"][-1] == pytest.approx(first.error)


def test_machines_that_never_whirl_have_no_bar_and_no_ranking() -> None:
    machine = with_rotor(disk_damping=1e5)
    never = rc.tolerance(machine, SPREADS, 40, 1, speed=6000 * RPM)
    assert np.isinf(never.onset).all()
    chart = draw.onset_histogram(never, np.inf, SI)
    assert chart["layout"]["annotations"][-1]["text"] == "no machine has an onset"
    names = {"bearing.radial_clearance": "C", "temperature": "T"}
    assert "no ranking" in draw.ranking(never, names)["layout"]["annotations"][0]["text"]
    assert draw.cloud(never, "temperature", Quantity("T", "T", SI.temperature, 50.0, 70.0), SI)


def test_a_spread_without_width_is_one_bar() -> None:
    one = rc.tolerance(SHEET, {"temperature": ("uniform", 60.0, 60.0)}, 50, 1, speed=6000 * RPM)
    stable, _ = _bars(draw.onset_histogram(one, one.onset[0], SI))
    assert max(stable["y"]) == pytest.approx(100.0)


def test_a_cloud_has_the_first_machines(found: rc.Tolerance) -> None:
    chart = draw.cloud(found, "bearing.radial_clearance", C, SI)
    stable, unstable, _ = chart["data"]
    assert len(stable["x"]) + len(unstable["x"]) == 600
    assert min(stable["y"]) >= 8700.0 > max(unstable["y"])


def test_a_sweep_marks_the_machine_on_each_of_its_curves() -> None:
    values = np.geomspace(40e-6, 90e-6, 5)
    over = input_sweep(SHEET, vary="radial_clearance", values=values, speed=8700 * RPM)
    here = input_sweep(SHEET, vary="radial_clearance", values=[60e-6], speed=8700 * RPM)
    for one, value in (
        (sweeps.onset, here.onset[0] / RPM), (sweeps.margin, 100.0 * here.margin[0]),
        (sweeps.log_decrement, here.log_decrement[0]),
        (sweeps.film, 1e6 * here.minimum_film_thickness[0]),
    ):  # fmt: skip
        chart = one(over, here, C, SI)
        mark = chart["data"][-1]
        assert (mark["x"][0], mark["y"][0]) == pytest.approx((60.0, value))
        low, high = chart["layout"]["yaxis"]["range"]
        assert low <= value <= high
