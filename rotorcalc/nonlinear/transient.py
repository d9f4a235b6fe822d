"""Nonlinear orbits: the rotor's motion integrated in time on the film's full force.

Model: the film's force at any position and velocity of the journal; a rigid rotor, a disk on a
flexible shaft with massless journals, or the same with journal masses; midspan damping; imbalance
from t = 0, turning forward. The load acts on the disk. A massless journal moves at the velocity at
which the film's force balances the shaft's, solved for at every step. The speed may run up or down.

Integrator: LSODA (ODEPACK, through SciPy), which switches to an implicit method where the film
makes the motion stiff; tolerances are relative to the motion, and absolute in clearances.

Source: San Andrés, Notes 5, Eq. 5.1 with imbalance forward, and the calculation sheet's flexible
rotor with the film's force in place of its linear coefficients.
"""

import math
import numbers
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc import modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, IntArray, real_array, shown
from rotorcalc.coefficients import equilibrium
from rotorcalc.display import Result
from rotorcalc.films import film_of
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.equations import Equations, Motion, Start, Steps, integrated, resting
from rotorcalc.nonlinear.limit_cycles import bifurcation
from rotorcalc.nonlinear.linear_motion import linear_theory, started

__all__ = [
    "MOST_REVOLUTIONS",
    "MOST_SAMPLES",
    "TOLERANCE",
    "Start",
    "Transient",
    "TransientError",
    "bifurcation",  # the limit cycles on which these motions end
    "last_state",
    "resting",
    "simulate",
    "start_on_mode",
]

# Bounds of time and memory: two million samples of up to 17 numbers take 0.3 GB.
MOST_REVOLUTIONS = 20_000
MOST_SAMPLES = 2_000_000
# Relative tolerance of each step of LSODA; the absolute one is by default a hundredth of it.
TOLERANCE, _ABSOLUTE = 1e-10, 1e-2
STEPS = Steps(TOLERANCE, _ABSOLUTE * TOLERANCE)
# Absolute tolerance from which implicit formulas, of order 5 at most, take longer steps than the
# explicit ones that a stiff motion allows.
_LOOSE = 5e-8
# LSODA refuses a tolerance of 1e-14, which is near its own rounding.
_TOLERANCES = (1e-13, 1e-3)
# Revolutions after which progress is reported, contact with the wall is checked, and the disk is
# pushed where it is; the golden angle, whose multiples by squares are the directions of the pushes:
# they never repeat, and unlike those of an even turn do not cancel one another.
_STRETCH, _GOLDEN = 20, math.pi * (3.0 - math.sqrt(5.0))


@dataclass(frozen=True, eq=False)
class Transient(Result):
    """A motion over time, from the bearing's centre.

    Attributes
    ----------
    time : array, (n,)
        t [s].
    journal, disk : array, (n, 2)
        Positions in X, Y [m]; the disk's with its static sag. Equal for a rigid shaft.
    disk_velocity : array, (n, 2)
        The disk's velocity in X, Y [m/s].
    speed : array, (n,)
        Running speed, Ω [rad/s].
    angle : array, (n,)
        Angle through which the imbalance has turned [rad].
    inner : array, (n, states), or None
        The film's inner states: positions of its inner coordinates [m], then velocities of those
        with a mass [m/s]; None where it has none.
    """

    time: Array
    journal: Array
    disk: Array
    disk_velocity: Array
    speed: Array
    angle: Array
    # A function, as the velocity of a massless journal is costly and seldom needed.
    _journal_velocity: Callable[[slice | IntArray], Array]
    inner: Array | None = None

    @cached_property
    def journal_velocity(self) -> Array:
        """The journal's velocity in X, Y [m/s], (n, 2); computed on first use.

        Without journal mass it is solved from the film's force, sample by sample.
        """
        return self._journal_velocity(slice(None))

    def journal_velocity_at(self, samples: IntArray) -> Array:
        """Return the journal's velocity at some samples in X, Y [m/s], (..., 2)."""
        return self._journal_velocity(samples)

    @property
    def last_journal_velocity(self) -> Array:
        """The journal's velocity at the end in X, Y [m/s], (2,)."""
        return self._journal_velocity(slice(-1, None))[0]


