"""Cases in the frame: keep, rename, use and remove them, and the table that compares them."""

from collections.abc import Sequence

import streamlit as st

from ui import cases
from ui.cases import Case, Shown
from ui.comparison import table
from ui.preview import Preview, Text
from ui.session import session

# On a narrow screen each quantity's values stand below its name, each with its case's.
_STYLE = """<style>
table.cases {width: 100%; border-collapse: collapse; font-size: 0.875rem;}
table.cases caption {text-align: left; font-size: 0.875rem; opacity: 0.75;}
table.cases :is(th, td) {padding: 0.3rem 0.6rem; text-align: right; vertical-align: top;
  border-bottom: 1px solid rgba(127, 127, 127, 0.3); font-weight: 400;}
table.cases th[scope=row] {text-align: left;}
table.cases thead th {font-weight: 600;}
table.cases small {display: block; opacity: 0.75; font-size: 0.8rem;}
table.cases .swatch {display: inline-block; width: 1rem; height: 0.25rem; margin-right: 0.35rem;
  vertical-align: middle;}
@media (max-width: 900px) {
  table.cases tbody tr {display: flex; flex-wrap: wrap;
    border-bottom: 1px solid rgba(127, 127, 127, 0.3);}
  table.cases tbody th {flex: 1 0 100%; border: none;}
  table.cases tbody td {border: none; text-align: left;}
  table.cases tbody td::before {content: attr(data-case) " "; opacity: 0.75;}
  table.cases thead tr {display: flex; flex-wrap: wrap;}
}
</style>"""


def draw_buttons() -> None:
    """Draw the button that keeps the machine as a case, and the list of cases."""
    visitor = session()
    with st.container(horizontal=True, gap="small", key="case_buttons"):
        name = cases.next_name(visitor.cases)
        st.button(
            f"Keep as {name}", key="keep", on_click=visitor.keep, args=(name,),
            disabled=len(visitor.cases) >= cases.MOST,
            help="Keeps this machine as a case: charts draw it as thin lines in a colour of its "
            "own, results show their change from the first case, and a table compares all cases.",
        )  # fmt: skip
        # Without their number: Streamlit closes a popover whose label changes.
        opened = st.popover("Cases", key="cases", on_change="rerun")
    if opened.open:
        with opened:
            _list(visitor.cases)


def _list(kept: Sequence[Case]) -> None:
    """Draw each case with what can be done with it."""
    if not kept:
        st.caption("No cases yet. Keep the machine as it is, then change it to compare the two.")
    for place, case in enumerate(kept):
        with st.container(horizontal=True, vertical_alignment="bottom", gap="small"):
            key = f"case_{case.colour}"
            session().mirror(f"{key}_name", case.name)
            st.text_input(
                f"Name of case {place + 1}", key=f"{key}_name", max_chars=24,
                on_change=_rename, args=(place, f"{key}_name"),
            )  # fmt: skip
            st.button("Use", key=f"{key}_use", on_click=session().use, args=(place,),
                      help="Sets the sliders to this case.")  # fmt: skip
            st.button("Remove", key=f"{key}_drop", on_click=session().drop, args=(place,))


def _rename(place: int, key: str) -> None:
    visitor = session()
    try:
        visitor.rename(place, st.session_state[key])
    except ValueError as error:
        visitor.problems[:] = [f"{error}."]


def draw_table(preview: Preview, shown: Sequence[Shown]) -> None:
    """Show the live machine and the cases side by side, where there are any."""
    if shown:
        st.subheader("Cases", anchor=False)
        st.html(_STYLE)
        preview.say("cases", lambda c: Text(table(c, shown, preview.units), "html"))
