import streamlit as st

from rotorcalc.figures import machine
from ui import page as frame
from ui.verdict import verdict

page = frame.begin(
    "Machine at a glance", "A rotor on two journal bearings: is it stable, and how does it move?"
)
units = page.units

judged = verdict(page.view, units)
(st.success if judged.level == "stable" else st.error)(judged.sentence)

bearing, results = st.columns([2, 3], gap="large")
with bearing:
    scale = st.segmented_control(
        "Film drawn", ["exaggerated", "to scale"], key="film_scale", default="exaggerated",
        required=True, persist_state="session", label_visibility="collapsed",
    )  # fmt: skip
    page.chart(
        lambda v: machine.cross_section(v.point, v.film, units, to_scale=scale == "to scale"),
        "cross_section",
        alt="Cross-section of the bearing with the journal, the load and the film's pressure",
        caption="Journal in its bearing, seen along the shaft. Pressure of the film: Eq. 5.25.",
    )
with results:
    st.caption("Stability")
    page.results("onset_speed", "whirl_frequency", "margin", "damping_ratio")
    st.caption("Static equilibrium")
    page.results("eccentricity_ratio", "attitude_angle", "minimum_film_thickness", "power_loss")
    st.caption(
        "Imbalance response" if page.view.is_stable else "Imbalance response, if it were stable"
    )
    page.results("disk_amplitude", "journal_amplitude", "disk_peak", "journal_peak")
