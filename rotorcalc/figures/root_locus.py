"""Charts of the root locus: the complex plane, and the window in which modes whirl."""

import itertools
from typing import Any

import numpy as np

from rotorcalc import modes
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.figures import cursor, style
from rotorcalc.figures.animation import ROW, playable, scrubbed
from rotorcalc.figures.style import Axis, Chart, Trace, titled
from rotorcalc.figures.text import number
from rotorcalc.onset import Onset
from rotorcalc.root_locus import Locus
from rotorcalc.units import Units

# Stops of the speed slider, one every 2.5 % of the top speed.
_STEPS = 40
# From slow to fast, distinct for colour-blind readers, contrast 3 : 1 on light and dark.
_SLOW_TO_FAST = ((43, 123, 186), (176, 86, 159), (214, 128, 10))
_EIGENVALUES = "eigenvalues"
# A Plotly line has one colour, so a branch is drawn in pieces; with twelve the steps hardly show.
_PIECES = 12
# A mode with a larger damping ratio hardly oscillates, and lies far to the left of the others.
HARDLY_SWINGS = 0.7
# Damping ratios of the rays, each twice the previous one: light damping matters most.
_RAYS = (0.05, 0.1, 0.2, 0.4)
_HOVER = "Ω %{customdata:.0f}<br>Re λ %{x:.4g}<br>Im λ %{y:.0f}<extra></extra>"
Item = dict[str, Any]


def plane(locus: Locus, onset: Onset, units: Units) -> Chart:
    """Return the root locus in the upper half of the complex plane, with its speed slider.

    Parameters
    ----------
    locus : Locus
        Eigenvalues over speed and at the running speed.
    onset : Onset
        Where the same machine becomes unstable.
    units : Units
        The reader's units.
    """
    axes = _axes(locus, units)
    speeds, steps, active = _steps(locus, axes[0], units)
    traces = [*_path(locus, onset, axes, units), *_moving(steps[active])]
    chart = _half_planes(traces, axes, locus, units, b=ROW)
    stops = units.speed.of(speeds)
    labels = [f"{stop:.0f}" for stop in stops]
    chart = scrubbed(chart, steps, labels=labels, active=active, unit=units.speed.name)
    return cursor.over_speed(
        playable(chart, step=120), locus.running_speed, units, frames=stops, along=_EIGENVALUES
    )


def still(locus: Locus, onset: Onset, units: Units) -> Chart:
    """Return the root locus without a speed slider of its own."""
    axes = _axes(locus, units)
    chart = _half_planes(_path(locus, onset, axes, units), axes, locus, units, b=64)
    return cursor.over_speed(chart, locus.running_speed, units, along=_EIGENVALUES)


def at_running_speed(locus: Locus, units: Units) -> Chart:
    """Return the eigenvalues at the running speed alone, on the axes of the root locus."""
    axes, here = _axes(locus, units), locus.here.eigenvalues
    marks = style.mark(here.real, whirl_frequency(here, units), "running speed")
    return _half_planes([{**marks, "cliponaxis": True}], axes, locus, units, b=64)


def _axes(locus: Locus, units: Units) -> tuple[Axis, Axis]:
    left, right, top = window(locus, units)
    return (
        style.axis(titled("Growth rate", "Re λ", units.growth.name), -left, right),
        style.axis(titled("Mode frequency", "Im λ", units.speed.name), 0.0, top),
    )


def _path(locus: Locus, onset: Onset, axes: tuple[Axis, Axis], units: Units) -> list[Trace]:
    return [
        *_coloured_branches(locus, units),
        _colour_bar(locus, units),
        *_crossing(onset, locus, units),
        *_here(locus, axes, units),
    ]


def _here(locus: Locus, axes: tuple[Axis, Axis], units: Units) -> list[Trace]:
    here = locus.here.eigenvalues
    return points(locus, here.real, whirl_frequency(here, units), *axes)


def _half_planes(
    traces: list[Trace], axes: tuple[Axis, Axis], locus: Locus, units: Units, *, b: int
) -> Chart:
    """Return a chart of the half planes where motions decay and grow; `b` is its lower margin."""
    (left, right), (_, top) = (axis["range"] for axis in axes)
    rays = _rays(-left, top, units)
    return style.chart(
        traces, *axes,
        height=580, margin={"l": 64, "r": 28, "t": 44, "b": b},
        shapes=[_half_plane(right), _imaginary_axis(), *(ray for ray, _ in rays)],
        annotations=[*_sides(), *(name for _, name in rays), *_numbers(locus, units, -left, top)],
    )  # fmt: skip


