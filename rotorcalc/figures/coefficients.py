"""Charts of the film's force coefficients, and of its added mass.

Dimensionless coefficients have logarithmic axes, as in the notes' Figs. 5.5 and 5.6; negative
values are drawn as absolute values, dashed, under a name with a minus sign.
"""

import math
from typing import Literal

import numpy as np

from rotorcalc.analysis import ForceCoefficients, Sweep
from rotorcalc.arrays import Array, BoolArray
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.coefficients import AddedMass, OverWhirlRatio, Unloading
from rotorcalc.figures import cursor, style
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.units import Unit, Units

# An element keeps its colour in both frames: XX and rr, XY and rt, and so on.
_COLOURS = {
    (0, 0): style.XX,
    (0, 1): style.XY,
    (1, 0): style.YX,
    (1, 1): style.YY,
}
_NAMES = {"XY": ("X", "Y"), "rt": ("r", "t")}
# Narrow entries: the names are two or three letters.
_LEGEND = {
    "orientation": "h", "x": 0, "y": 1.01, "yanchor": "bottom", "entrywidth": 28,
           "itemwidth": 30}  # fmt: skip
# By so much a chart of a table's rows reaches beyond them.
_ROOM = 1.04
# Speeds below this share of the top speed do not set a linear axis: they diverge as Ω → 0.
_SLOW = 0.1


def dimensionless(
    curve: ForceCoefficients,
    here: ForceCoefficients,
    symbol: Literal["k", "c"],
    against: Literal["ε", "σ"],
) -> Chart:
    """Return k with k_eq, or c, against ε (Fig. 5.5) or σ (Fig. 5.6)."""
    is_stiffness = symbol == "k"
    places, place = (
        (curve.eccentricity_ratio, here.eccentricity_ratio)
        if against == "ε"
        else (curve.sommerfeld, here.sommerfeld)
    )
    values = curve.stiffness if is_stiffness else curve.damping
    values_here = here.stiffness if is_stiffness else here.damping
    x = _abscissa(places, against)
    words = "Stiffness" if is_stiffness else "Damping"
    y = _decades(style.titled(words, f"|{symbol}_ij|", "-"), values_here)
    traces = _elements(symbol, curve.axes, places, values)
    if is_stiffness:
        k_eq = curve.equivalent_stiffness
        traces.append(style.line(places, k_eq, style.symbols("k_eq"), style.GREY, dash="dot"))
    return style.chart([*traces, *_points(float(place), values_here, (x, y))], x, y, legend=_LEGEND)


def stiffness_against_speed(
    sweep: Sweep, point: Sweep, curve: ForceCoefficients, here: ForceCoefficients, units: Units
) -> Chart:
    """Return K and K_eq against running speed, with dimensions."""
    return _dimensional("K", sweep, point, (curve, here), units)


def damping_against_speed(
    sweep: Sweep, point: Sweep, curve: ForceCoefficients, here: ForceCoefficients, units: Units
) -> Chart:
    """Return C against running speed, with dimensions."""
    return _dimensional("C", sweep, point, (curve, here), units)


def of_table(
    speed: Array, values: Array, symbol: Literal["K", "C"], now: float, units: Units
) -> Chart:
    """Return K or C of a table, shape (n, 2, 2), at its speeds; the running speed is a line."""
    unit: Unit = units.stiffness if symbol == "K" else units.damping
    at, shown, here = units.speed.of(speed), unit.of(values), float(units.speed.of(now))
    x = style.axis(
        style.titled("Running speed", "Ω", units.speed.name),
        0.0,
        style.ceiling(_ROOM * np.append(at, here)),
    )
    # Room for the marks, which at an end of the axis would be cut in half.
    low, high = _span(_ROOM * shown)
    words = "Stiffness" if symbol == "K" else "Damping"
    y = style.axis(style.titled(words, f"{symbol}_ij", unit.name), low, high)
    traces = [
        style.line(
            at, shown[:, *place], _name(symbol, "XY", place), colour,
            width=_width(symbol, place), mode="lines+markers",
        )
        for place, colour in _COLOURS.items()
    ]  # fmt: skip
    running = style.line(
        [here, here], [low, high], "running speed", style.HERE, dash="dash", showlegend=False
    )
    return style.chart([*traces, running], x, y, legend=_LEGEND)


