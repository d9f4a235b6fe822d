"""What a machine's floating ring does, kept for the texts and charts that share it."""

import math
from functools import lru_cache

from rotorcalc import (
    FloatingRing,
    Machine,
    ModeOnset,
    RingEquilibrium,
    mode_onsets,
    ring_equilibrium,
    ring_whirl,
)
from rotorcalc.figures.ring import TwoWhirls
from ui.computed import Computed


def has_ring(computed: Computed) -> bool:
    """Return whether a machine's bearing has a floating ring."""
    return isinstance(computed.machine.bearing.geometry, FloatingRing)


@lru_cache(maxsize=16)
def here(computed: Computed) -> RingEquilibrium:
    """Return ring and films at the running speed, or raise ValueError where there is no ring."""
    return ring_equilibrium(computed.machine, computed.speed)


@lru_cache(maxsize=16)
def over_speed(computed: Computed) -> RingEquilibrium:
    """Return ring and films over the sweep, or raise ValueError where there is no ring."""
    return ring_equilibrium(computed.machine, computed.sweep.speed)


@lru_cache(maxsize=16)
def whirls(computed: Computed) -> TwoWhirls:
    """Return the whirls in the two films, or raise ValueError where there is no ring."""
    machine = computed.machine
    return TwoWhirls(
        over=ring_whirl(machine, computed.sweep.speed),
        here=ring_whirl(machine, computed.speed),
        onsets=_onsets(machine),
    )


def onsets(computed: Computed) -> tuple[ModeOnset, ...]:
    """Return the onsets of the whirls that set in at some speed, the lowest first."""
    found = (one for one in _onsets(computed.machine) if 0.0 < one.speed < math.inf)
    return tuple(sorted(found, key=lambda one: one.speed))


# A slider of the running speed leaves them as they are.
@lru_cache(maxsize=64)
def _onsets(machine: Machine) -> tuple[ModeOnset, ModeOnset]:
    return mode_onsets(machine)
