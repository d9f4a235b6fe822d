"""A machine at its running speed, and its results, each computed when a page first asks for it."""

import math
from functools import cached_property, lru_cache

import numpy as np

from rotorcalc import Machine, Onset, Sweep, analyse, film_curves, modes, onset_speed
from rotorcalc.analysis import FilmCurves
from rotorcalc.response import ResponsePeaks, response_peaks
from rotorcalc.typing import Array, ComplexArray
from ui.inputs import Values, machine_of, speeds_of

# Points of a sweep: enough for a smooth line across a projector.
POINTS = 240
# The notes' figures run over these modified Sommerfeld numbers.
_SOMMERFELD = np.geomspace(1e-2, 1e2, POINTS)


class View:
    """A machine at its running speed, with all that the pages show of it."""

    def __init__(self, machine: Machine, speed: float, top_speed: float) -> None:
        self.machine = machine
        self.speed = speed
        self.top_speed = top_speed

    @cached_property
    def point(self) -> Sweep:
        """The machine at its running speed; fields without a leading axis."""
        return analyse(self.machine, self.speed)

    @property
    def sweep(self) -> Sweep:
        """The machine over speed, up to the top speed."""
        return _sweep(self.machine, self.top_speed)

    @property
    def curves(self) -> FilmCurves:
        """The bearing's dimensionless film over the modified Sommerfeld number."""
        return _curves(self.machine)

    @property
    def onset(self) -> Onset:
        """Where the machine becomes unstable, its shaft as it is."""
        return _onset(self.machine, True)

    @property
    def rigid_onset(self) -> Onset:
        """Where the machine would become unstable if its shaft were rigid."""
        return _onset(self.machine, False)

    @property
    def rigid_branches(self) -> ComplexArray:
        """Eigenvalues of the rigid rotor over the sweep, a column a mode."""
        return _branches(self.machine, self.top_speed, False)

    @property
    def branches(self) -> ComplexArray:
        """Eigenvalues of the rotor over the sweep, a column a mode."""
        return _branches(self.machine, self.top_speed, True)

    @property
    def disk_peaks(self) -> ResponsePeaks:
        """Peaks of the disk's response up to the top speed."""
        return _peaks(self.machine, self.top_speed, "disk")

    @property
    def journal_peaks(self) -> ResponsePeaks:
        """Peaks of the journals' response up to the top speed."""
        return _peaks(self.machine, self.top_speed, "journal")

    @property
    def is_stable(self) -> bool:
        """Whether every mode decays at the running speed."""
        return bool(np.all(self.point.flexible_eigenvalues.real < 0.0))

    @property
    def unloaded(self) -> bool:
        """Whether the bearings carry no load."""
        return self.machine.static_load == 0.0


def view_of(values: Values) -> View:
    """Return the view of kept values, or raise the core's ValueError."""
    return _view(machine_of(values), *speeds_of(values))


def speeds(top_speed: float) -> Array:
    """Return the speeds of a sweep [rad/s]."""
    return np.linspace(top_speed / POINTS, top_speed, POINTS)


@lru_cache(maxsize=64)
def _view(machine: Machine, speed: float, top_speed: float) -> View:
    return View(machine, speed, top_speed)


@lru_cache(maxsize=64)
def _sweep(machine: Machine, top_speed: float) -> Sweep:
    return analyse(machine, speeds(top_speed))


@lru_cache(maxsize=64)
def _branches(machine: Machine, top_speed: float, flexible: bool) -> ComplexArray:
    sweep = _sweep(machine, top_speed)
    values = sweep.flexible_eigenvalues if flexible else sweep.rigid_eigenvalues
    return modes.follow_branches(values)


@lru_cache(maxsize=256)
def _onset(machine: Machine, flexible: bool) -> Onset:
    return onset_speed(machine, flexible=flexible)


@lru_cache(maxsize=64)
def _peaks(machine: Machine, top_speed: float, at: str) -> ResponsePeaks:
    return response_peaks(machine, speeds(top_speed), at=at)


@lru_cache(maxsize=16)
def _curves_of(bearing: object) -> FilmCurves:
    return film_curves(bearing, _SOMMERFELD)  # type: ignore[arg-type]


def _curves(machine: Machine) -> FilmCurves:
    return _curves_of(machine.bearing)


def hertz(frequency: float) -> float:
    """Return a frequency [rad/s] in Hz."""
    return frequency / (2.0 * math.pi)
