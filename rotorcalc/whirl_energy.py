"""The energy of whirl: what the film's cross-coupling feeds in and damping dissipates.

The cross-coupled stiffness acts as a follower force: on a forward orbit it acts along the motion
and feeds energy in, which the damping of film and disk dissipates. A free motion grows where more
is fed in than dissipated; at the threshold the two are equal.

Source: San Andrés, Notes 5, Eq. 5.14 and Appendix A.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray, checked_speed, complex_array, real_array
from rotorcalc.coefficients import stiffness_and_damping
from rotorcalc.display import Result
from rotorcalc.machine import Machine, Rotor
from rotorcalc.onset import Onset

_I = np.eye(2)
_CIRCLE: ComplexArray = np.array([1.0, -1.0j])  # turns forward


@dataclass(frozen=True, eq=False)
class WhirlOrbit(Result):
    """The orbit in which a machine whirls at its onset.

    Attributes
    ----------
    speed : float
        Onset speed, Ω_s [rad/s].
    frequency : float
        Whirl frequency, ω_s [rad/s].
    journal, disk : complex array, (2,)
        Phasors of X and Y; the journal's ellipse has the area 1.
    """

    speed: float
    frequency: float
    journal: ComplexArray
    disk: ComplexArray


@dataclass(frozen=True, eq=False)
class WhirlEnergy(Result):
    """Energy gained and lost by the whirl orbit in one turn at each speed, each of shape (...).

    Energies are per bearing, per turn and per area of the journal's orbit [J/m² = N/m].

    Attributes
    ----------
    speed : array
        Running speed, Ω [rad/s].
    fed_in : array
        Work of the cross-coupled stiffness, K_XY − K_YX.
    film_loss, disk_loss : array
        Dissipation by the film's damping and by the disk's.
    """

    speed: Array
    fed_in: Array
    film_loss: Array
    disk_loss: Array


def orbit_area(orbit: ArrayLike) -> Array:
    """Return the area that an orbit encloses, A = ∮x dy = π Im(x ȳ).

    Parameters
    ----------
    orbit : array_like, (..., 2)
        Phasors of X and Y, in any one unit.

    Returns
    -------
    array, (...)
        Area in that unit squared; positive where the orbit turns forward.

    Examples
    --------
    >>> float(orbit_area([2.0, -1.0j]) / np.pi)
    2.0
    """
    x, y = np.moveaxis(complex_array("orbit", orbit, ends=(2,)), -1, 0)
    # With x = Re{X e^{jτ}} and y = Re{Y e^{jτ}}; (1, −j), a forward circle, has the area π.
    return np.pi * np.imag(x * np.conj(y))


def stiffness_work(K: ArrayLike, orbit: ArrayLike) -> Array:
    """Return the work that a stiffness does on the journal in one orbit, −∮xᵀKᵀdx.

    The symmetric part of K is that of a spring and does no work over a cycle; the skew part does
    the work (K_XY − K_YX)·A, for any ellipse at any frequency.

    Parameters
    ----------
    K : array_like, (..., 2, 2)
        Stiffness in X, Y [N/m].
    orbit : array_like, (..., 2)
        Phasors of X and Y [m].

    Returns
    -------
    array, (...)
        Work [J]; positive where it drives the orbit.
    """
    stiffness = real_array("K", K, ends=(2, 2))
    # ∮x dy = A and ∮y dx = −A, while ∮x dx = ∮y dy = 0: only the cross terms are left.
    return (stiffness[..., 0, 1] - stiffness[..., 1, 0]) * orbit_area(orbit)


def damping_work(C: ArrayLike, orbit: ArrayLike, frequency: ArrayLike) -> Array:
    """Return the energy dissipated by a damping in one orbit, ∮ẋᵀC dx = πω P*C P.

    Parameters
    ----------
    C : array_like, (..., 2, 2)
        Damping in X, Y [N·s/m]. Its skew part dissipates nothing.
    orbit : array_like, (..., 2)
        Phasors of X and Y, P [m].
    frequency : array_like, (...)
        Frequency of the orbit, ω [rad/s].

    Returns
    -------
    array, (...)
        Energy [J]; positive where it brakes the orbit.
    """
    P = complex_array("orbit", orbit, ends=(2,))
    damping = real_array("C", C, ends=(2, 2))
    quadratic = np.einsum("...i,...ij,...j->...", np.conj(P), damping, P)
    return np.pi * real_array("frequency", frequency) * quadratic.real


@checked
def whirl_orbit(machine: Machine, onset: Onset) -> WhirlOrbit:
    """Return the orbit in which a machine whirls at its onset.

    Parameters
    ----------
    machine : Machine
        The machine.
    onset : Onset
        Its onset, as `onset_speed` finds it.

    Returns
    -------
    WhirlOrbit
        Of the mode whose eigenvalue lies on the imaginary axis there. Where the onset is at speed
        0, a circle.

    Raises
    ------
    ValueError
        Where the machine has no onset.
    """
    if not math.isfinite(onset.speed):
        raise ValueError(f"onset = {onset.speed} rad/s: without an onset there is no whirl orbit")
    # Without load film and disk whirl infinitely slowly about the centre: a circle by symmetry.
    if onset.speed == 0.0:
        circle = _CIRCLE / np.complex128(math.sqrt(np.pi))
        return WhirlOrbit(speed=0.0, frequency=0.0, journal=circle, disk=circle)
    K, C = _film(machine, np.asarray(onset.speed), onset.whirl_frequency)
    lam = np.array(1j * onset.whirl_frequency)
    disk, journal = _mode_shape(machine.rotor, K, C, lam)
    # A linear whirl has no size of its own: the journal's orbit gets the area 1.
    size = math.sqrt(abs(float(orbit_area(journal))))
    return WhirlOrbit(
        speed=onset.speed,
        frequency=onset.whirl_frequency,
        journal=journal / size,
        disk=disk / size,
    )


@checked
def whirl_energy(machine: Machine, speed: ArrayLike, orbit: WhirlOrbit) -> WhirlEnergy:
    """Return the energy that a whirl orbit gains and loses in one turn at other speeds.

    The orbit keeps its shape and frequency; the film is that of each speed's equilibrium, its
    stiffness and damping those of a whirl at that frequency. At the orbit's own speed gain and loss
    are equal.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speeds, Ω [rad/s].
    orbit : WhirlOrbit
        The orbit at the machine's onset.

    Returns
    -------
    WhirlEnergy
        Its fields have the shape (...).

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.

    Notes
    -----
    For any free motion e^{λt} of the machine, with P_j and P_d the phasors of journal and disk,
    the balance of journal and disk multiplied by P_j* and P_d* leaves

        gain − loss = 2π Im λ Re λ (M_j |P_j|² + m_d |P_d|²),

    which vanishes with the growth Re λ.
    """
    omega = checked_speed(speed)
    K, C = _film(machine, omega, orbit.frequency)
    disk_damping = machine.rotor.disk_damping * _I
    return WhirlEnergy(
        speed=omega,
        fed_in=stiffness_work(K, orbit.journal),
        film_loss=damping_work(C, orbit.journal, orbit.frequency),
        # The damper sees the same orbit at every speed, whatever the film.
        disk_loss=np.broadcast_to(
            damping_work(disk_damping, orbit.disk, orbit.frequency), omega.shape
        ),
    )


def _film(machine: Machine, speed: Array, frequency: float) -> tuple[Array, Array]:
    """Return the film's K and C at speeds (...) for a whirl at a frequency, (..., 2, 2).

    Pads, rings and gases answer each frequency in another way. Frequency 0, as without load, has
    no ratio: the synchronous coefficients stand in.
    """
    ratio = frequency / speed if frequency > 0.0 else 1.0
    return stiffness_and_damping(machine, speed, whirl_ratio=ratio)


def _mode_shape(
    rotor: Rotor, K: Array, C: Array, lam: ComplexArray
) -> tuple[ComplexArray, ComplexArray]:
    """Return the phasors of disk and journal in the mode λ, (..., 2), the journal's of length 1.

    The impedance W of `modes.refined_eigenvalues` is singular at λ; the journal's phasor is normal
    to both of its rows, and the longer row gives it with the smaller error.
    """
    lam = lam[..., None, None]
    Z = K + lam * C + lam**2 * rotor.journal_mass * _I
    z = lam**2 * rotor.disk_mass + lam * rotor.disk_damping
    compliance = _I + Z / rotor.shaft_stiffness
    W = Z + z * compliance
    longer = np.argmax(np.abs(W).sum(axis=-1), axis=-1)[..., None, None]
    row = np.take_along_axis(W, longer, axis=-2)[..., 0, :]
    journal = np.stack([-row[..., 1], row[..., 0]], axis=-1)  # W j = 0
    journal = journal / np.linalg.norm(journal, axis=-1, keepdims=True)
    return np.einsum("...ij,...j->...i", compliance, journal), journal
