"""The lecture: what its answers claim, its steps on the page, and the way back."""

import math
import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from streamlit.testing.v1 import AppTest

import rotorcalc as rc
from tests.app.session import (
    EXERCISES_PAGE,
    HOME,
    LECTURE,
    charts,
    faults,
    move,
    session_of,
    texts,
    visit,
)
from ui.computed import Computed, computed_from
from ui.lecture.steps import MOST_BYTES, OWN, Step, own_steps, read
from ui.lecture.views import VIEWS

STEPS = own_steps(frozenset(VIEWS))
BY_TITLE = {step.title: step for step in STEPS}


def before_and_after(title: str) -> tuple[Computed, Computed]:
    step = BY_TITLE[title]
    return computed_from(step.values), computed_from(step.values | step.changed)


def falls_a_little() -> None:
    before, after = before_and_after("Why a film carries a load")
    assert after.speed == pytest.approx(2.0 * before.speed)
    assert 0.85 < after.point.peak_pressure / before.point.peak_pressure < 1.0


def leaves_to_the_side_and_ends_near_the_centre() -> None:
    before, after = before_and_after("Where the journal sits")
    assert before.point.eccentricity_ratio > 0.3
    assert after.point.eccentricity_ratio < 0.1
    assert 0.0 < before.point.attitude_angle < after.point.attitude_angle < math.pi / 2


def at_right_angles() -> None:
    _, after = before_and_after("Why it moves sideways")
    assert after.forces.tangential > 10.0 * abs(after.forces.radial)


def the_cross_coupled_ones_grow() -> None:
    _, after = before_and_after("Stiffness")
    K = rc.analyse(after.machine, after.speed * np.array([1.0, 4.0])).stiffness
    assert K[1, 0, 1] > 3.5 * K[0, 0, 1] > 0.0 > 3.5 * K[0, 1, 0] > K[1, 1, 0]
    np.testing.assert_allclose(np.diag(K[1]), np.diag(K[0]), rtol=0.05)


def feed_the_whirl_and_meet_the_damping_at_the_onset() -> None:
    _, after = before_and_after("The follower force")
    K, C = after.point.stiffness, after.point.damping
    assert K[0, 1] - K[1, 0] > 0.0
    at_onset = rc.analyse(after.machine, after.onset.speed)
    fed = at_onset.stiffness[0, 1] - at_onset.stiffness[1, 0]
    damped = after.onset.whirl_frequency * np.trace(at_onset.damping)
    assert fed == pytest.approx(damped, rel=0.01)
    assert K[0, 1] - K[1, 0] < 0.7 * fed
    np.testing.assert_allclose(np.trace(at_onset.damping), np.trace(C), rtol=0.02)


def earlier_with_more_clearance() -> None:
    before, after = before_and_after("The threshold speed")
    assert after.machine.bearing.radial_clearance > before.machine.bearing.radial_clearance
    assert after.onset.speed < before.onset.speed


def close_to_a_half_and_closer_at_higher_speed() -> None:
    _, after = before_and_after("The frequency of the whirl")
    speeds = after.speed * np.array([0.3, 1.0, 3.0])
    away = np.abs(rc.analyse(after.machine, speeds).whirl_ratio - 0.5)
    assert after.onset.whirl_frequency / after.onset.speed == pytest.approx(0.5, abs=0.01)
    assert away[0] > away[1] > away[2]


def a_half_with_a_tenth_of_the_stiffness() -> None:
    before, after = before_and_after("Flexible shafts")
    ratio = before.machine.rotor.shaft_stiffness / after.machine.rotor.shaft_stiffness
    assert ratio == pytest.approx(10.0)
    assert after.onset.speed / before.onset.speed == pytest.approx(0.5, abs=0.05)
    assert after.onset.whirl_frequency / after.onset.speed == pytest.approx(0.5, abs=0.01)


def crosses_at_half_speed() -> None:
    before, after = before_and_after("The root locus")
    assert before.is_stable
    assert not after.is_stable
    crossed = before.onset
    assert crossed.whirl_frequency / crossed.speed == pytest.approx(0.5, abs=0.01)


def twice_as_high_at_the_same_speed() -> None:
    before, after = before_and_after("What imbalance does")
    speeds = before.sweep.speed
    one, two = (rc.response_peaks(c.machine, speeds) for c in (before, after))
    np.testing.assert_allclose(two.speed, one.speed, rtol=1e-6)
    assert abs(after.point.disk_response).max() == pytest.approx(
        2.0 * abs(before.point.disk_response).max()
    )
    assert after.onset.speed == before.onset.speed


def lasts_below_the_onset() -> None:
    _, after = before_and_after("What happens beyond the onset")
    balanced = rc.varied(after.machine, {"imbalance": 0.0})
    branch = rc.bifurcation(balanced)
    assert branch.hopf.subcritical
    assert branch.folds.min() < after.onset.speed


