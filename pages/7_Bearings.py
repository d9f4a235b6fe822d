import streamlit as st

from ui.frame.page import Page, show
from ui.words import bearings as words
from ui.words import own


def content(page: Page) -> None:
    if own.said(page.computed, own.SIZE):
        return
    with page.preview.dimmed("bearings"):
        # The machine's own bearing stands first in the table alone.
        _, *kinds = words.compare(page)
        words.say_exceptions(kinds)
        st.subheader("What is said of each, and what it does here", anchor=False)
        for row in words.in_rows(kinds):
            for column, result in zip(st.columns(len(row)), row, strict=True):
                with column:
                    words.card(page, result, kinds)


show(
    "Bearings",
    "Other bores with the same diameter, length, clearance, oil and load, on this rotor.",
    content,
    unanswered=words.say_unanswered,
)
