"""What the page Criteria asks: speeds of operation, cross-coupling, and a grade of balancing."""

import math
from collections.abc import Callable
from functools import partial

import streamlit as st

from rotorcalc.criteria.unbalance import GRADES
from rotorcalc.units import SI, Units
from ui import criteria
from ui.choices import Value, choice, choices
from ui.computed import computed_from
from ui.criteria import COUPLING, FASTEST, FIELDS, GIVEN, GRADE, SLOWEST, STAGE, STAGES, Asked
from ui.format import quoted, short, typed_number
from ui.input_record import Input, tidy
from ui.inputs import INPUTS, in_units
from ui.preview import Preview
from ui.session import Session, session
from ui.words import criteria as words

# Characters of a visitor's number, and of all stages together, at most.
_LONGEST, _LONGEST_STAGES = 40, 1000


def ask(preview: Preview) -> Asked | None:
    """Show what is asked; return it, or None where something cannot be used, which is then said."""
    units, problems = preview.units, list[str]()
    with st.container(key="criteria_ask"):
        coupling = _ask_machine(units, problems)
    if coupling == "stages":
        _ask_stages(units, problems)
    if problems:
        for problem in problems:
            st.warning(problem)
        return None
    asked = _asked(preview)
    if asked is not None and coupling == "stages":
        preview.say("coupling", lambda c: words.coupling(c, asked, units))
    return asked


def _ask_machine(units: Units, problems: list[str]) -> str:
    """Show what is asked of the whole machine; return where the cross-coupling comes from."""
    given = _source() == "given"
    *fields, button = st.columns(6 if given else 5, vertical_alignment="bottom")
    with fields[0]:
        _field(SLOWEST, units, problems)
    with fields[1]:
        _field(FASTEST, units, problems)
    with fields[2]:
        coupling = _select(COUPLING, "Cross-coupling Qₐ", criteria.COUPLINGS)
    if given:
        with fields[3]:
            _field(GIVEN, units, problems)
    with fields[-1]:
        _select(GRADE, "Balance grade", dict.fromkeys(GRADES, ""))
    with button:
        st.button(
            "Set the imbalance", key="criteria_set", on_click=set_imbalance, width="stretch",
            help="Sets the machine's imbalance u to what the grade permits at the maximum "
            "continuous speed; Undo takes it back.",
        )  # fmt: skip
    return coupling


def _source() -> str:
    """Return where the cross-coupling comes from, before its widget is drawn."""
    first = choice(COUPLING, "none", criteria.COUPLINGS.__contains__)
    return first or st.session_state[COUPLING]


def _asked(preview: Preview) -> Asked | None:
    """Return what is asked, or None with the reason shown."""
    try:
        asked = criteria.asked_of(choices().kept())
        asked.operation(preview.computed)
    except ValueError as error:
        st.warning(f"{in_units(f'{error}', preview.units)}.")
        return None
    return asked


def _select(key: str, label: str, options: dict[str, str]) -> str:
    """Show a choice of one among some options, at first the first."""
    names = list(options)
    first = choice(key, names[0], names.__contains__)
    chosen = st.selectbox(
        label, names, index=names.index(first or names[0]), key=key,
        format_func=lambda one: options[one] or one,
    )  # fmt: skip
    return chosen or names[0]


def _field(key: str, units: Units, problems: list[str]) -> None:
    """Show a field for a number that may be left empty, kept in SI as engineers write it."""
    item = FIELDS[key]
    word = choice(key, "", lambda given: len(given) <= _LONGEST) or ""
    _number(item, word, units, f"{key}_{units.name}", problems, partial(_keep, key))


def _number(  # noqa: PLR0913, PLR0917 - a field: its input, its word, and what becomes of both
    item: Input, word: str, units: Units, key: str, problems: list[str],
    keep: Callable[[str], None],
) -> None:  # fmt: skip
    """Show a field of one number; what is typed is kept, also where it cannot be used."""
    shown, problem = _shown(item, word, units)
    session().mirror(key, shown)
    st.text_input(
        item.name(units), key=key, placeholder=item.follows or "missing", help=item.help,
        max_chars=_LONGEST, on_change=lambda: keep(_kept(item, st.session_state[key], units)),
    )  # fmt: skip
    if problem:
        problems.append(f"{item.name(units)} = {quoted(shown)} {problem}; type another value.")


