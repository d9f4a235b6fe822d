"""The file of a rotor for ROSS: its structure, and that its beams whirl as the machine does."""

import math
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorcalc as rc
from rotorcalc.ross_rotor import ross_axes, ross_rotor

SHEET = rc.PRESETS["sheet-1e7"].machine
SPEEDS = np.linspace(100.0, 1500.0, 29)
AT = 7  # 450 rad/s
ROTORS = {
    "bends": SHEET.rotor,
    "damped": replace(SHEET.rotor, journal_mass=20.0, disk_damping=4e3, imbalance=12e-6),
    "rigid": replace(SHEET.rotor, shaft_stiffness=math.inf),
}


def sweep_of(rotor):
    return rc.analyse(replace(SHEET, rotor=rotor), SPEEDS)


def document(rotor):
    return tomllib.loads(ross_rotor(sweep_of(rotor)))


def elements(document, kind):
    return [values for name, values in document.items() if name.split("_")[0] == kind]


def plane(one):
    """Return stiffness and consistent mass of a beam in one plane: place and slope at each end."""
    L, area = one["L"], math.pi * one["odl"] ** 2 / 4.0
    EI = one["material"]["E"] * math.pi * one["odl"] ** 4 / 64.0
    K = EI / L**3 * np.array([
        [12, 6 * L, -12, 6 * L], [6 * L, 4 * L * L, -6 * L, 2 * L * L],
        [-12, -6 * L, 12, -6 * L], [6 * L, 2 * L * L, -6 * L, 4 * L * L],
    ])  # fmt: skip
    m = one["material"]["rho"] * area * L / 420.0
    M = m * np.array([
        [156, 22 * L, 54, -13 * L], [22 * L, 4 * L * L, 13 * L, -3 * L * L],
        [54, 13 * L, 156, -22 * L], [-13 * L, -3 * L * L, -22 * L, 4 * L * L],
    ])  # fmt: skip
    return K, M


def eigenvalues(document, row):
    """Return λ of the beams, masses and bearings of a file at one row of its tables.

    In each plane places and slopes of three nodes, twelve in all: x first, then y.
    """
    M, C, K = (np.zeros((12, 12)) for _ in range(3))
    for one in elements(document, "ShaftElement"):
        for first in (2 * one["n"], 6 + 2 * one["n"]):
            four = slice(first, first + 4)
            stiffness, mass = plane(one)
            K[four, four] += stiffness
            M[four, four] += mass
    for one in elements(document, "DiskElement"):
        for place in (2 * one["n"], 6 + 2 * one["n"]):
            M[place, place] += one["m"]
            M[place + 1, place + 1] += one["Id"]
    for one in elements(document, "BearingElement"):
        places = [2 * one["n"], 6 + 2 * one["n"]]
        for matrix, letter in ((K, "k"), (C, "c")):
            entries = [one.get(f"{letter}{entry}", 0.0) for entry in ("xx", "xy", "yx", "yy")]
            here = [value[row] if isinstance(value, list) else value for value in entries]
            matrix[np.ix_(places, places)] += np.reshape(here, (2, 2))
    upper = np.hstack([np.zeros((12, 12)), np.eye(12)])
    lower = -np.linalg.solve(M, np.hstack([K, C]))
    return np.linalg.eigvals(np.vstack([upper, lower]))


@pytest.mark.parametrize("name", ROTORS)
def test_a_beam_model_of_the_file_has_the_machine_s_modes(name):
    rotor = ROTORS[name]
    found = eigenvalues(document(rotor), AT)
    known = sweep_of(rotor).flexible_eigenvalues[AT]
    known = known[known.imag > 0.0]
    assert len(known)
    for value in known:
        # The shaft's own small mass, and of a rigid one its remaining flexibility.
        assert np.abs(found - value).min() < (2e-3 if name == "rigid" else 1e-5) * abs(value)


@pytest.mark.parametrize("name", ROTORS)
def test_the_elements_are_those_of_the_machine(name):
    rotor, of = ROTORS[name], document(ROTORS[name])
    assert [one["n"] for one in elements(of, "ShaftElement")] == [0, 1]
    masses = {one["n"]: one["m"] for one in elements(of, "DiskElement")}
    assert sum(masses.values()) == pytest.approx(rotor.mass)
    assert masses.get(0, 0.0) == masses.get(2, 0.0) == rotor.journal_mass
    light = sum(
        one["material"]["rho"] * math.pi * one["odl"] ** 2 / 4.0 * one["L"]
        for one in elements(of, "ShaftElement")
    )
    assert light < 1e-6 * rotor.mass
    assert [one["n"] for one in elements(of, "BearingElement")] == (
        [0, 2, 1] if rotor.disk_damping else [0, 2]
    )
    assert of["parameters"] == {}


def test_the_tables_are_the_sweep_s_to_the_last_bit_in_ross_s_axes():
    sweep = sweep_of(SHEET.rotor)
    bearing = elements(document(SHEET.rotor), "BearingElement")[0]
    assert bearing["frequency"] == SPEEDS.tolist()
    for letter, matrix in (("k", sweep.stiffness), ("c", sweep.damping)):
        turned = ross_axes(matrix)
        for i, j in np.ndindex(2, 2):
            assert bearing[f"{letter}{'xy'[i]}{'xy'[j]}"] == turned[:, i, j].tolist()
    # The load acts along −y there: k_yy is this program's K_XX.
    assert bearing["kyy"] == sweep.stiffness[:, 0, 0].tolist()
    assert_allclose(bearing["kxy"], -sweep.stiffness[:, 1, 0])


def test_a_comment_has_the_imbalance_and_a_rigid_shaft():
    text = ross_rotor(sweep_of(ROTORS["damped"]))
    unbalance = 2.0 * ROTORS["damped"].disk_mass * 12e-6
    assert f"unbalance_magnitude={unbalance!r} kg m" in text
    assert "all but rigid" in ross_rotor(sweep_of(ROTORS["rigid"]))


def test_speeds_that_do_not_rise_are_refused():
    with pytest.raises(ValueError, match=r"sweep\.speed"):
        ross_rotor(rc.analyse(SHEET, 500.0))