def more_when_cooler() -> None:
    before, after = before_and_after("Heat")
    assert after.point.temperature < before.point.temperature
    assert after.point.power_loss > before.point.power_loss


def pads_whirl_last() -> None:
    _, after = before_and_after("What other bearings do")
    pads = rc.compare_bearings(after.machine, (rc.TiltingPads(),), speed=after.speed)[0]
    assert pads.onset > 10.0 * after.onset.speed
    bearing = replace(after.machine.bearing, geometry=rc.TiltingPads())
    K = rc.analyse(replace(after.machine, bearing=bearing), after.speed).stiffness
    assert abs(K[0, 1]) + abs(K[1, 0]) < 1e-6 * abs(K[0, 0])


CLAIMS: dict[str, Callable[[], None]] = dict(
    zip(
        BY_TITLE,
        (
            falls_a_little,
            leaves_to_the_side_and_ends_near_the_centre,
            at_right_angles,
            the_cross_coupled_ones_grow,
            feed_the_whirl_and_meet_the_damping_at_the_onset,
            earlier_with_more_clearance,
            close_to_a_half_and_closer_at_higher_speed,
            a_half_with_a_tenth_of_the_stiffness,
            crosses_at_half_speed,
            twice_as_high_at_the_same_speed,
            lasts_below_the_onset,
            more_when_cooler,
            pads_whirl_last,
        ),
        strict=True,
    )
)


@pytest.mark.parametrize("title", BY_TITLE)
def test_what_a_step_answers_is_so(title: str) -> None:
    CLAIMS[title]()


def axes(at: AppTest) -> list[object]:
    """Return the range and ticks of each axis of the chart that is shown."""
    (chart,) = charts(at).values()
    found = (axis for name, axis in chart["layout"].items() if name[1:5] == "axis")
    return [(axis["range"], axis.get("tickvals")) for axis in found]


def test_each_step_shows_its_view_and_its_answer_on_the_same_axes() -> None:
    at = visit(LECTURE)
    for number, step in enumerate(STEPS, start=1):
        assert faults(at) == []
        assert at.header[0].value == f"{number} · {step.title}"
        before = axes(at)
        assert before
        assert bool(at.metric) is (bool(step.results) and not step.before)
        at.button(key="lecture_show").click().run()
        assert step.answer in [box.value for box in at.success]
        assert len(at.metric) == len(step.results)
        if not step.before:
            assert axes(at) == before, step.title
        assert {key: session_of(at).values[key] for key in step.then} == step.changed
        assert at.button(key="lecture_next").disabled is (number == len(STEPS))
        if number < len(STEPS):
            at.button(key="lecture_next").click().run()


@pytest.mark.parametrize("step", STEPS, ids=lambda step: step.title)
def test_a_step_moves_one_input_over_a_range_in_which_its_values_lie(step: Step) -> None:
    (key,) = step.move
    low, high = step.windows[key]
    assert low < step.values[key] < high
    assert low < step.changed.get(key, step.values[key]) < high
    assert set(step.then) <= {key}
    # The charts run to the top speed, and a running speed above it would stretch them.
    assert key != "rpm" or step.view == "bearings" or high <= step.values["rpm_max"]


def test_without_a_range_an_input_moves_about_its_values() -> None:
    more = "machine = {rpm = 2000, T = 60}\nthen = {rpm = 5000}\nmove = ['rpm', 'T', 'u', 'k']"
    (step,) = read(f"[[step]]\n{GOOD}{more}".encode(), VIEWS)
    assert step.windows["rpm"] == (1000.0, 10000.0)
    low, high = step.windows["T"]
    assert (low, high) == (30.0, 90.0)
    assert 0.0 < step.windows["u"][0] < step.windows["u"][1]
    assert step.windows["k"] == (5e7, 2e8)


def test_a_visitors_machine_is_there_again_after_the_lecture() -> None:
    at = visit(HOME)
    move(at, "C", 75.0)
    at.switch_page(LECTURE).run()
    assert session_of(at).values["C"] == 60.0
    move(at, "rpm", 2000.0)
    at.switch_page(HOME).run()
    assert session_of(at).values["C"] == 75.0
    assert at.query_params["C"] == "75"
    session_of(at).undo()
    assert session_of(at).values["C"] == 60.0


def test_a_step_has_its_own_machine_after_an_exercise() -> None:
    at = visit(EXERCISES_PAGE)
    for _ in range(2):
        at.switch_page(LECTURE).run()
        assert session_of(at).values == STEPS[0].values
        at.switch_page(EXERCISES_PAGE).run()
        assert session_of(at).values != STEPS[0].values


def test_a_steps_machine_can_be_taken_along_and_undone() -> None:
    at = visit(HOME)
    move(at, "C", 75.0)
    at.switch_page(LECTURE).run()
    next(one for one in at.button if one.label == "Use this machine").click().run()
    at.switch_page(HOME).run()
    assert session_of(at).values == STEPS[0].values
    session_of(at).undo()
    assert session_of(at).values["C"] == 75.0


