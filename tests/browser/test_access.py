"""For everyone: light and dark, wide and narrow, with no fault that axe finds serious."""

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import expect

from tests.browser.app_page import PATHS, AppPage

PHONE = {"width": 390, "height": 844}
AXE = Axe()


# Colours do not depend on the size, nor places on the colours: two of the four tell all. The light
# page on a desk is seen in test_room, where it is open.
@pytest.mark.parametrize("name", PATHS)
def test_page_and_tabs_have_no_serious_fault_in_the_dark_and_fit_a_phone(
    app: AppPage, name: str
) -> None:
    app.page.set_viewport_size(PHONE)
    app.page.emulate_media(color_scheme="dark")
    app.open(name)
    assert violations(app) == []
    assert app.overflow() <= 0
    _, *others = app.tabs() or [""]
    assert others or name in ("Machine", "Bearings", "Lecture", "Exercises")
    for label in others:
        app.open_tab(label)
        assert app.page.get_by_role("tabpanel").filter(visible=True).inner_text().strip(), label
        expect(app.page.get_by_test_id("stException")).to_have_count(0)
        # The page around the open tab has a test of its own.
        assert violations(app, "[role=tabpanel]") == [], label
        assert app.overflow() <= 0, label


def test_inputs_on_a_phone(app: AppPage) -> None:
    app.page.set_viewport_size(PHONE)
    app.open("Machine")
    app.page.get_by_test_id("stExpandSidebarButton").click()
    app.slider("Radial clearance").scroll_into_view_if_needed()
    app.press("Radial clearance", "ArrowRight")
    assert app.query() == {"C": "60.5"}
    assert violations(app) == []


@pytest.mark.parametrize(
    ("name", "scheme", "query"),
    [("Machine", "dark", {"cases": "A~1~C~95"}), ("Orbits", "light", {"present": "orbits_time"})],
)
def test_a_presentation_has_no_serious_fault(
    app: AppPage, name: str, scheme: str, query: dict[str, str]
) -> None:
    app.page.emulate_media(color_scheme=scheme)
    app.open(name, **{"present": "1"} | query)
    assert app.charts().count() == 1
    app.page.get_by_role("button", name="Other sliders").click()
    expect(app.page.get_by_test_id("stPopoverBody")).to_be_visible()
    assert violations(app) == []
    assert app.overflow() <= 0


@pytest.mark.parametrize("button", ["Units and settings", "Share and keep", "Oil library"])
def test_popover_has_no_serious_fault(app: AppPage, button: str) -> None:
    app.open("Machine")
    if button == "Oil library":
        app.open_group("Oil")
    app.open_popover(button)
    assert violations(app) == []


def violations(app: AppPage, part: str = "html") -> list[str]:
    """Return what axe finds serious or critical in a part of the page."""
    found = AXE.run(app.page, part, {"resultTypes": ["violations"]}).response["violations"]
    return [
        f"{one['id']}: {one['help']}: {[node['html'][:200] for node in one['nodes'][:3]]}"
        for one in found
        if one["impact"] in ("serious", "critical")
    ]
