"""The user's axes x, y and the program's: X along the static load, Y at +90° as the shaft turns."""

import re
from collections.abc import Iterable

import numpy as np

from rotorcalc.arrays import Array

LOAD_AXES: dict[str, tuple[float, float]] = {
    "+x": (1.0, 0.0), "-x": (-1.0, 0.0), "+y": (0.0, 1.0), "-y": (0.0, -1.0),
}  # fmt: skip
# +1 where the shaft turns by the shorter way from +x to +y.
TURNS: dict[str, float] = {"x to y": 1.0, "y to x": -1.0}
# Those of the program, as a user's.
OWN_AXES = ("+x", "x to y")
_SAID = re.compile(r"load acts along ([+-][xy]), the shaft turns from (x to y|y to x)")


def words_of(load_axis: str, turns: str) -> str:
    """Return in words where the load acts and how the shaft turns; `said_axes` reads them."""
    return f"the load acts along {load_axis}, the shaft turns from {turns}"


def said_axes(cells: Iterable[str | float]) -> tuple[str, str] | None:
    """Return load axis and sense of rotation that a file says in the words of `words_of`."""
    # A comma between cells may have split them.
    text = re.sub(
        r"\s+", " ", ",".join(f" {cell.strip()}" for cell in cells if isinstance(cell, str))
    )
    found = _SAID.search(text)
    return None if found is None else (found[1], found[2])


class Axes:
    """Where the load acts in the user's axes, and how the shaft turns in them.

    Parameters
    ----------
    load_axis : "+x", "-x", "+y" or "-y"
        The axis along which the static load acts.
    turns : "x to y" or "y to x"
        The sense of rotation, by the shorter way between the positive axes.
    """

    def __init__(self, load_axis: str, turns: str) -> None:
        for name, value, known in (("load_axis", load_axis, LOAD_AXES), ("turns", turns, TURNS)):
            if value not in known:
                raise ValueError(f"{name} = {value!r}: must be {' or '.join(map(repr, known))}")
        X = np.array(LOAD_AXES[load_axis])
        # A quarter turn of X in the sense of rotation.
        Y = TURNS[turns] * np.array([-X[1], X[0]])
        # The rows are the unit vectors of X and Y in x, y: u_XY = T u_xy.
        self.T: Array = np.stack([X, Y])

    def of(self, coefficients: Array) -> Array:
        """Return in X, Y the coefficients, shape (..., 2, 2), given in x, y: T K Tᵀ.

        The elements only change places and signs, so nothing is rounded.
        """
        # 0.0 is added so that a −0 becomes 0.
        return self.T @ coefficients @ self.T.T + 0.0
