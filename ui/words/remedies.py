"""Remedies: the onset that is wanted, the values of one input that give it, and their use."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import streamlit as st

from rotorcalc import Machine, design
from rotorcalc.figures.design import Quantity
from rotorcalc.units import SI, Units
from ui.bores import Value
from ui.choices import choice
from ui.computed import Computed
from ui.format import amount, digits, quoted, typed_number
from ui.inputs import INPUTS
from ui.jobs import cache, work
from ui.preview import Text
from ui.words.citation import without_load
from ui.words.design import bore_field, fields_of, quantity, value_of

_solution = cache.Cached(work.solution, entries=64, megabytes=4)

WANTED, GIVEN = "stability_wanted", "at a given speed"
# Where an onset is wanted, by the words for it, but for a given speed.
_BASES: dict[str, Callable[[Computed], float]] = {
    "above the running speed": lambda c: c.speed,
    "above today's onset": lambda c: c.onset.speed,
    "above the top speed": lambda c: c.top_speed,
}
# By default the onset is wanted so much above the running speed, or above where it lies already.
_MARGIN = 20.0
_MOST_MARGIN = 1000.0


@dataclass(frozen=True)
class Wanted:
    """An onset that is wanted: a margin [%] above a speed of the machine, or a speed [rad/s]."""

    where: str
    margin: float
    speed: float = math.nan

    def target(self, computed: Computed) -> float:
        """Return the onset wanted of a machine [rad/s]."""
        if self.where not in _BASES:
            return self.speed
        return (1.0 + self.margin / 100.0) * _BASES[self.where](computed)

    def words(self, computed: Computed, units: Units) -> str:
        """Return the onset wanted in words."""
        speed = amount(units.speed, self.target(computed))
        if self.where not in _BASES:
            return speed
        return f"{speed}, {digits(self.margin)} % {self.where}"


def usual_input(computed: Computed) -> str:
    """Return the input to vary at first: without load the cure is a load, or stiffness there."""
    if computed.onset.speed > 0.0:
        return "C"
    own = [key for key in fields_of(computed.machine) if key not in INPUTS]
    return "load" if computed.unloaded or not own else own[0]


def choose_wanted(computed: Computed, where: str, units: Units) -> Wanted | None:
    """Ask for the margin or speed; return None, with the reason shown, where it is none."""
    label, usual = (
        (f"Speed [{units.speed.name}]", float(units.speed.of(_useful(computed))))
        if where == GIVEN
        else ("Margin [%]", _MARGIN)
    )
    key = "stability_target" if where == GIVEN else "stability_margin"
    usual = float(f"{usual:.3g}")
    begun = choice(key, f"{usual:g}", lambda word: len(word) < 40)
    if begun is not None:
        st.session_state[key] = begun
    text = st.text_input(label, key=key)
    try:
        return _taken(where, typed_number(text), units)
    except ValueError as error:
        st.warning(f"{label} = {quoted(text)} {error}.")
        return None


def _taken(where: str, number: float, units: Units) -> Wanted:
    if where == GIVEN:
        if not 0.0 < number < 1e7:
            raise ValueError("must be a positive speed")
        return Wanted(where, 0.0, units.speed.to_si(number))
    if not 0.0 <= number <= _MOST_MARGIN:
        raise ValueError(f"must lie between 0 and {_MOST_MARGIN:g} %")
    return Wanted(where, number)


def choose_where(computed: Computed) -> str:
    """Ask where the onset is wanted; at first above what makes a better one than today's."""
    options = [*_BASES, GIVEN]
    if not 0.0 < computed.onset.speed < math.inf:
        options.remove("above today's onset")
    usual = next(
        (one for one in options if one in _BASES and Wanted(one, _MARGIN).target(computed)
         > computed.onset.speed),
        options[0],
    )  # fmt: skip
    first = choice(WANTED, usual, options.__contains__)
    if first is None and st.session_state[WANTED] not in options:
        st.session_state[WANTED] = usual
    chosen = st.selectbox("Onset wanted", options, options.index(first or usual), key=WANTED)
    return chosen or usual


def _useful(computed: Computed) -> float:
    """Return a first speed to ask for [rad/s]: 20 % above onset and running speed."""
    onset = computed.onset.speed
    return 1.2 * max(computed.speed, onset if math.isfinite(onset) else 0.0)


