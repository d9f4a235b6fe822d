"""Charts of stability: thresholds over speed, the notes' Figs. 5.7 to 5.10, energy of whirl."""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.analysis import FilmCurves
from rotorcalc.arrays import Array
from rotorcalc.display import Result
from rotorcalc.figures import cursor, style
from rotorcalc.figures.style import Axis, Chart, Trace, titled
from rotorcalc.figures.text import number
from rotorcalc.onset import Onset
from rotorcalc.thresholds import Thresholds
from rotorcalc.units import Unit, Units
from rotorcalc.whirl_energy import WhirlEnergy

Item = dict[str, Any]

# At the figure's lower edge, where it neither narrows the plot nor overlaps the axis title.
LEGEND = {"orientation": "h", "x": 0, "yref": "container", "y": 0, "yanchor": "bottom"}
MARGIN = {"l": 64, "r": 28, "t": 16, "b": 112}
# Stands for infinity: a line rises to it, beyond the end of any axis.
_BEYOND = 1e7
# Green, against the red of the unstable side.
_STABLE = "rgba(0,145,106,0.13)"
# Half the space between the two bars at one speed, and their width.
_BESIDE, _WIDE = 0.19, 0.34


@dataclass(frozen=True)
class Crossing:
    """The onset of a machine, and whether the threshold's closed form applies to it."""

    onset: Onset
    closed_form: bool


@dataclass(frozen=True, eq=False)
class FilmFigure(Result):
    """Common data of the notes' figures: the film's curves, the limit of whirl, this machine.

    `here` is the film at the running speed, None without load, where σ is infinite; `limit` the
    one at which whirl ends, None where whirl has no such end.
    """

    curves: FilmCurves
    limit: FilmCurves | None
    here: FilmCurves | None
    over_eccentricity: bool = False

    def values(self, film: FilmCurves) -> Array:
        """Return a film's abscissae."""
        return film.film.eccentricity_ratio if self.over_eccentricity else film.film.sommerfeld

    def axis(self) -> Axis:
        """Return the abscissa."""
        if self.over_eccentricity:
            return style.eccentricity_axis(self.values(self.curves))
        return style.axis(titled("Modified Sommerfeld number", "σ", "-"), 1e-2, 1e2, log=True)


@dataclass(frozen=True, eq=False)
class Energies(Result):
    """The energy of the whirl orbit over speed, at the running speed and at the onset."""

    over: WhirlEnergy
    here: WhirlEnergy
    at_onset: WhirlEnergy | None


def threshold(over: Thresholds, here: Thresholds, crossing: Crossing, units: Units) -> Chart:
    """Return the threshold speeds over running speed; one meets the line Ω at the onset."""
    unit = units.speed
    speed, x = unit.of(over.speed), _speed_axis(over, units)
    top, now = _high(x), float(unit.of(here.flexible))
    wanted = [now, *_halves(unit, over.flexible, over.rigid)]
    y = style.axis(
        titled("Threshold speed", "Ω_s, Ω_sf", unit.name),
        0.0,
        style.ceiling([1.2 * top, *_shown(wanted, 4.0 * top)]),
    )
    line = style.line([0.0, top], [0.0, top], "Ω", style.GREY, dash="dot")
    onset = float(unit.of(crossing.onset.speed))
    chart = _over_speed(
        [*_pair(speed, unit.of(over.rigid), unit.of(over.flexible), crossing), line],
        (x, y),
        crossing,
        mark=(onset, onset),
        here=(float(unit.of(here.speed)), now),
        shapes=_unstable_side(onset, x),
        annotations=[_verdict(crossing.onset, x, unit)],
    )
    return cursor.over_speed(chart, here.speed, units)


def threshold_at_a_glance(
    over: Thresholds, here: Thresholds, crossing: Crossing, units: Units
) -> Chart:
    """Return that chart small; where no speed is unstable it says so, for its lines may be out."""
    chart = style.small(threshold(over, here, crossing, units))
    # In one line the axis's title is longer than the plot of a small chart with cases is high.
    title = chart["layout"]["yaxis"]["title"]
    title["text"] = title["text"].replace("Threshold speed ", "Threshold speed<br>")
    if math.isinf(crossing.onset.speed):
        words = _verdict(crossing.onset, chart["layout"]["xaxis"], units.speed)
        chart["layout"]["annotations"] = [words | {"font": {"size": 12}}]
    return chart


