"""What people do with the app: move a slider, open a tab, go to another page, a pause between.

Who has made a machine that cannot be, such as journals heavier than the rotor, puts the slider back
with the next action. Without that a third of all runs would be of pages that only say so.
"""

import asyncio
import random
import time
from typing import Any

from tests.load.client import ServerError, Visitor
from ui.frame.page import NO_MACHINE, PAGES

EVERY = 3.0  # seconds from one action to the next
# Shares of the actions; the rest goes to another page.
SLIDES, TABS = 0.7, 0.15


async def walk(visitor: Visitor, *, until: float, every: float, seed: int) -> None:
    """Open the home page and act until a time, at a steady pace that begins anywhere in it."""
    dice = random.Random(seed)
    due = time.perf_counter() + dice.random() * every
    begun = False
    while due < until:
        await asyncio.sleep(max(0.0, due - time.perf_counter()))
        try:
            if begun:
                await act(visitor, dice)
            else:
                await visitor.open()
                begun = True
        except ServerError:  # counted by the visitor, who goes on as people do
            await visitor.reconnect()
        # Who waited for an answer thinks no shorter for it.
        due = max(due + every, time.perf_counter())


async def act(visitor: Visitor, dice: random.Random) -> None:
    """Do one thing."""
    chance = dice.random()
    rows = visitor.tab_rows()
    if visitor.moved and is_refused(visitor):
        await visitor.slide(*visitor.moved.pop())
    elif chance < SLIDES and (sliders := visitor.live_sliders()):  # exercises have none
        data = dice.choice(sliders)
        visitor.moved[:] = [(data["label"], data["value"])]
        await visitor.slide(data["label"], place(data, dice.random()))
    elif chance < SLIDES + TABS and rows:
        await visitor.open_tab(dice.choice(dice.choice(rows)[1]))
    else:
        await visitor.go(dice.choice(list(PAGES.values())))


def is_refused(visitor: Visitor) -> bool:
    """Return whether the page says that its inputs make no machine."""
    return any(element.alert.title == NO_MACHINE for element in visitor.elements("alert"))


def place(data: dict[str, Any], share: float) -> float:
    """Return the value at a share of a live slider's track, as it lies about the preset's value."""
    preset = data["preset"]
    about = preset if isinstance(preset, float | int) and preset > 0.0 else data["usual"]
    value = about + (share - 0.5) * data["span"] if data["span"] else about * 4.0 ** (share - 0.5)
    return min(max(float(f"{value:.3g}"), data["low"]), data["high"])
