"""The short bearing as a film model: what the rest of the program asks of it."""

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array, real_array
from rotorcalc.films.short.force_coefficients import (
    added_mass,
    film_damping,
    film_stiffness,
    film_units,
    xy_damping,
    xy_stiffness,
)
from rotorcalc.films.short.pressure_field import (
    drag,
    film_thickness,
    peak_position,
    peak_pressure,
    pressure,
    side_flow,
)
from rotorcalc.films.short.static import attitude_angle, eccentricity_ratio, s_squared
from rotorcalc.films.state import FilmField, FilmState
from rotorcalc.frames import vector
from rotorcalc.machine import JournalBearing


def state(bearing: JournalBearing, sommerfeld: ArrayLike) -> FilmState:
    """Return the short bearing's film in static equilibrium, dimensionless.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing; only L/D enters, and only the drag.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    FilmState
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        Where σ is not positive, or so small that the film is thinner than the arithmetic can tell.
    """
    eps = _afloat(sommerfeld)
    phi = attitude_angle(eps)
    return FilmState(
        sommerfeld=np.asarray(sommerfeld, dtype=float),
        position=vector(eps * np.cos(phi), eps * np.sin(phi)),
        attitude_angle=phi,
        minimum_thickness=1.0 - eps,
        stiffness=film_stiffness(eps),
        damping=film_damping(eps),
        side_flow=side_flow(eps),
        drag=drag(eps, length_to_radius=bearing.length / bearing.radius),
        peak_pressure=peak_pressure(eps),
        peak_angle=phi + np.pi + peak_position(eps),
    )


def coefficients(
    bearing: JournalBearing,  # noqa: ARG001 - other film models need it
    sommerfeld: ArrayLike,
) -> tuple[Array, Array]:
    """Return the short bearing's stiffness and damping in static equilibrium, in film units.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing; nothing of it enters.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    stiffness, damping : array, (..., 2, 2)
        As `state` gives them, without the rest.

    Raises
    ------
    ValueError
        As in `state`.
    """
    eps = _afloat(sommerfeld)
    s2 = s_squared(eps)
    units = film_units(eps, s2)
    return xy_stiffness(eps, s2, *units), xy_damping(eps, s2, *units)


def field(
    bearing: JournalBearing,  # noqa: ARG001 - other film models need it
    sommerfeld: ArrayLike,
    *,
    angle: ArrayLike,
    zeta: ArrayLike,
) -> FilmField:
    """Return the short bearing's film thickness and pressure in static equilibrium, dimensionless.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing; nothing of it enters.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.
    angle : array_like, (...)
        Angle Θ around the bearing from X in the sense of rotation [rad].
    zeta : array_like, (...)
        Axial position from the bearing's middle, ζ = z/L [-], −1/2 ≤ ζ ≤ 1/2.

    Returns
    -------
    FilmField
        Its fields have the shape that σ, angle and ζ give together.

    Raises
    ------
    ValueError
        Where σ is not positive or ζ lies outside the bearing.
    """
    eps, angle, zeta = np.broadcast_arrays(eccentricity_ratio(sommerfeld), angle, zeta)
    # The thickest film lies opposite to the line of centres.
    theta = angle - attitude_angle(eps) - np.pi
    return FilmField(
        angle=angle,
        zeta=zeta,
        thickness=film_thickness(eps, theta),
        pressure=pressure(eps, theta, zeta),
        cavitated=np.sin(theta) < -1e-12,  # θ = 0 and π, as they round, belong to the full film
    )


def gap(position: ArrayLike) -> Array:
    """Return the thinnest film around a journal wherever it is, 1 − ε (Eq. 5.19).

    Parameters
    ----------
    position : array_like, (..., 2)
        Journal centre in X, Y from the bearing's centre, in C.

    Returns
    -------
    array, (...)
        Smallest film thickness, in C.
    """
    place = np.asarray(position, dtype=float)
    return 1.0 - np.hypot(place[..., 0], place[..., 1])


def inertia(bearing: JournalBearing, sommerfeld: ArrayLike) -> Array:  # noqa: ARG001 - the seam's
    """Return the film's added mass in X, Y in static equilibrium: `added_mass` at a σ.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing; the short bearing's integrals do not ask for its shape.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    array, (..., 2, 2)
        I_ij [-], in ρRL³/(12C).

    Raises
    ------
    ValueError
        Where σ is negative, or so small that the film's thickness rounds to zero.
    """
    return added_mass(eccentricity_ratio(sommerfeld))


def _afloat(sommerfeld: ArrayLike) -> Array:
    """Return ε where it is less than 1."""
    sigma = real_array("sommerfeld", sommerfeld)
    eps = eccentricity_ratio(sigma)
    if eps.size and eps.max() == 1.0:
        raise ValueError(
            f"sommerfeld = {np.min(sigma):.3g}: too small, the film's thickness rounds to zero"
        )
    return eps
