"""A result that pages show: its equation, that one's number, and the numbers put in.

Equations are filled with SI values, in which they hold as they stand; results have the units shown.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from rotorcalc.films import film_of
from rotorcalc.units import Unit, Units
from ui.computed import Computed
from ui.format import digits


@dataclass(frozen=True)
class Result:
    """A number that pages show.

    `equation` is LaTeX, `number` where it stands in the notes, `filled` its right-hand side with
    this machine's SI values, `remark` what the equation does not say, `nought` a word for zero,
    `unknown` one for no number. `source` names the result among those of the film, where another
    film has another equation.
    """

    key: str
    label: str
    kind: str
    value: Callable[[Computed], float]
    number: str
    equation: str
    filled: Callable[[Computed], str]
    remark: str = ""
    nought: str = ""
    unknown: str = "none"
    source: str = ""

    def unit(self, units: Units) -> Unit:
        """Return the unit in which the result is shown."""
        return getattr(units, self.kind)

    def shown(self, computed: Computed, units: Units) -> str:
        """Return the result with its unit, or a word where it is NaN."""
        value = self.value(computed)
        if math.isnan(value):
            return self.unknown
        if math.isinf(value):
            return "no limit"
        if value == 0.0 and self.nought:
            return self.nought
        unit = self.unit(units)
        number = digits(float(unit.of(value)))
        return number + {"-": "", "°": "°"}.get(unit.name, f" {unit.name}")

    def is_of(self, computed: Computed) -> bool:
        """Return whether the equation is the one by which the machine's film answers."""
        known = film_of(computed.machine.bearing).sources.get(self.source)
        return not self.source or (known is not None and known.equation == self.number)

    def change(self, computed: Computed, baseline: Computed) -> str | None:
        """Return the change from the baseline's result, or nothing where that is NaN."""
        live, pinned = self.value(computed), self.value(baseline)
        if not (math.isfinite(live) and math.isfinite(pinned)) or pinned == 0.0:
            return None
        change = (live / pinned - 1.0) * 100.0
        return f"{'+' if change >= 0.0 else '−'}{digits(abs(change))} % vs A"
