from functools import partial
from typing import Literal, cast

import streamlit as st

from rotorcalc.analysis import Axes
from rotorcalc.coefficients import BULK_FLOW, LAMINAR
from rotorcalc.figures import coefficients as draw
from rotorcalc.figures.cursor import over_film
from ui.choices import choose
from ui.frame.page import Page, show
from ui.words import coefficients as words
from ui.words import own
from ui.words.citation import cited, remark


def content(page: Page) -> None:
    axes = of_own(page) if page.computed.has_own else of_a_film(page)
    st.subheader("At the running speed", anchor=False)
    words.show_matrices(page.preview, axes)


def of_own(page: Page) -> Axes:
    page.results("equivalent_stiffness", "whirl_ratio", "rigid_threshold", "critical_mass")
    against_speed(page, "XY")
    return "XY"


def of_a_film(page: Page) -> Axes:
    page.results("sommerfeld", "eccentricity_ratio", "attitude_angle", "equivalent_stiffness")
    axes = cast("Axes", choose(
        "Frame", list(words.FRAMES), "coefficients_axes", format_func=words.FRAMES.__getitem__
    ))  # fmt: skip
    page.tabs("coefficients_tab", {
        "Against speed": partial(against_speed, axes=axes),
        "Against ε": partial(dimensionless, axes=axes, against="ε"),
        "Against σ": partial(dimensionless, axes=axes, against="σ"),
        "Over whirl ratio": over_whirl_ratio,
        "Added mass": added_mass,
        "Why only cross-coupling": only_cross_coupling,
    })  # fmt: skip
    return axes


def against_speed(page: Page, axes: Axes) -> None:
    units = page.units
    left, right = st.columns(2)
    with left:
        page.chart(
            lambda c: draw.stiffness_against_speed(
                c.sweep, c.point, c.coefficients(axes), c.coefficients_here(axes), units
            ),
            "stiffness_speed",
            alt="Stiffness coefficients and equivalent stiffness of one bearing against speed.",
            caption=own.ROWS
            if page.computed.has_own
            else cited(
                "Per bearing, each speed at its own equilibrium.",
                page.computed,
                "stiffness",
                rotor="Eq. 5.45",
            ),
        )
    with right:
        page.chart(
            lambda c: draw.damping_against_speed(
                c.sweep, c.point, c.coefficients(axes), c.coefficients_here(axes), units
            ),
            "damping_speed",
            alt="Damping coefficients of one bearing against speed.",
            caption=own.ROWS
            if page.computed.has_own
            else cited(
                remark(page.computed, "damping", "Per bearing; {}.", "Per bearing."),
                page.computed,
                "damping",
            ),
        )


def dimensionless(page: Page, axes: Axes, against: Literal["ε", "σ"]) -> None:
    symbols: tuple[Literal["k", "c"], ...] = ("k", "c")
    for column, symbol in zip(st.columns(2), symbols, strict=True):
        with column:
            page.figure_of_the_notes(
                lambda c, symbol=symbol: over_film(
                    draw.dimensionless(
                        c.film_coefficients(axes), c.film_coefficients_here(axes), symbol, against
                    ),
                    c.sweep,
                    c.point,
                    page.units,
                    against,
                ),
                f"{symbol}_{against}",
                alt=f"Dimensionless coefficients {symbol} against {against}, logarithmic.",
                caption=words.dimensionless_caption(page.computed, symbol, against),
            )
    page.say("unloaded", words.unloaded)


def over_whirl_ratio(page: Page) -> None:
    if not words.depends_on_whirl(page.computed):
        return
    symbols: tuple[Literal["K", "C"], ...] = ("K", "C")
    for column, symbol in zip(st.columns(2), symbols, strict=True):
        with column:
            name = "Stiffness" if symbol == "K" else "Damping"
            page.chart(
                lambda c, symbol=symbol: draw.over_whirl_ratio(
                    c.over_whirl_ratio, c.point, symbol, page.units
                ),
                f"{symbol}_whirl_ratio", at_one_speed=True,
                alt=f"{name} of one bearing against the frequency of the whirl over the speed.",
                caption=words.whirl_ratio_caption(page.computed, symbol),
            )  # fmt: skip


def added_mass(page: Page) -> None:
    units = page.units
    if not words.knows_added_mass(page.computed):
        return
    left, right = st.columns(2)
    with left:
        page.chart(
            lambda c: draw.added_mass(
                c.added_mass(LAMINAR),
                c.added_mass(BULK_FLOW),
                c.added_mass_here(LAMINAR),
                units,
            ),
            "added_mass",
            alt="Added mass of the film of one bearing against speed.",
            caption="Solid for laminar flow, dotted for bulk flow.",
        )
    with right:
        words.show_added_mass(page.preview)


def only_cross_coupling(page: Page) -> None:
    units = page.units
    if words.say_other_centre(page.preview):
        return
    left, right = st.columns(2)
    with left:
        page.chart(
            lambda c: draw.unloading(c.unloading, c.unloading_here, c.centred, units),
            "unloading",
            at_one_speed=True,
            alt=words.unloading_alt(page.computed),
            caption=cited(
                "At the running speed, the load alone varied; dashed: minus the value.",
                page.computed,
                "stiffness",
                "centre",
            ),
        )
    with right:
        words.show_centred(page.preview)


show(
    "Force coefficients",
    "The film's reaction: four stiffness and four damping coefficients for small motions of "
    "the journal about its equilibrium.",
    content,
)
