"""Charts of the static equilibrium: journal position, power loss, side flow and friction."""

import itertools
import math
from dataclasses import dataclass

import numpy as np

from rotorcalc.analysis import FilmCurves, Sweep
from rotorcalc.arrays import Array
from rotorcalc.coefficients import Equilibrium
from rotorcalc.display import Result
from rotorcalc.figures import cursor, plane, style, text
from rotorcalc.figures.plane import Part
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.units import Unit, Units

HEIGHT = 500
SMALL_HEIGHT = 300

_SOFT = "rgba(127,127,127,0.8)"
_MARGIN = {"l": 64, "r": 28, "t": 26, "b": 48}
# Half the width of the drawn plane, in radial clearances.
_EDGE = 1.24
# Labels of speeds closer together than this share of the clearance's reach would overlap.
_SPACING = 0.17
_UP_TO_THE_TOP = "up to the top speed"
# X/C below which the path has turned so far down that labels stand beside it, not above.
_LOW = 0.55
# The arrow that shows the sense of rotation: its ends [rad] and its radius over that reach.
_TURN = (1.9, 2.45, 1.08)


@dataclass(frozen=True, eq=False)
class Path(Result):
    """Where a journal sits: at any speed, over a sweep, at round speeds; and where the wall is.

    `outline` has the places of the journal's centre at the wall, in radial clearances.
    """

    curves: FilmCurves
    sweep: Sweep
    marks: Equilibrium
    outline: Array


def locus(path: Path, point: Sweep, units: Units) -> Chart:
    """Return the journal's path in its clearance, traced by speed."""
    curves, sweep, marks, outline = path.curves, path.sweep, path.marks, path.outline
    at = point.journal_position / point.machine.bearing.radial_clearance
    widest = float(np.hypot(*outline.T).max())
    edge = _EDGE * widest
    step = _step(edge, 0.5, 3)
    shown = _spaced(marks.film.position, at, _SPACING * widest)
    turn = (*_TURN[:2], _TURN[2] * widest)
    ticks, speeds = marks.film.position[shown], units.speed.of(marks.speed[shown])
    traces = [
        *_behind_path(curves, point),
        _path(sweep, units),
        _guides(at, edge),
        style.mark(at[1], at[0], "running speed", hovertemplate=_position_hover(point, units)),
    ]
    labels = [
        *(
            plane.label(f"{rpm:.0f}", place, size=12, **_beside(place, at))
            for rpm, place in zip(speeds, ticks, strict=True)
        ),
        *_locus_labels(point, at, outline, units),
        *_load_arrow(point, float(outline[:, 0].max()), units),
        plane.turning_head(*turn[1:]),
    ]  # fmt: skip
    shapes = [
        plane.outline(outline),
        plane.stroke((-widest, 0.0), (widest, 0.0)),
        plane.stroke((0.0, -widest), (0.0, widest)),
        *plane.turning(*turn),
        *(plane.dot(place, style.JOURNAL) for place in ticks),
    ]
    x = style.axis(f"{style.symbols('Y/C')}, in the sense of rotation →", -edge, edge, dtick=step)
    y = style.axis(f"← {style.symbols('X/C')}, along the load", edge, -edge, dtick=step)
    chart = plane.chart(
        traces, x, y, height=HEIGHT, margin=_MARGIN, annotations=labels, shapes=shapes
    )
    return cursor.over_speed(chart, point.speed, units, along=_UP_TO_THE_TOP)


