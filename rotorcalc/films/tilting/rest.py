"""The journal at rest on pads that tilt freely: one position for each load, from a pad's family.

A pad pushes the journal back along its pivot's direction with a force f(ξ) that rises with ξ, and
the pads stand symmetrically about the load: so the journal moves along it, y = 0, and

    Σ f(m + x cos β) cos β = F_o

has one root x. Number, preload and place of the pads enter here alone, not in the family. A pad
with its pivot behind its middle gives up its film with a force left; a load between the forces with
and without it is carried without it.
"""

import functools
import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.films.tilting.family import PadFamily, PadStates, family
from rotorcalc.films.tilting.pivots import Pivots

# Positions of the first table; Newton's steps, safe between two positions; where they end: at a
# step whose square is below rounding, or, where a force jumps, between two positions so close.
_PLACES, _MOST_STEPS, _CLOSE, _ROUNDING, _STEP = 240, 80, 1e-8, 1e-16, 1e-14
# Force beside the load, relative, at which a pad has given up its film there; a load that counts
# as light.
_ASTRAY, _AT_ITS_END, _LIGHT = 1e-9, 1e-9, 1e-3
# Without load pads are as at this position: without preload their films begin there.
_CENTRE = 1e-12
# Share of the way to where the last pad beside the load line gives up its film.
_NEARLY = 0.999


@dataclass(frozen=True, eq=False)
class Rest:
    """A bearing's journal and pads at rest, leading shape (...).

    Attributes
    ----------
    position : array, (..., 2)
        The journal's centre, in C.
    tilt : array, (..., N)
        δ of each pad, in C.
    pads : PadStates
        The films of the pads, (..., N), in units of the film.
    """

    position: Array
    tilt: Array
    pads: PadStates


class Resting(Protocol):
    """What finds the journal and the pads of one bearing at rest."""

    @property
    def heaviest(self) -> float:
        """The heaviest load, in units of the film."""
        ...

    @property
    def lightest_sommerfeld(self) -> float:
        """σ above which the film hardly changes."""
        ...

    def at(self, load: Array, stiffness: Array) -> Rest:
        """Return journal and pads at loads and pivots' stiffnesses (...), in units of the film."""
        ...


