"""Charts of nonlinear orbits: a released journal, its spectrum, and the limit cycles.

In the plane X, along the load, points down and Y to the right, so the shaft turns counterclockwise.
The linear theory is always drawn in purple, broken.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rotorcalc.arrays import Array
from rotorcalc.figures import cursor, plane, style, text
from rotorcalc.figures.animation import ROW, playable, scrubbed
from rotorcalc.figures.style import Axis, Chart, Trace, titled
from rotorcalc.nonlinear.limit_cycles import Bifurcation
from rotorcalc.nonlinear.measured_onset import GrowthCurve, Onsets
from rotorcalc.nonlinear.release import Release
from rotorcalc.units import Unit, Units

LINEAR, RING = style.PURPLE, style.OCHRE
UP, DOWN = style.GREEN, style.OCHRE
# Tall: the clearance is the page's main picture.
_PLANE_HEIGHT = 550
# Frames of an animation at most, points of the journal's trail, revolutions that the trail spans.
_FRAMES, _TRAIL, _REACH = 120, 48, 2.0
# Points of a line over time; more cannot be distinguished on a screen.
_MOST_POINTS = 6000
_MARGIN = {"l": 64, "r": 28, "t": 16, "b": 96}
_LEGEND = {"orientation": "h", "x": 0, "yref": "container", "y": 0, "yanchor": "bottom"}


def orbit(let_go: Release, units: Units) -> Chart:
    """Return the journal's path in its clearance, with play buttons and a slider."""
    unit = units.film
    x, y = _plane_axes(let_go, unit)
    steps, labels = _steps(let_go, unit)
    rest = unit.of(let_go.rest)
    still = [
        _wall(let_go, unit),
        _path(let_go.motion.journal, unit, "whole path", style.GREY, width=0.8, opacity=0.6),
        *_steady(let_go, unit),
        {
            **style.mark(rest[1], rest[0], "rest", style.GREY),
            "marker": {"size": 7, "color": style.GREY, "symbol": "x"},
        },
    ]
    chart = plane.chart(
        [*still, *_moving(steps[-1])], x, y, height=_PLANE_HEIGHT, showlegend=True,
        margin={"l": 64, "r": 28, "t": 56, "b": ROW},
    )  # fmt: skip
    chart = scrubbed(
        chart, steps, labels=labels, active=len(labels) - 1, unit="", prefix="Revolution ",
    )  # fmt: skip
    frames = [float(label) for label in labels]
    return _over_turns(playable(chart, step=60), let_go, frames=frames)


def over_time(let_go: Release, units: Units) -> Chart:
    """Return X and Y of the journal over revolutions, and the linear theory's."""
    unit, at = units.film, let_go.revolutions
    last = float(let_go.revolutions[-1])
    (X, Y) = unit.of(np.abs(let_go.wall).max(axis=0))
    x = style.axis("Revolutions since the release [-]", 0.0, last, anchor="y2")
    y = style.axis(f"X [{unit.name}]", -X, X, domain=style.UPPER)
    y2 = style.axis(f"Y [{unit.name}]", -Y, Y, domain=style.LOWER)
    motion, linear = unit.of(let_go.motion.journal), unit.of(let_go.linear)
    panes = [
        [
            style.line(at, linear[:, i], "linear theory", LINEAR, width=1.2, dash="dot",
                       showlegend=i == 0, **_long(let_go)),
            style.line(at, motion[:, i], "journal", style.JOURNAL, width=1.4, showlegend=i == 0,
                       **_long(let_go)),
            style.mark(last, motion[-1, i], "end", showlegend=False),
        ]
        for i in (0, 1)
    ]  # fmt: skip
    chart = style.chart(
        [*panes[0], *style.lower(panes[1])], x, y, yaxis2=y2,
        height=_PLANE_HEIGHT, margin=_MARGIN, legend=_LEGEND,
    )  # fmt: skip
    return _over_turns(chart, let_go)


