"""The Campbell diagram's chart: Plotly takes it, and it shows what the record holds."""

import numpy as np
import pytest

from rotorcalc import PRESETS
from rotorcalc.criteria import campbell
from rotorcalc.figures import SI, US
from rotorcalc.figures.campbell import diagram
from rotorcalc.figures.style import UNSTABLE
from tests.figures.charts import check_plotly_takes_it


def record_of(preset):
    return campbell(
        preset.machine, np.linspace(preset.top_speed / 120, preset.top_speed, 120)
    )  # fmt: skip


@pytest.mark.parametrize("units", [SI, US])
@pytest.mark.parametrize("preset", PRESETS.values(), ids=PRESETS)
def test_plotly_takes_it_and_lines_are_in_the_window(preset, units):
    chart = diagram(record_of(preset), units, running_speed=preset.speed)
    check_plotly_takes_it(chart)
    (_, right), (low, top) = (chart["layout"][name]["range"] for name in ("xaxis", "yaxis"))
    assert low == 0.0
    assert top >= 0.4999 * right
    whirl = next(trace for trace in chart["data"] if "whirl line" in trace["name"])
    assert whirl["y"] == pytest.approx(0.5 * whirl["x"])


def test_modes_are_drawn_once_forward_solid_and_backward_broken():
    found = record_of(PRESETS["sheet-1e7"])
    chart = diagram(found, SI, running_speed=400.0)
    for i in range(found.frequency.shape[1]):
        parts = {
            trace["name"].split(", ")[1]: trace
            for trace in chart["data"]
            if trace["name"].startswith(f"mode {i + 1}")
        }
        drawn = np.full(len(found.speed), np.nan)
        for direction, trace in parts.items():
            known = np.isfinite(trace["y"])
            assert np.all(found.forward[known, i] == (direction == "forward"))
            assert (trace["line"]["dash"] == "solid") == (direction == "forward")
            assert np.all(np.isnan(drawn[known]))
            drawn[known] = trace["y"][known]
        assert drawn == pytest.approx(SI.speed.of(found.frequency[:, i]), nan_ok=True)


def test_the_unstable_part_of_a_mode_is_red():
    found = record_of(PRESETS["sheet-1e8"])
    chart = diagram(found, SI, running_speed=600.0)
    (red,) = [trace for trace in chart["data"] if trace["name"] == "unstable"]
    assert red["line"]["color"] == UNSTABLE
    assert np.array_equal(np.isfinite(red["y"]), np.any(found.log_decrement < 0.0, axis=1))


def test_critical_speeds_are_marked_on_the_line_of_the_running_speed():
    found = record_of(PRESETS["sheet-1e7"])
    chart = diagram(found, SI, running_speed=400.0)
    (marks,) = [trace for trace in chart["data"] if "critical speed" in trace["name"]]
    assert np.array_equal(marks["x"], marks["y"])
    assert marks["x"] == pytest.approx(SI.speed.of(found.crossing_speed))