def whirl_frequency(over: Thresholds, here: Thresholds, crossing: Crossing, units: Units) -> Chart:
    """Return the whirl frequency at the threshold over running speed, beside half the speed."""
    unit = units.speed
    speed, x = unit.of(over.speed), _speed_axis(over, units)
    top, now = _high(x), float(unit.of(here.flexible_frequency))
    wanted = [now, *_halves(unit, over.flexible_frequency, over.rigid_frequency)]
    y = style.axis(
        titled("Whirl at the threshold", "ω_s", unit.name),
        0.0,
        style.ceiling([0.6 * top, *_shown(wanted, 4.0 * top)]),
    )
    half = style.line([0.0, top], [0.0, 0.5 * top], "½ Ω", style.GREY, dash="dot")
    rigid, flexible = unit.of(over.rigid_frequency), unit.of(over.flexible_frequency)
    onset = crossing.onset
    chart = _over_speed(
        [*_pair(speed, rigid, flexible, crossing), half],
        (x, y),
        crossing,
        mark=(float(unit.of(onset.speed)), float(unit.of(onset.whirl_frequency))),
        here=(float(unit.of(here.speed)), now),
        shapes=_unstable_side(float(unit.of(onset.speed)), x),
        annotations=[],
    )
    return cursor.over_speed(chart, here.speed, units)


def critical_mass(over: Thresholds, here: Thresholds, crossing: Crossing, units: Units) -> Chart:
    """Return the critical mass over the rotor's, over running speed; unstable below 1."""
    unit = units.speed
    speed, x = unit.of(over.speed), _speed_axis(over, units)
    now = float(here.flexible_mass_ratio)
    # Both curves fall with the speed: each has at least its lower end on the chart.
    low, high = style.decades([0.1, 100.0, now,
                               *_lowest(units.number, over.flexible_mass_ratio,
                                        over.rigid_mass_ratio)])  # fmt: skip
    y = style.axis(titled("Critical mass over rotor mass", "", "-"), low, high, log=True)
    one = style.line([0.0, _high(x)], [1.0, 1.0], "rotor mass", style.GREY, dash="dot")
    chart = _over_speed(
        [*_pair(speed, over.rigid_mass_ratio, over.flexible_mass_ratio, crossing), one],
        (x, y),
        crossing,
        mark=(float(unit.of(crossing.onset.speed)), 1.0),
        here=(float(unit.of(here.speed)), now),
        shapes=[_box(x0=0, x1=1, xref="paper", y0=low, y1=1.0)],
        annotations=[style.note("unstable below 1", 0.02, 0.03, xanchor="left", yanchor="bottom")],
    )
    return cursor.over_speed(chart, here.speed, units)


def whirl_ratio(figure: FilmFigure) -> Chart:
    """Return the whirl frequency ratio over σ or ε (Fig. 5.7)."""
    y = style.axis(titled("Whirl frequency ratio", "ω_s/Ω_s", "-"), 0.0, 0.6)
    now = math.nan if figure.here is None else float(figure.here.onset.whirl_ratio)
    return _film_chart(figure, figure.curves.onset.whirl_ratio, y, now, "whirl ratio")


def threshold_speed(figure: FilmFigure) -> Chart:
    """Return the dimensionless threshold speed of a rigid rotor over σ or ε (Fig. 5.8)."""
    now = math.nan if figure.here is None else float(figure.here.onset.threshold_speed)
    y = style.axis(titled("Threshold speed", "p_s", "-"), 0.0, style.ceiling([6.0, min(now, 30.0)]))
    return _film_chart(figure, figure.curves.onset.threshold_speed, y, now, style.symbols("p_s"))


