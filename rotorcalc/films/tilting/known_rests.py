"""Rests of one machine's pads on flexures that were found: where to begin between two of them.

The load, in units of the film, changes with viscosity and speed, κ in units of the load does not.
Between two neighbouring loads at which journal and pads stand alike, no pad has changed its film,
and a rest is a step of Newton's method or two from both. Where they do not, it is found anew.
"""

from typing import NamedTuple

import numpy as np

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.tilting.settling import Settled

# Neighbours are this close in load, and stand alike where no coordinate differs by more, in C.
_CLOSE, _ALIKE = 1.3, 0.05
# How far beyond its neighbours' places a rest may be, over their distance, and in C.
_BEYOND, _MARGIN = 0.5, 1e-3
# So many rests are kept.
_MOST = 2000


class Between(NamedTuple):
    """Where to begin at loads (P,): between neighbours that stand alike, and those (P, 2 + N)."""

    near: BoolArray
    start: Array
    low: Array
    high: Array


class KnownRests:
    """Rests over the load at one κ in units of the load."""

    def __init__(self, number: int) -> None:
        """Begin without any, of a number of pads."""
        self._load, self._at = np.empty(0), np.empty((0, 2 + number))

    def between(self, load: Array) -> Between:
        """Return where to begin at loads (P,)."""
        last = len(self._load) - 1
        if last < 1:
            none = np.zeros((len(load), self._at.shape[1]))
            return Between(np.zeros(len(load), dtype=bool), none, none, none)
        i = np.clip(np.searchsorted(self._load, load), 1, last)
        below, above = self._load[i - 1], self._load[i]
        low, high = self._at[i - 1], self._at[i]
        near = (below <= load) & (load <= above) & (above <= _CLOSE * below)
        near &= np.abs(high - low).max(axis=1) < _ALIKE
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(near, np.log(load / below) / np.log(above / below), 0.0)[:, None]
        return Between(near, (1.0 - share) * low + share * high, low, high)

    def add(self, load: Array, found: Settled) -> None:
        """Keep what was found at loads (P,)."""
        at = np.concatenate([found.position, found.tilt], axis=1)
        self._load, which = np.unique(np.append(self._load, load), return_index=True)
        self._at = np.concatenate([self._at, at])[which]
        if len(self._load) > _MOST:
            self._load, self._at = self._load[::2], self._at[::2]


def lies_between(found: Settled, between: Between) -> BoolArray:
    """Return where rests (P,) are no farther from their neighbours than these from each other."""
    at = np.concatenate([found.position, found.tilt], axis=1)
    room = _BEYOND * np.abs(between.high - between.low) + _MARGIN
    low, high = np.minimum(between.low, between.high), np.maximum(between.low, between.high)
    return found.good & ((at > low - room) & (at < high + room)).all(axis=1)