class TransientError(RuntimeError):
    """The integration failed; `partial` holds the motion computed so far."""

    def __init__(self, message: str, partial: Transient) -> None:
        super().__init__(message)
        self.partial = partial

    def __reduce__(self) -> tuple[type, tuple[str, Transient]]:
        """Return the arguments with which another process restores it."""
        # Pickle restores an exception from its message alone, which fails without `partial`.
        return type(self), (str(self), self.partial)


@checked
def simulate(  # noqa: PLR0913 - how long, from where, to which speed
    machine: Machine,
    speed: float,
    *,
    revolutions: int,
    samples_per_revolution: int = 64,
    start: ArrayLike | Start | None = None,
    final_speed: float | None = None,
    pushes: float = 0.0,
    tolerance: float = TOLERANCE,
    absolute: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Transient:
    """Return the nonlinear motion of a machine, integrated in time.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s], positive; at t = 0 where it runs up or down.
    revolutions : int
        Number of revolutions, 1 to 20000.
    samples_per_revolution : int
        Samples in each, evenly spaced in the angle of rotation, 1 or more.
    start : array_like (2,), Start or None
        The journal's position from the bearing's centre [m], at rest, the shaft carrying its static
        sag; or the whole state; None for the static equilibrium.
    final_speed : float or None
        Speed at the end of a linear run-up or run-down [rad/s]; None for constant speed.
    pushes : float
        Velocity that the disk is given every 20 revolutions, each time in another direction [m/s],
        zero or more: a machine is never quite undisturbed, and without a disturbance a balanced one
        would not leave an unstable equilibrium.
    tolerance : float
        Relative error allowed in each of the integrator's steps, 1e-13 to 1e-3. The default keeps
        a motion over 200 revolutions to better than 1e-6.
    absolute : float or None
        Error allowed in each step besides, in clearances and CΩ, within the same bounds; None for a
        hundredth of the relative one. A position is near 1: there a larger one changes little, but
        where velocities and displacements cross zero the steps become up to twice as long.
    progress : callable or None
        Called repeatedly with the share done, 0 to 1. An exception that it raises ends the work.

    Returns
    -------
    Transient
        n = revolutions · samples_per_revolution + 1 samples, the start included.

    Raises
    ------
    ValueError
        Where a speed, the number of revolutions or samples, the start, the pushes or the tolerance
        is out of bounds.
    TransientError
        Where the integration fails, with time and position; it holds the motion computed so far.
    """
    speeds = _checked_speeds(speed, final_speed)
    _check_length(revolutions, samples_per_revolution)
    _check_tolerance("tolerance", tolerance)
    if absolute is None:
        absolute = _ABSOLUTE * tolerance
    else:
        _check_tolerance("absolute", absolute)
    if not 0.0 <= pushes < math.inf:
        raise ValueError(f"pushes = {pushes} m/s: must be zero or more, and finite")
    model = Equations(machine, *speeds, turned=2.0 * math.pi * revolutions)
    state = model.initial(_checked_start(machine, speeds[0], start, model.thinnest))
    angles = np.linspace(0.0, model.turned, revolutions * samples_per_revolution + 1)
    steps = Steps(tolerance, absolute, implicit=absolute >= _LOOSE and model.is_stiff)
    run = _Run(angles, _STRETCH * samples_per_revolution, steps, pushes / (model.C * speeds[0]))
    return _integrate(model, state, run, progress)


@checked
def start_on_mode(machine: Machine, speed: float, amplitude: float) -> Start:
    """Return a state on the linear theory's mode that decays slowest, about static equilibrium.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s].
    amplitude : float
        Largest displacement in the mode of the journal, or of a part of the film that moves
        farther [m].

    Returns
    -------
    Start
        The motion from it follows that mode while it is small.

    Raises
    ------
    ValueError
        Where the speed is not positive, the amplitude is not positive and finite, or no mode
        oscillates.
    """
    if not 0.0 < amplitude < math.inf:
        raise ValueError(f"amplitude = {amplitude} m: must be positive and finite")
    theory = linear_theory(machine, _checked_speed("speed", speed))
    mode = modes.leading_place(theory.eigenvalues)
    lam, shape = theory.eigenvalues[mode], theory.vectors[: len(theory.forced), mode]
    if lam.imag <= 0.0:
        raise ValueError(f"machine: none of its modes oscillates at {speed:.6g} rad/s")
    journal = shape[theory.journal]
    # The phase at which the journal's displacement is largest: (x·x) real and positive.
    scale = amplitude * np.exp(-0.5j * np.angle(np.sum(journal**2)))
    inner = np.abs(shape[theory.journal.stop :]).max(initial=0.0)
    # The amplitude is that of the journal, or of the film's part that moves farthest.
    scale /= max(float(np.linalg.norm((journal * scale / abs(scale)).real)), float(inner))
    return started(machine, speed, (scale * shape).real, (lam * scale * shape).real)


@checked
def last_state(motion: Transient) -> Start:
    """Return the final state of a motion, a start for another."""
    return Start(
        journal=motion.journal[-1],
        disk=motion.disk[-1],
        journal_velocity=motion.last_journal_velocity,
        disk_velocity=motion.disk_velocity[-1],
        inner=None if motion.inner is None else motion.inner[-1],
    )


@dataclass(frozen=True, eq=False)
class _Run:
    """Angles at which to return the state, their number in a stretch, its steps, pushes [CΩ]."""

    angles: Array
    stretch: int
    steps: Steps
    pushes: float

    def pushed(self, state: Array, first: int) -> Array:
        """Return the state at the beginning of a stretch with the disk pushed."""
        turn = (first // self.stretch) ** 2 * _GOLDEN
        pushed = state.copy()
        pushed[2:4] += self.pushes * np.array([math.cos(turn), math.sin(turn)])
        return pushed


def _integrate(
    model: Equations, state: Array, run: _Run, progress: Callable[[float], object] | None
) -> Transient:
    """Integrate in stretches, so that progress is reported and a failure located."""
    motion, angles = model.motion(), run.angles
    states = np.empty((len(angles), len(state)))
    states[0] = state
    for first in range(0, len(angles) - 1, run.stretch):
        span = slice(first, min(first + run.stretch, len(angles) - 1) + 1)
        # Every stretch starts LSODA again: its history is lost, which costs a few small steps.
        start = run.pushed(states[first], first)
        rows, message = _stretch(model, motion, start, angles[span], run.steps)
        states[first + 1 : first + len(rows)] = rows[1:]
        done = first + len(rows)
        if message:
            partial = _transient(model, angles[:done], states[:done])
            place = partial.journal[-1] * 1e6
            raise TransientError(
                f"{message} after {partial.time[-1]:.6g} s, with the journal at "
                f"X = {place[0]:.4g} µm, Y = {place[1]:.4g} µm",
                partial,
            )
        if progress is not None:
            progress(float(angles[span][-1] / model.turned))
    return _transient(model, angles, states)


def _transient(model: Equations, angles: Array, states: Array) -> Transient:
    """Return states over angles as a motion with dimensions."""
    C, unit = model.C, model.C * model.first
    return Transient(
        time=model.time(angles),
        journal=model.journal(states) * C,
        disk=states[:, :2] * C,
        disk_velocity=states[:, 2:4] * unit,
        speed=model.speed(angles),
        angle=angles,
        _journal_velocity=partial(_velocities, model, angles, states),
        inner=model.inner_states(states),
    )


def _velocities(model: Equations, angles: Array, states: Array, rows: slice | IntArray) -> Array:
    return model.journal_velocity(angles[rows], states[rows])


def _stretch(
    model: Equations, motion: Motion, state: Array, angles: Array, steps: Steps
) -> tuple[Array, str]:
    """Return the valid states over a stretch, and the reason for an early end, if any.

    Where the integrator fails it does not say which of its states are valid: these are then found
    by halving the stretch.
    """
    # A failure inside the stretch may leave arbitrary numbers behind its place.
    states, message = _attempt(motion, state, angles, steps)
    if message and len(angles) > 2:
        middle = len(angles) // 2
        before, message = _stretch(model, motion, state, angles[: middle + 1], steps)
        if message:
            return before, message
        # From the last state known to be valid.
        after, message = _stretch(model, motion, before[-1], angles[middle:], steps)
        return np.concatenate([before, after[1:]]), message
    # Two angles are left: the failure lies between them.
    if message:
        return state[None, :], message
    # The film's force is kept finite at the wall, so an integration can pass it without an error.
    good = np.isfinite(states).all(axis=1) & (model.gap(states) > model.thinnest)
    reached = int(np.argmin(good)) if not good.all() else len(states)
    if reached < len(states):
        return states[: max(reached, 1)], _too_close(model)
    return states, ""


def _too_close(model: Equations) -> str:
    if model.thinnest == 0.0:
        return "the journal came too close to the wall"
    limit = f"than {model.thinnest:.2g} of"
    if model.inner is not None and model.inner.film.states > 0:
        place = f"a film became thinner {limit} its clearance"
    else:
        place = f"the journal came closer to the wall {limit} the clearance"
    return f"{place}, beyond which this film's force is not computed"


def _attempt(motion: Motion, state: Array, angles: Array, steps: Steps) -> tuple[Array, str]:
    try:
        states, message = integrated(motion, state, angles, steps=steps)
    except ArithmeticError as error:
        return state[None, :], str(error)
    return states, message and f"the integrator gave up ({message})"


def _checked_speeds(speed: float, final_speed: float | None) -> tuple[float, float]:
    first = _checked_speed("speed", speed)
    return first, first if final_speed is None else _checked_speed("final_speed", final_speed)


def _checked_speed(name: str, value: float) -> float:
    if not 0.0 < value < math.inf:
        raise ValueError(f"{name} = {value} rad/s: must be positive and finite")
    return float(value)


def _check_length(revolutions: int, samples: int) -> None:
    given: dict[str, object] = {"revolutions": revolutions, "samples_per_revolution": samples}
    for name, value in given.items():
        if isinstance(value, bool) or not isinstance(value, numbers.Integral) or value < 1:
            raise ValueError(f"{name} = {value!r}: must be a whole number, 1 or more")
    if revolutions > MOST_REVOLUTIONS:
        raise ValueError(f"revolutions = {revolutions}: must be at most {MOST_REVOLUTIONS}")
    if revolutions * samples > MOST_SAMPLES:
        raise ValueError(
            f"revolutions x samples_per_revolution = {revolutions * samples}: must be at most "
            f"{MOST_SAMPLES}"
        )


def _check_tolerance(name: str, tolerance: float) -> None:
    low, high = _TOLERANCES
    if not low <= tolerance <= high:
        raise ValueError(f"{name} = {tolerance}: must lie within {low:g} and {high:g}")


def _checked_start(
    machine: Machine, speed: float, start: ArrayLike | Start | None, thinnest: float
) -> Start:
    C = machine.bearing.radial_clearance
    if start is None:
        start = resting(machine, equilibrium(machine, speed).film.position * C)
    elif not isinstance(start, Start):
        start = resting(machine, _checked_vector("start", start))
    for name in ("journal", "disk", "journal_velocity", "disk_velocity"):
        _checked_vector(f"start.{name}", getattr(start, name))
    # Contact is the film's own gap, not |position| ≥ C: bores need not be circular.
    gap = float(film_of(machine.bearing).gap(start.journal / C))
    if 0.0 < gap <= thinnest:
        raise ValueError(
            f"start: the journal is {gap * C:.6g} m from the wall; this film's force is computed "
            f"down to {thinnest:.2g} of the clearance, {thinnest * C:.6g} m"
        )
    if gap <= 0.0:
        distance = float(np.hypot(*start.journal))
        raise ValueError(
            f"start: the journal lies {distance:.6g} m from the bearing's centre, where its film "
            f"has no thickness left; the radial clearance is {C:.6g} m"
        )
    return start


def _checked_vector(name: str, value: ArrayLike) -> Array:
    vector = real_array(name, value)
    if vector.shape != (2,):
        raise ValueError(
            f"{name} = {shown(value)}: must be two numbers, X and Y, has the shape {vector.shape}"
        )
    if not np.all(np.isfinite(vector)):
        raise ValueError(f"{name} = {shown(value)}: must be finite")
    return vector