@dataclass(frozen=True, eq=False)
class FreePads:
    """Pads without a stiffness of their pivots."""

    pivots: Pivots
    family: PadFamily

    @classmethod
    def of(cls, pivots: Pivots, slenderness: float, *, coarse: bool) -> "FreePads":
        """Return the pads of a bearing of (D/L)², made once."""
        return _free_pads(pivots, slenderness, coarse)

    @functools.cached_property
    def _table(self) -> tuple[Array, Array, Array]:
        """Positions x along the load, rising, the loads that they carry, and dx/dF."""
        towards = self.pivots.frames[:, 0, 0].max()
        last = min((self.family.last - self.pivots.preload) / towards, self._held_across)
        room = (1.0 - self.pivots.preload) / towards
        share = np.linspace(0.0, 1.0, _PLACES)
        # Dense towards the pad, where each step thins the film by one factor.
        x = room * (1.0 - (1.0 - last / room) ** share)
        loads, slope = self._carried(x, True)
        with np.errstate(divide="ignore"):
            return x, loads, 1.0 / slope

    @property
    def _held_across(self) -> float:
        """The position up to which a pad beside the load line has a film."""
        n = self.pivots.frames[:, 0]
        cos = n[n[:, 1] != 0.0, 0].max()
        spare = self.pivots.preload - self.family.first
        if cos > 0.0:
            return math.inf
        if spare <= 0.0:
            raise ValueError(
                f"preload = {self.pivots.preload:g}: only the pad under the load has a film, and "
                "nothing holds the journal across it; raise the preload, or let the load point "
                "between pads"
            )
        return math.inf if cos == 0.0 else _NEARLY * spare / -cos

    @property
    def heaviest(self) -> float:
        """The heaviest load, in units of the film."""
        return float(self._table[1][-1])

    @property
    def lightest_sommerfeld(self) -> float:
        """σ of the load at the table's first step."""
        return 0.25 / float(self._table[1][1])

    @functools.cached_property
    def unloaded(self) -> Rest:
        """Journal and pads without load, P = 1."""
        return self.at(np.zeros(1), np.zeros(1))

    def at(self, load: Array, stiffness: Array) -> Rest:  # noqa: ARG002 - free pads have none
        """Return journal and pads at loads (...), in units of the film."""
        flat = load.reshape(-1)
        carries = np.ones((flat.size, self.pivots.number), dtype=bool)
        x, lost = self._positions(flat, carries)
        while lost.any():
            carries[lost] &= ~self._at_its_end(x[lost])
            x[lost], still = self._positions(flat[lost], carries[lost])
            lost[lost] = still
        xi = self._xi(np.maximum(x, _CENTRE))
        pads = self.family.at(xi, carries=carries)
        tilt = pads.eta - x[:, None] * self.pivots.frames[:, 1, 0]
        position = np.stack([x, np.zeros_like(x)], axis=-1)
        shaped = {
            name: values.reshape(*load.shape, *values.shape[1:])
            for name, values in vars(pads).items()
        }
        return Rest(
            position=position.reshape(*load.shape, 2),
            tilt=tilt.reshape(*load.shape, -1),
            pads=PadStates(**shaped),
        )

    def _xi(self, x: Array) -> Array:
        return self.pivots.preload + x[:, None] * self.pivots.frames[:, 0, 0]

    def _carried(self, x: Array, carries: BoolArray | bool) -> tuple[Array, Array]:
        """Return the load that pads carry at positions (P,), and its derivative."""
        cos = self.pivots.frames[:, 0, 0]
        f, slope = self.family.force(self._xi(x))
        return (f * carries) @ cos, (slope * carries) @ cos**2

    def _near(self, load: Array, *, all_carry: bool) -> tuple[Array, Array, Array]:
        """Return positions below, near and above those at loads (P,)."""
        places, loads, slope = self._table
        x = np.interp(load, loads, places)
        if not all_carry:
            return np.zeros_like(load), x, np.full_like(load, places[-1])
        i = np.clip(np.searchsorted(loads, load), 1, len(loads) - 1)
        low, high, step = places[i - 1], places[i], loads[i] - loads[i - 1]
        # Hermite's polynomial between the two, where no pad gives up its film.
        with np.errstate(divide="ignore", invalid="ignore"):
            t, chord = (load - loads[i - 1]) / step, high - low
            before, after = step * slope[i - 1] - chord, step * slope[i] - chord
            bent = t * (1.0 - t) * ((1.0 - t) * before - t * after)
            smooth = low + t * chord + bent
        return low, np.where((smooth >= low) & (smooth <= high), smooth, x), high

    def _positions(self, load: Array, carries: BoolArray) -> tuple[Array, BoolArray]:
        """Return positions at loads (P,), and where none carries the load exactly."""
        low, x, high = self._near(load, all_carry=bool(carries.all()))
        near = np.zeros(load.shape, dtype=bool)
        for _ in range(_MOST_STEPS):
            found, slope = self._carried(x, carries)
            over = found > load
            low, high = np.where(over, low, x), np.where(over, x, high)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = -(found - load) / slope
            # Where a pad's film begins its force rises so steeply that any step is small.
            near = np.abs(found - load) <= _CLOSE * (load + _LIGHT)
            arrived = near & (np.abs(step) <= _CLOSE * np.abs(x) + _ROUNDING)
            inside = (x + step > low) & (x + step < high)
            # A step from so close leaves its square; where rounding turns it back, x stands.
            after = np.where(inside, x + step, np.where(arrived, x, 0.5 * (low + high)))
            arrived |= (found == load) | (np.abs(after - x) <= _STEP * np.abs(x))
            x = np.where(found == load, x, after)
            if arrived.all():
                break
        # A film that ends with a force left carries more than the load on one side of a place, and
        # less on the other: Newton's method does not arrive there.
        lost = ~near
        if lost.any():
            found, _ = self._carried(x, carries)
            lost = np.abs(found - load) > _ASTRAY * (load + _LIGHT)
        return x, lost

    def _at_its_end(self, x: Array) -> BoolArray:
        return np.abs(self._xi(x) - self.family.first) < _AT_ITS_END


@functools.lru_cache(maxsize=256)
def _free_pads(pivots: Pivots, slenderness: float, coarse: bool) -> FreePads:
    return FreePads(pivots, family(pivots.arc, pivots.offset, slenderness, coarse=coarse))
