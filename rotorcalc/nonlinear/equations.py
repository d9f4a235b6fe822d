"""The equations of motion on the film's full force, over the angle of rotation.

Model: the film's force at any position and velocity of the journal; a rigid rotor, a disk on a
flexible shaft with massless journals, or the same with journal masses; midspan damping; imbalance
turning forward. The load acts on the disk. A massless journal moves at the velocity at which the
film's force balances the shaft's, solved for at every step. The speed may run up or down.

Source: San Andrés, Notes 5, Eq. 5.1 with imbalance forward, and the calculation sheet's flexible
rotor with the film's force in place of its linear coefficients.
"""

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias, cast

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike
from scipy.integrate import ODEintWarning, odeint

from rotorcalc import heat
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, real_array, shown
from rotorcalc.coefficients import operating_points, stiffness_and_damping
from rotorcalc.display import Result
from rotorcalc.films import FilmUnits, InnerMotion, film_of
from rotorcalc.machine import Bearing, Machine
from rotorcalc.numerics.roots import clenshaw

# The derivatives of a state at an angle of rotation.
Motion: TypeAlias = Callable[[Array, float], list[float]]

# Steps of the integrator between two angles; more mean that it no longer advances.
_MOST_STEPS = 20_000
# Works that `motion_and_works` adds to a state: of imbalance, film and damper.
WORKS = 3
# Speeds at which the film's temperature is solved for in a run-up.
_TEMPERATURES = 24
# The longest step [rad]: in equilibrium longer steps of high order amplify rounding errors far
# beyond the tolerance before the error control notices.
_LONGEST_STEP = 0.25
# λ of a component that LSODA is given to find a motion stiff, and the error allowed in it.
_STIFF, _ANY = 300.0, 1e-3
# Rates at which a journal loses its velocity to the film, per radian, between which explicit
# formulas take shorter steps than accuracy asks for; beyond, LSODA leaves them by itself.
_STIFF_RATES = 5.0, 100.0


@dataclass(frozen=True)
class Steps:
    """Errors allowed in each of the integrator's steps, and whether it goes implicitly throughout.

    LSODA begins with explicit formulas, and leaves them where implicit ones allow steps five times
    as long. A journal with mass loses its velocity to the film many times in a radian; a loose
    tolerance then lets the implicit ones take two to four times as long steps, which it would never
    find out.
    """

    relative: float
    absolute: float
    implicit: bool = False


@dataclass(frozen=True, eq=False)
class Start(Result):
    """A state to start from, each of shape (2,), in X, Y from the bearing's centre [m], [m/s].

    `inner` holds the film's inner states (states,): the positions of its inner coordinates [m],
    then the velocities of those with a mass [m/s]; None where it has none, or in equilibrium.
    """

    journal: Array
    disk: Array
    journal_velocity: Array
    disk_velocity: Array
    inner: Array | None = None


class _Inner:
    """A film with inner coordinates behind the interface of one without; it holds their states.

    Set `states` and `speed`, call force or velocity once, then read `rates`.
    """

    def __init__(self, film: InnerMotion, places: int, viscosity: float) -> None:
        self.film, self.places, self.viscosity = film, places, viscosity
        self.states: list[float] = []
        self.rates: list[float] = []
        self.speed = math.nan

    def force(self, x: float, y: float, dx: float, dy: float) -> tuple[float, float]:
        """Return the force on the journal, as `FilmMotion.force`."""
        f_x, f_y, self.rates = self.film.force(
            (x, y, dx, dy), self.states, self.viscosity, self.speed
        )
        return f_x, f_y

    def velocity(
        self, x: float, y: float, f_x: float, f_y: float, _near: list[float] | None = None
    ) -> tuple[float, float]:
        """Return the journal's velocity, as `FilmMotion.velocity`."""
        dx, dy, self.rates = self.film.velocity(
            (x, y, f_x, f_y), self.states, self.viscosity, self.speed
        )
        return dx, dy


