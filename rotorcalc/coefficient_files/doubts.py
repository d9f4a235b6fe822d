"""What of a table looks as if axes or sense of rotation were wrong."""

import numpy as np

from rotorcalc.arrays import Array

_MUCH = 2.5


def doubts(K: Array, C: Array) -> tuple[str, ...]:
    """Return in words what looks wrong with K and C, shape (n, 2, 2), in the program's axes.

    Over an orbit of radius a in the sense of rotation K does the work π a² (K_XY − K_YX) on the
    journal. In every film of a turning journal that is positive: the rotation carries the oil, and
    with it the journal.
    """
    found: list[str] = []
    forward = K[:, 0, 1] - K[:, 1, 0]
    if np.sum(forward < 0.0) > np.sum(forward > 0.0):
        found.append(
            "The cross-coupling drives the journal against the rotation, K_XY < K_YX, which no "
            "film does that the shaft drags round: is the sense of rotation right?"
        )
    # A short bearing that carries next to nothing is twice as stiff across the load as along it.
    if np.all(K[:, 1, 1] > _MUCH * K[:, 0, 0]):
        found.append(
            "At every speed the film is much stiffer across the load than along it, K_YY > "
            f"{_MUCH:g} K_XX, which is rare: is the load's axis right?"
        )
    low = np.linalg.eigvalsh((C + C.swapaxes(-1, -2)) / 2.0)[:, 0]
    if np.any(low < 0.0):
        found.append(
            f"At {np.sum(low < 0.0)} of {len(low)} speeds the damping is negative in one "
            "direction: it would put energy into a vibration."
        )
    return tuple(found)
