"""Where a ring lies as a motion begins, and the thinner of its two films in one."""

from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films.ring import balance
from rotorcalc.films.ring.pair import Pair
from rotorcalc.films.state import OperatingPoints

# How far the journal may be from the ring's centre at the start of a motion, in C, for the ring to
# begin in its equilibrium.
_NEAREST = 0.9


@dataclass(frozen=True)
class RingStarts:
    """States of a ring, its place in C and where it has a mass its velocity in CΩ.

    Attributes
    ----------
    pair : Pair
        The two films.
    """

    pair: Pair

    def rest(self, points: OperatingPoints) -> Array:
        """Return the states in static equilibrium, (..., states)."""
        ratio = balance.speed_ratio(self.pair, np.asarray(points.sommerfeld, dtype=float))
        _, place, *_ = self.pair.places_and_flows(*self.pair.sommerfeld(points.sommerfeld, ratio))
        return self._still(self.pair.wider * place)

    def beside(self, points: OperatingPoints, journal: Array) -> Array:
        """Return the states in static equilibrium, or of a ring that follows a journal far off.

        So far that it would touch the ring; then both films are left the same share of theirs.
        """
        ring = self.rest(points)[..., :2]
        apart = journal - ring
        share = self.pair.wider / (1.0 + self.pair.wider)
        near = np.hypot(apart[..., 0], apart[..., 1]) < _NEAREST
        return self._still(np.where(near[..., None], ring, share * journal))

    def _still(self, ring: Array) -> Array:
        if self.pair.ring.ring_mass == 0.0:
            return ring
        return np.concatenate([ring, np.zeros_like(ring)], axis=-1)

    def gap(self, journal: Array, states: Array) -> Array:
        """Return the thinner of the two films at places of the journal and states of the ring."""
        inner, outer = self._each(journal, states)
        return np.minimum(inner, self.pair.wider * outer)

    def share(self, journal: Array, states: Array) -> Array:
        """Return the smaller of both films' thinnest places, each over its own clearance."""
        return np.minimum(*self._each(journal, states))

    def _each(self, journal: Array, states: Array) -> tuple[Array, Array]:
        ring = states[..., :2]
        return thinnest(journal - ring), thinnest(ring / self.pair.wider)


def thinnest(place: Array) -> Array:
    """Return the thinnest film around a journal at a place, (...), both in its own C."""
    return 1.0 - np.hypot(place[..., 0], place[..., 1])
