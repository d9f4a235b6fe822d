"""What the recesses of a hydrostatic bearing are said to do: pressures, flows, powers, rest."""

from typing import TypeAlias, cast

from rotorcalc import Hydrostatic
from rotorcalc.figures.recesses import names
from rotorcalc.machine import oil_of
from rotorcalc.units import Units
from ui.computed import Computed
from ui.format import amount, digits, minus
from ui.preview import Text

Row: TypeAlias = tuple[str, ...]

_RULE: Row = ("---", "---:", "---:", "---:")


def head(units: Units) -> Row:
    """Return what the columns of `each` are, with their units."""
    return (
        "Recess",
        f"Pressure [{units.pressure.name}]",
        "of supply [%]",
        f"Flow [{units.flow.name}]",
    )


def each(computed: Computed, units: Units) -> list[Row]:
    """Return number and angle, pressure, its share of the supply pressure, and flow of recesses."""
    found, p_s = computed.recesses_here, supply(computed)
    columns = (
        units.pressure.of(found.pressure),
        100.0 * found.pressure / p_s,
        units.flow.of(found.recess_flow),
    )
    return [
        (name, *(minus(digits(float(number))) for number in row))
        for name, *row in zip(names(len(found.pressure)), *columns, strict=True)
    ]


def totals(computed: Computed, units: Units) -> list[Row]:
    """Return what the supply delivers and what is lost, in words and with their units."""
    found = computed.recesses_here
    return [
        ("Flow of the supply", amount(units.flow, found.flow)),
        ("Pump power, pₛ Q", amount(units.power, found.pump_power)),
        ("Friction power", amount(units.power, found.friction_power)),
        ("Pump and friction", amount(units.power, found.total_power)),
    ]


def table(computed: Computed, units: Units) -> Text:
    """Return the recesses, a row each, as Markdown."""
    rows = (head(units), _RULE, *each(computed, units))
    return Text("\n".join(f"| {' | '.join(row)} |" for row in rows))


def summary(computed: Computed, units: Units) -> Text:
    """Return flow and powers of one bearing, in a sentence or two."""
    found = computed.recesses_here
    share = float(found.pump_power / found.total_power)
    return Text(
        f"The supply of one bearing delivers **{amount(units.flow, found.flow)}** at "
        f"{amount(units.pressure, supply(computed))}. Its pump needs "
        f"**{amount(units.power, found.pump_power)}**, without the pump's own loss, and the "
        f"journal loses **{amount(units.power, found.friction_power)}** by friction on the lands: "
        f"together **{amount(units.power, found.total_power)}**, of which "
        f"{digits(float(f'{100.0 * share:.2g}'))} % is the pump's."
    )


def warming(computed: Computed, units: Units) -> str:
    """Return by how much the pump warms the oil, which the balance of heat leaves out."""
    rise = supply(computed) / oil_of(computed.machine).volumetric_heat
    return (
        "The pump's power is supply pressure times flow, without its own loss. It ends as heat, "
        f"as friction does: in restrictors and lands it warms the oil by pₛ/(ρc) = "
        f"{amount(units.rise, rise)}, which the balance of heat leaves out."
    )


def rest(computed: Computed, units: Units) -> list[Row]:
    """Return place and stiffness of the journal as the rotation ends, in words."""
    still = computed.at_rest
    return [
        ("At rest, ε", digits(float(still.eccentricity_ratio))),
        ("At rest, K along the load", amount(units.stiffness, still.stiffness[0, 0])),
        ("At rest, K across it", amount(units.stiffness, still.stiffness[1, 1])),
    ]


def at_rest(computed: Computed, units: Units) -> Text:
    """Return where the journal is and how stiff its film, as the rotation ends."""
    (_, eps), (_, along), (_, across) = rest(computed, units)
    stiff = along if along == across else f"{along} along the load and {across} across it"
    return Text(
        f"At rest the journal floats: as the speed goes to zero, ε = **{eps}**, and the film's "
        f"stiffness is **{stiff}**, whatever the oil's viscosity."
    )


def suction(computed: Computed, units: Units) -> Text | None:
    """Return that the film is under suction somewhere, where it is."""
    found = computed.recesses_here
    if not bool(found.has_suction):
        return None
    lowest = amount(units.pressure, found.lowest_pressure)
    return Text(
        f"The film's lowest pressure is {lowest}: suction, at which oil cavitates sooner or later. "
        "This model takes the film as full; the sidebar, under “Where the model holds”, has the "
        "limits.",
        "info",
    )


def supply(computed: Computed) -> float:
    """Return the supply pressure, p_s [Pa]."""
    return cast("Hydrostatic", computed.machine.bearing.geometry).supply_pressure
