"""Where whirl sets in on a whole machine: the lowest speed at which a mode of it grows.

Model: the film's linear force coefficients about static equilibrium, each at its own speed's; a
symmetric rotor.

Source: San Andrés, Notes 5, Eqs. 5.41 to 5.50.
"""

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize_scalar

from rotorcalc import modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.coefficients import modified_sommerfeld, stiffness_and_damping
from rotorcalc.films import film_coefficients, film_state
from rotorcalc.machine import JournalBearing, Machine, Rotor
from rotorcalc.numerics import routh
from rotorcalc.numerics.roots import narrow_root
from rotorcalc.onset.whirl import whirl_onset

# Speeds a decade at which the search for the onset looks before it closes in.
_POINTS_PER_DECADE = 30


# It looks at so many at once, and no further than it must.
_BLOCK = 64


# How near to the onset, relative, the growth is a straight line over speed.
_STRAIGHT = 1e-7


@dataclass(frozen=True)
class Onset:
    """The lowest speed at which a machine becomes unstable.

    Attributes
    ----------
    speed : float
        Running speed at the onset, Ω_s [rad/s]; infinite where there is none.
    whirl_frequency : float
        Frequency of the whirl there, ω_s [rad/s]; not a number where there is none.
    eccentricity_ratio : float
        Eccentricity ratio there, ε [-]; not a number where there is none.
    """

    speed: float
    whirl_frequency: float
    eccentricity_ratio: float


_NO_ONSET = Onset(speed=math.inf, whirl_frequency=math.nan, eccentricity_ratio=math.nan)


@checked
def onset_speed(machine: Machine, flexible: bool = True) -> Onset:
    """Return the lowest speed at which the machine itself becomes unstable.

    Found on the eigenvalues, each at its own speed's equilibrium, so it holds with midspan
    damping and journal mass too. Without either it is where Ω = Ω_s(ε(Ω)) of Eqs. 5.45 to 5.50.
    Their polynomial tells sooner where all of them surely decay: there they are not computed.

    Parameters
    ----------
    machine : Machine
        The machine.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    Onset
        Speed, whirl frequency and eccentricity ratio at the onset. Without load the direct
        stiffness vanishes (Eq. 5.37), and the onset is at speed 0: the machine whirls at any speed.
    """

    def doubt(speed: Array) -> Array:
        return routh.doubt(_polynomial(machine, speed, flexible))

    speeds = search_speeds(machine, flexible)
    bracket = _first_crossing(doubt, speeds)
    if bracket is None:
        return _NO_ONSET
    found = _sharp_crossing(machine, flexible, *bracket)
    if found is None:
        found = _crossing_beyond_doubt(machine, flexible, speeds[speeds >= bracket[0]])
    speed, whirl_frequency = found
    if math.isinf(speed):
        return _NO_ONSET
    sigma = modified_sommerfeld(machine, speed or float(speeds[0]))
    eps = film_state(machine.bearing, sigma).eccentricity_ratio
    return Onset(speed=speed, whirl_frequency=whirl_frequency, eccentricity_ratio=float(eps))


def _fastest(rotor: Rotor, K: Array, C: Array, flexible: bool) -> ComplexArray:
    """Return the eigenvalue of the mode that grows fastest [1/s]."""
    lam = modes.refined_eigenvalues(rotor, K, C, flexible=flexible)
    rightmost = np.argmax(np.where(np.isfinite(lam), lam.real, -np.inf), axis=-1)
    return np.take_along_axis(lam, rightmost[..., None], axis=-1)[..., 0]


def _growth(machine: Machine, speed: ArrayLike, flexible: bool) -> Array:
    """Return the fastest growth of any mode, max Re λ/Ω [-], shape of `speed`."""
    K, C = stiffness_and_damping(machine, speed)
    return _fastest(machine.rotor, K, C, flexible).real / np.asarray(speed)


def _polynomial(machine: Machine, speed: ArrayLike, flexible: bool) -> Array:
    K, C = stiffness_and_damping(machine, speed)
    return modes.characteristic_polynomial(machine.rotor, K, C, flexible=flexible)


def search_speeds(machine: Machine, flexible: bool = True) -> Array:
    """Return speeds that span the first of all onsets there can be [rad/s], by equal ratios.

    A film that cannot whirl feeds no mode, whatever the rotor, so the search begins at the last
    speed before the film can; near the wall, below σ = 1e-3, none can. Above σ = 10 the film is all
    but centred and no longer changes. Without load it is centred at every speed, and the search
    begins far below every rate of the rotor, but not so far that the growth drowns in rounding.
    """
    unit = float(modified_sommerfeld(machine, 1.0))
    limit = _whirl_limit(machine.bearing)
    lowest = limit / unit if math.isfinite(unit) else 1e-3 * _slowest_rate(machine, flexible)
    centred = 10.0 / unit if math.isfinite(unit) else lowest
    highest = 2.0 * max(centred, _highest_onset(machine, centred, flexible))
    points = 1 + math.ceil(_POINTS_PER_DECADE * math.log10(highest / lowest))
    return np.geomspace(lowest, highest, points)


@functools.lru_cache(maxsize=256)
def _whirl_limit(bearing: JournalBearing) -> float:
    """Return a modified Sommerfeld number up to which a bearing's film cannot whirl [-]."""
    sigma = np.geomspace(1e-3, 10.0, 1 + 4 * _POINTS_PER_DECADE)
    ratio = whirl_onset(*film_coefficients(bearing, sigma)).whirl_ratio
    return float(sigma[max(int(np.argmax(ratio > 0.0)) - 1, 0)])


