"""The cross-section: the journal where the record says, X down and Y to the right."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse
from rotorcalc.coefficients import film_field
from rotorcalc.figures import SI, US, machine
from rotorcalc.films import film_of
from tests.figures.charts import check_plotly_takes_it
from tests.films.models import BEARINGS
from tests.machines import SHEET

THETA = np.linspace(0.0, 2.0 * np.pi, 181)


def drawn(preset, units=SI, **changes):
    made = replace(preset.machine, **changes)
    point = analyse(made, preset.speed)
    film = film_field(made, preset.speed, theta=THETA)
    return point, machine.cross_section(point, film, units)


def trace(chart, name):
    return next(trace for trace in chart["data"] if trace["name"] == name)


@pytest.mark.parametrize("units", [SI, US])
@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("load", [None, 0.0])
def test_plotly_accepts_the_chart(name, units, load):
    _, chart = drawn(PRESETS[name], units, load=load)
    check_plotly_takes_it(chart)


@pytest.mark.parametrize("name", PRESETS)
def test_the_journal_sits_at_its_eccentricity_and_attitude_angle(name):
    point, chart = drawn(PRESETS[name])
    centre = trace(chart, "journal centre")
    down, right = -centre["y"][0], centre["x"][0]
    assert np.hypot(down, right) == pytest.approx(
        machine.EXAGGERATED * float(point.eccentricity_ratio), rel=1e-12
    )
    assert np.arctan2(right, down) == pytest.approx(float(point.attitude_angle), rel=1e-12)


@pytest.mark.parametrize("name", BEARINGS)
def test_from_journal_to_wall_the_drawn_gap_is_the_films(name):
    """At any place of the journal, not only where it rests."""
    bore = replace(SHEET, bearing=BEARINGS[name])
    point, film = analyse(bore, 600.0), film_field(bore, 600.0, theta=THETA)
    chart = machine.cross_section(point, film, SI)
    wall, journal = (
        np.stack([-trace(chart, part)["y"], trace(chart, part)["x"]], axis=-1)
        for part in ("bearing", "journal")
    )
    assert wall[-1].tolist() == wall[0].tolist()
    ends = np.linspace(wall[:-1], wall[1:], 50).reshape(-1, 2)
    radius = float(np.ptp(journal[:, 0])) / 2.0
    farthest = np.hypot(*film_of(bore.bearing).outline(THETA).T).max()
    gap = (1.0 - radius) / farthest if name != "sprung" else (1.0 - radius) / np.sqrt(2.0)
    for place in ([0.0, 0.0], [0.5, 0.1], [-0.3, 0.6], [0.4, -0.4]):
        nearest = np.hypot(*(ends - gap * np.array(place)).T).min() - radius
        assert nearest == pytest.approx(gap * film_of(bore.bearing).gap(place), abs=2e-3 * gap)


def test_the_pressure_carries_the_load():
    """The drawn band, integrated, pushes the journal straight up: −X, and nothing along Y."""
    _, chart = drawn(PRESETS["sheet-1e8"])
    band = trace(chart, "pressure")
    x, y = band["x"][: len(THETA)], band["y"][: len(THETA)]
    pressure = np.hypot(x, y) - 1.0
    push = np.array([np.trapezoid(-pressure * np.cos(np.arctan2(y, x)), THETA),
                     np.trapezoid(-pressure * np.sin(np.arctan2(y, x)), THETA)])  # fmt: skip
    assert push[1] > 0.0
    assert abs(push[0]) < 1e-3 * push[1]
