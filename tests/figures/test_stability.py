"""The stability page's charts: valid, complete and explained, for every kind of machine."""

import json
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import PRESETS, CoefficientTable, TiltingPads, design, rpm, thresholds, variation
from rotorcalc.figures import SI, US, Chart, Units
from rotorcalc.figures import design as what_if
from rotorcalc.figures import stability as figures
from rotorcalc.figures.coefficients import of_table
from rotorcalc.figures.onset_map import onset_map
from rotorcalc.onset import Onset
from tests.figures.charts import (
    check_case_is_behind,
    check_plotly_takes_it,
    curves_in_window,
    notes,
)
from ui.computed import Computed, computed_from
from ui.inputs import GAS, INPUTS, PRESET_VALUES, Values
from ui.supply import other
from ui.words import design as moves
from ui.words import remedies
from ui.words import stability as ask

SHEET = PRESET_VALUES["sheet-1e8"]
VALUES: dict[str, Values] = {
    **PRESET_VALUES,
    "no load": SHEET | {"load": 0.0},
    "light load": SHEET | {"load": 1.0},
    "no whirl up to the top speed": SHEET | {"load": 20000.0, "rpm": 100.0, "rpm_max": 1000.0},
    "rigid": SHEET | {"k": math.inf},
    "damped": SHEET | {"cs": 5000.0, "mj": 10.0},
    "rigid and damped": SHEET | {"k": math.inf, "cs": 1e5, "mj": 10.0},
    "slow": SHEET | {"rpm": 100.0},
    "fast": SHEET | {"rpm": 30000.0, "rpm_max": 40000.0},
    "narrow": SHEET | {"C": 10.0},
    "heavy rotor": SHEET | {"mass": 2000.0, "C": 500.0},
    "soft": SHEET | {"k": 1e5, "load": 20000.0},
}
every_machine = pytest.mark.parametrize("values", VALUES.values(), ids=VALUES.keys())


def _over_speed(draw: Callable[..., Chart], c: Computed, units: Units) -> Chart:
    return draw(
        thresholds.at_each_speed(c.sweep), thresholds.at_each_speed(c.point), ask.crossing(c), units
    )


def _fig_5_10(c: Computed, over_eps: bool) -> Chart:
    return figures.flexible_threshold(
        ask.film_figure(c, over_eps), ask.sags(c), ask.flexible_curves(c), ask.flexible_here(c)
    )


def _map(c: Computed, units: Units) -> Chart:
    axes = (moves.quantity("C", c.machine, units), moves.quantity("load", c.machine, units))
    xs, ys = (np.geomspace(axis.low, axis.high, 4) for axis in axes)
    onsets = design.onset_map(c.machine, x="radial_clearance", xs=xs, y="load", ys=ys)
    here = moves.value_of(c.machine, "C"), moves.value_of(c.machine, "load")
    return onset_map(onsets, axes, here, c.speed, units)


def _solution(c: Computed, units: Units) -> Chart:
    found = design.solve_onset(c.machine, vary="temperature", target=1.2 * c.speed, low=0, high=150)
    axis = moves.quantity("T", c.machine, units)
    return what_if.solution(found, axis, (c.machine.temperature, c.onset.speed), c.speed, units)


