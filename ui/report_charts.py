"""The charts of the report: the pages' own, still, and sized for a sheet of paper."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from rotorcalc.figures import Chart, equilibrium, locus, machine, with_baseline
from rotorcalc.figures.units import Units
from ui.view import View

Charts: TypeAlias = dict[str, Chart]

# The width of A4 and of Letter within the report's margins, and of two charts beside each other.
FULL, HALF = 680, 334


@dataclass(frozen=True)
class Figure:
    """A chart of the report: `key` names its place, `draw` takes the machine and the units."""

    key: str
    title: str
    draw: Callable[[View, Units], Chart]
    caption: str
    width: int = FULL
    height: int = 300


SECTIONS: dict[str, tuple[Figure, ...]] = {
    "Static equilibrium": (
        Figure(
            "cross_section", "Bearing",
            lambda v, u: machine.cross_section(v.point, v.film, u),
            "The journal in its bearing, the film's thickness exaggerated; around it the pressure "
            "in the middle plane. Eq. 5.25.",
            HALF, HALF,
        ),
        Figure(
            "locus", "Journal's path",
            lambda v, u: equilibrium.locus(v.curves, v.sweep, v.at_round_speeds, v.point, u),
            "Journal centre in the clearance circle with rising speed. Eqs. 5.7, 5.8.",
            HALF, HALF,
        ),
        Figure(
            "position", "Eccentricity ratio and attitude angle",
            lambda v, u: equilibrium.position_over_speed(v.sweep, v.point, u),
            "Against running speed. Eqs. 5.7, 5.8.", height=340,
        ),
        Figure(
            "film", "Film",
            lambda v, u: equilibrium.film_around(v.film, v.point, u),
            "Thickness, and pressure in the middle plane, at the running speed. Eqs. 5.19, 5.25.",
            height=360,
        ),
        Figure(
            "power", "Power loss", lambda v, u: equilibrium.power_loss(v.sweep, v.point, u),
            "Of one bearing. Calculation sheet.", HALF, 260,
        ),
        Figure(
            "flow", "Side flow", lambda v, u: equilibrium.side_flow(v.sweep, v.point, u),
            "Of one bearing, both ends. Eq. 5.22.", HALF, 260,
        ),
        Figure(
            "thinnest", "Smallest film",
            lambda v, u: equilibrium.minimum_film_thickness(v.sweep, v.point, u),
            "C(1 − ε). Eq. 5.19.", HALF, 260,
        ),
        Figure(
            "torque", "Drag torque", lambda v, u: equilibrium.drag_torque(v.sweep, v.point, u),
            "Of one bearing. Calculation sheet.", HALF, 260,
        ),
    ),
    "Root locus": (
        Figure(
            "plane", "Complex plane",
            lambda v, u: locus.plane(v.locus(True), v.onset, u),
            "Eigenvalues with rising speed, upper half; dotted rays of constant damping ratio.",
            height=440,
        ),
    ),
}  # fmt: skip


def charts(view: View, baseline: View | None, units: Units) -> Charts:
    """Return the report's charts by key, another machine's behind the live one's."""
    return {
        figure.key: _chart(figure, view, baseline, units)
        for figures in SECTIONS.values()
        for figure in figures
    }


def _chart(figure: Figure, view: View, baseline: View | None, units: Units) -> Chart:
    chart = still(figure.draw(view, units))
    if baseline is not None:
        chart = with_baseline(chart, still(figure.draw(baseline, units)))
    layout = chart["layout"]
    size = {"width": figure.width, "height": figure.height, "autosize": False}
    font = {**layout["font"], "size": 12}
    return {"data": chart["data"], "layout": {**layout, **size, "font": font}}


def still(chart: Chart) -> Chart:
    """Return a chart without its speed slider and the traces that this moves."""
    if "frames" not in chart:
        return chart
    moving = chart["frames"][0]["traces"]
    layout = {key: value for key, value in chart["layout"].items() if key != "sliders"}
    margin = {**layout["margin"], "b": 52}
    data = [trace for i, trace in enumerate(chart["data"]) if i not in moving]
    return {"data": data, "layout": {**layout, "margin": margin}}
