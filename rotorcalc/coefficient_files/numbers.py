"""The numbers of a table in SI, each column's unit, and who says that it is that."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.batch.numbers import Mark
from rotorcalc.coefficient_files import units as known
from rotorcalc.coefficient_files.cells import Row, Sheet, is_empty, is_number, mark_of, value
from rotorcalc.coefficient_files.columns import (
    DAMPING,
    MASS,
    SHOWN,
    STIFFNESS,
    Header,
    Heading,
    header_of,
    quantity_of,
)
from rotorcalc.units import Unit, rpm

_LBF = {"stiffness": "lbf/in", "damping": "lbf·s/in"}


@dataclass(frozen=True)
class ReadColumn:
    """A column that was read: its key, its header, its unit, and who says so."""

    key: str
    header: str
    unit: str
    why: str


@dataclass
class Numbers:
    """The numbers of a table by their keys, shape (n,), in SI, in the order of the file."""

    rows: tuple[Row, ...]
    columns: tuple[ReadColumn, ...] = ()
    values: dict[str, Array] = field(default_factory=dict[str, Array])
    notes: list[str] = field(default_factory=list[str])
    warnings: list[str] = field(default_factory=list[str])


def numbers_of(sheet: Sheet, given: Mapping[str, str]) -> Numbers:
    """Return the numbers of a sheet; `given` has units for what names none.

    Raises
    ------
    ValueError
        Naming the cell that cannot be read.
    """
    header = header_of(sheet)
    below = sheet.rows[header.row + 1 :]
    unit_row = below[0] if header.row >= 0 and below and _has_words_alone(below[0]) else None
    read = Numbers(_rows(sheet, header, below), notes=list(sheet.notes))
    units = _units(sheet, header, unit_row, given)
    _check_named_alike(units)
    read.columns = tuple(
        ReadColumn(SHOWN[heading.key], heading.words, units[heading.key][0].name,
                   units[heading.key][1])
        for heading in header.headings.values()
        if heading.key not in MASS
    )  # fmt: skip
    _say(read, header, sheet, units)
    _fill(read, header, sheet, {key: unit for key, (unit, _) in units.items()})
    return read


# --- Rows -----------------------------------------------------------------------------------


def _rows(sheet: Sheet, header: Header, below: Sequence[Row]) -> tuple[Row, ...]:
    """Return the rows of the table: from the header on those with numbers in its columns."""
    places = [heading.place for heading in header.headings.values()]
    found: list[Row] = []
    for row in below:
        cells = [row.cells[place] for place in places if place < len(row.cells)]
        if row.comment or not any(map(is_number, cells)):
            _refuse_second(sheet, row)
            if not row.comment and found and _looks_broken(row, places):
                raise ValueError(f"{sheet.line(row)}: has no number in any column of the table")
            continue
        beyond = [cell for cell in row.cells[header.width :] if not is_empty(cell)]
        short = len(row.cells) < header.width
        if short or (beyond and sheet.shift is None and not header.unknown):
            raise ValueError(
                f"{sheet.line(row)}: has {len(row.cells)} cells, where the header has "
                f"{header.width}; with decimal commas separate the cells by semicolons"
            )
        found.append(row)
    if len(found) < 2:
        raise ValueError("the table needs at least two rows of numbers, at two speeds")
    return tuple(found)


def _looks_broken(row: Row, places: Sequence[int]) -> bool:
    """Return whether a row without numbers has something in every column: no remark."""
    return all(place < len(row.cells) and not is_empty(row.cells[place]) for place in places)


def _refuse_second(sheet: Sheet, row: Row) -> None:
    words = {str(cell).strip().lower() for cell in row.cells}
    if "kxx" in words:
        raise ValueError(f"{sheet.line(row)}: a second table begins; write one into a file")


def _has_words_alone(row: Row) -> bool:
    return not any(map(is_number, row.cells))


# --- Units ----------------------------------------------------------------------------------


def _units(
    sheet: Sheet, header: Header, unit_row: Row | None, given: Mapping[str, str]
) -> dict[str, tuple[Unit, str]]:
    """Return each column's unit and who says so."""
    marks = known.marks(cell for row in sheet.rows for cell in row.cells if isinstance(cell, str))
    dimensionless = "speed" not in header.headings
    # The words below a header are units where one of them is.
    if unit_row and not any(isinstance(cell, str) and known.is_unit(cell) and cell.strip() != "1"
                            for cell in unit_row.cells):  # fmt: skip
        unit_row = None
    return {
        key: _dimensionless(sheet, header, heading)
        if dimensionless and quantity_of(key) in ("stiffness", "damping")
        else _unit(sheet, header, heading, unit_row, given, marks)
        for key, heading in header.headings.items()
    }


