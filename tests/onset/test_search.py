"""Whirl onset: closed forms, determinants, and every onset against an exact count of roots."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq, minimize_scalar

from rotorcalc import (
    JournalBearing,
    Machine,
    Oil,
    Onset,
    PartialArc,
    Rotor,
    analyse,
    modes,
    onset_speed,
    unstable_ranges,
)
from rotorcalc.coefficients import equilibrium, modified_sommerfeld
from rotorcalc.films import short
from rotorcalc.films.finite import table as finite_table
from rotorcalc.numerics import routh
from rotorcalc.onset import search
from rotorcalc.onset.characteristic import polynomial
from rotorcalc.onset.whirl import flexible_threshold, whirl_onset
from tests.machines import (
    ALWAYS_STABLE,
    BENDING,
    EPS,
    RIGID,
    ROTORS,
    RPM,
    SHEET,
    balanced,
    log_uniform,
    machines,
    unstable_roots,
    with_rotor,
)

# An onset takes some 10 ms, an exact count of roots 1 ms.
few = settings(max_examples=25, suppress_health_check=[HealthCheck.too_slow])
loads = st.none() | log_uniform(1e-4, 1e6)


def threshold(eps):
    """Return k_eq, whirl ratio and p_s² of the short bearing."""
    onset = whirl_onset(short.stiffness(eps), short.damping(eps))
    return onset.equivalent_stiffness, onset.whirl_ratio, onset.critical_mass


def closed_form_onset(machine):
    """Return where Ω = Ω_sf(ε(Ω)), for massless journals without midspan damping.

    Solved for ε, with Ω(ε) from the Sommerfeld number and Ω_sf from Eqs. 5.45 to 5.50.
    """
    bearing, load = machine.bearing, machine.static_load
    C = bearing.radial_clearance
    unit = (
        machine.viscosity * bearing.length * bearing.radius / (4 * load) * (bearing.length / C) ** 2
    )
    sag = machine.static_sag / C

    def speed(log_eps):
        return float(short.modified_sommerfeld(math.exp(log_eps))) / unit

    def excess(log_eps):
        k_eq, _, p2 = threshold(math.exp(log_eps))
        onset = p2 * load / (C * machine.rotor.half_mass) / (1 + k_eq * sag)
        return math.log(speed(log_eps) ** 2 / onset)

    ends = math.log(1e-14), math.log(ALWAYS_STABLE * (1 - 1e-12))
    return speed(brentq(excess, *ends, xtol=1e-15, rtol=8 * EPS))


def rounding(machine, speed):
    """Return the relative error of an onset from coefficients with the rounding error EPS.

    Growth per Ω rounds to some EPS. Near the centre the film's damping, C ≈ 2πσF_o/(CΩ), outweighs
    the rotor's inertia and the growth passes zero with a slope of 1/(2πσ); on a soft shaft the
    film takes part in the disk's mode only by K_rot/K_eq.
    """
    state = equilibrium(machine, speed)
    K_eq = float(whirl_onset(state.stiffness, state.damping * speed).equivalent_stiffness)
    sigma = float(modified_sommerfeld(machine, speed))
    return 200 * EPS * (1 + 2 * math.pi * sigma) * (1 + K_eq / machine.rotor.shaft_stiffness)


# From k and c


@given(st.floats(1e-6, 0.7560), st.floats(-3, 3))
def test_onset_makes_the_determinant_vanish(eps, power):
    """Eq. 5.44 at p² = p_s² and ω = ω̄, in any common unit of k and c."""
    unit = 10.0**power
    k, c = unit * short.stiffness(eps), unit * short.damping(eps)
    onset = whirl_onset(k, c)
    w = onset.whirl_ratio
    Z = k - onset.critical_mass * w**2 * np.eye(2) + 1j * w * c
    det = Z[0, 0] * Z[1, 1] - Z[0, 1] * Z[1, 0]
    terms = np.abs(Z[0, 0] * Z[1, 1]) + np.abs(Z[0, 1] * Z[1, 0])
    # ω̄² is a difference whose terms stay of the size of k² while it vanishes at the limit.
    assert abs(det) <= 64 * EPS * (terms + np.abs(k).max() ** 2)


@given(
    st.lists(st.integers(-2000, 2000).map(lambda n: n / 1000), min_size=6, max_size=6),
    st.floats(0.1, 2),
    st.floats(-0.9, 0.9),
)
def test_onset_makes_the_determinant_vanish_for_any_bearing(numbers, c_YY, coupling):
    """Coefficients of no particular bearing, damping positive definite but not symmetric."""
    k = np.reshape(numbers[:4], (2, 2))
    c_XX = 0.1 + abs(numbers[4])
    cross = coupling * math.sqrt(c_XX * c_YY)
    c = np.array([[c_XX, cross + 0.1 * numbers[5]], [cross, c_YY]])
    assume(np.linalg.det(c) > 1e-3)
    onset = whirl_onset(k, c)
    w = onset.whirl_ratio
    assume(w > 1e-3)
    Z = k - onset.critical_mass * w**2 * np.eye(2) + 1j * w * c
    assert abs(np.linalg.det(Z)) <= 1000 * EPS * max(1.0, np.abs(Z).max()) ** 2


def test_a_film_that_cannot_whirl_has_no_critical_mass():
    for eps in (ALWAYS_STABLE + 1e-9, 0.8, 0.99):
        onset = whirl_onset(short.stiffness(eps), short.damping(eps))
        assert onset.whirl_ratio == 0
        assert onset.critical_mass == math.inf
        assert onset.threshold_speed == math.inf
        assert onset.equivalent_stiffness > 0


def test_whirl_ratio_vanishes_at_the_limit_of_stability():
    def square(eps):
        """Return ω̄² of Eq. 5.46, which continues below zero."""
        k, c = short.stiffness(eps), short.damping(eps)
        k_eq = whirl_onset(k, c).equivalent_stiffness
        return (k_eq - k[0, 0]) * (k_eq - k[1, 1]) - k[0, 1] * k[1, 0]

    limit = brentq(square, 0.7, 0.8, xtol=1e-15)
    assert limit == pytest.approx(ALWAYS_STABLE, abs=0.5e-12)
    assert float(short.modified_sommerfeld(limit)) == pytest.approx(0.0663852602, abs=0.5e-10)


def test_threshold_speed_has_its_minimum():
    least = minimize_scalar(
        lambda eps: float(threshold(eps)[2]),
        bounds=(0.3, 0.6),
        method="bounded",
        options={"xatol": 1e-10},
    )
    # A minimum is found to the root of EPS; its value to EPS.
    assert least.x == pytest.approx(0.45697072, abs=2e-8)
    assert math.sqrt(least.fun) == pytest.approx(2.5317057092, abs=0.5e-10)


def test_without_cross_coupling_no_rotor_whirls():
    onset = whirl_onset([[1.0, 0.0], [0.0, 2.0]], [[1.0, 0.2], [0.2, 1.0]])
    assert onset.whirl_ratio == 0
    assert onset.threshold_speed == math.inf


def test_a_negative_equivalent_stiffness_is_stable_at_no_speed():
    onset = whirl_onset([[-1.0, 1.0], [-1.0, -1.0]], np.eye(2))
    assert onset.equivalent_stiffness == -1
    assert onset.whirl_ratio == 1
    assert onset.threshold_speed == 0


@pytest.mark.parametrize("shape", [(), (3,), (2, 3), (0,)])
def test_onset_broadcasts(shape):
    k, c = short.stiffness(0.4), short.damping(np.full(shape, 0.4))
    onset = whirl_onset(np.broadcast_to(k, (*shape, 2, 2)), c)
    for name in ("equivalent_stiffness", "whirl_ratio", "critical_mass", "threshold_speed"):
        assert np.shape(getattr(onset, name)) == shape
        assert np.all(getattr(onset, name) == getattr(whirl_onset(k, short.damping(0.4)), name))


@given(st.floats(0.01, 0.75), st.floats(0, 10))
def test_flexible_threshold_has_film_and_shaft_in_series(eps, sag):
    k_eq, ratio, p2 = threshold(eps)
    p_sf = flexible_threshold(math.sqrt(p2), k_eq, sag)
    series = 1 / (1 / k_eq + sag)
    assert (ratio * p_sf) ** 2 == pytest.approx(series, rel=16 * EPS)  # ω_s² = K/M, the same ω̄
    assert flexible_threshold(math.sqrt(p2), k_eq, 0.0) == math.sqrt(p2)


def test_flexible_threshold_broadcasts():
    assert flexible_threshold(np.ones(4), np.ones(4), np.ones((3, 1))).shape == (3, 4)
    assert flexible_threshold(math.inf, 2.0, 1.0) == math.inf


# Of a machine: closed forms


@few
@given(machines(load=loads))
def test_onset_is_the_closed_form(machine):
    """Ω = Ω_sf(ε(Ω)), Eqs. 5.45 to 5.50, = the crossing of an eigenvalue, rigid and flexible."""
    onset = onset_speed(machine)
    expected = closed_form_onset(machine)
    assert onset.speed == pytest.approx(expected, rel=rounding(machine, expected))


@few
@given(machines())
def test_whirl_at_the_onset_is_at_the_whirl_ratio_of_the_film(machine):
    onset = onset_speed(machine)
    k_eq, ratio, _ = threshold(onset.eccentricity_ratio)
    # ω̄² is a difference of terms of order 1.
    error = rounding(machine, onset.speed) / float(ratio) ** 2
    assert onset.whirl_frequency == pytest.approx(float(ratio) * onset.speed, rel=error)
    K_eq = float(k_eq) * machine.static_load / machine.bearing.radial_clearance
    series = 1 / (1 / K_eq + 1 / machine.rotor.shaft_stiffness)
    assert onset.whirl_frequency == pytest.approx(  # Eq. 5.47
        math.sqrt(series / machine.rotor.half_mass), rel=error
    )


@few
@given(machines(), st.booleans())
def test_onset_puts_an_eigenvalue_on_the_imaginary_axis(machine, flexible):
    onset = onset_speed(machine, flexible=flexible)
    state = equilibrium(machine, onset.speed)
    lam = modes.refined_eigenvalues(
        machine.rotor, state.stiffness, state.damping, flexible=flexible
    )
    distance = np.abs(lam - 1j * onset.whirl_frequency)
    assert np.nanmin(distance) <= 1e-12 * onset.speed
    assert np.nanmax(lam.real) <= 1e-12 * onset.speed  # and none has gone before it


@few
@given(machines(stiffness=RIGID))
def test_flexible_false_gives_the_onset_of_a_rigid_shaft(machine):
    rigid = onset_speed(machine)
    bending = with_rotor(machine, shaft_stiffness=1e7)
    assert onset_speed(bending, flexible=False) == rigid
    assert onset_speed(bending).speed < rigid.speed


@pytest.mark.parametrize("stiffness", [1e12, 1e14, 1e16, 1e18])
def test_a_very_stiff_shaft_tends_to_a_rigid_one(stiffness):
    """Eq. 5.50: Ω_sf = Ω_s(1 − K_eq/(2K_rot)), K_eq = 42.5 MN/m here, moves ε by as little."""
    rigid = onset_speed(SHEET, flexible=False).speed
    stiff = onset_speed(with_rotor(shaft_stiffness=stiffness)).speed
    assert stiff == pytest.approx(rigid, rel=4.3e7 / stiffness + 1e-12)


@few
@given(machines(stiffness=RIGID, damped=True))
def test_rigid_onset_with_damping_is_that_of_a_film_with_more_damping(machine):
    """On a rigid rotor C_s adds to C_XX and C_YY, so Eqs. 5.45 and 5.46 hold for C + C_s I."""
    onset = onset_speed(machine)
    state = equilibrium(machine, onset.speed)
    damping = state.damping + machine.rotor.disk_damping * np.eye(2)
    expected = whirl_onset(state.stiffness, damping * state.speed)
    # Damping of the disk beside a light film's counts as the film's own does.
    heavier = 1 + machine.rotor.disk_damping / np.trace(state.damping)
    # ω̄² is a difference of terms of order 1.
    error = rounding(machine, onset.speed) * heavier / float(expected.whirl_ratio) ** 2
    assert math.sqrt(expected.critical_mass / machine.rotor.half_mass) == pytest.approx(
        onset.speed, rel=error
    )
    assert float(expected.whirl_ratio) * onset.speed == pytest.approx(
        onset.whirl_frequency, rel=error
    )


@few
@given(machines(stiffness=RIGID, journals=True))
def test_a_rigid_rotors_results_do_not_depend_on_where_its_mass_is(machine):
    whole = onset_speed(with_rotor(machine, journal_mass=0.0))
    error = rounding(machine, whole.speed)  # m_d + M_j is M to a rounding error
    assert onset_speed(machine).speed == pytest.approx(whole.speed, rel=error)
    assert onset_speed(machine).whirl_frequency == pytest.approx(whole.whirl_frequency, rel=error)


@few
@given(machines(stiffness=BENDING, journals=True))
def test_onset_with_journal_mass_is_where_the_rotor_balances_the_film(machine):
    """Undamped, the rotor's dynamic stiffness at ω̄Ω is the film's K_eq.

    m_j ω² + K_rot m_d ω²/(K_rot − m_d ω²) = K_eq: the film's impedance has the real eigenvalue
    K_eq at ω̄Ω, whatever the rotor.
    """
    onset = onset_speed(machine)
    k_eq, ratio, _ = threshold(onset.eccentricity_ratio)
    K_eq = float(k_eq) * machine.static_load / machine.bearing.radial_clearance
    rotor, square = machine.rotor, (float(ratio) * onset.speed) ** 2
    k, m_d, m_j = rotor.shaft_stiffness, rotor.disk_mass, rotor.journal_mass
    # Lowest root of (K_eq − m_j ω²)(K_rot − m_d ω²) = K_rot m_d ω²: no other, no pole.
    b = m_j * k + m_d * (k + K_eq)
    lowest = 2 * K_eq * k / (b + math.sqrt(b**2 - 4 * m_j * m_d * K_eq * k))
    # ω̄² is a difference of terms of order 1.
    assert square == pytest.approx(lowest, rel=2 * rounding(machine, onset.speed) / ratio**2)


@pytest.mark.parametrize("stiffness", [1e7, 1e8, 1e9])
def test_a_vanishing_journal_mass_gives_the_massless_onset(stiffness):
    """The distance falls with the mass, to rounding."""
    massless = with_rotor(shaft_stiffness=stiffness)
    limit = onset_speed(massless).speed
    distance = [
        abs(onset_speed(with_rotor(massless, journal_mass=m)).speed / limit - 1)
        for m in (1.0, 1e-3, 1e-6)
    ]
    assert distance[1] == pytest.approx(1e-3 * distance[0], rel=0.02)
    assert distance[2] == pytest.approx(1e-6 * distance[0], rel=0.02, abs=1e-12)


@few
@given(machines(damped=True, journals=True), st.booleans())
def test_a_vanishing_damping_gives_the_undamped_onset(machine, flexible):
    undamped = with_rotor(machine, disk_damping=0.0)
    slight = with_rotor(machine, disk_damping=1e-14 * machine.rotor.disk_damping)
    limit = onset_speed(undamped, flexible=flexible).speed
    assert onset_speed(slight, flexible=flexible).speed == pytest.approx(
        limit, rel=1e-6 + rounding(machine, limit)
    )


# Of a machine: exact counts of unstable roots


@few
@given(machines(damped=True, journals=True, load=loads), st.floats(ALWAYS_STABLE + 1e-9, 0.9999))
def test_every_rotor_is_stable_above_the_limit_of_eccentricity(machine, eps):
    """Whatever mass, shaft, midspan damping and journals."""
    speed = float(short.modified_sommerfeld(eps) / modified_sommerfeld(machine, 1.0))
    assume(equilibrium(machine, speed).film.eccentricity_ratio > ALWAYS_STABLE)
    assert unstable_roots(machine, speed) == 0
    assert unstable_roots(machine, speed, flexible=False) == 0


@few
@given(machines(), st.floats(0.001, ALWAYS_STABLE - 1e-6))
def test_below_the_limit_some_mass_is_unstable(machine, eps):
    """More than the critical mass, to be exact: the limit is no higher than it need be."""
    speed = float(short.modified_sommerfeld(eps) / modified_sommerfeld(machine, 1.0))
    state = equilibrium(machine, speed)
    onset = whirl_onset(state.stiffness, state.damping * speed)
    M_c = float(onset.critical_mass) / speed**2
    load = machine.static_load
    for share, count in ((0.999, 0), (1.001, 2)):
        loaded = replace(with_rotor(machine, mass=2 * share * M_c), load=load)
        assert unstable_roots(loaded, speed, flexible=False) == count


def assert_stable_below(machine, onset, lowest, *, flexible=True):
    """No root is unstable at any of many speeds up to the onset."""
    highest = onset.speed if math.isfinite(onset.speed) else 1e7 * lowest
    for speed in np.geomspace(min(lowest, 1e-3 * highest), highest, 60)[:-1]:
        assert unstable_roots(machine, speed, flexible=flexible) == 0, speed


def assert_unstable_above(machine, onset, *, flexible=True):
    assert (
        unstable_roots(machine, onset.speed * (1 + margin(machine, onset)), flexible=flexible) > 0
    )


def margin(machine, onset):
    return max(1e-9, 1e3 * rounding(machine, onset.speed))


@few
@given(
    st.one_of(
        machines(damped=True, journals=True, load=loads),
        machines(damped=True, load=loads),
        machines(journals=True, load=loads),
    ),
    st.booleans(),
)
# A light journal on a stiff shaft: rounding of the state matrix alone once made an onset of this.
@example(
    with_rotor(
        replace(SHEET, oil=replace(SHEET.oil, reference_viscosity=0.2), temperature=30.0),
        shaft_stiffness=4.2e9,
        journal_mass=0.03,
    ),
    True,
)
# Midspan damping that quenches the whirl of the disk, and leaves that of the journals, far above.
@example(with_rotor(shaft_stiffness=2.95e7, disk_damping=1.3e5, journal_mass=0.03), True)
@example(with_rotor(shaft_stiffness=1e7, disk_damping=5e3, journal_mass=10.0), True)
# Midspan damping that all but quenches the whirl, which then is far faster than the rigid rotor's.
@example(replace(with_rotor(disk_damping=1.12e5), load=1.0), True)
# A very stiff film and a light journal: two modes of the disk lie next to each other.
@example(
    Machine(
        oil=replace(SHEET.oil, reference_viscosity=0.1),
        bearing=JournalBearing(diameter=0.25, length=0.25, radial_clearance=70.3e-6),
        rotor=replace(SHEET.rotor, mass=10.0, shaft_stiffness=1e6, journal_mass=0.005),
        temperature=20.0,
    ),
    True,
)
# Next to no load: the growth at the onset is a millionth of a millionth of the decay of others.
@example(replace(SHEET, load=1e-6), True)
@example(replace(with_rotor(disk_damping=500.0), load=1e-4), True)
def test_onset_is_the_lowest_speed_with_an_unstable_root(machine, flexible):
    onset = onset_speed(machine, flexible=flexible)
    lowest = 0.01 / float(modified_sommerfeld(machine, 1.0))
    assert_stable_below(
        machine, replace(onset, speed=onset.speed * (1 - 1e-6)), lowest, flexible=flexible
    )
    if math.isfinite(onset.speed):
        assert_unstable_above(machine, onset, flexible=flexible)


def test_midspan_damping_raises_the_onset_of_a_stiff_shaft_until_there_is_none():
    """Of the sheet's rotor on 1e8 N/m, each onset found by itself and exact counts around it."""
    speeds = [onset_speed(with_rotor(disk_damping=c)).speed for c in (0, 1e3, 1e4, 2e4)]
    assert speeds == sorted(speeds)
    assert len(set(speeds)) == 4
    quiet = with_rotor(disk_damping=1e5)
    assert onset_speed(quiet).speed == math.inf
    for speed in np.geomspace(1.0, 1e7, 200):
        assert unstable_roots(quiet, speed) == 0


