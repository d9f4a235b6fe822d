"""The style of all charts: colours, axes, lines, the mark of the running speed, one template.

A chart is one plain dict of Plotly's figure, built in one go, fifty times faster than `go.Figure`;
`figure` converts it for a notebook. The same quantity always has the same colour; colours keep a
contrast of 3 : 1 on white and on near-black and are distinct for colour-blind readers.
"""

import math
import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

if TYPE_CHECKING:
    import plotly.graph_objects as go  # pyright: ignore[reportMissingTypeStubs]

Chart: TypeAlias = dict[str, Any]
Trace: TypeAlias = dict[str, Any]
Axis: TypeAlias = dict[str, Any]

# Each has a contrast of at least 3 : 1 to a white and to a near-black page.
BLUE, GREEN, PURPLE, OCHRE, RED, GREY = (
    "#2b7bba", "#00916a", "#b0569f", "#a8780a", "#d1541f", "#7d7d7d",
)  # fmt: skip
X, Y = BLUE, GREEN
XX, YY, XY, YX = BLUE, GREEN, PURPLE, OCHRE
JOURNAL, DISK = BLUE, OCHRE
FLEXIBLE, RIGID = BLUE, PURPLE
# What was measured on a machine, beside what is computed of one.
MEASURED = GREEN
# Reserved for instability, on lines, areas and the onset's mark.
UNSTABLE = RED
HERE = "#f0b400"
# Transparent, so that they suit both pages.
FAINT = "rgba(127,127,127,0.28)"
SHADE = "rgba(209,84,31,0.12)"

# Marks a trace, such as an arrowhead, that is not repeated for the cases behind.
LIVE_ONLY: dict[str, Any] = {"meta": "live only"}

# For axes and colour bars: 10000 rpm, not 10k.
PLAIN_NUMBERS: dict[str, Any] = {"exponentformat": "power", "minexponent": 5}

HEIGHT = 420
SMALL_HEIGHT = 260
# Shares of a chart's height for two panes, one above the other.
UPPER, LOWER = [0.55, 1.0], [0.0, 0.45]
# Round ends of an axis within a decade, so close that at most a quarter of it stays empty.
ROUND = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
# For what an axis should closely fit.
CLOSE = (
    1.0, 1.15, 1.3, 1.5, 1.7, 2.0, 2.3, 2.6, 3.0, 3.5, 4.0, 4.5, 5.0, 5.6, 6.4, 7.0, 8.0, 9.0, 10.0,
)  # fmt: skip


def figure(chart: Chart) -> "go.Figure":
    """Return a chart as Plotly's own figure object, for a notebook."""
    # Imported on use: pages draw dicts and never need it, and it is slow to import.
    import plotly.graph_objects as go  # noqa: PLC0415 # pyright: ignore[reportMissingTypeStubs]

    return go.Figure(chart)


def ceiling(
    values: ArrayLike, least: float = 0.0, *, steps: Sequence[float] = ROUND
) -> float:  # fmt: skip
    """Return a round number at or above all finite values, an axis end that seldom changes.

    Round are `steps` within a decade, times a power of ten.
    """
    finite = np.asarray(values, dtype=float)
    finite = finite[np.isfinite(finite)]
    top = max(float(finite.max(initial=0.0)), least)
    if top <= 0.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(top))
    # A maximum that is round already may be off by rounding.
    return next(step * power for step in steps if step * power >= top * (1 - 1e-12))


def eccentricity_axis(values: ArrayLike, **extra: Any) -> Axis:
    """Return an axis of ε: to 1, or further for a journal in a ring, which moves in two films."""
    high = ceiling(values, 1.0)
    return axis(titled("Eccentricity ratio", "ε", "-"), 0.0, high, **(extra if high == 1.0 else {}))


def decades(values: ArrayLike) -> tuple[float, float]:
    """Return the powers of ten at or around all positive finite values, for a logarithmic axis."""
    values = np.asarray(values, dtype=float)
    values = values[np.isfinite(values) & (values > 0.0)]
    low, high = math.floor(np.log10(values.min())), math.ceil(np.log10(values.max()))
    return 10.0**low, 10.0**high


