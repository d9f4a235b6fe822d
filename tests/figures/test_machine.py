"""The cross-section: the journal where the record says, X down and Y to the right."""

import re
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import PRESETS, TiltingPads, analyse
from rotorcalc.bearing_parts import bearing_parts
from rotorcalc.coefficients import film_field, middle_pressure
from rotorcalc.figures import SI, US, machine
from rotorcalc.figures.parts import HOUSING
from rotorcalc.films import film_of
from rotorcalc.films.pads import pads_of
from rotorcalc.ring import ring_equilibrium
from tests.figures.charts import check_plotly_takes_it
from tests.films.models import BEARINGS
from tests.machines import SHEET

THETA = np.linspace(0.0, 2.0 * np.pi, 181)


def drawn(preset, units=SI, **changes):
    made = replace(preset.machine, **changes)
    point = analyse(made, preset.speed)
    film = film_field(made, preset.speed, theta=THETA)
    return point, machine.cross_section(point, film, units)


def on(name):
    return replace(SHEET, bearing=BEARINGS[name])


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
    # A bore's corner may lie between two even degrees.
    every_degree = np.linspace(0.0, 2.0 * np.pi, 361)
    farthest = np.hypot(*film_of(bore.bearing).outline(every_degree).T).max()
    gap = (1.0 - radius) / farthest if name != "sprung" else (1.0 - radius) / np.sqrt(2.0)
    for place in ([0.0, 0.0], [0.5, 0.1], [-0.3, 0.6], [0.4, -0.4]):
        nearest = np.hypot(*(ends - gap * np.array(place)).T).min() - radius
        expected = gap * film_of(bore.bearing).gap(place)
        # Of a pad's edge the film is radial, as thin films are; as wide as drawn it is not.
        at_edge = from_an_edge(bore.bearing, np.array(place), gap, radius)
        assert nearest == pytest.approx(at_edge or expected, abs=2e-3 * gap)


def from_an_edge(bearing, place, gap, radius):
    """Return the drawn gap to the nearest pad where that is at its edge; else None."""
    if not is_drawn_by_pads(bearing):
        return None
    found = []
    for pad in pads_of(bearing):
        a = np.array([pad.a_x, pad.a_y])
        middle, half = (pad.start + pad.end) / 2.0, pad.arc / 2.0
        e = place - a
        aside = np.remainder(np.arctan2(e[1], e[0]) - middle + np.pi, 2.0 * np.pi) - np.pi
        beta = middle + np.clip(aside, -half, half)
        surface = gap * a + (radius + gap) * np.array([np.cos(beta), np.sin(beta)])
        found.append((np.hypot(*(surface - gap * place)) - radius, abs(aside) > half))
    distance, at_edge = min(found)
    return distance if at_edge else None


def is_drawn_by_pads(bearing):
    """Return whether a bore is drawn by its pads, not by where the journal can go."""
    known = ("axial-grooves", "elliptical", "offset-halves", "lobes", "pressure-dam", "multi-dam")
    return bearing.geometry.kind in known


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


def readings(chart):
    """Return the drawing's texts, markup taken out."""
    return [re.sub("<[^>]*>", "", note["text"]) for note in chart["layout"]["annotations"]]


@pytest.mark.parametrize(("load", "words"), [(None, "1334 N"), (2e4, "20 kN"), (3.4e7, "34 MN")])
def test_the_drawing_names_and_measures_what_it_shows(load, words):
    point, chart = drawn(PRESETS["sheet-1e8"], load=load)
    seen = readings(chart)
    C = float(point.machine.bearing.radial_clearance)
    for expected in (
        f"Fo = {words}",
        f"φ = {np.degrees(float(point.attitude_angle)):.4g}°",
        f"e = {1e6 * C * float(point.eccentricity_ratio):.4g} µm",
        f"hmin = {1e6 * float(point.minimum_film_thickness):.4g} µm",
    ):
        assert expected in seen
    assert {"φ", "e", "hmin", "Ω"} <= set(seen)
    assert not any(re.search(r"\de[+-]?\d", text) for text in seen)


