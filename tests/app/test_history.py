"""Undo and redo: of every kind of change of the machine, back and forth, exactly."""

from collections.abc import Callable

import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc.figures.cases import COLOURS
from tests.app.session import HOME, ORBITS, move, open_part, session_of, visit
from ui.history import History
from ui.inputs import PRESET_VALUES, machine_of


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
