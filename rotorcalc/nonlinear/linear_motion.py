"""The motion of a machine by the linear theory from any start, inner coordinates included.

The equations of motion with the film's stiffness and damping in place of its force,

    M q̈ + D q̇ + K q = f e^{jΩt},

over disk, journal and inner coordinates q; those without mass are of first order. A motion is the
forced one and all modes of the free one, each with the share that the start gives it.

Source: San Andrés, Notes 5, Eq. 5.38 and the calculation sheet.
"""

from dataclasses import dataclass

import numpy as np

from rotorcalc import modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray, IntArray
from rotorcalc.coefficients import dynamics, equilibrium, operating_points
from rotorcalc.films import InnerMotion, film_of
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.equations import Start, inner_rest, resting


@dataclass(frozen=True, eq=False)
class LinearMotion:
    """The linear theory of a machine at one speed; n coordinates, m states.

    Attributes
    ----------
    eigenvalues : complex array, (m,)
        λ [1/s].
    vectors : complex array, (m, m)
        Modes, one per column: all positions, then the velocities of the coordinates with mass.
    forced : complex array, (n,)
        Phasors of the response to imbalance [m].
    heavy : integer array
        The coordinates with mass.
    journal : slice
        The journal's coordinates.
    """

    eigenvalues: ComplexArray
    vectors: ComplexArray
    forced: ComplexArray
    heavy: IntArray
    journal: slice

    @property
    def whirl(self) -> complex:
        """λ of the oscillating mode that decays slowest or grows fastest [1/s]."""
        return complex(modes.leading(self.eigenvalues))


@checked
def linear_motion(machine: Machine, speed: float, start: Start, time: Array) -> Array:
    """Return the journal's motion by the linear theory, about its equilibrium.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s].
    start : Start
        The state at t = 0.
    time : array, (n,)
        t [s].

    Returns
    -------
    array, (n, 2)
        Displacement from rest in X, Y [m].
    """
    return motion_of(linear_theory(machine, speed), machine, speed, start, time)


@checked
def linear_theory(machine: Machine, speed: float) -> LinearMotion:
    """Return the modes and the response to imbalance of a machine at one speed."""
    M, D, K = _matrices(machine, speed)
    heavy, light = np.flatnonzero(M > 0.0), np.flatnonzero(M == 0.0)
    n, m = len(M), len(M) + len(heavy)
    velocity = np.zeros((n, m))
    velocity[heavy, n + np.arange(len(heavy))] = 1.0
    if len(light):  # their velocity follows from the balance of forces
        force = -K[light] @ np.eye(n, m) - D[np.ix_(light, heavy)] @ velocity[heavy]
        velocity[light] = np.linalg.solve(D[np.ix_(light, light)], force)
    # M v̇ = −K q − D q̇ for the coordinates with mass.
    pull = (-K[heavy] @ np.eye(n, m) - D[heavy] @ velocity) / M[heavy, None]
    values, vectors = np.linalg.eig(np.vstack([velocity, pull]))
    # Eq. 5.38 for the synchronous motion: Z q = m_d u Ω² (1, −j) at the disk.
    Z = K + 1j * speed * D - speed**2 * np.diag(M)
    imbalance = np.zeros(n, dtype=complex)
    rotor = machine.rotor
    # (cos Ωt, sin Ωt) as phasors; on the disk, whose coordinates come first.
    imbalance[:2] = rotor.disk_mass * rotor.imbalance * speed**2 * np.array([1.0, -1.0j])
    return LinearMotion(
        eigenvalues=values.astype(complex),
        vectors=vectors.astype(complex),
        forced=np.linalg.solve(Z, imbalance).astype(complex),
        heavy=heavy,
        journal=slice(0, 2) if rotor.is_rigid else slice(2, 4),
    )


@checked
def motion_of(
    theory: LinearMotion, machine: Machine, speed: float, start: Start, time: Array
) -> Array:
    """Return the journal's displacement from rest over time, (n, 2) [m], as `linear_motion`."""
    places, velocities = _away(machine, speed, start)
    forced, heavy = theory.forced, theory.heavy
    away = np.concatenate([
        places - forced.real, velocities[heavy] - (1j * speed * forced[heavy]).real
    ])  # fmt: skip
    shares = np.linalg.solve(theory.vectors, away.astype(complex))
    # Each phasor turns at its λ, that of the forced motion at jΩ; of the free motion's conjugate
    # pairs one stands for both.
    values = theory.eigenvalues
    one = values.imag >= 0.0
    twice = np.where(values[one].imag > 0.0, 2.0, 1.0)
    free = theory.vectors[theory.journal][:, one].T
    phasors = np.vstack([(twice * shares[one])[:, None] * free, forced[theory.journal]])
    # A mode that grows overflows in time; charts cut the motion off long before.
    with np.errstate(over="ignore", invalid="ignore"):
        turning = np.exp(time[:, None] * np.append(values[one], 1j * speed))
        return np.real(turning @ phasors)


