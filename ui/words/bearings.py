"""The bearings side by side: computed one after the other, shown as they come, and judged.

What is said of each kind is Appendix B of the notes, in other words; whether this machine bears it
out is computed.
"""

import base64
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import streamlit as st
from streamlit.elements.lib.column_types import ColumnConfig

from rotorcalc import Machine
from rotorcalc.comparison import KINDS, BearingResult
from rotorcalc.figures import Units
from rotorcalc.figures.bore import picture
from rotorcalc.geometry import Geometry
from ui.bores import FILMS, name_of
from ui.format import amount, lower
from ui.frame.page import Page
from ui.jobs import cache, work
from ui.jobs.queue import SHORT
from ui.session import session

_HERE = "This machine's: "
_A_ROW = 4

_results = cache.Cached(work.bearing, entries=256, megabytes=4, turns=SHORT)


@dataclass(frozen=True)
class Judgement:
    """What is said for and against a kind of bearing, and what can be asked of the numbers."""

    words: str
    claim: str
    # Of a bearing, and of the kinds that have an answer, the plain bore first.
    holds: Callable[[BearingResult, Sequence[BearingResult]], bool]


def _whirls_later(one: BearingResult, all_: Sequence[BearingResult]) -> bool:
    return one.onset > all_[0].onset


_JUDGEMENTS = {
    "plain": Judgement(
        "Simple to turn and cheap, but of all bores the one that whirls most readily.",
        "its onset is the lowest of all",
        lambda one, all_: one.onset <= min(other.onset for other in all_),
    ),
    "partial-arc": Judgement(
        "Simple, with little friction, as half of its film is missing; it resists vibration less.",
        "it loses less power than the plain bore",
        lambda one, all_: one.power_loss < all_[0].power_loss,
    ),
    "axial-grooves": Judgement(
        "Simple and cheap, and oil comes where it is needed; it still whirls.",
        "it whirls", lambda one, _: math.isfinite(one.onset),
    ),
    "elliptical": Judgement(
        "Simple, and it damps critical speeds well; it must be set to the load's direction.",
        "its peak response is lower than the plain bore's",
        lambda one, all_: one.peak_response < all_[0].peak_response,
    ),
    "offset-halves": Judgement(
        "Cheap, and it suppresses whirl at high speed very well; it must be set to the load's "
        "direction.",
        "its onset is higher than the plain bore's", _whirls_later,
    ),
    "lobes": Judgement(
        "It suppresses whirl well and is good all round; costly to make to its tolerances.",
        "its onset is higher than the plain bore's", _whirls_later,
    ),
    "pressure-dam": Judgement(
        "It suppresses whirl well and cheaply; its step wears or silts up, and it then becomes "
        "unstable with little warning.",
        "its onset is higher than the plain bore's", _whirls_later,
    ),
    "multi-dam": Judgement(
        "It can be cut into a bearing that exists, and suppresses whirl well; it has many "
        "dimensions to get right.",
        "its onset is higher than the plain bore's", _whirls_later,
    ),
}  # fmt: skip


def compare(page: Page) -> list[BearingResult]:
    """Return this machine's own bearing and every kind, and show their table as they come."""
    machine, speed = page.computed.machine, page.computed.speed
    asked = _asked(machine, speed)
    found: list[BearingResult] = []
    if any(_results.known(*one) is None for one in asked):
        page.run_whole()
    place, bar = st.empty(), st.empty()
    for one in asked:
        known = _results.known(*one)
        if known is None:
            geometry = one[2] or machine.bearing.geometry
            bar.progress(len(found) / len(asked), f"Computing: {lower(name_of(geometry.kind))} …")
            known = _results(*one)
            found.append(known)
            with place.container():
                _table(found, page.units)
        else:
            found.append(known)
    bar.empty()
    with place.container():
        _table(found, page.units)
    return found


def _asked(machine: Machine, speed: float) -> list[tuple[Machine, float, Geometry | None]]:
    """Return what is computed: the machine as it is, then on every kind of bore by itself."""
    # The last visitor's bore does not matter to the others: their results are then the same.
    return [(machine, speed, None), *((_plain(machine), speed, geometry) for geometry in KINDS)]


def _plain(machine: Machine) -> Machine:
    return replace(machine, bearing=replace(machine.bearing, geometry=KINDS[0], film="finite"))


def _table(found: Sequence[BearingResult], units: Units) -> None:
    """Show the results in a table that can be sorted, some of them as bars."""
    columns = list(_columns(found, units))
    st.dataframe(
        {label: values for label, values, _ in columns},
        column_config={label: config for label, _, config in columns if config is not None},
        hide_index=True,
        row_height=64,
        alt="Bearings of every kind on this machine: onset, damping, film, losses and response.",
    )
    st.caption(
        "Each kind at its usual shape, on the film of finite length; the first row is this "
        "machine's own. Click a column's head to sort. An empty onset: no speed makes it whirl."
    )


