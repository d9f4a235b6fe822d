"""Which way whirl sets in: the Hopf bifurcation of a balanced machine at its onset.

Near the onset the whirl's amplitude a, the journal's largest distance from rest, obeys

    ȧ = (Re λ) a + ℓ (a/C)² a,

the normal form. With ℓ < 0 a small whirl is born above the onset and grows gently with speed
(supercritical); with ℓ > 0 an unstable one shrinks towards the onset from below, and a kick larger
than it makes the machine whirl though the linear theory calls it stable (subcritical).

ℓ is the first Lyapunov coefficient, from the second and third derivatives of the equations of
motion at rest. They come from polynomials through the film's own force at Chebyshev's points, so
for every rotor and film model; the error shown is the difference of two such polynomials.

Source: Kuznetsov, Elements of Applied Bifurcation Theory, third edition, Eq. 5.34 (projection onto
the whirl's plane).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import cast

import numpy as np
from numpy.polynomial import chebyshev

from rotorcalc import modes
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.coefficients import equilibrium
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.equations import Equations, resting
from rotorcalc.onset.search import onset_speed

# Points on a line, and how far it reaches, as a share of the way to the nearest singularity.
_FINE, _COARSE = (24, 0.30), (20, 0.22)
_SPEED_STEP = 1e-4

_Rates = Callable[[Array], Array]


@dataclass(frozen=True)
class Hopf:
    """The onset of whirl of a balanced machine, and which way the whirl goes from there.

    Attributes
    ----------
    speed, whirl_frequency : float
        Ω_s and ω_s [rad/s].
    eccentricity_ratio : float
        ε at rest there [-].
    lyapunov : float
        ℓ [1/s]: growth of the whirl per (a/C)². Negative for a supercritical onset.
    lyapunov_error : float
        Difference of ℓ from that of a coarser polynomial [1/s].
    growth_slope : float
        d(Re λ)/dΩ of the whirl's mode [-].
    clearance : float
        C [m].
    """

    speed: float
    whirl_frequency: float
    eccentricity_ratio: float
    lyapunov: float
    lyapunov_error: float
    growth_slope: float
    clearance: float

    @property
    def subcritical(self) -> bool:
        """Whether the whirl is born unstable, below the onset."""
        return self.lyapunov > 0.0

    def amplitude(self, speed: float) -> float:
        """Return the whirl's amplitude near the onset by the normal form, a = C√(−Re λ/ℓ).

        Parameters
        ----------
        speed : float
            Running speed, Ω [rad/s].

        Returns
        -------
        float
            a [m]; not a number on the side of the onset where there is no such whirl.
        """
        square = -self.growth_slope * (speed - self.speed) / self.lyapunov
        return self.clearance * math.sqrt(square) if square >= 0.0 else math.nan


def hopf(machine: Machine) -> Hopf:
    """Return the onset of whirl of a machine without its imbalance, and which way it goes.

    Parameters
    ----------
    machine : Machine
        The machine, of whatever rotor.

    Returns
    -------
    Hopf
        At the lowest onset.

    Raises
    ------
    ValueError
        Where the machine has no onset, or whirls at any speed for want of load.
    """
    onset = onset_speed(machine)
    if not 0.0 < onset.speed < math.inf:
        why = "whirls at any speed" if onset.speed == 0.0 else "has no onset"
        raise ValueError(f"machine: {why}, so there is no Hopf bifurcation")
    lyapunov, coarse = (_lyapunov(machine, onset.speed, *line) for line in (_FINE, _COARSE))
    step = _SPEED_STEP * onset.speed
    low, high = (_growth(machine, onset.speed + sign * step) for sign in (-1, 1))
    return Hopf(
        speed=onset.speed,
        whirl_frequency=onset.whirl_frequency,
        eccentricity_ratio=onset.eccentricity_ratio,
        lyapunov=lyapunov,
        lyapunov_error=abs(lyapunov - coarse),
        growth_slope=(high - low) / (2.0 * step),
        clearance=machine.bearing.radial_clearance,
    )


def whirl_plane(machine: Machine, speed: float) -> tuple[complex, ComplexArray]:
    """Return the least damped whirl at a speed: its eigenvalue, and its journal's phasors.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s].

    Returns
    -------
    eigenvalue : complex
        λ [1/s].
    journal : complex array, (2,)
        Phasors of X and Y [-], the largest displacement 1, reached at the phase 0.
    """
    state = equilibrium(machine, speed)
    shapes = modes.mode_shapes(machine.rotor, state.stiffness, state.damping)
    waves = np.flatnonzero(shapes.eigenvalues.imag > 0.0)
    mode = waves[np.argmax(shapes.eigenvalues.real[waves])]
    journal = shapes.journal[mode]
    return complex(shapes.eigenvalues[mode]), journal * _unit(journal)


def _unit(journal: ComplexArray) -> complex:
    """Return the factor that makes a mode's largest displacement 1 and real."""
    turned = complex(np.exp(-0.5j * np.angle(np.sum(journal**2))))
    return turned / float(np.linalg.norm((journal * turned).real))


