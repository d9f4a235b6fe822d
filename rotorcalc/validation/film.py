"""Checks of the film: coefficients, equilibrium, limits, energy, and the threshold of whirl."""

import functools
import math
from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from rotorcalc.arrays import Array
from rotorcalc.films import short
from rotorcalc.frames import rotate, vector
from rotorcalc.onset import whirl
from rotorcalc.validation.case import Case, alike

# Eccentricity ratios at which the identities are checked; nearer to 0 and 1 limits take over.
_EPS = np.linspace(0.05, 0.95, 19)


def coefficients() -> list[Case]:
    """Return the checks of stiffness and damping."""
    group = "Force coefficients"
    phi = short.attitude_angle(_EPS)
    place = vector(_EPS * np.cos(phi), _EPS * np.sin(phi))
    K, C = short.film_stiffness(_EPS), short.film_damping(_EPS)
    K_rt, C_rt = short.radial_stiffness(_EPS), short.radial_damping(_EPS)
    still = np.zeros_like(place)
    by_place = _slopes(lambda move: short.film_force(place + move, still))
    by_speed = _slopes(lambda move: short.film_force(place, move))
    unit = 4.0 * short.modified_sommerfeld(_EPS)[:, None, None]
    turned, slopes = "Eq. 5.16, ε = 0.05 … 0.95", "by differences, ε = 0.05 … 0.95"
    trace, force = "the trace is invariant under rotation", "of the nonlinear force"
    return [
        alike(group, f"K_ij and −∂F_i/∂X_j {force}", (K, -by_place), slopes, tolerance=1e-8),
        alike(group, f"C_ij and −∂F_i/∂v_j {force}", (C, -by_speed), slopes, tolerance=1e-8),
        alike(group, "K of Eq. 5.35 and of Eq. 5.30", (K, rotate(K_rt, phi)), turned),
        alike(group, "C of Eq. 5.35 and of Eq. 5.31", (C, rotate(C_rt, phi)), turned),
        alike(group, "K_XX + K_YY and K_rr + K_tt", (_trace(K), _trace(K_rt)), trace),
        alike(group, "C_XX + C_YY and C_rr + C_tt", (_trace(C), _trace(C_rt)), trace),
        alike(group, "k and K C/F_o", (short.stiffness(_EPS), unit * K), "Eq. 5.32"),
        alike(group, "c and C ΩC/F_o", (short.damping(_EPS), unit * C), "Eq. 5.32"),
    ]


def _slopes(force: Callable[[Array], Array]) -> Array:
    """Return derivatives of forces at all ε by central differences of fourth order, (n, 2, 2)."""
    # Small against the distances to the centre and to the wall, where the force varies fastest.
    step = 1e-3 * (_EPS * (1.0 - _EPS))[:, None]
    columns: list[Array] = []
    for axis in np.eye(2):
        near = force(step * axis) - force(-step * axis)
        far = force(2.0 * step * axis) - force(-2.0 * step * axis)
        columns.append((8.0 * near - far) / (12.0 * step))
    return np.stack(columns, axis=-1)


def _trace(coefficients: Array) -> Array:
    return np.trace(coefficients, axis1=-2, axis2=-1)[:, None]


def equilibrium() -> list[Case]:
    """Return the checks of force, pressure and position."""
    group = "Static equilibrium"
    sigma = np.geomspace(1e-6, 1e6, 241)
    there_and_back = short.modified_sommerfeld(short.eccentricity_ratio(sigma))
    phi = short.attitude_angle(_EPS)
    place = vector(_EPS * np.cos(phi), _EPS * np.sin(phi))
    at_rest = short.film_force(place, np.zeros_like(place))
    # The film's force balances the load along X: −F_o in film units is −1/(4σ).
    carried = vector(-1.0 / (4.0 * short.modified_sommerfeld(_EPS)), np.zeros_like(_EPS))
    # 200 points resolve the peak at ε = 0.95 to rounding; along ζ the integrand is a parabola.
    theta, d_theta = _gauss(0.0, math.pi, 200)
    zeta, d_zeta = _gauss(-0.5, 0.5, 4)
    pressure = short.pressure(_EPS[:, None, None], theta[:, None], zeta)
    thrust = np.sum(pressure * d_zeta, axis=2) * d_theta
    summed = vector(thrust @ np.cos(theta), thrust @ np.sin(theta))
    # I_rr + I_tt = ∫dθ/H, and the trace is invariant under rotation.
    inertia = (d_theta / short.film_thickness(_EPS[:, None], theta)).sum(axis=1, keepdims=True)
    return [
        alike(group, "σ(ε(σ)) and σ, σ = 10⁻⁶ … 10⁶", (there_and_back, sigma), "Eq. 5.8, inverted"),
        alike(group, "Nonlinear force at rest and the load", (at_rest, carried), "Eqs. 5.3, 5.8"),
        alike(
            group, "Force and the pressure summed", (short.static_force(_EPS), summed),
            "Eqs. 5.5 and 5.26, by quadrature",
        ),
        alike(
            group, "Trace of the added mass and ∫dθ/H", (_trace(short.added_mass(_EPS)), inertia),
            "by quadrature",
        ),
    ]  # fmt: skip


