"""Continuation of limit cycles from the onset, by pseudo-arclength.

Each cycle is one step along the branch from the last, found by Newton's method on the balance of
forces, a condition for its phase and the step's length; so the branch is followed through the folds
at which it turns back.

Source: Seydel, Practical Bifurcation and Stability Analysis, third edition, section 4.4.
"""

import math
from collections.abc import Iterator

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.collocation import Balance, Cycle, differentiation
from rotorcalc.nonlinear.film_forces import rest_of
from rotorcalc.nonlinear.hopf import Hopf, whirl_shape

# Points around a cycle at first and at most, always odd; doubled where the polynomial's last
# coefficients are larger than this share of the clearance.
_FEWEST_POINTS, _MOST_POINTS = 33, 257
_TAIL = 1e-6
# Newton's method: steps at most, and the largest change at convergence.
_ITERATIONS, _SETTLED = 10, 1e-9
# Sizes of the first cycle, in C, tried in turn; below the last a cycle is the equilibrium.
_FIRST_SIZES, _AT_REST = (0.02, 0.005, 0.001), 1e-4
# Lengths of a step along the branch; it grows after a step in which Newton's method was fast.
_FIRST_STEP, _LONGEST_STEP, _SHORTEST_STEP = 0.02, 0.035, 1e-5
_FEW, _LONGER, _SHORTER = 6, 1.5, 0.4
# A step that leaves the tangent so far that it is longer than this share of it may have reached
# another part of the branch; it is shortened, down to a length at which it cannot.
_TURNS, _NO_JUMP = 1.1, 1e-3
# Minimum film over clearance at which a branch ends: the limit that `validity` sets.
_NEAREST_WALL = 0.03
# Why a branch ended that has no cycles beyond its last one.
AT_REST = "shrank to rest at another onset"
# Known branches have fewer cycles; the bound only stops a branch that never ends.
_MOST_CYCLES = 2000


class BifurcationError(RuntimeError):
    """The limit cycles could not be followed from the onset."""


class Branch:
    """The limit cycles of a machine, one after the other along their branch from the onset.

    Parameters
    ----------
    balance : Balance
        The balance of the machine's forces.
    onset : Hopf
        Its onset.
    lowest, highest : float
        Speeds between which to follow it, Ω [rad/s].

    Attributes
    ----------
    ended : str
        Why the branch ended; empty until then.
    """

    def __init__(self, balance: Balance, onset: Hopf, lowest: float, highest: float) -> None:
        self.balance, self.onset = balance, onset
        self.lowest, self.highest = lowest, highest
        self.ended = ""

    def __iter__(self) -> Iterator[Cycle]:
        """Yield the cycles, the last one at the bound of the speeds where the branch reaches it."""
        last, step = _born(self.balance.machine, self.onset), _FIRST_STEP
        cycle = self._first()
        for _ in range(_MOST_CYCLES):
            # Past a bound the branch ends with the cycle exactly at it.
            bounded = min(max(cycle.speed, self.lowest), self.highest)
            if bounded != cycle.speed:
                word = "highest" if bounded == self.highest else "lowest"
                self.ended = f"reached the {word} speed asked for"
                cycle = _at_speed(self.balance, last, cycle, bounded)
                if cycle is not None:
                    yield cycle
                return
            yield cycle
            after, step = self._next(last, cycle, step)
            if after is None:
                return
            last, cycle = cycle, after
        self.ended = f"has more than {_MOST_CYCLES} cycles"

    def _first(self) -> Cycle:
        for size in _FIRST_SIZES:
            cycle = small_cycle(self.balance, self.onset, size)
            if cycle is not None:
                return cycle
        raise BifurcationError("no limit cycle found next to the onset")

    def _next(self, last: Cycle, cycle: Cycle, step: float) -> tuple[Cycle | None, float]:
        """Return the next cycle and the step after it; None, and the reason kept, at the end."""
        if self.balance.gap(cycle.path) < _NEAREST_WALL:
            self.ended = (
                f"came to within {100.0 * _NEAREST_WALL:.0f} % of the clearance to the wall"
            )
            return None, step
        last = last.resampled(len(cycle.path))
        # The secant through the last two cycles stands for the tangent.
        chord = cycle.vector() - last.vector()
        tangent = chord / _length(chord, cycle.path.shape)
        while step >= _SHORTEST_STEP:
            found, steps = _corrected(self.balance, cycle, tangent, step)
            if found is None or (step > _NO_JUMP and _length_between(cycle, found) > _TURNS * step):
                step *= _SHORTER
            elif _through_rest(cycle, found):
                self.ended = AT_REST
                return None, step
            else:
                return found, min(_LONGER * step, _LONGEST_STEP) if steps <= _FEW else step
        self.ended = "was lost: Newton's method finds no next cycle, however near"
        return None, step


