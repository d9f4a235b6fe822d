"""The spreads of a study: which inputs vary and how, as a visitor types it and a link has it.

A number is kept in the unit of the address bar, whatever units are shown; what is none is kept as
it was typed, so that nothing typed is lost. In a link a spread is the input's key, the word of its
distribution and its numbers, with ~ between and ~~ between spreads.
"""

import itertools
import math
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

from rotorcalc import Machine, rpm, variation
from rotorcalc.units import SI, Unit, Units
from ui.format import amount, lower, minus, quoted, short, typed_number
from ui.input_record import tidy
from ui.inputs import INPUTS, as_shown, inputs_of, usual, values_of
from ui.jobs.work import Spreads
from ui.words.design import bore_field, fields_of, name

# What a spread's numbers are: values of the input, a difference of two, or a ratio of two.
Kind = Literal["value", "difference", "ratio"]
# Low end, middle and high end of a spread, within which nearly all values lie.
Reach = tuple[float, float, float]

MOST = 6
_LONGEST = 40
_BETWEEN, _PARTS = "~~", "~"
# Where an input at zero or infinity depends on a running speed [rad/s], which an onset does not.
_SPEED = 6000 * rpm
# By itself a clearance spreads by such a share, a temperature by so many kelvins, others by less.
_CLEARANCE, _DEGREES, _OTHERS = 0.15, 4.0, 0.10
# What has a zero in the middle of its slider, as an angle, by such a share of that.
_OF_ITS_RANGE = 0.05
_WARM = ("T", "T_in", "TR", "TR_gas")


class Distribution(NamedTuple):
    """A distribution on offer: its words, the core's word, its numbers, and its usual ones."""

    words: str
    core: str
    numbers: tuple[tuple[str, Kind], ...]
    of: Callable[[float, float, float], tuple[float, ...]]
    reach: Callable[..., Reach]