class Equations:
    """The equations of motion over the angle of rotation θ, in clearances.

    dq/dθ = (dq/dt)/Ω. The state holds disk position and velocity, then the journal's position where
    the shaft bends, then its velocity where it has mass, then the film's inner states; velocities
    are by time, in CΩ_0.
    """

    def __init__(self, machine: Machine, first: float, last: float, *, turned: float) -> None:
        rotor, bearing = machine.rotor, machine.bearing
        C = bearing.radial_clearance
        self.machine, self.C, self.turned = machine, C, turned
        # Ω² = Ω_0² + 2 Ω̇ θ: speed rises evenly in time, the motion is integrated over the angle.
        self.first, self.acceleration = first, (last**2 - first**2) / (2.0 * turned)
        self.flexible = not rotor.is_rigid
        self.massless = self.flexible and rotor.journal_mass == 0.0
        self.mass = rotor.disk_mass if self.flexible else rotor.half_mass
        # Forces in units of M C Ω_0² with M the mass that they accelerate; the film's unit at Ω_0.
        unit = C * first**2
        mu = float(heat.viscosity(machine, first))
        self.film_unit = float(FilmUnits(bearing, mu, first).force)
        self.thinning = _thinning(machine, first, last)
        self.film = self.film_unit / (self.mass * unit)
        self.shaft = rotor.shaft_stiffness * C / (self.mass * unit) if self.flexible else 0.0
        self.damper = rotor.disk_damping / (self.mass * first)
        self.load = machine.static_load / (self.mass * unit)
        self.imbalance = rotor.disk_mass * rotor.imbalance / (self.mass * C)
        self.journal_ratio = self.mass / rotor.journal_mass if rotor.journal_mass > 0.0 else 0.0
        model = film_of(bearing)
        film = model.motion()
        self.inner: _Inner | None = None
        # Where a motion ends, over the clearance: at the wall, or where the force is not known.
        self.thinnest = film.thinnest
        if isinstance(film, InnerMotion):
            if film.loaded is not None:
                film = film.loaded(machine.static_load)
            film = self.inner = _Inner(film, model.inner, mu)
        self.force, self.velocity = film.force, film.velocity

    def speed(self, angle: ArrayLike) -> Array:
        """Return the running speed at an angle of rotation [rad/s]."""
        return np.sqrt(self.first**2 + 2.0 * self.acceleration * np.asarray(angle, dtype=float))

    def time(self, angle: ArrayLike) -> Array:
        """Return the time at an angle of rotation [s]."""
        # Mean speed under constant acceleration is that of the two ends.
        return 2.0 * np.asarray(angle, dtype=float) / (self.first + self.speed(angle))

    def initial(self, start: Start) -> Array:
        """Return the state vector of a start, or (n, m) of n states."""
        C, unit = self.C, self.C * self.first
        parts = [start.disk / C, start.disk_velocity / unit]
        if self.flexible:
            parts.append(start.journal / C)
        if self.flexible and not self.massless:
            parts.append(start.journal_velocity / unit)
        if self.inner is not None and self.inner.film.states > 0:
            parts.append(self._inner_start(self.inner, start))
        return np.concatenate(parts, axis=-1)

    def _inner_start(self, inner: _Inner, start: Start) -> Array:
        """Return the film's inner states at a start, in equilibrium where it gives none."""
        if start.inner is None:
            return inner_rest(self.machine, self.first, start.journal)
        found = real_array("start.inner", start.inner)
        if found.shape[-1:] != (inner.film.states,) or not np.all(np.isfinite(found)):
            raise ValueError(
                f"start.inner = {shown(start.inner)}: must be {inner.film.states} numbers, the "
                "film's own states, or None"
            )
        found = found / self._inner_units(inner)
        if film_gap(self.machine.bearing, start.journal / self.C, found).min() <= 0.0:
            raise ValueError(
                f"start.inner = {shown(start.inner)}: leaves no film around the journal"
            )
        return found

    def _inner_units(self, inner: _Inner) -> Array:
        """Return the units of the film's inner states, C and CΩ_0."""
        # Positions come first, then velocities.
        is_place = np.arange(inner.film.states) < inner.places
        return self.C * np.where(is_place, 1.0, self.first)

    def motion(self) -> Motion:
        """Return the function of state and angle that LSODA integrates."""
        if not self.flexible:
            plain = self._rigid()
        else:
            plain = self._massless() if self.massless else self._with_journal_mass()
        return plain if self.inner is None else self._with_inner(plain, self.inner)

    def _with_inner(self, plain: Motion, inner: _Inner) -> Motion:
        """Return the motion of rotor and inner coordinates from that of the rotor alone.

        The film takes velocities in the present CΩ, and returns derivatives by the angle.
        """
        first, drive, own, places = self.first, self._drive(), self.own_states, inner.places
        coldest = inner.viscosity  # at the first speed

        def motion(state: Array, angle: float) -> list[float]:
            _, _, nu, strength = drive(angle)
            inner.speed, inner.viscosity = first * nu, coldest * strength / nu
            states = state[own:].tolist()
            inner.states = states[:places] + [velocity / nu for velocity in states[places:]]
            rates = plain(state[:own], angle)
            return [*rates, *inner.rates[:places], *(rate * nu for rate in inner.rates[places:])]

        return motion

    @property
    def is_stiff(self) -> bool:
        """Whether the film takes a journal's velocity from its mass many times in a radian."""
        if self.massless or self.inner is not None:
            return False
        rotor, (_, C) = self.machine.rotor, stiffness_and_damping(self.machine, self.first)
        mass = rotor.journal_mass if self.flexible else rotor.half_mass
        low, high = _STIFF_RATES
        return low < float(np.trace(C)) / (2.0 * mass * self.first) < high

    @property
    def own_states(self) -> int:
        """Number of the rotor's states, before the film's."""
        return 4 if not self.flexible else 6 if self.massless else 8

    def inner_states(self, states: Array) -> Array | None:
        """Return the film's inner states [m], [m/s] of states, or None where it has none."""
        if self.inner is None or self.inner.film.states == 0:
            return None
        return states[..., self.own_states :] * self._inner_units(self.inner)

    def _drive(self) -> Callable[[float], tuple[float, float, float, float]]:
        """Return imbalance force, ν = Ω/Ω_0 and μΩ over that at Ω_0, over the angle."""
        u, twice = self.imbalance, 2.0 * self.acceleration / self.first**2
        spin = 0.5 * twice  # Ω̇/Ω_0²
        cos, sin, sqrt, thinning = math.cos, math.sin, math.sqrt, self.thinning

        def steady(angle: float) -> tuple[float, float, float, float]:
            return u * cos(angle), u * sin(angle), 1.0, 1.0

        def drive(angle: float) -> tuple[float, float, float, float]:
            # −d²(cos θ)/dt² = Ω² cos θ + Ω̇ sin θ and −d²(sin θ)/dt² = Ω² sin θ − Ω̇ cos θ.
            nu2 = 1.0 + twice * angle
            c, s, nu = cos(angle), sin(angle), sqrt(nu2)
            strength = nu if thinning is None else nu * thinning(nu)
            return u * (nu2 * c + spin * s), u * (nu2 * s - spin * c), nu, strength

        return drive if twice else steady

    def _rigid(self) -> Motion:
        film, damper, load, force, drive = (
            self.film, self.damper, self.load, self.force, self._drive(),
        )  # fmt: skip

        def motion(state: Array, angle: float) -> list[float]:
            # Plain floats: arithmetic on NumPy's scalars takes five times as long.
            x, y, vx, vy = state.tolist()
            u_x, u_y, nu, strength = drive(angle)
            f_x, f_y = force(x, y, vx / nu, vy / nu)
            scale = film * strength  # the film's unit of force grows with μΩ
            # Eq. 5.1 over M C Ω_0², then over ν, as d/dθ is d/dt over Ω.
            a_x = scale * f_x - damper * vx + load + u_x
            a_y = scale * f_y - damper * vy + u_y
            return [vx / nu, vy / nu, a_x / nu, a_y / nu]

        return motion

    def _massless(self) -> Motion:
        film, shaft, damper, load, velocity, drive = (
            self.film, self.shaft, self.damper, self.load, self.velocity, self._drive(),
        )  # fmt: skip
        near: list[float] = []  # the last solution, from which the next search starts

        def motion(state: Array, angle: float) -> list[float]:
            X, Y, vX, vY, x, y = state.tolist()
            u_x, u_y, nu, strength = drive(angle)
            s_x, s_y = shaft * (X - x), shaft * (Y - y)
            scale = film * strength
            # Film and shaft force balance; the film's velocities are already by the angle.
            vx, vy = velocity(x, y, -s_x / scale, -s_y / scale, near)
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
            u_x, u_y, nu, strength = drive(angle)
            s_x, s_y = shaft * (X - x), shaft * (Y - y)
            f_x, f_y = force(x, y, vx / nu, vy / nu)
            scale = film * strength
            a_x = -s_x - damper * vX + load + u_x
            a_y = -s_y - damper * vY + u_y
            # The journal's balance, M_j ẍ = K_rot(X − x) + F_film.
            b_x, b_y = ratio * (s_x + scale * f_x), ratio * (s_y + scale * f_y)
            return [vX / nu, vY / nu, a_x / nu, a_y / nu, vx / nu, vy / nu, b_x / nu, b_y / nu]

        return motion

    def motion_and_works(self) -> Motion:
        """Return the motion of a state extended by the works of imbalance, film and damper.

        Each since the start, those of film and damper as losses, in M C² Ω_0².
        """
        motion, force, drive = self.motion(), self.force, self._drive()
        film, damper, place = self.film, self.damper, 4 if self.flexible else 0

        def both(state: Array, angle: float) -> list[float]:
            rates = motion(state[:-WORKS], angle)
            u_x, u_y, nu, strength = drive(angle)
            (dX, dY), (dx, dy) = rates[:2], rates[place : place + 2]  # velocities by the angle
            x, y = state[place : place + 2].tolist()
            f_x, f_y = force(x, y, dx, dy)
            given, lost = u_x * dX + u_y * dY, -film * strength * (f_x * dx + f_y * dy)
            return [*rates, given, lost, damper * nu * (dX * dX + dY * dY)]

        return both

    def gap(self, states: Array) -> Array:
        """Return the thinnest film in states, over its own clearance."""
        inner = None if self.inner is None else states[..., self.own_states :]
        return film_share(self.machine.bearing, self.journal(states), inner)

    def journal(self, states: Array) -> Array:
        """Return the journal's positions in states, in C."""
        return states[..., 4:6] if self.flexible else states[..., :2]

    def journal_velocity(self, angles: Array, states: Array) -> Array:
        """Return the journal's velocities in states at angles of rotation [m/s]."""
        unit = self.C * self.first
        if not self.flexible:
            return states[:, 2:4] * unit
        if not self.massless:
            return states[:, 6:8] * unit
        motion, nu = self.motion(), self.speed(angles) / self.first
        rates = [motion(state, angle) for state, angle in zip(states, angles, strict=True)]
        return np.array(rates)[:, 4:6] * nu[:, None] * unit


