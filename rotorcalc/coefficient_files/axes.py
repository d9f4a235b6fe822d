"""The user's axes x, y and the program's: X along the static load, Y at +90° as the shaft turns."""

from typing import Literal, TypeAlias

import numpy as np

from rotorcalc.arrays import Array

LoadAxis: TypeAlias = Literal["+x", "-x", "+y", "-y"]
Turns: TypeAlias = Literal["x to y", "y to x"]

LOAD_AXES: dict[str, tuple[float, float]] = {
    "+x": (1.0, 0.0), "-x": (-1.0, 0.0), "+y": (0.0, 1.0), "-y": (0.0, -1.0),
}  # fmt: skip
# +1 where the shaft turns by the shorter way from +x to +y.
TURNS: dict[str, float] = {"x to y": 1.0, "y to x": -1.0}


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
