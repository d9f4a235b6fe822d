"""Thresholds over speed and the energy of the whirl, against quadrature and the modes' growth."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc import (
    PRESETS,
    JournalBearing,
    Machine,
    analyse,
    film_curves,
    modes,
    onset_speed,
    whirl_energy,
)
from rotorcalc.analysis import FilmCurves
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.coefficients import equilibrium
from rotorcalc.onset import Onset
from tests.films.models import BEARINGS

SHEET = PRESETS["sheet-1e8"].machine
finite = st.floats(-10.0, 10.0)
numbers = st.tuples(finite, finite, finite, finite)


def _machine(**rotor: float) -> Machine:
    return replace(SHEET, rotor=replace(SHEET.rotor, **rotor))


MACHINES = {
    **{key: preset.machine for key, preset in PRESETS.items()},
    "midspan damping": _machine(disk_damping=1e4),
    "journal mass": _machine(journal_mass=20.0),
    "both": _machine(disk_damping=5e3, journal_mass=10.0, shaft_stiffness=1e7),
    "rigid and damped": _machine(disk_damping=1e4, shaft_stiffness=math.inf),
    "heavy": replace(SHEET, load=20000.0),
}
each_machine = pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES.keys())


def _orbit(x: ComplexArray, frequency: float) -> tuple[Array, Array, float]:
    """Return positions and velocities over one turn, and the step of time."""
    t = np.arange(64) * 2.0 * np.pi / frequency / 64
    wave = np.exp(1j * frequency * t)[:, None]
    return (x * wave).real, (1j * frequency * x * wave).real, float(t[1])


@given(K=numbers, C=numbers, x=numbers, frequency=st.floats(0.1, 100.0))
def test_work_is_the_integral_of_force_times_velocity_over_a_turn(
    K: tuple[float, ...], C: tuple[float, ...], x: tuple[float, ...], frequency: float
) -> None:
    stiffness, damping = np.reshape(K, (2, 2)), np.reshape(C, (2, 2))
    orbit = np.array([x[0] + 1j * x[1], x[2] + 1j * x[3]])
    position, velocity, dt = _orbit(orbit, frequency)
    by_stiffness = -np.sum((position @ stiffness.T) * velocity) * dt
    by_damping = np.sum((velocity @ damping.T) * velocity) * dt
    tolerance = 1e-12 * (1.0 + np.sum(np.abs(orbit)) ** 2) * max(1.0, frequency) * 1e3
    assert whirl_energy.stiffness_work(stiffness, orbit) == pytest.approx(
        by_stiffness, abs=tolerance
    )
    assert whirl_energy.damping_work(damping, orbit, frequency) == pytest.approx(
        by_damping, abs=tolerance
    )


@given(x=numbers)
def test_orbit_area_is_that_of_the_polygon_through_the_orbit(x: tuple[float, ...]) -> None:
    orbit = np.array([x[0] + 1j * x[1], x[2] + 1j * x[3]])
    position, velocity, dt = _orbit(orbit, 1.0)
    area = np.sum(position[:, 0] * velocity[:, 1]) * dt
    assert whirl_energy.orbit_area(orbit) == pytest.approx(
        area, abs=1e-11 * (1.0 + np.abs(orbit).max() ** 2)
    )


def test_orbit_area_distinguishes_forward_from_backward() -> None:
    assert whirl_energy.orbit_area([1.0, -1.0j]) == pytest.approx(np.pi)
    assert whirl_energy.orbit_area([1.0, 1.0j]) == pytest.approx(-np.pi)


@each_machine
def test_gain_and_loss_meet_at_the_onset(machine: Machine) -> None:
    onset = onset_speed(machine)
    energy = whirl_energy.whirl_energy(
        machine, onset.speed, whirl_energy.whirl_orbit(machine, onset)
    )
    loss = energy.film_loss + energy.disk_loss
    assert energy.fed_in == pytest.approx(loss, rel=1e-9)
    assert energy.fed_in > 0.0
    assert (energy.disk_loss > 0.0) == (machine.rotor.disk_damping > 0.0)


@each_machine
@pytest.mark.parametrize("factor", [0.3, 0.9, 1.0, 1.3])
def test_energy_gain_minus_loss_gives_every_modes_growth(machine: Machine, factor: float) -> None:
    """Hold the identity in `whirl_energy`'s notes, on shapes from the eigenvectors."""
    rotor, state = machine.rotor, equilibrium(machine, factor * onset_speed(machine).speed)
    shapes = modes.mode_shapes(rotor, state.stiffness, state.damping)
    for lam, disk, journal in zip(shapes.eigenvalues, shapes.disk, shapes.journal, strict=True):
        if lam.imag <= 0.0:
            continue
        gain = whirl_energy.stiffness_work(state.stiffness, journal)
        loss = whirl_energy.damping_work(
            state.damping, journal, lam.imag
        ) + whirl_energy.damping_work(rotor.disk_damping * np.eye(2), disk, lam.imag)
        moved = rotor.journal_mass * np.abs(journal) ** 2 + rotor.disk_mass * np.abs(disk) ** 2
        growth = 2.0 * np.pi * lam.imag * lam.real * moved.sum()
        assert gain - loss == pytest.approx(growth, abs=1e-7 * (abs(gain) + abs(loss)))


