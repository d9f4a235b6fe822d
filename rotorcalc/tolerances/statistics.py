r"""What samples say: a probability with its interval, and which input matters most.

The first-order index of an input X is the share of the output's variance that the best function of
X alone explains, S = Var E(Y|X)/Var Y. That function is approximated by a polynomial in X, fitted
to the samples themselves by least squares, and S estimated by the adjusted coefficient of
determination, 1 − (RSS/(n−p−1))/(TSS/(n−1)), whose mean is zero for an input without effect. The
standard error is that of the jackknife: twenty blocks of samples are left out in turn.

Source: Saltelli and others, Global Sensitivity Analysis, 2008, for the index; Wilson, J. Am. Stat.
Assoc. 22 (1927) for the interval.
"""

import math
from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.polynomial import chebyshev

from rotorcalc.arrays import Array
from rotorcalc.display import Result

# Of the normal distribution, for 95 %.
_Z = 1.959963984540054
# Degree of the polynomial at most, and samples for each of its degrees at least.
_DEGREE, _SAMPLES_A_DEGREE = 6, 20
_BLOCKS = 20
# Relative differences that may be rounding.
_ROUNDING = 1e-12


@dataclass(frozen=True)
class Probability(Result):
    """A probability counted on samples.

    Attributes
    ----------
    value : float
        Share of the samples [-].
    low, high : float
        Ends of the 95 % interval by Wilson's formula [-]. Samples without an answer widen it: the
        low end counts none of them, the high end all.
    """

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Influence(Result):
    """How much of the output's variance comes from one input alone.

    Attributes
    ----------
    field : str
        The input.
    index : float
        Its first-order index, S [-]; NaN where the output has no variance or is not finite.
    error : float
        Standard error of that estimate [-].
    """

    field: str
    index: float
    error: float


def probability(yes: int, unknown: int, samples: int) -> Probability:
    """Return the probability of an event that so many of the samples showed.

    Parameters
    ----------
    yes, unknown, samples : int
        Samples with the event, without an answer, and all.

    Returns
    -------
    Probability
        Its value is the share of those with an answer; NaN where there is none.
    """
    known = samples - unknown
    return Probability(
        value=yes / known if known else math.nan,
        low=_wilson(yes / samples, samples, -1.0),
        high=_wilson((yes + unknown) / samples, samples, 1.0),
    )


def _wilson(share: float, n: int, side: float) -> float:
    """Return one end of Wilson's interval, side −1 or 1."""
    # At a share of 0 or 1 the end is that, without rounding.
    if share == (0.0 if side < 0.0 else 1.0):
        return share
    half = _Z * math.sqrt(share * (1.0 - share) / n + _Z**2 / (4.0 * n**2))
    return (share + _Z**2 / (2.0 * n) + side * half) / (1.0 + _Z**2 / n)


def influence(field: str, x: Array, y: Array) -> Influence:
    """Return the first-order index of an input.

    Parameters
    ----------
    field : str
        The input.
    x, y : array, (n,)
        Its values and the output's, inputs drawn independently of one another.

    Returns
    -------
    Influence
        NaN for fewer than 40 samples, and where the output is constant or not finite.
    """
    n, width = len(y), np.ptp(x)
    degree = min(_DEGREE, n // _SAMPLES_A_DEGREE - 1)
    if degree < 1 or not np.all(np.isfinite(y)) or _is_constant(y):
        return Influence(field, math.nan, math.nan)
    if width == 0.0:  # what does not vary explains nothing
        return Influence(field, 0.0, 0.0)
    basis = cast("Array", chebyshev.chebvander(2.0 * (x - x.min()) / width - 1.0, degree))
    # Orthonormal, so that what blocks contribute can be taken out again one by one.
    Q: Array = np.linalg.qr(basis)[0]
    sums = _sums(Q, (y - y.mean()) / np.ptp(y))
    total = [np.sum(part, axis=0) for part in sums]
    without = [
        _adjusted(*(whole - part[b] for whole, part in zip(total, sums, strict=True)))
        for b in range(_BLOCKS)
    ]
    spread = float(np.var(without))
    return Influence(field, _adjusted(*total), math.sqrt((_BLOCKS - 1) * spread))


def _is_constant(y: Array) -> bool:
    return bool(np.ptp(y) <= _ROUNDING * np.max(np.abs(y)))


def _sums(Q: Array, y: Array) -> list[Array]:
    """Return QᵀQ, Qᵀy, Σy², Σy and the number of samples of each block, each (blocks, ...)."""
    blocks = list(zip(np.array_split(Q, _BLOCKS), np.array_split(y, _BLOCKS), strict=True))
    return [
        np.array([q.T @ q for q, _ in blocks]),
        np.array([q.T @ part for q, part in blocks]),
        np.array([part @ part for _, part in blocks]),
        np.array([part.sum() for _, part in blocks]),
        np.array([float(len(part)) for _, part in blocks]),
    ]


def _adjusted(QQ: Array, Qy: Array, yy: Array, y: Array, n: Array) -> float:
    """Return the adjusted coefficient of determination of a fit, from its sums."""
    residual = yy - Qy @ np.linalg.solve(QQ, Qy)
    total = yy - y**2 / n
    return float(1.0 - (residual / (n - len(Qy))) / (total / (n - 1.0)))
