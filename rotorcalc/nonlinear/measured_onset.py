"""The onset of whirl found three ways.

From the film's coefficients in closed form (Eqs. 5.45 to 5.50); from the eigenvalues of the free
motion; and as in an experiment: start a small whirl about the equilibrium at several speeds,
integrate the nonlinear motion, measure the growth rate of the whirl, and find the speed at which it
vanishes. The start lies on the linear theory's mode that decays slowest, since a kick would mostly
excite other modes; the growth rate is the nonlinear motion's own.
"""

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np
from scipy.optimize import brentq

from rotorcalc import modes
from rotorcalc.analysis import analyse
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.coefficients import equilibrium
from rotorcalc.display import Result
from rotorcalc.films import film_of
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.linear_motion import linear_theory
from rotorcalc.nonlinear.signals import fitted_modes
from rotorcalc.nonlinear.transient import TransientError, simulate, start_on_mode
from rotorcalc.onset.closed_form import closed_form_onset, covers
from rotorcalc.onset.search import searched_onset

# The initial whirl, in clearances, and its bound in minimum film thicknesses: so small that its
# growth is linear to a millionth of |λ|, yet large against the integrator's errors. Where the force
# is known to a mesh, and with it the place of rest, the whirl is as large as that error.
_WHIRL, _OF_FILM = 1e-4, 1e-2
# Observed time: _WHIRLS periods of whirl, or _LIFETIMES of 1/|growth rate| if shorter; at least
# _FEWEST periods, in at most _MOST revolutions and periods; and the samples over that time.
_WHIRLS, _LIFETIMES, _FEWEST, _MOST, _SAMPLES = 8.0, 3.0, 2.0, 400, 200
# Errors of the integrator, relative to such a motion.
_NOISE = 1e-6
# Speeds over the guess that bracket the onset, tried outwards; and the tolerance of the result.
_SPREAD = (0.98, 1.02, 0.9, 1.1, 0.75, 1.3, 0.5, 2.0)
_SHARP = 1e-6
# Speeds over the onset at which a curve of growth is measured: the narrowest of the brackets are
# among them.
_MEASURED = np.array([0.82, 0.86, 0.9, 0.94, 0.98, 1.02, 1.06, 1.1, 1.14, 1.18])
# Relative difference up to which the three onsets of a film that is known exactly agree.
_AGREE = 1e-3


Agreement: TypeAlias = Literal["agree", "differ", "not measured"]


@dataclass(frozen=True)
class Onsets:
    """The onset speed of a machine, three times [rad/s].

    Attributes
    ----------
    closed_form : float
        Where Ω = Ω_s(ε(Ω)); NaN for a rotor with midspan damping.
    eigenvalues : float
        Where the largest Re λ vanishes; infinite where there is none.
    measured : float
        Where a small whirl neither grows nor decays; NaN where no such speed was found.
    tolerance : float
        Relative difference up to which they agree [-], well above the errors of each.
    """

    closed_form: float
    eigenvalues: float
    measured: float
    tolerance: float = _AGREE

    @property
    def spread(self) -> float:
        """Largest difference of the known onsets from the eigenvalues', relative [-]."""
        known = [value for value in (self.closed_form, self.measured) if not math.isnan(value)]
        return max((abs(value / self.eigenvalues - 1.0) for value in known), default=math.nan)

    @property
    def agree(self) -> Agreement:
        """Whether all known onsets "agree" to their tolerance, or "differ".

        "not measured" where the measurement found no onset: two linear results prove nothing.
        """
        if math.isnan(self.measured):
            return "not measured"
        return "agree" if self.spread < self.tolerance else "differ"


@dataclass(frozen=True, eq=False)
class GrowthCurve(Result):
    """Growth rates of the whirl over speed, by the eigenvalues and as measured in time.

    Attributes
    ----------
    speed, rate : array, (n,)
        Ω [rad/s], and the largest Re λ of the linear theory [1/s].
    measured_speed, measured : array, (m,)
        Ω [rad/s], and the growth rate measured there [1/s].
    running_speed, running_rate : float
        Ω [rad/s], and the linear theory's rate there [1/s].
    """

    speed: Array
    rate: Array
    measured_speed: Array
    measured: Array
    running_speed: float
    running_rate: float


