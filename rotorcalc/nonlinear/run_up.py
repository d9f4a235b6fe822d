"""A run-up to the top speed, and the spectra that an engineer would record along it.

Model: the nonlinear motion of `transient` at evenly rising speed; a balanced rotor is stirred by a
small imbalance, as a perfectly balanced one would never leave its equilibrium.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from rotorcalc import modes
from rotorcalc.analysis import analyse
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.display import Result
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.signals import Waterfall, waterfall
from rotorcalc.nonlinear.transient import simulate

# Initial over final speed, and the number of revolutions.
# 1600 revolutions hold 50 windows of a waterfall side by side, and take about a second.
FROM, REVOLUTIONS = 0.3, 1600
# The imbalance of a balanced rotor, in clearances.
_STIR = 1e-3
# 16 samples a revolution resolve orders up to 8; a waterfall ends at 1.5.
_SAMPLES, _SPECTRA = 16, 200
# Of the integrator's steps: spectra are read to a hundredth.
_TOLERANCE = 1e-7


@dataclass(frozen=True, eq=False)
class RunUp(Result):
    """A run-up's spectra, with the linear theory's whirl and speeds to mark on them.

    Attributes
    ----------
    seen : Waterfall
        The spectra.
    whirl_order : array, (m,)
        Order of the least damped whirl at the spectra's speeds by the linear theory [-].
    onset, running_speed : float
        [rad/s].
    """

    seen: Waterfall
    whirl_order: Array
    onset: float
    running_speed: float


@checked
def run_up(
    machine: Machine, top_speed: float, *, progress: Callable[[float], object] | None = None
) -> RunUp:
    """Return the spectra of a run-up from 0.3 times a speed to it.

    Parameters
    ----------
    machine : Machine
        The machine.
    top_speed : float
        Speed at the end [rad/s].
    progress : callable or None
        Called repeatedly with the share done, 0 to 1. An exception that it raises ends the work.

    Returns
    -------
    RunUp
        Onset and running speed are NaN: the caller sets them.

    Raises
    ------
    ValueError
        Where the speed is not positive and finite.
    TransientError
        As `simulate`.
    """
    imbalance = machine.rotor.imbalance or _STIR * machine.bearing.radial_clearance
    motion = simulate(
        replace(machine, rotor=replace(machine.rotor, imbalance=imbalance)),
        FROM * top_speed,
        revolutions=REVOLUTIONS,
        samples_per_revolution=_SAMPLES,
        final_speed=top_speed,
        tolerance=_TOLERANCE,
        progress=progress,
    )
    seen = waterfall(motion, spectra=_SPECTRA)
    whirl = modes.leading(analyse(machine, seen.speed).flexible_eigenvalues)
    return RunUp(
        seen=seen,
        whirl_order=whirl.imag / seen.speed,
        onset=math.nan,
        running_speed=math.nan,
    )
