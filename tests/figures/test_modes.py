"""Charts of modes: Plotly takes them, they show what the records hold, frames move their traces."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse, modes, onset_speed
from rotorcalc.coefficients import equilibrium
from rotorcalc.figures import SI, US, style
from rotorcalc.figures import modes as figures
from rotorcalc.figures import root_locus as plane_figure
from rotorcalc.figures.conventions import conventions
from rotorcalc.root_locus import root_locus
from tests.figures.charts import beside, check_plotly_takes_it
from tests.films.models import RINGS


def shown_of(preset, units=SI, *, flexible=True, speed=None, **changes):
    rotor = replace(preset.machine.rotor, **changes.pop("rotor", {}))
    machine = replace(preset.machine, rotor=rotor, **changes)
    speed = preset.speed if speed is None else speed
    speeds = np.linspace(preset.top_speed / 240, preset.top_speed, 240)
    sweep = analyse(machine, speeds)
    values = sweep.flexible_eigenvalues if flexible else sweep.rigid_eigenvalues
    state = equilibrium(machine, speed)
    shapes = modes.mode_shapes(machine.rotor, state.stiffness, state.damping, flexible=flexible)
    locus = root_locus(
        speeds,
        modes.follow_branches(values),
        running_speed=speed,
        shapes=shapes,
        bearing=machine.bearing,
    )
    rigid = modes.undamped_frequency(sweep.equivalent_stiffness, rotor.half_mass)
    shaft = float(modes.undamped_frequency(rotor.shaft_stiffness, rotor.half_mass))
    return figures.OverSpeed(locus, onset_speed(machine, flexible), units), rigid, shaft


def all_charts(shown, rigid, shaft):
    here = shown.locus.here
    return [
        plane_figure.plane(shown.locus, shown.onset, shown.units),
        figures.growth(shown),
        figures.frequency(shown),
        figures.damping(shown),
        figures.decrement(shown),
        figures.natural(shown, rigid=rigid, shaft=shaft),
        *(
            figures.shape(here, mode, rigid=False, spiral=spiral)
            for mode in range(len(here.eigenvalues))
            for spiral in (False, True)
        ),
        figures.shape(here, 0, rigid=True),
    ]


CHANGES = {
    "as it is": {},
    "rigid": {"flexible": False},
    "no load": {"load": 0.0},
    "heavy load": {"load": 20000.0},
    "journal mass": {"rotor": {"journal_mass": 15.0, "disk_damping": 1e4}},
    "stiff shaft": {"rotor": {"shaft_stiffness": 1e10}},
    "soft shaft": {"rotor": {"shaft_stiffness": 1e5}},
    "slow": {"speed": 10.0},
}


@pytest.mark.parametrize("units", [SI, US])
@pytest.mark.parametrize("changes", CHANGES.values(), ids=CHANGES)
@pytest.mark.parametrize("name", PRESETS)
def test_plotly_accepts_every_chart(name, changes, units):
    for chart in all_charts(*shown_of(PRESETS[name], units, **dict(changes))):
        check_plotly_takes_it(chart)
        for axis in (chart["layout"]["xaxis"], chart["layout"]["yaxis"]):
            assert np.all(np.isfinite(axis["range"]))
            assert axis["range"][0] != axis["range"][1]


@pytest.mark.parametrize("changes", CHANGES.values(), ids=CHANGES)
@pytest.mark.parametrize("name", PRESETS)
def test_every_chart_shows_a_line_in_its_window(name, changes):
    for chart in all_charts(*shown_of(PRESETS[name], **dict(changes))):
        x, y = (sorted(chart["layout"][key]["range"]) for key in ("xaxis", "yaxis"))
        inside = 0
        for trace in chart["data"]:
            if trace["mode"] == "lines" and trace["name"] not in {"running speed", "1× speed"}:
                inside += np.sum(
                    (trace["x"] >= x[0]) & (trace["x"] <= x[1])
                    & (trace["y"] >= y[0]) & (trace["y"] <= y[1])
                )  # fmt: skip
        assert inside > 1, chart["layout"]["yaxis"]["title"]


def test_the_onset_lies_on_the_imaginary_axis_at_its_whirl_frequency():
    shown, *_ = shown_of(PRESETS["sheet-1e8"])
    chart = plane_figure.plane(shown.locus, shown.onset, SI)
    mark = next(trace for trace in chart["data"] if trace["name"].startswith("onset"))
    assert mark["name"] == "onset 8919 rpm"
    assert mark["x"] == [0.0]
    assert mark["y"] == pytest.approx(shown.onset.whirl_frequency * 30 / np.pi)


def test_an_onset_outside_the_chart_has_no_mark():
    preset = PRESETS["sheet-1e8"]
    for changes in ({"load": 0.0}, {"load": 20000.0}):
        shown, *_ = shown_of(preset, **changes)
        assert not 0.0 < shown.onset.speed <= preset.top_speed
        chart = plane_figure.plane(shown.locus, shown.onset, SI)
        assert not [trace for trace in chart["data"] if trace["name"].startswith("onset")]
        assert not figures.growth(shown)["layout"]["annotations"]


def test_frames_move_the_rings_to_the_eigenvalues_of_their_speed():
    shown, *_ = shown_of(PRESETS["sheet-1e8"])
    locus = shown.locus
    chart = plane_figure.plane(locus, shown.onset, SI)
    slider = chart["layout"]["sliders"][0]
    assert len(chart["frames"]) == len(slider["steps"]) == 40
    assert [step["args"][0][0] for step in slider["steps"]] == [f["name"] for f in chart["frames"]]
    for frame, step in zip(chart["frames"], slider["steps"], strict=True):
        rpm = float(step["label"])
        place = int(np.argmin(np.abs(locus.speed * 30 / np.pi - rpm)))
        half, rings = frame["data"]
        assert half["y"] == pytest.approx([rpm / 2, rpm / 2], abs=0.26)
        if rpm != 6000:
            assert rings["x"] == pytest.approx(locus.branches[place].real)
        assert [chart["data"][i]["mode"] for i in frame["traces"]] == ["lines", "markers"]


def test_the_scrubber_begins_at_the_running_speed():
    shown, *_ = shown_of(PRESETS["sheet-1e8"])
    chart = plane_figure.plane(shown.locus, shown.onset, SI)
    slider = chart["layout"]["sliders"][0]
    assert slider["steps"][slider["active"]]["label"] == "6000"
    assert chart["data"][-1]["x"] == pytest.approx(shown.locus.here.eigenvalues.real)


def test_frames_keep_their_traces_over_a_case():
    live, *_ = shown_of(PRESETS["sheet-1e8"])
    pinned, *_ = shown_of(PRESETS["sheet-1e7"])
    alone = plane_figure.plane(live.locus, live.onset, SI)
    both = beside(alone, plane_figure.plane(pinned.locus, pinned.onset, SI))
    assert len(both["data"]) > len(alone["data"])
    assert not [t for t in both["data"] if t["name"] == "A: at the speed chosen below"]
    for before, after in zip(alone["frames"], both["frames"], strict=True):
        moved = [both["data"][i]["name"] for i in after["traces"]]
        assert moved == [alone["data"][i]["name"] for i in before["traces"]]


def test_real_eigenvalues_are_dotted_and_have_no_frequency():
    shown, *_ = shown_of(PRESETS["fig-5-2"])
    damping = figures.damping(shown)
    still = [t for t in damping["data"] if "does not oscillate" in t["name"]]
    assert len(still) == 2
    assert all(trace["line"]["dash"] == "dot" for trace in still)
    assert np.nanmax(np.abs(still[0]["y"] - 1.0)) < 1e-12
    assert not [t for t in figures.frequency(shown)["data"] if "does not oscillate" in t["name"]]


def test_modes_outside_the_chart_are_mentioned():
    shown, *_ = shown_of(PRESETS["fig-5-2"])
    words = plane_figure.beyond(shown.locus, SI)
    assert words.count("does not oscillate") == 2
    stiff, *_ = shown_of(PRESETS["sheet-1e8"])
    assert plane_figure.beyond(stiff.locus, SI) == ""


def test_the_running_speed_is_marked_on_every_chart_over_speed():
    shown, rigid, shaft = shown_of(PRESETS["sheet-1e8"])
    lead = shown.locus.here.eigenvalues[shown.locus.least_damped]
    for chart, value in (
        (figures.growth(shown), lead.real),
        (figures.frequency(shown), lead.imag * 30 / np.pi),
        (figures.damping(shown), modes.damping_ratio(lead)),
        (figures.decrement(shown), modes.logarithmic_decrement(lead)),
        (figures.natural(shown, rigid=rigid, shaft=shaft), abs(lead) * 30 / np.pi),
    ):
        marks = [t for t in chart["data"] if t["mode"] == "markers"]
        assert marks[0]["marker"]["color"] == style.HERE
        assert marks[0]["x"] == pytest.approx([6000])
        assert marks[0]["y"] == pytest.approx([float(value)])


def test_a_forward_orbit_turns_from_x_down_to_y_right():
    shown, *_ = shown_of(PRESETS["sheet-1e8"])
    # Oil whirl, the mode of the lowest frequency, turns with the shaft.
    frequency = shown.locus.here.eigenvalues.imag
    mode = int(np.argmin(np.where(frequency > 0.0, frequency, np.inf)))
    chart = figures.shape(shown.locus.here, mode, rigid=False)
    assert chart["layout"]["yaxis"]["range"][0] > chart["layout"]["yaxis"]["range"][1]
    orbit = next(trace for trace in chart["data"] if trace["name"] == "disk")
    Y, X = orbit["x"], orbit["y"]
    assert np.all(X[:-1] * np.diff(Y) - Y[:-1] * np.diff(X) > 0.0)


def test_a_floating_rings_orbit_stands_in_the_shape_beside_the_shaft():
    machine = replace(PRESETS["sheet-1e8"].machine, bearing=RINGS["floating ring"])
    here = analyse(machine, 600.0).mode_shapes()
    mode = int(np.argmax(np.abs(here.inner[:, 0]) * (here.eigenvalues.imag > 0.0)))
    chart = figures.shape(here, mode, rigid=False, ring=True)
    check_plotly_takes_it(chart)
    drawn = {trace["name"]: trace for trace in reversed(chart["data"])}  # arrows come second
    X, Y = here.inner[mode].real
    assert (drawn["ring"]["y"][0], drawn["ring"]["x"][0]) == pytest.approx((X, Y))
    assert len(drawn["shaft at t = 0"]["x"]) == 3
    assert len(drawn["t = 0"]["x"]) == 3
    without = figures.shape(here, mode, rigid=False)
    assert "ring" not in [trace["name"] for trace in without["data"]]


def test_the_spiral_shrinks_by_the_decrement():
    shown, *_ = shown_of(PRESETS["sheet-1e8"])
    here, lead = shown.locus.here, shown.locus.least_damped
    orbit = figures.shape(here, lead, rigid=False, spiral=True)["data"][0]
    turn = (len(orbit["x"]) - 1) // 3
    ratio = np.hypot(orbit["x"][turn], orbit["y"][turn]) / np.hypot(orbit["x"][0], orbit["y"][0])
    assert ratio == pytest.approx(np.exp(-modes.logarithmic_decrement(here.eigenvalues[lead])))


def test_the_drawing_of_the_conventions_is_a_figure():
    chart = conventions()
    check_plotly_takes_it(chart)
    centre = next(t for t in chart["data"] if t["name"] == "journal's centre")
    down, right = -centre["y"][0], centre["x"][0]
    assert np.degrees(np.arctan2(right, down)) == pytest.approx(40.0)
