"""Charts of the steady response to imbalance: amplitude and phase over speed, and orbits.

Orbits are drawn with X, along the load, pointing down and Y to the right, so that the shaft turns
counterclockwise. A dot marks the instant when the imbalance points down, along X; an arrowhead the
direction of motion.
"""

import math
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.figures import cursor, style
from rotorcalc.figures.animation import ROW, playable, scrubbed
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.machine import Rotor
from rotorcalc.unbalance_curves import (
    BodyResponse,
    ClearanceOrbit,
    Orbits,
    ResponseCurves,
    ResponseFamily,
)
from rotorcalc.unbalance_peaks import ResponsePeaks
from rotorcalc.units import Unit, Units

_HEIGHT = 500
# Height of a chart with a slider, and its margins.
_PLAYED, _ROOM = 560, {"l": 64, "r": 28, "t": 44, "b": ROW}
# Axis over the highest peak, which leaves room for the peak's label.
_HEADROOM = 1.12
# The lowest peak that has a label, over the chart's height: those at the axis would overlap.
_LABELLED = 0.03
# Width and height of a peak's label over those of the plot, where charts stand side by side.
_LABEL = (0.34, 0.07)
# Two entries per row, so that charts side by side have plots of equal height.
_TWO_COLUMNS = {
    "orientation": "h", "x": 0, "y": 1.01, "yanchor": "bottom",
    "entrywidth": 0.44, "entrywidthmode": "fraction",
}  # fmt: skip
# Colour and width of the variants' lines, in the order of the parameter that varies.
_VARIANTS = (
    (style.PURPLE, 1.4), (style.GREEN, 1.4), (style.GREY, 1.4), (style.PURPLE, 2.8),
    (style.GREEN, 2.8),
)  # fmt: skip


def amplitude(curves: ResponseCurves, shown: Literal["axes", "XY"], units: Units) -> Chart:
    """Return the amplitudes of disk and journal against speed: the orbit's axes, or X and Y."""
    x, unit = cursor.speed_axis(curves.speed, units), units.amplitude
    bodies = _bodies(curves)
    sizes = [part for _, body, _, _ in bodies for part in _parts(body, shown)]
    peaks = [found.amplitude for _, _, found, _ in bodies]
    top = style.ceiling(_HEADROOM * unit.of(np.concatenate([*sizes, *peaks])))
    y = style.axis(f"Amplitude [{unit.name}]", 0.0, top)
    traces: list[Trace] = []
    notes: list[dict[str, Any]] = _unstable_note(curves)
    shapes = _shades(curves, units)
    for name, body, found, colour in bodies:
        traces += _pair(curves.speed, [unit.of(part) for part in _parts(body, shown)],
                        _names(name, shown), colour, units)  # fmt: skip
        if shown == "axes":
            traces += _peak_marks(found, name, colour, units)
            notes = _apart([*notes, *_peak_labels(found, name, units, (x, y))], (x, y))
        else:
            shapes += [_guide(float(units.speed.of(speed)), colour) for speed in found.speed]
    here = [unit.of(part) for _, body in _bodies_here(curves) for part in _parts(body, shown)]
    traces += _points(curves, np.array(here), (x, y), units)
    chart = style.chart(
        traces, x, y, shapes=shapes, annotations=notes, height=480, legend=_TWO_COLUMNS
    )
    return cursor.over_speed(chart, curves.running_speed, units)


def phase(curves: ResponseCurves, units: Units) -> Chart:
    """Return the phase lags of X and Y of disk and journal behind the imbalance, against speed."""
    x, unit = cursor.speed_axis(curves.speed, units), units.angle
    bodies = _bodies(curves)
    lags = unit.of(np.concatenate([body.lag for _, body, _, _ in bodies]))
    low = min(0.0, 90.0 * math.floor(float(lags.min()) / 90.0))
    high = max(180.0, 90.0 * math.ceil(float(lags.max()) / 90.0))
    y = style.axis("Lag behind the imbalance [°]", low, high, dtick=90)
    traces: list[Trace] = []
    for name, body, _, colour in bodies:
        traces += _pair(curves.speed, list(unit.of(body.lag).T), _names(name, "XY"), colour, units)
    here = np.concatenate([unit.of(body.lag) for _, body in _bodies_here(curves)])
    traces += _points(curves, here, (x, y), units)
    shapes, notes = _shades(curves, units), _unstable_note(curves)
    chart = style.chart(
        traces, x, y, shapes=shapes, annotations=notes, height=480, legend=_TWO_COLUMNS
    )
    return cursor.over_speed(chart, curves.running_speed, units)


