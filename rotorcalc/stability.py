"""Where whirl sets in: from the film's coefficients, and for a whole machine from its eigenvalues.

Model: the film's linear force coefficients about static equilibrium; a symmetric rotor. At the
threshold one mode whirls undamped, at the whirl ratio ω̄ = ω_s/Ω_s times the running speed.

Source: San Andrés, Notes 5, Eqs. 5.41 to 5.50.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize_scalar

from rotorcalc import modes
from rotorcalc.coefficients import (
    Equilibrium,
    equilibrium,
    modified_sommerfeld,
    stiffness_and_damping,
)
from rotorcalc.machine import Machine, Rotor
from rotorcalc.roots import narrow_root
from rotorcalc.typing import Array, ComplexArray

# Speeds a decade at which the search for the onset looks before it closes in.
_POINTS_PER_DECADE = 30
# It looks at so many at once, and no further than it must.
_BLOCK = 64


@dataclass(frozen=True, eq=False)
class WhirlOnset:
    """The threshold of whirl at one equilibrium, dimensionless, each of shape (...).

    Attributes
    ----------
    equivalent_stiffness : array
        k_eq = K_eq·C/F_o [-] (Eq. 5.45).
    whirl_ratio : array
        ω̄ = ω_s/Ω_s [-] (Eq. 5.46); 0 where the film cannot whirl.
    critical_mass : array
        p_s² = M_c CΩ²/F_o [-]; infinite where the film cannot whirl.
    threshold_speed : array
        p_s = Ω_s√(MC/F_o) [-] of a rigid rotor; infinite where the film cannot whirl.
    """

    equivalent_stiffness: Array
    whirl_ratio: Array
    critical_mass: Array
    threshold_speed: Array


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


def whirl_onset(k: ArrayLike, c: ArrayLike) -> WhirlOnset:
    """Return the threshold of whirl of a rigid rotor on given film coefficients.

    Parameters
    ----------
    k, c : array_like, (..., 2, 2)
        Dimensionless stiffness k = K·C/F_o and damping c = C·ΩC/F_o in X, Y [-] (Eq. 5.32). In
        another common unit, such as the film's own, k_eq and p_s² come out in that unit.

    Returns
    -------
    WhirlOnset
        Eqs. 5.45 and 5.46; its fields have the leading shape (...).

    Examples
    --------
    >>> from rotorcalc.films import short
    >>> onset = whirl_onset(short.stiffness(0.5), short.damping(0.5))
    >>> round(float(onset.whirl_ratio), 6), round(float(onset.threshold_speed), 6)
    (0.51464, 2.541731)
    """
    k_XX, k_XY, k_YX, k_YY = _elements(k)
    c_XX, c_XY, c_YX, c_YY = _elements(c)
    # Eq. 5.45
    k_eq = (k_XX * c_YY + k_YY * c_XX - c_YX * k_XY - c_XY * k_YX) / (c_XX + c_YY)
    # Eq. 5.46
    ratio2 = ((k_eq - k_XX) * (k_eq - k_YY) - k_XY * k_YX) / (c_XX * c_YY - c_XY * c_YX)
    can_whirl = ratio2 > 0.0  # else no real frequency feeds the whirl: stable at any mass
    p_s2 = np.where(can_whirl, k_eq / np.where(can_whirl, ratio2, 1.0), np.inf)
    return WhirlOnset(
        equivalent_stiffness=k_eq,
        whirl_ratio=np.sqrt(np.where(can_whirl, ratio2, 0.0)),
        critical_mass=p_s2,
        # A negative equivalent stiffness leaves no mass, and so no speed, at which it is stable.
        threshold_speed=np.sqrt(np.maximum(p_s2, 0.0)),
    )


def flexible_threshold(
    threshold_speed: ArrayLike, equivalent_stiffness: ArrayLike, sag_ratio: ArrayLike
) -> Array:
    """Return the threshold speed of a flexible rotor, p_sf = p_s/√(1 + k_eq Γ/C) (Eq. 5.50).

    The shaft lies in series with the film and lowers the natural frequency; the whirl ratio is
    that of the rigid rotor. Holds for massless journals without midspan damping.

    Parameters
    ----------
    threshold_speed : array_like, (...)
        Of the rigid rotor, p_s [-] or Ω_s [rad/s].
    equivalent_stiffness : array_like, (...)
        k_eq [-].
    sag_ratio : array_like, (...)
        Static sag over clearance, Γ/C [-]; k_eq Γ/C = K_eq/K_rot, so K_eq and 1/K_rot serve too.

    Returns
    -------
    array, (...)
        p_sf or Ω_sf, in the unit of `threshold_speed`.
    """
    softening = 1.0 + np.asarray(equivalent_stiffness) * np.asarray(sag_ratio)
    return np.asarray(threshold_speed) / np.sqrt(softening)


def onset_speed(machine: Machine, flexible: bool = True) -> Onset:
    """Return the lowest speed at which the machine itself becomes unstable.

    Found on the eigenvalues, each at its own speed's equilibrium, so it holds with midspan
    damping and journal mass too. Without either it is where Ω = Ω_s(ε(Ω)) of Eqs. 5.45 to 5.50.

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
    speeds, growth = _search(machine, flexible)
    if growth[0] > 0.0:
        state = equilibrium(machine, float(speeds[0]))
        return Onset(
            speed=0.0,
            whirl_frequency=0.0,
            eccentricity_ratio=float(state.film.eccentricity_ratio),
        )
    bracket = _first_crossing(machine, flexible, speeds, growth)
    if bracket is None:
        return Onset(speed=math.inf, whirl_frequency=math.nan, eccentricity_ratio=math.nan)
    speed = _crossing(machine, flexible, *bracket)
    state = equilibrium(machine, speed)
    whirl = _fastest(machine.rotor, state.stiffness, state.damping, flexible)
    return Onset(
        speed=speed,
        whirl_frequency=float(modes.damped_frequency(whirl)),
        eccentricity_ratio=float(state.film.eccentricity_ratio),
    )


