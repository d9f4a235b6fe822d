"""A result that pages show: its equation, that one's number, and the numbers put in.

Equations are filled with SI values, in which they hold as they stand; results have the units shown.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from rotorcalc.films.model import Source
from rotorcalc.onset import Onset
from rotorcalc.units import Unit, Units
from ui.computed import Computed
from ui.format import digits, minus
from ui.words import citation

# A share from which on its multiple is shown, not per cent.
_MANY = 10.0


@dataclass(frozen=True)
class Result:
    """A number that pages show.

    `equation` is LaTeX, `number` where it stands in the notes, `cites` that equation of the notes
    where `equation` follows from it, `filled` its right-hand side with
    this machine's SI values, `remark` what the equation does not say, `nought` words for zero,
    `unknown` for no number, `boundless` for an infinite one. `modelled` is false of what follows
    from the inputs without the film's model, `at_onset` true of what holds at the onset of whirl.
    `source` names the result among those of the film, where another film has another equation;
    `sought` returns an onset other than the machine's own that it follows from;
    `solved` returns what was solved where that depends on the machine; `belongs` whether a machine
    has such a result.
    """

    key: str
    label: str
    kind: str
    value: Callable[[Computed], float]
    number: str
    equation: str
    filled: Callable[[Computed], str]
    remark: str = ""
    nought: Callable[[Computed], str] | None = None
    unknown: str = "none"
    boundless: str = "no limit"
    modelled: bool = True
    cites: str = ""
    at_onset: bool = False
    source: str = ""
    sought: Callable[[Computed], Onset] | None = None
    solved: Callable[[Computed], Source] | None = None
    belongs: Callable[[Computed], bool] = lambda _: True

    def unit(self, units: Units) -> Unit:
        """Return the unit in which the result is shown."""
        return getattr(units, self.kind)

    def shown(self, computed: Computed, units: Units) -> str:
        """Return the result with its unit, or a word where it is no number."""
        value = self.value(computed)
        if not math.isfinite(value):
            return self._without_number(computed, value)
        if value == 0.0 and self.nought:
            return self.nought(computed)
        unit = self.unit(units)
        if unit.name == "%" and abs(value) >= _MANY:
            return f"{minus(digits(value))} times"
        number = minus(digits(float(unit.of(value))))
        return number + {"-": "", "°": "°"}.get(unit.name, f" {unit.name}")

    def _without_number(self, computed: Computed, value: float) -> str:
        if self.at_onset and computed.onset_is_unknown:
            return "not found"
        if self.sought and computed.ends_unanswered(self.sought(computed)):
            return "not found"
        return self.unknown if math.isnan(value) else self.boundless

    def origin(self, computed: Computed) -> Source | None:
        """Return what was solved for this machine, None where its film names no source."""
        if self.solved:
            return self.solved(computed)
        if self.source:
            return citation.source(computed, self.source)
        return Source(self.number, self.equation)

    def is_doubtful(self, computed: Computed) -> bool:
        """Return whether the model does not hold where it gives this result."""
        outside = computed.is_outside or (self.at_onset and computed.onset_is_outside)
        return self.modelled and outside

    def is_own(self, computed: Computed) -> bool:
        """Return whether it was the result's equation that was solved for this machine."""
        origin = self.origin(computed)
        return origin is not None and origin.equation == self.number

    def cited(self, computed: Computed) -> str:
        """Return where what was solved stands, or in words what it was."""
        origin = self.origin(computed)
        return citation.capital(origin.equation) if origin else "Film model"

    def change(self, computed: Computed, other: Computed, units: Units) -> str:
        """Return by how much a result differs from another machine's, in its unit, or nothing."""
        value, from_value = self.value(computed), self.value(other)
        if not (math.isfinite(value) and math.isfinite(from_value)):
            return ""
        unit = self.unit(units)
        # A temperature's zero is arbitrary, so it is no part of a difference.
        change = (value - from_value) * unit.per_si
        # What digits do not show, such as the rounding of a solved onset, is no difference.
        if change == 0.0 or abs(change) < 1e-9 * abs(value * unit.per_si):
            return "no change"
        # A difference of shares in per cent must not be read as a share of the share.
        name = {"-": "", "°": "°", "%": " % points"}.get(unit.name, f" {unit.name}")
        return f"{'+' if change > 0.0 else '−'}{digits(abs(change))}{name}"
