"""The film's static equilibrium and force coefficients of a machine, with their dimensions.

Scales the dimensionless answer of the film model by this machine's oil, bearing, load and speed.
Coefficients are K_ij = −∂F_i/∂X_j and C_ij = −∂F_i/∂Ẋ_j in X, Y (Eq. 5.14), per bearing.
Source: San Andrés, Notes 5, Eqs. 5.5, 5.8, 5.30 and 5.31.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.films import FilmState, film_state
from rotorcalc.machine import Machine
from rotorcalc.typing import Array


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """A bearing in static equilibrium, with dimensions.

    Attributes
    ----------
    speed : array, (...)
        Running speed, Ω [rad/s].
    film : FilmState
        The film, dimensionless.
    stiffness : array, (..., 2, 2)
        K_ij in X, Y [N/m].
    damping : array, (..., 2, 2)
        C_ij in X, Y [N·s/m].
    minimum_film_thickness : array, (...)
        [m].
    side_flow : array, (...)
        Oil that leaves at both ends together [m³/s].
    drag_torque : array, (...)
        Torque of the film on the journal [N·m].
    power_loss : array, (...)
        Drag torque times speed [W].
    """

    speed: Array
    film: FilmState
    stiffness: Array
    damping: Array
    minimum_film_thickness: Array
    side_flow: Array
    drag_torque: Array
    power_loss: Array


def equilibrium(machine: Machine, speed: ArrayLike) -> Equilibrium:
    """Return the static equilibrium of a machine's bearing and its force coefficients.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    Equilibrium
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    speed = checked_speed(speed)
    bearing, mu = machine.bearing, machine.viscosity
    R, L, C = bearing.radius, bearing.length, bearing.radial_clearance
    film = film_state(bearing, modified_sommerfeld(machine, speed))
    damping_unit = mu * R * L**3 / C**3
    drag_torque = film.drag * mu * speed * R**3 * L / C
    return Equilibrium(
        speed=speed,
        film=film,
        stiffness=film.stiffness * damping_unit * speed[..., None, None],
        damping=film.damping * damping_unit,
        minimum_film_thickness=film.minimum_thickness * C,
        side_flow=film.side_flow * speed * R * L * C,
        drag_torque=drag_torque,
        power_loss=drag_torque * speed,
    )


def modified_sommerfeld(machine: Machine, speed: ArrayLike) -> Array:
    """Return the modified Sommerfeld number, σ = μΩLR/(4F_o)·(L/C)² (Eq. 5.8).

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    array, (...)
        σ [-]; infinite without load.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    speed = checked_speed(speed)
    bearing = machine.bearing
    R, L, C = bearing.radius, bearing.length, bearing.radial_clearance
    with np.errstate(divide="ignore"):
        return machine.viscosity * speed * L * R / (4.0 * np.float64(machine.static_load)) * (L / C) ** 2


def checked_speed(speed: ArrayLike) -> Array:
    """Return speeds [rad/s] as an array, or raise ValueError where one is not positive and finite."""
    speeds = np.asarray(speed, dtype=float)
    good = np.isfinite(speeds) & (speeds > 0.0)
    if not np.all(good):
        raise ValueError(f"speed = {speeds[~good].flat[0]} rad/s: must be positive and finite")
    return speeds
