import streamlit as st

from rotorcalc.figures import equilibrium, heat
from ui.frame import supply
from ui.frame.page import Page, show
from ui.words import equilibrium as film
from ui.words import heat as words
from ui.words import own
from ui.words.citation import cited


def content(page: Page) -> None:
    if own.said(page.computed, own.HEAT):
        return
    if words.says_gas(page.computed):
        page.results("film_temperature", "viscosity", "power_loss")
        loss(page)
        return
    # Recesses have no grooves: the words below have the flow through their restrictors.
    needed = () if page.computed.has_recesses else ("flow_needed",)
    page.results("film_temperature", "outlet_temperature", "power_loss", "oil_rise", *needed)
    if not film.known("Loss, flow and their heat", page.computed.point.power_loss):
        return
    page.tabs("heat_tab", {
        "Over speed": over_speed,
        "Balance": balance,
        "What warming does": warming,
        "Oil": oil,
    })  # fmt: skip


def loss(page: Page) -> None:
    page.chart(
        lambda c: equilibrium.power_loss(c.sweep, c.point, page.units), "heat_loss",
        alt="Power loss over running speed.", caption=_loss(page),
    )  # fmt: skip


def _loss(page: Page) -> str:
    return cited("Drag torque times speed, all dissipated as heat.", page.computed, "drag")


def over_speed(page: Page) -> None:
    units = page.units
    given = page.computed.machine.supply is None
    side = "What the side flow alone would warm by, if it carried all the loss."
    charts = (
        (heat.temperatures, "temperatures", "Given, the same at every speed."
         if given else "The film is at the mean of inlet and outlet. ISO 7902-1."),
        (heat.rise, "rise", side if given else "From inlet to outlet."),
        (equilibrium.power_loss, "heat_loss", _loss(page)),
        (heat.flows, "flows", cited("Oil that passes one bearing.", page.computed, "flow")),
    )  # fmt: skip
    for number, row in enumerate((charts[:2], charts[2:])):
        if number:  # below the first charts, which stand above the fold with their axes
            page.say("heat", lambda c: words.carried(c, units))
        for column, (draw, key, caption) in zip(st.columns(2), row, strict=True):
            with column:
                page.chart(
                    lambda c, draw=draw: draw(c.sweep, c.point, units), key,
                    alt=f"{key.replace('_', ' ').capitalize()} over running speed.",
                    caption=caption,
                )  # fmt: skip


def balance(page: Page) -> None:
    if page.computed.machine.supply is None:
        supply.offer()
        return
    page.chart(
        lambda c: heat.balance(c.heat_curves, c.point, page.units), "heat_balance",
        alt="Heat made and heat carried over the film's temperature, which cross at the balance.",
        caption=lambda c: words.curves(c, page.units),
    )  # fmt: skip


def warming(page: Page) -> None:
    if page.computed.machine.supply is None:
        supply.offer()
        return
    page.say("warming", lambda c: words.table(c, page.units))
    left, right = st.columns(2)
    for column, draw, key in (
        (left, heat.eccentricity, "warm_eps"),
        (right, heat.film, "warm_film"),
    ):
        with column:
            page.chart(
                lambda c, draw=draw: draw(words.warmed(c, page.units), c.point, page.units), key,
                alt="With the balance of heat and with the film at the supply's temperature.",
                caption="Dashed: the film at the supply's temperature at every speed.",
            )  # fmt: skip


def oil(page: Page) -> None:
    page.chart(
        lambda c: heat.viscosity(c.sweep, c.point, c.other_oil, page.units), "oil_viscosity",
        alt="Viscosity of the oil over temperature by both laws, the film's range shaded.",
        caption=lambda c: words.law(c, page.units),
    )  # fmt: skip


show(
    "Heat",
    "Where the loss goes: the oil that carries it, the temperature that follows, what it changes.",
    content,
)
