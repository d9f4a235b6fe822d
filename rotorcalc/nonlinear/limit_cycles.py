"""The limit cycles of a balanced machine over speed, stable and unstable.

The cycles are found by collocation, followed from the onset by continuation, and their stability is
that of their Floquet multipliers.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, ComplexArray, IntArray
from rotorcalc.coefficients import rising_speed
from rotorcalc.display import Result
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.collocation import Balance, Cycle, harmonics
from rotorcalc.nonlinear.continuation import BifurcationError, Branch
from rotorcalc.nonlinear.equations import Start
from rotorcalc.nonlinear.film_forces import inertia_of, rest_of
from rotorcalc.nonlinear.floquet import multiplier
from rotorcalc.nonlinear.hopf import Hopf, hopf
from rotorcalc.nonlinear.rotor_impedance import disk_impedance
from rotorcalc.onset import ModeOnset, Onset

# A multiplier's imaginary part that is rounding, over its modulus.
_REAL = 1e-9


@dataclass(frozen=True)
class HeldCycle(Result):
    """A stable limit cycle at one speed.

    Attributes
    ----------
    amplitude, inner_amplitude : float
        Largest distance from equilibrium of the journal, and of a floating ring [m].
    whirl_frequency : float
        ω [rad/s].
    thinnest : float
        Thinnest film over its own clearance [-].
    """

    amplitude: float
    inner_amplitude: float
    whirl_frequency: float
    thinnest: float


@dataclass(frozen=True, eq=False)
class Bifurcation(Result):
    """Limit cycles along their branch, from the onset on; n of them.

    Attributes
    ----------
    hopf : Hopf
        The onset, where the cycles begin.
    ended : str
        Why the branch ended: "reached the highest speed asked for", or "lowest"; "came
        to within 3 % of the clearance to the wall"; "shrank to rest at another onset"; or why it
        could not be followed further.
    speed, whirl_frequency : array, (n,)
        Ω and ω [rad/s].
    amplitude : array, (n,)
        Largest distance of the journal from its equilibrium at that speed [m].
    eccentricity_ratio : array, (n,)
        Largest distance of the journal from the bearing's centre, in C [-].
    multiplier : array, (n,)
        Largest modulus of the Floquet multipliers but the one that is always 1 [-].
    stable : boolean array, (n,)
        Whether motions near the cycle approach it.
    paths : tuple of arrays, (m, 2)
        The journal's positions in X, Y around each cycle, from the bearing's centre [m].
    beats : boolean array, (n,)
        Whether the slowest small motion to decay about the cycle has a frequency of its own; a
        period doubling, at half the whirl's frequency, is included. An unstable cycle at which it
        has one is left for a motion of both frequencies at once, or for another whirl's cycle; at
        others the whirl's size changes.
    inner_amplitude : array, (n,)
        Largest distance of a floating ring from its equilibrium [m]; of another film's inner
        coordinates together. 0 where it has none.
    thinnest : array, (n,)
        Thinnest film in each cycle over its own clearance [-].
    inner_paths : tuple of arrays, (m, i)
        Positions of the i inner coordinates around each cycle [m], of a floating ring its X and Y.
    """

    hopf: Hopf
    ended: str
    speed: Array
    whirl_frequency: Array
    amplitude: Array
    eccentricity_ratio: Array
    multiplier: Array
    stable: BoolArray
    paths: tuple[Array, ...]
    beats: BoolArray
    inner_amplitude: Array
    thinnest: Array
    inner_paths: tuple[Array, ...]

    @property
    def zero_to_peak(self) -> Array:
        """Half the larger of the ranges of X and Y in each cycle [m], as probes read it, (n,)."""
        dense = (_dense(path) for path in self.paths)
        return np.array([0.5 * float(np.ptp(path, axis=0).max()) for path in dense])

    @property
    def folds(self) -> Array:
        """Speeds at which the branch turns back [rad/s], shape (folds,)."""
        return self._turns()[0]

    @property
    def fold_amplitudes(self) -> Array:
        """Amplitudes of the cycles at the folds [m], shape (folds,)."""
        return self._turns()[1]

    def _turns(self) -> tuple[Array, Array]:
        """Return the tops and bottoms of parabolas through the three cycles nearest to each.

        The onset counts as a cycle of no size: a branch may turn back at its first ones.
        """
        speed = np.concatenate([[self.hopf.speed], self.speed])
        amplitude = np.concatenate([[0.0], self.amplitude])
        step, size = np.diff(speed), np.diff(amplitude)
        turns = np.flatnonzero(step[:-1] * step[1:] < 0.0)
        before, after = step[turns] / size[turns], step[turns + 1] / size[turns + 1]
        bend = (after - before) / (size[turns] + size[turns + 1])
        slope = before + bend * size[turns]  # at the middle one of the three
        return (
            speed[turns + 1] - slope**2 / (4.0 * bend),
            amplitude[turns + 1] - slope / (2.0 * bend),
        )

    @checked
    def at(self, speed: float) -> tuple[Array, BoolArray]:
        """Return the cycles at a speed, interpolated between those found.

        Parameters
        ----------
        speed : float
            Running speed, Ω [rad/s].

        Returns
        -------
        amplitude : array, (m,)
            Largest distance of the journal from rest in each [m]; empty where there is no cycle.
        stable : boolean array, (m,)
            Whether each is stable.
        """
        inside, share = self._between(speed)
        nearest = inside + (share > 0.5)
        return self._squarely(self.amplitude, inside, share), self.stable[nearest]

    @checked
    def held_at(self, speed: float) -> HeldCycle | None:
        """Return the largest stable cycle at a speed, interpolated between those found.

        Parameters
        ----------
        speed : float
            Running speed, Ω [rad/s].

        Returns
        -------
        HeldCycle or None
            None where no cycle is stable.
        """
        inside, share = self._between(speed)
        held = self.stable[inside + (share > 0.5)]
        inside, share = inside[held], share[held]
        if not len(inside):
            return None
        sizes = self._squarely(self.amplitude, inside, share)
        largest = int(np.argmax(sizes))
        first, part = int(inside[largest]), float(share[largest])

        def along(values: Array) -> float:
            return float(values[first] + part * (values[first + 1] - values[first]))

        return HeldCycle(
            amplitude=float(sizes[largest]),
            inner_amplitude=math.sqrt(along(self.inner_amplitude**2)),
            whirl_frequency=along(self.whirl_frequency),
            thinnest=along(self.thinnest),
        )

    def _between(self, speed: float) -> tuple[IntArray, Array]:
        """Return after which cycles the branch has a speed, and where between each two."""
        low, high = self.speed[:-1], self.speed[1:]
        inside = np.flatnonzero((low - speed) * (high - speed) <= 0.0)
        return inside, (speed - low[inside]) / np.where(high == low, 1.0, high - low)[inside]

    @staticmethod
    def _squarely(values: Array, inside: IntArray, share: Array) -> Array:
        # a² is linear in Ω at the onset (a ∝ √(Ω − Ω_s)), so it is a² that is interpolated.
        first, last = values[inside] ** 2, values[inside + 1] ** 2
        return np.sqrt(first + share * (last - first))


@checked
def bifurcation(
    machine: Machine,
    *,
    lowest: float = 0.5,
    highest: float = 1.5,
    onset: Onset | ModeOnset | None = None,
    progress: Callable[[float], object] | None = None,
) -> Bifurcation:
    """Return the limit cycles of a machine without its imbalance, followed from its onset.

    Parameters
    ----------
    machine : Machine
        The machine, with any rotor.
    lowest, highest : float
        Between which speeds, over the onset's [-]; the onset lies between them.
    onset : Onset, ModeOnset or None
        Where the whirl sets in, on a floating ring one of `mode_onsets`; None for the lowest.
    progress : callable or None
        Called after each cycle with the share of the work done, 0 to 1. An exception that it
        raises ends the work.

    Returns
    -------
    Bifurcation
        Until the cycles reach a bound of the speeds, with a last one there, come to within 3 % of
        the clearance to the wall, or end otherwise; `ended` says which.

    Raises
    ------
    ValueError
        Where the onset does not lie between the speeds, and as `hopf` does.
    BifurcationError
        Where not even the first cycle is found.
    """
    if not 0.0 < lowest < 1.0 < highest < math.inf:
        raise ValueError(f"lowest = {lowest}, highest = {highest}: must lie on either side of 1")
    balance, born = Balance(machine), hopf(machine, onset=onset)
    branch = Branch(balance, born, lowest * born.speed, highest * born.speed)
    found: list[_Found] = []
    share = 0.0
    for cycle in branch:
        found.append(_measured(balance, cycle))
        if progress is not None:
            # A branch ends at the wall or at the highest speed, whichever is nearer.
            ratio = cycle.speed / born.speed
            # The amplitude grows as √(Ω − Ω_s) at first: its square keeps pace with the speed.
            nearest_wall = (1.0 - found[-1].gap) ** 2
            share = min(max(share, nearest_wall, (ratio - 1.0) / (highest - 1.0)), 1.0)
            progress(share)
    if not found:
        raise BifurcationError("no limit cycle found next to the onset")
    if progress is not None:
        progress(1.0)
    multipliers: ComplexArray = np.array([one.multiplier for one in found])
    return Bifurcation(
        hopf=born,
        ended=branch.ended,
        speed=np.array([one.cycle.speed for one in found]),
        whirl_frequency=np.array([one.cycle.speed * one.cycle.ratio for one in found]),
        amplitude=np.array([one.amplitude for one in found]),
        eccentricity_ratio=np.array([one.eccentricity_ratio for one in found]),
        multiplier=np.abs(multipliers),
        stable=np.abs(multipliers) < 1.0,
        paths=tuple(one.cycle.path[:, :2] * balance.C for one in found),
        # Of a real positive multiplier the small motion is in step with the whirl.
        beats=(multipliers.imag > _REAL * np.abs(multipliers)) | (multipliers.real < 0.0),
        inner_amplitude=np.array([one.inner_amplitude for one in found]),
        thinnest=np.array([one.gap for one in found]),
        inner_paths=tuple(one.cycle.path[:, 2:] * balance.C for one in found),
    )


@checked
def sweep(branch: Bifurcation, speed: ArrayLike, *, down: bool = False) -> Array:
    """Return the amplitude that a machine reaches as its speed slowly rises or falls.

    It stays in equilibrium up to the onset and follows a stable cycle as long as that exists; where
    the cycle ends it jumps to the nearest stable one, or returns to equilibrium.

    Parameters
    ----------
    branch : Bifurcation
        The machine's limit cycles.
    speed : array_like, (n,)
        Rising speeds, Ω [rad/s], within those of the branch.
    down : bool
        Whether the speed falls from the last of them instead.

    Returns
    -------
    array, (n,)
        Largest distance of the journal from rest [m], 0 at rest; NaN above the onset where the
        branch has no stable cycle.

    Raises
    ------
    ValueError
        Where the speeds are not a row that rises.
    """
    speed = rising_speed(speed)
    reached = np.full(len(speed), np.nan)
    # From above the sweep begins on the largest cycle: any start beyond the wall selects it.
    last = 10.0 * branch.hopf.clearance if down else 0.0
    for i in range(len(speed))[:: -1 if down else 1]:
        sizes, stable = branch.at(float(speed[i]))
        # Below the onset the equilibrium, of amplitude 0, is stable too.
        held = np.append(sizes[stable], [0.0] if speed[i] < branch.hopf.speed else [])
        if len(held):
            # Of several stable states the one nearest to the last is taken as the one reached.
            last = reached[i] = float(held[np.argmin(np.abs(held - last))])
    return reached


@checked
def start_on_cycle(machine: Machine, branch: Bifurcation, place: int) -> Start:
    """Return a state on a limit cycle, from which the motion follows the cycle.

    Parameters
    ----------
    machine : Machine
        The machine, without imbalance.
    branch : Bifurcation
        Its limit cycles.
    place : int
        Index of the cycle.

    Returns
    -------
    Start
        The state where the path of that cycle begins.

    Raises
    ------
    ValueError
        Where the branch has no such cycle.
    """
    if not 0 <= place < len(branch.paths):
        raise ValueError(f"place = {place}: must be 0 to {len(branch.paths) - 1}")
    path, inner = branch.paths[place], branch.inner_paths[place]
    frequency = float(branch.whirl_frequency[place]) * harmonics(len(path))
    journal, parts = _series(path), _series(inner)
    # The disk follows the journal by the shaft, j = (1 + s z) d, and hangs by its static sag.
    s = 1.0 / machine.rotor.shaft_stiffness
    disk = journal / (1.0 + s * disk_impedance(machine.rotor, frequency))[:, None]
    disk[0, 0] += machine.static_sag
    swing = 1j * frequency[:, None]
    # Of the inner coordinates those with a mass have a velocity among their states.
    velocities = np.sum(swing * parts, axis=0).real[inertia_of(machine.bearing) > 0.0]
    return Start(
        journal=path[0],
        disk=np.sum(disk, axis=0).real,
        journal_velocity=np.sum(swing * journal, axis=0).real,
        disk_velocity=np.sum(swing * disk, axis=0).real,
        inner=np.concatenate([inner[0], velocities]) if inner.shape[1] else None,
    )


def _series(path: Array) -> ComplexArray:
    """Return the phasors of a path's harmonics, in the order of `harmonics`."""
    return np.fft.fft(path, axis=0) / len(path)


def _dense(path: Array) -> Array:
    """Return a path with eight times as many points, by its Fourier series."""
    m = len(path)
    return np.fft.irfft(8.0 * np.fft.rfft(path, axis=0), n=8 * m, axis=0)


class _Found(NamedTuple):
    cycle: Cycle
    amplitude: float
    eccentricity_ratio: float
    gap: float
    multiplier: complex
    inner_amplitude: float


def _measured(balance: Balance, cycle: Cycle) -> _Found:
    """Return a cycle with its amplitude and its stability."""
    rest = rest_of(balance.machine, cycle.speed)
    # Denser, as largest distance and thinnest film may lie between two points.
    dense = cycle.resampled(4 * len(cycle.path) + 1).path
    return _Found(
        cycle=cycle,
        # From the equilibrium, not from the orbit's mean, as in the normal form of `hopf`.
        amplitude=_farthest((dense - rest)[:, :2]) * balance.C,
        eccentricity_ratio=_farthest(dense[:, :2]),
        gap=balance.gap(dense),
        multiplier=multiplier(balance, cycle),
        inner_amplitude=_farthest((dense - rest)[:, 2:]) * balance.C,
    )


def _farthest(path: Array) -> float:
    return float(np.linalg.norm(path, axis=1).max())
