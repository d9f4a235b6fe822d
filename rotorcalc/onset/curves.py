"""Two curves of the short film over σ, which give the onset of a machine without midspan damping.

σ²/p_s² and (σω̄)²: of the film alone, and both rise with σ.
"""

import functools

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.films import film_coefficients
from rotorcalc.machine import JournalBearing
from rotorcalc.onset.whirl import whirl_onset

# k and c over σ are the same for all short bearings, so any dimensions serve.
_ANY_BEARING = JournalBearing(diameter=1.0, length=1.0, radial_clearance=0.01)
# Modified Sommerfeld numbers that bracket a root. Below them no film can whirl; above them it is
# nearly centred, where both curves grow as σ². Forty per decade, refined by a root finder.
SIGMA = np.geomspace(1e-3, 1e3, 241)


@functools.cache
def table() -> tuple[Array, Array]:
    """Return the curves at `SIGMA`."""
    return curves(SIGMA)


def curves(sigma: Array) -> tuple[Array, Array]:
    """Return σ²/p_s² and (σω̄)² at σ."""
    onset = whirl_onset(*film_coefficients(_ANY_BEARING, sigma))  # p_s² in film units
    return sigma / (4.0 * onset.critical_mass), (sigma * onset.whirl_ratio) ** 2
