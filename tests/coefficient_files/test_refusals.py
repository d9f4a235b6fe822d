"""What cannot be read: each refusal's place and words, the bounds, and hostile files."""

import io
import os
import zipfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotorcalc import read_coefficients
from rotorcalc.coefficient_files import Scale, excel, written
from tests.coefficient_files.tables import NAMES, ROWS, text
from tests.coefficient_files.tables import excel as book

HEADER = ("rpm", *NAMES)
SCALE = Scale(diameter=0.1, length=0.05, radial_clearance=6e-5, viscosity=0.02, load=5e3)


def _with(old, new, separator=","):
    whole = text(separator)
    assert old in whole
    return whole.replace(old, new, 1)


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("", "the file is empty, or its name"),
        ("\n", "the file is empty"),
        (b"", "the file is empty"),
        (Path(), r"source = .*: is a folder"),
        ("Kxx\n", "no column of speed|at least two rows"),
        ("one\ntwo\n", "no table found: it needs a header with kxx"),
        ("1 2 3\n4 5 6\n", "line 1: has 3 numbers and no header above"),
        (_with("200000000", "2e8N"), r"line 2, column 5 \(K_yy\): '2e8N' is no number"),
        (_with("200000000", "=4e8/2"), r"line 2, column 5 \(K_yy\): '=4e8/2' is a formula, which"),
        (_with("200000000", ""), r"line 2, column 5 \(K_yy\): is empty"),
        (_with("200000000", "nan"), r"line 2, column 5 \(K_yy\): 'nan' is no number"),
        (_with("200000000", "1e999"), r"line 2, column 5 \(K_yy\): '1e999' is too large"),
        (_with("3000,", "0,"), r"line 2, column 1 \(speed\): 0: must be positive"),
        (_with("3000,", "-3000,"), r"line 2, column 1 \(speed\): -314.159: must be positive"),
        (_with("3000,", "6000,"), "lines 2 and 3: have the same speed"),
        (_with("3000,", ""), "line 2: has 8 cells, where the header has 9"),
        (_with("900000\n", "900000,7\n"), "line 2: has 10 cells, where the header has 9"),
        (_with("Kxy", "Kxx"), "line 1, column 3: 'Kxx' is a second column of this"),
        (_with("cxx".title(), "Dxx"), "the table has no column cxx"),
        (_with("rpm", "turns"), "the table has no column of speed"),
        (_with("Kxx", "Kxx [MN/m]"), "K_xy: its column names no unit, and that of K_xx is in MN/m"),
        (text(rows=ROWS[:1]), "at least two rows of numbers, at two speeds"),
        (text() + text(), "line 5: a second table begins"),
        (text() + ",".join("abcdefghi"), "line 5: has no number in any column"),
        (_with("Kxx", '"Kxx'), "line 1: no row of a table"),
        (text(";", comma=True).replace("3000;400000000", "3000;1,234"),
         r"line 2, column 2 \(K_xx\): '1,234' may have a decimal comma or one of thousands"),
        (text(" ").replace("3000 ", "3,5 ").replace("6000 ", "6.5 "),
         r"line 2, column 1 \(speed\): '3,5' has a comma, where other numbers of the file"),
        (text(rows=[(r[0], *(k + 0.5 for k in r[1:])) for r in ROWS], comma=True),
         "separate the cells by semicolons"),
        (b"\x89PNG\r\n\x1a\n" + bytes(40), "characters of code 0: it is no text"),
        (b"PK\x03\x04rubbish", "the file is no workbook"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(900), "the workbook is no workbook that can"),
        (b"1" * 2_000_001, "the file has more than 2 MB"),
        ("rpm\n" + "1\n" * 5001, "has more than 5000 lines"),
        (",".join("1" * 300) + "\n", "line 1: has more than 200 columns"),
        ("\n".join([",".join("1" * 190)] * 1100), "has more than 200000 cells"),
        ("\n\n" + "1" * 20_001, "line 3: has more than 20000 characters"),
        (None, "source = None: must be bytes or a text or a Path"),
    ],
)  # fmt: skip
def test_a_refusal_names_the_place_and_what_is_wrong(source, words):
    with pytest.raises(ValueError, match=words):
        read_coefficients(source)


def test_refusals_of_workbooks_name_the_cell():
    rows = [list(row) for row in ROWS]
    for value, words in (
        ("many", r"^cell B3 \(K_xx\): 'many' is no number"),
        ("", r"^cell B3 \(K_xx\): is empty"),
        ("=1+1", r"^cell B3 \(K_xx\): '=1\+1' is a formula, which is not run"),
    ):
        rows[1][1] = value
        with pytest.raises(ValueError, match=words):
            read_coefficients(book(HEADER, *map(tuple, rows)))
    with pytest.raises(ValueError, match=r"the workbook has no sheet 'Two', only Table"):
        read_coefficients(book(HEADER, *ROWS), sheet="Two")
    with pytest.raises(ValueError, match="the workbook has no cells"):
        read_coefficients(book())