def in_clearance(orbit: ClearanceOrbit, locus: Array, units: Units) -> Chart:
    """Return the journal's orbit about its static equilibrium inside its clearance."""
    unit = units.film
    farthest = max(float(np.abs(path).max()) for path in (orbit.wall, orbit.path))
    reach = style.ceiling(unit.of(1.04 * farthest), steps=style.CLOSE)
    x, y = _plane(reach, unit)
    centre = unit.of(orbit.centre)
    bottom = {**y, "range": [reach, reach]}  # reversed axis: its larger end is at the bottom
    guide, point = style.here(float(centre[1]), float(centre[0]), x, bottom)
    small = {**point, "marker": {**point["marker"], "size": 7}, "showlegend": False}
    traces = [
        _path(orbit.wall, unit, "clearance", style.GREY, width=1.8, showlegend=False),
        _path(locus, unit, "equilibrium at other speeds", style.GREY, dash="dot", width=1.4),
        guide,
        small,
        *_orbit(orbit.path, unit, "journal's orbit", style.JOURNAL),
    ]
    return style.chart(traces, x, y, height=_HEIGHT)


def played_in_clearance(
    orbit: ClearanceOrbit, locus: Array, here: Orbits, steps: Orbits, units: Units
) -> Chart:
    """Return `in_clearance` with a slider over speed and buttons to play it.

    Parameters
    ----------
    orbit : ClearanceOrbit
        The orbit at the running speed, and the wall.
    locus : array, (n, 2)
        Static equilibria at other speeds [m].
    here, steps : Orbits
        Orbits at the running speed and at the slider's other speeds.
    units : Units
        Units of display.

    Returns
    -------
    Chart
        The chart with its frames, slider and buttons.
    """
    chart = in_clearance(orbit, locus, units)
    layout = {**chart["layout"], "height": _PLAYED, "margin": _ROOM}
    paths = [(centre + journal,) for _, _, journal, centre in _moments(steps, here)]
    chart = _over_speeds({**chart, "layout": layout}, paths, steps, here, units)
    return playable(chart, step=120)


def at_running_speed(orbits: Orbits, units: Units) -> Chart:
    """Return the orbits of disk and journal at the running speed, both about the same point."""
    unit = units.film
    points = unit.of(np.concatenate([orbits.disk, orbits.journal]))
    x, y = _plane(style.ceiling(1.05 * np.abs(points)), unit)
    traces = style.joined([_orbit(p, unit, n, c) for n, p, c in _paths(orbits)])
    return style.chart(traces, x, y, height=_HEIGHT)


def scrubber(steps: Orbits, here: Orbits, units: Units) -> Chart:
    """Return the orbits with a speed slider that runs in the browser."""
    unit, moments = units.film, _moments(steps, here)
    paths = [
        (journal,) if here.is_rigid else (disk, journal) for _, disk, journal, _ in moments
    ]  # fmt: skip
    points = unit.of(np.concatenate([path for moment in paths for path in moment]))
    x, y = _plane(style.ceiling(1.05 * np.abs(points)), unit)
    # The sense of whirl may change with speed, so the name omits it.
    traces = style.joined([_orbit(p, unit, n.split(",")[0], c) for n, p, c in _paths(here)])
    chart = style.chart(traces, x, y, height=_PLAYED, margin=_ROOM)
    return _over_speeds(chart, paths, steps, here, units)


