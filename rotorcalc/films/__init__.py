"""Film models: where the journal sits, and how the film holds it.

A film model is a module with a function `state(bearing, sommerfeld)`, which answers for whole
arrays of modified Sommerfeld numbers with a `FilmState`. A bearing names its model in its field
`film`.
"""

from collections.abc import Callable

from numpy.typing import ArrayLike

from rotorcalc.films import short
from rotorcalc.films.state import FilmState
from rotorcalc.machine import JournalBearing

__all__ = ["FilmState", "film_state", "short"]

_STATES: dict[str, Callable[[JournalBearing, ArrayLike], FilmState]] = {"short": short.state}


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
    return _STATES[bearing.film](bearing, sommerfeld)
