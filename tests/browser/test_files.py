"""Files to take along: each opens, and holds the machine that was on the screen."""

import csv
import json
import zipfile
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from playwright.sync_api import BrowserContext, expect

from rotorcalc import Machine, analyse, onset_speed
from tests.browser.app_page import AppPage

LINK = {"preset": "sheet-1e7", "C": "81.3", "rpm": "3000", "load": "1234.5"}


def test_each_file_holds_the_machine_of_the_link(
    app: AppPage, elsewhere: AppPage, desk: BrowserContext, tmp_path: Path
) -> None:
    app.open("Machine", **LINK)
    app.open_popover("Share and keep")
    saved = app.save("Machine (JSON)", tmp_path)
    machine = Machine.from_json(saved.read_text(encoding="utf-8"))
    assert machine.bearing.radial_clearance == pytest.approx(81.3e-6, rel=1e-14)
    assert machine.load == 1234.5
    _sweep_is_a_table_with_units(app.save("Sweep over speed", tmp_path), machine)
    _ross_table_has_its_axes(app.save("K and C for ROSS", tmp_path), machine)
    _report_opens_by_itself(app.save("Report (HTML)", tmp_path), AppPage(desk.new_page(), app.url))
    _refuses_a_file_without_a_machine(app, tmp_path / "broken.json")
    _takes_the_file(elsewhere, saved, machine, tmp_path)


def _takes_the_file(elsewhere: AppPage, saved: Path, machine: Machine, folder: Path) -> None:
    elsewhere.open("Notes")
    body = elsewhere.open_popover("Share and keep")
    with elsewhere.run():
        body.locator("input[type=file]").set_input_files(saved)
    expect(elsewhere.page.get_by_test_id("stMain").get_by_test_id("stAlert")).to_have_count(1)
    again = Machine.from_json(
        elsewhere.save("Machine (JSON)", _below(folder)).read_text(encoding="utf-8")
    )
    assert again == machine


def _below(folder: Path) -> Path:
    below = folder / "again"
    below.mkdir()
    return below


def _refuses_a_file_without_a_machine(app: AppPage, broken: Path) -> None:
    broken.write_text(json.dumps({"version": 1, "oil": "olive"}))
    with app.run():
        app.page.get_by_test_id("stPopoverBody").locator("input[type=file]").set_input_files(broken)
    expect(app.page.get_by_text("broken.json").first).to_be_visible()
    assert app.query() == LINK


def _sweep_is_a_table_with_units(saved: Path, machine: Machine) -> None:
    with saved.open(encoding="utf-8-sig", newline="") as file:
        lines = list(csv.reader(file))
    given = dict(line for line in lines if line[0].startswith("# "))
    assert given["# Radial clearance C [µm]"] == "81.3"
    onset = onset_speed(machine).speed * 30 / np.pi
    assert float(given["# Onset of whirl [rpm]"]) == pytest.approx(onset, rel=1e-8)
    head, *rows = lines[len(given) :]
    assert all("[" in name and name.endswith("]") for name in head)
    table = np.array(rows, dtype=float)
    column = {name: table[:, i] for i, name in enumerate(head)}
    sweep = analyse(machine, column["Running speed Ω [rpm]"] * np.pi / 30)
    np.testing.assert_allclose(
        column["Eccentricity ratio ε [-]"], sweep.eccentricity_ratio, rtol=1e-8
    )
    np.testing.assert_allclose(
        column["Stiffness K_XY [MN/m]"] * 1e6, sweep.stiffness[:, 0, 1], rtol=1e-8
    )


def _ross_table_has_its_axes(saved: Path, machine: Machine) -> None:
    rows = _sheet(saved)
    start = next(i for i, row in enumerate(rows) if "kxx" in [str(cell).lower() for cell in row])
    head = [str(cell).lower() for cell in rows[start]]
    table = np.array(
        [row for row in rows[start + 1 :] if all(isinstance(cell, float) for cell in row)]
    )
    column = {name: table[:, i] for i, name in enumerate(head)}
    sweep = analyse(machine, column["speed"])
    for name, sign, (i, j) in (
        ("xx", 1, (1, 1)), ("xy", -1, (1, 0)), ("yx", -1, (0, 1)), ("yy", 1, (0, 0)),
    ):  # fmt: skip
        np.testing.assert_allclose(column[f"k{name}"], sign * sweep.stiffness[:, i, j], rtol=1e-12)
        np.testing.assert_allclose(column[f"c{name}"], sign * sweep.damping[:, i, j], rtol=1e-12)


def _sheet(path: Path) -> list[list[str | float]]:
    """Return the rows of a workbook's only sheet."""
    space = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
    with zipfile.ZipFile(path) as file:
        sheet = ET.fromstring(file.read("xl/worksheets/sheet1.xml"))  # noqa: S314
    return [
        [
            "".join(cell.itertext()) if cell.get("t") else float("".join(cell.itertext()))
            for cell in row
        ]
        for row in sheet.iter(f"{space}row")
    ]


def _report_opens_by_itself(saved: Path, tab: AppPage) -> None:
    requests: list[str] = []
    tab.page.on("request", lambda request: requests.append(request.url))
    tab.page.goto(saved.as_uri())
    expect(tab.page.locator(".js-plotly-plot .main-svg").first).to_be_visible()
    text = tab.page.locator("body").inner_text()
    drawn = tab.drawn()
    tab.page.emulate_media(media="print")
    printed = tab.page.pdf()
    tab.page.close()
    assert tab.faults == []
    assert [url for url in requests if not url.startswith(("file:", "data:", "blob:"))] == []
    for words in ("81.3", "3000 rpm", "1234", "Eq. 5.", "rotorcalc", "C=81.3"):
        assert words in text, words
    assert drawn
    assert printed.startswith(b"%PDF")
