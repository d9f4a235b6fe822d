"""Free motion about equilibrium: eigenvalues, mode shapes, frequencies and damping of each mode.

Model: the film's linear stiffness and damping at one running speed; the rotor as one disk on a
massless shaft, the whole per bearing. States, X and Y of each: a rigid rotor has the journal's
position and velocity (4); a flexible one the disk's position and velocity and the journal's
position (6), and with journal mass the journal's velocity too (8). A film with inner coordinates
adds their positions, and the velocities of those that have a mass.

Source: San Andrés, Notes 5, Eq. 5.38 (rigid), and the calculation sheet (flexible); midspan damping
and journal mass are the two extensions that the sheet leaves to the reader.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rotorcalc import state_matrices
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray, IntArray, complex_array, real_array
from rotorcalc.branches import follow_branches as follow_branches  # noqa: PLC0414 - its known name
from rotorcalc.display import Result
from rotorcalc.films.dynamics import NO_INERTIA
from rotorcalc.machine import Rotor
from rotorcalc.wide_spectra import inner_eigenpairs, inner_eigenvalues

_I = np.eye(2)
# Newton's steps from a good first guess, at most, and the size of the last step relative to λ:
# below the first no further step is needed, above the second λ has not converged. Between them lie
# modes close together, each of which is ill-conditioned.
_REFINEMENTS = 8
_NO_NEED, _SETTLED = 1e-14, 1e-9
# Distance from a pole of the journal's impedance, over its size.
_BESIDE = 1e-14


@dataclass(frozen=True, eq=False)
class ModeShapes(Result):
    """The free motions e^{λt} of a machine: eigenvalues λ and mode shapes.

    A mode's motion is Re{P e^{λt}}, P its phasors here. Each mode is scaled so that the largest of
    its displacements is 1, inner coordinates included.

    Attributes
    ----------
    eigenvalues : complex array, (..., n)
        λ [1/s].
    vectors : complex array, (..., n, n)
        Right eigenvectors of the state matrix, a column a mode: A v = λ v. Displacements in the
        unit of the scaling, velocities in that unit per second.
    disk, journal : complex array, (..., n, 2)
        Phasors of X and Y [-], a row a mode; the same for a rigid rotor.
    inner : complex array, (..., n, i)
        Phasors of the film's inner coordinates [-], a row a mode.
    """

    eigenvalues: ComplexArray
    vectors: ComplexArray
    disk: ComplexArray
    journal: ComplexArray
    inner: ComplexArray

    def ordered(self, order: NDArray[np.intp]) -> "ModeShapes":
        """Return the modes of these indices, shape (m,), in their order."""
        return ModeShapes(
            eigenvalues=self.eigenvalues[..., order],
            vectors=self.vectors[..., order],
            disk=self.disk[..., order, :],
            journal=self.journal[..., order, :],
            inner=self.inner[..., order, :],
        )


@checked
def state_matrix(
    rotor: Rotor, K: Array, C: Array, *, inertia: Array = NO_INERTIA, flexible: bool = True
) -> Array:
    """Return the matrix A of the free motion, q̇ = A q.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    K, C : array, (..., 2+i, 2+i)
        The film's stiffness [N/m] and damping [N·s/m] in X, Y and its i inner coordinates.
    inertia : array, (i,)
        Mass of each inner coordinate [kg]; none by default.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    array, (..., n, n)
        A; n = 4 for a rigid rotor, 6 for a flexible one, 8 with journal mass, and i to 2i more
        with inner coordinates. The state holds the positions of disk, journal and inner
        coordinates, then their velocities, as far as the model has them; a rigid rotor's journal
        is its disk.
    """
    bends = flexible and not rotor.is_rigid
    if K.shape[-1] > 2:
        return state_matrices.with_inner(rotor, K, C, inertia, bends=bends)
    if not bends:
        return state_matrices.rigid(rotor, K, C)
    if rotor.journal_mass > 0.0:
        return state_matrices.with_journal_mass(rotor, K, C)
    return state_matrices.massless_journals(rotor, K, C)


@checked
def eigenvalues(
    rotor: Rotor, K: Array, C: Array, *, inertia: Array = NO_INERTIA, flexible: bool = True
) -> ComplexArray:
    """Return the eigenvalues λ of the free motion e^{λt}.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    K, C : array, (..., 2+i, 2+i)
        The film's stiffness [N/m] and damping [N·s/m] in X, Y and its i inner coordinates.
    inertia : array, (i,)
        Mass of each inner coordinate [kg]; none by default.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    complex array, (..., n)
        λ [1/s], in no particular order; n as in `state_matrix`.
    """
    if K.shape[-1] > 2:
        bends = flexible and not rotor.is_rigid
        return inner_eigenvalues(rotor, K, C, inertia, bends=bends)
    A = state_matrix(rotor, K, C, inertia=inertia, flexible=flexible)
    return np.linalg.eigvals(A).astype(complex)


@checked
def mode_shapes(
    rotor: Rotor, K: Array, C: Array, *, inertia: Array = NO_INERTIA, flexible: bool = True
) -> ModeShapes:
    """Return the eigenvalues of the free motion with the shapes of its modes.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    K, C : array, (..., 2+i, 2+i)
        The film's stiffness [N/m] and damping [N·s/m] in X, Y and its i inner coordinates.
    inertia : array, (i,)
        Mass of each inner coordinate [kg]; none by default.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    ModeShapes
        In no particular order; n as in `state_matrix`.
    """
    rigid = rotor.is_rigid or not flexible
    if K.shape[-1] > 2:
        values, vectors = inner_eigenpairs(rotor, K, C, inertia, bends=not rigid)
    else:
        values, vectors = np.linalg.eig(state_matrix(rotor, K, C, flexible=flexible))
    # Scaled by displacements alone: velocities are λ times as large, in another unit.
    positions = vectors[..., : K.shape[-1] + (0 if rigid else 2), :]
    largest = np.argmax(np.abs(positions), axis=-2)[..., None, :]
    vectors = vectors / np.take_along_axis(positions, largest, axis=-2)
    disk = vectors[..., :2, :].swapaxes(-1, -2)
    journal = disk if rigid else vectors[..., 2:4, :].swapaxes(-1, -2)
    inner = vectors[..., (2 if rigid else 4) : positions.shape[-2], :].swapaxes(-1, -2)
    return ModeShapes(
        eigenvalues=values.astype(complex),
        vectors=vectors.astype(complex),
        disk=disk.astype(complex),
        journal=journal.astype(complex),
        inner=inner.astype(complex),
    )


@checked
def inner_share(shapes: ModeShapes) -> Array:
    """Return how much of each mode is motion of the film's own parts, pads or a ring.

    Parameters
    ----------
    shapes : ModeShapes
        The modes.

    Returns
    -------
    array, (..., n)
        Sum of squares of the amplitudes of the inner coordinates over that of these and the
        journal's [-]: 0 where the parts rest, or the film has none, 1 where the journal rests.
    """
    parts, journal = (np.sum(np.abs(one) ** 2, axis=-1) for one in (shapes.inner, shapes.journal))
    return parts / (parts + journal)


@checked
def refined_eigenvalues(
    rotor: Rotor, K: Array, C: Array, *, inertia: Array = NO_INERTIA, flexible: bool = True
) -> ComplexArray:
    """Return the eigenvalues λ of the free motion, each to its own rounding error.

    A matrix eigenvalue has a rounding error of the matrix's largest entries, which for a light
    load, a stiff shaft or a light journal is far more than a mode's growth rate. Newton's method on
    the impedance of the machine removes that error.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    K, C : array, (..., 2+i, 2+i)
        The film's stiffness [N/m] and damping [N·s/m] in X, Y and its i inner coordinates.
    inertia : array, (i,)
        Mass of each inner coordinate [kg]; none by default.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    complex array, (..., m)
        λ [1/s], in no particular order, m > n as in `state_matrix`. Some occur more than once; NaN
        where Newton's method does not converge.

    Notes
    -----
    With Z = K + λC + λ²M_j I for film and journal, z = λ²m_d + λC_s for the disk and s = 1/K_rot
    for the shaft, the free motion's journal j obeys W j = (Z + z I + s z Z) j = 0, as the
    synchronous response does with jΩ for λ. Newton's step for det W = 0 is −1/tr(W⁻¹ dW/dλ). It
    starts from the matrix eigenvalues, and from those of simpler machines, which are the limits of
    the least accurate ones: with massless journals, and, of the slow ones, K + λ(C + C_s I).
    """
    values = _first_guesses(rotor, K, C, inertia, flexible)
    step = values
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        for _ in range(_REFINEMENTS):
            step = _newton_step(rotor, _impedance(K, C, inertia, values), values, flexible)
            values = values + step
            if np.all(np.abs(step) <= _NO_NEED * np.abs(values)):
                break
        return np.where(np.abs(step) <= _SETTLED * np.abs(values), values, np.nan)


@checked
def characteristic_polynomial(rotor: Rotor, K: Array, C: Array, *, flexible: bool = True) -> Array:
    """Return the polynomial in λ whose roots are the eigenvalues of the free motion.

    With Z = K + λC for the film and the rotor's D = 1 + s z, N = λ²M_j D + z, in the symbols of
    `refined_eigenvalues`, det(D Z + N I) = D² det Z + D N tr Z + N².

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
    array, (..., n+1)
        Coefficients from the constant to that of λⁿ, n as in `state_matrix`. Where det K, det C
        and so on are positive, each is a sum of positive terms and has their relative error.
    """
    return film_terms(K, C) @ rotor_terms(rotor, flexible=flexible)


@checked
def film_terms(K: NDArray[Any], C: NDArray[Any]) -> NDArray[Any]:
    """Return the film's part in `characteristic_polynomial`: of det Z, tr Z and 1, (..., 6)."""
    terms = np.ones((*K.shape[:-2], 6), dtype=K.dtype)
    terms[..., 0], terms[..., 1], terms[..., 2] = _determinant(K, C)
    terms[..., 3], terms[..., 4] = _trace(K), _trace(C)
    return terms


