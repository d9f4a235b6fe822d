"""Nothing is asked outside: proved where nothing can be reached, and every attempt is counted.

That takes a network namespace, which some machines let nobody make. There a server is visited all
the same, and Python's own sockets are listened to, which is all that can be done.
"""

import json
import os
import shutil
import subprocess
import sys
from typing import Any

import pytest

from tests.load.replicas import ROOT

# As its own root in a namespace of users, or as root of this machine.
_WAYS = (["--map-root-user", "--net"], ["--net"])


@pytest.fixture(scope="module")
def shut() -> list[str]:
    """The words before a command that shut it in, none where no way of it is allowed.

    In CI one must be: what Python's own sockets ask is not all that is asked.
    """
    program = shutil.which("unshare")
    commands = ([program, *way] for way in _WAYS if program)
    found = next((command for command in commands if _is_allowed(command)), [])
    if not found and os.environ.get("CI"):
        pytest.fail("nobody may make a network namespace here (unshare --net)", pytrace=False)
    return found


def _is_allowed(command: list[str]) -> bool:
    return subprocess.run([*command, "true"], check=False, capture_output=True).returncode == 0


@pytest.fixture(scope="module")
def visited(shut: list[str]) -> dict[str, Any]:
    """What was asked outside while a server was started and visited."""
    command = [*shut, sys.executable, "-m", "tests.deploy.alone", *(["shut"] if shut else [])]
    done = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


def test_a_server_starts_and_is_visited_and_asks_nobody_outside(visited: dict[str, Any]) -> None:
    assert visited["asked"] == []
    assert visited["without a way"] == 0


def test_one_question_and_one_packet_outside_are_counted(
    shut: list[str], visited: dict[str, Any]
) -> None:
    assert visited["asked after one more"] == [["socket.connect", "198.51.100.7"]]
    if shut:
        assert visited["without a way after one more"] >= 1
