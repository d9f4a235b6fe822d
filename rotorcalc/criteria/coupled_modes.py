"""Free motion of a machine whose disk a fluid drives forward: cross-coupled stiffness at midspan.

Steam or gas around an impeller pushes a displaced disk at right angles to its displacement,
F_x = −Q y and F_y = Q x with X turning to Y: along the path of a forward whirl, so that Q > 0
feeds it and damps a backward one. The rotor is symmetric and Q is the whole machine's: the half of
the rotor on each bearing has Q/2.
"""

import numpy as np

from rotorcalc import modes
from rotorcalc.arrays import Array, BoolArray, ComplexArray
from rotorcalc.films import FilmDynamics
from rotorcalc.machine import Rotor

# K_xy = +q, K_yx = −q: the force on the disk is −K x.
_FORWARD = np.array([[0.0, 1.0], [-1.0, 0.0]])
_I = np.eye(2)
# Newton's steps at most, the size of the last step over λ below which no further is needed, and
# above which λ has not converged. With an impedance the steps shrink by a factor only.
_STEPS, _NO_NEED, _SETTLED = 60, 1e-14, 1e-9
# Ratio of an orbit's axes below which it counts as a line, and share of the inertia's force below
# which no force acts.
_LINE, _ALIKE = 0.005, 1e-8
# A refined eigenvalue further than this from the matrix's own, relative, is another one.
_SAME = 1e-6


def coupled_eigenvalues(rotor: Rotor, film: FilmDynamics, cross_coupling: Array) -> ComplexArray:
    """Return the eigenvalues λ of a machine with cross-coupled stiffness at midspan.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    film : FilmDynamics
        The film of one bearing at one speed [N/m], [N·s/m], [kg].
    cross_coupling : array, (m,)
        Q of the whole machine [N/m].

    Returns
    -------
    complex array, (m, n)
        λ [1/s], in no particular order; n as in `modes.state_matrix`. Of a film that is known by
        its impedance each is that of the film at its own frequency |λ|, NaN where none was found.
    """
    q = cross_coupling / 2.0
    first = np.linalg.eigvals(_state_matrices(rotor, film, q)).astype(complex)
    found, settled = _refined(rotor, film, q, first)
    if film.at is not None:
        return np.where(settled, found, complex(np.nan, np.nan))
    # Newton's method may run to another eigenvalue; the matrix's own then stands.
    return np.where(settled & (np.abs(found - first) <= _SAME * np.abs(first)), found, first)


def disk_whirls_forward(
    rotor: Rotor, film: FilmDynamics, cross_coupling: Array, eigenvalue: ComplexArray
) -> BoolArray:
    """Return whether the disk turns forward, or along a line, in each mode.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    film : FilmDynamics
        The film of one bearing at one speed [N/m], [N·s/m], [kg].
    cross_coupling : array, (m,)
        Q of the whole machine [N/m].
    eigenvalue : complex array, (m, n)
        λ of its modes [1/s]; NaN where one is not known.

    Returns
    -------
    boolean array, (m, n)
        False where λ is not known.
    """
    known = ~np.isnan(eigenvalue)
    lam = np.where(known, eigenvalue, 1j)
    W, _ = _impedance(rotor, film, cross_coupling / 2.0, lam)
    # The motion on which no force acts: the right singular vector of the smallest value.
    motion = np.linalg.svd(W)[2][..., -1, :].conj()
    forward, backward = (np.abs(motion[..., 0] + sign * motion[..., 1]) for sign in (1j, -1j))
    # Alike in X and Y, forward and backward have one λ: no force acts on any motion of the disk.
    inertia = np.abs(lam) ** 2 * rotor.half_mass
    alike = np.abs(_of_disk(W)).max(axis=(-2, -1)) <= _ALIKE * inertia
    return known & ((forward - backward >= -_LINE * (forward + backward)) | alike)


def _of_disk(W: ComplexArray) -> ComplexArray:
    """Return the impedance of the disk alone, the film's inner coordinates free, (..., 2, 2)."""
    if W.shape[-1] == 2:
        return W
    inner = np.linalg.solve(W[..., 2:, 2:], W[..., 2:, :2])
    return W[..., :2, :2] - W[..., :2, 2:] @ inner


