"""A study of a machine's tolerances: what is drawn, what that costs, and how many a page draws."""

import math
from dataclasses import dataclass

from rotorcalc import Machine, variation
from rotorcalc.films import film_of
from rotorcalc.onset import closed_form
from ui.jobs import work

# Seconds of a computation that a page makes at once, that it begins with, and at most on a server
# that others share.
_AT_ONCE, _AT_FIRST, _LONGEST = 0.3, 10.0, 45.0
# A machine in closed form [s]; one on a film whose table is there; one with a table of its own.
_CLOSED, _EACH, _TABLE = 6e-5, 8e-3, 0.05
# Of films that take longer, by their kind: the same two.
_SLOW = {
    "pressure-dam": (1e-2, 0.12), "multi-dam": (1e-2, 0.12), "tilting-pads": (0.15, 0.2),
    "floating-ring": (0.035, 0.06), "hydrostatic": (0.035, 0.12), "foil": (0.34, 0.34),
}  # fmt: skip
# With a supply of oil the film's temperature is solved for at each speed.
_SUPPLY = 4.0
# Machines that are drawn where a visitor does not say, and at most, of which fast ones make a file
# that a browser can open; and how many an index needs.
_USUAL, _MOST, FEWEST = 2000, 100_000, 40


@dataclass(frozen=True)
class Study:
    """What is drawn: the machine, its speed [rad/s], the spreads, how many, and the seed."""

    machine: Machine
    speed: float
    spreads: work.Spreads
    samples: int
    seed: int

    @property
    def request(self) -> tuple[Machine, float, work.Spreads, int, int]:
        """What the computation is given."""
        return self.machine, self.speed, self.spreads, self.samples, self.seed

    @property
    def seconds(self) -> float:
        """About how long it takes [s]."""
        fields = tuple(field for field, _ in self.spreads)
        return cost(self.machine, fields) * self.samples

    @property
    def at_once(self) -> bool:
        """Whether a page need not ask before it computes."""
        return self.seconds <= _AT_ONCE


def cost(machine: Machine, fields: tuple[str, ...]) -> float:
    """Return about how long a machine with other values of some inputs takes [s]."""
    each, table = _SLOW.get(machine.bearing.geometry.kind, (_EACH, _TABLE))
    if (
        closed_form.covers(machine)
        and machine.supply is None
        and "rotor.disk_damping" not in fields
    ):
        return _CLOSED
    supplied = each * (_SUPPLY if machine.supply is not None else 1.0)
    return supplied + (table if any(_has_own_table(machine, field) for field in fields) else 0.0)


def _has_own_table(machine: Machine, field: str) -> bool:
    """Return whether a machine with another value of an input has another film."""
    bearing = machine.bearing
    if field.startswith("bearing.geometry."):
        return True
    if field in ("bearing.diameter", "bearing.length"):
        return bearing.model != "short"
    if field != "bearing.radial_clearance":
        return False
    # Beside a depth or a second clearance that is given, another clearance is another bore.
    other = variation.varied(machine, {field: 0.999 * bearing.radial_clearance})
    return film_of(other.bearing).curve != film_of(bearing).curve


def most_samples(machine: Machine, fields: tuple[str, ...]) -> int:
    """Return how many machines are drawn at most, a round number."""
    return min(_round(_LONGEST / cost(machine, fields)), _MOST)


def usual_samples(machine: Machine, fields: tuple[str, ...]) -> int:
    """Return how many machines are drawn where a visitor does not say, a round number."""
    return max(min(_round(_AT_FIRST / cost(machine, fields)), _USUAL), FEWEST)


def _round(number: float) -> int:
    """Return the largest of 1, 2, 5 times a power of ten up to a number."""
    power = 10.0 ** math.floor(math.log10(number))
    return int(max(one * power for one in (1.0, 2.0, 5.0) if one * power <= number))
