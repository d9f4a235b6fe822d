"""The home page states whether the machine is stable, up to which speed, and how it whirls."""

import math
import re

import numpy as np
import pytest

import rotorcalc as rc
from rotorcalc import PRESETS, onset_speed
from tests.app.session import HOME, NOTES, PAGES, faults, move, texts, visit
from ui.inputs import PRESET_VALUES

RPM = math.pi / 30


def _said(at) -> str:
    return "\n".join(texts(at))


@pytest.mark.parametrize(("preset", "onset"), [("sheet-1e8", "8919"), ("sheet-1e7", "4627")])
def test_onset_speeds_of_the_sheets_two_rotors(preset: str, onset: str) -> None:
    at = visit(HOME, preset=preset)
    (verdict,) = at.success
    whirl = onset_speed(PRESETS[preset].machine).whirl_frequency
    for said in (f"{onset} rpm", f"{whirl / RPM:.0f} rpm", f"{whirl / (2 * math.pi):.4g} Hz"):
        assert said in verdict.value
    results = {metric.value for metric in at.metric}
    assert {f"{onset} rpm", f"{whirl / RPM:.0f} rpm"} <= results


def test_an_unstable_machine_is_called_so() -> None:
    at = visit(HOME, rpm="9000")
    (verdict,) = at.error
    assert re.match("Unstable at 9000 rpm.*became unstable at 8919 rpm", verdict.value)
    assert not at.success


def test_above_the_onset_the_verdict_gives_the_frequency_of_the_unstable_mode() -> None:
    """The eigenvalues give it: at the onset the whirl is slower."""
    values = rc.analyse(PRESETS["sheet-1e8"].machine, 10000 * RPM).flexible_eigenvalues
    unstable = values[np.argmax(values.real)]
    (verdict,) = visit(HOME, rpm="10000").error
    assert f"it whirls at {abs(unstable.imag) / RPM:.0f} rpm" in verdict.value
    assert f"growing at {unstable.real:.4g} 1/s" in verdict.value
    assert "4468" not in verdict.value


def test_outside_the_models_range_there_is_no_verdict_and_numbers_are_in_brackets() -> None:
    at = visit(HOME, L="5")
    assert not at.success
    assert not at.error
    (verdict,) = at.warning
    assert verdict.value.startswith("No verdict: the model does not hold for this machine.")
    assert ":red-badge[The model is outside its range: imbalance orbit" in verdict.value
    assert all(re.fullmatch(r"\(.+\)", metric.value) for metric in at.metric)
    assert all("(" not in metric.value for metric in visit(HOME).metric)


@pytest.mark.parametrize("page", [page for page in PAGES if page != NOTES])
def test_every_page_gives_the_same_verdict(page: str) -> None:
    (verdict,) = [box.value for box in visit(page, rpm="9000").error if "became" in box.value]
    assert verdict == visit(HOME, rpm="9000").error[0].value


def test_the_onset_separates_stable_from_unstable_speeds() -> None:
    at = visit(HOME)
    move(at, "rpm", 8900.0)
    assert len(at.success) == 1
    move(at, "rpm", 9000.0)
    assert not at.success
    assert at.error[0].value.startswith("Unstable")


def test_zero_load_is_explained() -> None:
    at = visit(HOME, load="0")
    (verdict,) = at.error
    assert re.search("without load.*Eq. 5.37.*any speed", verdict.value)
    assert faults(at) == []


def test_a_rigid_shaft_has_the_rigid_rotors_onset() -> None:
    at = visit(HOME, k="inf", rpm_max="14000")
    assert "10652 rpm" in at.success[0].value
    assert faults(at) == []


def test_a_film_thinner_than_the_model_allows_gets_no_verdict() -> None:
    # A heavily loaded bearing runs above the eccentricity ratio of 0.756, where it cannot whirl.
    at = visit(HOME, load="20000", mu="1", rpm="1000", k="inf", mass="10")
    assert faults(at) == []
    assert re.match("No verdict.*stable at 1000 rpm", at.warning[0].value)


@pytest.mark.parametrize("preset", PRESETS)
def test_the_margin_agrees_with_the_verdict(preset: str) -> None:
    at = visit(HOME, preset=preset)
    onset = onset_speed(PRESETS[preset].machine).speed / RPM
    margin = 100 * (onset / PRESET_VALUES[preset]["rpm"] - 1)
    assert f"{margin:.4g} %" in _said(at)


def test_an_onset_outside_the_models_range_is_marked() -> None:
    """Thin oil in a wide gap: turbulent at the onset, at over twice the running speed."""
    at = visit(HOME, C="200", mu="4", rpm="1000", L="100", load="3000")
    said = next(box.value for box in (*at.success, *at.warning))
    assert "(outside the model's range)" in said
    numbers = {metric.label: metric.value for metric in at.metric}
    assert numbers["Margin to onset"].startswith("(")
    assert not numbers["Power loss"].startswith("(")