@functools.cache
def _gauss(low: float, high: float, points: int) -> tuple[Array, Array]:
    """Return the points and weights of Gauss-Legendre quadrature."""
    place, weight = np.polynomial.legendre.leggauss(points)
    return low + (place + 1.0) * (high - low) / 2.0, weight * (high - low) / 2.0


def limits() -> list[Case]:
    """Return the checks of the centred bearing."""
    # The series' next terms are of order ε², below the tolerance.
    group, eps = "Limits of the centred bearing", 1e-6
    k, c = short.stiffness(eps), short.damping(eps)
    onset = whirl.whirl_onset(k, c)
    K, C = short.film_stiffness(0.0), short.film_damping(0.0)
    series = "series of Eq. 5.35 for small ε"
    limits = (
        ("k_XX at ε = 10⁻⁶", k[0, 0], 4.0 / math.pi, series),
        ("k_YY at ε = 10⁻⁶", k[1, 1], 8.0 / math.pi, series),
        ("ε k_XY at ε = 10⁻⁶", eps * k[0, 1], 1.0, series),
        ("ε k_YX at ε = 10⁻⁶", eps * k[1, 0], -1.0, series),
        ("ε c_XX at ε = 10⁻⁶", eps * c[0, 0], 2.0, series),
        ("c_XY at ε = 10⁻⁶", c[0, 1], 8.0 / math.pi, series),
        ("k_eq at ε = 10⁻⁶", onset.equivalent_stiffness, 6.0 / math.pi, "Eq. 5.45 of these"),
        ("Whirl ratio at ε = 10⁻⁶", onset.whirl_ratio, 0.5, "Eq. 5.48"),
        ("p_s² at ε = 10⁻⁶", onset.critical_mass, 24.0 / math.pi, "k_eq over the ratio squared"),
        ("K_XX without load", K[0, 0], 0.0, "Eq. 5.37"),
        ("K_XY/(Ω C_XX) without load", K[0, 1] / C[0, 0], 0.5, "Eq. 5.37"),
    )
    return [Case(group, name, float(v), ref, 1e-9, source) for name, v, ref, source in limits]


def energy() -> list[Case]:
    """Return the checks of power and flow."""
    group, aspect = "Energy and flow", 2.0 / 3.0
    theta, d_theta = _gauss(0.0, math.pi, 200)
    zeta, d_zeta = _gauss(-0.5, 0.5, 4)
    H = short.film_thickness(_EPS[:, None], theta)

    def pressure(z: Array | float) -> Array:
        return short.pressure(_EPS[:, None, None], theta[:, None], z)

    # The pressure is parabolic along the axis, so these differences are exact.
    slope = (pressure(zeta + 0.05) - pressure(zeta - 0.05)) / 0.1
    slope_at_end = (3.0 * pressure(0.5) - 4.0 * pressure(0.4) + pressure(0.3))[..., 0] / 0.2
    axial = np.sum(H**3 * d_theta * np.sum(slope**2 * d_zeta, axis=2), axis=1) / 12.0
    leaving = np.sum(-(H**3) / 6.0 * slope_at_end * d_theta, axis=1)
    # The mean over even steps of a periodic integrand converges exponentially.
    around = 2.0 * math.pi * np.arange(400) / 400
    shear = 2.0 * math.pi * np.mean(1.0 / short.film_thickness(_EPS[:, None], around), axis=1)
    drag = short.drag(_EPS, length_to_radius=aspect)
    heat = shear + aspect**2 * axial
    return [
        alike(
            group, "Drag torque × speed and the heat", (drag, heat), "shear and axial flow, summed"
        ),
        alike(group, "Side flow and flow at the ends", (short.side_flow(_EPS), leaving), "summed"),
    ]


