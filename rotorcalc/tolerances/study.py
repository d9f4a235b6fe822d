"""The onset of a machine within the tolerances of its inputs, on machines drawn at random.

The samples are drawn at once and solved in parts. Neither depends on where the parts are computed,
so the answer is the same in one process, in several and on other machines.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import cast

import numpy as np

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, checked_speed
from rotorcalc.coefficients import equilibrium
from rotorcalc.display import Result
from rotorcalc.films import film_of
from rotorcalc.machine import Machine
from rotorcalc.numerics.parts import in_parts
from rotorcalc.onset.closed_form import covers
from rotorcalc.onset.judge import is_unstable
from rotorcalc.onset.many import onset_speeds
from rotorcalc.tolerances.spreads import drawn
from rotorcalc.tolerances.statistics import Influence, Probability, influence, probability
from rotorcalc.variation import address, maker

# Machines of a part. In closed form thousands are solved at once; of any other film each may need a
# table of its own, and a part of many would keep the others waiting.
_CLOSED, _OTHERS = 10_000, 250
# Parts at least, so that several processes have something to do; in closed form none of fewer than
# so many, which take a few hundredths of a second.
_PARTS, _FEWEST = 16, 1000
# And of machines on the short film, whose onsets are searched together.
_FEWEST_SHORT = 25
# Ten million samples of ten inputs are a gigabyte.
MOST_SAMPLES = 10_000_000
# What a film that has no answer raises.
_NO_ANSWER = (ValueError, RuntimeError)


@dataclass(frozen=True, eq=False)
class Tolerance(Result):
    """Onset and margin of machines drawn within spreads.

    Attributes
    ----------
    machine : Machine
        The machine whose inputs spread.
    fields : tuple of str
        The inputs that do, k.
    seed : int
        Of the draws.
    speed : float
        Running speed, Ω [rad/s]; NaN where none was given.
    values : array, (samples, k)
        The inputs of each sample, in SI.
    onset : array, (samples,)
        Onset speed, Ω_s [rad/s]; infinite where there is none, NaN where the film has no answer.
    margin : array, (samples,)
        Onset speed over running speed, less 1 [-]; NaN without a running speed.
    unstable : boolean array, (samples,)
        Whether some mode grows at the running speed; False without one.
    answered : boolean array, (samples,)
        Whether the film has an answer, at the onset and at the running speed.
    refusals : tuple of str
        Reasons why some have none, each once.
    """

    machine: Machine
    fields: tuple[str, ...]
    seed: int
    speed: float
    values: Array
    onset: Array
    margin: Array
    unstable: BoolArray
    answered: BoolArray
    refusals: tuple[str, ...]

    @property
    def probability_unstable(self) -> Probability:
        """Probability that the machine is unstable at the running speed, with its 95 % interval.

        Raises
        ------
        ValueError
            Where no running speed was given.
        """
        if math.isnan(self.speed):
            raise ValueError("speed: none was given; tolerance(..., speed=...) asks at a speed")
        unknown = int(np.count_nonzero(~self.answered))
        return probability(int(np.count_nonzero(self.unstable)), unknown, len(self.onset))

    @property
    def influences(self) -> tuple[Influence, ...]:
        """First-order index of each input for the onset, the largest first (`statistics`).

        NaN where a sample has no finite onset: an infinite one has no variance.
        """
        found = [
            influence(field, self.values[:, i], self.onset) for i, field in enumerate(self.fields)
        ]
        return tuple(sorted(found, key=lambda one: one.index, reverse=True))


@checked
def tolerance(  # noqa: PLR0913 - what to draw, how many, and where to compute it
    machine: Machine,
    spreads: Mapping[str, object],
    samples: int = 10_000,
    seed: int = 0,
    executor: Executor | None = None,
    *,
    speed: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Tolerance:
    """Return the onset of machines drawn within the spreads of their inputs.

    Parameters
    ----------
    machine : Machine
        The machine; the inputs that do not spread are as they are.
    spreads : mapping of str to tuple
        Inputs, "bearing.geometry.preload" or "radial_clearance", and their distributions in SI:
        ("uniform", low, high), ("normal", mean, deviation[, low, high]), ("triangular", low, mode,
        high) or ("lognormal", median, ratio). Inputs are independent of one another.
    samples : int
        How many machines.
    seed : int
        The same seed draws the same machines; the first of them are the same for more samples.
    executor : concurrent.futures.Executor, optional
        Computes parts at the same time: a process pool, or a Dask client's `get_executor()` for
        many machines. Any gives the same answer.
    speed : float, optional
        Running speed, Ω [rad/s], positive, for margin and probability.
    progress : callable, optional
        Called with the share that is done, from above 0 to 1.

    Returns
    -------
    Tolerance
        A value of each sample.

    Raises
    ------
    ValueError
        Where there is no such input or distribution, or some samples are no valid machine: how
        many, and why the first is none. Nothing is left out or moved to a bound.
    """
    if not 1 <= samples <= MOST_SAMPLES:
        raise ValueError(f"samples = {samples}: must be between 1 and {MOST_SAMPLES}")
    if seed < 0:
        raise ValueError(f"seed = {seed}: must be at least 0")
    running = math.nan if speed is None else float(checked_speed(speed))
    paths = _paths(machine, spreads)
    fields = tuple(map(".".join, paths))
    values = np.empty((samples, len(fields)))
    for i, (field, spread) in enumerate(zip(fields, spreads.values(), strict=True)):
        values[:, i] = drawn(field, spread, samples=samples, seed=seed)
    parts = list(_parts(machine, paths, values, running))
    each = in_parts(solved, parts, executor=executor, progress=progress)
    found = [_accepted(one, part) for one, part in zip(each, parts, strict=True)]
    onset = np.concatenate([one.onset for one in found])
    return Tolerance(
        machine=machine, fields=fields, seed=int(seed), speed=running, values=values, onset=onset,
        margin=onset / running - 1.0,
        unstable=np.concatenate([one.unstable for one in found]),
        answered=np.concatenate([one.answered for one in found]),
        refusals=tuple(dict.fromkeys(words for one in found for words in one.refusals)),
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Part:
    """Some samples: the machine, and other values, (n, k), at k paths from a first sample on."""

    machine: Machine
    paths: tuple[tuple[str, ...], ...]
    values: Array
    speed: float
    first: int

    def machines(self) -> Iterator[Machine]:
        """Yield the machine of each sample; raises ValueError where one is no valid machine."""
        yield from map(maker(self.machine, self.paths), self.values.tolist())


@dataclass(frozen=True, eq=False)
class Solved:
    """What `Tolerance` has of the samples of a part; `invalid` counts those that are no machine."""

    onset: Array
    unstable: BoolArray
    answered: BoolArray
    refusals: tuple[str, ...] = ()
    invalid: int = 0


def solved(part: Part) -> Solved:
    """Return the onsets of a part's machines; of none of them where some are no machine."""
    try:
        machines = list(part.machines())
    except ValueError:
        return _invalid(part)
    refusals: list[str] = []
    onset = _onsets(machines, refusals)
    unstable, answered = np.zeros(onset.shape, dtype=bool), ~np.isnan(onset)
    if all(map(_in_closed_form, machines)):
        # An undamped rotor stays unstable above its onset, and its film has an answer everywhere.
        unstable = onset < part.speed
    elif not math.isnan(part.speed):
        for i in np.flatnonzero(answered):
            unstable[i], answered[i] = _judged(machines[i], part.speed, onset[i], refusals)
    return Solved(onset, unstable, answered, tuple(dict.fromkeys(refusals)))


