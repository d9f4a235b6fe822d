"""The bearing in cross-section, with journal, equilibrium position and pressure distribution."""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.analysis import Sweep
from rotorcalc.arrays import Array
from rotorcalc.coefficients import PressureField
from rotorcalc.figures import style
from rotorcalc.figures.style import Chart, Trace
from rotorcalc.units import Units

# Clearance over the bore's radius in the exaggerated drawing; to scale it would be invisible.
EXAGGERATED = 0.3
_ANGLES = np.linspace(0.0, 2.0 * np.pi, 181)


def cross_section(
    point: Sweep, film: PressureField, units: Units, *, to_scale: bool = False
) -> Chart:
    """Return the bearing seen along the shaft: X, the load, points down; the journal turns X to Y.

    Parameters
    ----------
    point : Sweep
        The machine at one speed.
    film : PressureField
        The film at that speed; its pressure in the bearing's middle is drawn.
    units : Units
        Units of display.
    to_scale : bool
        Whether to draw the film to scale; otherwise the clearance is drawn as 30 % of the bore.

    Returns
    -------
    Chart
        Lengths in radii of the bore.
    """
    bearing = point.machine.bearing
    C = bearing.radial_clearance
    gap = C / (bearing.radius + C) if to_scale else EXAGGERATED
    centre = point.journal_position / C * gap
    pressure = film.pressure[:, np.argmin(np.abs(film.axial_position))]
    traces = [
        *_pressure(film.theta - film.load_theta, pressure),
        _ring(np.zeros(2), 1.0, "bearing", style.GREY, fill=None),
        _ring(centre, 1.0 - gap, "journal", style.JOURNAL, fill="rgba(43,123,186,0.16)"),
        _line_of_centres(point),
        style.mark(*_drawn(centre), "journal centre", hoverinfo="name"),
    ]
    peak = float(units.pressure.of(point.peak_pressure))
    known = math.isfinite(peak)
    words = f"peak pressure {peak:.3g} {units.pressure.name}" if known else "pressure not known"
    load = float(units.force.of(point.machine.static_load))
    return style.chart(
        traces,
        _hidden(-1.6, 1.6, constrain="domain"),
        _hidden(-1.6, 1.1, scaleanchor="x"),
        annotations=[
            *_load_arrow(load, units),
            *_rotation_arrow(centre, 0.5 * (1.0 - gap)),
            style.note(words, 0.0, 0.0, xanchor="left"),
        ],
        showlegend=False,
        margin={"l": 8, "r": 8, "t": 8, "b": 8},
    )


def _drawn(position: Array) -> tuple[Array, Array]:
    """Return where a position (X, Y) lies on the screen: X down, Y to the right."""
    return position[..., 1], -position[..., 0]


def _circle(radius: ArrayLike, angles: Array) -> Array:
    return np.asarray(radius)[..., None] * np.stack((np.cos(angles), np.sin(angles)), axis=-1)


def _ring(centre: Array, radius: float, name: str, colour: str, *, fill: str | None) -> Trace:
    x, y = _drawn(centre + _circle(radius, _ANGLES))
    filled = {"fill": "toself", "fillcolor": fill} if fill else {}
    return style.line(x, y, name, colour, hoverinfo="name", **filled)


def _pressure(angles: Array, pressure: Array) -> list[Trace]:
    """Return the pressure as a band outside the bore, its height the pressure over its peak."""
    if np.isnan(pressure).any():  # not given by the film's model
        return []
    peak = max(float(np.max(pressure)), 1e-300)  # without load there is no pressure to scale by
    outer = _circle(1.0 + 0.5 * pressure / peak, angles)
    inner = _circle(np.ones_like(angles), angles)[::-1]
    x, y = _drawn(np.concatenate((outer, inner)))
    return [
        style.line(
            x, y, "pressure", style.UNSTABLE, width=1.4,
            fill="toself", fillcolor=style.SHADE, hoverinfo="name",
        )
    ]  # fmt: skip


def _line_of_centres(point: Sweep) -> Trace:
    phi = float(point.attitude_angle)
    ends = np.array([[0.0, 0.0], [np.cos(phi), np.sin(phi)]])
    return style.line(*_drawn(ends), "line of centres", style.GREY, dash="dot", hoverinfo="name")


def _load_arrow(load: float, units: Units) -> list[dict[str, Any]]:
    if load == 0.0:
        return [style.note("no load", 0.5, 0.99)]
    head = {
        "x": 0.0, "y": -0.42, "ax": 0.0, "ay": 0.42, "xref": "x", "yref": "y", "axref": "x",
        "ayref": "y", "text": "", "showarrow": True, "arrowhead": 2, "arrowwidth": 3,
        "arrowcolor": style.GREY,
    }  # fmt: skip
    label = {
        "x": 0.05, "y": 0.36, "text": f"Fₒ {load:.4g} {units.force.name}", "showarrow": False,
        "xanchor": "left",
    }  # fmt: skip
    return [head, label]


def _rotation_arrow(centre: Array, radius: float) -> list[dict[str, Any]]:
    """Return an arrow with the sense of rotation, X to Y: counter-clockwise on the screen."""
    tail, head = centre + _circle(radius, np.radians([205.0, 245.0]))
    (tail_x, head_x), (tail_y, head_y) = (
        tuple(map(float, pair)) for pair in zip(_drawn(tail), _drawn(head), strict=True)
    )
    return [
        {
            "x": head_x, "y": head_y, "ax": tail_x, "ay": tail_y, "xref": "x", "yref": "y",
            "axref": "x", "ayref": "y", "text": "", "showarrow": True, "arrowhead": 2,
            "arrowwidth": 2, "arrowcolor": style.JOURNAL,
        },
        {"x": head_x, "y": head_y, "text": "Ω", "showarrow": False, "xshift": -12, "yshift": -4},
    ]  # fmt: skip


def _hidden(low: float, high: float, **extra: Any) -> dict[str, Any]:
    return style.axis("", low, high, visible=False, **extra)
