"""The onset of any machine whose film is given by K and C, from its characteristic polynomial.

The possible range of speeds is scanned for the first at which a root may lie in Re λ > 0, and there
the zero of Hurwitz's last determinant is found: in floats where these are conclusive, else in sixty
digits.
"""

import functools
import math
from collections.abc import Callable, Hashable, Iterator
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from rotorcalc import heat, modes
from rotorcalc.arrays import Array, BoolArray
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.coefficients import equilibrium, modified_sommerfeld, stiffness_and_damping
from rotorcalc.films import FilmUnits, film_coefficients, film_of, film_state, turning_bounds
from rotorcalc.films.model import BoundedFilm
from rotorcalc.machine import HOTTEST, Bearing, Machine
from rotorcalc.numerics import routh
from rotorcalc.numerics.roots import narrow_root
from rotorcalc.onset.characteristic import ExactPolynomial, polynomial
from rotorcalc.onset.growth import fastest, growth, growth_crossing
from rotorcalc.onset.whirl import Method, Onset, whirl_onset

# Speeds per decade of the scan before the search refines, and σ of the scan for the film's whirl.
_POINTS_PER_DECADE, _SIGMAS = 30, 200
# Speeds evaluated at once, in floats and in sixty digits; the scan ends with the block it needs.
BLOCK, _EXACT_BLOCK = 64, 4
# Whirl ratio assumed with inner coordinates, where synchronous coefficients do not tell of whirl.
_HALF = 0.5
# Factor on the range of the search for inner coordinates: no bound is known for the modes of the
# film's own parts, whose stiffness and mass may be anything. And extensions for a stiffening film.
_INNER, _RISES = 10.0, 60
# Relative distance from an onset at which floats must prove stability below and instability above
# it; otherwise the onset is computed in sixty digits.
_SURE = 1e-9
# Parts into which the spacings on both sides of a hump are divided, again and again, and their
# share of the speed at which that ends: where a pad is about to give up its film its tilt has
# hardly any stiffness, and closer to there the error of the film's table would decide.
_ON_A_HUMP, _ONE_SPEED = 8, 1e-3
# Rounding of Hurwitz's determinant, over its largest value between two speeds of the search.
NOISE = 1e-11
# What counts as stable: a machine is not run where its film has no answer.
_NO_FILM = -1.0
# Newton's steps from an accurate first guess, and the distance from the axis at convergence.
_REFINEMENTS, _ON_AXIS = 3, 1e-8


def searched_onset(machine: Machine, flexible: bool = True) -> Onset:
    """Return the onset of a machine by its characteristic polynomial.

    Parameters
    ----------
    machine : Machine
        The machine.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    Onset
        As `onset_speed` gives it.
    """
    film = film_of(machine.bearing)
    if not film.can_whirl:
        return _no_onset("film")
    speeds = search_speeds(machine, flexible)
    if film.frequency_dependent:
        found = _onset_by_growth(machine, flexible, speeds)
        found = replace(found, searched_to=float(speeds[-1]))
    else:
        found = _onset_by_polynomial(machine, flexible, speeds)
    if isinstance(machine.bearing, CoefficientTable):
        return _within_table(found, machine, machine.bearing, flexible)
    if machine.supply is not None and math.isinf(found.speed):
        # Beyond this speed the oil would be hotter than any law of its viscosity holds.
        limit = heat.hottest_speed(machine)
        found = replace(found, searched_to=min(found.searched_to, limit))
    return found


def _within_table(found: Onset, machine: Machine, table: CoefficientTable, flexible: bool) -> Onset:
    """Return an onset with the ends of the table between which it was sought."""
    if found.speed == 0.0:  # unstable at the first speed already, and nothing is known below it
        grows = fastest(machine, table.first, flexible)
        found = replace(found, speed=table.first, whirl_frequency=float(abs(grows.imag)))
    return replace(found, searched_from=table.first, searched_to=table.last)


def where_film(machine: Machine, values: Callable[[Array], Array]) -> Callable[[Array], Array]:
    """Return a function of speeds that is `_NO_FILM` where a supply leaves the film no answer."""
    if machine.supply is None:
        return values

    def masked(speeds: Array) -> Array:
        there = heat.has_film(machine, speeds)
        if there.all():
            return values(speeds)
        found = np.full(len(speeds), _NO_FILM)
        if there.any():
            found[there] = values(speeds[there])
        return found

    return masked


