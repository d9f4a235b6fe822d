"""Threshold speeds and critical masses: of a machine at each speed, and of a bearing over its load.

The onset of a machine, at which threshold and speed meet, is found in `rotorcalc.onset`.

Source: San Andrés, Notes 5, Eqs. 5.45 to 5.50.
"""

import functools
import itertools
import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq, minimize_scalar

from rotorcalc import modes
from rotorcalc.analysis import FilmCurves, Sweep, film_curves
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, real_array
from rotorcalc.coefficients import dynamics
from rotorcalc.display import Result
from rotorcalc.films import film_of
from rotorcalc.machine import Bearing
from rotorcalc.onset.whirl import flexible_threshold

# Over the disk's own mass: up to these its critical mass is sought, and down to their inverses.
_FACTORS = np.geomspace(1.0, 1e4, 24)


@dataclass(frozen=True, eq=False)
class Thresholds(Result):
    """Threshold speeds, whirl frequencies and critical masses at each speed, fields of shape (...).

    All hold without midspan damping and journal mass; for the flexible shaft and for a rigid one.

    Attributes
    ----------
    speed : array
        Running speed, Ω [rad/s].
    flexible, rigid : array
        Threshold speed Ω_sf and Ω_s at this speed's equilibrium [rad/s]; infinite where the film
        cannot whirl.
    flexible_frequency, rigid_frequency : array
        Whirl frequency at that threshold, ω_s [rad/s] (Eq. 5.47); NaN where the film
        cannot whirl.
    flexible_mass_ratio, rigid_mass_ratio : array
        Critical mass over the rotor's, M_c/M = (Ω_s/Ω)² [-]; unstable below 1.
    """

    speed: Array
    flexible: Array
    rigid: Array
    flexible_frequency: Array
    rigid_frequency: Array
    flexible_mass_ratio: Array
    rigid_mass_ratio: Array


@checked
def at_each_speed(sweep: Sweep) -> Thresholds:
    """Return thresholds, whirl frequencies and critical mass ratios of a machine over speed.

    Parameters
    ----------
    sweep : Sweep
        The machine over speed, fields of shape (...).

    Returns
    -------
    Thresholds
        Eqs. 5.45 to 5.50; its fields have the shape (...).
    """
    rotor, K_eq = sweep.machine.rotor, sweep.equivalent_stiffness
    can_whirl = sweep.whirl_ratio > 0.0
    M_c = sweep.critical_mass
    # Eq. 5.47, ω_s = √(K_eq/M): with film and shaft in series for the flexible one.
    series = K_eq / (1.0 + K_eq / rotor.shaft_stiffness)  # film and shaft, below Eq. 5.50
    rigid_frequency = modes.undamped_frequency(K_eq, rotor.half_mass)
    frequency = modes.undamped_frequency(series, rotor.half_mass)
    # A negative K_eq leaves no critical mass: unstable at any speed, so the ratio is 0.
    ratio = np.sqrt(np.where(np.isnan(M_c), 0.0, M_c) / rotor.half_mass)  # Ω_s/Ω
    return Thresholds(
        speed=sweep.speed,
        flexible=sweep.flexible_threshold,
        rigid=sweep.rigid_threshold,
        flexible_frequency=np.where(can_whirl, frequency, np.nan),
        rigid_frequency=np.where(can_whirl, rigid_frequency, np.nan),
        # Eq. 5.50 scales Ω_s/Ω as it scales Ω_s.
        flexible_mass_ratio=flexible_threshold(ratio, K_eq, 1.0 / rotor.shaft_stiffness) ** 2,
        rigid_mass_ratio=ratio**2,
    )


@checked
def critical_mass(point: Sweep) -> float:
    """Return the mass per bearing with which a machine would be at its onset at a speed.

    Its load, shaft, midspan damping and journal mass stay as they are: of a flexible machine it is
    below the rigid rotor's M_c of Eq. 5.45, and at an onset it is the machine's own.

    Parameters
    ----------
    point : Sweep
        The machine at one speed.

    Returns
    -------
    float
        M_c, disk and journal [kg]; infinite where no heavier disk makes it unstable, NaN where no
        lighter one makes it stable, or where the film is known by its impedance alone.

    Notes
    -----
    Undamped, the film balances the rotor at the film's own whirl ratio: with X = (ω̄Ω)²,
    m_d = K_rot (K_eq − M_j X)/(X (K_rot + K_eq − M_j X)), which for massless journals is Eq. 5.50.
    With midspan damping, or a film with inner coordinates, it is the mass nearest to the machine's
    own at which max Re λ = 0.
    """
    rotor, film = point.machine.rotor, film_of(point.machine.bearing)
    if film.frequency_dependent and not film.inner:
        return math.nan
    if rotor.disk_damping > 0.0 or film.inner:
        return _nearest_critical_mass(point)
    X = float(point.whirl_ratio * point.speed) ** 2
    if X == 0.0:
        return math.inf
    journal = 0.0 if rotor.is_rigid else rotor.journal_mass  # a rigid rotor moves as one
    K = float(point.equivalent_stiffness) - journal * X
    return journal + K / X / (1.0 + K / rotor.shaft_stiffness) if K > 0.0 else math.nan


