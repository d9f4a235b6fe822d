"""Whirl: threshold speeds and critical masses of a machine at each speed, and the energy balance.

The cross-coupled stiffness acts as a follower force: on a forward orbit it acts along the motion
and feeds energy in, which the damping of film and disk dissipates. A free motion grows where more
is fed in than dissipated; at the threshold the two are equal.

Source: San Andrés, Notes 5, Eqs. 5.14, 5.45 to 5.50 and Appendix A.
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
from rotorcalc.arrays import Array, ComplexArray, complex_array, real_array
from rotorcalc.coefficients import equilibrium
from rotorcalc.display import Result
from rotorcalc.films import film_of
from rotorcalc.machine import JournalBearing, Machine, Rotor
from rotorcalc.onset import Onset
from rotorcalc.onset.whirl import flexible_threshold

_I = np.eye(2)
# Over the disk's own mass: up to these its critical mass is sought, and down to their inverses.
_FACTORS = np.geomspace(1.0, 1e4, 24)
_CIRCLE: ComplexArray = np.array([1.0, -1.0j])  # turns forward


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


@dataclass(frozen=True, eq=False)
class WhirlOrbit(Result):
    """The orbit in which a machine whirls at its onset.

    Attributes
    ----------
    speed : float
        Onset speed, Ω_s [rad/s].
    frequency : float
        Whirl frequency, ω_s [rad/s].
    journal, disk : complex array, (2,)
        Phasors of X and Y; the journal's ellipse has the area 1.
    """

    speed: float
    frequency: float
    journal: ComplexArray
    disk: ComplexArray


@dataclass(frozen=True, eq=False)
class WhirlEnergy(Result):
    """Energy gained and lost by the whirl orbit in one turn at each speed, each of shape (...).

    Energies are per bearing, per turn and per area of the journal's orbit [J/m² = N/m].

    Attributes
    ----------
    speed : array
        Running speed, Ω [rad/s].
    fed_in : array
        Work of the cross-coupled stiffness, K_XY − K_YX.
    film_loss, disk_loss : array
        Dissipation by the film's damping and by the disk's.
    """

    speed: Array
    fed_in: Array
    film_loss: Array
    disk_loss: Array


@checked
def thresholds(sweep: Sweep) -> Thresholds:
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
    ratio = np.sqrt(np.maximum(M_c / rotor.half_mass, 0.0))  # Ω_s/Ω
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
        lighter one makes it stable, or where the film depends on the whirl's frequency.

    Notes
    -----
    Undamped, the film balances the rotor at the film's own whirl ratio: with X = (ω̄Ω)²,
    m_d = K_rot (K_eq − M_j X)/(X (K_rot + K_eq − M_j X)), which for massless journals is Eq. 5.50.
    With midspan damping it is the mass nearest to the machine's own at which max Re λ = 0.
    """
    rotor = point.machine.rotor
    if film_of(point.machine.bearing).frequency_dependent:
        return math.nan
    if rotor.disk_damping > 0.0:
        return _damped_critical_mass(point)
    X = float(point.whirl_ratio * point.speed) ** 2
    if X == 0.0:
        return math.inf
    journal = 0.0 if rotor.is_rigid else rotor.journal_mass  # a rigid rotor moves as one
    K = float(point.equivalent_stiffness) - journal * X
    return journal + K / X / (1.0 + K / rotor.shaft_stiffness) if K > 0.0 else math.nan