def _onset_by_polynomial(machine: Machine, flexible: bool, speeds: Array) -> Onset:
    def most(speeds: Array) -> Array:
        return routh.margin_bounds(polynomial(machine, speeds, flexible))[1]

    bracket = first_crossing(where_film(machine, most), speeds)
    if bracket is None:
        return _no_onset("polynomial")
    found = _in_floats(machine, flexible, *bracket)
    if found is not None:
        return _onset_at(machine, *found, method="polynomial", flexible=flexible)
    return _onset_in_many_digits(machine, flexible, speeds[speeds >= bracket[0]])


def _onset_in_many_digits(machine: Machine, flexible: bool, speeds: Array) -> Onset:
    exact = ExactPolynomial(machine, flexible)
    margins = where_film(machine, exact.margins)
    bracket = first_crossing(margins, speeds, block=_EXACT_BLOCK)
    if bracket is None:
        return _no_onset("extended precision")
    found = (0.0, 0.0) if bracket[0] == 0.0 else _in_many_digits(exact, *bracket)
    return _onset_at(machine, *found, method="extended precision", flexible=flexible)


def _onset_by_growth(machine: Machine, flexible: bool, speeds: Array) -> Onset:
    grows = where_film(machine, lambda speed: growth(machine, speed, flexible))
    bracket = first_crossing(grows, speeds)
    if bracket is None:
        return _no_onset("eigenvalues")
    found = (0.0, 0.0) if bracket[0] == 0.0 else growth_crossing(machine, flexible, *bracket)
    return _onset_at(machine, *found, method="eigenvalues", flexible=flexible)


def crossing(machine: Machine, stable: float, unstable: float, *, flexible: bool = True) -> float:
    """Return the speed at which a machine turns from stable to unstable [rad/s].

    Parameters
    ----------
    machine : Machine
        The machine.
    stable, unstable : float
        Speeds at which it is stable and unstable [rad/s]; either may be the higher.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    float
        A speed between the two [rad/s].
    """
    if film_of(machine.bearing).frequency_dependent:
        return growth_crossing(machine, flexible, stable, unstable)[0]
    found = _in_floats(machine, flexible, stable, unstable)
    return (found or _in_many_digits(ExactPolynomial(machine, flexible), stable, unstable))[0]


def _no_onset(method: Method) -> Onset:
    return Onset(
        speed=math.inf, whirl_frequency=math.nan, eccentricity_ratio=math.nan, method=method
    )


def _onset_at(
    machine: Machine, speed: float, whirl_frequency: float, *, method: Method, flexible: bool
) -> Onset:
    # At speed 0, where it is without load, the journal sits in the centre.
    if isinstance(machine.bearing, CoefficientTable):
        eps = math.nan
    elif speed > 0.0:
        eps = equilibrium(machine, speed).film.eccentricity_ratio
    else:
        eps = film_state(machine.bearing, math.inf).eccentricity_ratio
    if math.isnan(whirl_frequency):
        whirl_frequency = _frequency_nearest_the_axis(machine, speed, flexible)
    return Onset(
        speed=speed, whirl_frequency=whirl_frequency, eccentricity_ratio=float(eps), method=method
    )


def _frequency_nearest_the_axis(machine: Machine, speed: float, flexible: bool) -> float:
    """Return ω of the mode that neither grows nor decays, by the eigenvalues at an onset [rad/s].

    Routh's row gives ω as a ratio of differences, of which rounding may leave nothing.
    """
    K, C = stiffness_and_damping(machine, speed)
    values = modes.refined_eigenvalues(machine.rotor, K, C, flexible=flexible)
    swings = values[np.isfinite(values) & (values.imag > 0.0)]
    return float(swings[np.argmin(np.abs(swings.real) / np.abs(swings))].imag)


def _in_floats(
    machine: Machine, flexible: bool, stable: float, unstable: float
) -> tuple[float, float] | None:
    """Return speed and whirl frequency at a change of stability, None where floats cannot tell."""

    def polynomials(speed: Array | float) -> Array:
        return polynomial(machine, speed, flexible)

    if stable == 0.0:
        return None
    # A single sign change of the determinant between the two, proved at both ends.
    decays, grows = polynomials(np.array([stable, unstable]))
    if not routh.surely_between(decays, grows):
        return None
    low, high = sorted((stable, unstable))
    root = narrow_root(lambda speed: routh.determinant(polynomials(speed)), low, high, noise=NOISE)
    aside = math.copysign(_SURE, unstable - stable)
    # The root counts only where the polynomial is provably stable before it and unstable after it.
    around = np.clip(root * np.array([1.0 - aside, 1.0, 1.0 + aside]), low, high)
    before, there, after = polynomials(around)
    if not routh.surely_between(before, after):
        return None
    frequency = _axis_frequency(there)
    if math.isnan(frequency):
        return ExactPolynomial(machine, flexible).sharpened(root)
    return root, frequency


