"""Charts of criteria: the log decrement over cross-coupling, and critical speeds with margins."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.criteria import Amplification, LevelOne
from rotorcalc.criteria.level_one import LEAST_DECREMENT
from rotorcalc.display import Result
from rotorcalc.figures import cursor, style, text
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.figures.text import number
from rotorcalc.units import Unit, Units

HEIGHT = 420
_HALF_POWER = 0.5**0.5
_HEADROOM = 1.15
_OPERATION = "rgba(0,145,106,0.14)"
_AT_Q_A, _AT_Q_0 = style.symbols("δ") + " at Q<sub>A</sub>", "Q<sub>0</sub>"


@dataclass(frozen=True, eq=False)
class Stability(Result):
    """The log decrement over Q, and at the anticipated Q_A, or at zero where that is not known."""

    over: LevelOne
    here: LevelOne
    is_known: bool


@dataclass(frozen=True, eq=False)
class CriticalSpeeds(Result):
    """The response over speed, its critical speeds, and the speeds of operation.

    Attributes
    ----------
    speed, amplitude : array, (n,)
        Ω [rad/s], and the disk's semi-major axis, zero to peak [m]; over the imbalance [-] where
        `is_balanced`.
    running_speed, here : float
        Ω [rad/s], and the amplitude there.
    found : Amplification
        Critical speeds, their amplitudes in the same measure.
    operation : tuple of float
        Minimum and maximum continuous speed [rad/s].
    unstable : array, (m, 2)
        First and last speed of the ranges where the machine is unstable [rad/s].
    is_balanced : bool
        Whether the rotor has no imbalance.
    """

    speed: Array
    amplitude: Array
    running_speed: float
    here: float
    found: Amplification
    operation: tuple[float, float]
    unstable: Array
    is_balanced: bool


def decrement(shown: Stability, units: Units) -> Chart:
    """Return the first forward mode's log decrement over the cross-coupled stiffness at midspan.

    A backward mode is drawn where it is damped less.
    """
    unit, over = units.stiffness, shown.over
    Q, delta = unit.of(over.cross_coupling), np.where(np.isfinite(over.forward_decrement),
                                                      over.forward_decrement, np.nan)  # fmt: skip
    x = style.axis(
        style.titled("Cross-coupled stiffness at midspan", "Q", unit.name), 0.0, float(Q[-1])
    )
    y = style.axis(style.titled("Log. decrement", "δ", "-"), *_ends(shown))
    hover = f"Q %{{x:.4g}} {unit.name}<br>δ %{{y:.3g}}<extra>%{{fullData.name}}</extra>"
    least = np.full(2, LEAST_DECREMENT)
    ends = np.array([0.0, float(Q[-1])])
    traces = [
        style.line(ends, least, f"required δ, {LEAST_DECREMENT:g}", style.GREY, dash="dash",
                   width=1.6, hoverinfo="skip"),
        style.line(Q, delta, "first forward mode", style.BLUE, hovertemplate=hover),
    ]  # fmt: skip
    less = over.backward_decrement < over.forward_decrement
    if np.any(less):
        back = np.where(
            less & np.isfinite(over.backward_decrement), over.backward_decrement, np.nan
        )
        traces.append(
            style.line(Q, back, "backward mode, damped less", style.PURPLE, dash="dot",
                       hovertemplate=hover)
        )  # fmt: skip
    if np.any(delta < 0.0):
        grows = np.where(delta < 0.0, delta, np.nan)
        traces.append(style.line(Q, grows, "unstable", style.UNSTABLE, width=4.0))
    traces += _marks(shown, unit, (x, y))
    return style.chart(
        traces, x, y, height=HEIGHT, shapes=[_unstable_below(y)],
        annotations=[style.note("unstable", 0.005, 0.01, xanchor="left", yanchor="bottom",
                                font={"color": style.UNSTABLE, "size": 13})],
    )  # fmt: skip


def _ends(shown: Stability) -> tuple[float, float]:
    """Return the ends of an axis of the log decrement: zero is within it, and the least one."""
    over = shown.over
    drawn = np.concatenate([over.forward_decrement, np.minimum(over.backward_decrement,
                                                           over.forward_decrement)])  # fmt: skip
    known = drawn[np.isfinite(drawn)]
    low = float(known.min(initial=0.0))
    high = style.ceiling(known, 2.0 * LEAST_DECREMENT)
    return -max(style.ceiling(-low), 0.1 * high) if low < 0.0 else -0.1 * high, high


def _unstable_below(y: Axis) -> dict[str, Any]:
    return {
        "type": "rect", "xref": "paper", "x0": 0, "x1": 1, "y0": y["range"][0], "y1": 0.0,
        "line": {"width": 0}, "fillcolor": style.SHADE, "layer": "below",
    }  # fmt: skip


def _marks(shown: Stability, unit: Unit, axes: tuple[Axis, Axis]) -> list[Trace]:
    """Return the mark at Q_A, or at zero, and that of Q_0."""
    at, delta = float(unit.of(shown.here.cross_coupling)), float(shown.here.forward_decrement)
    name = _AT_Q_A if shown.is_known else "without cross-coupling"
    marks: list[Trace] = []
    if np.isfinite(delta):
        marks += style.here(at, delta, *axes, name)
    else:  # nothing oscillates there: its place on the axis is still marked
        marks.append(style.mark(at, LEAST_DECREMENT, name))
    Q_0 = float(unit.of(shown.over.zero_decrement))
    if 0.0 < Q_0 <= axes[0]["range"][1]:
        mark = style.mark(Q_0, 0.0, _AT_Q_0, style.UNSTABLE)
        marks.append({**mark, "marker": {**mark["marker"], "symbol": "diamond"}})
    return marks


def critical_speeds(shown: CriticalSpeeds, units: Units) -> Chart:
    """Return the response over speed with N_1, N_c and N_2, and the margins that are asked for."""
    unit = units.number if shown.is_balanced else units.amplitude
    x, speed = cursor.speed_axis(shown.speed, units), units.speed.of(shown.speed)
    size, peaks = unit.of(shown.amplitude), unit.of(shown.found.amplitude)
    inside = shown.found.critical_speed <= shown.speed[-1]
    top = style.ceiling(_HEADROOM * np.concatenate([size, peaks[inside]]))
    words = "Amplitude over imbalance" if shown.is_balanced else "Amplitude of the disk"
    y = style.axis(style.titled(words, "", unit.name), 0.0, top)
    hover = text.hover(f"%{{x:.0f}} {units.speed.name}", unit)
    now = float(units.speed.of(shown.running_speed))
    traces = [
        style.line(speed, size, "disk", style.DISK, hovertemplate=hover),
        *_half_powers(shown, peaks, inside, units),
        *style.here(now, float(unit.of(shown.here)), x, y),
    ]
    shapes, notes = _bands(shown, units)
    chart = style.chart(
        traces, x, y, height=HEIGHT, shapes=shapes,
        annotations=[*notes, *_labels(shown, peaks, inside, units)],
    )  # fmt: skip
    return cursor.over_speed(chart, shown.running_speed, units)


def _half_powers(
    shown: CriticalSpeeds, peaks: Array, inside: BoolArray, units: Units
) -> list[Trace]:
    """Return N_c on each peak, and N_1 and N_2 where the response is 1/√2 of it."""
    found, speed = shown.found, units.speed
    if not np.any(inside):
        return []
    ends = speed.of(found.half_power_speed[inside])
    level = _HALF_POWER * np.repeat(peaks[inside, None], 2, axis=1)
    known = np.isfinite(ends) & (ends > 0.0)
    # Lines from N_1 to N_2, one after the other, with a gap between them.
    gap = np.full((len(ends), 1), np.nan)
    whole = np.all(known, axis=1, keepdims=True)
    widths = style.line(
        np.hstack([np.where(whole, ends, np.nan), gap]).ravel(),
        np.hstack([level, gap]).ravel(), "N<sub>1</sub> to N<sub>2</sub>, half power", style.PURPLE,
        width=1.6, dash="dot", hoverinfo="skip",
    )  # fmt: skip
    hover = f"%{{x:.0f}} {speed.name}<extra>%{{fullData.name}}</extra>"
    sides = style.mark(ends[known], level[known], "N<sub>1</sub>, N<sub>2</sub>", style.PURPLE,
                       hovertemplate=hover, showlegend=False)  # fmt: skip
    tops = style.mark(speed.of(found.critical_speed[inside]), peaks[inside],
                      "N<sub>c</sub>, critical speed", style.DISK, hovertemplate=hover)  # fmt: skip
    small = {"size": 8}
    return [
        widths,
        {**sides, "marker": {**sides["marker"], **small}},
        {**tops, "marker": {**tops["marker"], "symbol": "diamond"}},
    ]


def _labels(
    shown: CriticalSpeeds, peaks: Array, inside: BoolArray, units: Units
) -> list[dict[str, Any]]:
    """Return a label for each critical speed: the speed, AF, and its margin."""
    found, right = shown.found, float(units.speed.of(shown.speed[-1]))
    labels: list[dict[str, Any]] = []
    for i in np.flatnonzero(inside).tolist():
        at = float(units.speed.of(found.critical_speed[i]))
        words = (
            f"{at:.0f} {units.speed.name}, AF {number(found.amplification_factor[i], 3)}"
            f"<br>margin {number(100.0 * found.separation_margin[i], 3)} %, "
            f"required {number(100.0 * found.required_margin[i], 3)} %"
        )
        labels.append({
            "x": at, "y": float(peaks[i]), "text": words, "showarrow": False,
            "xanchor": "right" if at > 0.5 * right else "left", "yanchor": "bottom",
            "xshift": -10 if at > 0.5 * right else 10, "yshift": -6, "align": "left",
            "font": {"size": 13},
        })  # fmt: skip
    return labels


def _bands(
    shown: CriticalSpeeds, units: Units
) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Return the speeds of operation, the margins around them, and unstable speeds, shaded."""
    found, (low, high) = shown.found, shown.operation
    speed, required = found.critical_speed, found.required_margin
    below = float(np.max(required[speed < low], initial=0.0))
    above = float(np.max(required[speed > high], initial=0.0))
    within = float(np.max(required[(speed >= low) & (speed <= high)], initial=0.0))
    margins = [(low * (1.0 - max(below, within)), low), (high, high * (1.0 + above))]
    shapes = [_band(first, last, style.SHADE, units) for first, last in shown.unstable]
    shapes += [_band(a, b, style.FAINT, units) for a, b in margins if b > a]
    shapes.append(_band(low, high, _OPERATION, units, outlined=True))
    notes: list[dict[str, Any]] = []
    if len(shown.unstable):
        notes.append(style.note("unstable", 0.995, 0.995, xanchor="right", yanchor="top",
                                font={"color": style.UNSTABLE, "size": 13}))  # fmt: skip
    return shapes, notes


def _band(
    first: ArrayLike, last: ArrayLike, colour: str, units: Units, *, outlined: bool = False
) -> dict[str, Any]:
    line = {"color": style.GREEN, "width": 1.6} if outlined else {"width": 0}
    left, right = (float(units.speed.of(end)) for end in (first, last))
    return {
        "type": "rect", "yref": "paper", "x0": left, "x1": right, "y0": 0, "y1": 1,
        "line": line, "fillcolor": colour, "layer": "below",
    }  # fmt: skip