def solution(computed: Computed, key: str, target: float, units: Units) -> design.OnsetSolution:
    """Return the values of an input that put the onset at a speed."""
    axis, machine = quantity(key, computed.machine, units), computed.machine
    return _solution(machine, fields_of(machine)[key], target, axis.low, axis.high)


def answer(computed: Computed, key: str, wanted: Wanted, units: Units) -> str:
    """Return a text with the values that meet the target, or the range that can be reached."""
    axis, now = quantity(key, computed.machine, units), value_of(computed.machine, key)
    found = solution(computed, key, wanted.target(computed), units)
    begin = f"Wanted: an onset of {wanted.words(computed, units)}. "
    if len(found.solutions):
        return begin + _met(computed, found, axis, now, units)
    low, high = (float(units.speed.of(end)) for end in found.reachable)
    ends = f"{axis.text(axis.low)} and {axis.text(axis.high)}"
    if math.isinf(low):
        return f"{begin}With no {axis.words.lower()} between {ends} does this machine whirl."
    if low == high:
        return f"{begin}{axis.words} does not affect the onset of this machine."
    stays = f"above {digits(low)} {units.speed.name}"
    if math.isfinite(high):
        stays = f"between {digits(low)} and {digits(high)} {units.speed.name}"
    return (
        f"{begin}No value of the {axis.words.lower()} between {ends} gives it: the onset stays "
        f"{stays}."
    )


def _met(
    computed: Computed, found: design.OnsetSolution, axis: Quantity, now: float, units: Units
) -> str:
    values = " or ".join(f"**{axis.text(value)}**" for value in found.solutions)
    onset, today = computed.onset.speed, _now(axis, now)
    if onset == 0.0:
        return (
            f"{axis.words} {values} gives it; now it is {today}, and the machine whirls at any "
            "speed."
        )
    if math.isinf(onset):
        return f"{axis.words} {values} gives it; now it is {today}, and no onset was found."
    if math.isclose(onset, found.target, rel_tol=1e-6):
        return f"The onset is there already; {axis.words.lower()} {values} gives it."
    if onset > found.target:
        return (
            f"The onset is higher already, {amount(units.speed, onset)}: "
            f"{axis.words.lower()} {values} would lower it to this; now it is {today}."
        )
    return (
        f"{axis.words} {values} gives it; now it is {today}, and the onset "
        f"{amount(units.speed, onset)}."
    )


def cure(computed: Computed) -> Text | None:
    """Return what raises an onset of zero, where it is."""
    if computed.onset.speed > 0.0:
        return None
    why = f"The machine whirls at any speed: {without_load(computed)}."
    if not computed.unloaded:
        return Text(why, "info")
    return Text(
        f"{why} A **load** gives it some, and so does a bearing with **preload**, such as an "
        "elliptical or a lobed bore (Notes, Bearing types).",
        "info",
    )


def draw_buttons(
    computed: Computed, key: str, wanted: Wanted, units: Units,
    apply: Callable[[str, Value], None],
) -> None:  # fmt: skip
    """Draw a button for each solution, which makes it the machine's value."""
    axis = quantity(key, computed.machine, units)
    found = solution(computed, key, wanted.target(computed), units)
    with st.container(horizontal=True, gap="small"):
        for place, value in enumerate(found.solutions):
            kept = kept_value(computed.machine, key, float(value))
            problem = INPUTS[key].problem(kept) if key in INPUTS else ""
            st.button(
                f"Apply {axis.text(float(value))}", key=f"remedy_{place}", on_click=apply,
                args=(key, kept), disabled=bool(problem),
                help=problem or f"Sets {axis.words.lower()} to this value; Undo takes it back.",
            )  # fmt: skip


def kept_value(machine: Machine, key: str, value: float) -> float:
    """Return a solved value [SI] as it is kept, to six digits, which a link shows."""
    unit = INPUTS[key].unit(SI) if key in INPUTS else bore_field(machine, key).unit(SI)
    return float(f"{float(unit.of(value)):.6g}")


def _now(axis: Quantity, value: float) -> str:
    return "infinite" if math.isinf(value) else axis.text(value)
