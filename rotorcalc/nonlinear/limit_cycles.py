"""What whirl becomes: the limit cycles of a balanced machine over speed, stable and unstable.

A cycle of frequency ω is sought as a trigonometric polynomial for the journal, x(τ), τ = ωt, that
meets the balance of film and rotor at equally spaced τ (collocation, which converges faster than
any power of their number):

    F_film(x, ẋ) − Z_rotor x + F_o = 0.

The rotor is linear, so Z_rotor is its impedance at each harmonic, exact for a rigid rotor, a
flexible one, journal mass and midspan damping. The cycles are followed from the onset by the length
of their path, so through the folds at which they turn back. Each one's Floquet multipliers, of the
motion linearised about it, tell whether it is stable.

Source: Seydel, Practical Bifurcation and Stability Analysis, third edition, sections 4.4, 7.2, 7.4.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm

from rotorcalc import modes
from rotorcalc.arrays import Array, BoolArray, ComplexArray
from rotorcalc.coefficients import equilibrium
from rotorcalc.films import film_motion
from rotorcalc.machine import Machine, Rotor
from rotorcalc.nonlinear.equations import Start
from rotorcalc.nonlinear.hopf import Hopf, hopf, whirl_plane

MOST_CYCLES = 400
# Points around a cycle to begin with and at most, always odd; doubled where the polynomial's last
# coefficients are larger than this share of the clearance.
_FEWEST_POINTS, _MOST_POINTS = 33, 257
_TAIL = 1e-6
# Newton's method: steps at most, and the size of the last one.
_ITERATIONS, _SETTLED = 8, 1e-10
_FIRST_AMPLITUDE = 0.02
_FIRST_STEP, _LONGEST_STEP, _SHORTEST_STEP = 0.02, 0.035, 1e-5
_NEAREST_WALL = 0.97
_DIFFERENCE = 1e-6


class BifurcationError(RuntimeError):
    """The limit cycles could not be followed from the onset."""


@dataclass(frozen=True, eq=False)
class Bifurcation:
    """Limit cycles in the order in which they were found, from the onset on; n of them.

    Attributes
    ----------
    hopf : Hopf
        The onset, where the cycles begin.
    speed, whirl_frequency : array, (n,)
        Ω and ω [rad/s].
    amplitude : array, (n,)
        Largest distance of the journal from where it rests at that speed [m].
    eccentricity_ratio : array, (n,)
        Largest distance of the journal from the bearing's centre, in C [-].
    multiplier : array, (n,)
        Largest modulus of the Floquet multipliers but the one that is always 1 [-].
    stable : boolean array, (n,)
        Whether motions near the cycle approach it.
    paths : tuple of arrays, (m, 2)
        The journal's place in X, Y around each cycle, from the bearing's centre [m].
    """

    hopf: Hopf
    speed: Array
    whirl_frequency: Array
    amplitude: Array
    eccentricity_ratio: Array
    multiplier: Array
    stable: BoolArray
    paths: tuple[Array, ...]

    @property
    def folds(self) -> Array:
        """Speeds at which the branch turns back [rad/s], shape (folds,)."""
        return self._turns()[0]

    @property
    def fold_amplitudes(self) -> Array:
        """Amplitudes of the cycles at the folds [m], shape (folds,)."""
        return self._turns()[1]

    def _turns(self) -> tuple[Array, Array]:
        """Return the tops and bottoms of parabolas through the three cycles nearest to each."""
        step, size = np.diff(self.speed), np.diff(self.amplitude)
        turns = np.flatnonzero(step[:-1] * step[1:] < 0.0)
        before, after = step[turns] / size[turns], step[turns + 1] / size[turns + 1]
        bend = (after - before) / (size[turns] + size[turns + 1])
        slope = before + bend * size[turns]  # at the middle one of the three
        return (
            self.speed[turns + 1] - slope**2 / (4.0 * bend),
            self.amplitude[turns + 1] - slope / (2.0 * bend),
        )

    def at(self, speed: float) -> tuple[Array, BoolArray]:
        """Return the amplitudes of all cycles at a speed [m], and which of them are stable."""
        low, high = self.speed[:-1], self.speed[1:]
        inside = np.flatnonzero((low - speed) * (high - speed) <= 0.0)
        share = (speed - low[inside]) / np.where(high == low, 1.0, high - low)[inside]
        first, last = self.amplitude[inside] ** 2, self.amplitude[inside + 1] ** 2
        nearest = inside + (share > 0.5)
        return np.sqrt(first + share * (last - first)), self.stable[nearest]


def bifurcation(
    machine: Machine,
    *,
    lowest: float = 0.5,
    highest: float = 1.5,
    progress: Callable[[float], object] | None = None,
) -> Bifurcation:
    """Return the limit cycles of a machine without its imbalance, followed from its onset.

    Parameters
    ----------
    machine : Machine
        The machine, of whatever rotor.
    lowest, highest : float
        Between which speeds, over the onset's [-]; the onset lies between them.
    progress : callable or None
        Called now and then with the share done, 0 to 1. What it raises ends the work.

    Returns
    -------
    Bifurcation
        Until the cycles leave those speeds or come to within 3 % of the clearance to the wall.

    Raises
    ------
    ValueError
        Where the machine has no onset, or whirls at any speed for want of load, or the onset does
        not lie between the speeds.
    BifurcationError
        Where not even the first cycle is found.
    """
    if not 0.0 < lowest < 1.0 < highest < math.inf:
        raise ValueError(f"lowest = {lowest}, highest = {highest}: must lie on either side of 1")
    onset = hopf(machine)
    found: list[_Found] = []
    share = 0.0
    for cycle in _followed(_Balance(machine), onset):
        ratio = cycle.speed / onset.speed
        if not lowest <= ratio <= highest or len(found) == MOST_CYCLES:
            break
        found.append(_measured(machine, cycle))
        if progress is not None:
            share = max(share, found[-1].eccentricity_ratio ** 2, (ratio - 1.0) / (highest - 1.0))
            progress(share)
        if found[-1].eccentricity_ratio > _NEAREST_WALL:
            break
    if not found:
        raise BifurcationError("no limit cycle found next to the onset")
    if progress is not None:
        progress(1.0)
    return Bifurcation(
        hopf=onset,
        speed=np.array([one.cycle.speed for one in found]),
        whirl_frequency=np.array([one.cycle.speed * one.cycle.ratio for one in found]),
        amplitude=np.array([one.amplitude for one in found]),
        eccentricity_ratio=np.array([one.eccentricity_ratio for one in found]),
        multiplier=np.array([one.multiplier for one in found]),
        stable=np.array([one.multiplier < 1.0 for one in found]),
        paths=tuple(one.cycle.path * machine.bearing.radial_clearance for one in found),
    )


def sweep(branch: Bifurcation, speed: ArrayLike, *, down: bool = False) -> Array:
    """Return the amplitude that a machine reaches as its speed creeps up, or down.

    It rests up to the onset and follows a stable cycle as long as there is one; where its cycle
    ends it goes to the next one that is stable there, or comes to rest.

    Parameters
    ----------
    branch : Bifurcation
        The machine's limit cycles.
    speed : array_like, (n,)
        Rising speeds, Ω [rad/s], within those of the branch.
    down : bool
        Whether it comes down from the highest.

    Returns
    -------
    array, (n,)
        Largest distance of the journal from rest [m], 0 at rest; not a number where the machine
        cannot rest and the branch has no stable cycle.
    """
    speed = np.asarray(speed, dtype=float)
    reached = np.full(len(speed), np.nan)
    last = 10.0 * branch.hopf.clearance if down else 0.0
    for i in range(len(speed))[:: -1 if down else 1]:
        sizes, stable = branch.at(float(speed[i]))
        held = np.append(sizes[stable], [0.0] if speed[i] < branch.hopf.speed else [])
        if len(held):
            last = reached[i] = float(held[np.argmin(np.abs(held - last))])
    return reached


def start_on_cycle(machine: Machine, branch: Bifurcation, place: int) -> Start:
    """Return a state on a limit cycle, from which the motion goes round it.

    Parameters
    ----------
    machine : Machine
        The machine, without imbalance.
    branch : Bifurcation
        Its limit cycles.
    place : int
        Which of them.

    Returns
    -------
    Start
        Where the path of that cycle begins.
    """
    path, omega = branch.paths[place], float(branch.whirl_frequency[place])
    m = len(path)
    frequency = omega * _harmonics(m)
    journal: ComplexArray = np.fft.fft(path, axis=0) / m
    # The disk follows the journal by the shaft, j = (1 + s z) d, and hangs by its static sag.
    s = 1.0 / machine.rotor.shaft_stiffness
    series = 1.0 + s * _disk_impedance(machine.rotor, frequency)
    disk = journal / series[:, None]
    disk[0, 0] += machine.static_sag
    swing = 1j * frequency[:, None]
    return Start(
        journal=path[0],
        disk=np.sum(disk, axis=0).real,
        journal_velocity=np.sum(swing * journal, axis=0).real,
        disk_velocity=np.sum(swing * disk, axis=0).real,
    )


class _Cycle(NamedTuple):
    """A limit cycle: the journal's path in C, (m, 2), the whirl ratio ω/Ω, and Ω [rad/s]."""

    path: Array
    ratio: float
    speed: float

    def vector(self) -> Array:
        """Return all unknowns as one vector."""
        return np.concatenate([self.path.T.ravel(), [math.log(self.ratio), math.log(self.speed)]])

    @classmethod
    def of(cls, vector: Array) -> "_Cycle":
        """Return the cycle that a vector holds."""
        path = vector[:-2].reshape(2, -1).T
        return cls(path, math.exp(vector[-2]), math.exp(vector[-1]))

    def resampled(self, points: int) -> "_Cycle":
        """Return the same trigonometric polynomial at another, odd number of points."""
        m = len(self.path)
        half = np.fft.rfft(self.path, axis=0)[: (min(points, m) + 1) // 2]
        return self._replace(path=np.fft.irfft(half, n=points, axis=0) * (points / m))

    def tail(self) -> float:
        """Return the largest of the last eighth of the polynomial's coefficients, in C."""
        size = np.abs(np.fft.rfft(self.path, axis=0)) / len(self.path)
        return float(size[-max(len(size) // 8, 2) :].max())


class _Found(NamedTuple):
    cycle: _Cycle
    amplitude: float
    eccentricity_ratio: float
    multiplier: float


class _Balance:
    """The balance of film, rotor and load around a cycle, in the film's unit of force."""

    def __init__(self, machine: Machine) -> None:
        bearing = machine.bearing
        self.machine, self.C = machine, bearing.radial_clearance
        self.film_per_speed = machine.viscosity * bearing.radius * bearing.length**3 / self.C**2
        self.force, _ = film_motion(bearing)

    def residual(self, cycle: _Cycle) -> tuple[Array, Array]:
        """Return the residual, (2m,), and its derivatives by all unknowns, (2m, 2m + 2)."""
        m, unit = len(cycle.path), self.film_per_speed * cycle.speed
        D = _differentiation(m)
        velocity = cycle.ratio * (D @ cycle.path)
        film, by_place, by_velocity = self.film(cycle.path, velocity)
        omega = cycle.ratio * cycle.speed
        rotor, by_log = self.rotor(omega, m)
        scale = self.C / unit
        load = np.array([self.machine.static_load / unit, 0.0])
        residual = film - scale * (rotor @ cycle.path) + load
        jacobian = np.zeros((2 * m, 2 * m + 2))
        for i in (0, 1):
            rows = slice(i * m, (i + 1) * m)
            for j in (0, 1):
                block = by_velocity[:, i, j, None] * (cycle.ratio * D)
                block[np.diag_indices(m)] += by_place[:, i, j]
                jacobian[rows, j * m : (j + 1) * m] = block - (scale * rotor if i == j else 0.0)
            stiffer = scale * (by_log @ cycle.path[:, i])
            jacobian[rows, -2] = np.sum(by_velocity[:, i] * velocity, axis=-1) - stiffer
            jacobian[rows, -1] = scale * (rotor @ cycle.path[:, i]) - load[i] - stiffer
        return residual.T.ravel(), jacobian

    def rotor(self, omega: float, m: int) -> tuple[Array, Array]:
        """Return the rotor's impedance to the journal, and its derivative by ln ω, (m, m) [N/m]."""
        k = _harmonics(m)
        Z, slope = _impedance(self.machine.rotor, k * omega)
        return _circulant(Z), _circulant(slope * k * omega)

    def film(self, place: Array, velocity: Array) -> tuple[Array, Array, Array]:
        """Return the film's force, (m, 2), and its derivatives by place and velocity, (m, 2, 2)."""
        states = np.concatenate([place, velocity], axis=1)
        force = self._forces(states)
        slopes = np.empty((len(place), 2, 4))
        for j in range(4):
            step = np.zeros(4)
            step[j] = _DIFFERENCE
            ahead, behind = self._forces(states + step), self._forces(states - step)
            slopes[:, :, j] = (ahead - behind) / (2.0 * _DIFFERENCE)
        return force, slopes[:, :, :2], slopes[:, :, 2:]

    def _forces(self, states: Array) -> Array:
        return np.array([self.force(*state) for state in states.tolist()])


def _impedance(rotor: Rotor, omega: Array) -> tuple[ComplexArray, ComplexArray]:
    """Return the rotor's impedance to a journal that swings at ω, and its derivative by ω.

    Z = z/(1 + s z) − ω²M_j with z = −ω²m_d + jωC_s of the disk and s = 1/K_rot of the shaft.
    """
    s = 1.0 / rotor.shaft_stiffness
    z = _disk_impedance(rotor, omega)
    dz = -2.0 * omega * rotor.disk_mass + 1j * rotor.disk_damping
    series = 1.0 + s * z
    Z = z / series - omega**2 * rotor.journal_mass
    return Z, dz / series**2 - 2.0 * omega * rotor.journal_mass


def _disk_impedance(rotor: Rotor, omega: Array) -> ComplexArray:
    return -(omega**2) * rotor.disk_mass + 1j * omega * rotor.disk_damping


def _circulant(spectrum: ComplexArray) -> Array:
    """Return the real matrix that multiplies a periodic signal's harmonics by a spectrum."""
    m = len(spectrum)
    first = np.fft.ifft(spectrum).real
    return first[(np.arange(m)[:, None] - np.arange(m)[None, :]) % m]


def _differentiation(m: int) -> Array:
    """Return the matrix of d/dτ on m points of a period, m odd."""
    return _circulant((1j * _harmonics(m)).astype(complex))


def _harmonics(m: int) -> Array:
    """Return the orders of the harmonics that m points hold, as an FFT has them."""
    return np.fft.fftfreq(m, 1.0 / m).astype(float)


def _followed(balance: _Balance, onset: Hopf) -> Iterator[_Cycle]:
    """Yield the cycles along their branch, from the first one that is not all but at rest."""
    last = _born(balance.machine, onset)
    cycle, step = _first(balance, last, onset), _FIRST_STEP
    yield cycle
    while step >= _SHORTEST_STEP:
        last = last.resampled(len(cycle.path))
        tangent = _unit(cycle.vector() - last.vector(), len(cycle.path))
        found, steps = _corrected(balance, cycle, tangent, step)
        if found is None:
            step *= 0.4
            continue
        last, cycle = cycle, found
        yield cycle
        if steps <= 4:
            step = min(1.5 * step, _LONGEST_STEP)


def _weights(m: int) -> Array:
    """Return the weights by which unknowns enter a length: the path by its mean, and ln ω̄, ln Ω."""
    return np.concatenate([np.full(2 * m, 1.0 / m), [1.0, 1.0]])


def _unit(vector: Array, m: int) -> Array:
    return vector / math.sqrt(float(np.sum(_weights(m) * vector**2)))


def _born(machine: Machine, onset: Hopf) -> _Cycle:
    """Return the cycle of no size at the onset."""
    place = equilibrium(machine, onset.speed).film.position
    path = np.tile(place, (_FEWEST_POINTS, 1))
    return _Cycle(path, onset.whirl_frequency / onset.speed, onset.speed)


def _first(balance: _Balance, born: _Cycle, onset: Hopf) -> _Cycle:
    """Return a small cycle next to the onset, on the whirl's linear mode."""
    _, journal = whirl_plane(balance.machine, onset.speed)
    turn = np.exp(2j * np.pi * np.arange(_FEWEST_POINTS) / _FEWEST_POINTS)
    shape = np.real(turn[:, None] * journal)
    guess = born._replace(path=born.path + _FIRST_AMPLITUDE * shape)
    tangent = _unit(guess.vector() - born.vector(), _FEWEST_POINTS)
    length = float(np.sum(_weights(_FEWEST_POINTS) * tangent * (guess.vector() - born.vector())))
    cycle, _ = _corrected(balance, born, tangent, length)
    if cycle is None:
        raise BifurcationError("no limit cycle found next to the onset")
    return cycle


def _corrected(
    balance: _Balance, cycle: _Cycle, tangent: Array, step: float
) -> tuple[_Cycle | None, int]:
    """Return the cycle a step along the branch, and Newton's steps; None where there is none.

    Finer where it needs more points to be resolved.
    """
    found, steps = _newton(balance, cycle, tangent, step)
    while found is not None and found.tail() > _TAIL and len(found.path) < _MOST_POINTS:
        points = 2 * len(found.path) - 1
        cycle, m = cycle.resampled(points), len(cycle.path)
        fine = _Cycle(tangent[:-2].reshape(2, m).T, 1.0, 1.0).resampled(points)
        tangent = np.concatenate([fine.path.T.ravel(), tangent[-2:]])
        found, steps = _newton(balance, cycle, tangent, step)
    return found, steps


def _newton(
    balance: _Balance, cycle: _Cycle, tangent: Array, step: float
) -> tuple[_Cycle | None, int]:
    """Return Newton's solution of the balance, at a distance from a cycle and in phase with it."""
    m, start = len(cycle.path), cycle.vector()
    unknown: Array = start + step * tangent
    along = _weights(m) * tangent
    # A shift of the phase moves the path by dx/dτ; the guess has the phase of the solution.
    shift = (_differentiation(m) @ _Cycle.of(unknown).path).T.ravel()
    for count in range(1, _ITERATIONS + 1):
        now = _Cycle.of(unknown)
        if np.hypot(*now.path.T).max() >= 1.0:
            return None, count
        residual, jacobian = balance.residual(now)
        moved: Array = unknown - start
        rest = [float(shift @ (moved - step * tangent)[:-2]), float(along @ moved) - step]
        rows = np.vstack([jacobian, np.append(shift, [0.0, 0.0]), along])
        change: Array = np.linalg.solve(rows, -np.append(residual, rest))
        unknown = unknown + change
        if np.abs(change).max() < _SETTLED:
            return _Cycle.of(unknown), count
        if np.abs(change).max() > 0.5:
            break
    return None, _ITERATIONS


def _measured(machine: Machine, cycle: _Cycle) -> _Found:
    """Return a cycle with its size and its stability."""
    rest = equilibrium(machine, cycle.speed).film.position
    dense = cycle.resampled(4 * len(cycle.path) + 1).path
    return _Found(
        cycle=cycle,
        amplitude=float(np.hypot(*(dense - rest).T).max()) * machine.bearing.radial_clearance,
        eccentricity_ratio=float(np.hypot(*dense.T).max()),
        multiplier=_multiplier(machine, cycle),
    )


def _multiplier(machine: Machine, cycle: _Cycle) -> float:
    """Return the largest modulus of the Floquet multipliers, the one that is always 1 left out.

    The state matrix A(τ) of small motions about the cycle is integrated over its period by
    exponentials of its values in the middle of many steps (Magnus, second order, extrapolated).
    """
    fine, coarse = (
        _monodromy(machine, cycle.resampled(points * len(cycle.path))) for points in (2, 1)
    )
    values = np.linalg.eigvals(fine + (fine - coarse) / 3.0)
    rest = np.delete(values, np.argmin(np.abs(values - 1.0)))
    return float(np.abs(rest).max())


def _monodromy(machine: Machine, cycle: _Cycle) -> Array:
    balance, m = _Balance(machine), len(cycle.path)
    velocity = cycle.ratio * (_differentiation(m) @ cycle.path)
    _, by_place, by_velocity = balance.film(cycle.path, velocity)
    stiffness = balance.film_per_speed * cycle.speed / balance.C
    balanced = replace(machine.rotor, imbalance=0.0)
    A = modes.state_matrix(balanced, -stiffness * by_place, -stiffness / cycle.speed * by_velocity)
    # Each step has A in its middle; the first is cut in two, so that the period begins at τ = 0.
    step = 2.0 * np.pi / (cycle.ratio * cycle.speed * m)
    half = cast("Array", expm(A[0] * (0.5 * step)))
    steps = expm(A[1:] * step)
    product: Array = half
    for through in steps:
        product = through @ product
    return half @ product
