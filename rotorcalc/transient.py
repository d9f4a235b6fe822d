"""Nonlinear orbits: the rotor's motion integrated in time on the film's full force.

Model: the film's force at any position and velocity of the journal; a rigid rotor, a disk on a
flexible shaft with massless journals, or the same with journal masses; midspan damping; imbalance
from t = 0, turning forward. The load acts on the disk. Massless journals move at the velocity with
which the film's force balances the shaft's, solved at every step. Speed may run up or down.

Integrator: LSODA (ODEPACK, through SciPy), which turns to an implicit method where the film makes
the motion stiff; its error control is relative to the motion and to a billionth of the clearance.

Source: San Andrés, Notes 5, Eq. 5.1 with imbalance forward, and the calculation sheet's flexible
rotor with the film's force in place of its linear coefficients.
"""

import math
import numbers
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import odeint

from rotorcalc import modes
from rotorcalc.coefficients import checked_speed, equilibrium
from rotorcalc.films import film_motion
from rotorcalc.machine import Machine
from rotorcalc.typing import Array

MOST_REVOLUTIONS = 5000
MOST_SAMPLES = 2_000_000
# Of LSODA's own steps: relative, and in clearances.
_RELATIVE, _ABSOLUTE = 1e-10, 1e-12
# A stretch after which progress is told and the wall is looked for [revolutions].
_STRETCH = 20
_MOST_STEPS = 20_000

# The rates of a state at an angle of rotation.
Motion: TypeAlias = Callable[[Array, float], list[float]]


@dataclass(frozen=True, eq=False)
class Transient:
    """A motion over time, from the bearing's centre.

    Attributes
    ----------
    time : array, (n,)
        t [s].
    journal, disk : array, (n, 2)
        Positions in X, Y [m]; the disk's with its static sag. Equal for a rigid shaft.
    journal_velocity, disk_velocity : array, (n, 2)
        Velocities in X, Y [m/s].
    speed : array, (n,)
        Running speed, Ω [rad/s].
    angle : array, (n,)
        Angle through which the imbalance has turned [rad].
    """

    time: Array
    journal: Array
    disk: Array
    journal_velocity: Array
    disk_velocity: Array
    speed: Array
    angle: Array


@dataclass(frozen=True, eq=False)
class Start:
    """A state to start from, each of shape (2,), in X, Y from the bearing's centre [m], [m/s]."""

    journal: Array
    disk: Array
    journal_velocity: Array
    disk_velocity: Array


class TransientError(RuntimeError):
    """The integration could not go on; `partial` holds the motion computed so far."""

    def __init__(self, message: str, partial: Transient) -> None:
        super().__init__(message)
        self.partial = partial


