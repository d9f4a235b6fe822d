"""An input of a slider: its name, unit and range, and a visitor's value of it."""

import math
from dataclasses import dataclass

from rotorcalc.units import SI, Unit, Units
from ui.format import quoted, short, typed_number

# Smallest positive value: quotients by a smaller one would overflow.
_LEAST = 1e-290


@dataclass(frozen=True)
class Input:
    """An input that a visitor sets.

    `field` is its place in the core's records; `kind` names its unit in `Units`; `low` to `high` is
    what is admitted, in SI as engineers write it. Its scale is logarithmic, from `least` where
    `low` is zero, or linear where it has a `step`: a temperature, whose zero is arbitrary, or an
    angle; a linear slider shows `span` of its range. `infinite` is the word for one value beyond
    `high`, `follows` says from what the value follows where none is given.
    """

    key: str
    field: str
    label: str
    symbol: str
    kind: str
    low: float
    high: float
    group: str
    help: str
    least: float = 0.0
    step: float = 0.0
    infinite: str = ""
    # A pixel of a temperature is then a fifth of a degree.
    span: float = 60.0
    follows: str = ""

    def unit(self, units: Units) -> Unit:
        """Return the unit in which a visitor sees this input."""
        return getattr(units, self.kind)

    def shown(self, value: float, units: Units) -> float:
        """Return a kept value in a visitor's unit."""
        # Kept as it is: a change of unit and back would change its last digit.
        if units.name == SI.name:
            return float(value)
        return float(self.unit(units).of(self.unit(SI).to_si(value)))

    def stored(self, reading: float, units: Units) -> float:
        """Return a visitor's reading as it is kept."""
        # As above.
        if units.name == SI.name:
            return reading
        return tidy(float(self.unit(SI).of(self.unit(units).to_si(reading))))

    def name(self, units: Units) -> str:
        """Return label, symbol and unit, as beside a slider."""
        unit = self.unit(units).name
        return self.words + ("" if unit == "-" else f" [{unit}]")

    @property
    def words(self) -> str:
        """Label and symbol, where it has one."""
        return f"{self.label} {self.symbol}".rstrip()

    def taken(self, sent: object, units: Units) -> float:
        """Return the value to keep of a slider's message, which is in a visitor's unit.

        Raises ValueError where it is not a number or lies outside the range.
        """
        try:
            reading = math.inf if self.infinite and sent == self.infinite else typed_number(sent)
        except ValueError as error:
            raise ValueError(f"{self.label}: {quoted(sent)} {error}") from None
        value = self.stored(reading, units)
        if problem := self.problem(value, units):
            raise ValueError(f"{self.name(units)} = {short(reading)} {problem}")
        return value

    def problem(self, value: float | None, units: Units = SI) -> str:
        """Return the fault of a kept value as a text, empty where there is none."""
        if value is None:
            return "" if self.follows else "is missing"
        if self.infinite and value == math.inf:
            return ""
        # Zero itself is a value of its own, no damping for instance.
        if 0.0 < abs(value) < _LEAST:
            return f"lies between 0 and {_LEAST:g}, where floating-point numbers lose precision"
        if self.low <= value <= self.high:
            return ""
        low, high = (short(self.shown(end, units)) for end in (self.low, self.high))
        unit = self.unit(units).name
        return f"lies outside {low} to {high}" + ("" if unit == "-" else f" {unit}")

    def text(self, value: float, units: Units) -> str:
        """Return a kept value as a field shows it, in a visitor's unit."""
        return self.infinite if math.isinf(value) else short(self.shown(value, units))


def tidy(value: float) -> float:
    """Return a value without the rounding that a change of unit leaves in its last digits."""
    return float(f"{value:.14g}")