def _axis_frequency(polynomial: Array) -> float:
    """Return ω of the roots ±jω of a polynomial [rad/s], NaN where floats do not resolve it.

    Routh's scheme gives it less accurately than the speed is known; Newton's method refines it.
    """
    root, step = 1j * float(routh.axis_frequency(polynomial)), 0.0j
    falling: list[float] = polynomial[::-1].tolist()
    for _ in range(_REFINEMENTS):
        value = slope = 0.0j
        for coefficient in falling:  # Horner's scheme, for the slope as well
            slope = slope * root + value
            value = value * root + coefficient
        if slope == 0.0:
            return math.nan
        step = value / slope
        root -= step
    on_axis = max(abs(step), abs(root.real)) <= _ON_AXIS * abs(root)
    return root.imag if on_axis else math.nan


def _in_many_digits(exact: ExactPolynomial, stable: float, unstable: float) -> tuple[float, float]:
    """Return speed and whirl frequency at a change of stability between two speeds."""
    # More than one pair of roots may cross between the two.
    while exact.determinant(stable) <= 0.0 or exact.determinant(unstable) >= 0.0:
        middle = 0.5 * (stable + unstable)
        if middle in (stable, unstable):  # a real root crosses: the journal is driven off
            return middle, 0.0
        grows = exact.margins(np.array([middle]))[0] > 0.0
        stable, unstable = (stable, middle) if grows else (middle, unstable)
    root = float(brentq(exact.determinant, stable, unstable, xtol=1e-300, rtol=1e-14))
    return exact.sharpened(root)


def first_crossing(
    values: Callable[[Array], Array], speeds: Array, block: int = BLOCK
) -> tuple[float, float] | None:
    """Return speeds between which a function first turns positive, or None where it never does.

    Speed 0 and the first of them where that is so from there on.
    """
    found = np.empty(0)
    for begin in range(0, len(speeds), block):
        found = np.concatenate([found, values(speeds[begin : begin + block])])
        if np.any(found > 0.0):
            break
    first = int(np.argmax(found > 0.0)) if np.any(found > 0.0) else len(found)
    hidden = next(humps(values, speeds, found[:first]), None)
    if hidden is not None or first == len(found):
        return hidden
    return float(speeds[first - 1]) if first > 0 else 0.0, float(speeds[first])


def humps(
    values: Callable[[Array], Array], speeds: Array, found: Array
) -> Iterator[tuple[float, float]]:
    """Yield places where a function is positive between speeds at which it is not.

    Each local maximum of the values `found` at the speeds is examined; yielded are a speed below
    the hump and that of its top.
    """
    before, here, after = found[:-2], found[1:-1], found[2:]
    places = np.flatnonzero((before < here) & (here >= after) & (here <= 0.0))
    below, top = speeds[places], np.full(len(places), np.nan)
    between, left = np.stack([speeds[places + j] for j in range(3)], axis=-1), np.arange(len(top))
    while left.size:
        between, highest, is_certain = nearer_the_top(values, between)
        above = highest > 0.0
        top[left[above]] = between[above, 1]
        in_doubt = ~above & ~is_certain
        left, between = left[in_doubt], between[in_doubt]
    for low, high in zip(below.tolist(), top.tolist(), strict=True):
        if not math.isnan(high):
            yield low, high


def nearer_the_top(
    values: Callable[[Array], Array], between: Array
) -> tuple[Array, Array, BoolArray]:
    """Return closer places below, near and above the tops of humps.

    Parameters
    ----------
    values : callable
        The function: values (k,) at places (k,), those of the first hump first.
    between : array, (n, 3)
        Such places.

    Returns
    -------
    between : array, (n, 3)
        The closer ones.
    highest : array, (n,)
        The highest values.
    is_certain : boolean array, (n,)
        Whether no higher one can be above zero: a hump bends down, so its top is no further above
        the highest of equally distant places than a neighbour is below. At a jump that does not
        tell, and the places come closer until they are one.
    """
    below, above = (
        np.linspace(between[:, j], between[:, j + 1], _ON_A_HUMP + 1, axis=-1) for j in (0, 1)
    )
    on = np.concatenate([below, above[:, 1:]], axis=-1)
    found = values(on.ravel()).reshape(on.shape)
    best = np.clip(found.argmax(axis=-1), 1, on.shape[-1] - 2)[:, None] + np.arange(-1, 2)
    near, at = (np.take_along_axis(one, best, axis=-1) for one in (on, found))
    highest = at.max(axis=-1)
    is_one = near[:, 2] - near[:, 0] <= _ONE_SPEED * near[:, 2]
    return near, highest, is_one | (2.0 * highest <= at.min(axis=-1))


