"""Free motion in a film that is known by its impedance alone.

Stiffness and damping of such a film hold for a whirl at one frequency. Each mode is that of the
coefficients at its own natural frequency, ω = |λ|: exact for a mode that neither grows nor decays,
so for the onset, and to the first order of its damping ratio else.
"""

from dataclasses import dataclass

import numpy as np

from rotorcalc import modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, ComplexArray, IntArray
from rotorcalc.films.dynamics import FilmDynamics, reduced
from rotorcalc.machine import Rotor

# Steps at most, and the difference of |λ| and ω, as a share of |λ|, that ends them.
_STEPS, _SETTLED = 90, 1e-13
# Modes of one speed that differ by less are one.
_SAME = 1e-6
# A mode that still differs by more than this has not converged.
_UNSETTLED = 1e-9
# Slope of |λ| − ω over ω: −1 where the coefficients do not depend on the frequency, and between
# these bounds where they do. A step by another slope could leave the mode.
_SLOPES = (-1.5, -0.5)
# Longest step of a frequency, as a ratio: the modes at the next one must be told from each other.
_LONGEST = 1.25
# A motion whose |Im λ| is a smaller share of |λ| hardly oscillates.
_OSCILLATES = 0.3
# The high frequency, over that amid the modes. A massless journal on a gas film dies still faster.
_HIGH = 1e6
# A whirl as many times as fast as the slowest is a fast one.
_FAST = 5.0
_TINY = float(np.finfo(float).tiny)


@checked
def impedance_eigenvalues(
    rotor: Rotor, film: FilmDynamics, *, flexible: bool = True
) -> ComplexArray:
    """Return the eigenvalues λ of a rotor in a film that is known by its impedance.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    film : FilmDynamics
        The film at speeds (...) with its impedance `at` frequencies [rad/s].
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    complex array, (..., n)
        λ [1/s], in no particular order, n as in `modes.state_matrix`; NaN where the substitution
        does not converge. A massless journal on a gas film dies faster than any frequency; such a
        motion is given as it is with the coefficients of a very high one.
    """
    return _own_modes(rotor, film, flexible)[0]


def _own_modes(rotor: Rotor, film: FilmDynamics, flexible: bool) -> tuple[ComplexArray, Array]:
    """Return eigenvalues (..., n) and the frequency of the coefficients of each."""
    values, frequency = _starts(rotor, film, flexible)
    # A motion faster than the high frequency at which it was sought stays as it is there.
    lost = ~_swings(values) & (np.abs(values) > frequency)
    _follow(rotor, film, flexible, _Followed(values, frequency, ~lost))
    repeated = _repeated(values)
    if repeated.any():
        # Two modes nearly alike have become one: the other is beside it, with its coefficients.
        _follow(rotor, film, flexible, _Followed(values, frequency, repeated), nearest=1)
    settled = lost | (np.abs(np.abs(values) - frequency) <= _UNSETTLED * np.abs(values))
    return np.where(settled, values, complex(np.nan, np.nan)), frequency


@dataclass(frozen=True, eq=False)
class _Followed:
    """Modes on the way to their own frequencies, (..., n) each, changed in place."""

    values: ComplexArray
    frequency: Array
    left: BoolArray


def _follow(
    rotor: Rotor, film: FilmDynamics, flexible: bool, on: _Followed, *, nearest: int = 0
) -> None:
    """Take modes to where |λ| is the frequency of their coefficients, where `left`.

    At first each is the one nearest to its value, or the next but `nearest`.
    """
    values, frequency, left = on.values, on.frequency, on.left.copy()
    own, at = np.moveaxis(values, -1, 0), np.moveaxis(frequency, -1, 0)
    some = np.moveaxis(left, -1, 0)
    step = difference = np.zeros_like(frequency)
    for _ in range(_STEPS):
        # Modes first, as the film takes frequencies; only those that are left are solved.
        K, C = reduced(film, at)
        found = modes.eigenvalues(rotor, K[some], C[some], flexible=flexible)
        own[some], nearest = _nearest_to(own[some], found, nearest), 0
        before, difference = difference, np.abs(values) - frequency
        left &= np.abs(difference) > _SETTLED * np.abs(values)
        if not left.any():
            return
        after = frequency - difference / _slope(difference - before, step)
        near = np.clip(after, frequency / _LONGEST, frequency * _LONGEST)
        after = np.where(left, np.where(_swings(values), near, np.abs(after)), frequency)
        step = after - frequency
        frequency[...] = after


def _repeated(values: ComplexArray) -> BoolArray:
    """Return which modes (..., n) are one before them."""
    apart = np.abs(values[..., :, None] - values[..., None, :])
    same = apart <= _SAME * np.abs(values)[..., None]
    return np.asarray(np.tril(same, -1).any(axis=-1))


