"""Print every text that a visitor can see, each once with where it stands: python -m tests.words.

Texts that differ by their numbers only count as one. The list is there to be read.
"""

import json
import os
import re
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from google.protobuf.message import Message
from streamlit.testing.v1 import AppTest

from rotorcalc import PRESETS, CoefficientTable, analyse
from rotorcalc.coefficient_table import OWN
from tests.app.session import EXERCISES_PAGE, LECTURE, ORBITS, PAGES, open_part, tours, visit
from ui.bearing import kinds
from ui.exercises.collection import EXERCISES
from ui.lecture.steps import own_steps
from ui.lecture.views import VIEWS
from ui.own import text_of

# A bearing's own coefficients as a link has them: four speeds of the sheet's.
_SWEEP = analyse(PRESETS["sheet-1e8"].machine, np.array([200.0, 500.0, 800.0, 1200.0]))
_OWN = text_of(CoefficientTable(
    speed=_SWEEP.speed, stiffness=_SWEEP.stiffness, damping=_SWEEP.damping
))  # fmt: skip
# Machines and links of every kind, by name.
STATES: dict[str, dict[str, str]] = {
    "": {},
    **{key: {"preset": key} for key in list(PRESETS)[1:]},
    "unstable": {"rpm": "10000"},
    "far above its onset": {"rpm": "100000", "rpm_max": "120000"},
    "far below its onset": {"rpm": "100"},
    "zero load": {"load": "0"},
    "light load": {"load": "1"},
    "heavy load": {"load": "20000"},
    "rigid": {"k": "inf"},
    "damped, journal mass": {"cs": "5000", "mj": "10"},
    "strongly damped": {"cs": "200000"},
    "balanced": {"u": "0"},
    "large imbalance": {"u": "200"},
    "outside the model": {"L": "300", "C": "200", "rpm": "30000"},
    "small": {"mass": "0.1", "D": "7", "L": "3", "C": "15", "rpm": "100000", "mu": "5"},
    "cases": {"cases": "Wide~1~C~95~~Hot~2~T~90"},
    "US units": {"units": "US"},
    "bad link": {"C": "-3", "mass": "1,334", "tab": "Nowhere", "what": "5"},
    "no machine": {"mj": "200"},
    "presentation": {"present": "1"},
    "peak to peak": {"amplitude": "p-p"},
    "oil supply": {"T_in": "45", "flow": "2", "share": "1"},
    "hardly any oil": {"T_in": "45", "flow": "0.1", "share": "1"},
    "foil, heavy load": {"bearing": "foil"},
    "foil, light load": {"bearing": "foil", "load": "20", "mass": "4.08", "rpm": "30000"},
    **{kind: {"bearing": kind} for kind in kinds() if kind not in ("plain", "foil", OWN)},
    "own coefficients": {"bearing": OWN, "table": _OWN},
    "no coefficients": {"bearing": OWN},
}
# Names of an element's fields that hold what is read, not what identifies or styles it.
_READ = {
    "label", "help", "body", "delta", "placeholder", "alt", "text", "title", "options", "message",
    "icon_text", "caption", "value",
}  # fmt: skip
_TAGS = re.compile(r"<style.*?</style>|<[^>]+>", re.DOTALL)
# Of a figure, what is drawn as text.
_DRAWN = {"text", "name", "ticktext", "title", "hovertemplate"}
_POPOVERS = ("share", "settings", "oil_library", "cases")
_LONG = {"orbits_run_up": "Run-up", "orbits_cycles": "Limit cycles"}


def texts(at: AppTest) -> Iterator[str]:
    """Yield every text of a page as it stands: labels, tooltips, words, charts, alternatives."""
    for element in _elements(at):
        if (spec := getattr(element, "spec", "")) and isinstance(spec, str):
            yield from _of_figure(json.loads(spec))
        yield from _of_message(element)


