"""The operating points of a foil bearing by the tables that hold them.

The compressibility number is Λ = 6μΩ/p_a·(R/C)², the load W = F/(p_a D L); σ = Λ/(12 W (D/L)²). So
a machine has one W at all its speeds, and a curve over σ at one speed has one Λ.
"""

import functools
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films.foil.equilibrium import resting, settled
from rotorcalc.films.foil.reynolds import Films
from rotorcalc.films.foil.table import (
    HEAVIEST,
    HIGHEST_NUMBER,
    LIGHTEST,
    THINNEST,
    FoilShape,
    FoilTable,
    over_load,
    over_speed,
)
from rotorcalc.films.state import OperatingPoints
from rotorcalc.geometry import Foil
from rotorcalc.machine import JournalBearing

# Up to so many different loads each has its own table over speed, whatever the number of speeds.
_FEW = 8
# Digits of the number that names a table: equal loads may differ in the last ones.
_DIGITS = 12


@dataclass(frozen=True, eq=False)
class Conditions:
    """Where a foil bearing is asked for its film, fields of one flat shape (n,).

    Attributes
    ----------
    number : array
        Λ [-].
    load : array
        W [-].
    speed, sommerfeld : array
        Ω [rad/s] and σ [-], for messages.
    shape : tuple of int
        The shape of the points.
    """

    number: Array
    load: Array
    speed: Array
    sommerfeld: Array
    shape: tuple[int, ...]

    @classmethod
    def of(cls, bearing: JournalBearing, foil: Foil, points: OperatingPoints) -> "Conditions":
        """Return the conditions of a bearing at operating points."""
        unit = 6.0 * (bearing.radius / bearing.radial_clearance) ** 2 / foil.ambient_pressure
        area = foil.ambient_pressure * bearing.diameter * bearing.length
        fields = (
            points.viscosity * points.speed * unit, points.load / area,
            points.speed, points.sommerfeld,
        )  # fmt: skip
        wide = np.broadcast_arrays(*fields)
        return cls(*(each.reshape(-1) for each in wide), shape=wide[0].shape)


@dataclass(frozen=True, eq=False)
class Group:
    """Points that one table holds.

    Attributes
    ----------
    table : FoilTable
        The table.
    where : int array, (k,)
        Their indices among all points.
    place : array, (k,)
        Their places in the table.
    number : array, (k,)
        Λ there [-].
    light : array, (k,)
        Their load over that of the place: below 1 where it is lighter than the table's lightest, to
        which all but the coefficients is then in proportion.
    """

    table: FoilTable
    where: IntArray
    place: Array
    number: Array
    light: Array


def groups(foil: FoilShape, at: Conditions) -> Iterator[Group]:
    """Yield the points of each table.

    Raises
    ------
    ValueError
        Where the film does not carry the load, or Λ is higher than the tables go.
    """
    _check_number(at)
    loads, of_load = np.unique(_named(at.load), return_inverse=True)
    numbers, of_number = np.unique(_named(at.number), return_inverse=True)
    if len(loads) > _FEW and len(numbers) < len(loads):
        for i, number in enumerate(numbers.tolist()):
            yield _over_load(foil, at, np.flatnonzero(of_number == i), number)
    else:
        for i, load in enumerate(loads.tolist()):
            yield _over_speed(foil, at, np.flatnonzero(of_load == i), load)


def named(value: float) -> float:
    """Return a number rounded to the digits that name a table."""
    return float(f"{value:.{_DIGITS}g}")


def _named(values: Array) -> Array:
    return np.array([named(value) for value in values.tolist()])


def _check_number(at: Conditions) -> None:
    high = at.number > HIGHEST_NUMBER * (1.0 + 1e-9)
    if high.any():
        i = int(np.argmax(high))
        raise ValueError(
            f"speed = {at.speed[i]:.6g} rad/s: with this gas, clearance and ambient pressure the "
            f"compressibility number is {at.number[i]:.4g}, must be at most {HIGHEST_NUMBER:g}"
        )


def _over_speed(foil: FoilShape, at: Conditions, where: IntArray, load: float) -> Group:
    if load > HEAVIEST:
        raise ValueError(
            f"load: {load:.4g} of the ambient pressure over D L, must be at most {HEAVIEST:g}"
        )
    found = over_speed(foil, load)
    lowest, _ = found.ends
    number = at.number[where]
    if load < LIGHTEST:  # the film of no load: at low speeds incompressible
        number = np.maximum(number, lowest)
        return Group(found, where, np.log(number), number, np.zeros(len(where)))
    slow = number < lowest * (1.0 - 1e-9)
    if slow.any():
        i = where[np.argmax(slow)]
        least = at.speed[i] * lowest / at.number[i]
        raise ValueError(
            f"speed = {at.speed[i]:.6g} rad/s, sommerfeld = {at.sommerfeld[i]:.4g}: below the "
            f"lift-off speed of this load, {least:.6g} rad/s; there the film in the middle plane "
            f"is as thin as {found.films.least_thickness[0]:.3g} of the clearance"
        )
    place = np.log(np.maximum(number, lowest))
    return Group(found, where, place, number, np.ones(len(where)))


def _over_load(foil: FoilShape, at: Conditions, where: IntArray, number: float) -> Group:
    found = over_load(foil, number)
    lightest, heaviest = found.ends
    load = at.load[where]
    heavy = load > heaviest * (1.0 + 1e-9)
    if heavy.any():
        i = where[np.argmax(heavy)]
        least = at.sommerfeld[i] * at.load[i] / heaviest
        raise ValueError(
            f"sommerfeld = {at.sommerfeld[i]:.4g}: must be at least {least:.4g} at this speed, "
            f"where the thinnest film of the middle plane is {THINNEST:g} of the clearance or the "
            f"load {HEAVIEST:g} of the ambient pressure over D L"
        )
    place = np.log(np.clip(load, lightest, heaviest))
    return Group(found, where, place, at.number[where], np.minimum(load / lightest, 1.0))


def solved_at(foil: FoilShape, number: Array, load: Array) -> Iterator[tuple[BoolArray, Films]]:
    """Yield where each pair of Λ and W stands in two arrays of one shape, and the film there."""
    pairs = np.unique(np.stack([number.reshape(-1), load.reshape(-1)]), axis=1)
    for one, other in pairs.T.tolist():
        yield (number == one) & (load == other), _film_at(foil, one, other)


@functools.lru_cache(maxsize=64)
def _film_at(foil: FoilShape, number: float, load: float) -> Films:
    """Return the film at one Λ and W, in equilibrium."""
    if load < LIGHTEST:
        _, fine = foil.meshes()
        return resting(fine, foil.compliance, np.array([number]))
    found = over_speed(foil, named(load))
    near = found.nearest(math.log(number)).at(np.array([number]))
    at = settled(near, np.array([load]), steps=30)
    if not at.good.all():
        raise ValueError(f"bearing = foil: no equilibrium was found at Λ = {number:.4g}")
    return at.films
