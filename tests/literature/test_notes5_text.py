"""Statements and printed equations of Notes 5, and their misprints.

L. San Andrés, Notes 5, "Dynamics of a Rigid Rotor-Fluid Film Bearing System". Numbers of equations
are the notes'. Axes are the notes': X along the load, r along the line of centres, both frames
right-handed, K_ij = −∂F_i/∂X_j (Eq. 5.14).
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import PRESETS, analyse, onset_speed, orbit_ellipse
from rotorcalc.films import short
from rotorcalc.onset.whirl import flexible_threshold, whirl_onset

SHEET = PRESETS["sheet-1e8"].machine
FIG_5_2 = PRESETS["fig-5-2"].machine
EPS = np.linspace(0.05, 0.95, 19)
ROUNDING = 1e-13


def onset(eps):
    return whirl_onset(short.stiffness(eps), short.damping(eps))


# Equations as printed


def test_film_forces_of_fig_5_2():
    """Eq. 5.5 with the figure's data: 0.019 Pa·s, 0.05 m, L/D = 0.25, 0.1 mm, 3,000 rpm, ε = ½."""
    R, L, C, mu, W = 0.1, 0.05, 1e-4, 0.019, 3000 * math.pi / 30
    unit = mu * R * L**3 * W / C**2
    sigma = short.modified_sommerfeld(0.5)
    machine = replace(FIG_5_2, load=float(mu * W * L * R / (4 * sigma) * (L / C) ** 2))
    sweep = analyse(machine, W)
    assert sweep.eccentricity_ratio == pytest.approx(0.5, rel=ROUNDING)
    F_r, F_t = -unit * 0.25 / 0.75**2, unit * math.pi * 0.5 / (4 * 0.75**1.5)
    assert machine.static_load == pytest.approx(math.hypot(F_r, F_t), rel=ROUNDING)
    assert math.tan(sweep.attitude_angle) == pytest.approx(-F_t / F_r, rel=ROUNDING)


def test_dimensionless_coefficients_in_the_radial_frame():
    """Eqs. 5.33 and 5.34."""
    s2, sigma = 1 - EPS**2, short.modified_sommerfeld(EPS)
    f_r, f_t = 4 * sigma * EPS**2 / s2**2, math.pi * sigma * EPS / s2**1.5
    phi = short.attitude_angle(EPS)
    assert f_r == pytest.approx(np.cos(phi), rel=ROUNDING)
    assert f_t == pytest.approx(np.sin(phi), rel=ROUNDING)
    k = [
        [f_r * 2 * (1 + EPS**2) / (EPS * s2), f_t / EPS],
        [-f_t * (1 + 2 * EPS**2) / (EPS * s2), f_r / EPS],
    ]
    c = [
        [f_t * 2 * (1 + 2 * EPS**2) / (EPS * s2), -f_r * 2 / EPS],
        [-f_r * 2 / EPS, f_t * 2 / EPS],
    ]
    unit = 4 * sigma[:, None, None]
    assert unit * short.radial_stiffness(EPS) == pytest.approx(np.moveaxis(k, -1, 0), rel=ROUNDING)
    assert unit * short.radial_damping(EPS) == pytest.approx(np.moveaxis(c, -1, 0), rel=ROUNDING)


def printed_5_35(eps):
    """Return k and c in X, Y as the notes print them, with their misprints."""
    s2, phi = 1 - eps**2, short.attitude_angle(eps)
    f_r, f_t = np.cos(phi), np.sin(phi)
    a, b = f_r / (eps * s2), f_t / (eps * s2)
    k = [
        [a * (f_r**2 + 1 + 2 * eps**2), b * (f_r**2 + 1 + 2 * eps**2)],
        [b * (f_r**2 - 1 + eps**2), a * (f_r**2 + 1 - eps**2)],
    ]
    cross = 2 * a * ((2 + eps**2) * f_t**2 - 1 + eps**2)
    c = [
        [2 * b * ((2 + eps**2) * f_r**2 + 1 - eps**2), cross],
        [cross, 2 * b * ((2 + eps**2) * f_r**2 - 1 + eps**2)],
    ]
    return np.moveaxis(np.array(k), -1, 0), np.moveaxis(np.array(c), -1, 0)


def test_coefficients_as_printed_but_for_two():
    """Eq. 5.35: k_XX, k_XY, k_YX, c_XX and c_XY are right."""
    k, c = printed_5_35(EPS)
    size = np.abs(k).max(axis=(1, 2))
    for i, j in ((0, 0), (0, 1), (1, 0)):
        assert np.all(np.abs(k[:, i, j] - short.stiffness(EPS)[:, i, j]) <= ROUNDING * size)
    for i, j in ((0, 0), (0, 1), (1, 0)):
        assert c[:, i, j] == pytest.approx(short.damping(EPS)[:, i, j], rel=1e-11)


