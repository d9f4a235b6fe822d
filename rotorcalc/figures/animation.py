"""Animation in the browser: frames that update a few traces, their slider and play buttons."""

from collections.abc import Sequence
from typing import Any

from rotorcalc.figures.style import Chart, Trace

# A frame without transition and redraw: only the traces' data change.
_STILL: dict[str, Any] = {
    "mode": "immediate",
    "frame": {"duration": 0, "redraw": False},
    "transition": {"duration": 0},
}
_GREY, _CLEAR = "rgba(127,127,127,0.35)", "rgba(0,0,0,0)"


def scrubbed(  # noqa: PLR0913 - steps, and the words of their slider
    chart: Chart,
    steps: Sequence[Sequence[Trace]],
    *,
    labels: Sequence[str],
    active: int,
    unit: str,
    prefix: str = "Slide the speed: ",
) -> Chart:
    """Return a chart with a slider below it that updates its last traces.

    Parameters
    ----------
    chart : Chart
        A chart whose last traces are the moving ones, in their state at the active step.
    steps : sequence of sequences of traces
        Their changed properties at each step.
    labels : sequence of str
        The steps' speeds.
    active : int
        The slider's initial step.
    unit : str
        The unit of the labels.
    prefix : str
        Words before the label of the step shown.

    Returns
    -------
    Chart
        The chart with its frames and its slider.
    """
    first = len(chart["data"]) - len(steps[0])
    places = list(range(first, len(chart["data"])))
    frames = [
        {"name": str(i), "data": list(step), "traces": places} for i, step in enumerate(steps)
    ]
    return {
        **chart,
        "frames": frames,
        "layout": {**chart["layout"], "sliders": [_slider(labels, active, unit, prefix)]},
    }


def playable(chart: Chart, *, step: int, y: float) -> Chart:
    """Return an animated chart with buttons to play and stop it.

    Parameters
    ----------
    chart : Chart
        A chart with frames.
    step : int
        Duration of each frame [ms].
    y : float
        Top of the buttons in fractions of the plot, negative below it.

    Returns
    -------
    Chart
        The chart with its buttons.
    """
    run = {
        "frame": {"duration": step, "redraw": False},
        "transition": {"duration": 0},
        "fromcurrent": True,
        "mode": "immediate",
    }
    menu = {
        "type": "buttons", "direction": "left", "showactive": False,
        "x": 0.0, "xanchor": "left", "y": y, "yanchor": "top", "pad": {"r": 6, "t": 6},
        "bgcolor": _GREY, "bordercolor": _GREY,
        "buttons": [
            {"label": "▶ Play", "method": "animate", "args": [None, run]},
            {"label": "❚❚ Stop", "method": "animate", "args": [[None], _STILL]},
        ],
    }  # fmt: skip
    return {**chart, "layout": {**chart["layout"], "updatemenus": [menu]}}


def _slider(labels: Sequence[str], active: int, unit: str, prefix: str) -> dict[str, Any]:
    return {
        "active": active,
        "steps": [
            {"method": "animate", "label": label, "args": [[str(i)], _STILL]}
            for i, label in enumerate(labels)
        ],
        "currentvalue": {"prefix": prefix, "suffix": f" {unit}", "xanchor": "left"},
        "pad": {"t": 66, "b": 4, "l": 0, "r": 0},
        "len": 1.0,
        "bgcolor": _GREY,
        "bordercolor": _CLEAR,
        "activebgcolor": "#f0b400",
        "tickcolor": _CLEAR,
        "ticklen": 3,
    }