def _shown(item: Input, word: str, units: Units) -> tuple[str, str]:
    """Return a kept word as a visitor sees it, and why it cannot be used, or nothing."""
    if not word:
        return "", ""
    try:
        value = typed_number(word)
    except ValueError as error:
        return word, f"{error}"
    if not math.isfinite(value):
        return word, "is not a finite number"
    return short(item.shown(value, units)), item.problem(value, units)


def _kept(item: Input, text: str, units: Units) -> str:
    """Return what is typed as it is kept: a number in SI, any other text as it is."""
    try:
        value = item.stored(typed_number(text), units)
    except ValueError:
        return text.strip()
    return f"{tidy(value):.12g}"


def _keep(key: str, word: Value) -> None:
    choices().chosen[key] = word


def _ask_stages(units: Units, problems: list[str]) -> None:
    """Show the numbers of each stage, and buttons that add one and remove one."""
    text = choice(STAGES, criteria.NO_STAGE, lambda given: len(given) <= _LONGEST_STAGES)
    stages = criteria.words_of_stages(text or criteria.NO_STAGE)
    with st.expander("Stages", expanded=True), st.container(key="criteria_stages"):
        for place, stage in enumerate(stages):
            _stage(place, stage, units, problems, alone=len(stages) == 1)
        st.button(
            "Add a stage", key="criteria_add", on_click=_add_stage,
            disabled=len(stages) >= criteria.MOST_STAGES,
        )  # fmt: skip


def _stage(
    place: int, stage: list[str], units: Units, problems: list[str], *, alone: bool
) -> None:  # fmt: skip
    """Show the numbers of one stage, its kind, and a button that removes it."""
    *columns, kind, button = st.columns([4, 4, 4, 4, 4, 3], vertical_alignment="bottom")
    for part, (column, item) in enumerate(zip(columns, STAGE, strict=True)):
        with column:
            _number(
                item, stage[part], units, f"criteria_{item.key}_{place}_{units.name}", problems,
                partial(_set_stage, place, part),
            )  # fmt: skip
    with kind:
        _kind(place, stage[-1])
    with button:
        st.button(
            "Remove", key=f"criteria_remove_{place}", on_click=_remove_stage, args=(place,),
            disabled=alone, width="stretch", help=f"Removes stage {place + 1}.",
        )  # fmt: skip


def _kind(place: int, kind: str) -> None:
    key, names = f"criteria_kind_{place}", list(criteria.KINDS)
    session().mirror(key, kind)
    st.selectbox(
        "Kind", names, key=key, format_func=criteria.KINDS.__getitem__,
        on_change=lambda: _set_stage(place, len(STAGE), st.session_state[key]),
    )  # fmt: skip


def _stages() -> list[list[str]]:
    return criteria.words_of_stages(str(choices().chosen.get(STAGES, criteria.NO_STAGE)))


def _write(stages: list[list[str]]) -> None:
    _keep(STAGES, criteria.text_of_stages(stages))


def _set_stage(place: int, part: int, word: str) -> None:
    stages = _stages()
    stages[place][part] = word
    _write(stages)


def _add_stage() -> None:
    _write([*_stages(), criteria.words_of_stages(criteria.NO_STAGE)[0]])


def _remove_stage(place: int) -> None:
    stages = _stages()
    _write([*stages[:place], *stages[place + 1 :]])


def set_imbalance() -> None:
    """Set the machine's imbalance to what the grade permits, or say why it cannot be."""
    visitor = session()
    try:
        value = permitted(visitor)
    except ValueError as error:
        visitor.problems[:] = [f"{in_units(f'{error}', visitor.units)}."]
        return
    if problem := INPUTS["u"].problem(value, visitor.units):
        name, text = INPUTS["u"].name(visitor.units), INPUTS["u"].text(value, visitor.units)
        visitor.problems[:] = [f"{name} = {text} {problem}; it was left as it is."]
    else:
        visitor.set_value("u", value)


def permitted(visitor: Session) -> float:
    """Return the imbalance that the grade permits, as it is kept.

    To the six digits that a link shows, cut off: rounded up it would not meet its own grade.
    """
    asked = criteria.asked_of(choices().kept())
    u = criteria.graded_imbalance(computed_from(visitor.values), asked)
    value = float(INPUTS["u"].unit(SI).of(u))
    power = 10.0 ** (math.floor(math.log10(value)) - 5)
    return tidy(math.floor(value / power * (1.0 + 1e-12)) * power)