def critical_mass_number(figure: FilmFigure) -> Chart:
    """Return the dimensionless critical mass over σ or ε (Fig. 5.9)."""
    now = math.nan if figure.here is None else float(figure.here.onset.critical_mass)
    now = math.nan if now < 0.0 else now  # of a negative k_eq: there is no such mass
    y = style.axis(
        titled("Critical mass", "p_s²", "-"), 0.0, style.ceiling([30.0, min(now, 900.0)])
    )
    return _film_chart(figure, figure.curves.onset.critical_mass, y, now, style.symbols("p_s²"))


def flexible_threshold(
    figure: FilmFigure, sags: ArrayLike, thresholds: Array, now: float = math.nan
) -> Chart:
    """Return the threshold speed of flexible rotors over σ or ε (Fig. 5.10).

    `thresholds` has a row for each sag; the last row is this machine's, `now` its point.
    """
    x_values, x = figure.values(figure.curves), figure.axis()
    y = style.axis(
        titled("Threshold speed", "p_sf", "-"), 0.0, style.ceiling([5.0, min(now, 30.0)])
    )
    sags = np.asarray(sags, dtype=float)
    known = [
        style.line(
            x_values,
            _drawable(row),
            f"{_SAG} = {sag:g}",
            style.GREY,
            width=1.6,
            showlegend=False,
            **style.LIVE_ONLY,
        )
        for sag, row in zip(sags[:-1], thresholds[:-1], strict=True)
    ]
    own = style.line(
        x_values,
        _drawable(thresholds[-1]),
        f"this machine, {_SAG} = {sags[-1]:.3g}",
        style.FLEXIBLE,
        width=3.0,
    )
    names = [
        _at_the_free_end(figure, f"{_SAG} = {sag:g}", float(row[-1]))
        for sag, row in zip(sags[:-1], thresholds[:-1], strict=True)
    ]
    return _film_frame(figure, [*known, own], (x, y), now, names)


def energy_bars(energies: Energies, units: Units) -> Chart:
    """Return the energy gained and lost by the whirl orbit in a turn, as bars at two speeds."""
    stops = [energies.here] if energies.at_onset is None else [energies.here, energies.at_onset]
    gains = np.array([float(units.stiffness.of(stop.fed_in)) for stop in stops])
    films = np.array([float(units.stiffness.of(stop.film_loss)) for stop in stops])
    disks = np.array([float(units.stiffness.of(stop.disk_loss)) for stop in stops])
    rpm = [float(units.speed.of(stop.speed)) for stop in stops]
    titles = [f"{word}<br>{value:.0f} rpm" for word, value in zip(_STOPS, rpm, strict=False)]
    places = np.arange(len(stops), dtype=float)
    top = style.ceiling([1.12 * gains.max(), 1.12 * (films + disks).max()])
    bars = [
        _bar(places - _BESIDE, gains, f"fed in, {style.symbols('K_XY − K_YX')}", style.UNSTABLE),
        _bar(places + _BESIDE, films, "dissipated by the film", style.JOURNAL),
    ]
    if disks.any():
        bars.append(_bar(places + _BESIDE, disks, "dissipated at midspan", style.DISK, base=films))
    return style.chart(
        bars,
        style.axis("", -0.6, len(stops) - 0.4, tickvals=places, ticktext=titles),
        _energy_axis(top, units),
        barmode="overlay",
        shapes=_level(places, gains) if energies.at_onset is not None else [],
        annotations=[
            *_heights(places - _BESIDE, gains),
            *_heights(places + _BESIDE, films + disks),
        ],
        legend=LEGEND,
        margin=MARGIN,
    )


