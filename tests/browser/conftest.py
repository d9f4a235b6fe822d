"""A real Chromium, the app served to it, and tabs to open it in."""

import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import cache
from pathlib import Path
from typing import Any
from urllib.error import URLError
from urllib.request import urlopen

import pytest
from playwright.sync_api import Browser, BrowserContext, BrowserType, Playwright

from tests.browser.app_page import AppPage

ROOT = Path(__file__).resolve().parents[2]
START_TIMEOUT = 60  # seconds; a cold start on a busy machine takes about ten

DESK = {"width": 1440, "height": 900}

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
def serve(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[str], str]]:
    """Base URL of the app in a mode of ROTORCALC_LIVE, each started once, when first asked for."""
    with ExitStack() as servers:

        @cache
        def url(live: str) -> str:
            return servers.enter_context(_served(live, tmp_path_factory.mktemp("server")))

        yield url


@pytest.fixture
def app_url(request: pytest.FixtureRequest, serve: Callable[[str], str]) -> str:
    """Base URL of the app. Its parameter: "drag", or "off" for Streamlit's own charts, sliders."""
    return serve(getattr(request, "param", "drag"))


@contextmanager
def _served(live: str, folder: Path) -> Iterator[str]:
    """Serve the app by a process of its own."""
    environment = {**os.environ, "ROTORCALC_LIVE": live}
    port = _free_port()
    url = f"http://127.0.0.1:{port}"
    log = folder / "streamlit.log"
    options = ["--server.headless=true", "--server.address=127.0.0.1", f"--server.port={port}"]
    with log.open("wb") as out:
        server = subprocess.Popen(
            [sys.executable, "-m", "streamlit", "run", "app.py", *options],
            cwd=ROOT,
            env=environment,
            stdout=out,
            stderr=subprocess.STDOUT,
        )
    try:
        _wait_until_healthy(server, url, log)
        yield url
    finally:
        _stop(server)


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


@pytest.fixture
def app(desk: BrowserContext, app_url: str) -> Iterator[AppPage]:
    """A tab for the app; the test fails where the console or the network shows a fault."""
    tab = AppPage(desk.new_page(), app_url)
    yield tab
    tab.page.close()
    assert tab.faults == []


@pytest.fixture
def stranger(browser: Browser, app_url: str) -> Iterator[AppPage]:
    """A tab in a browser that was never here."""
    with browser.new_context(viewport=DESK) as context:
        tab = AppPage(context.new_page(), app_url)
        yield tab
    assert tab.faults == []


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def _wait_until_healthy(server: subprocess.Popen[bytes], url: str, log: Path) -> None:
    end = time.monotonic() + START_TIMEOUT
    while server.poll() is None and time.monotonic() < end:
        try:
            with urlopen(f"{url}/_stcore/health", timeout=5) as answer:
                if answer.status == 200:
                    return
        except (URLError, OSError):
            time.sleep(0.1)
    pytest.fail(f"streamlit did not start:\n{log.read_text()}", pytrace=False)


def _stop(server: subprocess.Popen[bytes]) -> None:
    server.terminate()
    try:
        server.wait(timeout=10)
    except subprocess.TimeoutExpired:
        server.kill()
        server.wait()
