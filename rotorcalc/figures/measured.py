"""What was measured on a machine, laid over the charts of a computed one, always in one colour.

Each function takes a chart and returns it with the measured lines on top and axes that hold them.
"""

import math

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.figures import style
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.measured import MeasuredOrbit, MeasuredResponse
from rotorcalc.nonlinear.signals import Spectrum
from rotorcalc.units import Units

# Of an orbit as many revolutions are drawn at most: a whirl near one half then turns four times.
TURNS = 8
_MOST_POINTS = 4000
_HEADROOM = 1.1
# Small and without a line, so that the computed curves are seen through them.
_MARK = {"size": 6, "color": style.MEASURED}


def over_orbit(chart: Chart, found: MeasuredOrbit, rest: Array, units: Units) -> Chart:
    """Return a chart of the plane with the last revolutions of a measured orbit.

    Parameters
    ----------
    chart : Chart
        With Y to the right and X downward.
    found : MeasuredOrbit
        The orbit. Where its mean was removed it is drawn about the place of rest.
    rest : array, (2,)
        Static equilibrium of the journal, in X, Y from the bearing's centre [m].
    units : Units
        Units of display.

    Returns
    -------
    Chart
        The chart; a frame of its animation leaves the measured orbit as it is.
    """
    first = int(np.searchsorted(found.angle, float(found.angle[-1]) - 2.0 * np.pi * TURNS))
    path = found.position[first:]
    path = path[:: max(1, len(path) // _MOST_POINTS)]
    about = np.zeros(2) if (found.mean == 0.0).all() else rest
    X, Y = units.film.of(path + about).T
    lines = [_line(Y, X, "measured", width=1.6)]
    reach = float(np.max(np.abs([X, Y])))
    return _with(chart, lines, {"xaxis": 1.05 * reach, "yaxis": 1.05 * reach})


def over_spectrum(chart: Chart, seen: Spectrum, units: Units) -> Chart:
    """Return a chart of amplitudes over orders with those of a measured orbit."""
    size = units.amplitude.of(seen.amplitude)
    top = _HEADROOM * float(size.max(initial=0.0))
    return _with(chart, [_line(seen.order, size, "measured", width=1.6)], {"yaxis": top})


def over_amplitude(chart: Chart, found: MeasuredResponse, shown: str, units: Units) -> Chart:
    """Return a chart of amplitudes over speed with the measured ones.

    `shown` is "axes" for those of the orbit, "XY" for X and Y.
    """
    if shown == "XY":
        names, sizes = ("X", "Y"), list(found.amplitude.T)
    else:
        ellipse = found.ellipse
        names, sizes = ("major", "|minor|"), [ellipse.semi_major, np.abs(ellipse.semi_minor)]
    sizes = [units.amplitude.of(size) for size in sizes]
    top = _HEADROOM * float(np.max(sizes))
    return _with(chart, _over_speed(found, sizes, names, units), {"yaxis": top})


def over_phase(chart: Chart, found: MeasuredResponse, units: Units) -> Chart:
    """Return a chart of phase lags over speed with those of X and Y that were measured."""
    low, high = sorted(chart["layout"]["yaxis"]["range"])
    lags = units.angle.of(found.lag)
    shown = [_nearest(lag, 0.5 * (low + high)) for lag in lags.T]
    # Phases may lie outside those computed.
    low = min(low, *(90.0 * math.floor(float(lag.min()) / 90.0) for lag in shown))
    high = max(high, *(90.0 * math.ceil(float(lag.max()) / 90.0) for lag in shown))
    chart = _with(chart, _over_speed(found, shown, ("X", "Y"), units), {})
    axis = {**chart["layout"]["yaxis"], "range": [low, high]}
    return {**chart, "layout": {**chart["layout"], "yaxis": axis}}


def _nearest(lag: Array, middle: float) -> Array:
    """Return a phase [°] with as many whole turns added as bring it nearest to the middle."""
    away = middle - float(np.median(lag))
    return lag + 360.0 * round(away / 360.0)


def _over_speed(
    found: MeasuredResponse, values: list[Array], names: tuple[str, str], units: Units
) -> list[Trace]:
    """Return marks, filled the first and open the second."""
    at = units.speed.of(found.speed)
    return [
        style.mark(
            at, value, f"measured {name}", marker={**_MARK, "symbol": symbol}, **style.LIVE_ONLY
        )
        for value, name, symbol in zip(values, names, ("square", "square-open"), strict=True)
    ]


def _line(x: Array, y: Array, name: str, **look: object) -> Trace:
    return style.line(x, y, name, style.MEASURED, **look, **style.LIVE_ONLY)


def _with(chart: Chart, traces: list[Trace], reach: dict[str, float]) -> Chart:
    """Return a chart with traces on top, its axes reaching as far as some readings."""
    # After the chart's own traces: frames know these by their places.
    layout = {**chart["layout"]}
    for name, needed in reach.items():
        layout[name] = _reaching(layout[name], needed)
    return {**chart, "data": [*chart["data"], *traces], "layout": layout}


def _reaching(axis: Axis, needed: float) -> Axis:
    """Return an axis whose larger end, and a smaller one below zero, reaches a reading."""
    ends = axis["range"]
    if needed <= max(ends):
        return axis
    # A reversed axis stays so, and one from zero begins there.
    new = style.ceiling(needed, steps=style.CLOSE)
    wider = [float(np.sign(end)) * new for end in ends]
    return {**axis, "range": wider, **style.ticks(wider[0], wider[1])}
