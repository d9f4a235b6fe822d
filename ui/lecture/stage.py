"""The lecture's stage: which step is shown, what it asks, and the way back to one's own machine."""

import io
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

import segno
import streamlit as st

from ui.choices import choice
from ui.computed import Computed, answered_from, computed_from
from ui.frame.page import HOME, Page
from ui.inputs import Values, inputs_of
from ui.lecture.steps import OWN, Step, own_steps, read
from ui.lecture.views import VIEWS
from ui.session import session
from ui.widgets import show_inputs
from ui.words import on_demand

_STEP, _KEY = "lecture_step", "rotorcalc_lecture"
_NAMES = frozenset(VIEWS)


def _style(name: str) -> str:
    return f"<style>{Path(__file__).with_name(name).read_text(encoding='utf-8')}</style>"


_STYLE, _PRESENTED = _style("stage.css"), _style("presented.css")


@dataclass
class Lecture:
    """A visitor's lecture: its steps, whether its answer is shown, and of which step that is."""

    steps: tuple[Step, ...]
    is_own: bool = True
    # The step whose machine was taken over, and whether its answer is shown; 0 for none.
    taken: int = 0
    answered: bool = False
    refused: str = ""


def lecture() -> Lecture:
    """Return the visitor's lecture."""
    return st.session_state.setdefault(_KEY, Lecture(own_steps(_NAMES)))


def arrive() -> None:
    """Take over the step's machine where it is not there yet; the visitor's own is kept.

    A link of a step may have moved the machine: then it is shown as the link has it.
    """
    visitor, mine = session(), lecture()
    first = choice(_STEP, 1, lambda at: 1 <= at <= len(mine.steps))
    if first is not None:
        st.session_state[_STEP] = first
    moved = "step" in st.query_params and bool(visitor.changed())
    if visitor.frame == 1 and (moved or visitor.borrowed):  # by its link, or by a server before
        visitor.lend(dict(visitor.values), visitor.preset)
        mine.taken, mine.answered = _at(), _is_shown(visitor.values)
    elif visitor.arriving or mine.taken != _at():  # exercises have lent another machine
        _take()


def sidebar() -> None:
    """Draw the sidebar: the steps, a file of others, and the way back."""
    mine = lecture()
    st.selectbox(
        "Step", range(1, len(mine.steps) + 1), key=_STEP, on_change=_take,
        format_func=lambda at: f"{at} · {mine.steps[at - 1].title}",
    )  # fmt: skip
    with st.popover("Steps from a file", width="stretch"):
        _show_file()
    if st.button("Use this machine", width="stretch", help="It replaces your own; undo works."):
        session().adopt()
        st.switch_page(HOME)
    if st.button("Back to your machine", width="stretch", type="primary"):
        st.switch_page(HOME)


def heading() -> None:
    """Draw the step's number, title and sentence, and the buttons to the next."""
    mine, step = lecture(), _step()
    st.html(_STYLE + (_PRESENTED if session().present else ""))
    with st.container(key="lecture_heading", horizontal=True, vertical_alignment="center"):
        st.button(
            "Back", key="lecture_back", shortcut="PageUp", on_click=_go, args=(-1,),
            disabled=_at() == 1,
        )  # fmt: skip
        st.button(
            "Next", key="lecture_next", shortcut="PageDown", on_click=_go, args=(1,),
            disabled=_at() == len(mine.steps),
        )  # fmt: skip
        st.header(f"{_at()} · {step.title}", anchor=False)
        if st.button("Link for students", shortcut="l"):
            _show_link()
    with st.container(key="lecture_say"):  # a presentation leaves out a page's sentence
        st.markdown(step.say)


