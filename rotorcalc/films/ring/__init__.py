"""The floating ring: two plain films in series, between them a ring that turns freely.

Model: each film is that of a plain bearing, short or of finite length, with the wedge of its two
surfaces' summed speeds: Ω + Ω_R inside the ring, Ω_R outside it. The ring turns at the speed at
which both films' torques on it are equal. One temperature stands for both films; a ratio of
viscosities for their difference. Both carry the journal's load: the ring's weight is left out.
"""

from rotorcalc.films.ring import balance
from rotorcalc.films.ring.film import RingFilm

__all__ = ["RingFilm", "balance"]
