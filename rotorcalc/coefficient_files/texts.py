"""A text as rows of cells, whatever separates them: semicolons, tabs, commas or spaces."""

import csv
import re
from collections.abc import Callable, Sequence
from functools import partial
from typing import TypeAlias, cast

from rotorcalc.coefficient_files.cells import (
    MOST_CELLS,
    MOST_COLUMNS,
    MOST_ROWS,
    Row,
    Sheet,
    is_number,
)

_Split: TypeAlias = Callable[[str], Sequence[str]]

_MARKS = "#%!"
# A word with a unit in brackets after it, which may have spaces: "Kxx [N s/m]".
_WORD = re.compile(r"[^\s\[(]+(?:[ \t]*[\[(][^\])]*[\])])?|\S+")
_LONGEST_LINE = 20_000
# Rows by which the separator is chosen.
_TRIED = 200


def sheet_of(text: str) -> Sheet:
    """Return the rows of a text that is not empty; raise ValueError where it is too large."""
    lines = [
        (number, line) for number, line in enumerate(text.splitlines(), start=1) if line.strip()
    ]
    if len(lines) > MOST_ROWS:
        raise ValueError(f"the file has more than {MOST_ROWS} lines")
    for number, line in lines:
        if len(line) > _LONGEST_LINE:
            raise ValueError(f"line {number}: has more than {_LONGEST_LINE} characters")
    split = _splitter([line for _, line in lines])
    rows = tuple(_row(number, line, split) for number, line in lines)
    if sum(len(row.cells) for row in rows) > MOST_CELLS:
        raise ValueError(f"the file has more than {MOST_CELLS} cells")
    return Sheet(rows)


def _row(number: int, line: str, split: _Split) -> Row:
    comment = line.lstrip()[0] in _MARKS
    try:
        cells = split(line.lstrip().lstrip(_MARKS) if comment else line)
    except csv.Error as error:
        raise ValueError(f"line {number}: no row of a table: {error}") from error
    if len(cells) > MOST_COLUMNS:
        raise ValueError(f"line {number}: has more than {MOST_COLUMNS} columns")
    return Row(number, tuple(cells), comment)


def _splitter(lines: Sequence[str]) -> _Split:
    """Return what splits lines into the most cells that are numbers.

    With decimal commas a comma between cells leaves half of them as numbers, a semicolon all.
    """
    splits: list[_Split] = [partial(_separated, mark) for mark in ";\t,"]
    splits.append(_words)
    tried = [line for line in lines if line.lstrip()[0] not in _MARKS][-_TRIED:] or lines[:_TRIED]
    # The first of those that are equal.
    return max(splits, key=lambda split: sum(_numbers(split, line) for line in tried))


def _words(line: str) -> list[str]:
    return cast("list[str]", _WORD.findall(line))


def _numbers(split: _Split, line: str) -> int:
    try:
        return sum(map(is_number, split(line)))
    except csv.Error:
        return 0


def _separated(mark: str, line: str) -> list[str]:
    return next(csv.reader([line], delimiter=mark, strict=True, skipinitialspace=True))