def content(page: Page) -> None:
    """Draw the step: its question, what moves, its numbers, its view, and the answer beside it."""
    step, mine = _step(), lecture()
    with st.container(key="lecture_question", horizontal=True, vertical_alignment="center"):
        st.markdown(f"**{step.question}**")
        if mine.answered:
            st.button(
                "Again", key="lecture_again", shortcut="a", on_click=_take,
                help="Its machine as it was at first, and the answer hidden.",
            )  # fmt: skip
        else:
            st.button("Show", key="lecture_show", type="primary", shortcut="s", on_click=_show)
    answered = mine.answered
    with st.container(key="lecture_stage"):
        shown, beside = st.container(key="lecture_view"), st.container(key="lecture_side")
    with beside:
        items = inputs_of(session().values)
        moved = [items[key] for key in step.move if key in items]
        show_inputs(f"lecture {_at()}", moved, step.windows)
        if step.results and (answered or not step.before):
            page.results(*step.results)
        if answered:
            _answer(step)
    with shown:
        view = step.view if answered else step.before or step.view
        VIEWS[view](replace(page, fixed_for=_extremes(step)))


def _answer(step: Step) -> None:
    st.success(step.answer)
    for line in step.equation.strip().splitlines():
        st.latex(line)
    if step.source:
        st.caption(f"{step.source[:1].upper()}{step.source[1:]}.")
    if step.derivation:
        with st.expander("Derivation"):
            st.markdown(step.derivation)


def _extremes(step: Step) -> tuple[Computed, ...]:
    """Return the machines among which the step moves, as far as their films have an answer."""
    found: list[Computed] = []
    for values in step.extremes:
        with suppress(ValueError):
            found.append(answered_from(values))
    return tuple(found)


def _at() -> int:
    return min(int(st.session_state.get(_STEP, 1)), len(lecture().steps))


def _step() -> Step:
    return lecture().steps[_at() - 1]


def _go(by: int) -> None:
    st.session_state[_STEP] = min(max(_at() + by, 1), len(lecture().steps))
    _take()


def _is_shown(values: Values) -> bool:
    """Tell whether a machine is as the step's answer leaves it, as after a reload."""
    changed = _step().changed
    return bool(changed) and changed.items() <= values.items()


def _take() -> None:
    """Take over the machine of the step."""
    mine, step = lecture(), _step()
    mine.taken, mine.answered = _at(), False
    session().lend(step.values, step.preset)


def _show() -> None:
    """Show the answer, and move what it moves."""
    visitor = session()
    lecture().answered = True
    for key, value in _step().changed.items():
        visitor.set_value(key, value)
    if _step().view == "limit cycles":  # a presenter's clicker presses no second button
        on_demand.request_cycles(computed_from(visitor.values))


@st.dialog("Link for students")
def _show_link() -> None:
    if not lecture().is_own:
        st.markdown("A link cannot hold steps from a file: give your students the file.")
        return
    address = f"{(st.context.url or '').partition('?')[0]}?step={_at()}"
    drawn = io.BytesIO()
    segno.make(address, error="m").save(
        drawn, kind="svg", scale=8, border=4, dark="#000000", light="#FFFFFF"
    )
    st.markdown(f"**{address}**")
    st.image(drawn.getvalue().decode(), width="stretch")


def _show_file() -> None:
    mine = lecture()
    st.markdown(
        "Write your own steps in a file of the same form, and load it here. It stays in this "
        "session."
    )
    st.download_button(
        "These steps", OWN.read_bytes(), "steps.toml", "text/plain", on_click="ignore",
        width="stretch",
    )  # fmt: skip
    st.file_uploader("Your steps", type="toml", key="lecture_file", on_change=_load)
    if mine.refused:
        st.error(mine.refused, title="The steps stay as they were")
    if not mine.is_own:
        st.button("Back to the notes' steps", on_click=_reset, width="stretch")


def _load() -> None:
    given, mine = st.session_state.get("lecture_file"), lecture()
    if given is None:
        return
    try:
        steps = read(given.getvalue(), VIEWS)
    except ValueError as error:
        mine.refused = f"{given.name}: {error}."
        return
    _begin(Lecture(steps, is_own=False))


def _reset() -> None:
    _begin(Lecture(own_steps(_NAMES)))


def _begin(new: Lecture) -> None:
    st.session_state[_KEY], st.session_state[_STEP] = new, 1
    _take()
