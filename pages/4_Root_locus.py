from functools import partial

import streamlit as st

from rotorcalc.figures import modes as figures
from rotorcalc.figures import root_locus as locus_figures
from ui.frame.page import Page, show
from ui.words import root_locus as words


def content(page: Page) -> None:
    page.results("damping_ratio", "natural_frequency", "onset_speed", "whirl_frequency")
    bends = words.choose_shaft(page.view)
    page.tabs("locus_tab", {
        "Complex plane": partial(plane, bends=bends),
        "Against speed": partial(against_speed, bends=bends),
        "Mode": partial(mode_shape, bends=bends),
    })  # fmt: skip


def plane(page: Page, *, bends: bool) -> None:
    view, units = page.view, page.units
    page.chart(
        lambda v: locus_figures.plane(v.locus(bends), onset(v, bends=bends), units),
        "locus",
        alt=words.ALTS["locus"],
        caption=" ".join([
            words.CAPTIONS["locus"],
            words.crossing(onset(view, bends=bends), view.top_speed, units),
            locus_figures.beyond(view.locus(bends), units),
        ]),
    )  # fmt: skip


def against_speed(page: Page, *, bends: bool) -> None:
    units = page.units

    def shown(v):
        return figures.OverSpeed(v.locus(bends), onset(v, bends=bends), units)

    def chart(draw, key):
        page.chart(draw, key, alt=words.ALTS[key], caption=words.CAPTIONS[key])

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
            lambda v: figures.natural(shown(v), rigid=v.rigid_frequency, shaft=v.shaft_frequency),
            "natural",
        )
    left, right = st.columns(2)
    with left:
        chart(lambda v: figures.decrement(shown(v)), "decrement")
    right.markdown(words.HOW_TO_READ)


def mode_shape(page: Page, *, bends: bool) -> None:
    view, units = page.view, page.units
    locus = view.locus(bends)
    st.markdown(words.table(locus.here, view.speed, units))
    left, right = st.columns([2, 3])
    with left:
        mode = words.choose_mode(locus.here, locus.leading, units)
        spiral = st.toggle("Let it grow or decay over three turns", key="locus_spiral")
        st.markdown(words.ABOUT_MODES)
    with right:
        page.chart(
            lambda v: figures.shape(
                v.locus(bends).here,
                mode if v is view else v.locus(bends).leading,
                rigid=v.machine.rotor.is_rigid or not bends,
                spiral=spiral,
            ),
            "shape",
            alt=words.ALTS["shape"],
            caption=words.CAPTIONS["shape"],
        )


def onset(view, *, bends):
    return view.onset if bends else view.rigid_onset


show(
    "Root locus",
    "How each mode of the rotor decays, and how fast it whirls, as the speed rises.",
    content,
)
