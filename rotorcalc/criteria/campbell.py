"""The Campbell diagram: frequency, damping and direction of every mode over running speed.

A mode whirls forward where its orbit turns with the shaft. A forward mode is driven by imbalance
where its frequency is the running speed, ω = Ω; a film drives one near half of it, ω = Ω/2, the
line of oil whirl.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc import modes
from rotorcalc.analysis import analyse
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, ComplexArray, IntArray
from rotorcalc.coefficients import rising_speed
from rotorcalc.display import Result
from rotorcalc.machine import Machine
from rotorcalc.root_locus import root_locus


@dataclass(frozen=True, eq=False)
class Campbell(Result):
    """The modes of a machine over running speed, a column a mode.

    Attributes
    ----------
    speed : array, (n,)
        Ω [rad/s].
    eigenvalue : complex array, (n, m)
        λ [1/s], Im λ ≥ 0; NaN where another column has the conjugate.
    frequency : array, (n, m)
        ω = Im λ [rad/s]; NaN where the mode does not oscillate.
    log_decrement : array, (n, m)
        δ [-]; NaN where the mode does not oscillate.
    forward : boolean array, (n, m)
        Whether the mode's orbit turns with the shaft; False too where it does not oscillate.
    crossing_speed : array, (k,)
        Speeds at which a mode's frequency is the running speed, rising, between the speeds given
        by interpolation [rad/s].
    crossing_mode : integer array, (k,)
        The columns of these modes.
    """

    speed: Array
    eigenvalue: ComplexArray
    frequency: Array
    log_decrement: Array
    forward: BoolArray
    crossing_speed: Array
    crossing_mode: IntArray


@checked
def campbell(machine: Machine, speed: ArrayLike, *, flexible: bool = True) -> Campbell:
    """Return the modes of a machine over running speed.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (n,)
        Rising speeds, Ω [rad/s].
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    Campbell
        Each mode followed over the speeds.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite, or they do not rise.
    """
    sweep = analyse(machine, rising_speed(speed))
    shapes = sweep.mode_shapes(flexible=flexible)
    last = modes.ModeShapes(
        eigenvalues=shapes.eigenvalues[-1],
        vectors=shapes.vectors[-1],
        disk=shapes.disk[-1],
        journal=shapes.journal[-1],
        inner=shapes.inner[-1],
    )
    locus = root_locus(
        sweep.speed,
        sweep.branches(flexible=flexible),
        running_speed=float(sweep.speed[-1]),
        shapes=last,
        bearing=machine.bearing,
    )
    values = locus.branches
    waves = values.imag > 0.0
    frequency = np.where(waves, values.imag, np.nan)
    decrement = modes.logarithmic_decrement(np.where(waves, values, 1j))
    crossing_speed, crossing_mode = _crossings(sweep.speed, frequency)
    return Campbell(
        speed=sweep.speed,
        eigenvalue=values,
        frequency=frequency,
        log_decrement=np.where(waves, decrement, np.nan),
        forward=waves & _turns_forward(values, shapes),
        crossing_speed=crossing_speed,
        crossing_mode=crossing_mode,
    )


def _turns_forward(values: ComplexArray, shapes: modes.ModeShapes) -> BoolArray:
    """Return whether the orbits of modes (n, m) turn with the shaft: disk's or journal's.

    That of the two which moves more: the other may stand near a node, where the sense changes.
    """
    distance = np.abs(shapes.eigenvalues[:, None, :] - values[..., None])
    place = np.argmin(np.where(np.isnan(distance), np.inf, distance), axis=-1)[..., None]
    sides: list[tuple[Array, Array]] = []
    for body in (shapes.disk, shapes.journal):
        x, y = np.moveaxis(np.take_along_axis(body, place, axis=1), -1, 0)
        # |f| and |b| of the forward and the backward circle that make up the ellipse.
        sides.append((np.abs(x + 1j * y), np.abs(x - 1j * y)))
    (f_d, b_d), (f_j, b_j) = sides
    return np.where(f_d + b_d >= f_j + b_j, f_d > b_d, f_j > b_j)


def _crossings(speed: Array, frequency: Array) -> tuple[Array, IntArray]:
    """Return where frequencies (n, m) cross the running speed, and whose, each (k,)."""
    above = frequency - speed[:, None]
    known = np.isfinite(above[:-1]) & np.isfinite(above[1:])
    i, j = np.nonzero(known & ((above[:-1] > 0.0) != (above[1:] > 0.0)))
    share = above[i, j] / (above[i, j] - above[i + 1, j])
    found = speed[i] + share * (speed[i + 1] - speed[i])
    order = np.argsort(found)
    return found[order], j[order]
