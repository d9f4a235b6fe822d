"""A bearing's own coefficients among the kept values: the table as one text.

The text has every number to the last bit, so that files, links, cases and undo carry a table as
they carry a word. A link has it up to a length that browsers and mail take.
"""

import base64
import binascii
from functools import lru_cache
from typing import Any

import numpy as np

from rotorcalc import CoefficientTable
from rotorcalc.units import Units
from ui.bores import Value

# Its key among the kept values.
TABLE = "table"
# Speed, K and C of a row.
_NUMBERS = 9
# Characters of a table in a link, some forty rows; and what a longer one has in its place.
MOST_IN_LINK, TOO_LONG = 4000, "in-file"
LEFT_OUT = (
    "these coefficients have more rows than a link carries; load the machine's file (JSON) instead"
)
OF_OIL = (
    "Oil and film temperature change nothing here: own coefficients are those of the oil, the "
    "temperature and the load that they were computed or measured with."
)


def text_of(table: CoefficientTable) -> str:
    """Return a table as text."""
    rows = [np.array(rows).reshape(len(table.speed), -1) for rows in
            (table.speed, table.stiffness, table.damping)]  # fmt: skip
    numbers = np.concatenate(rows, axis=1).astype("<f8")
    return base64.urlsafe_b64encode(numbers.tobytes()).decode()


@lru_cache(maxsize=64)
def table_of(text: str) -> CoefficientTable:
    """Return the table of a text, or raise ValueError."""
    if text == TOO_LONG:
        raise ValueError(LEFT_OUT)
    try:
        raw = base64.b64decode(text.encode("ascii"), altchars=b"-_", validate=True)
        numbers = np.frombuffer(raw, dtype="<f8").reshape(-1, _NUMBERS)
    except (UnicodeEncodeError, binascii.Error, ValueError):
        raise ValueError("is no table of coefficients") from None
    K, C = numbers[:, 1:5].reshape(-1, 2, 2), numbers[:, 5:].reshape(-1, 2, 2)
    fields: dict[str, Any] = {"speed": numbers[:, 0], "stiffness": K, "damping": C}
    return CoefficientTable(**fields)


def in_link(text: str) -> str:
    """Return a kept text as a link has it: a table that is too long for one is left out."""
    return text if len(text) <= MOST_IN_LINK else TOO_LONG


def described(table: CoefficientTable, units: Units) -> str:
    """Return in words how many rows a table has, and between which speeds."""
    first, last = (f"{float(units.speed.of(end)):.6g}" for end in (table.first, table.last))
    return f"{len(table.speed)} rows, {first} to {last} {units.speed.name}"


@lru_cache(maxsize=64)
def speeds_within(text: str) -> tuple[float, float]:
    """Return the ends of a table [rpm], six digits that lie within it."""
    table = table_of(text)
    low, high = (end * 30.0 / np.pi for end in (table.first, table.last))
    steps = [10.0 ** (np.floor(np.log10(end)) - 5.0) for end in (low, high)]
    inside = np.ceil(low / steps[0]) * steps[0], np.floor(high / steps[1]) * steps[1]
    low, high = (float(f"{one:.6g}") for one in inside)
    return low, high


def rows_of(value: Value) -> CoefficientTable:
    """Return the table of a kept value, or raise ValueError where there is none."""
    if not isinstance(value, str):
        raise ValueError(
            "Own coefficients: the table of stiffness and damping is missing; load the machine's "
            "file (JSON), or choose another bearing"
        )
    return table_of(value)
