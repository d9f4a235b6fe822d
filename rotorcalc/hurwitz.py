"""Whether a machine's free motion decays, told by its characteristic polynomial alone.

Model: as `modes`. The film's stiffness and damping and the rotor's masses, damping and shaft make
one polynomial in λ, and Routh's scheme tells whether all its roots decay, for a hundredth of what
the roots themselves cost.

Source: San Andrés, Notes 5, Eq. 5.39 and the calculation sheet's flexible rotor; Gantmacher, The
Theory of Matrices II, chapter XV, for Routh's scheme.
"""

import numpy as np

from rotorcalc.machine import Rotor
from rotorcalc.typing import Array, BoolArray


def is_unstable(rotor: Rotor, K: Array, C: Array) -> BoolArray:
    """Return where some mode of the free motion does not decay.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    K, C : array, (..., 2, 2)
        The film's stiffness [N/m] and damping [N·s/m] in X, Y.

    Returns
    -------
    boolean array, (...)
        True where a mode grows, or neither grows nor decays.
    """
    return ~_decays(characteristic_polynomial(rotor, K, C))


def characteristic_polynomial(rotor: Rotor, K: Array, C: Array) -> Array:
    """Return the polynomial in λ whose roots are the eigenvalues of the free motion.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    K, C : array, (..., 2, 2)
        The film's stiffness [N/m] and damping [N·s/m] in X, Y.

    Returns
    -------
    array, (..., n+1)
        Coefficients from the constant to that of λⁿ; n is 4 for a rigid shaft, 6 for massless
        journals, 8 otherwise.

    Notes
    -----
    With Z = K + λC for the film, z = λ²m_d + λC_s for the disk, s = 1/K_rot for the shaft, D = 1 +
    s z and N = λ²M_j D + z, it is det(D Z + N I) = D² det Z + D N tr Z + N². All its terms are
    positive where those of det Z are, so it has no small differences.
    """
    s, m_d, m_j = 1.0 / rotor.shaft_stiffness, rotor.disk_mass, rotor.journal_mass
    z = np.array([0.0, rotor.disk_damping, m_d, 0.0, 0.0])
    D = np.array([1.0, s * rotor.disk_damping, s * m_d])
    N = z + m_j * np.array([0.0, 0.0, *D])
    film = np.stack([*_determinant(K, C), _trace(K), _trace(C), np.ones(K.shape[:-2])], axis=-1)
    of_rotor = np.zeros((6, 9))
    for power in range(3):
        of_rotor[power, power : power + 5] = np.convolve(D, D)
    for power in range(2):
        of_rotor[3 + power, power : power + 7] = np.convolve(D, N)
    of_rotor[5] = np.convolve(N, N)
    degree = 4 if rotor.is_rigid else 6 if m_j == 0.0 else 8
    return film @ of_rotor[:, : degree + 1]


def _determinant(K: Array, C: Array) -> tuple[Array, Array, Array]:
    """Return the coefficients of 1, λ and λ² in det(K + λC)."""

    def both(A: Array, B: Array) -> Array:
        return A[..., 0, 0] * B[..., 1, 1] - A[..., 0, 1] * B[..., 1, 0]

    return both(K, K), both(K, C) + both(C, K), both(C, C)


def _trace(A: Array) -> Array:
    return A[..., 0, 0] + A[..., 1, 1]


def _decays(polynomial: Array) -> BoolArray:
    """Return where all roots decay: where the first column of Routh's scheme is positive."""
    falling = np.moveaxis(polynomial, -1, 0)[::-1]
    above, row = falling[0::2], falling[1::2]
    decays = np.all(polynomial > 0.0, axis=-1)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for _ in falling[2:-1]:
            below = above[1:].copy()
            below[: len(row) - 1] -= above[0] / row[0] * row[1:]
            decays &= below[0] > 0.0
            above, row = row, below
    return decays
