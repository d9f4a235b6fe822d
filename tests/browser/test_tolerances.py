"""A study in the browser: drawn on request, kept with its machine, all of it in its file."""

import csv
import io
from pathlib import Path

from playwright.sync_api import expect

from tests.browser.app_page import AppPage


def test_a_study_is_drawn_says_whose_it_is_and_is_taken_along(app: AppPage, tmp_path: Path) -> None:
    app.open("Tolerances", film="finite", rpm="8700")
    page = app.page
    expect(app.charts()).to_have_count(0)
    with app.run():
        page.get_by_label("Machines drawn").fill("60")
        page.keyboard.press("Enter")
    with app.run():
        page.get_by_label("Low [µm]").fill("55")
        page.keyboard.press("Enter")
    assert app.query()["spreads"] == "C~uniform~55~69~~T~uniform~56~64"
    with app.run():
        page.get_by_role("button", name="Draw", exact=True).click()
    said = page.get_by_text("of the machines drawn are unstable at 8700 rpm")
    expect(said).to_contain_text("60 drawn, seed 1")
    words = said.inner_text()
    expect(app.charts()).to_have_count(4)
    app.press("Radial clearance", "ArrowRight")
    earlier = page.get_by_text("This result is of an earlier machine")
    expect(earlier).to_contain_text("Radial clearance C [µm] was 60, now")
    assert said.inner_text() == words
    with app.run():
        page.get_by_role("button", name="Undo", exact=True).click()
    expect(earlier).to_have_count(0)
    page.get_by_text("Machines drawn", exact=True).last.click()
    text = app.save("All machines drawn", tmp_path).read_text("utf-8-sig")
    rows = [row for row in csv.reader(io.StringIO(text)) if not row[0].startswith("#")]
    share = sum(row[-1] == "unstable" for row in rows[1:]) / 60
    assert words.startswith(f"{100.0 * share:.3g} %")


def test_one_input_is_swept_on_a_bore(app: AppPage) -> None:
    app.open("Tolerances", bearing="elliptical", film="short", tab="Sweep", vary="preload")
    expect(app.charts()).to_have_count(4)
    assert [names[0] for names in app.traces()] == [
        "onset", "margin", "log decrement", "smallest film",
    ]  # fmt: skip