def test_no_onset_has_no_whirl():
    none = onset_speed(with_rotor(disk_damping=1e5))
    assert none.speed == math.inf
    assert math.isnan(none.whirl_frequency)
    assert math.isnan(none.eccentricity_ratio)


# Of a machine: what the search goes by


@few
@given(machines(damped=True, journals=True, load=loads), st.floats(-3, 3), st.booleans())
def test_no_root_is_unstable_where_floats_prove_stability(machine, power, flexible):
    speed = 10.0**power / float(modified_sommerfeld(machine, 1.0))
    count = unstable_roots(machine, speed, flexible=flexible)
    if routh.margin_bounds(polynomial(machine, np.array(speed), flexible))[1] < 0:
        assert count == 0


@pytest.mark.parametrize("rotor", ROTORS.values(), ids=ROTORS)
def test_stability_is_certain_except_beside_the_onset(rotor):
    machine = balanced(rotor)
    onset = onset_speed(machine).speed
    speeds = onset * np.array([0.01, 0.1, 0.5, 1 - 1e-9, 1 + 1e-9, 1.05, 1.2, 1.5, 2, 5, 10])
    _, doubt = routh.margin_bounds(polynomial(machine, speeds, True))
    unstable = [unstable_roots(machine, speed) > 0 for speed in speeds]
    assert unstable[:5] == [False, False, False, False, True]
    assert list(doubt > 0) == unstable


