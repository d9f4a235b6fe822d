"""Cases behind a chart: thin, in their own colours, named in the legend; and the colours."""

import itertools

import numpy as np
import pytest

from rotorcalc.figures import Case, style, with_cases
from rotorcalc.figures.cases import COLOURS
from tests.figures.charts import beside, check_plotly_takes_it


def drawn(top, **layout):
    x, y = style.axis("x [-]", 0.0, 10.0), style.axis("y [-]", 0.0, style.ceiling(top))
    traces = [
        style.line([0.0, 10.0], [0.0, top], "line", style.BLUE, dash="dash", fill="tozeroy"),
        *style.here(5.0, top / 2, x, y),
    ]
    return style.chart(traces, x, y, **layout)


def test_a_case_stands_behind_thin_and_stays_in_the_picture():
    chart = beside(drawn(1.0), drawn(7.5))
    entry, line, mark, *own = chart["data"]
    assert (entry["name"], line["name"], mark["name"]) == ("A", "A: line", "A: running speed")
    assert [trace["name"] for trace in own] == ["line", "running speed", "running speed"]
    assert line["line"]["width"] < own[0]["line"]["width"]
    assert line["line"]["dash"] == "dash"
    assert "fill" not in line
    assert chart["layout"]["yaxis"]["range"] == [0.0, 8.0]
    check_plotly_takes_it(chart)


def test_each_case_has_its_own_name_and_colour_and_all_stay_in_the_picture():
    cases = [Case(name, COLOURS[i], drawn(2.0 + i)) for i, name in enumerate("ABC")]
    chart = with_cases(drawn(1.0), cases)
    named = {t["name"]: t["line"]["color"] for t in chart["data"] if t["name"] in list("ABC")}
    assert named == dict(zip("ABC", COLOURS, strict=False))
    assert chart["layout"]["yaxis"]["range"] == [0.0, 4.0]
    assert {t["legendgroup"] for t in chart["data"] if ": " in t["name"]} == set("ABC")


def test_a_case_that_draws_the_same_is_neither_drawn_nor_named():
    chart = drawn(1.0)
    assert beside(chart, drawn(1.0)) is chart


def test_a_chart_without_a_legend_names_the_cases_alone():
    chart = beside(drawn(1.0, showlegend=False), drawn(2.0, showlegend=False))
    assert chart["layout"]["showlegend"]
    assert [t["name"] for t in chart["data"] if t.get("showlegend", True)] == ["A"]


def test_a_small_chart_keeps_its_few_ticks_over_a_case():
    chart = beside(style.small(drawn(5.0)), style.small(drawn(6.0)))
    assert chart["layout"]["yaxis"]["range"] == [0.0, 6.0]
    assert chart["layout"]["yaxis"]["tickvals"] == [0.0, 2.0, 4.0, 6.0]


def test_names_of_cases_are_not_cut_by_a_legend_of_narrow_entries():
    narrow = {"orientation": "h", "entrywidth": 28}
    for legend, place in ((narrow, "legend2"), (narrow | {"entrywidthmode": "fraction"}, None)):
        chart = beside(drawn(1.0, legend=legend), drawn(2.0, legend=legend))
        entry = chart["data"][0]
        assert (entry["name"], entry.get("legend")) == ("A", place)
        assert ("legend2" in chart["layout"]) == (place is not None)
        assert all("legend" not in trace for trace in chart["data"][1:])
        check_plotly_takes_it(chart)


def test_bars_of_a_case_are_marks_at_their_ends():
    def bars(height):
        chart = drawn(1.0)
        bar = {"type": "bar", "x": np.arange(2.0), "y": np.full(2, height), "base": [0.0, 1.0]}
        return {**chart, "data": [bar | {"name": "bar", "marker": {"color": style.RED}}]}

    _, ghost, _ = beside(bars(1.0), bars(2.0))["data"]
    assert ghost["mode"] == "markers"
    assert ghost["y"].tolist() == [2.0, 3.0]


def test_texts_of_a_case_are_left_out_and_its_hover_names_it():
    def labelled(top):
        chart = drawn(top)
        chart["data"][0] |= {
            "mode": "lines+text", "text": ["a", "b"], "hovertemplate": "%{y}<extra></extra>",
        }  # fmt: skip
        return chart

    line = beside(labelled(1.0), labelled(2.0))["data"][1]
    assert line["mode"] == "lines"
    assert "text" not in line
    assert line["hovertemplate"] == "%{y}<extra>A: line</extra>"


def test_an_axis_that_runs_down_still_runs_down_over_a_case():
    def down(low):
        chart = drawn(1.0)
        chart["layout"]["yaxis"] = style.axis("y", 1.0, low)
        chart["data"][0]["y"] = np.array([0.0, low])
        return chart

    assert beside(down(-1.0), down(-3.0))["layout"]["yaxis"]["range"] == [1.0, -3.0]


# Machado, Oliveira, Fernandes (2009), A physiologically-based model for simulation of color vision
# deficiency, severity 1, on linear RGB.
SIGHTS = {
    "normal": np.eye(3),
    "protanopia": np.array([
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ]),
    "deuteranopia": np.array([
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ]),
    "tritanopia": np.array([
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.303900],
    ]),
}  # fmt: skip
# sRGB (IEC 61966-2-1) to XYZ, and its white, D65.
_XYZ = np.array([
    [0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505],
])  # fmt: skip


def linear(colour: str) -> np.ndarray:
    share = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255
    return np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)


def lab(light: np.ndarray) -> np.ndarray:
    """Return CIE L*a*b* of linear RGB."""
    part = _XYZ @ np.clip(light, 0.0, 1.0) / _XYZ.sum(axis=1)
    f = np.where(part > (6 / 29) ** 3, np.cbrt(part), part * (29 / 6) ** 2 / 3 + 4 / 29)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("sight", SIGHTS)
def test_colours_of_cases_are_told_apart_with_every_sight(sight: str) -> None:
    """Ten times the just noticeable difference of 2.3, all but one."""
    seen = [lab(SIGHTS[sight] @ linear(colour)) for colour in (*COLOURS, style.HERE)]
    assert min(np.linalg.norm(a - b) for a, b in itertools.combinations(seen, 2)) > 20.0


@pytest.mark.parametrize("page", ["#ffffff", "#14181d"])
def test_colours_of_cases_are_legible_on_both_pages(page: str) -> None:
    """WCAG 1.4.11: a contrast of 3 for what is drawn."""
    for colour in COLOURS:
        dark, light = sorted(float(_XYZ[1] @ linear(one)) for one in (colour, page))
        assert (light + 0.05) / (dark + 0.05) >= 3.0, colour
