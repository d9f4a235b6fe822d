"""The files that leave the program: each is read back and compared with what it was made from."""

import csv
import io
import json
import math
import re
import zipfile
from functools import cache
from html.parser import HTMLParser
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from rotorcalc import __version__
from rotorcalc.figures.cases import COLOURS
from rotorcalc.onset import whirl
from rotorcalc.units import SI, US, Units, with_amplitudes
from ui.cases import Case, Shown
from ui.computed import Computed, computed_from
from ui.format import digits
from ui.inputs import PRESET_VALUES, Values, inputs_of, values_of
from ui.results.table import RESULTS
from ui.sharing import export, report, report_charts
from ui.sharing.labels import Labels
from ui.sharing.report_charts import sections
from ui.words import validity, verdict

LABELS = Labels("Pump 3", "Trip at 80 µm.\n<b>&", "Survey of the boiler feed pumps", "A. Nother")
LINK = 'https://host.example/Stability?preset=sheet-1e7&C=80&u="><script>alert(1)</script>'
DEFAULT = PRESET_VALUES["sheet-1e8"]
CASES: dict[str, Values] = {
    **PRESET_VALUES,
    "no load": DEFAULT | {"load": 0.0},
    "rigid": DEFAULT | {"k": math.inf},
    "no onset": DEFAULT | {"cs": 1e5},
    "no imbalance": DEFAULT | {"u": 0.0},
    "journal mass and damping": DEFAULT | {"mj": 20.0, "cs": 2000.0},
    "slow": DEFAULT | {"rpm": 100.0},
}
every_case = pytest.mark.parametrize("case", CASES)
either_system = pytest.mark.parametrize(
    "units",
    [SI, US, with_amplitudes(US, "p-p")],
    ids=lambda units: f"{units.name} {units.amplitude.name}",
)


def computed(case: str) -> Computed:
    return computed_from(CASES[case])


def kept(case: str) -> Shown:
    return Shown(Case("Kept", CASES[case], COLOURS[0]), computed(case))


def sheet(case: str, units: Units) -> tuple[list[str], np.ndarray]:
    text = export.sweep_csv(computed(case), units).decode("utf-8-sig")
    lines = [line for line in text.splitlines() if not line.startswith(("#", '"#'))]
    header, *rows = csv.reader(lines)
    return header, np.array(rows, dtype=float)


def test_cases_match_their_names() -> None:
    assert computed("no load").unloaded
    assert computed("rigid").machine.rotor.is_rigid
    assert math.isinf(computed("no onset").onset.speed)


# CSV


def test_csv_begins_with_the_byte_order_mark_that_excel_needs() -> None:
    assert export.sweep_csv(computed("rigid"), SI).startswith(b"\xef\xbb\xbf")


@every_case
@either_system
def test_csv_agrees_with_the_sweep(case: str, units: Units) -> None:
    header, numbers = sheet(case, units)
    sweep = computed(case).sweep
    lag = {"Disk": sweep.disk_response, "Journal": sweep.journal_response}
    expected = {
        f"Running speed Ω [{units.speed.name}]": units.speed.of(sweep.speed),
        "Modified Sommerfeld number σ [-]": sweep.sommerfeld,
        "Attitude angle φ [°]": np.degrees(sweep.attitude_angle),
        f"Smallest film h_min [{units.film.name}]": units.film.of(sweep.minimum_film_thickness),
        f"Stiffness K_XY [{units.stiffness.name}]": units.stiffness.of(sweep.stiffness[:, 0, 1]),
        f"Stiffness K_YX [{units.stiffness.name}]": units.stiffness.of(sweep.stiffness[:, 1, 0]),
        f"Damping C_YY [{units.damping.name}]": units.damping.of(sweep.damping[:, 1, 1]),
        f"Critical mass per bearing of the rigid rotor M_c [{units.mass.name}]": units.mass.of(
            sweep.critical_mass
        ),
        f"Threshold of the flexible rotor Ω_sf [{units.speed.name}]": units.speed.of(
            sweep.flexible_threshold
        ),
    } | {
        f"{part}: amplitude |Y| [{units.amplitude.name}]": units.amplitude.of(abs(response[:, 1]))
        for part, response in lag.items()
    }
    for name, values in expected.items():
        np.testing.assert_allclose(numbers[:, header.index(name)], values, rtol=1e-9)


