"""The charts of the report: the pages' own, still, and sized for a sheet of paper."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

import numpy as np

from rotorcalc.figures import (
    Chart,
    campbell,
    coefficients,
    equilibrium,
    film,
    heat,
    machine,
    modes,
    response,
    root_locus,
    stability,
)
from rotorcalc.figures import criteria as criteria_figures
from rotorcalc.figures import recesses as of_recesses
from rotorcalc.figures import ring as of_ring
from rotorcalc.ring import unloaded_speed_ratio
from rotorcalc.units import Units
from ui import criteria, ring
from ui.cases import Shown, compared
from ui.computed import Computed
from ui.criteria import Asked
from ui.words import criteria as criteria_words
from ui.words import recesses as recess_words
from ui.words import stability as ask
from ui.words.citation import cited

Charts: TypeAlias = dict[str, Chart]

# The width of A4 and of Letter within the report's margins, and of two charts beside each other.
FULL, HALF = 680, 334
_HEIGHT = 228
# Normal: groups, which cases make, would stand in columns of their own.
_LEGEND = {"orientation": "h", "x": 0, "y": 1.01, "yanchor": "bottom", "traceorder": "normal"}
_MARGIN = {"l": 58, "r": 10, "t": 30, "b": 44}


@dataclass(frozen=True)
class Figure:
    """A chart of the report: `key` names its place, `draw` takes the machine and the units.

    `film` and `rotor` are the caption's sources. `titles` are shorter titles of axes, for a chart
    too low for its own; they may name `units`. `missing` returns why a machine has no such chart.
    """

    key: str
    title: str
    draw: Callable[[Computed, Units], Chart]
    caption: str | Callable[[Computed], str]
    film: tuple[str, ...] = ()
    rotor: str = ""
    width: int = HALF
    height: int = _HEIGHT
    titles: Mapping[str, str] = field(default_factory=dict[str, str])
    legend: bool = True
    # Whether cases stay out of it.
    alone: bool = False
    missing: Callable[[Computed], str] = lambda _: ""

    def words(self, computed: Computed) -> str:
        """Return the caption with its sources."""
        caption = self.caption if isinstance(self.caption, str) else self.caption(computed)
        return cited(caption, computed, *self.film, rotor=self.rotor)


def _unknown(field: str) -> Callable[[Computed], str]:
    """Return what says that a film's model does not know a field of the sweep."""
    return lambda c: _NOT_GIVEN if np.isnan(getattr(c.point, field)).any() else ""


def _given_temperature(computed: Computed) -> str:
    return "The film's temperature is given." if computed.machine.supply is None else ""


def _gas(computed: Computed) -> str:
    return "The film is a gas, which carries next to no heat away." if computed.has_gas else ""


def _unknown_film(computed: Computed) -> str:
    return _NOT_GIVEN if np.isnan(computed.film.pressure).any() else ""


def _no_whirl(computed: Computed) -> str:
    return "" if ask.whirls(computed) else ask.no_whirl(computed)


def _of_sweep(draw: Callable[..., Chart]) -> Callable[[Computed, Units], Chart]:
    return lambda c, u: draw(c.sweep, c.point, u)


def _of_modes(draw: Callable[[modes.OverSpeed], Chart]) -> Callable[[Computed, Units], Chart]:
    return lambda c, u: draw(modes.OverSpeed(c.locus(True), c.onset, u))


def _of_thresholds(draw: Callable[..., Chart]) -> Callable[[Computed, Units], Chart]:
    return lambda c, u: ask.over_speed(draw, c, u)


def _of_coefficients(draw: Callable[..., Chart]) -> Callable[[Computed, Units], Chart]:
    return lambda c, u: draw(c.sweep, c.point, c.coefficients("XY"), c.coefficients_here("XY"), u)


def _dimensionless(symbol: Literal["k", "c"]) -> Callable[[Computed, Units], Chart]:
    return lambda c, _: coefficients.dimensionless(
        c.film_coefficients("XY"), c.film_coefficients_here("XY"), symbol, "σ"
    )


def _refused(ask_for: Callable[[Computed], object]) -> Callable[[Computed], str]:
    """Return what says why a result cannot be computed, where it cannot."""

    def reason(computed: Computed) -> str:
        try:
            ask_for(computed)
        except ValueError as error:
            return f"{error}."
        return ""

    return reason


