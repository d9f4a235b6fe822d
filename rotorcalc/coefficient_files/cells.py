"""A file as rows of cells, each with the place by which people find it."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

from rotorcalc.batch.numbers import LONGEST, Mark, decimal_mark, number

MOST_BYTES, MOST_ROWS, MOST_COLUMNS, MOST_CELLS = 2_000_000, 5_000, 200, 200_000

Cell: TypeAlias = str | float

_NUMBER = re.compile(r"[+\-\u2212]?(\d+[.,]?\d*|[.,]\d+)([eEdD][+\-\u2212]?\d{1,4})?", re.ASCII)
_GROUPS = re.compile(r"[+\-\u2212]?\d{1,3}(,\d{3})+", re.ASCII)


@dataclass(frozen=True)
class Row:
    """A row: its number in the file, from 1, and its cells.

    Those of a text are texts; a comment's are never numbers of the table.
    """

    number: int
    cells: tuple[Cell, ...]
    comment: bool = False


@dataclass(frozen=True)
class Sheet:
    """The rows of a text, or of a workbook's sheet, that hold anything."""

    rows: tuple[Row, ...]
    # Columns of the workbook before the first one here; None of a text.
    shift: int | None = None
    notes: tuple[str, ...] = ()

    def place(self, row: Row, column: int, name: str = "") -> str:
        """Return where a cell is: "cell B7" of a workbook, else "line 7, column 2"."""
        called = f" ({name})" if name else ""
        if self.shift is None:
            return f"line {row.number}, column {column + 1}{called}"
        return f"cell {letters(column + self.shift)}{row.number}{called}"

    def line(self, row: Row) -> str:
        """Return where a row is."""
        return f"{'line' if self.shift is None else 'row'} {row.number}"


def letters(column: int) -> str:
    """Return a workbook's name of a column that counts from 0: A to Z, AA and so on."""
    name = ""
    column += 1
    while column:
        column, last = divmod(column - 1, 26)
        name = chr(ord("A") + last) + name
    return name


def is_empty(cell: Cell) -> bool:
    """Return whether a cell has nothing in it."""
    return isinstance(cell, str) and not cell.strip()


def is_number(cell: Cell) -> bool:
    """Return whether a cell is a number, however it is written."""
    if not isinstance(cell, str):
        return True
    text = cell.strip()
    return len(text) <= LONGEST and bool(_NUMBER.fullmatch(text) or _GROUPS.fullmatch(text))


def mark_of(cells: Iterable[Cell]) -> Mark:
    """Return the decimal mark of the texts among cells."""
    return decimal_mark(_e(cell) for cell in cells if isinstance(cell, str))


def value(cell: Cell, mark: Mark) -> float:
    """Return a cell's number; raise ValueError in words where it has none."""
    if not isinstance(cell, str):
        if abs(cell) < float("inf"):
            return cell
        raise ValueError(f"{cell}: must be finite")
    if is_empty(cell):
        raise ValueError("is empty; a formula needs a value that was saved with it")
    return number(_e(cell), mark, infinite=False)


def _e(cell: str) -> str:
    """Return a text with the exponents of old programs, 1.5D+08, as 1.5E+08."""
    text = cell.strip().replace("\u2212", "-")
    return re.sub(r"(?<=[\d.,])[dD](?=[+-]?\d)", "E", text) if len(text) <= LONGEST else text
