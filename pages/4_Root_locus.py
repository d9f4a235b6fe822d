import streamlit as st

from rotorcalc.figures import locus as locus_figures
from rotorcalc.figures import modes as figures
from ui import modes as words
from ui.page import framed

with framed(
    "Root locus", "How each mode of the rotor decays, and how fast it whirls, as the speed rises."
) as page:
    view, units = page.view, page.units
    page.results("damping_ratio", "natural_frequency", "onset_speed", "whirl_frequency")
    bends = words.choose_shaft(view)
    plane, over_speed, mode_tab = st.tabs(
        ["Complex plane", "Against speed", "Mode"], on_change="rerun", key="locus_tab"
    )

    def shown(v):
        return figures.OverSpeed(v.locus(bends), v.onset if bends else v.rigid_onset, units)

    def chart(draw, key):
        page.chart(draw, key, alt=words.ALTS[key], caption=words.CAPTIONS[key])

    if plane.open:
        with plane:
            page.chart(
                lambda v: locus_figures.plane(v.locus(bends), shown(v).onset, units),
                "locus",
                alt=words.ALTS["locus"],
                caption=" ".join([
                    words.CAPTIONS["locus"],
                    words.crossing(shown(view).onset, view.top_speed, units),
                    locus_figures.beyond(view.locus(bends), units),
                ]),
            )  # fmt: skip

    if over_speed.open:
        with over_speed:
            left, right = st.columns(2)
            with left:
                chart(lambda v: figures.growth(shown(v)), "growth")
            with right:
                chart(lambda v: figures.frequency(shown(v)), "frequency")
            left, right = st.columns(2)
            with left:
                chart(lambda v: figures.damping(shown(v)), "damping")
            with right:
                chart(
                    lambda v: figures.natural(
                        shown(v), rigid=v.rigid_frequency, shaft=v.shaft_frequency
                    ),
                    "natural",
                )
            left, right = st.columns(2)
            with left:
                chart(lambda v: figures.decrement(shown(v)), "decrement")
            right.markdown(words.HOW_TO_READ)

    if mode_tab.open:
        with mode_tab:
            locus = view.locus(bends)
            st.markdown(words.table(locus.here, view.speed, units))
            left, right = st.columns([2, 3])
            with left:
                mode = words.choose_mode(locus.here, locus.leading, units)
                spiral = st.toggle("Let it grow or decay over three turns", key="locus_spiral")
                st.markdown(words.ABOUT_MODES)
            with right:
                chart(
                    lambda v: figures.shape(
                        v.locus(bends).here,
                        mode if v is view else v.locus(bends).leading,
                        rigid=v.machine.rotor.is_rigid or not bends,
                        spiral=spiral,
                    ),
                    "shape",
                )
