"""Charts of machines within tolerances: onset, margin, what matters most, and how it acts."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.figures import style
from rotorcalc.figures.design import Quantity
from rotorcalc.figures.stability import LEGEND, MARGIN, near
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.figures.text import amount
from rotorcalc.tolerances.study import Tolerance
from rotorcalc.units import Units

_STABLE, _UNSTABLE = style.BLUE, style.UNSTABLE
# Bars of a histogram at least and at most; between, twice the cube root of the samples.
_FEWEST, _MOST = 8, 50
# A running speed is on the axis of onsets where it is at most so many of their widths away.
_WIDTHS = 4.0
# Points of a cloud that a browser draws at once; they are the first of the samples.
_POINTS = 1500


def onset_histogram(found: Tolerance, onset: float, units: Units) -> Chart:
    """Return how the onsets spread, those of unstable machines in red, and the running speed.

    Parameters
    ----------
    found : Tolerance
        The machines drawn.
    onset : float
        Onset of the machine itself, Ω_s [rad/s].
    units : Units
        Units of display.

    Returns
    -------
    Chart
        The chart.
    """
    unit = units.speed
    running, itself = (float(unit.of(speed)) for speed in (found.speed, onset))
    chart = _histogram(
        found, unit.of(found.onset), style.titled("Onset speed", "Ω_on", unit.name), running,
        f"running speed, {amount(unit, found.speed)}",
    )  # fmt: skip
    left, right = chart["layout"]["xaxis"]["range"]
    if left <= itself <= right:
        top = chart["layout"]["yaxis"]["range"][1]
        mark = style.line(
            [itself] * 2, [0.0, top], f"the machine itself, {amount(unit, onset)}", style.GREY,
            dash="dot",
        )  # fmt: skip
        return {**chart, "data": [*chart["data"], mark]}
    return chart


def margin_histogram(found: Tolerance, units: Units) -> Chart:
    """Return how the margin over the running speed spreads, its zero marked."""
    unit = units.percent
    title = style.titled("Margin to onset", "Ω_on/Ω − 1", unit.name)
    return _histogram(found, unit.of(found.margin), title, 0.0, "running speed, no margin")


def _histogram(found: Tolerance, values: Array, title: str, at: float, words: str) -> Chart:
    """Return a histogram of finite values with a line at one place."""
    finite = np.isfinite(values)
    shown, unstable = values[finite], found.unstable[finite]
    edges = _edges(shown) if shown.size else np.array([0.0, 1.0])
    x, arrow = _axis(title, edges, at)
    share = 100.0 / len(values)
    bars = [
        share * np.histogram(shown[which], edges)[0] for which in (~unstable, unstable)
    ]  # fmt: skip
    top = style.ceiling(1.05 * (bars[0] + bars[1]), 1e-9)
    y = style.axis("Share of the machines [%]", 0.0, top)
    traces = [
        _bars(edges, heights, name, colour)
        for heights, name, colour in zip(
            bars, ("stable at the running speed", "unstable at the running speed"),
            (_STABLE, _UNSTABLE), strict=True,
        )
    ]  # fmt: skip
    notes: list[dict[str, Any]] = []
    if arrow:
        left = arrow == "←"
        notes.append(
            style.note(f"{arrow} {words}" if left else f"{words} {arrow}", 0.01 if left else 0.99,
                       0.98, xanchor="left" if left else "right", yanchor="top")
        )  # fmt: skip
    else:
        traces.append(style.line([at, at], [0.0, top], words, style.HERE, width=3))
    if not shown.size:
        notes.append(style.note("no machine has an onset", 0.5, 0.5))
    return style.chart(
        traces, near(x), y, barmode="stack", bargap=0.0, annotations=notes, legend=LEGEND,
        margin=MARGIN,
    )  # fmt: skip


def _edges(values: Array) -> Array:
    """Return the round ends of a histogram's bars, all of one width."""
    low, high = float(values.min()), float(values.max())
    if high - low <= 1e-9 * max(abs(low), abs(high), 1e-300):
        by = max(abs(low), 1.0) * 0.01
        return np.array([low - 1.5 * by, low - 0.5 * by, low + 0.5 * by, low + 1.5 * by])
    bars = min(max(2.0 * len(values) ** (1.0 / 3.0), _FEWEST), _MOST)
    width = style.ceiling((high - low) / bars, steps=(1.0, 2.0, 2.5, 5.0, 10.0))
    return width * np.arange(math.floor(low / width), math.floor(high / width) + 2, dtype=float)


def _axis(title: str, edges: Array, at: float) -> tuple[Axis, str]:
    """Return an axis that holds bars and a place beside them, or an arrow to one too far away."""
    low, high = float(edges[0]), float(edges[-1])
    room, away = 0.04 * (high - low), _WIDTHS * (high - low)
    if low - away <= at <= high + away:
        return style.axis(title, min(low, at) - room, max(high, at) + room), ""
    return style.axis(title, low - room, high + room), "←" if at < low else "→"


