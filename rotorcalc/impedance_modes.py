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

# Successive substitutions at most, and the relative change of λ that ends them. Each one shrinks
# the error by the factor with which the coefficients change over frequency, less than a half.
_STEPS, _SETTLED = 60, 1e-13
# What has changed by more than this in the last step has not converged.
_UNSETTLED = 1e-9


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
    change = np.array(np.inf)
    for _ in range(_STEPS):
        found = modes.eigenvalues(rotor, *_at_own_frequencies(film, values), flexible=flexible)
        following = _own(found, _nearest(found, values))
        change = np.abs(following - values) / np.abs(values)
        values = following
        if np.all(change <= _SETTLED):
            break
    return np.where(change <= _UNSETTLED, values, complex(np.nan, np.nan))


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
    shapes = modes.mode_shapes(rotor, *_at_own_frequencies(film, values), flexible=flexible)
    place = _nearest(shapes.eigenvalues, values)
    vectors: ComplexArray = np.take_along_axis(shapes.vectors, place[..., None, :], axis=-1)[..., 0]
    return modes.ModeShapes(
        eigenvalues=values,
        vectors=np.moveaxis(vectors, 0, -1),
        disk=_own(shapes.disk.swapaxes(-1, -2), place[..., None, :]).swapaxes(-1, -2),
        journal=_own(shapes.journal.swapaxes(-1, -2), place[..., None, :]).swapaxes(-1, -2),
    )


def _at_own_frequencies(film: FilmDynamics, values: ComplexArray) -> tuple[Array, Array]:
    """Return K and C at |λ| of the modes λ (..., n), shape (n, ..., 2, 2): the modes first."""
    return reduced(film, np.abs(np.moveaxis(values, -1, 0)))


def _nearest(found: ComplexArray, values: ComplexArray) -> IntArray:
    """Return which of the modes found (n, ..., n) is nearest to its own λ (..., n): (n, ..., 1)."""
    distance = np.abs(found - np.moveaxis(values, -1, 0)[..., None])
    return np.argmin(distance, axis=-1)[..., None]


def _own(found: ComplexArray, place: IntArray) -> ComplexArray:
    """Return of the modes (n, ..., n) each one's own, (..., n)."""
    return np.moveaxis(np.take_along_axis(found, place, axis=-1)[..., 0], 0, -1)
