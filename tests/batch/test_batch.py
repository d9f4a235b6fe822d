"""Machines from files: what is right is read exactly, what is wrong is named with its place."""

import contextlib
import csv
import importlib
import io
import json
import math
import re
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.constants import inch, lb, lbf

import rotorcalc as rc
from rotorcalc.batch import columns, command, reading
from rotorcalc.batch.numbers import decimal_mark, number
from tests.machines import SHEET

HEADER = (
    "name,speed [rpm],reference_viscosity [mPa·s],reference_temperature [°C],"
    "temperature_coefficient [1/°C],temperature [°C],diameter [mm],length [mm],"
    "radial_clearance [µm],mass [kg],shaft_stiffness [N/m],imbalance [µm]"
)
ROW = "sheet,6000,17.2368925,50,0.03,60,150,50,60,272.1422,1e8,12"
TABLE = f"{HEADER}\n{ROW}\n"


def with_column(header: str, *cells: str) -> str:
    """Return the table with another column, and a row for each of its cells."""
    return "\n".join([f"{HEADER},{header}", *(f"{ROW},{cell}" for cell in cells)])


def only(text: str | bytes, base: rc.Machine | None = None) -> reading.Case:
    found = rc.read_machines(text, base)
    assert found.problems == ()
    [case] = found.cases
    return case


# --- What is right --------------------------------------------------------------------------


def test_a_table_is_the_machine_to_the_last_bit() -> None:
    assert only(TABLE) == reading.Case(2, "sheet", SHEET, 6000 * rc.rpm)


@pytest.mark.parametrize(
    "write",
    [
        lambda text: text.replace("\n", "\r\n"),
        lambda text: "\ufeff" + text,
        lambda text: f"\n\n{text}\n\n",
        lambda text: text.encode("utf-8-sig"),
        lambda text: text.encode("utf-16"),
        lambda text: text.encode("cp1252"),
        lambda text: text.replace(",", ";"),
        lambda text: text.replace(",", "\t"),
        lambda text: text.replace(",", ";").replace(".", ","),
        lambda text: text.replace("µm", "um").replace("·", "*").replace("°", "deg"),
        lambda text: text.replace("radial_clearance", "bearing.radial_clearance"),
    ],
    ids=["CRLF", "BOM", "blank", "UTF-8", "UTF-16", "1252", ";", "tab", "comma", "ASCII", "full"],
)
def test_however_it_is_written_it_is_the_same(write: Callable[[str], str | bytes]) -> None:
    case = only(write(TABLE))
    assert (case.machine, case.speed) == (SHEET, 6000 * rc.rpm)


def test_us_units_are_their_factors() -> None:
    machine = only(
        "reference_viscosity [µreyn],reference_temperature [°F],temperature_coefficient [1/°F],"
        "temperature [°F],diameter [in],length [in],radial_clearance [mil],mass [lb],load [lbf]\n"
        "2.5,122,0.0166666666666666666,140,6,2,2.4,600,300"
    ).machine
    assert machine.oil.reference_viscosity == pytest.approx(2.5e-6 * lbf / inch**2, rel=1e-14)
    assert machine.oil.reference_temperature == pytest.approx(50.0, rel=1e-14)
    assert machine.oil.temperature_coefficient == pytest.approx(0.03, rel=1e-14)
    assert machine.temperature == pytest.approx(60.0, rel=1e-14)
    assert machine.bearing.diameter == pytest.approx(6 * inch, rel=1e-14)
    assert machine.bearing.radial_clearance == pytest.approx(2.4e-3 * inch, rel=1e-14)
    assert machine.rotor.mass == pytest.approx(600 * lb, rel=1e-14)
    assert machine.load == pytest.approx(300 * lbf, rel=1e-14)


@pytest.mark.parametrize("si", ["m", "N", "kg", "Pa·s", "N/m", "m³/s", "rad", "Pa", "°C"])
def test_every_unit_goes_there_and_back(si: str) -> None:
    for unit in columns.units_of(si).values():
        assert float(unit.of(unit.to_si(12.5))) == pytest.approx(12.5, rel=1e-13)


def test_every_number_of_every_bearing_has_a_column() -> None:
    for path, rule in columns._inputs().items():
        name = ".".join(path)
        unit = getattr(rule, "unit", None)
        found = columns.column_of(name if unit is None else f"{name} [{unit}]")
        assert found.path == path
        assert (found.unit is None) == (unit is None)


