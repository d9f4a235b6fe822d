"""A browser that loses its server or its network: nothing is lost, and the next action works.

Each visitor has done something else last. All of them are there at once, so that a server need not
be killed for each.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime

import pytest
from playwright.sync_api import BrowserContext, expect

from tests.browser.app_page import AppPage
from tests.browser.conftest import browser_type_launch_args, chromium, desk
from tests.deploy.line import Line
from tests.load.replicas import Replica

__all__ = ["browser_type_launch_args", "chromium", "desk"]

_STATE = "document.querySelector('[data-testid=stApp]').dataset.testConnectionState"
CLEARANCE = "Radial clearance"

# Several pages are opened at once, and servers started.
pytestmark = pytest.mark.timeout(300)


# --- What visitors do -------------------------------------------------------------------------


def nothing(_: AppPage) -> None:
    """Look at the page."""


def slide(tab: AppPage) -> None:
    """Move a slider by one step, half a micrometre."""
    before = tab.query()["C"]
    tab.press(CLEARANCE, "ArrowRight")
    assert float(tab.query()["C"]) == float(before) + 0.5


def open_a_tab(tab: AppPage) -> None:
    tab.open_tab("Forces")


def keep_a_case(tab: AppPage) -> None:
    """Keep the machine as a case, where there is none."""
    if not tab.page.locator("table.cases").count():
        with tab.run():
            tab.page.get_by_role("button", name="Keep as A").click()


def type_a_value(tab: AppPage) -> None:
    """Type a clearance one above."""
    value = float(tab.query()["C"]) + 1
    with tab.run():
        fill_in(tab, value)
    assert float(tab.query()["C"]) == value


def fill_in(tab: AppPage, value: float) -> None:
    """Write into the field of the clearance, and leave it."""
    field = tab.page.get_by_role("textbox", name=CLEARANCE)
    field.fill(f"{value:g}")
    field.press("Enter")


def choose_typing(tab: AppPage) -> None:
    """Have fields instead of sliders."""
    tab.open_popover("Units and settings")
    with tab.run():
        tab.page.get_by_text("Type values instead of sliding").click()
    tab.close_popover()


def kick(tab: AppPage) -> None:
    """Increase the initial displacement."""
    tab.slider("Initial displacement").focus()
    with tab.run():
        tab.slider("Initial displacement").press("ArrowRight")


# --- What must still be there -----------------------------------------------------------------


def machine(tab: AppPage) -> object:
    return tab.query(), tab.metrics()


def tab_open(tab: AppPage) -> object:
    return tab.query(), tab.page.locator("[role=tab][aria-selected=true]").inner_text()


def compared(tab: AppPage) -> object:
    return (
        tab.metrics(),
        tab.page.locator("table.cases").inner_text(),
        tab.page.get_by_test_id("stMetricDelta").all_inner_texts(),
    )


def field(tab: AppPage) -> object:
    return tab.page.get_by_role("textbox", name=CLEARANCE).input_value()


def height(tab: AppPage) -> object:
    return tab.slider("Initial displacement").evaluate(
        "handle => handle.value ?? handle.ariaValueNow"
    )


@dataclass(frozen=True)
class Visit:
    """A visitor's page, what was done there last, what must still be there, the next action."""

    page: str
    last: Callable[[AppPage], None]
    there: Callable[[AppPage], object]
    then: Callable[[AppPage], None] = slide
    first: Callable[[AppPage], None] = nothing


VISITS = {
    "nothing": Visit("Equilibrium", nothing, machine),
    "a slider": Visit("Machine", slide, machine),
    "a tab": Visit("Equilibrium", open_a_tab, tab_open),
    "a case": Visit("Stability", keep_a_case, compared, first=keep_a_case),
    "a typed value": Visit("Machine", type_a_value, field, type_a_value, first=choose_typing),
    "a kick": Visit("Orbits", kick, height, kick),
}


# --- Where it happens -------------------------------------------------------------------------


class Place:
    """A server, and the line by which visitors reach it."""

    def __init__(self) -> None:
        self.server = Replica().wait()
        self.line = Line(self.server.port)

    @property
    def address(self) -> str:
        return f"http://127.0.0.1:{self.line.port}"

    def mend(self) -> None:
        """Start a server where there is none, and let visitors reach it."""
        if self.server.process.poll() is not None:
            self.server = Replica(port=self.server.port).wait()
        self.line.mend()


@pytest.fixture(scope="module")
def place() -> Iterator[Place]:
    here = Place()
    with here.line:
        yield here
    here.server.stop()


@pytest.fixture(scope="module")
def tabs(desk: BrowserContext, place: Place) -> Iterator[dict[str, AppPage]]:
    """A tab for each visitor."""
    opened = {name: AppPage(desk.new_page(), place.address) for name in VISITS}
    for name, tab in opened.items():
        tab.open(VISITS[name].page, C="70", D="160")
        VISITS[name].first(tab)
    yield opened
    for tab in opened.values():
        tab.page.close()


