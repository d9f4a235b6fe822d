"""Numbers as people write them: with a decimal point or a decimal comma, never both in one file.

"1,234" may be either; it is read where other numbers of the file tell, and refused where none does.
"""

import math
import re
from collections.abc import Iterable
from typing import Literal, TypeAlias

Mark: TypeAlias = Literal[".", ",", ""]

_POINT = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,4})?", re.ASCII)
_COMMA = re.compile(r"[+-]?(\d+,?\d*|,\d+)([eE][+-]?\d{1,4})?", re.ASCII)
# Groups of three digits, of which the first does not begin with zero: perhaps thousands.
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(,\d{3})+", re.ASCII)
# Characters of a number at most; the smallest and largest have 330 digits when written in full.
LONGEST = 400
INFINITE = ("inf", "infinite", "rigid", "∞")


def decimal_mark(cells: Iterable[str]) -> Mark:
    """Return the decimal mark of a file, "" where its numbers leave it open.

    Parameters
    ----------
    cells : iterable of str
        The file's cells of numbers.

    Returns
    -------
    ".", "," or ""
        What most numbers have that can be read in one way only.
    """
    given = [cell.strip() for cell in cells if len(cell) <= LONGEST]
    points = sum("." in cell and bool(_POINT.fullmatch(cell)) for cell in given)
    commas = [cell for cell in given if "," in cell and _COMMA.fullmatch(cell)]
    sure = sum(not _THOUSANDS.fullmatch(cell) for cell in commas)
    if sure > points:
        return ","
    return "" if commas and not points else "."


def number(cell: str, mark: Mark, *, infinite: bool) -> float:
    """Return a cell's number.

    Parameters
    ----------
    cell : str
        Not empty.
    mark : ".", "," or ""
        The file's decimal mark.
    infinite : bool
        Whether "inf" is one.

    Returns
    -------
    float
        Its value.

    Raises
    ------
    ValueError
        Where it is no number, or could be two.
    """
    text = cell.strip().replace("\u2212", "-")
    if infinite and text.lower() in INFINITE:
        return math.inf
    shown = repr(text[:40])
    if text[:1] in ("=", "@"):
        raise ValueError(f"{shown} is a formula, which is not run; write its value")
    if len(text) > LONGEST:
        raise ValueError(f"{shown} is no number, with {len(text)} characters")
    if "," in text and _COMMA.fullmatch(text):
        return _with_comma(text, mark)
    if not _POINT.fullmatch(text):
        raise ValueError(f"{shown} is no number")
    if "." in text and mark == ",":
        raise ValueError(f"{shown} has a point, where other numbers of the file have a comma")
    return _finite(float(text), shown)


def _with_comma(text: str, mark: Mark) -> float:
    shown = repr(text[:40])
    if mark == ",":
        return _finite(float(text.replace(",", ".")), shown)
    if mark == ".":
        raise ValueError(f"{shown} has a comma, where other numbers of the file have a point")
    raise ValueError(
        f"{shown} may have a decimal comma or one of thousands; write {text.replace(',', '')} or "
        f"{text.replace(',', '.', 1)}"
    )


def _finite(value: float, shown: str) -> float:
    if math.isinf(value):
        raise ValueError(f"{shown} is too large for a number")
    return value
