"""Your data: a file of coefficients is shown in the program's axes, or refused by its place."""

from types import SimpleNamespace

import numpy as np
import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc import read_coefficients
from tests.app.session import YOUR_DATA, charts, faults, session_of, texts, visit
from tests.app.test_words import _faults as of_words
from tests.coefficient_files.tables import NAMES, ROWS, RPM, K, excel, text
from tests.words import texts as every_text
from ui.words.own_coefficients import FORMATS, _own

HANDBOOK = "\n".join([
    "S\tε\tφ\t" + "\t".join(NAMES),
    "0.05\t0.8\t35\t4\t2\t-1\t2\t6\t-2\t-2\t3",
    "0.2\t0.5\t52\t2\t2\t-2\t2\t4\t-1\t-1\t3",
    "0.9\t0.2\t72\t2\t3\t-3\t2\t6\t-1\t-1\t6",
])  # fmt: skip


def given(content: str | bytes, name: str = "mine.csv", **query: str) -> AppTest:
    """Return the page with a file."""
    at = visit(YOUR_DATA, **query)
    raw = content.encode() if isinstance(content, str) else content
    at.file_uploader(key="own_file").set_value((name, raw, "text/csv")).run()
    assert not at.exception
    return at


def shown(at: AppTest) -> list[str]:
    return [box.value for box in (*at.success, *at.warning, *at.error, *at.info)]


@pytest.mark.parametrize("units", ["SI", "US"])
@pytest.mark.parametrize(
    "content",
    [text(), excel(("speed", *NAMES), ("rpm", *["N/m"] * 4), *ROWS), HANDBOOK],
)  # fmt: skip
def test_a_file_is_shown_before_it_is_used_and_reads_well(content: str | bytes, units: str) -> None:
    at = given(content, units=units)
    before = dict(session_of(at).values)
    assert any("Read: 3 speeds" in words for words in shown(at))
    assert faults(at) == []
    mine = set(every_text(at)) - set(every_text(visit(YOUR_DATA, units=units)))
    assert len(mine) > 5
    assert [one for words in mine for one in of_words("Your data", words)] == []
    [table] = at.dataframe
    assert len(table.value) == 3
    assert session_of(at).values == before
    assert not at.button(key="use_own").disabled


def test_axes_and_units_are_the_visitors() -> None:
    at = given(text(header=("speed", *NAMES)))
    at.segmented_control(key="data_load_axis").set_value("+x").run()
    at.selectbox(key="own_speed").set_value("rpm").run()
    at.selectbox(key="own_stiffness").set_value("kN/m").run()
    assert any("chosen above, as the file names none" in words for words in texts(at))
    [table] = at.dataframe
    assert list(table.value["Speed [rpm]"]) == ["3000", "6000", "9000"]
    assert float(table.value["KXX [MN/m]"][0].replace("·10⁵", "e5")) == K[0, 0, 0] * 1e-3
    assert not any("against the rotation" in words for words in shown(at))
    at.segmented_control(key="data_turns").set_value("y to x").run()
    assert any("against the rotation" in words for words in shown(at))


def test_a_refusal_names_the_place_and_what_the_file_has_is_no_markup() -> None:
    at = given(text().replace("200000000", "**2e8** `x`", 1), "a`b<br>.csv")
    [said] = [error.value for error in at.error]
    assert "line 2, column 5 (K_yy): '**2e8** 'x''" in said
    assert said.startswith("`a'b<br>.csv` was not read: `")
    assert charts(at) == {}
    header = ("rpm", *NAMES, ":red[x] _y_")
    at = given(text(header=header, rows=[(*row, 1.0) for row in ROWS]))
    [said] = [words for words in texts(at) if "not read" in words]
    assert r"\:red\[x\] \_y\_" in said


def test_an_empty_file_is_refused_in_words() -> None:
    [said] = [error.value for error in given("").error]
    assert "was not read: `the file is empty" in said


def test_a_dimensionless_table_takes_the_machines_own_bearing_at_first() -> None:
    at = given(HANDBOOK)
    assert any("dimensionless" in words for words in texts(at))
    assert at.number_input(key="own_diameter_SI").value == pytest.approx(
        session_of(at).values["D"], rel=1e-5
    )
    [table] = at.dataframe
    first = table.value["Speed [rpm]"][0]
    at.number_input(key="own_load_SI").set_value(2.0 * at.number_input(key="own_load_SI").value)
    at.run()
    assert float(at.dataframe[0].value["Speed [rpm]"][0]) == pytest.approx(2 * float(first), 1e-3)
    at.segmented_control(key="data_which_s").set_value("DIN").run()
    assert any("classical, S, or modified" in words for words in shown(at))


def test_the_sample_is_the_machines_own_and_says_its_axes() -> None:
    at = visit(YOUR_DATA)
    assert {"chart_own_sample_K", "chart_own_sample_C"} == charts(at).keys()
    sample = _own(SimpleNamespace(computed=session_of(at).preview.computed))
    read = read_coefficients(sample)
    assert 20 < len(read.speed) < 30
    assert not read.warnings
    at = given(sample)
    assert any("load acts along +x" in words for words in shown(at))
    assert not [one for one in at.segmented_control if one.key == "data_load_axis"]
    assert float(at.dataframe[0].value["Speed [rpm]"].iloc[-1]) == pytest.approx(
        read.speed[-1] / RPM
    )


def test_what_is_used_is_the_machines_bearing_until_it_is_undone() -> None:
    at = given(text(header=("rpm", *NAMES)))
    at.segmented_control(key="data_load_axis").set_value("+x").run()
    before = dict(session_of(at).values)
    assert not any("In use" in words for words in shown(at))
    at.button(key="use_own").click().run()
    assert faults(at) == []
    assert any("In use: they are this machine's bearing" in words for words in shown(at))
    assert at.button(key="use_own").disabled
    assert at.button(key="use_own").label == "In use"
    sweep = session_of(at).preview.computed.sweep
    np.testing.assert_allclose(sweep.stiffness[0], K[0], rtol=1e-9)
    assert sweep.speed[[0, -1]] == pytest.approx([ROWS[0][0] * RPM, ROWS[-1][0] * RPM])
    at.button(key="undo").click().run()
    assert session_of(at).values == before


def test_formulas_of_what_is_read_are_whole() -> None:
    # A tab or a line's end within would be half of \\text or \\right.
    assert "\t" not in FORMATS
    assert FORMATS.count(r"\left(") == FORMATS.count(r"\right)") == 4