@checked
def started(machine: Machine, speed: float, places: Array, velocities: Array) -> Start:
    """Return a start at these displacements from rest [m] and velocities [m/s] of all coordinates.

    In the order of `LinearMotion.forced`.
    """
    C = machine.bearing.radial_clearance
    rest = resting(machine, equilibrium(machine, speed).film.position * C)
    journal = slice(0, 2) if machine.rotor.is_rigid else slice(2, 4)
    inner = None
    if film_of(machine.bearing).inner > 0:
        own = slice(journal.stop, None)
        massive = dynamics(machine, speed).inertia > 0.0
        # A coordinate without mass has a position but no velocity among its states.
        inner = np.append(_inner_rest(machine, speed) + places[own], velocities[own][massive])
    return Start(
        journal=rest.journal + places[journal],
        disk=rest.disk + places[:2],
        journal_velocity=velocities[journal],
        disk_velocity=velocities[:2],
        inner=inner,
    )


def _matrices(machine: Machine, speed: float) -> tuple[Array, Array, Array]:
    """Return M (n,), D and K (n, n) of disk, journal (one for a rigid shaft) and the film's."""
    rotor, film = machine.rotor, dynamics(machine, speed)
    if film.at is not None:
        raise ValueError(
            f"bearing = {machine.bearing.geometry.kind}: its film is known in a whirl of one "
            "frequency only, which gives no motion in time"
        )
    first = 0 if rotor.is_rigid else 2  # of the film's coordinates
    n = first + 2 + film.inertia.size
    M, D, K = np.zeros(n), np.zeros((n, n)), np.zeros((n, n))
    D[first:, first:], K[first:, first:] = film.damping, film.stiffness
    M[first : first + 2], M[first + 2 :] = rotor.journal_mass, film.inertia
    M[:2] = rotor.half_mass if rotor.is_rigid else rotor.disk_mass
    D[:2, :2] += rotor.disk_damping * np.eye(2)
    if not rotor.is_rigid:
        shaft = rotor.shaft_stiffness * np.eye(2)
        K[:4, :4] += np.block([[shaft, -shaft], [-shaft, shaft]])
    return M, D, K


def _away(machine: Machine, speed: float, start: Start) -> tuple[Array, Array]:
    """Return a start's displacements from rest and velocities, in the order of `_matrices`."""
    C = machine.bearing.radial_clearance
    rest = resting(machine, equilibrium(machine, speed).film.position * C)
    places, velocities = [start.disk - rest.disk], [start.disk_velocity]
    if not machine.rotor.is_rigid:
        places.append(start.journal - rest.journal)
        velocities.append(start.journal_velocity)
    inner, inner_velocities = _inner_away(machine, speed, start)
    return np.concatenate([*places, inner]), np.concatenate([*velocities, inner_velocities])


def _inner_away(machine: Machine, speed: float, start: Start) -> tuple[Array, Array]:
    """Return the same of the film's inner coordinates; zero where the start gives none."""
    film = film_of(machine.bearing)
    still = np.zeros(film.inner)
    if film.inner == 0:
        return still, still
    if start.inner is None:
        beside = inner_rest(machine, speed, start.journal)[: film.inner]
        return machine.bearing.radial_clearance * beside - _inner_rest(machine, speed), still
    velocities = still.copy()
    velocities[dynamics(machine, speed).inertia > 0.0] = start.inner[film.inner :]
    return start.inner[: film.inner] - _inner_rest(machine, speed), velocities


def _inner_rest(machine: Machine, speed: float) -> Array:
    """Return the positions of the film's inner coordinates in static equilibrium, (n,) [m]."""
    film, C = film_of(machine.bearing), machine.bearing.radial_clearance
    motion = film.motion()
    if not isinstance(motion, InnerMotion):
        return np.empty(0)
    return C * motion.rest(operating_points(machine, speed))[: film.inner]
