"""What the pages say of a bearing that is known by its own coefficients alone."""

import math

import streamlit as st

from ui.computed import Computed

PLACE = (
    "Own coefficients say how the bearing pushes back when the journal moves a little, not where "
    "the journal rests: its eccentricity, film, pressure, losses and flow are not known. "
    "Stability, root locus and response follow from the coefficients alone."
)
HEAT = (
    "Own coefficients give neither the loss of the film nor its flow, so no balance of heat can be "
    "drawn. Oil and film temperature change nothing of this machine."
)
MOTION = (
    "A large motion needs the force of the film at every place of the journal. Own coefficients "
    "hold for small motions only, so there is no nonlinear orbit, limit cycle or run-up. The "
    "linear orbits to imbalance are on the page Response."
)
SIZE = (
    "Other bearings are compared on the same diameter, length, clearance and oil, which own "
    "coefficients do not name. Choose a bearing in the sidebar to compare others with it."
)
CLEARANCE = "The clearance is not known, so the orbit is not drawn within it."
ROWS = "Circles: the rows of the table; between them each is interpolated, beyond them never."


def said(computed: Computed, words: str) -> bool:
    """Return whether the bearing is known by its own coefficients alone; say so if it is."""
    if computed.has_own:
        st.info(words)
    return computed.has_own


def begins_unstable(computed: Computed) -> bool:
    """Return whether the machine is unstable from the first speed of its coefficients on."""
    onset = computed.onset
    return onset.searched_from > 0.0 and math.isclose(onset.speed, onset.searched_from)