@every_case
def test_csv_has_a_unit_in_every_header_and_names_no_column_twice(case: str) -> None:
    header, numbers = sheet(case, SI)
    assert all(re.fullmatch(r"[^\[\]]+ \[[^\[\]]+\]", name) for name in header)
    assert len(set(header)) == len(header) == numbers.shape[1]


def test_csv_follows_the_units_shown() -> None:
    (si, in_si), (us, in_us) = sheet("sheet-1e8", SI), sheet("sheet-1e8", US)
    column = si.index("Smallest film h_min [µm]")
    assert us[column] == "Smallest film h_min [mil]"
    np.testing.assert_allclose(in_us[:, column] * 25.4, in_si[:, column], rtol=1e-9)


def test_csv_and_report_say_how_amplitudes_are_read() -> None:
    twice = with_amplitudes(SI, "p-p")
    (zero, in_zero), (peak, in_peak) = sheet("sheet-1e8", SI), sheet("sheet-1e8", twice)
    amplitudes = [i for i, name in enumerate(zero) if name.endswith("[µm 0-p]")]
    assert len(amplitudes) == 8  # |X|, |Y| and two semi-axes of disk and journal
    assert [peak[i].replace("p-p", "0-p") for i in amplitudes] == [zero[i] for i in amplitudes]
    np.testing.assert_allclose(in_peak[:, amplitudes], 2.0 * in_zero[:, amplitudes], rtol=1e-9)
    rest = [i for i in range(len(zero)) if i not in amplitudes]
    np.testing.assert_array_equal(in_peak[:, rest], in_zero[:, rest])
    for units, said, other in ((SI, "0-p", "p-p"), (twice, "p-p", "0-p")):
        page = report.report(computed("sheet-1e8"), [], units, LINK, LABELS).decode()
        numbers = re.findall(r"[\d.]+ µm (0-p|p-p)", page)
        assert set(numbers) == {said}
        assert len(numbers) >= 2
        assert f"Amplitude [µm {said}]" in page
        assert f"Amplitude [µm {other}]" not in page


@pytest.mark.parametrize("case", ["sheet-1e8", "rigid", "journal mass and damping"])
def test_csv_holds_every_eigenvalue_of_the_sweep(case: str) -> None:
    header, numbers = sheet(case, SI)
    for name, values in (
        ("Mode", computed(case).sweep.flexible_eigenvalues),
        ("Rigid rotor, mode", computed(case).sweep.rigid_eigenvalues),
    ):
        if name == "Mode" and case == "rigid":
            assert not any(title.startswith("Mode ") for title in header)
            continue
        columns = [i for i, title in enumerate(header) if title.startswith(f"{name} ")]
        found = numbers[:, columns[::2]] + 1j * numbers[:, columns[1::2]]
        # Of two that are mirror images the upper one is there, at some speeds in another column.
        both = np.nan_to_num(np.concatenate([found, found.conj()], axis=1), nan=np.inf)
        apart = abs(both[:, :, None] - values[:, None, :])
        assert np.all(apart.min(axis=1) <= 1e-9 * abs(values))
        assert not np.any(found.imag < 0.0)


def test_csv_writes_nan_and_infinity_as_python_reads_them() -> None:
    text = export.sweep_csv(computed("no load"), SI).decode("utf-8-sig")
    assert ",inf," in text
    still = export.sweep_csv(computed("no imbalance"), SI).decode("utf-8-sig")
    assert ",0,nan," in still  # nothing moves, so nothing lags
    header, numbers = sheet("sheet-1e8", SI)
    missing = {
        name for name, column in zip(header, numbers.T, strict=True) if np.isnan(column).any()
    }
    # A mode is blank where it is the mirror image of another.
    assert all("mode" in name.lower() for name in missing)


