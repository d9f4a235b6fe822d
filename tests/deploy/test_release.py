"""The unit and the documented update: a replica that hangs or does not start, two releases."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.request import urlopen

import pytest

from deploy import release
from deploy.watch import Watch
from tests.deploy import project
from tests.deploy.unit import Unit
from tests.load.client import Visitor
from tests.load.replicas import ROOT, free_port
from tests.waiting import finished, until

BASE = "rotorcalc"
MARK = "This is the next release."
PAGES = [path.stem.partition("_")[2] for path in sorted((ROOT / "pages").glob("*.py"))]

# Servers are started several times.
pytestmark = pytest.mark.timeout(400)


@dataclass
class Host:
    """A machine with two replicas, as deploy/README.md sets it up below another folder."""

    checkout: Path
    root: Path
    replicas: dict[str, Unit]

    def commit(self, title: str) -> None:
        """Commit what the checkout holds."""
        git = [shutil.which("git") or "git", "-c", "user.name=A", "-c", "user.email=a@b"]
        for words in (["init", "-q"], ["add", "--all"], ["commit", "-qm", title]):
            subprocess.run([*git, *words], cwd=self.checkout, check=True)

    def release(self, ports: Iterable[str], restart: Callable[[str], bool]) -> Path:
        """Lay out the last commit and restart replicas on it."""
        new = release.lay_out(self.checkout, self.root, BASE)
        release.release(list(ports), self.root, new, restart)
        return new

    def change_a_script(self) -> None:
        """Let a browser's file have another name in the next release."""
        script = self.checkout / "ui/live/slider.js"
        script.write_text(f"{script.read_text()}// the next release\n")

    def restart(self, port: str) -> bool:
        """Restart a replica, and return whether it is ready."""
        self.replicas[port].stop()
        return self.replicas[port].start()

    def address(self, port: str) -> str:
        return f"http://127.0.0.1:{port}/{BASE}"

    def released(self, port: str) -> str:
        """Return the commit that a replica runs."""
        with urlopen(f"{self.address(port)}/healthz", timeout=30) as answer:
            return json.load(answer)["commit"]

    def page(self, port: str, name: str) -> str:
        """Return what a page says, which is drawn without a failure."""

        async def visit() -> str:
            async with Visitor(self.address(port)) as visitor:
                await visitor.open(name)
                return " ".join(visitor.texts())

        said = finished(visit())
        assert "its log records" not in said
        return said


@pytest.fixture(scope="module")
def host(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Host]:
    """Two replicas of the second release; the tests leave them running, on this or a later one."""
    folder = tmp_path_factory.mktemp("host")
    checkout, root = project.copy(folder / "checkout"), folder / "srv"
    packages = release.packages_of(checkout / "deploy/requirements.txt", root)
    packages.parent.mkdir(parents=True)
    packages.symlink_to(sys.prefix)
    packages.with_name(f"{packages.name}.made").touch()
    ports = [str(free_port()) for _ in range(2)]
    settings = {"STREAMLIT_SERVER_BASE_URL_PATH": BASE}
    units = {port: Unit(root, int(port), folder / f"{port}.log", **settings) for port in ports}
    host = Host(checkout, root, units)
    host.commit("The first release")
    host.release([], host.restart)
    host.change_a_script()
    host.commit("The second release")
    host.release(ports, lambda port: units[port].start())
    yield host
    for unit in units.values():
        unit.stop()


def test_an_update_breaks_no_page_of_replicas_that_still_run(host: Host) -> None:
    first, other = host.replicas
    old = host.released(first)
    next(host.checkout.glob("pages/*_Response.py")).write_text(
        f"import streamlit as st\nst.markdown({MARK!r})\n"
    )
    (host.checkout / "ui/words/response.py").write_text("")  # what the old page takes from there
    host.change_a_script()
    host.commit("The next release")

    def restart(port: str) -> bool:
        """See that one goes on as before until it is restarted, after the other."""
        assert (host.root / "current").resolve().name != old
        assert host.released(other) == old
        if port == other:
            assert host.released(first) != old
            for name in PAGES:
                assert MARK not in host.page(other, name)
        return host.restart(port)

    new = host.release(host.replicas, restart)
    for port in host.replicas:
        assert host.released(port) == new.name
        assert MARK in host.page(port, "Response")
    # What belonged to the release before the last one is gone.
    assert {path.name for path in (host.root / "releases").iterdir()} == {old, new.name}
    assert len(list((host.root / "venvs").iterdir())) == 2
    www = host.root / "www" / BASE / "app/static"
    assert len(list(www.glob("slider-*.js"))) == 2
    assert len(list(www.glob("plotly-*.min.js"))) == 1
    assert re.fullmatch("[0-9a-f]{12}", old)


def test_a_release_that_does_not_start_is_taken_back_and_its_visitors_stay(host: Host) -> None:
    first, other = host.replicas
    old, untouched = host.released(first), host.replicas[other].process
    home = host.checkout / "ui/words/home.py"
    words = home.read_text()
    home.write_text("raise RuntimeError('a mistake')\n")
    host.commit("A mistake")
    home.write_text(words)
    with pytest.raises(release.ReleaseError, match=f"{first} does not start.*{old} is put back"):
        host.release(host.replicas, host.restart)
    assert host.replicas[other].process == untouched
    assert (host.root / "current").resolve().name == old
    assert host.released(first) == old


def test_a_replica_that_hangs_is_started_anew(host: Host) -> None:
    port = next(iter(host.replicas))
    hung = host.replicas[port].process
    os.kill(hung, signal.SIGSTOP)
    until(lambda: host.replicas[port].process != hung)
    until(lambda: _answers(host, port))
    assert host.page(port, "")


def _answers(host: Host, port: str) -> bool:
    try:
        return bool(host.released(port))
    except OSError:
        return False


def test_the_path_is_the_one_of_the_replicas_settings(tmp_path: Path) -> None:
    (tmp_path / "env").write_text("A=b=c\nSTREAMLIT_SERVER_BASE_URL_PATH=a/b\n")
    assert release.base_path(tmp_path / "env") == "a/b"
    (tmp_path / "env").write_text("")
    assert release.base_path(tmp_path / "env") == ""


def test_a_server_that_is_never_ready_is_ended() -> None:
    watch = Watch([sys.executable, "-c", "import time; time.sleep(600)"], start=0.2)
    assert not watch.is_ready()
    assert watch.end() == -signal.SIGKILL


def test_a_watch_ends_with_its_server_and_passes_on_the_signal_to_end() -> None:
    told = "import time; print('begun', flush=True); time.sleep(600)"
    command = [sys.executable, "-m", "deploy.watch", sys.executable, "-c", told]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE) as watch:
        assert watch.stdout is not None
        assert watch.stdout.readline() == b"begun\n"
        watch.terminate()
        assert watch.wait(30) != 0
