"""The tab Measured vibration of Your data: files, how the probes stand, and what was read."""

import math
from dataclasses import replace
from functools import partial

import numpy as np
import streamlit as st

from rotorcalc import MeasuredResponse, Transient, TransientError, simulate, start_on_mode
from rotorcalc.figures import Units
from rotorcalc.films import film_of
from rotorcalc.measured import orbit_table, response_table
from rotorcalc.measured.columns import keys_in
from rotorcalc.measured.orbits import COLUMNS
from rotorcalc.unbalance_response import phase_lag
from ui.computed import Computed
from ui.format import amount, digits, literal, minus
from ui.frame.page import Page
from ui.measured import Kind, Measured, Orbit, Upload, measured, picture
from ui.serving.downloads import offer
from ui.words.on_demand import slow_film

_PRIVATE = (
    "Your files stay in this session: they are in no link, no saved file and no report, and not on "
    "the server's disk. They are gone when this tab of the browser is closed."
)
_FORMATS: dict[Kind, str] = {
    "orbit": "CSV with a header, its units in brackets: time [s], probe 1 [µm], probe 2 [µm], "
    "keyphasor [V]. Displacements in µm, mm, mil, in or m; times in s or ms. Without times the "
    "sample rate is asked, without a keyphasor the running speed. At most 1 MB; no formula is run.",
    "response": "CSV with a header, its units in brackets: speed [rpm], amplitude 1 [µm], "
    "phase 1 [°], amplitude 2 [µm], phase 2 [°]. At most 1 MB; no formula is run.",
}
_LABELS: dict[Kind, str] = {
    "orbit": "Orbit: samples of two probes (CSV)",
    "response": "Amplitude and phase over speed (CSV)",
}
_READS = {"displacement": "journal comes nearer", "gap": "journal moves away"}
# Revolutions of the sample orbit, their samples, and the size of its first whirl in clearances.
_TURNS, _SAMPLES, _WHIRL = 60, 32, 0.02
_POINTS = 60
# Running speeds of a record [rpm].
_SPEEDS = (1.0, 1e6)
# Of a whirl's logarithm, over a whole record.
_STEADY = 0.1


def draw(page: Page) -> None:
    """Draw the tab."""
    mine = measured()
    left, right = st.columns([5, 3])
    with left:
        st.caption(_PRIVATE)
        _ask_probes(mine)
    with right:
        st.html(picture(mine.setting))
    for column, kind in zip(st.columns(2), ("orbit", "response"), strict=True):
        with column, st.container(border=True):
            _draw_file(page, mine, kind)


def _ask_probes(mine: Measured) -> None:
    first, second, third = st.columns(3)
    with first:
        _number(mine, "first", "Probe 1 at [°]", (-360.0, 360.0), 5.0)
    with second:
        _number(mine, "second", "Probe 2 at [°]", (-360.0, 360.0), 5.0)
    with third:
        _number(mine, "imbalance", "Imbalance at the pulse [°]", (-360.0, 360.0), 5.0)
    _choose(mine, "reads", "A reading rises as the", _READS)
    st.caption(
        "All angles count from the load's direction X in the sense of rotation. Where the "
        "imbalance points at the keyphasor's pulse only turns phases; if unknown, leave it at 0."
    )


def _draw_file(page: Page, mine: Measured, kind: Kind) -> None:
    key = f"measured_{kind}_{mine.removed[kind]}"
    upload = st.file_uploader(
        _LABELS[kind], type=["csv", "txt"], key=key, help=_FORMATS[kind],
        on_change=_look, args=(mine, kind, key),
    )  # fmt: skip
    if upload is not None:
        mine.take(kind, Upload(upload.name, upload.getvalue()))
    if kind == "orbit":
        _ask_orbit(page, mine)
    else:
        left, right = st.columns(2)
        with left:
            _choose(mine, "reading", "Amplitudes are", {"0-p": "0-p", "p-p": "p-p"})
        with right:
            _choose(mine, "phase", "Phases are a", {"lag": "lag", "lead": "lead"})
    mine.read(kind)
    if (given := mine.uploads.get(kind)) is not None:
        _show(page, mine, kind, given)
    with st.container(horizontal=True):
        if given is not None:
            st.button("Remove", key=f"measured_remove_{kind}", on_click=mine.remove, args=(kind,))
        _offer_sample(page, kind)


