"""Charts of the modes: growth rate, frequency and damping over speed, and mode shapes."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotorcalc import modes
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.display import Result
from rotorcalc.figures import cursor, style
from rotorcalc.figures.root_locus import HARDLY_SWINGS, points, whirl_frequency, window
from rotorcalc.figures.style import Axis, Chart, Trace, titled
from rotorcalc.modes import ModeShapes
from rotorcalc.onset import Onset
from rotorcalc.root_locus import Locus
from rotorcalc.units import Units

# By a mode's place in the locus; red, which elsewhere means unstable, comes last.
COLOURS = (style.BLUE, style.OCHRE, style.GREEN, style.PURPLE, style.GREY, style.RED)
Item = dict[str, Any]


@dataclass(frozen=True, eq=False)
class OverSpeed(Result):
    """Common data of the charts over speed: modes, onset, units of display."""

    locus: Locus
    onset: Onset
    units: Units


def growth(shown: OverSpeed) -> Chart:
    """Return the real parts over speed; the machine is unstable where one is positive."""
    left, right, _ = window(shown.locus, shown.units)
    y = style.axis(titled("Growth rate", "Re λ", shown.units.growth.name), -left, right)
    shade = {
        "type": "rect", "xref": "paper", "x0": 0, "x1": 1, "y0": 0, "y1": right,
        "fillcolor": style.SHADE, "line": {"width": 0}, "layer": "below",
    }  # fmt: skip
    return _chart(shown, y, np.real, shapes=[shade, _ZERO])


def frequency(shown: OverSpeed) -> Chart:
    """Return the damped frequencies over speed, with 1× and ½× the running speed."""
    locus, units = shown.locus, shown.units
    y = style.axis(titled("Mode frequency", "ω_d", units.speed.name), 0.0, window(locus, units)[2])
    orders = [
        _guide(shown, locus.speed, "1× speed", "dot"),
        _guide(shown, locus.speed / 2.0, "½× speed", "dash"),
    ]

    def quantity(values: ComplexArray) -> Array:
        return _swinging(values, whirl_frequency(values, units))

    return _chart(shown, y, quantity, beside=orders)


def damping(shown: OverSpeed) -> Chart:
    """Return the damping ratios over speed; ±1 where a mode does not oscillate."""
    y = style.axis(titled("Damping ratio", "ζ", "-"), *_damping_range(shown.locus))
    return _chart(shown, y, modes.damping_ratio, shapes=[_ZERO])


def decrement(shown: OverSpeed) -> Chart:
    """Return the logarithmic decrements over speed."""
    low, high = _damping_range(shown.locus)
    # At light damping δ = 2πζ, and 8 leaves some room.
    y = style.axis(titled("Logarithmic decrement", "δ", "-"), 8.0 * low, 8.0 * high)

    def quantity(values: ComplexArray) -> Array:
        return _swinging(values, modes.logarithmic_decrement(values))

    return _chart(shown, y, quantity, shapes=[_ZERO])


def natural(shown: OverSpeed, *, rigid: Array, shaft: float) -> Chart:
    """Return the natural frequencies over speed.

    Parameters
    ----------
    shown : OverSpeed
        The modes.
    rigid : array, (n,)
        Natural frequency of a rigid rotor on the film, √(K_eq/M), over the same speeds [rad/s].
    shaft : float
        That of the shaft in rigid bearings, √(K_rot/M) [rad/s]; infinite for a rigid shaft.
    """
    units = shown.units
    top = window(shown.locus, units)[2]
    y = style.axis(titled("Natural frequency", "ω_n", units.speed.name), 0.0, top)
    rigid_rotor = style.line(
        units.speed.of(shown.locus.speed),
        units.speed.of(rigid),
        style.symbols("√(K_eq/M)"),
        style.RIGID,
        dash="dash",
    )
    beside = [rigid_rotor]
    if units.speed.of(shaft) <= top:
        alone = np.full_like(shown.locus.speed, shaft)
        beside.append(_guide(shown, alone, style.symbols("√(K_rot/M)"), "dashdot"))

    def quantity(values: ComplexArray) -> Array:
        return _swinging(values, units.speed.of(modes.natural_frequency(values)))

    return _chart(shown, y, quantity, beside=beside)


def shape(
    here: ModeShapes, mode: int, *, rigid: bool, spiral: bool = False, ring: bool = False
) -> Chart:
    """Return a mode shape: the orbits of disk and journal, and the shaft between them.

    Parameters
    ----------
    here : ModeShapes
        The modes at the running speed.
    mode : int
        Which of them.
    rigid : bool
        Whether disk and journal move as one.
    spiral : bool
        Whether to draw growth or decay over three turns, or the orbit's shape alone.
    ring : bool
        Whether the film's inner coordinates are the place of a floating ring, whose orbit is drawn.
    """
    value = complex(here.eigenvalues[mode])
    turn = np.linspace(0.0, 2.0 * np.pi * (3.0 if spiral else 0.92), 289 if spiral else 97)
    rate = value.real / value.imag if spiral and value.imag > 0.0 else 0.0
    motion = np.exp((rate + 1j) * turn) if value.imag > 0.0 else np.array([0.0, 1.0 + 0.0j])
    parts = [("journal", here.journal[mode], style.JOURNAL)]
    if not rigid:
        parts.append(("disk", here.disk[mode], style.DISK))
    held = np.array([np.zeros(2), *(phasors.real for _, phasors, _ in parts)])
    if ring:
        parts.append(("ring", here.inner[mode], style.GREEN))
    at_first = np.array([phasors.real for _, phasors, _ in parts])
    # X points down, as the load does, so that the shaft turns counterclockwise from X to Y.
    x = style.axis("Y [-]", -1.3, 1.3, scaleanchor="y", constrain="domain")
    y = style.axis("X, along the load [-]", 1.3, -1.3)
    traces = [
        *(trace for part in parts for trace in _orbit(*part, motion)),
        style.line(
            held[:, 1], held[:, 0], "shaft at t = 0", style.GREY, dash="dot", width=1.6
        ),
        style.mark(at_first[:, 1], at_first[:, 0], "t = 0"),
    ]  # fmt: skip
    return style.chart(traces, x, y, height=460)


def _swinging(values: ComplexArray, quantity: Array) -> Array:
    """Return a quantity that only an oscillating mode has."""
    return np.where(values.imag > 0.0, quantity, np.nan)


def _damping_range(locus: Locus) -> tuple[float, float]:
    """Return damping ratios between which the whirling modes lie at the higher speeds and here."""
    higher = modes.damping_ratio(locus.branches[len(locus.speed) // 2 :])
    here = modes.damping_ratio(locus.here.eigenvalues)
    ratio = np.append(higher[higher < HARDLY_SWINGS], here[locus.least_damped])
    high = min(style.ceiling(ratio, least=0.05), 1.05)
    low = style.ceiling(-ratio) if np.any(ratio < 0.0) else 0.0
    return -max(low, high / 4.0), high


def _chart(
    shown: OverSpeed,
    y: Axis,
    quantity: Callable[[ComplexArray], Array],
    *,
    beside: list[Trace] | None = None,
    shapes: list[Item] | None = None,
) -> Chart:
    """Return a quantity of the modes over speed, dotted where a mode does not oscillate."""
    locus, units = shown.locus, shown.units
    speed, x = units.speed.of(locus.speed), cursor.speed_axis(locus.speed, units)
    over, here = quantity(locus.branches), quantity(locus.here.eigenvalues)
    now = np.full(len(here), float(units.speed.of(locus.running_speed)))
    traces = [
        *(beside or []),
        *(line for i in range(len(here)) for line in _branch(locus, i, speed, over[:, i])),
        *points(locus, now, here, x, y),
    ]
    lines, names = _onset_line(shown)
    chart = style.chart(
        traces, x, y, shapes=[*(shapes or []), *lines], annotations=names,
        margin={"l": 64, "r": 28, "t": 64, "b": 52},
    )  # fmt: skip
    return cursor.over_speed(chart, locus.running_speed, units)


def _branch(locus: Locus, i: int, speed: Array, values: Array) -> list[Trace]:
    """Return one mode's line, in two parts: where it oscillates and where it does not."""
    swings, known = locus.branches[:, i].imag > 0.0, np.isfinite(values)
    colour = COLOURS[i % len(COLOURS)]
    name = locus.name(i).split(" in the ")[0]  # short, for a legend
    traces: list[Trace] = []
    if np.any(swings & known):
        traces.append(style.line(speed, np.where(swings, values, np.nan), name, colour))
    if np.any(~swings & known):
        still = np.where(swings, np.nan, values)
        name = f"{name}, does not oscillate"
        traces.append(style.line(speed, still, name, colour, dash="dot", showlegend=False))
    return traces


