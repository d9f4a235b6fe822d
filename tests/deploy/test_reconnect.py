"""A browser that loses its server or its network: nothing is lost, and the next action works.

The browser's clock stands still during a break, but for what a test lets pass.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime

import pytest
from playwright.sync_api import BrowserContext, expect
from websockets.asyncio.client import connect

from tests.browser.app_page import AppPage
from tests.browser.conftest import browser_type_launch_args, chromium, desk
from tests.deploy.line import Line
from tests.load.replicas import Replica
from tests.waiting import finished

__all__ = ["browser_type_launch_args", "chromium", "desk"]

_STATE = "document.querySelector('[data-testid=stApp]').dataset.testConnectionState"
CLEARANCE = "Radial clearance"
KEPT = 128  # sessions of lost tabs that Streamlit keeps

# Pages are opened, and servers started.
pytestmark = pytest.mark.timeout(300)


# --- What visitors do -------------------------------------------------------------------------


def nothing(_: AppPage) -> None:
    """Look at the page."""


def slide(tab: AppPage) -> None:
    """Move a slider by one step, half a micrometre."""
    before = tab.query()["C"]
    tab.press(CLEARANCE, "ArrowRight")
    assert float(tab.query()["C"]) == float(before) + 0.5


def keep_a_case(tab: AppPage) -> None:
    """Open one of the page's tabs, and keep the machine as a case."""
    tab.open_tab("Forces")
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
    tab.press("Initial displacement", "ArrowRight")


# --- Where it happens -------------------------------------------------------------------------


class Place:
    """A server, and the line by which visitors reach it."""

    def __init__(self) -> None:
        self.server = Replica().wait()
        self.line = Line(self.server.port)

    @property
    def address(self) -> str:
        return f"http://127.0.0.1:{self.line.port}"

    def lose(self, how: str) -> None:
        """Let visitors lose their server by a crash or a restart, or their network."""
        if how in ("kill", "stop"):
            {"kill": self.server.kill, "stop": self.server.stop}[how]()
        if how == "silent":
            self.line.fall_silent()
        else:
            self.line.cut()

    def prepare(self, how: str) -> None:
        """Start a server where there is none, which nobody reaches yet."""
        if self.server.process.poll() is not None:
            self.server = Replica(port=self.server.port).wait()
        if how == "forgotten":
            finished(self._forget())

    def mend(self) -> None:
        """Start a server where there is none, and let visitors reach it."""
        self.prepare("")
        self.line.mend()

    async def _forget(self) -> None:
        """Let so many others come and go that no session of a lost tab is kept."""
        stream = f"{self.server.address.replace('http', 'ws')}/_stcore/stream"
        for _ in range(KEPT):
            async with connect(
                stream, origin=self.server.address, subprotocols=["streamlit", "-"], proxy=None
            ):  # type: ignore[arg-type] # fmt: skip
                pass


class Tabs:
    """Three visitors' tabs, each opened when first asked for."""

    def __init__(self, desk: BrowserContext, address: str) -> None:
        self._desk, self._address = desk, address
        self._open: dict[str, AppPage] = {}

    def __call__(self, *names: str) -> list[AppPage]:
        """Return the tabs of these names, and close the others."""
        for name in self._open.keys() - set(names):
            self._open.pop(name).page.close()
        for name in set(names) - self._open.keys():
            self._open[name] = self._opened(name)
        return [self._open[name] for name in names]

    def _opened(self, name: str) -> AppPage:
        tab = AppPage(self._desk.new_page(), self._address)
        tab.page.clock.install()
        tab.open("Orbits" if name == "releasing" else "Equilibrium", C="70", D="160")
        if name == "typing":
            choose_typing(tab)
        return tab


@pytest.fixture(scope="module")
def place() -> Iterator[Place]:
    here = Place()
    with here.line:
        yield here
    here.server.stop()


@pytest.fixture(scope="module")
def tabs(desk: BrowserContext, place: Place) -> Iterator[Tabs]:
    tabs = Tabs(desk, place.address)
    yield tabs
    tabs()


def lost(tab: AppPage) -> None:
    """Wait until the browser knows that its connection is lost."""
    tab.page.wait_for_function(f"() => {_STATE} !== 'CONNECTED'")


