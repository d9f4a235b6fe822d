"""Charts of the onset against inputs: a tornado chart, and a curve over one input."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.design import OnsetSolution, Sensitivities, Sensitivity
from rotorcalc.figures import cursor, style
from rotorcalc.figures.stability import LEGEND, MARGIN, near
from rotorcalc.figures.style import Axis, Chart, Trace, titled
from rotorcalc.figures.text import amount
from rotorcalc.units import Unit, Units

_LESS, _MORE = style.BLUE, style.OCHRE


@dataclass(frozen=True)
class Quantity:
    """An input on an axis: its name, symbol, unit, range in SI, and kind of scale."""

    words: str
    symbol: str
    unit: Unit
    low: float
    high: float
    log: bool = False

    def axis(self) -> Axis:
        """Return the axis."""
        low, high = (float(self.unit.of(end)) for end in (self.low, self.high))
        title = titled(self.words, self.symbol, self.unit.name)
        ticks = {"tickvals": _round_numbers(low, high)} if self.log else {}
        return near(style.axis(title, low, high, log=self.log, **ticks))

    def place(self, value: float) -> float:
        """Return a value in the axis's unit, held at the nearer end where it lies outside."""
        # Plotly draws nothing at a point beyond the end by rounding.
        low, high = self.low * (1.0 + 1e-9), self.high * (1.0 - 1e-9)
        return float(self.unit.of(min(max(value, low), high)))

    def beyond(self, value: float, arrows: str = "←→") -> str:
        """Return the arrow towards a value outside the axis, nothing for one on it."""
        return "" if self.low <= value <= self.high else arrows[value > self.high]

    def text(self, value: float) -> str:
        """Return a value with its unit."""
        return amount(self.unit, value).removesuffix(" -")


def this_machine(x: Axis, y: Axis, left: float, bottom: float, arrow: str) -> list[Trace]:
    """Return the mark of the machine, or words at the edge beyond which it lies."""
    if not arrow:
        return style.here(left, bottom, x, y, "this machine")
    side = {"←": "middle right", "→": "middle left", "↓": "top center", "↑": "bottom center"}[arrow]
    return [
        {
            "type": "scatter", "mode": "text", "x": np.array([left]), "y": np.array([bottom]),
            "text": [f"{arrow} this machine"], "textposition": side, "name": "this machine, beyond",
            "showlegend": False, "hoverinfo": "skip",
        }
    ]  # fmt: skip


def tornado(
    found: Sensitivities, names: Mapping[str, str], speed: float, units: Units
) -> Chart:  # fmt: skip
    """Return the onset's change with each input, a pair of bars per input, the largest on top.

    Inputs that do not move the onset are left out. A running speed, `speed` [rad/s] at first, is
    marked across the bars: those that reach beyond it make a stable machine unstable, and an
    unstable one stable.
    """
    onset, unit = float(units.speed.of(found.onset)), units.speed
    inputs = moving(found)[::-1]  # the axis runs upwards
    places = np.arange(len(inputs), dtype=float)
    less = np.array([_change(float(unit.of(one.onset_low)), onset) for one in inputs])
    more = np.array([_change(float(unit.of(one.onset_high)), onset) for one in inputs])
    # Of an onset that is zero or infinite there is no share.
    share = 100.0 / onset if 0.0 < onset < math.inf else 1.0
    title = titled("Change of the onset", "ΔΩ_on", unit.name)
    if share != 1.0:
        title = titled("Change of the onset", "ΔΩ_on/Ω_on", "%")
    all_of_them = share * np.array([*less, *more, 1.0])
    # Beside the bars there is room for their changes in words.
    reach = style.ceiling(1.5 * np.abs(all_of_them[np.isfinite(all_of_them)]))

    def texts(changes: Array) -> list[str]:
        return [f"{_effect(value, unit.name)}{_percent(value, onset)}" for value in changes]

    rows = [names[one.field] for one in inputs]
    none = style.note(
        "no input moves the onset" if math.isfinite(onset) else "no input gives an onset", 0.5, 0.5
    )
    chart = style.chart(
        [
            # The bar of an infinite change ends with the axis.
            _bars(np.clip(share * changes, -reach, reach), places, name, texts(changes), colour)
            for changes, name, colour in (
                (less, "10 % less", _LESS),
                (more, "10 % more", _MORE),
            )
        ],
        near(style.axis(title, -reach, reach, showgrid=bool(inputs))),  # no line through words
        style.axis(
            "", -0.6, max(len(inputs), 1) - 0.4, tickvals=places, ticktext=rows, showgrid=False,
            tickfont={"size": 13},
        ),
        barmode="overlay",
        height=130 + 30 * max(len(inputs), 4),
        legend=LEGEND,
        margin={"l": 64, "r": 28, "t": 28, "b": 84},
        shapes=[_zero()] if inputs else [],
        annotations=[
            note
            for place, low, high in zip(places, less, more, strict=True)
            for note in _beside(place, (low, high), share, unit.name)
        ]
        or [none],
    )  # fmt: skip
    if not math.isfinite(onset):
        return chart
    to = np.linspace(-reach, reach, 401)
    return cursor.over_speed(chart, speed, units, axis="x", at=onset + to / share, to=to)


