"""Results of the balance of heat: temperatures of film and outlet, and the oil's rise."""

from dataclasses import replace

from rotorcalc.figures.heat import oil_rise
from rotorcalc.films.model import Source
from rotorcalc.heat import USUAL_RISE, heat_balance
from rotorcalc.machine import oil_of
from ui.computed import Computed
from ui.format import tex
from ui.results.record import Result

_ISO = "ISO 7902-1"
_FILM = r"T = \tfrac12\,(T_{in} + T_{out})"
_OUTLET = r"T_{out} = T_{in} + \Delta T"
_NEEDED = r"q = \frac{s\,P}{\rho c\,\Delta T} - Q"
_RISE = r"T_{out} - T_{in} = \frac{s\,P}{\rho c\,(Q + q)}"


def _film_solved(computed: Computed) -> Source:
    if computed.machine.supply is None:
        return Source("Given", r"T\quad\text{given}")
    return Source(_ISO, _FILM)


def _outlet_solved(computed: Computed) -> Source:
    if computed.machine.supply is None:
        return Source("No supply given", _OUTLET)
    return Source(_ISO, _OUTLET)


def _rise_solved(computed: Computed) -> Source:
    if computed.machine.supply is None:
        return Source("Side flow alone", r"\Delta T = \frac{P}{\rho c\,Q}")
    return Source(_ISO, _RISE)


def _film(computed: Computed) -> str:
    supply, point = computed.machine.supply, computed.point
    inlet = tex(supply.temperature) if supply else ""
    out, T = float(point.outlet_temperature), float(point.temperature)
    return rf"\tfrac12\,({inlet} + {tex(out)}) = {tex(T)}"


def _outlet(computed: Computed) -> str:
    supply, point = computed.machine.supply, computed.point
    inlet = tex(supply.temperature) if supply else ""
    return rf"{inlet} + {tex(_rise(computed))} = {tex(float(point.outlet_temperature))}"


def _rise(computed: Computed) -> float:
    return float(oil_rise(computed.point))


def _rise_filled(computed: Computed) -> str:
    supply, point, oil = computed.machine.supply, computed.point, oil_of(computed.machine)
    share, flow = (supply.heat_share, supply.flow) if supply else (1.0, 0.0)
    top = rf"{tex(share)}\cdot {tex(float(point.power_loss))}"
    passing = tex(float(point.side_flow) + flow)
    below = rf"{tex(oil.density)}\cdot {tex(oil.heat_capacity)}\cdot {passing}"
    return rf"\frac{{{top}}}{{{below}}} = {tex(_rise(computed), 'K')}"


def _needed_filled(computed: Computed) -> str:
    machine, supply = computed.machine, computed.machine.supply
    if supply is not None:  # the film is then at another temperature
        T = supply.temperature + 0.5 * USUAL_RISE
        machine = replace(machine, temperature=T, supply=None)
    film, oil = heat_balance(machine, computed.speed), oil_of(machine)
    P, Q = float(film.power_loss), float(film.side_flow)
    top = rf"{tex(supply.heat_share if supply else 1.0)}\cdot {tex(P)}"
    below = rf"{tex(oil.density)}\cdot {tex(oil.heat_capacity)}\cdot {tex(USUAL_RISE)}"
    return rf"\frac{{{top}}}{{{below}}} - {tex(Q)} = {tex(computed.flow_needed)}"


def _has_oil(computed: Computed) -> bool:
    return not computed.has_gas


def _has_grooves(computed: Computed) -> bool:
    return _has_oil(computed) and not computed.has_recesses


HEAT: tuple[Result, ...] = (
    Result(
        "film_temperature", "Film temperature T", "temperature",
        lambda c: float(c.point.temperature), _ISO, _FILM, _film,
        "One temperature stands for the whole film, the mean of inlet and outlet.",
        modelled=False, solved=_film_solved,
    ),
    Result(
        "outlet_temperature", "Outlet temperature", "temperature",
        lambda c: float(c.point.outlet_temperature), _ISO,
        _OUTLET, _outlet, "Of the oil that leaves.",
        unknown="not known", modelled=False, solved=_outlet_solved, belongs=_has_oil,
    ),
    Result(
        "oil_rise", "Rise of the oil ΔT", "rise", _rise, _ISO, _RISE, _rise_filled,
        "With the share s of the loss, side flow Q and groove flow q.",
        unknown="not known", modelled=False, solved=_rise_solved, belongs=_has_oil,
    ),
    Result(
        "flow_needed", "Groove flow needed", "flow", lambda c: c.flow_needed, _ISO, _NEEDED,
        _needed_filled, "Besides the side flow Q, so that the oil warms by ΔT = 20 K, or 36 °F.",
        nought=lambda _: "none", unknown="not known", modelled=False, belongs=_has_grooves,
    ),
)  # fmt: skip
