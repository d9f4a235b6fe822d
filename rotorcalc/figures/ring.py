"""Charts of a floating ring: its speed, its two films and their two whirls over running speed."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.display import Result
from rotorcalc.figures import cursor, style
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.figures.text import hover
from rotorcalc.onset import ModeOnset, RingWhirl
from rotorcalc.ring import RingEquilibrium
from rotorcalc.units import Unit, Units

HEIGHT = 380
_MARGIN = {"l": 64, "r": 28, "t": 44, "b": 48}
_INNER, _OUTER = style.BLUE, style.OCHRE
# A mode this strongly damped hardly whirls: its frequency is left out.
_HARDLY_WHIRLS = 0.9


@dataclass(frozen=True, eq=False)
class TwoWhirls(Result):
    """Both whirls over speed and at the running speed, and where each sets in."""

    over: RingWhirl
    here: RingWhirl
    onsets: tuple[ModeOnset, ModeOnset]


@dataclass(frozen=True, eq=False)
class _Pane:
    """Running speeds (n,) and one of them, and the y-axis with its unit."""

    speed: Array
    at: Array
    y: Axis
    unit: Unit
    units: Units

    def line(self, values: Array, name: str, colour: str, **extra: Any) -> Trace:
        """Return a line over the speeds, of values in SI."""
        told = hover(f"%{{x:.0f}} {self.units.speed.name}", self.unit)
        speed, shown = self.units.speed.of(self.speed), self.unit.of(values)
        return style.line(speed, shown, name, colour, hovertemplate=told, **extra)

    def chart(self, traces: list[Trace], *marks: Array) -> Chart:
        """Return lines, and marks of values at the one speed."""
        x, now = cursor.speed_axis(self.speed, self.units), float(self.units.speed.of(self.at))
        first, *rest = (float(self.unit.of(one)) for one in marks)
        others = style.mark(np.full(len(rest), now), rest, "running speed", showlegend=False)
        drawn = [*traces, *style.here(now, first, x, self.y), others]
        chart = style.chart(drawn, x, self.y, height=HEIGHT, margin=_MARGIN)
        return cursor.over_speed(chart, self.at, self.units)


def speed_ratio(over: RingEquilibrium, here: RingEquilibrium, limit: float, units: Units) -> Chart:
    """Return the ring's speed over the shaft's, and what it is without load."""
    y = style.axis(style.titled("Speed ratio", "Ω_R/Ω", "-"), 0.0, style.ceiling([1.1 * limit]))
    pane = _Pane(over.speed, here.speed, y, units.number, units)
    unloaded = np.full_like(over.speed, limit)
    lines = [
        pane.line(over.speed_ratio, "ring", style.PURPLE),
        pane.line(unloaded, "without load", style.GREY, dash="dot", width=1.4),
    ]
    return pane.chart(lines, here.speed_ratio)


def eccentricities(over: RingEquilibrium, here: RingEquilibrium, units: Units) -> Chart:
    """Return the eccentricity ratios of the two films, each over its own clearance."""
    y = style.axis(style.titled("Eccentricity ratio", "ε", "-"), 0.0, 1.0)
    pane = _Pane(over.speed, here.speed, y, units.number, units)
    return _of_both(pane, over, here, "eccentricity_ratio")


def thicknesses(over: RingEquilibrium, here: RingEquilibrium, units: Units) -> Chart:
    """Return the thinnest place of either film."""
    unit = units.film
    both = np.concatenate([one.minimum_film_thickness for one in (over.inner, over.outer)])
    y = style.axis(style.titled("Smallest film", "h", unit.name), 0.0, style.ceiling(unit.of(both)))
    pane = _Pane(over.speed, here.speed, y, unit, units)
    return _of_both(pane, over, here, "minimum_film_thickness")


def whirls(shown: TwoWhirls, units: Units) -> Chart:
    """Return the frequencies of the two whirls, with their limits, red where they grow."""
    over, here, unit = shown.over, shown.here, units.speed
    top = style.ceiling(unit.of(1.15 * over.inner_limit * over.speed))
    y = style.axis(style.titled("Whirl frequency", "ω", unit.name), 0.0, top)
    pane = _Pane(over.speed, here.speed, y, unit, units)
    of_ring, of_both = style.symbols("Ω_R"), style.symbols("Ω + Ω_R")
    inner, outer = (
        (over.inner_whirl_ratio, over.inner_growth),
        (over.outer_whirl_ratio, over.outer_growth),
    )
    traces = [
        pane.line(over.inner_limit * over.speed, f"½({of_both})", style.GREY, dash="dash"),
        pane.line(over.outer_limit * over.speed, f"½{of_ring}", style.GREY, dash="dot"),
        *_whirl(pane, *inner, "inner film", _INNER),
        *_whirl(pane, *outer, "outer film", _OUTER),
        *_onsets(shown, units),
    ]
    ratios = here.inner_whirl_ratio, here.outer_whirl_ratio
    return pane.chart(traces, *(ratio * here.speed for ratio in ratios))


def _whirl(pane: _Pane, ratio: Array, growth: Array, name: str, colour: str) -> list[Trace]:
    """Return one whirl's frequency, and over it, in red, where it grows."""
    swings = -growth < _HARDLY_WHIRLS * np.hypot(growth, ratio)
    frequency = np.where(swings, ratio * pane.speed, np.nan)
    traces = [pane.line(frequency, name, colour)]
    if np.any(growth > 0.0):
        grows = np.where(growth > 0.0, frequency, np.nan)
        traces.append(pane.line(grows, f"{name}, growing", style.UNSTABLE, width=4.0))
    return traces


def _onsets(shown: TwoWhirls, units: Units) -> list[Trace]:
    """Return marks of the onsets that the speeds shown reach."""
    return [
        style.mark(
            float(units.speed.of(one.speed)), float(units.speed.of(one.whirl_frequency)),
            f"onset, {one.mode}", style.UNSTABLE,
        )
        for one in shown.onsets
        if 0.0 < one.speed <= shown.over.speed[-1]
    ]  # fmt: skip


def _of_both(pane: _Pane, over: RingEquilibrium, here: RingEquilibrium, name: str) -> Chart:
    """Return a quantity of both films over speed."""
    lines = [
        pane.line(getattr(over.inner, name), "inner film", _INNER),
        pane.line(getattr(over.outer, name), "outer film", _OUTER),
    ]
    return pane.chart(lines, *(getattr(film, name) for film in (here.inner, here.outer)))
