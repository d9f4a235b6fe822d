"""Stability of a limit cycle: Floquet multipliers of the motion linearised about it.

Source: Seydel, Practical Bifurcation and Stability Analysis, third edition, section 7.4.
"""

from dataclasses import replace
from typing import cast

import numpy as np
from scipy.linalg import expm

from rotorcalc import modes
from rotorcalc.arrays import Array
from rotorcalc.nonlinear.collocation import Balance, Cycle, differentiation


def multiplier(balance: Balance, cycle: Cycle) -> complex:
    """Return the Floquet multiplier of largest modulus except the one that is always 1.

    The state matrix A(τ) of small motions about the cycle is integrated over its period by
    exponentials of its values in the middle of many steps (Magnus, second order, extrapolated).

    Parameters
    ----------
    balance : Balance
        The balance of the machine's forces.
    cycle : Cycle
        A solution of it.

    Returns
    -------
    complex
        Growth of a small motion over one period [-], the slowest to decay, its imaginary part not
        negative; of modulus below 1 the cycle is stable.
    """
    fine, coarse = (
        _monodromy(balance, cycle.resampled(points * len(cycle.path))) for points in (2, 1)
    )
    # Error of second order in the step: half the step has a quarter of it.
    values = np.linalg.eigvals(fine + (fine - coarse) / 3.0)
    # A shift along the cycle neither grows nor decays: its multiplier, 1 up to errors, is left out.
    rest = np.delete(values, np.argmin(np.abs(values - 1.0)))
    least = complex(rest[np.argmax(np.abs(rest))])
    return complex(least.real, abs(least.imag))


def _monodromy(balance: Balance, cycle: Cycle) -> Array:
    """Return the matrix that maps a small motion about the cycle over one period."""
    m = len(cycle.path)
    velocity = cycle.ratio * (differentiation(m) @ cycle.path)
    _, by_place, by_velocity = balance.film(cycle.path, velocity, cycle.speed)
    stiffness = balance.unit(cycle.speed) / balance.C
    balanced = replace(balance.machine.rotor, imbalance=0.0)
    # K_ij = −∂F_i/∂X_j and C_ij = −∂F_i/∂Ẋ_j (Eq. 5.14), here at each point of the cycle.
    K, C = -stiffness * by_place, -stiffness / cycle.speed * by_velocity
    A = modes.state_matrix(balanced, K, C, inertia=balance.inertia)
    # Each step has A in its middle; the first is cut in two, so that the period begins at τ = 0.
    step = 2.0 * np.pi / (cycle.ratio * cycle.speed * m)
    half = cast("Array", expm(A[0] * (0.5 * step)))
    steps = expm(A[1:] * step)
    product: Array = half
    for through in steps:
        product = through @ product
    return half @ product
