"""One table of numbers, written in every format that is read."""

from collections.abc import Sequence

import numpy as np
from scipy.constants import inch, lbf, minute

from rotorcalc.coefficient_files import ReadTable
from ui.sharing.xlsx import Row, workbook

RPM = 2.0 * np.pi / minute
PER_INCH = lbf / inch
NAMES = ("Kxx", "Kxy", "Kyx", "Kyy", "Cxx", "Cxy", "Cyx", "Cyy")
# rpm, N/m, N·s/m; the load along +x, the shaft turning from x to y.
ROWS = (
    (3000.0, 400e6, 100e6, -500e6, 200e6, 3e6, -1e6, -1.1e6, 0.9e6),
    (6000.0, 300e6, 120e6, -400e6, 180e6, 2e6, -0.8e6, -0.8e6, 0.7e6),
    (9000.0, 250e6, 150e6, -350e6, 170e6, 1.5e6, -0.6e6, -0.6e6, 0.6e6),
)
SPEED = np.array([row[0] for row in ROWS]) * RPM
K = np.array([row[1:5] for row in ROWS]).reshape(-1, 2, 2)
C = np.array([row[5:9] for row in ROWS]).reshape(-1, 2, 2)


def text(
    separator: str = ",",
    header: Sequence[str] = ("rpm", *NAMES),
    rows: Sequence[Sequence[float]] = ROWS,
    comma: bool = False,
) -> str:
    """Return a table as text."""
    shown = [[f"{number:.10g}" for number in row] for row in rows]
    lines = [separator.join(header)] * bool(header)
    lines += [separator.join(row).replace(".", "," if comma else ".") for row in shown]
    return "\n".join(lines) + "\n"


def excel(*rows: Row) -> bytes:
    """Return a workbook."""
    return workbook("Table", rows)


def same(read: ReadTable, rtol: float = 1e-14) -> None:
    """Hold what was read against the numbers."""
    np.testing.assert_allclose(read.speed, SPEED, rtol=rtol)
    np.testing.assert_allclose(read.stiffness, K, rtol=rtol)
    np.testing.assert_allclose(read.damping, C, rtol=rtol)
