"""Reading of force coefficients from a file, into the program's axes, with what was taken for what.

The formats: ROSS's tables, xls, xlsx or CSV with a header from kxx to cyy and speed in any order;
texts of speed and eight columns with spaces, tabs, semicolons or commas; and the dimensionless
tables of handbooks. A unit is the header's, else that of a row below it, else ROSS's rule holds: a
cell that names pounds or inches makes all K lbf/in and all C lbf·s/in, one that names rpm the
speeds. What no one says is SI, and said to be so.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias, cast

import numpy as np

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, IntArray, shown
from rotorcalc.batch.text import readable
from rotorcalc.coefficient_files import excel, texts
from rotorcalc.coefficient_files.axes import OWN_AXES, Axes, said_axes
from rotorcalc.coefficient_files.cells import MOST_BYTES, Sheet
from rotorcalc.coefficient_files.columns import DAMPING, NUMBERS, STIFFNESS
from rotorcalc.coefficient_files.doubts import doubts
from rotorcalc.coefficient_files.handbooks import Scale, doubt
from rotorcalc.coefficient_files.numbers import Numbers, ReadColumn, numbers_of
from rotorcalc.coefficient_table import CoefficientTable

Matrices: TypeAlias = tuple[tuple[tuple[float, ...], ...], ...]

__all__ = ["ReadColumn", "ReadTable", "read_coefficients"]


@dataclass(frozen=True, eq=False)
class ReadTable:
    """What a file holds, in the program's axes X, Y.

    Attributes
    ----------
    speed : array, (n,)
        Running speeds, Ω [rad/s], in rising order.
    stiffness, damping : array, (n, 2, 2)
        K [N/m] and C [N·s/m] of one bearing.
    lines : tuple of int, (n,)
        The line, or row of the sheet, of each speed.
    columns : tuple of ReadColumn
        Each column that was read, its unit, and who says so.
    kind : str
        "over speed" or "dimensionless".
    sommerfeld, eccentricity_ratio, attitude_angle : array, (n,), or None
        Of a dimensionless table, where it has them; the angle in rad.
    notes : tuple of str
        What was assumed or left out.
    warnings : tuple of str
        What looks wrong.
    said_axes : (str, str) or None
        Load axis and sense of rotation, where the file says them.
    """

    speed: Array
    stiffness: Array
    damping: Array
    lines: tuple[int, ...]
    columns: tuple[ReadColumn, ...]
    kind: str
    sommerfeld: Array | None
    eccentricity_ratio: Array | None
    attitude_angle: Array | None
    notes: tuple[str, ...]
    warnings: tuple[str, ...]
    said_axes: tuple[str, str] | None

    @property
    def table(self) -> CoefficientTable:
        """The coefficients as a machine's bearing: `Machine(bearing=read.table, …)`."""
        # Lists become tuples there.
        return CoefficientTable(
            speed=cast("tuple[float, ...]", self.speed.tolist()),
            stiffness=cast("Matrices", self.stiffness.tolist()),
            damping=cast("Matrices", self.damping.tolist()),
        )


@checked
def read_coefficients(  # noqa: PLR0913 - what a file cannot say of itself
    source: bytes | str | Path,
    *,
    load_axis: str | None = None,
    turns: str | None = None,
    units: Mapping[str, str] | None = None,
    scale: Scale | None = None,
    sheet: str = "",
) -> ReadTable:
    """Return the force coefficients of a file, over speed.

    Parameters
    ----------
    source : bytes, str or Path
        The file, a text of it with its line ends, or its path.
    load_axis : "+x", "-x", "+y" or "-y", optional
        The axis of the file along which the static load acts. ROSS's tables usually have "-y".
    turns : "x to y" or "y to x", optional
        The sense in which the shaft turns in the file's axes. Without these two they are what the
        file says in the words of `written`, else "+x" and "x to y": the program's own axes.
    units : mapping of str to str, optional
        Units for "speed", "stiffness" and "damping" where the file names none.
    scale : Scale, optional
        Bearing, oil and load; needed by a dimensionless table.
    sheet : str
        Name of a workbook's sheet; "" for the first one that is not empty.

    Returns
    -------
    ReadTable
        The coefficients in the program's axes, and how they were read.

    Raises
    ------
    ValueError
        Where the file cannot be read; it names line and column, or the cell.

    Examples
    --------
    >>> text = '''rpm Kxx Kxy Kyx Kyy Cxx Cxy Cyx Cyy
    ... 3000 4e8 1e8 -5e8 2e8 3e6 -1e6 -1e6 9e5
    ... 6000 3e8 1e8 -4e8 2e8 2e6 -1e6 -1e6 8e5'''
    >>> read_coefficients(text, load_axis="-y").stiffness[0]
    array([[ 2.e+08,  5.e+08],
           [-1.e+08,  4.e+08]])
    """
    rows = _sheet(source, sheet)
    said = said_axes(cell for row in rows.rows for cell in row.cells)
    axes = Axes(load_axis or (said or OWN_AXES)[0], turns or (said or OWN_AXES)[1])
    return _table(numbers_of(rows, _checked(units)), axes, scale, said)


