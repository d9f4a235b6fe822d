"""The whole sheet in one call: each field from its own link of the chain, in its shape."""

import math
from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotorcalc import analyse, modes, unstable_ranges
from rotorcalc.analysis import film_curves, force_coefficients
from rotorcalc.coefficients import equilibrium
from rotorcalc.films import short
from rotorcalc.frames import rotate
from rotorcalc.onset.whirl import whirl_onset
from rotorcalc.unbalance_response import synchronous_response
from tests.machines import ALWAYS_STABLE, EPS, RPM, SHEET, machines, with_rotor

RIGID = with_rotor(shaft_stiffness=math.inf)
TRAILING = {
    "journal_position": (2,),
    "stiffness": (2, 2),
    "damping": (2, 2),
    "rigid_eigenvalues": (4,),
    "flexible_eigenvalues": (6,),
    "disk_response": (2,),
    "journal_response": (2,),
}
# DESIGN, section 4, and what has come since.
FIELDS = {
    *("speed", "sommerfeld", "eccentricity_ratio", "attitude_angle", "minimum_film_thickness"),
    *("power_loss", "side_flow", "stiffness", "damping", "equivalent_stiffness", "whirl_ratio"),
    *("critical_mass", "rigid_threshold", "flexible_threshold", "rigid_eigenvalues"),
    *("flexible_eigenvalues", "disk_response", "journal_response"),
}


# What is computed when first asked for.
LATER = ("rigid_eigenvalues", "flexible_eigenvalues")


def arrays(sweep):
    names = {field.name for field in fields(sweep)} - {"machine"}
    return {name: np.asarray(getattr(sweep, name)) for name in names | set(LATER)}


@pytest.mark.parametrize("shape", [(), (1,), (5,), (2, 3), (0,)])
@pytest.mark.parametrize(
    ("machine", "states"),
    [(SHEET, 6), (with_rotor(journal_mass=5.0), 8), (RIGID, 4)],
    ids=["flexible", "journal mass", "rigid"],
)
def test_every_field_has_the_shape_of_the_speeds(machine, states, shape):
    speeds = np.linspace(100.0, 1000.0, math.prod(shape)).reshape(shape) if shape else 600.0
    found = arrays(analyse(machine, speeds))
    assert set(found) >= FIELDS
    for name, values in found.items():
        trailing = (states,) if name == "flexible_eigenvalues" else TRAILING.get(name, ())
        assert values.shape == shape + trailing, name
        is_complex = name.endswith(("eigenvalues", "response"))
        assert values.dtype == (complex if is_complex else float), name


def test_single_speeds_give_the_same_as_an_array():
    speeds = np.linspace(600 * RPM, 12000 * RPM, 12)
    together = arrays(analyse(SHEET, speeds))
    for i, speed in enumerate(speeds):
        for name, values in arrays(analyse(SHEET, float(speed))).items():
            # Functions of arrays and of scalars may round otherwise.
            if name.endswith("eigenvalues"):
                assert np.poly(together[name][i] / speed) == pytest.approx(
                    np.poly(values / speed), rel=1e-9
                )
            else:
                # The outlet's temperature is not known where the film's is given.
                same = pytest.approx(values, rel=1e-11, nan_ok=name == "outlet_temperature")
                assert together[name][i] == same, name


def test_integers_and_lists_are_speeds():
    assert analyse(SHEET, 600).eccentricity_ratio == analyse(SHEET, 600.0).eccentricity_ratio
    assert analyse(SHEET, [600, 700.0]).speed.tolist() == [600.0, 700.0]


@settings(max_examples=40)
@given(machines(damped=True, journals=True), st.floats(0.05, 3))
def test_each_field_is_its_own_link_of_the_chain(machine, share):
    speed = share * 6000 * RPM
    sweep, state = analyse(machine, speed), equilibrium(machine, speed)
    K, C, rotor = state.stiffness, state.damping, machine.rotor
    assert sweep.machine is machine
    assert np.array_equal(sweep.stiffness, K)
    assert np.array_equal(sweep.damping, C)
    clearance = machine.bearing.radial_clearance
    assert np.hypot(*sweep.journal_position) == pytest.approx(
        sweep.eccentricity_ratio * clearance, rel=8 * EPS
    )
    disk, journal = synchronous_response(rotor, K, C, speed)
    assert np.array_equal(sweep.disk_response, disk)
    assert np.array_equal(sweep.journal_response, journal)
    assert np.array_equal(sweep.rigid_eigenvalues, modes.eigenvalues(rotor, K, C, flexible=False))
    assert np.array_equal(sweep.flexible_eigenvalues, modes.eigenvalues(rotor, K, C))
    for name in ("side_flow", "power_loss", "minimum_film_thickness", "peak_pressure"):
        assert getattr(sweep, name) == getattr(state, name)


