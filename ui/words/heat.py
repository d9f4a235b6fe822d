"""What the page Heat says: where the loss goes, what flow it takes, what warming changes."""

import math

import streamlit as st

from rotorcalc import Supply
from rotorcalc.figures.heat import Warmed, oil_rise
from rotorcalc.heat import USUAL_RISE
from rotorcalc.machine import oil_of
from rotorcalc.oils import LAW_NAMES
from rotorcalc.units import Units
from ui.computed import Computed
from ui.format import amount, digits, minus
from ui.preview import Text
from ui.results.table import RESULTS

_GAS = (
    "A gas carries next to no heat away: its film takes the temperature of the walls around it, "
    "which is given, and there is no balance of heat. A gas grows more viscous as it warms, so a "
    "warmer film carries more and loses more."
)


def says_gas(computed: Computed) -> bool:
    """Return whether the film is a gas; say then why there is no balance of heat."""
    if computed.has_gas:
        st.info(_GAS)
    return computed.has_gas


def carried(computed: Computed, units: Units) -> Text:
    """Return where the heat goes at the running speed."""
    supply = computed.machine.supply
    said = _given(computed, units) if supply is None else _supplied(computed, supply, units)
    return Text(f"{said} {needed(computed, units)}".rstrip())


def _given(computed: Computed, units: Units) -> str:
    point = computed.point
    rise = amount(units.rise, oil_rise(point))
    T, power = amount(units.temperature, point.temperature), amount(units.power, point.power_loss)
    if float(point.side_flow) == 0.0:
        return (
            f"The film's temperature, {T}, is given. One bearing turns **{power}** into heat, and "
            "no oil leaves its film at the ends."
        )
    return (
        f"The film's temperature, {T}, is given. One bearing turns **{power}** into heat: the "
        f"side flow of {amount(units.flow, point.side_flow)} alone would warm by **{rise}**."
    )


def _supplied(computed: Computed, supply: Supply, units: Units) -> str:
    point, share = computed.point, supply.heat_share
    whole = "" if share == 1.0 else f"{digits(100.0 * share)} % of "
    inlet = amount(units.temperature, supply.temperature)
    return (
        f"{amount(units.flow, point.side_flow + supply.flow)} of oil come at {inlet}, take up "
        f"{whole}"
        f"**{amount(units.power, point.power_loss)}**, and leave at "
        f"{amount(units.temperature, point.outlet_temperature)}: the oil warms by "
        f"**{amount(units.rise, oil_rise(point))}**, and the film is at "
        f"**{amount(units.temperature, point.temperature)}**."
    )


def needed(computed: Computed, units: Units) -> str:
    """Return what flow holds the oil's rise at 20 K, in words; recesses have no grooves."""
    flow, most = computed.flow_needed, amount(units.rise, USUAL_RISE)
    if math.isnan(flow):
        return ""
    if flow == 0.0:
        return f"The side flow alone keeps the rise below {most}."
    if computed.has_recesses:
        through = amount(units.flow, flow + float(computed.point.side_flow))
        return f"A flow of **{through}** through the restrictors holds the rise at {most}."
    return f"A groove flow of **{amount(units.flow, flow)}** holds the rise at {most}."


def warmed(computed: Computed, units: Units) -> Warmed:
    """Return the machine with the balance, and with its film as cold as the supply."""
    cold = computed.unwarmed
    T = amount(units.temperature, cold.machine.temperature or 0.0)
    return Warmed(computed.sweep, cold.sweep, f"film at the supply's {T}")


def table(computed: Computed, units: Units) -> Text:
    """Return what warming changes at the running speed and of the onset, as a table."""
    heads = ("", "Film", "μ", "ε", "Smallest film", "Onset of whirl")
    rows = [
        ("With the balance of heat", computed),
        ("Film everywhere as warm as at this speed", computed.settled),
        ("Film everywhere as cold as the supply", computed.unwarmed),
    ]
    lines = [_row(heads), _row(["---"] * len(heads)), *(_numbers(*row, units) for row in rows)]
    return Text("\n".join(lines))


def _numbers(label: str, computed: Computed, units: Units) -> str:
    point = computed.point
    return _row([
        label,
        amount(units.temperature, point.temperature),
        amount(units.viscosity, point.viscosity),
        minus(digits(float(point.eccentricity_ratio))),
        amount(units.film, point.minimum_film_thickness),
        RESULTS["onset_speed"].shown(computed, units),
    ])  # fmt: skip


def _row(cells: tuple[str, ...] | list[str]) -> str:
    return f"| {' | '.join(cells)} |"


def curves(computed: Computed, units: Units) -> str:
    """Return the caption of the balance's chart."""
    T = amount(units.temperature, computed.point.temperature)
    return (
        f"At {amount(units.speed, computed.speed)}. A warmer film is thinner oil: it makes less "
        f"heat, and the oil carries more, so they meet once, at {T}; there a warmer film cools "
        "down again. ISO 7902-1."
    )


def law(computed: Computed, units: Units) -> str:
    """Return the caption of the viscosity's chart: its range, and how far the laws differ there."""
    oil, sweep = oil_of(computed.machine), computed.sweep
    low, high = (
        amount(units.temperature, end) for end in (sweep.temperature.min(), sweep.temperature.max())
    )
    film = (
        f"The film is at {low} at every speed."
        if low == high
        else f"Shaded: the film up to the top speed, from {low} to {high}."
    )
    reference = amount(units.temperature, oil.reference_temperature)
    return (
        f"{film} Both laws have the same viscosity and slope at {reference}."
        f"{_difference(computed, units)}"
    )


def _difference(computed: Computed, units: Units) -> str:
    """Return how far the two laws are apart where the film is farthest from the reference."""
    oil, other = oil_of(computed.machine), computed.other_oil
    if other is None:
        return ""
    T = computed.sweep.temperature
    far = T.flat[abs(T - oil.reference_temperature).argmax()]
    ratio = float(oil.viscosity(far) / other.viscosity(far))
    if abs(ratio - 1.0) < 0.01:
        return " In this range they agree to 1 %."
    return (
        f" At {amount(units.temperature, far)} the {LAW_NAMES[oil.law]} used here gives "
        f"{digits(float(f'{abs(100.0 * (ratio - 1.0)):.2g}'))} % "
        f"{'more' if ratio > 1.0 else 'less'} than the other."
    )
