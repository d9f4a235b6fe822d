"""What films cost: `make bench`. No test, for timing depends on the machine.

To be read beside `numpy.linalg.eigvals` of a 200×200 matrix in the same run. Aims: a geometry never
asked before, 240 speeds, 5 times as long with two or three pads, 7 with four, 10 with pockets; a
known one at most 1.5 times as long as the short film.
"""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import analyse
from rotorcalc.films import film_of
from rotorcalc.films.finite.table import table
from tests.films.models import FINITE, SHORT_PADS
from tests.machines import RPM, SHEET

SPEEDS = np.linspace(600.0, 12000.0, 240) * RPM


@pytest.mark.benchmark(group="240 speeds, cold")
def test_eigvals_of_200(benchmark):
    matrix = np.random.default_rng(0).normal(size=(200, 200))
    assert benchmark(np.linalg.eigvals, matrix).shape == (200,)


@pytest.mark.benchmark(group="240 speeds, cold")
@pytest.mark.parametrize("name", FINITE)
def test_a_geometry_nobody_asked_before(benchmark, name):
    machine = replace(SHEET, bearing=FINITE[name])

    def forget():
        table.cache_clear()
        film_of.__wrapped__.cache_clear()

    sweep = benchmark.pedantic(lambda: analyse(machine, SPEEDS), setup=forget, rounds=7)
    assert sweep.stiffness.shape == (240, 2, 2)


@pytest.mark.benchmark(group="240 speeds, known")
@pytest.mark.parametrize("name", ["short", *FINITE, *SHORT_PADS])
def test_a_known_geometry(benchmark, name):
    bearing = SHEET.bearing if name == "short" else (FINITE | SHORT_PADS)[name]
    machine = replace(SHEET, bearing=bearing)
    assert benchmark(analyse, machine, SPEEDS).stiffness.shape == (240, 2, 2)
