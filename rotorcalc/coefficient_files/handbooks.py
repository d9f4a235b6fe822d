"""Dimensionless tables of handbooks, made real by a bearing, its oil and its load.

A row of such a table holds at one Sommerfeld number, which a given bearing reaches at one speed.
Three numbers of that name are in use, with L the length, D = 2R, C the radial clearance, W the load
and N the speed in revolutions a second:

- classical, S = μ N D L/W · (R/C)² (Raimondi and Boyd);
- modified, σ = μ Ω L R/(4 W) · (L/C)² = π S (L/D)² (notes, Eq. 5.27);
- of DIN 31652, So = W ψ²/(D L μ Ω) with ψ = C/R, which rises with the load: So = 1/(2π S).

The coefficients are K C/W and C Ω C/W, or those with the film's viscosity in place of the load,
K (C/R)³/(μ Ω L) and C (C/R)³/(μ L).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array

SOMMERFELDS = ("classical", "modified", "DIN")
NORMALISATIONS = ("load", "viscosity")


@dataclass(frozen=True, kw_only=True)
class Scale:
    """What makes a dimensionless table real.

    Parameters
    ----------
    diameter, length, radial_clearance : float
        Of the bearing, D, L, C [m].
    viscosity : float
        Of the oil in the film, μ [Pa·s].
    load : float
        Static load of the bearing, W [N].
    sommerfeld : str
        Which Sommerfeld number the table has: "classical" S, "modified" σ, or "DIN" So.
    normalised_by : str
        "load" for K C/W and C Ω C/W; "viscosity" for K (C/R)³/(μ Ω L) and C (C/R)³/(μ L).
    """

    diameter: float
    length: float
    radial_clearance: float
    viscosity: float
    load: float
    sommerfeld: str = "classical"
    normalised_by: str = "load"

    def __post_init__(self) -> None:
        """Refuse what is no bearing."""
        for name in ("diameter", "length", "radial_clearance", "viscosity", "load"):
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, int | float | np.floating):
                raise ValueError(f"{name} = {value!r}: must be a number")
            if not 0.0 < value < math.inf:
                raise ValueError(f"{name} = {value}: must be positive and finite")
        for name, known in (("sommerfeld", SOMMERFELDS), ("normalised_by", NORMALISATIONS)):
            if getattr(self, name) not in known:
                words = " or ".join(map(repr, known))
                raise ValueError(f"{name} = {getattr(self, name)!r}: must be {words}")

    def speed(self, number: Array) -> Array:
        """Return the speed of each Sommerfeld number, Ω [rad/s], shape as given."""
        return self.speed_by(self.sommerfeld, number)

    def speed_by(self, kind: str, number: Array) -> Array:
        """Return the same by another of the three numbers."""
        D, L, R = self.diameter, self.length, self.diameter / 2.0
        C, mu, W = self.radial_clearance, self.viscosity, self.load
        if kind == "classical":
            return 2.0 * math.pi * number * W / (mu * D * L) * (C / R) ** 2
        if kind == "modified":
            return 4.0 * number * W / (mu * L * R) * (C / L) ** 2
        return W * (C / R) ** 2 / (D * L * mu * number)

    def stiffness(self, K: Array, speed: Array) -> Array:
        """Return real stiffness [N/m], shape (n, 2, 2), from the dimensionless one."""
        if self.normalised_by == "load":
            return K * (self.load / self.radial_clearance)
        return K * (self._film * speed)[:, None, None]

    def damping(self, C: Array, speed: Array) -> Array:
        """Return real damping [N·s/m], shape (n, 2, 2), from the dimensionless one."""
        if self.normalised_by == "load":
            return C * (self.load / (self.radial_clearance * speed))[:, None, None]
        return C * self._film

    @property
    def _film(self) -> float:
        """μ L (R/C)³."""
        R = self.diameter / 2.0
        return self.viscosity * self.length * (R / self.radial_clearance) ** 3


def doubt(scale: Scale, number: Array, eccentricity: Array) -> str:
    """Return in words that a table's numbers do not look like the kind that was said, or "".

    A film's eccentricity falls with S and with σ, and rises with So. Beyond that the short bearing
    (notes, Eq. 5.27) tells them apart where they differ by more than other bearings do from it.
    """
    if len(number) < 2:
        return ""
    order = np.argsort(eccentricity)
    rises = bool(number[order][-1] > number[order][0])
    if rises != (scale.sommerfeld == "DIN"):
        kind = "of DIN 31652, So" if rises else "classical, S, or modified, σ"
        return (
            f"The Sommerfeld number {'rises' if rises else 'falls'} with the eccentricity ratio "
            f"here, as those do that are {kind}."
        )
    away = {kind: _away(scale, kind, number, eccentricity) for kind in ("classical", "modified")}
    if scale.sommerfeld not in away:
        return ""
    other = "modified" if scale.sommerfeld == "classical" else "classical"
    if away[scale.sommerfeld] > math.log(4.0) and away[other] < math.log(2.0):
        return (
            f"With these eccentricity ratios the numbers look like the {other} Sommerfeld "
            f"number's, not like the {scale.sommerfeld} one's."
        )
    return ""


def _away(scale: Scale, kind: str, number: Array, eccentricity: Array) -> float:
    """Return by how much numbers differ from a short bearing's, as the mean of a logarithm."""
    eps = np.clip(eccentricity, 1e-3, 0.999)
    e2 = eps**2
    sigma = (1 - e2) ** 2 / (eps * np.sqrt(16 * e2 + math.pi**2 * (1 - e2)))
    ratio: Callable[[str], Array] = lambda of: scale.speed_by(of, number)  # noqa: E731
    return float(abs(np.mean(np.log(ratio(kind) / scale.speed_by("modified", sigma)))))