def energy(energies: Energies, crossing: Crossing, units: Units) -> Chart:
    """Return the whirl orbit's energy gain and loss per turn over speed; equal at the onset."""
    over, here, unit = energies.over, energies.here, units.stiffness
    speed, x = units.speed.of(over.speed), _speed_axis(over, units)
    loss, now = unit.of(over.film_loss + over.disk_loss), float(unit.of(here.fed_in))
    lost = float(unit.of(here.film_loss + here.disk_loss))
    met = math.nan if energies.at_onset is None else float(unit.of(energies.at_onset.fed_in))
    y = _energy_axis(
        style.ceiling([1.05 * now, 1.05 * lost, 1.3 * met, *unit.of(over.fed_in)]), units
    )
    lines = [
        style.line(speed, unit.of(over.fed_in), "fed in", style.UNSTABLE),
        style.line(speed, loss, "dissipated", style.JOURNAL),
    ]
    if np.any(over.disk_loss):
        part = unit.of(over.disk_loss)
        lines.append(style.line(speed, part, "of which at midspan", style.DISK, dash="dash"))
    rpm, onset = float(units.speed.of(here.speed)), float(units.speed.of(crossing.onset.speed))
    second = style.mark(rpm, lost, "dissipated at the running speed", showlegend=False)
    chart = _over_speed(
        [*lines, second],
        (x, y),
        replace(crossing, closed_form=True),  # gain and loss meet at the onset of any machine
        mark=(onset, met),
        here=(rpm, now),
        shapes=_unstable_side(onset, x),
        annotations=[_verdict(crossing.onset, x, units.speed)],
    )
    return cursor.over_speed(chart, here.speed, units)


_SAG = style.symbols("Γ/C")
_STOPS = ("running speed", "onset")


def _over_speed(
    traces: list[Trace],
    axes: tuple[Axis, Axis],
    crossing: Crossing,
    *,
    mark: tuple[float, float],
    here: tuple[float, float],
    **layout: Any,
) -> Chart:
    """Return a chart over speed with the onset and the running speed marked on it."""
    x, y = axes
    name = _onset_name(mark[0])
    if not crossing.closed_form and math.isfinite(mark[0]):
        ends = [_low(y), _high(y)]
        traces.append(style.line([mark[0]] * 2, ends, name, style.UNSTABLE))
    elif _inside(mark, axes):
        traces.append(style.mark(*mark, name, style.UNSTABLE))
    notes = [*layout.pop("annotations"), *_off_the_chart(traces, y)]
    if _inside(here, axes):
        traces += style.here(*here, x, y)
    else:
        whose = "running speed" if crossing.closed_form else "closed forms"
        notes.append(_beyond(f"{whose}: no whirl", here, axes))
    return style.chart(traces, x, y, annotations=notes, legend=LEGEND, margin=MARGIN, **layout)


def _off_the_chart(traces: list[Trace], y: Axis) -> list[Item]:
    """Return notes on thresholds of which no part lies within the chart."""
    notes: list[Item] = []
    for trace in traces:
        values = np.asarray(trace["y"], dtype=float)
        values = values[np.isfinite(values) & (values < _BEYOND)]
        if not values.size or np.any((values >= _low(y)) & (values <= _high(y))):
            continue
        arrow, end = ("↑", values.min()) if values.min() > _high(y) else ("↓", values.max())
        words = f"{arrow} {trace['name']}: {'from' if arrow == '↑' else 'up to'} {number(end)}"
        notes.append(style.note(words, 0.02, 0.9 - 0.08 * len(notes), xanchor="left"))
    return notes


def _pair(speed: Array, rigid: Array, flexible: Array, crossing: Crossing) -> list[Trace]:
    """Return the lines of the rigid and the flexible shaft; dashed where they miss the onset."""
    lines = [_finite(speed, rigid, "rigid shaft", style.RIGID, crossing)]
    if not np.array_equal(rigid, flexible, equal_nan=True):
        lines.append(_finite(speed, flexible, "flexible shaft", style.FLEXIBLE, crossing))
    return lines


def _finite(x: Array, y: Array, name: str, colour: str, crossing: Crossing) -> Trace:
    if not crossing.closed_form:
        name += ", closed form"
    dash = "solid" if crossing.closed_form else "dash"
    return style.line(x, _drawable(y), name, colour, dash=dash)


def near(axis: Axis) -> Axis:
    """Return an axis with its title close to it, as a legend stands below."""
    return {**axis, "title": {**axis["title"], "standoff": 8}}


