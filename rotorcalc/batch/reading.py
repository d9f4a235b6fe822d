"""Machines from a file: JSON, one machine or a list, or a table with one machine a line.

A file is read as data: formulas are refused, and its size and number of cells are bounded. What is
wrong on one line costs that line alone; it is named with its line and column, and what is right is
read all the same. What is wrong with the file as a whole, its header for instance, is an error.
"""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, cast

from rotorcalc.arguments import checked
from rotorcalc.arrays import shown
from rotorcalc.batch.columns import KIND, KIND_PATH, OWN, Column, column_of
from rotorcalc.batch.numbers import Mark, decimal_mark, number
from rotorcalc.batch.text import readable, rows
from rotorcalc.machine import APP, Machine
from rotorcalc.oils import iso_oil
from rotorcalc.records import from_tree, parsed_value, to_tree
from rotorcalc.units import rpm
from rotorcalc.working_point import load_for, stiffness_for

MOST_BYTES, MOST_MACHINES, MOST_COLUMNS, MOST_LETTERS = 20_000_000, 100_000, 200, 1000
# With Walther's law an oil is its grade at every temperature, whatever the reference.
_REFERENCE = 40.0
_LOADS = ("eccentricity_ratio", "sommerfeld", "classical_sommerfeld")


@dataclass(frozen=True)
class Case:
    """A machine of a file.

    Attributes
    ----------
    line : int
        Of a table, or the number of a machine in JSON, from 1.
    name : str
        The user's, or "".
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s]; NaN where the file has none.
    """

    line: int
    name: str
    machine: Machine
    speed: float


@dataclass(frozen=True)
class Problem:
    """What is wrong on a line of a file.

    Attributes
    ----------
    line : int
        As of a `Case`.
    column : str
        Its header, or "" where it is the line's as a whole.
    words : str
        What is wrong.
    name : str
        The machine's, where it has one.
    """

    line: int
    column: str
    words: str
    name: str = ""

    def __str__(self) -> str:
        """Return line, column and words."""
        place = f"line {self.line}" + (f", column {self.column}" if self.column else "")
        return f"{place}: {self.words}"


@dataclass(frozen=True)
class MachineFile:
    """What a file holds: machines, and the problems of lines that are none."""

    cases: tuple[Case, ...]
    problems: tuple[Problem, ...]


class _ProblemError(ValueError):
    """A wrong cell, with its column."""

    def __init__(self, column: str, words: str) -> None:
        super().__init__(words)
        self.column = column


@checked
def read_machines(text: str | bytes, base: Machine | None = None) -> MachineFile:
    """Return the machines of a file.

    Parameters
    ----------
    text : str or bytes
        JSON as `Machine.to_json` writes it, one or a list of them, or a table with commas,
        semicolons or tabs, whose first line names columns and units: "radial_clearance [µm]". Bytes
        are UTF-8, UTF-16 with its mark, or Windows-1252.
    base : Machine, optional
        Has the values of inputs that a table has no column for, or an empty cell; otherwise these
        are at their defaults.

    Returns
    -------
    MachineFile
        Machines and problems, in the order of the lines.

    Raises
    ------
    ValueError
        Where the file is empty, too large, or its header or JSON cannot be read.
    """
    words = readable(text, most_bytes=MOST_BYTES)
    is_json = words.lstrip()[0] in "{["
    return _from_json(words) if is_json else _from_table(words, base)


# --- JSON -----------------------------------------------------------------------------------


def _from_json(text: str) -> MachineFile:
    document = parsed_value(text)
    listed = cast("list[object]", document) if isinstance(document, list) else [document]
    if len(listed) > MOST_MACHINES:
        raise ValueError(f"the file has more than {MOST_MACHINES} machines")
    cases: list[Case] = []
    problems: list[Problem] = []
    for place, one in enumerate(listed, start=1):
        try:
            cases.append(_of_document(place, one))
        except ValueError as error:
            problems.append(Problem(place, "", str(error)))
    return MachineFile(tuple(cases), tuple(problems))


def _of_document(place: int, document: object) -> Case:
    if not isinstance(document, Mapping):
        raise ValueError(f"machine = {shown(document)}: must be a JSON object")
    tree = cast("Mapping[str, Any]", document)
    app = tree.get(APP, {})
    app = cast("Mapping[str, Any]", app if isinstance(app, Mapping) else {})
    try:
        # Exact, as floats are written with all their digits.
        machine = Machine.from_json(json.dumps(tree))
    except RecursionError as error:
        raise ValueError(f"no JSON text of a machine: {error}") from error
    given = app.get("rpm", math.nan)
    if isinstance(given, bool) or not isinstance(given, float) or given <= 0.0:
        raise ValueError(f"app.rpm = {shown(given)}: must be a positive number")
    return Case(place, str(app.get("name", ""))[:MOST_LETTERS], machine, given * rpm)


# --- Tables ---------------------------------------------------------------------------------


