"""Links and files made to break the program: never a traceback, a hang, or markup."""

import copy
import json
import re
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from streamlit.testing.v1 import AppTest

from rotorcalc import PRESETS, Machine
from tests.app.session import HOME, OTHERS, open_part, session_of, visit
from ui.bearing import fields_of
from ui.bores import NAMES
from ui.inputs import INPUTS, inputs_of, machine_of
from ui.sharing.address import read

MARK = "zqx"  # in whatever is drawn, to find it again on the page
MARKUP = [
    f"<img src=x onerror={MARK}>", f"[{MARK}](javascript:{MARK})", f"![{MARK}](//evil/{MARK})",
    f"`<b>{MARK}</b>`", f"``{MARK}`", f"$\\href{{javascript:{MARK}}}{{x}}$", f":red[{MARK}]",
    f"\n\n# {MARK}", f"\u202e{MARK}", f"{MARK}\x00", f"&lt;{MARK}&gt;",
    f"../../{MARK}", f"file:///{MARK}", f"{{{{{MARK}}}}}", f"%s{MARK}%n",
]  # fmt: skip
NUMBERS = [
    "0", "-0", "1e308", "-1e308", "1e-320", "inf", "-inf", "nan", "9" * 5000, "0." + "0" * 5000,
    "1_000", "0x1p3", "١٢", "1e999999999", "+", "", " 80 ", "weight", "rigid",
]  # fmt: skip
WORDS = st.sampled_from([*MARKUP, *NUMBERS]) | st.text(max_size=30).map(lambda text: MARK + text)
KEYS = st.sampled_from([*INPUTS, "preset", "units"]) | st.sampled_from(MARKUP)
IN_RANGE = st.sampled_from(list(INPUTS.values())).flatmap(
    lambda item: st.tuples(
        st.just(item.key),
        st.sampled_from([item.low, item.high]).map(repr) | st.floats(item.low, item.high).map(repr),
    )
)
LINKS = st.lists(st.tuples(KEYS, WORDS) | IN_RANGE, max_size=8).map(dict)
UNHURRIED = settings(
    max_examples=10, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


class Watch:
    """Hears which files are opened while it listens."""

    def __init__(self) -> None:
        self._listening = False
        self.written: list[str] = []
        self.named: list[str] = []

    def __call__(self, event: str, args: tuple[Any, ...]) -> None:
        # A file's number instead of its path is one that is open already.
        if not self._listening or event != "open" or isinstance(args[0], int):
            return
        path, mode = str(args[0]), str(args[1] or "")
        if set(mode) & set("wax+"):
            self.written.append(path)
        if MARK in path:
            self.named.append(path)

    def __enter__(self) -> None:
        self._listening = True

    def __exit__(self, *_: object) -> None:
        self._listening = False


WATCH = Watch()
sys.addaudithook(WATCH)


def _without_code(text: str) -> str:
    return re.sub(r"`[^`\n]*`", "", text)


def _said(at: AppTest) -> list[str]:
    """Return every text of the page that is shown as Markdown."""
    kinds = ("markdown", "caption", "warning", "error", "info", "success", "header", "subheader")
    return [str(element.value) for kind in kinds for element in at.get(kind)]


def _unharmed(at: AppTest) -> None:
    assert not at.exception
    assert WATCH.written == []
    assert WATCH.named == []
    for text in _said(at):
        assert MARK not in _without_code(text), text


@pytest.mark.parametrize("path", [HOME, OTHERS[2]])
@UNHURRIED
@given(link=LINKS)
@example(link=dict.fromkeys(MARKUP, "1"))
@example(link={key: MARKUP[i % len(MARKUP)] for i, key in enumerate(INPUTS)})
@example(link={"preset": MARKUP[0], "units": MARKUP[1]})
def test_no_link_breaks_a_page_or_injects_markup(path: str, link: dict[str, str]) -> None:
    with WATCH:
        at = visit(path, **link)
    _unharmed(at)


@pytest.mark.parametrize("kind", NAMES)
def test_no_field_of_a_bore_breaks_a_page_or_injects_markup(kind: str) -> None:
    hostile = [*MARKUP, *NUMBERS]
    keys = [*fields_of(kind), "film"]
    for i, word in enumerate(hostile):
        link = {"bearing": kind} | {
            key: hostile[(i + place) % len(hostile)] for place, key in enumerate(keys)
        }
        found = read(link)
        with suppress(ValueError):  # refused in words
            machine_of(found.values)
        refused = [key for key in keys if any(key in problem for problem in found.problems)]
        assert refused or word in NUMBERS or keys == ["film"], link
    with WATCH:
        at = visit(HOME, bearing=kind, **dict(zip(keys, MARKUP, strict=False)))
    _unharmed(at)


def _places(tree: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    for key, value in tree.items():
        yield (*path, key)
        if isinstance(value, dict):
            yield from _places(value, (*path, key))


GOOD = json.loads(PRESETS["sheet-1e8"].machine.to_json())
JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | WORDS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(WORDS, inner, max_size=3),
    max_leaves=6,
)


@st.composite
def _machines(draw: st.DrawFn) -> str:
    """Draw a machine's file with some of its parts changed, taken out or added."""
    tree = copy.deepcopy(GOOD)
    for path in draw(st.lists(st.sampled_from(list(_places(GOOD))), min_size=1, max_size=3)):
        part = tree
        for key in path[:-1]:
            part = part[key] if isinstance(part, dict) and key in part else {}
        if not isinstance(part, dict):
            continue
        change = draw(st.sampled_from(["replace", "remove", "add"]))
        if change == "remove":
            part.pop(path[-1], None)
        else:
            part[path[-1] if change == "replace" else draw(WORDS)] = draw(JSON)
    return json.dumps(tree)


# A file as large as the server takes, of each kind that costs a reader most.
MEGABYTE = 10**6
MONSTERS = {
    "digits": json.dumps(GOOD).replace('"temperature": 60.0', f'"temperature": {"9" * MEGABYTE}'),
    "exponent": json.dumps(GOOD).replace("60.0", f"1e{'9' * MEGABYTE}"),
    "quoted digits": json.dumps(GOOD).replace("60.0", f'"{"9" * MEGABYTE}"'),
    "depth": "[" * MEGABYTE,
    "objects": '{"a":' * (MEGABYTE // 5),
    "keys": "{" + ",".join(f'"{MARK}{i}":1' for i in range(70000)) + "}",
    "key": json.dumps({MARK * (MEGABYTE // 3): 1}),
    "spaces": " " * MEGABYTE,
    "nothing": "",
    "no text": "\x00" * MEGABYTE,
    "surrogate": '{"\\ud800": 1}',
    "no object": "[]",
    "infinite": json.dumps(GOOD).replace("60.0", "Infinity"),
}


@settings(max_examples=300, deadline=None)
@given(text=_machines() | st.text(max_size=60))
def test_a_file_gives_a_machine_or_the_reason_why_it_cannot(text: str) -> None:
    try:
        machine = Machine.from_json(text)
    except ValueError as error:
        said = str(error)
    else:
        said = ""
        assert Machine.from_json(machine.to_json()) == machine
    assert len(said.encode()) < 2000


@pytest.mark.parametrize("kind", MONSTERS)
def test_no_file_blocks_the_server(kind: str) -> None:
    start = time.process_time()
    with pytest.raises(ValueError, match=r"."):
        Machine.from_json(MONSTERS[kind])
    assert time.process_time() - start < 2.0


def test_a_number_with_a_million_decimals_is_read_to_rounding() -> None:
    text = json.dumps(GOOD).replace("60.0", f"60.{'1' * MEGABYTE}")
    assert Machine.from_json(text).temperature == pytest.approx(60 + 1 / 9, rel=1e-15)


@pytest.fixture(scope="module")
def sharing() -> AppTest:
    at = visit(HOME, C="80")
    open_part(at, "share")
    return at


@UNHURRIED
@given(text=_machines() | st.sampled_from(sorted(MONSTERS.values())), name=st.sampled_from(MARKUP))
def test_no_upload_breaks_the_page_or_injects_markup(
    text: str, name: str, sharing: AppTest
) -> None:
    content = text.encode("utf-8", "surrogatepass")
    with WATCH:
        sharing.file_uploader(key="upload").upload(
            f"{name}.json".replace("\x00", ""), content
        ).run()
    _unharmed(sharing)
    values = session_of(sharing).values
    assert not any(item.problem(values[key]) for key, item in inputs_of(values).items())
