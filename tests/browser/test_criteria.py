"""The page Criteria in a browser: a grade sets the imbalance, undo takes it back, all follows."""

import json
import re

from playwright.sync_api import expect

from tests.browser.app_page import AppPage


def test_a_grade_sets_the_imbalance_which_undo_takes_back(app: AppPage) -> None:
    app.open("Criteria", slowest="5000")
    answer, rows = app.page.locator(".st-key-said_criteria"), app.page.locator(".criteria tbody tr")
    expect(answer).to_contain_text("From 5000 to 6000 rpm: distance of the mass centre")
    expect(rows.last).to_contain_text("✗ not met")
    box = app.page.locator(".criteria tbody tr").first.bounding_box()
    assert box is not None
    assert box["y"] < 500
    with app.run():
        app.page.get_by_role("combobox", name=re.compile("Balance grade")).click()
        app.page.get_by_role("option", name="G 2.5").click()
    expect(rows.last).to_contain_text("ISO 21940-11, G 2.5")
    with app.run():
        app.page.get_by_role("button", name="Set the imbalance").click()
    expect(rows.last).to_contain_text("✓ met")
    assert app.query() == {"slowest": "5000", "grade": "G 2.5", "u": "3.97887"}
    with app.run():
        app.page.get_by_role("button", name="Undo", exact=True).click()
    expect(rows.last).to_contain_text("✗ not met")
    assert app.query() == {"slowest": "5000", "grade": "G 2.5"}
    # A number of the page's own, and the machine's sliders.
    with app.run():
        app.page.get_by_role("textbox", name=re.compile("Minimum speed")).fill("4000")
        app.page.keyboard.press("Enter")
    expect(answer).to_contain_text("From 4000 to 6000 rpm")
    app.press("Running speed", "PageUp")
    expect(answer).not_to_contain_text("to 6000 rpm")
    # What is handed in is what was asked.
    app.open_popover("Share and keep")
    with app.page.expect_download() as started:
        app.page.get_by_role("button", name="Machine (JSON)").click()
    kept = json.loads(started.value.path().read_text(encoding="utf-8"))
    assert kept["app"]["criteria"]["grade"] == "G 2.5"
