"""The Hopf bifurcation of a balanced machine at its onset: direction and amplitude of whirl.

Near the onset the whirl's amplitude a, the journal's largest distance from rest, obeys

    ȧ = (Re λ) a + ℓ (a/C)² a,

the normal form. With ℓ < 0 a small stable whirl exists above the onset and grows gradually with
speed (supercritical); with ℓ > 0 a small unstable whirl exists below the onset, and a disturbance
larger than it makes the machine whirl although the linear theory calls it stable (subcritical).

ℓ is the first Lyapunov coefficient, by harmonic balance to the third order. Film, rotor and load
balance in L(d/dt) x = ½D²F(u, u) + ⅙D³F(u, u, u), with u = (x, ẋ) from rest, F the film's force and
L(jω) = K + jωC + Z_rotor(ω). A whirl A q e^{jωt}, L q = 0, shifts the journal's mean position by
|A|² h_0 and has a second harmonic A² h_2,

    L(0) h_0 = D²F(Q, Q̄),    L(2jω) h_2 = ½D²F(Q, Q),    Q = (q, jωq),

and the terms at ω, projected on the left null vector p of L(jω), change A:

    pᵀL'q Ȧ = pᵀ{D²F(Q, H_0) + D²F(Q̄, H_2) + ½D³F(Q, Q, Q̄)} |A|²A.

Only the film's force is expanded; the rotor is linear and enters L exactly. So this holds with
massless journals too, where velocity as a function of position is singular close to rest. A film's
inner coordinates belong to x, with −ω²m in L in place of the rotor's impedance.

Source: Kuznetsov, Elements of Applied Bifurcation Theory, third edition, section 5.4 (projection
onto the whirl's plane, here for a balance of forces in place of a system of first order).
"""

import math
from dataclasses import dataclass
from typing import NamedTuple, cast

import numpy as np

from rotorcalc import heat
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.coefficients import dynamics, equilibrium
from rotorcalc.films import FilmUnits
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.equations import film_gap
from rotorcalc.nonlinear.film_expansion import FilmExpansion
from rotorcalc.nonlinear.film_forces import film_forces, refuse_unknown, rest_of
from rotorcalc.nonlinear.rotor_impedance import impedance
from rotorcalc.onset import ModeOnset, Onset, onset_speed

# ℓ is computed twice, by polynomials with this many points, the second time at a speed beside the
# onset by as much as the onset may be in error. Its error is bounded by a multiple of their
# difference, and by the rounding of the three terms of which it is the sum: of a nearly central
# journal's third derivatives it is 3e-8, as polynomials of 9 to 21 points show.
_POINTS, _FEWER_POINTS = 17, 13
_BESIDE = 1e-8
_WIDER, _ROUNDING = 5.0, 1e-7
# Relative step of the derivative by speed: truncation of order 1e-8, rounding 1e-12.
_SPEED_STEP = 1e-4


