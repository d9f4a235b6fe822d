"""What one check is, and how two arrays are compared."""

from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array, ComplexArray


@dataclass(frozen=True)
class Case:
    """One check: a number of the program beside its reference.

    Attributes
    ----------
    group : str
        What part of the program it checks.
    name : str
        What the number is.
    value : float
        The program's, in `unit`.
    reference : float
        What it should be.
    tolerance : float
        How far the two may differ.
    source : str
        Where the reference comes from.
    unit : str
        Unit of the three numbers.
    """

    group: str
    name: str
    value: float
    reference: float
    tolerance: float
    source: str
    unit: str = "-"

    @property
    def difference(self) -> float:
        """How far value and reference differ."""
        return abs(self.value - self.reference)

    @property
    def holds(self) -> bool:
        """The verdict: whether they differ by no more than the tolerance; not where one is NaN."""
        return self.difference <= self.tolerance


def alike(
    group: str,
    name: str,
    pair: tuple[Array | ComplexArray, Array | ComplexArray],
    source: str,
    *,
    tolerance: float = 1e-12,
) -> Case:
    """Return the case that two arrays agree: their largest difference, relative to its row."""
    value, reference = pair
    rows = len(reference)
    scale = np.max(np.abs(reference).reshape(rows, -1), axis=1)
    off = np.max(np.abs(value - reference).reshape(rows, -1), axis=1)
    return Case(group, name, float(np.max(off / scale)), 0.0, tolerance, source)
