"""What a server finds when it looks at itself, and a server that cannot start."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from textwrap import indent
from typing import Any
from urllib.error import HTTPError
from urllib.request import urlopen

import pytest

from tests.deploy import project
from tests.deploy.test_replicas import awaited
from tests.load import client
from tests.load.client import Visitor
from tests.load.replicas import ROOT, Replica
from tests.waiting import until
from ui.serving import log

# A home page that fails while there is a file beside the app.
_BREAKABLE = """
from pathlib import Path
if (Path(__file__).parents[2] / "broken").exists():
    raise ValueError("radial_clearance = 81.2345 m")
"""


# What is waited for takes some ten seconds, and more on a busy machine.
pytestmark = pytest.mark.timeout(300)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = project.copy(tmp_path_factory.mktemp("project") / "rotorcalc")
    home = folder / "ui/words/home.py"
    head, content = home.read_text().split("    units = page.units\n", 1)
    home.write_text(head + indent(_BREAKABLE, "    ") + "    units = page.units\n" + content)
    pulse = folder / "ui/serving/pulse.py"
    text = pulse.read_text()
    assert text.count("_LOOK = 5.0") == 1
    pulse.write_text(text.replace("_LOOK = 5.0", "_LOOK = 0.5"))  # else a test waits for most looks
    return folder


@pytest.fixture(scope="module")
def server(folder: Path) -> Iterator[Replica]:
    replica = _server(folder)
    yield replica.wait()
    replica.stop()


def _server(folder: Path) -> Replica:
    return Replica(folder=folder, script=folder / "app.py")


def _answer(server: Replica) -> tuple[int, dict[str, Any]]:
    try:
        with urlopen(f"{server.address}/healthz", timeout=30) as answer:
            return answer.status, json.load(answer)
    except HTTPError as error:
        return error.code, json.load(error)


def _is_good(server: Replica) -> bool:
    return _answer(server)[1]["status"] == "good"


def _why(server: Replica, part: str) -> str:
    """Wait until a part is found to be bad, and return why."""
    until(lambda: part in _answer(server)[1].get("why", {}))
    status, answer = _answer(server)
    assert (status, answer["status"]) == (503, "bad")
    return answer["why"][part]


def _processes(server: Replica) -> dict[str, int]:
    """Return the processes for computations: by what they are for, their numbers."""
    found = {}
    for status in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            if status.read_text().rsplit(")", 1)[1].split()[1] == str(server.process.pid):
                command = (status.parent / "cmdline").read_text().split("\0")
                if len(command) > 3:  # one that has ended has none
                    names = {"0": "releases", "9": "comparisons"}
                    what = names.get(command[3], "long computations")
                    found[what] = int(status.parent.name)
    return found


def test_a_server_that_is_well_says_so(server: Replica) -> None:
    until(lambda: _is_good(server))
    command = [sys.executable, "-m", "ui.serving.health", f"{server.address}/healthz"]
    assert subprocess.run(command, cwd=ROOT, check=False).returncode == 0


@pytest.mark.parametrize("what", [signal.SIGSTOP, signal.SIGKILL])
@awaited
async def test_lost_processes_for_computations_are_named_and_replaced(
    server: Replica, what: signal.Signals
) -> None:
    """They are named by one look, and are there again for the next: only the log keeps it."""
    until(lambda: _is_good(server))
    lost, before = _processes(server), len(server.log.read_text())
    for number in lost.values():
        os.kill(number, what)

    def are_named() -> bool:
        found = re.findall(r"unhealthy why=(.*)", server.log.read_text()[before:])
        return all(f"'{part}': '" in "".join(found) for part in lost)

    until(are_named)
    until(lambda: _is_good(server))
    assert _processes(server).keys() == lost.keys()
    assert not set(_processes(server).values()) & set(lost.values())
    async with Visitor(server.address) as visitor:
        await visitor.open("Orbits", f"C={70 + what}")
        assert visitor.tally.errors == []


@pytest.mark.parametrize("what", [signal.SIGSTOP, signal.SIGKILL])
@awaited
async def test_the_next_visitor_notices_nothing_of_a_lost_process(
    server: Replica, what: signal.Signals, monkeypatch: pytest.MonkeyPatch
) -> None:
    until(lambda: _is_good(server))
    monkeypatch.setattr(client, "TIMEOUT", 120.0)  # it waits for a new process
    for number in _processes(server).values():
        os.kill(number, what)
    async with Visitor(server.address) as visitor:
        await visitor.open("Orbits", f"C={90 + what}")
        assert [element.alert.title for element in visitor.elements("alert")].count(log.TITLE) == 0


def test_scripts_that_are_gone_and_cannot_be_put_back_are_named(
    server: Replica, folder: Path
) -> None:
    until(lambda: _is_good(server))
    shutil.rmtree(folder / "static")
    assert "static" in _why(server, "files")
    (folder / "static").mkdir()
    until(lambda: _is_good(server))
    assert list((folder / "static").glob("plotly-*.min.js"))


def test_a_page_that_cannot_be_drawn_is_named_by_its_failure_in_the_log(
    server: Replica, folder: Path
) -> None:
    until(lambda: _is_good(server))
    (folder / "broken").touch()
    words = _why(server, "pages")
    (number,) = re.findall(r"\*\*([0-9a-f]{8})\*\*", words)
    said = server.log.read_text()
    assert f"failed id={number} times=1 type=ValueError places=" in said
    assert "home.py:" in said
    assert "81.2345" not in said
    assert "Traceback" not in said
    command = [sys.executable, "-m", "ui.serving.health", f"{server.address}/healthz"]
    asked = subprocess.run(command, cwd=ROOT, check=False, capture_output=True, text=True)
    assert asked.returncode == 1
    assert "pages" in asked.stderr
    (folder / "broken").unlink()
    until(lambda: _is_good(server))


def test_a_server_whose_page_fails_does_not_start_and_says_why(folder: Path) -> None:
    (folder / "broken").touch()
    try:
        ended = _server(folder)
        assert ended.process.wait(60) != 0
    finally:
        (folder / "broken").unlink()
    assert "cannot start" in ended.log.read_text()
    assert "'pages'" in ended.log.read_text()


def test_a_server_that_cannot_serve_its_scripts_does_not_start_and_says_why(folder: Path) -> None:
    shutil.rmtree(folder / "static")
    (folder / "static").touch()  # whoever runs the test cannot write in it
    try:
        ended = _server(folder)
        assert ended.process.wait(60) != 0
    finally:
        (folder / "static").unlink()
        (folder / "static").mkdir()
    last = ended.log.read_text().splitlines()[-1]
    assert f"{folder}/static" in last
    assert "cannot be written" in last
    assert "ui.live.assets" in last
    assert "is not available" not in ended.log.read_text()
