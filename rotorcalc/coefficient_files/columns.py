"""Which column of a table is what, by its header."""

import re
from dataclasses import dataclass

from rotorcalc.coefficient_files.cells import Cell, Row, Sheet, is_empty, is_number
from rotorcalc.coefficient_files.units import Quantity, unit_of

ELEMENTS = ("xx", "xy", "yx", "yy")
STIFFNESS = tuple("k" + element for element in ELEMENTS)
DAMPING = tuple("c" + element for element in ELEMENTS)
MASS = tuple("m" + element for element in ELEMENTS)
NUMBERS = ("sommerfeld", "eccentricity", "attitude")
# How a key is shown.
SHOWN = {
    **{key: f"{key[0].upper()}_{key[1:]}" for key in (*STIFFNESS, *DAMPING, *MASS)},
    "speed": "speed", "sommerfeld": "S", "eccentricity": "ε", "attitude": "φ",
}  # fmt: skip

_DIGITS: dict[str, str] = {"11": "xx", "12": "xy", "21": "yx", "22": "yy"}
_NAMES: dict[str, str] = {
    **dict.fromkeys(
        ("speed", "frequency", "freq", "omega", "ω", "ω̄", "n", "rpm", "hz", "rad/s", "w",
         "runningspeed", "rotorspeed", "shaftspeed", "rotationalspeed", "speedrpm", "speedrad/s",
         "rotorspeedrpm", "runningspeedω", "krpm"), "speed"),
    **dict.fromkeys(("s", "so", "σ", "sigma", "sommerfeld", "sommerfeldnumber"), "sommerfeld"),
    **dict.fromkeys(
        ("ε", "e", "eps", "epsilon", "eccentricity", "eccentricityratio", "ecc"), "eccentricity"),
    **dict.fromkeys(
        ("φ", "ϕ", "phi", "attitude", "attitudeangle", "fi"), "attitude"),
}  # fmt: skip
_LETTERS = {"k": "k", "c": "c", "b": "c", "m": "m", "stiffnessk": "k", "dampingc": "c"}
_HEADER = re.compile(r"(.*?)\s*[\[(]([^\])]*)[\])]\s*", re.DOTALL)


@dataclass(frozen=True)
class Heading:
    """A column: its place in the rows, its key, its words, and the unit that these name, or ""."""

    place: int
    key: str
    words: str
    unit: str = ""


@dataclass(frozen=True)
class Header:
    """The columns of a table, and where its numbers begin."""

    headings: dict[str, Heading]
    # Index of the row of the header; −1 where there is none.
    row: int
    unknown: tuple[str, ...] = ()

    @property
    def width(self) -> int:
        """How many cells a row needs."""
        return 1 + max(heading.place for heading in self.headings.values())


def quantity_of(key: str) -> Quantity:
    """Return what a column's numbers are."""
    if key in STIFFNESS:
        return "stiffness"
    if key in DAMPING:
        return "damping"
    known: dict[str, Quantity] = {"speed": "speed", "attitude": "angle"}
    return known.get(key, "number")


def header_of(sheet: Sheet) -> Header:
    """Return the columns of a sheet; raise ValueError where it has no table."""
    for index, row in enumerate(sheet.rows):
        if any(_key(cell)[0] == "kxx" for cell in row.cells):
            return _named(sheet, index)
    for row in sheet.rows:
        numbers = [place for place, cell in enumerate(row.cells) if not is_empty(cell)]
        if not row.comment and numbers and all(is_number(row.cells[place]) for place in numbers):
            return _unnamed(sheet, row, numbers)
    raise ValueError(
        "no table found: it needs a header with kxx, kxy, kyx, kyy, cxx, cxy, cyx, cyy and speed, "
        "or rows of nine numbers, speed and these eight"
    )


def _named(sheet: Sheet, index: int) -> Header:
    row = sheet.rows[index]
    headings: dict[str, Heading] = {}
    unknown: list[str] = []
    for place, cell in enumerate(row.cells):
        key, unit = _key(cell)
        words = str(cell).strip()[:40]
        if key in headings:
            raise ValueError(f"{sheet.place(row, place)}: {words!r} is a second column of this")
        if key:
            headings[key] = Heading(place, key, words, unit)
        elif words:
            unknown.append(words)
    return Header(headings, index, tuple(unknown))


def _unnamed(sheet: Sheet, row: Row, places: list[int]) -> Header:
    """Return the columns of a table without header by their number."""
    orders = {9: ("speed",), 11: NUMBERS}
    if len(places) not in orders:
        raise ValueError(
            f"{sheet.line(row)}: has {len(places)} numbers and no header above; without one there "
            "must be 9, speed and eight coefficients, or 11, S, ε, φ and eight"
        )
    keys = (*orders[len(places)], *STIFFNESS, *DAMPING)
    headings = {key: Heading(place, key, "") for key, place in zip(keys, places, strict=True)}
    return Header(headings, -1)


def _key(cell: Cell) -> tuple[str, str]:
    """Return key and unit of a header's cell, "" for what it does not name."""
    if not isinstance(cell, str) or len(cell) > 100:
        return "", ""
    text = cell.strip()
    bracketed = _HEADER.fullmatch(text)
    if bracketed:
        return _plain(bracketed[1]), bracketed[2].strip()
    if key := _plain(text):
        alone = text.lower().replace("_", " ").split()[-1]
        named = unit_of("speed", alone) if key == "speed" else None
        return key, "" if named is None else alone
    # "Kxx, N/m" and "Kxx N/m"
    name, _, unit = re.sub(r"\s*,\s*|\s+", " ", text).partition(" ")
    key = _plain(name)
    return (key, unit) if key and unit_of(quantity_of(key), unit) else ("", "")


def _plain(name: str) -> str:
    """Return a column's key by its name, "" where it has none."""
    word = re.sub(r"[\s_{}|*\-−]|\\(?=\w)", "", name).lower()
    if word in _NAMES:
        return _NAMES[word]
    letter, element = _LETTERS.get(word[:-2], ""), word[-2:]
    element = _DIGITS.get(element, element)
    return letter + element if letter and element in ELEMENTS else ""
