"""Limit cycles followed from the onset by the length of their branch.

Each cycle is a step along the branch from the last, found by Newton's method on the balance of
forces, its phase and the step's length; so the branch is followed through the folds at which it
turns back.

Source: Seydel, Practical Bifurcation and Stability Analysis, third edition, section 4.4.
"""

import math
from collections.abc import Iterator

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.coefficients import equilibrium
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.collocation import Balance, Cycle, differentiation
from rotorcalc.nonlinear.hopf import Hopf, whirl_shape

# Points around a cycle to begin with and at most, always odd; doubled where the polynomial's last
# coefficients are larger than this share of the clearance.
_FEWEST_POINTS, _MOST_POINTS = 33, 257
_TAIL = 1e-6
# Newton's method: steps at most, and the size of the last one.
_ITERATIONS, _SETTLED = 8, 1e-10
_FIRST_AMPLITUDE = 0.02
_FIRST_STEP, _LONGEST_STEP, _SHORTEST_STEP = 0.02, 0.035, 1e-5


class BifurcationError(RuntimeError):
    """The limit cycles could not be followed from the onset."""


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
    journal = whirl_shape(balance.machine, onset.speed, onset.whirl_frequency)
    turn = np.exp(2j * np.pi * np.arange(_FEWEST_POINTS) / _FEWEST_POINTS)
    guess = born._replace(path=born.path + size * np.real(turn[:, None] * journal))
    away = guess.vector() - born.vector()
    length = _length(away, _FEWEST_POINTS)
    cycle, _ = _corrected(balance, born, away / length, length)
    return cycle


def followed(balance: Balance, onset: Hopf) -> Iterator[Cycle]:
    """Yield the cycles along their branch, from the first one that is not all but at rest."""
    last = _born(balance.machine, onset)
    cycle, step = small_cycle(balance, onset, _FIRST_AMPLITUDE), _FIRST_STEP
    if cycle is None:
        raise BifurcationError("no limit cycle found next to the onset")
    yield cycle
    while step >= _SHORTEST_STEP:
        last = last.resampled(len(cycle.path))
        chord = cycle.vector() - last.vector()
        tangent = chord / _length(chord, len(cycle.path))
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


def _length(vector: Array, m: int) -> float:
    return math.sqrt(float(np.sum(_weights(m) * vector**2)))


def _born(machine: Machine, onset: Hopf) -> Cycle:
    """Return the cycle of no size at the onset."""
    place = equilibrium(machine, onset.speed).film.position
    path = np.tile(place, (_FEWEST_POINTS, 1))
    return Cycle(path, onset.whirl_frequency / onset.speed, onset.speed)


def _corrected(
    balance: Balance, cycle: Cycle, tangent: Array, step: float
) -> tuple[Cycle | None, int]:
    """Return the cycle a step along the branch, and Newton's steps; None where there is none.

    Finer where it needs more points to be resolved.
    """
    found, steps = _newton(balance, cycle, tangent, step)
    while found is not None and found.tail() > _TAIL and len(found.path) < _MOST_POINTS:
        points = 2 * len(found.path) - 1
        cycle, m = cycle.resampled(points), len(cycle.path)
        fine = Cycle(tangent[:-2].reshape(2, m).T, 1.0, 1.0).resampled(points)
        tangent = np.concatenate([fine.path.T.ravel(), tangent[-2:]])
        found, steps = _newton(balance, cycle, tangent, step)
    return found, steps


def _newton(
    balance: Balance, cycle: Cycle, tangent: Array, step: float
) -> tuple[Cycle | None, int]:
    """Return Newton's solution of the balance, at a distance from a cycle and in phase with it."""
    m, start = len(cycle.path), cycle.vector()
    unknown: Array = start + step * tangent
    along = _weights(m) * tangent
    # A shift of the phase moves the path by dx/dτ; the guess has the phase of the solution.
    shift = (differentiation(m) @ Cycle.of(unknown).path).T.ravel()
    for count in range(1, _ITERATIONS + 1):
        now = Cycle.of(unknown)
        if np.hypot(*now.path.T).max() >= 1.0:
            return None, count
        residual, jacobian = balance.residual(now)
        moved: Array = unknown - start
        rest = [float(shift @ (moved - step * tangent)[:-2]), float(along @ moved) - step]
        rows = np.vstack([jacobian, np.append(shift, [0.0, 0.0]), along])
        change: Array = np.linalg.solve(rows, -np.append(residual, rest))
        unknown = unknown + change
        if np.abs(change).max() < _SETTLED:
            return Cycle.of(unknown), count
        if np.abs(change).max() > 0.5:
            break
    return None, _ITERATIONS
