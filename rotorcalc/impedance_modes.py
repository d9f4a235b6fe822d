"""Free motion in a film that is known by its impedance alone.

Stiffness and damping of such a film hold for a whirl at one frequency. Each mode is that of the
coefficients at its own natural frequency, ω = |λ|: exact for a mode that neither grows nor decays,
so for the onset, and to the first order of its damping ratio else.
"""

import numpy as np

from rotorcalc import modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray, IntArray
from rotorcalc.films.dynamics import FilmDynamics, reduced
from rotorcalc.machine import Rotor

# Steps at most, and the difference of |λ| and ω, as a share of |λ|, that ends them.
_STEPS, _SETTLED = 60, 1e-13
# A mode that still differs by more than this has not converged.
_UNSETTLED = 1e-9
# Slope of |λ| − ω over ω: −1 where the coefficients do not depend on the frequency, and between
# these bounds where they do. A step by another slope could leave the mode.
_SLOPES = (-1.5, -0.5)


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
        does not converge.
    """
    values = modes.eigenvalues(rotor, film.stiffness, film.damping, flexible=flexible)
    frequency = np.abs(values)
    step = difference = np.zeros_like(frequency)
    for _ in range(_STEPS):
        found = modes.eigenvalues(rotor, *_at_frequencies(film, frequency), flexible=flexible)
        values = _own(found, _nearest(found, values))
        before, difference = difference, np.abs(values) - frequency
        if np.all(np.abs(difference) <= _SETTLED * np.abs(values)):
            break
        step = -difference / _slope(difference - before, step)
        frequency = frequency + step
    settled = np.abs(difference) <= _UNSETTLED * np.abs(values)
    return np.where(settled, values, complex(np.nan, np.nan))


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
    values = impedance_eigenvalues(rotor, film, flexible=flexible)
    shapes = modes.mode_shapes(rotor, *_at_frequencies(film, np.abs(values)), flexible=flexible)
    place = _nearest(shapes.eigenvalues, values)
    vectors: ComplexArray = np.take_along_axis(shapes.vectors, place[..., None, :], axis=-1)[..., 0]
    return modes.ModeShapes(
        eigenvalues=values,
        vectors=np.moveaxis(vectors, 0, -1),
        disk=_own(shapes.disk.swapaxes(-1, -2), place[..., None, :]).swapaxes(-1, -2),
        journal=_own(shapes.journal.swapaxes(-1, -2), place[..., None, :]).swapaxes(-1, -2),
        inner=np.empty((*values.shape, 0), dtype=complex),
    )


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