def _state_matrices(rotor: Rotor, film: FilmDynamics, q: Array) -> Array:
    """Return the state matrices A of each q, (m, n, n)."""
    A = modes.state_matrix(rotor, film.stiffness, film.damping, inertia=film.inertia)
    # Positions come first in every state, then velocities, the disk's ahead of all others.
    disk = film.stiffness.shape[-1] + (0 if rotor.is_rigid else 2)
    mass = rotor.half_mass if rotor.is_rigid else rotor.disk_mass
    coupled = np.repeat(A[None], len(q), axis=0)
    coupled[:, disk : disk + 2, :2] -= (q / mass)[:, None, None] * _FORWARD
    return coupled


def _refined(
    rotor: Rotor, film: FilmDynamics, q: Array, values: ComplexArray
) -> tuple[ComplexArray, BoolArray]:
    """Return eigenvalues refined by Newton's method on det W, and which have converged."""
    step = values
    with np.errstate(all="ignore"):
        for _ in range(_STEPS):
            step = _newton_step(rotor, film, q, values)
            values = values + step
            if not np.any(np.abs(step) > _NO_NEED * np.abs(values)):
                break
    return values, np.abs(step) <= _SETTLED * np.abs(values)


def _newton_step(rotor: Rotor, film: FilmDynamics, q: Array, lam: ComplexArray) -> ComplexArray:
    """Return −1/tr(W⁻¹ dW/dλ) at each λ, (m, n)."""
    W, dW = _impedance(rotor, film, q, lam)
    return -1.0 / np.trace(_solved(W, dW), axis1=-2, axis2=-1)


def _impedance(
    rotor: Rotor, film: FilmDynamics, q: Array, lam: ComplexArray
) -> tuple[ComplexArray, ComplexArray]:
    """Return the machine's impedance W and dW/dλ at each λ, (m, n, 2+i, 2+i).

    The disk's own impedance is D = z I + q J, z = λ²m_d + λC_s. It bends the shaft so that the
    journal moves by E = I + D/K_rot times the disk's displacement; film and journal then have Z E,
    and the forces on the rotor balance where W = Z E + D is singular. The film's inner coordinates
    keep their own columns.
    """
    at = lam[..., None, None]
    s, m = 1.0 / rotor.shaft_stiffness, rotor.disk_mass
    D = at * (at * m + rotor.disk_damping) * _I + q[:, None, None, None] * _FORWARD
    dD = (2.0 * at * m + rotor.disk_damping) * _I
    Z, dZ = _film_impedance(film, lam)
    Z[..., :2, :2] += at * at * rotor.journal_mass * _I
    dZ[..., :2, :2] += 2.0 * at * rotor.journal_mass * _I
    W, dW = Z.copy(), dZ.copy()
    W[..., :2] = Z[..., :2] @ (_I + s * D)
    dW[..., :2] = dZ[..., :2] @ (_I + s * D) + Z[..., :2] @ (s * dD)
    W[..., :2, :2] += D
    dW[..., :2, :2] += dD
    return W, dW


def _film_impedance(film: FilmDynamics, lam: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    """Return the film's Z and dZ/dλ with its inner coordinates at each λ, (m, n, 2+i, 2+i)."""
    at = lam[..., None, None]
    frequency = np.maximum(np.abs(lam), np.finfo(float).tiny)
    K, C = (film.stiffness, film.damping) if film.at is None else film.at(frequency)
    mass = np.diag(np.concatenate([np.zeros(2), film.inertia]))
    return K + at * (C + at * mass), C + 2.0 * at * mass + 0.0 * at


def _solved(W: ComplexArray, dW: ComplexArray) -> ComplexArray:
    """Return W⁻¹ dW; infinite where W is singular to the last bit: λ is then exact."""
    exact = (np.linalg.det(W) == 0.0)[..., None, None]
    # An infinite trace makes the step zero.
    solved = np.linalg.solve(np.where(exact, np.eye(W.shape[-1]), W), dW)
    return np.where(exact, np.inf, solved)
