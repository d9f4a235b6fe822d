"""Where the heat goes: the film's temperature from the oil supplied, its flow and the film's loss.

One temperature stands for the whole film, the mean of what enters and what leaves (ISO 7902-1):

    T_out = T_in + share·P/(ρc(Q + q)),  T = (T_in + T_out)/2,  μ at T,

with the loss P and the side flow Q of the film itself, and the flow q that passes the grooves
besides. At one speed and load, let the film warm: the loss falls, as the oil thins, and so does
the loss over the flow. In a film of fixed parts μΩ enters through σ alone, so these are two
properties of the film, that σ·drag and σ·drag/flow rise with σ; every bore here has them at every
load. Then heat made over heat carried falls with T, and there is never more than one balance: it is
stable, and a bracket holds it.

With the half rise θ = T − T_in and G(θ) = share·P/(2ρc(Q + q)) the balance is θ = G(θ). ln G is
nearly straight over θ: the next θ solves θ = G_k exp(−a(θ − θ_k)), a the slope by the last three
places, which is Wright's function, θ = ω(ln aG_k + aθ_k)/a.

Source: ISO 7902-1:2020, Hydrodynamic plain journal bearings under steady-state conditions.
"""

import functools
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import wrightomega

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, checked_speed, real_array
from rotorcalc.display import Result
from rotorcalc.films import FilmUnits, OperatingPoints, film_of, has_answer, turning_bounds
from rotorcalc.machine import HOTTEST, Machine, Supply, oil_of

# A step of θ below this share of it is the last: it leaves an error about a hundred thousand times
# smaller. Halving alone would end in half as many steps as this.
_SETTLED, _MOST_STEPS = 3e-7, 100
# Slope of ln G where none is known yet, so that α = 0 is no division by zero.
_FLAT = 1e-200
# The rise that ISO 7902-1 assumes at first, and about which a flow is usually chosen [K].
USUAL_RISE = 20.0


@dataclass(frozen=True, eq=False)
class HeatBalance(Result):
    """The heat of one bearing, fields of shape (...).

    Attributes
    ----------
    speed : array
        Running speed, Ω [rad/s].
    temperature : array
        Of the film, T [°C].
    outlet_temperature : array
        Of the oil that leaves, T_out [°C]; NaN where the film's temperature is given.
    viscosity : array
        Of the oil in the film, μ [Pa·s].
    power_loss : array
        Loss of the film, P [W].
    side_flow : array
        Oil that leaves the film at both ends, Q [m³/s].
    carried : array
        Heat that side flow and supply carry from T_in to T_out [W]; NaN where the film's
        temperature is given.
    """

    speed: Array
    temperature: Array
    outlet_temperature: Array
    viscosity: Array
    power_loss: Array
    side_flow: Array
    carried: Array


@dataclass(frozen=True, eq=False)
class HeatCurves(Result):
    """Heat made and heat carried over the film's temperature, at one speed; their crossing is T.

    Attributes
    ----------
    temperature : array, (n,)
        Of the film, T [°C].
    made : array, (n,)
        The oil's share of the loss, share·P [W]; NaN where the film does not carry its load.
    carried : array, (n,)
        2ρc(Q + q)(T − T_in) [W]; likewise.
    """

    temperature: Array
    made: Array
    carried: Array


@checked
def film_temperature(machine: Machine, speed: ArrayLike) -> Array:
    """Return the film's temperature at running speeds.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    array, (...)
        T [°C]: given, or from the supply by the balance of heat.

    Raises
    ------
    ValueError
        Where no balance exists: no oil leaves the film, the oil would be hotter than any law of its
        viscosity reaches, or so thin that the film does not carry the load.
    """
    speeds = checked_speed(speed)
    if machine.temperature is not None:
        return np.full(speeds.shape, machine.temperature)
    found = _temperatures(machine, speeds)
    if np.any(none := np.isnan(found)):
        _refuse(machine, float(speeds[none].flat[0]))
    return found


@checked
def viscosity(machine: Machine, speed: ArrayLike) -> Array | float:
    """Return the viscosity of the oil in the film at running speeds.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    array, (...), or float
        μ [Pa·s]; one number where the film's temperature is given.

    Raises
    ------
    ValueError
        As `film_temperature` does.
    """
    speeds = checked_speed(speed)
    if machine.temperature is not None:
        return machine.viscosity
    return machine.oil.viscosity(film_temperature(machine, speeds))


