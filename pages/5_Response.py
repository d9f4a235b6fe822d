from typing import Literal, cast

import streamlit as st

from rotorcalc.figures import response as draw
from ui import measured
from ui.choices import choose
from ui.frame.page import Page, show
from ui.preview import Text
from ui.words import own
from ui.words import response as words


def content(page: Page) -> None:
    page.results("disk_amplitude", "journal_amplitude", "disk_peak", "journal_peak")
    if words.say_balanced(page.computed):
        return
    page.say("unstable", words.unstable)
    page.say("wall", lambda c: words.wall(c, page.units))
    page.tabs("response_tab", {
        "Against speed": against_speed,
        "Orbits": orbits,
        "What damping and journal mass do": family,
    })  # fmt: skip


def against_speed(page: Page) -> None:
    units = page.units
    shown = cast('Literal["axes", "XY"]', choose(
        "Amplitudes of", list(words.SHOWN), "response_shown", format_func=words.SHOWN.__getitem__
    ))  # fmt: skip
    left, right = st.columns(2)
    with left:
        page.chart(
            measured.over_amplitude(
                lambda c: draw.amplitude(c.response, shown, units), shown, units
            ),
            "amplitude",
            alt="Amplitudes of disk and journal against speed, with peaks and unstable range.",
            caption=words.amplitude_caption,
        )
    with right:
        page.chart(
            measured.over_phase(lambda c: draw.phase(c.response, units), units),
            "phase",
            alt="Phase lag of disk and journal behind the imbalance against speed.",
            caption="Lag of X behind cos Ωt and of Y behind sin Ωt, the imbalance's "
            "components. Eq. 5.38, imbalance forward.",
        )


def orbits(page: Page) -> None:
    units = page.units
    left, right = st.columns(2)
    with left:
        if own.said(page.computed, own.CLEARANCE):
            scrubbed(page, right)
            return
        page.chart(
            lambda c: draw.played_in_clearance(
                c.clearance_orbit, c.sweep.journal_position, c.orbits, c.orbit_steps, units
            ),
            "clearance_orbit",
            alt="The journal's orbit about its equilibrium inside its clearance, over speed.",
            caption="The journal's centre in its clearance, about its equilibrium. X "
            "points down, along the load; the shaft turns counterclockwise.",
        )
    scrubbed(page, right)


def scrubbed(page: Page, place) -> None:
    units = page.units
    with place:
        page.chart(
            lambda c: draw.scrubber(c.orbit_steps, c.orbits, units),
            "orbits",
            alt="Orbits of disk and journal about the same point, with a slider over speed.",
            caption=lambda c: (
                f"Both about equilibrium. {words.senses(c)} {words.ORBIT_MARKS} "
                "A case stays at its own running speed."
            ),
        )


def family(page: Page) -> None:
    units = page.units
    varied = cast('Literal["damping", "mass"]', choose(
        "Vary", list(words.VARIED), "response_varied", format_func=words.VARIED.__getitem__
    ))  # fmt: skip
    page.say("family", lambda c: Text(words.explain_family(c, varied)))
    left, right = st.columns(2)
    with left:
        page.chart(
            lambda c: draw.family(
                c.response_family(words.VARIANTS[varied]), "disk", varied, c.response, units
            ),
            "family_disk",
            alt="Size of the disk's orbit against speed for several rotors.",
            caption="The disk's orbit. Eq. 5.38 with midspan damping and journal mass added.",
        )
    with right:
        page.chart(
            lambda c: draw.family(
                c.response_family(words.VARIANTS[varied]), "journal", varied, c.response, units
            ),
            "family_journal",
            alt="Size of the journal's orbit against speed for several rotors.",
            caption="The journal's orbit. Eq. 5.38 with midspan damping and journal mass added.",
        )


show(
    "Imbalance response",
    "Vibration of disk and journal when the disk's mass centre lies off the shaft's axis.",
    content,
)