def simulate(  # noqa: PLR0913 - how long, from where, to which speed
    machine: Machine,
    speed: float,
    *,
    revolutions: int,
    samples_per_revolution: int = 64,
    start: ArrayLike | Start | None = None,
    final_speed: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> Transient:
    """Return the nonlinear motion of a machine, integrated in time.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s], positive; at t = 0 where it runs up or down.
    revolutions : int
        Number of revolutions, 1 to 5000.
    samples_per_revolution : int
        Samples in each, evenly spaced in the angle of rotation, 1 or more.
    start : array_like (2,), Start or None
        The journal's position from the bearing's centre [m], at rest, the shaft carrying its static
        sag; or the whole state; None for the static equilibrium.
    final_speed : float or None
        Speed at the end of a linear run-up or run-down [rad/s]; None for constant speed.
    progress : callable or None
        Called now and then with the share done, 0 to 1. What it raises ends the integration.

    Returns
    -------
    Transient
        n = revolutions · samples_per_revolution + 1 samples, the start included.

    Raises
    ------
    ValueError
        Where a speed, the number of revolutions or samples, or the start is out of bounds.
    TransientError
        Where the integration cannot go on, with the time and place; it holds the part computed.
    """
    speeds = _checked_speeds(speed, final_speed)
    _check_length(revolutions, samples_per_revolution)
    model = _Model(machine, *speeds, turned=2.0 * math.pi * revolutions)
    state = model.initial(_checked_start(machine, speeds[0], start))
    angles = np.linspace(0.0, model.turned, revolutions * samples_per_revolution + 1)
    return _integrate(model, state, angles, _STRETCH * samples_per_revolution, progress)


def start_on_mode(machine: Machine, speed: float, amplitude: float) -> Start:
    """Return a state on the least damped mode of the linear theory, about static equilibrium.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s].
    amplitude : float
        Largest displacement of the journal in the mode [m].

    Returns
    -------
    Start
        From which the motion follows that mode while it is small.

    Raises
    ------
    ValueError
        Where the speed is not positive or the amplitude is not positive and finite.
    """
    if not 0.0 < amplitude < math.inf:
        raise ValueError(f"amplitude = {amplitude} m: must be positive and finite")
    state = equilibrium(machine, float(checked_speed(speed)))
    shapes = modes.mode_shapes(machine.rotor, state.stiffness, state.damping)
    waves = np.flatnonzero(shapes.eigenvalues.imag > 0.0)
    mode = waves[np.argmax(shapes.eigenvalues.real[waves])]
    lam, disk, journal = shapes.eigenvalues[mode], shapes.disk[mode], shapes.journal[mode]
    # The phase at which the journal's displacement is largest: (x·x) real and positive.
    scale = amplitude * np.exp(-0.5j * np.angle(np.sum(journal**2)))
    scale /= np.linalg.norm((journal * scale / abs(scale)).real)
    rest = _resting(machine, state.film.position * machine.bearing.radial_clearance)
    return Start(
        journal=rest.journal + (scale * journal).real,
        disk=rest.disk + (scale * disk).real,
        journal_velocity=(lam * scale * journal).real,
        disk_velocity=(lam * scale * disk).real,
    )


class _Model:
    """The equations of motion over the angle of rotation θ, in clearances.

    dq/dθ = (dq/dt)/Ω. The state holds disk position and velocity, then the journal's position where
    the shaft bends, then its velocity where it has mass; velocities are by time, in CΩ_0.
    """

    def __init__(self, machine: Machine, first: float, last: float, *, turned: float) -> None:
        rotor, bearing = machine.rotor, machine.bearing
        C = bearing.radial_clearance
        self.machine, self.C, self.turned = machine, C, turned
        self.first, self.acceleration = first, (last**2 - first**2) / (2.0 * turned)
        self.flexible = not rotor.is_rigid
        self.massless = self.flexible and rotor.journal_mass == 0.0
        self.mass = rotor.disk_mass if self.flexible else rotor.half_mass
        # Forces in units of M C Ω_0² with M the mass they move; the film's at Ω_0.
        unit = C * first**2
        self.film_unit = machine.viscosity * first * bearing.radius * bearing.length**3 / C**2
        self.film = self.film_unit / (self.mass * unit)
        self.shaft = rotor.shaft_stiffness * C / (self.mass * unit) if self.flexible else 0.0
        self.damper = rotor.disk_damping / (self.mass * first)
        self.load = machine.static_load / (self.mass * unit)
        self.imbalance = rotor.disk_mass * rotor.imbalance / (self.mass * C)
        self.journal_ratio = self.mass / rotor.journal_mass if rotor.journal_mass > 0.0 else 0.0
        self.force, self.velocity = film_motion(bearing)

    def speed(self, angle: ArrayLike) -> Array:
        """Return the running speed at an angle of rotation [rad/s]."""
        return np.sqrt(self.first**2 + 2.0 * self.acceleration * np.asarray(angle, dtype=float))

    def time(self, angle: ArrayLike) -> Array:
        """Return the time at an angle of rotation [s]."""
        return 2.0 * np.asarray(angle, dtype=float) / (self.first + self.speed(angle))

    def initial(self, start: Start) -> Array:
        """Return the state vector of a start."""
        C, unit = self.C, self.C * self.first
        parts = [start.disk / C, start.disk_velocity / unit]
        if self.flexible:
            parts.append(start.journal / C)
        if self.flexible and not self.massless:
            parts.append(start.journal_velocity / unit)
        return np.concatenate(parts)

    def motion(self) -> Motion:
        """Return the function of state and angle that LSODA integrates."""
        if not self.flexible:
            return self._rigid()
        return self._massless() if self.massless else self._with_journal_mass()

    def _drive(self) -> Callable[[float], tuple[float, float, float]]:
        """Return imbalance force and speed ratio ν = Ω/Ω_0 over the angle."""
        u, twice = self.imbalance, 2.0 * self.acceleration / self.first**2
        spin = 0.5 * twice  # Ω̇/Ω_0²
        cos, sin, sqrt = math.cos, math.sin, math.sqrt

        def drive(angle: float) -> tuple[float, float, float]:
            nu2 = 1.0 + twice * angle
            c, s = cos(angle), sin(angle)
            return u * (nu2 * c + spin * s), u * (nu2 * s - spin * c), sqrt(nu2)

        return drive

    def _rigid(self) -> Motion:
        film, damper, load, force, drive = (
            self.film, self.damper, self.load, self.force, self._drive(),
        )  # fmt: skip

        def motion(state: Array, angle: float) -> list[float]:
            x, y, vx, vy = state.tolist()
            u_x, u_y, nu = drive(angle)
            f_x, f_y = force(x, y, vx / nu, vy / nu)
            scale = film * nu
            a_x = scale * f_x - damper * vx + load + u_x
            a_y = scale * f_y - damper * vy + u_y
            return [vx / nu, vy / nu, a_x / nu, a_y / nu]

        return motion

    def _massless(self) -> Motion:
        film, shaft, damper, load, velocity, drive = (
            self.film, self.shaft, self.damper, self.load, self.velocity, self._drive(),
        )  # fmt: skip

        def motion(state: Array, angle: float) -> list[float]:
            X, Y, vX, vY, x, y = state.tolist()
            u_x, u_y, nu = drive(angle)
            s_x, s_y = shaft * (X - x), shaft * (Y - y)
            scale = film * nu
            vx, vy = velocity(x, y, -s_x / scale, -s_y / scale)  # already by the angle
            a_x = -s_x - damper * vX + load + u_x
            a_y = -s_y - damper * vY + u_y
            return [vX / nu, vY / nu, a_x / nu, a_y / nu, vx, vy]

        return motion

    def _with_journal_mass(self) -> Motion:
        film, shaft, damper, load, force, drive, ratio = (
            self.film, self.shaft, self.damper, self.load, self.force, self._drive(),
            self.journal_ratio,
        )  # fmt: skip

        def motion(state: Array, angle: float) -> list[float]:
            X, Y, vX, vY, x, y, vx, vy = state.tolist()
            u_x, u_y, nu = drive(angle)
            s_x, s_y = shaft * (X - x), shaft * (Y - y)
            f_x, f_y = force(x, y, vx / nu, vy / nu)
            scale = film * nu
            a_x = -s_x - damper * vX + load + u_x
            a_y = -s_y - damper * vY + u_y
            b_x, b_y = ratio * (s_x + scale * f_x), ratio * (s_y + scale * f_y)
            return [vX / nu, vY / nu, a_x / nu, a_y / nu, vx / nu, vy / nu, b_x / nu, b_y / nu]

        return motion

    def transient(self, angles: Array, states: Array) -> Transient:
        """Return states over angles as a motion with dimensions."""
        C, unit = self.C, self.C * self.first
        disk, disk_velocity = states[:, :2] * C, states[:, 2:4] * unit
        journal = states[:, 4:6] * C if self.flexible else disk
        return Transient(
            time=self.time(angles),
            journal=journal,
            disk=disk,
            journal_velocity=self._journal_velocity(angles, states) * unit,
            disk_velocity=disk_velocity,
            speed=self.speed(angles),
            angle=angles,
        )

    def _journal_velocity(self, angles: Array, states: Array) -> Array:
        if not self.flexible:
            return states[:, 2:4]
        if not self.massless:
            return states[:, 6:8]
        motion, nu = self.motion(), self.speed(angles) / self.first
        rates = [motion(state, angle) for state, angle in zip(states, angles, strict=True)]
        return np.array(rates)[:, 4:6] * nu[:, None]


def _integrate(
    model: _Model,
    state: Array,
    angles: Array,
    stretch: int,
    progress: Callable[[float], None] | None,
) -> Transient:
    """Integrate stretch by stretch, so that progress can be told and a failure has its place."""
    motion = model.motion()
    states = np.empty((len(angles), len(state)))
    states[0] = state
    for first in range(0, len(angles) - 1, stretch):
        span = slice(first, min(first + stretch, len(angles) - 1) + 1)
        rows, message = _stretch(motion, states[first], angles[span])
        states[first : first + len(rows)] = rows
        done = first + len(rows)
        if message:
            partial = model.transient(angles[:done], states[:done])
            place = partial.journal[-1] * 1e6
            raise TransientError(
                f"{message} after {partial.time[-1]:.6g} s, with the journal at "
                f"X = {place[0]:.4g} µm, Y = {place[1]:.4g} µm",
                partial,
            )
        if progress is not None:
            progress(float(angles[span][-1] / model.turned))
    return model.transient(angles, states)


def _stretch(motion: Motion, state: Array, angles: Array) -> tuple[Array, str]:
    """Return the good states over a stretch, and what ended it early, if anything did."""
    try:
        solved = cast(
            "tuple[Array, dict[str, Any]]",
            odeint(  # pyright: ignore[reportCallIssue] - it takes a list of rates as well
                motion,  # pyright: ignore[reportArgumentType]
                state,
                angles,
                rtol=_RELATIVE,
                atol=_ABSOLUTE,
                mxstep=_MOST_STEPS,
                full_output=True,
            ),
        )
    except ArithmeticError as error:
        return state[None, :], str(error)
    states, report = solved
    journal = states[:, 4:6] if states.shape[1] > 4 else states[:, :2]
    good = np.isfinite(states).all(axis=1) & (np.hypot(journal[:, 0], journal[:, 1]) < 1.0)
    reached = int(np.argmin(good)) if not good.all() else len(states)
    if reached < len(states):
        return states[: max(reached, 1)], "the journal came too close to the wall"
    if report["message"] != "Integration successful.":
        return states[:1], f"the integrator gave up ({report['message']})"
    return states, ""


def _checked_speeds(speed: float, final_speed: float | None) -> tuple[float, float]:
    first = float(checked_speed(speed))
    return first, first if final_speed is None else float(checked_speed(final_speed))


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


def _checked_start(machine: Machine, speed: float, start: ArrayLike | Start | None) -> Start:
    C = machine.bearing.radial_clearance
    if start is None:
        start = _resting(machine, equilibrium(machine, speed).film.position * C)
    elif not isinstance(start, Start):
        position = np.asarray(start, dtype=float)
        if position.shape != (2,):
            raise ValueError(f"start: must be a position (X, Y), has the shape {position.shape}")
        start = _resting(machine, position)
    for name in ("journal", "disk", "journal_velocity", "disk_velocity"):
        value = getattr(start, name)
        if not np.all(np.isfinite(value)):
            raise ValueError(f"start: {name} = {value} must be finite")
    distance = float(np.hypot(*start.journal))
    if distance >= C:
        raise ValueError(
            f"start: the journal lies {distance:.6g} m from the bearing's centre, must be less "
            f"than the radial clearance, {C:.6g} m"
        )
    return start


def _resting(machine: Machine, position: Array) -> Start:
    """Return a state at rest, the shaft carrying its static sag."""
    still = np.zeros(2)
    sag = np.array([machine.static_sag, 0.0])
    return Start(journal=position, disk=position + sag, journal_velocity=still, disk_velocity=still)
