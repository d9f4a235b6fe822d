"""Film models: where the journal sits, and how the film holds it.

A film model is a module with five functions, which answer for whole arrays: `state(bearing,
sommerfeld)` with a `FilmState`, `coefficients(bearing, sommerfeld)` with its stiffness and damping
alone, `field(bearing, sommerfeld, angle=..., zeta=...)` with a `FilmField`, `inertia(bearing,
sommerfeld)` with the film's added mass, and `gap(position)` with the thinnest film around a journal
that is not in equilibrium. A bearing names its model in its field `film`.
"""

from collections.abc import Callable
from typing import Protocol, TypeAlias

from numpy.typing import ArrayLike

from rotorcalc.arrays import Array
from rotorcalc.films import short
from rotorcalc.films.short import motion
from rotorcalc.films.state import FilmField, FilmState
from rotorcalc.machine import JournalBearing

__all__ = [
    "FilmField",
    "FilmState",
    "film_added_mass",
    "film_coefficients",
    "film_gap",
    "film_motion",
    "film_pressure",
    "film_state",
    "short",
]


class _FilmModel(Protocol):
    def state(self, bearing: JournalBearing, sommerfeld: ArrayLike) -> FilmState: ...

    def coefficients(
        self, bearing: JournalBearing, sommerfeld: ArrayLike
    ) -> tuple[Array, Array]: ...

    def field(
        self, bearing: JournalBearing, sommerfeld: ArrayLike, *, angle: ArrayLike, zeta: ArrayLike
    ) -> FilmField: ...

    def gap(self, position: ArrayLike) -> Array: ...

    def inertia(self, bearing: JournalBearing, sommerfeld: ArrayLike) -> Array: ...


class _Velocity(Protocol):
    def __call__(
        self, x: float, y: float, f_x: float, f_y: float, near: list[float] | None = ...
    ) -> tuple[float, float]: ...


# Force from position and velocity, velocity from position and force, point by point.
_Kernel: TypeAlias = Callable[[float, float, float, float], tuple[float, float]]
_MOTIONS: dict[str, tuple[_Kernel, _Velocity]] = {"short": (motion.force, motion.velocity)}
_MODELS: dict[str, _FilmModel] = {"short": short}


def film_state(bearing: JournalBearing, sommerfeld: ArrayLike) -> FilmState:
    """Return the film of a bearing in static equilibrium, by the bearing's own film model.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    FilmState
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        Where σ is not positive.
    """
    return _MODELS[bearing.film].state(bearing, sommerfeld)


def film_coefficients(bearing: JournalBearing, sommerfeld: ArrayLike) -> tuple[Array, Array]:
    """Return the film's stiffness and damping in static equilibrium, by the bearing's own model.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    stiffness, damping : array, (..., 2, 2)
        In X, Y, in μΩRL³/C³ and μRL³/C³: those of `film_state`, sooner, for it computes no more.

    Raises
    ------
    ValueError
        Where σ is not positive.
    """
    return _MODELS[bearing.film].coefficients(bearing, sommerfeld)


def film_pressure(
    bearing: JournalBearing, sommerfeld: ArrayLike, *, angle: ArrayLike, zeta: ArrayLike = 0.0
) -> FilmField:
    """Return thickness and pressure of a bearing's film in static equilibrium, by its own model.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
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
    return _MODELS[bearing.film].field(bearing, sommerfeld, angle=angle, zeta=zeta)


def film_added_mass(bearing: JournalBearing, sommerfeld: ArrayLike) -> Array:
    """Return the added mass of a bearing's film, dimensionless, by the bearing's own film model.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    array, (..., 2, 2)
        Integrals of the film's inertia in X, Y, I_ij [-]: the added mass in ρRL³/(12C), without
        the factor for the velocity's profile.

    Raises
    ------
    ValueError
        Where σ is not positive.
    """
    return _MODELS[bearing.film].inertia(bearing, sommerfeld)


def film_gap(bearing: JournalBearing, position: ArrayLike) -> Array:
    """Return the thinnest film around a journal wherever it is, by the bearing's own film model.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
    position : array_like, (..., 2)
        Journal centre in X, Y from the bearing's centre, in C.

    Returns
    -------
    array, (...)
        Smallest film thickness, in C.
    """
    return _MODELS[bearing.film].gap(position)


def film_motion(bearing: JournalBearing) -> tuple[_Kernel, _Velocity]:
    """Return the nonlinear film of a moving journal, by the bearing's own film model.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.

    Returns
    -------
    force, velocity : callables
        Of plain floats: force (f_x, f_y) from (x, y, x', y'), and velocity (x', y') from
        (x, y, f_x, f_y), and if need be a list that carries from one search to the next what makes
        it short, empty at first; position in C, velocity in CΩ, force in μΩRL³/C².
    """
    return _MOTIONS[bearing.film]