CHARTS: dict[str, Callable[[Computed, Units], Chart]] = {
    "threshold": lambda c, units: _over_speed(figures.threshold, c, units),
    "whirl frequency": lambda c, units: _over_speed(figures.whirl_frequency, c, units),
    "critical mass": lambda c, units: _over_speed(figures.critical_mass, c, units),
    "whirl ratio over σ": lambda c, _: figures.whirl_ratio(ask.film_figure(c)),
    "whirl ratio over ε": lambda c, _: figures.whirl_ratio(ask.film_figure(c, True)),
    "p_s over σ": lambda c, _: figures.threshold_speed(ask.film_figure(c)),
    "p_s over ε": lambda c, _: figures.threshold_speed(ask.film_figure(c, True)),
    "p_s² over σ": lambda c, _: figures.critical_mass_number(ask.film_figure(c)),
    "p_s² over ε": lambda c, _: figures.critical_mass_number(ask.film_figure(c, True)),
    "p_sf over σ": lambda c, _: _fig_5_10(c, False),
    "p_sf over ε": lambda c, _: _fig_5_10(c, True),
    "energy bars": lambda c, units: figures.energy_bars(ask.energies(c), units),
    "energy": lambda c, units: figures.energy(ask.energies(c), ask.crossing(c), units),
    "map": _map,
    "tornado": lambda c, units: what_if.tornado(
        moves.sensitivities(c), moves.names(c.machine, units), c.speed, units
    ),
    "solution": _solution,
}
every_chart = pytest.mark.parametrize("draw", CHARTS.values(), ids=CHARTS.keys())
SLOW = {"map", "tornado", "solution"}


def _texts(chart: Chart) -> list[str]:
    names = [str(trace.get("name", "")) for trace in chart["data"]]
    labels = [str(text) for trace in chart["data"] for text in trace.get("text") or ()]
    notes = [note["text"] for note in chart["layout"].get("annotations", ())]
    ticks = [str(t) for t in chart["layout"]["yaxis"].get("ticktext", ())]
    return [*names, *labels, *notes, *ticks]


@every_machine
@every_chart
def test_chart_is_valid_and_shows_no_nan(
    values: Values, draw: Callable[[Computed, Units], Chart]
) -> None:
    _check(draw(computed_from(values), SI))


@pytest.mark.parametrize("key", ["sheet-1e7", "damped"])
@every_chart
def test_chart_is_valid_in_us_units(key: str, draw: Callable[[Computed, Units], Chart]) -> None:
    _check(draw(computed_from(VALUES[key]), US))