def _dimensionless(sheet: Sheet, header: Header, heading: Heading) -> tuple[Unit, str]:
    if heading.unit and known.unit_of("number", heading.unit) is None:
        place = sheet.place(sheet.rows[header.row], heading.place)
        unknown = ", ".join(map(repr, header.unknown))[:200]
        others = f" (columns not known: {unknown})" if unknown else ""
        raise ValueError(
            f"{place}: {heading.words!r} names a unit, but there is no column of speed{others}; a "
            "table over a Sommerfeld number is dimensionless"
        )
    return Unit("-"), "over a Sommerfeld number"


def _unit(  # noqa: PLR0913, PLR0917 - all that may say a unit
    sheet: Sheet,
    header: Header,
    heading: Heading,
    unit_row: Row | None,
    given: Mapping[str, str],
    marks: Mapping[str, str],
) -> tuple[Unit, str]:
    quantity = quantity_of(heading.key)
    if quantity == "number":
        return Unit("-"), "a number"
    if heading.unit:
        place = sheet.place(sheet.rows[header.row], heading.place)
        return _named(quantity, heading.unit, place), "its header"
    if unit_row and heading.place < len(unit_row.cells):
        cell = unit_row.cells[heading.place]
        if not is_empty(cell):
            place = sheet.place(unit_row, heading.place)
            return _named(quantity, str(cell), place), f"{sheet.line(unit_row)}, below its header"
    if quantity in given:
        return _named(quantity, given[quantity], "units"), AS_GIVEN
    return _unsaid(quantity, heading, header, marks)


def _named(quantity: known.Quantity, spelling: str, place: str) -> Unit:
    unit = known.unit_of(quantity, spelling)
    if unit is None:
        raise ValueError(f"{place}: {known.wrong(quantity, spelling.strip())}")
    return unit


def _unsaid(
    quantity: known.Quantity, heading: Heading, header: Header, marks: Mapping[str, str]
) -> tuple[Unit, str]:
    """Return the unit of a column that has none: by ROSS's rule, else SI."""
    if quantity in _LBF and "lb" in marks:
        return _named(quantity, _LBF[quantity], ""), f"the file has {marks['lb'].strip()[:40]!r}"
    if quantity == "speed" and "rpm" in marks:
        return Unit("rpm", 1 / rpm, in_si=rpm), f"the file has {marks['rpm'].strip()[:40]!r}"
    if quantity == "speed" and header.row < 0:
        return Unit("rpm", 1 / rpm, in_si=rpm), _ASSUMED
    return Unit(known.SI_NAMES[quantity]), "" if heading.key == "attitude" else _ASSUMED


# Who says a unit that the reader's `units` names.
AS_GIVEN = "given as `units`"
_ASSUMED = "assumed: the file names none"


def _check_named_alike(units: Mapping[str, tuple[Unit, str]]) -> None:
    """Raise ValueError where a quantity's columns name a unit in part, and not the assumed one."""
    for key, (unit, why) in units.items():
        for other, (named, reason) in units.items():
            other_unit = named.name != unit.name and why == _ASSUMED != reason
            if other_unit and quantity_of(other) == quantity_of(key):
                raise ValueError(
                    f"{SHOWN[key]}: its column names no unit, and that of {SHOWN[other]} is in "
                    f"{named.name}: name the unit of each, or give it with the file"
                )


# --- Values ---------------------------------------------------------------------------------


