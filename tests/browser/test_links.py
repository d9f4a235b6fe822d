"""Links: every page opens cold, and the address bar carries the whole machine everywhere."""

import itertools
import re
from urllib.parse import parse_qsl, urlsplit

import pytest
from playwright.sync_api import expect

from tests.browser.app_page import MACHINE_PAGES, AppPage

LINK = {"preset": "sheet-1e7", "C": "80", "rpm": "3000", "cs": "500"}


Shown = tuple[dict[str, str], list[str]]


@pytest.fixture(scope="module")
def cold() -> dict[str, Shown]:
    """What each page shows on a cold visit by the link, as tests come by it."""
    return {}


@pytest.mark.parametrize(
    ("name", "after"), list(itertools.pairwise([*MACHINE_PAGES, MACHINE_PAGES[0]]))
)
def test_shared_link_gives_the_same_numbers_cold_and_on_the_pages_visited_after(
    app: AppPage, name: str, after: str, cold: dict[str, Shown]
) -> None:
    app.open(name, **LINK)
    assert app.query() == LINK
    expect(app.page.get_by_test_id("stHeading").first).to_be_visible()
    expect(app.page.get_by_test_id("stException")).to_have_count(0)
    if name not in ("Bearings", "Notes", "Your data"):
        assert app.metrics()
        # Criteria begins with a table, Tolerances with bars, which are no lines.
        assert app.drawn() or name in ("Criteria", "Tolerances")
    assert cold.setdefault(name, _shown(app)) == _shown(app)
    app.go(after)
    assert app.query() == LINK
    assert cold.setdefault(after, _shown(app)) == _shown(app)


def _shown(app: AppPage) -> Shown:
    sliders = app.page.get_by_test_id("stSidebar").locator("input[type=range]")
    return app.metrics(), [
        f"{slider.get_attribute('aria-label')} = {slider.get_attribute('aria-valuetext')}"
        for slider in sliders.all()
    ]


def test_link_survives_pages_and_reproduces_the_machine_elsewhere(
    app: AppPage, elsewhere: AppPage
) -> None:
    app.open("Equilibrium", **LINK)
    first = _shown(app)
    app.go("Response")
    app.go("Equilibrium")
    assert _shown(app) == first
    app.open_popover("Share and keep")
    link = app.page.get_by_test_id("stPopoverBody").get_by_test_id("stCode").inner_text().strip()
    assert link.startswith(f"{app.url}/Equilibrium?")
    elsewhere.page.goto(link)
    elsewhere.rest()
    assert elsewhere.query() == LINK
    assert _shown(elsewhere) == first


# On every page: tests/app/test_session.py.
def test_moved_value_goes_into_the_address_bar_and_to_other_pages(app: AppPage) -> None:
    app.open("Machine")
    app.press("Radial clearance", "ArrowRight")
    assert app.query() == {"C": "60.5"}
    for name in ("Equilibrium", "Orbits", "Notes", "Machine"):
        app.go(name)
        assert app.query() == {"C": "60.5"}
        assert app.value("Radial clearance") == "60.5"


def test_a_link_to_another_page_contains_the_machine(app: AppPage) -> None:
    """Without the session, which another server does not have, and without the page's choices."""
    app.open("Equilibrium", C="70", D="160", tab="Forces")
    app.press("Radial clearance", "ArrowRight")
    machine = {"C": "70.5", "D": "160"}
    assert app.query() == machine | {"tab": "Forces"}
    for name, path in (("Response", "/Response"), ("Machine", "/")):
        link = app.page.get_by_test_id("stMain").get_by_role("link", name=name, exact=True)
        link.focus()
        address = urlsplit(link.evaluate("link => link.href"))
        assert (address.path, dict(parse_qsl(address.query))) == (path, machine)
    with app.page.context.expect_page() as opened:
        link.click(modifiers=["Control"])
    other = AppPage(opened.value, app.url)
    other.rest()
    assert other.query() == machine
    other.page.close()


def test_a_link_clicked_as_soon_as_a_value_is_typed_leads_to_the_machine_with_it(
    app: AppPage,
) -> None:
    """As a tap is: between its press, which leaves the field, and its click there is no time."""
    app.open("Machine", C="70")
    app.page.get_by_label(re.compile("^Radial clearance.*typed$")).fill("75")
    with app.run():
        app.page.get_by_role("link", name="Equilibrium", exact=True).first.click()
    assert app.changes(app.query, {"C": "70"})
    assert (urlsplit(app.page.url).path, app.query()) == ("/Equilibrium", {"C": "75"})
    assert app.page.get_by_test_id("stException").count() == 0


def test_back_leads_to_the_page_before_with_the_machine_as_it_was_shown_there(
    app: AppPage,
) -> None:
    app.open("Machine", C="70")
    app.go("Response")
    app.go("Notes")
    with app.run():
        app.page.go_back()
    assert urlsplit(app.page.url).path == "/Response"
    assert app.query() == {"C": "70"}
    expect(app.page.get_by_test_id("stHeading").first).to_contain_text("Imbalance")


def test_the_browsers_reload_keeps_the_machine(app: AppPage) -> None:
    app.open("Machine")
    app.press("Radial clearance", "PageUp")
    shown = _shown(app)
    app.page.reload()
    app.rest()
    assert _shown(app) == shown


def test_broken_link_gets_a_message_and_the_rest_on_request(app: AppPage) -> None:
    app.open("Stability", C="-5", D="abc", T="70", colour="<b>red</b>")
    said = app.page.get_by_test_id("stAlert").all_inner_texts()
    for word in ("Radial clearance", "Diameter", "colour"):
        assert any(word in text for text in said), word
    assert app.value("Film temperature") == "70"
    expect(app.charts()).to_have_count(0)
    with app.run():
        app.page.get_by_role("button", name="Use the valid values").click()
    assert app.query() == {"T": "70"}
    expect(app.page.get_by_text("is not an input of this machine")).to_have_count(0)
