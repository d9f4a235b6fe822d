"""Values of a film over the load, 1/(4σ): splines over its logarithm, and a line to no load.

Without pressure a film opposes a displacement as it does a whirl at half speed, K = ½C·J with J a
right angle forward. Of a light load that part is large and says nothing of stability, so the rest
of K has splines of its own, and k_eq keeps its digits.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from rotorcalc.arrays import Array

# Coefficients grow at heavy loads about as the load to this power, by which they are divided.
GROWTH = 1.25


def half_whirl(C: Array) -> Array:
    """Return ½C·J: the stiffness of a film without pressure, whose force is that of a whirl."""
    K = np.empty_like(C)
    K[..., 0], K[..., 1] = -0.5 * C[..., 1], 0.5 * C[..., 0]
    return K


@dataclass(frozen=True, eq=False)
class LoadSplines:
    """Values over the load, in film units.

    Attributes
    ----------
    load : array, (n,)
        Rising loads, above none [-].
    unloaded : array, (k,)
        The values without load.
    scale : float
        The load about which the values begin to grow as its power; infinite where they do not.
    """

    load: Array
    unloaded: Array
    scale: float
    _spline: CubicSpline

    @classmethod
    def through(cls, load: Array, values: Array, *, scale: float = math.inf) -> "LoadSplines":
        """Return splines through values (n + 1, k), without load and at rising loads (n,)."""
        unloaded, values = values[0], values[1:]
        growth = (1.0 + load / scale) ** GROWTH
        slope = GROWTH * load[0] / (scale + load[0])
        # They continue the line from no load.
        start = (values[0] - unloaded - values[0] * slope) / growth[0]
        spline = CubicSpline(
            np.log(load), values / growth[:, None], bc_type=((1, start), "not-a-knot")
        )
        return cls(load, unloaded, scale, spline)

    def at(self, load: Array) -> Array:
        """Return the values at loads (...) up to the heaviest, (..., k)."""
        lightest = self.load[0]
        inside = np.minimum(np.maximum(load, lightest), self.load[-1])
        values = np.asarray(self._spline(np.log(inside)))
        if self.scale < math.inf:
            values *= ((1.0 + inside / self.scale) ** GROWTH)[..., None]
        light = load < lightest
        if light.any():
            share = (load[light] / lightest)[:, None]
            values[light] = (1.0 - share) * self.unloaded + share * values[light]
        return values


@dataclass(frozen=True, eq=False)
class CoefficientSplines:
    """Stiffness and damping over the load, in film units; damping is symmetric."""

    _splines: LoadSplines

    @classmethod
    def through(cls, load: Array, K: Array, C: Array, *, scale: float) -> "CoefficientSplines":
        """Return splines through K, C (n + 1, 2, 2), without load and at rising loads (n,)."""
        rest = (K - half_whirl(C)).reshape(len(K), 4)
        values = np.column_stack([C[:, 0, 0], C[:, 0, 1], C[:, 1, 1], rest])
        return cls(LoadSplines.through(load, values, scale=scale))

    def at(self, load: Array) -> tuple[Array, Array]:
        """Return stiffness and damping at loads (...), each (..., 2, 2)."""
        values = self._splines.at(load)
        C = values.take((0, 1, 1, 2), axis=-1).reshape(*load.shape, 2, 2)
        return values[..., 3:].reshape(*load.shape, 2, 2) + half_whirl(C), C
