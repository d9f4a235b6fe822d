import streamlit as st

from ui.frame.page import Page, show
from ui.words import measured, own_coefficients


def content(page: Page) -> None:
    page.tabs("data_tab", {
        "Coefficients": own_coefficients.draw,
        "Measured vibration": measured.draw,
        "What is read": lambda _: st.markdown(own_coefficients.FORMATS),
    })  # fmt: skip


show(
    "Your data",
    "Your own bearing's stiffness and damping, and vibration that you measured, from files.",
    content,
)