@checked
def onsets(machine: Machine, *, progress: Callable[[float], object] | None = None) -> Onsets:
    """Return the onset of a machine, found three ways.

    Parameters
    ----------
    machine : Machine
        The machine; its imbalance plays no part.
    progress : callable or None
        Called repeatedly with the share done, 0 to 1. An exception that it raises ends the work.

    Returns
    -------
    Onsets
        The eigenvalues' onset only sets the measurement's range, half to twice that speed.

    Raises
    ------
    ValueError
        Where the machine has no onset, or whirls at any speed without load.
    """
    return _onsets(machine, _rates(machine), progress)


@checked
def onsets_and_growth(machine: Machine) -> tuple[Onsets, GrowthCurve]:
    """Return `onsets` of a machine and its `growth_curve` about them, which share their releases.

    Parameters
    ----------
    machine : Machine
        The machine; its imbalance plays no part.

    Returns
    -------
    Onsets, GrowthCurve
        As these functions give them.

    Raises
    ------
    ValueError
        As `onsets` does.
    """
    rates = _rates(machine)
    found = _onsets(machine, rates, None)
    return found, _growth_curve(machine, found.eigenvalues, rates)


def _rates(machine: Machine) -> Callable[[float], float]:
    """Return the growth rates of a machine over speed, each measured once."""

    def rate(speed: float) -> float:
        return measured_growth(machine, speed)

    return functools.cache(rate)


def _onsets(
    machine: Machine,
    rates: Callable[[float], float],
    progress: Callable[[float], object] | None,
) -> Onsets:
    by_eigenvalues = searched_onset(machine).speed  # not by the closed form
    if not 0.0 < by_eigenvalues < math.inf:
        why = "whirls at any speed" if by_eigenvalues == 0.0 else "has no onset"
        raise ValueError(f"machine: {why}, so there is none to compare")
    closed = closed_form_onset(machine).speed if covers(machine) else math.nan
    return Onsets(
        closed_form=closed,
        eigenvalues=by_eigenvalues,
        measured=_measured_onset(rates, by_eigenvalues, progress),
        tolerance=max(_AGREE, _apart(machine)),
    )


def _apart(machine: Machine) -> float:
    """Return how far a film's force in motion may be from its linear theory."""
    return film_of(machine.bearing).motion().apart


@checked
def measured_growth(machine: Machine, speed: float) -> float:
    """Return the growth rate of a machine's whirl, measured on its nonlinear motion.

    The motion starts on the slowest mode to decay, so that it shows this mode alone: exponentials
    fitted to eight whirls then give its growth to about 1e-7 of |λ|, also where it takes thousands
    of them to grow by e.

    Parameters
    ----------
    machine : Machine
        The machine; its imbalance is left out.
    speed : float
        Running speed, Ω [rad/s].

    Returns
    -------
    float
        Growth rate [1/s] of a whirl of a ten-thousandth of the clearance, or of as much as the
        film's force at rest is uncertain (`FilmMotion.apart`). NaN where no mode oscillates, where
        two whirls take more than 400 revolutions or a revolution more than 400 whirls (that bounds
        the cost), or where the motion cannot be integrated.

    Raises
    ------
    ValueError
        Where the speed is not positive and finite.
    """
    balanced = replace(machine, rotor=replace(machine.rotor, imbalance=0.0))
    rest = equilibrium(balanced, speed)
    time = _watched(linear_theory(balanced, speed).whirl, speed)
    if math.isnan(time):
        return math.nan
    turns = time * speed / (2.0 * math.pi)
    revolutions = math.ceil(turns)
    film = float(rest.minimum_film_thickness)
    share = max(_WHIRL, _apart(machine))
    whirl = min(share * machine.bearing.radial_clearance, max(_OF_FILM, share) * film)
    try:
        motion = simulate(
            balanced,
            speed,
            revolutions=revolutions,
            samples_per_revolution=math.ceil(_SAMPLES / turns),
            start=start_on_mode(balanced, speed, whirl),
        )
    except TransientError:
        return math.nan
    # The allowance keeps rounding from dropping the last sample.
    watched = motion.journal[motion.time <= time * (1.0 + 1e-9)]
    place = rest.film.position * machine.bearing.radial_clearance
    values = fitted_modes(watched - place, float(motion.time[1]), noise=_NOISE)
    # The mode with the largest share comes first: the one that the motion was started on.
    waves = values[values.imag > 0.0]
    return float(waves[0].real) if len(waves) else math.nan


