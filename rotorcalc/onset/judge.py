"""Whether a machine is stable: the single criterion for onset, unstable ranges and charts.

An undamped rotor is unstable where its mass exceeds the film's limit (`closed_form`). For any other
the characteristic polynomial decides, in floats where rounding cannot matter, else in sixty digits.
Eigenvalues are not used: the error of each is a rounding error of the fastest.
"""

import itertools

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc import heat, modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray
from rotorcalc.coefficients import checked_speed, rising_speed, stiffness_and_damping
from rotorcalc.films import film_of
from rotorcalc.machine import Machine, Rotor
from rotorcalc.numerics import routh
from rotorcalc.onset.characteristic import ExactPolynomial
from rotorcalc.onset.closed_form import closed_form_onset, covers, excess_mass
from rotorcalc.onset.growth import growth
from rotorcalc.onset.search import crossing, humps, search_speeds
from rotorcalc.onset.whirl import Onset, whirl_onset


@checked
def is_unstable(
    machine: Machine,
    speed: ArrayLike,
    *,
    film: tuple[Array, Array] | None = None,
    flexible: bool = True,
) -> BoolArray:
    """Return whether some mode of a machine grows.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.
    film : pair of arrays, (..., 2, 2), optional
        The film's stiffness [N/m] and damping [N·s/m] at these speeds, where they are known.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    boolean array, (...)
        Where the machine is unstable.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    speeds = checked_speed(speed)
    film_model = film_of(machine.bearing)
    if not film_model.can_whirl:
        return np.zeros(speeds.shape, dtype=bool)
    if film_model.frequency_dependent:
        return growth(machine, speeds, flexible) > 0.0
    K, C = stiffness_and_damping(machine, speeds) if film is None else film
    if covers(machine):
        return _is_too_heavy(machine.rotor, speeds, K, C, flexible=flexible)
    return _margins(machine, speeds, K, C, flexible=flexible) > 0.0


@checked
def unstable_ranges(machine: Machine, speed: ArrayLike, *, onset: Onset | None = None) -> Array:
    """Return the ranges of speed in which some mode of a machine grows.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (n,)
        Rising speeds, Ω [rad/s]: the first and last bound the ranges, the others refine the search.
    onset : Onset, optional
        The machine's onset, where it is known: that of an undamped rotor need not be solved again.

    Returns
    -------
    array, (m, 2)
        First and last speed of each range [rad/s], to the digits of `onset_speed`. Ranges narrower
        than the spacing of the speeds are found as the search for an onset finds them.

    Raises
    ------
    ValueError
        Where the speeds are not positive and finite, in one row, and rising.
    """
    speeds = rising_speed(speed)
    film = film_of(machine.bearing)
    if not film.can_whirl:
        return np.empty((0, 2))
    if covers(machine) and (machine.supply is None or machine.supply.flow == 0.0):
        # A and B rise with speed, so an undamped rotor stays unstable above its onset. A flow
        # through the grooves cools slow machines more: there σ may fall again as the speed rises.
        first = max((onset or closed_form_onset(machine)).speed, speeds[0])
        return np.array([[first, speeds[-1]]] if first < speeds[-1] else np.empty((0, 2)))
    searched = search_speeds(machine)
    searched = searched[(searched > speeds[0]) & (searched < speeds[-1])]
    speeds = np.union1d(speeds, searched[heat.has_film(machine, searched)])

    def margins(speed: Array) -> Array:
        if film.frequency_dependent:
            return growth(machine, speed, True)
        return _margins(machine, speed, *stiffness_and_damping(machine, speed))

    found = margins(speeds)
    # The top of a hump splits an unseen range into two edges that the search below refines.
    hidden = [top for _, top in humps(margins, speeds, found)]
    speeds, order = np.unique(np.append(speeds, hidden), return_index=True)
    unstable = np.append(found > 0.0, np.ones(len(hidden), dtype=bool))[order]
    edges = [
        crossing(machine, *((a, b) if grows else (b, a)))
        for (a, b), grows, changes in zip(
            itertools.pairwise(speeds.tolist()), unstable[1:], unstable[1:] != unstable[:-1],
            strict=True,
        )
        if changes
    ]  # fmt: skip
    ends = [*speeds[:1][unstable[:1]], *edges, *speeds[-1:][unstable[-1:]]]
    return np.array(ends).reshape(-1, 2)


def _margins(machine: Machine, speed: Array, K: Array, C: Array, *, flexible: bool = True) -> Array:
    """Return `routh.margin` of a machine at speeds (...), with certain sign."""
    least, most = routh.margin_bounds(
        modes.characteristic_polynomial(machine.rotor, K, C, flexible=flexible)
    )
    margins = np.array(most)
    doubt = (least < 0.0) & (most > 0.0)
    if np.any(doubt):
        margins[doubt] = ExactPolynomial(machine, flexible).margins(speed[doubt])
    return margins


def _is_too_heavy(rotor: Rotor, speed: Array, K: Array, C: Array, *, flexible: bool) -> BoolArray:
    """Return whether an undamped rotor exceeds the film's critical mass, shape of `speed`."""
    film = whirl_onset(K, C * speed[..., None, None])  # K_eq, and p_s² as M_c Ω²
    with np.errstate(divide="ignore"):  # without load the critical mass is zero
        A = rotor.half_mass * speed**2 / film.critical_mass
    B = flexible * (film.whirl_ratio * speed) ** 2 * rotor.disk_mass / rotor.shaft_stiffness
    return excess_mass(A, B, rotor.journal_mass / rotor.half_mass) > 0.0
