"""Results as text: CSV, JSON, or a report to read.

A text that a spreadsheet would run as a formula, as it begins with =, +, - or @, is written behind
an apostrophe: names come from files, and those from anywhere.
"""

import csv
import io
import json
import math
from collections.abc import Mapping, Sequence

from rotorcalc.arguments import checked
from rotorcalc.batch.results import Value

_FORMULAS = ("=", "+", "-", "@", "\t", "\r")
# Letters of the widest name in a report.
_WIDTH = 44


@checked
def to_csv(columns: Mapping[str, Sequence[Value]]) -> str:
    """Return a table as CSV: a comma, a decimal point, lines as RFC 4180 has them.

    Parameters
    ----------
    columns : mapping of str to sequence
        As `table` returns them.

    Returns
    -------
    str
        A cell without a value is empty; numbers have all their digits.
    """
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(map(_safe, columns))
    writer.writerows([_cell(value) for value in row] for row in _rows(columns))
    return text.getvalue()


@checked
def to_json(columns: Mapping[str, Sequence[Value]]) -> str:
    """Return a table as a JSON list of objects; no value is null, infinity the text "inf"."""
    records = [
        {name: _json_value(value) for name, value in zip(columns, row, strict=True)}
        for row in _rows(columns)
    ]
    return json.dumps(records, indent=1, allow_nan=False, ensure_ascii=False) + "\n"


@checked
def to_report(columns: Mapping[str, Sequence[Value]]) -> str:
    """Return a table as a report: a paragraph for each machine, a line for each value."""
    return "\n".join(
        "\n".join(_paragraph(dict(zip(columns, row, strict=True)))) for row in _rows(columns)
    )


def _paragraph(row: Mapping[str, Value]) -> list[str]:
    title = f"line {row['line']}" + (f": {row['name']}" if row["name"] else "")
    lines = [title, "-" * len(title)]
    for name, value in row.items():
        if name in ("line", "name", "validity", "problem") or value in ("", None) or _is_nan(value):
            continue
        quantity, _, unit = name.partition(" [")
        lines.append(f"{quantity:{_WIDTH}} {value:>14.6g} {unit.rstrip(']')}")
    if row["validity"]:
        lines.append(f"validity: {row['validity']}")
    if row["problem"]:
        lines.append(f"problem: {row['problem']}")
    return [*lines, ""]


def _rows(columns: Mapping[str, Sequence[Value]]) -> Sequence[tuple[Value, ...]]:
    return list(zip(*columns.values(), strict=True))


def _is_nan(value: Value) -> bool:
    return isinstance(value, float) and math.isnan(value)


def _cell(value: Value) -> str:
    if isinstance(value, str):
        return _safe(value)
    return "" if _is_nan(value) else repr(value)


def _safe(text: str) -> str:
    return f"'{text}" if text.startswith(_FORMULAS) else text


def _json_value(value: Value) -> Value | None:
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else str(value)
    return value


FORMATS = {"csv": to_csv, "json": to_json, "report": to_report}
