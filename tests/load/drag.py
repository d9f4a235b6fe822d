"""Sessions that drag a slider at once: python -m tests.load.drag ADDRESS [--sessions 10]

Each sends as the app's slider does: the next value when the last one is answered, and the last
value when the thumb is let go. Printed are the longest times from letting go until charts and page
show it, and the most runs that one session had under way.
"""

import argparse
import asyncio
import math
import statistics
import sys
import time

from tests.load.client import ServerError, Tally, Visitor

SLIDER, LOW, HIGH = "Radial clearance", 60, 140
PERIOD = 4.0  # seconds for the thumb to go there and back


async def drag(visitor: Visitor, seconds: float) -> tuple[float, float]:
    """Drag a slider there and back by whole micrometres.

    Return how long after letting go the charts of the last value and the whole page were there.
    """
    start = time.perf_counter()
    released = start + seconds
    shown = 0
    while (now := time.perf_counter()) < released:
        value = _thumb(now - start)
        if value == shown:
            await asyncio.sleep(0.016)  # the thumb has not moved since, a frame of a screen ago
        else:
            await visitor.preview(SLIDER, value)
            shown = value
    if shown != _thumb(seconds):
        await visitor.preview(SLIDER, _thumb(seconds))
    charts = time.perf_counter() - released
    await visitor.slide(SLIDER, _thumb(seconds), dragging=False)
    return charts, time.perf_counter() - released


def _thumb(seconds: float) -> int:
    return round(LOW + (HIGH - LOW) * abs(math.sin(math.pi * seconds / PERIOD)))


async def crowd(
    address: str, *, sessions: int, seconds: float, page: str = ""
) -> tuple[list[tuple[float, float]], list[Tally]]:
    """Let sessions drag at once; return how long each one's last value took, and their tallies."""
    visitors = [Visitor(address) for _ in range(sessions)]
    try:
        for visitor in visitors:
            await visitor.open(page)
        settled = await asyncio.gather(*(drag(visitor, seconds) for visitor in visitors))
    finally:
        await asyncio.gather(*(visitor.close() for visitor in visitors))
    return settled, [visitor.tally for visitor in visitors]


def main() -> None:
    """Drag, and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("address")
    parser.add_argument("--sessions", type=int, default=10)
    parser.add_argument("--seconds", type=float, default=8.0)
    parser.add_argument("--page", default="", help="its name in the address, e.g. Stability")
    asked = parser.parse_args()
    try:
        settled, tallies = asyncio.run(
            crowd(asked.address, sessions=asked.sessions, seconds=asked.seconds, page=asked.page)
        )
    except (ServerError, OSError) as error:
        sys.exit(f"{error}")
    rate = statistics.median(tally.previewed / asked.seconds for tally in tallies)
    charts, pages = (max(taken) * 1e3 for taken in zip(*settled, strict=True))
    most = max(tally.most_under_way for tally in tallies)
    print(  # noqa: T201 - what this script is for
        f"{asked.sessions} sessions dragging for {asked.seconds:g} s: {rate:.1f} answers/s a "
        f"session; after letting go the last value's charts were there in at most {charts:.0f} ms, "
        f"the whole page in {pages:.0f} ms; at most {most} run(s) of a session under way"
    )


if __name__ == "__main__":
    main()
