"""The bearings side by side: computed one after the other, shown as they come, and judged.

What is said of each kind is Appendix B of the notes, in other words; whether this machine bears it
out is computed.
"""

import math
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import takewhile
from typing import Any, NamedTuple, TypeAlias

import streamlit as st
from streamlit.delta_generator import DeltaGenerator
from streamlit.elements.lib.column_types import ButtonColumnResult, ColumnConfig

from rotorcalc import JournalBearing, Machine, Oil
from rotorcalc.comparison import BearingResult, usual_bores
from rotorcalc.figures import Units, comparison
from rotorcalc.gas import Gas
from rotorcalc.geometry import Geometry, Plain
from ui.bearing import defaults_of, film_name, without_shape
from ui.bores import name_of
from ui.format import amount, lower
from ui.frame.bore import picture_address, picture_tag
from ui.frame.page import Page
from ui.inputs import as_shown, machine_of, on_lubricant
from ui.jobs import cache, work
from ui.jobs.queue import LONG, ROWS
from ui.serving import one_at_a_time
from ui.session import session

_NO_ANSWER = "This machine's own bearing has no answer at this speed and load"
_OWN, _CLICKED = "This machine", "use_in_table"
_A_ROW = 4
# Seconds after which the results so far are shown.
_PATIENCE = 0.6
# Seconds between two looks for the first result, where it takes longer than that.
_A_LOOK = 0.1
# Kinds that take about as long as all the others together.
_SLOW = ("tilting-pads", "hydrostatic")

# A machine, its running speed, and another bore in place of its own.
_Asked: TypeAlias = tuple[Machine, float, Geometry | None]

# Every row of some 150 visitors: a page that runs again for a button or a unit computes nothing.
_results = cache.Cached(work.bearing, entries=2048, megabytes=4, turns=ROWS)


@dataclass(frozen=True)
class Claim:
    """What is said of a bearing and can be asked of its numbers.

    `words`, and `denied` where they are false, end before the numbers that are compared: those of
    `attribute`, in the unit `kind`, of the bearing and of the plain bore, or of the plain bore and
    of the lowest of the others. `more` tells whether the bearing's is said to be the greater.
    """

    words: str
    denied: str
    attribute: str
    kind: str
    more: bool

    def value(self, one: BearingResult) -> float:
        """Return a bearing's number in SI."""
        return getattr(one, self.attribute)

    def shown(self, one: BearingResult, units: Units) -> str:
        """Return a bearing's number with its unit, or in words."""
        value = self.value(one)
        return amount(getattr(units, self.kind), value) if math.isfinite(value) else "none found"


@dataclass(frozen=True)
class Judgement:
    """What is said for and against a kind of bearing, and what of it can be asked of numbers."""

    words: str
    claims: tuple[Claim, ...]


