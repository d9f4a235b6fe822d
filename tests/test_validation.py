"""The live validation: every verdict true, and each of the formulas able to turn one false."""

import datetime as dt
import functools
import math
from dataclasses import replace
from pkgutil import resolve_name

import numpy as np
import pytest

from rotorcalc import analysis, modes, validation
from rotorcalc.films import short
from rotorcalc.films.short import force_coefficients
from rotorcalc.onset import search
from rotorcalc.validation import Case, finite
from ui import notes
from ui.notes.equations import EQUATIONS

CASES = validation.validate()


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.group}: {case.name}")
def test_every_check_holds(case):
    assert case.holds, f"{case.value!r} and {case.reference!r}"


def failed():
    return {case.name for case in validation.validate() if not case.holds}


def scaled(function, factor):
    @functools.wraps(function)
    def wrong(*args, **kwargs):
        return function(*args, **kwargs) * factor

    return wrong


@pytest.mark.parametrize(
    ("module", "name", "factor", "check"),
    [
        (short, "film_stiffness", 1 + 1e-6, "K of Eq. 5.35 and of Eq. 5.30"),
        (short, "film_stiffness", 1 + 1e-6, "K_ij and −∂F_i/∂X_j of the nonlinear force"),
        (short, "film_damping", 1 + 1e-6, "C_ij and −∂F_i/∂v_j of the nonlinear force"),
        (short, "radial_damping", 1 + 1e-6, "C_XX + C_YY and C_rr + C_tt"),
        (short, "film_force", 1 + 1e-6, "Nonlinear force at rest and the load"),
        (short, "pressure", 1 + 1e-6, "Force and the pressure summed"),
        (short, "eccentricity_ratio", 1 - 1e-9, "σ(ε(σ)) and σ, σ = 10⁻⁶ … 10⁶"),
        (short, "side_flow", 1.01, "Side flow and flow at the ends"),
        (short, "drag", 1.01, "Drag torque × speed and the heat"),
        (short, "added_mass", 1.01, "Trace of the added mass and ∫dθ/H"),
        (short, "stiffness", 1.001, "p_s² at ε = 10⁻⁶"),
        (short, "damping", np.array([[1.0, 1.0], [1.0, 1.001]]), "Whirl ratio"),
        (analysis, "flexible_threshold", 1 + 1e-6, "Threshold speed there, Friswell's bearing"),
        (modes, "eigenvalues", 1.001, "|Im λ|/Ω there"),
        (modes, "undamped_frequency", 1.001, "√(K_rot/M), K_rot = 10⁸ N/m"),
        (modes, "state_matrix", 1.001, "A v and λ v, 6 states"),
    ],
)
def test_a_broken_formula_fails_its_check(monkeypatch, module, name, factor, check):
    right = getattr(module, name)
    monkeypatch.setattr(module, name, scaled(right, factor))
    if name == "state_matrix":  # only one of the two sides of A v = λ v must be broken
        shapes = modes.mode_shapes
        monkeypatch.setattr(modes, "mode_shapes", lambda rotor, K, C: shapes(rotor, 1.01 * K, C))
    assert check in failed()


@pytest.mark.parametrize(
    ("field", "check"),
    [
        ("stiffness", "k_ij, elliptical, L/D = 1, S = 0.12"),
        ("damping", "c_ij, lobes, L/D = 0.5, S = 0.637"),
        ("position", "ε, L/D = 0.5, S = 0.319"),
        ("stiffness", "p_s, set 1, bearing 1"),
    ],
)
def test_a_wrong_film_of_finite_length_fails_its_check(monkeypatch, field, check):
    right = finite.film_state

    def wrong(bearing, sigma):
        film = right(bearing, sigma)
        return replace(film, **{field: 1.1 * getattr(film, field)})

    monkeypatch.setattr(finite, "film_state", wrong)
    assert check in failed()


def test_the_checks_detect_a_misprint_of_the_source(monkeypatch):
    def printed(eps, s2, radial, tangential):
        k = right(eps, s2, radial, tangential)
        fr2 = 16 * eps**2 / (16 * eps**2 + np.pi**2 * s2)
        k[..., 1, 1] = radial / s2 * (fr2 + s2)
        return k

    right = force_coefficients.xy_stiffness
    monkeypatch.setattr(force_coefficients, "xy_stiffness", printed)
    assert "K_XX + K_YY and K_rr + K_tt" in failed()


def test_the_checks_detect_a_wrong_onset(monkeypatch):
    right = search.searched_onset

    def wrong(machine, flexible=True):
        found = right(machine, flexible)
        return replace(found, speed=found.speed * 0.99)

    monkeypatch.setattr(search, "searched_onset", wrong)
    assert "Onset, sheet's rotor, K_rot = 10⁷ N/m" in failed()


def test_a_check_without_a_number_or_beyond_its_tolerance_fails():
    assert not Case("", "", math.nan, 0.0, 1.0, "").holds
    assert Case("", "", 1.0, 1.5, 0.5, "").holds
    assert not Case("", "", 1.0, 1.6, 0.5, "").holds


def test_tables_and_verdict_say_what_failed():
    good, bad = Case("g", "a|b", 1.0, 1.0, 0.0, "s"), Case("g", "c", 1.0, 2.0, 0.5, "s")
    table = notes.checks((good, bad))
    assert table.count("✓ holds") == 1
    assert table.count("✗ **fails**") == 1
    assert r"a\|b" in table
    when = dt.datetime(2031, 5, 7, 14, 30, tzinfo=dt.UTC)
    said = notes.verdict((good,), when)
    assert said.startswith("All 1 checks hold")
    assert "07 May 2031 at 14:30 UTC" in said
    assert notes.verdict((good, bad), when).startswith("1 of 2 checks fail")


def test_every_function_named_beside_an_equation_exists():
    for item in (item for items in EQUATIONS.values() for item in items):
        for name in item.functions:
            assert callable(resolve_name(f"rotorcalc.{name}"))
