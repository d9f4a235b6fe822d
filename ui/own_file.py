"""A visitor's own file of coefficients: read once, and how its axes lie as a picture."""

import base64
import threading
from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

from rotorcalc import read_coefficients
from rotorcalc.coefficient_files import Axes, ReadTable, Scale
from rotorcalc.figures import style
from ui.serving import one_at_a_time

_READING = threading.Lock()
_SIZE, _MIDDLE, _ARM = 190.0, 95.0, 62.0
_TEXT = "#7d7d7d"
_ANCHORS = {-1: "end", 0: "middle", 1: "start"}


class Read(NamedTuple):
    """What was read of a file, or why it was refused."""

    table: ReadTable | None
    problem: str = ""


def read(
    raw: bytes,
    axes: tuple[str | None, str | None],
    units: Mapping[str, str] | None = None,
    scale: Scale | None = None,
) -> Read:
    """Return what a file holds; `axes` are load axis and sense of rotation, None for the file's."""
    return _read(raw, axes, tuple((units or {}).items()), scale)


# A file has at most a megabyte, and is asked for at each run of its page.
@lru_cache(maxsize=24)
def _read(
    raw: bytes,
    axes: tuple[str | None, str | None],
    units: tuple[tuple[str, str], ...],
    scale: Scale | None,
) -> Read:
    try:
        # A workbook is read by another process, which may take long and much memory: one at a time,
        # and only who sent one waits for it.
        with one_at_a_time.PAGES.aside(), _READING:
            return Read(
                read_coefficients(
                    raw, load_axis=axes[0], turns=axes[1], units=dict(units), scale=scale
                )
            )
    except ValueError as error:
        return Read(None, str(error))


def picture(load_axis: str, turns: str) -> str:
    """Return as HTML the file's axes x, y, the load, the rotation, and X, Y of the program."""
    T = Axes(load_axis, turns).T
    X, Y = (tuple(row) for row in T.tolist())
    # The rotation from X to Y, drawn where neither axis is: opposite to both.
    start, stop = (-X[0], -X[1]), (-Y[0], -Y[1])
    sweep = 1 if turns == "y to x" else 0
    drawn = [
        f'<circle cx="{_MIDDLE}" cy="{_MIDDLE}" r="30" fill="none" stroke="{_TEXT}"/>',
        _arrow((1.0, 0.0), _ARM, _TEXT, 1.5),
        _arrow((0.0, 1.0), _ARM, _TEXT, 1.5),
        _word("x", (1.0, 0.0), _ARM + 12, _TEXT, (0.0, 13.0)),
        _word("y", (0.0, 1.0), _ARM + 12, _TEXT, (-13.0, 0.0)),
        _arrow(X, 46.0, style.RED, 4.0),
        _word("X, load", X, _ARM + 24, style.RED),
        _word("Y", Y, _ARM + 24, style.Y),
        _arrow(Y, 46.0, style.Y, 3.0),
        _turning(start, stop, sweep),
    ]
    svg = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-60 -8 {_SIZE + 120} {_SIZE + 16}" '
        f'font-family="Source Sans, Arial, sans-serif" font-size="15">{"".join(drawn)}</svg>'
    )
    address = f"data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}"
    words = f"The load acts along {load_axis}; the shaft turns from {turns}."
    return f'<img src="{address}" alt="{words}" width="212" height="141">'


def _at(direction: tuple[float, ...], radius: float) -> tuple[float, float]:
    """Return a place of the drawing, x to the right and y upward."""
    return _MIDDLE + radius * direction[0], _MIDDLE - radius * direction[1]


def _arrow(direction: tuple[float, ...], length: float, colour: str, width: float) -> str:
    (x, y), head = _at(direction, length), 5.0 + width
    ahead = (direction[0] * head * 1.6, -direction[1] * head * 1.6)
    side = (direction[1] * head * 0.7, direction[0] * head * 0.7)
    corners = (
        f"{x + ahead[0]},{y + ahead[1]} {x + side[0]},{y + side[1]} {x - side[0]},{y - side[1]}"
    )
    return (
        f'<line x1="{_MIDDLE}" y1="{_MIDDLE}" x2="{x}" y2="{y}" stroke="{colour}" '
        f'stroke-width="{width}"/><polygon points="{corners}" fill="{colour}"/>'
    )


def _word(
    text: str,
    direction: tuple[float, ...],
    radius: float,
    colour: str,
    shift: tuple[float, float] = (0.0, 0.0),
) -> str:
    # A longer word beside a horizontal arrow begins, or ends, where the arrow does.
    side = direction[0] if len(text) > 1 else 0.0
    x, y = _at(direction, radius - 10.0 * abs(side))
    return (
        f'<text x="{x + shift[0]}" y="{y + shift[1] + 5}" text-anchor="{_ANCHORS[round(side)]}" '
        f'fill="{colour}">{text}</text>'
    )


def _turning(start: tuple[float, float], stop: tuple[float, float], sweep: int) -> str:
    """Return an arc about the shaft with an arrowhead, and Ω beside it."""
    (x_1, y_1), (x_2, y_2) = _at(start, 40.0), _at(stop, 40.0)
    along = start[0] * -1.0, start[1] * -1.0  # at its end the arc runs along X
    tip = (x_2 + 11.0 * along[0], y_2 - 11.0 * along[1])
    side = (along[1] * 6.0, along[0] * 6.0)
    corners = f"{tip[0]},{tip[1]} {x_2 + side[0]},{y_2 + side[1]} {x_2 - side[0]},{y_2 - side[1]}"
    middle = (start[0] + stop[0]) / 2.0, (start[1] + stop[1]) / 2.0
    return (
        f'<path d="M {x_1} {y_1} A 40 40 0 0 {sweep} {x_2} {y_2}" fill="none" '
        f'stroke="{style.OCHRE}" stroke-width="2.5"/>'
        f'<polygon points="{corners}" fill="{style.OCHRE}"/>'
        + _word("Ω", middle, 78.0, style.OCHRE)
    )