_LATER = Claim(
    "Its onset is higher than the plain bore's", "Its onset is not higher than the plain bore's",
    "onset", "speed", more=True,
)  # fmt: skip
_LESS_POWER = Claim(
    "It loses less power than the plain bore", "It does not lose less power than the plain bore",
    "power_loss", "power", more=False,
)  # fmt: skip
_HIGHER_PEAK = Claim(
    "Its peak response is higher", "Its peak response is not higher", "peak_response", "amplitude",
    more=True,
)  # fmt: skip
_JUDGEMENTS = {
    "plain": Judgement(
        "Simple to turn and cheap, but of all bores the one that whirls most readily.",
        (
            Claim("Its onset is the lowest of all", "Its onset is not the lowest of all", "onset",
                  "speed", more=False),
        ),
    ),
    "partial-arc": Judgement(
        "Simple, with little friction, for much of its film is missing; it resists vibration less.",
        (_LESS_POWER, _HIGHER_PEAK),
    ),
    "axial-grooves": Judgement(
        "Simple and cheap, and oil comes where it is needed; it whirls as readily as a plain bore.",
        (
            Claim("Its onset is no higher than the plain bore's",
                  "Its onset is higher than the plain bore's", "onset", "speed", more=False),
        ),
    ),
    "elliptical": Judgement(
        "Simple, and it damps critical speeds well; it must be set to the load's direction, and "
        "it whirls at high speed.",
        (
            Claim("Its peak response is lower than the plain bore's",
                  "Its peak response is not lower than the plain bore's", "peak_response",
                  "amplitude", more=False),
            _LATER,
        ),
    ),
    "offset-halves": Judgement(
        "Cheap, and it suppresses whirl at high speed very well; it must be set to the load's "
        "direction.",
        (_LATER,),
    ),
    "lobes": Judgement(
        "It suppresses whirl well and is good all round; costly to make to its tolerances.",
        (_LATER,),
    ),
    "pressure-dam": Judgement(
        "It suppresses whirl well and cheaply; its step wears or silts up, and it then becomes "
        "unstable with little warning.",
        (_LATER,),
    ),
    "multi-dam": Judgement(
        "It can be cut into a bearing that exists, and suppresses whirl well; it has many "
        "dimensions to get right.",
        (_LATER,),
    ),
    "tilting-pads": Judgement(
        "Each pad takes its own position, which leaves almost no cross-coupling to feed a whirl; "
        "costly, hard to set to a clearance, and it damps critical speeds poorly.",
        (_LATER, _HIGHER_PEAK),
    ),
    "floating-ring": Judgement(
        "Easy to make and cheap, for turbochargers above all; each of its two films feeds a whirl, "
        "and such machines run on limit cycles, far above their onset.",
        (
            _LESS_POWER,
            Claim("It whirls below the plain bore's onset",
                  "It does not whirl below the plain bore's onset", "onset", "speed", more=False),
        ),
    ),
    "hydrostatic": Judgement(
        "Stiff from rest on, with many dimensions to choose, and it suppresses whirl; it needs oil "
        "at high pressure and damps critical speeds poorly.",
        (_LATER, _HIGHER_PEAK),
    ),
    "foil": Judgement(
        "Runs on air, without oil, and bears misalignment; costly, for light loads at high speed, "
        "and prone to whirl below running speed.",
        (_LESS_POWER,),
    ),
}  # fmt: skip


def compare(page: Page, *, draw: Callable[..., object] | None = None) -> list[BearingResult]:
    """Return this machine's own bearing and every kind, and show their table as they come.

    Instead of the table `draw` shows what it likes of results, the page, and whether all are there.
    Where all come at once the table is drawn once. Where they take longer the page runs whole,
    which a visitor can end, and what is found is kept.
    """
    machine, speed = page.computed.machine, page.computed.speed
    asked = _asked(machine, speed)
    found: list[BearingResult] = []
    draw = draw or _table
    # A place made empty at once would be so until its table comes.
    top, below = st.container(), st.container()
    so_far: _SoFar | None = None
    while len(found) < len(asked):
        if found:
            page.run_whole()
            so_far = so_far or _SoFar(top.empty(), below.empty(), draw)
            geometry = asked[len(found)][2] or machine.bearing.geometry
            so_far.show(found, geometry, len(asked), page)
        found += [_worded(one, page) for one in _next(asked[len(found) :])]
    if so_far:
        so_far.progress.empty()
    with so_far.table.container() if so_far else top:
        draw(found, page, done=True)
    return found


def _next(asked: Sequence[_Asked]) -> list[BearingResult]:
    """Return the first results: those that are known, and as many more as patience allows for.

    Other pages run meanwhile, and are not asked for a turn between two results.
    """
    found = _known(asked)
    if len(found) == len(asked):
        return found
    until = time.monotonic() + _PATIENCE
    with one_at_a_time.PAGES.aside():
        helper = _helper(asked[len(found) :])
        while len(found) < len(asked):
            left = until - time.monotonic()
            if found and left <= 0.0:
                break
            rest = asked[len(found) :]
            mine = [one for one in rest if helper is None or not _is_slow(one)]
            if not _results.several(mine, work.bearings, left):
                if helper is None:  # under way for another visitor
                    _results(*rest[0])
                else:
                    helper.join(left if left > 0.0 else _A_LOOK)
                    helper = helper if helper.is_alive() else None
            found += _known(rest)
    return found


