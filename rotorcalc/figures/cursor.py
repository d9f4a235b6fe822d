"""One value through all charts of a page: a running speed, or a moment of a motion.

A browser marks the value under the pointer in every chart that knows its quantity. What a chart
says of itself for that stands in its layout's `meta`, of which Plotly takes no notice:

`quantity`, `unit`
    What is marked, and the unit of its label.
`now`
    The value at which the chart is drawn.
and how the chart shows another value
    `axis` ("x" or "y") runs over it; or, with `at` and `to`, over something that follows from it;
    `along` names a line whose `customdata` holds the value at each of its points;
    `frames` are the values at the stops of its slider;
    `drawing` holds what a drawing needs (`machine.cross_section`);
    `asked` names an input, and between which `ends` of it another chart is to be had.
"""

from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.analysis import Sweep
from rotorcalc.arrays import Array
from rotorcalc.figures import style
from rotorcalc.figures.style import Axis, Chart
from rotorcalc.units import Units


def speed_axis(speed: Array, units: Units) -> Axis:
    """Return the axis of running speeds from zero to the last of a sweep's."""
    top = float(units.speed.of(speed[-1]))
    return style.axis(style.titled("Running speed", "Ω", units.speed.name), 0.0, top)


def marked(chart: Chart, quantity: str, unit: str, now: float, **how: Any) -> Chart:
    """Return a chart that can mark a value; `how` as this module says."""
    meta: dict[str, Any] = chart["layout"].get("meta", {})
    cursor = {"quantity": quantity, "unit": unit, "now": now, **how}
    return {**chart, "layout": {**chart["layout"], "meta": {**meta, "cursor": cursor}}}


def over_speed(chart: Chart, speed: ArrayLike, units: Units, **how: Any) -> Chart:
    """Return a chart that can mark a running speed, on its x-axis unless `how` says otherwise.

    Parameters
    ----------
    chart : Chart
        The chart.
    speed : float
        The running speed at which it is drawn [rad/s].
    units : Units
        Units of display.
    **how
        As this module says.

    Returns
    -------
    Chart
        The chart, which says so.
    """
    now = float(units.speed.of(speed))
    return marked(chart, "speed", units.speed.name, now, **(how or {"axis": "x"}))


def over_film(
    chart: Chart, sweep: Sweep, point: Sweep, units: Units, against: Literal["ε", "σ"]
) -> Chart:
    """Return a chart over ε or σ that can mark the running speed at which a machine has it.

    Parameters
    ----------
    chart : Chart
        The chart, ε or σ along its x-axis.
    sweep, point : Sweep
        The machine over speed, and at the running speed.
    units : Units
        Units of display.
    against : str
        "ε" or "σ".

    Returns
    -------
    Chart
        The chart, which says so; as it is without load, where all speeds have one ε and σ.
    """
    if not np.isfinite(point.sommerfeld):
        return chart
    to = sweep.eccentricity_ratio if against == "ε" else sweep.sommerfeld
    at = units.speed.of(sweep.speed)
    return over_speed(chart, point.speed, units, axis="x", at=at, to=to)
