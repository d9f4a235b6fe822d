import streamlit as st

from rotorcalc.figures import cursor
from rotorcalc.figures import design as what_if
from rotorcalc.figures import ring as of_ring
from rotorcalc.figures import stability as figures
from rotorcalc.figures.onset_map import onset_map as figure_of_map
from ui.frame.page import Page, show
from ui.preview import Text
from ui.ring import has_ring, whirls
from ui.session import session
from ui.words import design
from ui.words import remedies as remedy
from ui.words import ring as on_ring
from ui.words import stability as ask
from ui.words.citation import cited


def content(page: Page) -> None:
    page.results("onset_speed", "whirl_frequency", "margin", "critical_mass", "onset_ratio")
    page.tabs("stability_tab", {
        "Threshold": threshold,
        **({} if page.computed.has_own else {"Figures of the notes": figures_of_the_notes}),
        "Follower force": follower_force,
        "Map": onset_map,
        "Remedies": remedies,
    })  # fmt: skip


def over_speed(draw, units):
    return lambda c: ask.over_speed(draw, c, units)


def threshold(page: Page) -> None:
    units = page.units
    if not ask.can_whirl(page.computed):
        return
    if has_ring(page.computed):
        two_whirls(page)
    page.say("bare", ask.bare)
    left, right = st.columns(2)
    with left:
        page.chart(
            over_speed(figures.threshold, units),
            "threshold",
            alt="Threshold speed over running speed for the flexible and the rigid shaft, "
            "with the line of equal speeds, their crossing and the unstable side shaded.",
            caption=ask.meets(page.computed),
        )
    with right:
        page.chart(
            over_speed(figures.whirl_frequency, units),
            "whirl_frequency",
            alt="Whirl frequency at the threshold over running speed, with half the speed.",
            caption="At the threshold the rotor whirls at its natural frequency. Eq. 5.47.",
        )
    page.chart(
        over_speed(figures.critical_mass, units),
        "critical_mass",
        alt="Critical mass over the rotor's mass, over running speed; unstable below one.",
        caption="$M_c/M = (Ω_s/Ω)^2$: a rotor heavier than $2M_c$ would whirl. Eq. 5.45.",
    )


def two_whirls(page: Page) -> None:
    units = page.units
    left, right = st.columns([5, 6])
    with left:
        page.say("whirls", lambda c: on_ring.whirls(c, units))
        st.page_link("pages/6_Orbits.py", label="Orbits: the motion and its limit cycles")
    with right:
        page.chart(
            lambda c: of_ring.whirls(whirls(c), units),
            "ring_whirls",
            alt="Frequencies of the whirls in the inner and the outer film over running speed, "
            "with their limits.",
            caption=on_ring.WHIRLS,
        )


def figures_of_the_notes(page: Page) -> None:
    if not ask.can_whirl(page.computed):
        return
    over_eps, computed = ask.choose_abscissa(), page.computed

    def over_film(draw, *more):
        return lambda c: cursor.over_film(
            draw(ask.film_figure(c, over_eps), *(one(c) for one in more)),
            c.sweep, c.point, page.units, "ε" if over_eps else "σ",
        )  # fmt: skip

    left, right = st.columns(2)
    with left:
        page.figure_of_the_notes(
            over_film(figures.whirl_ratio),
            "whirl_ratio",
            alt="Whirl frequency ratio; zero where the film feeds no whirl.",
            caption=lambda c: cited(ask.ends_of_whirl(c), c, "whirl ratio", rotor="Eq. 5.46"),
        )
        page.figure_of_the_notes(
            over_film(figures.critical_mass_number),
            "critical_mass_number",
            alt="Dimensionless critical mass of the bearing.",
            caption=cited(
                r"$m_c = p_s^2 = M_c C Ω^2/F_o$.", computed, "critical mass", rotor="Eq. 5.45"
            ),
        )
    with right:
        page.figure_of_the_notes(
            over_film(figures.threshold_speed),
            "threshold_speed",
            alt="Dimensionless threshold speed of a rigid rotor on the bearing.",
            caption=lambda c: cited(
                rf"$p_s = Ω_s\sqrt{{MC/F_o}}${ask.lowest_threshold(c)}.",
                c,
                "threshold",
                rotor="Eq. 5.45",
            ),
        )
        page.figure_of_the_notes(
            over_film(figures.flexible_threshold, ask.sags, ask.flexible_curves, ask.flexible_here),
            "flexible_threshold",
            alt="Dimensionless threshold speed of flexible rotors for several static sags.",
            caption=cited(
                "The more the shaft sags, Γ = Fₒ/Kᵣₒₜ, the lower the threshold.",
                computed,
                "flexible threshold",
                rotor="Eq. 5.50",
            ),
        )


