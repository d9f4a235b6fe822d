"""Many visitors on one process: none is frozen by another, none has two runs under way."""

import asyncio
import random

from tests.deploy.test_replicas import awaited
from tests.load.client import Tally, Visitor
from tests.load.drag import crowd
from tests.load.replicas import Replica
from tests.load.walk import act, is_refused

PATIENCE = 5.0  # seconds: far more than a page takes here, far less than the heavy ones


async def _asks_for_maps(visitor: Visitor, ended: asyncio.Event) -> None:
    """Ask for one onset map on eigenvalues after another, the heaviest of all pages."""
    clearance = 60
    while not ended.is_set():
        await visitor.slide("Radial clearance", clearance)
        clearance += 1


@awaited
async def test_one_visitors_heavy_requests_do_not_freeze_the_others(server: Replica) -> None:
    heavy = [Visitor(server.address) for _ in range(3)]
    light = [Visitor(server.address) for _ in range(4)]
    ended = asyncio.Event()
    for i, visitor in enumerate(heavy):
        await visitor.open("Stability", f"cs=1000&mj={i + 1}")
        await visitor.open_tab("Map")
    for visitor in light:
        await visitor.open("Equilibrium")
    work = [asyncio.create_task(_asks_for_maps(visitor, ended)) for visitor in heavy]
    slowest = 0.0
    for clearance in range(70, 76):
        for visitor in light:
            await visitor.slide("Radial clearance", clearance)
            slowest = max(slowest, visitor.tally.latencies[-1])
    ended.set()
    await asyncio.gather(*work)
    await asyncio.gather(*(visitor.close() for visitor in [*heavy, *light]))
    assert slowest < PATIENCE
    assert all(visitor.tally.errors == [] for visitor in [*heavy, *light])
    assert all(visitor.tally.runs > 2 for visitor in heavy)


@awaited
async def test_ten_sessions_dragging_have_one_run_each_and_all_see_the_last_value(
    server: Replica,
) -> None:
    settled, tallies = await crowd(server.address, sessions=10, seconds=4.0)
    assert max(page for _, page in settled) < PATIENCE
    assert [tally.most_under_way for tally in tallies] == [1] * 10
    assert _errors(tallies) == []


@awaited
async def test_a_visitor_cannot_read_another_visitors_session(server: Replica) -> None:
    async with Visitor(server.address) as one, Visitor(server.address) as other:
        await one.open(query="C=81.2345")
        await other.open()
        assert one.session_id != other.session_id
        assert other.query == ""
        assert "81.2345" not in " ".join(other.texts())


@awaited
async def test_a_simulated_visitor_moves_back_a_slider_that_makes_no_machine(
    server: Replica,
) -> None:
    async with Visitor(server.address) as visitor:
        await visitor.open(query="mass=300")
        visitor.moved[:] = [("Journal mass", 0.0)]
        await visitor.slide("Journal mass", 160.0)
        assert is_refused(visitor)
        await act(visitor, random.Random(0))
        assert not is_refused(visitor)
        assert visitor.query == "mass=300"


def _errors(tallies: list[Tally]) -> list[str]:
    return [error for tally in tallies for error in tally.errors]
