"""Charts of the onset against inputs: a map, a tornado chart, a curve over one input."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.design import OnsetMap, OnsetSolution, Sensitivities
from rotorcalc.figures import style
from rotorcalc.figures.stability import LEGEND, MARGIN, near
from rotorcalc.figures.style import Axis, Chart, Trace, titled
from rotorcalc.units import Unit, Units

# Onset speeds [rpm] at which a map changes colour, fixed so that maps can be compared.
_LADDER = np.array([500, 700, 1e3, 1.5e3, 2e3, 3e3, 5e3, 7e3, 1e4, 1.5e4, 2e4, 3e4, 5e4])
# One hue from dark to light, legible to colour-blind readers and in grey; dark is a low onset.
_SEQUENCE = [
    [0.0, "#06264d"], [0.2, "#0b4a85"], [0.4, "#2b7bba"],
    [0.6, "#6aaed6"], [0.8, "#b0d2e8"], [1.0, "#eff6fc"],
]  # fmt: skip
_LESS, _MORE = style.BLUE, style.OCHRE
_HIGHEST = 1e7  # rpm: stands for an onset at infinity


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
        return float(self.unit.of(min(max(value, self.low), self.high)))

    def text(self, value: float) -> str:
        """Return a value with its unit."""
        return f"{float(self.unit.of(value)):.4g} {self.unit.name}"


def onset_map(
    shown: OnsetMap,
    quantities: tuple[Quantity, Quantity],
    here: tuple[float, float],
    speed: float,
    units: Units,
) -> Chart:
    """Return the onset speed over two inputs, with a machine on it.

    `here` is the machine's place in SI, `speed` the running speed [rad/s], along whose onset a
    line runs: beyond it the machine would be unstable there.
    """
    x, y = (quantity.axis() for quantity in quantities)
    left, bottom = (quantity.place(value) for quantity, value in zip(quantities, here, strict=True))
    return style.chart(
        [
            *_contours(shown, quantities, float(units.speed.of(speed)), units),
            *style.here(left, bottom, x, y, "this machine"),
        ],
        x,
        y,
        height=500,
        legend=LEGEND,
        margin={"l": 64, "r": 28, "t": 16, "b": 84},
    )


def tornado(found: Sensitivities, names: Mapping[str, str], units: Units) -> Chart:
    """Return the onset's change with each input, a pair of bars per input, the largest on top."""
    onset, unit = float(units.speed.of(found.onset)), units.speed
    inputs = found.inputs[::-1]  # the axis runs upwards
    places = np.arange(len(inputs), dtype=float)
    less = np.array([_change(float(unit.of(one.onset_low)), onset) for one in inputs])
    more = np.array([_change(float(unit.of(one.onset_high)), onset) for one in inputs])
    reach = style.ceiling(1.1 * np.abs([*less, *more, 1.0]))
    title = titled("Change", "ΔΩ_on", unit.name)
    rows = [
        f"{names[one.field]}<br>{_signed(low)} / {_signed(high)} {unit.name}"
        for one, low, high in zip(inputs, less, more, strict=True)
    ]
    return style.chart(
        [
            _bars(less, places, "10 % less", onset, _LESS),
            _bars(more, places, "10 % more", onset, _MORE),
            *_shares_axis_holder(onset),
        ],
        near(style.axis(title, -reach, reach)),
        style.axis(
            "", -0.6, len(inputs) - 0.4, tickvals=places, ticktext=rows, showgrid=False,
            tickfont={"size": 13},
        ),
        xaxis2=_shares_axis(reach, onset),
        barmode="overlay",
        height=160 + 42 * max(len(inputs), 4),
        legend=LEGEND,
        margin={"l": 64, "r": 28, "t": 52, "b": 84},
        shapes=[_zero()],
    )  # fmt: skip


def solution(
    found: OnsetSolution, quantity: Quantity, here: tuple[float, float], units: Units
) -> Chart:
    """Return the onset over one input, with the target, the values that meet it, and the machine.

    `here` is the machine's value of the input and its onset, in SI.
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
        traces += style.here(quantity.place(here[0]), now, x, y, "this machine")
    return style.chart(
        traces,
        x,
        y,
        legend=LEGEND,
        margin=MARGIN,
    )


def _round_numbers(low: float, high: float) -> Array:
    """Return the 1, 2, 5 of each decade between two numbers, over many decades only the 1."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    steps = (1.0, 2.0, 5.0) if last - first <= 4 else (1.0,)
    numbers = np.array([step * 10.0**power for power in range(first, last + 1) for step in steps])
    return numbers[(numbers >= low * (1 - 1e-9)) & (numbers <= high * (1 + 1e-9))]