def lost(tab: AppPage) -> None:
    """Wait until the browser knows that its connection is lost."""
    tab.page.wait_for_function(f"() => {_STATE} !== 'CONNECTED'")


def back(tab: AppPage) -> None:
    """Wait until it has another, and the page has run for it."""
    tab.page.wait_for_function(f"() => {_STATE} === 'CONNECTED'")
    tab.rest()


@pytest.mark.parametrize("goes", ["kill", "stop", "cut"])
def test_after_a_lost_connection_the_last_action_stands_and_the_next_works(
    goes: str, place: Place, tabs: dict[str, AppPage]
) -> None:
    """A crash, a restart, and a short failure of the network."""
    there = {}
    for name, tab in tabs.items():
        VISITS[name].last(tab)
        there[name] = VISITS[name].there(tab)
    {"kill": place.server.kill, "stop": place.server.stop, "cut": place.line.cut}[goes]()
    for tab in tabs.values():
        lost(tab)
    place.mend()
    for name, tab in tabs.items():
        back(tab)
        assert VISITS[name].there(tab) == there[name], name
        VISITS[name].then(tab)


def test_a_value_being_sent_is_not_lost(place: Place, tabs: dict[str, AppPage]) -> None:
    """Sent to a server that stops before it arrives, or moved while there is no server."""
    sliding, typing = tabs["a slider"], tabs["a typed value"]
    wanted = [float(tab.query()["C"]) + step for tab, step in ((sliding, 1), (typing, 1))]
    place.line.fall_silent()
    sliding.slider(CLEARANCE).press("ArrowRight")
    fill_in(typing, wanted[1])
    place.server.kill()
    place.line.cut()
    for tab in (sliding, typing):
        lost(tab)
    sliding.slider(CLEARANCE).press("ArrowRight")
    place.mend()
    for tab in tabs.values():
        back(tab)
    assert [float(tab.query()["C"]) for tab in (sliding, typing)] == wanted
    assert field(typing) == f"{wanted[1]:g}"


def test_a_running_computation_restarts_and_the_page_says_so(
    place: Place, tabs: dict[str, AppPage]
) -> None:
    tab = tabs["a kick"]
    tab.open_tab("Run-up")
    with place.server.held():
        tab.page.get_by_role("button", name="Run up and down").click()
        expect(tab.page.get_by_role("button", name="Cancel")).to_be_visible()
        place.server.kill()
    lost(tab)
    place.mend()
    back(tab)
    said = tab.page.get_by_text("This computation was interrupted and has started again.")
    expect(said).to_be_visible()
    expect(tab.page.locator(".live-chart")).to_be_visible()
    slide(tab)
    expect(said).to_be_hidden()


# --- Long breaks: the browser's clock is put forward ------------------------------------------


@pytest.fixture
def clocked(desk: BrowserContext, place: Place) -> Iterator[AppPage]:
    """A tab whose clock stands still but when a test puts it forward."""
    tab = AppPage(desk.new_page(), place.address)
    tab.page.clock.install()
    tab.open("Equilibrium", C="70")
    # The clock still goes on by itself: it is stopped at a time that no machine reaches meanwhile.
    now = tab.page.evaluate("Date.now()") / 1e3
    tab.page.clock.pause_at(datetime.fromtimestamp(now + 300, UTC))
    yield tab
    tab.page.close()


def pass_time(tab: AppPage, seconds: float, *, pause: float = 60, until: str = "") -> bool:
    """Put the browser's clock forward, and let it answer what comes meanwhile; see if it holds."""
    for _ in range(round(seconds * 4)):
        tab.page.clock.run_for(250)
        tab.page.wait_for_timeout(pause)
        if until and tab.page.evaluate(until):
            return True
    return False


# At the worst moment Streamlit has just been refused, or has just begun to wait.
@pytest.mark.parametrize(("how", "worst"), [("cut", "requestfailed"), ("silent", "request")])
def test_after_a_long_break_it_is_back_within_two_seconds(
    how: str, worst: str, place: Place, clocked: AppPage
) -> None:
    """Streamlit alone looks up to four seconds apart, and waits fifteen for who is silent."""
    {"cut": place.line.cut, "silent": place.line.fall_silent}[how]()
    assert pass_time(clocked, 12, until=f"{_STATE} !== 'CONNECTED'")
    pass_time(clocked, 20)
    looks: list[str] = []
    clocked.page.on(worst, lambda asked: looks.append(asked.url))  # type: ignore[call-overload]
    while not any("host-config" in url for url in looks):
        pass_time(clocked, 0.25)
    place.line.mend()
    # Two seconds of the browser's clock, however long a busy machine takes over them.
    assert pass_time(clocked, 2, pause=1000, until=f"{_STATE} === 'CONNECTED'")
    clocked.page.clock.resume()
    back(clocked)
    slide(clocked)
