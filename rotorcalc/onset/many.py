"""Onset speeds of many machines at once, by their characteristic polynomials alone.

As `onset_speed` for one machine, but on arrays over machines; where floats are not conclusive
`onset_speed` itself is called. The films follow one curve over σ: k and c depend on the film model
alone, not on the bearing's dimensions.
"""

import math
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import elementwise

from rotorcalc import modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films import FilmUnits, film_coefficients, film_of
from rotorcalc.machine import Bearing, Machine
from rotorcalc.numerics import routh
from rotorcalc.numerics.roots import narrow_roots
from rotorcalc.onset import onset_speed
from rotorcalc.onset.closed_form import closed_onsets, covers
from rotorcalc.onset.search import BLOCK, NOISE, nearer_the_top, search_range

# Number of machines from which solving them together is faster than one by one.
_FLEET = 4


@checked
def onset_speeds(machines: Sequence[Machine]) -> Array:
    """Return the onset speeds of many machines.

    Parameters
    ----------
    machines : sequence of Machine, n
        The machines.

    Returns
    -------
    array, (n,)
        Onset speed, Ω_s [rad/s], as `onset_speed` gives it for each.

    Raises
    ------
    RuntimeError
        Where the search does not end.
    """
    speeds = np.full(len(machines), np.nan)
    is_closed = [covers(machine) for machine in machines]
    closed = [i for i, known in enumerate(is_closed) if known]
    speeds[closed] = closed_onsets([machines[i] for i in closed])
    others = [
        i
        for i, (machine, known) in enumerate(zip(machines, is_closed, strict=True))
        if not known and _curve(machine) is not None
    ]
    # What is left NaN here, and the few, goes to `onset_speed` one by one.
    if len(others) >= _FLEET:
        speeds[others] = sure_onsets([machines[i] for i in others])
    for i, machine in enumerate(machines):
        if math.isnan(speeds[i]):
            speeds[i] = onset_speed(machine).speed
    return speeds


# Only the relative step ends the search: an onset may be of any size, its determinant of any too.
_ROOT: Any = {"xatol": 0.0, "xrtol": 1e-14, "fatol": 0.0, "frtol": 0.0}
# Relative distance from an onset at which floats must prove stability below and instability above
# it; otherwise `onset_speed` is called for that machine.
_SURE = 1e-11


def sure_onsets(machines: Sequence[Machine]) -> Array:
    """Return the onset speeds of many machines where their polynomials are conclusive.

    Parameters
    ----------
    machines : sequence of Machine, n
        Machines with shafts that bend or not, whose films follow one curve over σ.

    Returns
    -------
    array, (n,)
        Onset speed, Ω_s [rad/s], as `onset_speed` gives it; NaN where polynomials cannot decide.
    """
    speeds = np.full(len(machines), np.nan)
    kinds: dict[tuple[Hashable, int], list[int]] = {}
    terms = [modes.rotor_terms(machine.rotor) for machine in machines]
    for i, machine in enumerate(machines):
        if machine.static_load > 0.0 and _curve(machine) is not None:
            kinds.setdefault((_curve(machine), terms[i].shape[-1]), []).append(i)
    for same in kinds.values():
        speeds[same] = _sure_onsets([machines[i] for i in same], np.stack([terms[i] for i in same]))
    return speeds


def _curve(machine: Machine) -> Hashable:
    """Return the name of the curve over σ that a machine's film follows, None where it has none."""
    film = film_of(machine.bearing)
    # With a supply the film's viscosity has to be solved for at each speed of each machine.
    if machine.supply is not None or film.frequency_dependent or not film.can_whirl:
        return None
    return film.curve


@dataclass(frozen=True, eq=False)
class _Fleet:
    """Machines with the same film model and number of states: the data of their polynomials.

    Attributes
    ----------
    bearing : JournalBearing or CoefficientTable
        Any of the bearings.
    sommerfeld, damping : array, (m,)
        σ/Ω [s], and the unit of the film's damping, μRL³/C³ [N·s/m].
    rotor_terms : array, (m, 6, n+1)
        As `modes.rotor_terms` gives them.
    """

    bearing: Bearing
    sommerfeld: Array
    damping: Array
    rotor_terms: Array

    def polynomials(self, speed: Array, which: IntArray) -> Array:
        """Return characteristic polynomials, (m, p, n+1), of machines (m,) at speeds (m, p)."""
        k, c = film_coefficients(self.bearing, self.sommerfeld[which, None] * speed)
        C = c * self.damping[which, None, None, None]
        K = k * (self.damping[which, None] * speed)[..., None, None]
        return modes.film_terms(K, C) @ self.rotor_terms[which]

    def doubt(self, speed: Array, which: IntArray) -> Array:
        """Return their largest margins within rounding, (m, p): negative where surely stable."""
        return routh.margin_bounds(self.polynomials(speed, which))[1]


