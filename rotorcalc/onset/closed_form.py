"""The onset of a machine without midspan damping, on a film whose k and c depend on σ alone.

Undamped, the rotor's dynamic stiffness at the journal is real at every frequency, so at the onset
it balances the film's K_eq at the film's own whirl ratio ω̄. With X = (ω̄Ω)²:

    (K_eq − M_j X)(K_rot − m_d X) = K_rot m_d X

whose lower root is reached first. With A = M X/K_eq = M/M_c, B = m_d X/K_rot and β = M_j/M this is

    A + B − β A B = 1,  B < 1

With σ = sΩ/F_o, s = μLR(L/C)²/4, A = (M C F_o/s²) σ²/p_s² and B = (m_d F_o²/(K_rot s²)) (σω̄)²: two
curves of the film alone, both of which rise with σ, and so does the left side up to the root. So
whole grids of machines are solved at once. For massless journals it is Eq. 5.50 with Ω = Ω_sf.

Source: San Andrés, Notes 5, Eqs. 5.8, 5.45, 5.46 and 5.50; journal mass by the same balance.
"""

import functools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.optimize import elementwise

from rotorcalc import heat
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.films import FilmUnits, film_of, film_state
from rotorcalc.machine import Machine
from rotorcalc.numerics.roots import narrow_root, narrow_roots
from rotorcalc.onset.curves import SIGMA, curves, table
from rotorcalc.onset.warming import warm_onset, warm_onsets
from rotorcalc.onset.whirl import Onset, whirl_onset

# The film whose two curves both rise with σ.
_CURVE = "short"
# Ω/σ [rad/s] up to which squares of speeds over masses and stiffnesses stay finite.
_LARGEST = 1e140
# Only the relative step ends the search, as σ spans many decades.
_ROOT: Any = {"xatol": 0.0, "xrtol": 1e-15, "fatol": 0.0, "frtol": 0.0}
# As many as are solved one by one as fast as together.
_ONE_BY_ONE = 6


def covers(machine: Machine) -> bool:
    """Return whether the module's equation gives a machine's onset."""
    return machine.rotor.disk_damping == 0.0 and film_of(machine.bearing).curve == _CURVE


@checked
def has_closed_form(machine: Machine) -> bool:
    """Return whether Eq. 5.50 gives a machine's onset: no midspan damping, massless journals."""
    rotor = machine.rotor
    return covers(machine) and (rotor.journal_mass == 0.0 or rotor.is_rigid)


@checked
def closed_form_onset(machine: Machine, *, flexible: bool = True) -> Onset:
    """Return the onset of a machine by the module's equation.

    Parameters
    ----------
    machine : Machine
        A machine that the equation `covers`.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    Onset
        As `onset_speed` gives it.

    Raises
    ------
    ValueError
        Where the machine has midspan damping, or a load so small or large that floating-point
        numbers do not hold the squares of its speeds.
    """
    if not covers(machine):
        raise ValueError("machine: has midspan damping or another film, so no closed form")
    if machine.static_load == 0.0:
        return Onset(speed=0.0, whirl_frequency=0.0, eccentricity_ratio=0.0, method="closed form")
    if machine.supply is not None:
        return _onset_at(machine, *warm_onset(machine, flexible=flexible))
    a, b, beta, speed_of = _numbers(machine, flexible)
    [low], [high] = _bracket(*(np.array([x]) for x in (a, b, beta)))
    sigma = narrow_root(lambda sigma: _excess(sigma, a, b, beta), low, high)
    return _onset_at(machine, sigma, sigma * speed_of)


def _onset_at(machine: Machine, sigma: float, speed: float) -> Onset:
    if math.isinf(speed):
        return Onset(
            speed=speed, whirl_frequency=math.nan, eccentricity_ratio=math.nan,
            method="closed form", searched_to=heat.hottest_speed(machine),
        )  # fmt: skip
    # ω̄ from K and C in film units: the ratio does not depend on the unit.
    state = film_state(machine.bearing, sigma)
    ratio = float(whirl_onset(state.stiffness, state.damping).whirl_ratio)
    return Onset(
        speed=speed,
        whirl_frequency=ratio * speed,
        eccentricity_ratio=float(state.eccentricity_ratio),
        method="closed form",
    )


