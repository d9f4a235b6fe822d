"""The bearing in cross-section, with journal, equilibrium position and pressure distribution."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.analysis import Sweep
from rotorcalc.arrays import Array
from rotorcalc.bearing_parts import Parts
from rotorcalc.coefficients import PressureField
from rotorcalc.display import Result
from rotorcalc.figures import cursor, style, text
from rotorcalc.figures.bore import PadLines, closed, pad_lines
from rotorcalc.figures.parts import RING, moving, still, thickness
from rotorcalc.figures.style import Chart, Trace
from rotorcalc.films import film_of
from rotorcalc.films.pads import Pad, pads_of
from rotorcalc.geometry import FloatingRing, PartialArc
from rotorcalc.machine import Bearing
from rotorcalc.modes import ModeShapes, leading_place
from rotorcalc.unbalance_response import orbit_ellipse
from rotorcalc.units import Unit, Units

# Clearance over the bore's radius in the exaggerated drawing; to scale it would be invisible.
EXAGGERATED = 0.3
# How far beyond the bore the edges of tilting pads may lie, over its radius: within the housing.
_EDGES = 0.1
# Radius of the attitude angle's arc over the journal's.
_ARC = 0.55
_ANGLES = np.linspace(0.0, 2.0 * np.pi, 181)
_AROUND = np.linspace(0.0, 2.0 * np.pi, 361)  # a square bore's corners are among these
_BLUISH, _GREYISH = "rgba(43,123,186,0.16)", "rgba(128,128,128,0.22)"
_CROSS = {"symbol": "cross-thin", "size": 9, "line": {"color": style.GREY, "width": 1.6}}
_SMALL_CROSS = {"symbol": "x-thin", "size": 6, "line": {"color": style.GREY, "width": 1.4}}
# The deepest pocket in the exaggerated drawing, in C: a deeper one would reach the load's arrow.
_POCKET = 0.5
# Height of the peak pressure outside the bore, and the place of the bar that shows it, (x, y).
_PEAK, _BAR = 0.5, (1.0, -1.42)
# Where the number of a recess stands, and the room at the left for the pressures of recesses.
_WITHIN, _BESIDE = 0.87, 0.75
# Ends of the load's arrow above the bore, X.
_ARROW = (-1.46, -1.06)
Item = dict[str, Any]


@dataclass(frozen=True, eq=False)
class OtherSpeeds(Result):
    """What the drawing shows at other speeds than the running speed.

    Attributes
    ----------
    sweep : Sweep
        The machine over speed, (n,).
    angle : array, (m,)
        Angles Θ from X around the bore [rad].
    pressure_speed : array, (k,)
        Speeds of the pressure [rad/s].
    pressure : array, (k, m)
        Pressure in the bearing's middle [Pa]; NaN where the film's model gives none.
    modes_speed : array, (j,)
        Speeds of the modes [rad/s], the running speed among them.
    modes : ModeShapes
        The free motions there.
    parts : Parts, optional
        The parts that move, at the speeds of the pressure.
    """

    sweep: Sweep
    angle: Array
    pressure_speed: Array
    pressure: Array
    modes_speed: Array
    modes: ModeShapes
    parts: Parts | None = None


def cross_section(  # noqa: PLR0913 - the drawing has what each of these shows
    point: Sweep,
    film: PressureField,
    units: Units,
    *,
    to_scale: bool = False,
    others: OtherSpeeds | None = None,
    parts: Parts | None = None,
) -> Chart:
    """Return the bearing seen along the shaft: X, the load, points down; the journal turns X to Y.

    Parameters
    ----------
    point : Sweep
        The machine at one speed.
    film : PressureField
        The film at that speed; its pressure in the bearing's middle is drawn.
    units : Units
        Units of display.
    to_scale : bool
        Whether to draw the film to scale; otherwise the clearance is drawn as 30 % of the bore.
    others : OtherSpeeds, optional
        The machine at other speeds, for a drawing that can show them and the journal's whirl.
    parts : Parts, optional
        The parts of the bearing that move or are supplied, at the running speed.

    Returns
    -------
    Chart
        Lengths in radii of the bore, where it is widest.
    """
    bore = _Bore.of(point, parts, to_scale=to_scale)
    centre = point.journal_position / point.machine.bearing.radial_clearance * bore.gap
    pressure = film.pressure[:, np.argmin(np.abs(film.axial_position))]
    notes = {
        **_load_arrow(point.machine.static_load, units),
        **_rotation_arrow(centre, 0.5 * bore.journal),
        **_names(point, centre, bore),
        **_readings(point, units, parts),
        **_recess_names(parts),
    }
    traces = [
        *_pressure(film.theta - film.load_theta, pressure, bore),
        *_walls(bore, parts),
        _ring(centre + _circle(bore.journal, _ANGLES), "journal", style.JOURNAL, fill=_BLUISH),
        *_turning(centre, bore),
        *_attitude(point, bore),
        style.mark(*_drawn(np.zeros(2)), "bearing centre", marker=_CROSS, hoverinfo="name"),
        style.mark(*_drawn(centre), "journal centre", hoverinfo="name"),
        *(_scale(notes, point, units) if not np.isnan(pressure).any() else []),
    ]
    chart = style.chart(
        traces,
        _hidden(-2.1 - _room(parts), 1.7, constrain="domain"),
        _hidden(-1.62, 1.52, scaleanchor="x"),
        annotations=list(notes.values()),
        showlegend=False,
        height=340,
        margin={"l": 8, "r": 8, "t": 8, "b": 8},
    )
    if others is None:
        return chart
    drawing = _Drawing(bore, list(notes), units, others).numbers(point)
    return cursor.over_speed(chart, point.speed, units, drawing=drawing)


def remarks(bearing: Bearing, *, to_scale: bool) -> str:
    """Return what the marks of a bearing's cross-section mean, and what is not as it is drawn.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    to_scale : bool
        Whether its film is drawn to scale.

    Returns
    -------
    str
        Sentences; empty where the drawing needs none.
    """
    pads = _pads_of(bearing)
    words: list[str] = []
    if any(pad.a_x or pad.a_y for pad in pads):
        words.append("Crosses: centres of curvature of the pads.")
    if not to_scale and max((pad.depth for pad in pads), default=0.0) > _POCKET:
        words.append(f"Pockets are drawn at most {_POCKET:g} C deep.")
    return " ".join(words)


def _pads_of(bearing: Bearing) -> tuple[Pad, ...]:
    """Return a bearing's fixed pads, if it has such."""
    try:
        return pads_of(bearing)
    except ValueError:
        return ()