def _thinning(machine: Machine, first: float, last: float) -> Callable[[float], float] | None:
    """Return μ/μ_0 over ν = Ω/Ω_0, None where the viscosity stays.

    The film is taken at the temperature of each moment's speed: heating takes a film turns of the
    shaft, metal around it minutes, which is left out. A Chebyshev series over ln ν: plain floats.
    """
    if machine.supply is None or first == last:
        return None
    middle, half = 0.5 * math.log(last / first), 0.5 * math.log(last / first)
    x = np.cos(np.pi * (np.arange(_TEMPERATURES) + 0.5) / _TEMPERATURES)
    mu = np.log(np.asarray(heat.viscosity(machine, first * np.exp(middle + half * x))))
    start = math.log(float(heat.viscosity(machine, first)))
    series: list[float] = chebyshev.chebfit(x, mu - start, _TEMPERATURES - 1).tolist()

    def thinning(nu: float) -> float:
        return math.exp(clenshaw((math.log(nu) - middle) / half, series))

    return thinning


@checked
def resting(machine: Machine, position: Array) -> Start:
    """Return a state at rest, the shaft carrying its static sag.

    Parameters
    ----------
    machine : Machine
        The machine.
    position : array, (2,)
        The journal's, in X, Y from the bearing's centre [m].

    Returns
    -------
    Start
        The disk hangs below the journal by the sag.
    """
    still = np.zeros(2)
    sag = np.array([machine.static_sag, 0.0])
    return Start(journal=position, disk=position + sag, journal_velocity=still, disk_velocity=still)


