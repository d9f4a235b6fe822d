"""What the equilibrium page says of its charts, and where a film does not know a quantity."""

import numpy as np
import streamlit as st

from rotorcalc.arrays import Array
from rotorcalc.figures import film
from rotorcalc.films import film_of
from ui.computed import Computed
from ui.words.citation import at_one_speed, cited, remark


def thinnest(computed: Computed) -> str:
    """Return the caption of the smallest film over speed."""
    words = remark(
        computed, "thickness", "{}, below the clearance.", "The thinnest place of the film."
    )
    return cited(words, computed, "thickness")


def dotted(computed: Computed) -> str:
    """Return what the dotted line beside the journal's path is."""
    one_curve = film_of(computed.machine.bearing).curve is not None
    return f"dotted: {'at any speed' if one_curve else 'at the running speed, with any load'}"


def of_position(computed: Computed, *, over_speed: bool) -> str:
    """Return the caption of eccentricity and attitude angle."""
    each = "At the equilibrium of each speed"
    words = each if over_speed or not at_one_speed(computed) else f"{each}; {dotted(computed)}"
    return remark(computed, "eccentricity", otherwise=f"{words}.")


def leaves(computed: Computed) -> str:
    """Return what the side flow is."""
    if computed.has_gas:
        return "Gas that leaves at both ends."
    return "Oil that leaves at both ends and must be replaced."


def cavitated(computed: Computed) -> str:
    """Return what grey strips of the film are, where they are too narrow for words."""
    narrow = film.has_narrow_cavitation(computed.film)
    return " Grey: cavitated, at ambient pressure." if narrow else ""


def known(words: str, values: Array) -> bool:
    """Return whether a film's model knows a quantity; say so in its words if not."""
    unknown = bool(np.isnan(values).any())
    if unknown:
        st.info(f"{words}: the model of this bearing's film does not give it.")
    return not unknown
