"""Which way whirl sets in: the published verdict, the limit cycles, and extended precision."""

import math
from dataclasses import replace

import mpmath
import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from rotorcalc import JournalBearing, Machine, Oil, Rotor, analyse, hopf, simulate
from rotorcalc.films.short import motion
from rotorcalc.nonlinear import hopf as hopf_module
from rotorcalc.nonlinear import transient
from rotorcalc.nonlinear.collocation import Balance
from rotorcalc.nonlinear.continuation import small_cycle
from rotorcalc.nonlinear.film_expansion import FilmExpansion
from tests.films.models import BEARINGS, Preloaded
from tests.machines import RIGID, ROTORS, SHEET, C, balanced, log_uniform, machines, near_hopf

SOFT_TO_RIGID = RIGID | log_uniform(1e5, 1e10)
# Between the stiffness of the shaft and that of the film lie four orders of magnitude.
STIFF = Machine(
    oil=Oil(reference_viscosity=4e-3, reference_temperature=50, temperature_coefficient=0.03),
    bearing=JournalBearing(diameter=0.1, length=0.03, radial_clearance=100e-6),
    rotor=Rotor(mass=20.0),
    temperature=50.0,
)
# So lightly loaded that rounding decides the error of the third derivatives.
NEARLY_CENTRAL = Machine(
    oil=Oil(reference_viscosity=2e-3, reference_temperature=50, temperature_coefficient=0.03),
    bearing=JournalBearing(diameter=0.4, length=0.0872, radial_clearance=197e-6),
    rotor=Rotor(mass=10.0, disk_damping=1.677e6),
    temperature=30.0,
)
# Its force bends within a distance of 4e-8 C, and from farther away is odd about the rest.
AT_THE_CENTRE = Machine(
    oil=Oil(reference_viscosity=0.146, reference_temperature=50, temperature_coefficient=0.03),
    bearing=JournalBearing(diameter=0.3082, length=0.1932, radial_clearance=104.7e-6),
    rotor=Rotor(mass=13.42, shaft_stiffness=143.6e6, disk_damping=186.6e3, journal_mass=2.202e-3),
    temperature=93.3,
)


def stiff(k, **rotor):
    return replace(STIFF, rotor=replace(STIFF.rotor, shaft_stiffness=k, **rotor))


def found_of(machine):
    """Return the machine's onset, or leave this example out."""
    try:
        return hopf(machine)
    except ValueError:
        assume(False)


any_machine = st.booleans().flatmap(
    lambda damped: st.booleans().flatmap(
        lambda journals: machines(stiffness=SOFT_TO_RIGID, damped=damped, journals=journals)
    )
)


def lyapunov(eps):
    return hopf(near_hopf(eps, 1.0)[0]).lyapunov


def test_the_verdict_changes_at_the_published_eccentricity():
    assert brentq(lyapunov, 0.13, 0.15, xtol=1e-7) == pytest.approx(0.14109, abs=1e-5)
    assert lyapunov(0.14109 - 1e-4) > 0.0 > lyapunov(0.14109 + 1e-4)


@pytest.mark.parametrize("eps", [0.02, 0.06, 0.12, 0.16, 0.3, 0.6])
def test_the_sign_of_the_coefficient_is_certain_on_both_sides(eps):
    found = hopf(near_hopf(eps, 1.0)[0])
    assert found.subcritical == (eps < 0.14109)
    assert found.lyapunov_error < 1e-4 * abs(found.lyapunov)


@pytest.mark.parametrize("kind", ROTORS)
def test_the_normal_form_grows_as_the_motion_does(kind):
    """At the onset, where the linear growth vanishes, ȧ = ℓ (a/C)² a is all that is left."""
    machine = balanced(ROTORS[kind])
    onset = hopf(machine)
    growths = []
    for size in (0.05, 0.1):
        start = transient.start_on_mode(machine, onset.speed, size * C)
        motion = simulate(machine, onset.speed, revolutions=60, start=start)
        rest = analyse(machine, onset.speed).journal_position
        turns = np.hypot(*(motion.journal - rest).T)[: 60 * 64].reshape(30, -1).max(axis=1) / C
        time = motion.time[: 60 * 64].reshape(30, -1).mean(axis=1)
        # d(a⁻²)/dt = −2ℓ, whatever the shape of the orbit's fast turns.
        growths.append(np.polyfit(time[5:], turns[5:] ** -2.0, 1)[0] / -2.0)
    # Of the next order, a², two sizes rid the answer.
    assert (4.0 * growths[0] - growths[1]) / 3.0 == pytest.approx(onset.lyapunov, rel=0.03)