def toured(page: str, query: dict[str, str]) -> Iterator[tuple[str, str]]:
    """Yield where each text of a page stands, and the text, with every tab and popover opened."""
    at = visit(page, **query)
    for key in _popovers(at):
        at.session_state[key] = True
    for tab in tours(at):
        yield from ((f"{PAGES[page]} > {tab}" if tab else PAGES[page], text) for text in texts(at))


def once(found: Iterable[tuple[str, str]]) -> dict[str, tuple[str, str]]:
    """Return where each text stands first, and the text, those that differ by numbers as one."""
    seen: dict[str, tuple[str, str]] = {}
    for where, text in found:
        seen.setdefault(re.sub(r"[−-]?\d[\d.]*", "#", text), (where, text))
    return seen


def _elements(at: AppTest) -> Iterator[Message]:
    nodes: list[Any] = [at._tree]
    while nodes:
        node = nodes.pop()
        if (proto := getattr(node, "proto", None)) is not None:
            yield proto
        nodes += reversed(list(getattr(node, "children", {}).values()))


def _of_message(message: Message) -> Iterator[str]:
    for field, value in message.ListFields():
        values = value if isinstance(value, Iterable) and not isinstance(value, str) else [value]
        for one in values if not isinstance(values, dict) else ():
            if isinstance(one, Message):
                yield from _of_message(one)
            elif isinstance(one, str) and field.name in _READ:
                yield from _tidy(one)


def _of_figure(node: Any) -> Iterator[str]:
    if isinstance(node, dict):
        for key, value in node.items():
            for one in value if isinstance(value, list) else [value]:
                if key in _DRAWN and isinstance(one, str):
                    yield from _tidy(one.replace("<br>", " / "))
            yield from _of_figure(value)
    elif isinstance(node, list) and node and isinstance(node[0], dict):
        for value in node:
            yield from _of_figure(value)


def _tidy(text: str) -> Iterator[str]:
    """Yield a text without markup of HTML, where any is left."""
    if found := _TAGS.sub("", text).strip():
        yield found


def _popovers(at: AppTest) -> list[str]:
    keys = (getattr(proto, "id", "") for proto in _elements(at))
    explained = re.findall(r"explain_\w+", " ".join(key for key in keys if isinstance(key, str)))
    return [*dict.fromkeys(explained), *_POPOVERS]


def _computed_on_request() -> Iterator[tuple[str, str]]:
    for key, tab in _LONG.items():
        for query in ({}, {"u": "0", "C": "150"}):
            at = visit(ORBITS, **query)
            open_part(at, "orbits_tab", tab)
            at.button(key=key).click().run()
            yield from ((f"Orbits > {tab}, computed", text) for text in texts(at))


def staged() -> Iterator[tuple[str, str]]:
    """Yield the texts of the lecture's steps, before and after the answer, and of the exercises."""
    for number in range(1, len(own_steps(frozenset(VIEWS))) + 1):
        at = visit(LECTURE, step=f"{number}")
        yield from ((f"Lecture, step {number}", text) for text in texts(at))
        at.button(key="lecture_show").click().run()
        yield from ((f"Lecture, step {number}, answered", text) for text in texts(at))
    for number in range(1, len(EXERCISES) + 1):
        at = visit(EXERCISES_PAGE, exercise=f"{number}")
        yield from ((f"Exercises, {number}", text) for text in texts(at))
        for field in at.text_input:
            field.set_value("1")
        at.run()
        yield from ((f"Exercises, {number}, answered", text) for text in texts(at))


def main() -> None:
    """Print the list, page by page."""
    os.environ["ROTORCALC_LIVE"] = "off"
    found = (
        (f"{where}{f' ({state})' if state else ''}", text)
        for state, query in STATES.items()
        for page in PAGES
        for where, text in toured(page, query)
    )
    for where, text in once([*found, *staged(), *_computed_on_request()]).values():
        print(f"[{where}]\n    " + text.replace("\n", "\n    "))  # noqa: T201


if __name__ == "__main__":
    main()
