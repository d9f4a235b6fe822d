"""The short bearing's stiffness and damping in extended precision.

At light load or in a very thin film the growth rate of whirl is a difference too small for double
precision: at σ = 10⁸ it is 1e-18 of the film's damping. Here σ and all that follows are
`decimal.Decimal`, in the precision of the current context. Equations and units as in `short`.
"""

from decimal import Decimal, getcontext

import numpy as np
from numpy.typing import NDArray

# π to 100 digits; the search for an onset works with 60.
_PI = Decimal(
    "3.141592653589793238462643383279502884197169399375105820974944592307816406286208998628034825342117068"
)
# Far above the root, where the left side is 4w⁴, a step takes a quarter off w: from σ = 1e-12 some
# 75 steps; near the root each doubles the digits.
_MOST_ITERATIONS = 200


def coefficients(sommerfeld: Decimal) -> tuple[NDArray[np.object_], NDArray[np.object_]]:
    """Return stiffness and damping in X, Y in film units (Eq. 5.35), of decimals (2, 2).

    Parameters
    ----------
    sommerfeld : Decimal
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    stiffness, damping : array of Decimal, (2, 2)
        In μΩRL³/C³ and μRL³/C³.

    Raises
    ------
    RuntimeError
        Where the search for ε does not converge.
    """
    # In w = ε/s: 1 − ε² would lose its digits where the film is thin.
    w2 = _eccentricity(sommerfeld) ** 2
    s2 = 1 / (1 + w2)  # 1 − ε²
    eps2 = w2 * s2
    s4 = s2 * s2
    radial, tangential = eps2.sqrt() / s4, _PI / (4 * s2 * s2.sqrt())  # Eq. 5.33 times F_o
    load2 = 16 * eps2 + _PI**2 * s2
    fr2, ft2 = 16 * eps2 / load2, _PI**2 * s2 / load2  # cos²φ and sin²φ
    first, second = fr2 + 1 + 2 * eps2, (2 + eps2) * ft2 - s2
    K = [
        [radial / s2 * first, tangential / s2 * first],
        [tangential / s2 * (fr2 - s2), radial / s2 * (ft2 + s2)],
    ]
    C_XY = 2 * radial / s2 * second
    C = [
        [2 * tangential / s2 * ((2 + eps2) * fr2 + s2), C_XY],
        [C_XY, 2 * tangential / s2 * second],
    ]
    return np.array(K), np.array(C)


def _eccentricity(sommerfeld: Decimal) -> Decimal:
    """Return w = ε/s of Eq. 5.8, w(1+w²)√(π²+16w²) = 1/σ.

    The left side increases and is convex, so from above the root Newton's method descends to it.
    """
    load = 1 / sommerfeld
    if load == 0:  # σ = ∞: the journal is centred
        return load
    w = load / _PI  # above the root, as the factor (1+w²)√(π²+16w²) is at least π
    # Four guard digits: the rounding of `value` keeps a step from becoming smaller.
    small = Decimal(10) ** (4 - getcontext().prec)
    for _ in range(_MOST_ITERATIONS):
        w2 = w * w
        a, b = 1 + w2, _PI**2 + 16 * w2
        root = b.sqrt()
        value = w * a * root
        step = (value - load) / (a * root + 2 * w2 * root + 16 * w2 * a / root)
        w -= step
        if abs(step) <= small * w:
            return w
    raise RuntimeError(f"no eccentricity ratio found within {_MOST_ITERATIONS} iterations")