def back(tab: AppPage) -> None:
    """Wait until it has another, and the page has run for it."""
    tab.page.wait_for_function(f"() => {_STATE} === 'CONNECTED'")
    tab.rest()


# --- A break: the browser's clock stands, and is put forward ----------------------------------


@contextmanager
def stopped_clock(tab: AppPage) -> Iterator[None]:
    """Stop the browser's clock meanwhile, at a time that no machine reaches before."""
    now = tab.page.evaluate("Date.now()") / 1e3
    tab.page.clock.pause_at(datetime.fromtimestamp(now + 300, UTC))
    try:
        yield
    finally:
        tab.page.clock.resume()


def pass_time(tab: AppPage, seconds: float, *, pause: float = 60, until: str = "") -> bool:
    """Put the browser's clock forward, and let it answer what comes meanwhile; see if it holds."""
    for _ in range(round(seconds * 4)):
        tab.page.clock.run_for(250)
        tab.page.wait_for_timeout(pause)
        if until and tab.page.evaluate(until):
            return True
    return False


@dataclass(frozen=True)
class Break:
    """Whose connection breaks, what was done there last, and what is done next."""

    who: str
    last: Callable[[AppPage], None]
    then: Callable[[AppPage], None] = slide


BREAKS = {
    "kill": Break("sliding", nothing),
    "silent": Break("sliding", slide),
    "forgotten": Break("sliding", keep_a_case),
    "cut": Break("typing", type_a_value, type_a_value),
    "stop": Break("releasing", kick, kick),
}


# A tab stays open for the next test: those who slide come first, then who types, then a release.
@pytest.mark.parametrize("how", ["kill", "silent", "forgotten"])
def test_two_seconds_after_a_break_all_is_there_and_the_next_action_works(
    how: str, place: Place, tabs: Tabs
) -> None:
    """A crash, a network that falls silent, and a session long forgotten."""
    break_and_mend(how, place, tabs)


def break_and_mend(how: str, place: Place, tabs: Tabs) -> None:
    """Let a tab lose its connection and get another; see what it has kept, and act in it."""
    (tab,) = tabs(BREAKS[how].who)
    BREAKS[how].last(tab)
    before, session = tab.shown(), tab.session
    with stopped_clock(tab):
        place.lose(how)
        assert pass_time(tab, 12, until=f"{_STATE} !== 'CONNECTED'")
        if how == "forgotten":
            tab.page.clock.fast_forward(300_000)
        place.prepare(how)
        pass_time(tab, 10)
        wait_for_the_worst_moment(tab, how)
        place.mend()
        # Two seconds of the browser's clock, however long a busy machine takes over them.
        assert pass_time(tab, 2, pause=1000, until=f"{_STATE} === 'CONNECTED'")
    back(tab)
    assert tab.shown() == before
    assert how in ("cut", "silent") or tab.session != session
    BREAKS[how].then(tab)


def wait_for_the_worst_moment(tab: AppPage, how: str) -> None:
    """Put the clock forward until Streamlit has just been refused, or has just begun to wait.

    It looks up to four seconds apart, and waits fifteen for who is silent.
    """
    looks: list[str] = []
    event = "request" if how == "silent" else "requestfailed"
    tab.page.on(event, lambda asked: looks.append(asked.url))  # type: ignore[call-overload]
    while not any("host-config" in url for url in looks):
        pass_time(tab, 0.25)


def test_a_value_being_sent_is_not_lost(place: Place, tabs: Tabs) -> None:
    """Sent to a server that stops before it arrives, or moved while there is no server."""
    sliding, typing = tabs("sliding", "typing")
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
    for tab in (sliding, typing):
        back(tab)
    assert [float(tab.query()["C"]) for tab in (sliding, typing)] == wanted
    field = typing.page.get_by_role("textbox", name=CLEARANCE)
    assert field.input_value() == f"{wanted[1]:g}"


@pytest.mark.parametrize("how", ["cut", "stop"])
def test_a_typed_value_and_a_release_are_there_after_a_break(
    how: str, place: Place, tabs: Tabs
) -> None:
    """A network that fails, and a restart."""
    break_and_mend(how, place, tabs)


def test_a_running_computation_restarts_and_the_page_says_so(place: Place, tabs: Tabs) -> None:
    (tab,) = tabs("releasing")
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