def _helper(asked: Sequence[_Asked]) -> threading.Thread | None:
    """Return a thread that has the slow ones computed by another process, where that is free."""
    slow = [one for one in asked if _is_slow(one) and _results.known(*one) is None]
    if not slow or not LONG.is_free:
        return None
    helper = threading.Thread(target=_compute_ahead, args=(slow,), daemon=True)
    helper.start()
    return helper


def _compute_ahead(slow: Sequence[_Asked]) -> None:
    with suppress(Exception):  # the page then asks itself, and is told
        _results.several(slow, work.bearings, _PATIENCE, turns=LONG)


def _is_slow(one: _Asked) -> bool:
    _, _, geometry = one
    return geometry is not None and geometry.kind in _SLOW


def _known(asked: Sequence[_Asked]) -> list[BearingResult]:
    """Return the results that are known before the first one that is not."""
    known = (_results.known(*one) for one in asked)
    return [one for one in takewhile(lambda one: one is not None, known) if one is not None]


class _SoFar(NamedTuple):
    """Places for the results so far, and for how far it is."""

    table: DeltaGenerator
    progress: DeltaGenerator
    draw: Callable[..., object]

    def show(
        self, found: Sequence[BearingResult], geometry: Geometry, among: int, page: Page
    ) -> None:
        """Show what is found, and what comes next."""
        words = f"Computing: {lower(name_of(geometry.kind))} …"
        self.progress.progress(len(found) / among, words)
        with self.table.container():
            self.draw(found, page, done=False)


def _asked(machine: Machine, speed: float) -> list[_Asked]:
    """Return what is computed: the machine as it is, then on every kind of bore by itself."""
    machine = _without_the_unused(machine)
    # The last visitor's bore does not matter to the others: their results are then the same.
    plain = _plain(machine)
    others = ((plain, speed, one) for one in usual_bores(plain.bearing))
    return [(machine, speed, None), *others]


def _without_the_unused(machine: Machine) -> Machine:
    """Return a machine with usual values where no result depends on them: nothing is new then."""
    oil = machine.oil
    if machine.supply is not None or not isinstance(oil, Oil):
        return machine
    # Only a supply's oil carries heat away; only Walther's law asks for the density.
    density = oil.density if oil.law == "walther" else Oil.density
    return replace(machine, oil=replace(oil, heat_capacity=Oil.heat_capacity, density=density))


def _worded(one: BearingResult, page: Page) -> BearingResult:
    """Return a result with its refusal in the sidebar's words and units."""
    said = as_shown(one.refusal, page.preview.values, page.units)
    return replace(one, refusal=said) if one.refusal else one


def _plain(machine: Machine) -> Machine:
    if isinstance(machine.oil, Gas):
        # The others run on the oil that the sidebar had before.
        values = session().values
        return machine_of(on_lubricant(without_shape(values) | defaults_of("plain", values)))
    return replace(machine, bearing=replace(machine.bearing, geometry=Plain(), film="finite"))


@dataclass(frozen=True)
class _Column:
    """A column of numbers: its head, a result and its unit, decimals, width [px], and help."""

    head: str
    attribute: str
    kind: str
    decimals: int
    width: int
    help: str
    bars: bool = False