def _columns(
    found: Sequence[BearingResult], units: Units
) -> Iterator[tuple[str, list[Any], ColumnConfig | None]]:
    """Yield label, values in the units shown, and display of each column."""
    config = st.column_config
    yield "Bore", [_picture(one) for one in found], config.ImageColumn("", width="small")
    yield "Bearing", [_name(one, place) for place, one in enumerate(found)], None
    for label, unit, values, digits, bars in (
        ("Onset", units.speed, [one.onset for one in found], 0, True),
        ("Margin", units.percent, [one.margin for one in found], 1, False),
        ("Whirl ratio", units.number, [one.whirl_ratio for one in found], 3, False),
        ("Log decrement", units.number, [one.log_decrement for one in found], 3, False),
        ("Smallest film", units.film, [one.minimum_film_thickness for one in found], 2, True),
        ("Power", units.power, [one.power_loss for one in found], 3, True),
        ("Side flow", units.flow, [one.side_flow for one in found], 3, False),
        ("Peak of the disk", units.amplitude, [one.peak_response for one in found], 2, True),
    ):
        shown = [float(unit.of(value)) if math.isfinite(value) else None for value in values]
        name = label + ("" if unit.name == "-" else f" [{unit.name}]")
        most = max((value for value in shown if value is not None), default=0.0)
        number = f"%.{digits}f"
        if bars and most > 0.0:
            yield name, shown, config.ProgressColumn(name, format=number, max_value=most)
        else:
            yield name, shown, config.NumberColumn(name, format=number)


def _name(one: BearingResult, place: int) -> str:
    name = name_of(one.bearing.geometry.kind)
    return name if place else f"{_HERE}{lower(name)}, {FILMS[one.bearing.model].lower()}"


def _picture(one: BearingResult) -> str:
    """Return a bore's picture as an address that holds it, empty where there is none."""
    try:
        svg = picture(one.bearing)
    except ValueError:  # a bearing without fixed pads
        return ""
    return f"data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}"


def say_exceptions(found: Sequence[BearingResult]) -> None:
    """Name the bearings whose films have no answer here, and those that do not whirl."""
    names = [lower(name_of(one.bearing.geometry.kind)) for one in found]
    refused = [name for name, one in zip(names, found, strict=True) if one.refusal]
    steady = [name for name, one in zip(names, found, strict=True) if one.onset == math.inf]
    if refused:
        st.warning(f"No answer at this speed and load, for the reason below: {', '.join(refused)}.")
    if steady:
        st.info(f"No speed makes this machine whirl on: {', '.join(steady)}.")


def in_rows(found: Sequence[BearingResult]) -> Iterator[Sequence[BearingResult]]:
    """Yield results a few at a time."""
    for place in range(0, len(found), _A_ROW):
        yield found[place : place + _A_ROW]


def card(page: Page, one: BearingResult, found: Sequence[BearingResult]) -> None:
    """Show a kind's picture, what is said of it, what it does here, and a button to take it."""
    kind = one.bearing.geometry.kind
    judgement = _JUDGEMENTS[kind]
    st.image(picture(one.bearing), width=96)
    st.markdown(f"**{name_of(kind)}**")
    st.markdown(judgement.words)
    st.markdown(here(one, found, page.units))
    st.button(
        "Use this bearing", key=f"use_{kind}", on_click=session().set_bearing, args=(one.bearing,),
        disabled=one.bearing == page.computed.machine.bearing,
        help="Diameter, length, clearance and load stay; Undo takes it back.",
    )  # fmt: skip


def here(one: BearingResult, found: Sequence[BearingResult], units: Units) -> str:
    """Return what a bearing does on this machine, and whether that bears out what is said of it."""
    if one.refusal:
        return f"Here: {one.refusal}."
    numbers = (
        f"Here: {_onset(one, units)}, smallest film "
        f"{amount(units.film, one.minimum_film_thickness)}, power "
        f"{amount(units.power, one.power_loss)}."
    )
    judgement = _JUDGEMENTS[one.bearing.geometry.kind]
    others = [other for other in found if not other.refusal]
    if others[0].bearing.geometry != KINDS[0]:  # nothing to compare with
        return numbers
    if judgement.holds(one, others):
        return f"{numbers} Borne out: {judgement.claim}."
    return f"{numbers} Not borne out here: {judgement.claim}."


def _onset(one: BearingResult, units: Units) -> str:
    if one.onset == 0.0:
        return "whirls at any speed"
    if math.isinf(one.onset):
        return "whirls at no speed"
    return f"onset at {amount(units.speed, one.onset)}"
