"""What holds the project together: settings, locks, versions, and a core without a screen."""

import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest
import streamlit.config

import rotorcalc

ROOT = Path(__file__).resolve().parents[1]
PIN = re.compile(r"[a-z0-9.-]+==[0-9][0-9a-z.+!]*( ; [a-z_]+ [<>=!]+ '[a-z0-9.]+')*")


def _settings(tree: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield each setting of a TOML tree under Streamlit's dotted name."""
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from _settings(value, f"{prefix}{key}.")
        else:
            yield prefix + key, value


@pytest.fixture(scope="module")
def settings() -> dict[str, Any]:
    return dict(_settings(tomllib.loads((ROOT / ".streamlit/config.toml").read_text())))


def test_streamlit_knows_every_setting(settings: dict[str, Any]) -> None:
    assert set(settings) <= set(streamlit.config.get_config_options())


def test_a_rerun_does_not_end_in_a_garbage_collection(settings: dict[str, Any]) -> None:
    assert settings["runner.postScriptGC"] is False


@pytest.mark.parametrize("name", ["requirements.txt", "requirements-dev.txt"])
def test_lock_pins_every_package_and_names_no_source(name: str) -> None:
    lines = (ROOT / name).read_text().splitlines()
    pins = [line for line in lines if not line.startswith("#")]
    assert pins
    assert [pin for pin in pins if not PIN.fullmatch(pin)] == []


def test_move_js_names_the_locked_version_of_plotly() -> None:
    """Moving a drawn chart relies on the inside of Plotly, which may change with any release."""
    mover = (ROOT / "ui/live/move.js").read_text("utf-8")
    (written_for,) = re.findall(r"Python package plotly ([\d.]+\d):", mover)
    for lock in ("requirements.txt", "deploy/requirements.txt"):
        (locked,) = re.findall(r"^plotly==(\S+)$", (ROOT / lock).read_text("utf-8"), re.MULTILINE)
        assert locked == written_for, lock
    assert version("plotly") == written_for


def test_the_core_loads_neither_streamlit_nor_plotly() -> None:
    code = "import sys, rotorcalc; print({'streamlit', 'plotly'} & set(sys.modules))"
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"


def test_version_is_the_same_everywhere() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert rotorcalc.__version__ == project["version"]
