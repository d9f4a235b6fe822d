"""A table's impedance between its places and between its whirl ratios."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from rotorcalc.arrays import Array, ComplexArray, IntArray

# Whirl ratios are told apart by s = ν/(ν + ½), evenly up to a fast whirl. Over s, Z/(1 + ν) is
# smooth from ν = 0 to where the gas has no time to flow; beyond the last ratio Z is constant.
_EVEN, _FAST = 45, (30.0, 50.0, 100.0, 300.0, 1000.0)


def _share(nu: Array) -> Array:
    return nu / (nu + 0.5)


# Synchronous whirl, ν = 1 and s = 2/3, is one of them.
_S: Array = np.append(np.arange(_EVEN) / _EVEN, _share(np.array(_FAST)))
RATIOS: Array = 0.5 * _S / (1.0 - _S)
_SYNCHRONOUS = 2 * _EVEN // 3
# Slopes over s of the cubic splines through one value 1 and others 0: of any values a sum of these.
_SLOPES: Array = np.asarray(CubicSpline(_S, np.eye(len(_S)))(_S, 1))


@dataclass(frozen=True, eq=False)
class WhirlRows:
    """Z/(1 + ν) at `RATIOS` as splines over a table's place; by real and imaginary part."""

    _splines: CubicSpline
    _synchronous: CubicSpline

    @classmethod
    def through(cls, place: Array, Z: ComplexArray) -> "WhirlRows":
        """Return splines through Z (n, ratios, 2, 2) at rising places (n,)."""
        scaled = Z / (1.0 + RATIOS)[:, None, None]
        parts = np.stack([scaled.real, scaled.imag], axis=-1).reshape(len(place), len(RATIOS), 8)
        return cls(CubicSpline(place, parts), CubicSpline(place, parts[:, _SYNCHRONOUS]))

    def synchronous(self, place: Array) -> tuple[Array, Array]:
        """Return K and C at ν = 1, (..., 2, 2)."""
        parts = 2.0 * np.asarray(self._synchronous(place)).reshape(*np.shape(place), 2, 2, 2)
        return parts[..., 0], parts[..., 1]

    def at(self, place: Array) -> "Whirl":
        """Return the impedance at places (...) over any ν."""
        values = np.asarray(self._splines(place))
        return Whirl(values, _SLOPES @ values)


@dataclass(frozen=True, eq=False)
class Whirl:
    """Z/(1 + ν) at `RATIOS` and its slopes over s, (..., ratios, 8) each."""

    values: Array
    slopes: Array

    def __call__(self, whirl_ratio: Array) -> tuple[Array, Array]:
        """Return K and C at whirl ratios ν (k..., ...), positive, of the places (...)."""
        nu = np.asarray(whirl_ratio, dtype=float)
        inside = np.minimum(nu, RATIOS[-1])
        s = _share(inside)
        i = np.clip(np.searchsorted(_S, s, side="right") - 1, 0, len(_S) - 2)
        step = (_S[i + 1] - _S[i])[..., None]
        t = (s - _S[i])[..., None] / step
        low, high = self._taken(self.values, i), self._taken(self.values, i + 1)
        rise, end = step * self._taken(self.slopes, i), step * self._taken(self.slopes, i + 1)
        # Hermite's cubic between two ratios.
        parts = low + t * (
            rise
            + t * (3.0 * (high - low) - 2.0 * rise - end + t * (2.0 * (low - high) + rise + end))
        )
        Z = ((1.0 + inside)[..., None] * parts).reshape(*nu.shape, 2, 2, 2)
        return Z[..., 0], Z[..., 1] / nu[..., None, None]

    def _taken(self, rows: Array, i: IntArray) -> Array:
        """Return each place's own row at its ratio, (k..., ..., 8)."""
        lead = i.shape[: i.ndim - (rows.ndim - 2)]
        wide = np.broadcast_to(rows, (*lead, *rows.shape))
        return np.take_along_axis(wide, i[..., None, None], axis=-2)[..., 0, :]
