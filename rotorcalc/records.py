"""Frozen records whose fields are checked once, when they are made, and their JSON."""

import functools
import json
import math
import numbers
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, dataclass, fields
from types import NoneType
from typing import (
    Annotated,
    Any,
    ClassVar,
    NoReturn,
    Self,
    TypeVar,
    cast,
    get_args,
    get_origin,
    get_type_hints,
)

import numpy as np
from numpy.typing import NDArray

from rotorcalc.arrays import shown


@dataclass(frozen=True)
class Bound:
    """The unit and the range of a number: what a record's field accepts."""

    unit: str
    above: float = -math.inf
    at_least: float = -math.inf
    infinite: bool = False
    below: float = math.inf
    whole: bool = False

    def check(self, name: str, value: object) -> float:
        """Return `value` as a float, or raise ValueError naming field, value and bound."""
        # Nearly every value is a float well inside, which needs no words.
        if type(value) is float and self._holds(value):
            return value
        # True is a number to Python, but never meant as one.
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise ValueError(f"{name} = {shown(value)}: must be a number in {self.unit}")
        try:
            number = float(value)
        except OverflowError as error:
            # An integer beyond 1e308 is finite, so it does not mean a rigid shaft.
            given = f"{name} = {shown(value)} {self.unit}"
            raise ValueError(f"{given}: too large for a number") from error
        if problem := self._problem(number):
            raise ValueError(f"{name} = {shown(value)} {self.unit}: must be {problem}")
        return number

    def _holds(self, number: float) -> bool:
        """Return whether a number is finite and surely within the bounds: NaN and ∞ are not."""
        return self.above < number < self.below and number >= self.at_least and not self.whole

    def _problem(self, number: float) -> str:
        """Return in words which bound a number breaks, or nothing."""
        # NaN first: every comparison with it is false, so it would pass the bounds below.
        if math.isnan(number) or (math.isinf(number) and not self.infinite):
            return "finite"
        if number <= self.above:
            return "positive" if self.above == 0 else f"greater than {self.above:g} {self.unit}"
        if number < self.at_least:
            return f"at least {self.at_least:g} {self.unit}"
        if number >= self.below and not self.infinite:
            return f"less than {self.below:g} {self.unit}"
        return "a whole number" if self.whole and number != round(number) else ""


@dataclass(frozen=True)
class Choice:
    """The words that a record's field accepts."""

    words: tuple[str, ...]

    def check(self, name: str, value: object) -> str:
        """Return `value`, or raise ValueError naming field, value and the words."""
        if not isinstance(value, str) or value not in self.words:
            raise ValueError(f"{name} = {shown(value)}: must be one of {self.words}")
        return value


@dataclass(frozen=True)
class Grid:
    """A list of numbers, (n,), or of arrays of numbers of one shape, (n, *ends), in a unit."""

    unit: str
    ends: tuple[int, ...] = ()

    def check(self, name: str, value: object) -> tuple[Any, ...]:
        """Return `value` as tuples of floats, or raise ValueError naming the place in it."""
        wanted = "n" + "".join(f", {size}" for size in self.ends)
        rows = _rows(value)
        if rows is None:
            raise ValueError(f"{name} = {shown(value)}: must be a list of numbers, ({wanted})")
        return tuple(
            self._checked(f"{name}[{i}]", row, self.ends, wanted) for i, row in enumerate(rows)
        )

    def _checked(self, name: str, value: object, ends: tuple[int, ...], wanted: str) -> Any:
        if not ends:
            return Bound(self.unit).check(name, value)
        rows = _rows(value)
        if rows is None or len(rows) != ends[0]:
            raise ValueError(
                f"{name} = {shown(value)}: must be a list of {ends[0]}; the whole has the shape "
                f"({wanted})"
            )
        return tuple(
            self._checked(f"{name}[{i}]", row, ends[1:], wanted) for i, row in enumerate(rows)
        )


def _rows(value: object) -> list[Any] | None:
    """Return the rows of a list, a tuple or an array; None of anything else."""
    if isinstance(value, np.ndarray):
        array = cast("NDArray[Any]", value)
        return list(array) if array.ndim else None
    return list(cast("list[Any]", value)) if isinstance(value, list | tuple) else None


@dataclass(frozen=True)
class Rule:
    """What a field of a record accepts: a check or a class, whether None too, and its default."""

    check: "Bound | Choice | Grid | type[Record]"
    optional: bool
    default: object


@functools.cache
def rules(record: type) -> dict[str, Rule]:
    """Return the rule of each field of a record class."""
    hints = get_type_hints(record, include_extras=True)
    found: dict[str, Rule] = {}
    for field in fields(record):
        hint, check = hints[field.name], None
        if get_origin(hint) is Annotated:
            hint, check = get_args(hint)[:2]
        optional = NoneType in get_args(hint)
        if check is None:
            check = next(one for one in (get_args(hint) or (hint,)) if one is not NoneType)
        found[field.name] = Rule(check, optional, field.default)
    return found


@dataclass(frozen=True, kw_only=True)
class Record:
    """A frozen record that checks its fields once, when it is made."""

    def __post_init__(self) -> None:
        for name, rule in rules(type(self)).items():
            value = getattr(self, name)
            if rule.optional and value is None:
                continue
            if isinstance(rule.check, type):
                if not isinstance(value, rule.check):
                    raise ValueError(f"{name} = {shown(value)}: must be {_names(rule.check)}")
            elif (kept := rule.check.check(name, value)) is not value:
                # Past the frozen dataclass: an integer or a NumPy number is stored as a float.
                object.__setattr__(self, name, kept)


R = TypeVar("R", bound=Record)


