"""Results of a floating ring: its speed, and the place of journal and ring in their films."""

import math
from collections.abc import Callable

from rotorcalc.films.model import Source
from rotorcalc.ring import RingFilmEquilibrium
from ui import ring
from ui.computed import Computed
from ui.format import tex
from ui.results.record import Result
from ui.words import citation


def _balance(computed: Computed) -> Source:
    """Return what gives the ring's speed, the balance of the torques on it."""
    torques, film = (citation.source(computed, name) for name in ("drag", "film"))
    return Source(torques.equation if torques else _NONE, film.tex if film else "")


def _of_ring(value: Callable[[Computed], float]) -> Callable[[Computed], float]:
    """Return a number of the ring, NaN where there is none."""
    return lambda c: value(c) if ring.has_ring(c) else math.nan


def _of_film(place: str, field: str) -> Callable[[Computed], float]:
    """Return a number of the inner or the outer film, NaN where there is no ring."""

    def value(computed: Computed) -> float:
        film: RingFilmEquilibrium = getattr(ring.here(computed), place)
        return float(getattr(film, field))

    return _of_ring(value)


def _result(
    key: str, label: str, kind: str, value: Callable[[Computed], float], source: str = ""
) -> Result:
    """Return a result of a machine with a ring; without a source the torques give it."""
    return Result(
        key, label, kind, value, _NONE, "", lambda c: tex(value(c)),
        source=source, solved=None if source else _balance, belongs=ring.has_ring,
    )  # fmt: skip


_NONE = "no ring"
_SPEED = _of_ring(lambda c: float(ring.here(c).ring_speed))
_RATIO = _of_ring(lambda c: float(ring.here(c).speed_ratio))
RING: tuple[Result, ...] = (
    _result("ring_speed", "Ring's speed", "speed", _SPEED),
    _result("ring_ratio", "Ring's speed over Ω", "number", _RATIO),
    _result("inner_eccentricity", "Inner film's ε", "number",
            _of_film("inner", "eccentricity_ratio"), "eccentricity"),
    _result("outer_eccentricity", "Outer film's ε", "number",
            _of_film("outer", "eccentricity_ratio"), "eccentricity"),
    _result("inner_film", "Inner film's smallest h", "film",
            _of_film("inner", "minimum_film_thickness"), "thickness"),
    _result("outer_film", "Outer film's smallest h", "film",
            _of_film("outer", "minimum_film_thickness"), "thickness"),
)  # fmt: skip
