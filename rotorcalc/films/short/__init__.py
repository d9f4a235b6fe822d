"""The short journal bearing in closed form.

Model: Reynolds' equation without its circumferential pressure flow (Ocvirk), so for L/D of about a
half and less; laminar, isoviscous, incompressible oil; aligned, rigid and circular surfaces;
ambient pressure at both ends. The film carries over half the circumference: 0 ≤ θ ≤ π behind the
thickest film, and with a moving journal the half that its motion puts under pressure.

Axes: X along the static load, Y at +90° in the sense of rotation; r along the line of centres, t
at +90° from it. θ runs in the sense of rotation from the thickest film, which lies opposite to r.

Units: ε, x, y and film thickness in the radial clearance C; forces in μΩRL³/C²; stiffness in
μΩRL³/C³ and damping in μRL³/C³ ("film units"), or k and c of Eq. 5.32 where a docstring says so.

Source: San Andrés, Notes 5, Eqs. 5.5 to 5.37. Misprints of the source that are corrected here:
the sign in Eq. 5.7, and f_r² printed for f_t² in k_YY and c_YY of Eq. 5.35.
"""

from rotorcalc.films.short.film import ShortFilm
from rotorcalc.films.short.force import film_force
from rotorcalc.films.short.force_coefficients import (
    added_mass,
    damping,
    film_damping,
    film_stiffness,
    radial_damping,
    radial_stiffness,
    stiffness,
)
from rotorcalc.films.short.pressure_field import (
    drag,
    film_thickness,
    peak_position,
    peak_pressure,
    pressure,
    side_flow,
)
from rotorcalc.films.short.static import (
    attitude_angle,
    eccentricity_ratio,
    modified_sommerfeld,
    static_force,
)

__all__ = [
    "ShortFilm",
    "added_mass",
    "attitude_angle",
    "damping",
    "drag",
    "eccentricity_ratio",
    "film_damping",
    "film_force",
    "film_stiffness",
    "film_thickness",
    "modified_sommerfeld",
    "peak_position",
    "peak_pressure",
    "pressure",
    "radial_damping",
    "radial_stiffness",
    "side_flow",
    "static_force",
    "stiffness",
]
