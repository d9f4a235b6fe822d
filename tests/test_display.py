"""Results in a notebook: a text that fits a screen, a table in HTML, nothing left out."""

import math
from dataclasses import fields

import numpy as np
import pytest

from rotorcalc import (
    analyse,
    bifurcation,
    energy_balance,
    film_curves,
    orbit_ellipse,
    simulate,
)
from rotorcalc.analysis import ForceCoefficients
from rotorcalc.display import LINES, WIDTH, Result, units
from rotorcalc.nonlinear.signals import spectrum
from rotorcalc.validity import Check
from tests.machines import RPM, SHEET

MOTION = simulate(SHEET, 600.0, revolutions=5)
SWEEP = analyse(SHEET, np.linspace(1000, 12000, 100) * RPM)
RESULTS = {
    "sweep": SWEEP,
    "one speed": analyse(SHEET, 600.0),
    "no speed": analyse(SHEET, np.empty(0)),
    "film curves": film_curves(SHEET.bearing, np.geomspace(0.01, 10, 50)),
    "transient": MOTION,
    "spectrum": spectrum(MOTION),
    "energy": energy_balance(SHEET, MOTION),
    "orbit": orbit_ellipse(1.0, -1j),
    "bifurcation": bifurcation(SHEET, lowest=0.98, highest=1.02),
}


def record_classes(base=Result):
    """Return all classes of results."""
    found = base.__subclasses__()
    return [*found, *(deeper for one in found for deeper in record_classes(one))]


@pytest.mark.parametrize("result", RESULTS.values(), ids=RESULTS)
def test_the_text_fits_a_screen_and_names_every_field(result):
    lines = repr(result).splitlines()
    assert lines[0] == type(result).__name__
    assert len(lines) <= LINES == 12
    assert max(map(len, lines)) <= WIDTH == 100
    assert all(" at 0x" not in line for line in lines)


@pytest.mark.parametrize("result", RESULTS.values(), ids=RESULTS)
def test_the_table_has_a_row_a_field_and_no_markup_of_its_texts(result):
    table = result._repr_html_()
    for field in fields(result):
        if not field.name.startswith("_"):
            assert f">{field.name}<" in table or f">{field.name}." in table, field.name
    assert table.count("<tr>") == table.count("</tr>") > len(fields(result)) - 2


@pytest.mark.parametrize("record", record_classes(), ids=lambda record: record.__name__)
def test_every_record_of_arrays_shows_itself_briefly(record):
    # Checks come several in a tuple: each is a line, which a test of theirs measures.
    assert (record.__repr__ is Result.__repr__) != (record is Check)


def test_the_text_gives_shape_range_and_unit():
    speed = repr(SWEEP).splitlines()[2]
    assert speed.split() == ["speed", "(100,)", "104.72", "…", "1256.6", "rad/s"]
    one = repr(RESULTS["one speed"]).splitlines()[2]
    assert one.split() == ["speed", "600", "rad/s"]


def test_nan_and_complex_numbers_have_a_range_too():
    x = np.array([3.0 + 4.0j, math.nan, 0.0, 0.0, 1.0])
    assert "size 0 … 2.5" in repr(orbit_ellipse(x, np.zeros(5)))
    assert "nan" in repr(orbit_ellipse(np.full(5, np.nan), np.zeros(5)))


def test_units_are_those_of_the_docstring():
    assert units(type(SWEEP))["side_flow"] == "m³/s"
    assert units(type(SWEEP))["stiffness"] == "N/m"
    assert units(type(SWEEP))["damping"] == "N·s/m"
    assert units(type(SWEEP))["flexible_threshold"] == "rad/s"
    assert units(type(RESULTS["energy"]))["kinetic"] == "J"
    # With dimensions or without: the docstring has both, so neither is claimed.
    assert units(ForceCoefficients)["stiffness"] == ""
