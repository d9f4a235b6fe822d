"""Bearings of finite length and any fixed bore: Reynolds' equation, solved numerically.

Model: laminar, isoviscous, incompressible oil; aligned, rigid surfaces; ambient pressure at both
ends, in the grooves and in the broken film, which begins and ends where pressure and its slope
vanish (Swift and Stieber). A bore's film depends on σ alone: it is tabulated over the load once for
each geometry and L/D, and every result is read from the table.
"""

from rotorcalc.films.finite.circle import CIRCLE_SECONDS, CircleInMotion
from rotorcalc.films.finite.film import CoarseFilm, FiniteFilm
from rotorcalc.films.finite.impedance import Shape
from rotorcalc.films.finite.motion import APART, THINNEST

__all__ = [
    "APART",
    "CIRCLE_SECONDS",
    "THINNEST",
    "CircleInMotion",
    "CoarseFilm",
    "FiniteFilm",
    "Shape",
]