def _shown(values: ArrayLike, most: float) -> Array:
    """Return values that an axis must include, none above `most`, which would squeeze the rest."""
    return np.minimum(np.asarray(values, dtype=float), most)


def _lowest(unit: Unit, *curves: Array) -> list[float]:
    """Return the smallest value of each curve that has one, with some room above it."""
    known = (curve[np.isfinite(curve)] for curve in curves)
    return [1.05 * float(unit.of(curve.min())) for curve in known if curve.size]


def _halves(unit: Unit, *curves: Array) -> list[float]:
    """Return what an axis must include so that each curve has its lower half and its end on it."""
    known = [curve[np.isfinite(curve)] for curve in curves]
    ends = [float(unit.of(end)) for curve in known if curve.size
            for end in (np.median(curve), curve[-1])]  # fmt: skip
    return [*_lowest(unit, *curves), *ends]


def _drawable(values: Array) -> Array:
    """Return values with infinity replaced by a number beyond every axis."""
    return np.where(np.isposinf(values), _BEYOND, values)


def _speed_axis(over: Thresholds | WhirlEnergy, units: Units) -> Axis:
    return near(cursor.speed_axis(over.speed, units))


def _onset_name(rpm: float) -> str:
    return f"onset {rpm:.0f} rpm"


def _unstable_side(onset: float, x: Axis) -> list[Item]:
    if onset >= _high(x):
        return []
    return [_box(x0=onset, x1=_high(x), y0=0, y1=1, yref="paper")]


def _verdict(found: Onset, x: Axis, unit: Unit) -> Item:
    """Return a text that says which side of the chart is unstable."""
    onset, last = float(unit.of(found.speed)), float(unit.of(found.searched_to))
    if onset == 0.0:
        words = "unstable at any speed"
    elif math.isinf(onset):
        # Where the search ends far beyond the chart, the chart's own speeds say enough.
        every = "stable at every speed" + (" shown" if math.isfinite(last) else "")
        known = last < 4.0 * _high(x)
        words = f"stable up to {last:.0f} {unit.name}" if known else every
    elif onset >= _high(x):
        words = f"stable: the onset lies beyond, at {onset:.0f} {unit.name}"
    else:
        share = onset / _high(x)
        anchor = {"xanchor": "left"} if share < 0.7 else {"xanchor": "right"}
        return style.note(" unstable ", min(share, 1.0) if share < 0.7 else 1.0, 0.98, **anchor)
    return style.note(words, 0.98, 0.98, xanchor="right")


def _film_chart(figure: FilmFigure, values: Array, y: Axis, now: float, name: str) -> Chart:
    line = style.line(figure.values(figure.curves), _drawable(values), name, style.FLEXIBLE)
    line["showlegend"] = False
    return _film_frame(figure, [line], (figure.axis(), y), now, [])


def _film_frame(
    figure: FilmFigure, lines: list[Trace], axes: tuple[Axis, Axis], now: float, names: list[Item]
) -> Chart:
    """Return a chart over the film's numbers with the stable region and this machine on it."""
    x, y = axes
    shades, stable = _stable_side(figure, x)
    notes = [*names, *stable]
    place = math.nan if figure.here is None else float(figure.values(figure.here))
    marks: list[Trace] = []
    if _inside((place, now), axes):
        marks = style.here(place, now, x, y)
    else:
        notes.append(_beyond(_where(figure), (place, now), axes))
    return style.chart([*lines, *marks], x, y, shapes=shades, annotations=notes)


def _stable_side(figure: FilmFigure, x: Axis) -> tuple[list[Item], list[Item]]:
    """Return the region in which no rotor whirls, as a shade and in words, where there is one."""
    if figure.limit is None:
        return [], []
    edge = float(figure.values(figure.limit))
    left, right = (edge, _high(x)) if figure.over_eccentricity else (_low(x), edge)
    shade = _box(x0=left, x1=right, y0=0, y1=1, yref="paper", fillcolor=_STABLE)
    eps = float(figure.limit.film.eccentricity_ratio)
    at, anchor = (0.99, "right") if figure.over_eccentricity else (0.01, "left")
    words = f"stable<br>{style.symbols('ε')} > {eps:.4f}"
    return [shade], [style.note(words, at, 0.03, xanchor=anchor, yanchor="bottom")]


