"""The home page: the machine at a glance."""

import streamlit as st

from rotorcalc.figures import coefficients, equilibrium, machine, response, stability, style
from ui.choices import choose
from ui.computed import Computed
from ui.frame.page import Page, show
from ui.preview import Text
from ui.words import own
from ui.words.citation import cited
from ui.words.stability import can_whirl, meets, over_speed


def content(page: Page) -> None:
    """Draw the machine at a glance."""
    bearing, results = st.columns([3, 4], gap="medium")
    with bearing:
        if page.computed.has_own:
            _own(page)
        else:
            _drawing(page)
    with results:
        st.caption("Stability")
        page.results("onset_speed", "whirl_frequency", "margin", "damping_ratio")
        if not page.computed.has_own:
            st.caption("Static equilibrium")
            page.results(
                "eccentricity_ratio", "attitude_angle", "minimum_film_thickness", "power_loss"
            )
        page.say("imbalance", _heading)
        page.results("disk_amplitude", "journal_amplitude", "disk_peak", "journal_peak")
    _charts(page)


def _own(page: Page) -> None:
    """Draw own coefficients in place of a bearing of which nothing else is known."""
    page.chart(
        lambda c: coefficients.stiffness_against_speed(
            c.sweep, c.point, c.coefficients("XY"), c.coefficients_here("XY"), page.units
        ),
        "home_stiffness",
        alt="Stiffness coefficients of one bearing against speed, the rows of the table marked.",
        caption=f"The bearing's own stiffness. {own.ROWS}",
    )


def _drawing(page: Page) -> None:
    """Draw the bearing with its journal and the film's pressure."""
    units = page.units
    scale = choose("Film drawn", ["exaggerated", "to scale"], "machine_scale", hidden=True)
    page.chart(
        lambda c: machine.cross_section(
            c.point,
            c.middle_film,
            units,
            to_scale=scale == "to scale",
            others=c.other_speeds,
            parts=c.parts,
        ),
        "cross_section",
        while_dragging=lambda c: machine.cross_section(
            c.point, c.middle_film, units, to_scale=scale == "to scale", parts=c.parts
        ),
        alt="Cross-section of the bearing with the journal, the load and the film's pressure",
        caption=lambda c: _bearing(c, to_scale=scale == "to scale"),
    )


def _charts(page: Page) -> None:
    """Draw where the journal is, what it takes to whirl, and how it swings."""
    units = page.units
    locus, threshold, swing = st.columns(3)
    with locus:
        if page.computed.has_own:
            _damping(page)
        else:
            _locus(page)
    with threshold:
        if can_whirl(page.computed):
            _threshold(page)
        st.page_link("pages/3_Stability.py", label="Stability")
    with swing:
        page.chart(
            lambda c: style.small(response.amplitude(c.response, "axes", units)),
            "home_response",
            alt="Size of the orbits of disk and journal over running speed",
            caption="Amplitudes of disk and journals. Eq. 5.38.",
        )
        st.page_link("pages/5_Response.py", label="Imbalance response")


def _locus(page: Page) -> None:
    page.chart(
        lambda c: style.small(equilibrium.locus(c.path, c.point, page.units)),
        "home_locus",
        alt="Path of the journal's centre in its clearance, and its present position",
        caption=cited("Position of the journal.", page.computed, "attitude", "eccentricity"),
    )
    st.page_link("pages/1_Equilibrium.py", label="Static equilibrium")


def _damping(page: Page) -> None:
    page.chart(
        lambda c: style.small(
            coefficients.damping_against_speed(
                c.sweep, c.point, c.coefficients("XY"), c.coefficients_here("XY"), page.units
            )
        ),
        "home_damping",
        alt="Damping coefficients of one bearing against speed, the rows of the table marked.",
        caption="The bearing's own damping.",
    )
    st.page_link("pages/2_Coefficients.py", label="Force coefficients")


def _bearing(computed: Computed, *, to_scale: bool) -> str:
    remarks = machine.remarks(computed.machine.bearing, to_scale=to_scale)
    words = f"Journal in its bearing, seen along the shaft, and pressure of the film. {remarks}"
    return cited(words.rstrip(), computed, "pressure")


def _heading(computed: Computed) -> Text:
    unstable = "" if computed.is_stable else ", if it were stable"
    return Text(f"Imbalance response{unstable}", "caption")


def _threshold(page: Page) -> None:
    units = page.units
    page.chart(
        lambda c: over_speed(stability.threshold_at_a_glance, c, units),
        "home_threshold",
        alt="Threshold speed over running speed, and the line that it crosses at the onset",
        caption=meets(page.computed),
    )


def draw() -> None:
    """Draw the page."""
    show(
        "Machine at a glance",
        "A rotor on two journal bearings: is it stable, and how does it move?",
        content,
    )
