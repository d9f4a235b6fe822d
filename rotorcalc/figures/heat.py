"""Charts of heat: temperatures and flows over speed, the balance, what warming does, the oil."""

from dataclasses import dataclass

import numpy as np

from rotorcalc.analysis import Sweep
from rotorcalc.arrays import Array
from rotorcalc.display import Result
from rotorcalc.figures import cursor, style, text
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.heat import USUAL_RISE, HeatCurves, lone_rise
from rotorcalc.machine import Oil, oil_of
from rotorcalc.oils import LAW_NAMES
from rotorcalc.units import Unit, Units

HEIGHT = 340
_MARGIN = {"l": 64, "r": 28, "t": 44, "b": 48}
_INLET, _FILM, _OUTLET = style.BLUE, style.PURPLE, style.RED
_BAND = "rgba(127,127,127,0.16)"
_MADE, _CARRIED = style.RED, style.BLUE
# Step of the ends of a temperature axis, in its unit.
_SPAN = 20.0


@dataclass(frozen=True, eq=False)
class Warmed(Result):
    """A machine over speed with the balance of heat, and with its film at one temperature.

    `other` is what the second is called.
    """

    balanced: Sweep
    fixed: Sweep
    other: str


def temperatures(sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return the temperatures of inlet, film and outlet over running speed."""
    unit = units.temperature
    lines = [("film", _FILM, sweep.temperature)]
    supply = point.machine.supply
    if supply is not None:
        inlet = np.full(sweep.speed.shape, supply.temperature)
        lines = [
            ("outlet", _OUTLET, sweep.outlet_temperature), *lines, ("inlet", _INLET, inlet)
        ]  # fmt: skip
    low, high = _temperature_ends(np.concatenate([values for *_, values in lines]), unit)
    y = style.axis(style.titled("Temperature", "T", unit.name), low, high)
    return _lines(lines, unit, y, (sweep, point, float(point.temperature)), units)


def flows(sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return the oil through one bearing over running speed.

    Where the film's temperature is given, beside the side flow what must pass in all, so that the
    oil warms by no more than `heat.USUAL_RISE`.
    """
    unit, supply = units.flow, point.machine.supply
    lines = [("side flow", style.BLUE, sweep.side_flow)]
    if supply is not None:
        groove = np.full(sweep.speed.shape, supply.flow)
        total = sweep.side_flow + supply.flow
        lines += [("grooves", style.GREEN, groove), ("both", style.PURPLE, total)]
    else:
        heat_of = oil_of(point.machine).volumetric_heat
        needed = np.maximum(sweep.power_loss / (heat_of * USUAL_RISE), sweep.side_flow)
        lines.append((f"for a rise of {text.amount(units.rise, USUAL_RISE)}", style.GREY, needed))
    top = style.ceiling(unit.of(np.concatenate([values for *_, values in lines])))
    y = style.axis(style.titled("Flow per bearing", "", unit.name), 0.0, top)
    here = float(point.side_flow) + (supply.flow if supply else 0.0)
    return _lines(lines, unit, y, (sweep, point, here), units)


def rise(sweep: Sweep, point: Sweep, units: Units) -> Chart:
    """Return how far the oil warms over running speed.

    Where the film's temperature is given, how far the side flow alone would, with all the loss.
    """
    over, here = oil_rise(sweep), float(oil_rise(point))
    y = style.axis(
        style.titled("Rise of the oil", "ΔT", units.rise.name),
        0.0,
        style.ceiling(units.rise.of(over)),
    )
    chart = _lines([("rise", _OUTLET, over)], units.rise, y, (sweep, point, here), units)
    return {**chart, "layout": {**chart["layout"], "showlegend": False}}


def oil_rise(sweep: Sweep) -> Array:
    """Return how far the oil warms, or, without a supply, the side flow alone would [K]."""
    machine = sweep.machine
    if machine.supply is None:
        return lone_rise(machine, sweep.power_loss, sweep.side_flow)
    return sweep.outlet_temperature - machine.supply.temperature


def balance(curves: HeatCurves, point: Sweep, units: Units) -> Chart:
    """Return heat made and heat carried over the film's temperature; they cross at the balance."""
    T, power = units.temperature, units.power
    low, _ = _temperature_ends(curves.temperature, T)
    high = float(T.of(curves.temperature[-1]))
    x = style.axis(style.titled("Film temperature", "T", T.name), low, high)
    share = point.machine.supply.heat_share if point.machine.supply else 1.0
    here = share * float(point.power_loss)
    made = "made by the film" if share == 1.0 else "made by the film, the oil's share"
    # Heat made in cold oil may be many times as much: the axis shows the crossing.
    y = style.axis(
        style.titled("Heat per bearing", "", power.name), 0.0, style.ceiling(2.5 * power.of(here))
    )
    hover = text.hover(f"%{{x:.1f}} {T.name}", power)
    traces = [
        style.line(T.of(curves.temperature), power.of(curves.made), made, _MADE,
                   hovertemplate=hover),
        style.line(T.of(curves.temperature), power.of(curves.carried), "carried by the oil",
                   _CARRIED, hovertemplate=hover),
        *style.here(float(T.of(point.temperature)), float(power.of(here)), x, y, "balance"),
    ]  # fmt: skip
    return style.chart(traces, x, y, height=HEIGHT, margin=_MARGIN)


def eccentricity(warmed: Warmed, point: Sweep, units: Units) -> Chart:
    """Return ε over running speed with the balance, and with the film at one temperature."""
    both = (warmed.balanced.eccentricity_ratio, warmed.fixed.eccentricity_ratio)
    y = style.eccentricity_axis(np.concatenate(both), dtick=0.25)
    return _compared(warmed, "eccentricity_ratio", (units.number, y, style.JOURNAL), point, units)


def film(warmed: Warmed, point: Sweep, units: Units) -> Chart:
    """Return the smallest film over running speed, likewise."""
    C = float(units.film.of(point.machine.bearing.radial_clearance))
    y = style.axis(style.titled("Smallest film", "h", units.film.name), 0.0, style.ceiling(C))
    field = "minimum_film_thickness"
    return _compared(warmed, field, (units.film, y, style.GREEN), point, units)


def viscosity(sweep: Sweep, point: Sweep, other: Oil | None, units: Units) -> Chart:
    """Return the oil's viscosity over temperature by its law, and by the `other` one dotted.

    Shaded is the range of the film's temperature up to the top speed.
    """
    machine = point.machine
    oil, T, mu = oil_of(machine), units.temperature, units.viscosity
    inlet = [] if machine.supply is None else [machine.supply.temperature]
    known = sweep.outlet_temperature[np.isfinite(sweep.outlet_temperature)]
    low, high = _temperature_ends(
        np.array([20.0, 100.0, *sweep.temperature, *inlet, *known, oil.reference_temperature]), T
    )
    over = np.linspace(low, high, 121)
    si = np.array([T.to_si(one) for one in over])
    x = style.axis(style.titled("Temperature", "T", T.name), low, high)
    own = mu.of(oil.viscosity(si))
    y = style.axis(style.titled("Viscosity", "μ", mu.name), *style.decades(own), log=True)
    hover = text.hover(f"%{{x:.1f}} {T.name}", mu)
    traces = [style.line(over, own, LAW_NAMES[oil.law], style.BLUE, hovertemplate=hover)]
    if other is not None:
        soft = style.line(over, mu.of(other.viscosity(si)), LAW_NAMES[other.law], style.GREY,
                          dash="dot", width=1.6, hovertemplate=hover)  # fmt: skip
        traces.insert(0, soft)
    traces += style.here(float(T.of(point.temperature)), float(mu.of(point.viscosity)), x, y)
    ends = [float(T.of(end)) for end in (sweep.temperature.min(), sweep.temperature.max())]
    band = {
        "type": "rect", "xref": "x", "yref": "paper", "x0": ends[0], "x1": ends[1],
        "y0": 0, "y1": 1, "line": {"width": 0}, "fillcolor": _BAND, "layer": "below",
    }  # fmt: skip
    return style.chart(traces, x, y, height=HEIGHT, margin=_MARGIN, shapes=[band])


def _compared(
    warmed: Warmed, field: str, how: tuple[Unit, Axis, str], point: Sweep, units: Units
) -> Chart:
    unit, y, colour = how
    x = cursor.speed_axis(warmed.balanced.speed, units)
    hover = text.hover("%{x:.0f} rpm", unit)

    def line(sweep: Sweep, name: str, **extra: str) -> Trace:
        values = unit.of(getattr(sweep, field))
        return style.line(
            units.speed.of(sweep.speed), values, name, extra.pop("colour", colour),
            hovertemplate=hover, **extra,
        )  # fmt: skip

    traces = [
        line(warmed.fixed, warmed.other, colour=style.GREY, dash="dash"),
        line(warmed.balanced, "with the balance"),
        *style.here(
            float(units.speed.of(point.speed)), float(unit.of(getattr(point, field))), x, y
        ),
    ]
    chart = style.chart(traces, x, y, height=HEIGHT, margin=_MARGIN)
    return cursor.over_speed(chart, point.speed, units)


def _lines(
    lines: list[tuple[str, str, Array]],
    unit: Unit,
    y: Axis,
    at: tuple[Sweep, Sweep, float],
    units: Units,
) -> Chart:
    """Return named lines over running speed; `at` is the sweep, the point and its value in SI."""
    sweep, point, here = at
    x, hover = cursor.speed_axis(sweep.speed, units), text.hover("%{x:.0f} rpm", unit)
    traces = [
        style.line(units.speed.of(sweep.speed), unit.of(values), name, colour, hovertemplate=hover)
        for name, colour, values in lines
    ]
    traces += style.here(float(units.speed.of(point.speed)), float(unit.of(here)), x, y)
    chart = style.chart(traces, x, y, height=HEIGHT, margin=_MARGIN)
    return cursor.over_speed(chart, point.speed, units)


def _temperature_ends(values: Array, unit: Unit) -> tuple[float, float]:
    """Return round ends of an axis about temperatures, in their unit."""
    shown = unit.of(values[np.isfinite(values)])
    # A line does not run along an end.
    low = _SPAN * np.ceil(float(shown.min()) / _SPAN - 1.0)
    high = _SPAN * np.floor(float(shown.max()) / _SPAN + 1.0)
    return float(low), float(high)