def over_whirl_ratio(
    curve: OverWhirlRatio, point: Sweep, symbol: Literal["K", "C"], units: Units
) -> Chart:
    """Return K or C against the whirl ratio; the synchronous ones are marked."""
    is_stiffness = symbol == "K"
    unit: Unit = units.stiffness if is_stiffness else units.damping
    values = unit.of(curve.stiffness if is_stiffness else curve.damping)
    here = unit.of(point.stiffness if is_stiffness else point.damping)
    x = style.axis(style.titled("Whirl ratio", "ν", "-"), 0.0, float(curve.whirl_ratio[-1]))
    words = "Stiffness" if is_stiffness else "Damping"
    low, high = _span(np.append(values, here))
    y = style.axis(style.titled(words, f"{symbol}_ij", unit.name), low, high)
    traces = [
        style.line(
            curve.whirl_ratio, values[:, *place], _name(symbol, "XY", place), colour,
            width=_width(symbol, place),
        )
        for place, colour in _COLOURS.items()
    ]  # fmt: skip
    return style.chart([*traces, *_points(1.0, here, (x, y), signed=True)], x, y, legend=_LEGEND)


def unloading(curve: Unloading, here: Unloading, centred: Unloading, units: Units) -> Chart:
    """Return K and (Ω/2)·C_XX at the running speed as the journal nears the centre (Eq. 5.37)."""
    unit = units.stiffness
    high = style.ceiling(curve.eccentricity_ratio, 1.0)
    x = style.axis(style.titled("Eccentricity ratio", "ε", "-"), 1e-2, high, log=True)
    cross = float(unit.of(centred.stiffness[0, 1]))
    title = style.titled("Stiffness", "K_ij", unit.name)
    middle = math.floor(math.log10(cross))
    y = style.axis(title, 10.0 ** (middle - 2), 10.0 ** (middle + 3), log=True)
    eps, eps_here = curve.eccentricity_ratio, float(here.eccentricity_ratio)
    traces: list[Trace] = []
    for place, colour in _COLOURS.items():
        name = _name("K", "XY", place)
        traces += _signed(eps, unit.of(curve.stiffness[:, *place]), name, colour)
    damping = unit.of(curve.whirl_damping[:, 0, 0])
    traces.append(style.line(eps, damping, style.symbols("½Ω C_XX"), style.GREY, dash="dot"))
    traces += _points(eps_here, unit.of(here.stiffness), (x, y))
    return style.chart(traces, x, y)


def added_mass(laminar: AddedMass, bulk: AddedMass, here: AddedMass, units: Units) -> Chart:
    """Return the film's added mass against running speed, for two velocity profiles."""
    x, unit = cursor.speed_axis(laminar.speed, units), units.mass
    low, high = _span(unit.of(laminar.mass[_settled(laminar.speed)]))
    y = style.axis(style.titled("Added mass per bearing", "M_ij", unit.name), low, high)
    speed = units.speed.of(laminar.speed)
    traces: list[Trace] = []
    for place in ((0, 0), (1, 1), (0, 1)):
        name = _name("M", "XY", place)
        traces.append(style.line(speed, unit.of(laminar.mass[:, *place]), name, _COLOURS[place]))
    for place in ((0, 0), (1, 1)):
        name = f"{_name('M', 'XY', place)}, bulk flow"
        flat, colour = unit.of(bulk.mass[:, *place]), _COLOURS[place]
        traces.append(style.line(speed, flat, name, colour, dash="dot", width=1.6))
    values = unit.of(here.mass[[0, 1, 0], [0, 1, 1]])
    now = float(units.speed.of(here.speed))
    chart = style.chart([*traces, *_points(now, values, (x, y), signed=True)], x, y)
    return cursor.over_speed(chart, here.speed, units)


def _dimensional(
    symbol: str,
    sweep: Sweep,
    point: Sweep,
    coefficients: tuple[ForceCoefficients, ForceCoefficients],
    units: Units,
) -> Chart:
    curve, here = coefficients
    is_stiffness = symbol == "K"
    unit: Unit = units.stiffness if is_stiffness else units.damping
    values = unit.of(curve.stiffness if is_stiffness else curve.damping)
    values_here = unit.of(here.stiffness if is_stiffness else here.damping)
    x = cursor.speed_axis(sweep.speed, units)
    low, high = _span(np.append(values[_settled(sweep.speed)], values_here))
    words = "Stiffness" if is_stiffness else "Damping"
    y = style.axis(style.titled(words, f"{symbol}_ij", unit.name), low, high)
    speed = units.speed.of(sweep.speed)
    traces = [
        style.line(
            speed,
            values[:, *place],
            _name(symbol, curve.axes, place),
            colour,
            width=_width(symbol, place),
        )
        for place, colour in _COLOURS.items()
    ]
    if is_stiffness:
        K_eq = unit.of(curve.equivalent_stiffness)
        traces.append(style.line(speed, K_eq, style.symbols("K_eq"), style.GREY, dash="dot"))
    traces += _rows(sweep, symbol, units)
    now = float(units.speed.of(point.speed))
    chart = style.chart(
        [*traces, *_points(now, values_here, (x, y), signed=True)], x, y, legend=_LEGEND
    )
    return cursor.over_speed(chart, point.speed, units)