def film(let_go: Release, units: Units) -> Chart:
    """Return the minimum film thickness over revolutions, its smallest value marked."""
    unit, thickness = units.film, let_go.film
    place = int(np.argmin(thickness))
    x = style.axis("Revolutions since the release [-]", 0.0, float(let_go.revolutions[-1]))
    # No film is thicker than a journal's way to the wall.
    top = max(let_go.clearance, float(thickness.max()))
    y = style.axis(titled("Thinnest film", "h", unit.name), 0.0, float(unit.of(top)))
    least = f"least, {text.amount(unit, thickness[place])}"
    traces = [
        style.line(let_go.revolutions, unit.of(thickness), "thinnest film", style.JOURNAL,
                   width=1.4, **_long(let_go)),
        style.mark(let_go.revolutions[place], unit.of(thickness[place]), least),
    ]  # fmt: skip
    return _over_turns(style.chart(traces, x, y, margin=_MARGIN, legend=_LEGEND), let_go)


def growth(let_go: Release, units: Units) -> Chart:
    """Return the distance from rest over revolutions, with the linear theory's growth or decay."""
    unit, (at, size) = units.film, let_go.peaks
    C = float(unit.of(let_go.clearance))
    shown, predicted = unit.of(size), unit.of(let_go.predicted_peaks)
    floor = max(min(float(shown[shown > 0.0].min(initial=C)), C / 10.0), C * 1e-6)
    y = style.axis(
        f"Largest distance from rest [{unit.name}]",
        0.8 * floor,
        2.0 * C,
        log=True,
        dtick="D2" if floor > 1e-3 * C else 1,
    )
    x = style.axis("Revolutions since the release [-]", 0.0, float(let_go.revolutions[-1]))
    inside = np.where((predicted < 2.0 * C) & (predicted > 0.5 * floor), predicted, np.nan)
    traces = [
        style.line(at, np.where(shown > 0.0, shown, np.nan), "journal", style.JOURNAL),
        style.line(at, inside, "linear theory, e<sup>Re λ t</sup>", LINEAR, dash="dash"),
        style.mark(at[-1], max(float(shown[-1]), 0.8 * floor), "end"),
    ]
    return _over_turns(style.chart(traces, x, y, margin=_MARGIN, legend=_LEGEND), let_go)


def spectrum(let_go: Release, units: Units) -> Chart:
    """Return the spectrum of the journal's motion over orders of the running speed."""
    unit, seen = units.amplitude, let_go.spectrum
    x = style.axis("Frequency over running speed, order [-]", -1.5, 2.5, dtick=0.5)
    lines = [seen.whirl, seen.synchronous]
    top = style.ceiling(1.1 * unit.of([*lines, float(seen.amplitude.max())]))
    y = style.axis(f"Amplitude of the circle [{unit.name}]", 0.0, top)
    speed = float(let_go.motion.speed[0])
    traces = [
        style.line(seen.order, unit.of(seen.amplitude), "journal", style.JOURNAL, width=1.6),
        style.mark(1.0, unit.of(seen.synchronous), "1×, imbalance"),
    ]
    if seen.whirl > 0.0:
        name = f"whirl, {text.number(seen.whirl_ratio)}×"
        traces.append(style.mark(seen.whirl_ratio, unit.of(seen.whirl), name, style.UNSTABLE))
    if np.isfinite(let_go.whirl.imag):
        at = let_go.whirl.imag / speed
        name = f"linear theory's whirl, {text.number(at)}×"
        traces.append(style.line([at, at], [0.0, top], name, LINEAR, dash="dash", width=1.6))
    return style.chart(
        traces, x, y, shapes=guides(), annotations=guide_names(), height=460,
        margin={**_MARGIN, "t": 40}, legend=_LEGEND,
    )  # fmt: skip


