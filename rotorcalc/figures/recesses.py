"""Charts of a hydrostatic bearing's recesses over speed: their pressures, and the powers."""

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.figures import cursor, style, text
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.recesses import RecessEquilibrium
from rotorcalc.units import Units

HEIGHT = 420

# Recesses on opposite sides have different colours; from the fifth on lines are dashed.
_COLOURS = (style.BLUE, style.OCHRE, style.PURPLE, style.GREEN)
_DASHES = ("solid", "dash", "dot")
_SOFT = "rgba(127,127,127,0.8)"


def names(number: int) -> list[str]:
    """Return the numbers of recesses with their angles from the load line, as "1, 0°"."""
    return [f"{k + 1}, {360.0 * k / number:.3g}°" for k in range(number)]


def pressures(
    over: RecessEquilibrium, here: RecessEquilibrium, supply: float, units: Units
) -> Chart:
    """Return the pressure of each recess over running speed, below the supply pressure.

    Parameters
    ----------
    over, here : RecessEquilibrium
        The recesses over the sweep, (n,), and at the running speed, ().
    supply : float
        Supply pressure, p_s [Pa].
    units : Units
        Units of display.

    Returns
    -------
    Chart
        A line for each recess.
    """
    unit = units.pressure
    x, speed = cursor.speed_axis(over.speed, units), units.speed.of(over.speed)
    low = float(unit.of(over.pressure.min(initial=0.0)))
    high = style.ceiling(unit.of(np.append(over.pressure, supply)))
    y = style.axis(
        style.titled("Recess pressure", "p", unit.name),
        -style.ceiling(-low) if low < 0.0 else 0.0,
        high,
    )
    hover = text.hover(f"%{{x:.0f}} {units.speed.name}", unit)
    lines = [
        style.line(
            speed, unit.of(over.pressure[:, k]), name,
            _COLOURS[k % len(_COLOURS)], dash=_DASHES[k // len(_COLOURS)], hovertemplate=hover,
        )
        for k, name in enumerate(names(over.pressure.shape[1]))
    ]  # fmt: skip
    p_s = float(unit.of(supply))
    ends = np.asarray(x["range"], dtype=float)
    bound = style.line(ends, [p_s, p_s], "supply", _SOFT, width=1.4, dash="dot", hoverinfo="skip")
    return _chart([bound, *lines], (x, y), here, unit.of(here.pressure), units)


def powers(over: RecessEquilibrium, here: RecessEquilibrium, units: Units) -> Chart:
    """Return the power of the pump, that lost by friction, and their sum over running speed.

    Parameters
    ----------
    over, here : RecessEquilibrium
        The recesses over the sweep, (n,), and at the running speed, ().
    units : Units
        Units of display.

    Returns
    -------
    Chart
        Three lines.
    """
    unit = units.power
    x, speed = cursor.speed_axis(over.speed, units), units.speed.of(over.speed)
    total = unit.of(over.total_power)
    y = style.axis(style.titled("Power per bearing", "P", unit.name), 0.0, style.ceiling(total))
    hover = text.hover(f"%{{x:.0f}} {units.speed.name}", unit)
    lines = [
        style.line(speed, unit.of(values), name, colour, hovertemplate=hover, **more)
        for values, name, colour, more in (
            (over.pump_power, "pump", style.GREEN, {}),
            (over.friction_power, "friction", style.OCHRE, {}),
            (over.total_power, "together", style.GREY, {"dash": "dash"}),
        )
    ]
    marks = np.array([here.pump_power, here.friction_power, here.total_power])
    return _chart(lines, (x, y), here, unit.of(marks), units)


def _chart(
    lines: list[Trace],
    axes: tuple[Axis, Axis],
    here: RecessEquilibrium,
    values: Array,
    units: Units,
) -> Chart:
    """Return a chart over speed with a mark on each line at the running speed."""
    speed = float(units.speed.of(here.speed))
    marks = style.mark(np.full(len(values), speed), values, "running speed", showlegend=False)
    return cursor.over_speed(style.chart([*lines, marks], *axes, height=HEIGHT), here.speed, units)
