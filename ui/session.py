"""A visitor's session: one machine, its preset, the units of display, the cases beside it.

Widgets read from here and write to here, and the address bar is written from here. So a value
survives a change of page, whether it was moved or came with a link.
"""

import secrets
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any
from urllib.parse import parse_qsl, urlencode

import streamlit as st

from rotorcalc import CoefficientTable
from rotorcalc.machine import Bearing
from rotorcalc.units import SYSTEMS, Units, with_amplitudes
from ui import cases
from ui.bearing import bearing_values, defaults_of, film_model, without_shape
from ui.bores import FILM, KIND, Pick, Value, Values, bore_inputs, with_pick
from ui.cases import Case
from ui.choices import Value as Choice
from ui.choices import choices, release_of, words_of
from ui.history import MOST_NEAR, History
from ui.inputs import (
    LAW,
    PRESET_VALUES,
    SUPPLY,
    has_gas,
    has_supply,
    number,
    on_lubricant,
    usual_values,
)
from ui.own import TABLE, TOO_LONG, speeds_within
from ui.preview import Preview
from ui.sharing import address, labels

_KEY = "rotorcalc"


@dataclass(frozen=True)
class Work:
    """What undo and redo restore."""

    preset: str
    values: Values
    cases: tuple[Case, ...]
    # Those of a page's choices that belong to a state, but make none by themselves.
    release: Mapping[str, Choice] = field(default_factory=dict, compare=False)

    @cached_property
    def link(self) -> str:
        """The state as a link has it, for the browser to keep."""
        params = address.write(self.preset, self.values, "SI", self.cases)
        return urlencode(params | words_of(self.release))

    @classmethod
    def of(cls, link: str) -> "Work":
        """Return the state of a link, as far as it can be used."""
        given = address.read(dict(parse_qsl(link)))
        return cls(given.preset, given.values, given.cases, release_of(given.choices))


