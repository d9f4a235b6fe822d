"""Charts of a machine over the values of one input: onset, margin, log decrement, smallest film."""

from typing import NamedTuple

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.figures import style
from rotorcalc.figures.design import Quantity, this_machine
from rotorcalc.figures.stability import LEGEND, MARGIN
from rotorcalc.figures.style import Chart
from rotorcalc.figures.text import amount
from rotorcalc.input_sweep import InputSweep
from rotorcalc.units import Units

# An axis ends at so many times what the machine itself has, where a curve rises beyond.
_REACH = 4.0


class Over(NamedTuple):
    """A curve over an input: its axis, its values in the unit shown, and the machine's own.

    The axis reaches to `least` where the curve does.
    """

    title: str
    name: str
    values: Array
    here: float
    least: float = 0.0


def onset(found: InputSweep, here: InputSweep, quantity: Quantity, units: Units) -> Chart:
    """Return the onset over one input, with the running speed.

    Parameters
    ----------
    found, here : InputSweep
        Over values of the input, and at the machine's own alone.
    quantity : Quantity
        The input.
    units : Units
        Units of display.

    Returns
    -------
    Chart
        The chart.
    """
    unit = units.speed
    title = style.titled("Onset speed", "Ω_on", unit.name)
    over = Over(title, "onset", unit.of(found.onset), float(unit.of(here.onset[0])))
    words = f"running speed, {amount(unit, found.speed)}"
    return _chart(over, found, here, quantity, (float(unit.of(found.speed)), words))


def margin(found: InputSweep, here: InputSweep, quantity: Quantity, units: Units) -> Chart:
    """Return the margin to the onset over one input; as `onset`."""
    unit = units.percent
    title = style.titled("Margin to onset", "Ω_on/Ω − 1", unit.name)
    over = Over(title, "margin", unit.of(found.margin), float(unit.of(here.margin[0])), 100.0)
    return _chart(over, found, here, quantity, (0.0, "no margin"))


def log_decrement(found: InputSweep, here: InputSweep, quantity: Quantity, units: Units) -> Chart:
    """Return the least log decrement at the running speed over one input; as `onset`."""
    title = style.titled("Log decrement", "δ", units.number.name)
    over = Over(title, "log decrement", found.log_decrement, float(here.log_decrement[0]), 0.5)
    return _chart(over, found, here, quantity, (0.0, "edge of stability"))


def film(found: InputSweep, here: InputSweep, quantity: Quantity, units: Units) -> Chart:
    """Return the smallest film at the running speed over one input; as `onset`."""
    unit = units.film
    title = style.titled("Smallest film", "h_min", unit.name)
    values = unit.of(found.minimum_film_thickness)
    own = float(unit.of(here.minimum_film_thickness[0]))
    return _chart(Over(title, "smallest film", values, own), found, here, quantity, None)


def _chart(
    over: Over, found: InputSweep, here: InputSweep, quantity: Quantity,
    limit: tuple[float, str] | None,
) -> Chart:  # fmt: skip
    """Return a curve over an input, a limit across it, and the machine."""
    values = np.where(np.isinf(over.values), np.nan, over.values)
    x, at = quantity.axis(), quantity.unit.of(found.values)
    low, high = _ends(over, values, limit)
    y = style.axis(over.title, low, high)
    traces = [style.line(at, values, over.name, style.FLEXIBLE)]
    if limit:
        traces.append(style.line(at[[0, -1]], [limit[0]] * 2, limit[1], style.RED, dash="dot"))
    if np.isfinite(over.here) and low <= over.here <= high:
        value = float(here.values[0])
        arrow = quantity.beyond(value)
        traces += this_machine(x, y, quantity.place(value), over.here, arrow)
    nothing = [] if np.isfinite(values).any() else [
        style.note("no finite number at any of these values", 0.5, 0.5)
    ]  # fmt: skip
    return style.chart(traces, x, y, legend=LEGEND, margin=MARGIN, annotations=nothing)


def _ends(over: Over, values: Array, limit: tuple[float, str] | None) -> tuple[float, float]:
    """Return round ends of an axis that holds zero, limit and machine, and a curve near them."""
    marks = np.array([over.here, limit[0] if limit else 0.0])
    most = _REACH * np.abs(marks[np.isfinite(marks)]).max(initial=over.least / _REACH) or np.inf
    held = np.clip(values[np.isfinite(values)], -most, most)
    shown = 1.05 * np.array([*held, *marks, 0.0])
    low = float(shown[np.isfinite(shown)].min())
    return -style.ceiling(-low) if low < 0.0 else 0.0, style.ceiling(shown)
