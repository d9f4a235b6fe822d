"""The computations that take long; another process can be asked for them (`ui.jobs.process`).

Nothing of Streamlit is imported here: that process is small, and soon begun.
"""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rotorcalc import Machine, Onsets, analyse, design, onsets, simulate
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.figures.orbits import GrowthCurve, RunUp
from rotorcalc.nonlinear import release as releases
from rotorcalc.nonlinear.measured_onset import measured_growth
from rotorcalc.nonlinear.signals import waterfall

Progress = Callable[[float], object]
# An input's name in the core, the ends of its axis, and whether that is logarithmic.
Axis = tuple[str, float, float, bool]

# Revolutions from which a release is sampled half as finely.
LONG = 150
# A run-up begins at this share of its end; without imbalance this much, in C, stirs the whirl.
RUN_UP_REVOLUTIONS, RUN_UP_FROM, _STIR = 1600, 0.3, 1e-3
_SPECTRA = 200
# Of the integrator's steps: a picture needs less than the core's default.
_TOLERANCE = 1e-7


def release(
    machine: Machine, speed: float, kick: float, revolutions: int, progress: Progress | None = None
) -> releases.Release:
    """Return what becomes of a journal let go above its rest; `kick` in clearances."""
    return releases.release(
        machine,
        speed,
        kick=kick * machine.bearing.radial_clearance,
        revolutions=revolutions,
        samples_per_revolution=64 if revolutions < LONG else 32,
        tolerance=_TOLERANCE,
        progress=progress,
    )


def run_up(machine: Machine, top_speed: float, progress: Progress | None = None) -> RunUp:
    """Return a run-up's spectra; onset and running speed are left to who knows them."""
    imbalance = machine.rotor.imbalance or _STIR * machine.bearing.radial_clearance
    stirred = replace(machine, rotor=replace(machine.rotor, imbalance=imbalance))
    motion = simulate(
        stirred, RUN_UP_FROM * top_speed, revolutions=RUN_UP_REVOLUTIONS,
        samples_per_revolution=16, final_speed=top_speed, tolerance=_TOLERANCE,
        progress=progress,
    )  # fmt: skip
    seen = waterfall(motion, spectra=_SPECTRA)
    order = _leading(machine, seen.speed).imag / seen.speed
    return RunUp(seen=seen, whirl_order=order, onset=math.nan, running_speed=math.nan)


def three_onsets(machine: Machine) -> tuple[Onsets, GrowthCurve]:
    """Return the onset found three ways, and growth over speed without a running speed."""
    found = onsets(machine)
    speeds = np.linspace(0.8, 1.2, 81) * found.eigenvalues
    measured = np.linspace(0.82, 1.18, 10) * found.eigenvalues
    return found, GrowthCurve(
        speed=speeds,
        rate=_leading(machine, speeds).real,
        measured_speed=measured,
        measured=np.array([measured_growth(machine, speed) for speed in measured]),
        running_speed=math.nan,
        running_rate=math.nan,
    )


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


def _places(axis: Axis, points: int) -> tuple[str, Array]:
    name, low, high, log = axis
    return name, (np.geomspace if log else np.linspace)(low, high, points)


def _leading(machine: Machine, speeds: Array) -> ComplexArray:
    """Return the eigenvalue of the oscillating mode nearest to growth at each speed [1/s]."""
    values = analyse(machine, speeds).flexible_eigenvalues
    waves = np.where(values.imag > 0.0, values.real, -np.inf)
    return np.take_along_axis(values, np.argmax(waves, axis=1)[:, None], axis=1)[:, 0]