@dataclass
class Session:
    """One visitor's machine and how it is shown."""

    preset: str
    values: Values
    units_name: str
    problems: list[str] = field(default_factory=list)
    # What could not be taken of a link or a file: until the visitor takes the rest, nothing is
    # computed, as the rest is another machine than was meant.
    refused: list[str] = field(default_factory=list)
    cases: tuple[Case, ...] = ()
    # How amplitudes are read: "0-p" or "p-p".
    amplitude: str = "0-p"
    typed: bool = False
    image_format: str = "png"
    # Of a presentation: "" at the desk, else the key of the chart in view, or "1" for the first;
    # and the charts known so far, by the first of those that are open together.
    present: str = ""
    views: dict[str, tuple[str, ...]] = field(default_factory=dict)
    # Whether a slider is being dragged: the address bar waits until it is released.
    dragging: bool = False
    # The preview of the page as it was last drawn, and the secret to ask for it.
    preview: Preview | None = None
    token: str = field(default_factory=secrets.token_urlsafe)
    # Whether the page's content runs together with its frame the next time.
    whole: bool = False
    # Number of the frame drawn last. Of sliders and preview of one frame, the preview's values are
    # the newer.
    frame: int = 0
    # What the frame drawn last shows beside its sliders.
    drawn: tuple[object, ...] = ()
    # Long computations: those requested, by button, and those that have begun and not ended.
    asked: dict[str, str] = field(default_factory=dict)
    begun: set[str] = field(default_factory=set)
    # The page whose sidebar was drawn last, and whether the visitor has just come to another.
    page: str = ""
    arriving: bool = True
    # Whether its state is that of a session before it, which the browser kept.
    recalled: bool = False
    history: History[Work] = field(init=False)
    # The visitor's own work and its history, while a lecture's machine is shown.
    borrowed: "tuple[Work, History[Work]] | None" = None

    def __post_init__(self) -> None:
        """Begin the history with the machine of the link."""
        self.history = History(self._work())

    @property
    def units(self) -> Units:
        """The units shown."""
        return with_amplitudes(SYSTEMS[self.units_name], self.amplitude)

    def set_value(self, key: str, value: Value) -> None:
        """Keep a moved value, and drop the messages about a link or a file."""
        self.values[key] = value
        self.problems.clear()

    def set_kind(self, kind: str) -> None:
        """Take over a kind of bearing as it is by itself; diameter, length, clearance stay."""
        before = self.values
        self._set(on_lubricant(without_shape(before) | defaults_of(kind, before)))
        if has_gas(self.values) and has_supply(before):
            self.problems.append(
                "A foil bearing runs on air, which a supply of oil does not cool: its film's "
                "temperature is given."
            )

    def set_bearing(self, bearing: Bearing) -> None:
        """Take over another bearing's bore and film model; diameter, length, clearance stay.

        Or a table of its own coefficients: a supply of oil and a running speed that do not go with
        it give way, and the page says so.
        """
        if isinstance(bearing, CoefficientTable):
            self._set_table(bearing)
            return
        self._set(on_lubricant(without_shape(self.values) | bearing_values(bearing)))
        self.set_film(bearing.model)

    def _set_table(self, table: CoefficientTable) -> None:
        values = on_lubricant(without_shape(self.values) | bearing_values(table))
        problems: list[str] = []
        if has_supply(values):
            values |= dict.fromkeys(SUPPLY) | {"T": values["T_in"]}
            problems.append(
                "Own coefficients give no loss, so no film temperature follows from a supply of "
                "oil: it was left out."
            )
        low, high = speeds_within(str(values[TABLE]))
        speed = number(values, "rpm")
        if not low <= speed <= high:
            values["rpm"] = min(max(speed, low), high)
            problems.append(
                f"The running speed was {speed:g} rpm; own coefficients are given from {low:g} to "
                f"{high:g} rpm, so it is {values['rpm']:g} rpm now."
            )
        self._set(values)
        self.problems += problems

    def set_supply(self, heat: Values) -> None:
        """Take over film temperature and supply of oil, of which one is None (`ui.supply`)."""
        self._set(self.values | heat)

    def set_law(self, law: str) -> None:
        """Take over a law of the oil's viscosity."""
        self.set_value(LAW, law)

    def set_film(self, film: str) -> None:
        """Take over a film model; that of a bearing that names none needs no name."""
        usual = film_model(self.values | {FILM: None})
        self.set_value(FILM, None if film == usual else film)

    def set_pick(self, item: Pick, value: Value) -> None:
        """Take over a whole number or a word of the bore, and say what it made narrower."""
        before = self.values
        self._set(with_pick(before, item, value))
        self.problems += (
            f"{item.label} {value:g}: each is narrower now, as they would overlap."
            for part in item.parts[:1]
            if self.values[part] != before[part]
        )

    def _set(self, values: Values) -> None:
        self.values = values
        self.problems.clear()

    def set_preset(self, preset: str) -> None:
        """Take over a preset's machine and speeds."""
        self.preset, self.values = preset, dict(PRESET_VALUES[preset])
        self.take()

    def lend(self, values: Values, preset: str) -> None:
        """Show another machine for a while; the visitor's own, and its history, are kept."""
        first = self.borrowed is None
        if first:
            self.record()
            self.borrowed, self.cases = (self._work(), self.history), ()
        self.preset, self.values = preset, values
        self.take()
        if first:
            self.history = History(self._work())

    def give_back(self) -> None:
        """Show the visitor's own machine again, with its history."""
        if self.borrowed:
            work, self.history = self.borrowed
            self.borrowed = None
            self._restore(work)

    def adopt(self) -> None:
        """Make the machine that is shown the visitor's own, as a change that can be undone."""
        if self.borrowed:
            work, self.history = self.borrowed
            self.borrowed, self.cases = None, work.cases
            self.record()

    def take(self) -> None:
        """Drop what was refused of a link or a file, and the messages about it."""
        self.problems.clear()
        self.refused.clear()

    def changed(self) -> list[str]:
        """Return the keys of the values that differ from the preset's."""
        return changed(self.preset, self.values)

    def record(self) -> None:
        """Keep the machine for undo; while a slider is dragged, only where it is released."""
        if not self.dragging:
            self.history.record(self._work())

    def undo(self) -> None:
        """Go back to the machine before the last change."""
        self.record()
        self._restore(self.history.undo())

    def redo(self) -> None:
        """Make the change that was undone last."""
        self.record()
        self._restore(self.history.redo())

    def _work(self) -> Work:
        return Work(self.preset, dict(self.values), self.cases, choices().release())

    def _restore(self, work: Work) -> None:
        self.preset, self.values, self.cases = work.preset, dict(work.values), work.cases
        choices().restore(work.release)
        self.take()

    def framed(self) -> tuple[object, ...]:
        """Return what the frame shows of the machine beside its sliders, which follow by
        themselves.
        """
        inputs = bore_inputs(self.values)
        picked = [
            self.values[item.key] if isinstance(item, Pick) else self.values[item.key] is None
            for item in inputs
        ]
        return (
            self.preset, self.values["load"] is None, has_supply(self.values), self.values[LAW],
            has_gas(self.values),
            self.values[KIND], self.values[FILM], inputs, picked, self.units_name,
        )  # fmt: skip

    def view(self, chart: str) -> None:
        """Show a chart in a presentation, "1" for the first one, "" for none: all at a desk."""
        self.present = chart

    def mirror(self, key: str, value: object) -> bool:
        """Give a widget its value before it is drawn, where it has another; return whether it had.

        A page's widgets are its own: on arriving, `session_state` still answers for the last
        page's.
        """
        needed = self.arriving or st.session_state.get(key) != value
        if needed:
            st.session_state[key] = value
        return needed

    def keep(self, name: str) -> None:
        """Keep the live machine as a case, or raise ValueError: `ui.cases` says why."""
        self.cases = cases.added(self.cases, name, self.values)

    def rename(self, place: int, name: str) -> None:
        """Rename a case, or raise ValueError."""
        self.cases = cases.renamed(self.cases, place, name)

    def drop(self, place: int) -> None:
        """Forget a case."""
        self.cases = (*self.cases[:place], *self.cases[place + 1 :])

    def use(self, place: int) -> None:
        """Make a case the live machine."""
        self.values = dict(self.cases[place].values)
        self.take()

    def link(self) -> dict[str, str]:
        """Return the query parameters of a link to what is shown."""
        shown = address.write(self.preset, self.values, self.units_name, self.cases)
        shown |= {"amplitude": self.amplitude} if self.amplitude != "0-p" else {}
        presented = {"present": self.present} if self.present else {}
        return shown | choices().link() | presented

    def ask_for(self, work: str, name: str) -> None:
        """Request a long computation; `name` distinguishes it from others of its kind."""
        self.asked[work] = name
        self.begun.discard(work)

    def ask_no_more(self, work: str) -> None:
        """Withdraw the request of a long computation."""
        self.asked.pop(work, None)
        self.begun.discard(work)

    def kept(self) -> dict[str, Any]:
        """Return the state that the browser keeps for a session after this one.

        All of it is text and finite numbers, which JSON can hold.
        """
        states, place = self.history.near()
        return {
            "typed": self.typed, "image_format": self.image_format,
            "asked": self.asked, "chosen": choices().kept(), "labels": labels.kept(),
            "states": [state.link for state in states], "place": place,
            "recalled": self.recalled, "own": self.borrowed[0].link if self.borrowed else "",
        }  # fmt: skip

    def recall(self, kept: object) -> None:
        """Restore the valid part of what a browser kept, which is untrusted."""
        if not isinstance(kept, dict):
            return
        given: dict[str, Any] = kept
        self.recalled = True
        self.typed = given.get("typed") is True
        self.image_format = "svg" if given.get("image_format") == "svg" else "png"
        self.asked = _words(given.get("asked"), str)
        self.begun = set(self.asked)
        choices().recall(given.get("chosen"))
        labels.recall(_words(given.get("labels"), str))
        self._recall_history(given.get("states"), given.get("place"))
        if isinstance(own := given.get("own"), str) and own:
            work = Work.of(own)
            self.borrowed = (work, History(work))

    def _recall_history(self, links: object, place: object) -> None:
        """Take over the states that a browser kept, and go on from them."""
        given = links[:MOST_NEAR] if isinstance(links, list) else []
        if any(f"{TABLE}={TOO_LONG}" in str(link) for link in given):
            return  # a table that no link carries: another machine would stand in its place
        states = [Work.of(link) for link in given if isinstance(link, str)]
        if states and isinstance(place, int) and 0 <= place < len(states):
            self.history = History(*states, at=place)
            self.history.record(self._work())


