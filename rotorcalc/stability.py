"""Where whirl sets in: from the film's coefficients, and for a whole machine from its eigenvalues.

Model: the film's linear force coefficients about static equilibrium; a symmetric rotor. At the
threshold one mode whirls undamped, at the whirl ratio ω̄ = ω_s/Ω_s times the running speed.

Source: San Andrés, Notes 5, Eqs. 5.41 to 5.50.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq, minimize_scalar

from rotorcalc import modes
from rotorcalc.coefficients import equilibrium, modified_sommerfeld
from rotorcalc.films import film_state
from rotorcalc.machine import Machine
from rotorcalc.typing import Array

# Speeds at which the search for the onset looks before it closes in.
_SEARCH_POINTS = 160


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
    if machine.static_load == 0.0:
        return _unloaded_onset(machine, flexible)
    speeds = _search_speeds(machine)
    growth = _growth(machine, speeds, flexible)
    bracket = _first_crossing(machine, flexible, speeds, growth)
    if bracket is None:
        return Onset(speed=math.inf, whirl_frequency=math.nan, eccentricity_ratio=math.nan)

    def at(speed: float) -> float:
        return float(_growth(machine, speed, flexible))

    low, high = bracket
    speed = float(brentq(at, low, high, xtol=1e-14 * high, rtol=1e-14))
    state = equilibrium(machine, speed)
    eigenvalues = modes.eigenvalues(machine.rotor, state.stiffness, state.damping, flexible=flexible)
    crossing = eigenvalues[np.argmax(eigenvalues.real)]
    return Onset(
        speed=speed,
        whirl_frequency=float(modes.damped_frequency(crossing)),
        eccentricity_ratio=float(state.film.eccentricity_ratio),
    )


def _elements(coefficients: ArrayLike) -> tuple[Array, Array, Array, Array]:
    m = np.asarray(coefficients, dtype=float)
    return m[..., 0, 0], m[..., 0, 1], m[..., 1, 0], m[..., 1, 1]


def _growth(machine: Machine, speed: ArrayLike, flexible: bool) -> Array:
    """Return the fastest growth of any mode, max Re λ/Ω [-], shape of `speed`."""
    state = equilibrium(machine, speed)
    eigenvalues = modes.eigenvalues(machine.rotor, state.stiffness, state.damping, flexible=flexible)
    return eigenvalues.real.max(axis=-1) / state.speed


def _search_speeds(machine: Machine) -> Array:
    """Return speeds that span every onset the machine can have [rad/s].

    Below σ = 1e-3 the film lies so near the wall that it damps every whirl. Above σ = 10 it is
    all but centred, where the threshold of a rigid rotor no longer changes; midspan damping raises
    it at most as it raises the damping of the film.
    """
    unit = modified_sommerfeld(machine, 1.0)
    centred = equilibrium(machine, float(10.0 / unit))
    film = whirl_onset(centred.stiffness, centred.damping * centred.speed)
    threshold = np.sqrt(film.critical_mass / machine.rotor.half_mass) * centred.speed
    slack = 1.0 + 2.0 * machine.rotor.disk_damping / np.trace(centred.damping)
    highest = 2.0 * slack * max(float(centred.speed), float(threshold))
    return np.geomspace(1e-3 / unit, highest, _SEARCH_POINTS)


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


def _unloaded_onset(machine: Machine, flexible: bool) -> Onset:
    """Return the onset without load, where the film's state is the same at every speed."""
    film = film_state(machine.bearing, math.inf)
    slow = np.trace(equilibrium(machine, 1.0).damping) / machine.rotor.half_mass * 1e-6
    if _growth(machine, slow, flexible) > 0.0:
        return Onset(
            speed=0.0, whirl_frequency=0.0, eccentricity_ratio=float(film.eccentricity_ratio)
        )
    return Onset(speed=math.inf, whirl_frequency=math.nan, eccentricity_ratio=math.nan)