DISTRIBUTIONS: dict[str, Distribution] = {
    "uniform": Distribution(
        "Uniform", "uniform", (("Low", "value"), ("High", "value")),
        lambda low, _, high: (low, high), lambda low, high: (low, (low + high) / 2.0, high),
    ),
    "normal": Distribution(
        "Normal", "normal", (("Mean", "value"), ("Std. dev.", "difference")),
        lambda low, _, high: ((low + high) / 2.0, (high - low) / 4.0),
        lambda mean, sd: (mean - 2.0 * sd, mean, mean + 2.0 * sd),
    ),
    "cut": Distribution(
        "Normal, cut off", "normal",
        (("Mean", "value"), ("Std. dev.", "difference"), ("Low", "value"), ("High", "value")),
        lambda low, _, high: ((low + high) / 2.0, (high - low) / 4.0, low, high),
        lambda mean, _, low, high: (low, mean, high),
    ),
    "triangular": Distribution(
        "Triangular", "triangular",
        (("Low", "value"), ("Most likely", "value"), ("High", "value")),
        lambda low, middle, high: (low, middle, high), lambda *ends: ends,
    ),
    "lognormal": Distribution(
        "Lognormal", "lognormal", (("Median", "value"), ("Ratio", "ratio")),
        lambda _, middle, high: (middle, math.sqrt(high / middle) if middle > 0.0 else math.nan),
        lambda median, ratio: (median / ratio**2, median, median * ratio**2),
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Spread:
    """The spread of an input: its key, the word of its distribution, its numbers as kept."""

    key: str
    word: str
    texts: tuple[str, ...]

    @property
    def distribution(self) -> Distribution:
        """The distribution."""
        return DISTRIBUTIONS[self.word]

    def with_text(self, place: int, text: str) -> "Spread":
        """Return the spread with another number."""
        return replace(self, texts=(*self.texts[:place], text, *self.texts[place + 1 :]))


# --- In a link ---------------------------------------------------------------------------------


def written(spreads: tuple[Spread, ...]) -> str:
    """Return spreads as a link has them."""
    return _BETWEEN.join(_PARTS.join((one.key, one.word, *one.texts)) for one in spreads)


def read(text: str, machine: Machine) -> tuple[tuple[Spread, ...], list[str]]:
    """Return the spreads of a link that a machine can have, and what is wrong with the others."""
    known = fields_of(machine)
    found: list[Spread] = []
    problems: list[str] = []
    for part in text.split(_BETWEEN)[:MOST]:
        key, word, *texts = [*part.split(_PARTS), ""]
        one = Spread(key, word, tuple(word[:_LONGEST] for word in texts[:-1]))
        if key not in known:
            problems.append(f"The spread of {quoted(key)} is left out: this machine has no such "
                            "input, or its values are whole numbers.")  # fmt: skip
        elif word not in DISTRIBUTIONS or len(one.texts) != len(one.distribution.numbers):
            problems.append(f"The spread of {name(machine, key)} is left out: {quoted(part)} has "
                            "no distribution of this page, or not its numbers.")  # fmt: skip
        elif any(key == other.key for other in found):
            problems.append(f"{name(machine, key)} has two spreads; the first is used.")
        else:
            found.append(one)
    return tuple(found), problems


def usual_spreads(machine: Machine) -> tuple[Spread, ...]:
    """Return what a page shows by itself: the clearance and the temperature of a machine spread.

    With coefficients of its own neither moves the onset, and its rotor spreads.
    """
    known = fields_of(machine)
    usual = [key for key in ("C", "T", "T_in") if key in known]
    return tuple(usual_spread(machine, key) for key in usual or ("mass", "k"))


def usual_spread(machine: Machine, key: str, word: str = "uniform") -> Spread:
    """Return a spread about a machine's value of an input."""
    return _about(key, word, *_reach(machine, key))


def with_word(machine: Machine, spread: Spread, word: str) -> Spread:
    """Return about the same spread with another distribution."""
    try:
        reach = spread.distribution.reach(*map(float, spread.texts))
    except (ValueError, ZeroDivisionError, OverflowError):
        return usual_spread(machine, spread.key, word)
    return _about(spread.key, word, *reach)


def _about(key: str, word: str, low: float, middle: float, high: float) -> Spread:
    numbers = DISTRIBUTIONS[word].of(low, middle, high)
    return Spread(key, word, tuple(f"{number:.5g}" for number in numbers))


def _reach(machine: Machine, key: str) -> Reach:
    """Return low end, middle and high end, as kept, of what is usual about a machine's value."""
    now = float(unit_of(machine, key, SI).of(variation.value_of(machine, fields_of(machine)[key])))
    values = values_of(machine, _SPEED, _SPEED)
    item = inputs_of(values).get(key)
    if item is None:
        return now, now, now
    if now == 0.0 and not item.step:
        most = usual(key, values)
        return 0.0, 0.5 * most, most
    now = now if math.isfinite(now) else usual(key, values)
    by = abs(now) * (_CLEARANCE if key == "C" else _OTHERS)
    if key in _WARM:
        by = _DEGREES
    elif now == 0.0:
        by = _OF_ITS_RANGE * (item.high - item.low)
    low, high = min(item.low, now), max(item.high, now)
    return max(now - by, low), now, min(now + by, high)


# --- In a visitor's units ----------------------------------------------------------------------


def unit_of(machine: Machine, key: str, units: Units) -> Unit:
    """Return the unit in which a visitor sees an input."""
    return INPUTS[key].unit(units) if key in INPUTS else bore_field(machine, key).unit(units)


def label(machine: Machine, spread: Spread, place: int, units: Units) -> str:
    """Return the name of a spread's number, with its unit."""
    words, kind = spread.distribution.numbers[place]
    unit = _unit(machine, spread.key, kind, units).name
    return words + ("" if unit == "-" else f" [{unit}]")


def shown(machine: Machine, spread: Spread, place: int, units: Units) -> str:
    """Return a spread's number as a field shows it; what is none as it was typed."""
    text = spread.texts[place]
    if units.name == SI.name:
        return text
    try:
        value = typed_number(text)
    except ValueError:
        return text
    kind = spread.distribution.numbers[place][1]
    kept, seen = (_unit(machine, spread.key, kind, one) for one in (SI, units))
    return short(float(seen.of(kept.to_si(value))))


def kept(machine: Machine, spread: Spread, place: int, typed: str, units: Units) -> Spread:
    """Return the spread with a number as a visitor typed it."""
    text = typed.strip().replace(_PARTS, "")[:_LONGEST]
    if units.name != SI.name:
        try:
            value = typed_number(text)
        except ValueError:
            return spread.with_text(place, text)
        kind = spread.distribution.numbers[place][1]
        into, seen = (_unit(machine, spread.key, kind, one) for one in (SI, units))
        text = f"{tidy(float(into.of(seen.to_si(value)))):.14g}"
    return spread.with_text(place, text)


def _unit(machine: Machine, key: str, kind: Kind, units: Units) -> Unit:
    """Return the unit of a spread's number: a difference of temperatures has no zero of its own."""
    if kind == "ratio":
        return units.number
    unit = unit_of(machine, key, units)
    if kind == "value" or (unit.offset == 0.0 and key not in _WARM):
        return unit
    return units.rise


# --- For the core ------------------------------------------------------------------------------


def given(machine: Machine, spreads: tuple[Spread, ...], units: Units) -> Spreads:
    """Return inputs and distributions as the core takes them.

    Raises ValueError naming the value and its bound where a number is none, an end lies on the
    wrong side of another, or an end of a spread is no valid machine.
    """
    if not spreads:
        raise ValueError("no input spreads: add one")
    return tuple((fields_of(machine)[one.key], _core(machine, one, units)) for one in spreads)


def problem(machine: Machine, spread: Spread, units: Units) -> str:
    """Return why the core cannot take a spread, or nothing."""
    try:
        _core(machine, spread, units)
    except ValueError as error:
        return f"{error}"
    return ""


def _core(machine: Machine, spread: Spread, units: Units) -> tuple[str | float, ...]:
    numbers: list[float] = []
    for place, (words, kind) in enumerate(spread.distribution.numbers):
        where = f"{name(machine, spread.key)}: {lower(words)}"
        try:
            value = typed_number(spread.texts[place])
        except ValueError as error:
            raise ValueError(f"{where} = {quoted(spread.texts[place])} {error}") from None
        if not math.isfinite(value):
            raise ValueError(f"{where} = {quoted(spread.texts[place])} must be finite")
        numbers.append(_unit(machine, spread.key, kind, SI).to_si(value))
    _check_order(machine, spread, units)
    _check_ends(machine, spread, numbers, units)
    return (spread.distribution.core, *numbers)


def _check_order(machine: Machine, spread: Spread, units: Units) -> None:
    """Raise ValueError where values do not rise from a low end to a high one, or have no width."""
    parts = {
        words: (typed_number(text), place)
        for place, ((words, _), text) in enumerate(
            zip(spread.distribution.numbers, spread.texts, strict=True)
        )
    }
    begin = f"{name(machine, spread.key)}: "

    def said(words: str) -> str:
        place = parts[words][1]
        unit = label(machine, spread, place, units).removeprefix(words).strip(" []")
        return minus(f"{lower(words)} = {shown(machine, spread, place, units)} {unit}".rstrip())

    rising = [words for words in ("Low", "Most likely", "Mean", "High") if words in parts]
    for below, above in itertools.pairwise(rising):
        if parts[below][0] > parts[above][0]:
            raise ValueError(f"{begin}{said(above)} must be at least {said(below)}")
    if parts.get("Std. dev.", (0.0,))[0] < 0.0:
        raise ValueError(f"{begin}{said('Std. dev.')} must be at least 0")
    if parts.get("Median", (1.0,))[0] <= 0.0:
        raise ValueError(f"{begin}{said('Median')} must be positive")
    if parts.get("Ratio", (1.0,))[0] < 1.0:
        raise ValueError(f"{begin}{said('Ratio')} must be at least 1")


def _check_ends(machine: Machine, spread: Spread, numbers: list[float], units: Units) -> None:
    """Raise ValueError where a value of the input that is named is no valid machine."""
    field = fields_of(machine)[spread.key]
    for place, (value, (words, kind)) in enumerate(
        zip(numbers, spread.distribution.numbers, strict=True)
    ):
        if kind != "value":
            continue
        try:
            variation.varied(machine, {field: value})
        except ValueError as error:
            # The core's message names the field and its value in SI before the bound.
            bound = as_shown(
                f"{error}".partition(": ")[2] or f"{error}",
                values_of(machine, _SPEED, _SPEED), units,
            )  # fmt: skip
            unit = label(machine, spread, place, units).removeprefix(words).strip(" []")
            given = minus(f"{shown(machine, spread, place, units)} {unit}".rstrip())
            raise ValueError(
                f"{name(machine, spread.key)}: {lower(words)} = {given}: {bound}"
            ) from None


def worded(message: str, machine: Machine, fields: Iterable[str], units: Units) -> str:
    """Return a message of the core on machines drawn, inputs in words and a visitor's units."""
    own = {field: key for key, field in fields_of(machine).items()}
    for field in fields:
        unit = unit_of(machine, own[field], units)
        words = name(machine, own[field])
        message = re.sub(
            rf"\b{field.rpartition('.')[2]} = (-?[\d.]+(?:e[+-]?\d+)?) \S+?:",
            lambda found, unit=unit, words=words: f"{words} = {amount(unit, float(found[1]))}:",
            message,
        )
    return message.removeprefix("spreads: ")
