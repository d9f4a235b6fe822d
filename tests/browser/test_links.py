"""Links: every page opens cold, and the address bar carries the whole machine everywhere."""

import pytest
from playwright.sync_api import expect

from tests.browser.app_page import PATHS, AppPage

LINK = {"preset": "sheet-1e7", "C": "80", "rpm": "3000", "cs": "500"}


@pytest.mark.parametrize("name", PATHS)
def test_page_opens_cold_by_its_own_address(app: AppPage, name: str) -> None:
    app.open(name)
    assert app.query() == {}
    expect(app.page.get_by_test_id("stHeading").first).to_be_visible()
    expect(app.page.get_by_test_id("stException")).to_have_count(0)
    if name != "Notes":
        assert app.metrics()
        assert app.drawn()


@pytest.mark.parametrize("name", PATHS)
def test_shared_link_gives_the_same_numbers_cold_and_on_every_page_after(
    app: AppPage, name: str
) -> None:
    app.open(name, **LINK)
    seen = {name: _shown(app)}
    for other in [one for one in PATHS if one != name]:
        app.go(other)
        seen[other] = _shown(app)
        assert app.query() == LINK
    cold = _all_cold(app)
    for other, shown in seen.items():
        assert shown == cold[other], f"{name}, then {other}"


_COLD: dict[str, tuple[dict[str, str], list[str]]] = {}


def _all_cold(app: AppPage) -> dict[str, tuple[dict[str, str], list[str]]]:
    """Return what every page shows on a cold visit by the link, looked up once."""
    for name in PATHS.keys() - _COLD.keys():
        app.open(name, **LINK)
        _COLD[name] = _shown(app)
    return _COLD


def _shown(app: AppPage) -> tuple[dict[str, str], list[str]]:
    sliders = app.page.get_by_test_id("stSidebar").locator("input[type=range]")
    return app.metrics(), [
        f"{slider.get_attribute('aria-label')} = {slider.get_attribute('aria-valuetext')}"
        for slider in sliders.all()
    ]


def test_link_survives_pages_and_reproduces_the_machine_elsewhere(
    app: AppPage, stranger: AppPage
) -> None:
    app.open("Equilibrium", **LINK)
    first = _shown(app)
    app.go("Response")
    app.go("Equilibrium")
    assert _shown(app) == first
    app.open_popover("Share and keep")
    link = app.page.get_by_test_id("stPopoverBody").get_by_test_id("stCode").inner_text().strip()
    assert link.startswith(f"{app.url}/Equilibrium?")
    stranger.page.goto(link)
    stranger.rest()
    assert stranger.query() == LINK
    assert _shown(stranger) == first


def test_moved_value_goes_into_the_address_bar_and_to_every_page(app: AppPage) -> None:
    app.open("Machine")
    app.press("Radial clearance", "ArrowRight")
    assert app.query() == {"C": "61"}
    for name in PATHS:
        if name != "Machine":
            app.go(name)
        assert app.query() == {"C": "61"}
        assert app.slider("Radial clearance").get_attribute("aria-valuetext") == "61"


def test_the_browsers_reload_keeps_the_machine(app: AppPage) -> None:
    app.open("Machine")
    app.press("Radial clearance", "PageUp")
    shown = _shown(app)
    app.page.reload()
    app.rest()
    assert _shown(app) == shown


def test_broken_link_is_answered_in_words(app: AppPage) -> None:
    app.open("Stability", C="-5", D="abc", T="70", colour="<b>red</b>")
    said = app.page.get_by_test_id("stAlert").all_inner_texts()
    for word in ("Radial clearance", "Diameter", "colour"):
        assert any(word in text for text in said), word
    assert app.slider("Film temperature").get_attribute("aria-valuetext") == "70.0"
    assert app.query() == {"T": "70"}
    app.press("Film temperature", "ArrowRight")
    expect(app.page.get_by_text("is no quantity of this program")).to_have_count(0)