def closed_onsets(machines: Sequence[Machine]) -> Array:
    """Return the onsets of machines that the equation covers; NaN where `warm_onsets` leaves it."""
    speeds = np.zeros(len(machines))  # without load the onset is at speed 0
    warm = [i for i, one in enumerate(machines) if one.supply is not None and one.static_load > 0.0]
    if warm:
        speeds[warm] = warm_onsets([machines[i] for i in warm])
    loaded = [i for i, one in enumerate(machines) if one.supply is None and one.static_load > 0.0]
    if not loaded:
        return speeds
    a, b, beta, speed_of = np.array([_numbers(machines[i], True) for i in loaded]).T
    speeds[loaded] = _roots(a, b, beta) * speed_of
    return speeds


def _roots(a: Array, b: Array, beta: Array) -> Array:
    """Return σ at the onsets of machines, (m,)."""
    low, high = _bracket(a, b, beta)
    roots = narrow_roots(
        lambda sigma: _excess(sigma, *(x[:, None] for x in (a, b, beta))), low, high
    )
    # What is left lies at the kink where the product is held, or beyond the table.
    left = np.flatnonzero(np.isnan(roots))
    if len(left) > _ONE_BY_ONE:
        roots[left] = _bracketed(a[left], b[left], beta[left], low[left], high[left])
        return roots
    for i in left.tolist():
        excess = functools.partial(_excess, a=a[i], b=b[i], beta=beta[i])
        roots[i] = narrow_root(excess, float(low[i]), float(high[i]))
    return roots


def _bracketed(a: Array, b: Array, beta: Array, low: Array, high: Array) -> Array:
    # The stubs lack what find_root returns for arrays of arguments.
    found: Any = elementwise.find_root(_excess, (low, high), args=(a, b, beta), tolerances=_ROOT)
    if not np.all(found.success):
        raise RuntimeError("no onset found within the search's iterations")
    return found.x


def _numbers(machine: Machine, flexible: bool) -> tuple[float, float, float, float]:
    """Return M C F_o/s², m_d F_o²/(K_rot s²), β and Ω/σ of a machine."""
    bearing, rotor, F = machine.bearing, machine.rotor, machine.static_load
    # Ω/σ = F_o/s, with s from Eq. 5.8 at 1 rad/s.
    speed_of = 4.0 * F / float(FilmUnits(bearing, machine.viscosity, 1.0).force)
    if not 1.0 / _LARGEST < speed_of < _LARGEST:
        raise ValueError(
            f"static load = {F:g} N: gives speeds of about {speed_of:.3g} rad/s, whose squares "
            "floating-point numbers do not hold"
        )
    # Factors of σ²/p_s² in A and of (σω̄)² in B, see above.
    a = rotor.half_mass * bearing.radial_clearance / F * speed_of**2
    if rotor.is_rigid or not flexible:
        return a, 0.0, 0.0, speed_of
    b = rotor.disk_mass / rotor.shaft_stiffness * speed_of**2
    return a, b, rotor.journal_mass / rotor.half_mass, speed_of


def _bracket(a: Array, b: Array, beta: Array) -> tuple[Array, Array]:
    """Return σ below and above the root."""
    rigid, flexible = table()
    excess = excess_mass(a * rigid[:, None], b * flexible[:, None], beta)
    first = np.argmax(excess >= 0.0, axis=0)
    beyond = excess[-1] < 0.0  # the root lies where the film is centred and both curves grow as σ²
    far = 2.0 * SIGMA[-1] / np.sqrt(a * rigid[-1] + b * flexible[-1])  # A + B = 4 there
    low = np.where(beyond, SIGMA[-1], SIGMA[np.maximum(first - 1, 0)])
    return low, np.where(beyond, far, SIGMA[first])


def excess_mass(A: Any, B: Any, beta: Any) -> Any:
    """Return A + B − βAB − 1, positive where the rotor exceeds the critical mass.

    The product is held beyond B = 1, where the lower root ends, so that the sum still rises. Of
    floats or arrays.
    """
    return A * (1.0 - beta * np.minimum(B, 1.0)) + B - 1.0


def _excess(sigma: Any, a: Any, b: Any, beta: Any) -> Any:
    rigid, flexible = curves(sigma)
    return excess_mass(a * rigid, b * flexible, beta)