def beyond(locus: Locus, units: Units) -> str:
    """Return a text naming the modes at the running speed that lie outside the view."""
    left, right, top = window(locus, units)
    words: list[str] = []
    for i, value in enumerate(locus.here.eigenvalues):
        frequency = float(whirl_frequency(value, units))
        if value.imag < 0.0 or (-left <= value.real <= right and frequency <= top):
            continue  # the mirror image of another mode, or inside
        whirl = f"{frequency:.0f} {units.speed.name}" if value.imag > 0.0 else "does not oscillate"
        rate = number(value.real, 3)
        words.append(f"{locus.name(i)} ({whirl}, {rate} {units.growth.name})")
    return f"Outside this view at the running speed: {', '.join(words)}." if words else ""


def window(locus: Locus, units: Units) -> tuple[float, float, float]:
    """Return the extents of a view of the whirling modes to the left, right and top."""
    real, frequency = _whirling(locus, units)
    left = style.ceiling(-real)
    return left, max(style.ceiling(real), left / 3.0), style.ceiling(frequency)


def whirl_frequency(eigenvalue: ComplexArray | complex, units: Units) -> Array:
    """Return the imaginary part of eigenvalues as whirl frequency in a reader's unit."""
    return units.speed.of(np.imag(eigenvalue))


def points(locus: Locus, x: Array, y: Array, x_axis: Axis, y_axis: Axis) -> list[Trace]:
    """Return the running speed's points in view, that of the least damped mode with guides."""
    (left, right), (low, high) = x_axis["range"], y_axis["range"]
    shown = np.flatnonzero((x >= left) & (x <= right) & (y >= low) & (y <= high))
    if not len(shown):
        return []
    lead = locus.least_damped if locus.least_damped in shown else int(shown[0])
    rest = shown[shown != lead]
    others = style.mark(x[rest], y[rest], "running speed", showlegend=False)
    return [
        *style.here(float(x[lead]), float(y[lead]), x_axis, y_axis),
        {**others, "marker": {**others["marker"], "size": 9}},
    ]


def _whirling(locus: Locus, units: Units) -> tuple[Array, Array]:
    """Return growth rates and frequencies of the modes that whirl below the top speed."""
    values = locus.branches[np.isfinite(locus.branches)]
    waves = values[values.imag > 0.0] if np.any(values.imag > 0.0) else values
    slow = waves[np.imag(waves) <= 1.1 * locus.speed[-1]]
    lively = slow[modes.damping_ratio(slow) < HARDLY_SWINGS]
    kept = next(some for some in (lively, slow, waves) if len(some))
    return kept.real, whirl_frequency(kept, units)


def _coloured_branches(locus: Locus, units: Units) -> list[Trace]:
    """Return all branches in pieces, each piece of speed in its own colour."""
    n, m = locus.branches.shape
    gap = np.full((1, m), np.nan)
    speed = units.speed.of(locus.speed)
    edges = [round(i * (n - 1) / _PIECES) for i in range(_PIECES + 1)]
    traces: list[Trace] = []
    for i, (start, stop) in enumerate(itertools.pairwise(edges)):
        piece = np.vstack([locus.branches[start : stop + 1], gap]).T.ravel()
        traces.append(
            style.line(
                np.real(piece), whirl_frequency(piece, units), _EIGENVALUES,
                _colour(i / (_PIECES - 1)), width=3, showlegend=False,
                customdata=np.tile(np.append(speed[start : stop + 1], np.nan), m),
                hovertemplate=_HOVER,
            )
        )  # fmt: skip
    return traces


def _colour(fraction: float) -> str:
    parts = (
        np.interp(fraction, (0.0, 0.5, 1.0), part) for part in zip(*_SLOW_TO_FAST, strict=True)
    )
    return "rgb({:.0f},{:.0f},{:.0f})".format(*parts)


def _colour_bar(locus: Locus, units: Units) -> Trace:
    bar = {
        "title": {"text": f"Ω [{units.speed.name}]", "side": "right"},
        "thickness": 10, "outlinewidth": 0, "nticks": 5, "x": 1.01, "xpad": 4,
        **style.PLAIN_NUMBERS,
    }  # fmt: skip
    marker = {
        "size": 0.1, "color": np.zeros(2), "colorbar": bar, "showscale": True,
        "colorscale": [[fraction, _colour(fraction)] for fraction in (0.0, 0.5, 1.0)],
        "cmin": 0.0, "cmax": float(units.speed.of(locus.speed[-1])),
    }  # fmt: skip
    nowhere = np.full(2, np.nan)
    return {
        "type": "scatter", "mode": "markers", "x": nowhere, "y": nowhere, "name": "",
        "showlegend": False, "hoverinfo": "skip", "marker": marker,
    }  # fmt: skip