def test_bores_are_named_and_have_their_own_columns() -> None:
    text = with_column("bearing,preload [%],groove_width [°]", "elliptical,40,15", ",,")
    first, second = (case.machine.bearing.geometry for case in rc.read_machines(text).cases)
    assert first == rc.Elliptical(preload=0.4, groove_width=math.radians(15))
    assert second == rc.Plain()


def test_a_base_has_what_the_table_leaves_out() -> None:
    case = only("radial_clearance [µm];bearing.film\n80;finite", SHEET)
    expected = replace(SHEET.bearing, radial_clearance=80e-6, film="finite")
    assert case.machine == replace(SHEET, bearing=expected)
    assert math.isnan(case.speed)


def test_a_grade_is_that_oil_at_every_temperature() -> None:
    header = "oil,temperature [°C],diameter [mm],length [mm],radial_clearance [µm],mass [kg]"
    case = only(f"{header}\nISO VG 46,70,100,50,60,200")
    expected = rc.iso_oil("ISO VG 46", temperature=70.0).reference_viscosity
    assert case.machine.viscosity == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("header", "field", "value"),
    [
        ("eccentricity_ratio", "eccentricity_ratio", 0.4),
        ("sommerfeld", "sommerfeld", 0.4),
        ("eccentricity_ratio [%]", "eccentricity_ratio", 0.004),
    ],
)
def test_the_load_may_be_known_otherwise(header: str, field: str, value: float) -> None:
    case = only(with_column(header, "0.4"))
    found = rc.analyse(case.machine, case.speed)
    assert getattr(found, field) == pytest.approx(value, rel=1e-10)


def test_the_stiffness_may_be_a_natural_frequency() -> None:
    text = with_column("natural_frequency [Hz]", "50").replace("1e8,", ",")
    K = (2 * math.pi * 50) ** 2 * SHEET.rotor.half_mass
    assert only(text).machine.rotor.shaft_stiffness == pytest.approx(K, rel=1e-14)


def test_json_is_one_machine_or_many() -> None:
    document = json.loads(SHEET.to_json())
    shown = document | {"app": {"name": "first", "rpm": 6000}}
    for text, count in ((SHEET.to_json(), 1), (json.dumps([document, shown]), 2)):
        found = rc.read_machines(text)
        assert [case.machine for case in found.cases] == [SHEET] * count
    assert (found.cases[1].name, found.cases[1].speed) == ("first", 6000 * rc.rpm)


# --- What is wrong --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "empty"),
        ("\ufeff \n", "empty"),
        ("name\0", "code 0"),
        (b"\x81\x8d\x90", "no text in UTF-8"),
        (b"\xff\xfe\x00", "no text in UTF-8"),
        ("load\n1", "load: has no unit; write it in brackets, 'load [N]'"),
        ("load [N\n1", "must be a name, and a unit in brackets"),
        ("load [N] 2\n1", "must be a name, and a unit in brackets"),
        (f"a{' ' * 100_000}[[\n1", "must be a name, and a unit in brackets"),
        ("load [m]\n1", "no unit of this; known are N, kN, lbf"),
        ("clearance [m]\n1", "'clearance': no input of a machine; known are"),
        ("name [m]\n1", "is a text and has no unit"),
        ("load [N],load [kN]\n1,2", "'load' has two columns"),
        ("bearing,bearing.geometry.type\nplain,plain", "two columns"),
        ('name\n"a', "no table"),
        ("{", "no JSON text"),
        ("[NaN]", "NaN: not a JSON number"),
        ("[" * 100000, "no JSON text"),
        (",".join(["name"] * 300), "more than 200 columns"),
    ],
    ids=range(19),
)
def test_a_file_of_which_nothing_can_be_read_says_why(text: str | bytes, words: str) -> None:
    with pytest.raises(ValueError, match=re.escape(words)):
        rc.read_machines(text)


