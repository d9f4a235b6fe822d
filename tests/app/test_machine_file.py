"""The machine's file: the machine exactly, and how it is shown; old files, and broken ones."""

import json

import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc import Machine
from tests.app.session import HOME, faults, open_part, session_of, visit
from ui.inputs import PRESET_VALUES, machine_of
from ui.session import Session
from ui.sharing import machine_file
from ui.sharing.labels import Labels

LABELS = Labels(name="Pump 3", note="Trip at 80 µm.\nNew oil.")
CRITERIA = "pages/10_Criteria.py"
CASES = "Wide~3~C~95~~Thin oil~1~T~90"


def _written(at: AppTest) -> bytes:
    visitor = session_of(at)
    return machine_file.write(machine_of(visitor.values), visitor, LABELS)


def _loaded(document: bytes, **query: str) -> AppTest:
    at = visit(HOME, **query)
    open_part(at, "share")
    at.file_uploader(key="upload").upload("machine.json", document).run()
    return at


def test_a_file_brings_machine_speeds_units_cases_name_and_note() -> None:
    at = visit(HOME, preset="sheet-1e7", C="81.3", rpm="3456", rpm_max="9000", units="US",
               amplitude="p-p", cases=CASES)  # fmt: skip
    other = _loaded(_written(at), C="70")
    mine, theirs = session_of(at), session_of(other)
    assert (theirs.preset, theirs.values, theirs.units, theirs.cases) == (
        mine.preset, mine.values, mine.units, mine.cases,
    )  # fmt: skip
    assert other.text_input(key="label_name").value == LABELS.name
    assert other.text_area(key="label_note").value == LABELS.note
    assert faults(other) == []
    assert not other.warning
    other.button(key="undo").click().run()
    assert session_of(other).values == PRESET_VALUES["sheet-1e8"] | {"C": 70.0}
    assert session_of(other).cases == ()


def test_a_file_brings_what_the_page_criteria_asks() -> None:
    query = {"slowest": "5000", "coupling": "given", "qa": "2.5", "grade": "G 6.3"}
    at = visit(CRITERIA, **query)
    chosen = at.session_state["rotorcalc_choices"].kept()
    visitor = session_of(at)
    document = machine_file.write(machine_of(visitor.values), visitor, LABELS, chosen)
    assert json.loads(document)["app"]["criteria"] == query
    # Onto a page that shows other choices already.
    other = visit(CRITERIA, grade="G 1", fastest="7000")
    open_part(other, "share")
    other.file_uploader(key="upload").upload("machine.json", document).run()
    assert other.query_params == query | {"fastest": "7000"}
    assert not other.warning
    assert faults(other) == []


@pytest.mark.parametrize(
    "asked", [1, {"grade": "G 7"}, {"coupling": []}, {"what": "5"}, {"<b>": {}}], ids=str
)
def test_what_a_file_asks_of_criteria_is_checked(asked: object) -> None:
    document = json.loads(_written(visit(HOME)))
    document["app"]["criteria"] = asked
    at = _loaded(json.dumps(document).encode())
    assert any("left out" in one.value for one in at.warning)
    assert not at.exception


@pytest.mark.parametrize("preset", PRESET_VALUES)
def test_the_core_reads_the_machine_of_a_file(preset: str) -> None:
    visitor = Session(preset, dict(PRESET_VALUES[preset]), "SI")
    text = machine_file.write(machine_of(visitor.values), visitor, LABELS).decode()
    assert Machine.from_json(text) == machine_of(PRESET_VALUES[preset])
    assert json.loads(text)["version"] == 2


def test_an_old_file_brings_the_machine_and_leaves_the_rest() -> None:
    old = machine_of(PRESET_VALUES["fig-5-2"]).to_json()
    at = _loaded(old.encode(), rpm="3456", units="US", cases=CASES)
    visitor = session_of(at)
    assert machine_of(visitor.values) == machine_of(PRESET_VALUES["fig-5-2"])
    assert (visitor.values["rpm"], visitor.units_name, len(visitor.cases)) == (3456.0, "US", 2)
    assert not at.warning


@pytest.mark.parametrize(
    ("app", "word"),
    [
        ({"rpm": "fast"}, "Running speed"),
        ({"units": "cgs"}, "units"),
        ({"preset": "mine"}, "preset"),
        ({"cases": "A~1~C~-5"}, "Radial clearance"),
        ({"cases": {"A": 1}}, "Case"),
        ([], "JSON object"),
    ],
)
def test_what_a_file_says_beside_the_machine_is_checked_and_named(app: object, word: str) -> None:
    document = json.loads(machine_of(PRESET_VALUES["fig-5-2"]).to_json()) | {"app": app}
    at = _loaded(json.dumps(document).encode())
    assert at.exception == []
    assert any(word in box.value for box in at.warning)


def test_a_long_reason_is_not_cut() -> None:
    document = json.loads(machine_of(PRESET_VALUES["fig-5-2"]).to_json())
    document["bearing"]["geometry"] = {"type": "octagonal"}
    at = _loaded(json.dumps(document).encode())
    with pytest.raises(ValueError, match="octagonal") as refused:
        Machine.from_json(json.dumps(document))
    assert any(str(refused.value).replace("`", "'") in box.value for box in at.warning)


@pytest.mark.parametrize(
    ("place", "fields"),
    [
        ("oil", {"law": "walther"}),
        ("oil", {"heat_capacity": 1900.0}),
        ("", {"supply": {"temperature": 40.0, "flow": 2e-4, "heat_share": 0.8}}),
    ],
)
def test_heat_of_a_file_becomes_the_session_s_and_is_written_again(
    place: str, fields: dict[str, object]
) -> None:
    tree = json.loads(machine_of(PRESET_VALUES["sheet-1e8"]).to_json())
    (tree[place] if place else tree).update(fields)
    if "supply" in fields:
        del tree["temperature"]
    text = json.dumps(tree)
    visitor = Session("sheet-1e8", dict(PRESET_VALUES["sheet-1e8"]), "SI")
    loaded = machine_file.read(text, visitor)
    assert loaded.problems == []
    assert machine_of(loaded.link.values) == Machine.from_json(text)
    visitor.values = loaded.link.values
    again = machine_file.read(
        machine_file.write(machine_of(visitor.values), visitor, LABELS).decode(), visitor
    )
    assert (again.link.values, again.problems) == (visitor.values, [])
