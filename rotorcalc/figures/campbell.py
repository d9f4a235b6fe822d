"""The Campbell diagram: frequencies of the modes over running speed, forward and backward."""

from typing import Any

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.criteria.campbell import Campbell
from rotorcalc.figures import cursor, style
from rotorcalc.figures.modes import COLOURS
from rotorcalc.figures.style import Chart, Trace, titled
from rotorcalc.units import Units

# A mode of a larger log decrement hardly oscillates (ζ above 0.7); others decide the window.
_HARDLY_SWINGS = 6.16
# Frequencies up to this share of the top speed are shown.
_SHOWN = 1.1


def diagram(found: Campbell, units: Units, *, running_speed: float) -> Chart:
    """Return the Campbell diagram: forward modes solid, backward ones broken, unstable parts red.

    Parameters
    ----------
    found : Campbell
        The modes over speed.
    units : Units
        The reader's units.
    running_speed : float
        Ω [rad/s], where the chart has its mark.

    Returns
    -------
    Chart
        With the lines ω = Ω and ω = Ω/2, and diamonds where a mode meets the first.
    """
    speed = units.speed.of(found.speed)
    x, now = cursor.speed_axis(found.speed, units), float(units.speed.of(running_speed))
    y = style.axis(titled("Mode frequency", "ω", units.speed.name), 0.0, _top(found, units))
    traces = [
        _order(speed, 1.0, style.symbols("ω = Ω"), "dot"),
        _order(speed, 0.5, style.symbols("ω = Ω/2") + ", whirl line", "dash"),
        *(trace for i in range(found.frequency.shape[1]) for trace in _mode(found, i, units)),
        *_crossings(found, units, y["range"][1]),
        style.mark(now, now, "running speed"),
    ]
    chart = style.chart(
        _named_once(traces, "unstable"), x, y,
        shapes=[_at(running_speed, units)], margin={"l": 64, "r": 28, "t": 64, "b": 52},
    )  # fmt: skip
    return cursor.over_speed(chart, running_speed, units)


def _top(found: Campbell, units: Units) -> float:
    """Return a round frequency above those of the modes that whirl below the top speed."""
    top = float(found.speed[-1])
    swings = (found.log_decrement < _HARDLY_SWINGS) & (found.frequency <= _SHOWN * top)
    return style.ceiling(units.speed.of(found.frequency[swings]), units.speed.of(0.5 * top).item())


def _order(speed: Array, share: float, name: str, dash: str) -> Trace:
    return style.line(speed, share * speed, name, style.GREY, dash=dash, width=1.4)


def _mode(found: Campbell, i: int, units: Units) -> list[Trace]:
    """Return one mode's line: its forward part, its backward part, and where it grows."""
    forward, swings = found.forward[:, i], np.isfinite(found.frequency[:, i])
    name, colour = f"mode {i + 1}", COLOURS[i % len(COLOURS)]
    grows = found.log_decrement[:, i] < 0.0
    parts = [
        (forward, _line(found, i, f"{name}, forward", colour, units)),
        (swings & ~forward, _line(found, i, f"{name}, backward", colour, units, dash="dashdot")),
        (grows, _line(found, i, "unstable", style.UNSTABLE, units, width=4.0)),
    ]
    return [
        {**line, "y": np.where(taken, line["y"], np.nan)} for taken, line in parts if np.any(taken)
    ]


def _line(
    found: Campbell, i: int, name: str, colour: str, units: Units, **extra: Any
) -> Trace:  # fmt: skip
    """Return a mode's frequency over speed."""
    speed = units.speed
    hover = f"Ω %{{x:.0f}}<br>ω %{{y:.0f}}<br>δ %{{customdata:.3g}}<extra>{name}</extra>"
    return style.line(
        speed.of(found.speed), speed.of(found.frequency[:, i]), name, colour,
        customdata=found.log_decrement[:, i], hovertemplate=hover, **extra,
    )  # fmt: skip


def _named_once(traces: list[Trace], name: str) -> list[Trace]:
    """Return traces of which only the first of a name is in the legend."""
    places = [i for i, trace in enumerate(traces) if trace["name"] == name]
    return [
        {**trace, "showlegend": False} if i in places[1:] else trace
        for i, trace in enumerate(traces)
    ]


def _crossings(found: Campbell, units: Units, top: float) -> list[Trace]:
    """Return marks where a mode's frequency is the running speed."""
    place = units.speed.of(found.crossing_speed)
    place = place[place <= top]
    if not place.size:
        return []
    mark = style.mark(place, place, style.symbols("ω = Ω") + ": critical speed", style.GREY)
    return [{**mark, "marker": {**mark["marker"], "symbol": "diamond"}}]


def _at(running_speed: float, units: Units) -> dict[str, Any]:
    place = float(units.speed.of(running_speed))
    return {
        "type": "line", "yref": "paper", "x0": place, "x1": place, "y0": 0, "y1": 1,
        "line": {"color": style.HERE, "width": 1.6}, "layer": "below",
    }  # fmt: skip
