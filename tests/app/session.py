"""A visitor without a browser: opens pages, tabs and popovers, moves inputs, reads the page."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from streamlit.testing.v1 import AppTest

from ui.frame import page as frame
from ui.inputs import input_named
from ui.session import Session

ROOT = Path(__file__).resolve().parents[2]
TIMEOUT = 60  # seconds; a run takes 0.05, but the machine may be busy
_STAGES = {name: path for path, name in frame.PAGES.items() if name in ("Lecture", "Exercises")}
LECTURE, EXERCISES_PAGE = _STAGES["Lecture"], _STAGES["Exercises"]
# The pages of the visitor's own machine; a lecture and exercises have machines of their own.
PAGES = {path: name for path, name in frame.PAGES.items() if name not in _STAGES}
HOME, *OTHERS = PAGES
_BY_NAME = {name: path for path, name in PAGES.items()}
ORBITS, BEARINGS_PAGE, NOTES = (_BY_NAME[name] for name in ("Orbits", "Bearings", "Notes"))
TOLERANCES = _BY_NAME["Tolerances"]
YOUR_DATA = _BY_NAME["Your data"]

# A number that is none, as Python writes it, where a reader should find a word.
_NO_NUMBER = re.compile(r"(?<![\w\\])(nan|NaN|None|-?inf|Infinity)(?![\w:])")

_CELL = re.compile(r"<td[^>]*>(.*?)</td>")


def visit(page: str, **query: str) -> AppTest:
    """Return a new session on a page, cold, with a link's parameters."""
    at = AppTest.from_file(ROOT / HOME, default_timeout=TIMEOUT)
    at.query_params.update(query)
    if page != HOME:
        at.switch_page(page)
    return at.run()


def session_of(at: AppTest) -> Session:
    """Return the visitor's session."""
    return at.session_state["rotorcalc"]


def tabs(at: AppTest) -> list[tuple[str, str]]:
    """Return every tab of the page as the key of its row and its label."""
    return [
        (row.key, tab.label) for row in at.get("tab_container") for tab in row.children.values()
    ]


def tours(at: AppTest) -> Iterator[str]:
    """Open the page's tabs one after the other, and yield the label of each; "" without tabs."""
    found = tabs(at)
    if not found:
        yield ""
    for key, label in found:
        open_part(at, key, label)
        yield label


def open_part(at: AppTest, key: str, value: str | bool = True) -> None:
    """Open a tab by its label, or a popover."""
    at.session_state[key] = value
    at.run()


def slider_keys(at: AppTest) -> list[str]:
    """Return the keys of all sliders of the machine's inputs."""
    return [
        slider.key
        for slider in (*at.slider, *at.select_slider)
        if re.fullmatch(r"input_\w+_slider", slider.key or "")
    ]


def slider(at: AppTest, key: str) -> tuple[Any, Any, Any]:
    """Return a slider and the values at its ends."""
    found = [one for one in at.slider if one.key == key]
    if found:
        return found[0], found[0].min, found[0].max
    visitor = session_of(at)
    item = input_named(key.split("_", 1)[1].rsplit("_", 2)[0], visitor.values)
    units = visitor.units
    low, high = (item.shown(end, units) for end in (item.low, item.high))
    return at.select_slider(key=key), low, float("inf") if item.infinite else high


def move(at: AppTest, key: str, value: float) -> None:
    """Move an input, given in the unit of the link, by its slider in SI."""
    slider(at, f"input_{key}_SI_slider")[0].set_value(value).run()


def charts(at: AppTest) -> dict[str, dict[str, Any]]:
    """Return the figures shown, by key."""
    return {chart.key: json.loads(chart.proto.spec) for chart in at.get("plotly_chart")}


def texts(at: AppTest) -> Iterator[str]:
    """Yield every text that the page shows, but for links and the sidebar's fields."""
    for metric in at.metric:
        yield f"{metric.label}: {metric.value} {metric.delta}"
    for found in (at.caption, at.markdown, at.header, at.subheader, at.latex):
        yield from (element.value for element in found)
    for box in (at.success, at.info, at.warning, at.error):
        yield from (element.value for element in box)
    for table in at.table:
        yield table.value.to_string()
    yield from comparison(at).values()
    for figure in charts(at).values():
        yield from _words(figure)


def comparison(at: AppTest) -> dict[str, str]:
    """Return the table of cases: the texts of each row, by its quantity."""
    found = [one.proto.body for one in at.get("html") if "<table" in one.proto.body]
    rows = re.findall(r'<tr><th scope="row">(.*?)</th>(.*?)</tr>', "".join(found))
    return {
        label: " | ".join(re.sub("<small>", " ", text) for text in _CELL.findall(cells))
        for label, cells in ((label, cells.replace("</small>", "")) for label, cells in rows)
    }


def _words(node: Any) -> Iterator[str]:
    """Yield the texts of a figure: titles, names, annotations, tick labels."""
    if isinstance(node, dict):
        for key, value in node.items():
            if key in ("text", "name", "ticktext", "title", "hovertemplate"):
                yield from _strings(value)
            yield from _words(value)
    elif isinstance(node, list) and node and isinstance(node[0], dict):
        for value in node:
            yield from _words(value)


def _strings(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, list):
        yield from (text for text in value if isinstance(text, str))


def faults(at: AppTest) -> list[str]:
    """Return all that a page should never show: tracebacks, error boxes, numbers that are none.

    That a machine is unstable may stand in an error box: it is the answer, no fault.
    """
    found = [f"{error.value}\n{''.join(error.stack_trace)}" for error in at.exception]
    found += [error.value for error in at.error if "unstable" not in error.value.lower()]
    found += [text for text in texts(at) if _NO_NUMBER.search(text)]
    return found