def _elements(coefficients: ArrayLike) -> tuple[Array, Array, Array, Array]:
    m = np.asarray(coefficients, dtype=float)
    return m[..., 0, 0], m[..., 0, 1], m[..., 1, 0], m[..., 1, 1]


def _fastest(rotor: Rotor, K: Array, C: Array, flexible: bool) -> ComplexArray:
    """Return the eigenvalue of the mode that grows fastest [1/s]."""
    lam = modes.refined_eigenvalues(rotor, K, C, flexible=flexible)
    rightmost = np.argmax(np.where(np.isfinite(lam), lam.real, -np.inf), axis=-1)
    return np.take_along_axis(lam, rightmost[..., None], axis=-1)[..., 0]


def _growth(machine: Machine, speed: ArrayLike, flexible: bool) -> Array:
    """Return the fastest growth of any mode, max Re λ/Ω [-], shape of `speed`."""
    K, C = stiffness_and_damping(machine, speed)
    return _fastest(machine.rotor, K, C, flexible).real / np.asarray(speed)


def _search(machine: Machine, flexible: bool) -> tuple[Array, Array]:
    """Return speeds that span the first of all onsets there can be [rad/s], and the growth there.

    A film that cannot whirl feeds no mode, whatever the rotor, so the search begins at the last
    speed before the film can; near the wall, below σ = 1e-3, none can. Above σ = 10 the film is all
    but centred and no longer changes. Without load it is centred at every speed, and the search
    begins far below every rate of the rotor, but not so far that the growth drowns in rounding.
    """
    unit = float(modified_sommerfeld(machine, 1.0))
    lowest = 1e-3 / unit if math.isfinite(unit) else 1e-3 * _slowest_rate(machine, flexible)
    centred = equilibrium(machine, 10.0 / unit if math.isfinite(unit) else lowest)
    highest = 2.0 * max(float(centred.speed), _highest_onset(machine.rotor, centred, flexible))
    points = 1 + math.ceil(_POINTS_PER_DECADE * math.log10(highest / lowest))
    speeds = np.geomspace(lowest, highest, points)
    K, C = stiffness_and_damping(machine, speeds)
    ratio = whirl_onset(K, C * speeds[:, None, None]).whirl_ratio
    first = max(int(np.argmax(ratio > 0.0)) - 1, 0)
    growth = np.empty(0)
    for begin in range(first, points, _BLOCK):
        block = slice(begin, begin + _BLOCK)
        more = _fastest(machine.rotor, K[block], C[block], flexible).real / speeds[block]
        growth = np.concatenate([growth, more])
        if np.any(more > 0.0):
            break
    return speeds[first : first + len(growth)], growth


