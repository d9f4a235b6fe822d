"""A measured file from the page Your data is seen over the charts of other pages."""

from pathlib import Path

from playwright.sync_api import expect

from tests.browser.app_page import AppPage


def test_an_orbit_and_a_response_are_laid_over_the_charts(app: AppPage, tmp_path: Path) -> None:
    app.open("Your data", tab="Measured vibration")
    query = app.query()
    uploaders = app.page.get_by_test_id("stFileUploader").locator("input[type=file]")
    for place, kind in enumerate(("orbit", "response")):
        saved = app.save(f"Sample {kind}", tmp_path)
        # The name says that it is simulated.
        assert saved.name == f"simulated-{kind}.csv"
        with app.run():
            uploaders.nth(place).set_input_files(saved)
    expect(app.page.get_by_text("1× synchronous vector")).to_be_visible()
    assert app.query() == query
    app.go("Orbits")
    assert any("measured" in names for names in app.traces())
    app.go("Response")
    assert any("measured major" in names for names in app.traces())
    app.go("Your data")
    with app.run():
        app.page.get_by_role("button", name="Remove").first.click()
    app.go("Orbits")
    assert not any("measured" in names for names in app.traces())
