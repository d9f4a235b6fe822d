"""Bearings of several kinds side by side, on one machine: same journal, clearance, oil and load."""

import math
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace

import numpy as np

from rotorcalc import heat, modes
from rotorcalc.analysis import Sweep, analyse
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.coefficients import checked_speed, operating_points, stiffness_and_damping
from rotorcalc.display import Result
from rotorcalc.films import film_of
from rotorcalc.films.foil import CHECKED, FoilFilm
from rotorcalc.gas import Gas
from rotorcalc.geometry import (
    AxialGrooves,
    Elliptical,
    FloatingRing,
    Foil,
    Geometry,
    Hydrostatic,
    Lobes,
    MultiDam,
    OffsetHalves,
    PartialArc,
    Plain,
    PressureDam,
    TiltingPads,
)
from rotorcalc.machine import Bearing, Machine, Oil
from rotorcalc.numerics.first_answer import from_first_answer
from rotorcalc.onset import onset_speed
from rotorcalc.unbalance_peaks import ResponsePeaks, response_peaks

# Every kind.
KINDS: tuple[type[Geometry], ...] = (
    Plain,
    PartialArc,
    AxialGrooves,
    Elliptical,
    OffsetHalves,
    Lobes,
    PressureDam,
    MultiDam,
    TiltingPads,
    FloatingRing,
    Hydrostatic,
    Foil,
)
_TOUCHES = (
    "the journal touches the foil at the bearing's ends, where no pressure presses it back; the "
    "load is too heavy for it"
)
# Speeds up to this share of the running speed, and as many, are searched for peaks.
_TOP, _SPEEDS = 1.5, 240


@dataclass(frozen=True)
class BearingResult(Result):
    """What one bearing does on a machine at its running speed.

    Attributes
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    temperature : float
        Temperature of the film [°C]; with a supply by each bearing's own balance of heat.
    refusal : str
        Why its film has no answer at this speed and load; empty where it has one. Then numbers
        are NaN.
    onset : float
        Onset speed of the machine, Ω_s [rad/s]; infinite where there is none.
    margin : float
        Onset speed over running speed, less 1 [-].
    whirl_ratio : float
        Whirl ratio of the film at the running speed [-]; 0 where it cannot whirl.
    log_decrement : float
        Smallest logarithmic decrement of an oscillating mode at the running speed [-]; negative
        where one grows, infinite where none oscillates.
    minimum_film_thickness : float
        [m].
    eccentricity_ratio : float
        ε [-].
    power_loss : float
        Of one bearing [W].
    side_flow : float
        Of one bearing, both ends [m³/s].
    peak_response : float
        Largest peak of the disk's orbit, its semi-major axis, at speeds up to 1.5 times the running
        speed [m]; NaN where there is no peak.
    peak_speed : float
        Speed of that peak [rad/s].
    """

    bearing: Bearing
    temperature: float
    refusal: str = ""
    onset: float = math.nan
    margin: float = math.nan
    whirl_ratio: float = math.nan
    log_decrement: float = math.nan
    minimum_film_thickness: float = math.nan
    eccentricity_ratio: float = math.nan
    power_loss: float = math.nan
    side_flow: float = math.nan
    peak_response: float = math.nan
    peak_speed: float = math.nan


@checked
def compare_bearings(
    machine: Machine,
    geometries: Sequence[Geometry] | None = None,
    *,
    speed: float,
    executor: Executor | None = None,
    progress: Callable[[float], object] | None = None,
) -> tuple[BearingResult, ...]:
    """Return what bearings of several kinds do on one machine.

    Parameters
    ----------
    machine : Machine
        The machine; the bearings have its journal, length, clearance and oil.
    geometries : sequence of Geometry, optional
        The bores; by default every kind at its usual proportions (`usual_bores`).
    speed : float
        Running speed, Ω [rad/s], positive.
    executor : concurrent.futures.Executor, optional
        Computes the bearings at the same time; by default one after the other.
    progress : callable, optional
        Called with the share that is done, from above 0 to 1.

    Returns
    -------
    tuple of BearingResult
        In the order of the geometries, all on the film of finite length where the kind has it. A
        bearing that takes a gas runs on air at the temperature of the film or of the supply.

    Raises
    ------
    ValueError
        Where the speed is not positive and finite, or a geometry does not fit the bearing, or
        takes an oil where the machine has a gas.
    """
    checked_speed(speed)
    bores = usual_bores(machine.bearing) if geometries is None else geometries
    machines = [_with(machine, one) for one in bores]
    speeds = [speed] * len(machines)
    # Each is independent of the others, so any executor gives the same answer.
    each: Iterator[BearingResult] = (executor.map if executor else map)(
        bearing_result, machines, speeds
    )
    found: list[BearingResult] = []
    for one in each:
        found.append(one)
        if progress is not None:
            progress(len(found) / len(machines))
    return tuple(found)


