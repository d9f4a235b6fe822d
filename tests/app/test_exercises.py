"""The exercises: solved again from their printed numbers alone, by the notes' formulas."""

import cmath
import math
import re
from collections.abc import Callable

import pytest

from tests.app.session import EXERCISES_PAGE, HOME, faults, move, session_of, visit
from ui.exercises.collection import EXERCISES, TOLERANCE, Exercise, is_right, of_student
from ui.exercises.stage import sheet

SEEDS = (1, 2, 2_026, 999_999)
NUMBER = re.compile(r"(?<![A-Z])-?\d+(?:\.\d+)?(?:·10[⁰¹²³⁴⁵⁶⁷⁸⁹]+)?")
POWERS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")


def numbers(text: str) -> list[float]:
    """Return the numbers of a text, as a student reads them."""
    return [
        float(found.replace("·10", "e").translate(POWERS)) for found in NUMBER.findall(text)
    ]  # fmt: skip


def ellipse(x: float, lag_x: float, y: float, lag_y: float, _n: float) -> tuple[float, ...]:
    # Another way than two circles: the extremes of |(X, Y)| over a turn.
    P, Q = cmath.rect(x, -math.radians(lag_x)), cmath.rect(y, -math.radians(lag_y))
    turn = [cmath.exp(2j * math.pi * k / 4000) for k in range(4000)]
    radii = [math.hypot((P * e).real, (Q * e).real) for e in turn]
    return max(radii), min(radii)


def sommerfeld(eps: float) -> float:
    return (1 - eps**2) ** 2 / (eps * math.sqrt(16 * eps**2 + math.pi**2 * (1 - eps**2)))


def number_of(D: float, L: float, C: float, mu: float, n: float) -> float:
    """Return σ times the load [N]."""
    return mu * 1e-3 * n * math.pi / 30 * L * 1e-3 * D * 5e-4 / 4 * (L * 1e3 / C) ** 2


def position(*given: float) -> tuple[float, ...]:
    *bore, load = given
    sigma = number_of(*bore) / load
    low, high = 1e-6, 1.0 - 1e-9
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if sommerfeld(middle) > sigma else (low, middle)
    return sigma, low


def attitude(C: float, eps: float) -> tuple[float, ...]:
    phi = math.atan2(math.pi * math.sqrt(1 - eps**2), 4 * eps)
    return math.degrees(phi), C * (1 - eps)


def warm(mu: float, TR: float, alpha: float, _one: float, T: float) -> tuple[float, ...]:
    return (mu * math.exp(-alpha * (T - TR)),)


def carried(*given: float) -> tuple[float, ...]:
    *bore, eps = given
    return (number_of(*bore) / sommerfeld(eps),)


def stiffness(C: float, load: float, eps: float) -> tuple[float, ...]:
    phi = math.radians(attitude(C, eps)[0])
    bracket = (math.cos(phi) ** 2 + 1 + 2 * eps**2) / (eps * (1 - eps**2)) * load / C
    return bracket * math.cos(phi), bracket * math.sin(phi)


def critical_mass(n: float, keq: float, ratio: float) -> tuple[float, ...]:
    return (keq * 1e6 / (ratio * n * math.pi / 30) ** 2,)


def flexible(half: float, keq: float, ratio: float, k: float) -> tuple[float, ...]:
    series = 1 / (1 / (keq * 1e6) + 1 / k)
    return (math.sqrt(series / half) / ratio * 30 / math.pi,)


def line(_C: float, n: float, ratio: float) -> tuple[float, ...]:
    return (ratio * n / 60,)


def decay(_n: float, real: float, imag: float, _one: float) -> tuple[float, ...]:
    return real / math.hypot(real, imag), 2 * math.pi * real / imag


def grade(n: float, _g: float, *_standard: float) -> tuple[float, ...]:
    return (2500 / (n * math.pi / 30),)


SOLVED: dict[str, Callable[..., tuple[float, ...]]] = dict(
    zip(
        (one.title for one in EXERCISES),
        (
            ellipse, ellipse, position, attitude, warm, carried, stiffness, critical_mass, flexible,
            line, decay, grade,
        ),
        strict=True,
    )
)  # fmt: skip


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda one: one.title)
def test_a_student_finds_the_answers_from_the_printed_numbers(
    exercise: Exercise, seed: int
) -> None:
    text, answers = of_student(exercise, seed)
    found = SOLVED[exercise.title](*numbers(text))
    assert len(found) == len(exercise.asks)
    # Well within what is called right.
    assert found == pytest.approx(answers, rel=TOLERANCE / 3)


def test_each_student_has_other_numbers_and_the_same_ones_again() -> None:
    for exercise in EXERCISES:
        texts = [of_student(exercise, seed)[0] for seed in range(1, 9)]
        assert len(set(texts)) > 2, exercise.title
        assert "the sheet" not in texts[0]  # a student has no other than this one
        assert of_student(exercise, 3)[0] == texts[2]


def test_an_answer_is_right_within_the_tolerance_stated() -> None:
    assert is_right(98.01, 100.0)
    assert is_right(-101.9, -100.0)
    assert not is_right(97.9, 100.0)
    assert not is_right(0.0, 100.0)


def test_answers_are_judged_and_the_solution_follows() -> None:
    at = visit(EXERCISES_PAGE, exercise="4", seed="7")
    _, (phi, h) = of_student(EXERCISES[3], 7)
    assert faults(at) == []
    first, second = at.text_input
    first.set_value(f"{1.01 * phi:.4g}").run()
    assert any("is right" in box.value for box in at.success)
    second.set_value(f"{2.0 * h:.4g}").run()
    assert any("is not right" in box.value for box in at.error)
    assert not any("Solution" in text.value for text in at.markdown)
    second.set_value("39 or so").run()
    assert any("is not a number" in box.value for box in at.warning)
    # 39,352 may mean 39352 too: one of the readings is right.
    second.set_value(f"{h:.3f}".replace(".", ",")).run()
    assert any("Solution" in text.value for text in at.markdown)
    assert "4" in at.query_params["exercise"]


def test_every_exercise_is_shown_and_the_visitors_machine_waits() -> None:
    at = visit(HOME)
    move(at, "C", 75.0)
    at.switch_page(EXERCISES_PAGE).run()
    for number, exercise in enumerate(EXERCISES, start=1):
        at.selectbox(key="exercises_exercise").set_value(number).run()
        assert faults(at) == []
        assert at.header[0].value == f"Exercise {number} · {exercise.title}"
        assert len(at.text_input) == len(exercise.asks)
    at.switch_page(HOME).run()
    assert session_of(at).values["C"] == 75.0


def test_the_sheet_has_every_exercise_and_answers_only_where_asked() -> None:
    plain, solved = (sheet(7, solved=solved) for solved in (False, True))
    for exercise in EXERCISES:
        assert exercise.title in plain
    assert "<b>" not in plain
    assert solved.count("<b>") == sum(len(one.asks) for one in EXERCISES)
    assert "$" not in solved
