"""What a visitor measured: files read once, and kept in the session alone.

Nothing of it is in links, in files, in reports, in what the browser keeps, or on the server's disk.
"""

import base64
import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple, TypeVar, cast

import streamlit as st

from rotorcalc import MeasuredOrbit, MeasuredResponse, read_orbit, read_vibration_over_speed
from rotorcalc.arrays import ComplexArray
from rotorcalc.figures import Chart, Units, style
from rotorcalc.figures import measured as draw
from rotorcalc.nonlinear.release import Release
from rotorcalc.nonlinear.signals import Spectrum, growth, spectrum, synchronous_vector

Kind = Literal["orbit", "response"]
T = TypeVar("T")
_KEY = "rotorcalc_measured"


@dataclass(frozen=True)
class Setting:
    """How probes and files are meant; angles in degrees, as they are asked."""

    first: float = 135.0
    second: float = 225.0
    imbalance: float = 0.0
    reads: str = "displacement"
    sample_rate: float = 10000.0
    rpm: float = 0.0  # until it is asked: then it begins with the machine's
    mean: str = "removed"
    reading: str = "p-p"
    phase: str = "lag"

    @property
    def angles(self) -> tuple[float, float]:
        """Directions of the probes [rad]."""
        return math.radians(self.first), math.radians(self.second)


class Upload(NamedTuple):
    """A file as it came."""

    name: str
    raw: bytes


@dataclass(frozen=True)
class Orbit:
    """An orbit, and what is read from it; where it is too short for that, why."""

    record: MeasuredOrbit
    spectrum: Spectrum | None = None
    growth: complex = complex(math.nan, math.nan)
    vector: ComplexArray | None = None
    problem: str = ""


@dataclass
class Measured:
    """Files, how they are meant, and what was read from them or why nothing was."""

    setting: Setting = field(default_factory=Setting)
    uploads: dict[Kind, Upload] = field(default_factory=dict)
    orbit: Orbit | None = None
    response: MeasuredResponse | None = None
    problems: dict[Kind, str] = field(default_factory=dict)
    # How often each file was removed: its uploader's next key, which is empty.
    removed: dict[Kind, int] = field(default_factory=lambda: {"orbit": 0, "response": 0})
    _read: dict[Kind, tuple[Upload, Setting]] = field(default_factory=dict)

    def take(self, kind: Kind, upload: Upload) -> None:
        """Take a file, or another in its place."""
        self.uploads[kind] = upload

    def remove(self, kind: Kind) -> None:
        """Forget a file and all that was read from it."""
        self.uploads.pop(kind, None)
        self.problems.pop(kind, None)
        self._read.pop(kind, None)
        self.removed[kind] += 1
        setattr(self, kind, None)

    def read(self, kind: Kind) -> None:
        """Read a file, where it or how it is meant has changed."""
        given = self.uploads.get(kind)
        if given is None or self._read.get(kind) == (given, self.setting):
            return
        self._read[kind] = given, self.setting
        self.problems.pop(kind, None)
        setattr(self, kind, None)
        try:
            found = _of_orbit if kind == "orbit" else _of_response
            setattr(self, kind, found(given.raw, self.setting))
        except ValueError as error:
            self.problems[kind] = f"{error}"


def measured() -> Measured:
    """Return what this session's visitor measured."""
    return st.session_state.setdefault(_KEY, Measured())


def _of_orbit(raw: bytes, setting: Setting) -> Orbit:
    from rotorcalc.measured.columns import keys_in  # noqa: PLC0415
    from rotorcalc.measured.orbits import COLUMNS  # noqa: PLC0415

    given = keys_in(raw, COLUMNS)
    record = read_orbit(
        raw,
        angles=setting.angles,
        sample_rate=None if "time" in given else setting.sample_rate,
        speed=None if "keyphasor" in given else setting.rpm * math.pi / 30.0,
        reads=cast('Literal["displacement", "gap"]', setting.reads),
        mean=cast('Literal["removed", "kept"]', setting.mean),
        imbalance_angle=math.radians(setting.imbalance),
    )
    found = Orbit(record)
    try:
        found = replace(found, growth=growth(record))
        return replace(found, spectrum=spectrum(record), vector=synchronous_vector(record))
    except ValueError as error:
        return replace(found, problem=f"{error}")


def _of_response(raw: bytes, setting: Setting) -> MeasuredResponse:
    return read_vibration_over_speed(
        raw,
        reading=cast('Literal["0-p", "p-p"]', setting.reading),
        phase=cast('Literal["lag", "lead"]', setting.phase),
        angles=setting.angles,
        reads=cast('Literal["displacement", "gap"]', setting.reads),
        imbalance_angle=math.radians(setting.imbalance),
    )


# --- Over the charts of other pages -------------------------------------------------------------


