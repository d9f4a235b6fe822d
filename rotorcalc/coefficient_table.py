"""A bearing that is known by its force coefficients alone: the user's own table over speed.

K_ij = −∂F_i/∂X_j and C_ij = −∂F_i/∂Ẋ_j are those of one bearing, in X along the static load and Y
at +90° in the sense of rotation, for synchronous motion, so functions of the running speed alone.
Between its rows a table is interpolated monotonically (`films.own`), beyond its ends never. Oil,
temperature and load do not enter: they are in the table already.
"""

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

from rotorcalc.geometry import Geometry
from rotorcalc.records import Grid, Kind

# The word for such a bearing in files, links and error messages.
OWN = "own-coefficients"
_FEWEST = 2


@dataclass(frozen=True, kw_only=True)
class BearingRecord(Kind):
    """What a machine may run on: a `JournalBearing`, or a `CoefficientTable`."""

    unwritten: ClassVar[str] = "journal"


@dataclass(frozen=True, kw_only=True)
class UnknownBore(Geometry):
    """The bore of a bearing that is known by its coefficients alone."""

    kind: ClassVar[str] = OWN
    models: ClassVar[tuple[str, ...]] = ("table",)

    @classmethod
    def kinds(cls) -> dict[str, type[Self]]:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Return none: it is no bore to choose from."""
        return {}

    def check_around(self, radius: float) -> None:  # noqa: ARG002 - of no radius
        """Raise ValueError: no journal bearing has it."""
        raise ValueError("geometry = UnknownBore: is that of a CoefficientTable, not of a bearing")


_UNKNOWN = UnknownBore()


@dataclass(frozen=True, kw_only=True)
class CoefficientTable(BearingRecord):
    """A bearing's own force coefficients over running speed.

    Parameters
    ----------
    speed : tuple of float, (n,)
        Running speeds, Ω [rad/s], positive and rising, at least two.
    stiffness : tuple of tuples, (n, 2, 2)
        K_ij in X, Y at these speeds [N/m].
    damping : tuple of tuples, (n, 2, 2)
        C_ij in X, Y at these speeds [N·s/m].

    Lists and arrays are taken too, and kept as tuples, so that a table can be hashed.

    Raises
    ------
    ValueError
        Naming the row, its value and its bound.

    Examples
    --------
    >>> table = CoefficientTable(
    ...     speed=[100.0, 200.0],
    ...     stiffness=[[[1e7, 2e6], [-2e6, 1e7]], [[2e7, 2e6], [-2e6, 2e7]]],
    ...     damping=[[[1e5, 0.0], [0.0, 1e5]], [[9e4, 0.0], [0.0, 9e4]]],
    ... )
    >>> table.speed
    (100.0, 200.0)
    """

    kind: ClassVar[str] = OWN

    speed: Annotated[tuple[float, ...], Grid("rad/s")]
    stiffness: Annotated[tuple[tuple[tuple[float, ...], ...], ...], Grid("N/m", (2, 2))]
    damping: Annotated[tuple[tuple[tuple[float, ...], ...], ...], Grid("N·s/m", (2, 2))]

    def __post_init__(self) -> None:
        super().__post_init__()
        rows = len(self.speed)
        if rows < _FEWEST:
            raise ValueError(
                f"speed: has {rows} row{'' if rows == 1 else 's'}; a table of coefficients needs "
                f"at least {_FEWEST}, as it is interpolated between its rows"
            )
        for name in ("stiffness", "damping"):
            if len(getattr(self, name)) != rows:
                raise ValueError(
                    f"{name}: has {len(getattr(self, name))} rows, must have {rows}, one for each "
                    "speed"
                )
        self._check_speeds()

    def _check_speeds(self) -> None:
        before = 0.0
        for row, speed in enumerate(self.speed):
            if speed <= before:
                bound = f"greater than the one before it, {before:.9g} rad/s" if row else "positive"
                raise ValueError(f"speed[{row}] = {speed:.9g} rad/s: must be {bound}")
            before = speed

    @property
    def first(self) -> float:
        """Lowest speed of the table [rad/s]."""
        return self.speed[0]

    @property
    def last(self) -> float:
        """Highest speed of the table [rad/s]."""
        return self.speed[-1]

    # What such a bearing looks like is not known: its bore, its size, its film.

    @property
    def geometry(self) -> Geometry:
        """The bore, of which nothing is known."""
        return _UNKNOWN

    @property
    def film(self) -> None:
        """Name of a film model other than the default: there is none."""
        return

    @property
    def model(self) -> str:
        """Name of what stands for the film model."""
        return _UNKNOWN.models[0]

    @property
    def diameter(self) -> float:
        """NaN: not known."""
        return math.nan

    @property
    def radius(self) -> float:
        """NaN: not known."""
        return math.nan

    @property
    def length(self) -> float:
        """NaN: not known."""
        return math.nan

    @property
    def radial_clearance(self) -> float:
        """NaN: not known."""
        return math.nan

    @property
    def assembled_clearance(self) -> float:
        """NaN: not known."""
        return math.nan