def inner_rest(machine: Machine, speed: float, journal: Array) -> Array:
    """Return the film's inner states at rest beside a journal at rest.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed [rad/s].
    journal : array, (..., 2)
        The journal's position, in X, Y from the bearing's centre [m].

    Returns
    -------
    array, (..., states)
        In C and CΩ; none where the film has no inner coordinates.
    """
    motion = film_of(machine.bearing).motion()
    if not isinstance(motion, InnerMotion):
        return np.empty(0)
    points = operating_points(machine, speed)
    if motion.beside is None:
        return motion.rest(points)
    return motion.beside(points, journal / machine.bearing.radial_clearance)


def film_gap(bearing: Bearing, journal: Array, inner: Array | None) -> Array:
    """Return the thinnest film around a journal and the film's own parts, in C.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    journal : array, (..., 2)
        The journal's places, in C.
    inner : array, (..., states), or None
        The film's inner states, in C.

    Returns
    -------
    array, (...)
        Where the film has no inner states, or they do not matter, that of the journal alone.
    """
    motion = _inner_motion(bearing) if inner is not None else None
    if inner is None or motion is None or motion.gap is None:
        return film_of(bearing).gap(journal)
    return motion.gap(journal, inner)


def film_share(bearing: Bearing, journal: Array, inner: Array | None) -> Array:
    """Return the same over the clearance of the film that is thinnest in its own, (...)."""
    motion = _inner_motion(bearing) if inner is not None else None
    if inner is None or motion is None or motion.share is None:
        return film_gap(bearing, journal, inner)
    return motion.share(journal, inner)


