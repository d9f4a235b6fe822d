"""The switch between a given film temperature and a supply of oil, in the sidebar and on Heat."""

import streamlit as st

from ui.inputs import has_supply
from ui.session import session
from ui.supply import other

_GIVEN = (
    "The film's temperature is given here. With a supply of oil it follows at each speed from the "
    "film's loss and the oil that passes, and this tab shows how."
)


def draw_switch() -> None:
    """Draw the switch among the inputs."""
    visitor = session()
    visitor.mirror("oil_supply", has_supply(visitor.values))
    st.toggle(
        "Film temperature follows from the oil supply", key="oil_supply", on_change=_toggle,
        help="The film's loss warms the oil that passes; at each speed the film is at the mean of "
        "inlet and outlet temperature (ISO 7902-1).",
    )  # fmt: skip


def offer() -> None:
    """Explain that a balance needs a supply, and offer one."""
    st.info(_GIVEN)
    st.button("Let the temperature follow from the oil supply", key="use_supply", on_click=_toggle)


def _toggle() -> None:
    visitor = session()
    try:
        visitor.set_supply(other(visitor.values))
    except ValueError as error:
        visitor.problems[:] = [f"{error}."]