@settings(max_examples=60)
@given(machines(), st.floats(0.05, 3))
def test_thresholds_are_those_of_the_dimensionless_coefficients(machine, share):
    """k_eq F_o/C, ω̄ and p_s√(F_o/(MC)) from Eq. 5.35, Ω_sf from Eq. 5.50, M_c = p_s²F_o/(CΩ²)."""
    speed = share * 6000 * RPM
    sweep = analyse(machine, speed)
    eps, load = sweep.eccentricity_ratio, machine.static_load
    C, M = machine.bearing.radial_clearance, machine.rotor.half_mass
    onset = whirl_onset(short.stiffness(eps), short.damping(eps))
    # ω̄² is a difference of terms of order 1, of coefficients that go as 1/(1 − ε).
    error = 1e-12 + 1e3 * EPS / (1 - float(eps))
    if onset.whirl_ratio > 0:
        error = error / float(onset.whirl_ratio) ** 2
    k_eq = float(onset.equivalent_stiffness)
    assert sweep.equivalent_stiffness == pytest.approx(k_eq * load / C, rel=error)
    assert sweep.whirl_ratio == pytest.approx(float(onset.whirl_ratio), rel=error)
    assert sweep.critical_mass == pytest.approx(
        float(onset.critical_mass) * load / (C * speed**2), rel=error
    )
    rigid = float(onset.threshold_speed) * math.sqrt(load / (M * C))
    assert sweep.rigid_threshold == pytest.approx(rigid, rel=error)
    series = math.sqrt(1 + k_eq * machine.static_sag / C)
    assert sweep.flexible_threshold == pytest.approx(rigid / series, rel=error)


def test_a_film_that_cannot_whirl_has_infinite_thresholds():
    sweep = analyse(replace(SHEET, load=3e5), 6000 * RPM)
    assert sweep.eccentricity_ratio > ALWAYS_STABLE
    assert sweep.whirl_ratio == 0
    assert sweep.critical_mass == math.inf
    assert sweep.rigid_threshold == sweep.flexible_threshold == math.inf


@pytest.mark.parametrize("changes", [{}, {"disk_damping": 500.0}, {"journal_mass": 5.0}])
def test_for_a_rigid_shaft_the_flexible_fields_are_the_rigid_ones(changes):
    sweep = analyse(with_rotor(RIGID, **changes), np.linspace(100.0, 1000.0, 7))
    assert np.array_equal(sweep.flexible_eigenvalues, sweep.rigid_eigenvalues)
    assert np.array_equal(sweep.flexible_threshold, sweep.rigid_threshold)
    assert np.array_equal(sweep.disk_response, sweep.journal_response)


@pytest.mark.parametrize(
    "machine", [SHEET, RIGID, with_rotor(journal_mass=5.0, disk_damping=100.0)]
)
def test_without_load_every_field_is_a_number_or_its_limit(machine):
    sweep = analyse(replace(machine, load=0.0), np.linspace(10.0, 1500.0, 9))
    infinite = {"sommerfeld", "friction_coefficient"}
    known = arrays(sweep)
    assert np.all(np.isnan(known.pop("outlet_temperature")))  # the film's temperature is given
    for name, values in known.items():
        assert np.all(np.isfinite(values)) == (name not in infinite), name
        assert not np.any(np.isnan(values)), name
    assert np.all(sweep.eccentricity_ratio == 0)
    assert np.all(sweep.attitude_angle == np.pi / 2)
    assert sweep.whirl_ratio == pytest.approx(0.5, rel=4 * EPS)
    assert np.all(sweep.equivalent_stiffness == 0)
    assert np.all(sweep.critical_mass == 0)
    assert np.all(sweep.rigid_threshold == 0)
    assert np.all(sweep.rigid_eigenvalues.real.max(axis=-1) > 0)


