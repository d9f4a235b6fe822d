"""What the equilibrium page says where a film's model does not know a quantity."""

import numpy as np
import streamlit as st

from rotorcalc.arrays import Array


def known(words: str, values: Array) -> bool:
    """Return whether a film's model knows a quantity; say so in its words if not."""
    unknown = bool(np.isnan(values).any())
    if unknown:
        st.info(f"{words}: the model of this bearing's film does not give it.")
    return not unknown
