"""Critical speeds, amplification factors by half power, and separation margins.

A critical speed N_c is a peak of the response to imbalance. N_1 and N_2, below and above it, are
the speeds at which the response is 1/√2 of the peak, 0.707 in the standards: half the power. The
amplification factor is

    AF = N_c/(N_2 − N_1),

about 1/(2ζ) of a lightly damped mode. Below AF = 2.5 the response counts as critically damped, and
no separation margin is required. Else a critical speed must keep from the speeds of operation

    SM = 17 % (1 − 1/(AF − 1.5)), at most 16 %, below them, of the minimum speed, and
    SM = 10 % + 17 % (1 − 1/(AF − 1.5)), at most 26 %, above them, of the maximum continuous speed.

Source: API 617, 7th edition (2002), in the form of API 684, SP6.8.2.1 and SP6.8.2.10, as Petrobras'
open program ROSS cites and computes them (`ross/API_Report/Report.py`).
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import g

from rotorcalc import heat
from rotorcalc.analysis import analyse
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, checked_speed, real_array
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.coefficients import rising_speed, stiffness_and_damping
from rotorcalc.display import Result
from rotorcalc.machine import Machine
from rotorcalc.numerics.first_answer import from_first_answer
from rotorcalc.numerics.roots import narrow_root
from rotorcalc.onset import judge
from rotorcalc.unbalance_peaks import both_peaks
from rotorcalc.unbalance_response import orbit_sizes, synchronous_response

# Below this amplification factor no separation margin is required.
DAMPED = 2.5
_HALF_POWER = math.sqrt(0.5)
# Distances from a peak, as shares of its speed, at which the response is computed to bracket the
# half-power speeds: above the peak up to four times its speed.
_BELOW, _ABOVE = np.geomspace(1e-9, 0.999, 400), np.geomspace(1e-9, 3.0, 400)
# Speeds of the sweep where none are given, and its ends over the largest natural frequency that
# shaft or load suggest.
_SPEEDS, _FIRST, _LAST = 400, 0.01, 4.0
# Rounding errors of a response over its largest difference from half the power between two speeds.
_NOISE = 1e-11


@dataclass(frozen=True, eq=False)
class Amplification(Result):
    """The critical speeds of a machine, each field of shape (n,) or (n, 2).

    Attributes
    ----------
    critical_speed : array, (n,)
        Speed of the peak, N_c [rad/s].
    amplitude : array, (n,)
        Semi-major axis of the orbit there, zero to peak [m].
    half_power_speed : array, (n, 2)
        N_1 and N_2 [rad/s]; 0 and infinite where the response does not fall to 1/√2 of the peak
        between standstill and four times its speed.
    amplification_factor : array, (n,)
        AF [-]; 0 where N_2 is infinite: the peak is then as flat as no resonance is.
    separation_margin : array, (n,)
        Distance from the operating speeds over the minimum or the maximum speed [-]; 0 between
        them, NaN without operating speeds.
    required_margin : array, (n,)
        SM [-]; 0 below AF = 2.5, NaN without operating speeds.
    stable : boolean array, (n,)
        Whether the machine is stable at that speed: else it whirls, and no response is steady.
    """

    critical_speed: Array
    amplitude: Array
    half_power_speed: Array
    amplification_factor: Array
    separation_margin: Array
    required_margin: Array
    stable: BoolArray

    @property
    def passed(self) -> BoolArray:
        """Whether each critical speed keeps its margin, (n,); False without operating speeds."""
        return self.separation_margin >= self.required_margin


@checked
def amplification(
    machine: Machine,
    speeds: ArrayLike | None = None,
    *,
    minimum_speed: float | None = None,
    maximum_speed: float | None = None,
    at: str = "disk",
) -> Amplification:
    """Return a machine's critical speeds, amplification factors and separation margins.

    Parameters
    ----------
    machine : Machine
        The machine. Its imbalance scales the amplitude alone, and may be zero.
    speeds : array_like, (n,), or None
        Rising speeds between which critical speeds are sought, Ω [rad/s], from the first on at
        which the film has an answer; None for a range that follows from shaft and load, beyond the
        maximum speed, or for that of a table of coefficients.
    minimum_speed, maximum_speed : float or None
        Lowest and highest speed of continuous operation [rad/s]; one alone is both.
    at : str
        Whose response, "disk" or "journal".

    Returns
    -------
    Amplification
        One row for each critical speed, rising.

    Raises
    ------
    ValueError
        Where `at` is neither, a speed is not positive and finite, the speeds do not rise, or the
        minimum speed is above the maximum.
    """
    if at not in ("disk", "journal"):
        raise ValueError(f"at = {at!r}: must be 'disk' or 'journal'")
    operating = _operating_speeds(minimum_speed, maximum_speed)
    grid = _own_speeds(machine, operating) if speeds is None else real_array("speeds", speeds)
    unit = replace(machine, rotor=replace(machine.rotor, imbalance=1.0))
    body = ("disk", "journal").index(at)
    rising = rising_speed(grid, name="speeds")
    sweep = from_first_answer(lambda speed: analyse(unit, speed), rising)
    peaks = both_peaks(sweep)[body]
    # Below the first answer the film has none either.
    lowest = float(sweep.speed[0]) if len(sweep.speed) < len(rising) else 0.0
    half_power = np.array([
        _half_power_speeds(unit, body, (speed, size), lowest=lowest)
        for speed, size in zip(peaks.speed, peaks.amplitude, strict=True)
    ]).reshape(-1, 2)  # fmt: skip
    factor = peaks.speed / (half_power[:, 1] - half_power[:, 0])
    margin, required = _margins(peaks.speed, factor, operating)
    stable = ~judge.is_unstable(machine, peaks.speed) if len(factor) else np.zeros(0, dtype=bool)
    return Amplification(
        critical_speed=peaks.speed,
        amplitude=peaks.amplitude * machine.rotor.imbalance,
        half_power_speed=half_power,
        amplification_factor=factor,
        separation_margin=margin,
        required_margin=required,
        stable=stable,
    )


@checked
def required_margin(amplification_factor: ArrayLike, *, above: bool) -> Array:
    """Return the separation margin that API 617 requires of a critical speed.

    Parameters
    ----------
    amplification_factor : array_like, (...)
        AF [-].
    above : bool
        Whether the critical speed lies above the speeds of operation, or below them.

    Returns
    -------
    array, (...)
        SM [-], of the maximum continuous speed above, of the minimum speed below; 0 below AF = 2.5.

    Examples
    --------
    >>> required_margin([2.0, 3.5, 40.0], above=False)
    array([0.   , 0.085, 0.16 ])
    >>> required_margin(3.5, above=True)
    array(0.185)
    """
    AF = real_array("amplification_factor", amplification_factor)
    margin = 0.17 * (1.0 - 1.0 / (np.maximum(AF, DAMPED) - 1.5))
    required = np.minimum(0.10 + margin, 0.26) if above else np.minimum(margin, 0.16)
    return np.where(AF < DAMPED, 0.0, required)


def _operating_speeds(minimum: float | None, maximum: float | None) -> tuple[float, float] | None:
    """Return the lowest and the highest speed of operation, None where neither is given."""
    given = [speed for speed in (minimum, maximum) if speed is not None]
    if not given:
        return None
    low, high = checked_speed([given[0], given[-1]]).tolist()
    if low > high:
        raise ValueError(
            f"minimum_speed = {low:g} rad/s: must be at most the maximum speed, {high:g} rad/s"
        )
    return low, high


def _own_speeds(machine: Machine, operating: tuple[float, float] | None) -> Array:
    """Return speeds over which a machine's resonances may be expected."""
    if isinstance(machine.bearing, CoefficientTable):
        return np.geomspace(machine.bearing.first, machine.bearing.last, _SPEEDS)
    rotor, C = machine.rotor, machine.bearing.radial_clearance
    # K_eq of a film is of the size of F_o/C, and a shaft in rigid bearings has √(K_rot/M).
    of_film = max(machine.static_load / rotor.half_mass, g) / C
    of_shaft = 0.0 if rotor.is_rigid else rotor.shaft_stiffness / rotor.half_mass
    top = _LAST * math.sqrt(of_film + of_shaft)
    if operating is not None:
        top = max(top, 1.5 * operating[1])
    speeds = np.geomspace(_FIRST / _LAST * top, top, _SPEEDS)
    return speeds[heat.has_film(machine, speeds)]