@dataclass(frozen=True)
class Hopf:
    """The onset of whirl of a balanced machine, and the direction of the bifurcation there.

    Attributes
    ----------
    speed, whirl_frequency : float
        Ω_s and ω_s [rad/s].
    eccentricity_ratio : float
        ε at rest there [-].
    lyapunov : float
        ℓ [1/s]: growth of the whirl per (a/C)². Negative for a supercritical onset.
    lyapunov_error : float
        Bound of the error of ℓ [1/s].
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
    def subcritical(self) -> bool | None:
        """Whether the onset is subcritical; None where the sign of ℓ is not certain."""
        if not abs(self.lyapunov) > self.lyapunov_error:
            return None
        return self.lyapunov > 0.0

    @checked
    def amplitude(self, speed: float) -> float:
        """Return the whirl's amplitude near the onset by the normal form, a = C√(−Re λ/ℓ).

        Parameters
        ----------
        speed : float
            Running speed, Ω [rad/s].

        Returns
        -------
        float
            a [m]; NaN on the side of the onset where there is no such whirl.
        """
        # Re λ = (d Re λ/dΩ)(Ω − Ω_s) to first order.
        square = -self.growth_slope * (speed - self.speed) / self.lyapunov
        return self.clearance * math.sqrt(square) if square >= 0.0 else math.nan


@checked
def hopf(machine: Machine, *, onset: Onset | ModeOnset | None = None) -> Hopf:
    """Return the Hopf bifurcation of a machine without its imbalance: onset and direction.

    Parameters
    ----------
    machine : Machine
        The machine, with any rotor.
    onset : Onset, ModeOnset or None
        Where the whirl sets in, on a floating ring one of `mode_onsets`; None for the lowest.

    Returns
    -------
    Hopf
        There.

    Raises
    ------
    ValueError
        Where the machine has no onset, or whirls at any speed, as a plain bearing without load
        does; where the film gives no force for a moving journal, or has parts that move on their
        own and not the forces on them.
    """
    refuse_unknown(machine.bearing)
    onset = onset_speed(machine) if onset is None else onset
    if not 0.0 < onset.speed < math.inf:
        if math.isnan(onset.speed):
            raise ValueError("onset = nan: the speed of a Hopf bifurcation must be known")
        why = "whirls at any speed" if onset.speed == 0.0 else "has no onset"
        raise ValueError(f"machine: {why}, so there is no Hopf bifurcation")
    terms = _lyapunov_terms(machine, onset.speed, onset.whirl_frequency, _POINTS)
    beside = onset.speed * (1.0 + _BESIDE)
    other = _lyapunov_terms(machine, beside, onset.whirl_frequency, _FEWER_POINTS)
    difference = abs(float(np.sum(terms - other)))
    return Hopf(
        speed=onset.speed,
        whirl_frequency=onset.whirl_frequency,
        eccentricity_ratio=float(equilibrium(machine, onset.speed).film.eccentricity_ratio),
        lyapunov=float(np.sum(terms)),
        lyapunov_error=_WIDER * difference + _ROUNDING * float(np.sum(np.abs(terms))),
        # With ℓ it gives the amplitude at a speed beside the onset.
        growth_slope=_growth_slope(machine, onset.speed, onset.whirl_frequency),
        clearance=machine.bearing.radial_clearance,
    )


@checked
def whirl_shape(machine: Machine, speed: float, frequency: float) -> ComplexArray:
    """Return the shape of the undamped whirl at an onset.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed, frequency : float
        Running speed Ω and whirl frequency ω at the onset [rad/s].

    Returns
    -------
    complex array, (d,)
        Phasors q of the journal's X and Y and of the film's inner coordinates [-], the journal's
        largest displacement 1, reached at the phase 0.

    Raises
    ------
    ValueError
        Where the frequency is not finite.
    """
    if not math.isfinite(frequency):
        raise ValueError(f"frequency = {frequency} rad/s: must be finite")
    return _whirl(machine, speed, frequency).shape


class _Whirl(NamedTuple):
    """The null vectors of L: q, and p scaled to pᵀL'q = 1 with L' = dL/d(jω) [N·s/m]."""

    shape: ComplexArray
    left: ComplexArray


def _whirl(machine: Machine, speed: float, frequency: float) -> _Whirl:
    left, _, right = np.linalg.svd(_balance(machine, speed, frequency))
    q: ComplexArray = right[-1].conj()
    # Turned to the phase at which the journal's displacement is largest: q·q real and positive.
    turned = q * np.exp(-0.5j * np.angle(np.sum(q[:2] ** 2)))
    q = turned / float(np.linalg.norm(turned[:2].real))
    p: ComplexArray = left[:, -1].conj()
    film = dynamics(machine, speed)
    _, by_frequency = impedance(machine.rotor, np.array([frequency]))
    # d(−ω²m)/dω = −2ωm.
    by_frequency = np.append(np.repeat(by_frequency, 2), -2.0 * frequency * film.inertia)
    slope = film.damping - 1j * np.diag(by_frequency)
    return _Whirl(q, p / (p @ slope @ q))


def _balance(machine: Machine, speed: float, frequency: float) -> ComplexArray:
    """Return L(jω) = K + jωC + Z(ω) [N/m]."""
    film = dynamics(machine, speed)
    Z, _ = impedance(machine.rotor, np.array([frequency]))
    each = np.append(np.repeat(Z, 2), -(frequency**2) * film.inertia)
    return film.stiffness + 1j * frequency * film.damping + np.diag(each)


def _growth_slope(machine: Machine, speed: float, frequency: float) -> float:
    """Return d(Re λ)/dΩ, from pᵀ(L' dλ/dΩ + ∂L/∂Ω)q = 0."""
    step = _SPEED_STEP * speed
    low, high = (_balance(machine, speed + sign * step, frequency) for sign in (-1.0, 1.0))
    q, p = _whirl(machine, speed, frequency)
    return -float((p @ (high - low) @ q).real) / (2.0 * step)


def _lyapunov_terms(machine: Machine, speed: float, frequency: float, points: int) -> Array:
    """Return the three terms of ℓ [1/s]: by the mean shift, the second harmonic and the cubic."""
    place, mu = rest_of(machine, speed), float(heat.viscosity(machine, speed))
    inner = place[2:] if len(place) > 2 else None
    gap = float(film_gap(machine.bearing, place[:2], inner))
    expansion = FilmExpansion(film_forces(machine, speed).of, place, gap, points)
    q, p = _whirl(machine, speed, frequency)
    swing = 1j * frequency / speed
    Q = np.concatenate([q, swing * q])
    along = expansion.whirl(Q)
    # From the film's unit of force and clearances to N and m.
    unit = float(FilmUnits(machine.bearing, mu, speed).stiffness)
    steady, double = (_balance(machine, speed, harmonic * frequency) for harmonic in (0.0, 2.0))
    # Mean shift and second harmonic, the two equations of the module's docstring.
    h_0 = unit * cast("ComplexArray", np.linalg.solve(steady, along.QQ_))
    h_2 = 0.5 * unit * cast("ComplexArray", np.linalg.solve(double, along.QQ))
    cubic = [
        expansion.second(Q, np.concatenate([h_0, 0.0 * h_0])),
        expansion.second(Q.conj(), np.concatenate([h_2, 2.0 * swing * h_2])),
        0.5 * along.QQQ_,
    ]
    # With a = 2|A|, |A|² = a²/4.
    return 0.25 * unit * np.real(np.array(cubic) @ p)