@pytest.mark.parametrize(
    ("old", "new", "column", "words"),
    [
        (",60,272", ",-60,272", "radial_clearance [µm]", "must be positive"),
        (",60,272", ",x,272", "radial_clearance [µm]", "'x' is no number"),
        (",60,272", ",nan,272", "radial_clearance [µm]", "'nan' is no number"),
        (",60,272", ",=30*2,272", "radial_clearance [µm]", "a formula, which is not run"),
        (",60,272", ',"60,5",272', "radial_clearance [µm]", "has a comma, where other"),
        (",60,272", ",1e999,272", "radial_clearance [µm]", "too large for a number"),
        (",60,272", f",{'9' * 100_000}x,272", "radial_clearance [µm]", "1000 characters"),
        (",60,272", f",{'9' * 900}x,272", "radial_clearance [µm]", "with 901 characters"),
        (",60,272", ",٦٠,272", "radial_clearance [µm]", "is no number"),
        (",60,272", ",,272", "radial_clearance [µm]", "radial_clearance: missing"),
        (",1e8,", ",-inf,", "shaft_stiffness [N/m]", "is no number"),
        ("sheet,6000", "sheet,0", "speed [rpm]", "must be positive"),
        ("sheet,6000", "sheet,", "", ""),
        (",12\n", ",12,13\n", "", "has 13 cells, the header 12"),
        (",12\n", "\n", "", "has 11 cells, the header 12"),
        ("sheet", "s" * 1001, "name", "more than 1000 characters"),
    ],
    ids=range(16),
)
def test_a_wrong_line_is_named_and_costs_no_other(
    old: str, new: str, column: str, words: str
) -> None:
    wrong = TABLE.replace(old, new)
    assert wrong != TABLE
    found = rc.read_machines(f"{wrong}{ROW}\n")
    assert found.cases[-1] == replace(only(TABLE), line=3)
    if not words:
        assert found.problems == ()
        return
    [problem] = found.problems
    assert problem.line == 2
    assert words in problem.words
    assert problem.column == column


@pytest.mark.parametrize(
    ("header", "cell", "words"),
    [
        ("eccentricity_ratio", "1.5", "no load gives"),
        ("eccentricity_ratio,load [N]", "0.5,100", "given beside load"),
        ("eccentricity_ratio,sommerfeld", "0.5,1", "exactly one of"),
        ("natural_frequency [Hz]", "50", "given beside shaft_stiffness"),
        ("bearing", "round", "type = 'round': must be one of plain"),
        ("preload", "0.5", "preload: unknown key"),
        ("film", "thick", "film = 'thick': must be one of"),
        ("supply.temperature [°C]", "40", "beside a supply"),
        ("oil.law", "linear", "must be one of"),
    ],
)
def test_what_contradicts_is_named(header: str, cell: str, words: str) -> None:
    found = rc.read_machines(with_column(header, cell))
    assert found.cases == ()
    assert words in found.problems[0].words


def test_a_problem_of_json_has_the_machines_number() -> None:
    document = json.loads(SHEET.to_json())
    wrong = document | {"load": -1.0}
    spun = document | {"app": {"rpm": "fast"}}
    found = rc.read_machines(json.dumps([document, wrong, 3, spun]))
    assert [one.line for one in found.problems] == [2, 3, 4]
    assert "load = -1.0 N: must be at least 0" in found.problems[0].words


def test_sizes_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reading, "MOST_MACHINES", 3)
    for text in (TABLE + 3 * f"{ROW}\n", json.dumps([1, 2, 3, 4])):
        with pytest.raises(ValueError, match="more than 3 machines"):
            rc.read_machines(text)
    monkeypatch.setattr(reading, "MOST_BYTES", 10)
    with pytest.raises(ValueError, match="the file has more than"):
        rc.read_machines(TABLE)


@pytest.mark.parametrize(
    ("cells", "mark"),
    [
        (["1", "2"], "."),
        (["1.5"], "."),
        (["0,5"], ","),
        (["1,234"], ""),
        (["1,234", "2,5"], ","),
        (["1,234", "2.5"], "."),
        (["1,2345"], ","),
        (["x,5", "name"], "."),
    ],
)
def test_the_decimal_mark_is_what_most_numbers_have(cells: list[str], mark: str) -> None:
    assert decimal_mark(cells) == mark


def test_a_number_that_may_be_two_is_asked_back() -> None:
    with pytest.raises(ValueError, match=r"write 1234 or 1\.234"):
        number("1,234", "", infinite=False)
    assert number("1,234", ",", infinite=False) == 1.234


