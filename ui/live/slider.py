"""Sliders that send while they move, each with a field to type a value."""

from collections.abc import Sequence
from dataclasses import dataclass

from streamlit.components.v2 import component

from ui.live import assets
from ui.live.message import Move, echo, taken

_component = component("rotorcalc.sliders", js=assets.module("slider"), isolate_styles=False)


@dataclass(frozen=True)
class Slider:
    """A slider as it is shown.

    `low` to `high` is the range; its track is a window on it, logarithmic, or linear of width
    `span` where there is one, with a key's `step`. `least` is the lowest value beside zero of a
    range that begins there; `beyond` is the word for one more stop above `high`. At such a stop the
    window lies about `usual`. `preset` is a value that no drag or key passes unseen. Where `window`
    has two values the track is fixed between them.
    """

    name: str
    label: str
    help: str
    value: float | str
    low: float
    high: float
    usual: float
    preset: float | str | None = None
    least: float = 0.0
    step: float = 0.0
    span: float = 0.0
    beyond: str = ""
    window: tuple[float, ...] = ()


def show(
    sliders: Sequence[Slider],
    *,
    key: str,
    frame: int,
    on_move: Move,
    while_dragging: bool = True,
) -> None:
    """Show some sliders below each other, one element of the page.

    They send through the page's preview. The whole page runs only where there is no preview, or
    where a run is under way. `frame` is the number of the frame in which they are drawn.
    """
    _component(
        key=key,
        # A list: Streamlit would look through a dictionary for data frames, at some cost.
        data=[
            [vars(slider) for slider in sliders],
            {"whileDragging": while_dragging, "echo": echo(), "frame": frame},
        ],
        on_moved_change=lambda: taken(key, on_move),
    )  # fmt: skip
