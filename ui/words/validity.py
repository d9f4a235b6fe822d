"""The validity panel: where the model holds for this machine, and where it is strained."""

import streamlit as st

from rotorcalc.validity import Check, validity
from ui.computed import Computed
from ui.format import digits

_BADGES = {"good": "green", "caution": "orange", "outside": "red"}
_FILM = ":small[Film: {}, laminar, isoviscous, aligned, rigid walls. Orbits: small.]"
WORDS = {"good": "holds", "caution": "strained", "outside": "outside"}


def draw(computed: Computed) -> None:
    """Show each assumption with its number and limits; the headline tells the worst."""
    checks = validity(computed.point)
    worst = max(checks, key=lambda check: list(_BADGES).index(check.worst))
    strained = [check for check in checks if check.worst != "good"]
    headline = (
        "The model holds" if not strained else f"The model is {WORDS[worst.worst]}: {worst.name}"
    )
    with st.expander(headline, expanded=False, key="validity", icon=_icon(worst)):
        st.markdown(
            "\n\n".join([*map(_line, checks), _FILM.format(computed.machine.bearing.model)])
        )


def _icon(worst: Check) -> str:
    icons = {"good": "check_circle", "caution": "warning", "outside": "error"}
    return f":material/{icons[worst.worst]}:"


def _line(check: Check) -> str:
    badge = f":{_BADGES[check.worst]}-badge[{WORDS[check.worst]}]"
    limits = f"limits {digits(float(check.caution))} and {digits(float(check.limit))}"
    text = f"{badge} {check.name}: **{digits(float(check.value))}** ({limits})"
    return text if check.worst == "good" else f"{text}: {check.reason}."
