"""The short bearing as a film model (interface in `films.model`)."""

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array
from rotorcalc.films.dynamics import NO_INERTIA, FilmDynamics
from rotorcalc.films.model import FilmMotion, Limit, Source
from rotorcalc.films.short import motion
from rotorcalc.films.short.force_coefficients import (
    added_mass,
    film_units,
    xy_damping,
    xy_stiffness,
)
from rotorcalc.films.short.pressure_field import (
    drag,
    film_thickness,
    peak_position,
    pressure,
    side_flow,
)
from rotorcalc.films.short.static import attitude_angle, eccentricity_ratio, s_squared
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.frames import vector
from rotorcalc.machine import JournalBearing

# Above ε = 0.7560 (σ = 0.066385) the film cannot sustain whirl; above σ = 10 the journal is nearly
# centred, and the coefficients in film units equal those of the centre within 1 part in 5000.
_WHIRLS_ABOVE, _CENTRED_ABOVE = 0.066385, 10.0
# 1 − ε goes as σ^½ and is then 1e-15, known to some ten per cent: floats near 1 are no finer.
_THINNEST_AT = 1e-30

# As printed in the notes, with their misprints corrected.
_SHEET = "the notes' calculation sheet"
_SOURCES: dict[str, Source] = {
    "film": Source(
        "short bearing without a groove, no pressure flow around the journal, cavitated at ambient"
    ),
    "eccentricity": Source(
        "Eq. 5.8",
        r"\frac{1}{\sigma}=\frac{\varepsilon\sqrt{16\varepsilon^2+\pi^2(1-\varepsilon^2)}}"
        r"{(1-\varepsilon^2)^2}",
        remark="more speed or viscosity, less load: closer to the centre",
    ),
    "attitude": Source("Eq. 5.7", r"\tan\varphi=\frac{\pi\sqrt{1-\varepsilon^2}}{4\,\varepsilon}"),
    "thickness": Source("Eq. 5.19", r"h_{min}=C(1-\varepsilon)", remark="C(1 − ε)"),
    "pressure": Source(
        "Eq. 5.25",
        r"p=\frac{3\mu\Omega L^2}{C^2}\,\frac{\varepsilon\sin\theta}{(1+\varepsilon\cos\theta)^3}"
        r"\left(\frac14-\frac{z^2}{L^2}\right)",
        remark="a parabola along z, ambient at both ends",
    ),
    "force": Source("Eqs. 5.5, 5.6, Fig. 5.2"),
    "drag": Source(
        _SHEET,
        r"T=\frac{2\pi\mu\Omega R^3L}{C\sqrt{1-\varepsilon^2}}+\tfrac12 eF_o\sin\varphi",
    ),
    "flow": Source(_SHEET, r"Q=\Omega RLC\,\varepsilon"),
    "stiffness": Source("Eqs. 5.30, 5.35"),
    "damping": Source("Eqs. 5.31, 5.35", remark="large at low speed, where the film is thin"),
    "k": Source("Eqs. 5.34, 5.35"),
    "c": Source("Eqs. 5.34, 5.35"),
    "XY": Source("Eq. 5.35", remark=r"$k_{YY}$ and $c_{YY}$ corrected"),
    "rt": Source("Eqs. 5.30, 5.31, 5.34"),
    "centre": Source("Eq. 5.37", r"K_{XY}=-K_{YX}=\tfrac{\Omega}{2}C_{XX}"),
    "half speed": Source("Eq. 5.48", r"\frac{\omega_s}{\Omega_s}\to\tfrac12"),
    "over ε": Source("Fig. 5.5"),
    "over σ": Source("Fig. 5.6"),
    "whirl ratio": Source("Fig. 5.7"),
    "threshold": Source("Fig. 5.8"),
    "critical mass": Source("Fig. 5.9"),
    "flexible threshold": Source("Fig. 5.10"),
}


