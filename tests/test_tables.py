"""A sweep as a table: every number is there, under a name with its unit."""

import subprocess
import sys
from dataclasses import fields

import numpy as np
import pytest

import rotorcalc as rc
from rotorcalc.tables import dataframe
from tests.machines import SHEET, with_rotor

SPEEDS = np.linspace(1000, 12000, 40) * rc.rpm
SWEEP = rc.analyse(SHEET, SPEEDS)
TABLE = SWEEP.to_dataframe()


def test_a_table_has_one_row_per_speed_and_a_unit_in_every_column_name():
    assert len(TABLE) == 40
    assert all(name.endswith("]") and " [" in name and "[]" not in name for name in TABLE)
    assert not TABLE.columns.duplicated().any()
    assert TABLE["speed [rad/s]"].to_numpy() == pytest.approx(SPEEDS)


def test_every_field_is_in_the_table():
    for field in fields(SWEEP):
        if field.name != "machine":
            assert any(name.startswith(field.name) for name in TABLE), field.name


def test_columns_are_named_by_quantity_element_and_unit():
    for name in (
        "side_flow [m³/s]", "stiffness_XY [N/m]", "damping_YY [N·s/m]", "critical_mass [kg]",
        "journal_position_Y [m]", "disk_response_X_amplitude [m]", "journal_response_Y_lag [rad]",
        "eigenvalue_6_imag [rad/s]",
    ):  # fmt: skip
        assert name in TABLE


def test_elements_of_a_matrix_keep_their_positions():
    assert TABLE["stiffness_XY [N/m]"].to_numpy() == pytest.approx(SWEEP.stiffness[:, 0, 1])
    assert TABLE["stiffness_YX [N/m]"].to_numpy() == pytest.approx(SWEEP.stiffness[:, 1, 0])


def test_amplitude_and_lag_give_the_phasors_back():
    """X lags cos Ωt, whose phasor is 1, and Y lags sin Ωt, whose phasor is −j."""
    for axis, phasor, response in (("X", 1.0, 0), ("Y", -1j, 1)):
        amplitude = TABLE[f"disk_response_{axis}_amplitude [m]"].to_numpy()
        lag = TABLE[f"disk_response_{axis}_lag [rad]"].to_numpy()
        found = amplitude * phasor * np.exp(-1j * lag)
        assert found == pytest.approx(SWEEP.disk_response[:, response], rel=1e-12)


def test_eigenvalues_are_the_sweeps():
    real = TABLE.filter(like="_real [1/s]").to_numpy()
    imag = TABLE.filter(like="_imag [rad/s]").to_numpy()
    found = np.sort_complex(real + 1j * imag)
    assert found == pytest.approx(np.sort_complex(SWEEP.flexible_eigenvalues))


def test_one_speed_has_one_row_with_the_same_columns():
    table = rc.analyse(SHEET, 600.0).to_dataframe()
    assert len(table) == 1
    assert list(table) == list(TABLE)


def test_a_body_at_rest_has_no_phase_lag():
    table = rc.analyse(with_rotor(imbalance=0.0), SPEEDS).to_dataframe()
    assert table["disk_response_X_amplitude [m]"].eq(0.0).all()
    assert table["disk_response_X_lag [rad]"].isna().all()


def test_speeds_in_two_dimensions_make_no_table():
    with pytest.raises(ValueError, match=r"^speed: must have the shape \(n,\) for a table"):
        rc.analyse(SHEET, SPEEDS.reshape(4, 10)).to_dataframe()


def test_pandas_is_not_loaded_before_a_table_is_asked_for():
    code = "import sys, rotorcalc; assert 'pandas' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_where_pandas_is_missing_the_error_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="needs pandas: pip install pandas"):
        dataframe({})


def test_no_speeds_have_no_row_and_the_same_columns():
    table = rc.analyse(SHEET, []).to_dataframe()
    assert table.shape == (0, TABLE.shape[1])
    assert list(table.columns) == list(TABLE.columns)