def test_a_link_opens_a_step_as_it_is_or_as_it_was_moved() -> None:
    at = visit(LECTURE, step="8")
    assert at.header[0].value == "8 · Flexible shafts"
    assert session_of(at).values == BY_TITLE["Flexible shafts"].values
    moved = visit(LECTURE, step="8", k="20000000", rpm="3000")
    assert session_of(moved).values["k"] == 2e7
    assert "8" in moved.query_params["step"]
    unknown = visit(LECTURE, step="99")
    assert "step = `'99'` is not among this page's choices." in [
        one.value for one in unknown.warning
    ]
    assert unknown.header[0].value.startswith("1 ")


GOOD = 'title = "A"\nsay = "B"\nview = "locus"\nquestion = "C"\nanswer = "D"\n'


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"\xff", "not TOML in UTF-8"),
        (b"[[step]", "not TOML in UTF-8"),
        (b"a = 1", "1 to 60 tables"),
        (b"step = []", "1 to 60 tables"),
        (b"step = [1]", "step 1: must be a table"),
        (b"[[step]]\na = x\nb = 1", "at line 2"),
        (b"[[step]]\n" * 61, "1 to 60 tables"),
        (b"#" * (MOST_BYTES + 1), "at most 200000 are read"),
        (f"[[step]]\n{GOOD}titel = 'x'", "step 1 (line 1): `'titel'` is none of title, say"),
        (f"[[step]]\n{GOOD}[[step]]\ntitle = 'x'", "step 2 (line 7): say: missing"),
        (f"[[step]]\n{GOOD}move = 'x'", "step 1 (line 1): move: must be a list"),
        (f"[[step]]\n{GOOD}before = 'x'", "step 1 (line 1): before = `'x'`: must be one of"),
        (f"[[step]]\n{GOOD}between = {{C = [1, 2]}}", "between = `'C'`: must be one of rpm"),
        (f"[[step]]\n{GOOD}between = {{rpm = 5}}", "between: rpm must have two values"),
        (f"[[step]]\n{GOOD}between = {{rpm = [900, 500]}}", "between: rpm must rise"),
        (
            f"[[step]]\n{GOOD}between = {{rpm = [900, 'x']}}",
            "between: Running speed (rpm = `'x'`) is not a number",
        ),
        (
            f"[[step]]\n{GOOD.replace('locus', 'x')}",
            "(line 1): view = `'x'`: must be one of bearing",
        ),
        (f"[[step]]\n{GOOD}move = ['x']", "step 1 (line 1): move = `'x'`: must be one of rpm"),
        (f"[[step]]\n{GOOD}results = ['x']", "step 1 (line 1): results = `'x'`: must be one of"),
        (
            f"[[step]]\n{GOOD}machine = {{rpm = -1}}",
            "step 1 (line 1): machine: Running speed (rpm = `'-1'`)",
        ),
        (
            f"[[step]]\n{GOOD}machine = {{preset = 'x'}}",
            "(line 1): preset = `'x'`: must be one of",
        ),
        (f"[[step]]\n{GOOD}then = {{D = 'x'}}", "step 1 (line 1): then: Diameter (D = `'x'`)"),
        (f"[[step]]\n{GOOD}then = {{y = 1}}", "step 1 (line 1): then = `'y'`: must be one of"),
    ],
)
def test_a_file_of_steps_is_refused_by_step_and_field(content: str | bytes, words: str) -> None:
    with pytest.raises(ValueError, match=re.escape(words)):
        read(content.encode() if isinstance(content, str) else content, VIEWS)


def test_a_lecturers_own_steps_replace_the_notes_and_go_again() -> None:
    at = visit(LECTURE, step="4")
    at.file_uploader[0].set_value(("bad.toml", b"[[step]]", "text/plain")).run()
    assert "bad.toml: step 1 (line 1): title: missing." in [box.value for box in at.error]
    assert at.header[0].value.startswith("4 ")
    at.file_uploader[0].set_value(("own.toml", f"[[step]]\n{GOOD}".encode(), "text/plain")).run()
    assert at.header[0].value == "1 · A"
    next(one for one in at.button if one.label == "Link for students").click().run()
    assert any("give your students the file" in text for text in texts(at))
    next(one for one in at.button if one.label.startswith("Back to the notes")).click().run()
    assert at.header[0].value == f"1 · {STEPS[0].title}"


def test_the_file_that_is_offered_is_the_one_that_is_read() -> None:
    assert read(OWN.read_bytes(), VIEWS) == STEPS
    assert all(isinstance(step, Step) for step in STEPS)


def test_a_page_loaded_again_after_the_answer_still_shows_it() -> None:
    first = visit(LECTURE, step="8")
    first.button(key="lecture_show").click().run()
    again = visit(LECTURE, **dict(first.query_params))
    assert [box.value for box in again.success] == [box.value for box in first.success] != []
    assert not visit(LECTURE, step="8").success
