"""What is written of what happens often."""

import re
from pathlib import Path
from types import SimpleNamespace

import pytest
from starlette.types import Message, Receive, Scope, Send

from tests.waiting import finished
from ui.frame.page import PAGES
from ui.serving import log
from ui.serving.guard import refusal, strangers


class Written:
    """The log's events, and the ids that visitors are shown; its clock stands still."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now = 0.0
        self.events: list[dict[str, object]] = []
        self.shown: list[str] = []
        monkeypatch.setattr(log, "time", SimpleNamespace(monotonic=lambda: self.now))
        monkeypatch.setattr(log, "event", lambda _, **told: self.events.append(told))
        monkeypatch.setattr(log.st, "error", lambda words, **_: self.shown.append(words))
        monkeypatch.setattr(log, "_FAILURES", log.Rarely())
        monkeypatch.setattr(refusal, "_REFUSALS", log.Rarely())


@pytest.fixture
def written(monkeypatch: pytest.MonkeyPatch) -> Written:
    return Written(monkeypatch)


def _fail(kind: type[Exception]) -> None:
    try:
        raise kind("81.2345")
    except kind as error:
        log.failed(error)


def _fail_elsewhere() -> None:
    try:
        raise ValueError
    except ValueError as error:
        log.failed(error)


def test_failures_at_one_place_are_one_line_in_ten_seconds_and_its_id_is_shown(
    written: Written,
) -> None:
    for _ in range(500):
        _fail(ValueError)
        written.now += 0.01
    assert [told["times"] for told in written.events] == [1]
    written.now += 10
    _fail(ValueError)
    assert [told["times"] for told in written.events] == [1, 500]
    first, second = (told["id"] for told in written.events)
    assert [f"**{first}**" in words for words in written.shown] == [True] * 500 + [False]
    assert f"**{second}**" in written.shown[-1]


def test_failures_of_another_type_or_place_have_lines_of_their_own(written: Written) -> None:
    _fail(ValueError)
    _fail(TypeError)
    _fail_elsewhere()
    assert len({told["id"] for told in written.events}) == 3


def test_refusals_are_written_by_their_reason(written: Written) -> None:
    for why in ("one", "other", "one"):
        refusal.count(why)
    assert [told["why"] for told in written.events] == ["one", "other"]


@pytest.mark.parametrize(("login", "status"), [({}, 404), ({"redirect_uri": "here"}, 302)])
def test_the_paths_of_a_login_are_there_where_one_is_set_up(
    login: dict[str, str], status: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    sent: list[Message] = []

    async def app(_: Scope, __: Receive, send: Send) -> None:
        await send({"type": "http.response.start", "status": 302, "headers": []})

    async def send(message: Message) -> None:
        sent.append(message)

    monkeypatch.setattr(strangers, "get_secrets_auth_section", lambda: login)
    scope = {
        "type": "http", "method": "GET", "path": "/oauth2callback",
        "headers": [(b"host", b"localhost:8501")], "client": ("127.0.0.1", 1),
    }  # fmt: skip
    finished(strangers.OwnSite(app)(scope, None, send))  # type: ignore[arg-type]
    assert sent[0]["status"] == status


def test_the_proxys_log_knows_every_page() -> None:
    config = (Path(__file__).parents[2] / "deploy" / "nginx.conf").read_text(encoding="utf-8")
    named = re.search(r"rotorcalc_known>/rotorcalc/\(([^)]*)", config)
    pages = {re.sub(r".*/\d+_(.*)\.py", r"\1", path) for path in PAGES} - {"app.py"}
    assert named
    assert pages <= set(named[1].split("|"))