def test_kharitonovs_polynomials_have_the_four_patterns_of_the_theorem():
    """Even and odd part each lowest and highest on the imaginary axis, in every pair."""
    signs = routh._KHARITONOV
    assert np.all(signs[:, 2:] == -signs[:, :-2])
    assert {tuple(row) for row in signs[:, :2]} == {(1, 1), (1, -1), (-1, 1), (-1, -1)}


@pytest.mark.parametrize("rotor", ROTORS.values(), ids=ROTORS)
@pytest.mark.parametrize("load", [None, 1.0, 0.0])
def test_all_methods_find_the_same_onset(monkeypatch, rotor, load):
    """The polynomial in floats, and in many digits where rounding leaves it in doubt everywhere."""
    machine = replace(balanced(rotor), load=load)
    onset = onset_speed(machine)
    in_floats = search.searched_onset(machine)
    monkeypatch.setattr(routh, "ROUNDING", 1.0)
    in_digits = search.searched_onset(machine)
    assert in_digits.method == "extended precision"
    assert in_floats.method == ("extended precision" if load == 0.0 else "polynomial")
    for found in (in_floats, in_digits):
        for name in ("speed", "whirl_frequency", "eccentricity_ratio"):
            assert getattr(found, name) == pytest.approx(getattr(onset, name), rel=1e-12), name


