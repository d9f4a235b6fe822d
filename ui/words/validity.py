"""The validity panel: where the model holds for this machine, and where it is strained."""

import streamlit as st

from rotorcalc.validity import Check
from ui.computed import Computed
from ui.format import digits
from ui.preview import Preview, Text

_BADGES = {"good": "green", "caution": "orange", "outside": "red"}
_FILM = ":small[Film: {}, laminar, isoviscous, aligned, rigid walls. Orbits: small.]"
WORDS = {"good": "holds", "caution": "strained", "outside": "outside"}


def worst(computed: Computed) -> Check:
    """Return the assumption that a machine satisfies worst at its running speed."""
    return max(computed.checks, key=lambda check: list(_BADGES).index(check.worst))


def headline(computed: Computed) -> str:
    """Return the worst of the assumptions in a few words."""
    check = worst(computed)
    if check.worst == "good":
        return "The model holds"
    state = "strained" if check.worst == "caution" else "outside its range"
    return f"The model is {state}: {check.name}"


def badge(computed: Computed) -> str:
    """Return the headline in its colour, Markdown."""
    return f":{_BADGES[worst(computed).worst]}-badge[{headline(computed)}]"


def panel(computed: Computed) -> Text:
    """Return each assumption with its number and limits."""
    lines = map(_line, computed.checks)
    return Text("\n\n".join([*lines, _FILM.format(computed.machine.bearing.model)]))


def draw(preview: Preview) -> None:
    """Show all assumptions in an expander; the worst of them stands with the verdict."""
    with st.expander("Where the model holds", expanded=False, key="validity"):
        preview.say("assumptions", panel)


def _line(check: Check) -> str:
    badge = f":{_BADGES[check.worst]}-badge[{WORDS[check.worst]}]"
    limits = f"limits {digits(float(check.caution))} and {digits(float(check.limit))}"
    text = f"{badge} {check.name}: **{digits(float(check.value))}** ({limits})"
    return text if check.worst == "good" else f"{text}: {check.reason}."
