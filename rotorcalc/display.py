"""How results are displayed in a notebook: a few lines of text, or a table in HTML.

A result is a frozen record of arrays, which printed in full would fill pages. The text gives each
field's shape, the range of its values and its unit, the HTML table its meaning as well. Unit and
meaning are read from the record's docstring, so that they are written in one place.
"""

import functools
import html
import inspect
import re
import reprlib
import textwrap
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any, NamedTuple, cast

import numpy as np

# A text no wider than a code line and short enough to stay on screen with the cell above it.
WIDTH, LINES = 100, 12
# "[N·s/m]" in a docstring, and the line that opens an attribute, "semi_major, semi_minor : array".
_UNIT = re.compile(r"\[([^\]]*)\]")
_ATTRIBUTE = re.compile(r"(\w+(?:, \w+)*) : ")
# Arrays of at most this many numbers are printed in full: a vector, or three modes.
_FEW = 3


class Result:
    """A record of arrays with a short repr; its subclasses are frozen dataclasses."""

    def __init_subclass__(cls) -> None:
        """Keep `dataclass` from giving a subclass a repr with every number of its arrays."""
        if "__repr__" not in vars(cls):
            cls.__repr__ = Result.__repr__  # `dataclass` leaves a repr alone that the class defines

    def __repr__(self) -> str:
        """Return at most `LINES` lines of at most `WIDTH` columns."""
        rows = list(_rows(self))
        # All fields where they fit, else as many as leave two lines for the names of the others.
        shown = rows if len(rows) < LINES else rows[: LINES - 3]
        lines = [type(self).__name__, *_columns(shown)]
        if rest := [row.field for row in rows[len(shown) :]]:
            names = f"and {len(rest)} more: {', '.join(rest)}"
            lines += [f"  {line}" for line in textwrap.wrap(names, WIDTH - 2, max_lines=2)]
        return "\n".join(line.rstrip()[:WIDTH] for line in lines)

    def _repr_html_(self) -> str:
        """Return all fields as a table in HTML."""
        title, _ = _described(type(self))
        rows = "".join(
            f"<tr>{''.join(map(_cell, row))}</tr>" for row in [_Row._fields, *_rows(self)]
        )
        return f"<p><b>{type(self).__name__}</b>: {html.escape(title)}</p><table>{rows}</table>"


class _Row(NamedTuple):
    field: str
    shape: str
    values: str
    unit: str
    meaning: str


def _rows(record: Result, prefix: str = "") -> Iterator[_Row]:
    """Yield one row per field; fields of a result within a result have dotted names."""
    _, described = _described(type(record))
    for field in fields(record):  # pyright: ignore[reportArgumentType] - a dataclass, as they all
        name, value = prefix + field.name, getattr(record, field.name)
        if isinstance(value, Result):
            yield from _rows(value, f"{name}.")
        elif not field.name.startswith("_"):
            unit, meaning = described.get(field.name, ("", ""))
            yield _Row(name, _shape(value), _values(value), unit, meaning)


def _columns(rows: list[_Row]) -> Iterator[str]:
    """Yield rows as lines of aligned columns, without the meaning."""
    widths = [max(len(row[i]) for row in rows) for i in range(3)]
    for row in rows:
        cells = [cell.ljust(width) for cell, width in zip(row, widths, strict=False)]
        yield "  ".join(["", *cells, row.unit])


def _cell(text: str) -> str:
    return f'<td style="text-align: left">{html.escape(text)}</td>'


def units(record: type) -> dict[str, str]:
    """Return the unit of each field of a record, from its docstring."""
    _, described = _described(record)
    return {field.name: described.get(field.name, ("", ""))[0] for field in fields(record)}


@functools.cache
def _described(record: type) -> tuple[str, dict[str, tuple[str, str]]]:
    """Return the first line of a record's docstring, and unit and meaning of its attributes."""
    title, _, rest = (inspect.getdoc(record) or "").partition("\n")
    texts: dict[str, str] = {}
    names = ""
    for line in rest.splitlines():
        # Headings start a line; the indented lines below one are its text.
        if heading := _ATTRIBUTE.match(line):
            names = heading[1]
        elif line.startswith(" "):
            texts[names] = f"{texts.get(names, '')} {line.strip()}".strip()
    found = {
        name: (unit, text)
        for names, text in texts.items()
        for name, unit in _with_units(names.split(", "), text, title)
    }
    return title, found


def _with_units(names: list[str], text: str, title: str) -> list[tuple[str, str]]:
    """Return the names that share a text with the unit of each: "K_ij [N/m] and C_ij [N·s/m]"."""
    found = _UNIT.findall(text) or _UNIT.findall(title)  # "..., each of shape (n,) [J]."
    if len(found) == 1:
        found = found * len(names)
    # A field with alternative units, such as K_ij with or without dimensions, is given none.
    return list(zip(names, found if len(found) == len(names) else [""] * len(names), strict=True))


def _shape(value: Any) -> str:
    if isinstance(value, tuple):
        return f"({len(cast('tuple[Any, ...]', value))},)"
    return str(np.shape(value)).replace(" ", "") if np.ndim(value) else ""


def _values(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return in_brief(cast("np.ndarray[Any, Any]", value))
    if isinstance(value, tuple):
        kinds = {type(each).__name__ for each in cast("tuple[object, ...]", value)}
        return " or ".join(sorted(kinds))
    if is_dataclass(value):
        return type(cast("object", value)).__name__
    return f"{value:.5g}" if isinstance(value, float | complex) else reprlib.repr(value)


def in_brief(values: Any) -> str:
    """Return all numbers of an array where they are few, else the smallest and the largest."""
    if values.dtype.kind not in "fc":  # booleans and texts are counted: "3 False, 5 True"
        found, counts = np.unique(values, return_counts=True)
        return ", ".join(f"{count} {each}" for each, count in zip(found, counts, strict=True))
    if values.size <= _FEW:
        return ", ".join(f"{number:.5g}" for number in values.ravel().tolist())
    if values.dtype.kind == "c":
        return f"size {in_brief(np.abs(values))}"
    known = values[~np.isnan(values)]
    return f"{known.min():.5g} … {known.max():.5g}" if known.size else "nan"
