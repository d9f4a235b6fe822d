"""The page of exercises: a student's numbers, the answers typed, what is right, and a sheet."""

import html
import math
from pathlib import Path
from string import Template

import streamlit as st
from latex2mathml.converter import convert

from ui.choices import choice, choices
from ui.exercises.collection import (
    EXERCISES,
    TOLERANCE,
    Ask,
    Exercise,
    is_right,
    of_student,
)
from ui.format import digits, numbers_meant
from ui.frame.page import HOME, PAGES, Page
from ui.serving.downloads import offer
from ui.session import session

_NUMBER, _SEED = "exercises_exercise", "exercises_seed"
MOST = 9_999_999_999
_SHEET = Template(Path(__file__).with_name("sheet.html").read_text(encoding="utf-8"))


def arrive() -> None:
    """Take over the machine of the exercise; the visitor's own is kept."""
    for key, most in ((_NUMBER, len(EXERCISES)), (_SEED, MOST)):
        if (first := choice(key, 1, lambda value, most=most: 1 <= value <= most)) is not None:
            st.session_state[key] = first
    exercise = _exercise()
    session().lend(exercise.values(_seed()), exercise.preset)


def sidebar() -> None:
    """Draw the choice of an exercise, the student's number, and the sheet."""
    st.selectbox(
        "Exercise", range(1, len(EXERCISES) + 1), key=_NUMBER,
        format_func=lambda at: f"{at} · {EXERCISES[at - 1].title}",
    )  # fmt: skip
    st.number_input(
        "Student's number",
        1,
        MOST,
        key=_SEED,
        step=1,
        help="Each number, such as a matriculation number, has its own values. It is in the link.",
    )
    seed = _seed()  # the file is made outside the session, when it is asked for
    for label, solved in (("Sheet for print", False), ("Sheet with solutions", True)):
        offer(
            label, lambda seed=seed, solved=solved: sheet(seed, solved=solved),
            f"exercises-{seed}{'-solutions' if solved else ''}.html", "text/html",
            width="stretch",
        )  # fmt: skip
    if st.button("Back to your machine", width="stretch", type="primary"):
        st.switch_page(HOME)


def heading() -> None:
    """Draw the exercise's number and title."""
    st.header(f"Exercise {_at()} · {_exercise().title}", anchor=False)


def content(page: Page) -> None:
    """Draw the exercise: its text, fields for the answers, what is right, hint and solution."""
    exercise, name = _exercise(), f"{_at()}_{_seed()}"
    st.markdown(exercise.told(page.computed, exercise.values(_seed())))
    given = [
        st.text_input(f"{ask.words}{_in(ask)}", key=f"answer_{name}_{i}", width=280)
        for i, ask in enumerate(exercise.asks)
    ]
    st.caption(
        f"The numbers of student {_seed()}. An answer is right within {100 * TOLERANCE:g}\u00a0%."
    )
    right = [_judge(ask, word, page) for ask, word in zip(exercise.asks, given, strict=True)]
    with st.expander("Hint"):
        st.markdown(exercise.hint)
        if st.button(f"Open this machine on the page {PAGES[exercise.page]}"):
            session().adopt()
            choices().restore(exercise.chosen)
            st.switch_page(exercise.page)
    if all(right) or st.toggle("Show the solution", key=f"exercises_solved_{name}"):
        st.markdown(f"**Solution.** {exercise.solution}")
        st.markdown(_solved(exercise, page))


def sheet(seed: int, *, solved: bool) -> str:
    """Return all exercises with a student's numbers as a page for print, HTML."""
    rows = [_row(number, one, seed, solved) for number, one in enumerate(EXERCISES, start=1)]
    return _SHEET.substitute(
        seed=seed, tolerance=f"{100 * TOLERANCE:g}", rows="\n".join(rows),
        what=" with solutions" if solved else "",
    )  # fmt: skip


def _row(number: int, exercise: Exercise, seed: int, solved: bool) -> str:
    text, answers = of_student(exercise, seed)
    lines = (
        f"<li>{_plain(ask.words)}{_in(ask)}: "
        + (f"<b>{digits(value)}</b>" if solved else '<span class="line"></span>')
        for ask, value in zip(exercise.asks, answers, strict=True)
    )
    how = f"<p>{_plain(exercise.solution)}</p>" if solved else ""
    return (
        f"<section><h2>{number} {html.escape(exercise.title)}</h2><p>{_plain(text)}</p>"
        f"<ul>{''.join(lines)}</ul>{how}</section>"
    )


def _plain(text: str) -> str:
    """Return a text with its LaTeX as MathML, which a browser prints by itself, HTML."""
    words, *rest = text.split("$")
    parts = [html.escape(words)]
    for latex, after in zip(rest[::2], rest[1::2], strict=True):
        parts += (convert(latex), html.escape(after))
    return "".join(parts)


def _at() -> int:
    return min(max(int(st.session_state.get(_NUMBER, 1)), 1), len(EXERCISES))


def _seed() -> int:
    return int(st.session_state.get(_SEED, 1))


def _exercise() -> Exercise:
    return EXERCISES[_at() - 1]


def _in(ask: Ask) -> str:
    return "" if ask.unit == "-" else f" [{ask.unit}]"


def _judge(ask: Ask, word: str, page: Page) -> bool:
    """Say whether an answer is right; return it."""
    if not word.strip():
        return False
    try:
        # Each reading counts: a decimal comma and a separator of thousands look alike.
        given = [float(number) for number in numbers_meant(word)]
    except ValueError as error:
        st.warning(f"{ask.words}: {word} {error}.")
        return False
    expected = ask.value(page.computed)
    right = any(math.isfinite(number) and is_right(number, expected) for number in given)
    say = st.success if right else st.error
    say(f"{ask.words}: {word} is {'right' if right else 'not right'}.")
    return right


def _solved(exercise: Exercise, page: Page) -> str:
    return "\n".join(
        f"- {ask.words}{_in(ask)}: **{digits(ask.value(page.computed))}**" for ask in exercise.asks
    )