@dataclass(frozen=True, eq=False)
class _Bore:
    """The bore as it is drawn.

    The journal touches it wherever its centre is on the film's outline, so the wall lies one
    journal's radius beyond the outline: `gap` is the clearance as drawn, `journal` the radius.
    """

    outline: Array
    gap: float
    journal: float
    # Where the bore has grooves; a circle has none.
    pads: tuple[PadLines, ...] = ()
    # Whether the journal can touch the rest of a circle beside a single pad.
    is_open: bool = False
    # Thickness of a ring between journal and bore, as drawn.
    ring: float = 0.0

    @classmethod
    def of(cls, point: Sweep, parts: Parts | None, *, to_scale: bool) -> "_Bore":
        bearing = point.machine.bearing
        outline = film_of(bearing).outline(_AROUND)
        if parts is not None and parts.foil is not None:
            # A foil can be pressed back much farther than it is: the drawing has room for what is.
            # In steps, so that a slider seldom changes its scale.
            outline = _circle(1.0 + math.ceil(4.0 * parts.foil.max()) / 4.0, _AROUND)
        widest = float(np.hypot(*outline.T).max())
        C = bearing.radial_clearance
        thick = _ring_thickness(bearing, parts)
        room = max(widest, _room_for_edges(parts, widest))
        gap = C / (bearing.radius + thick + widest * C) if to_scale else EXAGGERATED / room
        ring = 0.0 if thick == 0.0 else gap * thick / C if to_scale else RING
        journal = 1.0 - gap * widest - ring
        pads, is_open = _pads(bearing, journal, gap, math.inf if to_scale else _POCKET)
        return cls(outline, gap, journal, pads, is_open, ring)

    def wall(self, angles: Array) -> Array:
        """Return the wall where its normal points in these directions, (n, 2)."""
        normal = _circle(1.0, angles)
        if np.ptp(np.hypot(*self.outline.T)) < 1e-9:  # round, as most are: nothing to look for
            return normal
        touched = self.outline[np.argmax(normal @ self.outline.T, axis=-1)]
        return self.gap * touched + (self.journal + self.ring) * normal

    def moving(self, parts: Parts, at: int) -> dict[str, Array]:
        """Return the lines of what moves, at one of the parts' speeds."""
        return moving(parts, at, journal=self.journal, gap=self.gap, ring=self.ring)


