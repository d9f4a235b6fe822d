"""The first value on at which a film answers, where a few values have a table of their own."""

import numpy as np
import pytest

from rotorcalc.arrays import Array
from rotorcalc.numerics.first_answer import from_first_answer

VALUES = np.geomspace(0.01, 100.0, 240)
FEW = 8


class Film:
    """Refuses values below its least, which is higher for a few together than for many."""

    def __init__(self, many: float, few: float) -> None:
        self.least = {False: many, True: few}
        self.asked: list[int] = []

    def __call__(self, values: Array) -> Array:
        self.asked.append(len(values))
        if values[0] < self.least[len(values) <= FEW]:
            raise ValueError("too heavy")
        return values


@pytest.mark.parametrize("least", [0.0, 0.0101, 0.3, 7.0, 60.0])
@pytest.mark.parametrize("beside", [0.99, 1.0, 1.03])
def test_all_that_many_together_are_answered_is_returned(least: float, beside: float) -> None:
    film = Film(least, beside * least)
    expected = VALUES[least <= VALUES]
    assert from_first_answer(film, VALUES) == pytest.approx(expected, rel=1e-15)
    # No table is made for a few.
    assert min(film.asked) > FEW
    assert len(film.asked) < 12


def test_what_the_last_value_is_refused_for_is_said() -> None:
    with pytest.raises(ValueError, match="too heavy"):
        from_first_answer(Film(1e3, 1e3), VALUES)
