import streamlit as st

from rotorcalc.figures.notes import conventions
from ui import notes
from ui.page import framed

with framed(
    "Notes", "The model, its signs and equations, the source's misprints, and the program's checks."
) as page:
    model, signs, equations, misprints, bearings, checks, references = st.tabs(
        [
            "Model",
            "Signs and axes",
            "Equations",
            "Misprints",
            "Bearing types",
            "Live validation",
            "References",
        ],
        on_change="rerun",
        key="notes_tab",
    )

    if model.open:
        model.markdown(notes.text("model"))

    if signs.open:
        with signs:
            page.chart(
                lambda _: conventions(),
                "conventions",
                alt=notes.CONVENTIONS_ALT,
                caption="Seen along the shaft, the clearance drawn far too large. Eqs. 5.3, 5.7, "
                "5.11.",
            )
            st.markdown(notes.text("conventions"))

    if equations.open:
        equations.markdown(notes.equations())

    if misprints.open:
        misprints.markdown(notes.text("misprints"))

    if bearings.open:
        bearings.markdown(notes.text("bearings"))

    if checks.open:
        with checks:
            with st.spinner("Computing the checks …"):
                cases, seconds = notes.checked()
            show = st.success if all(case.holds for case in cases) else st.error
            show(notes.verdict(cases, seconds))
            st.markdown(
                "Each row is computed by the code that draws the other pages, and set beside a "
                "number that comes another way. Recorded: found once by an independent calculation."
            )
            st.markdown(notes.checks(cases))

    if references.open:
        references.markdown(notes.text("references"))