def family(
    responses: ResponseFamily,
    at: Literal["disk", "journal"],
    varied: Literal["damping", "mass"],
    curves: ResponseCurves,
    units: Units,
) -> Chart:
    """Return the orbit's size against speed for several rotors, dotted where they are unstable.

    The first rotor is this machine's; `curves` are its response.
    """
    is_disk, unit = at == "disk", units.amplitude
    sizes = unit.of(responses.disk if is_disk else responses.journal)
    speed = units.speed.of(responses.speed)
    x = cursor.speed_axis(curves.speed, units)
    title = f"{at.capitalize()}, amplitude of its major axis [{unit.name}]"
    y = style.axis(title, 0.0, style.ceiling(sizes))
    names = [_variant_name(rotor, varied, units) for rotor in responses.rotors]
    own: tuple[str, float] = (style.DISK if is_disk else style.JOURNAL, 3.6)
    lines = [
        _by_stability(speed, size, unstable, name, look)
        for size, unstable, name, look in zip(
            sizes, responses.unstable, names, (own, *_VARIANTS), strict=False
        )
    ]
    others = [line | style.LIVE_ONLY for line in style.joined(lines[1:])]
    here = curves.disk_here if is_disk else curves.journal_here
    now, size = float(units.speed.of(curves.running_speed)), float(unit.of(here.ellipse.semi_major))
    chart = style.chart([*others, *lines[0], *style.here(now, size, x, y)], x, y, height=440)
    return cursor.over_speed(chart, curves.running_speed, units)


def _moments(steps: Orbits, here: Orbits) -> list[tuple[float, Array, Array, Array]]:
    """Return speed, orbits of disk and journal, and equilibrium, at rising speeds."""
    moments = [
        (float(speed), disk, journal, centre)
        for speed, disk, journal, centre in zip(
            steps.speed, steps.disk, steps.journal, steps.centre, strict=True
        )
        if speed != here.speed
    ]
    moments.append((float(here.speed), here.disk, here.journal, here.centre))
    return sorted(moments, key=lambda moment: moment[0])


def _over_speeds(
    chart: Chart, paths: Sequence[tuple[Array, ...]], steps: Orbits, here: Orbits, units: Units
) -> Chart:
    """Return a chart with a slider over speed; `paths` are the orbits, its last traces, at each."""
    speeds = [speed for speed, *_ in _moments(steps, here)]
    stops = units.speed.of(speeds)
    chart = scrubbed(
        chart,
        [_step(moment, units) for moment in paths],
        labels=[f"{stop:.0f}" for stop in stops],
        active=speeds.index(float(here.speed)), unit=units.speed.name, prefix="Ω = ",
    )  # fmt: skip
    return cursor.over_speed(chart, here.speed, units, frames=stops)


def _bodies(curves: ResponseCurves) -> list[tuple[str, BodyResponse, ResponsePeaks, str]]:
    """Return name, response, peaks and colour of each body; a rigid rotor is one body."""
    journal = ("journal", curves.journal, curves.journal_peaks, style.JOURNAL)
    if curves.is_rigid:
        return [("rotor", *journal[1:])]
    return [("disk", curves.disk, curves.disk_peaks, style.DISK), journal]


def _bodies_here(curves: ResponseCurves) -> list[tuple[str, BodyResponse]]:
    journal = ("journal", curves.journal_here)
    return [journal] if curves.is_rigid else [("disk", curves.disk_here), journal]


def _parts(body: BodyResponse, shown: str) -> list[Array]:
    if shown == "XY":
        return [body.amplitude[..., 0], body.amplitude[..., 1]]
    return [body.ellipse.semi_major, np.abs(body.ellipse.semi_minor)]


def _names(body: str, shown: str) -> tuple[str, str]:
    return (f"{body} X", f"{body} Y") if shown == "XY" else (f"{body} major", f"{body} |minor|")


def _pair(
    speed: Array, values: list[Array], names: tuple[str, str], colour: str, units: Units
) -> list[Trace]:
    """Return the lines of a body: the first solid, the second dashed."""
    at = units.speed.of(speed)
    return [
        style.line(at, value, name, colour, dash=dash)
        for value, name, dash in zip(values, names, ("solid", "dash"), strict=True)
    ]


def _peak_marks(peaks: ResponsePeaks, body: str, colour: str, units: Units) -> list[Trace]:
    if not len(peaks.speed):
        return []
    at, size = units.speed.of(peaks.speed), units.amplitude.of(peaks.amplitude)
    shape = {"size": 11, "symbol": "diamond", "color": colour,
             "line": {"color": "#333333", "width": 1.2}}  # fmt: skip
    return [style.mark(at, size, f"peak of the {body}", marker=shape, showlegend=False)]


