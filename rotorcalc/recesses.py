"""The recesses of a hydrostatic bearing: their pressures, and what the supply has to deliver.

Of the film's power part is spent by the shaft, its drag, and part by the pump that supplies the
recesses. Both end as heat in the oil.
"""

from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray
from rotorcalc.coefficients import operating_points
from rotorcalc.display import Result
from rotorcalc.films import FilmUnits, OperatingPoints, film_of
from rotorcalc.films.hydrostatic import HydrostaticFilm
from rotorcalc.machine import Machine


@dataclass(frozen=True, eq=False)
class RecessEquilibrium(Result):
    """The recesses of one bearing in static equilibrium; N of them, the first on the load line.

    Attributes
    ----------
    speed : array, (...)
        Running speed, Ω [rad/s].
    pressure : array, (..., N)
        Of each recess, above ambient [Pa].
    recess_flow : array, (..., N)
        Through each restrictor [m³/s]; negative where the film's rotation pumps oil back.
    flow : array, (...)
        Of all restrictors; it leaves at both ends [m³/s].
    pump_power : array, (...)
        Supply pressure times flow [W], without the pump's own loss.
    friction_power : array, (...)
        Torque of the lands' film on the journal times speed [W].
    lowest_pressure : array, (...)
        Lowest pressure of the film, above ambient [Pa], at most 0. Where it is negative oil
        cavitates, which the model leaves out.
    """

    speed: Array
    pressure: Array
    recess_flow: Array
    flow: Array
    pump_power: Array
    friction_power: Array
    lowest_pressure: Array

    @property
    def total_power(self) -> Array:
        """Of pump and friction together, all of which ends as heat in the oil [W], (...)."""
        return self.pump_power + self.friction_power

    @property
    def has_suction(self) -> BoolArray:
        """Whether some pressure of the film is below ambient, (...)."""
        return self.lowest_pressure < 0.0


@checked
def recess_pressure(machine: Machine, speed: ArrayLike) -> Array:
    """Return the pressures in the recesses of a machine's bearing in static equilibrium.

    Parameters
    ----------
    machine : Machine
        A machine on a `Hydrostatic` bearing.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    array, (..., N)
        Above ambient [Pa]; the first recess is on the load line, the others follow in the sense of
        rotation.

    Raises
    ------
    ValueError
        Where the bearing has no recesses, a speed is not positive and finite, or the load is too
        heavy for the supply pressure.
    """
    film = _film(machine)
    points = operating_points(machine, speed)
    found, _ = film.balance(points)
    return film.shape.supply_pressure * _each(points, found.pressure)


@checked
def recess_equilibrium(machine: Machine, speed: ArrayLike) -> RecessEquilibrium:
    """Return pressures, flows and powers of a machine's recesses in static equilibrium.

    Parameters
    ----------
    machine : Machine
        A machine on a `Hydrostatic` bearing.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    RecessEquilibrium
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        As `recess_pressure` does.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from rotorcalc import PRESETS, Hydrostatic
    >>> sheet = PRESETS["sheet-1e8"].machine
    >>> machine = replace(sheet, bearing=replace(sheet.bearing, geometry=Hydrostatic()))
    >>> found = recess_equilibrium(machine, 300.0)
    >>> bool(found.pressure[0] > found.pressure[2])
    True
    """
    film, bearing = _film(machine), machine.bearing
    points = operating_points(machine, speed)
    found, _ = film.balance(points)
    p_s = film.shape.supply_pressure
    units = FilmUnits(bearing, points.viscosity, points.speed)
    drag, side_flow = film.drag_and_flow(points)
    flow = side_flow * units.flow
    # Shares of the whole, which is the sum over the recesses.
    share = found.flow / found.flow.sum(axis=1, keepdims=True)
    return RecessEquilibrium(
        speed=np.broadcast_to(points.speed, flow.shape),
        pressure=p_s * _each(points, found.pressure),
        recess_flow=flow[..., None] * _each(points, share),
        flow=flow,
        pump_power=p_s * flow,
        friction_power=drag * units.torque * points.speed,
        lowest_pressure=p_s * film.extremes(points).lowest.reshape(flow.shape),
    )


def _each(points: OperatingPoints, values: Array) -> Array:
    """Return values (n, N) of flattened points in their shape, (..., N)."""
    return values.reshape(*points.sommerfeld.shape, values.shape[-1])


def _film(machine: Machine) -> HydrostaticFilm:
    if machine.bearing.geometry.kind != "hydrostatic":
        raise ValueError(f"bearing = {machine.bearing.geometry.kind}: has no recesses")
    return cast("HydrostaticFilm", film_of(machine.bearing))
