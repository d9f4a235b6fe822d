"""A visitor's own coefficients in a browser: uploaded, seen, used, and then the machine's."""

import re
from pathlib import Path

from playwright.sync_api import expect

from tests.browser.app_page import AppPage
from tests.coefficient_files.tables import NAMES, ROWS, excel


def test_a_workbook_is_shown_and_used_and_a_broken_one_changes_nothing(
    app: AppPage, tmp_path: Path
) -> None:
    good, broken = tmp_path / "mine.xlsx", tmp_path / "broken.csv"
    units = ("rpm", *["N/m"] * 4, *["N*s/m"] * 4)
    good.write_bytes(excel(("Speed", *NAMES), units, *ROWS))
    broken.write_text("rpm kxx cxx\n1000 1e8 1e5\n2000 many 1e5\n", encoding="utf-8")
    app.open("Your data", load_axis="+x")
    verdict = app.page.locator(".st-key-said_verdict")
    before = verdict.inner_text()
    with app.run():
        app.page.locator("input[type=file]").first.set_input_files(broken)
    expect(app.page.get_by_text("line 3, column 2 (K_xx): 'many' is no number")).to_be_visible()
    with app.run():
        app.page.locator("input[type=file]").first.set_input_files(good)
    expect(app.page.get_by_text("Read: 3 speeds from 3000 rpm to 9000 rpm")).to_be_visible()
    assert verdict.inner_text() == before
    with app.run():
        app.page.get_by_role("button", name="Use these coefficients").click()
    expect(verdict).not_to_have_text(before)
    expect(verdict).to_have_text(re.compile(r"rpm"))
    expect(app.page.get_by_role("button", name="In use")).to_be_disabled()
    expect(app.page.get_by_text("In use: they are this machine's bearing")).to_be_visible()
    # The slider's track ends where the coefficients do, on this page too.
    ends = app.page.locator(".live-slider", has=app.page.get_by_label("Running speed")).first
    expect(ends.locator("div span").last).to_have_text("9000")
    app.go("Coefficients")
    expect(app.page.locator(".js-plotly-plot").first).to_be_visible()
    assert app.faults == []
