"""The onset of machines whose film depends on the whirl's frequency, from the eigenvalues.

With inner coordinates, or a film that is known by its impedance, neither Eqs. 5.45 to 5.50 nor a
polynomial of fixed degree apply. The fastest growing mode is refined on the machine's impedance.
"""

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc import modes
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.coefficients import dynamics
from rotorcalc.films import FilmDynamics
from rotorcalc.impedance_modes import impedance_eigenvalues
from rotorcalc.machine import Machine, Rotor
from rotorcalc.numerics.roots import narrow_root

# A refined eigenvalue that has moved further than this, relative, has converged to another one.
_SAME = 1e-6


def refined(rotor: Rotor, film: FilmDynamics, flexible: bool) -> ComplexArray:
    """Return all λ of a rotor on a film [1/s], (..., n), refined where that finds the same one."""
    if film.at is not None:
        return impedance_eigenvalues(rotor, film, flexible=flexible)
    known = modes.eigenvalues(
        rotor, film.stiffness, film.damping, inertia=film.inertia, flexible=flexible
    )
    return _refined_from(known, rotor, film, flexible)


def _refined_from(
    known: ComplexArray, rotor: Rotor, film: FilmDynamics, flexible: bool
) -> ComplexArray:
    """Return matrix eigenvalues refined, where that finds the same one."""
    found = modes.refined_eigenvalues(
        rotor, film.stiffness, film.damping, inertia=film.inertia, flexible=flexible
    )
    found = found[..., : known.shape[-1]]  # the first guesses begin with the matrix eigenvalues
    is_same = np.abs(found - known) <= _SAME * np.abs(known)
    # Newton's method may run to another eigenvalue; the matrix's own then stands.
    return np.where(is_same, found, known)


def fastest(machine: Machine, speed: ArrayLike, flexible: bool) -> ComplexArray:
    """Return λ of the mode that grows fastest at speeds (...) [1/s]."""
    values = refined(machine.rotor, dynamics(machine, speed), flexible)
    if np.any(unsettled := np.all(np.isnan(values.real), axis=-1)):
        first = np.broadcast_to(speed, unsettled.shape)[unsettled][0]
        raise ValueError(
            f"speed = {first:g} rad/s: on this film no mode was found whose frequency is that of "
            "its own stiffness and damping; compute the onset at other loads or speeds"
        )
    place = np.nanargmax(values.real, axis=-1)[..., None]
    return np.take_along_axis(values, place, axis=-1)[..., 0]


def growth(machine: Machine, speed: ArrayLike, flexible: bool) -> Array:
    """Return the largest Re λ/Ω of any mode at speeds (n,) [-], refined where that can matter.

    A matrix eigenvalue that is further from the axis than refining may move it has the same sign.
    """
    rotor, film, Omega = machine.rotor, dynamics(machine, speed), np.asarray(speed)
    if film.at is not None:
        return fastest(machine, speed, flexible).real / Omega
    values = modes.eigenvalues(
        rotor, film.stiffness, film.damping, inertia=film.inertia, flexible=flexible
    )
    near = np.any(np.abs(values.real) <= 2.0 * _SAME * np.abs(values), axis=-1)
    if near.any():
        beside = FilmDynamics(film.stiffness[near], film.damping[near], film.inertia)
        values[near] = _refined_from(values[near], rotor, beside, flexible)
    return values.real.max(axis=-1) / Omega


def growth_crossing(
    machine: Machine, flexible: bool, stable: float, unstable: float
) -> tuple[float, float]:
    """Return speed and whirl frequency where a machine changes between two speeds [rad/s]."""
    low, high = sorted((stable, unstable))

    def rates(speed: Array) -> Array:
        return growth(machine, speed, flexible)

    # Where rounding decides an end's sign, the change lies there.
    if rates(np.array([stable]))[0] >= 0.0:
        root = stable
    elif rates(np.array([unstable]))[0] <= 0.0:
        root = unstable
    else:
        root = narrow_root(rates, low, high)
    return root, float(abs(fastest(machine, root, flexible).imag))