def test_a_vanishing_load_tends_to_no_load():
    none = arrays(analyse(replace(SHEET, load=0.0), 600.0))
    for name, values in arrays(analyse(replace(SHEET, load=1e-9), 600.0)).items():
        if np.all(np.isfinite(none[name])) and not name.endswith("eigenvalues"):
            # ε = 1e-13 here, thresholds as the root of the load: 1e-5 of the sheet's 1e3 rad/s.
            size = np.abs(none[name]).max() or np.abs(arrays(analyse(SHEET, 600.0))[name]).max()
            error = 2e-6 if name.endswith("threshold") else 1e-10
            assert np.abs(values - none[name]).max() <= error * size, name


# Curves and frames


def test_film_curves_are_those_of_the_eccentricity():
    sigma = np.geomspace(1e-3, 1e3, 25)
    curves, eps = film_curves(SHEET.bearing, sigma), short.eccentricity_ratio(sigma)
    onset = whirl_onset(short.stiffness(eps), short.damping(eps))
    assert curves.film.eccentricity_ratio == pytest.approx(eps, rel=4 * EPS)
    assert curves.onset.equivalent_stiffness == pytest.approx(onset.equivalent_stiffness, rel=1e-11)
    assert curves.onset.whirl_ratio == pytest.approx(onset.whirl_ratio, rel=1e-9)


def test_force_coefficients_in_both_frames_and_units():
    sweep = analyse(SHEET, np.linspace(100.0, 1000.0, 5))
    curves = film_curves(SHEET.bearing, sweep.sommerfeld)
    for source, K in ((sweep, sweep.stiffness), (curves, curves.film.k)):
        fixed, turning = (force_coefficients(source, axes=axes) for axes in ("XY", "rt"))
        assert (fixed.axes, turning.axes) == ("XY", "rt")
        assert np.array_equal(fixed.stiffness, K)
        assert rotate(turning.stiffness, sweep.attitude_angle) == pytest.approx(
            fixed.stiffness, abs=16 * EPS * np.abs(K).max()
        )
        assert np.array_equal(fixed.equivalent_stiffness, turning.equivalent_stiffness)
        # k_eq is the same in both frames: it is made of invariants.
        again = whirl_onset(turning.stiffness, turning.damping).equivalent_stiffness
        assert again == pytest.approx(turning.equivalent_stiffness, rel=1e-11)


def test_radial_coefficients_of_a_film_are_those_of_equation_5_34():
    curves = film_curves(SHEET.bearing, 0.4)
    turning = force_coefficients(curves, axes="rt")
    eps, unit = float(curves.film.eccentricity_ratio), 4 * 0.4
    assert turning.stiffness == pytest.approx(unit * short.radial_stiffness(eps), rel=1e-12)
    assert turning.damping == pytest.approx(unit * short.radial_damping(eps), rel=1e-12)


@pytest.mark.parametrize("sommerfeld", [math.inf, [1.0, math.inf], [[math.inf], [math.inf]]])
def test_without_load_the_threshold_is_its_limit(sommerfeld):
    """ε → 0: k_eq → 6/π, whirl ratio → ½, p_s² → 24/π, with no warning of a division."""
    onset = film_curves(SHEET.bearing, sommerfeld).onset
    unloaded = np.isinf(sommerfeld)
    assert onset.equivalent_stiffness[unloaded] == pytest.approx(6 / math.pi, rel=1e-9)
    assert onset.whirl_ratio[unloaded] == pytest.approx(0.5, rel=1e-9)
    assert onset.critical_mass[unloaded] == pytest.approx(24 / math.pi, rel=1e-9)
    assert onset.threshold_speed[unloaded] == pytest.approx(math.sqrt(24 / math.pi), rel=1e-9)


def test_the_centred_film_has_the_same_threshold_in_units_of_the_load():
    onset = whirl_onset(short.stiffness([0.0, 0.5]), short.damping([0.0, 0.5]))
    assert onset.equivalent_stiffness[0] == pytest.approx(6 / math.pi)
    assert onset.critical_mass[0] == pytest.approx(24 / math.pi)
    assert onset.whirl_ratio[0] == 0.5
    assert onset.whirl_ratio[1] == whirl_onset(short.stiffness(0.5), short.damping(0.5)).whirl_ratio


@pytest.mark.parametrize("speeds", [500.0, [500.0], [600.0, 500.0], [500.0] * 3, [[400.0, 500.0]]])
def test_a_sweep_that_does_not_rise_has_no_unstable_ranges(speeds):
    with pytest.raises(ValueError, match=r"^sweep\.speed(\[\d\] = |: must be two or more rising)"):
        unstable_ranges(analyse(SHEET, speeds))