def _starts(rotor: Rotor, film: FilmDynamics, flexible: bool) -> tuple[ComplexArray, Array]:
    """Return eigenvalues (..., n) near the modes' own, and the frequencies of their coefficients.

    Of coefficients at one frequency each mode is another one for certain; two of coefficients at
    two frequencies may be one. So motions that die are taken at a high frequency, fast whirls, as
    those of light journals, at one amid them, and the others at one amid these.
    """

    def at(frequency: Array) -> ComplexArray:
        values = modes.eigenvalues(rotor, *reduced(film, frequency), flexible=flexible)
        return np.take_along_axis(values, np.argsort(-np.abs(values), axis=-1), axis=-1)

    known = modes.eigenvalues(rotor, film.stiffness, film.damping, flexible=flexible)
    high = _HIGH * _mean(np.abs(known), np.isfinite(known))
    first = at(high)
    dies = ~_swings(first)
    first = np.take_along_axis(first, np.argsort(~dies, axis=-1, kind="stable"), axis=-1)
    # In this order: those that die, the fast whirls, the others.
    size: Array = np.abs(first)
    whirls = np.sort(~dies, axis=-1)
    fast: BoolArray = whirls & (size > _FAST * size[..., -1:])
    slow: BoolArray = whirls & ~fast
    values, frequency = first, np.broadcast_to(high[..., None], first.shape)
    for some in (fast, slow):
        amid = np.where(some.any(axis=-1), _mean(size, some), high)
        values = np.where(some, at(amid), values)
        frequency = np.where(some, amid[..., None], frequency)
    return values.copy(), frequency.copy()


def _mean(sizes: Array, counted: BoolArray) -> Array:
    """Return the geometric mean of the sizes (..., n) that are counted; 1 of none."""
    total = (np.log(np.maximum(sizes, _TINY)) * counted).sum(axis=-1)
    return np.asarray(np.exp(total / np.maximum(counted.sum(axis=-1), 1)))


def _nearest_to(values: ComplexArray, found: ComplexArray, after: int) -> ComplexArray:
    """Return of modes (k, n) the one nearest to each λ (k,), or the next but some."""
    place = np.abs(found - values[:, None]).argsort(axis=-1)[:, after]
    return found[np.arange(len(values)), place]


@checked
def impedance_modes(rotor: Rotor, film: FilmDynamics, *, flexible: bool = True) -> modes.ModeShapes:
    """Return the free motions of a rotor in a film that is known by its impedance.

    Parameters
    ----------
    rotor, film, flexible
        As of `impedance_eigenvalues`.

    Returns
    -------
    ModeShapes
        λ as `impedance_eigenvalues` gives it, each with the shape of its own coefficients.
    """
    values, frequency = _own_modes(rotor, film, flexible)
    shapes = modes.mode_shapes(rotor, *_at_frequencies(film, frequency), flexible=flexible)
    place = _nearest(shapes.eigenvalues, values)
    vectors: ComplexArray = np.take_along_axis(shapes.vectors, place[..., None, :], axis=-1)[..., 0]
    return modes.ModeShapes(
        eigenvalues=values,
        vectors=np.moveaxis(vectors, 0, -1),
        disk=_own(shapes.disk.swapaxes(-1, -2), place[..., None, :]).swapaxes(-1, -2),
        journal=_own(shapes.journal.swapaxes(-1, -2), place[..., None, :]).swapaxes(-1, -2),
        inner=np.empty((*values.shape, 0), dtype=complex),
    )


def _swings(values: ComplexArray) -> BoolArray:
    """Return which motions oscillate, rather than die."""
    return np.abs(values.imag) > _OSCILLATES * np.abs(values)


def _slope(change: Array, step: Array) -> Array:
    """Return the secant's slope after a step, and that of coefficients that are constant before."""
    secant = np.divide(change, step, out=np.full_like(change, -1.0), where=step != 0)
    return np.clip(secant, *_SLOPES)


def _at_frequencies(film: FilmDynamics, frequency: Array) -> tuple[Array, Array]:
    """Return K and C at the frequency of each mode (..., n), shape (n, ..., 2, 2): modes first."""
    return reduced(film, np.moveaxis(frequency, -1, 0))


def _nearest(found: ComplexArray, values: ComplexArray) -> IntArray:
    """Return which of the modes found (n, ..., n) is nearest to its own λ (..., n): (n, ..., 1)."""
    distance = np.abs(found - np.moveaxis(values, -1, 0)[..., None])
    return np.argmin(distance, axis=-1)[..., None]


def _own(found: ComplexArray, place: IntArray) -> ComplexArray:
    """Return of the modes (n, ..., n) each one's own, (..., n)."""
    return np.moveaxis(np.take_along_axis(found, place, axis=-1)[..., 0], 0, -1)
