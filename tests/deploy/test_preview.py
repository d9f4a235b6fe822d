"""Previews while a slider is dragged, straight and through the proxy."""

import asyncio
import json
from contextlib import closing
from http.client import HTTPConnection
from urllib.parse import urlsplit

import pytest

from tests.deploy.conftest import Site
from tests.deploy.test_replicas import awaited
from tests.load.client import Visitor
from tests.load.replicas import Replica


@awaited
async def test_a_preview_has_charts_and_numbers_and_is_not_stored(server: Replica) -> None:
    async with Visitor(server.address) as visitor:
        await visitor.open("Stability")
        said = visitor.texts()
        answer = await visitor.preview("Radial clearance", 83)
        assert {"chart_threshold", "chart_whirl_frequency"} <= answer["charts"].keys()
        (row,) = answer["rows"].values()
        numbers = [number for number, _, _ in row]
        assert not any(number in " ".join(said) for number in numbers[:3])
        await visitor.rerun()
        assert visitor.texts() == said
        assert visitor.query == ""
        await visitor.slide("Radial clearance", 83)
        shown = [element.metric.body for element in visitor.elements("metric")]
        assert shown == numbers


@pytest.mark.parametrize("name", ["", "Equilibrium", "Coefficients", "Root_locus", "Response"])
@awaited
async def test_every_page_has_a_preview(server: Replica, name: str) -> None:
    async with Visitor(server.address) as visitor:
        await visitor.open(name)
        answer = await visitor.preview("Film temperature", 71.5)
        assert answer["charts"]
        assert answer["rows"]


@awaited
async def test_a_stranger_gets_no_preview(server: Replica) -> None:
    async with Visitor(server.address) as visitor:
        await visitor.open()
        for token in ("0", "x" * 2000, "../etc"):
            assert visitor.ask("C", 83, token) == (204, b"")


@awaited
async def test_an_invalid_value_gets_no_preview(server: Replica) -> None:
    async with Visitor(server.address) as visitor:
        await visitor.open()
        for name, value in [
            ("C", "much"), ("C", 1e9), ("C", ""), ("C", "nan"), ("C", "9" * 5000), ("C", "rigid"),
            ("C", "5e-324"), ("nothing", 1), ("__class__", 1), ("", ""), ("load", "None"),
        ]:  # fmt: skip
            status, body = visitor.ask(name, value)
            answer = json.loads(body)
            assert status == 200
            assert answer.pop("refused"), (name, value)
            assert answer == {"charts": {}, "texts": {}, "rows": {}}, (name, value)


@awaited
async def test_a_page_sends_one_request_at_a_time(server: Replica) -> None:
    async with Visitor(server.address) as visitor:
        await visitor.open()
        known = visitor.preview_data()
        port = urlsplit(server.address).port

        def ask(value: int) -> int:
            with closing(HTTPConnection("127.0.0.1", port, timeout=30)) as connection:
                path = f"{known['address']}?name=C&value={value}"
                connection.request("GET", path, headers={"X-Rotorcalc-Page": known["token"]})
                return connection.getresponse().status

        asked = (asyncio.to_thread(ask, value) for value in range(70, 90))
        answers = await asyncio.gather(*asked)
        assert set(answers) == {200, 429}


@awaited
async def test_through_the_proxy_it_comes_from_the_visitors_own_replica(site: Site) -> None:
    async with site.visitor() as visitor:
        await visitor.open("Equilibrium")
        for clearance in range(80, 90):
            answer = await visitor.preview("Radial clearance", clearance)
            assert answer["charts"]
