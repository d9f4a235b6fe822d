"""Film models: the journal's equilibrium position, and the film's forces on it.

`film_of(bearing)` is the only entry: it returns the film of a bearing, with the interface of
`films.model.Film`. A bearing names its film model; `MODELS` maps that name to a class.
"""

import functools
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, real_array
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.films import short
from rotorcalc.films.dynamics import FilmDynamics, reduced
from rotorcalc.films.finite import CoarseFilm, FiniteFilm
from rotorcalc.films.finite.table import takes_long
from rotorcalc.films.foil import CoarseFoilFilm, FoilFilm
from rotorcalc.films.hydrostatic import CoarseHydrostaticFilm, HydrostaticFilm
from rotorcalc.films.lobes import LobesFilm
from rotorcalc.films.model import BoundedFilm, Film, FilmMotion, InnerMotion, at_one_speed
from rotorcalc.films.own import OwnFilm
from rotorcalc.films.pads import pads_of
from rotorcalc.films.ring import RingFilm
from rotorcalc.films.short import ShortFilm
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.films.tilting import CoarseTiltingFilm, TiltingFilm
from rotorcalc.films.units import FilmUnits
from rotorcalc.geometry import FloatingRing, Foil, Hydrostatic, TiltingPads
from rotorcalc.machine import Bearing, JournalBearing

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
    "draft",
    "film_coefficients",
    "film_of",
    "film_state",
    "has_answer",
    "journal_motion",
    "reduced",
    "short",
    "turning_bounds",
]

# Keys: the kind of a bearing's geometry and the name of its film model.
MODELS: dict[tuple[str, str], Callable[[JournalBearing], Film]] = {
    ("plain", "short"): ShortFilm,
    ("plain", "finite"): FiniteFilm,
    ("partial-arc", "finite"): FiniteFilm,
    ("axial-grooves", "finite"): FiniteFilm,
    ("elliptical", "finite"): FiniteFilm,
    ("offset-halves", "finite"): FiniteFilm,
    ("lobes", "finite"): FiniteFilm,
    ("pressure-dam", "finite"): FiniteFilm,
    ("multi-dam", "finite"): FiniteFilm,
    ("partial-arc", "short"): LobesFilm,
    ("axial-grooves", "short"): LobesFilm,
    ("elliptical", "short"): LobesFilm,
    ("offset-halves", "short"): LobesFilm,
    ("lobes", "short"): LobesFilm,
}
MODELS.update({(kind, "coarse"): CoarseFilm for kind, model in list(MODELS) if model == "finite"})
# A ring's film takes the model of its two films from the bearing.
for _model in ("short", "finite", "coarse"):
    MODELS["floating-ring", _model] = RingFilm
MODELS["hydrostatic", "finite"] = HydrostaticFilm
MODELS["hydrostatic", "coarse"] = CoarseHydrostaticFilm
MODELS["foil", "finite"], MODELS["foil", "coarse"] = FoilFilm, CoarseFoilFilm
MODELS["tilting-pads", "finite"] = TiltingFilm
MODELS["tilting-pads", "coarse"] = CoarseTiltingFilm


@checked
# Bounded: every step of a dragged clearance is another bearing.
@functools.lru_cache(maxsize=1024)
def film_of(bearing: Bearing) -> Film:
    """Return the film of a bearing, made once.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.

    Returns
    -------
    Film
        Of the model that the bearing names; what a table of coefficients gives in place of one.
    """
    if isinstance(bearing, CoefficientTable):
        return OwnFilm(bearing)
    return MODELS[bearing.geometry.kind, bearing.model](bearing)


@checked
def draft(bearing: Bearing) -> Bearing:
    """Return a bearing on a coarse mesh where its own takes long; else as it is.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.

    Returns
    -------
    JournalBearing or CoefficientTable
        The same bore, to draw while it changes.
    """
    if isinstance(bearing, CoefficientTable):
        return bearing
    if bearing.model != "finite" or not _takes_long(bearing):
        return bearing
    return replace(bearing, film="coarse")