@dataclass(frozen=True, kw_only=True)
class Kind(Record):
    """A record that comes in several kinds, distinguished in files by the word in `kind`.

    Of the kind that `unwritten` names, which was once the only one, files do not hold it.
    """

    kind: ClassVar[str] = ""
    unwritten: ClassVar[str] = ""

    @classmethod
    def kinds(cls) -> "dict[str, type[Self]]":
        """Return this class's subclasses by their words, in order of definition."""
        return dict(cast("Mapping[str, type[Self]]", _kinds(cls)))

    def __init_subclass__(cls, **kwargs: Any) -> None:
        """Have the new kind found among the others."""
        super().__init_subclass__(**kwargs)
        _kinds.cache_clear()


@functools.cache
def _kinds(cls: type[Kind]) -> Mapping[str, type[Kind]]:
    """Return the kinds of a record; a page asks for them some hundred times."""
    found: dict[str, type[Kind]] = {cls.kind: cls} if cls.kind else {}
    for below in cls.__subclasses__():
        found |= _kinds(below)
    return found


def _names(record: type[Record]) -> str:
    """Return the names of the classes that a field takes."""
    if issubclass(record, Kind) and record.unwritten:
        return " or ".join(one.__name__ for one in record.kinds().values())
    return record.__name__


def number_paths(record: Record) -> Iterator[tuple[str, ...]]:
    """Yield the path of each number of a record: field names from the outermost record inwards."""
    for name, rule in rules(type(record)).items():
        value = getattr(record, name)
        if isinstance(value, Record):
            yield from ((name, *path) for path in number_paths(value))
        elif isinstance(rule.check, Bound):
            yield (name,)


def to_tree(record: Record) -> dict[str, object]:
    """Return a record as a tree of JSON values, fields at their default left out.

    JSON has no infinity, so it is written "inf"; a record of several kinds is named in "type".
    """
    tree: dict[str, object] = {}
    if isinstance(record, Kind) and record.kind != record.unwritten:
        tree["type"] = record.kind
    for name, rule in rules(type(record)).items():
        value = getattr(record, name)
        if value == rule.default and str(value) == str(rule.default):  # −0.0 is not 0.0
            continue
        if isinstance(value, Record):
            tree[name] = to_tree(value)
        else:
            tree[name] = "inf" if value == math.inf else value
    return tree


def from_tree(cls: type[R], tree: object, *, where: str) -> R:
    """Return the record that a tree of JSON values describes; `where` is the path to it."""
    if not isinstance(tree, Mapping):
        raise ValueError(f"{where.rstrip('.') or 'machine'} = {shown(tree)}: must be a JSON object")
    values = dict(cast("Mapping[str, Any]", tree))
    if issubclass(cls, Kind):
        cls = _kind_of(cls, values, where)
    known = rules(cls)
    # Unknown keys are errors: a misspelt field would otherwise silently take its default.
    for unknown in values.keys() - known.keys():
        raise ValueError(f"{where}{_key(unknown)}: unknown key; known are {', '.join(known)}")
    for name, rule in known.items():
        if name in values:
            values[name] = _value_of(rule, values[name], where=f"{where}{name}")
        elif rule.default is MISSING:
            raise ValueError(f"{where}{name}: missing")
    return cls(**values)


def _kind_of(cls: type[R], values: dict[str, Any], where: str) -> type[R]:
    """Return the record class that "type" names, and take that key out of the values."""
    kinds = cast("type[Kind]", cls).kinds()
    word = values.pop("type", cast("type[Kind]", cls).unwritten or None)
    if not isinstance(word, str) or word not in kinds:
        raise ValueError(f"{where}type = {shown(word)}: must be one of {', '.join(kinds)}")
    return cast("type[R]", kinds[word])


def _value_of(rule: Rule, value: object, *, where: str) -> object:
    """Return a field's value from its JSON value."""
    if isinstance(rule.check, type):
        return (
            None
            if value is None and rule.optional
            else from_tree(rule.check, value, where=f"{where}.")
        )
    if isinstance(rule.check, Bound) and rule.check.infinite and value == "inf":
        return math.inf
    if isinstance(value, float) and math.isinf(value):
        raise ValueError(f"{where}: too large for a number; infinite is written 'inf'")
    return value


def parsed(text: str) -> dict[str, Any]:
    """Return the object in a JSON text, strictly: no NaN, no duplicate key."""
    document = parsed_value(text)
    if not isinstance(document, dict):
        raise ValueError(f"machine = {shown(document)}: must be a JSON object")
    return cast("dict[str, Any]", document)


def parsed_value(text: str) -> object:
    """Return whatever a JSON text holds, as strictly."""
    try:
        return json.loads(
            text,
            # As a float at once: an integer of a million digits is then inf, refused as too large.
            parse_int=float,
            parse_constant=_refuse_constant,
            object_pairs_hook=_unique_keys,
        )
    # RecursionError: brackets nested too deep. TypeError: not a text.
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError, TypeError) as error:
        raise ValueError(f"no JSON text of a machine: {error}") from error


def _refuse_constant(word: str) -> NoReturn:
    raise ValueError(f"{word}: not a JSON number; an infinite shaft_stiffness is written 'inf'")


def _unique_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    unique: dict[str, Any] = {}
    for key, value in pairs:
        # `json` would keep the last of the two without a word.
        if key in unique:
            raise ValueError(f"{_key(key)}: given twice")
        unique[key] = value
    return unique


def _key(key: str) -> str:
    """Return a short text of a key for an error, without surrogates, which no page can display."""
    return key[:80].encode("utf-8", "backslashreplace").decode()