def _damped_critical_mass(point: Sweep) -> float:
    rotor = point.machine.rotor

    def growth(disk: float) -> float:
        heavier = replace(rotor, mass=2.0 * (disk + rotor.journal_mass))
        return float(np.max(modes.eigenvalues(heavier, point.stiffness, point.damping).real))

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
def film_limit(bearing: JournalBearing) -> FilmCurves:
    """Return the film at the limit of whirl: at any higher eccentricity every rotor is stable.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.

    Returns
    -------
    FilmCurves
        One film, fields without a leading shape: the last without whirl as σ rises.

    Raises
    ------
    ValueError
        Where whirl has no such end: the film feeds it at no load, or at the heaviest too.

    Examples
    --------
    >>> bearing = JournalBearing(diameter=0.1, length=0.05, radial_clearance=1e-4)
    >>> round(float(film_limit(bearing).film.eccentricity_ratio), 9)
    0.756030386
    """
    film = film_of(bearing)
    if not film.can_whirl:
        raise ValueError(f"bearing = {bearing.geometry.kind}: its film feeds a whirl at no load")
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
def lowest_threshold(bearing: JournalBearing) -> float:
    """Return the eccentricity ratio at which a rigid rotor's dimensionless threshold is lowest.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.

    Returns
    -------
    float
        ε [-] at the least p_s over σ (Fig. 5.8); NaN where p_s has no least value inside.

    Examples
    --------
    >>> bearing = JournalBearing(diameter=0.1, length=0.05, radial_clearance=1e-4)
    >>> round(lowest_threshold(bearing), 5)
    0.45697
    """

    def threshold(log_sigma: float) -> float:
        return float(film_curves(bearing, np.exp(log_sigma)).onset.threshold_speed)

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


def orbit_area(orbit: ArrayLike) -> Array:
    """Return the area that an orbit encloses, A = ∮x dy = π Im(x ȳ).

    Parameters
    ----------
    orbit : array_like, (..., 2)
        Phasors of X and Y, in any one unit.

    Returns
    -------
    array, (...)
        Area in that unit squared; positive where the orbit turns forward.

    Examples
    --------
    >>> float(orbit_area([2.0, -1.0j]) / np.pi)
    2.0
    """
    x, y = np.moveaxis(complex_array("orbit", orbit, ends=(2,)), -1, 0)
    # With x = Re{X e^{jτ}} and y = Re{Y e^{jτ}}; (1, −j), a forward circle, has the area π.
    return np.pi * np.imag(x * np.conj(y))


def stiffness_work(K: ArrayLike, orbit: ArrayLike) -> Array:
    """Return the work that a stiffness does on the journal in one orbit, −∮xᵀKᵀdx.

    The symmetric part of K is that of a spring and does no work over a cycle; the skew part does
    the work (K_XY − K_YX)·A, for any ellipse at any frequency.

    Parameters
    ----------
    K : array_like, (..., 2, 2)
        Stiffness in X, Y [N/m].
    orbit : array_like, (..., 2)
        Phasors of X and Y [m].

    Returns
    -------
    array, (...)
        Work [J]; positive where it drives the orbit.
    """
    stiffness = real_array("K", K, ends=(2, 2))
    # ∮x dy = A and ∮y dx = −A, while ∮x dx = ∮y dy = 0: only the cross terms are left.
    return (stiffness[..., 0, 1] - stiffness[..., 1, 0]) * orbit_area(orbit)


def damping_work(C: ArrayLike, orbit: ArrayLike, frequency: ArrayLike) -> Array:
    """Return the energy dissipated by a damping in one orbit, ∮ẋᵀC dx = πω P*C P.

    Parameters
    ----------
    C : array_like, (..., 2, 2)
        Damping in X, Y [N·s/m]. Its skew part dissipates nothing.
    orbit : array_like, (..., 2)
        Phasors of X and Y, P [m].
    frequency : array_like, (...)
        Frequency of the orbit, ω [rad/s].

    Returns
    -------
    array, (...)
        Energy [J]; positive where it brakes the orbit.
    """
    P = complex_array("orbit", orbit, ends=(2,))
    damping = real_array("C", C, ends=(2, 2))
    quadratic = np.einsum("...i,...ij,...j->...", np.conj(P), damping, P)
    return np.pi * real_array("frequency", frequency) * quadratic.real