@given(st.floats(0.02, 0.98))
def test_a_hump_between_two_speeds_is_found(place):
    """Narrower than their distance, and lower than what follows."""
    speeds = np.arange(1.0, 11.0)

    def values(speed):
        hump = 1.001 - (speed - 4.0 - place) ** 2
        return np.where(speed < 9.5, np.maximum(hump, -1.0 - 0.1 * (speed - 7) ** 2) - 1.0, 1.0)

    low, high = search.first_crossing(values, speeds)
    assert values(np.array(low)) < 0 < values(np.array(high))
    assert high < 6
    assert search.first_crossing(lambda s: values(s) - 0.01, speeds) == (9.0, 10.0)
    assert search.first_crossing(lambda s: values(s) - 9.0, speeds) is None


@given(st.floats(0.02, 0.98))
def test_a_hump_whose_top_is_a_jump_is_found(place):
    """As where a pad gives up its film; a hundredth below zero it is not one."""
    speeds = np.arange(1.0, 11.0)
    jump = 4.0 + place

    def values(speed):
        return np.where(speed < jump, -2.0 - 0.01 * speed, jump - speed) + 0.01

    ((low, top),) = search.humps(values, speeds, values(speeds))
    assert values(np.array(low)) < 0.0 < values(np.array(top))
    assert not list(search.humps(lambda s: values(s) - 0.02, speeds, values(speeds) - 0.02))