def _peak_labels(
    peaks: ResponsePeaks, body: str, units: Units, axes: tuple[Axis, Axis]
) -> list[dict[str, Any]]:
    """Return labels with amplitude and speed of each peak, on the side with more room."""
    right, top = (max(axis["range"]) for axis in axes)
    labels: list[dict[str, Any]] = []
    sizes = units.amplitude.of(peaks.amplitude)
    for speed, size in zip(units.speed.of(peaks.speed), sizes, strict=True):
        if size < _LABELLED * top:
            continue
        to_left = speed > (0.3 if body == "disk" else 0.7) * right
        number = f"{size:.3g}" if size < 1e3 else f"{size:.0f}"
        text = f"{number} {units.amplitude.name}, {speed:.0f} {units.speed.name}"
        labels.append(
            {"x": float(speed), "y": float(size), "text": text, "showarrow": False,
             "xanchor": "right" if to_left else "left", "yanchor": "bottom", "yshift": 7,
             "font": {"size": 13}}
        )  # fmt: skip
    return labels


def _apart(labels: list[dict[str, Any]], axes: tuple[Axis, Axis]) -> list[dict[str, Any]]:
    """Return labels of peaks, those below their peaks that would cover one before them."""
    placed: list[dict[str, Any]] = []
    for label in labels:
        is_covering = any(_covers(label, other, axes) for other in placed if "yshift" in other)
        below = {"yanchor": "top", "yshift": -7} if is_covering else {}
        placed.append(label | below)
    return placed


def _covers(one: dict[str, Any], other: dict[str, Any], axes: tuple[Axis, Axis]) -> bool:
    """Return whether labels overlap that stand above their peaks."""
    (wide, high), (x, y) = _LABEL, axes
    first, second = (
        label["x"] / max(x["range"]) - wide * (label["xanchor"] == "right")
        for label in (one, other)
    )
    return abs(first - second) < wide and abs(one["y"] - other["y"]) < high * max(y["range"])


def _guide(speed: float, colour: str) -> dict[str, Any]:
    """Return a thin line at the speed of a peak: peaks of the axes are not those of X and Y."""
    return {"type": "line", "x0": speed, "x1": speed, "y0": 0, "y1": 1, "yref": "paper",
            "line": {"color": colour, "width": 1.2, "dash": "dot"}}  # fmt: skip


def _shades(curves: ResponseCurves, units: Units) -> list[dict[str, Any]]:
    """Return shaded ranges of speed in which the machine is unstable."""
    return [
        {"type": "rect", "x0": float(first), "x1": float(last), "y0": 0, "y1": 1, "yref": "paper",
         "fillcolor": style.SHADE, "line": {"width": 0}, "layer": "below"}
        for first, last in units.speed.of(curves.unstable)
    ]  # fmt: skip


def _unstable_note(curves: ResponseCurves) -> list[dict[str, Any]]:
    if not len(curves.unstable):
        return []
    words = {"font": {"color": style.UNSTABLE, "size": 13}, "xanchor": "right", "yanchor": "top"}
    return [style.note("unstable", 0.995, 0.995, **words)]


def _points(
    curves: ResponseCurves, values: Array, axes: tuple[Axis, Axis], units: Units
) -> list[Trace]:
    """Return the running speed's marks, one on each line, with guides from the highest."""
    now = float(units.speed.of(curves.running_speed))
    lines, point = style.here(now, float(values.max()), *axes)
    point = {**point, "showlegend": False}
    others = style.mark(np.full(len(values), now), values, "running speed", showlegend=False)
    return [lines, point, others]


def _plane(reach: float, unit: Unit) -> tuple[Axis, Axis]:
    """Return the axes of an orbit: Y to the right, X down, one scale for both."""
    plain: Axis = {"constrain": "domain", "exponentformat": "power"}
    x = style.axis(style.titled("Y", "", unit.name), -reach, reach) | plain
    equal: Axis = {"scaleanchor": "x", "scaleratio": 1, **plain}
    y = style.axis(f"X, along the load [{unit.name}]", reach, -reach) | equal
    return x, y


