"""A workbook, xls or xlsx, as rows of cells: read by python-calamine, in another process."""

import io
import json
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any, cast

from rotorcalc.coefficient_files.cells import (
    MOST_CELLS,
    MOST_COLUMNS,
    MOST_ROWS,
    Row,
    Sheet,
    is_empty,
)

_PROGRAM = Path(__file__).with_name("workbook.py")
_XLS, _XLSX = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", b"PK\x03\x04"
_SECONDS, _MOST_EXPANDED = 30.0, 50_000_000


def is_workbook(raw: bytes) -> bool:
    """Return whether bytes begin as a workbook's do."""
    return raw.startswith((_XLS, _XLSX))


def sheet_of(raw: bytes, name: str) -> Sheet:
    """Return the rows of a workbook's sheet; "" for the first one with cells in it."""
    if raw.startswith(_XLSX):
        _check_size(raw)
    answer = _answer(raw, name)
    if answer.get("missing"):
        raise ValueError("Excel files need python-calamine: pip install 'rotorcalc[files]'")
    if "error" in answer:
        raise ValueError(f"the workbook {answer['error']}")
    down, right = answer["start"]
    rows = tuple(
        Row(number, tuple(cells))
        for number, cells in enumerate(answer["rows"], start=down + 1)
        if not all(map(is_empty, cells))
    )
    if sum(len(row.cells) for row in rows) > MOST_CELLS:
        raise ValueError(f"the sheet has more than {MOST_CELLS} cells")
    others = [other for other in answer["names"] if other != answer["name"]]
    note = f"Sheet {answer['name'][:80]!r}"
    note += f"; not read: {', '.join(others)[:200]}." if others else "."
    return Sheet(rows, shift=right, notes=(note,))


def _check_size(raw: bytes) -> None:
    try:
        with zipfile.ZipFile(io.BytesIO(raw)) as package:
            size = sum(part.file_size for part in package.infolist())
    except Exception as error:
        raise ValueError(f"the file is no workbook: {error}") from error
    if size > _MOST_EXPANDED:
        raise ValueError(f"the workbook expands to more than {_MOST_EXPANDED / 1e6:g} MB")


def _answer(raw: bytes, name: str) -> dict[str, Any]:
    # -I: neither the folder nor the surroundings decide what is imported.
    command = [sys.executable, "-I", str(_PROGRAM), name, str(MOST_ROWS), str(MOST_COLUMNS)]
    try:
        done = subprocess.run(  # noqa: S603 - our own program; the name is an argument to it alone
            command, input=raw, capture_output=True, timeout=_SECONDS, check=True
        )
        return cast("dict[str, Any]", json.loads(done.stdout))
    except subprocess.TimeoutExpired as error:
        raise ValueError(f"the workbook takes more than {_SECONDS:g} s to read") from error
    except (subprocess.CalledProcessError, json.JSONDecodeError) as error:
        raise ValueError("the workbook needs too much memory or time to read") from error
