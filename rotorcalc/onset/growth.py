"""The onset of machines whose film has inner coordinates, from the eigenvalues.

Such a film's coefficients depend on the whirl frequency, so neither Eqs. 5.45 to 5.50 nor a
polynomial of fixed degree apply. The fastest growing mode is refined on the machine's impedance.
"""

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc import modes
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.coefficients import dynamics
from rotorcalc.films import FilmDynamics
from rotorcalc.machine import Machine, Rotor
from rotorcalc.numerics.roots import narrow_root

# A refined eigenvalue that has moved further than this, relative, has converged to another one.
_SAME = 1e-6


def refined(rotor: Rotor, film: FilmDynamics, flexible: bool) -> ComplexArray:
    """Return all λ of a rotor on a film [1/s], (..., n), refined where that finds the same one."""
    matrices = (rotor, film.stiffness, film.damping)
    known = modes.eigenvalues(*matrices, inertia=film.inertia, flexible=flexible)
    found = modes.refined_eigenvalues(*matrices, inertia=film.inertia, flexible=flexible)
    found = found[..., : known.shape[-1]]  # the first guesses begin with the matrix eigenvalues
    is_same = np.abs(found - known) <= _SAME * np.abs(known)
    # Newton's method may run to another eigenvalue; the matrix's own then stands.
    return np.where(is_same, found, known)


def fastest(machine: Machine, speed: ArrayLike, flexible: bool) -> ComplexArray:
    """Return λ of the mode that grows fastest at speeds (...) [1/s]."""
    values = refined(machine.rotor, dynamics(machine, speed), flexible)
    return np.take_along_axis(values, np.argmax(values.real, axis=-1)[..., None], axis=-1)[..., 0]


def growth(machine: Machine, speed: ArrayLike, flexible: bool) -> Array:
    """Return the largest Re λ/Ω of any mode at speeds (...) [-]."""
    return fastest(machine, speed, flexible).real / np.asarray(speed)


def growth_crossing(
    machine: Machine, flexible: bool, stable: float, unstable: float
) -> tuple[float, float]:
    """Return speed and whirl frequency where a machine changes between two speeds [rad/s]."""
    low, high = sorted((stable, unstable))
    root = narrow_root(lambda speed: growth(machine, speed, flexible), low, high)
    return root, float(abs(fastest(machine, root, flexible).imag))