def changed(preset: str, values: Values) -> list[str]:
    """Return the keys of the values that differ from a preset's.

    Of another kind of bearing than the preset's these are the kind, and its fields that are not at
    their default.
    """
    usual = usual_values(preset, values) | {KIND: PRESET_VALUES[preset][KIND]}
    return [key for key, value in values.items() if key not in usual or value != usual[key]]


def _words(given: object, kind: type | tuple[type, ...]) -> dict[str, Any]:
    """Return the values of a mapping that have a type."""
    items = given.items() if isinstance(given, dict) else ()
    return {key: value for key, value in items if isinstance(value, kind)}


def session() -> Session:
    """Return this session's state; a new session's comes from the address bar."""
    with suppress(KeyError):
        return st.session_state[_KEY]
    given = address.read(st.query_params.to_dict())
    st.session_state[_KEY] = visitor = Session(
        preset=given.preset, values=given.values, units_name=given.units, refused=given.problems,
        cases=given.cases, amplitude=given.amplitude, present=given.present,
    )  # fmt: skip
    choices().words = given.choices
    return visitor


def write_address_bar() -> dict[str, str]:
    """Write the machine to the address bar if it differs; return the query parameters."""
    visitor = session()
    params = visitor.link()
    # Streamlit sends the address bar to the browser at each assignment, changed or not.
    # A link that was refused in part stays as it is: read again, it is refused again.
    if not visitor.dragging and not visitor.refused and st.query_params.to_dict() != params:
        st.query_params.from_dict(params)
    return params