def _checked(units: Mapping[str, str] | None) -> Mapping[str, str]:
    given = units or {}
    for name in given:
        if name not in ("speed", "stiffness", "damping"):
            raise ValueError(f"units: {name!r}: must be speed, stiffness or damping")
    return given


def _sheet(source: object, name: str) -> Sheet:
    if isinstance(source, bytes | str) and not source.strip():
        raise ValueError("the file is empty, or its name: a table of coefficients is needed")
    if isinstance(source, bytes) or (isinstance(source, str) and re.search(r"[\r\n]", source)):
        raw = source
    else:
        raw = _loaded(source)
    if isinstance(raw, bytes) and excel.is_workbook(raw):
        if len(raw) > MOST_BYTES:
            raise ValueError(f"the file has more than {MOST_BYTES / 1e6:g} MB")
        return excel.sheet_of(raw, name)
    if name:
        raise ValueError(f"sheet = {name!r}: the file is a text, which has no sheets")
    return texts.sheet_of(readable(raw, most_bytes=MOST_BYTES))


def _loaded(source: object) -> bytes:
    if not isinstance(source, str | Path):
        raise ValueError(f"source = {shown(source)}: must be bytes, a text or a path")
    if Path(source).is_dir():
        raise ValueError(f"source = {shown(source)}: is a folder; name a file in it")
    try:
        with Path(source).open("rb") as file:
            return file.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        raise ValueError(f"source = {shown(source)}: no file that can be read: {error}") from error


def _table(
    read: Numbers, axes: Axes, scale: Scale | None, said: tuple[str, str] | None
) -> ReadTable:
    is_real = "speed" in read.values
    speed, stiffness, damping = _over_speed(read) if is_real else _real(read, scale)
    order = np.argsort(speed, kind="stable")
    if np.any(order != np.arange(len(speed))):
        read.notes.append("The rows were put in order of rising speed.")
    speed, K, C = speed[order], axes.of(stiffness[order]), axes.of(damping[order])
    if not (np.isfinite(K).all() and np.isfinite(C).all() and np.isfinite(speed).all()):
        raise ValueError("the table's numbers are too large to be real with this bearing and oil")
    places = cast("list[int]", order.tolist())
    lines = [read.rows[place].number for place in places]
    for k in np.flatnonzero(np.diff(speed) <= 0.0)[:1].tolist():
        raise ValueError(f"lines {lines[k]} and {lines[k + 1]}: have the same speed")
    S, eps, phi = (_sorted(read.values.get(key), order) for key in NUMBERS)
    return ReadTable(
        speed=speed, stiffness=K, damping=C, lines=tuple(lines), columns=read.columns,
        kind="over speed" if is_real else "dimensionless", sommerfeld=S,
        eccentricity_ratio=eps, attitude_angle=phi, notes=tuple(read.notes),
        warnings=(*read.warnings, *doubts(K, C)), said_axes=said,
    )  # fmt: skip


def _sorted(values: Array | None, order: IntArray) -> Array | None:
    return None if values is None else values[order]


def _over_speed(read: Numbers) -> tuple[Array, Array, Array]:
    """Return speed, K and C as a table has them."""
    return read.values["speed"], _matrices(read, STIFFNESS), _matrices(read, DAMPING)


def _matrices(read: Numbers, keys: tuple[str, ...]) -> Array:
    return np.stack([read.values[key] for key in keys], axis=-1).reshape(-1, 2, 2)


def _real(read: Numbers, scale: Scale | None) -> tuple[Array, Array, Array]:
    """Return speed, K and C of a dimensionless table, and say by which formulas."""
    if scale is None:
        raise ValueError(
            "the table is dimensionless, over a Sommerfeld number: it needs the bearing's "
            "diameter, length and clearance, the oil's viscosity and the load to be real"
        )
    number = read.values["sommerfeld"]
    speed = scale.speed(number)
    read.notes += [_FORMULAS[scale.sommerfeld], _NORMALISED[scale.normalised_by]]
    if "eccentricity" in read.values:
        read.warnings += filter(None, [doubt(scale, number, read.values["eccentricity"])])
    K, C = _matrices(read, STIFFNESS), _matrices(read, DAMPING)
    return speed, scale.stiffness(K, speed), scale.damping(C, speed)


_FORMULAS = {
    "classical": "S is read as the classical Sommerfeld number, μ N D L/W · (R/C)², N in 1/s.",
    "modified": "S is read as the modified Sommerfeld number, μ Ω L R/(4 W) · (L/C)².",
    "DIN": "S is read as So of DIN 31652, W ψ²/(D L μ Ω) with ψ = C/R.",
}
_NORMALISED = {
    "load": "The coefficients are read as K C/W and C Ω C/W.",
    "viscosity": "The coefficients are read as K (C/R)³/(μ Ω L) and C (C/R)³/(μ L).",
}