def test_a_hump_far_below_zero_is_looked_at_once():
    speeds = np.linspace(1.0, 50.0, 400)
    looks = []

    def values(speed):
        looks.append(len(speed))
        return np.sin(speed) - 1.01

    assert not list(search.humps(values, speeds, values(speeds)))
    assert len(looks) == 2


# Without load


@few
@given(machines(load=st.just(0.0)), st.booleans())
def test_without_load_an_undamped_rotor_whirls_at_any_speed(machine, flexible):
    assert onset_speed(machine, flexible=flexible) == Onset(0.0, 0.0, 0.0, "closed form")


@few
@given(machines(stiffness=RIGID, damped=True, load=st.just(0.0)))
def test_without_load_damping_does_not_help_a_rigid_rotor(machine):
    assert onset_speed(machine) == Onset(0.0, 0.0, 0.0, "extended precision")


@few
@given(machines(stiffness=BENDING, damped=True, load=st.just(0.0)))
def test_without_load_a_flexible_rotor_is_stable_if_its_damping_outweighs_its_mass(machine):
    """The disk's dynamic stiffness at low frequency is −(M − C_s²/K_rot)ω², as a mass is."""
    rotor = machine.rotor
    effective = rotor.half_mass - rotor.disk_damping**2 / rotor.shaft_stiffness
    assume(abs(effective) > 1e-3 * rotor.half_mass)
    assert onset_speed(machine).speed == (0.0 if effective > 0 else math.inf)


