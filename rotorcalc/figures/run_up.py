"""Charts of a run-up and a run-down: amplitude over speed both ways, and the spectra."""

import math
from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.figures import cursor, style
from rotorcalc.figures.orbits import DOWN, LINEAR, UP, branch_lines, guide_names, guides
from rotorcalc.figures.style import Axis, Chart, Trace, titled
from rotorcalc.nonlinear.limit_cycles import Bifurcation
from rotorcalc.nonlinear.run_up import Passage, RunUp
from rotorcalc.units import Unit, Units

_HEIGHT = 560
_MARGIN = {"l": 64, "r": 28, "t": 40, "b": 96}
_LEGEND = {"orientation": "h", "x": 0, "yref": "container", "y": 0, "yanchor": "bottom"}
# Decades of amplitude below the highest that a waterfall shows: down to the noise.
_DECADES = 3.0
# Lines that can be read on a waterfall, whose low amplitudes are dark.
_ON_DARK = "#ffffff"


@dataclass(frozen=True)
class Marks:
    """Speeds to mark [rad/s]: onset, running speed, where whirl is expected; NaN for none."""

    onset: float
    running_speed: float
    expected: float


def hysteresis(run: RunUp, branch: Bifurcation | None, marks: Marks, units: Units) -> Chart:
    """Return the amplitude at rising and at falling speed, the limit cycles behind it."""
    unit, ends = units.amplitude, units.speed.of(np.sort(run.up.speed[[0, -1]]))
    x = style.axis(titled("Running speed", "Ω", units.speed.name), *map(float, ends))
    largest = max(float(way.amplitude.max()) for way in (run.up, run.down))
    top = float(unit.of(max(run.clearance, 1.05 * largest)))
    y = style.axis(f"Amplitude of the journal [{unit.name}]", 0.0, top)
    traces = [
        *_behind(branch, units),
        _way(run.up, "speed rising ▸", UP, units),
        _way(run.down, "speed falling ◂", DOWN, units),
        *(
            _upright(speed, name, colour, (x, y), units)
            for speed, name, colour in (
                (marks.onset, "onset", style.UNSTABLE),
                (marks.expected, "expected from the growth rate", LINEAR),
                (marks.running_speed, "running speed", style.HERE),
            )
            if np.isfinite(speed)
        ),
    ]
    chart = style.chart(traces, x, y, height=_HEIGHT, margin=_MARGIN, legend=_LEGEND)
    return cursor.over_speed(chart, marks.running_speed, units)


def waterfall(passage: Passage, clearance: float, marks: Marks, units: Units) -> Chart:
    """Return the spectra of a passage over orders and speed, the linear theory's whirl on them."""
    unit, seen = units.amplitude, passage.seen
    rising = np.argsort(seen.speed)
    speed, size = units.speed.of(seen.speed[rising]), unit.of(seen.amplitude[rising])
    x = style.axis("Frequency over running speed, order [-]", 0.0, 1.5, dtick=0.25)
    y = style.axis(titled("Running speed", "Ω", units.speed.name), speed[0], speed[-1])
    heat = _heat(seen.order, speed, size, float(unit.of(clearance)), unit)
    heat["hovertemplate"] = (
        f"%{{x:.3f}}×, %{{y:.0f}} {units.speed.name}<br>%{{customdata:.3g}} {unit.name}"
        "<extra></extra>"
    )
    traces = [
        heat,
        style.line(passage.whirl_order[rising], speed, "linear theory's whirl", _ON_DARK,
                   dash="dash", width=2.0),
        _across(marks.onset, "onset", style.UNSTABLE, units, y),
        _across(marks.running_speed, "running speed", style.HERE, units, y),
    ]  # fmt: skip
    chart = style.chart(
        traces, x, y, shapes=guides(_ON_DARK, 1.2),
        annotations=guide_names("½×, whirl", "1×, imbalance"), height=_HEIGHT,
        margin=_MARGIN, legend=_LEGEND,
    )  # fmt: skip
    return cursor.over_speed(chart, marks.running_speed, units, axis="y")


def _heat(order: Array, speed: Array, size: Array, clearance: float, unit: Unit) -> Trace:
    """Return a map of amplitudes, its colours logarithmic: small whirl and imbalance both show."""
    top = math.log10(style.ceiling(max(clearance, float(size.max()))))
    low = top - _DECADES
    ticks = list(range(math.ceil(low), math.floor(top) + 1))
    bar = {
        "title": {"text": f"Amplitude of the circle [{unit.name}]", "side": "right"},
        "thickness": 14, "outlinewidth": 0,
        "tickvals": ticks, "ticktext": [f"{10.0**tick:g}" for tick in ticks],
    }  # fmt: skip
    return {
        "type": "heatmap", "name": "spectrum", "x": order, "y": speed,
        "z": np.log10(np.maximum(size, 10.0**low)).astype(np.float32),
        "customdata": size.astype(np.float32),
        "zmin": low, "zmax": top, "colorscale": "Cividis", "zsmooth": "best", "colorbar": bar,
    }  # fmt: skip


def _way(passage: Passage, name: str, colour: str, units: Units) -> Trace:
    at, size = units.speed.of(passage.speed), units.amplitude.of(passage.amplitude)
    hover = f"%{{x:.0f}} {units.speed.name}, %{{y:.3g}} {units.amplitude.name}"
    return style.line(at, size, name, colour, hovertemplate=f"{hover}<extra>{name}</extra>")


def _behind(branch: Bifurcation | None, units: Units) -> list[Trace]:
    """Return the limit cycles in the same measure, faint, where they are known."""
    if branch is None:
        return []
    at = units.speed.of(np.append(branch.hopf.speed, branch.speed))
    size = units.amplitude.of(np.append(0.0, branch.zero_to_peak))
    return [{**line, "opacity": 0.45} for line in branch_lines(at, size, branch)]


def _upright(speed: float, name: str, colour: str, axes: tuple[Axis, Axis], units: Units) -> Trace:
    """Return a line up the chart at a speed, where that is within the axis."""
    (low, high), (_, top) = (axis["range"] for axis in axes)
    at = float(units.speed.of(speed))
    inside = low <= at <= high
    words = f"{name}, {at:.0f} {units.speed.name}" if inside else f"{name}: outside"
    ends = np.array([0.0, top] if inside else np.empty(0))
    return style.line(np.full(len(ends), at), ends, words, colour, dash="dash", width=1.8)


def _across(speed: float, name: str, colour: str, units: Units, y: Axis) -> Trace:
    """Return a line across the orders at a speed, where that is within the axis."""
    at = float(units.speed.of(speed))
    inside = y["range"][0] <= at <= y["range"][1]
    words = f"{name}, {at:.0f} {units.speed.name}" if inside else f"{name}: outside"
    ends = np.array([0.0, 1.5] if inside else np.empty(0))
    return style.line(ends, np.full(len(ends), at), words, colour, width=2.0)
