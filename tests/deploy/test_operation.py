"""What a server writes and answers: its first line, failures with their id, its health."""

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import rotorcalc
from tests.load.client import Visitor
from tests.load.replicas import ROOT, Replica
from tests.waiting import finished
from ui.serving import health, settings, version

ENTERED = "81.2345"  # stands for what a visitor entered

# A server like ours whose page fails with a visitor's number in the exception.
_FAILING = """
import streamlit as st
if "C" in st.query_params:
    raise ValueError(f"radial_clearance = {st.query_params['C']} m")
"""


@pytest.fixture(scope="module")
def failing(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Replica]:
    """A server of the app, but for its page."""
    folder = tmp_path_factory.mktemp("failing")
    page, app = folder / "page.py", folder / "app.py"
    page.write_text(_FAILING)
    text = (ROOT / "app.py").read_text()
    assert text.count("__file__") == 1
    app.write_text(text.replace("__file__", f"{str(page)!r}"))
    replica = Replica(script=app, PYTHONPATH=str(ROOT), ROTORCALC_LOG="json")
    yield replica.wait()
    replica.stop()


def _lines(replica: Replica) -> list[dict[str, Any]]:
    lines = replica.log.read_text().splitlines()
    return [json.loads(line) for line in lines if line.startswith("{")]


async def _visit(address: str) -> list[str]:
    async with Visitor(address) as visitor:
        await visitor.open(query=f"C={ENTERED}")
        return visitor.texts()


def test_a_failure_has_an_id_on_page_and_in_log_without_visitor_data(
    failing: Replica,
) -> None:
    said = " ".join(finished(_visit(failing.address)))
    numbers = re.findall(r"\*\*([0-9a-f]{8})\*\*", said)
    assert len(numbers) == 1
    (failure,) = [line for line in _lines(failing) if line["event"] == "failed"]
    assert failure["id"] == numbers[0]
    assert failure["level"] == "error"
    assert failure["type"] == "ValueError"
    assert any("page.py:4" in place for place in failure["places"])
    assert ENTERED not in failing.log.read_text()
    assert "Traceback" not in said
    assert "page.py" not in said


def test_the_log_begins_with_version_and_commit(failing: Replica) -> None:
    start = next(line for line in _lines(failing) if line["event"] == "start")
    assert start["version"] == rotorcalc.__version__
    assert start["commit"] == version.commit()
    assert {"time", "level", "python", "streamlit", "replica"} <= start.keys()


def test_the_health_check_computes_a_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    health.check()
    monkeypatch.setitem(health._EXPECTED, "sommerfeld", 3.9)
    with pytest.raises(health.WrongAnswerError, match=r"sommerfeld = 3\.91447: must be 3\.9"):
        health.check()


@pytest.mark.parametrize(
    ("name", "word", "read"),
    [
        ("ROTORCALC_HEAVY_JOBS", "0", settings.heavy_jobs),
        ("ROTORCALC_HEAVY_JOBS", "many", settings.heavy_jobs),
        ("ROTORCALC_MAX_SOCKETS", "-1", settings.limits),
        ("ROTORCALC_REPLICA", "a; Path=/", settings.replica),
        ("ROTORCALC_LOG", "xml", settings.log),
        ("ROTORCALC_DOCS", "javascript:alert(1)", settings.docs),
    ],
)
def test_an_invalid_setting_is_refused_by_name(
    name: str, word: str, read: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(name, word)
    with pytest.raises(ValueError, match=re.escape(f"{name} = {word!r}: must be")):
        read()


@pytest.mark.parametrize(
    ("name", "word", "said"),
    [
        ("ROTORCALC_DOC", "/docs", "ROTORCALC_DOC is no setting .* perhaps to ROTORCALC_DOCS"),
        ("ROTORCALC_MAX_SOCKET", "9", "perhaps to ROTORCALC_MAX_SOCKETS, or unset it"),
        ("rotorcalc_live", "off", "perhaps to ROTORCALC_LIVE"),
        ("ROTORCALC_LIVE", "yes", "one of drag, release, off; unset it for drag"),
        ("ROTORCALC_HEAVY_JOBS", "0", "whole number from 1 to 64; unset it for 1"),
    ],
)
def test_a_wrong_setting_ends_the_start_with_a_line(
    name: str, word: str, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for own in ("ROTORCALC_SERVICE_HOST", "ROTORCALC_DOCS_PORT", "ROTORCALC_DOCS_SERVICE_HOST"):
        monkeypatch.setenv(own, "10.0.0.1")  # as Kubernetes sets it
    settings.end_where_wrong()
    monkeypatch.setenv(name, word)
    with pytest.raises(SystemExit, match=said) as found:
        settings.end_where_wrong()
    assert "\n" not in str(found.value)


def test_the_server_itself_ends_with_that_line() -> None:
    words = [sys.executable, "-m", "streamlit", "run", "app.py", "--server.headless", "true"]
    done = subprocess.run(
        [*words, "--server.port", "0"], cwd=ROOT, capture_output=True, text=True, timeout=60,
        env={**os.environ, "ROTORCALC_HEAVY_JOBS": "many"}, check=False,
    )  # fmt: skip
    assert done.returncode != 0
    said = done.stdout + done.stderr
    assert "The server does not start: ROTORCALC_HEAVY_JOBS = 'many': must be a whole" in said
    assert "Traceback" not in said


def test_a_host_names_the_commit_where_there_is_no_checkout(monkeypatch) -> None:
    version.commit.cache_clear()
    monkeypatch.setenv("ROTORCALC_COMMIT", "0123456789abcdef")
    try:
        assert version.label() == f"rotorcalc {rotorcalc.__version__} · 0123456789ab"
    finally:
        version.commit.cache_clear()


def test_the_commit_of_another_users_checkout_is_known(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    git = [shutil.which("git") or "git", "-c", "user.name=A", "-c", "user.email=a@b"]
    for words in (["init", "-q"], ["commit", "-q", "--allow-empty", "-m", "First"]):
        subprocess.run([*git, *words], cwd=tmp_path, check=True)
    monkeypatch.delenv("ROTORCALC_COMMIT", raising=False)
    monkeypatch.setenv("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1")
    monkeypatch.setattr(version, "_ROOT", tmp_path)
    version.commit.cache_clear()
    try:
        assert re.fullmatch("[0-9a-f]{7,12}", version.commit())
    finally:
        version.commit.cache_clear()