def _say(
    read: Numbers, header: Header, sheet: Sheet, units: Mapping[str, tuple[Unit, str]]
) -> None:
    """Note what was assumed, and what was left out."""
    if header.row < 0:
        order = ", ".join(SHOWN[key] for key in header.headings)
        read.notes.append(f"No header: the columns are taken to be {order}.")
    assumed = {quantity_of(key): unit.name for key, (unit, why) in units.items() if why == _ASSUMED}
    if assumed:
        named = ", ".join(f"{quantity} in {name}" for quantity, name in assumed.items())
        read.warnings.append(f"The file names no unit for some columns. Assumed: {named}.")
    if header.unknown:
        read.notes.append(f"Columns not read: {', '.join(header.unknown)[:200]}.")
    last = read.rows[-1].number
    after = [row for row in sheet.rows if row.number > last]
    if after:
        read.notes.append(f"Not read: {len(after)} lines of words below the table.")


def _fill(read: Numbers, header: Header, sheet: Sheet, units: Mapping[str, Unit]) -> None:
    headings = dict(header.headings)
    masses = [headings.pop(key) for key in MASS if key in headings]
    mark = mark_of(
        row.cells[heading.place] for row in read.rows for heading in header.headings.values()
    )
    for key, heading in headings.items():
        read.values[key] = _column(read.rows, heading, sheet, mark, units[key])
    for heading in masses:
        if np.any(_column(read.rows, heading, sheet, mark, Unit("-"))):
            read.warnings.append(
                f"{SHOWN[heading.key]} is left out: a table here has no added mass."
            )
    _complete(read)
    _turn_degrees(read, units)


def _column(rows: Sequence[Row], heading: Heading, sheet: Sheet, mark: Mark, unit: Unit) -> Array:
    numbers: list[float] = []
    positive = heading.key in ("speed", "sommerfeld")
    for row in rows:
        try:
            number = unit.to_si(value(row.cells[heading.place], mark))
            if not np.isfinite(number):
                raise ValueError(f"{number}: must be finite")
            if positive and number <= 0.0:
                raise ValueError(f"{number:g}: must be positive")
            if heading.key == "eccentricity" and not 0.0 <= number < 1.0:
                raise ValueError(f"{number:g}: must be from 0 to below 1")
        except ValueError as error:
            place = sheet.place(row, heading.place, SHOWN[heading.key])
            raise ValueError(f"{place}: {error}") from error
        numbers.append(number)
    return np.array(numbers)


def _complete(read: Numbers) -> None:
    """Fill in what a table may leave out: as ROSS does, yy is xx, and cross terms are zero."""
    values = read.values
    if "speed" not in values and "sommerfeld" not in values:
        raise ValueError("the table has no column of speed, and none of a Sommerfeld number")
    for keys in (STIFFNESS, DAMPING):
        if keys[0] not in values:
            raise ValueError(f"the table has no column {keys[0]}")
        missing = [key for key in keys if key not in values]
        for key in missing:
            values[key] = values[keys[0]] if key == keys[3] else np.zeros(len(read.rows))
        if missing:
            read.notes.append(_left_out(keys, missing))


def _left_out(keys: Sequence[str], missing: Sequence[str]) -> str:
    """Return which coefficients a file leaves out, and what they are taken to be."""
    cross = [SHOWN[key] for key in missing if key != keys[3]]
    direct = [f"{SHOWN[keys[3]]} is {SHOWN[keys[0]]}"] if keys[3] in missing else []
    zero = [f"{' and '.join(cross)} {'is' if len(cross) == 1 else 'are'} zero"] if cross else []
    named = ", ".join(SHOWN[key] for key in missing)
    return f"Not in the file: {named}. As in ROSS, {', and '.join([*direct, *zero])}."


def _turn_degrees(read: Numbers, units: Mapping[str, Unit]) -> None:
    """Take attitude angles without a unit for degrees where they exceed a full turn in radians."""
    angles = read.values.get("attitude")
    if angles is not None and units["attitude"].name == "rad" and np.max(angles) > 2.0 * np.pi:
        read.values["attitude"] = np.radians(angles)
        read.columns = tuple(
            replace(column, unit="°", why="by its size")
            if column.key == SHOWN["attitude"]
            else column
            for column in read.columns
        )