def _rows(sweep: Sweep, symbol: str, units: Units) -> list[Trace]:
    """Return the rows of a table of coefficients within the sweep, as circles on its lines."""
    table = sweep.machine.bearing
    if not isinstance(table, CoefficientTable):
        return []
    given, unit = (
        (table.stiffness, units.stiffness) if symbol == "K" else (table.damping, units.damping)
    )
    rows = np.asarray(table.speed)
    within = (rows >= sweep.speed[0]) & (rows <= sweep.speed[-1])
    speed, values = units.speed.of(rows[within]), unit.of(np.asarray(given)[within])
    return [
        {
            **style.mark(speed, values[:, *place], "row of the table"),
            "marker": {
                "size": 5, "symbol": "circle-open", "color": colour, "line": {"width": 1.5}
            },
            "showlegend": False,
        }
        for place, colour in _COLOURS.items()
    ]  # fmt: skip


def _elements(symbol: str, axes: str, places: Array, values: Array) -> list[Trace]:
    """Return the lines of the four elements, negative values dashed."""
    return style.joined(
        [
            _signed(
                places,
                values[:, *place],
                _name(symbol, axes, place),
                colour,
                width=_width(symbol, place),
            )
            for place, colour in _COLOURS.items()
        ]
    )


def _width(symbol: str, place: tuple[int, int]) -> float:
    """Return a line's width: c_XY is wide, so that it shows beside the equal c_YX."""
    return 5.5 if symbol in "cC" and place == (0, 1) else 2.2


def _signed(x: Array, y: Array, name: str, colour: str, width: float = 2.2) -> list[Trace]:
    """Return |y| as a line where y is positive and as a dashed line where it is negative."""
    parts = [(y, name, "solid"), (-y, f"−{name}", "dash")]
    return [
        style.line(x, np.where(part > 0.0, part, np.nan), label, colour, dash=dash, width=width)
        for part, label, dash in parts
        if np.any(part > 0.0)
    ]


def _points(
    x: float, values: Array, axes: tuple[Axis, Axis], *, signed: bool = False
) -> list[Trace]:
    """Return the running speed's marks, one on each line, with guides from the largest."""
    levels = (values if signed else np.abs(values)).ravel()
    finite = levels[np.isfinite(levels)]
    if not (math.isfinite(x) and len(finite)):
        return []
    largest = float(finite.max())
    others = style.mark(np.full(len(levels), x), levels, "running speed", showlegend=False)
    lines, point = style.here(x, largest, *axes)
    return [lines, point | {"showlegend": False}, others]


def _name(symbol: str, axes: str, place: tuple[int, int]) -> str:
    """Return a coefficient's symbol with its two indices."""
    names = _NAMES[axes]
    return style.symbols(f"{symbol}_{names[place[0]]}{names[place[1]]}")


def _abscissa(places: Array, against: str) -> Axis:
    if against == "ε":
        return style.eccentricity_axis(places)
    low, high = float(places.min()), float(places.max())
    return style.axis(style.titled("Modified Sommerfeld number", "σ", "-"), low, high, log=True)


def _decades(title: str, values: Array) -> Axis:
    """Return a logarithmic axis from 0.1 to 100, or up to the running speed's values."""
    sizes = np.abs(values[np.isfinite(values)])
    top = max(2, math.ceil(math.log10(float(sizes.max(initial=1.0)))))
    return style.axis(title, 0.1, 10.0**top, log=True)


def _settled(speed: Array) -> BoolArray:
    return speed >= _SLOW * speed[-1]


def _span(values: Array) -> tuple[float, float]:
    """Return round bounds of a linear axis around values, zero within."""
    lowest = float(np.nanmin(values))
    return (-style.ceiling(-lowest) if lowest < 0.0 else 0.0), style.ceiling(values)
