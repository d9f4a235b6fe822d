"""Hostile sessions: python -m tests.load.flood ADDRESS [--sessions 20] [--seconds 10] [--rate 0]

Each asks for runs of whole pages of ever new machines, without waiting for an answer, `rate` a
second or as fast as they are taken, and comes back when it is turned away. They come from this
machine's address as everybody else, or from as many as --addresses says, where the server believes
a proxy's X-Forwarded-For. Printed are messages sent, openings and refusals.
"""

import argparse
import asyncio
import itertools
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from urllib.parse import urlsplit, urlunsplit

from streamlit.proto.BackMsg_pb2 import BackMsg
from websockets.asyncio.client import connect
from websockets.exceptions import WebSocketException

PAGES = ("", "Stability", "Response", "Coefficients")
MARK = "81.2345"  # stands in all that they send


def main() -> None:
    """Flood, and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("address")
    parser.add_argument("--sessions", type=int, default=20)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--rate", type=float, default=0.0)
    parser.add_argument("--addresses", type=int, default=0)
    done = asyncio.run(flood(**vars(parser.parse_args())))
    print(", ".join(f"{times} {what}" for what, times in done.items()))  # noqa: T201


@contextmanager
def flooded(address: str, **options: float) -> Iterator[None]:
    """Let hostile sessions flood a server from a process of their own meanwhile."""
    words = [word for name, value in options.items() for word in (f"--{name}", str(value))]
    command = [sys.executable, "-m", "tests.load.flood", address, "--seconds", "600", *words]
    process = subprocess.Popen(command)
    try:
        yield
    finally:
        process.kill()
        process.wait()


async def flood(
    address: str, *, sessions: int, seconds: float, rate: float, addresses: int
) -> Counter[str]:
    """Let hostile sessions flood a server; return what they did and met."""
    done: Counter[str] = Counter()
    until = time.monotonic() + seconds
    names = [f"198.51.100.{i + 1}" for i in range(addresses)] or [""]
    await asyncio.gather(
        *(
            _session(address, until, rate, done, seed=i, name=names[i % len(names)])
            for i in range(sessions)
        )
    )
    return done


async def _session(
    address: str, until: float, rate: float, done: Counter[str], *, seed: int, name: str
) -> None:
    parts = urlsplit(address)
    stream = urlunsplit(("ws", parts.netloc, f"{parts.path}/_stcore/stream", "", ""))
    origin = f"{parts.scheme}://{parts.netloc}"
    headers = {"X-Forwarded-For": name} if name else {}
    numbers = itertools.count(seed * 1000)
    while time.monotonic() < until:
        try:
            async with connect(
                stream, origin=origin, subprotocols=["streamlit", "-"],  # type: ignore[arg-type]
                max_size=None, proxy=None, open_timeout=5, close_timeout=1,
                additional_headers=headers,
            ) as socket:  # fmt: skip
                done["opened"] += 1
                ignoring = asyncio.create_task(_ignore(socket))
                while time.monotonic() < until:
                    await socket.send(_run(next(numbers)))
                    done["sent"] += 1
                    await asyncio.sleep(1 / rate if rate else 0)
                ignoring.cancel()
        except (WebSocketException, OSError) as error:
            done[f"times {error}"[:60]] += 1
            await asyncio.sleep(0.1)


async def _ignore(socket: object) -> None:
    with suppress(WebSocketException):
        async for _ in socket:  # type: ignore[attr-defined]
            pass


def _run(number: int) -> bytes:
    message = BackMsg()
    asked = message.rerun_script
    asked.page_name = PAGES[number % len(PAGES)]
    asked.query_string = f"C={MARK}&mass={300 + number % 100}&cs=1000"
    asked.context_info.timezone = "UTC"
    return message.SerializeToString()


if __name__ == "__main__":
    main()
