"""The same numbers from every format; units, order of columns, what a table may leave out."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse, read_coefficients
from rotorcalc.coefficient_files import written
from tests.coefficient_files.tables import (
    NAMES,
    PER_INCH,
    ROWS,
    RPM,
    SPEED,
    C,
    K,
    excel,
    same,
    text,
)
from ui.computed import computed_from
from ui.inputs import PRESET_VALUES
from ui.sharing import export

BRACKETS = ("Speed [rpm]", *(f"{name} [N/m]" for name in NAMES[:4]),
            *(f"{name} [N s/m]" for name in NAMES[4:]))  # fmt: skip
DRIVE_END = Path(__file__).with_name("pounds.xls")


@pytest.mark.parametrize(
    ("separator", "comma"),
    [(",", False), (";", False), ("\t", False), (" ", False), ("   ", False), (", ", False),
     (";", True), ("\t", True), (" ", True)],
)  # fmt: skip
@pytest.mark.parametrize("header", [("rpm", *NAMES), BRACKETS, ()])
def test_separators_and_decimal_commas(separator, comma, header):
    # With a decimal somewhere, so that a comma can be told from one of thousands.
    rows = [(row[0], *(number + 0.5 for number in row[1:])) for row in ROWS]
    read = read_coefficients(text(separator, header, rows, comma=comma))
    np.testing.assert_allclose(read.speed, SPEED, rtol=1e-15)
    np.testing.assert_array_equal(read.stiffness, K + 0.5)
    np.testing.assert_array_equal(read.damping, C + 0.5)
    first = 2 if header else 1
    assert read.lines == tuple(range(first, first + len(rows)))


@pytest.mark.parametrize(
    ("name", "factor"),
    [("N/m", 1.0), ("MN/m", 1e6), ("N/mm", 1e3), ("N/µm", 1e6), ("N/um", 1e6), ("lb/in", PER_INCH),
     ("LBF/IN", PER_INCH), ("klbf/in", 1e3 * PER_INCH)],
)  # fmt: skip
def test_units_of_stiffness_in_the_header(name, factor):
    rows = [(*row[:1], *(k / factor for k in row[1:5]), *row[5:]) for row in ROWS]
    header = ["rpm", *(f"{key} [{name}]" for key in NAMES[:4]), *NAMES[4:]]
    read = read_coefficients(text("\t", header, rows))
    np.testing.assert_allclose(read.stiffness, K, rtol=1e-9)
    assert {column.why for column in read.columns if column.key[0] == "K"} == {"its header"}
    # A table half of whose columns name pounds has them in the others too; else SI is assumed.
    assumed = any("damping in N·s/m" in words for words in read.warnings)
    assert assumed != ("lb" in name.lower())
    assert read.columns[5].unit == ("N·s/m" if assumed else "lbf·s/in")


@pytest.mark.parametrize(
    ("name", "factor"), [("N·s/m", 1.0), ("N-s/m", 1.0), ("kN s/m", 1e3), ("lb-s/in", PER_INCH)]
)
@pytest.mark.parametrize(
    ("speed", "per_rpm"), [("rpm", 1.0), ("Hz", 1.0 / 60.0), ("rad/s", RPM), ("r/min", 1.0)]
)
def test_units_in_a_row_below_the_header(name, factor, speed, per_rpm):
    rows = [(row[0] * per_rpm, *row[1:5], *(c / factor for c in row[5:])) for row in ROWS]
    units = (speed, *["N/m"] * 4, *[name] * 4)
    same(read_coefficients(excel(("speed", *NAMES), units, *rows)))


def test_a_milli_is_no_mega_and_an_unknown_unit_is_refused_by_its_cell():
    header = ["rpm", "Kxx [mN/m]", *NAMES[1:]]
    with pytest.raises(ValueError, match=r"^line 1, column 2: 'mN/m': no unit of stiffness; known"):
        read_coefficients(text(header=header))
    units = ("rpm", "N/m", "N/m", "N/furlong", "N/m", *["N*s/m"] * 4)
    with pytest.raises(ValueError, match=r"^cell D2: 'N/furlong': no unit of stiffness"):
        read_coefficients(excel(("speed", *NAMES), units, *ROWS))


def test_ross_tells_units_by_a_word_in_any_cell():
    pounds = [(row[0], *(number / PER_INCH for number in row[1:])) for row in ROWS]
    sheet = excel(("All in inches and lb, speeds in RPM",), ("speed", *NAMES), *pounds)
    read = read_coefficients(sheet)
    same(read)
    assert {column.unit for column in read.columns} == {"rpm", "lbf/in", "lbf·s/in"}
    assert all("All in inches" in column.why for column in read.columns)
    assert not any("Assumed" in words for words in read.warnings)


def test_without_a_word_a_table_is_in_si_as_ross_has_it_and_that_is_said():
    rows = [(row[0] * RPM, *row[1:]) for row in ROWS]
    read = read_coefficients(excel(("Frequency", *NAMES), *rows))
    same(read)
    [said] = [words for words in read.warnings if "Assumed" in words]
    assert "speed in rad/s, stiffness in N/m, damping in N·s/m" in said
    given = read_coefficients(
        excel(("Frequency", *NAMES), *rows), units={"speed": "Hz", "stiffness": "MN/m"}
    )
    np.testing.assert_allclose(given.speed, 2 * np.pi * RPM * np.array([r[0] for r in ROWS]))
    np.testing.assert_array_equal(given.stiffness, 1e6 * K)


def test_an_old_workbook_with_columns_in_another_order():
    read = read_coefficients(DRIVE_END)
    same(read)
    assert read.lines == (6, 7, 8)
    same(read_coefficients(str(DRIVE_END), sheet="Bearing"))


def test_the_table_written_for_ross_comes_back():
    computed = computed_from(PRESET_VALUES[next(iter(PRESETS))])
    read = read_coefficients(export.ross_table(computed), load_axis="-y")
    sweep = computed.sweep
    for name in ("speed", "stiffness", "damping"):
        np.testing.assert_array_equal(getattr(read, name), getattr(sweep, name), err_msg=name)
    assert not read.warnings


def test_a_table_written_here_comes_back_to_the_last_digit():
    random = np.random.default_rng(3)
    speed = np.cumsum(random.random(40)) + 1e-3
    K, C = random.normal(size=(2, 40, 2, 2)) * 10.0 ** random.uniform(-9, 12, (2, 40, 2, 2))
    read = read_coefficients(written(speed, K, C).encode())
    np.testing.assert_array_equal(read.speed, speed)
    np.testing.assert_array_equal(read.stiffness, K)
    np.testing.assert_array_equal(read.damping, C)


def test_a_machine_runs_on_what_was_read():
    read = read_coefficients(text())
    machine = replace(PRESETS["sheet-1e8"].machine, bearing=read.table)
    sweep = analyse(machine, SPEED[1:2])
    np.testing.assert_allclose(sweep.stiffness[0], K[1], rtol=1e-12)
    np.testing.assert_allclose(sweep.damping[0], C[1], rtol=1e-12)


def test_what_a_table_may_leave_out_is_as_in_ross_and_said():
    read = read_coefficients("rpm,kxx,cxx\n1000,2e8,3e5\n2000,4e8,5e5\n")
    np.testing.assert_array_equal(read.stiffness[1], 4e8 * np.eye(2))
    np.testing.assert_array_equal(read.damping[0], 3e5 * np.eye(2))
    assert sum("Not in the file" in words for words in read.notes) == 2
    # What is there is not said to be assumed.
    [note] = read_coefficients(
        "rpm,kxx,kxy,kyx,kyy,cxx,cxy,cyx\n1,2,0,0,2,3,1,1\n2,2,0,0,2,3,1,1\n",
        units={"speed": "rpm", "stiffness": "N/m", "damping": "N·s/m"},
    ).notes
    assert note == "Not in the file: C_yy. As in ROSS, C_yy is C_xx."
    notes = read_coefficients("rpm,kxx,kxy,kyy,cxx\n1,2,1,2,3\n2,2,1,2,3\n").notes
    assert "Not in the file: K_yx. As in ROSS, K_yx is zero." in notes
    assert any("C_yy is C_xx, and C_xy and C_yx are zero." in one for one in notes)


def test_remarks_comments_order_and_numbers_of_old_programs():
    lines = text().splitlines()
    lines[1] = lines[1].replace("400000000", " 4.0D+08")
    scrambled = [
        "Bearing 1",
        "",
        "# rpm Kxx of an older run",
        lines[0],
        *reversed(lines[1:]),
        "end",
    ]
    read = read_coefficients("\r\n".join(scrambled))
    same(read)
    assert read.lines == (7, 6, 5)
    assert any("order of rising speed" in words for words in read.notes)
    assert any("1 lines of words" in words for words in read.notes)


def test_added_mass_is_left_out_and_said():
    header = ["rpm", *NAMES, "Mxx"]
    read = read_coefficients(text(header=header, rows=[(*row, 3.0) for row in ROWS]))
    same(read)
    assert any("M_xx is left out" in words for words in read.warnings)
    quiet = read_coefficients(text(header=header, rows=[(*row, 0.0) for row in ROWS]))
    assert not any("left out" in words for words in quiet.warnings)


def test_encodings():
    lines = text(header=[name.replace("rpm", "Ω [rpm]") for name in ("rpm", *NAMES)])
    for encoding in ("utf-8", "utf-8-sig", "utf-16"):
        same(read_coefficients(lines.encode(encoding)))
    # A file in Windows-1252 has the sign of a product.
    header = [*BRACKETS[:5], *(f"{name} [N·s/m]" for name in NAMES[4:])]
    same(read_coefficients(text(header=header).encode("cp1252")))


def test_the_table_says_what_it_took_for_what():
    read = read_coefficients(text("\t", BRACKETS))
    assert [column.key for column in read.columns][:3] == ["speed", "K_xx", "K_xy"]
    assert read.columns[0].header == "Speed [rpm]"
    assert re.fullmatch("over speed", read.kind)
    assert not read.notes
    assert not read.warnings
