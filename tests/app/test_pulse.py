"""When a server says that it lives, and when it does not."""

import asyncio
from types import SimpleNamespace

import pytest

from tests.waiting import finished
from ui.jobs import queue
from ui.serving import health, own_visit, pulse
from ui.serving.pulse import Pulse


class Host:
    """A server's parts that a test may break, its clock, and what it says."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now, self.page, self.core, self.process = 0.0, "", "", ""
        self.said: list[str] = []
        monkeypatch.setattr(pulse, "time", SimpleNamespace(monotonic=lambda: self.now))
        monkeypatch.setattr(pulse, "tell", self.said.append)
        monkeypatch.setattr(health, "check", lambda: self.core)
        monkeypatch.setattr(own_visit, "fault_of", self._drawn)
        line = SimpleNamespace(name="releases", inspect=lambda: self.process)
        monkeypatch.setattr(queue, "LINES", (line,))
        self.pulse = Pulse()

    async def _drawn(self) -> str:
        if self.page == "hangs":
            await asyncio.Event().wait()
        return self.page

    def looks(self) -> dict[str, str]:
        """Let the server look at itself a minute later."""
        self.now += 60.0
        return finished(self.pulse.look(patience=0.5))

    def beats(self) -> bool:
        """Return whether it says now that it lives."""

        async def once() -> None:
            beating = asyncio.create_task(self.pulse._beats())
            await asyncio.sleep(0)
            beating.cancel()

        self.said.clear()
        finished(once())
        return self.said == ["WATCHDOG=1"]


@pytest.fixture
def host(monkeypatch: pytest.MonkeyPatch) -> Host:
    return Host(monkeypatch)


@pytest.mark.parametrize(
    ("part", "name", "why"),
    [("page", "pages", "it fails"), ("page", "pages", "hangs"), ("core", "core", "wrong")],
)
def test_a_server_that_neither_draws_nor_computes_gives_no_sign_of_life(
    host: Host, part: str, name: str, why: str
) -> None:
    assert host.looks() == {}
    assert host.beats()
    setattr(host, part, why)
    assert host.looks().keys() == {name}
    assert host.pulse.faults().keys() == {name}
    assert not host.beats()
    setattr(host, part, "")
    assert host.looks() == {}
    assert host.beats()


def test_a_lost_process_is_told_and_no_reason_to_end_the_server(host: Host) -> None:
    host.process = "it does not answer"
    assert host.looks() == {"releases": "it does not answer"}
    assert host.beats()


def test_a_server_that_no_longer_looks_at_itself_is_not_well(host: Host) -> None:
    host.looks()
    host.now += 60.0
    assert host.pulse.faults().keys() == {"server"}
    assert not host.beats()