@settings(max_examples=70)
@given(machine=any_machine)
@example(machine=stiff(1e9))
@example(machine=stiff(1e10))
@example(machine=stiff(1e5))
@example(machine=AT_THE_CENTRE)
def test_the_coefficient_is_that_of_the_limit_cycles(machine):
    """The cycles know nothing of derivatives: ℓ is −C² d(Re λ)/dΩ over the slope of a² by Ω."""
    onset = found_of(machine)
    lyapunov, doubt = lyapunov_of_cycles(machine, onset)
    assume(doubt < 0.003 * abs(lyapunov))
    assert abs(onset.lyapunov - lyapunov) < 0.01 * abs(lyapunov) + onset.lyapunov_error


@pytest.mark.parametrize("spring", [0.05, 0.2, 0.3])
@pytest.mark.parametrize("stiffness", [1e7, math.inf])
def test_another_film_has_the_coefficient_of_its_limit_cycles(spring, stiffness):
    """One with direct stiffness, which holds the journal without load."""
    bearing = replace(SHEET.bearing, geometry=Preloaded(spring=spring))
    rotor = replace(SHEET.rotor, shaft_stiffness=stiffness)
    onset = hopf(machine := replace(SHEET, bearing=bearing, rotor=rotor))
    lyapunov, doubt = lyapunov_of_cycles(machine, onset)
    assert doubt < 1e-3 * abs(lyapunov)
    assert onset.lyapunov_error < 1e-3 * abs(lyapunov)
    assert onset.lyapunov == pytest.approx(lyapunov, rel=5e-3)


@pytest.mark.parametrize("name", ["ringed", "ringed, heavy"])
def test_films_with_inner_coordinates_are_refused(name):
    with pytest.raises(ValueError, match="does not give the forces on its inner coordinates"):
        hopf(replace(SHEET, bearing=BEARINGS[name]))


def lyapunov_of_cycles(machine, onset):
    """Return ℓ from cycles of ever smaller size, and by how much two extrapolations differ."""
    values = []
    for size in 0.16 * 0.5 ** np.arange(9):
        cycle = small_cycle(Balance(machine), onset, size)
        if cycle is None:
            values.append(math.nan)
            continue
        first = np.fft.fft(cycle.path, axis=0)[1] * 2.0 / len(cycle.path)
        turned = first * np.exp(-0.5j * np.angle(np.sum(first**2)))
        square = np.sum(turned.real**2)
        values.append(-onset.growth_slope * (cycle.speed - onset.speed) / square)
    once = (4.0 * np.array(values[1:]) - values[:-1]) / 3.0  # the next order is a²
    doubt = np.abs(np.diff(once))
    doubt[np.isnan(doubt)] = np.inf
    best = int(np.argmin(doubt))
    return once[best + 1], doubt[best]


@settings(max_examples=40)
@given(machine=any_machine)
@example(machine=NEARLY_CENTRAL)
@example(machine=AT_THE_CENTRE)
def test_the_error_bounds_the_difference_from_extended_precision(machine):
    onset = found_of(machine)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(FilmExpansion, "along", derivatives_in_extended_precision)
        terms = hopf_module._lyapunov_terms(machine, onset.speed, onset.whirl_frequency, 5)
    assert abs(onset.lyapunov - float(np.sum(terms))) < onset.lyapunov_error


