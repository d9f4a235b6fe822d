"""What can be held mechanically of the words on screen; `tests.words` prints them to be read."""

import re
from collections.abc import Iterator

import numpy as np
import pytest

from rotorcalc.figures import root_locus
from rotorcalc.units import SI
from tests.app.session import NOTES, PAGES
from tests.words import STATES, once, staged, toured
from ui.bearing import kinds
from ui.cases import computed
from ui.computed import computed_from
from ui.exercises.collection import EXERCISES, Exercise, of_student
from ui.lecture.steps import Step, own_steps
from ui.lecture.views import VIEWS
from ui.sharing import address

# Mathematics, code, hover texts' fields and addresses are no words.
_NO_WORDS = re.compile(r"\$\$.*?\$\$|\$[^$]*\$|`[^`]*`|%\{[^}]*\}|https?://\S*", re.DOTALL)
_LATEX = re.compile(r"\\[a-z]+")
_RULES = {
    "an exponent as computers write it": re.compile(r"\d\.?\d*e[+-]\d", re.IGNORECASE),
    "an index that is not typeset": re.compile(r"(?<![A-Za-z0-9_/])[A-Za-zΑ-Ωα-ω]_[A-Za-z]"),
    "a number that is none": re.compile(r"(?<![\w\\])(nan|NaN|None|-?inf|Infinity)(?![\w:])"),
    "two spaces": re.compile(r"\S  +\S"),
    "a hyphen for a minus": re.compile(r"(?<![\w.,)\]⁰-⁹^])-\d"),
    "an expression of before": re.compile(
        "holds that down|let go|creeping down|taken off|slider's speed|no quantity of this program"
        "|means nothing|goes unstable|went unstable|makes no machine|half of any",
        re.IGNORECASE,
    ),
}
# Decimal numbers with more than four digits that count.
_DECIMAL = re.compile(r"(?<![\d.~])\d+\.\d+(?![\d.])")
# Where more digits are the point: results compared to their last digit, and the source's own.
_EXACT = ("Notes", "Orbits > Onset three ways")

STATES_TESTED = [
    "",
    "unstable",
    "far below its onset",
    "zero load",
    "damped, journal mass",
    "cases",
]


def _words(text: str) -> str:
    return "" if _LATEX.search(_NO_WORDS.sub("", text)) else _NO_WORDS.sub("x", text)


def _faults(where: str, text: str) -> Iterator[str]:
    words = _words(text)
    yield from (f"{where}: {fault}: {text}" for fault, rule in _RULES.items() if rule.search(words))
    if not where.startswith(_EXACT):
        for number in _DECIMAL.findall(words):
            if len(number.replace(".", "").lstrip("0")) > 4:
                yield f"{where}: {number} has too many digits: {text}"


@pytest.mark.parametrize(
    ("page", "state"),
    [
        # The notes are the same for every machine.
        *((page, state) for page in PAGES for state in STATES_TESTED if page != NOTES or not state),
        ("pages/2_Coefficients.py", "outside the model"),
    ],
)
def test_what_a_visitor_reads_keeps_to_the_rules(page: str, state: str) -> None:
    found = once(toured(page, STATES[state])).values()
    assert len(found) > 30
    assert [fault for where, text in found for fault in _faults(where, text)] == []


@pytest.mark.parametrize("step", own_steps(frozenset(VIEWS)), ids=lambda step: step.title)
def test_what_a_step_of_the_lecture_says_keeps_to_the_rules(step: Step) -> None:
    said = (step.title, step.say, step.question, step.answer, step.derivation)
    assert [fault for text in said for fault in _faults(step.title, text)] == []


@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda exercise: exercise.title)
def test_what_an_exercise_says_keeps_to_the_rules(exercise: Exercise) -> None:
    text, _ = of_student(exercise, 1)
    said = (text, exercise.hint, exercise.solution, *(ask.words for ask in exercise.asks))
    assert [fault for words in said for fault in _faults(exercise.title, words)] == []


def test_the_list_has_every_kind_of_bearing_the_lecture_and_the_exercises() -> None:
    own = {kind for kind, bore in kinds().items() if bore.__module__.startswith("rotorcalc.")}
    assert own <= {query.get("bearing", "plain") for query in STATES.values()}
    assert next(where for where, _ in staged() if "answered" in where) == (
        "Lecture, step 1, answered"
    )


def test_the_list_has_the_cases_of_its_link() -> None:
    cases, problems = computed(address.read(STATES["cases"]).cases)
    assert [shown.case.name for shown in cases] == ["Wide", "Hot"]
    assert problems == []


def test_a_mirror_image_of_a_mode_is_not_mentioned_outside_the_view() -> None:
    values = address.read(STATES["small"]).values
    shown = computed_from(values)
    (mirrored,) = np.flatnonzero(shown.locus(True).here.eigenvalues.imag < 0.0)
    assert f"mode {mirrored + 1} " not in root_locus.beyond(shown.locus(True), SI)


@pytest.mark.parametrize(
    "text",
    [
        "pressure 2e+04 Pa", "stiffness K_XX rises", "margin nan %", "two  spaces", "-3 rpm",
        "8919.25 rpm", "this holds that down",
    ],
)  # fmt: skip
def test_each_rule_can_be_broken(text: str) -> None:
    assert list(_faults("Stability", text))
    assert not list(_faults("Stability", "Stable at 8919 rpm, 48.66 % above, −3 and 2·10⁻⁴."))