_COLUMNS = (
    _Column("Onset", "onset", "speed", 0, 88, "Speed at which the rotor begins to whirl; "
            "without a number, none was found.", bars=True),
    _Column("Margin", "margin", "percent", 0, 76, "Onset over running speed, less one."),
    _Column("Whirl", "whirl_ratio", "number", 3, 54, "Whirl ratio at the running speed; without a "
            "number, the film feeds no whirl there."),
    _Column("Log dec.", "log_decrement", "number", 3, 62,
            "Logarithmic decrement of the least damped mode at the running speed."),
    _Column("h min", "minimum_film_thickness", "film", 1, 78, "Smallest film.", bars=True),
    _Column("Power", "power_loss", "power", 2, 80, "Power loss of one bearing.", bars=True),
    _Column("Flow", "side_flow", "flow", 2, 84, "Side flow of one bearing."),
    _Column("Peak", "peak_response", "amplitude", 1, 104,
            "Highest peak of the disk's imbalance response up to 1.5 times the running speed.",
            bars=True),
)  # fmt: skip
# With a supply of oil each bearing's own; a given temperature is the same for all.
_FILM = _Column("Film", "temperature", "temperature", 1, 78, "Temperature of the film, by the "
                "bearing's own balance of heat.")  # fmt: skip
_USE = "Diameter, length, clearance and load stay; Undo takes it back."


def _table(found: Sequence[BearingResult], page: Page, *, done: bool) -> None:
    """Show the results in a table that can be sorted, some as bars, each with a button at last."""
    config = st.column_config
    bearings = [one.bearing for one in found]
    film = () if page.computed.machine.supply is None else (_FILM,)
    own = f"{_OWN}: none" if found[0].refusal else _OWN
    columns: list[tuple[str, list[Any], ColumnConfig | ButtonColumnResult]] = [
        (
            "Bearing",
            [own, *(name_of(one.geometry.kind) for one in bearings[1:])],
            config.TextColumn(width=_wide(143), pinned=True),
        ),
        (
            "Bore",
            [picture_address(one) for one in bearings],
            config.ImageColumn("", width=_wide(40)),
        ),
        (
            "Use",
            ["Use" if done and one != bearings[0] else "" for one in bearings],
            config.ButtonColumn(
                "", width=_wide(48), key=_CLICKED, on_click=_take, args=(bearings,), help=_USE
            )
            if done  # a key stands for one table of a run
            else config.TextColumn("", width=_wide(48)),
        ),
        *(_numbers(column, found, page.units) for column in (*_COLUMNS, *film)),
    ]
    st.dataframe(
        {label: values for label, values, _ in columns},
        column_config={label: config for label, _, config in columns},
        hide_index=True,
        row_height=52,
        height="content",
        placeholder="–",
        alt="Bearings of every kind on this machine: onset, damping, film, losses and response.",
    )
    first = f"{name_of(bearings[0].geometry.kind)}, {film_name(page.preview.values)}".lower()
    st.caption(
        f"First this machine's own bearing ({first}), then each kind at its usual shape, on the "
        "film of finite length, a foil on air. A click on a column's head sorts."
    )


def _wide(width: int) -> int:
    """Return a column's width [px] for the type as it is shown."""
    return round(1.15 * width) if session().present else width


def _numbers(
    column: _Column, found: Sequence[BearingResult], units: Units
) -> tuple[str, list[Any], ColumnConfig]:
    """Return head, values in the units shown, and display of a column."""
    unit = getattr(units, column.kind)
    values = [getattr(one, column.attribute) for one in found]
    if column.attribute == "whirl_ratio":  # zero where there is none
        values = [value or math.nan for value in values]
    shown = [float(unit.of(value)) if math.isfinite(value) else None for value in values]
    head = column.head + ("" if unit.name == "-" else f" [{unit.name}]")
    number = f"%.{column.decimals}f"
    most = max((value for value in shown if value is not None), default=0.0)
    if column.bars and most > 0.0:
        bar = st.column_config.ProgressColumn(
            head, format=number, max_value=most, width=_wide(column.width), help=column.help
        )
        return head, shown, bar
    plain = st.column_config.NumberColumn(
        head, format=number, width=_wide(column.width), help=column.help
    )
    return head, shown, plain


