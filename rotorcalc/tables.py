"""Results as tables: one row per speed, one column per number, the unit in the column's name.

Vectors and matrices take one column per element, phasors an amplitude and a phase lag, as they are
measured. Units are those of the record's docstring.
"""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.display import Result, units
from rotorcalc.unbalance_response import phase_lag

if TYPE_CHECKING:
    import pandas as pd  # pyright: ignore[reportMissingTypeStubs]


def dataframe(columns: dict[str, Array]) -> "pd.DataFrame":
    """Return columns of numbers as a pandas table; pandas is imported only here.

    Raises
    ------
    ImportError
        Where pandas is not installed.
    """
    try:
        # Imported on use: pandas is optional, and slow to import.
        import pandas as pd  # noqa: PLC0415 # pyright: ignore[reportMissingTypeStubs]
    except ImportError as error:
        raise ImportError("to_dataframe needs pandas: pip install pandas") from error
    return pd.DataFrame(columns)


def columns(result: Result, *, rows: int) -> dict[str, Array]:
    """Return the arrays of a result as columns.

    Parameters
    ----------
    result : Result
        A record whose arrays have the leading shape (rows,), or none where there is one row.
    rows : int
        The number of rows.

    Returns
    -------
    dict of str to array, (rows,)
        "speed [rad/s]", "stiffness_XY [N/m]" and so on, in the order of the fields.
    """
    return {
        f"{name} [{end}]": column
        for field, unit in units(type(result)).items()
        if (value := _numbers(getattr(result, field))) is not None
        for name, end, column in _elements(field, unit, _in_rows(value, rows))
    }


def _in_rows(value: Array, rows: int) -> Array:
    # Without any row the number of elements is not to be had from the size.
    return value.reshape(rows, -1 if rows else math.prod(value.shape[1:]))


def eigenvalue_columns(branches: ComplexArray) -> dict[str, Array]:
    """Return eigenvalues, (rows, m), as columns: growth rate and frequency of each."""
    return {
        f"eigenvalue_{i}_{part} [{unit}]": column
        for i, branch in enumerate(branches.T, start=1)
        for part, unit, column in (("real", "1/s", branch.real), ("imag", "rad/s", branch.imag))
    }


def _numbers(value: object) -> Array | None:
    """Return a field as an array, or None where it is not one."""
    return cast("Array", value) if isinstance(value, np.ndarray | np.generic) else None


def _elements(
    name: str, unit: str, values: Array | ComplexArray
) -> Iterator[tuple[str, str, Array]]:
    """Yield name, unit and values of each element of a scalar, vector or matrix, (rows, k)."""
    # Scalar, vector and 2 × 2 matrix are told apart by their number of elements.
    ends = {1: [""], 2: ["_X", "_Y"], 4: ["_XX", "_XY", "_YX", "_YY"]}[values.shape[1]]
    if not np.iscomplexobj(values):
        yield from ((name + end, unit, column) for end, column in zip(ends, values.T, strict=True))
        return
    amplitude = np.abs(values)
    lag = np.where(amplitude > 0.0, phase_lag(values), np.nan)  # a body at rest has no phase
    for end, size, angle in zip(ends, amplitude.T, lag.T, strict=True):
        yield f"{name}{end}_amplitude", unit, size
        yield f"{name}{end}_lag", "rad", angle
