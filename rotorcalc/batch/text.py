"""The text of a table: its characters, its cells' separator, and its rows with their lines.

A file is untrusted: its size, its rows and their cells are bounded before anything is made of it.
"""

import csv
import io
from collections.abc import Iterable

_DELIMITERS = ";\t,"


def readable(text: str | bytes, *, most_bytes: int) -> str:
    """Return a file's text.

    Parameters
    ----------
    text : str or bytes
        Bytes are UTF-8, UTF-16 with its mark, or Windows-1252.
    most_bytes : int
        Its length at most.

    Returns
    -------
    str
        Without the mark of its encoding, and not empty.

    Raises
    ------
    ValueError
        Where it is empty, too long, or no text.
    """
    if len(text) > most_bytes:
        raise ValueError(f"the file has more than {most_bytes / 1e6:g} MB")
    words = text if isinstance(text, str) else _decoded(text)
    words = words.removeprefix("\ufeff")
    if "\0" in words:
        raise ValueError("the file has characters of code 0: it is no text")
    if not words.strip():
        raise ValueError("the file is empty")
    return words


def rows(text: str, *, most: int, things: str) -> Iterable[tuple[int, list[str]]]:
    """Yield the first line number and the cells of each row from the header on.

    Parameters
    ----------
    text : str
        A table with semicolons, tabs or commas between its cells.
    most : int
        Rows below the header at most.
    things : str
        What they are, for the message where there are more.

    Raises
    ------
    ValueError
        Where there is no header, there are more rows, the quotes of a row are wrong, or a cell is
        longer than the reader's 131072 characters.
    """
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=_delimiter(text), strict=True)
    count, before, begun = 0, 0, False
    try:
        for row in reader:
            first, before = before + 1, reader.line_num
            if not begun and not any(cell.strip() for cell in row):
                continue
            begun, count = True, count + 1
            if count > most + 1:
                raise ValueError(f"the file has more than {most} {things}")
            yield first, row
    except csv.Error as error:
        raise ValueError(f"line {reader.line_num}: no table: {error}") from error
    if not begun:
        raise ValueError("the file has no header: all its cells are empty")


def _decoded(raw: bytes) -> str:
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        encodings = ("utf-16",)
    else:
        encodings = ("utf-8-sig", "cp1252")
    for encoding in encodings:
        try:
            return raw.decode(encoding)
        except UnicodeDecodeError:
            continue
    raise ValueError("the file is no text in UTF-8, UTF-16 or Windows-1252")


def _delimiter(text: str) -> str:
    """Return what separates the cells of the header: units have none of these."""
    header = next(line for line in text.splitlines() if line.strip())
    return next((mark for mark in _DELIMITERS if mark in header), ",")