def _where(figure: FilmFigure) -> str:
    if figure.here is None:
        return f"no load: {style.symbols('σ')} is infinite"
    film = figure.here.film
    return (
        f"running speed: {style.symbols('σ')} = {float(film.sommerfeld):.3g}, "
        f"{style.symbols('ε')} = {float(film.eccentricity_ratio):.3f}"
    )


def _at_the_free_end(figure: FilmFigure, words: str, height: float) -> Item:
    """Return a line's name above its end at the centred film."""
    at, anchor = (0.0, "left") if figure.over_eccentricity else (2.0, "right")
    return {
        "text": words, "y": height, "xref": "x", "yref": "y", "yanchor": "bottom",
        "showarrow": False, "font": {"size": 12}, "x": at, "xanchor": anchor,
    }  # fmt: skip


def _energy_axis(top: float, units: Units) -> Axis:
    return style.axis(titled("Energy per turn and area", "", units.stiffness.name), 0.0, top)


def _bar(x: Array, y: Array, name: str, colour: str, base: Array | None = None) -> Trace:
    return {
        "type": "bar", "x": x, "y": y, "base": base, "name": name, "width": _WIDE,
        "marker": {"color": colour}, "customdata": [number(float(value)) for value in y],
        "hovertemplate": f"{name}: %{{customdata}}<extra></extra>",
    }  # fmt: skip


def _heights(x: Array, y: Array) -> list[Item]:
    """Return the heights of bars above them."""
    return [
        {
            "text": number(float(value), 3), "x": float(place), "y": float(value),
            "yanchor": "bottom", "showarrow": False,
        }
        for place, value in zip(x, y, strict=True)
    ]  # fmt: skip


def _level(places: Array, gains: Array) -> list[Item]:
    """Return a line across the bars at the onset, where they are equal."""
    left, right = places[-1] - _BESIDE - _WIDE / 2, places[-1] + _BESIDE + _WIDE / 2
    return [
        {
            "type": "line", "x0": left - 0.04, "x1": right + 0.04, "y0": gains[-1], "y1": gains[-1],
            "line": {"color": style.GREY, "width": 2, "dash": "dot"},
        }
    ]  # fmt: skip


def _box(**place: Any) -> Item:
    return {
        "type": "rect", "layer": "below", "line": {"width": 0}, "fillcolor": style.SHADE, **place,
    }  # fmt: skip


def _beyond(words: str, point: tuple[float, float], axes: tuple[Axis, Axis]) -> Item:
    """Return a note on a running-speed point outside the chart, at the edge where it would be."""
    (at, value), (x, y) = point, axes
    if not (math.isfinite(at) and math.isfinite(value)):
        return style.note(words, 0.98, 0.88, xanchor="right")
    arrow, height = ("↑", 0.98) if value > _high(y) else ("↓", 0.03)
    (first, last), along = x["range"], math.log10(at) if x["type"] == "log" else at
    share = min(max((along - first) / (last - first), 0.0), 1.0)
    # From the place into the chart, so that the words keep within it.
    side = {"xanchor": "left"} if share < 0.5 else {"xanchor": "right"}
    place = f"{arrow} {number(value)} at the running speed"
    return style.note(place, share, height, yanchor="top" if height > 0.5 else "bottom", **side)


def _inside(point: tuple[float, float], axes: tuple[Axis, Axis]) -> bool:
    return all(_low(axis) <= at <= _high(axis) for at, axis in zip(point, axes, strict=True))


def _low(axis: Axis) -> float:
    return _ends(axis)[0]


def _high(axis: Axis) -> float:
    return _ends(axis)[1]


def _ends(axis: Axis) -> tuple[float, float]:
    low, high = axis["range"]
    return (10.0**low, 10.0**high) if axis["type"] == "log" else (low, high)
