"""Which limit cycles a visitor asks for, those that are known, and what is said of them."""

from dataclasses import dataclass, replace

import numpy as np

from rotorcalc import Bifurcation, Machine, ModeOnset
from rotorcalc.figures import Units
from rotorcalc.nonlinear.continuation import AT_REST
from ui import ring
from ui.choices import choices, choose
from ui.computed import Computed
from ui.format import amount, digits
from ui.jobs import cache, work

# A ring's machine runs at many times its onset: how far its cycles are followed, over the onset.
_REACHES = (1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0)
_BEYOND = 1.1
_WHIRL = "orbits_whirl"
_BOTH = (
    "a second whirl of another frequency grows; the machine ends with both at once or on the "
    "other whirl's cycle. A release shows which."
)

followed = cache.Cached(work.cycles, entries=16, megabytes=16)


@dataclass(frozen=True)
class Branch:
    """Which limit cycles are asked for: from which onset of which machine, and up to where."""

    machine: Machine
    onset: ModeOnset | None
    highest: float

    @property
    def asked(self) -> tuple[Machine, ModeOnset | None, float]:
        """What they are kept by."""
        return self.machine, self.onset, self.highest


def branch_of(computed: Computed) -> Branch:
    """Return the branch that is asked for: on a ring that of the whirl chosen, up past Ω.

    One that is known farther than needed serves as well.
    """
    return _branches(computed)[0]


def _branches(computed: Computed) -> list[Branch]:
    """Return the branches of all whirls of a machine, that of the one chosen first."""
    found = ring.onsets(computed) if ring.has_ring(computed) else ()
    if not found:
        return [Branch(balanced(computed.machine), None, _REACHES[0])]
    chosen = str(choices().chosen.get(_WHIRL, ""))
    return [
        _branch_from(onset, computed) for onset in sorted(found, key=lambda one: one.mode != chosen)
    ]


def _branch_from(onset: ModeOnset, computed: Computed) -> Branch:
    machine = balanced(computed.machine)
    needed = _BEYOND * computed.speed / onset.speed
    reaches = [one for one in _REACHES if one >= needed] or [_REACHES[-1]]
    enough = [Branch(machine, onset, reach) for reach in reaches]
    found_already = (one for one in reversed(enough) if followed.known(*one.asked) is not None)
    return next(found_already, enough[0])


def choose_whirl(computed: Computed) -> None:
    """Show a choice of the whirl whose cycles are followed, where a ring has two."""
    found = ring.onsets(computed) if ring.has_ring(computed) else ()
    if len(found) > 1:
        choose("Whirl in the", [one.mode for one in found], _WHIRL)


def known(computed: Computed) -> Bifurcation | None:
    """Return the limit cycles where they have been computed."""
    return followed.known(*branch_of(computed).asked)


def known_of_all(computed: Computed) -> list[Bifurcation]:
    """Return the limit cycles of all whirls that have been computed, of the one chosen first."""
    found = (followed.known(*one.asked) for one in _branches(computed))
    return [one for one in found if one is not None]


def held(branch: Bifurcation, speed: float, units: Units) -> tuple[str, ...]:
    """Return in sentences the stable cycle at a speed, and the speeds without one."""
    at, cycle = amount(units.speed, speed), branch.held_at(speed)
    low, high = float(branch.speed.min()), float(branch.speed.max())
    if cycle is not None:
        first = (
            f"At {at} the limit cycle takes the journal up to "
            f"{amount(units.film, cycle.amplitude)} and the ring up to "
            f"{amount(units.film, cycle.inner_amplitude)} from rest, at "
            f"{amount(units.speed, cycle.whirl_frequency)}, "
            f"{digits(cycle.whirl_frequency / speed)} of the running speed; the thinnest film is "
            f"{digits(cycle.thinnest)} of its clearance."
        )
    elif speed > high and _leads_on(branch):
        first = f"The cycles were followed up to {amount(units.speed, high)} only."
    elif not low <= speed <= high:
        first = f"At {at} this branch has no cycle."
    elif branch.beats[np.argmin(np.abs(branch.speed - speed))]:
        return (f"At {at} no cycle is stable: {_BOTH}",)
    else:
        first = f"At {at} no cycle of this branch is stable."
    if (branch.beats & ~branch.stable).any():
        return first, f"On parts of the dashed line {_BOTH}"
    return (first,)


def _leads_on(branch: Bifurcation) -> bool:
    """Return whether its last cycle is the fastest, and none beyond it was looked for."""
    return bool(branch.speed[-1] == branch.speed.max()) and branch.ended != AT_REST


def balanced(machine: Machine) -> Machine:
    return replace(machine, rotor=replace(machine.rotor, imbalance=0.0))
