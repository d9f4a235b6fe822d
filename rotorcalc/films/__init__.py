"""Film models: where the journal sits, and how the film holds it.

`film_of(bearing)` is the one door: it gives the film of a bearing, which answers as
`films.model.Film` says. A bearing names its model; `MODELS` knows which class that is.
"""

import functools
from collections.abc import Callable

from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.films import short
from rotorcalc.films.dynamics import FilmDynamics, reduced
from rotorcalc.films.model import Film, FilmMotion, InnerMotion
from rotorcalc.films.short import ShortFilm
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.films.units import FilmUnits
from rotorcalc.machine import JournalBearing

__all__ = [
    "MODELS",
    "Film",
    "FilmDynamics",
    "FilmField",
    "FilmMotion",
    "FilmState",
    "FilmUnits",
    "InnerMotion",
    "OperatingPoints",
    "film_coefficients",
    "film_of",
    "film_state",
    "journal_motion",
    "reduced",
    "short",
]

# By the kind of a bearing's geometry and the name of its film model.
MODELS: dict[tuple[str, str], Callable[[JournalBearing], Film]] = {("plain", "short"): ShortFilm}


@functools.lru_cache(maxsize=1024)
def film_of(bearing: JournalBearing) -> Film:
    """Return the film of a bearing, made once.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.

    Returns
    -------
    Film
        Of the model that the bearing names.
    """
    return MODELS[bearing.geometry.kind, bearing.model](bearing)


@checked
def journal_motion(bearing: JournalBearing) -> FilmMotion:
    """Return the force of a bearing's film on a journal that moves, where it depends on no more.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.

    Returns
    -------
    FilmMotion
        In plain floats.

    Raises
    ------
    ValueError
        Where the film has parts that move by themselves, or no force for a journal that moves.
    """
    motion = film_of(bearing).motion()
    if not isinstance(motion, FilmMotion):
        raise ValueError(
            f"bearing = {bearing.geometry.kind}: its film has parts that move by themselves, "
            "which this computation does not follow"
        )
    return motion


@checked
def film_state(bearing: JournalBearing, sommerfeld: ArrayLike) -> FilmState:
    """Return the film of a bearing in static equilibrium over the modified Sommerfeld number.

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
    return film_of(bearing).state(OperatingPoints.at_sommerfeld(bearing, sommerfeld))


@checked
def film_coefficients(bearing: JournalBearing, sommerfeld: ArrayLike) -> tuple[Array, Array]:
    """Return the film's synchronous stiffness and damping over the modified Sommerfeld number.

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
    film = film_of(bearing)
    points = OperatingPoints.at_sommerfeld(bearing, sommerfeld)
    if film.inner:
        state = film.state(points)
        return state.stiffness, state.damping
    dynamics = film.dynamics(points)
    return dynamics.stiffness, dynamics.damping
