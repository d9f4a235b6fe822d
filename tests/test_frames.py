"""Frames: turning force coefficients from the line of centres to the load and back."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc.frames import matrix, rotate, vector
from tests.machines import EPS

elements = st.lists(st.floats(-100, 100), min_size=4, max_size=4)
angles = st.floats(-10, 10)


@given(elements, angles)
def test_turning_back_undoes_a_turn(elements, angle):
    M = np.reshape(elements, (2, 2))
    # Each product of two matrices rounds twice an element; an angle of 10 rounds cos by EPS.
    assert rotate(rotate(M, angle), -angle) == pytest.approx(M, abs=16 * EPS * 200)


@given(elements, angles)
def test_a_turn_keeps_trace_determinant_and_the_skew_part(elements, angle):
    M = np.reshape(elements, (2, 2))
    turned = rotate(M, angle)
    assert np.trace(turned) == pytest.approx(np.trace(M), abs=16 * EPS * 200)
    (a, b), (c, d) = turned
    expected = elements[0] * elements[3] - elements[1] * elements[2]
    assert a * d - b * c == pytest.approx(expected, abs=32 * EPS * 200**2)
    assert turned[0, 1] - turned[1, 0] == pytest.approx(M[0, 1] - M[1, 0], abs=16 * EPS * 200)


@given(elements, st.floats(-3, 3), st.tuples(st.floats(-1, 1), st.floats(-1, 1)))
def test_forces_rotate_with_their_displacements(elements, phi, displacement):
    """Eq. 5.16 follows from Eq. 5.11: with X = Q r and F = Q f, F = Q K Qᵀ X where f = K r."""
    K, r = np.reshape(elements, (2, 2)), np.array(displacement)
    Q = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])  # Eq. 5.11
    assert rotate(K, phi) @ (Q @ r) == pytest.approx(Q @ (K @ r), abs=16 * EPS * 400)


def test_a_quarter_turn_takes_x_to_y():
    turned = rotate([[1.0, 2.0], [3.0, 4.0]], np.pi / 2)
    assert turned == pytest.approx(np.array([[4.0, -3.0], [-2.0, 1.0]]), abs=8 * EPS)


def test_leading_axes_broadcast():
    M = np.arange(24.0).reshape(2, 3, 2, 2)
    angle = np.array([0.1, 0.2, 0.3])
    turned = rotate(M, angle)
    assert turned.shape == (2, 3, 2, 2)
    assert np.array_equal(turned[1, 2], rotate(M[1, 2], 0.3))


@pytest.mark.parametrize("shape", [(), (3,), (2, 3), (0,)])
def test_matrix_and_vector_put_the_elements_on_trailing_axes(shape):
    x = np.ones(shape)
    assert matrix(x, 2.0, 3.0, 4.0).shape == (*shape, 2, 2)
    assert np.all(matrix(x, 2.0, 3.0, 4.0) == [[1.0, 2.0], [3.0, 4.0]])
    assert vector(x, 5.0).shape == (*shape, 2)
    assert np.all(vector(x, 5.0) == [1.0, 5.0])