def test_centred_coefficients():
    """Eqs. 5.36 and 5.37: k̄ = μRL³Ω/C³·π/4 = (Ω/2)c̄, c̄ = μRL³/C³·π/2."""
    machine, W = replace(SHEET, load=0.0), 500.0
    R, L, C = 0.075, 0.050, 60e-6
    sweep, unit = analyse(machine, W), machine.viscosity * R * L**3 / C**3
    k, c = unit * W * math.pi / 4, unit * math.pi / 2
    assert sweep.stiffness == pytest.approx(np.array([[0, k], [-k, 0]]), rel=ROUNDING)
    assert sweep.damping == pytest.approx(c * np.eye(2), rel=ROUNDING)
    assert k == pytest.approx(W / 2 * c, rel=ROUNDING)


# Statements


def test_attitude_angle_falls_from_a_right_angle_to_zero():
    """As ε → 0, φ → ½π; as ε → 1, φ → 0 (below Eq. 5.7)."""
    assert short.attitude_angle(1e-9) == pytest.approx(math.pi / 2, abs=2e-9)
    assert short.attitude_angle(1 - 1e-12) == pytest.approx(0, abs=2e-6)


def test_large_sommerfeld_numbers_centre_the_journal_and_small_ones_do_not():
    """ε → 0.0 and φ near 90° at large σ; ε → 1.0 and φ near 0° at small σ (below Eq. 5.8)."""
    centred, heavy = short.eccentricity_ratio([1e3, 1e-5])
    assert centred < 1e-3
    assert heavy > 0.99
    assert math.degrees(short.attitude_angle(centred)) > 89
    assert math.degrees(short.attitude_angle(heavy)) < 10


def test_the_whirl_ratio_near_the_centre_is_one_half():
    """For near centred journal operation the whirl frequency is 0.50 (Eq. 5.48)."""
    assert round(float(onset(0.01).whirl_ratio), 2) == 0.50
    assert onset(1e-6).whirl_ratio == pytest.approx(0.5, abs=1e-11)


def test_always_stable_at_large_eccentricity():
    """Always stable for ε > 0.75, the text says; 0.7560 for the short bearing, to more digits."""
    assert onset(0.76).whirl_ratio == 0
    assert onset(0.7561).whirl_ratio == 0
    assert onset(0.7560).whirl_ratio > 0
    assert onset(0.75).threshold_speed < math.inf


def test_threshold_speed_at_half_the_clearance():
    """Eqs. 5.45 and 5.46 at ε = 0.5, to the digits of the program's open cases."""
    at = onset(0.5)
    assert short.modified_sommerfeld(0.5) == pytest.approx(0.333164, rel=0, abs=5e-7)
    assert at.equivalent_stiffness == pytest.approx(1.711065, rel=0, abs=5e-7)
    assert at.whirl_ratio == pytest.approx(0.514640, rel=0, abs=5e-7)
    assert at.threshold_speed == pytest.approx(2.541731, rel=0, abs=5e-7)


def test_whirl_is_at_the_natural_frequency():
    """ω_s = √(K_eq/M) (Eq. 5.47)."""
    rigid = onset_speed(SHEET, flexible=False)
    K_eq = float(analyse(SHEET, rigid.speed).equivalent_stiffness)
    assert rigid.whirl_frequency == pytest.approx(
        math.sqrt(K_eq / SHEET.rotor.half_mass), rel=1e-11
    )


def test_a_centred_rotor_reaches_twice_its_natural_frequency():
    """Ω_max = ω_s/0.50 = 2ω_n (Eq. 5.49)."""
    at = onset_speed(replace(SHEET, load=1.0), flexible=False)
    assert at.eccentricity_ratio < 0.01
    assert at.speed == pytest.approx(2 * at.whirl_frequency, rel=1e-4)


def test_an_unloaded_rotor_has_no_support_and_whirls_at_any_speed():
    """F_o = 0: the bearing possesses no support stiffness; unstable (below Eq. 5.48)."""
    unloaded = replace(SHEET, load=0.0)
    assert analyse(unloaded, 100.0).equivalent_stiffness == 0
    assert onset_speed(unloaded).speed == 0


def test_without_cross_coupling_there_is_no_whirl():
    """k_XY = 0: WFR = 0, no whirl occurs and the system is always stable."""
    k = short.stiffness(0.4) * np.eye(2)
    assert whirl_onset(k, short.damping(0.4)).whirl_ratio == 0


def test_more_speed_means_less_eccentricity_and_ends_in_whirl():
    """Operation at ever increasing speeds will eventually lead to an unstable rotor."""
    speeds = np.linspace(10.0, 3000.0, 300)
    sweep = analyse(SHEET, speeds)
    assert np.all(np.diff(sweep.eccentricity_ratio) < 0)
    unstable = sweep.rigid_eigenvalues.real.max(axis=-1) > 0
    assert not unstable[0]
    assert unstable[-1]
    assert np.count_nonzero(np.diff(unstable.astype(int))) == 1