def _room_for_edges(parts: Parts | None, widest: float) -> float:
    """Return the least width of the drawing [C], in steps, that keeps pads in their housing.

    The clearance between preloaded pads is a small part of C: where that is drawn large, the edges
    of the pads lie far outside. 0 without pads.
    """
    if parts is None or parts.pads is None:
        return 0.0
    highest = max(
        thickness(pad, edge) for pads in parts.pads for pad in pads for edge in (pad.start, pad.end)
    )
    return math.ceil(4.0 * EXAGGERATED * (highest - widest) / _EDGES) / 4.0


def _ring_thickness(bearing: Bearing, parts: Parts | None) -> float:
    """Return the thickness of a floating ring [m], 0 where there is none."""
    if parts is None or parts.ring is None or not isinstance(bearing.geometry, FloatingRing):
        return 0.0
    return bearing.geometry.outer_radius - bearing.radius - bearing.radial_clearance


def _pads(
    bearing: Bearing, journal: float, gap: float, deepest: float
) -> tuple[tuple[PadLines, ...], bool]:
    """Return the pads of a bore that has grooves, and whether one pad is all there is of it."""
    pads = _pads_of(bearing)
    if not pads or pads[0].is_closed:
        return (), False
    lines = pad_lines(pads, journal=journal, gap=gap, deepest=deepest)
    return lines, isinstance(bearing.geometry, PartialArc)


# Lines of parts: colours and widths, by the names of their traces.
_PARTS = {
    "pads": (style.GREY, 3.6), "pivots": (style.PURPLE, 3.0), "housing": (style.GREY, 1.2),
    "ring": (style.GREY, 1.6), "recesses": (style.PURPLE, 2.0), "foil": (style.GREY, 2.4),
    "bumps": (style.GREY, 1.0), "slit": (style.PURPLE, 2.0),
}  # fmt: skip


def _walls(bore: _Bore, parts: Parts | None) -> Iterator[Trace]:
    """Yield the bore: its surface, and of a bore with grooves pads, pockets and centres."""
    if parts is not None:
        yield from _part_lines(bore, parts)
        if parts.pads is not None or parts.foil is not None:
            return
    if not bore.pads:
        yield _ring(bore.wall(_ANGLES), "bearing", style.GREY, fill=None)
        return
    around = _ring(bore.wall(_ANGLES), "bearing", style.GREY, fill=None)
    if not bore.is_open:
        x, y = _drawn(closed(bore.pads))
        around = style.line(x, y, "bearing", style.GREY, hoverinfo="name")
    yield around | {"line": around["line"] | {"width": 1.2}}
    yield _several([one.surface for one in bore.pads], "pads", style.GREY, width=3.6)
    pockets = [one.pocket for one in bore.pads if len(one.pocket)]
    if pockets:
        yield _several(pockets, "pocket", style.PURPLE, width=2.0)
    centres = np.array([one.centre for one in bore.pads])
    if np.any(centres != 0.0):
        name = "centres of the pads' curvature"
        yield style.mark(*_drawn(centres), name, marker=_SMALL_CROSS, hoverinfo="name")


def _part_lines(bore: _Bore, parts: Parts) -> Iterator[Trace]:
    """Yield the lines of the parts that move, and of what stands around them."""
    for name, places in (
        still(parts, journal=bore.journal, gap=bore.gap) | bore.moving(parts, 0)
    ).items():
        colour, width = _PARTS[name]
        filled = {"fill": "toself", "fillcolor": _GREYISH} if name == "ring" else {}
        x, y = _drawn(places)
        yield style.line(x, y, name, colour, width=width, hoverinfo="name", **filled)
    if parts.ring is not None:
        mark = bore.gap * parts.ring[0] + _ring_mark(bore)
        yield style.line(*_drawn(mark), "ring key", style.GREY, width=4, hoverinfo="skip")


def _ring_mark(bore: _Bore) -> Array:
    """Return a line across the ring, which turns with it, about the ring's centre."""
    inside = bore.journal + bore.gap
    return np.array([[inside, 0.0], [inside + bore.ring, 0.0]])


def _several(parts: list[Array], name: str, colour: str, *, width: float) -> Trace:
    """Return lines as one trace."""
    apart = np.full((1, 2), np.nan)
    x, y = _drawn(np.concatenate([piece for part in parts for piece in (part, apart)][:-1]))
    return style.line(x, y, name, colour, width=width, hoverinfo="name")


