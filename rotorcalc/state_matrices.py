"""The matrix A of a machine's free motion, q̇ = A q, over the states of rotor and film.

The state holds the positions of disk, journal and the film's inner coordinates, then the velocities
of those of them that have a mass; a rigid rotor's journal is its disk.
"""

import numpy as np

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.machine import Rotor

_I = np.eye(2)


def rigid(rotor: Rotor, K: Array, C: Array) -> Array:
    """Return A over (journal, its velocity), (..., 4, 4)."""
    M = rotor.half_mass
    # Eq. 5.38; on a rigid shaft the midspan damper acts beside the film's damping.
    A = np.zeros((*K.shape[:-2], 4, 4))
    A[..., :2, 2:] = _I
    A[..., 2:, :2] = -K / M
    A[..., 2:, 2:] = -(C + rotor.disk_damping * _I) / M
    return A


def massless_journals(rotor: Rotor, K: Array, C: Array) -> Array:
    """Return A over (disk, journal, disk velocity); film and shaft force balance at the journal."""
    k, m = rotor.shaft_stiffness, rotor.disk_mass
    # Without mass the journal's velocity follows from C ẋ_j = k(x_d − x_j) − K x_j.
    mobility = np.linalg.inv(C)
    A = np.zeros((*K.shape[:-2], 6, 6))
    A[..., :2, 4:] = _I
    A[..., 2:4, :2] = k * mobility
    A[..., 2:4, 2:4] = -mobility @ (K + k * _I)
    A[..., 4:, :2] = -k / m * _I
    A[..., 4:, 2:4] = k / m * _I
    A[..., 4:, 4:] = -rotor.disk_damping / m * _I
    return A


def with_journal_mass(rotor: Rotor, K: Array, C: Array) -> Array:
    """Return A over (disk, journal, disk velocity, journal velocity)."""
    k, m, m_j = rotor.shaft_stiffness, rotor.disk_mass, rotor.journal_mass
    # m ẍ_d = k(x_j − x_d) − C_s ẋ_d and m_j ẍ_j = k(x_d − x_j) − K x_j − C ẋ_j.
    A = np.zeros((*K.shape[:-2], 8, 8))
    A[..., :4, 4:] = np.eye(4)
    A[..., 4:6, :2] = -k / m * _I
    A[..., 4:6, 2:4] = k / m * _I
    A[..., 4:6, 4:6] = -rotor.disk_damping / m * _I
    A[..., 6:, :2] = k / m_j * _I
    A[..., 6:, 2:4] = -(K + k * _I) / m_j
    A[..., 6:, 6:] = -C / m_j
    return A


def with_inner(rotor: Rotor, K: Array, C: Array, inertia: Array, *, bends: bool) -> Array:
    """Return A of a rotor in a film with inner coordinates.

    Coordinates a with a mass obey m q̈ = −(K q + C q̇); for those without, b, the forces balance,
    C_bb q̇_b = −K_b q − C_ba q̇_a.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    K, C : array, (..., 2+n, 2+n)
        The film's stiffness and damping in the order X, Y, inner coordinates.
    inertia : array, (n,)
        Mass of each inner coordinate [kg].
    bends : bool
        Whether the shaft bends.

    Returns
    -------
    array, (..., p, p)
        A.
    """
    mass, stiffness, damping = (_coupled if bends else _rigidly)(rotor, K, C, inertia)
    heavy, light = np.flatnonzero(mass > 0.0), np.flatnonzero(mass == 0.0)
    n, m = len(mass), len(heavy)
    # q̇ = R q + S v, v the velocities of the coordinates with a mass.
    R, S = np.zeros((*K.shape[:-2], n, n)), np.zeros((*K.shape[:-2], n, m))
    S[..., heavy, np.arange(m)] = 1.0
    if light.size:
        balance = damping[..., light[:, None], light]
        R[..., light, :] = -np.linalg.solve(balance, stiffness[..., light, :])
        S[..., light, :] = -np.linalg.solve(balance, damping[..., light[:, None], heavy])
    resists, over_mass = damping[..., heavy, :], 1.0 / mass[heavy][:, None]
    of_place = -(stiffness[..., heavy, :] + resists @ R) * over_mass
    of_velocity = -(resists @ S) * over_mass
    below = np.concatenate([of_place, of_velocity], axis=-1)
    return np.concatenate([np.concatenate([R, S], axis=-1), below], axis=-2)


def inverse_with_inner(rotor: Rotor, K: Array, C: Array, inertia: Array, *, bends: bool) -> Array:
    """Return A⁻¹ of `with_inner`, (..., p, p), from K⁻¹; K of rotor and film is regular.

    q = −K⁻¹(C q̇ + M v̇) and v = q̇ give the state from its rates.
    """
    mass, stiffness, damping = (_coupled if bends else _rigidly)(rotor, K, C, inertia)
    heavy = np.flatnonzero(mass > 0.0)
    n, m = len(mass), len(heavy)
    momentum = np.broadcast_to(np.diag(mass)[:, heavy], (*K.shape[:-2], n, m))
    inverse = np.zeros((*K.shape[:-2], n + m, n + m))
    rates = np.concatenate([damping, momentum], axis=-1)
    inverse[..., :n, :] = -np.linalg.solve(stiffness, rates)
    inverse[..., n + np.arange(m), heavy] = 1.0
    return inverse


def resists(rotor: Rotor, K: Array, *, bends: bool) -> BoolArray:
    """Return whether K of a rotor in a film with inner coordinates is regular, (...)."""
    nothing = np.zeros(K.shape[-1] - 2)
    stiffness = (_coupled if bends else _rigidly)(rotor, K, np.zeros_like(K), nothing)[1]
    return np.asarray(np.linalg.slogdet(stiffness)[0] != 0.0)


def _rigidly(rotor: Rotor, K: Array, C: Array, inertia: Array) -> tuple[Array, Array, Array]:
    """Return masses, stiffness and damping over (journal, inner coordinates) of a rigid rotor."""
    damping = C.copy()
    damping[..., :2, :2] += rotor.disk_damping * _I
    return np.concatenate([[rotor.half_mass] * 2, inertia]), K, damping


def _coupled(rotor: Rotor, K: Array, C: Array, inertia: Array) -> tuple[Array, Array, Array]:
    """Return masses, stiffness and damping over (disk, journal, inner coordinates)."""
    n = K.shape[-1] + 2
    stiffness, damping = np.zeros((2, *K.shape[:-2], n, n))
    stiffness[..., 2:, 2:], damping[..., 2:, 2:] = K, C
    # The shaft is a spring between disk and journal, the same in X and Y.
    k, pair = rotor.shaft_stiffness, np.kron([[1.0, -1.0], [-1.0, 1.0]], _I)
    stiffness[..., :4, :4] += k * pair
    damping[..., :2, :2] += rotor.disk_damping * _I
    mass = np.concatenate([[rotor.disk_mass] * 2, [rotor.journal_mass] * 2, inertia])
    return mass, stiffness, damping