@checked
def rotor_terms(
    rotor: Rotor, *, flexible: bool = True, number: Callable[[float], Any] = float
) -> NDArray[Any]:
    """Return the rotor's part in `characteristic_polynomial`: of D², D N and N², (6, n+1).

    In floats, or in another type of number, such as `decimal.Decimal`.
    """
    bends = flexible and not rotor.is_rigid
    # s = 0 for the rigid shaft lowers the degree to 4, so one set of terms serves all rotors.
    s = 1 / number(rotor.shaft_stiffness) if bends else number(0.0)
    m_j, C_s = number(rotor.journal_mass), number(rotor.disk_damping)
    m_d = number(rotor.mass) / 2 - m_j
    zero = number(0.0)
    D = np.array([number(1.0), s * C_s, s * m_d])
    N = np.array([zero, C_s, m_d, zero, zero])
    N[2:] += m_j * D
    terms = np.full((6, 9), zero)
    for power in range(3):
        terms[power, power : power + 5] = np.convolve(D, D)
    for power in range(2):
        terms[3 + power, power : power + 7] = np.convolve(D, N)
    terms[5] = np.convolve(N, N)
    degree = 4 if s == 0 else 6 if m_j == 0 else 8
    return terms[:, : degree + 1]


def leading(eigenvalues: ArrayLike) -> ComplexArray:
    """Return the eigenvalue of the oscillating mode that decays slowest in time, the whirl.

    Its growth rate decides on stability. The least damped mode, which loses the smallest share of
    its amplitude in a period, may be another one while all decay: `least_damped`.

    Parameters
    ----------
    eigenvalues : array_like, (..., n)
        λ of all modes [1/s].

    Returns
    -------
    complex array, (...)
        The one with Im λ > 0 that decays slowest, or grows fastest; NaN where none oscillates.
    """
    values = complex_array("eigenvalues", eigenvalues)
    return _oscillating_at(leading_place(values), values)


