"""The record of one check, and the comparison of two arrays."""

from dataclasses import dataclass

import numpy as np

from rotorcalc.arrays import Array, ComplexArray


@dataclass(frozen=True)
class Case:
    """One check: a number of the program and its reference.

    Attributes
    ----------
    group : str
        The part of the program that it checks.
    name : str
        Name of the number.
    value : float
        The program's number, in `unit`.
    reference : float
        The reference number.
    tolerance : float
        Largest admissible difference.
    source : str
        Source of the reference.
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
        """Absolute difference of value and reference."""
        return abs(self.value - self.reference)

    @property
    def holds(self) -> bool:
        """Whether the difference is within the tolerance; False where one number is NaN."""
        return self.difference <= self.tolerance


def alike(
    group: str,
    name: str,
    pair: tuple[Array | ComplexArray, Array | ComplexArray],
    source: str,
    *,
    tolerance: float = 1e-12,
) -> Case:
    """Return the case that two arrays agree: largest difference, relative to its row's largest."""
    value, reference = pair
    # One scale per row: each row is one ε, and elements that vanish are judged by the others.
    rows = len(reference)
    scale = np.max(np.abs(reference).reshape(rows, -1), axis=1)
    off = np.max(np.abs(value - reference).reshape(rows, -1), axis=1)
    return Case(group, name, float(np.max(off / scale)), 0.0, tolerance, source)
