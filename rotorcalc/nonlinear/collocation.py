"""A limit cycle as a trigonometric polynomial, and the balance of forces that it satisfies.

A cycle of frequency ω is sought as a trigonometric polynomial for the journal, x(τ), τ = ωt, that
meets the balance of film and rotor at equally spaced τ (collocation, which converges faster than
any power of their number):

    F_film(x, ẋ) − Z_rotor x + F_o = 0.

The rotor is linear, so Z_rotor is its impedance at each harmonic, exact for a rigid rotor, a
flexible one, journal mass and midspan damping.

Source: Seydel, Practical Bifurcation and Stability Analysis, third edition, section 7.2.
"""

import math
from typing import NamedTuple

import numpy as np

from rotorcalc import heat
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.films import FilmUnits, InnerMotion, film_of, journal_motion
from rotorcalc.films.model import Force
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.rotor_impedance import impedance

# Step of a difference of the film's force, as a share of the distance to kink or wall; its bounds.
_DIFFERENCE_SHARE, _SMALLEST_DIFFERENCE, _LARGEST_DIFFERENCE = 1e-3, 1e-11, 1e-6
# Relative step of the difference of the film's unit by speed.
_SPEED_STEP = 1e-4


class Cycle(NamedTuple):
    """A limit cycle: the journal's path in C, (m, 2), the whirl ratio ω/Ω, and Ω [rad/s]."""

    path: Array
    ratio: float
    speed: float

    def vector(self) -> Array:
        """Return all unknowns as one vector."""
        return np.concatenate([self.path.T.ravel(), [math.log(self.ratio), math.log(self.speed)]])

    @classmethod
    def of(cls, vector: Array) -> "Cycle":
        """Return the cycle that a vector holds."""
        path = vector[:-2].reshape(2, -1).T
        return cls(path, math.exp(vector[-2]), math.exp(vector[-1]))

    def resampled(self, points: int) -> "Cycle":
        """Return the same trigonometric polynomial at another, odd number of points."""
        m = len(self.path)
        half = np.fft.rfft(self.path, axis=0)[: (min(points, m) + 1) // 2]
        return self._replace(path=np.fft.irfft(half, n=points, axis=0) * (points / m))

    def tail(self) -> float:
        """Return the largest of the last eighth of the polynomial's coefficients, in C."""
        size = np.abs(np.fft.rfft(self.path, axis=0)) / len(self.path)
        return float(size[-max(len(size) // 8, 2) :].max())


class Balance:
    """The balance of film, rotor and load around a cycle, in the film's unit of force.

    Parameters
    ----------
    machine : Machine
        The machine; its imbalance plays no part.
    """

    def __init__(self, machine: Machine) -> None:
        bearing = machine.bearing
        self.machine, self.C = machine, bearing.radial_clearance
        film = film_of(bearing)
        # A film that depends on more than place and velocity in its units changes with the speed.
        self.changes, self.wall = isinstance(film.motion(), InnerMotion), film.gap
        journal_motion(bearing, viscosity=1.0, speed=1.0)  # refuses a film with inner states

    def force(self, speed: float) -> Force:
        """Return the film's force on a moving journal at a speed."""
        mu = float(heat.viscosity(self.machine, speed))
        return journal_motion(self.machine.bearing, viscosity=mu, speed=speed).force

    def residual(self, cycle: Cycle) -> tuple[Array, Array]:
        """Return the residual, (2m,), and its derivatives by `Cycle.vector()`, (2m, 2m + 2)."""
        m, unit = len(cycle.path), self.unit(cycle.speed)
        D = differentiation(m)
        velocity = cycle.ratio * (D @ cycle.path)
        film, by_place, by_velocity = self.film(cycle.path, velocity, cycle.speed)
        # The unknowns are ln ω̄ and ln Ω, so that both stay positive.
        omega = cycle.ratio * cycle.speed
        rotor, by_log = self.rotor(omega, m)
        scale, growth = self.C / unit, self._growth(cycle.speed)
        load = np.array([self.machine.static_load / unit, 0.0])
        by_speed = self._by_speed(cycle.path, velocity, cycle.speed)
        # The module's balance over the film's unit of force; the load pulls along X.
        residual = film - scale * (rotor @ cycle.path) + load
        jacobian = np.zeros((2 * m, 2 * m + 2))
        for i in (0, 1):
            rows = slice(i * m, (i + 1) * m)
            for j in (0, 1):
                block = by_velocity[:, i, j, None] * (cycle.ratio * D)
                block[np.diag_indices(m)] += by_place[:, i, j]
                jacobian[rows, j * m : (j + 1) * m] = block - (scale * rotor if i == j else 0.0)
            # By ln ω̄ velocity and rotor frequency grow; by ln Ω that frequency and the film's unit.
            stiffer = scale * (by_log @ cycle.path[:, i])
            jacobian[rows, -2] = np.sum(by_velocity[:, i] * velocity, axis=-1) - stiffer
            firmer = scale * (rotor @ cycle.path[:, i]) - load[i]
            jacobian[rows, -1] = growth * firmer - stiffer + by_speed[:, i]
        return residual.T.ravel(), jacobian

    def unit(self, speed: float) -> float:
        """Return the film's unit of force at a speed, μΩRL³/C² [N]."""
        mu = float(heat.viscosity(self.machine, speed))
        return float(FilmUnits(self.machine.bearing, mu, speed).force)

    def _growth(self, speed: float) -> float:
        """Return the derivative of ln of that unit by ln Ω: 1 unless the film warms with speed."""
        if self.machine.supply is None:
            return 1.0
        low, high = (self.unit(speed * (1.0 + step)) for step in (-_SPEED_STEP, _SPEED_STEP))
        return math.log(high / low) / math.log((1.0 + _SPEED_STEP) / (1.0 - _SPEED_STEP))

    def rotor(self, omega: float, m: int) -> tuple[Array, Array]:
        """Return the rotor's impedance to the journal, and its derivative by ln ω, (m, m) [N/m]."""
        k = harmonics(m)
        Z, slope = impedance(self.machine.rotor, k * omega)
        return _circulant(Z), _circulant(slope * k * omega)

    def _by_speed(self, place: Array, velocity: Array, speed: float) -> Array:
        """Return the derivative of the force in its own units by ln Ω, (m, 2)."""
        if not self.changes:
            return np.zeros_like(place)
        states = np.concatenate([place, velocity], axis=1)
        low, high = (
            _forces(self.force(speed * math.exp(step)), states)
            for step in (-_SPEED_STEP, _SPEED_STEP)
        )
        return (high - low) / (2.0 * _SPEED_STEP)

    def film(self, place: Array, velocity: Array, speed: float) -> tuple[Array, Array, Array]:
        """Return the film's force, (m, 2), and its derivatives by place and velocity, (m, 2, 2)."""
        force_at = self.force(speed)
        states = np.concatenate([place, velocity], axis=1)
        h = self._difference(place, velocity)
        force = _forces(force_at, states)
        slopes = np.empty((len(place), 2, 4))
        for j in range(4):
            # Central differences: a film model gives its force on a moving journal, not the slopes.
            step = h * np.eye(4)[j]
            ahead, behind = (_forces(force_at, states + sign * step) for sign in (1.0, -1.0))
            slopes[:, :, j] = (ahead - behind) / (2.0 * h)
        return force, slopes[:, :, :2], slopes[:, :, 2:]

    def gap(self, path: Array) -> float:
        """Return the minimum film thickness along a path of the journal, in C."""
        return float(np.min(self.wall(path)))

    def _difference(self, place: Array, velocity: Array) -> Array:
        """Return the step of a difference of the force, (m, 1).

        A plain bearing's force is not smooth where the velocity relative to half speed whirl
        vanishes, and large whirl comes to within a millionth of it: a step across it gives a slope
        of neither side, and with it Newton's method converges slowly.
        """
        relative = np.hypot(velocity[:, 0] + 0.5 * place[:, 1], velocity[:, 1] - 0.5 * place[:, 0])
        room = np.minimum(relative, self.wall(place))
        share = _DIFFERENCE_SHARE * room[:, None]
        return np.clip(share, _SMALLEST_DIFFERENCE, _LARGEST_DIFFERENCE)


def _forces(force: Force, states: Array) -> Array:
    return np.array([force(*state) for state in states.tolist()])


def _circulant(spectrum: ComplexArray) -> Array:
    """Return the real matrix that multiplies a periodic signal's harmonics by a spectrum."""
    m = len(spectrum)
    first = np.fft.ifft(spectrum).real
    return first[(np.arange(m)[:, None] - np.arange(m)[None, :]) % m]


def differentiation(m: int) -> Array:
    """Return the matrix of d/dτ on m points of a period, m odd."""
    # m odd: on an even number of points the highest harmonic has no derivative of its own.
    return _circulant((1j * harmonics(m)).astype(complex))


def harmonics(m: int) -> Array:
    """Return the orders of the harmonics on m points, in the order of an FFT."""
    return np.fft.fftfreq(m, 1.0 / m).astype(float)
