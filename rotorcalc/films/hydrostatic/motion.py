"""The force of lands and recesses on a moving journal, one point at a time, for integration.

At each instant the recesses' pressures balance their flows: the oil in them and in the pipes is
incompressible, and what passes a restrictor leaves over the lands at once. With the matrices of
`influence` and the motion w = (x' + y/2, y' − x/2)

    q y = G P(y) − 12 S g w,    F = −gᵀ P − 12 S D w

the flows y follow from w, and from a given force with G + g D⁻¹ gᵀ in place of G and −g D⁻¹ F
in place of −12 S g w. Multiplied by either matrix's inverse both are the gradient of a convex
function of y, so there is one solution. As in static equilibrium the film stays full, whatever its
pressure.
"""

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, cast

import numpy as np
from scipy.linalg import lapack

from rotorcalc.arrays import Array
from rotorcalc.films.hydrostatic.balance import Bearing, bearing_with
from rotorcalc.films.state import OperatingPoints
from rotorcalc.geometry import Hydrostatic
from rotorcalc.machine import JournalBearing

# Newton's steps, and the size of the last, whose square is what remains.
_MOST_STEPS, _SETTLED = 80, 1e-9


@dataclass(frozen=True)
class RecessesInMotion:
    """The film of a hydrostatic bearing, and its force on a moving journal.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing, of a `Hydrostatic` geometry.
    coarse : bool
        Whether its table is that for drafts.
    """

    bearing: JournalBearing
    coarse: bool = False
    # The flows of the last points, of force and of velocity: how soon the next are found, not what.
    _by_motion: list[Array] = field(
        default_factory=list["Array"], init=False, repr=False, compare=False
    )
    _by_force: list[Array] = field(
        default_factory=list["Array"], init=False, repr=False, compare=False
    )

    def __reduce__(self) -> tuple[type, tuple[JournalBearing, bool]]:
        """Return the bearing, with which another process makes the table again."""
        return type(self), (self.bearing, self.coarse)

    @cached_property
    def _on(self) -> Bearing:
        return bearing_with(self.bearing, coarse=self.coarse)

    @cached_property
    def _supply(self) -> float:
        return cast("Hydrostatic", self.bearing.geometry).supply_pressure

    @cached_property
    def _slender(self) -> float:
        """(R/L)²: the film's units have L for R."""
        return (self.bearing.radius / self.bearing.length) ** 2

    def rest(self, points: OperatingPoints) -> Array:
        """Return the inner states, of which there are none, (..., 0)."""
        return np.empty((*np.shape(points.sommerfeld), 0))

    def number(self, viscosity: float, speed: float) -> float:
        """Return S = μΩ(R/C)²/p_s."""
        one = self.bearing
        return viscosity * speed * (one.radius / one.radial_clearance) ** 2 / self._supply

    def force(
        self,
        moving: tuple[float, float, float, float],
        inner: list[float],  # noqa: ARG002 - the seam's, none
        viscosity: float,
        speed: float,
    ) -> tuple[float, float, list[float]]:
        """Return the force on a moving journal, as `InnerMotion.force`.

        From (x, y, x', y') in C and CΩ, in μΩRL³/C².
        """
        x, y, dx, dy = moving
        S, at = self.number(viscosity, speed), self._on.table.point(x, y)
        pushed = 12.0 * S * np.array([dx + 0.5 * y, dy - 0.5 * x])
        P = self._pressures(at.conductance, -at.pumping @ pushed, self._by_motion)
        f_x, f_y = (-self._slender / S * (P @ at.pumping + at.squeeze @ pushed)).tolist()
        return f_x, f_y, []

    def velocity(
        self,
        moving: tuple[float, float, float, float],
        inner: list[float],  # noqa: ARG002 - the seam's, none
        viscosity: float,
        speed: float,
    ) -> tuple[float, float, list[float]]:
        """Return the velocity at which the film's force on the journal is the given one.

        As `InnerMotion.velocity`, from (x, y, f_x, f_y).
        """
        x, y, *f = moving
        S, at = self.number(viscosity, speed), self._on.table.point(x, y)
        F, g = S / self._slender * np.array(f), at.pumping
        (a, b), (_, d) = at.squeeze.tolist()
        inverse = np.array([[d, -b], [-b, a]]) / (a * d - b * b)
        moves = g @ inverse  # g D⁻¹
        P = self._pressures(at.conductance + moves @ g.T, moves @ F, self._by_force)
        w_x, w_y = (-inverse @ (F + P @ g) / (12.0 * S)).tolist()
        return w_x - 0.5 * y, w_y + 0.5 * x, []

    def recess_pressure(
        self, moving: tuple[float, float, float, float], viscosity: float, speed: float
    ) -> Array:
        """Return the recess pressures around a moving journal, (N,), in p_s."""
        x, y, dx, dy = moving
        S, at = self.number(viscosity, speed), self._on.table.point(x, y)
        pushed = 12.0 * S * np.array([dx + 0.5 * y, dy - 0.5 * x])
        return self._pressures(at.conductance, -at.pumping @ pushed, self._by_motion)

    def _pressures(self, conductance: Array, flow: Array, near: list[Array]) -> Array:
        """Return the recess pressures at which q y = G P(y) + flow, from the flows near by."""
        restrictors, q = self._on.restrictors, self._on.size
        y = near[0] if near else np.full(len(flow), restrictors.centred_flow)
        solve = cast("Any", lapack.dgesv)
        for _ in range(_MOST_STEPS):
            left = q * y - conductance @ restrictors.pressure(y) - flow
            J = -conductance * restrictors.slope(y)
            J.flat[:: len(y) + 1] += q
            *_, step, info = solve(J, left)
            y = y - step
            size = float(np.abs(step).max())
            if info or not math.isfinite(size):
                break
            if size < _SETTLED or restrictors.kind == "capillary":
                near[:] = [y]
                return restrictors.pressure(y)
        raise ArithmeticError(
            "no balance of the recesses' flows was found for the journal's motion"
        )
