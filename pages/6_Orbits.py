from typing import TypedDict

import streamlit as st

from rotorcalc.figures import orbits as draw
from rotorcalc.figures import run_up as draw_run
from rotorcalc.nonlinear.run_up import RunUp
from ui import measured
from ui.choices import choose
from ui.frame.page import Page, show
from ui.preview import Draw, not_at_once
from ui.words import limit_cycles as cycles
from ui.words import on_demand, own
from ui.words import orbits as ask
from ui.words import run_up as run_ups
from ui.words.citation import cited, remark


def content(page: Page) -> None:
    if own.said(page.computed, own.MOTION):
        st.page_link("pages/5_Response.py", label="Imbalance response")
        page.results("onset_speed", "whirl_frequency", "margin", "damping_ratio")
        return
    page.tabs("orbits_tab", {
        "Orbit": of_a_release(orbit),
        "In time": of_a_release(in_time),
        "Spectrum": of_a_release(spectrum),
        "Run-up": on_release(run_up),
        "Limit cycles": on_release(limit_cycles),
        "Onset three ways": on_release(onset_three_ways),
    })  # fmt: skip
    page.results("onset_speed", "whirl_frequency", "margin", "damping_ratio")


def of_a_release(content):
    """Return a tab's content that begins with a release, and what the journal did."""

    def released(page: Page) -> None:
        if not on_demand.has_motion(page.computed.machine.bearing):
            return
        answer = st.container(key="outcome")
        with st.container(key="release"):
            asked = ask.choose_release(page.computed)
        shown = ask.try_out(page, asked)
        if shown is None:
            return
        with answer:
            ask.say_outcome(shown.preview, asked)
        content(shown, asked)

    return released


def on_release(content):
    """Return a tab's content that takes too long to follow a slider: it is dimmed meanwhile."""

    def dimmed(page: Page) -> None:
        with page.preview.dimmed(content.__name__):
            if on_demand.has_motion(page.computed.machine.bearing):
                content(page)

    return dimmed


class Drawings(TypedDict):
    """A chart's functions of the machine."""

    draw: Draw
    while_dragging: Draw


def of_release(draw_release, page: Page, asked: ask.Ask) -> Drawings:
    """Return the functions that draw a release, and a coarser one while a slider is dragged."""
    units = page.units
    return {
        "draw": lambda c: draw_release(ask.let_go(c, asked), units),
        "while_dragging": lambda c: draw_release(ask.coarse(c, asked), units),
    }


def orbit(page: Page, asked: ask.Ask) -> None:
    left, right = st.columns([4, 5])
    with left:
        page.chart(
            key="orbits_path",
            **of_release(measured.over_orbit(draw.orbit), page, asked),
            alt="The journal's path in its clearance, with an animation.",
            caption="Play it, or move the slider. Blue: M ẍ = F(x, ẋ) + load + imbalance (Eq. 5.1, "
            "forward); purple: the linear theory from the same start (Eq. 5.38)."
            + ask.of_ring(page.computed)
            + measured.orbit_words(),
        )
    with right:
        page.chart(
            key="orbits_time",
            **of_release(draw.over_time, page, asked),
            alt="X and Y of the journal over revolutions, and by linear theory.",
            caption="X along the load, Y at 90° in the sense of rotation. The linear motion ends "
            "where it leaves the bearing.",
        )


def in_time(page: Page, asked: ask.Ask) -> None:
    left, right = st.columns(2)
    with left:
        page.chart(
            key="orbits_growth",
            **of_release(draw.growth, page, asked),
            alt="Distance from equilibrium over revolutions, logarithmic.",
            caption="Largest distance over each two revolutions; dashed: "
            "$e^{\\mathrm{Re}\\,λ\\,t}$. Eq. 5.38.",
        )
    with right:
        page.chart(
            key="orbits_film",
            **of_release(draw.film, page, asked),
            alt="Thinnest film over revolutions.",
            caption=cited(
                remark(
                    page.computed,
                    "thickness",
                    "Thinnest film around the journal, h = {}.",
                    "Thinnest film around the journal.",
                ),
                page.computed,
                "thickness",
            ),
        )