def search_speeds(machine: Machine, flexible: bool = True) -> Array:
    """Return the speeds of `search_range` [rad/s], and those of a table's rows."""
    speeds = np.geomspace(*search_range(machine, flexible))
    if isinstance(machine.bearing, CoefficientTable):
        return np.union1d(speeds, machine.bearing.speed)
    return speeds


def search_range(machine: Machine, flexible: bool = True) -> tuple[float, float, int]:
    """Return ends [rad/s] and number of speeds in equal ratios that span every first onset.

    Below the σ at which the film can whirl every rotor is stable, so the search begins there; above
    some σ the film no longer changes (`sommerfeld_range`). Without load the film is the centred one
    at every speed, and the search begins far below every rate of the rotor.

    For a film with inner coordinates the upper end is not proved: it is ten times twice the bound
    on the rotor's own modes on the synchronous film (`_highest_onset`). An onset above the last of
    these speeds is not found. Of a film that has its own bounds, as one of gas, and of a table of
    coefficients all speeds between these are searched.

    With a supply the film's viscosity lies between those of the coldest oil and the hottest, and an
    onset is one of the machine with that viscosity at every speed: both ranges together hold it.
    """
    if machine.supply is not None:
        cold, hot = (
            search_range(replace(machine, temperature=T, supply=None), flexible)
            for T in (machine.supply.temperature, HOTTEST)
        )
        return _range(min(cold[0], hot[0]), max(cold[1], hot[1]))
    if isinstance(machine.bearing, CoefficientTable):
        return _range(machine.bearing.first, machine.bearing.last)
    if isinstance(film_of(machine.bearing), BoundedFilm):
        return _answered_range(machine, flexible)
    unit = float(modified_sommerfeld(machine, 1.0))
    # σ is proportional to speed: `unit` is σ at 1 rad/s.
    lightest, centred = _whirl_range(machine.bearing)
    is_loaded = math.isfinite(unit)
    lowest = lightest / unit if is_loaded else 1e-3 * _slowest_rate(machine, flexible)
    centred = centred / unit if is_loaded else lowest
    highest = 2.0 * _beyond_all_onsets(machine, centred, flexible)
    if film_of(machine.bearing).inner:  # modes of the film's own parts, beside the rotor's
        highest *= _INNER
    return _range(lowest, highest)


def _answered_range(machine: Machine, flexible: bool) -> tuple[float, float, int]:
    """Return the range of all speeds at which a film of its own bounds has answers."""
    least, largest = turning_bounds(machine.bearing, machine.static_load)
    # Just inside, so that rounding does not pass the bounds.
    low = (1.0 + 1e-9) * least / machine.viscosity
    high = (1.0 - 1e-9) * largest / machine.viscosity
    return _range(low or min(1e-3 * _slowest_rate(machine, flexible), 1e-3 * high), high)


def _range(lowest: float, highest: float) -> tuple[float, float, int]:
    return lowest, highest, 1 + math.ceil(_POINTS_PER_DECADE * math.log10(highest / lowest))


def _whirl_range(bearing: Bearing) -> tuple[float, float]:
    """Return σ below which no rotor whirls, and σ above which the film no longer changes."""
    film = film_of(bearing)
    heavy, centred = film.sommerfeld_range
    # Of a film that depends on the frequency the synchronous coefficients decide nothing.
    curve = None if film.frequency_dependent else film.curve
    return (heavy if curve is None else _whirls_above(_Curve(curve, bearing))), centred


@dataclass(frozen=True)
class _Curve:
    """A film's k and c over σ; equal for all bearings with the same."""

    name: Hashable
    bearing: Bearing = field(compare=False)


@functools.lru_cache(maxsize=256)
def _whirls_above(curve: _Curve) -> float:
    """Return σ below which a film's whirl ratio is 0: at no frequency does it feed a whirl."""
    sigma = np.geomspace(*film_of(curve.bearing).sommerfeld_range, _SIGMAS)
    whirls = whirl_onset(*film_coefficients(curve.bearing, sigma)).whirl_ratio > 0.0
    first = int(np.argmax(whirls)) if whirls.any() else len(sigma) - 1
    return float(sigma[max(first - 1, 0)])


