"""A table of coefficients as CSV that `read_coefficients` reads back to the last digit."""

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import checked_speed, real_array
from rotorcalc.coefficient_files.axes import OWN_AXES, words_of
from rotorcalc.coefficient_files.columns import ELEMENTS

_HEAD = (
    "# Stiffness K and damping C of one bearing over running speed.",
    "# X points along the static load, Y at +90° in the sense of rotation.",
    f"# In x, y of a file: {words_of(*OWN_AXES)}.",
)


def written(speed: ArrayLike, stiffness: ArrayLike, damping: ArrayLike) -> str:
    """Return coefficients as CSV, in SI units and in the program's axes.

    Parameters
    ----------
    speed : array_like, (n,)
        Running speeds, Ω [rad/s].
    stiffness, damping : array_like, (n, 2, 2)
        K [N/m] and C [N·s/m] in X, Y.

    Returns
    -------
    str
        A line a speed; each number has as many digits as tell it from every other.
    """
    K = real_array("stiffness", stiffness, ends=(2, 2)).reshape(-1, 4)
    C = real_array("damping", damping, ends=(2, 2)).reshape(-1, 4)
    header = ["speed [rad/s]", *(f"K{element} [N/m]" for element in ELEMENTS)]
    header += [f"C{element} [N·s/m]" for element in ELEMENTS]
    rows = np.column_stack([checked_speed(speed), K, C]).tolist()
    lines = [*_HEAD, ",".join(header), *(",".join(map(repr, row)) for row in rows)]
    return "\n".join(lines) + "\n"
