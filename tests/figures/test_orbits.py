"""Charts of nonlinear orbits: Plotly takes them, and they show the records' numbers."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import bifurcation, onset_speed, onsets
from rotorcalc.figures import SI, US, orbits
from rotorcalc.figures import run_up as of_run_up
from rotorcalc.figures.run_up import Marks
from rotorcalc.figures.style import HERE
from rotorcalc.films import film_of
from rotorcalc.nonlinear.limit_cycles import sweep
from rotorcalc.nonlinear.measured_onset import GrowthCurve
from rotorcalc.nonlinear.release import release
from rotorcalc.nonlinear.run_up import run_up
from rotorcalc.units import with_amplitudes
from tests.figures.charts import (
    check_case_is_behind,
    check_plotly_takes_it,
    curves_in_window,
    notes,
)
from tests.films.models import BEARINGS, MOVING
from tests.machines import ROTORS, RPM, SHEET, C, balanced, near_hopf

OF_A_RELEASE = [
    orbits.orbit, orbits.over_time, orbits.film, orbits.growth, orbits.spectrum,
    orbits.once_a_revolution,
]  # fmt: skip


@pytest.fixture(scope="module")
def releases():
    big, speed, _ = near_hopf(0.06, 0.99)
    return {
        "follows": release(SHEET, 6000 * RPM, kick=0.3 * C, revolutions=20),
        "grows": release(balanced(SHEET.rotor), 9365 * RPM, kick=0.05 * C, revolutions=60),
        "at rest": release(balanced(SHEET.rotor), 6000 * RPM, kick=0.0, revolutions=16),
        "jumps": release(big, speed, kick=0.4 * C, revolutions=200, samples_per_revolution=32),
        "unloaded": release(replace(SHEET, load=0.0), 6000 * RPM, kick=0.2 * C, revolutions=16),
    }


@pytest.mark.parametrize("units", [SI, US], ids=lambda units: units.name)
@pytest.mark.parametrize("name", ["follows", "grows", "at rest", "jumps", "unloaded"])
@pytest.mark.parametrize("draw", OF_A_RELEASE, ids=lambda draw: draw.__name__)
def test_every_chart_of_a_release_is_a_plotly_figure(releases, draw, name, units):
    chart = draw(releases[name], units)
    check_plotly_takes_it(chart)
    assert curves_in_window(chart) or notes(chart)
    if name != "follows":
        check_case_is_behind(chart, draw(releases["follows"], units))
    assert any(trace.get("marker", {}).get("color") == HERE for trace in chart["data"])


@pytest.mark.parametrize("name", MOVING)
def test_the_clearance_is_drawn_as_the_film_has_its_wall(name):
    film = film_of(BEARINGS[name])
    let_go = release(
        replace(balanced(SHEET.rotor), bearing=BEARINGS[name]), 6000 * RPM,
        kick=0.1 * C, revolutions=16,
    )  # fmt: skip
    for draw in (orbits.orbit, orbits.once_a_revolution):
        chart = draw(let_go, SI)
        (wall,) = (trace for trace in chart["data"] if trace["name"] == "clearance")
        places = np.stack([wall["y"], wall["x"]], axis=-1) / (1e6 * C)
        assert film.gap(places) == pytest.approx(0.0, abs=1e-9)
        for axis, values in (("xaxis", wall["x"]), ("yaxis", wall["y"])):
            assert np.abs(values).max() < max(chart["layout"][axis]["range"])
    across = orbits.over_time(let_go, SI)["layout"]
    assert across["yaxis"]["range"][1] == pytest.approx(np.abs(wall["y"]).max())


def test_the_animation_ends_on_the_still_and_moves_its_last_traces(releases):
    chart = orbits.orbit(releases["grows"], SI)
    frames = chart["frames"]
    assert 100 < len(frames) <= 150
    places = frames[-1]["traces"]
    assert places == list(range(len(chart["data"]) - 4, len(chart["data"])))
    for change, place in zip(frames[-1]["data"], places, strict=True):
        assert change["x"] == pytest.approx(chart["data"][place]["x"], rel=1e-6, nan_ok=True)
    labels = [step["label"] for step in chart["layout"]["sliders"][0]["steps"]]
    assert labels[0] == "0.0"
    assert labels[-1] == "60.0"
    play, stop = chart["layout"]["updatemenus"][0]["buttons"]
    assert play["args"][0] is None
    assert stop["args"][0] == [None]


def test_a_floating_ring_moves_with_its_clearance_around_the_journal():
    name = "floating ring, heavy"
    let_go = release(
        replace(balanced(SHEET.rotor), bearing=BEARINGS[name]), 6000 * RPM,
        kick=0.5 * C, revolutions=16,
    )  # fmt: skip
    assert let_go.ring == pytest.approx(let_go.motion.inner[:, :2])
    chart = orbits.orbit(let_go, SI)
    check_plotly_takes_it(chart)
    assert len(chart["frames"][0]["data"]) == 6
    drawn = {trace["name"]: trace for trace in chart["data"]}
    ring, around, now = drawn["ring"], drawn["clearance in the ring"], drawn["now"]
    assert (ring["y"][-1], ring["x"][-1]) == pytest.approx(tuple(1e6 * let_go.ring[-1]), rel=1e-5)
    off = np.hypot(around["y"] - ring["y"][-1], around["x"] - ring["x"][-1])
    assert off == pytest.approx(1e6 * C, rel=1e-5)
    assert np.hypot(now["y"][0] - ring["y"][-1], now["x"][0] - ring["x"][-1]) < 1e6 * C


def test_the_charts_show_the_records_numbers(releases):
    found = releases["jumps"]
    (least,) = (trace for trace in orbits.film(found, SI)["data"] if "least" in trace["name"])
    assert least["y"][0] == pytest.approx(found.film.min() * 1e6)
    names = [trace["name"] for trace in orbits.spectrum(found, SI)["data"]]
    assert f"whirl, {found.spectrum.whirl_ratio:.4f}×" in names
    x = next(t for t in orbits.over_time(found, SI)["data"] if t["name"] == "journal")["y"]
    assert np.nanmax(np.abs(x)) == pytest.approx(np.abs(found.motion.journal[:, 0]).max() * 1e6)


@pytest.mark.parametrize("points", [1, 5999, 6000, 6001, 11999, 12000, 12001])
def test_a_long_line_is_thinned_to_what_a_screen_shows(points):
    thinned = orbits._thin(np.arange(points))
    assert len(thinned) <= 6000
    assert thinned[0] == 0
    assert len(np.unique(np.diff(thinned))) <= 1
    assert points < 6000 or len(thinned) > 2500


@pytest.mark.parametrize("units", [SI, with_amplitudes(US, "p-p")], ids=["0-p", "p-p"])
def test_a_run_up_and_a_run_down_with_their_marks(units):
    machine, *_ = near_hopf(0.06, 1.0)
    onset = onset_speed(machine).speed
    run = run_up(machine, 0.98 * onset, 1.06 * onset, revolutions=200)
    marks = Marks(onset, running_speed=2.0 * onset, expected=math.nan)
    branch = bifurcation(machine, lowest=0.95, highest=1.01)
    chart = of_run_up.hysteresis(run, branch, marks, units)
    check_plotly_takes_it(chart)
    named = {trace["name"].split(",")[0]: trace for trace in chart["data"]}
    assert list(named)[-4:] == [
        "speed rising ▸",
        "speed falling ◂",
        "onset",
        "running speed: outside",
    ]
    assert "limit cycle" in named
    up, unit = named["speed rising ▸"], units.amplitude
    np.testing.assert_allclose(up["y"], unit.of(run.up.amplitude))
    assert chart["layout"]["yaxis"]["title"]["text"] == f"Amplitude of the journal [{unit.name}]"
    alone = of_run_up.hysteresis(run, None, marks, units)
    assert not any("cycle" in trace["name"] for trace in alone["data"])
    for passage in (run.up, run.down):
        chart = of_run_up.waterfall(passage, run.clearance, marks, units)
        check_plotly_takes_it(chart)
        heat = chart["data"][0]
        assert np.all(np.diff(heat["y"]) > 0.0)
        assert heat["z"].shape == (300, len(passage.seen.order))
        top = heat["customdata"].max()
        assert top == pytest.approx(float(unit.of(passage.seen.amplitude.max())), rel=1e-6)
        assert {"½×, whirl", "1×, imbalance"} == {note["text"] for note in notes_of(chart)}


def notes_of(chart):
    return chart["layout"]["annotations"]


@pytest.mark.parametrize("eps", [0.06, 0.30])
def test_limit_cycles_show_both_branches_and_both_sweeps(eps):
    machine, speed, _ = near_hopf(eps, 1.01)
    branch = bifurcation(machine)
    speeds = np.linspace(branch.speed.min(), branch.speed.max(), 50)
    swept = (speeds, sweep(branch, speeds), sweep(branch, speeds, down=True))
    for running in (speed, 1.0):
        chart = orbits.cycles(branch, swept, running, SI)
        check_plotly_takes_it(chart)
        names = [trace["name"] for trace in chart["data"]]
        assert {"limit cycle, stable", "limit cycle, unstable", "speed slowly rising ▸"} <= set(
            names
        )
        assert any(name.startswith("fold") for name in names)
    stable = next(t for t in chart["data"] if t["name"] == "limit cycle, stable")
    assert np.isfinite(stable["y"]).sum() == branch.stable.sum() + branch.stable[0]


@pytest.mark.parametrize("running", [0.9, 3.0])
def test_the_growth_chart_marks_all_three_onsets(running):
    machine = balanced(ROTORS["rigid"])
    found = onsets(machine)
    speeds = np.linspace(0.8, 1.2, 9) * found.eigenvalues
    curve = GrowthCurve(
        speeds, speeds - found.eigenvalues, speeds, speeds - found.eigenvalues,
        running * found.eigenvalues, 0.1,
    )  # fmt: skip
    chart = orbits.onset_growth(found, curve, SI)
    check_plotly_takes_it(chart)
    assert (chart["data"][-1]["name"] == "running speed: outside") == (running > 1.2)


@pytest.mark.parametrize("kind", ROTORS)
def test_a_small_release_is_the_linear_theorys(kind):
    """Kick and imbalance both: every mode has its share, and the ellipse its phase."""
    machine = balanced(ROTORS[kind], 1e-4 * C)
    found = release(machine, 5000 * RPM, kick=1e-4 * C, revolutions=16)
    assert np.abs(found.linear - found.motion.journal).max() < 1e-6 * C
    last = found.linear[-65:]
    assert np.ptp(last, axis=0) == pytest.approx(np.ptp(found.ellipse, axis=0), rel=0.01)


def test_the_linear_motion_ends_where_it_leaves_the_bearing(releases):
    found = releases["grows"]
    far = release(balanced(SHEET.rotor), 11500 * RPM, kick=0.3 * C, revolutions=60)
    assert np.isnan(far.linear[-1]).all()
    assert np.nanmax(np.hypot(*far.linear.T)) < 1.5 * C
    start = found.motion.journal[0]
    assert found.linear[0] == pytest.approx(start)
    assert found.last_size > 5.0 * found.first_size
    at, size = found.peaks
    growth = np.polyfit(2 * math.pi * at[3:9] / (9365 * RPM), np.log(size[3:9]), 1)[0]
    assert growth == pytest.approx(found.whirl.real, rel=0.05)


def test_a_bad_release_raises_a_valueerror():
    with pytest.raises(ValueError, match="film has no thickness left"):
        release(SHEET, 6000 * RPM, kick=1.2 * C, revolutions=20)
    with pytest.raises(ValueError, match="16 or more"):
        release(SHEET, 6000 * RPM, kick=0.1 * C, revolutions=2)
