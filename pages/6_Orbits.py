import streamlit as st

from rotorcalc.figures import orbits as draw
from ui import orbits as ask
from ui.page import framed

with framed(
    "Nonlinear orbits",
    "Let the journal go and watch: its motion on the film's full force, the linear theory beside "
    "it.",
    follows=False,
) as drawn:
    view, units = drawn.view, drawn.units
    answer = st.container()
    asked = ask.choose_release(view)
    page, found = ask.try_out(drawn, asked)
    with answer:
        ask.say_outcome(view, asked, found, units)
    TABS = ["Orbit", "In time", "Spectrum", "Run-up", "Limit cycles", "Onset three ways"]
    orbit, time, spectrum, run_up, cycles, onset = st.tabs(
        TABS, on_change="rerun", key="orbits_tab"
    )

    def chart(draw_release, key, alt, caption):
        shown = lambda v: draw_release(ask.let_go(v, asked), units)  # noqa: E731
        page.chart(shown, f"orbits_{key}", alt=alt, caption=caption)

    if orbit.open:
        left, right = orbit.columns([4, 5])
        with left:
            chart(
                draw.orbit, "path",
                "The journal's path in its clearance circle, with an animation.",
                "Play it, or pull the slider. Blue: M ẍ = F(x, ẋ) + load + imbalance (Eq. 5.1, "
                "forward); purple: the linear theory from the same start (Eq. 5.38).",
            )  # fmt: skip
        with right:
            chart(
                draw.over_time, "time",
                "X and Y of the journal over revolutions, and the linear ones.",
                "X along the load, Y at 90° with the rotation. The linear motion ends where it "
                "leaves the bearing.",
            )  # fmt: skip
    if time.open:
        left, right = time.columns(2)
        with left:
            chart(
                draw.growth, "growth", "Distance from rest over revolutions, logarithmic.",
                "Largest distance over each two revolutions; dashed: e^(Re λ t). Eq. 5.38.",
            )  # fmt: skip
        with right:
            chart(
                draw.film, "film", "Thinnest film over revolutions.",
                "Thinnest film around the journal, h = C(1 − ε). Eq. 5.19.",
            )  # fmt: skip
    if spectrum.open:
        with spectrum:
            ask.show_measured(view, found, units)
        left, right = spectrum.columns([3, 2])
        with left:
            chart(
                draw.spectrum, "spectrum", "Spectrum of the motion over orders, ½× and 1× marked.",
                "Of X + jY over the last quarter, Hann window; negative orders turn against the "
                "shaft.",
            )  # fmt: skip
        with right:
            chart(
                draw.once_a_revolution, "points", "Places of the journal once a revolution.",
                "Once a revolution (Poincaré): synchronous one point, exact half-speed whirl two.",
            )  # fmt: skip
    if run_up.open:
        with run_up:
            if (run := ask.ask_run_up(view)) is not None:
                page.alone().chart(
                    lambda _, run=run: draw.waterfall(run, units), "orbits_waterfall",
                    alt="Spectra over running speed: imbalance at 1×, whirl near ½× past the "
                    "onset.",
                    caption=ask.run_up_caption(view),
                )  # fmt: skip
    if cycles.open:
        with cycles:
            if (branch := ask.ask_cycles(view)) is not None:
                ask.say_cycles(branch, units)
                page.alone().chart(
                    lambda v, branch=branch: draw.cycles(branch, ask.swept(branch), v.speed, units),
                    "orbits_cycles",
                    alt="Size of the limit cycles over speed, stable and unstable, and two sweeps.",
                    caption="Without imbalance: harmonic balance, stability by Floquet. At the "
                    "onset ȧ = (Re λ) a + ℓ (a/C)² a decides.",
                )  # fmt: skip
    if onset.open:
        with onset:
            if (three := ask.ask_onsets(view)) is not None:
                ask.say_onsets(three[0], units)
                ask.with_onset(page).chart(
                    lambda v: draw.onset_growth(*ask.three_onsets(v), units), "orbits_onset",
                    alt="Growth rate over speed: eigenvalues as a line, measured rates as points.",
                    caption="Each point: 16 revolutions of the nonlinear motion after a kick of "
                    "C/10000, its exponentials fitted. Without imbalance. Eqs. 5.38, 5.45 to 5.50.",
                )  # fmt: skip
    page.results("onset_speed", "whirl_frequency", "margin", "damping_ratio")