@given(value=st.floats(allow_nan=False, allow_infinity=False), comma=st.booleans())
def test_every_number_is_read_as_it_was_written(value: float, comma: bool) -> None:
    text = repr(value)
    mark = "," if comma else "."
    assert number(text.replace(".", mark), mark, infinite=False) == value


@settings(max_examples=50)
@given(text=st.text() | st.binary())
@example(text=b";")  # a header of empty cells
def test_anything_is_read_or_refused(text: str | bytes) -> None:
    with contextlib.suppress(ValueError):
        assert isinstance(rc.read_machines(text), reading.MachineFile)


CELLS = st.text(max_size=8) | st.floats().map(str) | st.sampled_from(["", "inf", "=A1", "1,5", '"'])


@given(cells=st.lists(CELLS, min_size=12, max_size=12), place=st.integers(0, 12))
def test_any_cells_are_machines_or_problems(cells: list[str], place: int) -> None:
    row = [*cells[:place], *ROW.split(",")[place:]]
    text = io.StringIO(newline="")
    csv.writer(text).writerows([HEADER.split(","), row, ROW.split(",")])
    if "\0" in text.getvalue():
        return
    found = rc.read_machines(text.getvalue(), SHEET)
    blank = not any(cell.strip() for cell in row)
    assert len(found.cases) + len(found.problems) == 2 - blank


# --- Results --------------------------------------------------------------------------------


def test_results_are_those_of_each_machine() -> None:
    read = rc.read_machines(with_column("journal_mass [kg]", "0", "-1", "10"))
    told: list[float] = []
    with ThreadPoolExecutor(2) as pool:
        found = rc.batch.results(read.cases, executor=pool, progress=told.append)
    assert repr(found) == repr(rc.batch.results(read.cases))  # NaN is not equal to itself
    assert told == [0.5, 1.0]
    table = rc.batch.table(found, read.problems)
    assert table["line"] == [2, 3, 4]
    for row, case in ((0, read.cases[0]), (2, read.cases[1])):
        sweep = rc.analyse(case.machine, case.speed)
        onset = rc.onset_speed(case.machine).speed
        assert table["onset [rad/s]"][row] == onset
        assert table["margin [-]"][row] == onset / case.speed - 1.0
        assert table["stiffness_XY [N/m]"][row] == sweep.stiffness[0, 1]
        assert table["unstable [-]"][row] == 0.0
        assert table["log_decrement [-]"][row] > 0.0
        critical = rc.amplification(case.machine, maximum_speed=case.speed)
        spare = list(critical.separation_margin - critical.required_margin)
        i = spare.index(min(spare))
        assert table["critical_speeds [-]"][row] == len(spare)
        assert table["critical_speed [rad/s]"][row] == critical.critical_speed[i]
        assert table["amplification_factor [-]"][row] == critical.amplification_factor[i]
        assert table["separation_margin [-]"][row] == critical.separation_margin[i]
        assert table["required_margin [-]"][row] == critical.required_margin[i]
    assert table["problem"][0] == ""
    assert "journal_mass" in table["problem"][1]
    assert math.isnan(table["onset [rad/s]"][1])


def test_a_machine_without_critical_speed_has_none_in_its_row() -> None:
    stiff = rc.read_machines(TABLE.replace("1e8", "inf"))
    [one] = rc.batch.results(stiff.cases)
    assert one.values["critical_speeds [-]"] == 0.0
    assert math.isnan(one.values["critical_speed [rad/s]"])
    assert one.refusal == ""


def test_what_has_no_answer_says_why_and_keeps_the_rest() -> None:
    heavy = (
        with_column("load [MN],film", "9,finite").replace("[MN]", "[kN]").replace(",9,", ",9e3,")
    )
    [one] = rc.batch.results(rc.read_machines(heavy).cases)
    assert "smallest film" in one.refusal
    assert one.values["onset [rad/s]"] > 0.0


def test_when_the_time_is_over_the_rest_says_so() -> None:
    cases = rc.read_machines(f"{TABLE}{ROW}\n{ROW}\n").cases
    first, *rest = rc.batch.results(cases, seconds=0.0)
    assert first.refusal == ""
    assert [one.refusal for one in rest] == ["not computed: the time of 0 s was over"] * 2


