"""Film temperature given, or a supply of oil: values of each that go with those of the other."""

import numpy as np

from rotorcalc import Machine, Supply, analyse, heat
from rotorcalc.units import SI
from ui.bores import Values
from ui.input_record import Input, tidy
from ui.inputs import INPUTS, SUPPLY, has_supply, machine_of, speeds_of

# Digits of a flow, and decimals of a temperature [°C], that are taken over: short in a link.
_DIGITS, _DECIMALS = 4, 1


def other(values: Values) -> Values:
    """Return a supply for values with a film temperature, or a film temperature for a supply.

    At the running speed the film is as warm as before, to a tenth of a degree. Raises ValueError
    where the machine has no film there.
    """
    machine, (speed, _) = machine_of(values), speeds_of(values)
    if has_supply(values):
        T = round(film_temperature(values), _DECIMALS)
        return dict.fromkeys(SUPPLY) | {"T": _in_range(INPUTS["T"], T)}
    found = supply_for(machine, speed)
    flow = float(INPUTS["flow"].unit(SI).of(found.flow))
    kept = {"T_in": round(found.temperature, _DECIMALS), "flow": float(f"{flow:.{_DIGITS}g}")}
    return {"T": None, "share": 1.0} | {
        key: _in_range(INPUTS[key], tidy(value)) for key, value in kept.items()
    }


def film_temperature(values: Values) -> float:
    """Return the film's temperature at the running speed [°C]; raises ValueError if it has none."""
    return float(heat.film_temperature(machine_of(values), speeds_of(values)[0]))


def supply_for(machine: Machine, speed: float) -> Supply:
    """Return a supply with which a film has its given temperature at a speed [rad/s].

    The oil warms by 20 K, or less where the side flow alone is more than that takes: the supply is
    colder than the film by half of it. Raises ValueError as `rotorcalc.heat` does.
    """
    if machine.temperature is None:
        raise ValueError("the machine has a supply already")
    point = analyse(machine, speed)
    if np.isnan(point.power_loss):
        raise ValueError("The model of this bearing's film does not give its loss and flow")
    alone = float(heat.lone_rise(machine, point.power_loss, point.side_flow))
    rise = min(heat.USUAL_RISE, alone)
    return Supply(
        temperature=machine.temperature - 0.5 * rise,
        flow=float(heat.flow_for_rise(machine, speed, rise=rise)),
    )


def _in_range(item: Input, value: float) -> float:
    return min(max(value, item.low), item.high)
