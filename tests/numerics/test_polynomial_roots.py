"""Roots of polynomials: against roots that are known, however close or far apart they lie."""

from decimal import Decimal, localcontext

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc.numerics.polynomial_roots import error_bounds, exact_roots, simultaneous_roots

LAM = st.tuples(st.floats(-6, 6), st.floats(-1, 1), st.booleans())


def from_roots(pairs, reals):
    """Return the coefficients, from the constant up, of Π (λ² − 2 Re λ + |λ|²) Π (λ − r)."""
    polynomial = np.array([Decimal(1)])
    for z in pairs:
        re, im = Decimal(z.real), Decimal(z.imag)
        polynomial = np.convolve(polynomial, np.array([re * re + im * im, -2 * re, Decimal(1)]))
    for r in reals:
        polynomial = np.convolve(polynomial, np.array([-Decimal(r), Decimal(1)]))
    return polynomial


def sorted_roots(values):
    return np.array(sorted(values, key=lambda z: (z.imag, z.real)))


def all_of(pairs, reals):
    return [*pairs, *(z.conjugate() for z in pairs), *map(complex, reals)]


SETS = [
    pytest.param([1e-20 + 1j, -1e3 + 1e-3j], [-1e15, -1e-9], id="far apart"),
    pytest.param([-1e-25 + 1j, 1e-30 + 2j], [-1.0, -3.0], id="close to the axis"),
    pytest.param([], [-5801.9284632668, -5801.9284436791, -1e5, -1e-5], id="real, close"),
    pytest.param([-1 + 1e-9j], [-1e8, -7.0], id="a pair beside the real axis"),
    pytest.param([-0.5 + 4j, -0.5 - 1e-13 + 4j], [-2e15, -2.1e15], id="pairs, close"),
]


@pytest.mark.parametrize(("pairs", "reals"), SETS)
@pytest.mark.parametrize("away", [1e-12, 1e-3, 0.3])
def test_roots_in_many_digits_are_the_known_ones(pairs, reals, away):
    with localcontext(prec=60):
        polynomial = from_roots(pairs, reals)
        expected = sorted_roots(all_of(pairs, reals))
        aside = 1 + away * np.exp(2j * np.arange(len(expected)))
        floats = np.array([float(a) for a in polynomial])
        near = simultaneous_roots(floats[None], (expected * aside)[None])[0]
        found = sorted_roots(exact_roots(polynomial, near))
    assert found.real == pytest.approx(expected.real, rel=1e-14, abs=0)
    assert found.imag == pytest.approx(expected.imag, rel=1e-14, abs=0)


@given(st.lists(LAM, min_size=6, max_size=6, unique_by=lambda t: round(t[0], 1)))
def test_simultaneous_roots_lie_within_their_error_bounds(drawn):
    pairs = [10.0**p * complex(np.sin(a), np.cos(a)) for p, a, pair in drawn[:4] if pair]
    reals = [-(10.0**p) for p, _, pair in drawn[:4] if not pair]
    with localcontext(prec=60):
        polynomial = np.array([float(a) for a in from_roots(pairs, reals)])[None]
    known = np.array(all_of(pairs, reals))
    found = simultaneous_roots(polynomial, known[None] * 1.2)
    bounds = error_bounds(polynomial, found)[0]
    distance = np.abs(known[:, None] - found[0][None, :])
    assert np.all(np.any(distance <= bounds, axis=1))
    # A bound that admits anything would prove nothing.
    assert np.median(bounds / np.abs(found)) < 1e-6


def test_an_error_bound_notices_a_wrong_root():
    polynomial = np.array([[6.0, 11.0, 6.0, 1.0]])  # −1, −2, −3
    bounds = error_bounds(polynomial, np.array([[-1.0, -2.0, -3.01 + 0j]]))[0]
    assert bounds[2] >= 0.01
    assert bounds.max() < 0.1
    assert error_bounds(polynomial, np.array([[-1.0, -2.0, -3.0 + 0j]])).max() < 1e-11


def test_a_missed_root_raises_an_error():
    with (
        localcontext(prec=60),
        pytest.raises(RuntimeError, match="found 0 of a polynomial's 2 roots"),
    ):
        exact_roots(from_roots([-1 + 2j], []), np.array([-1 - 8j, -1 - 9j]))


@pytest.mark.parametrize("apart", [0.0, 1e-30, 1e-27])
def test_a_pair_closer_than_rounding_is_found_as_one(apart):
    """Two planes of a heavily damped disk hardly differ, and leave such a pair far out."""
    pairs, reals = [-2e-5 + 3j], [-6.5e7, -0.16, -0.2]
    with localcontext(prec=60):
        polynomial = from_roots(pairs, [*reals, -6.5e7])
        polynomial[0] *= 1 + Decimal(apart)
        near = np.array([-2e-5 + 3j, -2e-5 - 3j, -0.16, -0.2, -6.5e7 + 1.5j, -6.5e7 - 1.7j])
        found = exact_roots(polynomial, near)
    expected = all_of(pairs, [*reals, -6.5e7])
    assert np.max(np.min(np.abs(found[:, None] / expected - 1.0), axis=0)) < 1e-14
    assert np.count_nonzero(np.abs(found / -6.5e7 - 1.0) < 1e-14) == 2


def test_starting_values_that_are_zero_or_the_same_twice_lose_no_root():
    """As eigenvalues are where others of the same matrix are 1e20 times as large."""
    pairs, reals = [-5e-6 + 493j, -8e-14 + 588j, -2e-5 + 493j], [-2.6e21, -2.7e21]
    with localcontext(prec=60):
        polynomial = from_roots(pairs, reals)
        near = np.array([0, 0, -2.6e21 - 1e14j, -2.6e21 + 1e14j, 493j, -493j, 588j, -588j])
        found = sorted_roots(exact_roots(polynomial, near))
    expected = sorted_roots(all_of(pairs, reals))
    assert found.real == pytest.approx(expected.real, rel=1e-14, abs=0)
    assert found.imag == pytest.approx(expected.imag, rel=1e-14, abs=0)