def _slowest_rate(machine: Machine, flexible: bool) -> float:
    """Return the slowest of the rotor's own rates, or a rigid one's on a centred film [rad/s]."""
    rotor = machine.rotor
    if rotor.is_rigid or not flexible:
        return float(np.trace(stiffness_and_damping(machine, 1.0)[1])) / rotor.half_mass
    k, C_s = rotor.shaft_stiffness, rotor.disk_damping
    return min(math.sqrt(k / rotor.half_mass), k / C_s if C_s > 0.0 else math.inf)


def _highest_onset(machine: Machine, centred: float, flexible: bool) -> float:
    """Return a speed above every onset on a film that is centred from a speed on [rad/s].

    The whirl's frequency is bounded by the rotor's: on the film's stiffness alone; with midspan
    damping, which can quench that whirl, also by that of the disk on the shaft and of the journal
    between shaft and film. The film feeds the whirl at the whirl ratio and more speed feeds it
    more, by so much as the midspan damping takes from the journal.
    """
    stiffness, damping = stiffness_and_damping(machine, centred)
    film, rotor = whirl_onset(stiffness, damping * centred), machine.rotor
    C, C_s, m = float(np.trace(damping)) / 2.0, rotor.disk_damping, rotor.disk_mass
    squares = [max(float(film.equivalent_stiffness), 0.0) / rotor.half_mass]
    taken = C_s
    if flexible and not rotor.is_rigid and C_s > 0.0:
        k = rotor.shaft_stiffness
        squares.append(2.0 * k / m)
        if rotor.journal_mass > 0.0:
            squares.append((float(np.trace(stiffness)) + 2.0 * k) / rotor.journal_mass)
        # Largest of k²C_s/|k + z|² over frequency; a light damper's is cut off, for it quenches
        # no whirl.
        taken = C_s if C_s**2 >= 2.0 * k * m else min(2.0 * k * m / C_s, 1e6 * C)
    return math.sqrt(max(squares)) * (1.0 + taken / C) / float(film.whirl_ratio)


def _sharp_crossing(
    machine: Machine, flexible: bool, low: float, high: float
) -> tuple[float, float] | None:
    """Return speed and whirl frequency of an onset between two speeds, or None.

    Where Hurwitz's last determinant vanishes, to its rounding; there the growth of the eigenvalue
    that crosses is a straight line over speed. None where they do not cross so near to it.
    """

    def determinant(speed: Array) -> Array:
        return routh.determinant(_polynomial(machine, speed, flexible))

    try:
        root = narrow_root(determinant, low, high) if low > 0.0 else math.nan
    except ValueError:  # of one sign at both ends
        root = math.nan
    if math.isnan(root):
        return None
    near = root * np.array([1.0 - _STRAIGHT, 1.0 + _STRAIGHT])
    K, C = stiffness_and_damping(machine, near)
    stable, unstable = modes.refined_eigenvalues(machine.rotor, K, C, flexible=flexible)
    after = unstable[np.nanargmax(unstable.real)]
    if not (np.nanmax(stable.real) < 0.0 < after.real):
        return None
    before = stable[np.nanargmin(np.abs(stable - after))]
    share = before.real / (before.real - after.real)
    whirl = before + (after - before) * share
    return float(near[0] + (near[1] - near[0]) * share), float(modes.damped_frequency(whirl))


def _crossing_beyond_doubt(machine: Machine, flexible: bool, speeds: Array) -> tuple[float, float]:
    """Return speed and frequency where the growth first vanishes, by the eigenvalues alone.

    Speed 0 where it never does anything but grow, infinite where it always decays.
    """

    def growth(speed: Array) -> Array:
        return _growth(machine, speed, flexible)

    bracket = _first_crossing(growth, speeds)
    if bracket is None:
        return math.inf, math.nan
    low, high = bracket
    if low == 0.0:
        return 0.0, 0.0
    within_rounding = growth(np.array(low)) >= 0.0
    speed = low if within_rounding else narrow_root(growth, low, high)
    whirl = _fastest(machine.rotor, *stiffness_and_damping(machine, speed), flexible)
    return speed, float(modes.damped_frequency(whirl))


def _first_crossing(values: Callable[[Array], Array], speeds: Array) -> tuple[float, float] | None:
    """Return speeds between which a function first turns positive, or None where it never does.

    Speed 0 and the first of them where that is so from there on. A hump of the function that hides
    between two speeds is looked for at each of its local maxima.
    """
    found = np.empty(0)
    for begin in range(0, len(speeds), _BLOCK):
        found = np.concatenate([found, values(speeds[begin : begin + _BLOCK])])
        if np.any(found > 0.0):
            break
    first = int(np.argmax(found > 0.0)) if np.any(found > 0.0) else len(found)
    is_peak = (found[:-2] < found[1:-1]) & (found[1:-1] >= found[2:])
    for i in np.flatnonzero(is_peak[: max(first - 1, 0)]):
        top = minimize_scalar(
            lambda speed: -float(values(np.array(speed))),
            bounds=(speeds[i], speeds[i + 2]),
            method="bounded",
        )
        if top.fun < 0.0:
            return float(speeds[i]), float(top.x)
    if first == len(found):
        return None
    return float(speeds[first - 1]) if first > 0 else 0.0, float(speeds[first])