def _look(mine: Measured, kind: Kind, key: str) -> None:
    """Forget a file that was taken out of its uploader, which on another visit is empty anyway."""
    if st.session_state.get(key) is None:
        mine.remove(kind)


def _ask_orbit(page: Page, mine: Measured) -> None:
    """Ask for what the file lacks."""
    given = mine.uploads.get("orbit")
    has = {"time", "keyphasor"} if given is None else keys_in(given.raw, COLUMNS)
    if "time" not in has:
        _number(mine, "sample_rate", "Sample rate [Hz]", (1e-2, 1e7), 100.0)
    if "keyphasor" not in has:
        if not mine.setting.rpm:
            rpm = round(float(page.units.speed.of(page.computed.speed)), 1)
            mine.setting = replace(mine.setting, rpm=min(max(rpm, _SPEEDS[0]), _SPEEDS[1]))
        _number(mine, "rpm", "Running speed of the record [rpm]", _SPEEDS, 10.0)
    _choose(mine, "mean", "Mean of the record", {"removed": "removed", "kept": "kept"})


def _show(page: Page, mine: Measured, kind: Kind, given: Upload) -> None:
    problem = mine.problems.get(kind)
    if problem is not None:
        st.error(f"{literal(given.name, 80)} was not read: {literal(problem)}")
    elif kind == "orbit" and mine.orbit is not None:
        st.markdown(f"Read from {literal(given.name, 80)}:")
        st.markdown(_orbit(mine.orbit, page.units))
        st.caption("Drawn on **Orbits**, in the tabs Orbit and Spectrum.")
    elif mine.response is not None:
        st.markdown(f"Read from {literal(given.name, 80)}:")
        st.markdown(_response(mine.response, page.units))
        balanced = page.computed.machine.rotor.imbalance == 0.0
        place = "once the machine has an imbalance" if balanced else "in the tab Against speed"
        st.caption(f"Drawn on **Response**, {place}.")


# --- What was read --------------------------------------------------------------------------------


def _orbit(found: Orbit, units: Units) -> str:
    """Return what was read from an orbit, as a list."""
    record, rpm = found.record, units.speed
    low, high = float(record.speed.min()), float(record.speed.max())
    speed = amount(rpm, low) if high < 1.005 * low else (
        f"{digits(float(rpm.of(low)))} to {amount(rpm, high)}"
    )  # fmt: skip
    source = "from the keyphasor" if record.has_keyphasor else "as given"
    turns = digits(round(record.revolutions, 1))
    lines = [
        f"{len(record.time)} samples, {turns} revolutions, running speed {speed}, {source}",
        *_motion(found, units),
        _mean(found, units),
    ]
    if record.unread:
        lines.append(f"columns not read: {', '.join(literal(one, 40) for one in record.unread)}")
    return "\n".join(f"- {line}" for line in lines if line)


def _motion(found: Orbit, units: Units) -> list[str]:
    seen, vector = found.spectrum, found.vector
    if seen is None or vector is None:
        return [f"whirl and synchronous vector need more: {literal(found.problem)}"]
    return [_whirl(found, units), _vector(found, units)]


def _whirl(found: Orbit, units: Units) -> str:
    seen = found.spectrum
    if seen is None or math.isnan(seen.whirl_ratio):
        return "no whirl above the noise"
    said = (
        f"**whirl** at {digits(seen.whirl_ratio)} of the running speed, a circle of "
        f"{amount(units.amplitude, seen.whirl)}"
    )
    if math.isnan(found.growth.real):
        return said
    rate = minus(digits(float(f"{found.growth.real:.2g}")))
    return f"{said}, {_way(found)}: growth rate {rate} {units.growth.name}"


def _way(found: Orbit) -> str:
    """Return in words how a whirl changes; by less than a tenth over the record is not at all."""
    record = found.record
    change = found.growth.real * float(record.time[-1] - record.time[0])
    if abs(change) < _STEADY:
        return "neither growing nor decaying"
    return "growing" if change > 0.0 else "decaying"


