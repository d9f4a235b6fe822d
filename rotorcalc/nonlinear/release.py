"""The release of a displaced journal: its nonlinear motion, and the linear theory's.

Source: San Andrés, Notes 5, Eq. 5.38; the motions as in `transient` and `linear_motion`.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotorcalc.analysis import Sweep
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.coefficients import equilibrium
from rotorcalc.display import Result
from rotorcalc.films import film_of
from rotorcalc.geometry import FloatingRing
from rotorcalc.machine import Bearing, Machine
from rotorcalc.nonlinear.equations import film_gap, resting
from rotorcalc.nonlinear.linear_motion import linear_theory, motion_of
from rotorcalc.nonlinear.signals import Spectrum, poincare_points, spectrum
from rotorcalc.nonlinear.suction import lowest_pressure
from rotorcalc.nonlinear.transient import TOLERANCE, Transient, TransientError, simulate
from rotorcalc.unbalance_response import orbit_points

# Oscillations of its fastest mode after which a release ends, and revolutions at least: that bounds
# its cost.
_MOST_SWINGS, FEWEST_REVOLUTIONS = 800, 16
# Share of a motion, at its end, that is taken as settled.
_SETTLED = 0.25
# Around the wall, every degree: a square bore's corners are among them.
_AROUND = np.linspace(0.0, 2.0 * np.pi, 361)
# Clearances beyond the wall at which a linear orbit is cut off in charts.
_FAR = 0.5


@dataclass(frozen=True, eq=False)
class Release(Result):
    """The motion of a released journal beside the linear theory's; n samples.

    Attributes
    ----------
    motion : Transient
        The nonlinear motion.
    clearance : float
        C [m].
    wall : array, (p, 2)
        Positions of the journal's centre at contact, all the way round, in X, Y [m].
    rest : array, (2,)
        Static equilibrium of the journal, in X, Y from the bearing's centre [m].
    linear : array, (n, 2)
        The journal's positions by the linear theory [m]; NaN once it is far outside the wall.
    ellipse : array, (m, 2)
        The synchronous orbit by the linear theory [m].
    whirl : complex
        Growth rate + j frequency [1/s] of the linear theory's mode that decays slowest.
    film : array, (n,)
        Minimum film thickness [m].
    spectrum : Spectrum
        Of the last quarter of the motion.
    points : array, (k, 2)
        The journal's positions once per revolution [m].
    stopped : str
        Why the motion ended early; empty where it did not.
    lowest_pressure : float
        Of a film that the model keeps full whatever its pressure, above ambient [Pa]; else NaN.
    ring : array, (n, 2), or None
        The positions of a floating ring's centre in X, Y [m].
    """

    motion: Transient
    clearance: float
    wall: Array
    rest: Array
    linear: Array
    ellipse: Array
    whirl: complex
    film: Array
    spectrum: Spectrum
    points: Array
    stopped: str
    lowest_pressure: float = math.nan
    ring: Array | None = None

    @property
    def size(self) -> Array:
        """Distance of the journal from its static equilibrium, (n,) [m]."""
        return np.hypot(*(self.motion.journal - self.rest).T)

    @property
    def first_size(self) -> float:
        """Largest distance from rest over the first two revolutions [m]."""
        return float(self.size[self.motion.angle <= 4.0 * math.pi].max())

    @property
    def last_size(self) -> float:
        """Largest distance from rest over the last quarter of the motion [m]."""
        return float(self.size[-self.settled :].max())

    @property
    def revolutions(self) -> Array:
        """Revolutions since the release, (n,) [-]."""
        return self.motion.angle / (2.0 * math.pi)

    @property
    def peaks(self) -> tuple[Array, Array]:
        """Revolutions, and the largest distance from rest over each two of them [m], (n/2,)."""
        # Two revolutions hold a whole turn of a whirl at half speed.
        two = int(np.searchsorted(self.motion.angle, 4.0 * math.pi))
        rows = len(self.size) // two
        largest = self.size[: rows * two].reshape(rows, two).max(axis=1)
        return 2.0 * np.arange(rows, dtype=float) + 1.0, largest

    @property
    def predicted_peaks(self) -> Array:
        """The linear theory's growth or decay of the first of the peaks, (n/2,) [m]."""
        at, largest = self.peaks
        time = 2.0 * math.pi * (at - at[0]) / self.motion.speed[0]
        with np.errstate(over="ignore"):
            return largest[0] * np.exp(self.whirl.real * time)

    @property
    def settled(self) -> int:
        """Samples in the last quarter of the motion."""
        return max(int(_SETTLED * len(self.motion.time)), 1)


