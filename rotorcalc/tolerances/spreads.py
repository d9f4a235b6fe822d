"""How an input spreads over many machines: distributions, and draws from them.

A draw is the inverse of the distribution at a share between 0 and 1. The shares of an input come
from a generator of its own, seeded by the seed and the input's name: other inputs, more samples or
the way in which the samples are computed change nothing of them.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from typing import NamedTuple, cast

import numpy as np
from scipy.special import ndtr, ndtri

from rotorcalc.arrays import Array, shown
from rotorcalc.records import Bound

_NUMBER = Bound("SI")
# Shares of 0 and 1 would draw the infinite ends of a normal distribution.
_ENDS = (2.0**-54, 1.0 - 2.0**-53)


def _uniform(share: Array, low: float, high: float) -> Array:
    return low + (high - low) * share


def _normal(
    share: Array, mean: float, deviation: float, low: float = -math.inf, high: float = math.inf
) -> Array:
    if deviation == 0.0:
        return np.full(share.shape, mean)
    # Between two bounds the shares of the whole distribution that lie between them.
    first, last = ndtr((low - mean) / deviation), ndtr((high - mean) / deviation)
    return np.clip(mean + deviation * ndtri(first + (last - first) * share), low, high)


def _triangular(share: Array, low: float, mode: float, high: float) -> Array:
    width = high - low
    if width == 0.0:
        return np.full(share.shape, mode)
    rising = low + np.sqrt(share * width * (mode - low))
    falling = high - np.sqrt((1.0 - share) * width * (high - mode))
    return np.where(share * width < mode - low, rising, falling)


def _lognormal(share: Array, median: float, ratio: float) -> Array:
    return median * np.exp(math.log(ratio) * ndtri(share))


class _Kind(NamedTuple):
    """A kind of distribution: its numbers, how many it needs, its inverse and what it demands."""

    names: tuple[str, ...]
    needed: int
    inverse: Callable[..., Array]
    fault: Callable[..., str]


def _bounds_fault(mean: float, deviation: float, *bounds: float) -> str:
    if deviation < 0.0:
        return f"deviation = {deviation:g}: must be at least 0"
    if len(bounds) == 1:
        return "a normal distribution has two bounds, or none"
    return _order_fault(low=bounds[0], mean=mean, high=bounds[1]) if bounds else ""


def _order_fault(**values: float) -> str:
    """Return in words where values do not rise; equal ones are of a spread without width."""
    for (before, low), (after, high) in itertools.pairwise(values.items()):
        if high < low:
            return f"{after} = {high:g}: must be at least {before} = {low:g}"
    return ""


def _ratio_fault(median: float, ratio: float) -> str:
    if median <= 0.0:
        return f"median = {median:g}: must be positive"
    return f"ratio = {ratio:g}: must be at least 1" if ratio < 1.0 else ""


def _uniform_fault(low: float, high: float) -> str:
    return _order_fault(low=low, high=high)


def _triangular_fault(low: float, mode: float, high: float) -> str:
    return _order_fault(low=low, mode=mode, high=high)


KINDS: dict[str, _Kind] = {
    "uniform": _Kind(("low", "high"), 2, _uniform, _uniform_fault),
    "normal": _Kind(("mean", "deviation", "low", "high"), 2, _normal, _bounds_fault),
    "triangular": _Kind(("low", "mode", "high"), 3, _triangular, _triangular_fault),
    "lognormal": _Kind(("median", "ratio"), 2, _lognormal, _ratio_fault),
}


def drawn(name: str, spread: object, *, samples: int, seed: int) -> Array:
    """Return values of one input.

    Parameters
    ----------
    name : str
        The input's full name, from which its generator is seeded besides the seed.
    spread : tuple
        ("uniform", low, high), ("normal", mean, deviation), ("normal", mean, deviation, low, high)
        for one cut off at two bounds, ("triangular", low, mode, high), or ("lognormal", median,
        ratio): two thirds of the values lie between median/ratio and median·ratio. In SI.
    samples : int
        How many.
    seed : int
        Of all inputs.

    Returns
    -------
    array, (samples,)
        The first values are the same for any number of samples.

    Raises
    ------
    ValueError
        Naming the input, the value and its bound.
    """
    kind, numbers = _read(name, spread)
    source = np.random.SeedSequence(seed, spawn_key=tuple(name.encode()))
    share = np.clip(np.random.default_rng(source).random(samples), *_ENDS)
    return kind.inverse(share, *numbers)


def _read(name: str, spread: object) -> tuple[_Kind, list[float]]:
    """Return the kind and the numbers of a spread, or raise ValueError naming what is wrong."""
    given_as = shown(spread)
    listed = isinstance(spread, Sequence) and not isinstance(spread, str)
    word, *given = cast("Sequence[object]", spread) if listed and spread else [None]
    if not isinstance(word, str) or word not in KINDS:
        raise ValueError(f"{name}: {given_as}: must be one of {', '.join(map(_form, KINDS))}")
    kind = KINDS[word]
    if not kind.needed <= len(given) <= len(kind.names):
        raise ValueError(f"{name}: {given_as}: must be {_form(word)}")
    numbers = [
        _NUMBER.check(f"{name}: {part}", value)
        for part, value in zip(kind.names, given, strict=False)
    ]
    if fault := kind.fault(*numbers):
        raise ValueError(f"{name}: {fault}")
    return kind, numbers


def _form(word: str) -> str:
    kind = KINDS[word]
    more = "".join(f"[, {name}]" for name in kind.names[kind.needed :])
    return f"({', '.join([repr(word), *kind.names[: kind.needed]])}{more})"
