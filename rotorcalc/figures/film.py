"""Charts of the film in static equilibrium: thickness, pressure and forces."""

import math
from typing import Any

import numpy as np

from rotorcalc.analysis import Sweep
from rotorcalc.arrays import Array, BoolArray
from rotorcalc.coefficients import FilmForces, PressureField
from rotorcalc.figures import cursor, plane, style, text
from rotorcalc.figures.plane import Part
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.units import Units

HEIGHT = 500

_RADIAL, _TANGENTIAL, _RESULTANT = style.PURPLE, style.OCHRE, style.BLUE
_THICKNESS, _PRESSURE, _PRESSURE_FILL = style.BLUE, style.PURPLE, "rgba(176,86,159,0.16)"
_LOAD = style.symbols("F_o")
_SOFT = "rgba(127,127,127,0.8)"
_CAVITATED = "rgba(127,127,127,0.12)"
_UP_TO_THE_TOP = "up to the top speed"
# The narrowest cavitated film [°] that its words fit in; those of several would overlap.
_ROOM = 100.0


def film_around(field: PressureField, point: Sweep, units: Units) -> Chart:
    """Return the film's thickness and its pressure in the middle plane around the journal.

    Thinnest film and highest pressure are marked; without load both are undefined.
    """
    theta, h = units.angle.of(field.theta), units.film.of(field.thickness)
    middle = int(np.argmin(np.abs(field.axial_position)))
    p = units.pressure.of(field.pressure[:, middle])
    thinnest = int(np.argmin(h))
    peak = float(units.angle.of(field.peak_theta))
    top = float(units.pressure.of(point.peak_pressure))
    C = float(units.film.of(point.machine.bearing.radial_clearance))
    x = _around(field, anchor="y2")
    y = style.axis(
        style.titled("Film", "h", units.film.name), 0.0, style.ceiling(2.05 * C),
        domain=style.UPPER,
    )  # fmt: skip
    y2 = style.axis(
        style.titled("Pressure", "p", units.pressure.name), _floor(p), style.ceiling(top),
        domain=style.LOWER,
    )  # fmt: skip
    traces = [
        style.line(
            theta, h, "film thickness", _THICKNESS,
            hovertemplate=text.hover("θ = %{x:.0f}°", units.film),
        ),
        style.line(
            theta, p, "pressure", _PRESSURE, yaxis="y2", fill="tozeroy", fillcolor=_PRESSURE_FILL,
            hovertemplate=text.hover("θ = %{x:.0f}°", units.pressure),
        ),
    ]  # fmt: skip
    if _has_shape(field, point):
        traces += [
            *style.here(theta[thinnest], h[thinnest], x, y, "thinnest film"),
            *style.lower(style.here(peak, top, x, y2, "highest pressure")),
        ]
    notes = _over_theta(field, point, units, level=0.3)
    return style.chart(traces, x, y, yaxis2=y2, height=HEIGHT, showlegend=False, **notes)


def pressure_map(field: PressureField, point: Sweep, units: Units) -> Chart:
    """Return the pressure over the unwrapped bearing, p(θ, z), as a contour map."""
    z = units.length.of(field.axial_position)
    edge, high = style.ceiling(z), style.ceiling(units.pressure.of(point.peak_pressure))
    p = np.where(field.cavitated[:, None], np.nan, units.pressure.of(field.pressure))
    # A tenth of the scale a contour, from zero up and down.
    step = high / 10
    low = step * math.floor(_lowest(p) / step)
    once = slice(None, -1)  # 360° repeats 0°
    x = _around(field)
    y = style.axis(style.titled("Axial position", "z", units.length.name), -edge, edge)
    title = style.titled("Pressure", "p", units.pressure.name)
    contour: Trace = {
        "type": "contour", "name": "pressure", "x": units.angle.of(field.theta[once]), "y": z,
        "z": p[once].T.astype(np.float32),  # single precision halves the message
        "zmin": low, "zmax": high, "colorscale": "Cividis", "line": {"width": 0.4},
        "contours": {"start": low, "end": high, "size": step},
        "colorbar": {"title": {"text": title, "side": "right"}, "thickness": 14, "outlinewidth": 0,
                     **style.PLAIN_NUMBERS},
        "hovertemplate": f"θ = %{{x:.0f}}°<br>z = %{{y:.3g}} {units.length.name}<br>"
        f"%{{z:.3g}} {units.pressure.name}<extra></extra>",
    }  # fmt: skip
    peak = style.here(float(units.angle.of(field.peak_theta)), 0.0, x, y, "highest pressure")
    traces = [contour, *peak] if _has_shape(field, point) else []
    notes = _over_theta(field, point, units, level=0.5)
    return style.chart(traces, x, y, height=HEIGHT, showlegend=False, **notes)