def small_cycle(balance: Balance, onset: Hopf, size: float) -> Cycle | None:
    """Return a small cycle next to the onset, found from the whirl's linear mode.

    Parameters
    ----------
    balance : Balance
        The balance of the machine's forces.
    onset : Hopf
        Its onset.
    size : float
        Largest distance from rest of the linear whirl from which the search starts, in C.

    Returns
    -------
    Cycle or None
        The cycle as far from rest, by the length of the branch; None where the search fails.
    """
    born = _born(balance.machine, onset)
    shape = whirl_shape(balance.machine, onset.speed, onset.whirl_frequency)
    turn = np.exp(2j * np.pi * np.arange(_FEWEST_POINTS) / _FEWEST_POINTS)
    guess = born._replace(path=born.path + size * np.real(turn[:, None] * shape))
    away = guess.vector() - born.vector()
    length = _length(away, born.path.shape)
    cycle, _ = _corrected(balance, born, away / length, length)
    return cycle


def _through_rest(cycle: Cycle, after: Cycle) -> bool:
    """Return whether the next cycle is the equilibrium, or beyond it with the opposite phase."""
    now, then = (_around_mean(one.resampled(_FEWEST_POINTS).path) for one in (cycle, after))
    return float(np.sum(now * then)) <= 0.0 or float(np.abs(then).max()) < _AT_REST


def _around_mean(path: Array) -> Array:
    return path - path.mean(axis=0)


def _weights(shape: tuple[int, ...]) -> Array:
    """Return the weights of the unknowns in a length: mean over the path, and ln ω̄, ln Ω."""
    m, d = shape
    return np.concatenate([np.full(d * m, 1.0 / m), [1.0, 1.0]])


def _length(vector: Array, shape: tuple[int, ...]) -> float:
    return math.sqrt(float(np.sum(_weights(shape) * vector**2)))


def _length_between(cycle: Cycle, after: Cycle) -> float:
    """Return the length of the branch between two cycles."""
    m = max(len(cycle.path), len(after.path))
    one, other = cycle.resampled(m), after.resampled(m)
    return _length(other.vector() - one.vector(), other.path.shape)


def _born(machine: Machine, onset: Hopf) -> Cycle:
    """Return the cycle of zero amplitude at the onset."""
    path = np.tile(rest_of(machine, onset.speed), (_FEWEST_POINTS, 1))
    return Cycle(path, onset.whirl_frequency / onset.speed, onset.speed)


def _corrected(
    balance: Balance, cycle: Cycle, tangent: Array, step: float
) -> tuple[Cycle | None, int]:
    """Return the cycle one step along the branch, and Newton's steps; None without convergence.

    With more points where the polynomial needs them.
    """
    found, steps = _newton(balance, cycle, tangent, step, _weights(cycle.path.shape) * tangent)
    while found is not None and found.tail() > _TAIL and len(found.path) < _MOST_POINTS:
        # Less one, so that the number stays odd.
        points = 2 * len(found.path) - 1
        (m, d), cycle = cycle.path.shape, cycle.resampled(points)
        fine = Cycle(tangent[:-2].reshape(d, m).T, 1.0, 1.0).resampled(points)
        tangent = np.concatenate([fine.path.T.ravel(), tangent[-2:]])
        found, steps = _newton(balance, cycle, tangent, step, _weights(cycle.path.shape) * tangent)
    return found, steps


def _at_speed(balance: Balance, before: Cycle, after: Cycle, speed: float) -> Cycle | None:
    """Return the cycle at a speed between two others; None where it is not found."""
    start = before.resampled(len(after.path))
    chord = after.vector() - start.vector()
    along = np.zeros_like(chord)
    along[-1] = 1.0
    found, _ = _newton(balance, start, chord / chord[-1], math.log(speed / start.speed), along)
    # The speed exactly as given, without the logarithm's rounding.
    return None if found is None else found._replace(speed=speed)


def _newton(
    balance: Balance, cycle: Cycle, tangent: Array, step: float, along: Array
) -> tuple[Cycle | None, int]:
    """Return Newton's solution of the balance, a step from a cycle and in phase with the guess.

    The step is measured by the unknowns' weights `along`.
    """
    (m, d), start = cycle.path.shape, cycle.vector()
    unknown: Array = start + step * tangent
    # A shift of the phase moves the path by dx/dτ; the guess has the phase of the solution.
    shift = (differentiation(m) @ Cycle.of(unknown, d).path).T.ravel()
    for count in range(1, _ITERATIONS + 1):
        now = Cycle.of(unknown, d)
        if balance.gap(now.path) <= 0.0:
            return None, count
        residual, jacobian = balance.residual(now)
        moved: Array = unknown - start
        rest = [float(shift @ (moved - step * tangent)[:-2]), float(along @ moved) - step]
        # dm equations of balance, one for the phase and one for the step, in dm + 2 unknowns.
        rows = np.vstack([jacobian, np.append(shift, [0.0, 0.0]), along])
        change: Array = np.linalg.solve(rows, -np.append(residual, rest))
        unknown = unknown + change
        if np.abs(change).max() < _SETTLED:
            return Cycle.of(unknown, d), count
        if np.abs(change).max() > 0.5:  # half a clearance, or half of ω̄ or Ω: it diverges
            break
    return None, _ITERATIONS
