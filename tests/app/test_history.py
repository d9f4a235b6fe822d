"""Undo and redo: of every kind of change of the machine, back and forth, exactly."""

import json
from collections.abc import Callable

import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc.figures.cases import COLOURS
from tests.app.session import HOME, ORBITS, move, open_part, session_of, visit
from ui.history import History
from ui.inputs import PRESET_VALUES, machine_of
from ui.session import Work
from ui.sharing import labels


def _choose_preset(at: AppTest) -> None:
    at.selectbox(key="preset").set_value("sheet-1e7").run()


def _give_load(at: AppTest) -> None:
    at.toggle(key="load_follows").set_value(False).run()


def _use_grade(at: AppTest) -> None:
    open_part(at, "oil_library")
    at.button(key="use_grade").click().run()


def _use_fit(at: AppTest) -> None:
    open_part(at, "oil_library")
    at.button(key="use_fit").click().run()


def _load_file(at: AppTest) -> None:
    open_part(at, "share")
    text = machine_of(PRESET_VALUES["fig-5-2"]).to_json()
    at.file_uploader(key="upload").upload("machine.json", text.encode()).run()


def _press_in_cases(at: AppTest, what: str) -> None:
    open_part(at, "cases")
    at.button(key=f"case_{COLOURS[0]}_{what}").click().run()


def _rename(at: AppTest) -> None:
    open_part(at, "cases")
    at.text_input(key=f"case_{COLOURS[0]}_name").set_value("Thin oil").run()


CHANGES: dict[str, Callable[[AppTest], object]] = {
    "slider": lambda at: move(at, "C", 85.0),
    "speed": lambda at: move(at, "rpm", 7000.0),
    "preset": _choose_preset,
    "load": _give_load,
    "grade": _use_grade,
    "fit": _use_fit,
    "file": _load_file,
    "demonstration": lambda at: at.button(key="orbits_small").click().run(),
    "case kept": lambda at: at.button(key="keep").click().run(),
    "case used": lambda at: _press_in_cases(at, "use"),
    "case removed": lambda at: _press_in_cases(at, "drop"),
    "case renamed": _rename,
    "reset": lambda at: at.button(key="reset").click().run(),
}


def _work(at: AppTest) -> object:
    visitor = session_of(at)
    return visitor.preset, dict(visitor.values), visitor.cases


@pytest.mark.parametrize("kind", CHANGES)
def test_a_change_of_each_kind_is_undone_and_made_again(kind: str) -> None:
    case = {"cases": f"A~1~C~{95}"} if kind.startswith("case") else {}
    at = visit(ORBITS if kind == "demonstration" else HOME, T="65", **case)
    assert at.button(key="undo").disabled
    before = _work(at)
    CHANGES[kind](at)
    after = _work(at)
    assert after != before
    for button, expected in (("undo", before), ("redo", after), ("undo", before)):
        at.button(key=button).click().run()
        assert _work(at) == expected
        assert at.selectbox(key="preset").value == session_of(at).preset
        assert at.toggle(key="load_follows").value == (session_of(at).values["load"] is None)
    assert at.button(key="undo").disabled
    assert at.exception == []


def test_a_new_change_ends_what_could_be_redone() -> None:
    at = visit(HOME)
    move(at, "C", 85.0)
    move(at, "C", 95.0)
    at.button(key="undo").click().run()
    assert session_of(at).values["C"] == 85.0
    move(at, "T", 70.0)
    assert at.button(key="redo").disabled
    at.button(key="undo").click().run()
    assert session_of(at).values == PRESET_VALUES["sheet-1e8"] | {"C": 85.0}


def test_values_passed_while_dragging_are_one_change() -> None:
    at = visit(HOME)
    visitor = session_of(at)
    for clearance, dragging in ((61.0, True), (75.0, True), (90.0, False)):
        visitor.dragging = dragging
        visitor.set_value("C", clearance)
        at.run()
    at.button(key="undo").click().run()
    assert session_of(at).values == PRESET_VALUES["sheet-1e8"]


