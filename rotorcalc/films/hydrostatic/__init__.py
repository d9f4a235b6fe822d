"""The film of a hydrostatic (hybrid) bearing: recesses supplied through restrictors, and lands."""

from rotorcalc.films.hydrostatic.film import CoarseHydrostaticFilm, HydrostaticFilm

__all__ = ["CoarseHydrostaticFilm", "HydrostaticFilm"]