def test_the_bar_is_as_long_as_the_peak_pressure_is_high():
    point, chart = drawn(PRESETS["sheet-1e8"])
    bar, band = trace(chart, "scale of the pressure"), trace(chart, "pressure")
    height = np.nanmax(np.hypot(band["x"], band["y"])) - 1.0
    assert np.ptp(bar["x"]) == pytest.approx(height, rel=1e-3)
    assert f"{1e-6 * float(point.peak_pressure):.4g} MPa" in readings(chart)


def test_no_load_has_neither_arrow_nor_scale():
    _, chart = drawn(PRESETS["sheet-1e8"], load=0.0)
    assert "no load" in readings(chart)
    assert "scale of the pressure" not in [one["name"] for one in chart["data"]]


SPEEDS = np.linspace(50.0, 1200.0, 24)


def other_speeds(made, speed):
    speeds = np.union1d(SPEEDS, speed)
    return machine.OtherSpeeds(
        sweep=analyse(made, SPEEDS),
        angle=THETA,
        pressure_speed=SPEEDS,
        pressure=middle_pressure(made, SPEEDS, angle=THETA),
        modes_speed=speeds,
        modes=analyse(made, speeds).mode_shapes(),
        parts=bearing_parts(made, SPEEDS),
    )


@pytest.mark.parametrize("name", ["sheet-1e8", "fig-5-2"])
def test_at_another_speed_the_drawing_is_that_speeds_own(name):
    preset = PRESETS[name]
    point, film = (
        analyse(preset.machine, preset.speed),
        film_field(preset.machine, preset.speed, theta=THETA),
    )
    chart = machine.cross_section(
        point, film, SI, others=other_speeds(preset.machine, preset.speed)
    )
    check_plotly_takes_it(chart)
    said = chart["layout"]["meta"]["cursor"]["drawing"]
    for i in (3, 20):
        speed = float(SPEEDS[i])
        there = machine.cross_section(
            analyse(preset.machine, speed), film_field(preset.machine, speed, theta=THETA), SI
        )
        centre = trace(there, "journal centre")
        assert (said["x"][i], said["y"][i]) == pytest.approx((centre["x"][0], centre["y"][0]))
        for reading in said["readings"]:
            words = f"{reading['words']}{float(reading['values'][i]):.4g}"
            assert any(
                note["text"].startswith(words[:-1]) for note in there["layout"]["annotations"]
            )
        wall = np.stack([said["pressure"]["x"], said["pressure"]["y"]], axis=-1)
        out = said["pressure"]["shares"][i]
        peak = np.hypot(*(wall * (1.0 + out[:, None])).T).max()
        band = trace(there, "pressure")
        assert peak == pytest.approx(np.nanmax(np.hypot(band["x"], band["y"])), rel=2e-3)


WITH_PARTS = [name for name in BEARINGS if bearing_parts(on(name), 600.0) is not None]


@pytest.mark.parametrize("to_scale", [False, True])
@pytest.mark.parametrize("name", WITH_PARTS)
def test_parts_at_another_speed_are_drawn_as_they_are_there(name, to_scale):
    made, speed = on(name), float(SPEEDS[9])
    here, there = (
        machine.cross_section(
            analyse(made, one), film_field(made, one, theta=THETA), SI, to_scale=to_scale,
            parts=bearing_parts(made, one),
            others=other_speeds(made, one) if one == 600.0 else None,
        )
        for one in (600.0, speed)
    )  # fmt: skip
    check_plotly_takes_it(here)
    said = here["layout"]["meta"]["cursor"]["drawing"]
    for part, lines in said["moving"].items():
        shown = trace(there, part)
        assert lines["x"][9] == pytest.approx(shown["x"], nan_ok=True, abs=1e-12)
        assert lines["y"][9] == pytest.approx(shown["y"], nan_ok=True, abs=1e-12)
    read = [note["text"] for note in there["layout"]["annotations"]]
    for reading in said["readings"]:
        (words,) = [one for one in read if one.startswith(reading["words"])]
        number = float(words.removeprefix(reading["words"]).split()[0].removesuffix("°"))
        over = other_speeds(made, 600.0).sweep.speed
        assert number == pytest.approx(np.interp(speed, over, reading["values"]), rel=1e-3)


