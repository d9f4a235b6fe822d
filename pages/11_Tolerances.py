import streamlit as st

from rotorcalc import Tolerance, onset_speed
from rotorcalc.figures import input_sweep as sweeps
from rotorcalc.figures import tolerances as figures
from ui.frame.page import Page, show
from ui.preview import Text, not_at_once
from ui.words import one_input
from ui.words import tolerances as ask

DECREMENT = "Of the least damped mode at the running speed, −2π Re λ/|Im λ|. Eq. 5.38."
SWEPT = (
    ("onset", sweeps.onset, "Onset of whirl with one input varied, all others unchanged."),
    ("log_decrement", sweeps.log_decrement, DECREMENT),
    ("margin", sweeps.margin, "Onset over running speed, less one."),
    ("film", sweeps.film, "Thinnest film around the journal at the running speed."),
)


def content(page: Page) -> None:
    page.tabs("tolerances_tab", {"Tolerances": tolerances, "Sweep": sweep})
    page.results("onset_speed", "margin", "whirl_frequency", "damping_ratio")


def tolerances(page: Page) -> None:
    with page.preview.dimmed("tolerances"):
        answer = st.container()
        left, right = st.columns([2, 3])
        with left, st.container(key="ask"):
            asked = ask.choose_study(page)
        with right:
            drawn = ask.drawn(page, asked)
        if drawn is None:
            return
        if drawn.before:
            answer.warning(drawn.before)
        with answer, outcome(drawn, "answer"):
            st.info(ask.said(drawn.found, page.units))
        with right, outcome(drawn, "onsets"):
            onsets(page.alone(), drawn.found)
        with outcome(drawn, "rest"):
            what_matters(page.alone(), drawn.study, drawn.found)
            margins(page.alone(), drawn.study, drawn.found)
            machines(page, drawn.study, drawn.found)


def outcome(drawn: ask.Drawn, part: str):
    """Return a container of a result, dimmed where it is an earlier one's."""
    return st.container(key=f"{'former' if drawn.before else 'drawn'}_{part}")


def onsets(page: Page, found: Tolerance) -> None:
    units = page.units
    page.chart(
        lambda _: figures.onset_histogram(found, onset_speed(found.machine).speed, units),
        "tolerances_onset",
        while_dragging=not_at_once,
        alt="Histogram of the onset speeds of the machines drawn, the running speed marked.",
        caption="Onset of each machine: the speed at which a mode begins to grow, Eq. 5.38.",
    )


def margins(page: Page, study: ask.Study, found: Tolerance) -> None:
    units, first = page.units, found.influences[0].field
    left, right = st.columns(2)
    with left:
        page.chart(
            lambda _: figures.margin_histogram(found, units),
            "tolerances_margin",
            while_dragging=not_at_once,
            alt="Histogram of the margins of the machines drawn over the running speed.",
            caption="Onset over running speed, less one.",
        )
    with right:
        quantity = ask.quantity_of(study, found, first, units)
        page.chart(
            lambda _: figures.cloud(found, first, quantity, units),
            "tolerances_cloud",
            while_dragging=not_at_once,
            alt="Onset speed of the machines drawn over the input that matters most.",
            caption="A point is a machine drawn; all other inputs spread too.",
        )


def what_matters(page: Page, study: ask.Study, found: Tolerance) -> None:
    names = ask.names_of(study)
    st.markdown(ask.matters(found, names))
    page.chart(
        lambda _: figures.ranking(found, names),
        "tolerances_ranking",
        while_dragging=not_at_once,
        alt="First-order index of each input for the onset, with its standard error.",
        caption="S is the share of the onset's variance that one input alone explains, with its "
        "standard error; one without effect may be estimated a little below 0. The interval of "
        "the probability is Wilson's.",
    )


def machines(page: Page, study: ask.Study, found: Tolerance) -> None:
    with st.expander("Machines drawn"):
        ask.table(study, found, page.units)


def sweep(page: Page) -> None:
    with st.container(key="ask"):
        varied = one_input.choose(page)
    with page.preview.dimmed("sweep"):
        found = one_input.ask(page, varied)
    if found is None:
        return
    page.say(
        "sweep",
        lambda c: Text(one_input.changes(varied, one_input.over(c, varied))),
        while_dragging=lambda c: Text(one_input.changes(varied, one_input.coarse(c, varied))),
    )
    left, right = st.columns(2)
    for place, (key, draw, caption) in enumerate(SWEPT):
        with right if place % 2 else left:
            page.chart(
                over_input(draw, one_input.over, varied, page),
                f"sweep_{key}",
                while_dragging=over_input(draw, one_input.coarse, varied, page),
                alt=f"{key.replace('_', ' ').capitalize()} over one input, the machine marked.",
                caption=caption,
            )


def over_input(draw, over, varied: one_input.Varied, page: Page):
    return lambda c: draw(over(c, varied), one_input.here(c, varied), varied.axis, page.units)


show(
    "Tolerances",
    "Machines as they are made: how their onsets spread, and which input matters most.",
    content,
)