# Without an onset there is no whirl orbit: the page says so and draws no energy.
@pytest.mark.parametrize("name", [name for name in CHARTS if not name.startswith("energy")])
def test_chart_is_valid_where_there_is_no_onset(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    draw = CHARTS[name]
    never = Onset(
        speed=math.inf,
        whirl_frequency=math.nan,
        eccentricity_ratio=math.nan,
        method="polynomial",
    )
    monkeypatch.setattr(Computed, "onset", never)
    monkeypatch.setattr(moves, "sensitivities", lambda _: _endless())
    _check(draw(computed_from(VALUES["damped"]), SI))


def _endless() -> design.Sensitivities:
    one = design.Sensitivity("load", 1.0, 2.0, math.inf, math.inf)
    return design.Sensitivities(onset=math.inf, inputs=(one, one))


def _check(chart: Chart) -> None:
    check_plotly_takes_it(chart)
    for text in _texts(chart):
        assert "nan" not in text.lower().split()
        assert not {"inf", "inf rpm"} & set(text.lower().split())
    for axis in ("xaxis", "yaxis"):
        low, high = chart["layout"][axis]["range"]
        assert math.isfinite(low)
        assert math.isfinite(high)
        assert low < high


@every_machine
@every_chart
def test_every_chart_shows_a_curve_in_its_window_or_says_why_not(
    values: Values, draw: Callable[[Computed, Units], Chart]
) -> None:
    chart = draw(computed_from(values), SI)
    assert curves_in_window(chart) or any("no whirl" in text for text in _texts(chart))


# Bars are not drawn behind bars, and one map is not drawn behind another: only its marks are.
NO_BASELINE = {"energy bars", "tornado"}


@pytest.mark.parametrize("name", sorted(CHARTS.keys() - NO_BASELINE))
def test_a_case_can_stand_behind(name: str) -> None:
    other = PRESET_VALUES["friswell-5-5-1"] | {"cs": 5000.0, "mj": 2.0}
    check_case_is_behind(*(CHARTS[name](computed_from(values), SI) for values in (SHEET, other)))


@pytest.mark.parametrize("key", PRESETS)
def test_the_crossing_lies_on_the_line_of_equal_speeds(key: str) -> None:
    computed = computed_from(PRESET_VALUES[key])
    chart = _over_speed(figures.threshold, computed, SI)
    [mark] = [trace for trace in chart["data"] if trace["name"].startswith("onset")]
    rpm = float(SI.speed.of(computed.onset.speed))
    assert mark["x"] == pytest.approx([rpm])
    assert mark["y"] == pytest.approx([rpm])
    assert chart["layout"]["shapes"][0]["x0"] == pytest.approx(rpm)


def test_a_glance_says_that_no_speed_is_unstable_and_else_leaves_words_out() -> None:
    steady = SHEET | {"bearing": "elliptical", "preload": 0.9, "groove_width": 10.0}
    for values, words in ((steady, ["stable at every speed"]), (SHEET, [])):
        computed = computed_from(values)
        assert math.isinf(computed.onset.speed) == bool(words)
        assert notes(_over_speed(figures.threshold_at_a_glance, computed, SI)) == words
    # Where the search ended far beyond the chart, the chart tells of its own speeds.
    c, crossing = computed_from(steady), ask.crossing(computed_from(steady))
    crossing = replace(crossing, onset=replace(crossing.onset, searched_to=1e5))
    over = thresholds.at_each_speed(c.sweep), thresholds.at_each_speed(c.point)
    assert notes(figures.threshold_at_a_glance(*over, crossing, SI)) == [
        "stable at every speed shown"
    ]


def test_with_damping_the_onset_is_a_line_of_its_own() -> None:
    computed = computed_from(VALUES["damped"])
    chart = _over_speed(figures.threshold, computed, SI)
    [line] = [trace for trace in chart["data"] if trace["name"].startswith("onset")]
    assert line["mode"] == "lines"
    assert line["x"] == pytest.approx([float(SI.speed.of(computed.onset.speed))] * 2)
    curves = [trace for trace in chart["data"] if trace["name"].endswith("closed form")]
    assert [curve["line"]["dash"] for curve in curves] == ["dash", "dash"]


def test_axes_stay_where_they_are_while_a_slider_moves() -> None:
    ranges = {
        json.dumps(
            [
                CHARTS[name](computed_from(SHEET | {"C": clearance}), SI)["layout"][axis]["range"]
                for name in CHARTS
                if name not in SLOW
                for axis in ("xaxis", "yaxis")
                if not name.startswith("energy")
            ]
        )
        for clearance in (55.0, 60.0, 65.0)
    }
    assert len(ranges) == 1


def test_the_bars_meet_at_the_onset() -> None:
    for key in ("sheet-1e8", "damped"):
        chart = figures.energy_bars(ask.energies(computed_from(VALUES[key])), SI)
        gain, *losses = chart["data"]
        taken = sum(loss["y"][1] for loss in losses)
        assert gain["y"][1] == pytest.approx(taken, rel=1e-9)
        assert len(losses) == (2 if key == "damped" else 1)


def test_the_tornado_has_the_largest_on_top() -> None:
    computed = computed_from(SHEET)
    found, speed = moves.sensitivities(computed), computed.speed
    chart = what_if.tornado(found, moves.names(computed.machine, SI), speed, SI)
    less, more = (np.abs(trace["x"]) for trace in chart["data"][:2])
    reach = np.maximum(less, more)
    assert np.all(np.diff(reach) >= 0.0)
    assert any("Film temperature T ±5 °C" in row for row in chart["layout"]["yaxis"]["ticktext"])
    in_us = what_if.tornado(found, moves.names(computed.machine, US), speed, US)
    assert any("Film temperature T ±9 °F" in row for row in in_us["layout"]["yaxis"]["ticktext"])


def _words(chart: Chart) -> list[str]:
    return [note["text"] for note in chart["layout"].get("annotations", ())]


def test_a_maps_colours_span_its_onsets_and_its_contours_are_labelled() -> None:
    computed = computed_from(SHEET)
    for low, high in ((10e-6, 500e-6), (55e-6, 65e-6)):
        onsets = design.onset_map(
            computed.machine,
            x="radial_clearance", xs=np.geomspace(low, high, 40),
            y="temperature", ys=np.linspace(20.0, 100.0, 40),
        )  # fmt: skip
        axes = tuple(moves.quantity(key, computed.machine, SI) for key in ("C", "T"))
        chart = onset_map(onsets, axes, (60e-6, 60.0), computed.speed, SI)
        levels = [float(text) for text in chart["data"][0]["colorbar"]["ticktext"]]
        rpm = SI.speed.of(onsets.speed)
        assert len(levels) >= 3
        assert rpm.min() <= levels[0] < levels[-1] <= rpm.max()
        labels = {float(text) for text in _words(chart) if text.isdigit()}
        assert labels
        assert labels <= set(levels)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        (SHEET, {"stable", "unstable"}),
        (SHEET | {"rpm": 100.0}, {"stable"}),
        (SHEET | {"rpm": 300000.0, "rpm_max": 300000.0}, {"unstable"}),
    ],
)
def test_a_map_names_its_sides_and_has_a_line_only_between_two(
    values: Values, words: set[str]
) -> None:
    computed = computed_from(values)
    axes = tuple(moves.quantity(key, computed.machine, SI) for key in ("C", "T"))
    onsets = design.onset_map(
        computed.machine, x="radial_clearance", xs=np.geomspace(50e-6, 300e-6, 30),
        y="temperature", ys=np.linspace(20.0, 80.0, 30),
    )  # fmt: skip
    chart = onset_map(onsets, axes, (60e-6, 60.0), computed.speed, SI)
    assert {text for text in _words(chart) if not text.isdigit()} == words
    legend = [trace["name"] for trace in chart["data"] if trace.get("showlegend", True)]
    assert any("running speed" in name for name in legend) == (len(words) == 2)
    said = moves.sides(computed, onsets, SI)
    assert ("red line" in said) == (len(words) == 2)
    for side in ("**stable**", "**unstable**"):
        assert (side in said) == (side.strip("*") in words) or len(words) == 2


