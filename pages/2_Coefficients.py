from typing import Literal

import streamlit as st

from rotorcalc.analysis import Axes
from rotorcalc.coefficients import BULK_FLOW, LAMINAR
from rotorcalc.figures import coefficients as draw
from ui import coefficients as words
from ui.page import framed

with framed(
    "Force coefficients",
    "How the film pushes back: four stiffness and four damping coefficients for small motions of "
    "the journal about its equilibrium.",
) as page:
    view, units = page.view, page.units
    page.results("sommerfeld", "eccentricity_ratio", "attitude_angle", "equivalent_stiffness")
    axes: Axes = st.segmented_control(
        "Frame", list(words.FRAMES), format_func=words.FRAMES.__getitem__, key="coefficient_axes",
        default="XY", required=True, persist_state="session",
    )  # fmt: skip
    speed, eccentricity, sommerfeld, mass, centre = st.tabs(
        ["Against speed", "Against ε", "Against σ", "Added mass", "Why only cross-coupling"],
        on_change="rerun", key="coefficient_tabs",
    )  # fmt: skip

    if speed.open:
        left, right = speed.columns(2)
        with left:
            page.chart(
                lambda v: draw.stiffness_against_speed(
                    v.sweep, v.point, v.coefficients(axes), v.coefficients_here(axes), units
                ),
                "stiffness_speed",
                alt="Stiffness coefficients and equivalent stiffness of one bearing against speed.",
                caption="Per bearing, each speed at its own equilibrium. Eqs. 5.30, 5.35, 5.45.",
            )
        with right:
            page.chart(
                lambda v: draw.damping_against_speed(
                    v.sweep, v.point, v.coefficients(axes), v.coefficients_here(axes), units
                ),
                "damping_speed",
                alt="Damping coefficients of one bearing against speed.",
                caption="Per bearing; large at low speed, where the film is thin. Eqs. 5.31, 5.35.",
            )

    def film_chart(symbol: Literal["k", "c"], against: Literal["ε", "σ"]) -> None:
        page.chart(
            lambda v: draw.dimensionless(
                v.film_coefficients(axes), v.film_coefficients_here(axes), symbol, against
            ),
            f"{symbol}_{against}",
            alt=f"Dimensionless coefficients {symbol} against {against}, logarithmic.",
            caption=words.dimensionless_caption(symbol, against),
        )

    if eccentricity.open:
        left, right = eccentricity.columns(2)
        with left:
            film_chart("k", "ε")
        with right:
            film_chart("c", "ε")
        words.say_unloaded(view)
    if sommerfeld.open:
        left, right = sommerfeld.columns(2)
        with left:
            film_chart("k", "σ")
        with right:
            film_chart("c", "σ")
        words.say_unloaded(view)
    if mass.open:
        left, right = mass.columns(2)
        with left:
            page.chart(
                lambda v: draw.added_mass(
                    v.added_mass(LAMINAR),
                    v.added_mass(BULK_FLOW),
                    v.added_mass_here(LAMINAR),
                    units,
                ),
                "added_mass",
                alt="Added mass of the film of one bearing against speed.",
                caption="Solid for laminar flow, dotted for bulk flow.",
            )
        with right:
            words.show_added_mass(view, units)

    if centre.open:
        left, right = centre.columns(2)
        with left:
            page.chart(
                lambda v: draw.unloading(v.unloading, v.unloading_here, v.centred, units),
                "unloading",
                alt="Stiffness against eccentricity ratio: direct falls to zero, cross stays.",
                caption="At the running speed, the load alone varied; dashed: minus the value. "
                "Eqs. 5.35, 5.37.",
            )
        with right:
            words.show_centred(view, units)

    st.subheader("At the running speed", anchor=False)
    words.show_matrices(view, axes, units)