def _changed(raw, old, new):
    """Return a workbook with another text in its parts."""
    file = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(raw)) as before, zipfile.ZipFile(file, "w", 8) as after:
        for name in before.namelist():
            after.writestr(name, before.read(name).replace(old, new))
    return file.getvalue()


def test_a_formula_counts_by_the_value_saved_with_it_and_is_refused_without_one():
    plain = book(HEADER, *ROWS)
    saved = _changed(plain, b"<c><v>200000000.0</v>", b"<c><f>1/0</f><v>200000000.0</v>")
    np.testing.assert_array_equal(
        read_coefficients(saved).stiffness, read_coefficients(plain).stiffness
    )
    unsaved = _changed(plain, b"<c><v>200000000.0</v>", b"<c><f>1/0</f>")
    with pytest.raises(ValueError, match=r"^cell E2 \(K_yy\): is empty; a formula needs"):
        read_coefficients(unsaved)


def test_hostile_workbooks_cost_little():
    begin = sum(os.times()[:4])  # with those of other processes
    plain = book(HEADER, *ROWS)
    far = _changed(plain, b"<row><c><v>9000.0", b'<row r="1048576"><c r="XFD1048576"><v>9000.0')
    with pytest.raises(ValueError, match=r"too much memory|more than 5000 rows|has no cells"):
        read_coefficients(far)
    bomb = _changed(plain, b"<sheetData>", b"<sheetData>" + b" " * 60_000_000)
    assert len(bomb) < 200_000
    with pytest.raises(ValueError, match="expands to more than 50 MB"):
        read_coefficients(bomb)
    entities = b'<!DOCTYPE a [<!ENTITY b "9">]><worksheet'
    with pytest.raises(ValueError, match="workbook"):
        read_coefficients(_changed(plain, b"<worksheet", entities).replace(b"zz", b"")[:-40])
    assert sum(os.times()[:4]) - begin < 5.0


def test_a_workbook_without_its_reader_says_what_to_install(monkeypatch):
    monkeypatch.setattr(excel, "_answer", lambda *_: {"missing": True})
    with pytest.raises(ValueError, match=r"need python-calamine: pip install 'rotorcalc\[files\]'"):
        read_coefficients(book(HEADER, *ROWS))


def test_units_that_are_none_are_refused():
    with pytest.raises(ValueError, match=r"units: 'mass': must be speed, stiffness or damping"):
        read_coefficients(text(), units={"mass": "kg"})
    with pytest.raises(ValueError, match=r"^units: 'lb': no unit of stiffness; known are N/m"):
        read_coefficients(text(), units={"stiffness": "lb"})


# Pieces of tables, so that a good share of what is drawn gets past the header.
PIECES = st.sampled_from([
    *HEADER, "S", "eps", "phi", "[N/m]", "(rpm)", "[", "]", "lb/in", "-", "1", "2.5", "1,5",
    "1,234",
    "1e308", "-1e-320", "=A1", "nan", '"', "'", "#", "%", "\ufeff", "\u2212", "∞", "Ω", "\x1c", "٣",
    " ", "  ", "\t", ",", ";", "\n", "\n", "\r\n", "\x85",
])  # fmt: skip
TEXTS = st.one_of(st.lists(PIECES, max_size=120).map("".join), st.text(max_size=200))


@settings(max_examples=60, deadline=1000, suppress_health_check=[HealthCheck.too_slow])
@given(TEXTS)
def test_a_text_is_read_or_refused_in_words(words):
    for source in (words.encode("utf-8", "surrogatepass"), words + "\n", text(" ") + words):
        _read_or_refused(source)


@settings(max_examples=100, deadline=1000)
@given(st.data())
def test_a_damaged_table_is_read_or_refused_in_words(data):
    separator = data.draw(st.sampled_from([",", ";", "\t", " "]))
    whole = bytearray(text(separator).encode())
    for _ in range(data.draw(st.integers(1, 4))):
        place = data.draw(st.integers(0, len(whole) - 1))
        whole[place : place + data.draw(st.integers(0, 3))] = data.draw(st.binary(max_size=3))
    _read_or_refused(bytes(whole))


def _read_or_refused(source):
    try:
        read = read_coefficients(source, scale=SCALE)
    except ValueError:
        return
    n = len(read.speed)
    assert read.stiffness.shape == read.damping.shape == (n, 2, 2)
    assert np.all(np.diff(read.speed) > 0.0)
    again = read_coefficients(written(read.speed, read.stiffness, read.damping))
    np.testing.assert_array_equal(again.stiffness, read.stiffness)


@settings(max_examples=12, deadline=None)
@given(st.data())
def test_a_damaged_workbook_is_read_or_refused_in_words(data):
    whole = bytearray(book(HEADER, *ROWS))
    for _ in range(data.draw(st.integers(1, 6))):
        whole[data.draw(st.integers(4, len(whole) - 1))] = data.draw(st.integers(0, 255))
    _read_or_refused(bytes(whole))