@checked
def usual_bores(bearing: Bearing) -> tuple[Geometry, ...]:
    """Return a bore of every kind as is usual around a bearing's journal.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        Its diameter, length and clearance enter, and whether it runs on a gas.

    Returns
    -------
    tuple of Geometry
        In the order of `KINDS`; in place of a bearing on gas only those that take a gas.

    Raises
    ------
    ValueError
        Where the bearing is known by its coefficients alone: its size is not known then.
    """
    _refuse_table(bearing)
    D, L, C = bearing.diameter, bearing.length, bearing.radial_clearance
    on_oil = bearing.geometry.lubricant == "oil"
    return tuple(kind.around(D, L, C) for kind in KINDS if on_oil or kind.lubricant == "gas")


def _refuse_table(bearing: Bearing) -> None:
    if isinstance(bearing, CoefficientTable):
        raise ValueError(
            f"bearing = {bearing.geometry.kind}: a table of coefficients has no diameter, length "
            "and clearance with which another bearing could take its place"
        )


def _with(machine: Machine, geometry: Geometry) -> Machine:
    _refuse_table(machine.bearing)
    film = "finite" if "finite" in geometry.models else None
    bearing = replace(machine.bearing, geometry=geometry, film=film)
    if geometry.lubricant == "gas" and isinstance(machine.oil, Oil):
        # No supply of oil cools it: the film then has the supply's temperature.
        warm = machine.temperature if machine.supply is None else machine.supply.temperature
        return replace(machine, bearing=bearing, oil=Gas(), temperature=warm, supply=None)
    return replace(machine, bearing=bearing)


@checked
def bearing_result(machine: Machine, speed: float) -> BearingResult:
    """Return what a machine's bearing does at its running speed.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    BearingResult
        With the reason where the film has no answer there.
    """
    checked_speed(speed)
    if reason := _too_heavy_for_gas(machine, speed):
        return _refused(machine, reason)
    try:
        sweep = analyse(machine, speed)
    except ValueError as error:
        return _refused(machine, str(error))
    if sweep.minimum_film_thickness <= 0.0:
        return _refused(machine, _TOUCHES)
    onset = onset_speed(machine)
    peak, at = _largest_peak(machine, speed)
    return BearingResult(
        bearing=machine.bearing,
        temperature=float(sweep.temperature),
        onset=onset.speed,
        margin=onset.speed / speed - 1.0,
        whirl_ratio=float(sweep.whirl_ratio),
        log_decrement=log_decrement(sweep),
        minimum_film_thickness=float(sweep.minimum_film_thickness),
        eccentricity_ratio=float(sweep.eccentricity_ratio),
        power_loss=float(sweep.power_loss),
        side_flow=float(sweep.side_flow),
        peak_response=peak,
        peak_speed=at,
    )


def _too_heavy_for_gas(machine: Machine, speed: float) -> str:
    """Return why a foil's load is beyond what its model was checked for, before any table of it."""
    bearing = machine.bearing
    if not isinstance(bearing.geometry, Foil):
        return ""
    most = CHECKED * bearing.geometry.ambient_pressure * bearing.diameter * bearing.length
    if machine.static_load <= most:
        film = film_of(bearing)
        touches = isinstance(film, FoilFilm) and film.surely_touches(
            operating_points(machine, speed)
        )
        return _TOUCHES if touches else ""
    return (
        f"static load = {machine.static_load:.6g} N: must be at most {most:.4g} N, "
        f"F/(pₐ D L) = {CHECKED:g}, up to which this foil was checked"
    )


def _refused(machine: Machine, reason: str) -> BearingResult:
    given = math.nan if machine.temperature is None else machine.temperature
    return BearingResult(machine.bearing, given, refusal=reason)


def log_decrement(sweep: Sweep) -> float:
    """Return the smallest decrement of an oscillating mode, infinite where there is none."""
    return float(modes.smallest_decrement(sweep.flexible_eigenvalues))


def _largest_peak(machine: Machine, speed: float) -> tuple[float, float]:
    """Return size and speed of the largest peak of the disk's orbit, NaN where there is none."""
    top = _TOP * speed
    speeds = np.linspace(top / _SPEEDS, top, _SPEEDS)
    speeds = speeds[heat.has_film(machine, speeds)]
    found = from_first_answer(lambda some: _peaks(machine, some), speeds)
    if found is None or not found.amplitude.size:
        return math.nan, math.nan
    largest = int(np.argmax(found.amplitude))
    return float(found.amplitude[largest]), float(found.speed[largest])


def _peaks(machine: Machine, speeds: Array) -> ResponsePeaks | None:
    """Return the peaks between speeds, None at a speed alone, where the film has an answer."""
    if len(speeds) > 1:
        return response_peaks(machine, speeds)
    stiffness_and_damping(machine, speeds)
    return None
