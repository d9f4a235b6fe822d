from functools import partial

import streamlit as st

from rotorcalc.figures import modes as figures
from rotorcalc.figures import root_locus as locus_figures
from ui.choices import choice
from ui.frame.page import Page, show
from ui.preview import Text
from ui.words import root_locus as words


def content(page: Page) -> None:
    page.results("damping_ratio", "natural_frequency", "onset_speed", "whirl_frequency")
    bends = words.choose_shaft(page.computed)
    page.tabs("locus_tab", {
        "Complex plane": partial(plane, bends=bends),
        "Against speed": partial(against_speed, bends=bends),
        "Mode": partial(mode_shape, bends=bends),
    })  # fmt: skip


def plane(page: Page, *, bends: bool) -> None:
    units = page.units
    page.chart(
        lambda c: locus_figures.plane(c.locus(bends), onset(c, bends=bends), units),
        "locus",
        alt=words.ALTS["locus"],
        caption=lambda c: " ".join([
            words.caption("locus", c),
            words.crossing(c, onset(c, bends=bends), units),
            locus_figures.beyond(c.locus(bends), units),
        ]),
    )  # fmt: skip


def against_speed(page: Page, *, bends: bool) -> None:
    units = page.units

    def shown(c):
        return figures.OverSpeed(c.locus(bends), onset(c, bends=bends), units)

    def chart(draw, key):
        page.chart(draw, key, alt=words.ALTS[key], caption=words.caption(key, page.computed))

    left, right = st.columns(2)
    with left:
        chart(lambda c: figures.growth(shown(c)), "growth")
    with right:
        chart(lambda c: figures.frequency(shown(c)), "frequency")
    left, right = st.columns(2)
    with left:
        chart(lambda c: figures.damping(shown(c)), "damping")
    with right:
        chart(
            lambda c: figures.natural(shown(c), rigid=c.rigid_frequency, shaft=c.shaft_frequency),
            "natural",
        )
    left, right = st.columns(2)
    with left:
        chart(lambda c: figures.decrement(shown(c)), "decrement")
    right.markdown(words.how_to_read(page.computed))


def mode_shape(page: Page, *, bends: bool) -> None:
    computed, units = page.computed, page.units
    locus = computed.locus(bends)
    page.say("modes", lambda c: Text(words.table(c.locus(bends), units)))
    left, right = st.columns([2, 3])
    with left:
        mode = words.choose_mode(locus)
        spiral = st.toggle(
            "Show growth or decay over three turns", key="locus_spiral",
            value=bool(choice("locus_spiral", default=False, allowed=lambda _: True)),
        )  # fmt: skip
        st.markdown(words.ABOUT_MODES)
    with right:
        page.chart(
            lambda c: figures.shape(
                c.locus(bends).here,
                words.same_mode(c.locus(bends), None if page.is_case(c) else mode),
                rigid=c.machine.rotor.is_rigid or not bends,
                spiral=spiral,
                ring=c.machine.bearing.geometry.kind == "floating-ring",
            ),
            "shape",
            at_one_speed=True,
            alt=words.ALTS["shape"],
            caption=words.caption("shape", computed),
        )


def onset(computed, *, bends):
    return computed.onset if bends else computed.rigid_onset


show(
    "Root locus",
    "How fast each mode of the rotor decays and whirls as the speed rises.",
    content,
)
