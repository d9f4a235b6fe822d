"""Onsets where one is known nearly: without the search over all speeds, so to be confirmed by it.

At its onset a machine's determinant changes sign, over speed as over an input. Which of several
such changes is the first, only the search from low speed tells (`onset_speed`).
"""

import math

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films import film_of
from rotorcalc.machine import Machine
from rotorcalc.numerics import routh
from rotorcalc.numerics.roots import NOTHING, narrow_roots
from rotorcalc.onset.characteristic import polynomial
from rotorcalc.onset.growth import growth
from rotorcalc.onset.search import NOISE


def edge(machine: Machine, speed: float) -> float:
    """Return a number that changes sign where the onset of a machine passes a speed.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s].

    Returns
    -------
    float
        Negative where one pair of roots has crossed the axis.

    Raises
    ------
    ValueError
        Where the film has no answer at the speed.
    """
    return float(_edges(machine, np.array([speed]))[0])


def onset_between(machine: Machine, low: float, high: float) -> float:
    """Return the onset of a machine between two near speeds.

    Parameters
    ----------
    machine : Machine
        The machine.
    low, high : float
        The speeds [rad/s].

    Returns
    -------
    float
        Where `edge` vanishes [rad/s]; NaN where it does not do so once.
    """
    noise = NOTHING if film_of(machine.bearing).frequency_dependent else NOISE

    def edges(speed: Array) -> Array:
        return _edges(machine, speed[0])[None, :]

    try:
        return float(narrow_roots(edges, np.array([low]), np.array([high]), noise=noise)[0])
    except ValueError:
        return math.nan


def _edges(machine: Machine, speed: Array) -> Array:
    if film_of(machine.bearing).frequency_dependent:
        return -growth(machine, speed, True)
    return routh.determinant(polynomial(machine, speed, True))
