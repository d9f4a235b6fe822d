"""Load and shaft stiffness from what a user may know in their place.

A load may be known by the eccentricity ratio ε, by the modified Sommerfeld number σ (Eq. 5.8) or by
the classical one, S = μNLD/F_o (R/C)² with N in revolutions a second, so that σ = πS(L/D)². A
shaft's stiffness may be known by the natural frequency of the rotor on rigid supports,
ω² = K_rot/(M − M_j).

Source: San Andrés, Notes 5, Eq. 5.8.
"""

import itertools
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, checked_speed
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.coefficients import equilibrium
from rotorcalc.films import FilmUnits, OperatingPoints, film_of
from rotorcalc.films.short import modified_sommerfeld
from rotorcalc.machine import Machine

# σ between which a load is looked for: the thinnest and thickest films that mean anything.
_LEAST, _MOST = 1e-8, 1e8
_LOADS = 320
_WORDS = {
    "eccentricity_ratio": "eccentricity ratio",
    "sommerfeld": "modified Sommerfeld number",
    "classical_sommerfeld": "classical Sommerfeld number",
}


@checked
def load_for(
    machine: Machine,
    speed: float,
    *,
    eccentricity_ratio: float | None = None,
    sommerfeld: float | None = None,
    classical_sommerfeld: float | None = None,
) -> float:
    """Return the static load per bearing with which the journal is at a known place.

    Parameters
    ----------
    machine : Machine
        The machine; its own load plays no part.
    speed : float
        Running speed, Ω [rad/s], positive.
    eccentricity_ratio : float, optional
        ε [-]. Exactly one of the three is given.
    sommerfeld : float, optional
        Modified Sommerfeld number, σ [-], as `Sweep.sommerfeld`.
    classical_sommerfeld : float, optional
        S = μNLD/F_o (R/C)² [-], with F_o the load of one bearing.

    Returns
    -------
    float
        F_o [N]; with a supply the film has the temperature of that load.

    Raises
    ------
    ValueError
        Where not exactly one is given, it is not positive, no load or more than one gives it, or
        the bearing is known by its coefficients alone.

    Examples
    --------
    >>> from rotorcalc import PRESETS, analyse
    >>> preset = PRESETS["sheet-1e8"]
    >>> load = load_for(preset.machine, preset.speed, eccentricity_ratio=0.5)
    >>> float(analyse(replace(preset.machine, load=load), preset.speed).eccentricity_ratio)
    0.5
    """
    checked_speed(speed)
    if isinstance(machine.bearing, CoefficientTable):
        raise ValueError(
            f"bearing = {machine.bearing.geometry.kind}: a table of coefficients knows neither the "
            "journal's place nor a Sommerfeld number, whatever the load"
        )
    given = {
        "eccentricity_ratio": eccentricity_ratio,
        "sommerfeld": sommerfeld,
        "classical_sommerfeld": classical_sommerfeld,
    }
    known = {name: float(value) for name, value in given.items() if value is not None}
    if len(known) != 1:
        raise ValueError(f"{', '.join(known) or 'load'}: give exactly one of {', '.join(given)}")
    [(name, target)] = known.items()
    if not 0.0 < target < math.inf:
        raise ValueError(f"{name} = {target:g}: must be positive and finite")
    sigma = _sigma_of(machine, name, target)
    if sigma is None:
        return _found(machine, speed, "eccentricity_ratio", target)
    if machine.supply is not None:
        return _found(machine, speed, "sommerfeld", sigma)
    unit = float(FilmUnits(machine.bearing, machine.viscosity, speed).force)
    return unit / (4.0 * sigma)  # Eq. 5.8


@checked
def stiffness_for(machine: Machine, *, natural_frequency: float) -> float:
    """Return the shaft's stiffness with which the rotor has a natural frequency.

    Parameters
    ----------
    machine : Machine
        The machine; its own shaft stiffness plays no part.
    natural_frequency : float
        Of the rotor on rigid supports, ω [rad/s], positive; infinite for a rigid shaft.

    Returns
    -------
    float
        K_rot = ω²(M − M_j) of one side [N/m].

    Raises
    ------
    ValueError
        Where the frequency is not positive.

    Examples
    --------
    >>> from rotorcalc import PRESETS
    >>> round(stiffness_for(PRESETS["sheet-1e8"].machine, natural_frequency=100.0))
    1360709
    """
    if not natural_frequency > 0.0:
        raise ValueError(f"natural_frequency = {natural_frequency:g} rad/s: must be positive")
    return natural_frequency**2 * machine.rotor.disk_mass


def _sigma_of(machine: Machine, name: str, target: float) -> float | None:
    """Return σ where it follows from what is known without a film, else None."""
    bearing = machine.bearing
    if name == "classical_sommerfeld":
        return math.pi * target * (bearing.length / bearing.diameter) ** 2
    if name == "sommerfeld":
        return target
    if film_of(bearing).curve == "short" and target < 1.0:
        return float(modified_sommerfeld(target))
    return None


def _found(machine: Machine, speed: float, name: str, target: float) -> float:
    """Return the only load at which a property of the equilibrium has a value."""
    property_at = _property(machine, speed, name)
    load = _loads(machine, speed)
    excess = property_at(load) - target
    known = np.isfinite(excess)
    load, excess = load[known], excess[known]
    brackets = [
        (low, high)
        for (low, high), (before, after) in zip(
            itertools.pairwise(load.tolist()), itertools.pairwise(excess.tolist()), strict=True
        )
        if (before < 0.0) != (after < 0.0)
    ]
    if len(brackets) != 1:
        number = "no load gives" if not brackets else f"{len(brackets)} loads give"
        reach = f"; it goes from {np.min(excess + target):.4g} to {np.max(excess + target):.4g}"
        raise ValueError(
            f"{name} = {target:g}: {number} this {_WORDS[name]} at {speed:g} rad/s"
            f"{reach if load.size else ''}"
        )
    low, high = np.log(brackets[0])

    def difference(ln_load: float) -> float:
        return float(property_at(np.array([math.exp(ln_load)]))[0]) - target

    return math.exp(float(brentq(difference, low, high, xtol=1e-14, rtol=1e-14)))


def _loads(machine: Machine, speed: float) -> Array:
    """Return the loads that are tried, rising."""
    film, oil = film_of(machine.bearing), machine.oil
    mu = machine.viscosity if machine.supply is None else oil.viscosity(machine.supply.temperature)
    unit = float(FilmUnits(machine.bearing, float(mu), speed).force)
    heaviest = unit / (4.0 * max(film.least_sommerfeld * (1.0 + 1e-12), _LEAST))
    return np.geomspace(unit / (4.0 * _MOST), heaviest, _LOADS)


def _property(machine: Machine, speed: float, name: str) -> Callable[[Array], Array]:
    """Return a property of the equilibrium over the load, NaN where the film has no answer."""
    if machine.supply is None:
        film, mu = film_of(machine.bearing), machine.viscosity

        def all_at_once(load: Array) -> Array:
            points = OperatingPoints.of(machine.bearing, viscosity=mu, speed=speed, load=load)
            return film.state(points).eccentricity_ratio

        return all_at_once

    def one(load: float) -> float:
        try:
            film = equilibrium(replace(machine, load=load), speed).film
        except ValueError:
            return math.nan
        return float(getattr(film, name))

    def each(load: Array) -> Array:
        return np.array([one(value) for value in load.tolist()])

    return each
