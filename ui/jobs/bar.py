"""The bar of a computation."""

from collections.abc import Callable

import streamlit as st
from streamlit.delta_generator import DeltaGenerator


def show_progress(words: str) -> tuple[DeltaGenerator, Callable[[float], object]]:
    """Show how much of a computation is done; return its bar, and what moves that on."""
    bar = st.progress(0.0, words)
    # Without its words at every step Streamlit would take them away.
    return bar, lambda share: bar.progress(share, words)