@dataclass(frozen=True)
class ShortFilm:
    """The film of one short bearing with a circular bore, in closed form.

    Attributes
    ----------
    bearing : JournalBearing
        The bearing; only L/D enters, and only the drag.
    """

    bearing: JournalBearing

    inner: int = field(default=0, init=False)
    frequency_dependent: bool = field(default=False, init=False)
    can_whirl: bool = field(default=True, init=False)
    curve: Hashable = field(default="short", init=False)
    sommerfeld_range: tuple[float, float] = field(
        default=(_WHIRLS_ABOVE, _CENTRED_ABOVE), init=False
    )
    least_sommerfeld: float = field(default=_THINNEST_AT, init=False)

    @property
    def sources(self) -> Mapping[str, Source]:
        """Equations of the notes."""
        return _SOURCES

    @property
    def limits(self) -> tuple[Limit, ...]:
        """Length over diameter: the model neglects circumferential pressure flow."""
        return (
            Limit(
                "Length over diameter, L/D", self.bearing.length / self.bearing.diameter, 0.5, 1.0,
                "the short bearing neglects the circumferential pressure flow; it overestimates "
                "the force of longer bearings",
            ),
        )  # fmt: skip

    def state(self, points: OperatingPoints) -> FilmState:
        """Return the film in static equilibrium.

        Raises
        ------
        ValueError
            Where σ is so small that ε rounds to 1.
        """
        eps = _eccentricity(points)
        s2 = s_squared(eps)
        units = film_units(eps, s2)
        phi, peak = attitude_angle(eps), peak_position(eps)
        return FilmState(
            sommerfeld=points.sommerfeld,
            position=vector(eps * np.cos(phi), eps * np.sin(phi)),
            attitude_angle=phi,
            minimum_thickness=1.0 - eps,
            stiffness=xy_stiffness(eps, s2, *units),
            damping=xy_damping(eps, s2, *units),
            side_flow=side_flow(eps),
            drag=self._drag(eps),
            peak_pressure=pressure(eps, peak),
            peak_angle=phi + np.pi + peak,  # θ = 0 lies at Θ = φ + π
        )

    def place_and_flow(self, sommerfeld: Array) -> tuple[Array, Array]:
        """Return the journal's centre at σ, (..., 2), in C, and the side flow: of `state` alone."""
        eps = eccentricity_ratio(sommerfeld)
        # cos φ = 4ε/√(16ε² + π²s²) and sin φ = πs/√(…), Eq. 5.7.
        along, across = 4.0 * eps, np.pi * np.sqrt(s_squared(eps))
        share = eps / np.hypot(along, across)
        return vector(share * along, share * across), side_flow(eps)

    def dynamics(self, points: OperatingPoints) -> FilmDynamics:
        """Return stiffness and damping only, in half the time of `state`."""
        eps = _eccentricity(points)
        s2 = s_squared(eps)
        units = film_units(eps, s2)
        return FilmDynamics(
            stiffness=xy_stiffness(eps, s2, *units),
            damping=xy_damping(eps, s2, *units),
            inertia=NO_INERTIA,
        )

    def drag_and_flow(self, points: OperatingPoints) -> tuple[Array, Array]:
        """Return drag and side flow only."""
        eps = _eccentricity(points)
        return self._drag(eps), side_flow(eps)

    def _drag(self, eps: Array) -> Array:
        return drag(eps, length_to_radius=self.bearing.length / self.bearing.radius)

    def field(self, points: OperatingPoints, *, angle: ArrayLike, zeta: ArrayLike) -> FilmField:
        """Return thickness and pressure in static equilibrium.

        Raises
        ------
        ValueError
            Where ζ lies outside the bearing.
        """
        eps, angle, zeta = np.broadcast_arrays(eccentricity_ratio(points.sommerfeld), angle, zeta)
        # The thickest film lies opposite to the line of centres.
        theta = angle - attitude_angle(eps) - np.pi
        return FilmField(
            angle=angle,
            zeta=zeta,
            thickness=film_thickness(eps, theta),
            pressure=pressure(eps, theta, zeta),
            cavitated=np.sin(theta) < -1e-12,  # θ = 0 and π, as they round, are in the full film
        )

    def added_mass(self, points: OperatingPoints) -> Array:
        """Return the integrals of the film's inertia, I_ij, in ρRL³/(12C)."""
        return added_mass(eccentricity_ratio(points.sommerfeld))

    def motion(self) -> FilmMotion:
        """Return the force on a moving journal, and its inverse, in plain floats."""
        return FilmMotion(force=motion.force, velocity=motion.velocity)

    def accuracy(self, sommerfeld: float) -> None:
        """Return None: the film is a closed form."""

    def gap(self, position: ArrayLike) -> Array:
        """Return the minimum film thickness, 1 − ε (Eq. 5.19)."""
        place = np.asarray(position, dtype=float)
        return 1.0 - np.hypot(place[..., 0], place[..., 1])

    def outline(self, angle: ArrayLike) -> Array:
        """Return the clearance circle, of radius 1."""
        return vector(np.cos(angle), np.sin(angle))


def _eccentricity(points: OperatingPoints) -> Array:
    """Return ε, or raise ValueError where the film's thickness is lost in its rounding."""
    sigma = points.sommerfeld
    if sigma.size and (least := np.min(sigma)) < _THINNEST_AT:
        raise ValueError(
            f"sommerfeld = {least:.3g}: too small, below {_THINNEST_AT:g} the film's thickness is "
            "lost in rounding"
        )
    return eccentricity_ratio(sigma)
