"""The chart of onsets on bearings side by side."""

from dataclasses import replace

import numpy as np
import pytest

import rotorcalc as rc
from rotorcalc.comparison import BearingResult
from rotorcalc.figures import comparison, style
from rotorcalc.units import SI
from tests.machines import SHEET

RPM = np.pi / 30.0


@pytest.fixture(scope="module")
def plain() -> BearingResult:
    return rc.compare_bearings(SHEET, (rc.Plain(),), speed=6000.0 * RPM)[0]


def test_bars_rise_from_the_lowest_onset_and_are_red_where_it_is_passed(
    plain: BearingResult,
) -> None:
    onsets = {"b": 9000.0, "none": np.inf, "refused": np.nan, "a": 5000.0}
    found = [replace(plain, onset=onset * RPM) for onset in onsets.values()]
    chart = comparison.onsets(found, list(onsets), 6000.0 * RPM, SI)
    bars, running = chart["data"]
    low, top = chart["layout"]["xaxis"]["range"]
    assert chart["layout"]["yaxis"]["ticktext"] == ["a  <b>5000</b>", "b  <b>9000</b>", "none"]
    np.testing.assert_allclose(bars["x"], [5000.0, 9000.0, top])
    assert bars["text"] == ["", "", "no onset found"]
    assert [colour == style.UNSTABLE for colour in bars["marker"]["color"]] == [True, False, False]
    np.testing.assert_allclose(running["x"], 6000.0)
    assert low == 0.0
    assert top > 9000.0