def _from_table(text: str, base: Machine | None) -> MachineFile:
    lines = list(rows(text, most=MOST_MACHINES, things="machines"))
    header = lines[0][1]
    if len(header) > MOST_COLUMNS:
        raise ValueError(f"the header has more than {MOST_COLUMNS} columns")
    columns = _columns(header)
    filled = [(line, row) for line, row in lines[1:] if any(cell.strip() for cell in row)]
    mark = decimal_mark(
        cell for _, row in filled for column, cell in zip(columns, row, strict=False) if column.unit
    )
    cases: list[Case] = []
    problems: list[Problem] = []
    for line, row in filled:
        try:
            cases.append(_of_row(line, _cells(columns, row, mark), base))
        except _ProblemError as error:
            problems.append(Problem(line, error.column, str(error), _name(columns, row)))
        except (ValueError, RuntimeError) as error:
            column = _blamed(str(error), columns)
            problems.append(Problem(line, column, str(error), _name(columns, row)))
    return MachineFile(tuple(cases), tuple(problems))


def _columns(header: Sequence[str]) -> list[Column]:
    columns: list[Column] = []
    for place, cell in enumerate(header, start=1):
        try:
            columns.append(column_of(cell))
        except ValueError as error:
            raise ValueError(f"header, column {place}: {error}") from error
    seen: set[tuple[str, ...]] = set()
    for column in columns:
        path = KIND_PATH if column.path == (KIND,) else column.path
        if path in seen:
            raise ValueError(f"header: {'.'.join(path)!r} has two columns")
        seen.add(path)
    return columns


def _cells(
    columns: Sequence[Column], row: Sequence[str], mark: Mark
) -> dict[tuple[str, ...], str | float]:
    """Return the values of a row by their path; empty cells have none."""
    beyond = [cell for cell in row[len(columns) :] if cell.strip()]
    if len(row) < len(columns) or beyond:
        raise ValueError(f"has {len(row)} cells, the header {len(columns)}")
    values: dict[tuple[str, ...], str | float] = {}
    for column, cell in zip(columns, row, strict=False):
        text = cell.strip()
        if len(text) > MOST_LETTERS:
            raise _ProblemError(column.header, f"has more than {MOST_LETTERS} characters")
        if text:
            values[column.path] = _value(column, text, mark)
    return values


def _value(column: Column, text: str, mark: Mark) -> str | float:
    if column.unit is None:
        return text
    try:
        reading = number(text, mark, infinite=column.infinite)
    except ValueError as error:
        raise _ProblemError(column.header, str(error)) from error
    return float(column.unit.to_si(reading))


def _of_row(line: int, values: dict[tuple[str, ...], str | float], base: Machine | None) -> Case:
    """Return the machine of a row."""
    own = {name: values.pop((name,)) for name in OWN if (name,) in values}
    machine = _machine(values, own, base)
    speed = float(own.get("speed", math.nan))
    if speed <= 0.0:
        raise ValueError(f"speed = {speed:g} rad/s: must be positive")
    if "natural_frequency" in own:
        _not_both("natural_frequency", "shaft_stiffness", ("rotor", "shaft_stiffness") in values)
        K = stiffness_for(machine, natural_frequency=float(own["natural_frequency"]))
        machine = replace(machine, rotor=replace(machine.rotor, shaft_stiffness=K))
    known = {name: float(own[name]) for name in _LOADS if name in own}
    if known:
        _not_both(next(iter(known)), "load", ("load",) in values)
        if math.isnan(speed):
            raise ValueError(f"{next(iter(known))}: needs a running speed, a column 'speed [rpm]'")
        machine = replace(machine, load=load_for(machine, speed, **known))
    return Case(line, str(own.get("name", "")), machine, speed)


def _machine(
    values: Mapping[tuple[str, ...], str | float], own: Mapping[str, object], base: Machine | None
) -> Machine:
    tree: dict[str, Any] = {} if base is None else cast("dict[str, Any]", to_tree(base))
    for name in ("oil", "bearing", "rotor"):
        tree.setdefault(name, {})
    kind = own.get(KIND, values.get(KIND_PATH))
    if kind is not None and kind != tree["bearing"].get("geometry", {}).get("type", "plain"):
        tree["bearing"]["geometry"] = {"type": kind}
    if "oil" in own:
        tree["oil"] = to_tree(iso_oil(str(own["oil"]), temperature=_REFERENCE, law="walther"))
    for path, value in values.items():
        if path == KIND_PATH:
            continue
        below = tree
        for name in path[:-1]:
            below = below.setdefault(name, {"type": "plain"} if name == "geometry" else {})
        below[path[-1]] = "inf" if value == math.inf else value
    return from_tree(Machine, tree, where="")


def _not_both(one: str, other: str, given: bool) -> None:
    if given:
        raise ValueError(f"{one}: given beside {other}; leave out one of them")


def _blamed(words: str, columns: Sequence[Column]) -> str:
    """Return the header of the column whose field a message begins with, or ""."""
    field = words.split(maxsplit=1)[0].rstrip(":").split(".")[-1] if words.strip() else ""
    return next((one.header for one in columns if one.path[-1] == field), "")


def _name(columns: Sequence[Column], row: Sequence[str]) -> str:
    for column, cell in zip(columns, row, strict=False):
        if column.path == ("name",):
            return cell.strip()[:MOST_LETTERS]
    return ""