def _contours(
    shown: OnsetMap, quantities: tuple[Quantity, Quantity], speed: float, units: Units
) -> list[Trace]:
    xs, ys = quantities[0].unit.of(shown.xs), quantities[1].unit.of(shown.ys)
    rpm = np.minimum(units.speed.of(shown.speed), _HIGHEST)
    with np.errstate(divide="ignore"):
        steps = np.interp(np.log(rpm), np.log(_LADDER), np.arange(len(_LADDER)))
    hover = f"%{{x:.4g}}, %{{y:.4g}}<br>onset %{{customdata:.0f}} {units.speed.name}<extra></extra>"
    place: dict[str, Any] = {"type": "contour", "x": xs, "y": ys, "hoverongaps": False}
    steps[np.isnan(rpm)] = np.nan
    return [
        place | {
            "z": steps, "zmin": 0, "zmax": len(_LADDER) - 1, "colorscale": _SEQUENCE,
            "contours": {"start": 0, "end": len(_LADDER) - 1, "size": 1, "coloring": "fill"},
            "line": {"width": 0.6, "color": "rgba(255,255,255,0.5)"},
            "customdata": rpm, "hovertemplate": hover, "name": "onset", "showlegend": False,
            "colorbar": _colour_bar(units.speed.name),
        },
        place | {
            "z": rpm, "name": f"onset at the running speed, {speed:.0f} {units.speed.name}",
            "contours": {"type": "constraint", "operation": "=", "value": speed},
            "line": {"width": 3, "color": style.RED}, "hoverinfo": "skip",
            "showlegend": True, "showscale": False,
        },
    ]  # fmt: skip


def _colour_bar(unit: str) -> dict[str, Any]:
    return {
        "title": {"text": f"Onset<br>[{unit}]"}, "tickvals": np.arange(len(_LADDER)),
        "ticktext": [f"{step:.0f}" for step in _LADDER], "thickness": 16, "outlinewidth": 0,
    }  # fmt: skip


def _change(onset: float, base: float) -> float:
    """Return the difference of two onsets; 0 between infinite ones."""
    change = onset - base if onset != base else 0.0
    return change if np.isfinite(change) else 0.0


def _signed(value: float) -> str:
    return f"{value:+.0f}".replace("-", "−")


def _bars(x: Array, y: Array, name: str, onset: float, colour: str) -> Trace:
    shares = 100.0 * x / onset if onset > 0.0 else 0.0 * x
    hover = f"{name}: %{{x:+.4g}} rpm, %{{customdata:+.2g}} %<extra></extra>"
    return {
        "type": "bar", "orientation": "h", "x": x, "y": y, "name": name, "width": 0.6,
        "marker": {"color": colour}, "customdata": shares, "hovertemplate": hover,
    }  # fmt: skip


def _shares_axis(reach: float, onset: float) -> Axis:
    """Return the upper axis, the change in per cent of the onset."""
    share = 100.0 * reach / onset if 0.0 < onset < math.inf else 1.0
    return near(
        style.axis(
            "of the onset [%]", -share, share,
            overlaying="x", side="top", showgrid=False, tickmode="auto", nticks=7,
        )
    )  # fmt: skip


def _shares_axis_holder(onset: float) -> list[Trace]:
    """Return an invisible trace: Plotly draws an axis only where a trace refers to it."""
    if not 0.0 < onset < math.inf:
        return []
    holder = style.mark(0.0, 0.0, "", showlegend=False, hoverinfo="skip", xaxis="x2")
    return [holder | {"marker": {"opacity": 0}}]


def _zero() -> dict[str, Any]:
    return {
        "type": "line", "x0": 0, "x1": 0, "y0": 0, "y1": 1, "yref": "paper",
        "line": {"color": style.GREY, "width": 1.4},
    }  # fmt: skip
