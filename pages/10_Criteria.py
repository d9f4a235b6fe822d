import streamlit as st

from rotorcalc.figures import campbell
from rotorcalc.figures import criteria as draw
from ui import criteria
from ui.frame import criteria as frame
from ui.frame.page import Page, show
from ui.inputs import in_units
from ui.preview import not_at_once
from ui.words import criteria as words


def content(page: Page) -> None:
    units = page.units
    answer = st.container(key="outcome")
    asked = frame.ask(page.preview)
    if asked is not None:
        held = not_at_once if criteria.takes_long(page.computed) else None
        with answer:
            page.say("criteria", lambda c: words.verdict(c, asked, units), while_dragging=held)
        page.tabs("criteria_tab", {
            "Table": of(table, asked),
            "Level one": of(level_one, asked),
            "Critical speeds": of(critical_speeds, asked),
            "Campbell": of(campbell_diagram, asked),
        })  # fmt: skip
        page.say("graded", lambda c: words.imbalance(c, asked, units))
        notes()
    page.results("onset_speed", "margin", "damping_ratio", "natural_frequency")


def of(content, asked):
    """Return a tab's content for what is asked, or why there is none."""

    def drawn(page: Page) -> None:
        try:
            content(page, asked)
        except ValueError as error:  # raised before anything was drawn
            st.warning(f"{in_units(f'{error}', page.units)}.")

    return drawn


def table(page: Page, asked: criteria.Asked) -> None:
    held = not_at_once if criteria.takes_long(page.computed) else None
    page.say("table", lambda c: words.table(c, asked, page.units), while_dragging=held)


def level_one(page: Page, asked: criteria.Asked) -> None:
    page.chart(
        lambda c: draw.decrement(criteria.stability(c, asked), page.units),
        "level_one",
        while_dragging=not_at_once if criteria.takes_long(page.computed) else None,
        alt="Log decrement of the first forward mode over the cross-coupled stiffness at midspan, "
        "with the anticipated one, the required decrement 0.1 and where the decrement vanishes.",
        caption=words.STABLE,
    )


def critical_speeds(page: Page, asked: criteria.Asked) -> None:
    page.chart(
        lambda c: draw.critical_speeds(criteria.critical(c, asked), page.units),
        "critical_speeds",
        alt="The disk's response over running speed with critical speeds, half-power speeds, the "
        "speeds of operation and the margins required beside them.",
        caption=lambda c: words.of_critical_speeds(c, asked, page.units),
    )


def campbell_diagram(page: Page, _: criteria.Asked) -> None:
    def diagram(c, **held):
        found = criteria.modes_over_speed(c, **held)
        return campbell.diagram(found, page.units, running_speed=c.speed)

    page.alone().chart(
        diagram,
        "campbell",
        while_dragging=lambda c: diagram(c, while_dragging=True),
        alt="Frequencies of forward and backward modes over running speed, with the lines of the "
        "running speed and of half of it.",
        caption=words.CAMPBELL,
    )


def notes() -> None:
    """Say folded where the numbers are from, and what is left out."""
    with st.expander("Where these numbers come from, and what is left out"):
        st.markdown(f"{words.SOURCES}\n\n{words.RULES}\n\n{words.LEFT_OUT}")


show(
    "Criteria",
    "What standards ask of this machine: value, limit, source and verdict of each criterion.",
    content,
)