def follower_force(page: Page) -> None:
    if not ask.has_orbit(page.computed):
        return
    units = page.units
    page.say("balance", lambda c: Text(ask.balance(c, units)))
    left, right = st.columns([2, 3])
    with left:
        page.chart(
            lambda c: figures.energy_bars(ask.energies(c), units),
            "energy_bars",
            at_one_speed=True,
            alt="Energy fed in and dissipated in one turn of the whirl orbit, at the "
            "running speed and at the onset, where the bars meet.",
            caption="Per turn, orbit area (J/m² = N/m) and bearing. Appendix A, Eq. 5.14.",
        )
    with right:
        page.chart(
            lambda c: figures.energy(ask.energies(c), ask.crossing(c), units),
            "energy",
            alt="Energy fed in and dissipated in the whirl orbit over running speed; the "
            "two lines meet at the onset.",
            caption=ask.energies_over_speed,
        )
    st.latex(ask.WORK)
    st.caption(ask.WORK_WORDS)


def onset_map(page: Page) -> None:
    computed, units = page.computed, page.units
    with st.container(key="ask"):
        left, right = st.columns(2)
        with left:
            x = design.choose_input(
                computed.machine, "Across", remedy.usual_input(computed), "stability_x"
            )
        with right:
            y = design.choose_input(computed.machine, "Up", "T", "stability_y", without=x)

    def map_of(c, onsets):
        axes = (design.quantity(x, c.machine, units), design.quantity(y, c.machine, units))
        here = design.value_of(c.machine, x), design.value_of(c.machine, y)
        return figure_of_map(onsets, axes, here, c.speed, units)

    onsets = design.onset_map(computed, x, y, units)
    page.say(
        "map",
        lambda c: Text(design.sides(c, design.onset_map(c, x, y, units), units)),
        while_dragging=lambda c: Text(design.sides(c, design.coarse_map(c, x, y, units), units)),
    )
    page.chart(
        lambda c: map_of(c, onsets),
        "onset_map",
        at_one_speed=True,
        while_dragging=lambda c: map_of(
            c, onsets if c.machine == computed.machine else design.coarse_map(c, x, y, units)
        ),
        alt="Contour map of the onset speed over two inputs, with this machine, and the machines "
        "that are unstable at the running speed shaded.",
        caption="Onset of this machine with two inputs varied and all others unchanged.",
    )


def remedies(page: Page) -> None:
    units = page.units
    page.say("cure", remedy.cure)
    with st.container(key="ask"):
        vary, wanted = ask_for_a_remedy(page)
    left, right = st.columns(2)
    with left:
        if wanted is not None:
            solved(page, vary, wanted)
    with right:
        page.chart(
            lambda c: what_if.tornado(
                design.sensitivities(c), design.names(c.machine, units), c.speed, units
            ),
            "tornado",
            alt="Change of the onset speed for ten per cent less and more of each input.",
            caption=design.TORNADO,
        )


def ask_for_a_remedy(page: Page) -> tuple[str, remedy.Wanted | None]:
    computed, units = page.computed, page.units
    left, middle, right = st.columns([3, 3, 2])
    with left:
        vary = design.choose_input(
            computed.machine, "Change", remedy.usual_input(computed), "stability_vary"
        )
    with middle:
        where = remedy.choose_where(computed)
    with right:
        wanted = remedy.choose_wanted(computed, where, units)
    if wanted is not None:
        page.say("answer", lambda c: Text(remedy.answer(c, vary, wanted, units)))
        with page.preview.dimmed("remedies"):
            remedy.draw_buttons(computed, vary, wanted, units, session().set_value)
    return vary, wanted


def solved(page: Page, vary: str, wanted: remedy.Wanted) -> None:
    units = page.units
    page.chart(
        lambda c: what_if.solution(
            remedy.solution(c, vary, wanted.target(c), units),
            design.quantity(vary, c.machine, units),
            (design.value_of(c.machine, vary), c.onset.speed),
            c.speed,
            units,
        ),
        "solution",
        alt="Onset speed over one input, with the onset wanted and the values that give it.",
        caption="Onset with one input varied, all others unchanged; every crossing is solved for. "
        "A running speed under the pointer is stable where the onset lies above its line.",
    )


show(
    "Stability",
    "The speed above which the rotor whirls, and what affects it.",
    content,
)