def _drawn(position: Array) -> tuple[Array, Array]:
    """Return where a position (X, Y) lies on the screen: X down, Y to the right."""
    return position[..., 1], -position[..., 0]


def _circle(radius: ArrayLike, angles: Array) -> Array:
    return np.asarray(radius)[..., None] * np.stack((np.cos(angles), np.sin(angles)), axis=-1)


def _ring(places: Array, name: str, colour: str, *, fill: str | None) -> Trace:
    x, y = _drawn(np.concatenate((places, places[:1])))
    filled = {"fill": "toself", "fillcolor": fill} if fill else {}
    return style.line(x, y, name, colour, hoverinfo="name", **filled)


def _pressure(angles: Array, pressure: Array, bore: _Bore) -> list[Trace]:
    """Return the pressure as a band outside the bore, its height the pressure over its peak."""
    if np.isnan(pressure).any():  # not given by the film's model
        return []
    wall = bore.wall(angles)
    outer = wall + _circle(_PEAK * _shares(pressure), angles)
    # Apart, so that no line joins them where a film without cavitation begins.
    x, y = _drawn(np.concatenate((outer, [[np.nan, np.nan]], wall[::-1])))
    return [
        style.line(
            x, y, "pressure", style.UNSTABLE, width=1.4,
            fill="toself", fillcolor=style.SHADE, hoverinfo="name",
        )
    ]  # fmt: skip


def _shares(pressure: Array) -> Array:
    """Return pressures around the film over their peak; without load there is none."""
    return pressure / np.maximum(np.max(pressure, axis=-1, keepdims=True), 1e-300)


def _scale(notes: dict[str, Item], point: Sweep, units: Units) -> list[Trace]:
    """Return the bar that shows the peak pressure's height, and add its name to the notes."""
    if point.machine.static_load == 0.0:
        return []
    (x, y), half = _BAR, 0.04
    ends = np.array([[0, half], [0, -half], [0, 0], [_PEAK, 0], [_PEAK, half], [_PEAK, -half]])
    notes["scale"] = {
        "text": text.amount(units.pressure, point.peak_pressure), "x": x + _PEAK / 2, "y": y,
        "yanchor": "top", "yshift": -4, "showarrow": False,
    }  # fmt: skip
    return [
        style.line(
            x + ends[:, 0], y + ends[:, 1], "scale of the pressure", style.UNSTABLE, width=1.6,
            hoverinfo="name",
        )
    ]  # fmt: skip


def _turning(centre: Array, bore: _Bore) -> list[Trace]:
    """Return the journal's whirl, a point while it rests, and a line on it that turns with it."""
    key = centre + np.array([[0.8 * bore.journal, 0.0], [bore.journal, 0.0]])
    quiet = {"hoverinfo": "skip", **style.LIVE_ONLY}
    return [
        style.line(*_drawn(np.array([centre, centre])), "whirl", style.PURPLE, width=1.4, **quiet),
        style.line(*_drawn(key), "key", style.JOURNAL, width=4, **quiet),
    ]


def _attitude(point: Sweep, bore: _Bore) -> list[Trace]:
    """Return the line of centres, to the thinnest film, and the attitude angle from the load."""
    phi = float(point.attitude_angle)
    ends = np.array([[0.0, 0.0], [math.cos(phi), math.sin(phi)]])
    arc = _circle(_ARC * bore.journal, np.linspace(0.0, phi, 49))
    return [
        style.line(*_drawn(ends), "line of centres", style.GREY, dash="dot", hoverinfo="name"),
        style.line(*_drawn(arc), "attitude angle", style.PURPLE, width=1.8, hoverinfo="name"),
    ]


def _names(point: Sweep, centre: Array, bore: _Bore) -> dict[str, Item]:
    """Return the names of attitude angle, eccentricity and thinnest film, beside them."""
    phi = float(point.attitude_angle)
    angle = _circle((_ARC + 0.16) * bore.journal, np.array(phi / 2.0))
    thinnest = _circle(1.0, np.array(phi))
    right = bool(thinnest[1] >= 0.0)
    side: Item = {"xanchor": "left" if right else "right", "xshift": 6 if right else -6}
    return {
        "φ": _label("φ", angle, font={"color": style.PURPLE}),
        "e": _label("e", centre / 2.0, yshift=16),
        "h_min": _label("h_min", thinnest, **side),
    }


