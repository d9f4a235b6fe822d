"""Sessions on the app, as people use it: python -m tests.load [ADDRESS ...]

Without an address it starts --replicas servers of its own, and prints their memory and processor
time too. Sessions go to the addresses in turns, as sticky sessions behind a proxy do.

    python -m tests.load --sessions 50                  one process, three minutes
    python -m tests.load --sessions 80 --replicas 2     two
    python -m tests.load --sessions 40 --soak 10000     memory over many actions
    python -m tests.load --sessions 5 --hostile 20      beside sessions that flood each server

It leaves with an error where a session saw one, or where a bound is broken: 95 % of the answers in
0.15 s, beside a flood in 0.5 s; there also memory, rest afterwards, and the time to end.
"""

import argparse
import asyncio
import os
import sys
import time
from contextlib import ExitStack

from tests.load.client import Tally, Visitor
from tests.load.flood import flooded
from tests.load.replicas import Replica
from tests.load.walk import EVERY, walk

LIMIT = 0.150  # seconds: the 95th percentile that is wanted
_LIMIT_FLOODED = 0.500  # the same beside a flood
_MEMORY = 500.0  # MB that a flooded server may hold
_REST = 60.0  # seconds after a flood in which a server is to come to rest
_RESTING = 0.05  # of a core, at most
_END = 5.0  # seconds in which a flooded server is to end
_CHUNK = 60.0  # seconds between two looks at the memory