@checked
def leading_place(eigenvalues: ComplexArray) -> IntArray:
    """Return the index of `leading`, (...); of the largest real part where none oscillates."""
    waves = eigenvalues.imag > 0.0
    counts = waves | ~np.any(waves, axis=-1, keepdims=True)
    return np.argmax(np.where(counts, eigenvalues.real, -np.inf), axis=-1)


def least_damped(eigenvalues: ArrayLike) -> ComplexArray:
    """Return the eigenvalue of the oscillating mode with the smallest logarithmic decrement.

    That is the one with the smallest damping ratio too. It is below zero where a mode grows, so
    that it says the same of stability as the largest growth rate.

    Parameters
    ----------
    eigenvalues : array_like, (..., n)
        λ of all modes [1/s].

    Returns
    -------
    complex array, (...)
        The one with Im λ > 0 of the smallest −Re λ/|Im λ|; NaN where none oscillates.
    """
    values = complex_array("eigenvalues", eigenvalues)
    return _oscillating_at(least_damped_place(values), values)


def smallest_decrement(eigenvalues: ArrayLike) -> Array:
    """Return the logarithmic decrement of the least damped mode.

    Parameters
    ----------
    eigenvalues : array_like, (..., n)
        λ of all modes [1/s].

    Returns
    -------
    array, (...)
        −2π Re λ/|Im λ| of `least_damped` [-]; infinite where no mode oscillates.
    """
    values = least_damped(eigenvalues)
    return np.where(np.isnan(values.real), np.inf, logarithmic_decrement(values))


