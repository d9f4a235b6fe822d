"""What every chart must be: taken by Plotly whole, and with something to see in its window."""

from typing import Any

import numpy as np

from rotorcalc.figures import Case, Chart, figure, with_cases
from rotorcalc.figures.cases import COLOURS
from rotorcalc.figures.style import GREY, LIVE_ONLY


def check_plotly_takes_it(chart: Chart) -> None:
    """Build Plotly's own figure, which raises on any name or value that it does not know.

    It says nothing of an x longer than its y, and draws the shorter of both.
    """
    made = figure(chart)
    assert [trace.type for trace in made.data] == [trace["type"] for trace in chart["data"]]
    for trace in chart["data"]:
        if trace["type"] == "scatter":
            assert np.shape(trace["x"]) == np.shape(trace["y"]), trace["name"]
            assert np.ndim(trace["x"]) == 1, trace["name"]
        if "z" in trace:
            assert np.shape(trace["z"]) == (len(trace["y"]), len(trace["x"])), trace.get("name")


def beside(chart: Chart, other: Chart, name: str = "A") -> Chart:
    """Return a chart with another machine's behind it, as a case."""
    return with_cases(chart, [Case(name, COLOURS[0], other)])


def check_case_is_behind(chart: Chart, other: Chart) -> Chart:
    """Draw another machine's chart behind one, and return both; the two machines must differ."""
    both = beside(chart, other)
    check_plotly_takes_it(both)
    ghosts, live = both["data"][: -len(chart["data"])], both["data"][-len(chart["data"]) :]
    own = {"showlegend"} if chart["layout"].get("showlegend") is False else set[str]()
    assert [_without(trace, own) for trace in live] == [
        _without(trace, own) for trace in chart["data"]
    ]
    lines = [trace for trace in other["data"] if trace["type"] in ("scatter", "bar")]
    entry, *ghosts = ghosts
    assert 0 < len(ghosts) <= len(lines)
    assert entry["name"] == "A"
    assert all(trace["name"].startswith("A: ") for trace in ghosts)
    assert {trace["line"]["color"] for trace in (entry, *ghosts)} == {COLOURS[0]}
    named = [trace["name"] for trace in both["data"] if trace.get("showlegend", True)]
    assert both["layout"].get("showlegend", True)
    assert named.count("A") == 1
    assert named == ["A"] or not own
    for name, axis in chart["layout"].items():
        if name[1:5] == "axis" and "range" in axis:
            ends = *axis["range"], *other["layout"][name]["range"]
            assert sorted(both["layout"][name]["range"]) == [min(ends), max(ends)]
    return both


def _without(trace: dict[str, Any], keys: set[str]) -> dict[str, Any]:
    return {key: value for key, value in trace.items() if key not in keys}


def curves_in_window(chart: Chart) -> list[str]:
    """Return the names of the curves, bars and fields of which the axes' window shows something.

    Marks of the running speed and grey lines (guides, walls) do not count: they are always there.
    """
    return [
        str(trace.get("name", trace["type"]))
        for trace in chart["data"]
        if not trace.get("name", "").startswith("running speed")
        and trace.get("line", {}).get("color") != GREY
        and trace.get("meta") != LIVE_ONLY["meta"]
        and _points_in_window(trace, chart["layout"])
    ]


def notes(chart: Chart) -> list[str]:
    """Return the words in a chart, which say why it is empty where it is."""
    return [note["text"] for note in chart["layout"].get("annotations", ())]


def _points_in_window(trace: dict[str, Any], layout: dict[str, Any]) -> int:
    if "z" in trace:
        return int(np.isfinite(np.asarray(trace["z"], dtype=float)).sum())
    inside = True
    for letter in "xy":
        values = np.asarray(trace[letter])
        if values.dtype.kind not in "fiu":  # categories: bars
            continue
        axis = layout[trace.get(f"{letter}axis", letter).replace(letter, f"{letter}axis", 1)]
        low, high = sorted(axis["range"])
        if axis.get("type") == "log":
            values = np.log10(values, where=values > 0.0, out=np.full(values.shape, np.nan))
        rounding = 1e-9 * (high - low)
        inside = inside & (values >= low - rounding) & (values <= high + rounding)
    return int(np.sum(inside))
