"""The calculation sheet of Notes 5 for a rotor of 600 lbf, to the digits printed.

L. San Andrés, Notes 5, "Stability and Imbalance Response of a Jeffcott-Rotor Supported on Short
Length Journal Bearings" (UT/2000, TAMU/2006). The machine-read sheet prints its data and the values
of the first group of tests; its curves are lost. The second group are the values of the open cases
that the program's design lists for the same machine, computed once and checked against quadrature.

Axes and signs are the program's own: X along the load, rotation from X to Y, K_ij = −∂F_i/∂X_j.
"""

import math

import pytest

from rotorcalc import PRESETS, analyse, onset_speed

STIFF, FLEXIBLE = PRESETS["sheet-1e8"].machine, PRESETS["sheet-1e7"].machine
RPM = math.pi / 30
LITRE_PER_MINUTE = 1e-3 / 60


def printed(number):
    """Return what agrees with a printed number: to half a unit of its last digit."""
    mantissa, _, exponent = number.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return pytest.approx(float(number), rel=0, abs=0.5001 * 10.0 ** (int(exponent or 0) - decimals))


@pytest.fixture(scope="module")
def at_6000():
    return analyse(STIFF, 6000 * RPM)


# Printed in the sheet


def test_load_and_mass():
    assert STIFF.static_load == printed("1.334e3")  # W [N]
    assert STIFF.rotor.half_mass == printed("136.071")  # M [kg]
    assert STIFF.rotor.mass == printed("272.142")  # 2·M [kg]


def test_operating_viscosity():
    assert STIFF.viscosity == printed("0.013")  # [N·s/m²]


def test_static_deflection_of_the_shaft():
    assert STIFF.static_sag == printed("1.334e-5")  # δ [m]
    assert STIFF.static_sag / STIFF.bearing.radial_clearance == printed("0.222")  # Γ
    assert FLEXIBLE.static_sag == printed("1.334e-4")
    assert FLEXIBLE.static_sag / FLEXIBLE.bearing.radial_clearance == printed("2.224")


@pytest.mark.parametrize(("machine", "number"), [(STIFF, "8.186e3"), (FLEXIBLE, "2.589e3")])
def test_natural_frequency_of_the_shaft(machine, number):
    frequency = math.sqrt(machine.rotor.shaft_stiffness / machine.rotor.half_mass)
    assert frequency / RPM == printed(number)  # ω_elastic [rpm]


def test_imbalance():
    assert STIFF.rotor.imbalance == printed("1.2e-5")  # a [m]
    assert STIFF.rotor.imbalance / STIFF.bearing.radial_clearance == printed("0.2")


# Of the same machine, from the program's design


def test_operating_viscosity_to_more_digits():
    assert STIFF.viscosity == printed("0.012769")


@pytest.mark.parametrize(
    ("machine", "flexible", "rpm"),
    [(STIFF, False, "10651.9"), (STIFF, True, "8919.3"), (FLEXIBLE, True, "4627.1")],
)
def test_onset_speed(machine, flexible, rpm):
    assert onset_speed(machine, flexible=flexible).speed / RPM == printed(rpm)


def test_whirl_at_the_rigid_onset():
    assert onset_speed(STIFF, flexible=False).whirl_frequency / RPM == printed("5332.6")


def test_equilibrium_at_6000_rpm(at_6000):
    assert at_6000.sommerfeld == printed("3.91447")
    assert at_6000.eccentricity_ratio == printed("0.080116")


def test_side_flow_at_6000_rpm(at_6000):
    assert at_6000.side_flow / LITRE_PER_MINUTE == printed("0.67957")


def test_power_loss_at_6000_rpm(at_6000):
    assert at_6000.power_loss / 1e3 == printed("11.1735")  # [kW]


def test_the_stiff_rotor_is_stable_at_6000_rpm_and_the_flexible_one_is_not(at_6000):
    assert at_6000.flexible_eigenvalues.real.max() < 0
    assert analyse(FLEXIBLE, 6000 * RPM).flexible_eigenvalues.real.max() > 0
