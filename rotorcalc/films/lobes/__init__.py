"""Short bearings of several pads, or of part of a circle, in closed form.

Model: Reynolds' equation without its circumferential pressure flow, as for the short plain bearing;
every pad a part of a circle, at ambient pressure in the grooves. The pressure falls to ambient
within a length of about L/2 of a pad's edge, which is neglected, so that of a film that begins or
ends at an edge under pressure the force is too high; the film carries where the journal's rotation
and motion together press it.

In a pad's own frame h = 1 − e cos θ, θ = β − γ, with the journal at e, γ from the pad's centre of
curvature. Sommerfeld's substitution, cos θ = (cos ψ + e)/(1 + e cos ψ), makes all integrals
elementary.
"""

from rotorcalc.films.lobes.film import LobesFilm

__all__ = ["LobesFilm"]
