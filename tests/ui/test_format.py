"""Numbers as visitors type them, and as fields show them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ui.format import short, typed_number, without_noise


@pytest.mark.parametrize(
    ("word", "value"),
    [
        ("1334", 1334.0),
        ("1.334", 1.334),
        ("13,34", 13.34),
        ("0,334", 0.334),
        ("1234,567", 1234.567),
        ("1,334.5", 1334.5),
        ("1.334,5", 1334.5),
        ("1,334,000", 1334000.0),
        ("1.334.000", 1334000.0),
        ("1 334", 1334.0),
        ("1\u202f334,5", 1334.5),
        ("1'334.5", 1334.5),
        ("1_000", 1000.0),
        ("\u22125,5", -5.5),
        (" 60 ", 60.0),
        ("1,5e3", 1500.0),
        ("0", 0.0),
        ("-0.0", 0.0),
        ("1e-05", 1e-5),
        (60, 60.0),
        (0.1 + 0.2, 0.1 + 0.2),
        ("inf", float("inf")),
    ],
)
def test_a_number_that_can_mean_one_thing_is_read(word: object, value: float) -> None:
    assert typed_number(word) == value


@pytest.mark.parametrize(
    ("word", "answer"),
    [
        ("1,334", "can mean 1.334 or 1334"),
        ("-12,500", "can mean -12.500 or -12500"),
        ("1,334e3", "can mean 1.334e3 or 1334e3"),
        ("1e400", "too large"),
        ("-1e400", "too large"),
        ("1e-400", "too small"),
        ("", "not a number"),
        ("1 2", "not a number"),
        ("1,,2", "not a number"),
        ("1,33.4", "not a number"),
        ("1_0", "not a number"),
        ("0x10", "not a number"),
        (None, "not a number"),
        (True, "not a number"),
        ("60 µm", "not a number"),
    ],
)
def test_any_other_is_asked_back_in_words(word: object, answer: str) -> None:
    with pytest.raises(ValueError, match=answer):
        typed_number(word)


@given(st.floats(allow_nan=False))
def test_a_number_as_python_writes_it_is_read_exactly(value: float) -> None:
    assert typed_number(value) == value


@given(st.floats(1e-3, 1e12))
def test_what_a_field_shows_can_be_typed_again(value: float) -> None:
    assert typed_number(short(value)) == pytest.approx(value, rel=1e-5)


def test_the_rounding_of_other_elements_is_zero() -> None:
    matrices = np.array([[[4e8, 1e-7], [-1e-7, 4e8]], [[1e8, 1e3], [0.0, 1e8]]])
    shown = without_noise(matrices)
    assert np.count_nonzero(shown[0]) == 2
    assert np.array_equal(shown[1], matrices[1])