def _paths(orbits: Orbits) -> list[tuple[str, Array, str]]:
    """Return name with sense of whirl, points and colour of each orbit."""
    journal = f"{'rotor' if orbits.is_rigid else 'journal'}, {_sense(orbits.journal_forward)}"
    if orbits.is_rigid:
        return [(journal, orbits.journal, style.JOURNAL)]
    disk = f"disk, {_sense(orbits.disk_forward)}"
    return [(disk, orbits.disk, style.DISK), (journal, orbits.journal, style.JOURNAL)]


def _sense(forward: ArrayLike) -> str:
    return "forward" if forward else "backward"


def _path(points: Array, unit: Unit, name: str, colour: str, **extra: Any) -> Trace:
    shown = unit.of(points)
    return style.line(shown[:, 1], shown[:, 0], name, colour, **extra)


def _orbit(points: Array, unit: Unit, name: str, colour: str) -> list[Trace]:
    """Return an orbit: its path, the instant when the imbalance points along X, and its sense."""
    start = _path(points[:1], unit, name, colour)
    return [
        _path(points, unit, name, colour),
        {**start, "mode": "markers", "marker": {"size": 8, "color": colour}, "showlegend": False,
         **style.LIVE_ONLY},
        _arrow(points, unit, name, colour),
    ]  # fmt: skip


def _arrow(points: Array, unit: Unit, name: str, colour: str) -> Trace:
    """Return arrowheads after an eighth and five eighths of a turn, each along the path."""
    last = len(points) - 1
    at = np.array([last // 8, 5 * last // 8])
    step = points[at + 1] - points[at]
    # Plotly counts clockwise from up; X is down, Y to the right.
    angle = np.degrees(np.arctan2(step[:, 1], -step[:, 0]))
    shape = {"symbol": "arrow", "size": 12, "angle": angle, "color": colour, "line": {"width": 0}}
    path = _path(points[at], unit, name, colour)
    rest = {"mode": "markers", "marker": shape, "showlegend": False, "hoverinfo": "skip"}
    return {**path, **rest, **style.LIVE_ONLY}


def _step(paths: Sequence[Array], units: Units) -> list[Trace]:
    """Return the traces of one step of the slider."""
    return [_moved(trace) for path in paths for trace in _orbit(path, units.film, "", style.GREY)]


def _moved(trace: Trace) -> Trace:
    """Return the properties of an orbit's trace that change with speed."""
    # Single precision suffices on screen and halves the message.
    place = {axis: trace[axis].astype(np.float32) for axis in ("x", "y")}
    angle = trace.get("marker", {}).get("angle")
    return place if angle is None else place | {"marker": {"angle": angle}}


def _by_stability(
    speed: Array, size: Array, unstable: BoolArray, name: str, look: tuple[str, float]
) -> list[Trace]:
    """Return a line that is dotted where the machine is unstable, its two parts joined."""
    colour, width = look
    joint = unstable.copy()
    joint[:-1] |= unstable[1:]
    joint[1:] |= unstable[:-1]
    steady = style.line(speed, np.where(unstable, np.nan, size), name, colour, width=width)
    if not np.any(unstable):
        return [steady]
    dotted = style.line(
        speed, np.where(joint, size, np.nan), f"{name}, unstable", colour, dash="dot",
        width=width, showlegend=bool(np.all(unstable)),
    )  # fmt: skip
    return [steady, dotted] if not np.all(unstable) else [dotted]


def _variant_name(rotor: Rotor, varied: Literal["damping", "mass"], units: Units) -> str:
    """Return the legend's name of a variant."""
    if varied == "damping":
        unit, value, symbol = units.shaft_damping, rotor.disk_damping, "C_s"
    else:
        unit, value, symbol = units.mass, rotor.journal_mass, "M_j"
    number = float(unit.of(value))
    digits = f"{number:.3g}" if number < 1e3 else f"{number:,.0f}".replace(",", "\u2009")
    return f"{style.symbols(symbol)} = {digits} {unit.name}"