def _watched(expected: complex, speed: float) -> float:
    """Return the time for which to observe a mode [s], NaN where that would take too long."""
    whirl, revolution = 2.0 * math.pi / expected.imag, 2.0 * math.pi / speed
    time = _WHIRLS * whirl
    # After a few lifetimes a decay leaves nothing to measure, and a growth is no longer linear.
    if expected.real != 0.0:
        time = min(time, _LIFETIMES / abs(expected.real))
    if time > _MOST * revolution:
        time = _MOST * revolution if _FEWEST * whirl <= _MOST * revolution else math.nan
    return time if revolution <= _MOST * whirl else math.nan


@checked
def measured_onset(
    machine: Machine, *, near: float, progress: Callable[[float], object] | None = None
) -> float:
    """Return the speed at which a small whirl neither grows nor decays.

    Parameters
    ----------
    machine : Machine
        The machine; its imbalance is left out.
    near : float
        First guess [rad/s].
    progress : callable or None
        Called repeatedly with the share done, 0 to 1. An exception that it raises ends the work.

    Returns
    -------
    float
        Speed [rad/s] to a millionth; NaN where the whirl grows, or dies, at every speed
        from half to twice the first guess.
    """
    return _measured_onset(_rates(machine), near, progress)


def _measured_onset(
    rates: Callable[[float], float], near: float, progress: Callable[[float], object] | None
) -> float:
    releases = 0

    def rate(speed: float) -> float:
        nonlocal releases
        releases += 1
        if progress is not None:
            # How many releases are needed is not known ahead: the share rises, but never to 1.
            progress(1.0 - 1.0 / (1.0 + 0.2 * releases))
        return rates(speed)

    lower, upper = _SPREAD[0::2], _SPREAD[1::2]
    for low, high in zip(lower, upper, strict=True):
        # Stable below, unstable above: the narrowest pair that brackets a change is refined.
        if rate(low * near) < 0.0 < rate(high * near):
            found = brentq(rate, low * near, high * near, xtol=_SHARP * near, rtol=_SHARP)
            return float(found)
    return math.nan


@checked
def growth_curve(machine: Machine, onset: float) -> GrowthCurve:
    """Return the growth of a machine's whirl around its onset, computed and measured.

    Parameters
    ----------
    machine : Machine
        The machine; its imbalance is left out.
    onset : float
        Speed in the middle [rad/s].

    Returns
    -------
    GrowthCurve
        From 0.8 to 1.2 times that speed; without a running speed.

    Raises
    ------
    ValueError
        Where the speed is not positive and finite.
    """
    return _growth_curve(machine, onset, _rates(machine))


def _growth_curve(machine: Machine, onset: float, rates: Callable[[float], float]) -> GrowthCurve:
    speeds, measured = np.linspace(0.8, 1.2, 81) * onset, _MEASURED * onset
    return GrowthCurve(
        speed=speeds,
        rate=modes.leading(analyse(machine, speeds).flexible_eigenvalues).real,
        measured_speed=measured,
        measured=np.array(list(map(rates, measured.tolist()))),
        running_speed=math.nan,
        running_rate=math.nan,
    )