_NOT_GIVEN = "The model of this bearing's film does not give it."
# Charts that need a film, of which a table of coefficients knows nothing.
_OF_A_FILM = frozenset((
    "cross_section", "path", "position", "film", "power", "flow", "temperatures", "rise", "balance",
    "viscosity", "k", "c", "whirl_ratio", "threshold_speed", "clearance",
))  # fmt: skip
_OWN = "The bearing is known by its own coefficients alone."
RESPONSE, CRITERIA = "Imbalance response", "Criteria"
RING, RECESSES = "Floating ring", "Recesses over speed"
SECTIONS: dict[str, tuple[Figure, ...]] = {
    "Static equilibrium": (
        Figure(
            "cross_section", "Bearing",
            lambda c, u: machine.cross_section(c.point, c.film, u, parts=c.parts),
            "Film exaggerated; pressure at mid-length.", ("pressure",), height=285,
        ),
        Figure(
            "path", "Journal's path",
            lambda c, u: equilibrium.locus(c.path, c.point, u),
            "In its clearance.", ("attitude", "eccentricity"), height=285,
        ),
        Figure(
            "position", "Eccentricity and attitude angle",
            _of_sweep(equilibrium.position_over_speed), "", ("attitude", "eccentricity"),
            titles={"yaxis": "ε [-]", "yaxis2": "φ [°]"},
        ),
        Figure(
            "film", "Film", lambda c, u: film.film_around(c.film, c.point, u),
            "Thickness, and pressure at mid-length.", ("thickness", "pressure"),
            titles={"yaxis": "h [{units.film.name}]", "yaxis2": "p [{units.pressure.name}]"},
            missing=_unknown_film,
        ),
        Figure(
            "power", "Power loss", _of_sweep(equilibrium.power_loss), "Of one bearing.", ("drag",),
            titles={"yaxis": "P [{units.power.name}]"}, missing=_unknown("power_loss"),
        ),
        Figure(
            "flow", "Side flow", _of_sweep(equilibrium.side_flow), "Of one bearing.", ("flow",),
            titles={"yaxis": "Q [{units.flow.name}]"}, missing=_unknown("side_flow"),
        ),
    ),
    RING: (
        Figure(
            "ring_ratio", "Speed of the ring",
            lambda c, u: of_ring.speed_ratio(
                ring.over_speed(c), ring.here(c), unloaded_speed_ratio(c.machine.bearing), u
            ),
            "Over the shaft's; dotted: without load.", ("drag",),
            titles={"yaxis": "Ω<sub>R</sub>/Ω [-]"},
        ),
        Figure(
            "ring_eccentricity", "Eccentricity ratios",
            lambda c, u: of_ring.eccentricities(ring.over_speed(c), ring.here(c), u),
            "Each over its own clearance.", titles={"yaxis": "ε [-]"},
        ),
        Figure(
            "ring_films", "Smallest films",
            lambda c, u: of_ring.thicknesses(ring.over_speed(c), ring.here(c), u),
            "The thinnest place of each film.", ("thickness",),
            titles={"yaxis": "h [{units.film.name}]"},
        ),
        Figure(
            "ring_whirls", "Two whirls", lambda c, u: of_ring.whirls(ring.whirls(c), u),
            "Of the inner and of the outer film; red where they grow.",
            titles={"yaxis": "ω [{units.speed.name}]"},
        ),
    ),
    RECESSES: (
        Figure(
            "recess_pressures", "Pressures of the recesses",
            lambda c, u: of_recesses.pressures(
                c.recesses, c.recesses_here, recess_words.supply(c), u
            ),
            "By number and angle from the load line; dotted: the supply.", width=FULL, height=250,
        ),
        Figure(
            "recess_powers", "Powers",
            lambda c, u: of_recesses.powers(c.recesses, c.recesses_here, u),
            "Of one bearing: supply pressure times flow, and friction on the lands.",
            width=FULL, height=240,
        ),
    ),
    "Heat": (
        Figure(
            "temperatures", "Temperatures", _of_sweep(heat.temperatures),
            "The film is at the mean of inlet and outlet. ISO 7902-1.",
            missing=lambda c: _unknown("power_loss")(c) or _gas(c) or _given_temperature(c),
        ),
        Figure(
            "rise", "Rise of the oil", _of_sweep(heat.rise),
            "From inlet to outlet; with a given film temperature, of the side flow alone.",
            titles={"yaxis": "ΔT [{units.rise.name}]"},
            missing=lambda c: _unknown("power_loss")(c) or _gas(c),
        ),
        Figure(
            "balance", "Balance of heat",
            lambda c, u: heat.balance(c.heat_curves, c.point, u),
            "At the running speed; they cross at the film's temperature. ISO 7902-1.",
            missing=lambda c: _unknown("power_loss")(c) or _gas(c) or _given_temperature(c),
        ),
        Figure(
            "viscosity", "Viscosity of the oil",
            lambda c, u: heat.viscosity(c.sweep, c.point, c.other_oil, u),
            "Shaded: the film up to the top speed, where its temperature changes.", missing=_gas,
        ),
    ),
    "Force coefficients": (
        Figure(
            "stiffness", "Stiffness", _of_coefficients(coefficients.stiffness_against_speed),
            "Of one bearing, each speed at its own equilibrium.", ("stiffness",), "Eq. 5.45",
            width=FULL, height=260,
        ),
        Figure(
            "damping", "Damping", _of_coefficients(coefficients.damping_against_speed),
            "Of one bearing.", ("damping",), width=FULL, height=260,
        ),
        Figure(
            "k", "Dimensionless stiffness", _dimensionless("k"),
            "Dashed: minus the value.", ("over σ", "k"), "Eq. 5.32",
        ),
        Figure(
            "c", "Dimensionless damping", _dimensionless("c"),
            "Dashed: minus the value.", ("over σ", "c"), "Eq. 5.32",
        ),
    ),
    "Stability": (
        Figure(
            "threshold", "Threshold speed", _of_thresholds(stability.threshold),
            ask.meeting, (), "Eqs. 5.45, 5.46, 5.50",
            width=FULL, height=290, missing=_no_whirl,
        ),
        Figure(
            "whirl", "Whirl frequency at the threshold", _of_thresholds(stability.whirl_frequency),
            "", (), "Eq. 5.47",
            titles={"yaxis": "ω<sub>s</sub> [{units.speed.name}]"}, missing=_no_whirl,
        ),
        Figure(
            "mass", "Critical mass", _of_thresholds(stability.critical_mass),
            "Unstable below 1.", (), "Eq. 5.45",
            titles={"yaxis": "M<sub>c</sub>/M [-]"}, missing=_no_whirl,
        ),
        Figure(
            "whirl_ratio", "Whirl ratio",
            lambda c, _: stability.whirl_ratio(ask.film_figure(c)),
            "", ("whirl ratio",), "Eq. 5.46", missing=_no_whirl,
        ),
        Figure(
            "threshold_speed", "Threshold of a rigid rotor",
            lambda c, _: stability.threshold_speed(ask.film_figure(c)),
            "", ("threshold",), "Eq. 5.45", missing=_no_whirl,
        ),
    ),
    "Root locus": (
        Figure(
            "plane", "Complex plane", lambda c, u: root_locus.plane(c.locus(True), c.onset, u),
            "Eigenvalues with rising speed, upper half; dotted: constant damping ratio.",
            width=FULL, height=300,
        ),
        Figure("growth", "Growth rate", _of_modes(modes.growth), "Unstable where one is positive."),
        Figure("frequency", "Frequencies of the modes", _of_modes(modes.frequency), "Im λ."),
        Figure("ratio", "Damping ratio", _of_modes(modes.damping), "ζ = −Re λ/|λ|."),
        Figure(
            "natural", "Natural frequency",
            lambda c, u: modes.natural(
                modes.OverSpeed(c.locus(True), c.onset, u),
                rigid=c.rigid_frequency, shaft=c.shaft_frequency,
            ),
            "|λ|.", (), "Eq. 5.47",
        ),
    ),
    RESPONSE: (
        Figure(
            "amplitude", "Amplitude", lambda c, u: response.amplitude(c.response, "axes", u),
            "Semi-axes of the orbits, as amplitudes.", (), "Eq. 5.38", width=FULL, height=255,
        ),
        Figure(
            "phase", "Phase lag", lambda c, u: response.phase(c.response, u),
            "Behind the imbalance, which turns forward.", (), "Eq. 5.38", width=FULL, height=225,
        ),
        Figure(
            "orbits", "Orbits", lambda c, u: response.at_running_speed(c.orbits, u),
            "About equilibrium, at the running speed.", height=275,
        ),
        Figure(
            "clearance", "Journal in its clearance",
            lambda c, u: response.in_clearance(c.clearance_orbit, c.sweep.journal_position, u),
            "Dotted: equilibrium at other speeds.", height=275, legend=False,
        ),
    ),
}  # fmt: skip


