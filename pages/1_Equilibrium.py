import streamlit as st

from rotorcalc.figures import equilibrium as place
from rotorcalc.figures import film
from rotorcalc.figures import recesses as supplied
from rotorcalc.figures import ring as of_ring
from rotorcalc.ring import unloaded_speed_ratio
from ui.choices import choose
from ui.frame.page import Page, show
from ui.ring import has_ring, here, over_speed
from ui.words import equilibrium as words
from ui.words import own
from ui.words import recesses as tell
from ui.words import ring as on_ring
from ui.words.citation import cited, remark


def content(page: Page) -> None:
    if own.said(page.computed, own.PLACE):
        page.results("static_load", "static_sag")
        return
    page.results(
        "eccentricity_ratio", "attitude_angle", "minimum_film_thickness", "power_loss", "side_flow"
    )
    page.tabs("equilibrium_tab", {
        "Locus": locus,
        **({"Ring": ring} if has_ring(page.computed) else {}),
        "Film and pressure": film_and_pressure,
        "Forces": forces,
        "Losses and flow": losses,
        **({"Recesses": recesses} if page.computed.has_recesses else {}),
    })  # fmt: skip


def locus(page: Page) -> None:
    units = page.units
    left, right = st.columns(2)
    with left:
        page.chart(
            lambda c: place.locus(c.path, c.point, units),
            "locus",
            alt="Path of the journal in its clearance, from the wall to the middle.",
            caption=cited(
                "Path of the journal's centre, speeds in rpm along it; "
                f"{words.dotted(page.computed)}.",
                page.computed, "attitude", "eccentricity",
            ),
        )  # fmt: skip
    with right:
        over = choose("Abscissa", ["Over σ", "Over speed"], "equilibrium_over", hidden=True)
        page.chart(
            lambda c: (
                place.position_over_speed(c.sweep, c.point, units)
                if over == "Over speed"
                else place.position_over_sommerfeld(c.curves, c.sweep, c.point, units)
            ),
            "position",
            alt="Eccentricity ratio and attitude angle, the running speed marked on both.",
            caption=cited(
                words.of_position(page.computed, over_speed=over == "Over speed"),
                page.computed,
                "attitude",
                "eccentricity",
            ),
        )


def ring(page: Page) -> None:
    units = page.units
    page.results(
        "ring_speed", "inner_eccentricity", "outer_eccentricity", "inner_film", "outer_film"
    )
    page.say("ring_balance", lambda c: on_ring.balance(c, units))
    left, middle, right = st.columns(3)
    with left:
        page.chart(
            lambda c: of_ring.speed_ratio(
                over_speed(c), here(c), unloaded_speed_ratio(c.machine.bearing), units
            ),
            "ring_ratio",
            alt="Ring's speed over the shaft's, over running speed, and its limit without load.",
            caption=cited("The heavier the load, the slower the ring.", page.computed, "drag"),
        )
    with middle:
        page.chart(
            lambda c: of_ring.eccentricities(over_speed(c), here(c), units),
            "ring_eccentricity",
            alt="Eccentricity ratios of the inner and the outer film over running speed.",
            caption=on_ring.films(page.computed),
        )
    with right:
        page.chart(
            lambda c: of_ring.thicknesses(over_speed(c), here(c), units),
            "ring_films",
            alt="Thinnest place of the inner and of the outer film over running speed.",
            caption=cited("The thinnest place of each film.", page.computed, "thickness"),
        )


def film_and_pressure(page: Page) -> None:
    units = page.units
    if not words.known("Thickness and pressure around the journal", page.computed.film.pressure):
        return
    left, right = st.columns(2)
    with left:
        page.chart(
            lambda c: film.film_around(c.film, c.point, units), "film", at_one_speed=True,
            alt="Thickness and pressure of the film once around the journal, and the load.",
            caption=lambda c: cited(
                "Film and pressure above ambient at mid-length; θ in the sense of rotation."
                f"{words.cavitated(c)}",
                c, "thickness", "pressure",
            ),
        )  # fmt: skip
    with right:
        page.chart(
            lambda c: film.pressure_map(c.film, c.point, units), "pressure", at_one_speed=True,
            alt="Contour map of the film's pressure over angle and axial position.",
            caption=lambda c: cited(
                remark(c, "pressure", "The film unwrapped: {}.", "The film unwrapped.")
                + words.cavitated(c),
                c, "pressure",
            ),
        )  # fmt: skip


def forces(page: Page) -> None:
    units = page.units
    left, right = st.columns(2)
    with left:
        page.chart(
            lambda c: film.forces(c.force_curves, c.forces, c.sweep, c.point, units), "forces",
            alt="Resultant, tangential and radial force of the film over eccentricity ratio.",
            caption=cited(
                "At the running speed: in equilibrium the resultant equals the load.",
                page.computed, "force",
            ),
        )  # fmt: skip
    with right:
        page.chart(
            lambda c: film.force_balance(c.forces, c.sweep, c.point, units), "balance",
            alt="Right-angled triangle of load, tangential and radial film force.",
            caption=cited(
                "The forces close a triangle; φ lies between load and radial force. Grey: its "
                "corner at other speeds.",
                page.computed, "attitude", rotor="Eq. 5.4",
            ),
        )  # fmt: skip


def losses(page: Page) -> None:
    units = page.units
    left, right = st.columns(2)
    computed = page.computed
    friction = place.drag_torque if computed.unloaded else place.friction_coefficient
    for column, draw, caption in (
        (left, place.power_loss,
         cited("Drag torque times speed, all dissipated as heat.", computed, "drag")),
        (right, place.side_flow,
         cited(words.leaves(computed), computed, "flow")),
        (left, friction, "Drag torque/(R Fₒ); without load the drag torque itself."),
        (right, place.minimum_film_thickness, words.thinnest(computed)),
    ):  # fmt: skip
        name = draw.__name__
        title = name.replace("_", " ").capitalize()
        with column:
            if not words.known(title, getattr(page.computed.point, name)):
                continue
            page.chart(
                lambda c, draw=draw: draw(c.sweep, c.point, units), name,
                alt=f"{title} over running speed.",
                caption=caption,
            )  # fmt: skip


def recesses(page: Page) -> None:
    units = page.units
    page.say("powers", lambda c: tell.summary(c, units))
    left, right = st.columns(2)
    with left:
        page.chart(
            lambda c: supplied.pressures(c.recesses, c.recesses_here, tell.supply(c), units),
            "recess_pressures",
            alt="Pressure of each recess over running speed, and the supply pressure.",
            caption=cited(
                "Recesses by number and angle from the load line, in the sense of rotation.",
                page.computed, "eccentricity",
            ),
        )  # fmt: skip
        page.say("recesses", lambda c: tell.table(c, units))
    with right:
        page.chart(
            lambda c: supplied.powers(c.recesses, c.recesses_here, units),
            "recess_powers",
            alt="Power of the pump, power lost by friction, and their sum over running speed.",
            caption=lambda c: tell.warming(c, units),
        )
        page.say("at_rest", lambda c: tell.at_rest(c, units))
        page.say("suction", lambda c: tell.suction(c, units))


show(
    "Static equilibrium",
    "Where the journal settles at the running speed, how its film carries the load, "
    "and its losses and flow.",
    content,
)