def over_orbit(draw_release: Callable[[Release, Units], Chart]) -> Callable[..., Chart]:
    """Return a drawing of a release in the plane with the measured orbit, where there is one."""
    found = measured().orbit

    def drawn(release: Release, units: Units) -> Chart:
        chart = draw_release(release, units)
        return chart if found is None else draw.over_orbit(chart, found.record, release.rest, units)

    return drawn


def over_spectrum(draw_release: Callable[[Release, Units], Chart]) -> Callable[..., Chart]:
    """Return a drawing of a release's spectrum with the measured one, where there is one."""
    seen = None if (found := measured().orbit) is None else found.spectrum

    def drawn(release: Release, units: Units) -> Chart:
        chart = draw_release(release, units)
        return chart if seen is None else draw.over_spectrum(chart, seen, units)

    return drawn


def over_amplitude(
    draw_chart: Callable[[T], Chart], shown: str, units: Units
) -> Callable[[T], Chart]:
    """Return a drawing of amplitudes over speed with the measured ones, where there are some."""
    found = measured().response
    return (
        draw_chart
        if found is None
        else (lambda computed: draw.over_amplitude(draw_chart(computed), found, shown, units))
    )


def over_phase(draw_chart: Callable[[T], Chart], units: Units) -> Callable[[T], Chart]:
    """Return a drawing of phases over speed with the measured ones, where there are some."""
    found = measured().response
    return (
        draw_chart
        if found is None
        else (lambda computed: draw.over_phase(draw_chart(computed), found, units))
    )


def orbit_words() -> str:
    """Return what a caption adds where an orbit was measured."""
    found = measured().orbit
    if found is None:
        return ""
    place = "" if (found.record.mean == 0.0).all() else ", about rest"
    turns = min(draw.TURNS, round(found.record.revolutions))
    return f" Green: measured, the last {turns} revolutions{place}."


# --- The picture of the probes ------------------------------------------------------------------

_TEXT, _SHAFT = "#7d7d7d", 42.0
_TURNING = (
    '<path d="M 20 -15 A 25 25 0 0 0 -20 -15" fill="none" stroke-width="2" '
    f'stroke="{style.OCHRE}"/>'
)


def picture(setting: Setting) -> str:
    """Return as HTML where the probes stand, with the load, X, Y and the sense of rotation."""
    drawn = [
        f'<circle r="{_SHAFT}" fill="none" stroke="{_TEXT}" stroke-width="1.5"/>',
        _arrow(0.0, 0.0, 74.0, style.RED), _word(0.0, 90.0, "X, load", style.RED),
        _arrow(90.0, 0.0, 60.0, style.Y), _word(90.0, 72.0, "Y", style.Y),
        _TURNING,
        f'<polygon points="-26,-8 -22,-20 -13,-12" fill="{style.OCHRE}"/>',
        f'<text y="-6" text-anchor="middle" fill="{style.OCHRE}">Ω</text>',
    ]  # fmt: skip
    for name, angle in (("1", setting.first), ("2", setting.second)):
        drawn += [_probe(angle), _word(angle, 92.0, f"{name}: {angle:g}°", style.MEASURED)]
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-130 -105 260 212" '
        f'font-family="Source Sans, Arial, sans-serif" font-size="15">{"".join(drawn)}</svg>'
    )
    address = f"data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}"
    words = (
        f"Probes at {setting.first:g}° and {setting.second:g}° from the load, which acts "
        "downward, in the sense of rotation, here counterclockwise."
    )
    return f'<img src="{address}" alt="{words}" width="286" height="233">'


def _at(angle: float, radius: float) -> tuple[float, float]:
    """Return a place of the drawing: 0° is down, and angles count counterclockwise."""
    a = math.radians(angle)
    return round(radius * math.sin(a), 2), round(radius * math.cos(a), 2)


def _arrow(angle: float, start: float, end: float, colour: str) -> str:
    (x, y), (u, v), (a, b), (c, d) = (
        _at(angle, start), _at(angle, end - 8.0), _at(angle - 4.0, end - 10.0), _at(angle, end),
    )  # fmt: skip
    e, f = _at(angle + 4.0, end - 10.0)
    return (
        f'<line x1="{x}" y1="{y}" x2="{u}" y2="{v}" stroke="{colour}" stroke-width="3"/>'
        f'<polygon points="{a},{b} {c},{d} {e},{f}" fill="{colour}"/>'
    )


def _probe(angle: float) -> str:
    (x, y), (u, v) = _at(angle, _SHAFT + 5.0), _at(angle, _SHAFT + 32.0)
    return f'<line x1="{x}" y1="{y}" x2="{u}" y2="{v}" stroke="{style.MEASURED}" stroke-width="9"/>'


def _word(angle: float, radius: float, text: str, colour: str) -> str:
    x, y = _at(angle, radius)
    return f'<text x="{x}" y="{y + 5}" text-anchor="middle" fill="{colour}">{text}</text>'