def _crossing(onset: Onset, locus: Locus, units: Units) -> list[Trace]:
    """Return the mark of the onset on the imaginary axis, where the speeds shown reach it."""
    if not 0.0 < onset.speed <= locus.speed[-1]:
        return []
    name = f"onset {units.speed.of(onset.speed):.0f} {units.speed.name}"
    place = float(units.speed.of(onset.whirl_frequency))
    mark = style.mark(0.0, place, name, style.UNSTABLE)
    return [{**mark, "marker": {**mark["marker"], "symbol": "diamond", "size": 12}}]


def _steps(locus: Locus, x: Axis, units: Units) -> tuple[Array, list[list[Trace]], int]:
    """Return the slider's speeds, the traces at each, and its step at the running speed.

    The moving traces are the line of half the speed, and a ring around each eigenvalue.
    """
    places = np.unique(np.linspace(0, len(locus.speed) - 1, _STEPS).round().astype(int))
    speeds, values = locus.speed[places], locus.branches[places]
    active = int(np.argmin(np.abs(speeds - locus.running_speed)))
    speeds[active], values[active] = locus.running_speed, locus.here.eigenvalues
    half, frequency = units.speed.of(speeds) / 2.0, whirl_frequency(values, units)
    steps: list[list[Trace]] = [
        [
            {"x": np.array(x["range"]), "y": np.full(2, half[i])},
            {"x": values[i].real, "y": frequency[i]},
        ]
        for i in range(len(speeds))
    ]
    return speeds, steps, active


def _moving(step: list[Trace]) -> list[Trace]:
    """Return the slider's traces at a step."""
    half, rings = step
    line = style.line(half["x"], half["y"], "½× slider speed", style.GREY, dash="dash", width=1.2)
    ring = style.mark(rings["x"], rings["y"], "at the speed chosen below")
    hollow = {"size": 15, "color": "rgba(0,0,0,0)", "line": {"color": style.GREY, "width": 2.5}}
    return [
        line | {"hoverinfo": "skip", "showlegend": False, **style.LIVE_ONLY},
        {**ring, "marker": hollow, "cliponaxis": True, **style.LIVE_ONLY},
    ]


def _half_plane(right: float) -> Item:
    return {
        "type": "rect", "xref": "x", "yref": "paper", "x0": 0, "x1": right, "y0": 0, "y1": 1,
        "fillcolor": style.SHADE, "line": {"width": 0}, "layer": "below",
    }  # fmt: skip


def _imaginary_axis() -> Item:
    return {
        "type": "line", "xref": "x", "yref": "paper", "x0": 0, "x1": 0, "y0": 0, "y1": 1,
        "line": {"color": style.UNSTABLE, "width": 2}, "layer": "below",
    }  # fmt: skip


def _sides() -> list[Item]:
    common = {"xref": "x", "yanchor": "top"}
    return [
        style.note("stable", 0, 0.99, **common, xanchor="right", xshift=-6),
        style.note("unstable", 0, 0.99, **common, xanchor="left", xshift=6),
    ]


def _rays(left: float, top: float, units: Units) -> list[tuple[Item, Item]]:
    """Return rays of constant damping ratio with their names, those of visible length."""
    reach = units.speed.to_si(top)
    rays: list[tuple[Item, Item]] = []
    for ratio in _RAYS:
        slope = ratio / np.sqrt(1.0 - ratio**2)
        end = min(1.0, left / (slope * reach))  # where the ray leaves the view
        x, y = -slope * reach * end, top * end
        if end > 0.3 and -x > 0.3 * left:
            line = {"color": style.FAINT, "width": 1.4, "dash": "dot"}
            rays.append((
                {
                    "type": "line", "x0": 0, "y0": 0, "x1": x, "y1": y,
                    "layer": "below", "line": line,
                },
                {
                    "text": f"{style.symbols('ζ')} = {ratio:g}", "x": 0.97 * x, "y": 0.97 * y,
                    "showarrow": False,
                    "font": {"size": 12, "color": style.GREY}, "xanchor": "left", "xshift": 3,
                },
            ))  # fmt: skip
    return rays


def _numbers(locus: Locus, units: Units, left: float, top: float) -> list[Item]:
    """Return the modes' numbers beside their points at the running speed."""
    return [
        {
            "text": f"<b>{i}</b>", "showarrow": False, "xshift": 13, "yshift": 11,
            "x": float(value.real), "y": float(whirl_frequency(value, units)),
        }
        for i, value in enumerate(locus.here.eigenvalues, start=1)
        if value.real >= -left and whirl_frequency(value, units) <= top
    ]  # fmt: skip