@few
@given(machines(stiffness=BENDING, damped=True, journals=True, load=st.just(0.0)))
def test_without_load_journals_whirl_where_their_inertia_takes_over(machine):
    """A centred film feeds Ω/2: K_rot, C_s, m_d and M_j balance at ω, and Ω = 2ω(1 + δ/C).

    With X = ω², z = jωC_s − m_d X and Re{K_rot z/(K_rot + z)} = M_j X,
    m_j m_d² X² + (m_j(C_s² − 2K m_d) − K m_d²) X + K(K M − C_s²) = 0; Im{...} = ωδ.
    """
    rotor = machine.rotor
    k, C_s, m_d, m_j = (
        rotor.shaft_stiffness,
        rotor.disk_damping,
        rotor.disk_mass,
        rotor.journal_mass,
    )
    surplus = C_s**2 - k * rotor.half_mass
    assume(abs(surplus) > 1e-3 * C_s**2)
    onset = onset_speed(machine)
    if surplus < 0:
        assert onset.speed == 0.0
        return
    a, b = m_j * m_d**2, m_j * (C_s**2 - 2 * k * m_d) - k * m_d**2
    root = math.sqrt(b**2 + 4 * a * k * surplus)
    X = 2 * k * surplus / (b + root) if b > 0 else (root - b) / (2 * a)
    z = 1j * math.sqrt(X) * C_s - m_d * X
    delta = (k * z / (k + z)).imag / math.sqrt(X)
    C = float(equilibrium(machine, 1.0).damping[0, 0])
    error = 1e-9 * rotor.half_mass * k / surplus + 1e-9
    assert onset.whirl_frequency == pytest.approx(math.sqrt(X), rel=error)
    assert onset.speed == pytest.approx(2 * math.sqrt(X) * (1 + delta / C), rel=error)