def _fleet(machines: Sequence[Machine], rotor_terms: Array) -> _Fleet:
    units = [FilmUnits(one.bearing, one.viscosity, 1.0) for one in machines]
    loads = np.array([machine.static_load for machine in machines])
    return _Fleet(
        bearing=machines[0].bearing,
        sommerfeld=np.array([unit.force for unit in units]) / (4.0 * loads),
        damping=np.array([unit.damping for unit in units]),
        rotor_terms=rotor_terms,
    )


def _sure_onsets(machines: Sequence[Machine], rotor_terms: Array) -> Array:
    """Return the onsets of machines with the same film model and number of states."""
    first, last, lengths = np.array([search_range(machine) for machine in machines]).T
    ratio = (last / first) ** (1.0 / (lengths - 1.0))
    # Shorter searches are continued, each at its own ratio, to a common length.
    points = int(lengths.max())
    speeds: Array = first[:, None] * ratio[:, None] ** np.arange(points, dtype=float)
    fleet = _fleet(machines, rotor_terms)
    doubt = _doubt(fleet, speeds)
    in_doubt = doubt > 0.0
    end: IntArray = np.where(np.any(in_doubt, axis=1), np.argmax(in_doubt, axis=1), points)
    # No uncertain point: no onset. The first point uncertain: no bracket, left to the search.
    smooth = ~_has_hump(fleet.doubt, speeds, doubt)
    onsets = np.where(smooth & (end == points), np.inf, np.nan)
    which = np.flatnonzero(smooth & (end > 0) & (end < points))
    if which.size:
        low, high = speeds[which, end[which] - 1], speeds[which, end[which]]
        onsets[which] = _crossings(fleet, which, low, high)
    return onsets


def _doubt(fleet: _Fleet, speeds: Array) -> Array:
    """Return `_Fleet.doubt` at speeds (m, p), in each row to the block of the first above zero.

    Further on, where no machine's onset can be, it is infinite.
    """
    doubt = np.full(speeds.shape, np.inf)
    left = np.arange(len(speeds))
    for begin in range(0, speeds.shape[1], BLOCK):
        block = slice(begin, begin + BLOCK)
        doubt[left, block] = fleet.doubt(speeds[left, block], left)
        left = left[np.all(doubt[left, block] <= 0.0, axis=1)]
        if not left.size:
            break
    return doubt


def _has_hump(values: Callable[[Array, IntArray], Array], speeds: Array, found: Array) -> BoolArray:
    """Return whether a row turns positive between two speeds before the first where it is, (m,).

    `values` are those of rows (n,) at speeds (n, p), `found` all of them at the speeds (m, p).
    """
    which, place = _peaks(found)
    between = np.stack([speeds[which, place + j] for j in range(-1, 2)], axis=-1)
    is_above = np.zeros(len(found), dtype=bool)
    while which.size:
        rows = which

        def flat(on: Array, rows: IntArray = rows) -> Array:
            return values(on.reshape(len(rows), -1), rows).ravel()

        between, highest, is_certain = nearer_the_top(flat, between)
        is_above[which[highest > 0.0]] = True
        in_doubt = ~is_certain & ~is_above[which]
        which, between = which[in_doubt], between[in_doubt]
    return is_above


def _peaks(found: Array) -> tuple[IntArray, IntArray]:
    """Return rows and places of the local maxima before a row's first value above zero."""
    is_peak = (found[:, :-2] < found[:, 1:-1]) & (found[:, 1:-1] >= found[:, 2:])
    before = np.cumsum(found > 0.0, axis=1) == 0
    which, place = np.nonzero(is_peak & before[:, 1:-1])
    return which, place + 1


def _crossings(fleet: _Fleet, which: IntArray, low: Array, high: Array) -> Array:
    """Return the onsets between speeds, (k,), NaN where rounding leaves them uncertain."""
    roots = narrow_roots(
        lambda speed: routh.determinant(fleet.polynomials(speed, which)), low, high, noise=NOISE
    )
    rough = np.isnan(roots)
    if rough.any():  # as where the film's table has a kink
        roots[rough] = _bracketed(fleet, which[rough], low[rough], high[rough])
    is_found = ~np.isnan(roots)
    around = np.where(is_found, roots, low)[:, None] * np.array([1.0 - _SURE, 1.0 + _SURE])
    below_above = fleet.polynomials(around, which)
    sharp = (routh.margin_bounds(below_above[:, 0])[1] < 0.0) & routh.surely_crossed(
        below_above[:, 1]
    )
    return np.where(sharp & is_found, roots, np.nan)


def _bracketed(fleet: _Fleet, which: IntArray, low: Array, high: Array) -> Array:
    """Return the determinants' zeros between speeds, (k,), NaN where the search does not end."""

    def determinant(speed: Array, which: Array) -> Array:
        polynomials = fleet.polynomials(speed[:, None], which.astype(int))
        return routh.determinant(polynomials)[:, 0]

    # The stubs lack what find_root returns for arrays of arguments.
    found: Any = elementwise.find_root(determinant, (low, high), args=(which,), tolerances=_ROOT)
    return np.where(found.success, found.x, np.nan)