@dataclass(frozen=True)
class _Reading:
    """A number of the drawing: its symbol, its unit, and its values in SI."""

    symbol: str
    unit: Unit
    values: Array

    def words(self, value: float) -> str:
        """Return the symbol and a value with its unit."""
        return f"{style.symbols(self.symbol)} = {text.amount(self.unit, value)}"


def _read(sweep: Sweep, units: Units, parts: Parts | None) -> list[_Reading]:
    """Return what is read off the drawing, at a speed or over the sweep's."""
    e = sweep.eccentricity_ratio * sweep.machine.bearing.radial_clearance
    return [
        _Reading("φ", units.angle, sweep.attitude_angle),
        _Reading("e", units.film, e),
        _Reading("h_min", units.film, sweep.minimum_film_thickness),
        _Reading("p_max", units.pressure, sweep.peak_pressure),
        *_read_parts(sweep, units, parts),
    ]


def _read_parts(sweep: Sweep, units: Units, parts: Parts | None) -> Iterator[_Reading]:
    """Yield what is read off the parts: the ring's speed, the recesses' pressures."""
    if parts is None:
        return
    if parts.ring_ratio is not None:
        ratio = np.interp(sweep.speed, parts.speed, parts.ring_ratio)
        yield _Reading("Ω_R", units.speed, ratio * sweep.speed)
    if parts.recess_pressure is not None:
        for i in range(parts.recess_pressure.shape[-1]):
            values = np.interp(sweep.speed, parts.speed, parts.recess_pressure[:, i])
            yield _Reading(f"p_{i + 1}", units.pressure, values)


def _readings(point: Sweep, units: Units, parts: Parts | None) -> dict[str, Item]:
    """Return the numbers of the drawing, one below the other at its left edge."""
    rows = {one.symbol: one.words(float(one.values)) for one in _read(point, units, parts)}
    if not math.isfinite(float(point.peak_pressure)):
        rows["p_max"] = f"{style.symbols('p_max')} not known"
    return {
        f"{symbol} read": style.note(
            words, 0.0, 1.0, xanchor="left", yanchor="top", yshift=-22 * i
        )
        for i, (symbol, words) in enumerate(rows.items())
    }  # fmt: skip


def _room(parts: Parts | None) -> float:
    """Return how much wider the drawing is at its left for more readings than above the bore."""
    return 0.0 if parts is None or parts.recess_pressure is None else _BESIDE


def _recess_names(parts: Parts | None) -> dict[str, Item]:
    """Return the number of each recess, within it: outside are the load and the names."""
    if parts is None or parts.recesses is None:
        return {}
    # Beside its middle, where the line of centres or the load may be.
    middles = _circle(_WITHIN, parts.recesses @ np.array([0.25, 0.75]))
    return {
        f"recess {i}": _label(f"{i}", place, font={"color": style.PURPLE})
        for i, place in enumerate(middles, start=1)
    }


def _label(name: str, place: Array, **extra: Any) -> Item:
    x, y = map(float, _drawn(place))
    return {"text": style.symbols(name), "x": x, "y": y, "showarrow": False, **extra}


def _load_arrow(load: float, units: Units) -> dict[str, Item]:
    """Return the load as an arrow above the bore, with its value."""
    tail, tip = _ARROW
    if load == 0.0:
        return {"load": _label("no load", np.array([tip, 0.0]))}
    label = _label("F_o", np.array([(tail + tip) / 2.0, 0.0]), xanchor="left", xshift=8)
    words = f" = {text.amount(units.force, load)}"
    return {
        "arrow": {
            "x": 0.0, "y": -tip, "ax": 0.0, "ay": -tail, "xref": "x", "yref": "y", "axref": "x",
            "ayref": "y", "text": "", "showarrow": True, "arrowhead": 2, "arrowwidth": 3,
            "arrowcolor": style.GREY,
        },
        "load": {**label, "text": label["text"] + words},
    }  # fmt: skip


def _rotation_arrow(centre: Array, radius: float) -> dict[str, Item]:
    """Return an arrow with the sense of rotation, X to Y: counterclockwise on the screen."""
    tail, head = centre + _circle(radius, np.radians([205.0, 245.0]))
    (tail_x, head_x), (tail_y, head_y) = (
        tuple(map(float, pair)) for pair in zip(_drawn(tail), _drawn(head), strict=True)
    )
    return {
        "turn": {
            "x": head_x, "y": head_y, "ax": tail_x, "ay": tail_y, "xref": "x", "yref": "y",
            "axref": "x", "ayref": "y", "text": "", "showarrow": True, "arrowhead": 2,
            "arrowwidth": 2, "arrowcolor": style.JOURNAL,
        },
        "Ω": {"x": head_x, "y": head_y, "text": "Ω", "showarrow": False, "xshift": -12,
              "yshift": -4},
    }  # fmt: skip


