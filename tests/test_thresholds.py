"""Thresholds and critical masses over speed, against the onset, eigenvalues and limits."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rotorcalc import (
    PRESETS,
    JournalBearing,
    analyse,
    film_curves,
    onset_speed,
    thresholds,
)
from rotorcalc.analysis import FilmCurves
from rotorcalc.arrays import Array
from tests.films.models import BEARINGS, RINGS
from tests.machines import MACHINES, SHEET


@pytest.mark.parametrize("key", PRESETS)
def test_thresholds_meet_the_speed_at_the_onset(key: str) -> None:
    machine = PRESETS[key].machine
    for flexible in (True, False):
        onset = onset_speed(machine, flexible=flexible)
        at = thresholds.at_each_speed(analyse(machine, onset.speed))
        kind = "flexible" if flexible else "rigid"
        threshold, frequency, ratio = (
            getattr(at, kind + part) for part in ("", "_frequency", "_mass_ratio")
        )
        assert threshold == pytest.approx(onset.speed, rel=1e-9)
        assert frequency == pytest.approx(onset.whirl_frequency, rel=1e-9)
        assert ratio == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize("key", MACHINES)
@pytest.mark.parametrize("speed", [300.0, 900.0])
def test_at_its_critical_mass_a_machine_is_neutral_on_the_film_as_it_is(
    key: str, speed: float
) -> None:
    machine = MACHINES[key]
    critical = thresholds.critical_mass(analyse(machine, speed))
    for factor in (0.99, 1.0, 1.01):
        rotor = replace(machine.rotor, mass=2.0 * critical * factor)
        heavier = replace(machine, rotor=rotor, load=machine.static_load)
        values = analyse(heavier, speed).flexible_eigenvalues
        growth = values.real.max() / abs(values[np.argmax(values.real)])
        assert (
            growth == pytest.approx(0.0, abs=1e-9) if factor == 1.0 else growth * (factor - 1) > 0
        )


def test_at_the_onset_the_critical_mass_is_the_machines_own() -> None:
    ringed = (replace(SHEET, bearing=bearing) for bearing in RINGS.values())
    for machine in (*MACHINES.values(), *ringed):
        there = analyse(machine, onset_speed(machine).speed)
        own = thresholds.critical_mass(there)
        assert own == pytest.approx(machine.rotor.half_mass, rel=1e-8)


def test_whirl_frequency_is_the_whirl_ratio_times_the_threshold() -> None:
    sweep = analyse(SHEET, np.geomspace(50.0, 3000.0, 40))
    over = thresholds.at_each_speed(sweep)
    whirls = sweep.whirl_ratio > 0.0
    for frequency, threshold in (
        (over.flexible_frequency, over.flexible),
        (over.rigid_frequency, over.rigid),
    ):
        expected = sweep.whirl_ratio[whirls] * threshold[whirls]
        np.testing.assert_allclose(frequency[whirls], expected, rtol=1e-10)


def test_a_film_that_cannot_whirl_has_no_frequency_and_no_critical_mass() -> None:
    over = thresholds.at_each_speed(analyse(replace(SHEET, load=20000.0), np.array([10.0])))
    assert np.isnan(over.flexible_frequency).all()
    assert np.isinf(over.flexible_mass_ratio).all()
    assert np.isinf(over.flexible).all()


def test_flexible_curves_reach_from_the_rigid_rotor_to_the_bare_shaft() -> None:
    curves = _curves()
    rigid, soft = thresholds.flexible_curves(curves, [0.0, 1e9])
    np.testing.assert_array_equal(rigid, curves.onset.threshold_speed)
    # The shaft alone: ω_s = √(K_rot/M), so p_sf² ω̄² Γ/C → 1.
    np.testing.assert_allclose(soft * curves.onset.whirl_ratio * math.sqrt(1e9), 1.0, rtol=1e-8)


def _curves() -> FilmCurves:
    return film_curves(SHEET.bearing, np.geomspace(0.1, 100.0, 30))


def test_film_limit_is_the_eccentricity_above_which_no_rotor_whirls() -> None:
    bearing = JournalBearing(diameter=0.3, length=0.1, radial_clearance=2e-4)
    limit = thresholds.film_limit(bearing)
    assert limit.film.eccentricity_ratio == pytest.approx(0.756030386471, abs=1e-11)
    assert limit.film.sommerfeld == pytest.approx(0.0663852602, abs=1e-10)
    assert limit.onset.whirl_ratio == 0.0
    assert math.isinf(limit.onset.threshold_speed)


def test_a_film_whose_whirl_has_no_end_is_refused() -> None:
    with pytest.raises(ValueError, match="feeds a whirl at no load"):
        thresholds.film_limit(BEARINGS["sprung"])
    assert np.any(film_curves(BEARINGS["preloaded"], np.array([1.0, 10.0])).onset.whirl_ratio)
    assert float(thresholds.film_limit(BEARINGS["preloaded"]).onset.whirl_ratio) == 0.0


def test_a_film_that_feeds_no_whirl_though_it_could_is_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def calm(_: JournalBearing, sigma: Array) -> SimpleNamespace:
        return SimpleNamespace(onset=SimpleNamespace(whirl_ratio=np.zeros_like(sigma)))

    monkeypatch.setattr(thresholds, "film_curves", calm)
    with pytest.raises(ValueError, match="feeds a whirl at no load"):
        thresholds.film_limit(SHEET.bearing)