def axis(title: str, low: float, high: float, *, log: bool = False, **extra: Any) -> Axis:
    """Return an axis with a fixed range, in data units also for a logarithmic axis."""
    span = [math.log10(low), math.log10(high)] if log else [low, high]
    if log:
        kind: Axis = {"type": "log", "dtick": 1}
    else:
        kind = {"type": "linear"} | ({} if _TICKS & extra.keys() else ticks(low, high))
    return {"title": {"text": title}, "range": span, **_AXIS, **kind, **extra}


def ticks(low: float, high: float, most: int = 6) -> Axis:
    """Return ticks at round numbers, of which the ends of the axis are some where they are round.

    An axis from zero has one at its end in any case; `most` is the largest number of intervals.
    """
    start, end = sorted((low, high))
    if not 0.0 < end - start < math.inf:
        return {}
    power = 10.0 ** math.floor(math.log10((end - start) / most))
    steps = [
        step
        for step in (factor * power for factor in (1, 2, 5, 10, 20, 2.5, 4, 3, 12.5))
        if 2.0 - 1e-9 <= (end - start) / step <= most + 1e-9
    ]
    fits = (step for step in steps if _divides(step, start) and _divides(step, end))
    step = next(fits, steps[0])
    first, last = math.ceil(start / step - 1e-9), math.floor(end / step + 1e-9)
    # Within the axis: an end that is round but for its last digit would else have no tick.
    values = [min(max(round(i * step, 12), start), end) for i in range(first, last + 1)]
    if start == 0.0 and not _divides(step, end):
        kept = [value for value in values if end - value > 0.6 * step]
        values = [*kept, end]
    return {"tickmode": "array", "tickvals": values}


def _divides(step: float, value: float) -> bool:
    return abs(value / step - round(value / step)) < 1e-6


def line(x: ArrayLike, y: ArrayLike, name: str, colour: str, **extra: Any) -> Trace:
    """Return a line; `dash` and `width` style it, anything else goes to the trace."""
    style = {
        "color": colour, "width": extra.pop("width", 2.2), "dash": extra.pop("dash", "solid"),
        "simplify": False,  # Plotly's simplification leaves visible corners
    }  # fmt: skip
    return {
        "type": "scatter", "mode": "lines", "x": np.asarray(x), "y": np.asarray(y),
        "name": name, "line": style, **extra,
    }  # fmt: skip


def here(
    x: float, y: float, x_axis: Axis, y_axis: Axis, name: str = "running speed"
) -> list[Trace]:
    """Return the mark of the running speed: a point with dashed lines to both axes."""
    left, bottom = _low(x_axis), _low(y_axis)
    guide = line([left, x, x], [y, y, bottom], name, FAINT, dash="dash", width=1.4)
    return [
        guide | {"showlegend": False, "hoverinfo": "skip", "line": guide["line"] | {"color": GREY}},
        mark(x, y, name),
    ]


def lower(traces: Iterable[Trace]) -> list[Trace]:
    """Return traces in the lower of two panes, whose axis is `yaxis2`."""
    return [{**trace, "yaxis": "y2"} for trace in traces]


def mark(x: ArrayLike, y: ArrayLike, name: str, colour: str = HERE, **extra: Any) -> Trace:
    """Return a marker visible on light and dark, by default the running speed's."""
    return {
        "type": "scatter", "mode": "markers", "name": name,
        "x": np.atleast_1d(x), "y": np.atleast_1d(y),
        "marker": {"size": 11, "color": colour, "line": {"color": "#333333", "width": 1.5}},
        "cliponaxis": False,  # drawn whole at the edge of the plot too
        **extra,
    }  # fmt: skip


def arrowhead(x: ArrayLike, y: ArrayLike, name: str, colour: str, size: float = 15.0) -> Trace:
    """Return an arrowhead at the second of two points, which points away from the first."""
    return {
        "type": "scatter", "mode": "markers", "x": np.asarray(x), "y": np.asarray(y), "name": name,
        "showlegend": False, "hoverinfo": "skip",
        "marker": {
            "symbol": "arrow", "angleref": "previous", "size": np.array([0.1, size]),
            "color": colour,
        },
    }  # fmt: skip


def chart(traces: Iterable[Trace], x: Axis, y: Axis, **layout: Any) -> Chart:
    """Return a chart of traces over two axes; `layout` adds to or replaces what charts share."""
    return {"data": list(traces), "layout": {**_LAYOUT, "xaxis": x, "yaxis": y, **layout}}


