import streamlit as st

from rotorcalc.figures.conventions import conventions
from ui import notes
from ui.frame.page import Page, show
from ui.notes import ring


def content(page: Page) -> None:
    page.tabs("notes_tab", {
        "Model": lambda _: st.markdown(notes.text("model")),
        "Finite length": lambda _: st.markdown(notes.text("finite")),
        "Signs and axes": signs,
        "Equations": lambda _: st.markdown(notes.equations()),
        "Misprints": lambda _: st.markdown(f"{notes.text('misprints')}\n{ring.whirls()}"),
        "Bearing types": lambda _: st.markdown(notes.text("bearings")),
        "Live validation": live_validation,
        "References": lambda _: st.markdown(notes.text("references")),
    })  # fmt: skip


def signs(page: Page) -> None:
    page.chart(
        lambda _: conventions(),
        "conventions",
        alt=notes.CONVENTIONS_ALT,
        caption="Seen along the shaft, the clearance exaggerated. Eqs. 5.3, 5.7, 5.11.",
    )
    st.markdown(notes.text("conventions"))


def live_validation(_: Page) -> None:
    with st.spinner("Computing the checks …"):
        cases, when = notes.checked()
    say = st.success if all(case.holds for case in cases) else st.error
    say(notes.verdict(cases, when))
    st.markdown(
        "Each row is computed by the code behind the other pages, and compared with an "
        "independent reference. Recorded: from a separate calculation."
    )
    st.markdown(notes.checks(cases))


show(
    "Notes",
    "The model, its signs and equations, the source's misprints, and the program's checks.",
    content,
)