def derivatives_in_extended_precision(expansion, direction):
    """Return second and third differences of the short film's force with sixty digits."""
    size = float(np.linalg.norm(direction))
    with mpmath.workdps(60):
        step = mpmath.mpf(10) ** -9 * float(np.hypot(*expansion.rest[:2]))
        values = [
            mpmath.matrix(
                short_force(*(
                    mpmath.mpf(float(rest)) + count * step * float(way) / size
                    for rest, way in zip(expansion.rest, direction, strict=True)
                ))
            )
            for count in range(-2, 3)
        ]  # fmt: skip
        second = (values[3] - 2 * values[2] + values[1]) / step**2 * size**2
        third = (values[4] - 2 * values[3] + 2 * values[1] - values[0]) / (2 * step**3) * size**3
        return np.array([[float(number) for number in order] for order in (second, third)])


def short_force(x, y, dx, dy):
    """Return the short film's force by its formula, of mpmath's numbers."""
    A, B = dx + y / 2, dy - x / 2
    V = mpmath.sqrt(A**2 + B**2)
    sin, cos = A / V, -B / V
    a, b, kappa2 = x * cos + y * sin, -x * sin + y * cos, 1 - x**2 - y**2
    kappa = mpmath.sqrt(kappa2)
    G = 2 / kappa * (mpmath.pi / 2 - mpmath.atan(b / kappa))
    F_a = V / 2 * a * (3 * b * G - 4 - 2 * b**2 / (1 - a**2)) / kappa2**2
    F_b = V / 2 * (G / kappa2 + 3 * b * (b * G - 2) / kappa2**2)
    return F_a * cos - F_b * sin, F_a * sin + F_b * cos


def test_extended_precision_has_the_same_force():
    point = (0.3, -0.2, 0.1, 0.4)
    assert [float(f) for f in short_force(*map(mpmath.mpf, point))] == pytest.approx(
        motion.force(*point), rel=1e-12
    )


@pytest.mark.parametrize("journal_mass", [0.0, 0.5])
def test_a_stiffer_shaft_tends_to_the_rigid_one(journal_mass):
    """The shaft gives way by force over stiffness, so the difference falls tenfold a decade."""
    rigid = hopf(STIFF).lyapunov
    away = [
        hopf(stiff(10.0**power, journal_mass=journal_mass)).lyapunov - rigid
        for power in range(8, 13)
    ]
    assert np.array(away[1:]) / away[:-1] == pytest.approx(0.1, rel=0.3)


def test_the_verdict_is_withheld_where_the_sign_is_not_certain():
    border = brentq(lyapunov, 0.13, 0.15, xtol=1e-15, rtol=1e-14)
    assert hopf(near_hopf(border, 1.0)[0]).subcritical is None
    onset = hopf(STIFF)
    assert onset.subcritical is False
    assert replace(onset, lyapunov=35.0).subcritical is True
    assert replace(onset, lyapunov_error=36.0).subcritical is None


@given(
    place=st.tuples(*2 * [st.floats(-0.5, 0.5)]),
    u=st.lists(st.floats(-1.0, 1.0), min_size=4, max_size=4),
)
def test_any_force_has_its_derivatives(place, u):
    """Known ones, of a force without wall or half speed whirl."""
    direction = np.array(u)
    assume(np.linalg.norm(direction) > 1e-3)

    def force(x, y, dx, dy):
        return math.exp(x - 2.0 * dy), math.sin(y + 3.0 * dx)

    found = FilmExpansion(force, np.array(place), 0.3, 17).along(direction)
    along_x, along_y = u[0] - 2.0 * u[3], u[1] + 3.0 * u[2]
    x, y = place
    expected = [
        [along_x**2 * math.exp(x), -(along_y**2) * math.sin(y)],
        [along_x**3 * math.exp(x), -(along_y**3) * math.cos(y)],
    ]
    size = np.linalg.norm(direction)
    assert np.array(found) / [[size**2], [size**3]] == pytest.approx(
        np.array(expected) / [[size**2], [size**3]], rel=1e-6, abs=1e-6
    )


@pytest.mark.parametrize("frequency", [math.inf, math.nan])
def test_a_whirl_without_a_frequency_is_refused(frequency):
    with pytest.raises(ValueError, match=r"frequency = (inf|nan) rad/s: must be finite"):
        hopf_module.whirl_shape(SHEET, 900.0, frequency)
