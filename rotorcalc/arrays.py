"""Array types of the package's signatures, conversion of input to them, and error texts."""

import reprlib
from dataclasses import is_dataclass
from typing import Any, TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array: TypeAlias = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]
BoolArray: TypeAlias = NDArray[np.bool_]
IntArray: TypeAlias = NDArray[np.intp]

# There is one such object for all arrays of floats.
_FLOAT = np.dtype(np.float64)


def real_array(name: str, values: ArrayLike, *, ends: tuple[int, ...] = ()) -> Array:
    """Return `values` as an array of floats, or raise ValueError showing them.

    NumPy alone would read "6000", True and None as numbers. `ends` is the shape of each value, (2,)
    of vectors and (2, 2) of matrices.
    """
    # The common cases, without the checks below: a film calls this 30 times per speed.
    kind = type(values)
    if kind is np.ndarray and cast("Array", values).dtype is _FLOAT:
        array = cast("Array", values)
        if not ends or array.shape[-len(ends) :] == ends:
            return array
    elif not ends and (kind is np.float64 or kind is float):
        return np.asarray(values)
    return _numbers(name, values, "fiu", ends).astype(float, copy=False)


def checked_speed(speed: ArrayLike) -> Array:
    """Return speeds [rad/s] as an array, or raise ValueError unless all are positive and finite."""
    speeds = real_array("speed", speed)
    # A journal that does not turn draws in no film: at Ω = 0 no load is carried.
    good = np.isfinite(speeds) & (speeds > 0.0)
    if not good.all():
        raise ValueError(f"speed = {speeds[~good].flat[0]} rad/s: must be positive and finite")
    return speeds


def complex_array(name: str, values: ArrayLike, *, ends: tuple[int, ...] = ()) -> ComplexArray:
    """Return `values` as an array of complex numbers, or raise ValueError as `real_array` does."""
    return _numbers(name, values, "fiuc", ends).astype(complex, copy=False)


def _numbers(name: str, values: ArrayLike, kinds: str, ends: tuple[int, ...]) -> NDArray[Any]:
    try:
        array = np.asarray(values)
    except ValueError as error:  # rows of different lengths
        raise ValueError(f"{name} = {shown(values)}: must be an array of numbers") from error
    # An empty array holds nothing that could be wrong, whatever NumPy calls its kind.
    if array.dtype.kind not in kinds and array.size > 0:
        raise ValueError(f"{name} = {shown(values)}: must be a number or an array of numbers")
    if ends and array.shape[-len(ends) :] != ends:
        shape = ", ".join(map(str, ends))
        raise ValueError(f"{name}: must have the shape (..., {shape}), has {array.shape}")
    return array


def shown(value: object) -> str:
    """Return a short text of any value for an error message."""
    if is_dataclass(value) and not isinstance(value, type):
        return f"a {type(value).__name__}"  # its own text fills lines
    try:
        return reprlib.repr(value)
    except ValueError:  # Python refuses to write out integers of thousands of digits
        return f"an {type(value).__name__} of thousands of digits"