def forces(
    curves: FilmForces, at: FilmForces, sweep: Sweep, point: Sweep, units: Units
) -> Chart:  # fmt: skip
    """Return the film's forces over ε at the running speed (Fig. 5.2), and the load on them."""
    eps, load = curves.eccentricity_ratio, float(units.force.of(at.total))
    usual = (eps > 0.02) & (eps < 0.8)
    # A film under high pressure at the supply may carry all its loads close to the centre.
    within = units.force.of(curves.total[usual] if usual.any() else curves.total)
    # The radial part vanishes with ε²: two decades below the load it may leave the chart.
    low_part = max(float(units.force.of(-at.radial)), load / 100)
    low, high = style.decades([within.min(), within.max(), load, low_part])
    x = style.eccentricity_axis(eps, dtick=0.2)
    y = style.axis(style.titled("Film force", "F", units.force.name), low, high, log=True)
    hover = text.hover("ε = %{x:.4f}", units.force)
    traces = [
        style.line(eps, units.force.of(force), name, colour, hovertemplate=hover)
        for force, name, colour in (
            (curves.total, f"resultant {style.symbols('F')}", _RESULTANT),
            (curves.tangential, f"tangential {style.symbols('F_t')}", _TANGENTIAL),
            (-curves.radial, f"radial −{style.symbols('F_r')}", _RADIAL),
        )
    ]
    if load == 0.0:
        note = text.remark("no load: the film force is zero", 0.98, 0.03)
        return style.chart(traces, x, y, height=HEIGHT, annotations=[note])
    e, parts = float(at.eccentricity_ratio), units.force.of(np.array([at.tangential, -at.radial]))
    marker = {"size": 9, "color": [_TANGENTIAL, _RADIAL], "line": {"color": style.HERE, "width": 2}}
    traces += [
        style.line(x["range"], [load, load], f"load {_LOAD}", _SOFT, width=1.6, dash="dot"),
        style.mark(
            [e, e], parts, "components", marker=marker, showlegend=False, hovertemplate=hover
        ),
        *style.here(e, load, x, y),
    ]
    chart = style.chart(traces, x, y, height=HEIGHT)
    return cursor.over_film(chart, sweep, point, units, "ε")


