"""The drawing of the program's conventions: axes, angles and senses, as one chart without axes."""

import math
from typing import Any

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.figures import style
from rotorcalc.figures.style import Chart, Trace

# Dimensions of the drawing; clearance and eccentricity are exaggerated.
_BEARING, _JOURNAL, _ECCENTRICITY, _ATTITUDE = 1.0, 0.64, 0.28, math.radians(40.0)
Item = dict[str, Any]


def conventions() -> Chart:
    """Return a drawing of the journal in its bearing with X, Y, r, t, φ, θ and the load."""
    centre = _at(_ECCENTRICITY, _ATTITUDE)
    thick = _ATTITUDE + math.pi
    traces = [
        _arc(_BEARING, 0.0, 2.0 * math.pi, "bearing", style.GREY, width=4),
        _arc(_JOURNAL, 0.0, 2.0 * math.pi, "journal", style.JOURNAL, width=3, centre=centre),
        _straight((0.0, 0.0), _at(1.5, 0.0), style.X),
        _straight((0.0, 0.0), _at(1.5, math.pi / 2.0), style.Y),
        _straight(_at(1.0, thick), _at(1.32, _ATTITUDE), style.GREY, dash="dash"),
        _arc(1.14, 0.0, _ATTITUDE, "φ", style.OCHRE, width=2.5),
        _arc(0.86, thick, thick + math.radians(75.0), "θ", style.PURPLE, width=2.5),
        _arc(1.16, math.radians(110.0), math.radians(160.0), "Ω", style.RED, width=2.5),
        style.mark(np.array([0.0]), np.array([0.0]), "bearing's centre", style.GREY),
        style.mark(np.array([centre[0]]), np.array([centre[1]]), "journal's centre", style.JOURNAL),
    ]
    arrows = [
        _arrow(_at(1.5, 0.0), 0.0, style.X),
        _arrow(_at(1.5, math.pi / 2.0), math.pi / 2.0, style.Y),
        _arrow(_at(1.32, _ATTITUDE), _ATTITUDE, style.GREY),
        _arrow(_at(1.14, _ATTITUDE), _ATTITUDE + math.pi / 2.0, style.OCHRE, length=0.06),
        _arrow(_at(0.86, thick + math.radians(75.0)), thick + math.radians(165.0), style.PURPLE),
        _arrow(_at(1.16, math.radians(160.0)), math.radians(250.0), style.RED),
        _arrow(_ahead(centre, 0.42), _ATTITUDE + math.pi / 2.0, style.GREY, length=0.42),
        _arrow((centre[0], centre[1] - 0.5), 0.0, style.RED, length=0.5),
    ]
    words = [
        _word("X, along the load", _at(1.58, 0.0), style.X),
        _word("Y", _at(1.58, math.pi / 2.0), style.Y),
        _word("r", _at(1.4, _ATTITUDE)),
        _word("t", _ahead(centre, 0.49)),
        _word("φ", _at(1.25, _ATTITUDE / 2.0), style.OCHRE),
        _word("θ", _at(0.79, thick + math.radians(45.0)), style.PURPLE),
        _word("Ω", _at(1.28, math.radians(135.0)), style.RED),
        _word("e", _at(0.2, _ATTITUDE - 0.55)),
        _word("F_o", (centre[0] + 0.1, centre[1] - 0.3), style.RED),
        _word("θ = 0, thickest film", _at(1.06, thick), anchor="right"),
        _word("θ = π, thinnest film", _at(1.08, _ATTITUDE + 0.16), anchor="left"),
    ]
    bare = {"visible": False, "fixedrange": True}
    x = {**bare, "range": [-1.9, 1.9], "scaleanchor": "y", "constrain": "domain"}
    y = {**bare, "range": [-1.75, 1.35]}
    return style.chart(
        traces, x, y, annotations=[*arrows, *words], showlegend=False, height=520,
        margin={"l": 8, "r": 8, "t": 8, "b": 8},
    )  # fmt: skip


def _at(radius: float, angle: float) -> tuple[float, float]:
    """Return a place of the drawing: X points down, Y right, angles run from X towards Y."""
    return radius * math.sin(angle), -radius * math.cos(angle)


def _ahead(centre: tuple[float, float], length: float) -> tuple[float, float]:
    step = _at(length, _ATTITUDE + math.pi / 2.0)
    return centre[0] + step[0], centre[1] + step[1]


def _arc(radius: float, start: float, stop: float, name: str, colour: str, **extra: Any) -> Trace:
    """Return an arc about `centre`, by default the bearing's."""
    centre: tuple[float, float] = extra.pop("centre", (0.0, 0.0))
    angle: Array = np.linspace(start, stop, 121)
    x, y = centre[0] + radius * np.sin(angle), centre[1] - radius * np.cos(angle)
    return style.line(x, y, name, colour, hoverinfo="skip", **extra)


def _straight(
    start: tuple[float, float], stop: tuple[float, float], colour: str, dash: str = "solid"
) -> Trace:
    ends = np.array([start, stop])
    return style.line(ends[:, 0], ends[:, 1], "", colour, dash=dash, width=2, hoverinfo="skip")


def _arrow(tip: tuple[float, float], angle: float, colour: str, *, length: float = 0.08) -> Item:
    """Return an arrow that ends in `tip` and points in the direction of `angle`."""
    back = _at(length, angle)
    return {
        "x": tip[0], "y": tip[1], "ax": tip[0] - back[0], "ay": tip[1] - back[1],
        "xref": "x", "yref": "y", "axref": "x", "ayref": "y", "text": "", "showarrow": True,
        "arrowhead": 2, "arrowsize": 1.1, "arrowwidth": 2.2, "arrowcolor": colour,
    }  # fmt: skip


def _word(
    text: str, place: tuple[float, float], colour: str | None = None, anchor: str = "center"
) -> Item:
    text = style.symbols(text)
    font = {"size": 16} if colour is None else {"size": 16, "color": colour}
    return {
        "text": text, "x": place[0], "y": place[1], "showarrow": False, "xanchor": anchor,
        "font": font,
    }  # fmt: skip