def test_a_map_without_load_says_that_all_of_it_is_unstable() -> None:
    computed = computed_from(SHEET | {"load": 0.0})
    onsets = moves.onset_map(computed, "C", "T", SI)
    axes = tuple(moves.quantity(key, computed.machine, SI) for key in ("C", "T"))
    chart = onset_map(onsets, axes, (60e-6, 60.0), computed.speed, SI)
    assert _words(chart) == ["unstable"]
    assert chart["data"][0]["showscale"] is False
    assert "All machines of this map are **unstable**" in moves.sides(computed, onsets, SI)
    few = replace(onsets, speed=onsets.speed[:12, :12])
    assert "at 12 × 12 points" in moves.sides(computed, few, SI)
    assert "points" not in moves.sides(computed, replace(onsets, speed=np.zeros((61, 61))), SI)


def test_a_machine_beyond_its_axis_is_named_at_the_edge() -> None:
    computed = computed_from(SHEET | {"load": 0.0})
    axis = moves.quantity("load", computed.machine, SI)
    found = remedies.solution(computed, "load", 1.2 * computed.speed, SI)
    chart = what_if.solution(found, axis, (0.0, 0.0), computed.speed, SI)
    [words] = [trace for trace in chart["data"] if trace["name"].startswith("this machine")]
    assert words["text"] == ["← this machine"]


def test_the_tornado_leaves_out_what_moves_nothing() -> None:
    computed = computed_from(SHEET | {"load": 0.0})
    chart = CHARTS["tornado"](computed, SI)
    [row] = chart["layout"]["yaxis"]["ticktext"]
    assert row.startswith("Load per bearing")