def position_over_speed(sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return ε and φ over running speed."""
    x, speed = cursor.speed_axis(sweep.speed, units), float(units.speed.of(point.speed))
    chart = _panes(units.speed.of(sweep.speed), sweep, (speed, point), x, units)
    return cursor.over_speed(chart, point.speed, units)


def position_over_sommerfeld(curves: FilmCurves, sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return ε and φ over the modified Sommerfeld number; without load it is infinite."""
    film, sigma = curves.film, float(point.sommerfeld)
    low, high = style.decades([1e-2, 1e2, sigma])
    loaded = math.isfinite(sigma)
    x = style.axis(style.titled("Modified Sommerfeld number", "σ", "-"), low, high, log=True)
    chart = _panes(sweep.sommerfeld, sweep, (sigma if loaded else high, point), x, units)
    soft: Part = {"width": 1.4, "dash": "dot", "hoverinfo": "skip"}
    phi = units.angle.of(film.attitude_angle)
    behind = [
        style.line(film.sommerfeld, film.eccentricity_ratio, "any speed", _SOFT, **soft),
        *style.lower([style.line(film.sommerfeld, phi, "any speed", _SOFT, **soft)]),
    ]
    notes = (
        [] if loaded else [text.remark(f"no load: {style.symbols('σ')} is infinite", 0.98, 0.97)]
    )
    chart = {
        "data": [*behind, *chart["data"]],
        "layout": {**chart["layout"], "annotations": notes},
    }
    return cursor.over_film(chart, sweep, point, units, "σ")


def power_loss(sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return the power loss of one film over running speed."""
    title = style.titled("Power loss per bearing", "P", units.power.name)
    return _over_speed(sweep, point, units, ("power_loss", units.power, title))


def side_flow(sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return the oil that leaves one bearing at both ends over running speed."""
    title = style.titled("Side flow per bearing", "Q", units.flow.name)
    return _over_speed(sweep, point, units, ("side_flow", units.flow, title))


def friction_coefficient(sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return the friction coefficient over running speed; it is infinite without load."""
    title = style.titled("Friction coefficient", "f", "-")
    chart = _over_speed(sweep, point, units, ("friction_coefficient", units.number, title))
    loaded = point.machine.static_load > 0.0
    notes = [] if loaded else [text.remark("no load: drag over load is infinite", 0.98, 0.97)]
    return {**chart, "layout": {**chart["layout"], "annotations": notes}}


def drag_torque(sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return the film's torque on one journal over running speed."""
    title = style.titled("Drag torque per bearing", "T", units.torque.name)
    return _over_speed(sweep, point, units, ("drag_torque", units.torque, title))


def minimum_film_thickness(sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return the smallest film thickness over running speed, below the radial clearance."""
    C = float(units.film.of(point.machine.bearing.radial_clearance))
    title = style.titled("Smallest film", "h", units.film.name)
    chart = _over_speed(
        sweep, point, units, ("minimum_film_thickness", units.film, title), least=1.05 * C
    )
    across = chart["layout"]["xaxis"]["range"]
    clearance = style.line(
        across, [C, C], f"radial clearance {style.symbols('C')}", _SOFT, width=1.4, dash="dot"
    )
    return {**chart, "data": [clearance, *chart["data"]]}


def _step(end: float, least: float, most: int) -> float:
    """Return a step between an axis' ticks, of which `most` at most lie from 0 to its end."""
    return next(step for i in itertools.count() if end / (step := least * 2.0**i) <= most)


def _over_speed(
    sweep: Sweep, point: Sweep, units: Units, quantity: tuple[str, Unit, str], least: float = 0.0
) -> Chart:
    """Return a field of the sweep over running speed; `quantity` is its name, unit and title."""
    name, unit, title = quantity
    values, value = unit.of(getattr(sweep, name)), float(unit.of(getattr(point, name)))
    speed, hover = units.speed.of(sweep.speed), text.hover("%{x:.0f} rpm", unit)
    x = cursor.speed_axis(sweep.speed, units)
    y = style.axis(title, 0.0, style.ceiling(values, least))
    line = style.line(speed, values, name.replace("_", " "), style.BLUE, hovertemplate=hover)
    here = style.here(float(units.speed.of(point.speed)), value, x, y)
    chart = style.chart(
        [line, *here], x, y, height=SMALL_HEIGHT, showlegend=False, margin=_MARGIN
    )  # fmt: skip
    return cursor.over_speed(chart, point.speed, units)


def _panes(across: Array, sweep: Sweep, at: tuple[float, Sweep], x: Axis, units: Units) -> Chart:
    """Return ε above φ over one axis; `at` is the running speed's place there and its record."""
    place, point = at
    x = {**x, "anchor": "y2"}
    eps, phi = sweep.eccentricity_ratio, units.angle.of(sweep.attitude_angle)
    highest = style.ceiling(eps, 1.0)
    y = style.axis(
        style.titled("Eccentricity ratio", "ε", "-"),
        0.0,
        highest,
        dtick=_step(highest, 0.25, 5),
        domain=style.UPPER,
    )
    low, high = 30.0 * math.floor(min(0.0, float(phi.min())) / 30.0), float(phi.max())
    high = max(90.0, 30.0 * math.ceil(high / 30.0))
    y2 = style.axis(
        style.titled("Attitude angle", "φ", "°"), low, high, dtick=30, domain=style.LOWER
    )
    hover = text.hover("%{x:.4g}", units.number)
    traces = [
        style.line(across, eps, "ε", style.JOURNAL, hovertemplate=hover),
        *style.here(place, float(point.eccentricity_ratio), x, y),
        *style.lower([
            style.line(across, phi, "φ", style.PURPLE, hovertemplate=hover),
            *style.here(place, float(units.angle.of(point.attitude_angle)), x, y2),
        ]),
    ]  # fmt: skip
    height = HEIGHT - 40  # leaves room for the control above the chart
    return style.chart(traces, x, y, yaxis2=y2, height=height, showlegend=False, margin=_MARGIN)


def _behind_path(curves: FilmCurves, point: Sweep) -> list[Trace]:
    """Return the whole path, and the line of centres with the attitude angle."""
    phi, quiet = float(point.attitude_angle), {"hoverinfo": "skip"}
    centres = [(0.0, 0.0), plane.at(phi, 1.0)]
    return [
        plane.line(curves.film.position, "any speed", _SOFT, width=1.4, dash="dot", **quiet),
        plane.line(centres, "line of centres", style.PURPLE, width=1.4, **quiet),
        plane.line(plane.arc(0.0, phi, 0.3), "attitude angle", style.PURPLE, width=1.6, **quiet),
    ]


def _path(sweep: Sweep, units: Units) -> Trace:
    """Return the journal's path up to the top speed, with speed and ε in its hover text."""
    places = sweep.journal_position / sweep.machine.bearing.radial_clearance
    told = np.stack([units.speed.of(sweep.speed), sweep.eccentricity_ratio], axis=-1)
    hover = "%{customdata[0]:.0f} rpm<br>ε = %{customdata[1]:.4f}<extra></extra>"
    extra: Part = {"width": 3.5, "customdata": told, "hovertemplate": hover}
    return plane.line(places, _UP_TO_THE_TOP, style.JOURNAL, **extra)


def _spaced(places: Array, at: Array, spacing: float) -> list[int]:
    """Return the indices of points to mark, apart from each other and from the running speed."""
    kept: list[int] = []
    for i, place in enumerate(places):
        others = [at, *(places[j] for j in kept)]
        if all(math.dist(place, other) >= spacing for other in others):
            kept.append(i)
    return kept


def _beside(place: Array, at: Array) -> Part:
    """Return the position of a label, clear of the path and of the running speed's label."""
    if place[0] < at[0] < _LOW and math.dist(place, at) < 0.3:
        return {"xanchor": "right", "yshift": 14}
    return {"xanchor": "left", "xshift": 7, "yshift": 9 if place[0] < 0.35 else 0}


def _guides(at: Array, edge: float) -> Trace:
    """Return the dashed lines from the journal's place to both axes of the plane."""
    places = np.array([(at[0], -edge), (at[0], at[1]), (edge, at[1])])
    return plane.line(places, "to the axes", style.GREY, width=1.4, dash="dash", hoverinfo="skip")


def _position_hover(point: Sweep, units: Units) -> str:
    X, Y = point.journal_position
    place = f"X = {text.amount(units.film, X)}<br>Y = {text.amount(units.film, Y)}"
    return f"{place}<br>ε = {float(point.eccentricity_ratio):.4f}<extra>running speed</extra>"


def _locus_labels(point: Sweep, at: Array, outline: Array, units: Units) -> list[Part]:
    C, rpm = point.machine.bearing.radial_clearance, float(units.speed.of(point.speed))
    phi = text.amount(units.angle, point.attitude_angle)
    radius = np.hypot(*outline.T)
    is_circle = np.allclose(radius, radius[0], rtol=0.0, atol=1e-9)
    # On a floating ring the journal has the way through both films.
    wider = is_circle and radius[0] > 1.0 + 1e-9
    symbol = style.symbols("C + C_o" if wider else "C")
    size = f"{symbol} = {text.amount(units.film, C * (radius[0] if is_circle else 1.0))}"
    circle = f"{'circle' if is_circle else 'clearance'}, {size}"
    left: Part = {"xanchor": "right", "xshift": -6}
    yshift = 20 if at[0] < _LOW else -4
    return [
        plane.label(f"<b>{rpm:.0f} rpm</b>", at, xshift=10, yshift=yshift, xanchor="left"),
        plane.label(f"{style.symbols('φ')} = {phi}", (0.3, 0.0), **left),
        plane.label("Ω", plane.at(2.2, 1.18 * float(np.hypot(*outline.T).max()))),
        plane.label(circle, (1.1 * float(outline[:, 0].max()), 0.0), size=12, **left),
    ]


def _load_arrow(point: Sweep, reach: float, units: Units) -> list[Part]:
    load = point.machine.static_load
    if load == 0.0:
        centred = not np.any(point.journal_position)
        words = "no load: the journal is centred" if centred else "no load"
        return [plane.label(words, (-0.6 * reach, 0.0))]
    words = f"{style.symbols('F_o')} = {text.amount(units.force, load)}"
    return [
        # On the left: on the right large type would reach the arrow of the rotation.
        plane.label(words, (-0.55 * reach, 0.0), xshift=-10, xanchor="right"),
        plane.arrow((-0.95 * reach, 0.0), (-0.45 * reach, 0.0), style.GREY),
    ]
