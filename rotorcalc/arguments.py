"""Refusal of arguments that contradict a function's annotations, with a clear message.

A notebook's user may pass a text for a machine, "rigid" for a bool, a list for a number. Python
would fail somewhere inside, or take a word for true. `checked` reads a function's annotations once
and checks every argument before the call. An argument annotated as array_like is left to the
function, which converts it by `arrays.real_array`.
"""

import functools
import inspect
import numbers
import sys
import types
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import (
    Annotated,
    Any,
    Literal,
    NamedTuple,
    ParamSpec,
    TypeAlias,
    TypeVar,
    Union,
    cast,
    get_args,
    get_origin,
    get_type_hints,
)

import numpy as np

from rotorcalc.arrays import shown

P = ParamSpec("P")
R = TypeVar("R")
# Takes an argument's name and value; raises ValueError where the value is not admitted.
_Check: TypeAlias = Callable[[str, Any], object]


class _Kind(NamedTuple):
    """A kind of value: its test, the words for it, and types that need no test."""

    admits: Callable[[Any], bool]
    words: str
    surely: tuple[type, ...] = ()


class _Rule(NamedTuple):
    """The check of one argument, skipped for types that always pass."""

    name: str
    place: int
    surely: tuple[type, ...]
    check: _Check


def checked(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that refuses arguments which contradict its annotations.

    Parameters
    ----------
    function : callable
        A function with annotated parameters.

    Returns
    -------
    callable
        The same function, which first raises ValueError naming a wrong argument and its value.

    Examples
    --------
    >>> @checked
    ... def doubled(times: int, *, rigid: bool = False) -> int:
    ...     return 2 * times
    >>> doubled(3, rigid="no")
    Traceback (most recent call last):
    ValueError: rigid = 'no': must be True or False
    """
    rules: list[_Rule] | None = None

    @functools.wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        nonlocal rules
        if rules is None:  # at the first call, as annotations may name classes defined further down
            rules = _rules(function)
        for name, place, surely, check in rules:
            if place < len(args):
                value = args[place]
            elif name in kwargs:
                value = kwargs[name]
            else:
                continue
            # Nearly every argument is exactly of an admitted type: that test is the quicker one.
            if type(value) not in surely:
                check(name, value)
        return function(*args, **kwargs)

    return call


def _rules(function: Callable[..., Any]) -> list[_Rule]:
    """Return the rules of a function's parameters; keyword-only ones get a place past the end."""
    code = cast("types.FunctionType", inspect.unwrap(function)).__code__
    places = {name: place for place, name in enumerate(code.co_varnames[: code.co_argcount])}
    found: list[_Rule] = []
    for name, hint in get_type_hints(function, include_extras=True).items():
        rule = _rule(hint)
        if rule is not None and name != "return":
            found.append(_Rule(name, places.get(name, sys.maxsize), *rule))
    return found


def _rule(hint: Any) -> tuple[tuple[type, ...], _Check] | None:
    """Return the types that always pass and the check of others; None where there is no rule."""
    if get_origin(hint) is Annotated:
        return (), get_args(hint)[1].check  # a Bound or a Choice, as in the fields of a record
    union = get_origin(hint) in (Union, types.UnionType)
    kinds = [_kind(member) for member in (get_args(hint) if union else (hint,))]
    known = [kind for kind in kinds if kind is not None]
    if len(known) < len(kinds):  # one member of the union, such as ArrayLike, is not known here
        return None

    def check(name: str, value: Any) -> None:
        for kind in known:
            if kind.admits(value):
                return
        words = " or ".join(kind.words for kind in known)
        raise ValueError(f"{name} = {shown(value)}: must be {words}")

    return tuple(one for kind in known for one in kind.surely), check


def _kind(hint: Any) -> _Kind | None:
    """Return the kind of value that an annotation admits, or None where it is not known here."""
    origin, args = get_origin(hint), get_args(hint)
    if hint in _PLAIN or origin in _PLAIN:
        return _PLAIN[origin or hint]
    if origin is Literal:
        return _Kind(_among(args), " or ".join(map(repr, args)))
    if origin in (Sequence, tuple):
        return _sequence(args[0], None if origin is Sequence or Ellipsis in args else len(args))
    return _record(hint) if isinstance(hint, type) and origin is None else None


def _record(cls: type) -> _Kind:
    article = "an" if cls.__name__[0] in "AEIO" else "a"
    return _Kind(_of(cls), f"{article} {cls.__name__}", (cls,))


def _sequence(element: Any, length: int | None = None) -> _Kind | None:
    """Return the kind of a list of elements, of a fixed length where one is given."""
    kind = _kind(element)
    if kind is None:
        return None

    def admits(values: Any) -> bool:
        # A text is a sequence of texts, but never meant as a list.
        listed = isinstance(values, Sequence | np.ndarray) and not isinstance(values, str | bytes)
        right = listed and length in (None, len(cast("Sequence[Any]", values)))
        return right and all(map(kind.admits, cast("Sequence[Any]", values)))

    return _Kind(
        admits, f"{'a list' if length is None else f'a list of {length}'}, each {kind.words}"
    )


def _of(*cls: type) -> Callable[[Any], bool]:
    def admits(value: object) -> bool:
        return isinstance(value, cls)

    return admits


def _among(words: tuple[str, ...]) -> Callable[[Any], bool]:
    def admits(value: object) -> bool:
        # The type first: an array compared with a word is an array, which has no truth value.
        return isinstance(value, str) and value in words

    return admits


def _is_number(value: Any) -> bool:
    if isinstance(value, np.ndarray):  # a result at one speed is an array without dimensions
        given = cast("np.ndarray[Any, Any]", value)
        return given.ndim == 0 and given.dtype.kind in "iuf"
    # A bool is a number to Python: a mass of True would pass as 1 kg.
    return not isinstance(value, bool) and isinstance(value, numbers.Real)


def _is_whole(value: Any) -> bool:
    return not isinstance(value, bool) and isinstance(value, numbers.Integral)


def _is_array(value: Any) -> bool:
    if not isinstance(value, np.ndarray | np.generic):
        return False
    given = cast("np.ndarray[Any, Any]", value)
    if given.dtype.kind == "O":  # decimals, in which the onset is computed where floats leave doubt
        return all(isinstance(one, numbers.Number) for one in given.flat)
    return given.dtype.kind in "biufc"


def _is_list(value: Any) -> bool:
    # Python iterates over the letters of a text and the keys of a mapping: neither is a list here.
    return isinstance(value, Iterable) and not isinstance(value, str | bytes | Mapping)


# Annotations with a fixed test; types in "surely" pass without it.
_PLAIN: dict[Any, _Kind] = {
    types.NoneType: _Kind(_of(types.NoneType), "None", (types.NoneType,)),
    # A comparison of NumPy numbers gives an np.bool_.
    bool: _Kind(_of(bool, np.bool_), "True or False", (bool,)),
    float: _Kind(_is_number, "a number", (float, int)),
    int: _Kind(_is_whole, "a whole number", (int,)),
    str: _Kind(_of(str), "a text", (str,)),
    bytes: _Kind(_of(bytes), "bytes", (bytes,)),
    np.ndarray: _Kind(_is_array, "an array of numbers"),
    Callable: _Kind(callable, "a function"),
    Mapping: _Kind(_of(Mapping), "a mapping of names to values", (dict,)),
    Iterable: _Kind(_is_list, "a list"),
}
