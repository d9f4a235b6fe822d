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


@pytest.fixture
def shared(app: AppPage) -> AppPage:
    """The app with the machine of the link, its files at hand."""
    app.open("Machine", **LINK)
    app.open_popover("Share and keep")
    return app


def test_machine_file_loads_back(shared: AppPage, stranger: AppPage, tmp_path: Path) -> None:
    saved = shared.save("Machine (JSON)", tmp_path)
    machine = Machine.from_json(saved.read_text(encoding="utf-8"))
    assert machine.bearing.radial_clearance == pytest.approx(81.3e-6, rel=1e-14)
    assert machine.load == 1234.5

    stranger.open("Machine")
    body = stranger.open_popover("Share and keep")
    with stranger.run():
        body.locator("input[type=file]").set_input_files(saved)
    expect(stranger.page.get_by_test_id("stMain").get_by_test_id("stAlert")).to_have_count(1)
    again = Machine.from_json(
        stranger.save("Machine (JSON)", _below(tmp_path)).read_text(encoding="utf-8")
    )
    assert again == machine


def _below(folder: Path) -> Path:
    below = folder / "again"
    below.mkdir()
    return below


def test_a_file_without_a_machine_gets_a_message(shared: AppPage, tmp_path: Path) -> None:
    broken = tmp_path / "broken.json"
    broken.write_text(json.dumps({"version": 1, "oil": "olive"}))
    with shared.run():
        shared.page.get_by_test_id("stPopoverBody").locator("input[type=file]").set_input_files(
            broken
        )
    expect(shared.page.get_by_text("broken.json").first).to_be_visible()
    assert shared.query() == LINK


def test_sweep_is_a_table_with_units(shared: AppPage, tmp_path: Path) -> None:
    saved = shared.save("Sweep over speed", tmp_path)
    machine = Machine.from_json(shared.save("Machine (JSON)", tmp_path).read_text("utf-8"))
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


def test_ross_table_has_stiffness_and_damping_in_its_axes(shared: AppPage, tmp_path: Path) -> None:
    machine = Machine.from_json(shared.save("Machine (JSON)", tmp_path).read_text("utf-8"))
    rows = _sheet(shared.save("K and C for ROSS", tmp_path))
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


def test_report_opens_by_itself(shared: AppPage, desk: BrowserContext, tmp_path: Path) -> None:
    saved = shared.save("Report (HTML)", tmp_path)
    tab = AppPage(desk.new_page(), shared.url)
    requests: list[str] = []
    tab.page.on("request", lambda request: requests.append(request.url))
    tab.page.goto(saved.as_uri())
    expect(tab.page.locator(".js-plotly-plot .main-svg").first).to_be_visible()
    text = tab.page.locator("body").inner_text()
    drawn = tab.drawn()
    tab.page.emulate_media(media="print")
    tab.page.pdf(path=tmp_path / "report.pdf")
    tab.page.close()
    assert tab.faults == []
    assert [url for url in requests if not url.startswith(("file:", "data:", "blob:"))] == []
    for words in ("81.3", "3000 rpm", "1234", "Eq. 5.", "rotorcalc", "C=81.3"):
        assert words in text, words
    assert drawn
    assert (tmp_path / "report.pdf").read_bytes().startswith(b"%PDF")
