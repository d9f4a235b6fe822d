"""The rows of a page in which a visitor says which inputs spread, and how."""

from dataclasses import dataclass
from typing import Literal

import streamlit as st

from rotorcalc import Machine
from rotorcalc.units import Units
from ui.choices import choice
from ui.inputs import INPUTS
from ui.session import session
from ui.words import spreads
from ui.words.design import fields_of, name
from ui.words.spreads import DISTRIBUTIONS, Spread

SPREADS = "tolerances_spreads"
_LONGEST = 600
_WIDE, _NARROW = 240, 116


@dataclass(frozen=True)
class Rows:
    """The spreads shown, of a machine, in a visitor's units."""

    spreads: tuple[Spread, ...]
    machine: Machine
    units: Units

    @property
    def fields(self) -> tuple[str, ...]:
        """The inputs that spread, as the core names them."""
        return tuple(fields_of(self.machine)[one.key] for one in self.spreads)

    @property
    def problem(self) -> str:
        """Why the first spread that cannot be used is none, or nothing."""
        said = (spreads.problem(self.machine, one, self.units) for one in self.spreads)
        return next(filter(None, said), "")

    def draw(self) -> None:
        """Show a row for each spread, and below it why it cannot be used."""
        for place in range(len(self.spreads)):
            self._row(place)

    def draw_add(self) -> None:
        """Show a button that lets one more input spread."""
        free = self._free()
        st.button(
            "Add an input", key="spread_add", on_click=self._add,
            disabled=not free or len(self.spreads) >= spreads.MOST,
            help=f"Up to {spreads.MOST} inputs spread, independently of one another.",
        )  # fmt: skip

    def _row(self, place: int) -> None:
        one = self.spreads[place]
        with st.container(horizontal=True, gap="xsmall"):
            self._choose(place, "Input", [one.key, *self._free()], one.key, _WIDE)
            self._choose(place, "Distribution", list(DISTRIBUTIONS), one.word, "stretch")
        with st.container(horizontal=True, gap="xsmall", vertical_alignment="bottom"):
            for number in range(len(one.texts)):
                self._number(place, number)
            if len(self.spreads) > 1:
                st.button(
                    "Remove", key=f"spread_{place}_remove", type="tertiary",
                    on_click=self._drop, args=(place,),
                )  # fmt: skip
        if problem := spreads.problem(self.machine, one, self.units):
            st.warning(f"{problem}.")

    def _number(self, place: int, number: int) -> None:
        one, key = self.spreads[place], f"spread_{place}_{number}_{self.units.name}"
        session().mirror(key, spreads.shown(self.machine, one, number, self.units))
        st.text_input(
            spreads.label(self.machine, one, number, self.units), key=key, width=_NARROW,
            on_change=self._take_text, args=(place, number, key),
        )  # fmt: skip

    def _choose(
        self, place: int, label: str, options: list[str], now: str, width: int | Literal["stretch"]
    ) -> None:
        key = f"spread_{place}_{label.lower()}"
        session().mirror(key, now)
        st.selectbox(
            label, options, key=key, format_func=self._words, width=width,
            label_visibility="collapsed", on_change=self._take_choice, args=(place, key),
        )  # fmt: skip

    def _words(self, option: str) -> str:
        """Return an input or a distribution in words."""
        found = DISTRIBUTIONS.get(option)
        return found.words if found else name(self.machine, option)

    def _take_choice(self, place: int, key: str) -> None:
        chosen, one = st.session_state[key], self.spreads[place]
        if chosen in DISTRIBUTIONS:
            self._replace(place, spreads.with_word(self.machine, one, chosen))
        else:
            self._replace(place, spreads.usual_spread(self.machine, chosen, one.word))

    def _take_text(self, place: int, number: int, key: str) -> None:
        one, typed = self.spreads[place], st.session_state[key]
        self._replace(place, spreads.kept(self.machine, one, number, typed, self.units))

    def _replace(self, place: int, one: Spread) -> None:
        _keep((*self.spreads[:place], one, *self.spreads[place + 1 :]))

    def _drop(self, place: int) -> None:
        _keep((*self.spreads[:place], *self.spreads[place + 1 :]))

    def _add(self) -> None:
        free = self._free()
        own = [key for key in free if key not in INPUTS]
        key = next(one for one in ("load", *own, "mu", *free) if one in free)
        _keep((*self.spreads, spreads.usual_spread(self.machine, key)))

    def _free(self) -> list[str]:
        """Return the inputs that do not spread."""
        taken = {one.key for one in self.spreads}
        return [key for key in fields_of(self.machine) if key not in taken]


def choose_spreads(machine: Machine, units: Units) -> Rows:
    """Show the inputs that spread, each in a row; return them."""
    begun = choice(SPREADS, "", lambda text: len(text) < _LONGEST)
    if begun is not None:
        st.session_state[SPREADS] = begun
    text = str(st.session_state[SPREADS])
    found, problems = spreads.read(text, machine) if text else ((), [])
    for problem in problems:
        st.warning(problem)
    rows = Rows(found or spreads.usual_spreads(machine), machine, units)
    rows.draw()
    return rows


def _keep(chosen: tuple[Spread, ...]) -> None:
    st.session_state[SPREADS] = spreads.written(chosen)
