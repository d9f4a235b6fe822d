"""Frozen records whose fields are checked once, when they are made, and their JSON."""

import functools
import json
import math
import numbers
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import (
    Annotated,
    Any,
    NoReturn,
    TypeVar,
    cast,
    get_args,
    get_origin,
    get_type_hints,
)

from rotorcalc.arrays import shown


@dataclass(frozen=True)
class Bound:
    """The unit and the range of a number: what a record's field accepts."""

    unit: str
    above: float = -math.inf
    at_least: float = -math.inf
    infinite: bool = False

    def check(self, name: str, value: object) -> float:
        """Return `value` as a float, or raise ValueError naming field, value and bound."""
        given = f"{name} = {shown(value)}"
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise ValueError(f"{given}: must be a number in {self.unit}")
        try:
            number = float(value)
        except OverflowError as error:  # it is finite, so not even a rigid shaft is meant
            raise ValueError(f"{given} {self.unit}: too large for a number") from error
        if math.isnan(number) or (math.isinf(number) and not self.infinite):
            raise ValueError(f"{given} {self.unit}: must be finite")
        if number <= self.above:
            rule = "positive" if self.above == 0 else f"greater than {self.above:g} {self.unit}"
            raise ValueError(f"{given} {self.unit}: must be {rule}")
        if number < self.at_least:
            raise ValueError(f"{given} {self.unit}: must be at least {self.at_least:g} {self.unit}")
        return number


@dataclass(frozen=True)
class Choice:
    """The words that a record's field accepts."""

    words: tuple[str, ...]

    def check(self, name: str, value: object) -> str:
        """Return `value`, or raise ValueError naming field, value and the words."""
        if not isinstance(value, str) or value not in self.words:
            raise ValueError(f"{name} = {shown(value)}: must be one of {self.words}")
        return value


@functools.cache
def _checks(record: type) -> dict[str, Any]:
    """Return what each field of a record class must pass: a Bound, a Choice or a class."""
    hints = get_type_hints(record, include_extras=True)
    return {
        field.name: get_args(hints[field.name])[1]
        if get_origin(hints[field.name]) is Annotated
        else hints[field.name]
        for field in fields(record)
    }


@dataclass(frozen=True, kw_only=True)
class Record:
    """A frozen record that checks its fields once, when it is made."""

    def __post_init__(self) -> None:
        for name, check in _checks(type(self)).items():
            value = getattr(self, name)
            if isinstance(check, type):
                if not isinstance(value, check):
                    raise ValueError(f"{name} = {shown(value)}: must be {check.__name__}")
            elif name != "load" or value is not None:
                object.__setattr__(self, name, check.check(name, value))


R = TypeVar("R", bound=Record)


def to_tree(record: Record) -> dict[str, object]:
    """Return a record as a tree of JSON values; JSON has no infinity, so it is the word inf."""
    tree: dict[str, object] = {}
    for field in fields(record):
        value = getattr(record, field.name)
        if isinstance(value, Record):
            tree[field.name] = to_tree(value)
        else:
            tree[field.name] = "inf" if value == math.inf else value
    return tree


def from_tree(cls: type[R], tree: object, *, where: str) -> R:
    """Return the record that a tree of JSON values describes; `where` is the path to it."""
    if not isinstance(tree, Mapping):
        raise ValueError(f"{where or 'machine'} = {shown(tree)}: must be a JSON object")
    values = dict(cast("Mapping[str, Any]", tree))
    checks = _checks(cls)
    for unknown in values.keys() - checks.keys():
        raise ValueError(f"{where}{_key(unknown)}: unknown key; known are {', '.join(checks)}")
    for missing in checks.keys() - values.keys():
        raise ValueError(f"{where}{missing}: missing")
    for name, check in checks.items():
        if isinstance(check, type) and issubclass(check, Record):
            values[name] = from_tree(check, values[name], where=f"{where}{name}.")
        elif isinstance(check, Bound) and check.infinite and values[name] == "inf":
            values[name] = math.inf
        elif isinstance(values[name], float) and math.isinf(values[name]):
            raise ValueError(f"{where}{name}: too large for a number; infinite is written 'inf'")
    return cls(**values)


def parsed(text: str) -> dict[str, Any]:
    """Return the object that JSON text holds, strictly: no NaN, no key twice."""
    try:
        document = json.loads(
            text,
            # As a float at once: an integer of a million digits is then just too large a number.
            parse_int=float,
            parse_constant=_refuse_constant,
            object_pairs_hook=_unique_keys,
        )
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError, TypeError) as error:
        raise ValueError(f"no JSON text of a machine: {error}") from error
    if not isinstance(document, dict):
        raise ValueError(f"machine = {shown(document)}: must be a JSON object")
    return cast("dict[str, Any]", document)


def _refuse_constant(word: str) -> NoReturn:
    raise ValueError(f"{word}: no number of JSON; an infinite shaft_stiffness is written 'inf'")


def _unique_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    unique: dict[str, Any] = {}
    for key, value in pairs:
        if key in unique:
            raise ValueError(f"{_key(key)}: given twice")
        unique[key] = value
    return unique


def _key(key: str) -> str:
    """Return a key as an error shows it: short, and free of surrogates, which no page can show."""
    return key[:80].encode("utf-8", "backslashreplace").decode()
