"""What one input does, all others as they are: onset, margin, damping and film over its values.

An input is named by its field, "radial_clearance" or "bearing.geometry.preload".
"""

import math
from collections.abc import Callable
from concurrent.futures import Executor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc import modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, checked_speed, real_array
from rotorcalc.coefficients import Equilibrium, dynamics, equilibrium
from rotorcalc.display import Result
from rotorcalc.films import film_of
from rotorcalc.machine import Machine
from rotorcalc.numerics.parts import in_parts
from rotorcalc.onset.closed_form import covers
from rotorcalc.onset.eigenvalues import certain_eigenvalues, eigenvalues_of
from rotorcalc.onset.many import onset_speeds
from rotorcalc.variation import address, changed

# Values that are solved together, so that progress can be told; in closed form they are quick.
_TOGETHER, _CLOSED = 8, 64


@dataclass(frozen=True, eq=False)
class InputSweep(Result):
    """A machine over the values of one input.

    Attributes
    ----------
    field : str
        The input.
    speed : float
        Running speed, Ω [rad/s].
    values : array, (n,)
        Its values in SI.
    onset : array, (n,)
        Onset speed, Ω_s [rad/s]; infinite where there is none.
    margin : array, (n,)
        Onset speed over running speed, less 1 [-].
    log_decrement : array, (n,)
        Smallest logarithmic decrement of an oscillating mode at the running speed [-]; infinite
        where none oscillates.
    minimum_film_thickness : array, (n,)
        Smallest film at the running speed, h_min [m].

    Everywhere NaN where a value is no valid machine, or its film has no answer.
    """

    field: str
    speed: float
    values: Array
    onset: Array
    margin: Array
    log_decrement: Array
    minimum_film_thickness: Array


@checked
def input_sweep(  # noqa: PLR0913 - an input with its values, and where to compute
    machine: Machine,
    *,
    vary: str,
    values: ArrayLike,
    speed: float,
    executor: Executor | None = None,
    progress: Callable[[float], object] | None = None,
) -> InputSweep:
    """Return a machine over the values of one input.

    Parameters
    ----------
    machine : Machine
        The machine.
    vary : str
        The input, "bearing.radial_clearance" or "radial_clearance".
    values : array_like, (n,)
        Its values in SI.
    speed : float
        Running speed, Ω [rad/s], positive.
    executor : concurrent.futures.Executor, optional
        Computes values at the same time.
    progress : callable, optional
        Called with the share that is done, from above 0 to 1.

    Returns
    -------
    InputSweep
        A number for each value.

    Raises
    ------
    ValueError
        Where there is no such input, the values are no list, or the speed is not positive.
    """
    running = float(checked_speed(speed))
    given = real_array("values", values)
    if given.ndim != 1 or not given.size:
        raise ValueError(f"values: must be a list, (n,), has the shape {given.shape}")
    solved = partial(_solved, machine, address(machine, vary), running)
    size = _CLOSED if covers(machine) and machine.supply is None else _TOGETHER
    parts = [given[first : first + size] for first in range(0, len(given), size)]
    found = np.concatenate(list(in_parts(solved, parts, executor=executor, progress=progress)))
    onset, decrement, film = found.T
    return InputSweep(
        field=vary, speed=running, values=given, onset=onset, margin=onset / running - 1.0,
        log_decrement=decrement, minimum_film_thickness=film,
    )  # fmt: skip


def _solved(machine: Machine, path: tuple[str, ...], speed: float, values: Array) -> Array:
    """Return onset, log decrement and smallest film for each value, (n, 3)."""
    found = np.full((len(values), 3), np.nan)
    answered: list[int] = []
    machines: list[Machine] = []
    rests: list[Equilibrium] = []
    for i, value in enumerate(values.tolist()):
        with suppress(ValueError):
            one = changed(machine, {path: value})
            rests.append(equilibrium(one, speed))
            machines.append(one)
            answered.append(i)
    found[answered, 0] = _onsets(machines)
    found[answered, 1] = _decrements(machines, rests)
    found[answered, 2] = [float(rest.minimum_film_thickness) for rest in rests]
    found[np.isnan(found[:, :2]).any(axis=1)] = np.nan  # no number where the onset has none
    return found


def _decrements(machines: list[Machine], rests: list[Equilibrium]) -> Array:
    """Return log decrements; those of one rotor on films of K and C together."""
    is_plain = not any(film_of(one.bearing).frequency_dependent for one in machines)
    if not machines or not is_plain or len({one.rotor for one in machines}) > 1:
        return np.array([_decrement(*one) for one in zip(machines, rests, strict=True)])
    K = np.stack([rest.stiffness for rest in rests])
    C = np.stack([rest.damping for rest in rests])
    try:
        values = eigenvalues_of(machines, float(rests[0].speed), K, C)
    except ValueError:
        return np.array([_decrement(*one) for one in zip(machines, rests, strict=True)])
    return modes.smallest_decrement(values)


def _decrement(machine: Machine, rest: Equilibrium) -> float:
    """Return the log decrement of a machine, NaN where its eigenvalues are not known."""
    try:
        film = dynamics(machine, rest.speed)
        values = certain_eigenvalues(machine, rest.speed, film, flexible=True)
    except ValueError:
        return math.nan
    return float(modes.smallest_decrement(values))


def _onsets(machines: list[Machine]) -> Array:
    """Return onsets, all together where each has one; NaN where a film has no answer."""
    try:
        return onset_speeds(machines)
    except ValueError:
        return np.concatenate([_onset(one) for one in machines])


def _onset(machine: Machine) -> Array:
    try:
        return onset_speeds([machine])
    except ValueError:
        return np.array([np.nan])