def _half_power_speeds(
    machine: Machine, body: int, at: tuple[float, float], *, lowest: float
) -> tuple[float, float]:
    """Return the speeds below and above a peak at which the response is 1/√2 of it.

    `at` is the peak's speed and size; speeds below the lowest are not asked for.
    """
    peak, size = at

    def over(speed: Array) -> Array:
        K, C = stiffness_and_damping(machine, speed)
        sizes = orbit_sizes(*synchronous_response(machine.rotor, K, C, speed))
        return sizes[body] - _HALF_POWER * size

    def crossing(speeds: Array) -> float | None:
        """Return the first speed of a row, away from the peak, with half the power."""
        asked = speeds[(speeds >= lowest) & heat.has_film(machine, speeds)]
        row = np.concatenate([[peak], asked])
        lower = np.flatnonzero(over(row) <= 0.0)
        if not lower.size:
            return None
        near, far = row[lower[0] - 1 : lower[0] + 1].tolist()
        return narrow_root(over, *sorted((near, far)), noise=_NOISE)

    below, above = crossing(peak * (1.0 - _BELOW)), crossing(peak * (1.0 + _ABOVE))
    return 0.0 if below is None else below, math.inf if above is None else above


def _margins(
    speed: Array, factor: Array, operating: tuple[float, float] | None
) -> tuple[Array, Array]:
    """Return actual and required separation margins of critical speeds, each (n,)."""
    if operating is None:
        unknown = np.full(speed.shape, np.nan)
        return unknown, unknown
    low, high = operating
    above = speed > high
    margin = np.where(above, (speed - high) / high, np.maximum((low - speed) / low, 0.0))
    below = required_margin(factor, above=False)
    return margin, np.where(above, required_margin(factor, above=True), below)