def _bars(edges: Array, heights: Array, name: str, colour: str) -> Trace:
    middles = 0.5 * (edges[1:] + edges[:-1])
    return {
        "type": "bar", "x": middles, "y": heights, "width": edges[1] - edges[0], "name": name,
        "marker": {"color": colour, "line": {"width": 0.5, "color": "rgba(255,255,255,0.6)"}},
        "hovertemplate": f"%{{y:.3g}} % {name}<extra></extra>", "showlegend": bool(heights.any()),
    }  # fmt: skip


def ranking(found: Tolerance, names: Mapping[str, str]) -> Chart:
    """Return the first-order indices of the onset with their standard errors, the largest on top.

    Parameters
    ----------
    found : Tolerance
        The machines drawn.
    names : mapping of str to str
        Words for the inputs.

    Returns
    -------
    Chart
        The chart; without bars where the onsets have no variance, or some machine has none.
    """
    known = [one for one in found.influences if not math.isnan(one.index)][::-1]
    places = np.arange(len(known), dtype=float)
    title = style.titled("First-order index of the onset", "S", "-")
    index = np.array([one.index for one in known])
    error = np.array([one.error for one in known])
    bars: Trace = {
        "type": "bar", "orientation": "h", "x": np.maximum(index, 0.0), "y": places, "width": 0.55,
        "marker": {"color": style.BLUE}, "name": "share of the onset's variance",
        "showlegend": False, "hoverinfo": "skip",
        "error_x": {"type": "data", "array": error, "color": style.GREY, "thickness": 2},
    }  # fmt: skip
    notes = [
        {
            "text": f"{max(one.index, 0.0):.2f} ± {max(one.error, 0.005):.2f}", "x": 1.02,
            "y": place, "xanchor": "left", "showarrow": False,
        }
        for place, one in zip(places, known, strict=True)
    ]  # fmt: skip
    none = style.note("no ranking: the onsets have no finite variance", 0.5, 0.5)
    y = style.axis(
        "", -0.6, max(len(known), 1) - 0.4, tickvals=places, showgrid=False,
        ticktext=[names[one.field] for one in known], tickfont={"size": 13},
    )  # fmt: skip
    return style.chart(
        [bars], near(style.axis(title, 0.0, 1.3, tickvals=[0.0, 0.2, 0.4, 0.6, 0.8, 1.0])), y,
        height=96 + 34 * max(len(known), 2), annotations=notes or [none],
        margin={"l": 64, "r": 28, "t": 16, "b": 52},
    )  # fmt: skip


def cloud(found: Tolerance, field: str, quantity: Quantity, units: Units) -> Chart:
    """Return the onsets over one input, a point a machine, and the running speed.

    Parameters
    ----------
    found : Tolerance
        The machines drawn, of which the first are shown.
    field : str
        The input.
    quantity : Quantity
        Its name, symbol and unit.
    units : Units
        Units of display.

    Returns
    -------
    Chart
        The chart.
    """
    unit = units.speed
    x = quantity.unit.of(found.values[:, found.fields.index(field)])[:_POINTS]
    y = unit.of(found.onset)[:_POINTS]
    unstable, finite = found.unstable[:_POINTS], np.isfinite(y)
    running = float(unit.of(found.speed))
    left, right = _ends(x)
    low, high = _ends(y[finite]) if finite.any() else (0.0, 2.0 * running)
    near_by = low - _WIDTHS * (high - low) <= running <= high + _WIDTHS * (high - low)
    if near_by:
        by = 0.05 * (high - low)
        low, high = min(low, running - by), max(high, running + by)
    traces = [
        _points(x[finite & which], y[finite & which], name, colour)
        for which, name, colour in (
            (~unstable, "stable at the running speed", _STABLE),
            (unstable, "unstable at the running speed", _UNSTABLE),
        )
    ]
    if near_by:
        words = f"running speed, {amount(unit, found.speed)}"
        traces.append(style.line([left, right], [running] * 2, words, style.HERE, width=3))
    return style.chart(
        traces,
        near(style.axis(style.titled(quantity.words, quantity.symbol, quantity.unit.name), left,
                        right)),
        style.axis(style.titled("Onset speed", "Ω_on", unit.name), max(low, 0.0), high),
        legend=LEGEND, margin=MARGIN,
    )  # fmt: skip


def _ends(values: Array) -> tuple[float, float]:
    """Return the ends of an axis a little beyond values."""
    low, high = float(values.min()), float(values.max())
    by = 0.04 * (high - low) or 0.01 * max(abs(low), 1.0)
    return low - by, high + by


def _points(x: Array, y: Array, name: str, colour: str) -> Trace:
    return {
        "type": "scatter", "mode": "markers", "x": x, "y": y, "name": name,
        "marker": {"size": 5, "color": colour, "opacity": 0.55}, "showlegend": bool(x.size),
    }  # fmt: skip