@either_system
def test_csv_begins_with_inputs_and_onset(units: Units) -> None:
    text = export.sweep_csv(computed("rigid"), units).decode("utf-8-sig")
    head = dict(row for row in csv.reader(text.splitlines()) if row[0].startswith("#"))
    for item in inputs_of(PRESET_VALUES["sheet-1e8"]).values():
        assert f"# {item.name(units)}" in head
    load = float(head[f"# Load per bearing Fₒ [{units.force.name}]"])
    assert load == pytest.approx(units.force.of(computed("rigid").machine.static_load), rel=1e-5)
    assert head["# The load is"] == "half the weight"
    assert head["# Shaft stiffness Kᵣₒₜ" + f" [{units.shaft_stiffness.name}]"] == "rigid"
    onset = float(head["# Onset of whirl [rpm]"])
    assert onset == pytest.approx(units.speed.of(computed("rigid").onset.speed), rel=1e-9)


def test_csv_numbers_modes_as_the_page_does() -> None:
    header, numbers = sheet("sheet-1e8", SI)
    shown = computed("sheet-1e8").locus(True)
    for mode, branch in enumerate(shown.branches.T, start=1):
        frequency = numbers[:, header.index(f"Mode {mode}: whirl frequency Im λ [1/s]")]
        np.testing.assert_allclose(frequency, branch.imag, rtol=1e-9)


# ROSS


@cache
def ross_rows(case: str) -> list[list[str | float]]:
    """Read the workbook's sheet as any reader of Office Open XML would."""
    with zipfile.ZipFile(io.BytesIO(export.ross_table(computed(case)))) as package:
        parts = {name: ET.fromstring(package.read(name)) for name in package.namelist()}  # noqa: S314
    space = {"s": "http://schemas.openxmlformats.org/spreadsheetml/2006/main"}
    cells = [
        row.findall("s:c", space)
        for row in parts["xl/worksheets/sheet1.xml"].iter(f"{{{space['s']}}}row")
    ]
    return [
        [
            "".join(cell.itertext())
            if cell.get("t") == "inlineStr"
            else float("".join(cell.itertext()))
            for cell in row
        ]
        for row in cells
    ]


def ross_table(case: str) -> dict[str, np.ndarray]:
    """Return the columns below the header, which is the row with the word kxx, as ROSS finds it."""
    rows = ross_rows(case)
    at = next(i for i, row in enumerate(rows) if "kxx" in row)
    numbers = [row for row in rows[at + 1 :] if isinstance(row[1], float)]
    return dict(zip(map(str, rows[at]), np.array(numbers).T, strict=True))


def in_our_axes(table: dict[str, np.ndarray], letter: str) -> np.ndarray:
    """Undo the change of axes: X = −y, Y = x."""
    xx, xy, yx, yy = (table[letter + ij] for ij in ("xx", "xy", "yx", "yy"))
    return np.stack([yy, -yx, -xy, xx], axis=-1).reshape(-1, 2, 2)


@every_case
def test_ross_table_turned_back_is_the_sweep(case: str) -> None:
    table, sweep = ross_table(case), computed(case).sweep
    np.testing.assert_array_equal(table["speed"], sweep.speed)
    np.testing.assert_array_equal(in_our_axes(table, "k"), sweep.stiffness)
    np.testing.assert_array_equal(in_our_axes(table, "c"), sweep.damping)


def test_ross_axes_are_a_rotation() -> None:
    K = computed("sheet-1e8").point.stiffness
    turned = export.ross_axes(K)
    # Whirl does not know how its axes lie, but knows in which sense the shaft turns: a mirrored
    # matrix has the other sign of k_xy − k_yx.
    assert turned[0, 1] - turned[1, 0] == pytest.approx(K[0, 1] - K[1, 0], rel=1e-15)
    C = computed("sheet-1e8").point.damping
    ours = whirl.whirl_onset(K, C)
    theirs = whirl.whirl_onset(turned, export.ross_axes(C))
    assert theirs.whirl_ratio == pytest.approx(ours.whirl_ratio, rel=1e-12)
    assert theirs.critical_mass == pytest.approx(ours.critical_mass, rel=1e-12)