def _takes_long(bearing: JournalBearing) -> bool:
    if isinstance(bearing.geometry, FloatingRing):  # two plain films
        return False
    if isinstance(bearing.geometry, TiltingPads):  # free ones share the films of one pad
        return bearing.geometry.rotational_stiffness > 0.0
    # Recesses and foils are solved anew, whatever of them changes.
    return isinstance(bearing.geometry, Hydrostatic | Foil) or takes_long(pads_of(bearing))


@checked
def journal_motion(bearing: Bearing, *, viscosity: float, speed: float) -> FilmMotion:
    """Return the force of a bearing's film on a moving journal, for films without inner states.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    viscosity, speed : float
        μ [Pa·s] and Ω [rad/s]: in its own units only the force of some films depends on them.

    Returns
    -------
    FilmMotion
        In plain floats.

    Raises
    ------
    ValueError
        Where the film has inner coordinates, or the model has no force on a moving journal.
    """
    motion = film_of(bearing).motion()
    if isinstance(motion, FilmMotion):
        return motion
    if motion.states > 0:
        raise ValueError(
            f"bearing = {bearing.geometry.kind}: its film has inner coordinates, parts that move "
            "on their own, which this computation does not include"
        )
    return at_one_speed(motion, viscosity=viscosity, speed=speed)


@checked
def turning_bounds(bearing: Bearing, load: float) -> tuple[float, float]:
    """Return the least and the largest μΩ at which a bearing's film carries a load and has answers.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    load : float
        Static load, F_o [N].

    Returns
    -------
    least, largest : float
        Viscosity times speed, μΩ [Pa]; 0 and infinite where there is no bound.

    Raises
    ------
    ValueError
        Where the film carries the load at no speed.
    """
    film = film_of(bearing)
    if isinstance(film, BoundedFilm):
        return film.turning_bounds(load)
    # σ of Eq. 5.8 is proportional to μΩ.
    unit = float(FilmUnits(bearing, 1.0, 1.0).force)
    return 4.0 * load * film.least_sommerfeld / unit, math.inf


@checked
def has_answer(bearing: Bearing, speed: ArrayLike, *, viscosity: float, load: float) -> BoolArray:
    """Return at which speeds a bearing's film carries a load and has answers.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    speed : array_like, (...)
        Running speed, Ω [rad/s].
    viscosity : float
        μ [Pa·s].
    load : float
        Static load, F_o [N].

    Returns
    -------
    boolean array, (...)
        Of a table of coefficients, from its first speed to its last.

    Raises
    ------
    ValueError
        Where the film carries the load at no speed.
    """
    speeds = real_array("speed", speed)
    if isinstance(bearing, CoefficientTable):
        return np.asarray((speeds >= bearing.first) & (speeds <= bearing.last))
    least, largest = turning_bounds(bearing, load)
    turning = viscosity * speeds
    return np.asarray((turning >= least) & (turning <= largest))


@checked
def film_state(
    bearing: Bearing,
    sommerfeld: ArrayLike,
    *,
    viscosity: ArrayLike = 1.0,
    speed: ArrayLike = 1.0,
) -> FilmState:
    """Return the film of a bearing in static equilibrium over the modified Sommerfeld number.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.
    viscosity, speed : array_like, (...)
        μ [Pa·s] and Ω [rad/s]: a film of fixed parts depends on σ alone, others on these too.

    Returns
    -------
    FilmState
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        Where σ, μ or Ω is not positive.
    """
    points = OperatingPoints.at_sommerfeld(bearing, sommerfeld, viscosity=viscosity, speed=speed)
    return film_of(bearing).state(points)


@checked
def film_coefficients(bearing: Bearing, sommerfeld: ArrayLike) -> tuple[Array, Array]:
    """Return the film's synchronous stiffness and damping over the modified Sommerfeld number.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    stiffness, damping : array, (..., 2, 2)
        In X, Y, in μΩRL³/C³ and μRL³/C³: those of `film_state`, without its other results.

    Raises
    ------
    ValueError
        Where σ is not positive.
    """
    film = film_of(bearing)
    points = OperatingPoints.at_sommerfeld(bearing, sommerfeld)
    if film.frequency_dependent:
        # `state` is synchronous, ν = 1; `dynamics` may still hold inner coordinates.
        state = film.state(points)
        return state.stiffness, state.damping
    dynamics = film.dynamics(points)
    return dynamics.stiffness, dynamics.damping