def test_inputs_changed_from_the_preset_are_named_and_reset() -> None:
    at = visit(HOME, preset="sheet-1e7", C="80", rpm="3000")
    (said,) = [text.value for text in at.caption if "preset" in text.value]
    assert said in ("Changed from the preset: C, Ω.", "Changed from the preset: Ω, C.")
    at.button(key="reset").click().run()
    assert session_of(at).values == PRESET_VALUES["sheet-1e7"]
    assert any(text.value == "Unchanged from the preset." for text in at.caption)
    assert at.button(key="reset").disabled


def test_undo_survives_a_change_of_page() -> None:
    at = visit(HOME)
    move(at, "C", 85.0)
    at.switch_page(ORBITS).run()
    at.button(key="undo").click().run()
    assert session_of(at).values == PRESET_VALUES["sheet-1e8"]


def test_history_goes_no_further_than_its_ends_and_forgets_the_oldest() -> None:
    history = History(0)
    for state in [*range(1, 500), 499]:
        history.record(state)
    assert not history.can_redo
    assert (history.redo(), history.undo()) == (499, 498)
    gone = [history.undo() for _ in range(500)]
    assert gone[-1] == gone[-2] > 0
    assert not history.can_undo
    assert history.redo() == gone[-1] + 1


def test_undo_and_redo_are_restored_from_what_a_browser_kept() -> None:
    at = visit(HOME, preset="sheet-1e7", k="inf")
    states = [_work(at)]
    for change in ("case kept", "slider", "reset"):
        CHANGES[change](at)
        states.append(_work(at))
    at.button(key="undo").click().run()
    kept = json.loads(json.dumps(session_of(at).kept(), allow_nan=False))
    other = visit(HOME, **at.query_params)
    session_of(other).recall(kept)
    other.run()
    for button, state in (("redo", 3), ("undo", 2), ("undo", 1), ("undo", 0)):
        other.button(key=button).click().run()
        assert _work(other) == states[state]
    assert other.button(key="undo").disabled


def test_undo_leads_from_the_machine_of_another_link_to_what_a_browser_kept() -> None:
    at = visit(HOME)
    move(at, "C", 85.0)
    other = visit(HOME, C="90")
    session_of(other).recall(session_of(at).kept())
    for clearance in (85.0, 60.0):
        other.run()
        other.button(key="undo").click().run()
        assert session_of(other).values["C"] == clearance


def test_of_states_kept_by_a_browser_what_can_be_used_is_taken() -> None:
    visitor = session_of(visit(HOME, C="72"))
    links = ["C=85", "C=-5&T=70&what=3&cases=<b>&preset=no", *["C=90"] * 500]
    visitor.recall({"states": links, "place": 1})
    states, place = visitor.history.near()
    assert (len(states), place) == (3, 2)
    usual = PRESET_VALUES["sheet-1e8"]
    assert [state.values for state in states] == [
        usual | {"C": 85.0}, usual | {"T": 70.0}, usual | {"C": 72.0},
    ]  # fmt: skip


def test_a_browser_keeps_the_states_nearest_to_the_present() -> None:
    history = History(*range(150), at=120)
    assert history.near() == (list(range(70, 150)), 50)
    assert History(1).near() == ([1], 0)


@pytest.mark.parametrize("kick", ["-1", "2", "nan", "x", ""])
def test_the_release_of_a_kept_state_is_checked(kick: str) -> None:
    release = {"orbits_kick": 0.25, "orbits_revolutions": 400}
    work = Work("sheet-1e7", dict(PRESET_VALUES["sheet-1e7"]), (), release)
    assert Work.of(work.link) == work
    assert Work.of(work.link).release == release
    assert Work.of(f"kick={kick}&revolutions={kick}").release == {}


def test_labels_that_a_browser_kept_are_taken_over_and_cut() -> None:
    labels.recall({"title": "x" * 9999, "author": "A <b>", "no": "label"})
    assert labels.kept() == {"name": "", "note": "", "title": "x" * 120, "author": "A <b>"}