def spectrum(page: Page, asked: ask.Ask) -> None:
    ask.show_measured(page.preview, asked)
    left, right = st.columns([3, 2])
    with left:
        page.chart(
            key="orbits_spectrum",
            **of_release(measured.over_spectrum(draw.spectrum), page, asked),
            alt="Spectrum of the motion over orders, ½× and 1× marked.",
            caption="Of X + jY over the last quarter, Hann window; negative orders turn against "
            "the shaft.",
        )
    with right:
        page.chart(
            key="orbits_points",
            **of_release(draw.once_a_revolution, page, asked),
            alt="Positions of the journal once per revolution.",
            caption="Once per revolution (Poincaré): one point if synchronous, two in an exact "
            "half-speed whirl.",
        )


def run_up(page: Page) -> None:
    asked = run_ups.choose_run(page.computed)
    run = run_ups.ask_run(page, asked)
    if run is not None:
        run_ups.say_seen(page.computed, asked, run, page.units)
        run_up_charts(page.alone(), asked, run)
    run_ups.say_why(page.computed, asked, page.units)


def run_up_charts(page: Page, asked: run_ups.AskRun, run: RunUp) -> None:
    units, marks = page.units, run_ups.marks(page.computed, asked)
    picture = choose("Picture", ["Amplitude", "Spectra rising", "Spectra falling"],
                     "orbits_picture", hidden=True)  # fmt: skip
    if picture == "Amplitude":
        branch = cycles.known(page.computed)
        page.chart(
            lambda _: draw_run.hysteresis(run, branch, marks, units), "orbits_hysteresis",
            while_dragging=not_at_once,
            alt="Amplitude over speed as it rises and as it falls, the onset marked.",
            caption=run_ups.caption(branch),
        )  # fmt: skip
        if branch is None and on_demand.ask_cycles(page) is not None:
            st.rerun()
        return
    passage = run.up if picture == "Spectra rising" else run.down
    page.chart(
        lambda _: draw_run.waterfall(passage, run.clearance, marks, units), "orbits_waterfall",
        while_dragging=not_at_once,
        alt="Spectra over running speed: imbalance at 1×, whirl near ½× past the onset.",
        caption="The journal's forward circles, each spectrum of 64 revolutions; dashed: Im λ/Ω of "
        "the whirl that decays slowest. Colours are logarithmic.",
    )  # fmt: skip


def limit_cycles(page: Page) -> None:
    units = page.units
    if (branch := on_demand.ask_cycles(page)) is not None:
        on_demand.say_held(branch, page.computed, units)
        on_demand.say_cycles(branch, page.computed, units)
        page.alone().chart(
            lambda c, branch=branch: draw.cycles(
                branch, on_demand.swept(branch, c), c.speed, units
            ),
            "orbits_cycles",
            while_dragging=not_at_once,
            alt="Size of the limit cycles over speed, stable and unstable, and two sweeps.",
            caption="Without imbalance: harmonic balance, stability by Floquet. At the "
            "onset ȧ = (Re λ) a + ℓ (a/C)² a decides.",
        )  # fmt: skip


def onset_three_ways(page: Page) -> None:
    units = page.units
    if (three := on_demand.ask_onsets(page)) is not None:
        on_demand.say_onsets(three[0], units)
        on_demand.with_onset(page).chart(
            lambda c: draw.onset_growth(*on_demand.three_onsets(c), units), "orbits_onset",
            while_dragging=not_at_once,
            alt="Growth rate over speed: eigenvalues as a line, measured rates as points.",
            caption="Each point: exponentials fitted to eight whirls of the nonlinear motion from "
            "C/10000. Without imbalance. Eqs. 5.38, 5.45 to 5.50.",
        )  # fmt: skip


show(
    "Nonlinear orbits",
    "Release the journal, and compare its motion under the full film force with the linear theory.",
    content,
)
