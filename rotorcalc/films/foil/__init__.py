"""The gas film of a foil bearing: Reynolds' equation of a compressible film on springs."""

from rotorcalc.films.foil.film import CoarseFoilFilm, FoilFilm
from rotorcalc.films.foil.table import CHECKED

__all__ = ["CHECKED", "CoarseFoilFilm", "FoilFilm"]