@checked
def whirl_orbit(machine: Machine, onset: Onset) -> WhirlOrbit:
    """Return the orbit in which a machine whirls at its onset.

    Parameters
    ----------
    machine : Machine
        The machine.
    onset : Onset
        Its onset, as `onset_speed` finds it.

    Returns
    -------
    WhirlOrbit
        Of the mode whose eigenvalue lies on the imaginary axis there. Where the onset is at speed
        0, a circle.

    Raises
    ------
    ValueError
        Where the machine has no onset.
    """
    if not math.isfinite(onset.speed):
        raise ValueError(f"onset = {onset.speed} rad/s: without an onset there is no whirl orbit")
    # Without load film and disk whirl infinitely slowly about the centre: a circle by symmetry.
    if onset.speed == 0.0:
        circle = _CIRCLE / np.complex128(math.sqrt(np.pi))
        return WhirlOrbit(speed=0.0, frequency=0.0, journal=circle, disk=circle)
    state = equilibrium(machine, onset.speed)
    lam = np.array(1j * onset.whirl_frequency)
    disk, journal = _mode_shape(machine.rotor, state.stiffness, state.damping, lam)
    # A linear whirl has no size of its own: the journal's orbit gets the area 1.
    size = math.sqrt(abs(float(orbit_area(journal))))
    return WhirlOrbit(
        speed=onset.speed,
        frequency=onset.whirl_frequency,
        journal=journal / size,
        disk=disk / size,
    )


@checked
def whirl_energy(machine: Machine, speed: ArrayLike, orbit: WhirlOrbit) -> WhirlEnergy:
    """Return the energy that a whirl orbit gains and loses in one turn at other speeds.

    The orbit keeps its shape and frequency; the film is that of each speed's equilibrium. At the
    orbit's own speed gain and loss are equal.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speeds, Ω [rad/s].
    orbit : WhirlOrbit
        The orbit at the machine's onset.

    Returns
    -------
    WhirlEnergy
        Its fields have the shape (...).

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.

    Notes
    -----
    For any free motion e^{λt} of the machine, with P_j and P_d the phasors of journal and disk,
    the balance of journal and disk multiplied by P_j* and P_d* leaves

        gain − loss = 2π Im λ Re λ (M_j |P_j|² + m_d |P_d|²),

    which vanishes with the growth Re λ.
    """
    state = equilibrium(machine, speed)
    disk_damping = machine.rotor.disk_damping * _I
    return WhirlEnergy(
        speed=state.speed,
        fed_in=stiffness_work(state.stiffness, orbit.journal),
        film_loss=damping_work(state.damping, orbit.journal, orbit.frequency),
        # The damper sees the same orbit at every speed, whatever the film.
        disk_loss=np.broadcast_to(
            damping_work(disk_damping, orbit.disk, orbit.frequency), state.speed.shape
        ),
    )


def _mode_shape(
    rotor: Rotor, K: Array, C: Array, lam: ComplexArray
) -> tuple[ComplexArray, ComplexArray]:
    """Return the phasors of disk and journal in the mode λ, (..., 2), the journal's of length 1.

    The impedance W of `modes.refined_eigenvalues` is singular at λ; the journal's phasor is normal
    to both of its rows, and the longer row gives it with the smaller error.
    """
    lam = lam[..., None, None]
    Z = K + lam * C + lam**2 * rotor.journal_mass * _I
    z = lam**2 * rotor.disk_mass + lam * rotor.disk_damping
    compliance = _I + Z / rotor.shaft_stiffness
    W = Z + z * compliance
    longer = np.argmax(np.abs(W).sum(axis=-1), axis=-1)[..., None, None]
    row = np.take_along_axis(W, longer, axis=-2)[..., 0, :]
    journal = np.stack([-row[..., 1], row[..., 0]], axis=-1)  # W j = 0
    journal = journal / np.linalg.norm(journal, axis=-1, keepdims=True)
    return np.einsum("...ij,...j->...i", compliance, journal), journal