def test_the_orbit_of_the_onset_solves_the_equation_of_whirl() -> None:
    """Eq. 5.43: the film's force balances the rotor's inertia on the orbit."""
    machine = _machine(shaft_stiffness=math.inf)
    onset = onset_speed(machine)
    orbit, state = whirl_energy.whirl_orbit(machine, onset), equilibrium(machine, onset.speed)
    Z = state.stiffness + 1j * onset.whirl_frequency * state.damping
    inertia = machine.rotor.half_mass * onset.whirl_frequency**2
    np.testing.assert_allclose(Z @ orbit.journal, inertia * orbit.journal, rtol=1e-9)
    np.testing.assert_allclose(orbit.disk, orbit.journal, rtol=1e-12)
    assert whirl_energy.orbit_area(orbit.journal) == pytest.approx(1.0)


def test_without_load_damping_dissipates_nothing() -> None:
    machine = replace(SHEET, load=0.0)
    orbit = whirl_energy.whirl_orbit(machine, onset_speed(machine))
    energy = whirl_energy.whirl_energy(machine, np.array([10.0, 100.0]), orbit)
    assert np.all(energy.fed_in > 0.0)
    assert np.all(energy.film_loss == 0.0)


def test_without_onset_there_is_no_orbit() -> None:
    never = Onset(
        speed=math.inf,
        whirl_frequency=math.nan,
        eccentricity_ratio=math.nan,
        method="polynomial",
    )
    with pytest.raises(ValueError, match="without an onset"):
        whirl_energy.whirl_orbit(SHEET, never)


@pytest.mark.parametrize("key", PRESETS)
def test_thresholds_meet_the_speed_at_the_onset(key: str) -> None:
    machine = PRESETS[key].machine
    for flexible in (True, False):
        onset = onset_speed(machine, flexible=flexible)
        at = whirl_energy.thresholds(analyse(machine, onset.speed))
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
    critical = whirl_energy.critical_mass(analyse(machine, speed))
    for factor in (0.99, 1.0, 1.01):
        rotor = replace(machine.rotor, mass=2.0 * critical * factor)
        heavier = replace(machine, rotor=rotor, load=machine.static_load)
        values = analyse(heavier, speed).flexible_eigenvalues
        growth = values.real.max() / abs(values[np.argmax(values.real)])
        assert (
            growth == pytest.approx(0.0, abs=1e-9) if factor == 1.0 else growth * (factor - 1) > 0
        )


def test_at_the_onset_the_critical_mass_is_the_machines_own() -> None:
    for machine in MACHINES.values():
        there = analyse(machine, onset_speed(machine).speed)
        own = whirl_energy.critical_mass(there)
        assert own == pytest.approx(machine.rotor.half_mass, rel=1e-8)


def test_whirl_frequency_is_the_whirl_ratio_times_the_threshold() -> None:
    sweep = analyse(SHEET, np.geomspace(50.0, 3000.0, 40))
    over = whirl_energy.thresholds(sweep)
    whirls = sweep.whirl_ratio > 0.0
    for frequency, threshold in (
        (over.flexible_frequency, over.flexible),
        (over.rigid_frequency, over.rigid),
    ):
        expected = sweep.whirl_ratio[whirls] * threshold[whirls]
        np.testing.assert_allclose(frequency[whirls], expected, rtol=1e-10)


def test_a_film_that_cannot_whirl_has_no_frequency_and_no_critical_mass() -> None:
    over = whirl_energy.thresholds(analyse(replace(SHEET, load=20000.0), np.array([10.0])))
    assert np.isnan(over.flexible_frequency).all()
    assert np.isinf(over.flexible_mass_ratio).all()
    assert np.isinf(over.flexible).all()


def test_flexible_curves_reach_from_the_rigid_rotor_to_the_bare_shaft() -> None:
    curves = _curves()
    rigid, soft = whirl_energy.flexible_curves(curves, [0.0, 1e9])
    np.testing.assert_array_equal(rigid, curves.onset.threshold_speed)
    # The shaft alone: ω_s = √(K_rot/M), so p_sf² ω̄² Γ/C → 1.
    np.testing.assert_allclose(soft * curves.onset.whirl_ratio * math.sqrt(1e9), 1.0, rtol=1e-8)


def _curves() -> FilmCurves:
    return film_curves(SHEET.bearing, np.geomspace(0.1, 100.0, 30))


def test_film_limit_is_the_eccentricity_above_which_no_rotor_whirls() -> None:
    bearing = JournalBearing(diameter=0.3, length=0.1, radial_clearance=2e-4)
    limit = whirl_energy.film_limit(bearing)
    assert limit.film.eccentricity_ratio == pytest.approx(0.756030386471, abs=1e-11)
    assert limit.film.sommerfeld == pytest.approx(0.0663852602, abs=1e-10)
    assert limit.onset.whirl_ratio == 0.0
    assert math.isinf(limit.onset.threshold_speed)


def test_a_film_whose_whirl_has_no_end_is_refused() -> None:
    with pytest.raises(ValueError, match="feeds a whirl at no load"):
        whirl_energy.film_limit(BEARINGS["sprung"])
    assert np.any(film_curves(BEARINGS["preloaded"], np.array([1.0, 10.0])).onset.whirl_ratio)
    assert float(whirl_energy.film_limit(BEARINGS["preloaded"]).onset.whirl_ratio) == 0.0


def test_a_film_that_feeds_no_whirl_though_it_could_is_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def calm(_: JournalBearing, sigma: Array) -> SimpleNamespace:
        return SimpleNamespace(onset=SimpleNamespace(whirl_ratio=np.zeros_like(sigma)))

    monkeypatch.setattr(whirl_energy, "film_curves", calm)
    with pytest.raises(ValueError, match="feeds a whirl at no load"):
        whirl_energy.film_limit(SHEET.bearing)