_BELONGS: dict[str, Callable[[Computed], bool]] = {
    RESPONSE: lambda c: c.machine.rotor.imbalance != 0.0,
    RING: ring.has_ring,
    RECESSES: lambda c: c.has_recesses,
}


def of_criteria(asked: Asked) -> tuple[Figure, ...]:
    """Return the charts of the criteria, for what is asked of a machine."""
    return (
        Figure(
            "level_one", "Level one",
            lambda c, u: criteria_figures.decrement(criteria.stability(c, asked), u),
            "Log decrement of the first forward mode over the cross-coupled stiffness at midspan. "
            "API 617, level I.",
            width=FULL, height=260, missing=_refused(lambda c: criteria.stability(c, asked)),
        ),
        Figure(
            "critical_speeds", "Critical speeds",
            lambda c, u: criteria_figures.critical_speeds(criteria.critical(c, asked), u),
            "Green: speeds of operation; grey: margins required beside them. API 684, SP6.8.2.",
            (), "Eq. 5.38", width=FULL, height=270,
            missing=_refused(lambda c: criteria.critical(c, asked)),
        ),
        Figure(
            "campbell", "Campbell diagram",
            lambda c, u: campbell.diagram(
                criteria.modes_over_speed(c), u, running_speed=c.speed
            ),
            criteria_words.CAMPBELL, width=FULL, height=290, alone=True,
            missing=_refused(criteria.modes_over_speed),
        ),
    )  # fmt: skip


