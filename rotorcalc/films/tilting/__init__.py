"""Tilting pads of finite length, free or on flexures: Reynolds' equation, solved numerically.

Model: as `films.finite`; besides, each pad tilts about a pivot on its own surface's circle, without
friction, against the rotational stiffness of a flexure or none, with or without inertia. Pivots and
pads do not deform.
"""

from rotorcalc.films.tilting.film import CoarseTiltingFilm, TiltingFilm

__all__ = ["CoarseTiltingFilm", "TiltingFilm"]