def threshold() -> list[Case]:
    """Return the checks of the threshold of whirl."""
    group = "Threshold of whirl"
    half = whirl.whirl_onset(short.stiffness(0.5), short.damping(0.5))
    printed = "Eqs. 5.45 and 5.46 at ε = 0.5, recorded"
    edge = float(brentq(_ratio_squared, 0.7, 0.8, xtol=1e-15))
    lowest = minimize_scalar(_p_s, bounds=(0.3, 0.6), method="bounded", options={"xatol": 1e-9})
    sigma = short.modified_sommerfeld
    return [
        Case(group, "σ at ε = 0.5", float(sigma(0.5)), 0.333164, 5e-7, "Eq. 5.8, recorded"),
        Case(group, "k_eq", float(half.equivalent_stiffness), 1.711065, 5e-7, printed),
        Case(group, "Whirl ratio", float(half.whirl_ratio), 0.514640, 5e-7, printed),
        Case(group, "p_s", float(half.threshold_speed), 2.541731, 5e-7, printed),
        Case(group, "|Δ| of Eq. 5.44 at p_s, relative", _determinant(), 0.0, 1e-12, "Eq. 5.44"),
        Case(group, "ε above which no rotor whirls", edge, 0.756030386471, 5e-13, "recorded"),
        Case(group, "σ there", float(sigma(edge)), 0.0663852602, 5e-11, "recorded"),
        Case(group, "Least p_s", float(lowest.fun), 2.5317057092, 5e-11, "recorded"),
        Case(group, "ε of the least p_s", float(lowest.x), 0.45697072, 5e-8, "recorded"),
        Case(
            group, "Unstable machines among 400 above that ε", _unstable_above(edge), 0.0, 0.0,
            "no rotor whirls, Eq. 5.46", "machines",
        ),
    ]  # fmt: skip


def _p_s(eps: float) -> float:
    onset = whirl.whirl_onset(short.stiffness(eps), short.damping(eps))
    return float(onset.threshold_speed)


def _ratio_squared(eps: float) -> float:
    """Return ω̄² of Eq. 5.46 times det c, which changes sign where whirl ends."""
    k, c = short.stiffness(eps), short.damping(eps)
    k_eq = whirl.whirl_onset(k, c).equivalent_stiffness
    return float(np.linalg.det(k - k_eq * np.eye(2)))


def _determinant() -> float:
    """Return the largest |Δ| of Eq. 5.44 at the threshold, relative to its terms."""
    eps = _EPS[_EPS < 0.75]
    k, c = short.stiffness(eps), short.damping(eps)
    onset = whirl.whirl_onset(k, c)
    w = onset.whirl_ratio[:, None, None]
    Z = k + 1j * w * c - onset.critical_mass[:, None, None] * w**2 * np.eye(2)
    return float(np.max(np.abs(np.linalg.det(Z)) / np.linalg.norm(Z, axis=(1, 2)) ** 2))


def _unstable_above(edge: float) -> float:
    """Return how many of 400 rigid rotors are unstable above the ε at which whirl ends."""
    eps, p2 = np.linspace(edge + 1e-6, 0.95, 20)[:, None], np.geomspace(1e-2, 1e4, 20)
    k, c = short.stiffness(eps), short.damping(eps)
    A = np.zeros((*np.broadcast_shapes(eps.shape, p2.shape), 4, 4))
    A[..., :2, 2:] = np.eye(2)
    # The rigid rotor in units of load and clearance: p² is its mass, M C Ω²/F_o.
    A[..., 2:, :2] = -k / p2[:, None, None]
    A[..., 2:, 2:] = -c / p2[:, None, None]
    return float(np.sum(np.linalg.eigvals(A).real.max(axis=-1) >= 0.0))