def _nearest_critical_mass(point: Sweep) -> float:
    rotor, film = point.machine.rotor, dynamics(point.machine, point.speed)

    def growth(disk: float) -> float:
        heavier = replace(rotor, mass=2.0 * (disk + rotor.journal_mass))
        values = modes.eigenvalues(heavier, film.stiffness, film.damping, inertia=film.inertia)
        return float(np.max(values.real))

    own = rotor.half_mass - rotor.journal_mass
    stable = growth(own) <= 0.0
    # A stable machine's is above its own mass, an unstable one's below.
    disks = own * (_FACTORS if stable else 1.0 / _FACTORS)
    for near, far in itertools.pairwise(disks):
        if (growth(far) <= 0.0) != stable:
            return brentq(growth, near, far) + rotor.journal_mass
    return math.inf if stable else math.nan


@checked
def flexible_curves(curves: FilmCurves, sag_ratio: ArrayLike) -> Array:
    """Return the threshold speed of flexible rotors on one bearing (Eq. 5.50, Fig. 5.10).

    Parameters
    ----------
    curves : FilmCurves
        The bearing over the modified Sommerfeld number, fields of shape (n,).
    sag_ratio : array_like, (m,)
        Static sag over clearance of each rotor, Γ/C [-].

    Returns
    -------
    array, (m, n)
        p_sf [-]; infinite where the film cannot whirl.
    """
    onset, sag = curves.onset, real_array("sag_ratio", sag_ratio)[:, None]
    return flexible_threshold(onset.threshold_speed, onset.equivalent_stiffness, sag)


@checked
def film_limit(bearing: Bearing) -> FilmCurves:
    """Return the film at the limit of whirl: at any higher eccentricity every rotor is stable.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.

    Returns
    -------
    FilmCurves
        One film, fields without a leading shape: the last without whirl as σ rises.

    Raises
    ------
    ValueError
        Where whirl has no such end: the film feeds it at no load, or at the heaviest too; or where
        the film depends on more than σ.

    Examples
    --------
    >>> from rotorcalc import JournalBearing
    >>> bearing = JournalBearing(diameter=0.1, length=0.05, radial_clearance=1e-4)
    >>> round(float(film_limit(bearing).film.eccentricity_ratio), 9)
    0.756030386
    """
    film = film_of(bearing)
    if not film.can_whirl:
        raise ValueError(f"bearing = {bearing.geometry.kind}: its film feeds a whirl at no load")
    if film.curve is None:
        raise ValueError(
            f"bearing = {bearing.geometry.kind}: the limit of its whirl depends on more than σ"
        )
    # A heavily loaded film cannot whirl, a lightly loaded one can: the limit lies between.
    low, high = film.sommerfeld_range
    # Each pass narrows the bracket a thousandfold in ln σ, to a few hundred roundings in the end.
    while high > low * (1.0 + 1e-13):
        sigma = np.geomspace(low, high, 1000)
        whirls = film_curves(bearing, sigma).onset.whirl_ratio > 0.0
        if whirls[0] or not whirls.any():
            loads = "every load" if whirls[0] else "no load"
            raise ValueError(
                f"bearing = {bearing.geometry.kind}: its film feeds a whirl at {loads}"
            )
        first = int(np.argmax(whirls))
        low, high = float(sigma[first - 1]), float(sigma[first])
    return film_curves(bearing, low)


@functools.lru_cache(maxsize=64)
def lowest_threshold(bearing: Bearing) -> float:
    """Return the eccentricity ratio at which a rigid rotor's dimensionless threshold is lowest.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.

    Returns
    -------
    float
        ε [-] at the least p_s over σ (Fig. 5.8); NaN where p_s has no least value inside, or is no
        function of σ alone.

    Examples
    --------
    >>> from rotorcalc import JournalBearing
    >>> bearing = JournalBearing(diameter=0.1, length=0.05, radial_clearance=1e-4)
    >>> round(lowest_threshold(bearing), 5)
    0.45697
    """

    def threshold(log_sigma: float) -> float:
        return float(film_curves(bearing, np.exp(log_sigma)).onset.threshold_speed)

    if film_of(bearing).curve is None:
        return float("nan")
    scan = np.log(np.geomspace(*film_of(bearing).sommerfeld_range, 60))
    found = film_curves(bearing, np.exp(scan)).onset.threshold_speed
    least = int(np.argmin(found))
    # At an end of the range p_s still falls: the curve has no minimum inside.
    if not 0 < least < len(scan) - 1:
        return float("nan")
    best = minimize_scalar(
        threshold, bracket=(scan[least - 1], scan[least], scan[least + 1]), tol=1e-9
    )
    return float(film_curves(bearing, np.exp(best.x)).film.eccentricity_ratio)