def test_where_no_input_moves_the_onset_no_line_crosses_the_words() -> None:
    none = design.Sensitivities(math.inf, ())
    chart = what_if.tornado(none, {}, 600.0, SI)
    assert notes(chart) == ["no input gives an onset"]
    assert not chart["layout"]["shapes"]
    assert not chart["layout"]["xaxis"]["showgrid"]
    assert notes(what_if.tornado(replace(none, onset=900.0), {}, 600.0, SI)) == [
        "no input moves the onset"
    ]


def test_where_an_onset_was_not_found_no_infinity_is_said(monkeypatch) -> None:
    computed, onset = computed_from(SHEET), np.array([2.0, math.inf]) * 1000 * rpm
    found = design.OnsetSolution("C", 600.0, np.empty(0), np.array([1e-5, 1e-4]), onset)
    monkeypatch.setattr(remedies, "solution", lambda *_: found)
    said = remedies.answer(computed, "C", _wanted(computed), SI)
    assert said.endswith("the onset stays above 2000 rpm.")
    found = replace(found, solutions=np.array([5e-5]))
    nowhere = replace(computed.onset, speed=math.inf)
    monkeypatch.setattr(Computed, "onset", property(lambda _: nowhere))
    said = remedies.answer(computed, "C", _wanted(computed), SI)
    assert said.endswith("**50 µm** gives it; now it is 60 µm, and no onset was found.")


def _wanted(computed: Computed, margin: float = 20.0) -> remedies.Wanted:
    return remedies.Wanted("above the running speed", margin)


def test_the_solutions_stand_on_the_wanted_line() -> None:
    computed, axis = computed_from(SHEET), moves.quantity("C", computed_from(SHEET).machine, SI)
    found = remedies.solution(computed, "C", 1.2 * computed.speed, SI)
    chart = what_if.solution(found, axis, (60e-6, computed.onset.speed), computed.speed, SI)
    [mark] = [trace for trace in chart["data"] if trace["name"] == "solution"]
    assert mark["x"] == pytest.approx([100.44, 459.40], rel=1e-4)
    assert mark["y"] == pytest.approx([7200.0, 7200.0])
    said = remedies.answer(computed, "C", _wanted(computed), SI)
    assert "100.4 µm" in said
    assert "459.4 µm" in said
    assert "higher already" in said


def test_without_a_solution_the_text_gives_the_range_that_can_be_reached() -> None:
    computed = computed_from(SHEET)
    words = remedies.answer(computed, "T", _wanted(computed, 100.0), SI)
    assert "No value" in words
    assert "8296" in words
    assert "8939" in words


def test_a_coarse_map_stays_while_one_of_its_inputs_is_dragged() -> None:
    first, second = (
        moves.coarse_map(computed_from(SHEET | {"C": clearance}), "C", "load", SI)
        for clearance in (61.0, 62.0)
    )
    assert first is second
    machine = computed_from(SHEET | {"C": 61.0}).machine
    own = design.onset_map(
        machine, x="radial_clearance", xs=first.xs[::9], y="load", ys=first.ys[::9]
    )
    np.testing.assert_allclose(first.speed[::9, ::9], own.speed, rtol=1e-9)


@pytest.mark.parametrize(
    ("key", "here", "dragged", "low", "high"),
    [
        ("C", 60.0, 90.0, 1e-5, 1e-3),
        ("load", 600.0, 1500.0, 100.0, 1e4),
        ("cs", 2000.0, 5000.0, 0.0, 3e4),
    ],
)
def test_an_axis_is_round_and_stays_while_its_input_is_dragged(
    key: str, here: float, dragged: float, low: float, high: float
) -> None:
    for value in (here, dragged):
        axis = moves.quantity(key, computed_from(SHEET | {key: value}).machine, SI)
        assert (axis.low, axis.high) == pytest.approx((low, high))


