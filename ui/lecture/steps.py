"""The lecture's steps, read from a file and checked."""

import math
import re
import tomllib
from collections.abc import Collection, Iterator, Mapping
from dataclasses import MISSING, dataclass, field, fields
from functools import cache
from pathlib import Path
from typing import Any

from ui.bores import Value, Values
from ui.format import quoted
from ui.inputs import DEFAULT_PRESET, PRESET_VALUES, inputs_of, number, usual
from ui.results.table import RESULTS
from ui.sharing import address

OWN = Path(__file__).with_name("steps.toml")
# A file of forty steps has room in both.
MOST_BYTES, MOST_STEPS = 200_000, 60
_ENDED = re.compile(r"; | and was left out|\.$")
_KINDS = {str: "text in quotes", dict: "a table { … }", list: "a list [ … ]"}


@dataclass(frozen=True)
class Step:
    """One step: what to say, what is shown, what may be moved, and a question with its answer.

    `machine` and `then` are in the words of a link; the comment of steps.toml explains each field.
    """

    title: str
    say: str
    view: str
    question: str
    answer: str
    equation: str = ""
    source: str = ""
    derivation: str = ""
    before: str = ""
    machine: dict[str, Any] = field(default_factory=dict, hash=False)
    then: dict[str, Any] = field(default_factory=dict, hash=False)
    move: list[str] = field(default_factory=lambda: ["rpm"], hash=False)
    between: dict[str, Any] = field(default_factory=dict, hash=False)
    results: list[str] = field(default_factory=list, hash=False)

    @property
    def preset(self) -> str:
        """The preset from which the machine differs."""
        return str(self.machine.get("preset", DEFAULT_PRESET))

    @property
    def values(self) -> Values:
        """The machine's kept values."""
        return _values(self.machine, "machine")

    @property
    def changed(self) -> Mapping[str, Value]:
        """The values that the answer changes."""
        after = _values(self.machine | self.then, "then")
        return {key: after[key] for key in self.then}

    @property
    def windows(self) -> dict[str, tuple[float, float]]:
        """The values between which each of the inputs moves: as given, or about the machine's."""
        return {
            key: _between(self, key) if key in self.between else _about(self, key)
            for key in self.move
        }

    @property
    def extremes(self) -> Iterator[Values]:
        """The machines at first, with the answer, and with each input at the ends of its window."""
        after = self.values | dict(self.changed)
        yield from (self.values, after)
        yield from (after | {key: end} for key, ends in self.windows.items() for end in ends)


@cache
def own_steps(views: frozenset[str]) -> tuple[Step, ...]:
    """Return the steps of the notes."""
    return read(OWN.read_bytes(), views)


def read(content: bytes, views: Collection[str]) -> tuple[Step, ...]:
    """Return the steps of a file; a ValueError says which step has which fault."""
    if len(content) > MOST_BYTES:
        raise ValueError(f"the file has {len(content)} bytes: at most {MOST_BYTES} are read")
    try:
        found = tomllib.loads(content.decode())
    except (UnicodeDecodeError, tomllib.TOMLDecodeError, RecursionError) as error:
        raise ValueError(f"the file is not TOML in UTF-8: {error}") from error
    steps = found.pop("step", None)
    if found or not isinstance(steps, list) or not 1 <= len(steps) <= MOST_STEPS:
        raise ValueError(f"the file must hold 1 to {MOST_STEPS} tables [[step]], and nothing else")
    lines = [at for at, line in enumerate(content.splitlines(), 1) if line.strip() == b"[[step]]"]
    # Steps may also be written as one list, whose lines are not known.
    where = [f" (line {at})" for at in lines] if len(lines) == len(steps) else [""] * len(steps)
    return tuple(
        _step(f"step {place}{at}", one, views)
        for place, (at, one) in enumerate(zip(where, steps, strict=True), start=1)
    )


def _step(name: str, given: object, views: Collection[str]) -> Step:
    try:
        step = Step(**_fields(given))
        _check(step, views)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error
    return step


def _fields(given: object) -> dict[str, Any]:
    if not isinstance(given, dict):
        raise ValueError("must be a table")
    known = {one.name: one for one in fields(Step)}
    for key, value in given.items():
        if key not in known:
            raise ValueError(f"{quoted(key)} is none of {', '.join(known)}")
        if not isinstance(value, kind := _kind(known[key].type)):
            raise ValueError(f"{key}: must be {_KINDS[kind]}")
    for name, one in known.items():
        needed = one.default is MISSING and one.default_factory is MISSING
        if needed and not given.get(name, "").strip():
            raise ValueError(f"{name}: missing")
    return given


def _kind(annotation: object) -> type:
    return next(kind for kind in _KINDS if annotation is kind or f"{annotation}".startswith(
        kind.__name__
    ))  # fmt: skip


def _check(step: Step, views: Collection[str]) -> None:
    _known("view", [step.view], views)
    _known("before", [step.before] if step.before else [], views)
    _known("results", step.results, RESULTS)
    _known("preset", [step.preset], PRESET_VALUES)
    _known("move", step.move, inputs_of(step.values))
    _known("then", list(step.then), inputs_of(step.values))
    _known("between", list(step.between), step.move)
    _ = step.changed, step.windows


def _between(step: Step, key: str) -> tuple[float, float]:
    """Return the two values between which a step moves an input, or raise ValueError."""
    given = step.between[key]
    if not isinstance(given, list) or len(given) != 2:
        raise ValueError(f"between: {key} must have two values, [from, to]")
    low, high = (number(_values(step.machine | {key: end}, "between"), key) for end in given)
    if not (low < high < math.inf) or (low <= 0.0 and not inputs_of(step.values)[key].step):
        raise ValueError(f"between: {key} must rise, from a value above zero to a finite one")
    return low, high


def _about(step: Step, key: str) -> tuple[float, float]:
    """Return a window about an input's value at first and with the answer."""
    item, after = inputs_of(step.values)[key], step.values | dict(step.changed)
    ends = sorted(number(values, key) for values in (step.values, after) if values[key] is not None)
    inside = [value for value in ends if (value > 0.0 or item.step) and value < math.inf]
    inside = inside or [usual(key, step.values)]
    least = item.least or item.low
    if item.step:
        low, high = inside[0] - 0.5 * item.span, inside[-1] + 0.5 * item.span
    else:
        low, high = 0.5 * inside[0], 2.0 * inside[-1]
    return max(low, least), min(high, item.high)


def _known(name: str, given: list[str], known: Collection[str]) -> None:
    for one in given:
        if one not in known:
            raise ValueError(f"{name} = {quoted(one)}: must be one of {', '.join(known)}")


def _values(given: dict[str, Any], name: str) -> Values:
    words = {key: f"{value}" for key, value in given.items() if key != "preset"}
    problems: list[str] = []
    preset = str(given.get("preset", DEFAULT_PRESET))
    _known("preset", [preset], PRESET_VALUES)
    values = address.checked_values(words, preset, problems)
    if problems:
        # Of a link such a value would be replaced, and the problem ends with how.
        raise ValueError(f"{name}: {'; '.join(_ENDED.split(one)[0] for one in problems)}")
    return values