def _slowest_rate(machine: Machine, flexible: bool) -> float:
    """Return the slowest of the rotor's own rates, or a rigid one's on a centred film [rad/s]."""
    rotor = machine.rotor
    if rotor.is_rigid or not flexible:
        return float(np.trace(equilibrium(machine, 1.0).damping)) / rotor.half_mass
    k, C_s = rotor.shaft_stiffness, rotor.disk_damping
    return min(math.sqrt(k / rotor.half_mass), k / C_s if C_s > 0.0 else math.inf)


def _highest_onset(rotor: Rotor, centred: Equilibrium, flexible: bool) -> float:
    """Return a speed above every onset on a centred film [rad/s].

    The whirl's frequency is bounded by the rotor's: on the film's stiffness alone; with midspan
    damping, which can quench that whirl, also by that of the disk on the shaft and of the journal
    between shaft and film. The film feeds the whirl at the whirl ratio and more speed feeds it
    more, by so much as the midspan damping takes from the journal.
    """
    film = whirl_onset(centred.stiffness, centred.damping * centred.speed)
    C, C_s, m = float(np.trace(centred.damping)) / 2.0, rotor.disk_damping, rotor.disk_mass
    squares = [max(float(film.equivalent_stiffness), 0.0) / rotor.half_mass]
    taken = C_s
    if flexible and not rotor.is_rigid and C_s > 0.0:
        k = rotor.shaft_stiffness
        squares.append(2.0 * k / m)
        if rotor.journal_mass > 0.0:
            squares.append((float(np.trace(centred.stiffness)) + 2.0 * k) / rotor.journal_mass)
        # Largest of k²C_s/|k + z|² over frequency; a light damper's is cut off, for it quenches
        # no whirl.
        taken = C_s if C_s**2 >= 2.0 * k * m else min(2.0 * k * m / C_s, 1e6 * C)
    return math.sqrt(max(squares)) * (1.0 + taken / C) / float(film.whirl_ratio)


def _crossing(machine: Machine, flexible: bool, low: float, high: float) -> float:
    """Return the speed between a stable and an unstable one at which the growth vanishes."""
    if _growth(machine, low, flexible) >= 0.0:  # within a rounding error of the onset
        return low
    return narrow_root(lambda speed: _growth(machine, speed, flexible), low, high)


def _first_crossing(
    machine: Machine, flexible: bool, speeds: Array, growth: Array
) -> tuple[float, float] | None:
    """Return a stable and an unstable speed around the lowest onset, or None where there is none.

    A hump of the growth that hides between two speeds of the search is looked for at each of
    its local maxima.
    """
    for i in range(1, len(speeds)):
        if growth[i] > 0.0:
            return float(speeds[i - 1]), float(speeds[i])
        is_peak = i + 1 < len(speeds) and growth[i - 1] < growth[i] >= growth[i + 1]
        if is_peak:
            top = minimize_scalar(
                lambda speed: -float(_growth(machine, speed, flexible)),
                bounds=(speeds[i - 1], speeds[i + 1]),
                method="bounded",
            )
            if top.fun < 0.0:
                return float(speeds[i - 1]), float(top.x)
    return None