@dataclass(frozen=True, eq=False)
class _Drawing:
    """The numbers by which a browser draws the bearing at other speeds, and the journal's whirl.

    Places are those of the drawing, x to the right and y up; `notes` names its annotations.
    """

    bore: _Bore
    notes: list[str]
    units: Units
    others: OtherSpeeds

    def numbers(self, point: Sweep) -> dict[str, Any]:
        """Return all of them, over speeds in the unit of display."""
        sweep, C = self.others.sweep, point.machine.bearing.radial_clearance
        x, y = _drawn(sweep.journal_position / C * self.bore.gap)
        return {
            "at": self.units.speed.of(sweep.speed), "x": x, "y": y,
            "few": self.units.speed.of(self.others.pressure_speed),
            "angle": sweep.attitude_angle, "arc": _ARC * self.bore.journal,
            "name": (_ARC + 0.16) * self.bore.journal, "journal": self.bore.journal,
            "room": sweep.minimum_film_thickness / C * self.bore.gap,
            "notes": {name: place for place, name in enumerate(self.notes)},
            "readings": [
                self._reading(one) for one in _read(sweep, self.units, self.others.parts)
            ],
            "pressure": self._pressure(),
            "moving": self._moving(),
            "ring": self._ring(),
            "whirl": self._whirl(),
            "thicker": self.bore.gap * point.machine.bearing.radius / C,
        }  # fmt: skip

    def _reading(self, one: _Reading) -> dict[str, Any]:
        return {
            "note": f"{one.symbol} read", "words": f"{style.symbols(one.symbol)} = ",
            "values": one.unit.of(one.values), "unit": one.unit.name,
        }  # fmt: skip

    def _pressure(self) -> dict[str, Any] | None:
        """Return the pressure over its peak at some speeds, and the wall on which it stands."""
        if np.isnan(self.others.pressure).any():
            return None
        angle = self.others.angle
        x, y = _drawn(self.bore.wall(angle))
        return {
            "angle": angle, "x": x, "y": y,
            "shares": list(_PEAK * _shares(self.others.pressure)),
        }  # fmt: skip

    def _moving(self) -> dict[str, Any]:
        """Return the lines of parts that move, at the speeds of the pressure, by their traces."""
        parts = self.others.parts
        if parts is None:
            return {}
        at = [self.bore.moving(parts, i) for i in range(len(parts.speed))]
        return {
            name: dict(zip("xy", zip(*(_drawn(one[name]) for one in at), strict=True), strict=True))
            for name in at[0]
        }

    def _ring(self) -> dict[str, Any] | None:
        """Return where a floating ring's centre is and how fast it turns, over some speeds."""
        parts = self.others.parts
        if parts is None or parts.ring is None:
            return None
        x, y = _drawn(self.bore.gap * parts.ring)
        return {
            "ratio": parts.ring_ratio, "x": x, "y": y,
            "ends": _ring_mark(self.bore)[:, 0],
        }  # fmt: skip

    def _whirl(self) -> dict[str, Any]:
        """Return the slowest mode to decay: growth, frequency, the journal's phasors, of size 1."""
        values, place = self.others.modes.eigenvalues, leading_place(self.others.modes.eigenvalues)
        mode = np.take_along_axis(values, place[:, None], axis=-1)[:, 0]
        shape = np.take_along_axis(self.others.modes.journal, place[:, None, None], axis=-2)[:, 0]
        shape = shape / np.maximum(orbit_ellipse(shape).semi_major, 1e-300)[:, None]
        return {
            "at": self.units.speed.of(self.others.modes_speed),
            "speed": self.others.modes_speed, "growth": mode.real, "frequency": mode.imag,
            # Y to the right, X down.
            "x": [shape[:, 1].real, shape[:, 1].imag], "y": [-shape[:, 0].real, -shape[:, 0].imag],
        }  # fmt: skip


def _hidden(low: float, high: float, **extra: Any) -> dict[str, Any]:
    return style.axis("", low, high, visible=False, **extra)
