"""Pin and compare: a baseline machine A beside the live one."""

import math

import streamlit as st

from rotorcalc.units import Units
from ui.bearing import FILM, KIND, Values, fields_of
from ui.inputs import INPUTS, number
from ui.session import session


def draw_buttons() -> None:
    """Draw the buttons that pin, swap and unpin."""
    visitor = session()
    if visitor.baseline is None:
        st.button(
            "Pin this machine", key="pin", width="stretch", on_click=visitor.pin,
            help="Keeps it as A: charts draw it thin and grey, results show their change from it.",
        )  # fmt: skip
        return
    swap, unpin = st.columns(2)
    swap.button("Swap with A", key="swap", width="stretch", on_click=visitor.swap)
    unpin.button("Unpin A", key="unpin", width="stretch", on_click=visitor.unpin)


def draw_differences(units: Units) -> None:
    """Show the inputs that differ between the pinned machine and the live one."""
    visitor = session()
    if visitor.baseline is None:
        return
    rows = [
        {
            "Input": item.name(units),
            "A": _shown(key, visitor.baseline, units),
            "Now": _shown(key, visitor.values, units),
        }
        for key, item in INPUTS.items()
        if visitor.baseline[key] != visitor.values[key]
    ]
    rows += _bearings(visitor.baseline, visitor.values, units)
    if rows:
        st.table(rows, border="horizontal", width="content", hide_index=True,
                 alt="Inputs that differ between machine A and the live one")  # fmt: skip
    else:
        st.caption("A is pinned and equals the live machine: move a slider to compare.")


def _shown(key: str, values: Values, units: Units) -> str:
    if values[key] is None:
        return "half the weight"
    value = number(values, key)
    return INPUTS[key].infinite if math.isinf(value) else f"{INPUTS[key].shown(value, units):.5g}"


def _bearings(pinned: Values, live: Values, units: Units) -> list[dict[str, str]]:
    """Return the differences in the bearing's kind, film model and fields."""
    rows = [(word.capitalize(), f"{pinned[word]}", f"{live[word]}")
            for word in (KIND, FILM) if pinned[word] != live[word]]  # fmt: skip
    # Bearings of two kinds have different fields: one that is missing is shown as a dash.
    fields = fields_of(pinned[KIND]) | fields_of(live[KIND])
    for key, field in fields.items():
        then, now = (field.shown(values.get(key), units) for values in (pinned, live))
        if then != now:
            rows.append((field.name_in(units), then, now))
    return [dict(zip(("Input", "A", "Now"), row, strict=True)) for row in rows]
