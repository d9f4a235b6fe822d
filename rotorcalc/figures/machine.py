"""The bearing in cross-section, with journal, equilibrium position and pressure distribution."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.analysis import Sweep
from rotorcalc.arrays import Array
from rotorcalc.coefficients import PressureField
from rotorcalc.figures import style, text
from rotorcalc.figures.style import Chart, Trace
from rotorcalc.films import film_of
from rotorcalc.units import Units

# Clearance over the bore's radius in the exaggerated drawing; to scale it would be invisible.
EXAGGERATED = 0.3
# Radius of the attitude angle's arc over the journal's.
_ARC = 0.55
_ANGLES = np.linspace(0.0, 2.0 * np.pi, 181)
_AROUND = np.linspace(0.0, 2.0 * np.pi, 361)  # a square bore's corners are among these


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
        Lengths in radii of the bore, where it is widest.
    """
    bore = _Bore.of(point, to_scale=to_scale)
    centre = point.journal_position / point.machine.bearing.radial_clearance * bore.gap
    pressure = film.pressure[:, np.argmin(np.abs(film.axial_position))]
    journal = centre + _circle(bore.journal, _ANGLES)
    traces = [
        *_pressure(film.theta - film.load_theta, pressure, bore),
        _ring(bore.wall(_ANGLES), "bearing", style.GREY, fill=None),
        _ring(journal, "journal", style.JOURNAL, fill="rgba(43,123,186,0.16)"),
        *_attitude(point, bore),
        style.mark(*_drawn(centre), "journal centre", hoverinfo="name"),
    ]
    return style.chart(
        traces,
        _hidden(-2.1, 1.7, constrain="domain"),
        _hidden(-1.6, 1.1, scaleanchor="x"),
        annotations=[
            *_load_arrow(point.machine.static_load),
            *_rotation_arrow(centre, 0.5 * bore.journal),
            *_names(point, bore),
            *_readings(point, film, units),
        ],
        showlegend=False,
        height=330,
        margin={"l": 8, "r": 8, "t": 8, "b": 8},
    )


@dataclass(frozen=True, eq=False)
class _Bore:
    """The bore as it is drawn.

    The journal touches it wherever its centre is on the film's outline, so the wall lies one
    journal's radius beyond the outline: `gap` is the clearance as drawn, `journal` the radius.
    """

    outline: Array
    gap: float
    journal: float

    @classmethod
    def of(cls, point: Sweep, *, to_scale: bool) -> "_Bore":
        bearing = point.machine.bearing
        outline = film_of(bearing).outline(_AROUND)
        widest = float(np.hypot(*outline.T).max())
        C = bearing.radial_clearance
        gap = C / (bearing.radius + widest * C) if to_scale else EXAGGERATED / widest
        return cls(outline, gap, 1.0 - gap * widest)

    def wall(self, angles: Array) -> Array:
        """Return the wall where its normal points in these directions, (n, 2)."""
        normal = _circle(1.0, angles)
        if np.ptp(np.hypot(*self.outline.T)) < 1e-9:  # round, as most are: nothing to look for
            return normal
        touched = self.outline[np.argmax(normal @ self.outline.T, axis=-1)]
        return self.gap * touched + self.journal * normal


def _drawn(position: Array) -> tuple[Array, Array]:
    """Return where a position (X, Y) lies on the screen: X down, Y to the right."""
    return position[..., 1], -position[..., 0]


def _circle(radius: ArrayLike, angles: Array) -> Array:
    return np.asarray(radius)[..., None] * np.stack((np.cos(angles), np.sin(angles)), axis=-1)


def _ring(places: Array, name: str, colour: str, *, fill: str | None) -> Trace:
    x, y = _drawn(np.concatenate((places, places[:1])))
    filled = {"fill": "toself", "fillcolor": fill} if fill else {}
    return style.line(x, y, name, colour, hoverinfo="name", **filled)


def _pressure(angles: Array, pressure: Array, bore: _Bore) -> list[Trace]:
    """Return the pressure as a band outside the bore, its height the pressure over its peak."""
    if np.isnan(pressure).any():  # not given by the film's model
        return []
    peak = max(float(np.max(pressure)), 1e-300)  # without load there is no pressure to scale by
    wall = bore.wall(angles)
    outer = wall + _circle(0.5 * pressure / peak, angles)
    x, y = _drawn(np.concatenate((outer, wall[::-1])))
    return [
        style.line(
            x, y, "pressure", style.UNSTABLE, width=1.4,
            fill="toself", fillcolor=style.SHADE, hoverinfo="name",
        )
    ]  # fmt: skip


def _attitude(point: Sweep, bore: _Bore) -> list[Trace]:
    """Return the line of centres, to the thinnest film, and the attitude angle from the load."""
    phi = float(point.attitude_angle)
    ends = np.array([[0.0, 0.0], [math.cos(phi), math.sin(phi)]])
    arc = _circle(_ARC * bore.journal, np.linspace(0.0, phi, 49))
    return [
        style.line(*_drawn(ends), "line of centres", style.GREY, dash="dot", hoverinfo="name"),
        style.line(*_drawn(arc), "attitude angle", style.PURPLE, width=1.8, hoverinfo="name"),
    ]


def _names(point: Sweep, bore: _Bore) -> list[dict[str, Any]]:
    """Return the names of the attitude angle and of the thinnest film, beside them."""
    phi = float(point.attitude_angle)
    angle = _circle((_ARC + 0.16) * bore.journal, np.array(phi / 2.0))
    thinnest = _circle(1.0, np.array(phi))
    right = bool(thinnest[1] >= 0.0)
    return [
        _label("φ", angle, font={"color": style.PURPLE}),
        _label("h_min", thinnest, xanchor="left" if right else "right", xshift=6 if right else -6),
    ]


def _readings(point: Sweep, film: PressureField, units: Units) -> list[dict[str, Any]]:
    """Return the numbers of the drawing, one below the other at its left edge."""
    C = point.machine.bearing.radial_clearance
    known = math.isfinite(float(point.peak_pressure))
    load = point.machine.static_load
    rows = (
        ("F_o", text.amount(units.force, load) if load else "0, no load"),
        ("φ", text.amount(units.angle, point.attitude_angle).replace(" ", "")),
        ("e", text.amount(units.film, point.eccentricity_ratio * C)),
        ("h_min", text.amount(units.film, film.thickness.min())),
        ("p_max", text.amount(units.pressure, point.peak_pressure) if known else "not known"),
    )
    return [
        style.note(
            f"{style.symbols(name)} = {words}", 0.0, 1.0, xanchor="left", yanchor="top",
            yshift=-22 * i,
        )
        for i, (name, words) in enumerate(rows)
    ]  # fmt: skip


def _label(name: str, place: Array, **extra: Any) -> dict[str, Any]:
    x, y = map(float, _drawn(place))
    return {"text": style.symbols(name), "x": x, "y": y, "showarrow": False, **extra}


def _load_arrow(load: float) -> list[dict[str, Any]]:
    if load == 0.0:
        return []
    head = {
        "x": 0.0, "y": -0.42, "ax": 0.0, "ay": 0.42, "xref": "x", "yref": "y", "axref": "x",
        "ayref": "y", "text": "", "showarrow": True, "arrowhead": 2, "arrowwidth": 3,
        "arrowcolor": style.GREY,
    }  # fmt: skip
    return [head, _label("F_o", np.array([-0.36, 0.0]), xanchor="left", xshift=6)]


def _rotation_arrow(centre: Array, radius: float) -> list[dict[str, Any]]:
    """Return an arrow with the sense of rotation, X to Y: counterclockwise on the screen."""
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