def _take(bearings: Sequence[JournalBearing]) -> None:
    """Take the bearing over whose button in the table was clicked."""
    session().set_bearing(bearings[st.session_state[_CLICKED]["row"]])


def onsets(found: Sequence[BearingResult], page: Page, *, done: bool) -> None:
    """Show a chart of the onset on each kind of bearing, once all are there."""
    if not done:
        return
    kinds = found[1:]
    names = [name_of(one.bearing.geometry.kind) for one in kinds]
    page.chart(
        lambda c: comparison.onsets(kinds, names, c.speed, page.units),
        "onsets",
        alt="Onset of whirl on each kind of bearing as bars, the highest on top.",
        caption=_left_out(kinds),
    )


def _left_out(found: Sequence[BearingResult]) -> str:
    names = ", ".join(lower(name_of(one.bearing.geometry.kind)) for one in found if one.refusal)
    usual = (
        "Each kind at its usual shape, on the film of finite length. Red: it whirls at this speed."
    )
    return f"{usual} Without a result: {names}." if names else usual


def say_unanswered(problem: str) -> None:
    """Say why the machine's own bearing has no answer; others may have one."""
    st.error(f"{problem}. The other bearings are on the same machine.", title=_NO_ANSWER)


def say_exceptions(found: Sequence[BearingResult]) -> None:
    """Name the bearings whose films have no answer here, and those that do not whirl."""
    names = [lower(name_of(one.bearing.geometry.kind)) for one in found]
    refused = [name for name, one in zip(names, found, strict=True) if one.refusal]
    steady = [name for name, one in zip(names, found, strict=True) if one.onset == math.inf]
    if refused:
        st.warning(f"No answer at this speed and load, for the reason below: {', '.join(refused)}.")
    if steady:
        st.info(f"No onset was found on: {', '.join(steady)}.")


def in_rows(found: Sequence[BearingResult]) -> Iterator[Sequence[BearingResult]]:
    """Yield results a few at a time."""
    for place in range(0, len(found), _A_ROW):
        yield found[place : place + _A_ROW]


def card(page: Page, one: BearingResult, found: Sequence[BearingResult]) -> None:
    """Show a kind's picture, what is said of it, whether it holds here, and a button to take it."""
    kind = one.bearing.geometry.kind
    st.html(picture_tag(one.bearing, 96))
    words = (f"**{name_of(kind)}**", _JUDGEMENTS[kind].words, *here(one, found, page.units))
    st.markdown("\n\n".join(words))
    st.button(
        "Use this bearing", key=f"use_{kind}", on_click=session().set_bearing, args=(one.bearing,),
        disabled=one.bearing == page.computed.machine.bearing, help=_USE,
    )  # fmt: skip


def here(one: BearingResult, found: Sequence[BearingResult], units: Units) -> list[str]:
    """Return whether this machine's numbers bear out what is said of a bearing."""
    if one.refusal:
        return [f"Here: {one.refusal}."]
    plain, *others = found
    answered = [other for other in others if not other.refusal]
    lines: list[str] = []
    for claim in _JUDGEMENTS[one.bearing.geometry.kind].claims:
        other = min(answered, key=claim.value, default=plain) if one is plain else plain
        # Where neither has an onset, or both whirl at any speed, their numbers tell nothing.
        value, to = claim.value(one), claim.value(other)
        if value != to and not math.isnan(value + to):
            lines.append(_judged(claim, one, other, units))
    return lines


def _judged(claim: Claim, one: BearingResult, other: BearingResult, units: Units) -> str:
    value, to = claim.value(one), claim.value(other)
    holds = value > to if claim.more else value <= to
    badge = ":green-badge[borne out]" if holds else ":orange-badge[not here]"
    numbers = f"{claim.shown(one, units)} against {claim.shown(other, units)}"
    return f"{badge} {claim.words if holds else claim.denied}: {numbers}."