def test_what_is_written_is_read_again() -> None:
    cases = rc.read_machines(f"{TABLE}{ROW}\n".replace("\nsheet", "\n=1+1", 1)).cases
    table = rc.batch.table(rc.batch.results(cases))
    rows = list(csv.DictReader(io.StringIO(rc.batch.to_csv(table))))
    assert [row["name"] for row in rows] == ["'=1+1", "sheet"]
    records = json.loads(rc.batch.to_json(table))
    for name, column in table.items():
        if name in ("name", "validity", "problem"):
            assert [record[name] for record in records] == column
            continue
        for value, row, record in zip(column, rows, records, strict=True):
            if math.isnan(value):
                assert (row[name], record[name]) == ("", None)
            else:
                assert float(row[name]) == float(record[name]) == value
    assert records[0]["name"] == "=1+1"
    report = rc.batch.to_report(table)
    assert report.startswith("line 2: =1+1\n")
    assert "934.029 rad/s" in report


def test_what_lies_outside_the_models_range_is_said_in_words() -> None:
    # Long for a short bearing, and an imbalance orbit as large as the clearance.
    read = rc.read_machines(f"{TABLE}{ROW.replace('150,50', '150,300').replace(',12', ',300')}\n")
    good, bad = rc.batch.results(read.cases)
    checks = [one for one in rc.validity(rc.analyse(read.cases[1].machine, read.cases[1].speed))
              if one.worst != "good"]  # fmt: skip
    assert len(checks) > 1
    assert {one.worst for one in checks} == {"caution", "outside"}
    for one in checks:
        word = {"caution": "strained", "outside": "outside"}[one.worst]
        assert f"{word}: {one.name} = {float(one.value):.4g}, limit" in bad.validity
    assert good.validity == "; ".join(
        f"strained: {one.name} = {float(one.value):.4g}, limit {float(one.caution):.4g}"
        for one in rc.validity(rc.analyse(SHEET, 6000 * rc.rpm)) if one.worst != "good"
    )  # fmt: skip
    table = rc.batch.table([good, bad])
    assert table["validity"] == [good.validity, bad.validity]
    assert f"validity: {bad.validity}" in rc.batch.to_report(table)


def test_own_coefficients_have_an_unknown_validity() -> None:
    sweep = rc.analyse(SHEET, [400.0, 700.0])
    table = rc.CoefficientTable(speed=sweep.speed, stiffness=sweep.stiffness, damping=sweep.damping)
    [one] = rc.read_machines(replace(SHEET, bearing=table).to_json()).cases
    [found] = rc.batch.results([replace(one, speed=628.0)])
    assert found.validity.startswith("own coefficients")


# --- The command line -----------------------------------------------------------------------


@pytest.fixture
def machines(tmp_path: Path) -> Path:
    path = tmp_path / "machines.csv"
    path.write_text(TABLE, "utf-8")
    return path