def _inner_motion(bearing: Bearing) -> InnerMotion | None:
    motion = film_of(bearing).motion()
    return motion if isinstance(motion, InnerMotion) else None


def integrated(motion: Motion, state: Array, angles: Array, *, steps: Steps) -> tuple[Array, str]:
    """Return the states at angles of rotation, and the reason for an early end.

    Parameters
    ----------
    motion : callable
        The rates of a state at an angle.
    state : array, (m,)
        The state at the first angle.
    angles : array, (n,)
        Rising angles of rotation [rad].
    steps : Steps
        Errors allowed in each step, and how it goes.

    Returns
    -------
    states : array, (n, m)
        Valid up to where it ended.
    message : str
        Empty where it reached the last angle.

    Raises
    ------
    ArithmeticError
        Where the derivatives of a state cannot be computed.
    """
    relative, absolute = (np.full(len(state), one) for one in (steps.relative, steps.absolute))
    if steps.implicit:
        motion, state = _with_a_stiff_one(motion, state, angles[0])
        # Its own accuracy does not matter.
        relative, absolute = np.append(relative, 0.0), np.append(absolute, _ANY)
    with warnings.catch_warnings():  # the message says the same
        warnings.simplefilter("ignore", ODEintWarning)
        states, report = cast(
            "tuple[Array, dict[str, Any]]",
            odeint(  # pyright: ignore[reportCallIssue] - it takes a list of rates as well
                motion,  # pyright: ignore[reportArgumentType]
                state,
                angles,
                rtol=cast("float", relative),
                atol=cast("float", absolute),
                mxstep=_MOST_STEPS,
                hmax=_LONGEST_STEP,
                full_output=True,
            ),
        )
    message = str(report["message"])
    if steps.implicit:
        states = states[:, :-1]
    return states, "" if message == "Integration successful." else message


def _with_a_stiff_one(motion: Motion, state: Array, angle: float) -> tuple[Motion, Array]:
    """Return a motion and a state with one more component, w.

    w' = λ(sin θ − w) follows sin θ at once: to LSODA that is stiff from the first step on.
    """

    def both(state: Array, angle: float) -> list[float]:
        return [*motion(state[:-1], angle), _STIFF * (math.sin(angle) - float(state[-1]))]

    return both, np.append(state, math.sin(angle))