def _vector(found: Orbit, units: Units) -> str:
    vector = found.vector
    if vector is None:
        return ""
    lags = units.angle.of(phase_lag(vector[None, :])[0]) % 360.0
    each = ", ".join(
        f"{axis} {amount(units.amplitude, abs(part))}, lag {lag:.0f}°"
        for axis, part, lag in zip("XY", vector, lags, strict=True)
    )
    start = "" if found.record.has_keyphasor else " (phases from the first sample)"
    return f"**1× synchronous vector**: {each}{start}"


def _mean(found: Orbit, units: Units) -> str:
    mean = found.record.mean
    if (mean == 0.0).all():
        return "mean kept"
    X, Y = (amount(units.film, value) for value in mean)
    return f"mean removed: X {X}, Y {Y}"


def _response(found: MeasuredResponse, units: Units) -> str:
    rpm, major = units.speed, found.ellipse.semi_major
    at = int(np.argmax(major))
    first = digits(float(rpm.of(found.speed[0])))
    lines = [
        f"{len(found.speed)} speeds, {first} to {amount(rpm, found.speed[-1])}",
        f"**largest orbit** {amount(units.amplitude, major[at])} at {amount(rpm, found.speed[at])}",
    ]
    if found.unread:
        lines.append(f"columns not read: {', '.join(literal(one, 40) for one in found.unread)}")
    return "\n".join(f"- {line}" for line in lines)


# --- Samples --------------------------------------------------------------------------------------


def _offer_sample(page: Page, kind: Kind) -> None:
    """Offer a file of this machine's computed motion, to try the page with."""
    c, angles = page.computed, measured().setting.angles
    if kind == "orbit":
        if slow_film(c) is not None or not _moves(c):
            return
        build = partial(_sample_orbit, c, angles)
    elif c.machine.rotor.imbalance == 0.0:
        return
    else:
        build = partial(_sample_response, c, angles)
    offer(
        f"Sample {kind}, simulated", build, f"simulated-{kind}.csv", "text/csv",
        key=f"measured_sample_{kind}",
        help="A file computed from this machine as it is now, to try the page with.",
    )  # fmt: skip


def _moves(c: Computed) -> bool:
    try:
        film_of(c.machine.bearing).motion()
        start_on_mode(c.machine, c.speed, 1e-9)
    except ValueError:
        return False
    return True


def _sample_orbit(c: Computed, angles: tuple[float, float]) -> str:
    return orbit_table(_simulated(c), angles=angles)


def _simulated(c: Computed) -> Transient:
    """Return the motion of this machine from a small whirl on; to the wall, if it comes to that."""
    start = start_on_mode(c.machine, c.speed, _WHIRL * c.machine.bearing.radial_clearance)
    try:
        return simulate(
            c.machine, c.speed, revolutions=_TURNS, samples_per_revolution=_SAMPLES, start=start
        )
    except TransientError as error:
        return error.partial


def _sample_response(c: Computed, angles: tuple[float, float]) -> str:
    sweep = c.sweep
    some = slice(None, None, max(1, len(sweep.speed) // _POINTS))
    return response_table(sweep.speed[some], sweep.journal_response[some], angles=angles)


# --- Widgets that keep what they were set to ------------------------------------------------------


def _number(mine: Measured, name: str, label: str, ends: tuple[float, float], step: float) -> None:
    """Show a number of the setting, and keep it for when the page is drawn again."""
    found = st.number_input(
        label, *ends, float(getattr(mine.setting, name)), step, key=f"measured_set_{name}",
        format="%g",
    )  # fmt: skip
    mine.setting = replace(mine.setting, **{name: found})


def _choose(mine: Measured, name: str, label: str, options: dict[str, str]) -> None:
    found = st.segmented_control(
        label, list(options), default=getattr(mine.setting, name), required=True,
        format_func=options.__getitem__, key=f"measured_set_{name}",
    )  # fmt: skip
    mine.setting = replace(mine.setting, **{name: found})