@pytest.mark.parametrize("rotor", [{}, {"journal_mass": 5.0}, {"shaft_stiffness": math.inf}])
def test_onset_vanishes_with_the_load_as_its_root(rotor):
    """p_s² → 24/π: Ω_s² = 24/π·F_o/(CM), a shaft that bends no longer counts."""
    machine = with_rotor(**rotor)
    for load in (1e-2, 1e-4):
        expected = math.sqrt(24 / math.pi * load / (60e-6 * machine.rotor.half_mass))
        # K_eq/K_rot = 1.9·1e-2/60e-6/1e8 = 3e-6, and ε² is less.
        found = onset_speed(replace(machine, load=load)).speed
        assert found == pytest.approx(expected, rel=1e-5)


def test_onset_of_the_sheets_rotors_in_rpm():
    """To the digits that DESIGN prints; tests/literature has the rest of the sheet."""
    assert onset_speed(SHEET).speed / RPM == pytest.approx(8919.3, abs=0.05)
    assert onset_speed(SHEET, flexible=False).speed / RPM == pytest.approx(10651.9, abs=0.05)


@pytest.mark.parametrize("load", [1e300, 1e-300])
def test_a_load_beyond_floating_point_is_refused_in_words(load):
    machine = replace(SHEET, load=load)
    for asked in (onset_speed, lambda m: unstable_ranges(m, np.array([10.0, 1000.0]))):
        with pytest.raises(ValueError, match="static load = 1e"):
            asked(machine)