@pytest.mark.parametrize(
    "key", sorted(INPUTS.keys() - GAS.keys() - {"TR", "rho", "u", "rpm", "rpm_max", "share"})
)
def test_every_input_can_be_varied_over_its_axis(key: str) -> None:
    values = VALUES["damped"]
    # Those of a supply, and the heat that its oil carries, move the onset with a supply only.
    computed = computed_from(values | (other(values) if key in ("T_in", "flow", "cp") else {}))
    axis = moves.quantity(key, computed.machine, SI)
    for end in (axis.low, axis.high):
        field = moves.fields_of(computed.machine)[key]
        varied = variation.varied(computed.machine, {field: end})
        assert variation.value_of(varied, field) == end


MACHINE = PRESETS["sheet-1e8"].machine


@pytest.mark.parametrize("stiffness", [1e5, 1e6], ids=lambda k: f"{k:g} N·m/rad")
def test_thresholds_of_pads_on_flexures_lie_on_the_chart(stiffness):
    pads = TiltingPads(rotational_stiffness=stiffness)
    computed = Computed(
        replace(MACHINE, bearing=replace(MACHINE.bearing, geometry=pads, film=None)),
        6000 * rpm, 12000 * rpm,
    )  # fmt: skip
    for draw in (figures.threshold, figures.whirl_frequency, figures.critical_mass):
        assert_thresholds_are_on(ask.over_speed(draw, computed, SI), computed)


def test_thresholds_of_an_own_table_lie_on_the_chart():
    # Stiff, on a soft shaft: the critical mass falls far below the rotor's.
    speed = np.array([2000.0, 9000.0]) * rpm
    K = np.array([[[2e8, 2e8], [-1e8, 2e8]], [[2e8, 3e8], [-3e8, 4e8]]])
    C = np.array([[[5e5, 0.0], [0.0, 5e5]], [[3e5, 0.0], [0.0, 3e5]]])
    table = CoefficientTable(speed=speed, stiffness=K, damping=C)
    soft = replace(MACHINE, rotor=replace(MACHINE.rotor, shaft_stiffness=1e7), bearing=table)
    computed = Computed(soft, 6000 * rpm, 9000 * rpm)
    for draw in (figures.threshold, figures.whirl_frequency, figures.critical_mass):
        assert_thresholds_are_on(ask.over_speed(draw, computed, SI), computed)


def assert_thresholds_are_on(chart, computed):
    """Assert that half of each line lies on a chart, of speeds those below four times the top."""
    low, high = chart["layout"]["yaxis"]["range"]
    if chart["layout"]["yaxis"]["type"] == "log":
        low, high = 10.0**low, 10.0**high
    lines = [one for one in chart["data"] if "shaft" in one["name"]]
    assert lines
    of_speed = "rpm" in str(chart["layout"]["yaxis"]["title"])
    reaches = of_speed and high >= 4.0 * computed.top_speed / rpm
    for line in lines:
        y = np.asarray(line["y"], dtype=float)
        y = y[np.isfinite(y)]
        assert np.mean((y >= low) & (y <= high)) >= 0.5 or reaches


def test_a_threshold_beyond_the_chart_is_named():
    weak = TiltingPads(rotational_stiffness=3e3)
    machine = replace(MACHINE, bearing=replace(MACHINE.bearing, geometry=weak, film=None))
    chart = ask.over_speed(figures.threshold, Computed(machine, 6000 * rpm, 12000 * rpm), SI)
    high = chart["layout"]["yaxis"]["range"][1]
    beyond = [one for one in chart["data"] if "shaft" in one["name"] and np.nanmin(one["y"]) > high]
    assert beyond
    for line in beyond:
        assert any(text.startswith(f"↑ {line['name']}: from") for text in _texts(chart))


def test_a_tables_rows_are_not_cut_at_the_ends_of_its_chart():
    speed = np.array([100.0, 200.0])
    values = np.array([[[1e8, -3e8], [0.0, 1e8]], [[4e8, 0.0], [0.0, 1e8]]])
    chart = of_table(speed, values, "K", 150.0, SI)
    low, high = chart["layout"]["yaxis"]["range"]
    assert low < -300.0 * 1.02
    assert high > 400.0 * 1.02