def test_ross_axes_agree_with_the_textbook_that_ross_follows() -> None:
    """Friswell et al., example 5.5.1: x horizontal, y vertical; MN/m, printed to four digits."""
    K = export.ross_axes(computed("friswell-5-5-1").point.stiffness) / 1e6
    np.testing.assert_allclose(K, [[12.81, 16.39], [-25.06, 8.815]], rtol=5e-4)


def test_ross_sheet_has_no_unit_that_ross_would_misread() -> None:
    words = " ".join(
        cell for row in ross_rows("sheet-1e8") for cell in row if isinstance(cell, str)
    )
    for trigger in ("lb", "lbm", "inches", "rpm"):
        assert trigger not in words.lower()
    for stated in ("kxx = K_YY", "x = Y, y = -X", "rad/s", "N/m", "N*s/m"):
        assert stated in words


def test_ross_table_is_the_same_file_each_time() -> None:
    assert export.ross_table(computed("rigid")) == export.ross_table(computed("rigid"))


# Report


class Reader(HTMLParser):
    """A page's text outside scripts and styles, its scripts, its tags with their attributes."""

    VOID = frozenset({"meta", "br", "hr", "img", "link", "input"})

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.text: list[str] = []
        self.scripts: list[str] = []
        self.feed(page)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        inside = self.open[-1] if self.open else ""
        if inside == "script":
            self.scripts.append(data)
        elif inside != "style":
            self.text.append(data)


@cache
def read(case: str, pinned: str | None, units_name: str = "SI") -> Reader:
    beside = [] if pinned is None else [kept(pinned)]
    page = report.report(computed(case), beside, {"SI": SI, "US": US}[units_name], LINK, LABELS)
    return Reader(page.decode())


compared = pytest.mark.parametrize("pinned", [None, "sheet-1e7"])


@every_case
@compared
def test_report_is_complete_and_shows_no_nan(case: str, pinned: str | None) -> None:
    page = read(case, pinned)
    text = " ".join(page.text)
    assert not re.search(r"\b(nan|None|Traceback)\b", text)
    assert __version__ in text
    assert text.count("Eq. 5.") > 10
    ids = [attributes["id"] for _, attributes in page.tags if "id" in attributes]
    assert ids == [
        figure.key for figures in sections(computed(case)).values() for figure in figures
    ]


@every_case
@either_system
def test_report_shows_every_input_and_result(case: str, units: Units) -> None:
    text = read(case, None, units.name).text
    shown = computed(case)
    values = values_of(shown.machine, shown.speed, shown.top_speed)
    for key, item in inputs_of(values).items():
        value = values[key]
        assert item.label in text
        if value is not None and math.isfinite(value):
            assert _as_read(f"{item.shown(value, units):.6g}") in text
    for result in RESULTS.values():
        assert (result.label in text) == result.belongs(shown)


def _as_read(number: str) -> str:
    """Return a number as people write it: 1.5·10⁸, −2."""
    digits, _, exponent = number.partition("e")
    raised = f"{int(exponent or 0)}".translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return (f"{digits}·10{raised}" if exponent else digits).replace("-", "−")


@every_case
def test_the_sweeps_file_says_of_the_model_what_the_page_says(case: str) -> None:
    text = export.sweep_csv(computed(case), SI).decode("utf-8-sig")
    [said] = [row for row in csv.reader(io.StringIO(text)) if row[0].startswith("# Model")]
    assert said == ["# Model at the running speed", validity.headline(computed(case))]


@every_case
def test_the_reports_headline_says_of_the_model_what_the_page_says(case: str) -> None:
    shown = computed(case)
    said = " ".join(read(case, None).text)
    headline = validity.headline(shown)
    assert f"{headline}." in said[: said.index("Inputs")]
    page = verdict.text(shown, SI).words
    assert headline in page
    for words in ("lie outside the model's range.", "Coarse mesh"):
        assert (words in page) == (words in said[: said.index("Inputs")])


def test_report_has_title_case_author_and_remarks_as_they_were_written() -> None:
    text = read("sheet-1e8", None).text
    for words in (LABELS.title, f" {LABELS.name}", f" {LABELS.author}", f" {LABELS.note}"):
        assert words in text
    plain = Reader(report.report(computed("rigid"), [], SI, LINK, Labels()).decode()).text
    assert "Rotor on two journal bearings" in plain
    assert "Author:" not in plain


