"""Choices beside the machine, such as the open tab: kept from page to page, and in the link.

A choice is known by the key of its widget, "<page>_<name>"; in a link by its name, as a link is of
one page. A value of a link or of a browser is untrusted: each widget says what it allows.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, TypeVar

import streamlit as st

from ui.format import quoted

Value = str | float | bool
T = TypeVar("T", str, float, int, bool)

# The names that a link may have.
NAMES = frozenset((
    "tab", "scale", "over", "axes", "shaft", "spiral", "shown", "varied", "x", "y", "vary",
    "wanted", "margin", "target", "kick", "revolutions",
    "speeds", "balance", "pace", "picture", "whirl", "step", "exercise",
    "spreads", "samples", "seed",
    "slowest", "fastest", "coupling", "qa", "stages", "grade",
    "load_axis", "turns", "which_s", "norm",
))  # fmt: skip
_KEY = "rotorcalc_choices"
# The choices of a release, which undo brings back: least and largest value of each.
KICKS, TURNS = (0.0, 1.2), (20, 600)
_RELEASE = {"orbits_kick": KICKS, "orbits_revolutions": TURNS}


@dataclass
class Choices:
    """What a visitor chose, by key; a link's words until used; this page's widgets' defaults."""

    chosen: dict[str, Value] = field(default_factory=dict)
    words: dict[str, str] = field(default_factory=dict)
    defaults: dict[str, Value] = field(default_factory=dict)

    def arrive(self) -> None:
        """Forget what belonged to the page that was left; its choices are kept."""
        self.words.clear()
        self.defaults.clear()

    def link(self) -> dict[str, str]:
        """Return this page's choices, where they differ from what it shows by itself."""
        self._look()
        return self.words | {
            _name(key): _written(self.chosen[key])
            for key, default in self.defaults.items()
            if self.chosen.get(key, default) != default
        }

    def kept(self) -> dict[str, Value]:
        """Return every choice, for a server without this session."""
        self._look()
        return self.chosen

    def release(self) -> dict[str, Value]:
        """Return the choices of a release, which undo brings back with its machine."""
        kept = self.kept()
        return {key: kept[key] for key in _RELEASE if key in kept}

    def restore(self, release: Mapping[str, Value]) -> None:
        """Bring back choices; before the widgets of a run are drawn."""
        self.chosen |= release
        for key in release.keys() & st.session_state.keys():
            st.session_state[key] = release[key]

    def recall(self, kept: object) -> None:
        """Restore what a browser kept."""
        given = kept if isinstance(kept, Mapping) else {}
        self.chosen |= {
            str(key): value for key, value in given.items() if isinstance(value, str | int | float)
        }

    def _look(self) -> None:
        """Take over the present values of this page's widgets; no others can have changed."""
        for key in self.defaults:
            with suppress(KeyError):
                self.chosen[key] = st.session_state[key]


def choices() -> Choices:
    """Return the visitor's choices."""
    return st.session_state.setdefault(_KEY, Choices())


def choice(key: str, default: T, allowed: Callable[[T], bool]) -> T | None:
    """Return with what a widget begins; None where the widget already has a value."""
    mine = choices()
    mine.defaults[key] = default
    word = mine.words.pop(_name(key), None)
    if key in st.session_state:
        mine.chosen[key] = st.session_state[key]
        return None
    given = mine.chosen.get(key, default) if word is None else word
    value = _taken(given, default, allowed)
    if value is None:
        st.warning(f"{_name(key)} = {quoted(given)} is not among this page's choices.")
        value = default
    mine.chosen[key] = value
    return value


def choose(
    label: str, options: Sequence[str], key: str, *, hidden: bool = False, **extra: Any
) -> str:
    """Show a choice of one among a few options, at first the first; return the chosen one."""
    chosen = st.segmented_control(
        label, options, key=key, required=True,
        default=choice(key, options[0], options.__contains__),
        label_visibility="collapsed" if hidden else "visible", **extra,
    )  # fmt: skip
    return chosen or options[0]


def words_of(release: Mapping[str, Value]) -> dict[str, str]:
    """Return the choices of a release as a link has them."""
    return {_name(key): _written(value) for key, value in release.items()}


def release_of(words: Mapping[str, str]) -> dict[str, Value]:
    """Return the choices of a release in a link's words, as far as they can be used."""
    found: dict[str, Value] = {}
    for key, (low, high) in _RELEASE.items():
        value = _taken(words.get(_name(key)), low, lambda _: True)
        if value is not None and low <= value <= high:
            found[key] = value
    return found


def _taken(given: object, default: T, allowed: Callable[[T], bool]) -> T | None:
    """Return a value in the default's type, None where it is none or is not allowed."""
    try:
        value = given == "yes" if isinstance(default, bool) and isinstance(given, str) else given
        value = type(default)(value)  # type: ignore[arg-type]
    except (ValueError, TypeError, OverflowError):
        return None
    return value if allowed(value) else None


def _written(value: Value) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _name(key: str) -> str:
    return key.partition("_")[2]