def once_a_revolution(let_go: Release, units: Units) -> Chart:
    """Return the journal's positions once per revolution, the last quarter emphasised."""
    unit = units.film
    x, y = _plane_axes(let_go, unit)
    points = unit.of(let_go.points)
    late = points[-max(len(points) // 4, 4) :]
    dots: dict[str, Any] = {"mode": "markers", "marker": {"size": 4, "color": style.GREY}}
    traces: list[Trace] = [
        _wall(let_go, unit),
        {**style.line(points[:, 1], points[:, 0], "all", style.GREY), **dots},
        style.mark(late[:, 1], late[:, 0], "last quarter"),
    ]
    traces[-1]["marker"] = {**traces[-1]["marker"], "size": 7}
    return plane.chart(
        traces, x, y, height=460, showlegend=True, margin=_MARGIN, legend=_LEGEND
    )  # fmt: skip


def cycles(
    branch: Bifurcation,
    swept: tuple[Array, Array, Array] | None,
    running_speed: float,
    units: Units,
) -> Chart:
    """Return the limit cycles over speed, stable solid and unstable broken, with two sweeps.

    `swept` holds rising speeds [rad/s] and the amplitudes as the speed slowly rises and falls [m];
    None where rest is unstable below this onset, and no sweep begins there. A floating ring's
    amplitude is a thin line beside the journal's.
    """
    C, onset = branch.hopf.clearance, float(units.speed.of(branch.hopf.speed))
    at = units.speed.of(np.append(branch.hopf.speed, branch.speed))
    size = np.append(0.0, branch.amplitude) / C
    low, high = float(at.min()), float(at.max())
    room = 0.12 * (high - low)
    here = float(units.speed.of(running_speed))
    ends = min(low - room, 0.97 * onset), max(high, 1.03 * onset)
    x = style.axis(titled("Running speed", "Ω", units.speed.name), *ends)
    y = style.axis("Largest distance a/C [-]", 0.0, _top(size))
    traces = [
        *_of_ring(at, branch),
        *branch_lines(at, size, branch),
        *_rest(ends, ends[0] if swept is None else onset),
        *([] if swept is None else _sweeps(swept, C, units)),
        style.mark(onset, 0.0, f"onset, {onset:.0f} {units.speed.name}", style.UNSTABLE),
        *_folds(branch, units),
    ]  # fmt: skip
    if ends[0] <= here <= ends[1]:
        traces += _here_line(here, y)
        amplitudes, _ = branch.at(running_speed)
        traces.append(style.mark(np.full(len(amplitudes) + 1, here),
                                 np.append(0.0, amplitudes / C), "running speed"))  # fmt: skip
    else:
        edge = ends[0] if here < ends[0] else ends[1]
        traces.append(style.mark(edge, 0.0, "running speed, outside"))
    chart = style.chart(traces, x, y, height=560, margin=_MARGIN, legend=_LEGEND)
    return cursor.over_speed(chart, running_speed, units)


def onset_growth(found: Onsets, curve: GrowthCurve, units: Units) -> Chart:
    """Return growth rates over speed, by eigenvalues and as measured, with the three onsets."""
    x = style.axis(
        titled("Running speed", "Ω", units.speed.name),
        *(float(value) for value in units.speed.of(curve.speed[[0, -1]])),
    )
    rates = np.concatenate([curve.rate, curve.measured[np.isfinite(curve.measured)]])
    reach = style.ceiling(np.abs(rates))
    y = style.axis(titled("Growth rate", "", units.growth.name), -reach, reach)
    zero = float(units.speed.of(found.eigenvalues))
    traces = [
        style.line(x["range"], [0.0, 0.0], "zero growth", style.GREY, width=1.2,
                   showlegend=False),
        style.line(units.speed.of(curve.speed), curve.rate, "eigenvalues, max Re λ", LINEAR,
                   dash="dash"),
        {**style.mark(units.speed.of(curve.measured_speed), curve.measured, "measured in time",
                      style.JOURNAL), "mode": "markers"},
        style.mark(zero, 0.0, f"onset, {zero:.0f} {units.speed.name}", style.UNSTABLE),
    ]  # fmt: skip
    here = float(units.speed.of(curve.running_speed))
    inside = x["range"][0] <= here <= x["range"][1] and abs(curve.running_rate) <= reach
    place = [[here, curve.running_rate]] if inside else np.empty((0, 2))
    at, rate = np.asarray(place, dtype=float).T
    name = "running speed" if inside else "running speed: outside"
    chart = style.chart(
        [*traces, style.mark(at, rate, name)], x, y, height=460, margin=_MARGIN, legend=_LEGEND
    )
    return cursor.over_speed(chart, curve.running_speed, units)


# --- The plane --------------------------------------------------------------------------------


def _plane_axes(let_go: Release, unit: Unit) -> tuple[Axis, Axis]:
    reach = 1.06 * float(unit.of(np.hypot(*let_go.wall.T).max()))
    x = style.axis(titled("Y", "", unit.name), -reach, reach)
    return x, style.axis(f"X, along the load [{unit.name}]", reach, -reach)


def _wall(let_go: Release, unit: Unit) -> Trace:
    return plane.line(unit.of(let_go.wall), "clearance", style.GREY, width=1.8, showlegend=False)


def _path(points: Array, unit: Unit, name: str, colour: str, **extra: Any) -> Trace:
    return plane.line(unit.of(_thin(points)), name, colour, **extra)


def _steady(let_go: Release, unit: Unit) -> list[Trace]:
    """Return the linear theory's synchronous orbit, where there is one and it stays."""
    if let_go.whirl.real >= 0.0 or not np.ptp(let_go.ellipse):
        return []
    name = "linear theory, steady"
    return [plane.line(unit.of(let_go.ellipse), name, LINEAR, dash="dot", width=1.6)]


def _steps(let_go: Release, unit: Unit) -> tuple[list[list[Trace]], list[str]]:
    """Return the moving traces at each step of the animation, and the steps' labels.

    Single precision suffices on screen.
    """
    n, turns = len(let_go.motion.time), let_go.revolutions
    ends = np.unique(np.linspace(0, n - 1, min(_FRAMES, n)).astype(int))
    back = np.linspace(_REACH * (n - 1) / float(turns[-1]), 0.0, _TRAIL)
    trails = np.maximum(ends[:, None] - back, 0.0).astype(int)
    journal, linear = (
        unit.of(points).astype(np.float32) for points in (let_go.motion.journal, let_go.linear)
    )
    steps = [
        [_at(path[places]) for path in (linear, journal) for places in (trail, trail[-1:])]
        for trail in trails
    ]
    if let_go.ring is not None:
        around = unit.of(plane.arc(0.0, 2.0 * math.pi, let_go.clearance)).astype(np.float32)
        ring = unit.of(let_go.ring).astype(np.float32)
        for step, trail in zip(steps, trails, strict=True):
            step[:0] = [_at(ring[trail]), _at(ring[trail[-1]] + around)]
    return steps, [f"{turns[end]:.1f}" for end in ends]


def _moving(step: list[Trace]) -> list[Trace]:
    """Return the moving traces at a step: trails of both journals, and where they are now.

    With a floating ring its centre's trail comes first, and where its clearance lies.
    """
    still = np.zeros((1, 2))
    of_ring = [
        plane.line(still, "ring", RING, width=2.0),
        plane.line(still, "clearance in the ring", RING, width=1.2, dash="dot", showlegend=False),
    ]
    of_journals = [
        plane.line(still, "linear theory", LINEAR, dash="dash", width=1.6),
        style.mark(0.0, 0.0, "linear journal", LINEAR, showlegend=False, opacity=0.8),
        plane.line(still, "journal", style.JOURNAL, width=2.6),
        style.mark(0.0, 0.0, "now"),
    ]
    traces = of_journals if len(step) == len(of_journals) else [*of_ring, *of_journals]
    return [trace | place for trace, place in zip(traces, step, strict=True)]


def _at(points: NDArray[np.float32]) -> Trace:
    return {"x": points[:, 1], "y": points[:, 0]}


def _over_turns(chart: Chart, let_go: Release, **how: Any) -> Chart:
    """Return a chart that can mark a moment of the motion, on its x-axis unless `how` says else."""
    last = float(let_go.revolutions[-1])
    return cursor.marked(chart, "revolutions", "revolutions", last, **(how or {"axis": "x"}))


# --- Over orders and speed --------------------------------------------------------------------


def _long(let_go: Release) -> dict[str, Any]:
    """Return what makes a line an envelope where its swings lie too close to be seen.

    Its value is the number of points in a swing: two revolutions, a turn of a whirl at half speed.
    """
    return {"meta": {"envelope": int(np.searchsorted(let_go.motion.angle, 4.0 * math.pi))}}


def _thin(values: Array) -> Array:
    """Return values thinned evenly to at most 6000 points."""
    return values[:: max(1, math.ceil(len(values) / _MOST_POINTS))]


def guides(colour: str = style.GREY, width: float = 1.4) -> list[dict[str, Any]]:
    """Return lines at half the running speed and at the running speed, over an axis of orders."""
    return [
        {"type": "line", "x0": order, "x1": order, "y0": 0, "y1": 1, "yref": "paper",
         "line": {"color": colour, "width": width, "dash": "dot"}}
        for order in (0.5, 1.0)
    ]  # fmt: skip


def guide_names(half: str = "½×", once: str = "1×") -> list[dict[str, Any]]:
    """Return the names of these lines."""
    return [
        {"text": name, "x": order, "y": 1.0, "yref": "paper", "yanchor": "bottom",
         "showarrow": False}
        for order, name in ((0.5, half), (1.0, once))
    ]  # fmt: skip


def _top(size: Array) -> float:
    return style.ceiling(1.02 * size, 1.0)


def branch_lines(at: Array, size: Array, branch: Bifurcation) -> list[Trace]:
    """Return the branch in two lines that meet, stable solid and unstable broken."""
    stable = np.append(branch.stable[0], branch.stable)
    unstable = ~stable
    joint = unstable.copy()
    joint[:-1] |= unstable[1:]
    joint[1:] |= unstable[:-1]
    hover = "%{x:.0f}, a/C = %{y:.3f}<extra>%{fullData.name}</extra>"
    lines: list[Trace] = []
    if stable.any():
        lines.append(
            style.line(at, np.where(stable, size, np.nan), "limit cycle, stable", style.JOURNAL,
                       width=3.2, hovertemplate=hover)
        )  # fmt: skip
    if unstable.any():
        lines.append(
            style.line(at, np.where(joint, size, np.nan), "limit cycle, unstable", style.UNSTABLE,
                       dash="dash", hovertemplate=hover)
        )  # fmt: skip
    # The cycles are few, so a spline draws the smooth curve on which they lie.
    return [{**line, "line": {**line["line"], "shape": "spline"}} for line in lines]


def _of_ring(at: Array, branch: Bifurcation) -> list[Trace]:
    """Return the amplitude of a floating ring along the branch."""
    if not branch.inner_amplitude.any():
        return []
    size = np.append(0.0, branch.inner_amplitude) / branch.hopf.clearance
    hover = "%{x:.0f}, a/C = %{y:.3f}<extra>%{fullData.name}</extra>"
    line = style.line(at, size, "the ring's distance", RING, width=1.4,
                      hovertemplate=hover)  # fmt: skip
    return [{**line, "line": {**line["line"], "shape": "spline"}}]


def _rest(ends: tuple[float, float], onset: float) -> list[Trace]:
    """Return the equilibrium, stable below its onset and unstable above."""
    return [
        style.line([ends[0], onset], [0.0, 0.0], "rest, stable", style.JOURNAL, width=3.2,
                   showlegend=False, cliponaxis=False),
        style.line([onset, ends[1]], [0.0, 0.0], "rest, unstable", style.JOURNAL, dash="dot",
                   showlegend=False, cliponaxis=False),
    ]  # fmt: skip


def _sweeps(swept: tuple[Array, Array, Array], C: float, units: Units) -> list[Trace]:
    speed, up, down = swept
    at = units.speed.of(speed)
    return [
        style.line(at, up / C, "speed slowly rising ▸", UP, width=1.6, dash="dot"),
        style.line(at, down / C, "speed slowly falling ◂", DOWN, width=1.6, dash="dot"),
    ]


def _folds(branch: Bifurcation, units: Units) -> list[Trace]:
    folds = branch.folds
    if not len(folds):
        return []
    sizes = branch.fold_amplitudes / branch.hopf.clearance
    words = ", ".join(f"{speed:.0f}" for speed in units.speed.of(folds))
    name = f"{'fold' if len(folds) == 1 else 'folds'}, {words} {units.speed.name}"
    return [style.mark(units.speed.of(folds), sizes, name, style.PURPLE)]


def _here_line(here: float, y: Axis) -> list[Trace]:
    ends: ArrayLike = y["range"]
    guide = style.line([here, here], ends, "running speed", style.GREY, dash="dash", width=1.2)
    return [{**guide, "showlegend": False, "hoverinfo": "skip"}]
