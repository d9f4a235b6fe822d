"""Free motion about equilibrium: state matrices, eigenvalues, and what they say of each mode.

Model: the film's linear stiffness and damping at one running speed; the rotor as one disk on a
massless shaft, the whole per bearing. States, X and Y of each: a rigid rotor has the journal's
position and velocity (4); a flexible one the disk's position and velocity and the journal's
position (6), and with journal mass the journal's velocity too (8).

Source: San Andrés, Notes 5, Eq. 5.38 (rigid), and the calculation sheet (flexible); midspan damping
and journal mass are the two extensions that the sheet leaves to its reader.
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import linear_sum_assignment

from rotorcalc.machine import Rotor
from rotorcalc.typing import Array, ComplexArray

_I = np.eye(2)


def state_matrix(rotor: Rotor, K: Array, C: Array, *, flexible: bool = True) -> Array:
    """Return the matrix A of the free motion, q̇ = A q.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    K, C : array, (..., 2, 2)
        The film's stiffness [N/m] and damping [N·s/m] in X, Y.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    array, (..., n, n)
        A; n = 4 for a rigid rotor, 6 for a flexible one, 8 with journal mass. The state holds
        disk position, journal position, disk velocity, journal velocity, as far as the model has
        them; a rigid rotor's journal is its disk.
    """
    if rotor.is_rigid or not flexible:
        return _rigid(rotor, K, C)
    if rotor.journal_mass > 0.0:
        return _with_journal_mass(rotor, K, C)
    return _massless_journals(rotor, K, C)


def eigenvalues(rotor: Rotor, K: Array, C: Array, *, flexible: bool = True) -> ComplexArray:
    """Return the eigenvalues λ of the free motion e^{λt}.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    K, C : array, (..., 2, 2)
        The film's stiffness [N/m] and damping [N·s/m] in X, Y.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    complex array, (..., n)
        λ [1/s], in no particular order; n as in `state_matrix`.
    """
    return np.linalg.eigvals(state_matrix(rotor, K, C, flexible=flexible)).astype(complex)


def damped_frequency(eigenvalue: ArrayLike) -> Array:
    """Return the frequency of a mode, ω_d = |Im λ| [rad/s], shape (...) of `eigenvalue` [1/s]."""
    return np.abs(np.imag(eigenvalue))


def natural_frequency(eigenvalue: ArrayLike) -> Array:
    """Return the natural frequency, ω_n = |λ| [rad/s], shape (...) of `eigenvalue` [1/s]."""
    return np.abs(np.asarray(eigenvalue))


def damping_ratio(eigenvalue: ArrayLike) -> Array:
    """Return the damping ratio, ζ = −Re λ/|λ| [-].

    Parameters
    ----------
    eigenvalue : array_like, (...)
        λ [1/s], not zero.

    Returns
    -------
    array, (...)
        ζ; negative where the mode grows, ±1 where it does not oscillate.
    """
    return -np.real(eigenvalue) / np.abs(eigenvalue)


def logarithmic_decrement(eigenvalue: ArrayLike) -> Array:
    """Return the logarithmic decrement, −2π Re λ/|Im λ| [-].

    Parameters
    ----------
    eigenvalue : array_like, (...)
        λ [1/s].

    Returns
    -------
    array, (...)
        Logarithm of the ratio of successive amplitudes; infinite where the mode does not oscillate.
    """
    with np.errstate(divide="ignore"):
        return -2.0 * np.pi * np.real(eigenvalue) / np.abs(np.imag(eigenvalue))


def follow_branches(eigenvalues: ArrayLike) -> ComplexArray:
    """Return eigenvalues reordered so that each column is one mode followed over the sweep.

    Each step extrapolates every branch along its last step and pairs the next eigenvalues with the
    predictions so that the sum of the distances is least. So modes keep their identity where
    their frequencies cross.

    Parameters
    ----------
    eigenvalues : array_like, (n, m)
        λ of m modes at n neighbouring points of a sweep [1/s].

    Returns
    -------
    complex array, (n, m)
        The same values, each row reordered. The first row runs from the highest frequency down.
    """
    branches = np.array(eigenvalues, dtype=complex)
    if len(branches) == 0:
        return branches
    branches[0] = branches[0][np.lexsort((branches[0].real, -branches[0].imag))]
    for i in range(1, len(branches)):
        last = branches[i - 1]
        predicted = last if i == 1 else 2.0 * last - branches[i - 2]
        _, order = linear_sum_assignment(np.abs(predicted[:, None] - branches[i][None, :]))
        branches[i] = branches[i][order]
    return branches


def _rigid(rotor: Rotor, K: Array, C: Array) -> Array:
    M = rotor.half_mass
    A = np.zeros((*K.shape[:-2], 4, 4))
    A[..., :2, 2:] = _I
    A[..., 2:, :2] = -K / M
    A[..., 2:, 2:] = -(C + rotor.disk_damping * _I) / M
    return A


def _massless_journals(rotor: Rotor, K: Array, C: Array) -> Array:
    """Return A over (disk, journal, disk velocity): the journal moves as film and shaft balance."""
    k, m = rotor.shaft_stiffness, rotor.disk_mass
    mobility = np.linalg.inv(C)
    A = np.zeros((*K.shape[:-2], 6, 6))
    A[..., :2, 4:] = _I
    A[..., 2:4, :2] = k * mobility
    A[..., 2:4, 2:4] = -mobility @ (K + k * _I)
    A[..., 4:, :2] = -k / m * _I
    A[..., 4:, 2:4] = k / m * _I
    A[..., 4:, 4:] = -rotor.disk_damping / m * _I
    return A


def _with_journal_mass(rotor: Rotor, K: Array, C: Array) -> Array:
    """Return A over (disk, journal, disk velocity, journal velocity)."""
    k, m, m_j = rotor.shaft_stiffness, rotor.disk_mass, rotor.journal_mass
    A = np.zeros((*K.shape[:-2], 8, 8))
    A[..., :4, 4:] = np.eye(4)
    A[..., 4:6, :2] = -k / m * _I
    A[..., 4:6, 2:4] = k / m * _I
    A[..., 4:6, 4:6] = -rotor.disk_damping / m * _I
    A[..., 6:, :2] = k / m_j * _I
    A[..., 6:, 2:4] = -(K + k * _I) / m_j
    A[..., 6:, 6:] = -C / m_j
    return A
