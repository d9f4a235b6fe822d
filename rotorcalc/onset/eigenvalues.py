"""A machine's eigenvalues with certain signs of their real parts: growth and decay as the judge's.

The rounding error of a matrix eigenvalue is that of the fastest. At light load, or beside a stiff
shaft or a light journal, it exceeds the growth rate of the whirl; there the eigenvalues are roots
of the characteristic polynomial in sixty digits. All others are LAPACK's.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.optimize import linear_sum_assignment

from rotorcalc import modes
from rotorcalc.arrays import Array, BoolArray, ComplexArray
from rotorcalc.films import FilmDynamics
from rotorcalc.films.dynamics import NO_INERTIA
from rotorcalc.impedance_modes import impedance_modes
from rotorcalc.machine import Machine
from rotorcalc.numerics.polynomial_roots import error_bounds, simultaneous_roots
from rotorcalc.onset.characteristic import ExactPolynomial, polynomial_on
from rotorcalc.onset.growth import refined

# Least |Re λ| over the largest |λ| that needs no proof: a matrix eigenvalue's error over that is
# 2e-16 times its condition number; of 1558 wrong signs of 3000 drawn machines all lay below 5e-17.
_PLAIN = 1e-8
# Largest proved error of an eigenvalue over its real part.
_SURE = 1e-3


def certain_eigenvalues(
    machine: Machine, speed: Array, film: FilmDynamics, *, flexible: bool
) -> ComplexArray:
    """Return the eigenvalues λ of a machine at speeds, none with a doubtful sign of Re λ.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array, (...)
        Running speed, Ω [rad/s].
    film : FilmDynamics
        The film there [N/m], [N·s/m], [kg].
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    complex array, (..., n)
        λ [1/s], in no particular order; n as in `modes.state_matrix`. Of a film that
        depends on frequency each is refined as `growth.refined` does, without proof.
    """
    if film.frequency_dependent:
        return refined(machine.rotor, film, flexible)
    values = modes.eigenvalues(machine.rotor, film.stiffness, film.damping, flexible=flexible)
    return _certain(machine, speed, film, values, flexible=flexible)


def eigenvalues_of(
    machines: Sequence[Machine], speed: float, stiffness: Array, damping: Array
) -> ComplexArray:
    """Return the eigenvalues of machines with one rotor, on films of K and C alone.

    Parameters
    ----------
    machines : sequence of Machine, m
        The machines, all with the same rotor.
    speed : float
        Running speed, Ω [rad/s].
    stiffness, damping : array, (m, 2, 2)
        Their films there [N/m], [N·s/m].

    Returns
    -------
    complex array, (m, n)
        λ [1/s] of each, as `certain_eigenvalues` gives them.
    """
    values = modes.eigenvalues(machines[0].rotor, stiffness, damping)
    for i in np.flatnonzero(_is_near_axis(values)).tolist():
        film = FilmDynamics(stiffness[i], damping[i], NO_INERTIA)
        values[i] = _certain(machines[i], np.asarray(speed), film, values[i], flexible=True)
    return values


def certain_mode_shapes(
    machine: Machine, speed: Array, film: FilmDynamics, *, flexible: bool
) -> modes.ModeShapes:
    """Return the free motions of a machine at speeds, eigenvalues as `certain_eigenvalues`.

    The vectors are those of the state matrix.
    """
    if film.at is not None:
        return impedance_modes(machine.rotor, film, flexible=flexible)
    shapes = modes.mode_shapes(
        machine.rotor, film.stiffness, film.damping, inertia=film.inertia, flexible=flexible
    )
    if film.inner:
        certain = refined(machine.rotor, film, flexible)
    else:
        certain = _certain(machine, speed, film, shapes.eigenvalues, flexible=flexible)
    return replace(shapes, eigenvalues=_paired(shapes.eigenvalues, certain))


def _paired(values: ComplexArray, certain: ComplexArray) -> ComplexArray:
    """Return certain eigenvalues, each in the place of the one it replaces, (..., n)."""
    found = certain.copy()
    for place in np.argwhere(np.any(certain != values, axis=-1)):
        one, other = values[*place][:, None], certain[*place][None, :]
        size = np.abs(one) + np.abs(other)
        distance = np.abs(one - other) / np.where(size == 0.0, 1.0, size)
        found[*place] = certain[*place][linear_sum_assignment(distance)[1]]
    return found


def _certain(
    machine: Machine, speed: Array, film: FilmDynamics, values: ComplexArray, *, flexible: bool
) -> ComplexArray:
    doubt = _in_doubt(machine, film, values, flexible)
    if not np.any(doubt):
        return values
    exact = ExactPolynomial(machine, flexible)
    polynomial = polynomial_on(_at(film, doubt), machine.rotor, flexible)
    near = simultaneous_roots(polynomial, values[doubt])
    found = values.copy()
    try:
        found[doubt] = [exact.roots(*row) for row in zip(speed[doubt].tolist(), near, strict=True)]
    except RuntimeError as error:
        raise ValueError(
            f"static load = {machine.static_load:g} N: the film is so stiff that sixty digits do "
            "not resolve the eigenvalues"
        ) from error
    return found


def _in_doubt(
    machine: Machine, film: FilmDynamics, values: ComplexArray, flexible: bool
) -> BoolArray:
    """Return where the sign of some real part is not proved."""
    doubt = _is_near_axis(values)
    if np.any(doubt):
        polynomial = polynomial_on(_at(film, doubt), machine.rotor, flexible)
        errors = error_bounds(polynomial, values[doubt])
        doubt[doubt] = np.any(errors > _SURE * np.abs(values[doubt].real), axis=-1)
    return doubt


def _is_near_axis(values: ComplexArray) -> BoolArray:
    """Return where some real part needs a proof of its sign, (...)."""
    smallest = np.abs(values.real).min(axis=-1)
    return np.asarray(smallest <= _PLAIN * np.abs(values).max(axis=-1))


def _at(film: FilmDynamics, places: BoolArray) -> tuple[Array, Array]:
    return film.stiffness[places], film.damping[places]
