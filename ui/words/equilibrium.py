"""What the equilibrium page says where a film's model does not know a quantity."""

import numpy as np
import streamlit as st

from rotorcalc.arrays import Array
from ui.computed import Computed
from ui.words.citation import cited, remark


def thinnest(computed: Computed) -> str:
    """Return the caption of the smallest film over speed."""
    words = remark(
        computed, "thickness", "{}, below the clearance.", "The thinnest place of the film."
    )
    return cited(words, computed, "thickness")


def known(words: str, values: Array) -> bool:
    """Return whether a film's model knows a quantity; say so in its words if not."""
    unknown = bool(np.isnan(values).any())
    if unknown:
        st.info(f"{words}: the model of this bearing's film does not give it.")
    return not unknown
