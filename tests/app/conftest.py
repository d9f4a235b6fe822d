"""A session without a browser has Streamlit's own sliders and charts: AppTest moves no others."""

from collections.abc import Iterator
from functools import cache

import pytest
from streamlit.components.v2 import manifest_scanner
from streamlit.testing.v1 import local_script_runner
from streamlit.testing.v1.local_script_runner import LocalScriptRunner

from ui.words import design


@pytest.fixture(autouse=True, scope="session")
def packages_searched_once() -> Iterator[None]:
    """Let AppTest search the installed packages for components once, not anew for each session."""
    with pytest.MonkeyPatch.context() as patch:
        found = cache(manifest_scanner.scan_component_manifests)
        patch.setattr(manifest_scanner, "scan_component_manifests", found)
        yield


@pytest.fixture(autouse=True, scope="session")
def runs_are_waited_for() -> Iterator[None]:
    """Let AppTest wait for a run's thread, which it would look at a thousand times a second."""
    looks = local_script_runner.require_widgets_deltas

    def wait(runner: LocalScriptRunner, timeout: float = 3) -> None:
        if runner._script_thread:
            runner._script_thread.join(timeout)
        looks(runner, 0.01)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(local_script_runner, "require_widgets_deltas", wait)
        yield


@pytest.fixture(autouse=True)
def streamlits_own(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROTORCALC_LIVE", "off")


@pytest.fixture
def coarse_maps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Give maps a few points, which may take a tenth of a second each: the page says the same."""
    monkeypatch.setattr(design, "_COARSE", 4)
