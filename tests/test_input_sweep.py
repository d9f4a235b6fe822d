"""A machine over one input: each value's own onset, damping and film, whoever computes it."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

import rotorcalc as rc
from rotorcalc.input_sweep import InputSweep, input_sweep
from rotorcalc.variation import varied
from tests.machines import RPM, SHEET

SPEED = 8700 * RPM
ELLIPSE = replace(
    SHEET, bearing=replace(SHEET.bearing, geometry=rc.Elliptical(preload=0.2), film="short")
)
CLEARANCES = np.linspace(40e-6, 90e-6, 11)


@pytest.fixture(scope="module")
def over_clearance() -> InputSweep:
    return input_sweep(SHEET, vary="radial_clearance", values=CLEARANCES, speed=SPEED)


def test_each_value_is_a_machine_of_its_own(over_clearance: InputSweep) -> None:
    for i in (0, 7, 10):
        one = varied(SHEET, {"radial_clearance": CLEARANCES[i]})
        assert over_clearance.onset[i] == pytest.approx(rc.onset_speed(one).speed, rel=1e-12)
        point = rc.analyse(one, SPEED)
        assert over_clearance.minimum_film_thickness[i] == point.minimum_film_thickness
        values = point.flexible_eigenvalues
        swings = values[values.imag > 0.0]
        slowest = np.min(-2.0 * np.pi * swings.real / swings.imag)
        assert over_clearance.log_decrement[i] == pytest.approx(slowest, rel=1e-9)
    np.testing.assert_array_equal(over_clearance.margin, over_clearance.onset / SPEED - 1.0)


@pytest.mark.parametrize(("machine", "vary", "ends"), [
    (SHEET, "radial_clearance", (50e-6, 80e-6)), (ELLIPSE, "preload", (0.01, 0.6)),
])  # fmt: skip
def test_where_the_margin_is_zero_nothing_is_damped(machine, vary, ends) -> None:
    def margin(value: float) -> float:
        return float(input_sweep(machine, vary=vary, values=[value], speed=speed).margin[0])

    middle = varied(machine, {vary: float(np.mean(ends))})
    speed = rc.onset_speed(middle).speed
    value = brentq(margin, *ends, xtol=1e-12)
    found = input_sweep(machine, vary=vary, values=[value], speed=speed)
    assert abs(found.log_decrement[0]) < 1e-7


def test_an_executor_gives_the_same_and_progress_rises(over_clearance: InputSweep) -> None:
    told: list[float] = []
    with ThreadPoolExecutor(2) as pool:
        other = input_sweep(
            SHEET, vary="radial_clearance", values=CLEARANCES, speed=SPEED, executor=pool,
            progress=told.append,
        )  # fmt: skip
    np.testing.assert_array_equal(other.onset, over_clearance.onset)
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_what_is_no_machine_has_no_number_and_what_never_whirls_no_end() -> None:
    found = input_sweep(SHEET, vary="radial_clearance", values=[-1e-6, 60e-6], speed=SPEED)
    assert np.isnan([found.onset[0], found.margin[0], found.log_decrement[0]]).all()
    assert np.isfinite(found.onset[1])
    damped = input_sweep(SHEET, vary="disk_damping", values=[0.0, 1e6], speed=SPEED)
    assert np.isinf(damped.onset[1])


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"vary": "size"}, "no input of a machine"),
        ({"values": []}, "values: must be a list"),
        ({"values": 5e-5}, "values: must be a list"),
        ({"speed": -1.0}, "speed"),
    ],
)
def test_what_cannot_be_swept_is_named(change: dict, words: str) -> None:
    given = {"vary": "radial_clearance", "values": CLEARANCES, "speed": SPEED} | change
    with pytest.raises(ValueError, match=words):
        input_sweep(SHEET, **given)
