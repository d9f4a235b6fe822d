"""Amplitude and phase written from a computed response lie on it when they are read back."""

import contextlib
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotorcalc import MeasuredResponse, analyse, orbit_ellipse, read_vibration_over_speed
from rotorcalc.measured import response_table
from rotorcalc.unbalance_response import phase_lag
from tests.machines import RPM, SHEET

SPEEDS = np.linspace(1000.0, 8000.0, 30) * RPM
SWEEP = analyse(SHEET, SPEEDS)
TABLE = response_table(SPEEDS, SWEEP.journal_response)
HEAD = "speed [rpm],amplitude 1 [µm],phase 1 [°],amplitude 2 [µm],phase 2 [°]"


def read(table: str | bytes, **how: object) -> MeasuredResponse:
    return read_vibration_over_speed(table, **{"reading": "p-p", "phase": "lag"} | how)


def test_a_response_read_back_lies_on_the_response() -> None:
    found = read(TABLE)
    assert found.speed == pytest.approx(SPEEDS, rel=1e-9)
    assert found.response == pytest.approx(SWEEP.journal_response, rel=1e-8)
    assert found.lag == pytest.approx(phase_lag(SWEEP.journal_response), abs=1e-8)
    major = orbit_ellipse(SWEEP.journal_response).semi_major
    assert found.ellipse.semi_major == pytest.approx(major, rel=1e-8)
    assert found.amplitude == pytest.approx(np.abs(SWEEP.journal_response), rel=1e-8)


@settings(max_examples=20)
@given(first=st.floats(-180.0, 180.0), apart=st.floats(12.0, 168.0), mark=st.floats(-3.0, 3.0))
def test_neither_the_probes_nor_the_mark_change_the_response(
    first: float, apart: float, mark: float
) -> None:
    angles = math.radians(first), math.radians(first + apart)
    # A mark that passes the keyphasor when the imbalance is that angle ahead of X: all peaks come
    # that much earlier after its pulse.
    ahead = SWEEP.journal_response * np.exp(1j * mark)
    table = response_table(SPEEDS, ahead, angles=angles)
    found = read(table, angles=angles, imbalance_angle=mark)
    assert found.response == pytest.approx(SWEEP.journal_response, rel=1e-6, abs=1e-13)


def test_zero_to_peak_lead_gap_other_units_and_the_order_of_lines() -> None:
    text = (
        "phase 2 [°];amplitude 2 [mil];speed [Hz];note;amplitude 1 [mil 0-p];phase 1 [rad]\n"
        "90;2;20;a;1;0\n"
        "0;4;10;b;3;0\n"
    )
    angles = (0.0, math.pi / 2)
    found = read(text, reading="0-p", phase="lead", angles=angles)
    assert found.speed == pytest.approx(2.0 * math.pi * np.array([10.0, 20.0]))
    assert found.response / 25.4e-6 == pytest.approx(np.array([[3.0, 4.0], [1.0, 2.0j]]))
    assert found.unread == ("note",)
    late = read(text, reading="0-p", phase="lag", reads="gap", angles=angles)
    assert late.response == pytest.approx(-found.response.conj())
    # What the header does not say is as it is asked.
    plain = text.replace(" 0-p", "")
    assert read(plain, angles=angles).amplitude == pytest.approx(0.5 * found.amplitude)


@pytest.mark.parametrize(
    ("text", "how", "words"),
    [
        (TABLE, {"reading": "0-p"}, "amplitude 1 is p-p, but amplitudes were said to be 0-p"),
        (TABLE, {"angles": (1.0, 1.05)}, "nearly parallel"),
        (TABLE, {"angles": (1.0,)}, "1 of them, must be two"),
        (TABLE, {"imbalance_angle": 7.0}, "imbalance_angle = 7 rad"),
        (TABLE, {"reading": "rms"}, "reading = 'rms': must be '0-p' or 'p-p'"),
        (TABLE.replace("phase 2", "other"), {}, r"has no column 'phase 2 \[°\]'"),
        (f"{HEAD}\n1,2,3,4,5\n", {}, "has 1 rows of numbers, must have 2"),
        (f"{HEAD}\n1,2,3,4,5\n2,2,3,-4,5", {}, "line 3, column amplitude 2: must be zero or more"),
        (f"{HEAD}\n1,2,3,4,5\n0,2,3,4,5", {}, "line 3, column speed: must be 0.01 to"),
        (f"{HEAD}\n1,2,3,4,5\n2,2,3,4,1e9", {}, "line 3, column phase 2: must be within"),
        (f"{HEAD}\n1,2,3,4,5\n\n1,2,3,4,5", {}, "line 4, column speed: the same as on line 2"),
        (f"{HEAD}\n1,2,3,4,5\n2,@SUM(A1),3,4,5", {}, "line 3, column amplitude 1 .*a formula"),
    ],
)
def test_what_is_wrong_is_named(text: str, how: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        read(text, **how)


CELL = st.sampled_from(["0", "1", "-2.5", "1e9", "1e-9", "", "=1", "a", "nan", "7000", "1e12"])


@settings(max_examples=60)
@given(cells=st.lists(st.lists(CELL, min_size=5, max_size=5), max_size=4), raw=st.binary())
def test_any_cells_and_bytes_are_a_response_or_refused(cells: list[list[str]], raw: bytes) -> None:
    rows = "\n".join(map(",".join, cells))
    for table in (f"{HEAD}\n{rows}", raw):
        with contextlib.suppress(ValueError):
            found = read(table)
            assert np.isfinite(found.response).all()
            assert (np.diff(found.speed) > 0.0).all()
