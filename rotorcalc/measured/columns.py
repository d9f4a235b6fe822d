"""A table of numbers from a file: columns by their names, in SI, refused by line and column.

A file is read as data. Formulas are refused, its size and its cells are bounded, and of a table
with one wrong cell nothing is taken: a gap in a record of samples would be read as vibration.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.batch import columns as known_units
from rotorcalc.batch.numbers import Mark, decimal_mark, number
from rotorcalc.batch.text import readable, rows
from rotorcalc.units import AMPLITUDES, Unit

MOST_BYTES, MOST_ROWS, MOST_COLUMNS = 20_000_000, 500_000, 50
_HEADER = re.compile(r"\s*([^\[\]]{1,60}?)\s*(?:\[([^\[\]]{0,30})\]\s*)?")
# How an amplitude is read, by the spellings that a unit may end with.
_READINGS = {"0-p": "0-p", "0p": "0-p", "pk": "0-p", "peak": "0-p", "p-p": "p-p", "pp": "p-p",
             "pk-pk": "p-p", "pkpk": "p-p"}  # fmt: skip


class Quantity(NamedTuple):
    """A column that a table may have: its names and its unit in SI, "" where any will do."""

    names: tuple[str, ...]
    si: str


@dataclass(frozen=True)
class Table:
    """Columns of numbers in SI by the keys of their quantities, each (n,).

    Attributes
    ----------
    columns : dict
        Arrays by key.
    lines : list of int
        The line of the file on which each row stands.
    readings : dict
        How amplitudes are read, "0-p" or "p-p", by key, where a unit says it.
    unread : tuple of str
        Headers of other columns.
    """

    columns: dict[str, Array]
    lines: list[int]
    readings: dict[str, str]
    unread: tuple[str, ...]


class _Column(NamedTuple):
    key: str
    header: str
    unit: Unit
    place: int


def read_table(given: str | bytes | Path, known: Mapping[str, Quantity], *, fewest: int) -> Table:
    """Return the known columns of a table.

    Parameters
    ----------
    given : str, bytes or Path
        The table's text, or the file that holds it.
    known : mapping
        Quantities by the keys under which they are returned.
    fewest : int
        Rows that it must have.

    Returns
    -------
    Table
        In the order of the lines.

    Raises
    ------
    ValueError
        Naming line and column, where anything is wrong.
    """
    if isinstance(given, Path):
        with given.open("rb") as file:  # one byte more than is admitted at most
            given = file.read(MOST_BYTES + 1)
    lines = list(rows(readable(given, most_bytes=MOST_BYTES), most=MOST_ROWS, things="rows"))
    header = lines[0][1]
    if len(header) > MOST_COLUMNS:
        raise ValueError(f"the header has more than {MOST_COLUMNS} columns")
    found, readings, unread = _columns(header, known)
    filled = [(line, row) for line, row in lines[1:] if any(cell.strip() for cell in row)]
    if len(filled) < fewest:
        raise ValueError(f"the file has {len(filled)} rows of numbers, must have {fewest} or more")
    for line, row in filled:
        if len(row) < len(header) or any(cell.strip() for cell in row[len(header) :]):
            raise ValueError(f"line {line}: has {len(row)} cells, the header {len(header)}")
    cells = [row for _, row in filled]
    mark = decimal_mark(row[column.place] for row in cells for column in found)
    places = [line for line, _ in filled]
    columns = {one.key: _numbers(one, cells, places, mark) for one in found}
    return Table(columns, places, readings, unread)


def keys_in(text: str | bytes, known: Mapping[str, Quantity]) -> set[str]:
    """Return the keys of the columns that a table's header has; none where it cannot be read."""
    try:
        lines = rows(readable(text, most_bytes=MOST_BYTES), most=MOST_ROWS, things="rows")
        found, _, _ = _columns(next(iter(lines))[1][:MOST_COLUMNS], known)
    except (ValueError, StopIteration):
        return set()
    return {column.key for column in found}


def _columns(
    header: Sequence[str], known: Mapping[str, Quantity]
) -> tuple[list[_Column], dict[str, str], tuple[str, ...]]:
    """Return the columns to read, how amplitudes are read, and the headers of the others."""
    keys = {name: key for key, quantity in known.items() for name in quantity.names}
    found: list[_Column] = []
    readings: dict[str, str] = {}
    unread: list[str] = []
    for place, cell in enumerate(header):
        match = _HEADER.fullmatch(cell)
        name = " ".join(match[1].lower().split()) if match else ""
        if match is None or name not in keys:
            unread.append(cell.strip()[:80])
            continue
        key = keys[name]
        if any(key == column.key for column in found):
            raise ValueError(f"header: {name!r} has two columns")
        spelt, reading = _reading(match[2])
        if reading:
            readings[key] = reading
        found.append(_Column(key, cell.strip(), _unit(name, spelt, known[key].si), place))
    return found, readings, tuple(name for name in unread if name)


def _reading(unit: str | None) -> tuple[str | None, str]:
    """Return a unit without the reading that ends it, "µm p-p", and the reading."""
    words = (unit or "").split()
    if len(words) > 1 and words[-1].lower() in _READINGS:
        return " ".join(words[:-1]), _READINGS[words[-1].lower()]
    return unit, ""


def _unit(name: str, given: str | None, si: str) -> Unit:
    if not si:
        return Unit("-")
    units = known_units.units_of(si)
    spellings = ", ".join(unit.name for unit in units.values())
    if given is None:
        raise ValueError(f"header: {name} has no unit; write '{name} [{si}]', one of {spellings}")
    unit = units.get(known_units.plain(given))
    if unit is None:
        raise ValueError(f"header: {name} [{given}] has an unknown unit; known are {spellings}")
    return unit


def _numbers(
    column: _Column, cells: Sequence[Sequence[str]], lines: Sequence[int], mark: Mark
) -> Array:
    values = np.empty(len(cells))
    for i, row in enumerate(cells):
        text = row[column.place]
        try:
            values[i] = number(text, mark, infinite=False)
        except ValueError as error:
            problem = f"{error}" if text.strip() else "is empty"
            raise ValueError(f"line {lines[i]}, column {column.header}: {problem}") from error
    unit = column.unit
    in_si = (values - unit.offset) * (1.0 / unit.per_si if unit.in_si is None else unit.in_si)
    beyond = np.abs(in_si) > _LARGEST
    if beyond.any():
        line = lines[int(np.argmax(beyond))]
        raise ValueError(f"line {line}, column {column.header}: is larger than {_LARGEST:g} in SI")
    return in_si


# Squares of what is read must stay finite.
_LARGEST = 1e12


def share_of(reading: str) -> float:
    """Return the amplitude, zero to peak, over its reading."""
    return 1.0 / AMPLITUDES[reading]
