"""Texts of the imbalance response page."""

from collections.abc import Callable
from typing import Literal

import streamlit as st

from rotorcalc import Machine, Rotor
from rotorcalc.unbalance_curves import damping_variants, journal_mass_variants
from rotorcalc.units import Units
from ui.computed import Computed
from ui.format import digits
from ui.preview import Text

SHOWN: dict[Literal["axes", "XY"], str] = {"axes": "Orbit's axes", "XY": "X and Y"}
VARIED: dict[Literal["damping", "mass"], str] = {
    "damping": "Midspan damping",
    "mass": "Journal mass",
}
ORBIT_MARKS = (
    "Dots: where each is when the imbalance points down; arrowheads: the sense of whirl. Eq. 5.38."
)
VARIANTS: dict[str, Callable[[Machine], tuple[Rotor, ...]]] = {
    "damping": damping_variants,
    "mass": journal_mass_variants,
}


def say_balanced(computed: Computed) -> bool:
    """Return whether the rotor is balanced; show a note if it is."""
    balanced = computed.machine.rotor.imbalance == 0.0
    if balanced:
        st.info(
            "The rotor is perfectly balanced (u = 0): nothing drives a synchronous motion, and "
            "disk and journal stay in equilibrium. Move the slider **Imbalance u** in the "
            "sidebar's group Rotor to see a response."
        )
    return balanced


def unstable(computed: Computed) -> Text | None:
    """Return that the response shown would not last, where it would not."""
    if computed.is_stable:
        return None
    return Text(
        "The machine is unstable at its running speed: it whirls with growing amplitude, and "
        "the steady response shown there would not last.",
        "error",
    )


def wall(computed: Computed, units: Units) -> Text | None:
    """Return by how much the journal would move into the wall, where it would."""
    closest = computed.clearance_orbit.closest
    if not closest <= 0.0:  # or not known
        return None
    C = float(units.film.of(computed.machine.bearing.radial_clearance))
    return Text(
        f"By linear theory the journal would move {digits(-closest * C)} {units.film.name} into "
        f"the wall; the clearance is {digits(C)} {units.film.name}. The film stiffens well before "
        "that, so this orbit is a warning, not an amplitude.",
        "warning",
    )


def amplitude_caption(computed: Computed) -> str:
    """Return the caption of the chart of amplitudes."""
    peaks = (
        "diamonds (with X and Y dotted lines) mark the largest orbits"
        if len(computed.disk_peaks.speed) or len(computed.journal_peaks.speed)
        else "no peak up to the top speed"
    )
    unstable = (
        " Shaded: unstable, no steady response exists." if len(computed.response.unstable) else ""
    )
    return f"About equilibrium; {peaks}.{unstable} Eq. 5.38."


def senses(computed: Computed) -> str:
    """Return the sense of whirl of disk and journal at the running speed."""
    orbits = computed.orbits
    journal = _sense(bool(orbits.journal_forward))
    if orbits.is_rigid:
        return f"The shaft is rigid: disk and journal move alike. The orbit runs {journal}."
    disk = _sense(bool(orbits.disk_forward))
    if disk == journal:
        return f"Disk and journal both whirl {disk}."
    return f"The disk whirls {disk}, the journal {journal}."


def explain_family(computed: Computed, varied: Literal["damping", "mass"]) -> str:
    """Return what the family's lines are."""
    rotor = computed.machine.rotor
    if varied == "damping":
        shares = (
            "the centred film's damping"
            if rotor.is_rigid
            else "the critical damping of the disk on its shaft, 2√(Kᵣₒₜ M)"
        )
        return (
            "The thickest line is this machine, the others the same with midspan damping of "
            f"0, 5, 10, 20 and 50 % of {shares}. Dotted where the machine is unstable."
        )
    return (
        "The thickest line is this machine, the others the same with 0, 5, 10, 20 and 40 % of half "
        "the rotor's mass moved from the disk to each journal. Dotted where the machine is "
        "unstable. The imbalance is the disk's, so a lighter disk is also excited less."
    )


def _sense(forward: bool) -> str:
    return "forward, with the shaft" if forward else "backward, against the shaft"
