"""The documentation's examples run as they stand, and say what the program says."""

import runpy
from pathlib import Path

import pytest

import rotorcalc as rc

EXAMPLES = Path(__file__).parents[1] / "docs" / "examples"
SHEET = rc.PRESETS["sheet-1e8"].machine


def printed(name: str, capsys: pytest.CaptureFixture[str]) -> str:
    runpy.run_path(f"{EXAMPLES / name}.py")
    return capsys.readouterr().out


def test_the_sheet(capsys: pytest.CaptureFixture[str]) -> None:
    said = printed("the_sheet", capsys)
    assert f"Onset of whirl: {rc.onset_speed(SHEET).speed / rc.rpm:.0f} rpm" in said
    assert "0.501 of that speed" in said


def test_which_bearing(capsys: pytest.CaptureFixture[str]) -> None:
    _, *rows = printed("which_bearing", capsys).splitlines()
    onsets = [float(row.split()[1]) for row in rows]
    assert len(rows) == 5
    assert onsets == sorted(onsets)
    assert rows[-1].startswith("tilting-pads")


def test_hysteresis(capsys: pytest.CaptureFixture[str]) -> None:
    *_, small, large = printed("hysteresis", capsys).splitlines()
    # A small push dies away, a large one ends on the cycle.
    assert float(small.split()[-2]) < 0.02
    assert float(large.split()[-2]) > 0.6


def test_within_tolerances(capsys: pytest.CaptureFixture[str]) -> None:
    said = printed("within_tolerances", capsys)
    assert "radial_clearance: 100.0 %" in said
    assert "with 95 % confidence" in said


def test_your_own_table(capsys: pytest.CaptureFixture[str]) -> None:
    said = printed("your_own_table", capsys)
    onset = float(said.splitlines()[-1].split()[-2])
    # The table holds the sheet's own coefficients, rounded, at every 2000 rpm.
    assert onset == pytest.approx(rc.onset_speed(SHEET).speed / rc.rpm, rel=2e-3)


def test_every_example_is_tested() -> None:
    names = {path.stem for path in EXAMPLES.glob("*.py")}
    assert names == {
        name.removeprefix("test_") for name in globals() if name.startswith("test_")
    } - {"every_example_is_tested"}  # fmt: skip
