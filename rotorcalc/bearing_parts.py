"""The parts of a machine's bearing that move, give way or are supplied, over speed.

What a drawing of the bearing shows beside its journal: where a ring floats and how fast it turns,
which pressures recesses have.
"""

import functools
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.coefficients import checked_speed
from rotorcalc.display import Result
from rotorcalc.films.pads import Pad
from rotorcalc.films.tilting.pivots import pivots_of
from rotorcalc.foils import foil_deflection
from rotorcalc.geometry import FloatingRing, Foil, Geometry, Hydrostatic, TiltingPads
from rotorcalc.machine import Machine
from rotorcalc.recesses import recess_pressure
from rotorcalc.ring import ring_equilibrium
from rotorcalc.tilting import pad_tilts

# Angles at which a foil's deflection is asked, every two degrees.
_AROUND = np.linspace(0.0, 2.0 * np.pi, 181)


@dataclass(frozen=True, eq=False)
class Parts(Result):
    """Where the parts of a bearing are at some speeds; None for those it does not have.

    Attributes
    ----------
    speed : array, (k,)
        Running speeds, Ω [rad/s].
    pads : tuple of tuple of Pad, optional
        The tilting pads at each speed, as those of a fixed bore, in C.
    pivots : array, (pads,), optional
        Angles of their pivots from X [rad].
    ring : array, (k, 2), optional
        Centre of a floating ring from the bearing's, in C.
    ring_ratio : array, (k,), optional
        Speed of the ring over running speed [-].
    recesses : array, (N, 2), optional
        Angles at which each recess begins and ends [rad].
    recess_pressure : array, (k, N), optional
        Pressure in each recess [Pa].
    foil : array, (k, m), optional
        Deflection of a foil at angles Θ evenly spaced from X, the first and last the same, in C.
    slit : float, optional
        Angle of the slit between the foil's ends [rad].
    """

    speed: Array
    pads: tuple[tuple[Pad, ...], ...] | None = None
    pivots: Array | None = None
    ring: Array | None = None
    ring_ratio: Array | None = None
    recesses: Array | None = None
    recess_pressure: Array | None = None
    foil: Array | None = None
    slit: float | None = None


@checked
def bearing_parts(machine: Machine, speed: ArrayLike) -> Parts | None:
    """Return where the parts of a machine's bearing are in static equilibrium.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (k,)
        Running speeds, Ω [rad/s], positive.

    Returns
    -------
    Parts or None
        None where the bearing has a fixed bore.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite, or the film has no answer there.
    """
    return _parts(machine.bearing.geometry, machine, np.atleast_1d(checked_speed(speed)))


@functools.singledispatch
def _parts(_geometry: Geometry, _machine: Machine, _speed: Array) -> Parts | None:
    return None


@_parts.register
def _recesses(geometry: Hydrostatic, machine: Machine, speed: Array) -> Parts:
    pressure = recess_pressure(machine, speed)
    return Parts(speed=speed, recesses=recess_ends(geometry), recess_pressure=pressure)


def recess_ends(geometry: Hydrostatic) -> Array:
    """Return the angles from X at which each recess begins and ends [rad], (N, 2)."""
    pitch = 2.0 * np.pi / geometry.recesses
    half = 0.5 * geometry.recess_angle
    middle = pitch * np.arange(round(geometry.recesses), dtype=np.float64)
    return np.stack((middle - half, middle + half), axis=-1)


@_parts.register
def _foil(geometry: Foil, machine: Machine, speed: Array) -> Parts:
    C = machine.bearing.radial_clearance
    pressed = np.array([foil_deflection(machine, one, _AROUND) for one in speed.tolist()]) / C
    return Parts(speed=speed, foil=pressed, slit=geometry.slit)


@_parts.register
def _pads(_geometry: TiltingPads, machine: Machine, speed: Array) -> Parts:
    bearing, pivots = machine.bearing, pivots_of(machine.bearing)
    # As a displacement on the pad's surface, in C.
    tilts = pad_tilts(machine, speed) * bearing.radius / bearing.radial_clearance
    pads = tuple(pivots.tilted(one) for one in tilts)
    return Parts(speed=speed, pads=pads, pivots=pivots.angle)


@_parts.register
def _ring(_geometry: FloatingRing, machine: Machine, speed: Array) -> Parts:
    found, C = ring_equilibrium(machine, speed), machine.bearing.radial_clearance
    return Parts(
        speed=speed,
        ring=found.outer.position / C,
        ring_ratio=found.speed_ratio,
    )
