"""The onset of machines with massless journals and no midspan damping, without eigenvalues.

Such a machine goes unstable where Ω = Ω_sf(ε(Ω)). With σ = sΩ/F_o, s = μLR(L/C)²/4, that is the
root in σ of

    σ² (1/p_s² + (Γ/C) ω̄²) = s²/(M C F_o)        (Eqs. 5.8, 5.45, 5.46 and 5.50)

whose left side is the film's alone but for the static sag, and rises with σ. So whole grids of
machines are solved at once.

Source: San Andrés, Notes 5.
"""

import functools
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.optimize import elementwise

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.films import film_coefficients, film_state
from rotorcalc.machine import JournalBearing, Machine
from rotorcalc.numerics.roots import narrow_root
from rotorcalc.onset.search import Onset
from rotorcalc.onset.whirl import whirl_onset

# Film models whose k and c depend on σ alone, so that one curve serves every bearing.
ONE_CURVE = frozenset({"short"})


# Modified Sommerfeld numbers between which a root is bracketed. Below no film can whirl, above it
# is all but centred, where the left side of the equation grows as σ².
_SIGMA = np.geomspace(1e-3, 1e3, 241)


_ROOT: Any = {"xatol": 0.0, "xrtol": 1e-15, "fatol": 0.0, "frtol": 0.0}


@checked
def has_closed_form(machine: Machine) -> bool:
    """Return whether Eqs. 5.45 to 5.50 give the machine's onset, and no eigenvalues are needed."""
    rotor = machine.rotor
    massless = rotor.journal_mass == 0.0 or rotor.is_rigid
    return massless and rotor.disk_damping == 0.0 and machine.bearing.model in ONE_CURVE


@checked
def closed_form_onset(machine: Machine, *, flexible: bool = True) -> Onset:
    """Return the onset of a machine by the module's equation, without its eigenvalues.

    Parameters
    ----------
    machine : Machine
        A machine with `has_closed_form`; with a rigid shaft it may have journal mass.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    Onset
        As `onset_speed` gives it.

    Raises
    ------
    ValueError
        Where the machine has midspan damping, or journal mass on a shaft that bends.
    """
    if not flexible:
        machine = replace(machine, rotor=replace(machine.rotor, shaft_stiffness=math.inf))
    if not has_closed_form(machine):
        raise ValueError("no closed form for a machine with midspan damping or journal mass")
    M, K_rot, F, s, C = _numbers(machine)
    if F == 0.0:
        return Onset(speed=0.0, whirl_frequency=0.0, eccentricity_ratio=0.0)
    film, sag, wanted = machine.bearing.model, F / (K_rot * C), s**2 / (M * C * F)
    low, high = _bracket(film, sag=np.array([sag]), wanted=np.array([wanted]))
    sigma = narrow_root(lambda sigma: _residual(film, sigma, sag, wanted), low[0], high[0])
    state = film_state(machine.bearing, sigma)
    speed = sigma * F / s
    return Onset(
        speed=speed,
        whirl_frequency=float(whirl_onset(state.k, state.c).whirl_ratio) * speed,
        eccentricity_ratio=float(state.eccentricity_ratio),
    )


def closed_onsets(machines: Sequence[Machine]) -> Array:
    """Return the onsets of machines with one film model and a closed form."""
    numbers = np.array([_numbers(machine) for machine in machines])
    speeds = np.zeros(len(machines))  # without load the onset is at speed 0
    loaded = numbers[:, 2] > 0.0
    M, K_rot, F, s, C = numbers[loaded].T
    sigma = _root(machines[0].bearing.model, sag=F / (K_rot * C), wanted=s**2 / (M * C * F))
    speeds[loaded] = sigma * F / s
    return speeds


def _numbers(machine: Machine) -> tuple[float, ...]:
    """Return M, K_rot, F_o, s = σF_o/Ω, C of a machine."""
    bearing, rotor = machine.bearing, machine.rotor
    L, C = bearing.length, bearing.radial_clearance
    s = machine.viscosity * L * bearing.radius * (L / C) ** 2 / 4.0
    return rotor.half_mass, rotor.shaft_stiffness, machine.static_load, s, C


def _root(film: str, *, sag: Array, wanted: Array) -> Array:
    """Return the lowest σ at which the left side of the module's equation is the right one."""

    def residual(sigma: Array, sag: Array, wanted: Array) -> Array:
        return _residual(film, sigma, sag, wanted)

    bracket = _bracket(film, sag=sag, wanted=wanted)
    # The stubs lack what find_root returns for arrays of arguments.
    found: Any = elementwise.find_root(residual, bracket, args=(sag, wanted), tolerances=_ROOT)
    if not np.all(found.success):
        raise RuntimeError("no onset found within the search's iterations")
    return np.asarray(found.x, dtype=float)


def _bracket(film: str, *, sag: Array, wanted: Array) -> tuple[Array, Array]:
    """Return σ below and above the root, where the left side first passes the right one."""
    rigid, flexible = _curve(film)
    table = rigid + sag[:, None] * flexible
    first = np.argmax(table >= wanted[:, None], axis=1)
    beyond = table[:, -1] < wanted  # where the film is centred
    far = 2.0 * _SIGMA[-1] * np.sqrt(wanted / table[:, -1])
    low = np.where(beyond, _SIGMA[-1], _SIGMA[np.maximum(first - 1, 0)])
    high = np.where(beyond, far, _SIGMA[first])
    return low, high


def _residual(film: str, sigma: Any, sag: Any, wanted: Any) -> Any:
    """Return how far the left side is above the right one, relative; of floats or arrays."""
    rigid, flexible = _left_side(film, sigma)
    return (rigid + sag * flexible) / wanted - 1.0


@functools.cache
def _curve(film: str) -> tuple[Array, Array]:
    return _left_side(film, _SIGMA)


def _left_side(film: str, sigma: Array) -> tuple[Array, Array]:
    """Return σ²/p_s² and σ²ω̄², the two terms of the module's equation."""
    any_bearing = JournalBearing(diameter=1.0, length=1.0, radial_clearance=0.01, film=film)
    k, c = film_coefficients(any_bearing, sigma)
    onset = whirl_onset(k, c)  # p_s² in film units, not in the load's
    return sigma / (4.0 * onset.critical_mass), (sigma * onset.whirl_ratio) ** 2
