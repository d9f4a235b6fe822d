"""What tolerances and files of machines cost: `make bench`. No test: timing depends on the machine.

Aims on two cores: a million onsets of short bearings in a minute, 120 µs of a processor each, and
ten thousand bores of finite length in five minutes, 60 ms each.
"""

from dataclasses import replace

import pytest

import rotorcalc as rc
from tests.machines import RPM, SHEET

CLEARANCE = {"radial_clearance": ("uniform", 50e-6, 80e-6), "temperature": ("normal", 60.0, 4.0)}
ELLIPSE = replace(SHEET, bearing=replace(SHEET.bearing, geometry=rc.Elliptical()))


@pytest.mark.benchmark(group="tolerance")
def test_20000_short_bearings(benchmark):
    found = benchmark.pedantic(rc.tolerance, (SHEET, CLEARANCE, 20_000, 1), rounds=3)
    assert len(found.onset) == 20_000


@pytest.mark.benchmark(group="tolerance")
def test_first_order_indices_of_20000_samples(benchmark):
    found = rc.tolerance(SHEET, CLEARANCE, 20_000, 1)
    assert len(benchmark(lambda: found.influences)) == 2


@pytest.mark.benchmark(group="tolerance")
def test_100_bores_of_finite_length(benchmark):
    seeds = iter(range(100))  # other bores each time, as each one's table is kept

    def study():
        spreads = CLEARANCE | {"preload": ("uniform", 0.3, 0.6)}
        return rc.tolerance(ELLIPSE, spreads, 100, next(seeds), speed=6000 * RPM)

    assert benchmark.pedantic(study, rounds=3).answered.all()


@pytest.mark.benchmark(group="batch")
def test_1000_lines_of_a_table(benchmark):
    header = "radial_clearance [µm],load [lbf],temperature [°F]"
    text = "\n".join([header, *(f"{50 + 0.01 * i:g},300,140" for i in range(1000))])
    assert len(benchmark(rc.read_machines, text, SHEET).cases) == 1000


@pytest.mark.benchmark(group="batch")
def test_results_of_one_machine(benchmark):
    cases = rc.read_machines("speed [rpm]\n6000", SHEET).cases
    assert benchmark(rc.batch.results, cases)[0].refusal == ""