@checked
def has_film(machine: Machine, speed: ArrayLike) -> BoolArray:
    """Return at which speeds the film carries the load, and has a temperature.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    boolean array, (...)
        False where `equilibrium` refuses the speed.
    """
    speeds = checked_speed(speed)
    if machine.temperature is not None:
        return has_answer(
            machine.bearing, speeds, viscosity=machine.viscosity, load=machine.static_load
        )
    return ~np.isnan(_temperatures(machine, speeds))


@checked
def hottest_speed(machine: Machine) -> float:
    """Return the highest speed at which a machine's film has a temperature.

    Parameters
    ----------
    machine : Machine
        A machine with a supply.

    Returns
    -------
    float
        Ω [rad/s], to 1e-4 of itself; infinite above 1e9, 0 where there is none.
    """
    low, high, points = 1e-3, 1e9, 300
    for _ in range(3):
        speed = np.geomspace(low, high, points)
        known = np.flatnonzero(has_film(machine, speed))
        if not known.size:
            return 0.0
        last = int(known[-1])
        if last == points - 1:
            return np.inf if high >= 1e9 else high
        low, high, points = float(speed[last]), float(speed[last + 1]), 40
    return low


@checked
def settled(machine: Machine, speed: float) -> Machine:
    """Return a machine with its film at the temperature of one speed.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    Machine
        The same where its film's temperature is given; otherwise with that of the balance.

    Raises
    ------
    ValueError
        As `film_temperature` does.
    """
    if machine.temperature is not None:
        return machine
    return replace(machine, temperature=float(film_temperature(machine, speed)), supply=None)


@checked
def heat_balance(machine: Machine, speed: ArrayLike) -> HeatBalance:
    """Return loss, flow and temperatures of a machine's bearing.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    HeatBalance
        Its fields have the shape (...).

    Raises
    ------
    ValueError
        As `film_temperature` does.
    """
    speeds = checked_speed(speed)
    T = film_temperature(machine, speeds)
    P, Q = _loss_and_flow(machine, speeds, T)
    out = outlet_temperature(machine, P, Q)
    return HeatBalance(
        speed=speeds,
        temperature=T,
        outlet_temperature=out,
        viscosity=machine.oil.viscosity(T),
        power_loss=P,
        side_flow=Q,
        carried=_carried(machine, Q, out - (machine.supply.temperature if machine.supply else 0.0)),
    )


@checked
def outlet_temperature(machine: Machine, power_loss: ArrayLike, side_flow: ArrayLike) -> Array:
    """Return the temperature of the oil that leaves, T_out = T_in + share·P/(ρc(Q + q)).

    Parameters
    ----------
    machine : Machine
        The machine.
    power_loss, side_flow : array_like, (...)
        Loss P [W] and side flow Q [m³/s] of one bearing.

    Returns
    -------
    array, (...)
        T_out [°C]; NaN where the film's temperature is given, and that of the supply unknown.
    """
    P, Q = real_array("power_loss", power_loss), real_array("side_flow", side_flow)
    supply = machine.supply
    if supply is None:
        return np.full(P.shape, np.nan)
    return supply.temperature + 2.0 * _half_rise(machine, supply, P, Q)


@checked
def heat_curves(machine: Machine, speed: float, temperature: ArrayLike) -> HeatCurves:
    """Return heat made and heat carried over the film's temperature, at one speed.

    Parameters
    ----------
    machine : Machine
        A machine with a supply.
    speed : float
        Running speed, Ω [rad/s], positive.
    temperature : array_like, (n,)
        Temperatures of the film, T [°C].

    Returns
    -------
    HeatCurves
        Over these temperatures.

    Raises
    ------
    ValueError
        Where the machine has no supply.
    """
    supply = machine.supply
    if supply is None:
        raise ValueError("machine: its film's temperature is given; a supply makes it a balance")
    T = np.atleast_1d(real_array("temperature", temperature))
    P, Q = np.full(T.shape, np.nan), np.full(T.shape, np.nan)
    speeds = np.full(T.shape, float(speed))
    held = _highest(machine, speeds) >= T
    P[held], Q[held] = _loss_and_flow(machine, speeds[held], T[held])
    carried = _carried(machine, Q, 2.0 * (T - supply.temperature))
    return HeatCurves(temperature=T, made=supply.heat_share * P, carried=carried)


