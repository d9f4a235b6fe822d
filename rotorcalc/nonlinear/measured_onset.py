"""The onset of whirl found three ways that share nothing but the machine.

From the film's coefficients in closed form (Eqs. 5.45 to 5.50); from the eigenvalues of the free
motion; and as an experiment would: release the journal a little off its rest at many speeds,
integrate the nonlinear motion, measure how its whirl grows, and find the speed at which it neither
grows nor dies.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from rotorcalc.analysis import analyse
from rotorcalc.arguments import checked
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.signals import growth
from rotorcalc.nonlinear.transient import simulate
from rotorcalc.onset.closed_form import has_closed_form
from rotorcalc.onset.many import onset_speeds
from rotorcalc.onset.search import onset_speed

# The kick, in clearances, and the revolutions over which its whirl is watched.
_KICK, _REVOLUTIONS = 1e-4, 16
# Speeds over the guess at which the search looks first, outwards; and how sharp it ends.
_SPREAD = (0.97, 1.03, 0.9, 1.1, 0.75, 1.3, 0.5, 2.0)
_SHARP = 1e-6
_AGREE = 1e-3


@dataclass(frozen=True)
class Onsets:
    """The onset speed of a machine, three times [rad/s].

    Attributes
    ----------
    closed_form : float
        Where Ω = Ω_s(ε(Ω)); not a number for a rotor with midspan damping or journal mass.
    eigenvalues : float
        Where the largest Re λ vanishes; infinite where there is none.
    measured : float
        Where a released journal's whirl neither grows nor dies; not a number where no such speed
        was found.
    """

    closed_form: float
    eigenvalues: float
    measured: float

    @property
    def spread(self) -> float:
        """Largest difference of those that are numbers, over the eigenvalues' [-]."""
        known = [value for value in (self.closed_form, self.measured) if not math.isnan(value)]
        return max((abs(value / self.eigenvalues - 1.0) for value in known), default=math.nan)

    @property
    def agree(self) -> bool:
        """Whether all that are numbers agree to a thousandth."""
        return self.spread < _AGREE


@checked
def onsets(machine: Machine, *, progress: Callable[[float], object] | None = None) -> Onsets:
    """Return the onset of a machine, found three ways.

    Parameters
    ----------
    machine : Machine
        The machine; its imbalance plays no part.
    progress : callable or None
        Called now and then with the share done, 0 to 1. What it raises ends the work.

    Returns
    -------
    Onsets
        The eigenvalues' only tells the measurement where to look first: half to twice that speed.

    Raises
    ------
    ValueError
        Where the machine has no onset, or whirls at any speed for want of load.
    """
    by_eigenvalues = onset_speed(machine).speed
    if not 0.0 < by_eigenvalues < math.inf:
        why = "whirls at any speed" if by_eigenvalues == 0.0 else "has no onset"
        raise ValueError(f"machine: {why}, so there is none to compare")
    closed = float(onset_speeds([machine])[0]) if has_closed_form(machine) else math.nan
    return Onsets(
        closed_form=closed,
        eigenvalues=by_eigenvalues,
        measured=measured_onset(machine, near=by_eigenvalues, progress=progress),
    )


@checked
def measured_growth(machine: Machine, speed: float) -> float:
    """Return the growth rate of a machine's whirl as a short release of its journal shows it.

    Parameters
    ----------
    machine : Machine
        The machine; its imbalance is left out.
    speed : float
        Running speed, Ω [rad/s].

    Returns
    -------
    float
        Growth rate [1/s] of the whirl after a kick of a ten-thousandth of the clearance.
    """
    balanced = replace(machine, rotor=replace(machine.rotor, imbalance=0.0))
    rest = analyse(balanced, speed).journal_position
    kick = np.array([_KICK * machine.bearing.radial_clearance, 0.0])
    motion = simulate(balanced, speed, revolutions=_REVOLUTIONS, start=rest + kick)
    return growth(motion, rest=rest).real


@checked
def measured_onset(
    machine: Machine, *, near: float, progress: Callable[[float], object] | None = None
) -> float:
    """Return the speed at which a released journal's whirl neither grows nor dies.

    Parameters
    ----------
    machine : Machine
        The machine; its imbalance is left out.
    near : float
        Where to look first [rad/s].
    progress : callable or None
        Called now and then with the share done, 0 to 1. What it raises ends the work.

    Returns
    -------
    float
        Speed [rad/s] to a millionth; not a number where the whirl grows, or dies, at every speed
        from half to twice the one to begin with.
    """
    releases = 0

    def rate(speed: float) -> float:
        nonlocal releases
        releases += 1
        if progress is not None:
            progress(1.0 - 1.0 / (1.0 + 0.2 * releases))
        return measured_growth(machine, speed)

    lower, upper = _SPREAD[0::2], _SPREAD[1::2]
    for low, high in zip(lower, upper, strict=True):
        if rate(low * near) < 0.0 < rate(high * near):
            found = brentq(rate, low * near, high * near, xtol=_SHARP * near, rtol=_SHARP)
            return float(found)
    return math.nan
