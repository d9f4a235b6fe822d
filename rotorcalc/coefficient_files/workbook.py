"""A workbook's cells, read in a process of its own that has little memory and little time.

A few bytes of a workbook can name a cell a million rows down, for which a reader makes room. This
file is run by its path, so that it loads nothing of the package, reads the workbook from its input,
and writes JSON. No formula is run: a cell has the value that was saved with it.
"""

import io
import json
import sys
from itertools import islice
from typing import Any

_MEMORY, _SECONDS = 768_000_000, 10


def _bounded() -> None:
    try:
        import resource  # noqa: PLC0415 - not on Windows
    except ImportError:
        return
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (_SECONDS, _SECONDS))


def _plain(value: Any) -> str | float:
    """Return a number as one, and all else, a date for instance, as a text."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(value)
    return str(value)[:1000]


def _read(raw: bytes, wanted: str, most: tuple[int, int]) -> dict[str, Any]:
    import python_calamine  # noqa: PLC0415 - after the bounds are set

    rows, columns = most
    book = python_calamine.load_workbook(io.BytesIO(raw))  # pyright: ignore[reportUnknownMemberType]
    names = book.sheet_names
    if wanted and wanted not in names:
        return {"error": f"has no sheet {wanted[:80]!r}, only {', '.join(names)[:400]}"}
    for name in [wanted] if wanted else names:
        sheet = book.get_sheet_by_name(name)
        if sheet.start is None:
            continue
        if sheet.height > rows or sheet.width > columns:
            return {
                "error": f"sheet {name!r} has {sheet.height} rows and {sheet.width} columns, more "
                f"than {rows} or {columns}"
            }
        cells = sheet.to_python(skip_empty_area=True)
        found = [list(map(_plain, row)) for row in islice(cells, rows)]
        return {"names": names, "name": name, "start": sheet.start, "rows": found}
    return {"error": "has no cells"}


def main() -> None:
    """Write what is in the workbook of the input, or what is wrong with it, as JSON."""
    wanted, rows, columns = sys.argv[1:]
    _bounded()
    try:
        answer = _read(sys.stdin.buffer.read(), wanted, (int(rows), int(columns)))
    except ImportError:
        answer = {"missing": True}
    except MemoryError:
        answer = {"error": "needs too much memory"}
    except BaseException as error:  # noqa: BLE001 - the reader's panics are no Exception
        answer = {"error": f"is no workbook that can be read: {str(error)[:200]}"}
    sys.stdout.write(json.dumps(answer))


if __name__ == "__main__":
    main()