@checked
def lone_rise(machine: Machine, power_loss: ArrayLike, side_flow: ArrayLike) -> Array:
    """Return how far the side flow alone would warm if it carried a film's loss, P/(ρcQ).

    Parameters
    ----------
    machine : Machine
        The machine, whose oil it is.
    power_loss, side_flow : array_like, (...)
        Loss P [W] and side flow Q [m³/s] of one bearing.

    Returns
    -------
    array, (...)
        [K]; infinite where no oil leaves the film.
    """
    P, Q = real_array("power_loss", power_loss), real_array("side_flow", side_flow)
    with np.errstate(divide="ignore"):
        return np.asarray(P / (oil_of(machine).volumetric_heat * Q))


@checked
def flow_for_rise(machine: Machine, speed: ArrayLike, *, rise: float = USUAL_RISE) -> Array:
    """Return the flow through the grooves with which the oil warms by a given rise.

    Parameters
    ----------
    machine : Machine
        The machine. With a supply the film is at T_in + rise/2 and the oil takes its share of the
        loss; a given film temperature stays, and the oil takes all.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.
    rise : float
        T_out − T_in [K], positive.

    Returns
    -------
    array, (...)
        Flow of one bearing besides its side flow, q [m³/s]; 0 where the side flow is enough.

    Raises
    ------
    ValueError
        Where the rise is not positive, or the film does not carry its load so warm.
    """
    if not 0.0 < rise < np.inf:
        raise ValueError(f"rise = {rise} K: must be positive and finite")
    speeds, supply = checked_speed(speed), machine.supply
    share = 1.0 if supply is None else supply.heat_share
    T = machine.temperature if supply is None else supply.temperature + 0.5 * rise
    P, Q = _loss_and_flow(machine, speeds, np.full(speeds.shape, T))
    return np.maximum(share * P / (oil_of(machine).volumetric_heat * rise) - Q, 0.0)


def _loss_and_flow(machine: Machine, speed: Array, T: Array) -> tuple[Array, Array]:
    """Return loss [W] and side flow [m³/s] of a film at temperatures."""
    mu = machine.oil.viscosity(T)
    bearing, units = machine.bearing, FilmUnits(machine.bearing, mu, speed)
    points = OperatingPoints.of(bearing, viscosity=mu, speed=speed, load=machine.static_load)
    drag, flow = film_of(bearing).drag_and_flow(points)
    return drag * units.torque * speed, flow * units.flow


def _half_rise(machine: Machine, supply: Supply, P: Array, Q: Array) -> Array:
    """Return (T_out − T_in)/2 [K], infinite where heat is made and no oil passes."""
    with np.errstate(divide="ignore", invalid="ignore"):
        rise = 0.5 * supply.heat_share * P / (oil_of(machine).volumetric_heat * (Q + supply.flow))
    return np.where(supply.heat_share == 0.0, 0.0, rise)


def _carried(machine: Machine, Q: Array, rise: Array) -> Array:
    flow = machine.supply.flow if machine.supply else 0.0
    return oil_of(machine).volumetric_heat * (Q + flow) * rise


def _temperatures(machine: Machine, speed: Array) -> Array:
    """Return the temperatures of the balance at speeds (...), NaN where there is none."""
    flat = _solved(machine, speed.tobytes())
    return flat.reshape(speed.shape)


# Equilibrium, free motion and response ask the same speeds one after another.
@functools.lru_cache(maxsize=128)
def _solved(machine: Machine, speeds: bytes) -> Array:
    speed = np.frombuffer(speeds)
    found = np.full(speed.shape, np.nan)
    room = _highest(machine, speed) - _supply(machine).temperature
    able = room > 0.0
    if np.any(able):
        found[able] = _supply(machine).temperature + _half_rises(machine, speed[able], room[able])
    found.flags.writeable = False
    return found


def _supply(machine: Machine) -> Supply:
    if machine.supply is None:
        raise ValueError("machine: has no supply")
    return machine.supply


def _highest(machine: Machine, speed: Array) -> Array:
    """Return the highest temperature at speeds at which oil and film have an answer [°C]."""
    # A little above the film's limit, so that rounding does not pass it.
    thinnest = (1.0 + 1e-9) * _thinnest(machine, speed)
    return np.minimum(oil_of(machine).temperature(thinnest), HOTTEST)


def _thinnest(machine: Machine, speed: Array) -> Array:
    """Return the least viscosity with which the film carries the load at speeds [Pa·s]."""
    return turning_bounds(machine.bearing, machine.static_load)[0] / speed


