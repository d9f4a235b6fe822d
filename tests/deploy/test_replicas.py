"""Two replicas: visitors stay with theirs, and keep their machine when it stops."""

import asyncio
import re
import signal
from collections.abc import Callable, Coroutine
from functools import wraps
from typing import Any, ParamSpec

import pytest

from tests.deploy.conftest import BASE, NAMES, Site
from tests.load.client import ServerError, Visitor
from tests.load.replicas import ROOT
from tests.waiting import finished

P = ParamSpec("P")
COOKIE = "rotorcalc_replica"
PATIENCE = 5.0  # seconds in which a visitor is sent on


def awaited(test: Callable[P, Coroutine[Any, Any, None]]) -> Callable[P, None]:
    """Return a test that runs a coroutine to its end."""

    @wraps(test)
    def run(*args: P.args, **kwargs: P.kwargs) -> None:
        finished(test(*args, **kwargs))

    return run


async def _come_back(visitor: Visitor) -> None:
    """Act as a browser that has lost its connection: try again until there is an answer."""
    for _ in range(40):
        try:
            await visitor.reconnect()
            return
        except (ServerError, OSError):
            await asyncio.sleep(0.25)
    pytest.fail("the visitor found no replica")


def _value(visitor: Visitor, label: str) -> float:
    slider = visitor.live_slider(label)
    assert slider is not None

    return slider["value"]


@awaited
async def test_new_visitors_are_shared_out_and_stay_with_their_replica(site: Site) -> None:
    visitors = [site.visitor() for _ in range(4)]
    for visitor in visitors:
        await visitor.open()
    assert sorted(visitor.cookies[COOKIE] for visitor in visitors) == ["1", "1", "2", "2"]
    for visitor in visitors:
        theirs = visitor.cookies[COOKIE]
        for _ in range(3):
            await visitor.reconnect()
            assert visitor.cookies[COOKIE] == theirs
        await visitor.close()


def test_a_file_comes_from_the_visitors_own_replica(site: Site) -> None:
    for name in NAMES:
        for _ in range(4):
            answer = site.get("/rotorcalc/", Cookie=f"{COOKIE}={name}")
            assert f"{COOKIE}={name};" in str(answer.headers.get_all("Set-Cookie"))


@awaited
async def test_visitors_of_a_killed_replica_keep_their_machine(site: Site) -> None:
    async with site.visitor(**{COOKIE: "1"}) as visitor:
        await visitor.open("Stability", "D=120&units=US")
        await visitor.slide("Radial clearance", 3.0)
        await visitor.open_tab("Figures of the notes")
        before = visitor.query
        assert "D=120" in before
        site.replicas["1"].kill()
        try:
            await _come_back(visitor)
            assert visitor.cookies[COOKIE] == "2"
            assert visitor.query == before
            assert _value(visitor, "Radial clearance") == pytest.approx(3.0)
            assert _value(visitor, "Diameter") == pytest.approx(120 / 25.4)
            await visitor.slide("Radial clearance", 4.0)
            assert _value(visitor, "Radial clearance") == pytest.approx(4.0)
        finally:
            site.start("1")


@awaited
async def test_an_idle_visitor_of_a_lost_replica_gets_the_page_from_the_other(site: Site) -> None:
    async with site.visitor(**{COOKIE: "1"}) as visitor:
        await visitor.open("Equilibrium", "C=70.5")
        runs = visitor.tally.runs
        site.replicas["1"].kill()
        try:
            await _come_back(visitor)
            assert visitor.tally.runs == runs + 1
            await visitor.slide("Radial clearance", 71.0)
            assert visitor.query == "C=71"
        finally:
            site.start("1")


@awaited
async def test_a_rolling_restart_keeps_every_visitors_inputs(site: Site) -> None:
    visitors = [site.visitor(**{COOKIE: NAMES[i % 2]}) for i in range(4)]
    for i, visitor in enumerate(visitors):
        await visitor.open("", f"mass={300 + i}")
        await visitor.slide("Radial clearance", 70 + i)
    for name in NAMES:
        site.replicas[name].stop()
        lost = [visitor for visitor in visitors if visitor.cookies[COOKIE] == name]
        await asyncio.gather(*(_come_back(visitor) for visitor in lost))
        site.start(name)
    for i, visitor in enumerate(visitors):
        await visitor.slide("Length", 50)
        assert _value(visitor, "Radial clearance") == 70 + i
        assert _value(visitor, "Rotor mass") == 300 + i
        await visitor.close()


@awaited
async def test_nobody_is_without_a_page_while_one_replica_is_well(site: Site) -> None:
    """The new replica's first request, a websocket, does not end; then the other one stops."""
    site.replicas["1"].stop()
    assert _named(site, "1") == "2"
    site.start("1")
    async with site.visitor(**{COOKIE: "1"}) as visitor:
        await visitor.open()
        site.replicas["2"].stop()
        try:
            assert [_named(site, name) for name in ("1", "2", "")] == ["1"] * 3
        finally:
            site.start("2")


@awaited
async def test_visitors_of_a_replica_that_hangs_are_sent_on(site: Site) -> None:
    hung = site.replicas["1"].process
    hung.send_signal(signal.SIGSTOP)
    try:
        for path in ("", "Stability", "_stcore/host-config"):
            assert _named(site, "1", path) == "2"
        assert _named(site, "1", "_stcore/health") == "2"
        for _ in range(3):  # whichever has fewer connections
            assert site.get(f"/{BASE}/", timeout=PATIENCE).status == 200
        async with site.visitor(**{COOKIE: _named(site, "1", "_stcore/health")}) as visitor:
            await visitor.open()
    finally:
        hung.send_signal(signal.SIGCONT)


def test_a_browser_waits_longer_for_a_sign_than_nginx_for_a_replica() -> None:
    text = (ROOT / "deploy/nginx.conf").read_text()
    (health,) = re.findall(r"location = /rotorcalc/_stcore/health \{(.*?)\}", text, re.DOTALL)
    waits = [int(number) for number in re.findall(r"_timeout (\d+)ms;", health)]
    script = (ROOT / "ui/live/connection.js").read_text()
    assert len(waits) == 2
    assert sum(waits) < int(re.findall(r"const LOOK = (\d+);", script)[0])


def _named(site: Site, name: str, path: str = "") -> str:
    """Return the replica that answers a visitor of another, soon enough."""
    answer = site.get(f"/{BASE}/{path}", timeout=PATIENCE, Cookie=f"{COOKIE}={name}")
    assert answer.status == 200
    cookies = str(answer.headers.get_all("Set-Cookie"))
    return re.findall(rf"{COOKIE}=(\w+);", cookies)[0]