def themed(chart: Chart, *, dark: bool) -> Chart:
    """Return a chart with its text in the colour for a light or a dark page."""
    font = {**chart["layout"]["font"], "color": _TEXT_ON_DARK if dark else _TEXT}
    return {**chart, "layout": {**chart["layout"], "font": font}}


def small(chart: Chart) -> Chart:
    """Return a chart for an overview: lower, without legend and annotations."""
    overview: Chart = {
        "height": SMALL_HEIGHT,
        "showlegend": False,
        "annotations": [],
        "margin": {"l": 56, "r": 24, "t": 12, "b": 48},
    }
    layout = chart["layout"]
    # What the overview leaves out, for where it is shown large after all.
    left_out = ("showlegend", "annotations", "margin")
    whole = {"showlegend": True} | {key: layout[key] for key in left_out if key in layout}
    axes = {
        name: axis | ticks(*axis["range"], most=4)
        for name, axis in layout.items()
        if name[1:5] == "axis" and has_own_ticks(axis)
    }
    return {
        **chart,
        "layout": {
            **layout, **axes, **overview, "meta": {**layout.get("meta", {}), "whole": whole},
        },
    }  # fmt: skip


def note(text: str, x: float, y: float, **extra: Any) -> dict[str, Any]:
    """Return a short text at a point given in fractions of the plot."""
    return {
        "text": text, "x": x, "y": y, "xref": "paper", "yref": "paper", "showarrow": False, **extra,
    }  # fmt: skip


def has_own_ticks(axis: Axis) -> bool:
    """Return whether an axis has the ticks of `ticks`."""
    return axis.get("tickmode") == "array" and axis["type"] == "linear" and "ticktext" not in axis


def _low(axis: Axis) -> float:
    low = min(axis["range"])
    return 10.0**low if axis["type"] == "log" else low


def symbols(text: str) -> str:
    """Return symbols such as K_ij or ω_s/Ω_s typeset as in an equation.

    Letters are italic, Greek capitals upright, as LaTeX has them; an underscore begins an index.
    Words of more than one letter, such as Re, stay as they are.
    """
    return _SYMBOL.sub(_typeset, text)


def _typeset(match: re.Match[str]) -> str:
    letter, index = match[1], f"<sub>{match[2]}</sub>" if match[2] else ""
    if "Α" <= letter <= "Ω":
        return f"{letter}<i>{index}</i>" if index else letter
    return f"<i>{letter}{index}</i>"


def titled(words: str, symbol: str, unit: str) -> str:
    """Return an axis title, "words symbol [unit]", the symbol typeset."""
    return " ".join(part for part in (words, symbols(symbol), f"[{unit}]") if part)


def legend_below() -> dict[str, Any]:
    """Return a legend below the chart, where it leaves the plot its full width."""
    return {"orientation": "h", "x": 0, "y": -0.22, "yanchor": "top"}


def joined(groups: Sequence[Sequence[Trace]]) -> list[Trace]:
    """Return the traces of several groups as one list."""
    return [trace for group in groups for trace in group]


# One letter, no part of a word, and its index.
_SYMBOL = re.compile(r"(?<![A-Za-z])([A-Za-zΑ-Ωα-ω])(?:_([A-Za-z]+|[0-9]+))?(?![A-Za-z])")
# What an axis says of its ticks itself.
_TICKS = {"dtick", "tickvals", "tickmode", "nticks", "visible"}
_TEXT, _TEXT_ON_DARK = "#20262d", "#e6eaee"
_AXIS: Axis = {
    "gridcolor": "rgba(127,127,127,0.18)",
    "zeroline": False,
    "showline": True,
    "linecolor": "rgba(127,127,127,0.6)",
    "ticks": "outside",
    "tickcolor": "rgba(127,127,127,0.6)",
    "automargin": True,
    **PLAIN_NUMBERS,
}
_LAYOUT: dict[str, Any] = {
    "height": HEIGHT,
    "margin": {"l": 64, "r": 28, "t": 44, "b": 52},
    "paper_bgcolor": "rgba(0,0,0,0)",
    "plot_bgcolor": "rgba(0,0,0,0)",
    "font": {"size": 14, "color": _TEXT, "family": "Source Sans, Arial, sans-serif"},
    "hovermode": "closest",
    "legend": {"orientation": "h", "x": 0, "y": 1.01, "yanchor": "bottom"},
    "uirevision": "keep",
    "separators": ".",  # 10000 rpm, not 10,000
}