@checked
def release(  # noqa: PLR0913 - from where, for how long, how exactly
    machine: Machine,
    speed: float,
    *,
    kick: float,
    revolutions: int,
    samples_per_revolution: int = 64,
    tolerance: float = TOLERANCE,
    absolute: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Release:
    """Return the motion of a journal released away from its equilibrium.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s].
    kick : float
        Initial displacement above the equilibrium, against the load [m], zero or more.
    revolutions, samples_per_revolution, tolerance, absolute, progress
        As in `simulate`; 16 revolutions or more.

    Returns
    -------
    Release
        Where the integration fails, up to that time.

    Raises
    ------
    ValueError
        As `simulate`; also where the displacement leads out of the clearance.
    """
    if revolutions < FEWEST_REVOLUTIONS:
        raise ValueError(f"revolutions = {revolutions}: must be {FEWEST_REVOLUTIONS} or more")
    C = machine.bearing.radial_clearance
    rest = equilibrium(machine, speed).film.position * C
    # Against the load is −X.
    start = resting(machine, rest - np.array([kick, 0.0]))
    stopped = ""
    try:
        motion = simulate(
            machine, speed, revolutions=revolutions, start=start, tolerance=tolerance,
            absolute=absolute, samples_per_revolution=samples_per_revolution, progress=progress,
        )  # fmt: skip
    except TransientError as error:
        # Its last quarter must hold the four revolutions that a spectrum needs.
        if len(error.partial.time) <= 16 * samples_per_revolution:
            raise
        motion, stopped = error.partial, str(error)
    inner = None if motion.inner is None else motion.inner / C
    theory = linear_theory(machine, speed)
    linear = motion_of(theory, machine, speed, start, motion.time)
    return Release(
        motion=motion,
        clearance=C,
        wall=C * film_of(machine.bearing).outline(_AROUND),
        rest=rest,
        linear=rest + _drawn(linear, rest, machine.bearing),
        ellipse=rest + orbit_points(*theory.forced[theory.journal]),
        whirl=theory.whirl,
        film=C * film_gap(machine.bearing, motion.journal / C, inner),
        # Fewer revolutions make no spectrum, see `signals.spectrum`.
        spectrum=spectrum(
            motion,
            last=max(int(_SETTLED * revolutions), 4),
            slowest=_slowest(theory.whirl.imag / speed),
        ),
        points=poincare_points(motion),
        stopped=stopped,
        lowest_pressure=lowest_pressure(machine, motion),
        ring=_ring(machine.bearing, motion),
    )


def _slowest(order: float) -> float:
    """Return from which order on whirl is looked for: below 0.2 where linear theory has it there.

    A floating ring whirls at half of its own speed.
    """
    return min(0.2, 0.7 * order) if order > 0.1 else 0.2


def _ring(bearing: Bearing, motion: Transient) -> Array | None:
    if motion.inner is None or not isinstance(bearing.geometry, FloatingRing):
        return None
    return motion.inner[:, :2]


@checked
def affordable_revolutions(point: Sweep) -> int:
    """Return for how many revolutions a release is worth following: what 800 swings take.

    Parameters
    ----------
    point : Sweep
        The machine at one speed.

    Returns
    -------
    int
        Fewer where the fastest mode swings many times in a revolution, but 16 at least.
    """
    swings = float(np.abs(point.flexible_eigenvalues.imag).max() / point.speed)
    return max(FEWEST_REVOLUTIONS, round(_MOST_SWINGS / max(swings, 1.0)))


def _drawn(linear: Array, rest: Array, bearing: Bearing) -> Array:
    """Return a linear motion up to where it first lies far outside the clearance."""
    C = bearing.radial_clearance
    far = ~(film_of(bearing).gap((linear + rest) / C) > -_FAR)
    end = int(np.argmax(far)) if far.any() else len(linear)
    return np.where(np.arange(len(linear))[:, None] < end, linear, np.nan)