def _in_closed_form(machine: Machine) -> bool:
    return covers(machine) and machine.supply is None


def _judged(machine: Machine, speed: float, onset: float, refusals: list[str]) -> tuple[bool, bool]:
    """Return whether a machine is unstable at a speed, and whether its film has an answer there."""
    try:
        equilibrium(machine, speed)
        return onset < speed and bool(is_unstable(machine, speed)), True
    except _NO_ANSWER as error:
        refusals.append(str(error))
        return False, False


def _onsets(machines: list[Machine], refusals: list[str]) -> Array:
    """Return onsets, NaN where a film has no answer."""
    try:
        return onset_speeds(machines)
    except _NO_ANSWER as error:
        if len(machines) == 1:
            refusals.append(str(error))
            return np.array([math.nan])
    # Halves, so that the few without an answer cost the others little.
    middle = len(machines) // 2
    return np.concatenate(
        [_onsets(half, refusals) for half in (machines[:middle], machines[middle:])]
    )


def _invalid(part: Part) -> Solved:
    """Return how many of a part's samples are no machine, and why the first is none."""
    words: list[str] = []
    for i, row in enumerate(part.values):
        one = Part(part.machine, part.paths, row[None, :], part.speed, part.first + i)
        try:
            list(one.machines())
        except ValueError as error:
            words.append(f"sample {one.first + 1}: {error}")
    nothing = np.zeros(0)
    return Solved(nothing, nothing > 0.0, nothing > 0.0, tuple(words[:1]), len(words))


def _accepted(found: Solved, part: Part) -> Solved:
    if found.invalid:
        among = part.first + len(part.values)
        raise ValueError(
            f"spreads: {found.invalid} of samples {part.first + 1} to {among} are no valid "
            f"machine, the first {found.refusals[0]}. A narrower spread, or a normal one cut off "
            "at two bounds, draws none such"
        )
    return found


def _paths(machine: Machine, spreads: Mapping[str, object]) -> tuple[tuple[str, ...], ...]:
    if not spreads:
        raise ValueError("spreads: none given; name an input and its distribution")
    paths: list[tuple[str, ...]] = []
    for name in cast("Mapping[object, object]", spreads):
        if not isinstance(name, str):
            raise ValueError(f"spreads: {name!r}: must be the name of an input")
        path = address(machine, name)
        if path in paths:
            raise ValueError(f"spreads: {'.'.join(path)!r}: given twice")
        paths.append(path)
    return tuple(paths)


def _parts(
    machine: Machine, paths: tuple[tuple[str, ...], ...], values: Array, speed: float
) -> Iterator[Part]:
    damped = ("rotor", "disk_damping") in paths
    closed = _in_closed_form(machine) and not damped
    size = min(_CLOSED if closed else _OTHERS, math.ceil(len(values) / _PARTS))
    if closed:
        size = max(size, _FEWEST)
    elif film_of(machine.bearing).curve == "short" and machine.supply is None:
        size = max(size, _FEWEST_SHORT)
    for first in range(0, len(values), size):
        yield Part(machine, paths, values[first : first + size], speed, first)
