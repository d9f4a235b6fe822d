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
# Distances in pixels hold at any height of a chart: the slider lies below the title of the axis,
# with buttons to its left.
_BELOW, _BUTTONS = 64, 170
# Margin below a plot with a slider.
ROW = 134
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


def playable(chart: Chart, *, step: int) -> Chart:
    """Return an animated chart with buttons to play and stop it, beside its slider.

    Parameters
    ----------
    chart : Chart
        A chart with frames and a slider.
    step : int
        Duration of each frame [ms].

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
        "x": 0.0, "xanchor": "left", "y": 0.0, "yanchor": "top", "pad": {"t": _BELOW + 14},
        "bgcolor": _GREY, "bordercolor": _GREY,
        "buttons": [
            {"label": "▶ Play", "method": "animate", "args": [None, run]},
            {"label": "❚❚ Stop", "method": "animate", "args": [[None], _STILL]},
        ],
    }  # fmt: skip
    (slider,) = chart["layout"]["sliders"]
    beside = {**slider, "pad": {**slider["pad"], "l": _BUTTONS}}
    return {**chart, "layout": {**chart["layout"], "updatemenus": [menu], "sliders": [beside]}}


def _slider(labels: Sequence[str], active: int, unit: str, prefix: str) -> dict[str, Any]:
    return {
        "active": active,
        "steps": [
            {"method": "animate", "label": label, "args": [[str(i)], _STILL]}
            for i, label in enumerate(labels)
        ],
        "currentvalue": {
            "prefix": prefix, "suffix": f" {unit}", "xanchor": "left", "offset": 6,
            "font": {"size": 14},
        },
        "font": {"size": 1},  # of the steps' labels: the current one is enough
        "x": 0.0, "len": 1.0, "y": 0.0, "yanchor": "top",
        "pad": {"t": _BELOW, "b": 0, "l": 0, "r": 8},
        "bgcolor": _GREY,
        "bordercolor": _CLEAR,
        "activebgcolor": "#f0b400",
        "tickcolor": _CLEAR,
        "ticklen": 0,
        "minorticklen": 0,
    }  # fmt: skip