def _guide(shown: OverSpeed, values: Array, name: str, dash: str) -> Trace:
    speed = shown.units.speed
    return style.line(
        speed.of(shown.locus.speed), speed.of(values), name, style.GREY, dash=dash, width=1.4
    )


def _onset_line(shown: OverSpeed) -> tuple[list[Item], list[Item]]:
    """Return the onset speed as a line with its name, where the speeds shown reach it."""
    onset, top, speed = shown.onset.speed, float(shown.locus.speed[-1]), shown.units.speed
    if not 0.0 < onset <= top:
        return [], []
    place = float(speed.of(onset))
    line = {
        "type": "line", "yref": "paper", "x0": place, "x1": place, "y0": 0, "y1": 1,
        "line": {"color": style.UNSTABLE, "width": 1.6, "dash": "dot"}, "layer": "below",
    }  # fmt: skip
    side = "right" if onset > top / 2.0 else "left"
    name = style.note(
        f"onset {place:.0f} {speed.name}", place, 0.99, xanchor=side, yanchor="top",
        xshift=-4 if side == "right" else 4,
    )  # fmt: skip
    return [line], [{**name, "xref": "x"}]


def _orbit(name: str, phasors: ComplexArray, colour: str, motion: ComplexArray) -> list[Trace]:
    """Return one orbit with an arrow at its end."""
    X, Y = (np.real(phasor * motion) for phasor in phasors)
    return [style.line(Y, X, name, colour), style.arrowhead(Y[-2:], X[-2:], name, colour)]


_ZERO: Item = {
    "type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": 0, "y1": 0,
    "line": {"color": style.UNSTABLE, "width": 1.6}, "layer": "below",
}  # fmt: skip