def force_balance(at: FilmForces, sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return load and film forces as a closed triangle, in units of the load (Eq. 5.4).

    Over speed its corner moves along a half circle over the load: the angle there is right.
    """
    x = style.axis(f"Force along {style.symbols('Y')}, in {_LOAD} →", -0.55, 0.95, dtick=0.5)
    y = style.axis(f"← Force along {style.symbols('X')}, in {_LOAD}", 1.15, -0.25, dtick=0.5)
    load = float(at.total)
    if load == 0.0:
        note = text.remark("no load: there is no force to balance", 0.5, 0.5, xanchor="center")
        return plane.chart([], x, y, height=HEIGHT, annotations=[note])
    phi = float(point.attitude_angle)
    start, end, corner = (0.0, 0.0), (1.0, 0.0), plane.at(phi, -float(at.radial) / load)
    sides = (
        (start, end, f"load {_LOAD}", style.GREY, load),
        (end, corner, f"tangential {style.symbols('F_t')}", _TANGENTIAL, float(at.tangential)),
        (corner, start, f"radial {style.symbols('F_r')}", _RADIAL, float(at.radial)),
    )
    half_circle = plane.arc(0.0, math.pi, 0.5) + np.array([0.5, 0.0])
    hidden: Part = {"showlegend": False, "hoverinfo": "skip"}
    traces = [
        plane.line(half_circle, "any speed", _SOFT, width=1.4, dash="dot", **hidden),
        _corners(sweep, units),
        *(
            plane.line(
                [tail, tip], f"{name} = {text.amount(units.force, size)}", colour,
                width=3, hoverinfo="name",
            )
            for tail, tip, name, colour, size in sides
        ),
        *(
            style.arrowhead((tail[1], tip[1]), (tail[0], tip[0]), name, colour)
            for tail, tip, name, colour, _ in sides
        ),
        style.mark(corner[1], corner[0], "running speed", **hidden),
    ]  # fmt: skip
    chart = plane.chart(traces, x, y, height=HEIGHT, showlegend=True)
    return cursor.over_speed(chart, point.speed, units, along=_UP_TO_THE_TOP)


def _corners(sweep: Sweep, units: Units) -> Trace:
    """Return the triangle's corner over the speeds of a sweep, with the speed at each place."""
    phi, speed = sweep.attitude_angle, units.speed.of(sweep.speed)
    # In equilibrium the radial force is −Fₒ cos φ.
    places = np.cos(phi)[:, None] * np.stack([np.cos(phi), np.sin(phi)], axis=-1)
    hover = f"%{{customdata:.0f}} {units.speed.name}<extra></extra>"
    extra: Part = {"customdata": speed, "hovertemplate": hover, "showlegend": False}
    return plane.line(places, _UP_TO_THE_TOP, _SOFT, width=3.5, **extra)


def _over_theta(field: PressureField, point: Sweep, units: Units, *, level: float) -> Part:
    """Return the common parts of charts over θ: the load's direction and the cavitated film."""
    if not _has_shape(field, point):
        words = "no load: uniform film, no pressure"
        return {"annotations": [text.remark(words, 0.5, level, xanchor="center")]}
    notes, shapes = _load_line(field, point, units)
    for a, b in _cavitated(field):
        shapes.append(
            _upright(a, b, type="rect", fillcolor=_CAVITATED, line={"width": 0}, layer="below")
        )
        if b - a >= _ROOM:
            words = "cavitated:<br>ambient pressure"
            notes.append(style.note(words, (a + b) / 2, level, xref="x", font={"size": 12}))
    return {"annotations": notes, "shapes": shapes}


def has_narrow_cavitation(field: PressureField) -> bool:
    """Return whether the film's cavitated parts are all too narrow for words."""
    return 0.0 < max((b - a for a, b in _cavitated(field)), default=0.0) < _ROOM


def _cavitated(field: PressureField) -> list[tuple[float, float]]:
    """Return between which angles [°] the film is cavitated."""
    theta, last = np.degrees(field.theta), len(field.theta) - 1
    return [
        (float(theta[max(first - 1, 0)]), float(theta[min(end + 1, last)]))
        for first, end in _runs(field.cavitated)
    ]


def _has_shape(field: PressureField, point: Sweep) -> bool:
    """Return whether film or pressure is not uniform: by a load, pads, or recesses."""
    uneven = np.ptp(field.thickness) > 0.0 or bool(np.any(field.pressure != 0.0))
    return point.machine.static_load > 0.0 or bool(uneven)


def _floor(pressure: Array) -> float:
    """Return the lower end of an axis of pressures: zero, but for a film under suction."""
    lowest = _lowest(pressure)
    return -style.ceiling(-lowest) if lowest < 0.0 else 0.0


def _lowest(pressure: Array) -> float:
    """Return the lowest pressure, at most ambient; rounding makes no suction."""
    lowest, highest = float(np.nanmin(pressure)), float(np.nanmax(pressure))
    return lowest if lowest < -1e-9 * highest else 0.0


def _load_line(field: PressureField, point: Sweep, units: Units) -> tuple[list[Part], list[Part]]:
    """Return name and line of the load's direction."""
    load, at = point.machine.static_load, float(units.angle.of(field.load_theta))
    if load == 0.0:
        return [], []
    above: Part = {"xref": "x", "yanchor": "bottom", "font": {"size": 13}}
    dotted: Part = {"type": "line", "line": {"color": _SOFT, "width": 1.6, "dash": "dot"}}
    note = style.note(f"load, {text.amount(units.force, load)}", at, 1.0, **above)
    return [note], [_upright(at, at, **dotted)]


def _around(field: PressureField, **extra: Any) -> Axis:
    """Return the axis of θ, which begins opposite to the line of centres."""
    h = field.thickness
    thickest = bool(h[0] >= np.nanmax(h) * (1 - 1e-12))
    start = "the thickest film" if thickest else "opposite the line of centres"
    return style.axis(f"{style.symbols('θ')} from {start} [°]", 0.0, 360.0, dtick=60, **extra)


def _upright(left: float, right: float, **extra: Any) -> Part:
    """Return a shape over the whole height of the plot."""
    return {
        "xref": "x", "yref": "paper", "x0": left, "x1": right, "y0": 0, "y1": 1,
        **extra,
    }  # fmt: skip


def _runs(flags: BoolArray) -> list[tuple[int, int]]:
    """Return first and last index of each run of set flags."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], flags, [False]))))
    return [(int(first), int(after) - 1) for first, after in edges.reshape(-1, 2)]
