"""Other machines behind a chart's own: named cases, each thin and in a colour of its own.

The chart keeps its colours, which mean quantities, and its thicker lines; a case keeps the dashes
of the lines it repeats. Its name stands once in the legend, whose click hides all that it draws.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotorcalc.figures.style import LIVE_ONLY, Chart, Trace, has_own_ticks, ticks

# Told apart, from each other and from the running speed's mark, with normal and with each kind of
# colour-blind sight; legible on white and on near-black.
COLOURS = (
    "#8c0afa", "#aa503c", "#969678", "#c86ee6", "#825a6e", "#46a0b4", "#aa14d2", "#5a64a0",
)  # fmt: skip

# Height of a row of a legend [px].
_ROW = 26

# The notes' own bearing behind another.
OF_THE_NOTES = "#9a7b62"


@dataclass(frozen=True)
class Case:
    """A named machine's chart, and the colour in which it is drawn behind another's."""

    name: str
    colour: str
    chart: Chart


def with_cases(chart: Chart, cases: Sequence[Case]) -> Chart:
    """Return a chart with the lines and marks of cases behind it, where they differ from its own.

    Parameters
    ----------
    chart : Chart
        The chart in front.
    cases : sequence of Case
        Charts of the same kind.

    Returns
    -------
    Chart
        With axes that include all cases, and the names of those that draw anything in its legend.
    """
    drawn = [_outline(trace) for trace in chart["data"]]
    groups = [group for case in cases if (group := _behind(case, drawn))]
    if not groups:
        return chart
    ghosts = [trace for group in groups for trace in group]
    layout = widened(chart["layout"], [case.chart["layout"] for case in cases])
    own, layout = _legend(chart["data"], layout)
    if _is_narrow(layout["legend"]):
        ghosts, layout = _with_own_legend(ghosts, layout)
    both = {**chart, "data": [*ghosts, *own], "layout": layout}
    if "frames" in chart:  # a frame refers to its traces by index, which those of cases shift
        both["frames"] = [
            {**frame, "traces": [place + len(ghosts) for place in frame["traces"]]}
            for frame in chart["frames"]
        ]
    return both


def _behind(case: Case, drawn: Sequence[tuple[bytes, ...]]) -> list[Trace]:
    """Return what a case draws that is not drawn already, and its name for the legend."""
    ghosts = [
        _ghost(shown, case)
        for trace in case.chart["data"]
        if (shown := _tips(trace))
        and shown.get("meta") != LIVE_ONLY["meta"]
        # Guides to the axes and the like, which mark one machine only.
        and shown.get("hoverinfo") != "skip"
        and _quiet(shown)
        and _outline(trace) not in drawn
    ]
    return [_entry(case), *ghosts] if ghosts else []


def _tips(trace: Trace) -> Trace | None:
    """Return a line as it is, bars as marks at their ends, and nothing else."""
    if trace["type"] == "scatter":
        return trace
    if trace["type"] != "bar":
        return None
    base = trace.get("base")
    along = "x" if trace.get("orientation") == "h" else "y"
    ends = np.asarray(trace[along]) + (0.0 if base is None else base)
    marks = {key: trace[key] for key in ("x", "y", "xaxis", "yaxis", "name") if key in trace}
    return {**marks, along: ends, "type": "scatter", "mode": "markers"}


def _ghost(trace: Trace, case: Case) -> Trace:
    style = {"color": case.colour, "width": 1.3, "dash": trace.get("line", {}).get("dash", "solid")}
    symbol = trace.get("marker", {}).get("symbol", "circle")
    marker = {
        "color": "rgba(0,0,0,0)", "size": 9, "symbol": symbol,
        "line": {"color": case.colour, "width": 1.6},
    }  # fmt: skip
    kept = {key: value for key, value in trace.items() if not key.startswith(("fill", "text"))}
    name = f"{case.name}: {trace.get('name', '')}"
    hover = trace.get("hovertemplate")
    told = (
        {"hovertemplate": hover.replace("<extra></extra>", f"<extra>{name}</extra>")}
        if hover
        else {}
    )
    return {
        **kept, **told, "name": name, "mode": _quiet(trace), "line": style, "marker": marker,
        "showlegend": False, "legendgroup": case.name,
    }  # fmt: skip


def _quiet(trace: Trace) -> str:
    """Return how a trace is drawn, without its texts: one machine's are enough in a chart."""
    return "+".join(part for part in trace["mode"].split("+") if part != "text")


def _entry(case: Case) -> Trace:
    """Return a trace that draws nothing but its line in the legend."""
    return {
        "type": "scatter", "mode": "lines", "x": [None], "y": [None], "name": case.name,
        "line": {"color": case.colour, "width": 2}, "legendgroup": case.name, "showlegend": True,
        "legendrank": 1001,  # after the chart's own lines, which have 1000
        "hoverinfo": "skip",
    }  # fmt: skip


def _legend(traces: Sequence[Trace], layout: Chart) -> tuple[list[Trace], Chart]:
    """Return traces and layout with a legend of the cases, even where the chart has none."""
    # Groups would stand in columns of their own.
    legend: dict[str, Any] = {**layout.get("legend", {}), "traceorder": "normal"}
    layout = {**layout, "legend": legend}
    if layout.get("showlegend", True):
        return list(traces), layout
    return [{**trace, "showlegend": False} for trace in traces], {**layout, "showlegend": True}


def _is_narrow(legend: dict[str, Any]) -> bool:
    """Return whether a legend's entries have a width [px] of their own, which would cut names."""
    return "entrywidth" in legend and legend.get("entrywidthmode") != "fraction"


def _with_own_legend(ghosts: Sequence[Trace], layout: Chart) -> tuple[list[Trace], Chart]:
    """Return traces and layout with the cases' names in a legend of their own below the chart."""
    below = {"orientation": "h", "x": 0, "yref": "container", "y": 0, "yanchor": "bottom"}
    margin = {**layout["margin"], "b": layout["margin"]["b"] + _ROW}
    named = [{**one, "legend": "legend2"} if one.get("showlegend") else one for one in ghosts]
    return named, {**layout, "legend2": below, "margin": margin}


def widened(layout: Chart, others: Sequence[Chart]) -> Chart:
    """Return a layout whose axes include others' ranges, reversed axes staying reversed."""
    axes: Chart = {}
    for name, axis in layout.items():
        if name[1:5] == "axis" and "range" in axis:
            first, last = axis["range"]
            there = [other[name]["range"] for other in others if "range" in other.get(name, ())]
            ends = [first, last, *(end for reach in there for end in reach)]
            low, high = min(ends), max(ends)
            wide = {**axis, "range": [low, high] if first <= last else [high, low]}
            # No closer than a small chart's, whose labels would run into each other.
            most = max(4, len(axis.get("tickvals", ())) - 1)
            axes[name] = wide | (ticks(low, high, most) if has_own_ticks(axis) else {})
    return {**layout, **axes}


def _outline(trace: Trace) -> tuple[bytes, ...]:
    """Return the data of a trace, to see whether another draws the same."""
    return tuple(_bytes(trace.get(key, ())) for key in ("x", "y"))


def _bytes(values: Any) -> bytes:
    array = np.asarray(values)
    # Bars have names on one axis.
    return (array if array.dtype.kind in "US" else array.astype(float)).tobytes()
