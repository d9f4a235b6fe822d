"""The gas film of a foil bearing: Reynolds' equation of a compressible film on springs."""

from rotorcalc.films.foil.film import CoarseFoilFilm, FoilFilm

__all__ = ["CoarseFoilFilm", "FoilFilm"]