def moving(found: Sensitivities) -> tuple[Sensitivity, ...]:
    """Return the inputs that move the onset by more than rounding."""
    return tuple(
        one for one in found.inputs
        if any(end != found.onset and not math.isclose(end, found.onset, rel_tol=1e-9)
               for end in (one.onset_low, one.onset_high))
    )  # fmt: skip


def solution(
    found: OnsetSolution, quantity: Quantity, here: tuple[float, float], speed: float, units: Units
) -> Chart:
    """Return the onset over one input, with the target, the values that meet it, and the machine.

    `here` is the machine's value of the input and its onset, in SI, `speed` its running speed
    [rad/s]. A running speed is marked across the chart: stable where the onset lies above it.
    """
    unit = units.speed
    x, now = quantity.axis(), float(unit.of(here[1]))
    target = float(unit.of(found.target))
    top = style.ceiling([1.6 * target, min(1.2 * now, 6.0 * target)])
    y = style.axis(titled("Onset speed", "Ω_on", unit.name), 0.0, top)
    onset = unit.of(np.where(np.isinf(found.onset), np.nan, found.onset))
    values = quantity.unit.of(found.values)
    ends = [values[0], values[-1]]
    wanted = quantity.unit.of(found.solutions)
    traces = [
        style.line(values, onset, "onset", style.FLEXIBLE),
        style.line(ends, [target] * 2, f"target {target:.0f} {unit.name}", style.RED, dash="dot"),
    ]
    if len(wanted):
        heights = np.full(len(wanted), target)
        traces.append(style.mark(wanted, heights, "solution", style.RED))
    if np.isfinite(now) and now <= top:
        arrow = quantity.beyond(here[0])
        # Clear of the axis, of which an onset of zero would cross its words.
        height = max(now, 0.04 * top) if arrow else now
        traces += this_machine(x, y, quantity.place(here[0]), height, arrow)
    chart = style.chart(traces, x, y, legend=LEGEND, margin=MARGIN)
    return cursor.over_speed(chart, speed, units, axis="y")


def _round_numbers(low: float, high: float) -> Array:
    """Return the 1, 2, 5 of each decade between two numbers, over many decades only the 1."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    steps = (1.0, 2.0, 5.0) if last - first <= 4 else (1.0,)
    numbers = np.array([step * 10.0**power for power in range(first, last + 1) for step in steps])
    return numbers[(numbers >= low * (1 - 1e-9)) & (numbers <= high * (1 + 1e-9))]


def _change(onset: float, base: float) -> float:
    """Return the difference of two onsets; 0 between infinite ones."""
    return onset - base if onset != base else 0.0


def _effect(change: float, unit: str) -> str:
    """Return a change in whole units; what it means where the onset comes from or goes to ∞."""
    if math.isinf(change):
        return "no whirl" if change > 0.0 else "whirl"
    return f"{change:+.0f} {unit}".replace("-", "−") if round(change) else f"0 {unit}"


def _bars(x: Array, y: Array, name: str, texts: list[str], colour: str) -> Trace:
    return {
        "type": "bar", "orientation": "h", "x": x, "y": y, "name": name, "width": 0.6,
        "marker": {"color": colour}, "customdata": texts,
        "hovertemplate": f"{name}: %{{customdata}}<extra></extra>",
    }  # fmt: skip


def _beside(
    place: float, changes: tuple[float, float], share: float, unit: str
) -> list[dict[str, Any]]:
    """Return the changes with 10 % less and more of an input, each on its side of the bars."""
    colours = (_LESS, _MORE) if changes[0] <= changes[1] else (_MORE, _LESS)
    return [
        {
            "text": _effect(change, unit), "x": share * end if math.isfinite(end) else 0.0,
            "y": place, "xanchor": anchor, "xshift": shift, "showarrow": False,
            "font": {"size": 12, "color": colour},
        }
        for change, end, anchor, shift, colour in zip(
            sorted(changes), (min(*changes, 0.0), max(*changes, 0.0)), ("right", "left"), (-3, 3),
            colours, strict=True,
        )
    ]  # fmt: skip


def _percent(change: float, onset: float) -> str:
    share = 100.0 * change / onset if 0.0 < onset < math.inf else math.nan
    return f", {share:+.2g} %".replace("-", "−") if math.isfinite(share) else ""


def _zero() -> dict[str, Any]:
    return {
        "type": "line", "x0": 0, "x1": 0, "y0": 0, "y1": 1, "yref": "paper",
        "line": {"color": style.GREY, "width": 1.4},
    }  # fmt: skip
