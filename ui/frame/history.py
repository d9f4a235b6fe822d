"""Undo, redo and reset of the machine, and what was changed from its preset."""

import streamlit as st

from ui.bearing import fields_of, film_name
from ui.bores import FILM, KIND, Values, name_of
from ui.format import lower
from ui.inputs import INPUTS, LAW, LAWS
from ui.own import TABLE
from ui.session import Session, changed

# Key of the place of the inputs changed.
CHANGES = "said_changes"


def draw(visitor: Session) -> None:
    """Draw the buttons, and name the inputs that differ from the preset's."""
    with st.container(horizontal=True, gap="small", key="history"):
        st.button(
            "Undo", key="undo", on_click=visitor.undo, disabled=not visitor.history.can_undo,
            shortcut="Mod+Z", help="Takes back the last change to the machine or its cases.",
        )  # fmt: skip
        st.button(
            "Redo", key="redo", on_click=visitor.redo, disabled=not visitor.history.can_redo,
            shortcut="Mod+Shift+Z", help="Repeats the change that was undone last.",
        )  # fmt: skip
        st.button(
            "Reset", key="reset", on_click=visitor.set_preset, args=(visitor.preset,),
            disabled=not visitor.changed(), help="Back to the preset's machine and speeds.",
        )  # fmt: skip
    with st.container(key=CHANGES):
        st.caption(changes(visitor.preset, visitor.values))


def changes(preset: str, values: Values) -> str:
    """Return which inputs differ from the preset's, in words."""
    # A table is the bearing's own coefficients themselves, which the bearing's name says.
    keys = (key for key in changed(preset, values) if key != TABLE)
    names = ", ".join(_symbol(key, values) for key in keys)
    return f"Changed from the preset: {names}." if names else "Unchanged from the preset."


def _symbol(key: str, values: Values) -> str:
    if key in INPUTS:
        return INPUTS[key].symbol
    if key == KIND:
        return f"bearing: {lower(name_of(values[KIND]))}"
    if key == LAW:
        return f"viscosity by {LAWS[str(values[LAW])]}"
    if key == FILM:
        return f"film: {lower(film_name(values))}"
    fields = fields_of(values[KIND])
    return lower(fields[key].label) if key in fields else key.replace("_", " ")
