"""What a visitor writes on a report and a file: title, author, name of the machine, note."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields

import streamlit as st

_KEY = "rotorcalc_labels"
_WORDS = {
    "name": "Name of this machine", "note": "Remarks", "title": "Title of the report",
    "author": "Author",
}  # fmt: skip
_LONGEST = {"note": 2000}


def _longest(label: str) -> int:
    """Return how many letters a label has at most."""
    return _LONGEST.get(label, 120)


@dataclass
class Labels:
    """A report's title and author, a machine's name and remarks on it."""

    name: str = ""
    note: str = ""
    title: str = ""
    author: str = ""


def labels() -> Labels:
    """Return the visitor's labels."""
    return st.session_state.setdefault(_KEY, Labels())


def draw() -> Labels:
    """Show a field for each label; return them."""
    mine = labels()
    for field in fields(Labels):
        key, most = f"label_{field.name}", _longest(field.name)
        st.session_state.setdefault(key, getattr(mine, field.name))
        draw_one = st.text_area if field.name == "note" else st.text_input
        setattr(mine, field.name, draw_one(_WORDS[field.name], max_chars=most, key=key) or "")
    return mine


def name(name: str, note: str) -> None:
    """Take over a file's name and remarks."""
    recall({"name": name, "note": note})


def kept() -> dict[str, str]:
    """Return the labels, for the browser to keep."""
    return asdict(labels())


def recall(kept: Mapping[str, str]) -> None:
    """Take over some labels; before their fields are drawn."""
    mine = labels()
    for field in fields(Labels):
        if field.name in kept:
            setattr(mine, field.name, kept[field.name][: _longest(field.name)])
            st.session_state.pop(f"label_{field.name}", None)
