"""Dimensionless tables: made from a short bearing of the program, and read back real."""

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse, read_coefficients
from rotorcalc.coefficient_files import Scale
from tests.coefficient_files.tables import NAMES, RPM, text

MACHINE = PRESETS["sheet-1e8"].machine
SPEEDS = np.array([2000.0, 4000.0, 8000.0]) * RPM
SWEEP = analyse(MACHINE, SPEEDS)
D, L, CLEARANCE = (
    MACHINE.bearing.diameter, MACHINE.bearing.length, MACHINE.bearing.radial_clearance
)  # fmt: skip
MU, W = float(SWEEP.viscosity[0]), MACHINE.static_load
OF_BEARING = {"diameter": D, "length": L, "radial_clearance": CLEARANCE, "viscosity": MU, "load": W}
# The definitions, written out once more.
SOMMERFELD = {
    "classical": MU * SPEEDS / (2 * np.pi) * D * L / W * (D / 2 / CLEARANCE) ** 2,
    "modified": MU * SPEEDS * L * (D / 2) / (4 * W) * (L / CLEARANCE) ** 2,
    "DIN": W * (2 * CLEARANCE / D) ** 2 / (D * L * MU * SPEEDS),
}


def table(sommerfeld, normalised_by="load", header=("S", "eps", "phi [°]", *NAMES)):
    """Return a handbook's page of the bearing."""
    at = SPEEDS[:, None, None]
    if normalised_by == "load":
        k, c = SWEEP.stiffness * CLEARANCE / W, SWEEP.damping * CLEARANCE * at / W
    else:
        film = MU * L * (D / 2 / CLEARANCE) ** 3
        k, c = SWEEP.stiffness / (film * at), SWEEP.damping / film
    columns = [
        SOMMERFELD[sommerfeld], SWEEP.eccentricity_ratio, np.degrees(SWEEP.attitude_angle),
        *k.reshape(-1, 4).T, *c.reshape(-1, 4).T,
    ]  # fmt: skip
    return "\n".join([" ".join(header), *(" ".join(map(repr, row)) for row in _rows(columns))])


def _rows(columns):
    return np.stack(columns, axis=-1)[::-1].tolist()  # as handbooks do, from slow to fast or not


@pytest.mark.parametrize("sommerfeld", SOMMERFELD)
@pytest.mark.parametrize("normalised_by", ["load", "viscosity"])
def test_a_page_of_a_handbook_is_the_bearing_again(sommerfeld, normalised_by):
    scale = Scale(**OF_BEARING, sommerfeld=sommerfeld, normalised_by=normalised_by)
    read = read_coefficients(table(sommerfeld, normalised_by), scale=scale)
    for name in ("speed", "stiffness", "damping", "eccentricity_ratio", "attitude_angle"):
        np.testing.assert_allclose(getattr(read, name), getattr(SWEEP, name), rtol=1e-12)
    assert read.kind == "dimensionless"
    assert not read.warnings
    assert sum("read as" in words for words in read.notes) == 2


def test_the_modified_number_is_the_programs():
    np.testing.assert_allclose(SOMMERFELD["modified"], SWEEP.sommerfeld, rtol=1e-12)


def test_without_a_header_eleven_columns_are_one_too_and_degrees_are_told():
    scale = Scale(**OF_BEARING)
    read = read_coefficients(table("classical", header=()), scale=scale)
    np.testing.assert_allclose(read.attitude_angle, SWEEP.attitude_angle, rtol=1e-12)
    np.testing.assert_allclose(read.stiffness, SWEEP.stiffness, rtol=1e-12)
    assert [column.unit for column in read.columns if column.key == "φ"] == ["°"]
    assert any("taken to be S, ε, φ, K_xx" in words for words in read.notes)


@pytest.mark.parametrize(
    ("has", "said", "words"),
    [("modified", "classical", "look like the modified"),
     ("classical", "modified", "look like the classical"),
     ("DIN", "classical", "those do that are of DIN 31652"),
     ("classical", "DIN", "those do that are classical")],
)  # fmt: skip
def test_another_sommerfeld_number_than_was_said_is_told_by_the_eccentricities(has, said, words):
    # Half as long as wide the two differ by a factor of 4/π only; a shorter one tells them apart.
    short = OF_BEARING | {"length": D / 8}
    eps = np.array([0.2, 0.5, 0.8])
    sigma = (1 - eps**2) ** 2 / (eps * np.sqrt(16 * eps**2 + np.pi**2 * (1 - eps**2)))
    S = sigma / np.pi * 64
    number = {"classical": S, "modified": sigma, "DIN": 1 / (2 * np.pi * S)}[has]
    rows = [(s, e, *[1.0] * 8) for s, e in zip(number, eps, strict=True)]
    page = text(header=("S", "e", *NAMES), rows=rows)
    [warning] = [
        one for one in read_coefficients(page, scale=Scale(**short, sommerfeld=said)).warnings
        if "Sommerfeld" in one or "numbers look" in one
    ]  # fmt: skip
    assert words in warning
    right = read_coefficients(page, scale=Scale(**short, sommerfeld=has))
    assert not [one for one in right.warnings if "Sommerfeld" in one]


def test_what_is_missing_or_no_bearing_is_refused():
    with pytest.raises(ValueError, match="is dimensionless, over a Sommerfeld number: it needs"):
        read_coefficients(table("classical"))
    with pytest.raises(ValueError, match=r"load = 0\.0: must be positive"):
        Scale(**OF_BEARING | {"load": 0.0})
    with pytest.raises(ValueError, match="sommerfeld = 'mine': must be 'classical' or"):
        Scale(**OF_BEARING, sommerfeld="mine")
    page = table("classical").replace("Kxx", "Kxx [N/m]")
    with pytest.raises(ValueError, match=r"column 4: 'Kxx \[N/m\]' names a unit, but"):
        read_coefficients(page, scale=Scale(**OF_BEARING))
    with pytest.raises(ValueError, match=r"no column of speed \(columns not known: 'Drehzahl"):
        read_coefficients("Drehzahl [rpm],Kxx [MN/m],Cxx\n1,2,3\n2,3,4\n")
    rows = [(0.1, 1.2, 40.0, *[1.0] * 8), (0.2, 0.6, 40.0, *[1.0] * 8)]
    page = text(header=("S", "eps", "phi", *NAMES), rows=rows)
    with pytest.raises(ValueError, match=r"^line 2, column 2 \(ε\): 1.2: must be from 0 to below"):
        read_coefficients(page, scale=Scale(**OF_BEARING))
