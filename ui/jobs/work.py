"""The long computations, which another process can run (`ui.jobs.process`).

Nothing of Streamlit is imported here: that process is small, and soon begun.
"""

import time
from collections.abc import Callable, Sequence

import numpy as np

from rotorcalc import (
    Bifurcation,
    Machine,
    ModeOnset,
    Onsets,
    Tolerance,
    bifurcation,
    compare_bearings,
    design,
    tolerance,
)
from rotorcalc import input_sweep as sweeps
from rotorcalc.arrays import Array
from rotorcalc.comparison import BearingResult, bearing_result
from rotorcalc.geometry import Geometry
from rotorcalc.input_sweep import InputSweep
from rotorcalc.nonlinear import release as releases
from rotorcalc.nonlinear import run_up as run_ups
from rotorcalc.nonlinear.measured_onset import GrowthCurve, onsets_and_growth
from rotorcalc.nonlinear.run_up import RunUp

Progress = Callable[[float], object]
# An input's name in the core, the ends of its axis, and whether that is logarithmic.
Axis = tuple[str, float, float, bool]
# Inputs and their distributions, as `tolerance` has them in a mapping.
Spreads = tuple[tuple[str, tuple[str | float, ...]], ...]

# Revolutions from which a release is sampled half as finely.
LONG = 150
# Error allowed in each of the integrator's steps, relative and in clearances. A motion is then
# right to some millionths of a clearance, one that dies away to a tenth of the least drawn.
_TOLERANCE = 1e-7


def release(
    machine: Machine, speed: float, kick: float, revolutions: int, progress: Progress | None = None
) -> releases.Release:
    """Return the motion of a journal released above its equilibrium; `kick` in clearances."""
    return releases.release(
        machine,
        speed,
        kick=kick * machine.bearing.radial_clearance,
        revolutions=revolutions,
        samples_per_revolution=64 if revolutions < LONG else 32,
        tolerance=_TOLERANCE,
        absolute=_TOLERANCE,
        progress=progress,
    )


def run_up(
    machine: Machine,
    lowest: float,
    highest: float,
    revolutions: int,
    progress: Progress | None = None,
) -> RunUp:
    """Return a run-up and the run-down from its end, amplitudes and spectra."""
    return run_ups.run_up(machine, lowest, highest, revolutions=revolutions, progress=progress)


def cycles(
    machine: Machine,
    onset: ModeOnset | None,
    highest: float,
    progress: Progress | None = None,
) -> Bifurcation:
    """Return the limit cycles from an onset, the lowest for None, up to `highest` times it."""
    return bifurcation(machine, onset=onset, highest=highest, progress=progress)


def three_onsets(machine: Machine) -> tuple[Onsets, GrowthCurve]:
    """Return the onset found three ways, and growth over speed without a running speed."""
    return onsets_and_growth(machine)


def onset_map(
    machine: Machine, x: Axis, y: Axis, points: int, progress: Progress | None = None
) -> design.OnsetMap:
    """Return the onset over two inputs."""
    (x_name, xs), (y_name, ys) = _places(x, points), _places(y, points)
    return design.onset_map(machine, x=x_name, xs=xs, y=y_name, ys=ys, progress=progress)


def solution(
    machine: Machine, name: str, target: float, low: float, high: float
) -> design.OnsetSolution:
    """Return the values of an input that put the onset at a speed."""
    return design.solve_onset(machine, vary=name, target=target, low=low, high=high)


def bearing(machine: Machine, speed: float, geometry: Geometry | None) -> BearingResult:
    """Return what a machine does on another bore, or on its own."""
    if geometry is None:
        return bearing_result(machine, speed)
    return compare_bearings(machine, (geometry,), speed=speed)[0]


def bearings(
    asked: Sequence[tuple[Machine, float, Geometry | None]], patience: float
) -> list[BearingResult]:
    """Return the first of what `bearing` gives for each, as many as begin within some seconds."""
    until = time.monotonic() + patience
    found: list[BearingResult] = []
    for one in asked:
        if found and time.monotonic() >= until:
            break
        found.append(bearing(*one))
    return found


def study(  # noqa: PLR0913, PLR0917 - what is drawn, which is also what its result is kept by
    machine: Machine,
    speed: float,
    spreads: Spreads,
    samples: int,
    seed: int,
    progress: Progress | None = None,
) -> Tolerance:
    """Return the onsets of machines drawn within spreads, and what follows at a speed."""
    return tolerance(machine, dict(spreads), samples, seed, speed=speed, progress=progress)


def input_sweep(
    machine: Machine,
    field: str,
    values: tuple[float, ...],
    speed: float,
    progress: Progress | None = None,
) -> InputSweep:
    """Return a machine over the values of one input."""
    return sweeps.input_sweep(machine, vary=field, values=values, speed=speed, progress=progress)


def _places(axis: Axis, points: int) -> tuple[str, Array]:
    name, low, high, log = axis
    return name, (np.geomspace if log else np.linspace)(low, high, points)