def test_a_ring_floats_clear_of_journal_and_bore_and_turns_at_its_own_speed():
    made = on("floating ring")
    found = ring_equilibrium(made, 600.0)
    chart = machine.cross_section(
        analyse(made, 600.0), film_field(made, 600.0, theta=THETA), SI,
        parts=bearing_parts(made, 600.0),
    )  # fmt: skip
    radius = {
        name: np.ptp(trace(chart, name)["x"]) / 2.0 for name in ("journal", "ring", "bearing")
    }
    assert radius["journal"] < radius["ring"] < radius["bearing"]
    rpm_there = float(SI.speed.of(found.ring_speed))
    (said,) = [
        n["text"] for n in chart["layout"]["annotations"] if "Ω" in n["text"] and "=" in n["text"]
    ]
    assert said.endswith(f"{rpm_there:.0f} rpm")


def test_the_whirl_is_that_of_the_mode_that_decays_slowest():
    made, speed = PRESETS["sheet-1e8"].machine, PRESETS["sheet-1e8"].speed
    point, film = analyse(made, speed), film_field(made, speed, theta=THETA)
    chart = machine.cross_section(point, film, SI, others=other_speeds(made, speed))
    whirl = chart["layout"]["meta"]["cursor"]["drawing"]["whirl"]
    here = int(np.argmin(np.abs(whirl["speed"] - speed)))
    mode = max(point.flexible_eigenvalues, key=lambda value: value.real)
    assert whirl["growth"][here] + 1j * whirl["frequency"][here] == pytest.approx(mode)
    # Its largest distance over a turn is one, and it whirls forward: X to Y, here down to right.
    turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 721))
    x, y = (
        np.real((parts[0][here] + 1j * parts[1][here]) * turn) for parts in (whirl["x"], whirl["y"])
    )
    assert np.hypot(x, y).max() == pytest.approx(1.0, rel=1e-4)
    assert np.sum(x[:-1] * np.diff(y) - y[:-1] * np.diff(x)) > 0.0


@pytest.mark.parametrize("name", BEARINGS)
def test_what_the_drawing_shows_otherwise_is_said(name):
    made = replace(SHEET, bearing=BEARINGS[name])
    point, film = analyse(made, 600.0), film_field(made, 600.0, theta=THETA)
    for to_scale in (False, True):
        chart = machine.cross_section(point, film, SI, to_scale=to_scale)
        drawn_parts = {one["name"] for one in chart["data"]}
        said = machine.remarks(BEARINGS[name], to_scale=to_scale)
        assert ("centres of curvature" in said) == ("centres of the pads' curvature" in drawn_parts)
        assert ("Pockets" in said) == ("pocket" in drawn_parts and not to_scale)


@pytest.mark.parametrize("preload", [0.0, 0.3, 0.9])
def test_pads_stay_in_their_housing_and_pivots_hold_them(preload: float) -> None:
    bearing = replace(SHEET.bearing, geometry=TiltingPads(preload=preload))
    pads = replace(SHEET, bearing=bearing)
    chart = machine.cross_section(
        analyse(pads, 600.0), film_field(pads, 600.0, theta=np.linspace(0.0, 2.0 * np.pi, 181)), SI,
        parts=bearing_parts(pads, 600.0),
    )  # fmt: skip
    lines = {one["name"]: np.stack((one["x"], one["y"])) for one in chart["data"] if "x" in one}
    assert np.nanmax(np.hypot(*lines["pads"])) <= HOUSING
    for start in lines["pivots"][:, ::3].T:  # each pivot's line begins on a pad
        away = np.hypot(*(lines["pads"] - start[:, None]))
        assert np.nanmin(away) < 0.03  # its points are so far apart
