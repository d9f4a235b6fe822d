"""A real Chromium, the app served to it, and tabs to open it in."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import (
    Browser,
    BrowserContext,
    BrowserType,
    Playwright,
    ViewportSize,
    expect,
)

from tests.browser.app_page import TIMEOUT, AppPage
from tests.load.replicas import Replica

Lend = Callable[[], AbstractContextManager[AppPage]]

DESK: ViewportSize = {"width": 1440, "height": 900}

expect.set_options(timeout=TIMEOUT)

# Quiet, and at home in a container: as root, without a graphics card, without a network.
CHROMIUM_ARGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


@pytest.fixture(scope="session")
def chromium(playwright: Playwright) -> str:
    """Path of the system's Chromium ($CHROMIUM goes first), or else of Playwright's own."""
    named = os.environ.get("CHROMIUM")
    for name in [named] if named else ["chromium", "chromium-browser", "google-chrome"]:
        if found := shutil.which(name):
            return found
    if named:
        pytest.fail(f"CHROMIUM = {named}: no such program")
    own = playwright.chromium.executable_path
    if not Path(own).exists():
        _install_chromium()
    return own


def _install_chromium() -> None:
    command = [sys.executable, "-m", "playwright", "install", "chromium"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.fail(
            "The browser tests need Chromium. Playwright could not download its own: install one "
            "(Debian: apt install chromium) or name it in the environment variable CHROMIUM.\n"
            + done.stderr,
            pytrace=False,
        )


@pytest.fixture(scope="session")
def browser_type_launch_args(
    browser_type_launch_args: dict[str, Any], chromium: str
) -> dict[str, Any]:
    return browser_type_launch_args | {"executable_path": chromium, "args": CHROMIUM_ARGS}


@pytest.fixture(scope="session")
def serve() -> Iterator[Callable[[str], Replica]]:
    """Server of the app in a mode of ROTORCALC_LIVE, each started once, when first asked for."""
    with ExitStack() as servers:

        @cache
        def server(live: str) -> Replica:
            replica = Replica(ROTORCALC_LIVE=live, STREAMLIT_SERVER_ADDRESS="127.0.0.1")
            servers.callback(replica.stop)
            return replica.wait()

        yield server


@pytest.fixture
def server(request: pytest.FixtureRequest, serve: Callable[[str], Replica]) -> Replica:
    """Server of the app. Its parameter: "drag", or "off" for Streamlit's own charts and sliders."""
    return serve(getattr(request, "param", "drag"))


@pytest.fixture(scope="session")
def desk(
    browser_type: BrowserType,
    browser_type_launch_args: dict[str, Any],
    tmp_path_factory: pytest.TempPathFactory,
) -> Iterator[BrowserContext]:
    """A browser on a desk: its tabs are a visitor each, and its cache serves all tests.

    In a folder of its own, as people's browsers have one, it keeps scripts compiled: a page opens
    in half the time.
    """
    folder = tmp_path_factory.mktemp("browser")
    with browser_type.launch_persistent_context(
        folder, viewport=DESK, **browser_type_launch_args
    ) as context:
        yield context


@pytest.fixture(scope="session")
def free_tabs() -> list[AppPage]:
    """Tabs that no test is using."""
    return []


@pytest.fixture
def lend(
    request: pytest.FixtureRequest, desk: BrowserContext, server: Replica, free_tabs: list[AppPage]
) -> Lend:
    """Tabs for the app; the test fails where the console or the network shows a fault.

    A tab is used again, unless a test has failed in it: its process has the scripts compiled, and
    a page opens in half the processor time.
    """

    @contextmanager
    def lent() -> Iterator[AppPage]:
        tab = free_tabs.pop() if free_tabs else AppPage(desk.new_page(), server.address)
        tab.url = server.address
        tab.page.bring_to_front()  # behind another it hears of no pointer that leaves it
        failed = request.session.testsfailed
        yield tab
        faults = tab.faults
        if faults or request.session.testsfailed > failed:
            tab.page.close()
        else:
            tab.leave(DESK)
            free_tabs.append(tab)
        assert faults == []

    return lent


@pytest.fixture
def app(lend: Lend) -> Iterator[AppPage]:
    """A tab for the app."""
    with lend() as tab:
        yield tab


@pytest.fixture
def elsewhere(lend: Lend) -> Iterator[AppPage]:
    """A tab for another visitor."""
    with lend() as tab:
        yield tab


@pytest.fixture
def stranger(browser: Browser, server: Replica) -> Iterator[AppPage]:
    """A tab in a browser that was never here."""
    with browser.new_context(viewport=DESK) as context:
        tab = AppPage(context.new_page(), server.address)
        yield tab
    assert tab.faults == []