def _beyond_all_onsets(machine: Machine, centred: float, flexible: bool) -> float:
    """Return a speed above every onset [rad/s].

    The stiffness of a film that is not circular goes on rising with speed where it is centred, and
    with it the highest onset.
    """
    highest = centred
    for _ in range(_RISES):
        before, highest = highest, max(highest, _highest_onset(machine, highest, flexible))
        # The film's stiffness rises at most as Ω, and the bound as its root: after a factor of
        # 1.5 all later ones multiply to less than 1.5, and `search_speeds` doubles the bound.
        if highest <= 1.5 * before or not _stiffens(machine.bearing):
            break
    return highest


@functools.lru_cache(maxsize=256)
def _stiffens(bearing: Bearing) -> bool:
    """Return whether a film's stiffness goes on rising with speed where the journal is centred.

    That of a circular bore does not: unloaded, it has cross stiffness only (Eq. 5.37).
    """
    if film_of(bearing).inner:
        return True
    K, C = film_coefficients(bearing, math.inf)
    return max(float(np.trace(K)), float(whirl_onset(K, C).equivalent_stiffness)) > 0.0


def _slowest_rate(machine: Machine, flexible: bool) -> float:
    """Return the slowest of the rotor's own rates, or a rigid one's on a centred film [rad/s]."""
    rotor = machine.rotor
    if rotor.is_rigid or not flexible:
        return float(np.trace(stiffness_and_damping(machine, 1.0)[1])) / rotor.half_mass
    k, C_s = rotor.shaft_stiffness, rotor.disk_damping
    return min(math.sqrt(k / rotor.half_mass), k / C_s if C_s > 0.0 else math.inf)


def _highest_onset(machine: Machine, centred: float, flexible: bool) -> float:
    """Return a speed above every onset on a film that is centred from a speed on [rad/s].

    The whirl frequency is bounded by natural frequencies: the rotor's on the film's stiffness;
    with midspan damping, which can suppress that whirl, also the disk's on the shaft and the
    journal's between shaft and film. The film drives the whirl at the whirl ratio, and the speed
    must exceed that by the share of the midspan damping that acts on the journal.
    """
    film, rotor = _synchronous(machine, centred), machine.rotor
    C, C_s, m = film.damping / 2.0, rotor.disk_damping, rotor.disk_mass
    squares = [max(film.equivalent, 0.0) / rotor.half_mass]
    taken = C_s
    if flexible and not rotor.is_rigid and C_s > 0.0:
        k = rotor.shaft_stiffness
        squares.append(2.0 * k / m)
        if rotor.journal_mass > 0.0:
            squares.append((film.stiffness + 2.0 * k) / rotor.journal_mass)
        # Maximum of k²C_s/|k + z|² over frequency; a light damper's resonance is cut off, as it
        # suppresses no whirl.
        taken = C_s if C_s**2 >= 2.0 * k * m else min(2.0 * k * m / C_s, 1e6 * C)
    ratio = (0.0 if film_of(machine.bearing).inner else film.whirl_ratio) or _HALF
    return math.sqrt(max(squares)) * (1.0 + taken / C) / ratio


class _Synchronous(NamedTuple):
    """Traces of K and C of a film in synchronous motion, its K_eq, and its whirl ratio."""

    stiffness: float
    damping: float
    equivalent: float
    whirl_ratio: float


def _synchronous(machine: Machine, speed: float) -> _Synchronous:
    film = film_of(machine.bearing)
    if film.frequency_dependent or film.curve is None:
        K, C = stiffness_and_damping(machine, speed)
        return _of_matrices(K, C * speed, 1.0 / speed)
    sigma = float(modified_sommerfeld(machine, speed))
    # Machines on one curve ask for its end, which rounding would make another for each.
    k, c, equivalent, ratio = _on_curve(_Curve(film.curve, machine.bearing), float(f"{sigma:.9g}"))
    units = FilmUnits(machine.bearing, machine.viscosity, speed)
    stiffness, damping = float(units.stiffness), float(units.damping)
    return _Synchronous(k * stiffness, c * damping, equivalent * stiffness, ratio)


@functools.lru_cache(maxsize=256)
def _on_curve(curve: _Curve, sigma: float) -> _Synchronous:
    """Return those of a film at a σ in film units."""
    k, c = film_coefficients(curve.bearing, sigma)
    return _of_matrices(k, c, 1.0)


def _of_matrices(K: Array, C: Array, unit: float) -> _Synchronous:
    """Return those of K and C of the same unit, and what the latter's has to be multiplied by."""
    film = whirl_onset(K, C)
    return _Synchronous(
        float(np.trace(K)), float(np.trace(C)) * unit, float(film.equivalent_stiffness),
        float(film.whirl_ratio),
    )  # fmt: skip