def main() -> None:
    """Measure, and print; leave with an error where a session saw one or a bound is broken."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("address", nargs="*")
    parser.add_argument("--sessions", type=int, default=50)
    parser.add_argument("--minutes", type=float, default=3.0)
    parser.add_argument("--every", type=float, default=EVERY, help="seconds between two actions")
    parser.add_argument("--replicas", type=int, default=1, help="servers to start")
    parser.add_argument("--soak", type=int, default=0, help="actions; the memory is looked at")
    parser.add_argument("--hostile", type=int, default=0, help="flooding sessions on each server")
    parser.add_argument("--addresses", type=int, default=0, help="addresses that these come from")
    parser.add_argument("--rate", type=float, default=0.0, help="their messages a second, 0: all")
    asked = parser.parse_args()
    with ExitStack() as stack:
        own = [] if asked.address else [Replica() for _ in range(asked.replicas)]
        for replica in own:
            stack.callback(replica.stop)
        addresses = asked.address or [replica.wait().address for replica in own]
        if asked.soak:
            failures = _soak(addresses, own, asked)
        else:
            warm(addresses)
            with _flood(addresses, asked):
                failures = _measure(addresses, own, asked)
            if own and asked.hostile:
                failures += _aftermath(own[0], asked)
    sys.exit("\n".join(failures) or None)


def warm(addresses: list[str]) -> None:
    """Let each server import and compile what a first visitor would otherwise wait for."""
    asyncio.run(crowd(addresses, sessions=2 * len(addresses), seconds=6.0, every=0.3, seed=999))


async def crowd(
    addresses: list[str], *, sessions: int, seconds: float, every: float, seed: int = 0
) -> list[Tally]:
    """Let sessions walk at once; return what each has seen."""
    visitors = [Visitor(addresses[i % len(addresses)]) for i in range(sessions)]
    until = time.perf_counter() + seconds
    walks = (
        walk(visitor, until=until, every=every, seed=seed + i) for i, visitor in enumerate(visitors)
    )
    try:
        await asyncio.gather(*walks)
    finally:
        await asyncio.gather(*(visitor.close() for visitor in visitors))
    return [visitor.tally for visitor in visitors]


def percentile(values: list[float], share: float) -> float:
    """Return the value that a share of the values do not exceed."""
    return sorted(values)[min(int(share * len(values)), len(values) - 1)]


def _measure(addresses: list[str], own: list[Replica], asked: argparse.Namespace) -> list[str]:
    used = sum(replica.seconds() for replica in own)
    tallies = asyncio.run(
        crowd(addresses, sessions=asked.sessions, seconds=60 * asked.minutes, every=asked.every)
    )
    used = sum(replica.seconds() for replica in own) - used
    runs = sum(tally.runs for tally in tallies)
    _say(
        f"{asked.sessions} sessions on {len(addresses)} process(es), an action every "
        f"{asked.every:g} s, {asked.minutes:g} min: {_summary(tallies)}"
    )
    if own:
        _say(f"processor: {used / runs * 1e3:.0f} ms a run; memory: {_memory(own)}")
    limit = _LIMIT_FLOODED if asked.hostile else LIMIT
    slow = percentile([one for tally in tallies for one in tally.latencies], 0.95)
    return _errors(tallies) + _above({"95 % of the answers [s]": (slow, limit)})


def _flood(addresses: list[str], asked: argparse.Namespace) -> ExitStack:
    """Let hostile sessions flood each server until the stack is left."""
    stack = ExitStack()
    for address in addresses if asked.hostile else []:
        hostile = {"sessions": asked.hostile, "addresses": asked.addresses, "rate": asked.rate}
        stack.enter_context(flooded(address, **hostile))
    return stack


def _above(measured: dict[str, tuple[float, float]]) -> list[str]:
    """Return a text of the measurements above their bounds."""
    return [
        f"{name}: {value:.3g}, above {bound:g}"
        for name, (value, bound) in measured.items()
        if value > bound
    ]


def _aftermath(server: Replica, asked: argparse.Namespace) -> list[str]:
    """Look at a server that was flooded: its memory, whether it rests, and how soon it ends.

    Return what is above its bound.
    """
    time.sleep(_REST)
    used = server.seconds()
    time.sleep(5)
    used = (server.seconds() - used) / 5
    _say(
        f"most memory {server.peak():.0f} MB; {_REST:.0f} s after the flood "
        f"{server.memory():.0f} MB, {used:.1%} of a core"
    )
    peak = server.peak()
    with _flood([server.address], asked):
        time.sleep(5)
        start = time.perf_counter()
        server.process.terminate()
        server.process.wait()
        ended = time.perf_counter() - start
    _say(
        f"flooded again, it ended {ended:.1f} s after SIGTERM; "
        f"machine's load {os.getloadavg()[0]:.0f} on {os.cpu_count()} cores"
    )
    return _above({
        "memory [MB]": (peak, _MEMORY), "cores in use after a minute": (used, _RESTING),
        "end after SIGTERM [s]": (ended, _END),
    })  # fmt: skip


def _soak(addresses: list[str], own: list[Replica], asked: argparse.Namespace) -> list[str]:
    """Walk in rounds of new sessions, and look at the memory after each."""
    errors: list[str] = []
    done = number = 0
    while done < asked.soak:
        number += 1
        tallies = asyncio.run(
            crowd(
                addresses, sessions=asked.sessions, seconds=_CHUNK, every=asked.every,
                seed=number * asked.sessions,
            )
        )  # fmt: skip
        done += sum(tally.runs for tally in tallies)
        errors += _errors(tallies)
        _say(f"{done} actions, {number * asked.sessions} sessions: {_memory(own)}; "
             f"{_summary(tallies)}")  # fmt: skip
    return errors


def _summary(tallies: list[Tally]) -> str:
    latencies = [latency for tally in tallies for latency in tally.latencies]
    low, high, most = (percentile(latencies, share) * 1e3 for share in (0.5, 0.95, 1.0))
    received = sum(tally.received for tally in tallies) / len(latencies) / 1e3
    return (
        f"{len(latencies)} runs, median {low:.0f} ms, 95 % {high:.0f} ms, longest "
        f"{most:.0f} ms, {received:.0f} kB each, {len(_errors(tallies))} error(s)"
    )


def _errors(tallies: list[Tally]) -> list[str]:
    errors = [error for tally in tallies for error in tally.errors]
    for error in sorted(set(errors)):
        _say(f"error, {errors.count(error)} times: {error}")
    return errors


def _memory(own: list[Replica]) -> str:
    return ", ".join(f"{replica.memory():.0f} MB" for replica in own) or "not known"


def _say(line: str) -> None:
    print(line, flush=True)  # noqa: T201 - what this script is for


if __name__ == "__main__":
    main()