def _half_rises(machine: Machine, speed: Array, room: Array) -> Array:
    """Return θ of the balance at speeds, NaN where G(θ) > θ up to the room that θ has."""
    supply = _supply(machine)

    def made(theta: Array) -> Array:
        return _half_rise(
            machine, supply, *_loss_and_flow(machine, speed, supply.temperature + theta)
        )

    theta = np.zeros(speed.shape)
    loss, flow = _loss_and_flow(machine, speed, supply.temperature + theta)
    half, low, high = _half_rise(machine, supply, loss, flow), theta, np.full(speed.shape, np.inf)
    none = ~np.isfinite(half)
    # About the centre of a circular bore the loss goes as μ, the side flow as 1/μ.
    own = flow / np.where(flow > 0.0, flow + supply.flow, 1.0)
    slope = secant = np.maximum(oil_of(machine).thinning(supply.temperature) * (1.0 + own), _FLAT)
    found, before = none | (half == 0.0), np.full(speed.shape, np.nan)
    for _ in range(_MOST_STEPS):
        step = np.where(found, theta, _next(theta, half, slope))
        # Before the bracket is asked: it may be as narrow as rounding.
        found = found | (np.abs(step - theta) <= _SETTLED * step)
        step = np.minimum(step, room)
        if np.all(found):
            return np.where(none, np.nan, step)
        outside = ~found & ((step <= low) | (step >= high))
        step = np.where(outside, 0.5 * (low + np.minimum(high, room)), step)
        after = made(step)
        # Still more heat made than carried where the film can be no hotter: no balance.
        none = none | ((step >= room) & (after > step)) | ~np.isfinite(after)
        found = found | none
        last, secant = secant, _secant(theta, half, step, after, secant)
        slope = _at_end(secant, last, (before, theta, step))
        before, theta, half = theta, step, after
        low, high = np.where(theta < half, theta, low), np.where(theta >= half, theta, high)
    raise RuntimeError(f"no film temperature found within {_MOST_STEPS} steps")


def _next(theta: Array, G: Array, slope: Array) -> Array:
    """Return the root of θ' = G exp(−a(θ' − θ))."""
    with np.errstate(divide="ignore", invalid="ignore"):  # G = 0, or no answer: not asked
        return wrightomega(np.log(slope * G) + slope * theta) / slope


def _secant(theta: Array, G: Array, after_theta: Array, after: Array, secant: Array) -> Array:
    """Return −d ln G/dθ between two places, the last one where they are one."""
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.log(G / after) / (after_theta - theta)
    return np.where(np.isfinite(found) & (found > 0.0), found, secant)


def _at_end(secant: Array, last: Array, places: tuple[Array, Array, Array]) -> Array:
    """Return the slope at the last of three places, by how it changed between the two secants."""
    first, middle, end = places
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = secant + (secant - last) * (end - middle) / (end - first)
    # A secant over no more than rounding says nothing; nor is there a first place at the start.
    return np.where(np.abs(slope - secant) < 0.5 * secant, slope, secant)


def _refuse(machine: Machine, speed: float) -> None:
    """Raise ValueError with the reason why there is no balance at a speed."""
    supply, here = _supply(machine), np.array([speed])
    # Where even the cold film does not carry the load, the film itself says so.
    loss, flow = _loss_and_flow(machine, here, np.array([supply.temperature]))
    if float(flow[0]) + supply.flow == 0.0:
        raise ValueError(
            f"supply.flow = 0 m³/s: at {speed:.6g} rad/s no oil leaves the film either, so nothing "
            f"carries its loss of {loss[0]:.4g} W away; give a flow, or a load"
        )
    top = _highest(machine, here)
    loss, flow = _loss_and_flow(machine, here, top)
    if not np.all(np.isfinite(loss + flow)):
        raise ValueError(
            f"bearing = {machine.bearing.geometry.kind}: its film model gives no loss and flow, "
            "from which its temperature would follow; give the film's temperature"
        )
    why = (
        f"beyond which no law of an oil's viscosity holds (ASTM D341, to {HOTTEST:g} °C)"
        if top[0] == HOTTEST
        else "where the oil is so thin that the film does not carry the load"
    )
    carried = _carried(machine, flow, 2.0 * (top - supply.temperature))
    raise ValueError(
        f"supply.temperature = {supply.temperature:g} °C, supply.flow = {supply.flow:.4g} m³/s: at "
        f"{speed:.6g} rad/s the film would be hotter than {top[0]:.4g} °C, {why}; there it still "
        f"makes {supply.heat_share * loss[0]:.4g} W, and a flow of {flow[0] + supply.flow:.4g} "
        f"m³/s carries {carried[0]:.4g} W; give more flow, or colder oil"
    )