@checked
def least_damped_place(eigenvalues: ComplexArray) -> IntArray:
    """Return the index of `least_damped`, (...); of the largest real part where none oscillates."""
    waves = eigenvalues.imag > 0.0
    decrement = logarithmic_decrement(np.where(waves, eigenvalues, 1j))
    place = np.argmin(np.where(waves, decrement, np.inf), axis=-1)
    return np.where(np.any(waves, axis=-1), place, leading_place(eigenvalues))


def _oscillating_at(place: IntArray, values: ComplexArray) -> ComplexArray:
    """Return the eigenvalue at an index, (...); NaN where it does not oscillate."""
    value: ComplexArray = np.take_along_axis(values, place[..., None], axis=-1)[..., 0]
    return np.where(value.imag > 0.0, value, complex(np.nan, np.nan))


def damped_frequency(eigenvalue: ArrayLike) -> Array:
    """Return the frequency of a mode, ω_d = |Im λ| [rad/s], shape (...) of `eigenvalue` [1/s]."""
    return np.abs(complex_array("eigenvalue", eigenvalue).imag)


def natural_frequency(eigenvalue: ArrayLike) -> Array:
    """Return the natural frequency, ω_n = |λ| [rad/s], shape (...) of `eigenvalue` [1/s]."""
    return np.abs(complex_array("eigenvalue", eigenvalue))


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
    lam = complex_array("eigenvalue", eigenvalue)
    return -lam.real / np.abs(lam)


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
    lam = complex_array("eigenvalue", eigenvalue)
    with np.errstate(divide="ignore"):
        return -2.0 * np.pi * lam.real / np.abs(lam.imag)


def undamped_frequency(stiffness: ArrayLike, mass: ArrayLike) -> Array:
    """Return the frequency of a mass on a spring, ω = √(K/M).

    With the film's K_eq it is the whirl frequency of a rigid rotor at its threshold (Eq. 5.47),
    with K_rot the natural frequency of the shaft in rigid bearings (calculation sheet).

    Parameters
    ----------
    stiffness : array_like, (...)
        K [N/m].
    mass : array_like, (...)
        M [kg].

    Returns
    -------
    array, (...)
        ω [rad/s]; NaN where the stiffness is negative.
    """
    ratio = real_array("stiffness", stiffness) / real_array("mass", mass)
    return np.sqrt(np.where(ratio < 0.0, np.nan, ratio))


def _first_guesses(
    rotor: Rotor, K: Array, C: Array, inertia: Array, flexible: bool
) -> ComplexArray:
    """Return eigenvalues of the machine and of simpler ones, (..., m), none of them refined."""
    found = [eigenvalues(rotor, K, C, inertia=inertia, flexible=flexible)]
    if K.shape[-1] == 2:
        found.append(_slow(K, C + rotor.disk_damping * _I))
        if flexible and not rotor.is_rigid and rotor.journal_mass > 0.0:
            A = state_matrices.massless_journals(rotor, K, C)
            found.append(np.linalg.eigvals(A).astype(complex))
    return np.concatenate(found, axis=-1)