def test_report_holds_coefficients_over_speed() -> None:
    text, sweep = read("sheet-1e8", None).text, computed("sheet-1e8").sweep
    start = text.index("Force coefficients over speed")
    for matrix, unit in ((sweep.stiffness, SI.stiffness), (sweep.damping, SI.damping)):
        for i in (11, 239):
            value = float(unit.of(matrix[i, 0, 1]))
            assert digits(value).replace("-", "−") in text[start:]


def test_report_names_rigid_shaft_weight_and_missing_onset() -> None:
    assert "rigid" in read("rigid", None).text
    text = read("sheet-1e8", None).text
    assert text[text.index("N, half the weight") - 1].startswith("1334.")
    assert "no limit" in read("no onset", None).text


def test_report_typesets_symbols_and_powers() -> None:
    page = report.report(computed("sheet-1e8"), [], SI, LINK, LABELS).decode()
    assert "<i>K<sub>XY</sub></i> [MN/m]" in page
    assert ">1·10⁸<" in page
    tables = page[page.index("<h2>Inputs") : page.index("<figure")]
    assert not re.search(r"\de[+-]\d|\bK_?XX", tables)


def test_report_stands_names_of_cases_beside_the_others() -> None:
    one = computed("sheet-1e8")
    for chart in report_charts.charts(one, [kept("sheet-1e7")], SI).values():
        # Else Plotly gives each group of a legend a column, and the first has all other names.
        assert chart["layout"]["legend"]["traceorder"] == "normal"


def test_report_compares_cases_where_they_differ() -> None:
    text = read("sheet-1e8", "sheet-1e7").text
    assert text.count("1·10⁷") == 1
    assert text.count("17.2369") == 1  # the same in both, so once
    assert "Kept" in text
    assert "1·10⁷" not in read("sheet-1e8", None).text
    assert "Kept" not in read("sheet-1e8", None).text


def test_report_loads_nothing_from_the_network() -> None:
    page = read("sheet-1e8", "sheet-1e7")
    names = [tag for tag, _ in page.tags]
    assert not {"link", "img", "iframe", "object", "embed", "base", "source"} & set(names)
    assert not any("src" in attributes or "srcset" in attributes for _, attributes in page.tags)
    policy = next(a["content"] for t, a in page.tags if t == "meta" and "http-equiv" in a)
    assert policy is not None
    assert policy.startswith("default-src 'none'")


def test_report_escapes_the_link() -> None:
    page = read("sheet-1e8", None)
    anchors = [attributes for tag, attributes in page.tags if tag == "a"]
    assert anchors == [{"href": LINK}]
    assert LINK in page.text
    assert len(page.scripts) == len([tag for tag, _ in page.tags if tag == "script"]) == 2


def test_report_links_web_addresses_only() -> None:
    page = report.report(computed("rigid"), [], SI, "javascript:alert(1)", Labels()).decode()
    reader = Reader(page)
    assert not any(tag == "a" for tag, _ in reader.tags)
    assert "javascript:alert(1)" in reader.text


def test_tables_escape_what_they_show() -> None:
    assert report._row([("<b>&", "")]) == "<tr><td>&lt;b&gt;&amp;</td></tr>"


def test_charts_cannot_close_the_script_that_contains_them() -> None:
    script = report._script({"x": {"data": [], "layout": {"title": {"text": "</script><b>"}}}})
    assert "<" not in script
    assert json.loads(script)["x"]["layout"]["title"]["text"] == "</script><b>"


@every_case
@compared
def test_charts_have_no_controls_and_fit_the_page(case: str, pinned: str | None) -> None:
    script = read(case, pinned).scripts[-1]
    start = script.index("{", script.index("Object.entries"))
    charts, _ = json.JSONDecoder().raw_decode(script[start:])
    for chart in charts.values():
        assert chart["layout"]["width"] <= 680
        assert not {"sliders", "updatemenus"} & chart["layout"].keys()
        assert chart["data"]
