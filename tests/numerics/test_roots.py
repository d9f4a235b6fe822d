"""Roots between near places."""

import math

import numpy as np
import pytest

from rotorcalc.numerics.roots import HiddenRootError, narrow_root, narrow_roots, zeros


@pytest.mark.parametrize(
    ("function", "low", "high", "root"),
    [
        (np.cos, 1.5, 1.65, math.pi / 2),
        (lambda x: x**3 - 2.0, 1.2, 1.3, 2.0 ** (1 / 3)),
        (lambda x: np.exp(x) - 1e6, 13.5, 14.0, math.log(1e6)),
        (lambda x: 1e-200 * (x - 3.0), 2.9, 3.3, 3.0),
    ],
)
def test_a_smooth_functions_root_is_found_to_rounding_in_one_call(
    function, low, high, root
) -> None:
    looks: list[int] = []

    def values(x):
        looks.append(len(x))
        return function(x)

    assert narrow_root(values, low, high) == pytest.approx(root, rel=3e-15)
    assert len(looks) == 1


@pytest.mark.parametrize(
    ("function", "root"),
    [
        (lambda x: np.where(x < 1.0, x - 1.0, 50.0 * (x - 1.0)), 1.0),  # a kink at the root
        (lambda x: np.abs(x - 0.98) - 0.01 + 0.0 * x, 0.99),  # and beside it
        (lambda x: np.where(x < 1.013, -1.0, 1.0), 1.013),  # a jump
        (lambda x: np.tanh(1e3 * (x - 1.001)), 1.001),  # too steep for the series
    ],
)
def test_the_root_of_a_function_with_a_kink_is_found_too(function, root) -> None:
    assert narrow_root(function, 0.985, 1.05) == pytest.approx(root, rel=2e-14)


def test_between_two_kinks_the_root_is_found_in_a_few_calls() -> None:
    looks: list[int] = []

    def values(x):
        looks.append(len(x))
        return np.interp(x, [0.9, 1.0, 1.1], [-1.0, -0.2, 9.0]) + 0.1 * x**3

    root = narrow_root(values, 0.95, 1.05)
    assert abs(values(np.array([root]))[0]) < 1e-14
    assert len(looks) <= 4


@pytest.mark.parametrize("at", [0.987, 1.0, 1.0497])
def test_a_jump_is_found_in_a_few_calls_on_the_side_nearer_to_zero(at) -> None:
    looks: list[int] = []

    def values(x):
        looks.append(len(x))
        return np.where(x < at, -0.3 - x, 1e-3 * x)

    root = narrow_root(values, 0.985, 1.05)
    assert at <= root <= at * (1.0 + 1e-14)
    assert len(looks) <= 14


def test_rounding_beside_a_kink_is_that_of_the_function_not_of_what_is_left_of_it() -> None:
    """Closer to its root a function is smaller, and its errors are not."""
    looks: list[int] = []

    def values(x):
        looks.append(len(x))
        return x - 1.02 + np.maximum(x - 1.04, 0.0) ** 3 + 2e-14 * np.sin(1e9 * x)

    assert narrow_root(values, 0.985, 1.05, noise=1e-12) == pytest.approx(1.02, rel=1e-13)
    assert looks == [18, 18]


def test_a_root_at_an_end_is_found() -> None:
    assert narrow_root(lambda x: x - 1.0, 1.0, 1.1) == pytest.approx(1.0, rel=1e-14)


def test_a_root_that_rounding_hides_is_no_number() -> None:
    """The signs at many places together are not those at each alone."""

    def values(x):
        return x - 1.017 + 2e-3 * np.sin(1e7 * x) if len(x) > 1 else -x

    with pytest.raises(HiddenRootError, match="rounding errors hide"):
        narrow_root(values, 0.985, 1.05)


def test_an_error_of_the_function_itself_is_told_as_it_is() -> None:
    def values(x):
        if len(x) == 1:
            raise ValueError("no film")
        return np.tanh(1e3 * (x - 1.001)) + 1e-3 * np.sin(1e5 * x)

    with pytest.raises(ValueError, match="no film"):
        narrow_root(values, 0.985, 1.05)


def test_many_functions_roots_are_found_to_rounding_in_one_call() -> None:
    """Of powers, xⁿ = 1.3; the first has no root there, the last a kink."""
    power, looks = np.array([[9.0], [1.0], [-2.0], [3.5], [0.4]]), []

    def values(x):
        looks.append(x.shape)
        return np.vstack([x[:-1] ** power - 1.3, np.abs(x[-1:] - 1.1) - 0.01])

    about = np.append(1.3 ** (1.0 / power[:, 0]), 1.1)
    about[0] = 1.2
    roots = narrow_roots(values, 0.98 * about, 1.03 * about)
    assert roots[1:-1] == pytest.approx(about[1:-1], rel=3e-15)
    assert np.isnan(roots[[0, -1]]).all()
    assert looks == [(6, 18)]


def test_all_zeros_of_a_function_are_found() -> None:
    assert zeros(np.cos, 0.0, 20.0) == pytest.approx(np.pi * (np.arange(6) + 0.5), rel=1e-12)
    assert zeros(lambda x: x**2 + 1e-3, -1.0, 1.0).size == 0


def test_zeros_of_a_function_with_a_jump_are_not_claimed() -> None:
    with pytest.raises(ValueError, match="no series"):
        zeros(lambda x: np.where(x < 0.7, -1.0, 1.0), 0.0, 1.0)
