"""What a table of a bearing's own coefficients gives in place of a film.

K and C of the running speed, each entry interpolated by a piecewise cubic that is monotonic
wherever the rows are (PCHIP), and so never swings beyond them. With dimensions: N/m and N·s/m.
Nothing else of the film is known, neither the journal's place nor a force in motion.

Source: F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984), 300-304.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator

from rotorcalc.arrays import Array
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.films.dynamics import NO_INERTIA, FilmDynamics
from rotorcalc.films.model import FilmMotion, Limit, Source
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints

_SOURCE = Source(
    "own coefficients, interpolated over speed", remark="the user's own, between rows by PCHIP"
)


@dataclass(frozen=True)
class OwnFilm:
    """The film that a table of coefficients stands for; see `films.model.Film`."""

    bearing: CoefficientTable
    inner: int = field(default=0, init=False)
    frequency_dependent: bool = field(default=False, init=False)
    can_whirl: bool = field(default=True, init=False)
    curve: None = field(default=None, init=False)
    sommerfeld_range: tuple[float, float] = field(default=(np.nan, np.nan), init=False)
    least_sommerfeld: float = field(default=0.0, init=False)
    limits: tuple[Limit, ...] = field(default=(), init=False)

    @property
    def sources(self) -> Mapping[str, Source]:
        """Of what it knows: K and C."""
        return dict.fromkeys(("film", "stiffness", "damping"), _SOURCE)

    @cached_property
    def _rows(self) -> Array:
        """K and C of the rows, (n, 2, 2, 2)."""
        return np.stack([self.bearing.stiffness, self.bearing.damping], axis=1)

    @cached_property
    def _between(self) -> PchipInterpolator:
        return PchipInterpolator(self.bearing.speed, self._rows, axis=0)

    def dynamics(self, points: OperatingPoints) -> FilmDynamics:
        """Return K [N/m] and C [N·s/m] at the points' speeds; ValueError beyond the ends."""
        found = self._at(np.broadcast_to(points.speed, points.sommerfeld.shape))
        return FilmDynamics(found[..., 0, :, :], found[..., 1, :, :], NO_INERTIA)

    def state(self, points: OperatingPoints) -> FilmState:
        """Return the same, and NaN for what a table does not know."""
        known = self.dynamics(points)
        unknown = np.full(points.sommerfeld.shape, np.nan)
        return FilmState(
            sommerfeld=unknown,
            position=np.full((*unknown.shape, 2), np.nan),
            attitude_angle=unknown,
            minimum_thickness=unknown,
            stiffness=known.stiffness,
            damping=known.damping,
            side_flow=unknown,
            drag=unknown,
            peak_pressure=unknown,
            peak_angle=unknown,
        )

    def drag_and_flow(self, points: OperatingPoints) -> tuple[Array, Array]:
        """Return NaN: neither is known."""
        unknown = np.full(points.sommerfeld.shape, np.nan)
        return unknown, unknown

    def field(self, points: OperatingPoints, *, angle: ArrayLike, zeta: ArrayLike) -> FilmField:  # noqa: ARG002 - the seam's
        """Raise ValueError: there is neither a thickness nor a pressure."""
        self._refuse("no film, so neither its thickness nor its pressure")

    def added_mass(self, points: OperatingPoints) -> Array:  # noqa: ARG002 - the seam's
        """Raise ValueError: the film's inertia is not known."""
        self._refuse("no inertia of the film")

    def motion(self) -> FilmMotion:
        """Raise ValueError: coefficients hold for small motions, and are no force."""
        self._refuse("no force of a film on a moving journal, but coefficients for small motions")

    def accuracy(self, sommerfeld: float) -> None:  # noqa: ARG002 - the seam's
        """Return None: nothing is computed."""
        return

    def gap(self, position: ArrayLike) -> Array:
        """Return NaN: the clearance is not known."""
        return np.full(np.shape(position)[:-1], np.nan)

    def outline(self, angle: ArrayLike) -> Array:
        """Return NaN: the bore is not known."""
        return np.full((*np.shape(angle), 2), np.nan)

    def _at(self, speed: Array) -> Array:
        """Return K and C at speeds (...), (..., 2, 2, 2)."""
        first, last = self.bearing.first, self.bearing.last
        beyond = ~((speed >= first) & (speed <= last))
        if np.any(beyond):
            raise ValueError(
                f"speed = {speed[beyond].flat[0]:.9g} rad/s: beyond the bearing's own "
                f"coefficients, which are given from {first:.9g} to {last:.9g} rad/s and hold "
                "nowhere else; ask between these, or give rows for more speeds"
            )
        found = self._between(speed)
        # At a row exactly what the row says: the cubic's rounding is left out.
        place = np.searchsorted(self.bearing.speed, speed)
        is_row = np.asarray(self.bearing.speed)[place] == speed
        return np.where(is_row[..., None, None, None], self._rows[place], found)

    def _refuse(self, words: str) -> NoReturn:
        raise ValueError(
            f"bearing = {self.bearing.geometry.kind}: a table of coefficients has {words}"
        )