def test_the_program_writes_a_table(machines: Path) -> None:
    command_line = [sys.executable, "-m", "rotorcalc", str(machines)]
    done = subprocess.run(command_line, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    [row] = csv.DictReader(io.StringIO(done.stdout.decode(), newline=""))
    assert float(row["onset [rad/s]"]) == rc.onset_speed(SHEET).speed


def test_a_wrong_line_ends_with_1_and_is_in_the_results(
    machines: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    machines.write_text(f"{TABLE}{ROW.replace('272', '-272')}\n", "utf-8")
    out = machines.with_suffix(".json")
    assert command.main([str(machines), "--out", str(out)]) == 1
    first, second = json.loads(out.read_text("utf-8"))
    assert first["onset [rad/s]"] == rc.onset_speed(SHEET).speed
    assert second["problem"] == capsys.readouterr().err.strip()
    assert second["problem"].startswith("line 3, column mass [kg]: mass = -272.1422 kg")


def test_half_a_character_in_a_name_costs_nothing(machines: Path) -> None:
    document = json.loads(SHEET.to_json()) | {"app": {"name": "\ud800"}}
    machines.write_text(json.dumps(document), "utf-8")
    out = machines.with_suffix(".txt")
    assert command.main([str(machines), "--out", str(out)]) == 0
    assert out.read_text("utf-8").startswith("line 1: \\ud800\n")


def test_tolerances_from_the_command_line(machines: Path, tmp_path: Path) -> None:
    spreads = {"radial_clearance [µm]": ["uniform", 50, 80], "temperature [°F]": ["normal", 140, 9]}
    (tmp_path / "spreads.json").write_text(json.dumps(spreads), "utf-8")
    options = ["--tolerance", str(tmp_path / "spreads.json"), "--samples", "300", "--seed", "5"]
    out = tmp_path / "out.json"
    assert command.main([str(machines), *options, "--out", str(out)]) == 0
    [found] = json.loads(out.read_text("utf-8"))
    si = {"radial_clearance": ("uniform", 50e-6, 80e-6), "temperature": ("normal", 60.0, 5.0)}
    expected = rc.tolerance(SHEET, si, 300, 5, speed=6000 * rc.rpm)
    middle = np.quantile(expected.onset, 0.5, method="inverted_cdf")
    assert found["onset_quantile_0.5 [rad/s]"] == pytest.approx(middle, rel=1e-9)
    [plain] = rc.batch.results(rc.read_machines(machines.read_text("utf-8")).cases)
    assert found["validity"] == plain.validity != ""
    index = {one.field: one.index for one in expected.influences}
    assert found["influence_temperature [-]"] == pytest.approx(index["temperature"], abs=1e-9)


@pytest.mark.parametrize("error", [ValueError, RuntimeError])
def test_a_study_is_kept_where_the_nominal_machine_has_no_onset(
    error: type[Exception], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuses(_: rc.Machine) -> None:
        raise error("no answer")

    module = importlib.import_module("rotorcalc.batch.results")
    spread = module.Spread({"temperature": ("normal", 60.0, 5.0)}, 100, 5)
    whole = module.tolerance_result(only(TABLE), spread)
    monkeypatch.setattr(module, "onset_speed", refuses)
    found = module.tolerance_result(only(TABLE), spread)
    assert found.values == whole.values != {}
    assert found.refusal == ""


def test_of_many_refused_samples_the_first_is_told_and_how_many_more(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    module = importlib.import_module("rotorcalc.batch.results")
    drawn = rc.tolerance(SHEET, {"temperature": ("normal", 60.0, 5.0)}, 100, 5, speed=600.0)
    told = tuple(f"at {number} rpm no answer" for number in range(99))
    monkeypatch.setattr(module, "tolerance", lambda *_, **__: replace(drawn, refusals=told))
    spread = module.Spread({}, 100, 5)
    assert module.tolerance_result(only(TABLE), spread).refusal == (
        "at 0 rpm no answer; and 98 more"
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["nowhere.csv"], "No such file"),
        (["FILE", "--base", "FILE"], "no JSON text"),
        (["FILE", "--tolerance", "FILE"], "no JSON text"),
        (["FILE", "--out", "/nowhere/out.csv"], "No such file"),
    ],
)
def test_what_cannot_be_used_ends_with_2(
    arguments: list[str], words: str, machines: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    given = [str(machines) if one == "FILE" else one for one in arguments]
    assert command.main(given) == 2
    assert words in capsys.readouterr().err


@pytest.mark.parametrize(
    ("spreads", "words"),
    [
        ({"name": ["uniform", 1, 2]}, "is no number of a machine"),
        ({"speed [rpm]": ["uniform", 1, 2]}, "is no number of a machine"),
        ({"load [N]": "uniform"}, "must be a list"),
        ({"load [N]": ["uniform", "1", 2]}, "must have numbers after its name"),
        ({"load": ["uniform", 1, 2]}, "has no unit"),
    ],
)
def test_wrong_spreads_end_with_2(
    spreads: dict, words: str, machines: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = machines.with_suffix(".json")
    path.write_text(json.dumps(spreads), "utf-8")
    assert command.main([str(machines), "--tolerance", str(path)]) == 2
    assert words in capsys.readouterr().err


@pytest.mark.parametrize("options", [[], ["FILE", "--speed", "-1"], ["FILE", "--processes", "0"]])
def test_a_wrong_command_is_explained(
    options: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        command.main(options)
    assert ended.value.code == 2
    assert "usage:" in capsys.readouterr().err


def test_progress_is_for_a_terminal_alone(
    machines: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command.main([str(machines), "--out", str(machines.with_suffix(".txt"))]) == 0
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    assert command.main([str(machines), "--out", str(machines.with_suffix(".txt"))]) == 0
    assert capsys.readouterr().err == "\r100 % done\n"
    assert machines.with_suffix(".txt").read_text("utf-8").startswith("line 2: sheet\n")