def _all(asked: Asked) -> dict[str, tuple[Figure, ...]]:
    return SECTIONS | {CRITERIA: of_criteria(asked)}


def sections(computed: Computed, asked: Asked = criteria.NOTHING) -> dict[str, tuple[Figure, ...]]:
    """Return the charts that a machine has: a balanced one has no response."""
    return {
        title: tuple(figure for figure in figures if not _missing(figure, computed))
        for title, figures in _all(asked).items()
        if title not in _BELONGS or _BELONGS[title](computed)
    }


def _missing(figure: Figure, computed: Computed) -> str:
    """Return why a machine has no such chart, or nothing."""
    if computed.has_own and figure.key in _OF_A_FILM:
        return _OWN
    return figure.missing(computed)


def left_out(computed: Computed, title: str, asked: Asked = criteria.NOTHING) -> list[str]:
    """Return which charts of a section are left out, and why, a sentence for each reason."""
    reasons: dict[str, list[str]] = {}
    for figure in _all(asked)[title]:
        if reason := _missing(figure, computed):
            reasons.setdefault(reason, []).append(figure.title)
    return [f"Left out: {', '.join(titles)}. {reason}" for reason, titles in reasons.items()]


def charts(
    computed: Computed, cases: Sequence[Shown], units: Units, asked: Asked = criteria.NOTHING
) -> Charts:  # fmt: skip
    """Return the report's charts by key, those of cases behind the live machine's."""
    return {
        figure.key: _chart(figure, computed, cases, units)
        for figures in sections(computed, asked).values()
        for figure in figures
    }


def _chart(figure: Figure, computed: Computed, cases: Sequence[Shown], units: Units) -> Chart:
    beside = () if figure.alone else cases
    chart = compared(lambda c: _still(figure.draw(c, units)), beside)(computed)
    return {
        "data": [_unnamed(trace) for trace in chart["data"]],
        "layout": _layout(figure, chart["layout"], units),
    }


def _layout(figure: Figure, layout: Mapping[str, Any], units: Units) -> dict[str, Any]:
    """Return a layout in the report's size, with text in proportion."""
    size = 12 if figure.width == FULL else 11
    titled = {
        key: {**layout[key], "title": {"text": title.format(units=units)}}
        for key, title in figure.titles.items()
    }
    notes = [
        {**note, "font": {**note.get("font", {}), "size": size - 1}}
        for note in layout.get("annotations", ())
    ]
    return {
        **layout,
        **titled,
        "annotations": notes,
        "width": figure.width,
        "height": figure.height,
        "autosize": False,
        "margin": _MARGIN,
        "font": {**layout["font"], "size": size},
        "legend": {**_LEGEND, "font": {"size": size - 1}},
        **({} if figure.legend else {"showlegend": False}),
    }


def _unnamed(trace: dict[str, Any]) -> dict[str, Any]:
    """Return a trace; the running speed's mark is the same on all charts and needs no legend."""
    return {**trace, "showlegend": False} if trace.get("name") == "running speed" else trace


def _still(chart: Chart) -> Chart:
    """Return a chart without what only a page moves: slider, buttons, and the traces moved."""
    moving = chart["frames"][0]["traces"] if "frames" in chart else ()
    moves = {"sliders", "updatemenus", "meta"}
    layout = {key: value for key, value in chart["layout"].items() if key not in moves}
    data = [trace for i, trace in enumerate(chart["data"]) if i not in moving]
    return {"data": data, "layout": layout}