def _slow(K: Array, C: Array) -> ComplexArray:
    """Return λ of K + λC: the roots of its determinant, (..., 2)."""
    # aλ² + 2bλ + c = 0, by the form without cancellation: q = −b ∓ √(b² − ac), λ = q/a and c/q.
    c, twice_b, a = _determinant(K, C)
    b = 0.5 * twice_b
    q = -b - np.copysign(np.sqrt(np.maximum(b * b - a * c, 0.0)), b)
    swing = 1j * np.sqrt(np.maximum(a * c - b * b, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.stack([(q + swing) / a, np.where(swing == 0.0, c / q, (q - swing) / a)], axis=-1)


def _determinant(
    K: NDArray[Any], C: NDArray[Any]
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Return det(K + λC): det K, K : adj C and det C, the coefficients of 1, λ and λ²."""
    return _mixed(K, K), _mixed(K, C) + _mixed(C, K), _mixed(C, C)


# Not within `_determinant`: its annotations would be evaluated at each call, for half of its time.
def _mixed(A: NDArray[Any], B: NDArray[Any]) -> NDArray[Any]:
    """Return the product of one matrix's first row and another's second in the determinant."""
    return A[..., 0, 0] * B[..., 1, 1] - A[..., 0, 1] * B[..., 1, 0]


def _trace(A: NDArray[Any]) -> NDArray[Any]:
    return A[..., 0, 0] + A[..., 1, 1]


def _impedance(
    K: Array, C: Array, inertia: Array, lam: ComplexArray
) -> tuple[ComplexArray, ComplexArray]:
    """Return the film's Z and dZ/dλ of the journal alone at each λ, (..., m, 2, 2).

    The inner coordinates are eliminated, q_i = −Z_ii⁻¹ Z_iq q.
    """
    at = lam[..., None, None]
    mass = np.diag(np.concatenate([np.zeros(2), inertia]))
    Z = K[..., None, :, :] + at * (C[..., None, :, :] + at * mass)
    dZ = C[..., None, :, :] + 2.0 * at * mass
    if K.shape[-1] == 2:
        return Z, dZ
    # Where inner coordinates alone swing, as pads that balance one another, the journal's Z has a
    # pole: it is taken just beside that. Rounding may find it in the transposed matrix alone.
    inner = Z[..., 2:, 2:]
    turned = inner.swapaxes(-1, -2)
    at_pole = (np.linalg.det(inner) == 0.0) | (np.linalg.det(turned) == 0.0)
    aside = _BESIDE * np.abs(inner).max(axis=(-2, -1)) * at_pole
    inner = inner + aside[..., None, None] * np.eye(inner.shape[-1])
    # Derivative of Z_qq − Z_qi Z_ii⁻¹ Z_iq, with `drives` = −Z_qi Z_ii⁻¹.
    follows = -np.linalg.solve(inner, Z[..., 2:, :2])
    drives = -np.linalg.solve(inner.swapaxes(-1, -2), Z[..., :2, 2:].swapaxes(-1, -2))
    drives = drives.swapaxes(-1, -2)
    change = dZ[..., :2, :2] + dZ[..., :2, 2:] @ follows
    change = change + drives @ (dZ[..., 2:, :2] + dZ[..., 2:, 2:] @ follows)
    return Z[..., :2, :2] + Z[..., :2, 2:] @ follows, change


def _newton_step(
    rotor: Rotor,
    film: tuple[ComplexArray, ComplexArray],
    lam: ComplexArray,
    flexible: bool,
) -> ComplexArray:
    """Return −1/tr(W⁻¹ dW) = −det W/tr(adj W · dW) of the machine's impedance W at each λ."""
    # W = Z(1 + s z) + (λ²M_j(1 + s z) + z) I and its derivative, in the symbols of the caller.
    s, m = 1.0 / rotor.shaft_stiffness if flexible else 0.0, rotor.journal_mass
    z = lam * (lam * rotor.disk_mass + rotor.disk_damping)
    dz = 2.0 * lam * rotor.disk_mass + rotor.disk_damping
    bent, d_bent = 1.0 + s * z, s * dz
    inertia = lam * lam * m * bent + z
    d_inertia = 2.0 * lam * m * bent + lam * lam * m * d_bent + dz
    Z, dZ = film

    def element(i: int, j: int) -> tuple[ComplexArray, ComplexArray]:
        W, dW = Z[..., i, j] * bent, dZ[..., i, j] * bent + Z[..., i, j] * d_bent
        return (W + inertia, dW + d_inertia) if i == j else (W, dW)

    (W_xx, dW_xx), (W_xy, dW_xy) = element(0, 0), element(0, 1)
    (W_yx, dW_yx), (W_yy, dW_yy) = element(1, 0), element(1, 1)
    slope = W_yy * dW_xx + W_xx * dW_yy - W_xy * dW_yx - W_yx * dW_xy
    return (W_xy * W_yx - W_xx * W_yy) / slope