def _growth(machine: Machine, speed: float) -> float:
    state = equilibrium(machine, speed)
    values = modes.refined_eigenvalues(machine.rotor, state.stiffness, state.damping)
    return float(np.max(values.real[np.isfinite(values) & (values.imag > 0.0)]))


def _lyapunov(machine: Machine, speed: float, points: int, reach: float) -> float:
    """Return ℓ [1/s] at the onset."""
    lines = _Lines(machine, speed, points, reach)
    A = lines.jacobian()
    values, vectors = np.linalg.eig(A)
    upper = np.where(np.imag(values) > 0.0, 0.0, np.inf)
    whirl = int(np.argmin(np.abs(np.real(values)) + upper))
    lam, q = complex(values[whirl]), vectors[:, whirl].astype(complex)
    q = q * _unit(q[lines.journal])
    left, columns = np.linalg.eig(A.T)
    p = columns[:, np.argmin(np.abs(left - lam))].astype(complex)
    p = p / (p @ q)  # p is not conjugated: pᵀ takes the place of the source's ⟨p, ·⟩
    twice = 2j * lam.imag * np.eye(len(A)) - A
    steady = cast("ComplexArray", np.linalg.solve(A, lines.second(q, q.conj())))
    double = cast("ComplexArray", np.linalg.solve(twice, lines.second(q, q)))
    cubic = lines.third(q) - 2.0 * lines.second(q, steady) + lines.second(q.conj(), double)
    # The state is z q + z̄ q̄ with a = 2|z|, and rates are by Ωt.
    return float((p @ cubic).real) / 8.0 * speed


class _Lines:
    """Derivatives of the equations of motion at rest, along lines through it, by Ωt and in C."""

    def __init__(self, machine: Machine, speed: float, points: int, reach: float) -> None:
        balanced = replace(machine, rotor=replace(machine.rotor, imbalance=0.0))
        model = Equations(balanced, speed, speed, turned=2.0 * math.pi)
        film = equilibrium(balanced, speed).film
        position = film.position
        self.rest = model.initial(resting(balanced, position * model.C))
        self.rates = model.motion()
        self.journal = slice(4, 6) if model.flexible else slice(0, 2)
        # The force is not smooth at the wall, nor where the journal goes round at half speed.
        self.room = reach * min(float(film.minimum_thickness), 0.5 * float(film.eccentricity_ratio))
        self.nodes = np.cos(np.pi * (np.arange(points) + 0.5) / points)
        fit = np.linalg.inv(chebyshev.chebvander(self.nodes, points - 1))
        self.slopes = [_at_middle(points, order) @ fit for order in (1, 2, 3)]

    def along(self, direction: Array, order: int) -> Array:
        """Return the derivative of an order along a direction."""
        size = float(np.abs(direction).max())
        if size == 0.0:
            return np.zeros_like(self.rest)
        h = self.room / size
        rates = np.array([
            self.rates(self.rest + h * node * direction, 0.0) for node in self.nodes
        ])  # fmt: skip
        return self.slopes[order - 1] @ rates / h**order

    def jacobian(self) -> Array:
        """Return the matrix of first derivatives."""
        return np.stack([self.along(axis, 1) for axis in np.eye(len(self.rest))], axis=1)

    def second(self, u: ComplexArray, v: ComplexArray) -> ComplexArray:
        """Return the second derivative B(u, v)."""
        return (
            self._second(u.real, v.real)
            - self._second(u.imag, v.imag)
            + 1j * (self._second(u.real, v.imag) + self._second(u.imag, v.real))
        )

    def third(self, q: ComplexArray) -> ComplexArray:
        """Return the third derivative C(q, q, q̄)."""
        a, b = q.real, q.imag
        both, apart = self.along(a + b, 3), self.along(a - b, 3)
        aaa, bbb = self.along(a, 3), self.along(b, 3)
        aab, abb = (both - apart - 2.0 * bbb) / 6.0, (both + apart - 2.0 * aaa) / 6.0
        return aaa + abb + 1j * (aab + bbb)

    def _second(self, u: Array, v: Array) -> Array:
        return (self.along(u + v, 2) - self.along(u - v, 2)) / 4.0


def _at_middle(points: int, order: int) -> Array:
    """Return the derivatives of an order of Chebyshev's polynomials at 0."""
    return np.array([
        chebyshev.chebval(0.0, chebyshev.chebder(row, order)) for row in np.eye(points)
    ], dtype=float)  # fmt: skip
