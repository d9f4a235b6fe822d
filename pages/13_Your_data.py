import streamlit as st

from ui.frame.page import Page, show
from ui.words import own_coefficients


def content(page: Page) -> None:
    page.tabs("data_tab", {
        "Coefficients": own_coefficients.draw,
        "What is read": lambda _: st.markdown(own_coefficients.FORMATS),
    })  # fmt: skip


show(
    "Your data",
    "Stiffness and damping of your own bearing, from a file.",
    content,
)
