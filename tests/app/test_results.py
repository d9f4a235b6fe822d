"""Results are the machine's own, named apart, and explained by the equation of their title."""

import re
from dataclasses import replace

import numpy as np
import pytest

import rotorcalc as rc
from rotorcalc.units import SI
from tests.app.session import visit
from tests.app.test_bearings import SPEED, TOP
from tests.machines import SHEET
from ui.computed import Computed
from ui.notes.equations import equation
from ui.results.row import explanation
from ui.results.table import RESULTS
from ui.words.coefficients import matrix


@pytest.mark.parametrize("key", [key for key, one in RESULTS.items() if "Eq." in one.number])
def test_an_explanation_titled_by_an_equation_shows_it(key: str) -> None:
    """It is written as the notes have it, or solved for the result: the same to both sides."""
    result, shown = RESULTS[key], Computed(SHEET, SPEED, TOP)
    number = result.number.removeprefix("Eq. ")
    said = explanation(result, shown, SI)
    solved = {"static_load", "eccentricity_ratio", "attitude_angle", "minimum_film_thickness",
              "whirl_ratio", "equivalent_stiffness"}  # fmt: skip
    assert (equation(number) in said) == (key not in solved)


@pytest.mark.parametrize("key", RESULTS)
def test_powers_of_a_small_number_stand_behind_brackets(key: str) -> None:
    """LaTeX has no power of a power."""
    light = Computed(replace(SHEET, load=1.0), SPEED, TOP)
    said = explanation(RESULTS[key], light, SI)
    assert not re.search(r"\^\{[^{}]*\}\^", said)
    if key == "eccentricity_ratio":
        assert re.search(r"\(1-\(6.*10\^\{-5\}\)\^2\)", said)


def test_what_rounding_leaves_of_a_zero_is_shown_as_zero() -> None:
    words = matrix("M", np.array([[21.11, -6.9e-32], [0.3, 21.11]]), SI.mass)
    assert words.endswith(r"\begin{bmatrix}21.11 & 0\\0.3 & 21.11\end{bmatrix}\ \text{kg}" + "\n$$")


def test_what_solved_an_onset_is_not_equated_to_it() -> None:
    """A growth rate of zero is not an onset speed: the two stand on lines of their own."""
    rotor = replace(SHEET.rotor, disk_damping=2000.0)
    said = explanation(
        RESULTS["onset_speed"], Computed(replace(SHEET, rotor=rotor), SPEED, TOP), SI
    )
    assert re.search(r"\\max.*= 0\n\$\$\n\nOnset of whirl Ωₒₙ: \*\*\d+ rpm\*\*", said)


def test_the_critical_mass_is_the_machines_own_and_the_rigid_rotors_is_named_so() -> None:
    point = rc.analyse(SHEET, SPEED)
    shown = Computed(SHEET, SPEED, TOP)
    own, rigid = (RESULTS[key] for key in ("critical_mass", "rigid_critical_mass"))
    assert rigid.value(shown) == point.critical_mass
    assert "rigid" in rigid.label
    assert own.value(shown) < rigid.value(shown)
    # Eq. 5.50: as the threshold speeds, squared
    softening = float(point.flexible_threshold / point.rigid_threshold) ** 2
    assert own.value(shown) == pytest.approx(float(point.critical_mass) * softening, rel=1e-12)


@pytest.mark.parametrize("damping", ["0", "20000"])
def test_the_whirl_ratio_shown_is_the_verdicts(damping: str) -> None:
    at = visit("pages/3_Stability.py", cs=damping)
    (verdict,) = at.success
    ratio = float(re.search(r"(0\.\d{3}) of that speed", verdict.value).group(1))
    (shown,) = [float(one.value) for one in at.metric if one.label == "Whirl ratio at onset"]
    assert shown == pytest.approx(ratio, abs=5e-4)
