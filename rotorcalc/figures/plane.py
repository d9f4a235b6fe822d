"""Drawing in the plane across the shaft: X, the load's direction, down, and Y to the right.

So a journal that turns X→Y turns counterclockwise. Points are (X, Y), angles run from X towards Y.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array
from rotorcalc.figures import style
from rotorcalc.figures.style import Axis, Chart, Trace

Part = dict[str, Any]


def chart(traces: list[Trace], x: Axis, y: Axis, **layout: Any) -> Chart:
    """Return a chart of the plane, both axes in one scale; Y runs along `x`, X down along `y`."""
    x = {**x, "scaleanchor": "y", "constrain": "domain"}
    y = {**y, "constrain": "domain"}
    return style.chart(traces, x, y, **{"showlegend": False, **layout})


def at(angle: float, radius: float) -> tuple[float, float]:
    """Return a place from its angle and its distance from the centre."""
    return radius * math.cos(angle), radius * math.sin(angle)


def line(places: ArrayLike, name: str, colour: str, **extra: Any) -> Trace:
    """Return a line through places, shape (n, 2)."""
    places = np.asarray(places, dtype=float)
    return style.line(places[:, 1], places[:, 0], name, colour, **extra)


def arc(start: float, end: float, radius: float) -> Array:
    """Return the places of an arc about the centre."""
    angle = np.linspace(start, end, 49)  # 7.5° a chord over a full turn, no corner to be seen
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def label(text: str, place: ArrayLike, *, size: int = 14, **extra: Any) -> Part:
    """Return a text at a place."""
    X, Y = np.asarray(place, dtype=float)
    return {
        "text": text, "x": float(Y), "y": float(X), "xref": "x", "yref": "y", "showarrow": False,
        "font": {"size": size}, **extra,
    }  # fmt: skip


def arrow(tail: tuple[float, float], tip: tuple[float, float], colour: str) -> Part:
    """Return an arrow between two places."""
    return {
        "text": "", "showarrow": True, "x": tip[1], "y": tip[0], "ax": tail[1], "ay": tail[0],
        "xref": "x", "yref": "y", "axref": "x", "ayref": "y",
        "arrowhead": 2, "arrowsize": 1.1, "arrowwidth": 2.5, "arrowcolor": colour,
    }  # fmt: skip


def circle(radius: float) -> Part:
    """Return a circle about the centre, behind all lines."""
    return {
        "type": "circle", "x0": -radius, "x1": radius, "y0": -radius, "y1": radius,
        "line": {"color": style.GREY, "width": 2}, "layer": "below",
    }  # fmt: skip


def outline(places: ArrayLike) -> Part:
    """Return a closed line through places, shape (n, 2), behind all lines; a circle as one."""
    radius = np.hypot(*np.asarray(places, dtype=float).T)
    if np.ptp(radius) < 1e-9 * radius[0]:
        return circle(float(radius[0]))
    points = "L".join(f"{Y:.5g},{X:.5g}" for X, Y in np.asarray(places, dtype=float))
    return {
        "type": "path", "path": f"M{points}Z", "line": {"color": style.GREY, "width": 2},
        "layer": "below",
    }  # fmt: skip


def dot(place: ArrayLike, colour: str) -> Part:
    """Return a small mark at a place, in front of all lines."""
    X, Y = np.asarray(place, dtype=float)
    r = 0.025
    return {
        "type": "circle", "x0": float(Y - r), "x1": float(Y + r), "y0": float(X - r),
        "y1": float(X + r), "fillcolor": colour, "line": {"color": "#ffffff", "width": 1},
    }  # fmt: skip


def stroke(tail: tuple[float, float], tip: tuple[float, float]) -> Part:
    """Return a faint straight line, behind all lines."""
    return {
        "type": "line", "x0": tail[1], "y0": tail[0], "x1": tip[1], "y1": tip[0],
        "line": {"color": style.FAINT, "width": 1.2}, "layer": "below",
    }  # fmt: skip


def turning(start: float, end: float, radius: float) -> list[Part]:
    """Return the arc of an arrow that shows a sense of rotation; `turning_head` is its head."""
    path = "L".join(f"{Y:.4f},{X:.4f}" for X, Y in arc(start, end, radius))
    return [{"type": "path", "path": f"M{path}", "line": {"color": style.GREY, "width": 2.5}}]


def turning_head(end: float, radius: float) -> Part:
    """Return the head of the arrow that `turning` draws."""
    return arrow(at(end - 0.06, radius), at(end + 0.06, radius), style.GREY)