def test_eigenvalues_beyond_sixty_digits_are_refused_in_words():
    sweep = analyse(replace(SHEET, load=1e30), 600.0)
    with pytest.raises(ValueError, match=r"static load = 1e\+30 N"):
        sweep.flexible_eigenvalues  # noqa: B018 - computed on first use


def test_an_onset_where_a_second_pair_of_roots_follows_the_first_at_once():
    """Rounding of the polynomial there hides in which order they cross the axis."""
    machine = Machine(
        oil=Oil(
            reference_viscosity=0.9406279229216675,
            reference_temperature=150.0,
            temperature_coefficient=0.06289446736405928,
        ),
        bearing=JournalBearing(
            diameter=0.019440564576405736,
            length=0.5328234976185604,
            radial_clearance=4.4246814833480985e-05,
        ),
        rotor=Rotor(
            mass=1e5,
            shaft_stiffness=1423480.190828669,
            disk_damping=2.8827132132078632,
            journal_mass=4e4,
        ),
        temperature=4.929691390822444,
        load=24105.655105507532,
    )
    onset = onset_speed(machine)
    assert onset.whirl_frequency / onset.speed == pytest.approx(0.5, rel=1e-6)  # σ ≫ 1
    below, above = onset.speed * np.array([1 - 1e-5, 1 + 1e-5])
    assert np.max(analyse(machine, below).flexible_eigenvalues.real) < 0.0
    assert np.max(analyse(machine, above).flexible_eigenvalues.real) > 0.0


def test_a_journal_that_is_driven_off_without_whirl_has_an_onset_of_frequency_zero(monkeypatch):
    # On a pad far behind the load, with nothing but oil beside it, a real root crosses: the
    # determinant keeps its sign there. A bore, which ends at its circle, refuses such a pad.
    monkeypatch.setattr(finite_table, "resting", lambda *states: np.full(len(states[-1]), True))
    # No other test has this length: the table is kept.
    geometry = PartialArc(centre=math.radians(-60.0))
    bearing = replace(SHEET.bearing, length=0.0501, geometry=geometry)
    machine = replace(SHEET, bearing=bearing)
    found = onset_speed(machine)
    assert found.whirl_frequency == 0.0
    below, above = (
        analyse(machine, share * found.speed).flexible_eigenvalues for share in (0.999, 1.001)
    )
    assert below.real.max() < 0.0 < above.real.max()
    assert above[np.argmax(above.real)].imag == 0.0