def test_flexibility_lowers_the_onset_and_leaves_the_whirl_ratio():
    """Below Eq. 5.49, and the more flexible the rotor the lower its threshold (Fig. 5.10)."""
    curves = [
        flexible_threshold(onset(0.4).threshold_speed, onset(0.4).equivalent_stiffness, sag)
        for sag in (0.0, 0.1, 1.0, 10.0)
    ]
    assert np.all(np.diff(curves) < 0)
    found = onset_speed(SHEET)
    assert found.whirl_frequency / found.speed == pytest.approx(
        float(onset(found.eccentricity_ratio).whirl_ratio), rel=1e-11
    )


def test_a_very_stiff_film_leaves_the_modes_of_the_shaft():
    """Small σ: the natural frequency is just (K_rot/M)^0.5, irrespective of the bearing."""
    eps, sag = 0.7559, 10.0
    at = onset(eps)
    natural = at.whirl_ratio * flexible_threshold(at.threshold_speed, at.equivalent_stiffness, sag)
    shaft = math.sqrt(1 / sag)  # √(K_rot/M) in units of √(F_o/(MC))
    assert natural == pytest.approx(shaft, rel=1 / (sag * float(at.equivalent_stiffness)))


# Misprints


def test_eq_5_4_load_is_minus_the_force():
    f_r, f_t = short.static_force(0.5)
    phi = short.attitude_angle(0.5)
    load = 0.25 / float(short.modified_sommerfeld(0.5))
    assert f_r * np.cos(phi) - f_t * np.sin(phi) == pytest.approx(-load, rel=ROUNDING)


def test_eq_5_7_attitude_angle_is_positive():
    f_r, f_t = short.static_force(0.5)
    assert math.tan(short.attitude_angle(0.5)) == pytest.approx(-f_t / f_r, rel=ROUNDING)
    assert -f_t / f_r == pytest.approx(+math.pi * math.sqrt(0.75) / 2, rel=ROUNDING)


def test_eq_5_35_as_printed_breaks_the_trace():
    """k_YY and c_YY print f_r² for f_t²: the sum with k_XX and c_XX is not that in (r, t)."""
    k, c = printed_5_35(EPS)
    unit = 4 * short.modified_sommerfeld(EPS)[:, None, None]
    for as_printed, corrected, radial in (
        (k, short.stiffness(EPS), unit * short.radial_stiffness(EPS)),
        (c, short.damping(EPS), unit * short.radial_damping(EPS)),
    ):
        invariant = np.trace(radial, axis1=1, axis2=2)
        assert np.trace(corrected, axis1=1, axis2=2) == pytest.approx(invariant, rel=ROUNDING)
        assert np.all(np.abs(np.trace(as_printed, axis1=1, axis2=2) / invariant - 1) > 1e-3)


def test_eq_5_1_imbalance_as_printed_turns_backward():
    """(sin Ωt, cos Ωt) = Re{(−j, 1)e^{jΩt}}."""
    assert orbit_ellipse(-1j, 1.0).semi_minor == -1
    assert orbit_ellipse(1.0, -1j).semi_minor == +1  # (cos, sin), as in the sheet


def test_the_sheets_gamma_is_not_squared():
    """√(1 + k_eq Γ²) for √(1 + k_eq Γ): with the sheet's Γ = 0.222 the onset would be 10 % off."""
    found = onset_speed(SHEET)
    at = onset(found.eccentricity_ratio)
    sag = SHEET.static_sag / SHEET.bearing.radial_clearance
    unit = math.sqrt(SHEET.static_load / (SHEET.rotor.half_mass * SHEET.bearing.radial_clearance))
    as_printed = at.threshold_speed / math.sqrt(1 + float(at.equivalent_stiffness) * sag**2) * unit
    corrected = flexible_threshold(at.threshold_speed, at.equivalent_stiffness, sag) * unit
    assert corrected == pytest.approx(found.speed, rel=1e-11)
    assert as_printed > 1.1 * found.speed


def test_only_dimensional_direct_stiffness_vanishes_at_the_centre():
    """Below Eq. 5.35 and at 5.48, k_XX = k_YY = k_eq = 0 hold for K_XX, K_YY and K_eq."""
    assert np.diag(short.stiffness(0.0)) == pytest.approx([4 / math.pi, 8 / math.pi], rel=ROUNDING)
    assert np.array_equal(np.diag(short.film_stiffness(0.0)), [0, 0])
    assert onset(1e-6).equivalent_stiffness == pytest.approx(6 / math.pi, rel=1e-11)
