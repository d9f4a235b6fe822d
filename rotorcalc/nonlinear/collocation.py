"""A limit cycle as a trigonometric polynomial, and the balance of forces that it satisfies.

A cycle of frequency ω is sought as a trigonometric polynomial for the journal and the film's inner
coordinates, x(τ), τ = ωt, that meets the balance of film and rotor at equally spaced τ
(collocation, which converges faster than any power of their number):

    F_film(x, ẋ) − Z x + F_o = 0.

The rotor is linear, so Z is its impedance at each harmonic, exact for a rigid rotor, a flexible
one, journal mass and midspan damping. An inner coordinate has Z = −ω²m, its mass m zero or not.

Source: Seydel, Practical Bifurcation and Stability Analysis, third edition, section 7.2.
"""

import math
from typing import NamedTuple

import numpy as np

from rotorcalc import heat
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.films import FilmUnits, InnerMotion, film_of
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.equations import film_share
from rotorcalc.nonlinear.film_forces import (
    FilmForces,
    film_forces,
    inertia_of,
    refuse_unknown,
)
from rotorcalc.nonlinear.rotor_impedance import impedance

# Step of a difference of the film's force, as a share of the distance to kink or wall; its bounds.
_DIFFERENCE_SHARE, _SMALLEST_DIFFERENCE, _LARGEST_DIFFERENCE = 1e-3, 1e-11, 1e-6
# Relative step of the difference of the film's unit by speed.
_SPEED_STEP = 1e-4


class Cycle(NamedTuple):
    """A limit cycle: its path in C, (m, d), the whirl ratio ω/Ω, and Ω [rad/s].

    The path has the d coordinates of the journal, X and Y, and of the film.
    """

    path: Array
    ratio: float
    speed: float

    def vector(self) -> Array:
        """Return all unknowns as one vector."""
        return np.concatenate([self.path.T.ravel(), [math.log(self.ratio), math.log(self.speed)]])

    @classmethod
    def of(cls, vector: Array, coordinates: int) -> "Cycle":
        """Return the cycle that a vector holds."""
        path = vector[:-2].reshape(coordinates, -1).T
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
        refuse_unknown(bearing)
        # A film that depends on more than place and velocity in its units changes with the speed.
        self.changes = isinstance(film_of(bearing).motion(), InnerMotion)
        self.inertia = inertia_of(bearing)

    def force(self, speed: float) -> FilmForces:
        """Return the film's forces in motion at a speed."""
        return film_forces(self.machine, speed)

    def residual(self, cycle: Cycle) -> tuple[Array, Array]:
        """Return the residual, (dm,), and its derivatives by `Cycle.vector()`, (dm, dm + 2)."""
        (m, d), unit = cycle.path.shape, self.unit(cycle.speed)
        D = differentiation(m)
        velocity = cycle.ratio * (D @ cycle.path)
        film, by_place, by_velocity = self.film(cycle.path, velocity, cycle.speed)
        # The unknowns are ln ω̄ and ln Ω, so that both stay positive.
        impedances = self.impedances(cycle.ratio * cycle.speed, m)
        scale, growth = self.C / unit, self._growth(cycle.speed)
        # The load pulls along X.
        load = np.append(self.machine.static_load / unit, np.zeros(d - 1))
        by_speed = self._by_speed(cycle.path, velocity, cycle.speed)
        # The module's balance over the film's unit of force.
        residual = film + load
        jacobian = np.zeros((d * m, d * m + 2))
        for i, (own, by_log) in enumerate(impedances):
            rows, inert = slice(i * m, (i + 1) * m), scale * (own @ cycle.path[:, i])
            residual[:, i] -= inert
            for j in range(d):
                block = by_velocity[:, i, j, None] * (cycle.ratio * D)
                block[np.diag_indices(m)] += by_place[:, i, j]
                jacobian[rows, j * m : (j + 1) * m] = block - (scale * own if i == j else 0.0)
            # By ln ω̄ velocity and frequency grow; by ln Ω that frequency and the film's unit.
            stiffer = scale * (by_log @ cycle.path[:, i])
            jacobian[rows, -2] = np.sum(by_velocity[:, i] * velocity, axis=-1) - stiffer
            jacobian[rows, -1] = growth * (inert - load[i]) - stiffer + by_speed[:, i]
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

    def impedances(self, omega: float, m: int) -> list[tuple[Array, Array]]:
        """Return each coordinate's impedance and its derivative by ln ω, (m, m) [N/m]."""
        k = harmonics(m)
        Z, slope = impedance(self.machine.rotor, k * omega)
        rotor = _circulant(Z), _circulant(slope * k * omega)
        # −ω²m, which goes with ω².
        unit = _circulant(-((k * omega) ** 2).astype(complex))
        return [rotor, rotor, *((mass * unit, 2.0 * mass * unit) for mass in self.inertia.tolist())]

    def _by_speed(self, place: Array, velocity: Array, speed: float) -> Array:
        """Return the derivative of the forces in their own units by ln Ω, (m, d)."""
        if not self.changes:
            return np.zeros_like(place)
        states = np.concatenate([place, velocity], axis=1)
        low, high = (
            self.force(speed * math.exp(step)).at(states) for step in (-_SPEED_STEP, _SPEED_STEP)
        )
        return (high - low) / (2.0 * _SPEED_STEP)

    def film(self, place: Array, velocity: Array, speed: float) -> tuple[Array, Array, Array]:
        """Return the film's forces, (m, d), and their derivatives by place and velocity."""
        forces, (m, d) = self.force(speed), place.shape
        states = np.concatenate([place, velocity], axis=1)
        # Where a force is not smooth, as at a plain bearing's half speed whirl, to which large
        # whirl comes within a millionth, a step across the kink gives a slope of neither side, and
        # with it Newton's method converges slowly.
        share = _DIFFERENCE_SHARE * forces.smooth(place, velocity)[:, None]
        h = np.clip(share, _SMALLEST_DIFFERENCE, _LARGEST_DIFFERENCE)
        slopes = np.empty((m, d, 2 * d))
        for j, unit in enumerate(np.eye(2 * d)):
            # Central differences: a film model gives its forces in motion, not their slopes.
            ahead, behind = (forces.at(states + sign * h * unit) for sign in (1.0, -1.0))
            slopes[:, :, j] = (ahead - behind) / (2.0 * h)
        return forces.at(states), slopes[:, :, :d], slopes[:, :, d:]

    def gap(self, path: Array) -> float:
        """Return the thinnest film along a path over its own clearance."""
        inner = path[:, 2:] if path.shape[1] > 2 else None
        return float(np.min(film_share(self.machine.bearing, path[:, :2], inner)))


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
