"""Restrictors before the recesses of a hydrostatic bearing: flow through them and recess pressure.

A capillary passes Q = q (1 − P), an orifice Q = q √(1 − P), P the recess pressure over the supply
pressure. In y = Q/q both are smooth, P = 1 − y and P = 1 − y|y|, also where the film's rotation
pumps oil back, P > 1. They are sized so that the recesses of the centred bearing at rest have the
pressure β p_s (Rowe, Hydrostatic, Aerostatic and Hybrid Bearing Design, 2012).
"""

from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array


@dataclass(frozen=True)
class Restrictors:
    """The restrictors before the recesses.

    Attributes
    ----------
    kind : "capillary" or "orifice"
        How the flow depends on the pressure.
    pressure_ratio : float
        Recess pressure of the centred bearing at rest over the supply pressure, β [-].
    """

    kind: str
    pressure_ratio: float

    def size(self, outflow: float) -> float:
        """Return q from the outflow of a recess at the supply pressure, in the centre at rest."""
        beta = self.pressure_ratio
        left = 1.0 - beta
        return outflow * beta / (left if self.kind == "capillary" else np.sqrt(left))

    @property
    def centred_flow(self) -> float:
        """The unknown y of the centred bearing at rest."""
        left = 1.0 - self.pressure_ratio
        return left if self.kind == "capillary" else float(np.sqrt(left))

    def pressure(self, y: Array) -> Array:
        """Return the recess pressure behind a restrictor that passes q y, P = p/p_s."""
        return 1.0 - (y if self.kind == "capillary" else y * np.abs(y))

    def slope(self, y: Array) -> Array:
        """Return dP/dy."""
        return -np.ones_like(y) if self.kind == "capillary" else -2.0 * np.abs(y)
