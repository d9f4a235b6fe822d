"""The short bearing's film: closed forms against differences, quadrature and limits."""

import math
from contextlib import nullcontext

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from rotorcalc import JournalBearing
from rotorcalc.films import OperatingPoints, film_coefficients, film_of, film_state, short
from rotorcalc.films.short import static
from rotorcalc.frames import rotate
from rotorcalc.onset.whirl import whirl_onset
from tests.machines import EPS

ECCENTRICITIES = np.linspace(0.05, 0.95, 19)
BEARING = JournalBearing(diameter=0.1, length=0.05, radial_clearance=1e-4)

# Gauss and Legendre's rule over half a turn. A film at ε has its nearest pole arcosh(1/ε) off the
# real angles; at 0.95 the rule's error is below 1.2^(−2·200) = 1e-31 of the integral.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(200)
HALF_TURN, HALF_TURN_WEIGHTS = (NODES + 1.0) * np.pi / 2.0, WEIGHTS * np.pi / 2.0

# Central difference of order 8, whose error is h⁸f⁽⁹⁾/630. The force changes over 1−ε as the wall
# comes near and over ε as the half that carries turns with the velocity; with h = 0.005 of the
# less, and a force that grows as (1−ε)⁻³, the error is 1e-14 of the largest coefficient. Rounding
# of the force, some 10 EPS of it over h, is 5e-13.
STENCIL = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
DIFFERENCE_ERROR = 2e-12


def step(eps):
    return 0.005 * min(eps, 1 - eps)


# Numbers so small that they have lost digits are no test of the last ones.
eccentricities = st.floats(0.0, 0.95, allow_subnormal=False)
directions = st.floats(-np.pi, np.pi, allow_subnormal=False)
velocities = st.floats(-5, 5).map(lambda v: v if abs(v) > 1e-150 else 0.0)


def minus_derivatives(force, size):
    """Return −∂F_i/∂x_j at x = 0, (2, 2), from a function of a displacement."""
    columns = []
    for unit in np.eye(2):
        slope = sum(
            w * (force(n * size * unit) - force(-n * size * unit)) for n, w in STENCIL.items()
        )
        columns.append(-slope / size)
    return np.stack(columns, axis=-1)


def half_turn(values):
    """Return the integral over 0 ≤ θ ≤ π of values at the nodes."""
    return float(np.sum(HALF_TURN_WEIGHTS * values))


def polar(radius, angle):
    return np.array([radius * math.cos(angle), radius * math.sin(angle)])


# Nonlinear force


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_stiffness_is_minus_the_derivative_of_the_force_by_position(eps):
    still = np.zeros(2)
    for here, closed in (
        (polar(eps, short.attitude_angle(eps)), short.film_stiffness(eps)),  # X, Y
        (polar(eps, 0.0), short.radial_stiffness(eps)),  # r, t
    ):
        found = minus_derivatives(lambda d, here=here: short.film_force(here + d, still), step(eps))
        assert found == pytest.approx(closed, abs=DIFFERENCE_ERROR * np.max(np.abs(closed)))


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_damping_is_minus_the_derivative_of_the_force_by_velocity(eps):
    for here, closed in (
        (polar(eps, short.attitude_angle(eps)), short.film_damping(eps)),  # X, Y
        (polar(eps, 0.0), short.radial_damping(eps)),  # r, t
    ):
        found = minus_derivatives(lambda v, here=here: short.film_force(here, v), step(eps))
        assert found == pytest.approx(closed, abs=DIFFERENCE_ERROR * np.max(np.abs(closed)))


@given(eccentricities, directions, velocities, velocities)
@example(0.95, 0.0, -5.0, 0.0)
@example(0.95, 0.0, 5.0, 0.0)
def test_force_is_the_integral_of_the_positive_pressure(radius, angle, dx, dy):
    """Reynolds' equation integrated along z, F = −∫ max(P, 0) n dΘ, n = (cos Θ, sin Θ).

    With H = 1 − x cos Θ − y sin Θ the pressure's mean along z is P = −(∂H/∂τ + ½ ∂H/∂Θ)/H³ in
    μΩ(L/C)², positive over the half turn about the direction (A, B).
    """
    x, y = polar(radius, angle)
    A, B = dx + y / 2, dy - x / 2
    turn = math.atan2(B, A) - np.pi / 2 + HALF_TURN
    H = 1 - x * np.cos(turn) - y * np.sin(turn)
    dH = -dx * np.cos(turn) - dy * np.sin(turn)
    slope = x * np.sin(turn) - y * np.cos(turn)
    P = -(dH + slope / 2) / H**3
    quadrature = [-half_turn(P * np.cos(turn)), -half_turn(P * np.sin(turn))]
    # Where the journal leaves the wall the closed form is a small difference over κ⁴.
    rounding = 20 * EPS * math.hypot(A, B) / (1 - radius**2) ** 2
    size = half_turn(np.abs(P))
    assert short.film_force([x, y], [dx, dy]) == pytest.approx(
        quadrature, abs=rounding + 1e-13 * size
    )


@given(eccentricities, directions, directions, st.floats(0, 5), directions)
def test_the_force_rotates_with_position_and_velocity(radius, angle, heading, pace, turn):
    force = short.film_force(polar(radius, angle), polar(pace, heading))
    turned = short.film_force(polar(radius, angle + turn), polar(pace, heading + turn))
    cos, sin = math.cos(turn), math.sin(turn)
    # The angles round to 4 EPS, and the force changes over 1 − ε.
    error = 64 * EPS * (pace + 1) / (1 - radius) ** 4
    assert turned == pytest.approx(
        [cos * force[0] - sin * force[1], sin * force[0] + cos * force[1]], abs=error
    )


@given(eccentricities, directions, st.floats(0.01, 5), directions, st.integers(-30, 30))
def test_force_is_proportional_to_the_velocity_relative_to_half_speed_whirl(
    radius, angle, pace, heading, power
):
    (x, y), relative = polar(radius, angle), polar(pace, heading)
    whirl = np.array([-y / 2, x / 2])
    force = short.film_force([x, y], whirl + relative)
    scaled = short.film_force([x, y], whirl + 2.0**power * relative)
    error = 64 * EPS * (2.0**power * pace + 1) / (1 - radius) ** 3.5
    assert scaled == pytest.approx(2.0**power * force, abs=error * max(1.0, 2.0**power))


@given(eccentricities, directions, st.floats(0.01, 5), directions)
def test_the_film_never_gives_energy_to_the_motion_relative_to_half_speed_whirl(
    radius, angle, pace, heading
):
    (x, y), relative = polar(radius, angle), polar(pace, heading)
    force = short.film_force([x, y], relative + np.array([-y / 2, x / 2]))
    assert force @ relative < 0.0


@given(eccentricities, directions)
def test_half_speed_whirl_about_the_centre_has_no_force(radius, angle):
    x, y = polar(radius, angle)
    assert np.array_equal(short.film_force([x, y], [-y / 2, x / 2]), [0.0, 0.0])


def test_force_at_rest_balances_the_load_along_x():
    eps = ECCENTRICITIES
    phi, load = short.attitude_angle(eps), 0.25 / short.modified_sommerfeld(eps)
    position = np.stack([eps * np.cos(phi), eps * np.sin(phi)], axis=-1)
    force = short.film_force(position, np.zeros((19, 2)))
    assert force[:, 0] == pytest.approx(-load, rel=64 * EPS)
    assert force[:, 1] == pytest.approx(np.zeros(19), abs=64 * EPS * float(load.max()))


def test_static_force_is_the_force_at_rest_on_the_line_of_centres():
    position = np.stack([ECCENTRICITIES, np.zeros(19)], axis=-1)
    at_rest = short.film_force(position, np.zeros((19, 2)))
    assert short.static_force(ECCENTRICITIES) == pytest.approx(at_rest, rel=32 * EPS)


@pytest.mark.parametrize("position", [[1.0, 0.0], [0.8, -0.7], [math.nan, 0.0], [math.inf, 0.0]])
def test_a_journal_outside_the_clearance_circle_is_refused(position):
    with pytest.raises(ValueError, match=r"position: must lie inside the clearance circle"):
        short.film_force(position, [0.0, 0.0])


@pytest.mark.parametrize("velocity", [[math.nan, 0.0], [0.0, math.inf], [-math.inf, math.inf]])
def test_a_velocity_that_is_not_finite_is_refused(velocity):
    with pytest.raises(ValueError, match=r"velocity: must be finite"):
        short.film_force([0.5, 0.0], velocity)


def test_force_broadcasts():
    position = np.broadcast_to([0.3, 0.1], (4, 1, 2))
    velocity = np.broadcast_to([0.2, -0.4], (5, 2))
    force = short.film_force(position, velocity)
    assert force.shape == (4, 5, 2)
    assert np.all(force == short.film_force([0.3, 0.1], [0.2, -0.4]))


# Coefficients


def test_corrected_closed_form_is_the_rotated_radial_one():
    """Eq. 5.35, with k_YY and c_YY corrected, = Eqs. 5.30 and 5.31 turned by Eq. 5.16."""
    eps = np.linspace(0.0, 0.999, 500)
    phi = short.attitude_angle(eps)
    for fixed, radial in (
        (short.film_stiffness(eps), short.radial_stiffness(eps)),
        (short.film_damping(eps), short.radial_damping(eps)),
    ):
        error = np.abs(fixed - rotate(radial, phi)).max(axis=(-1, -2))
        assert np.all(error <= 32 * EPS * np.abs(radial).max(axis=(-1, -2)))


def test_traces_are_the_same_in_both_frames():
    eps = np.linspace(0.0, 0.999, 500)
    for fixed, radial in (
        (short.film_stiffness(eps), short.radial_stiffness(eps)),
        (short.film_damping(eps), short.radial_damping(eps)),
    ):
        assert np.trace(fixed, axis1=-2, axis2=-1) == pytest.approx(
            np.trace(radial, axis1=-2, axis2=-1), rel=32 * EPS
        )


def test_damping_is_symmetric_and_dissipates_energy():
    eps = np.linspace(0.0, 0.999, 500)
    C = short.film_damping(eps)
    assert np.array_equal(C[:, 0, 1], C[:, 1, 0])
    assert np.all(C[:, 0, 0] > 0)
    assert np.all(np.linalg.det(C) > 0)


def test_units_of_the_load_are_units_of_the_film_over_the_load():
    """F_o = μΩRL³/(4σC²), so k = 4σ·K and c = 4σ·C of the film's units (Eq. 5.32)."""
    eps = ECCENTRICITIES
    unit = 4 * short.modified_sommerfeld(eps)[:, None, None]
    assert short.stiffness(eps) == pytest.approx(unit * short.film_stiffness(eps), rel=32 * EPS)
    assert short.damping(eps) == pytest.approx(unit * short.film_damping(eps), rel=32 * EPS)


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_radial_coefficients_are_the_journal_bearing_integrals(eps):
    """Eq. 5.29 with J_i^{kj} by quadrature = Eqs. 5.30 and 5.31."""
    sin, cos, H = np.sin(HALF_TURN), np.cos(HALF_TURN), 1 + eps * np.cos(HALF_TURN)

    def J(i, k, j):
        return half_turn(sin**k * cos**j / H**i)

    stiffness = [
        [(-J(3, 1, 1) + 3 * eps * J(4, 1, 2)) / 2, (J(3, 0, 2) + 3 * eps * J(4, 2, 1)) / 2],
        [(-J(3, 2, 0) + 3 * eps * J(4, 2, 1)) / 2, (J(3, 1, 1) + 3 * eps * J(4, 3, 0)) / 2],
    ]
    damping = [[J(3, 0, 2), J(3, 1, 1)], [J(3, 1, 1), J(3, 2, 0)]]
    # Sums of 200 terms, the largest 1/(1−ε)⁴.
    error = 200 * EPS * (1 - eps) ** -4
    assert short.radial_stiffness(eps) == pytest.approx(np.array(stiffness), abs=error)
    assert short.radial_damping(eps) == pytest.approx(np.array(damping), abs=error)


def centred_limits(eps):
    """Return what tends to a constant as ε → 0, each beside its limit (DESIGN, Eqs. 5.36, 5.48)."""
    k, c = short.stiffness(eps), short.damping(eps)
    onset, added = whirl_onset(k, c), short.added_mass(eps)
    return {
        "k_XX": (k[0, 0], 4 / np.pi),
        "k_YY": (k[1, 1], 8 / np.pi),
        "k_XY": (eps * k[0, 1], 1),
        "k_YX": (eps * k[1, 0], -1),
        "c_XX": (eps * c[0, 0], 2),
        "c_YY": (eps * c[1, 1], 2),
        "c_XY": (c[0, 1], 8 / np.pi),
        "k_eq": (onset.equivalent_stiffness, 6 / np.pi),
        "whirl ratio": (onset.whirl_ratio, 0.5),
        "p_s²": (onset.critical_mass, 24 / np.pi),
        "I_XX": (added[0, 0], np.pi / 2),
        "I_YY": (added[1, 1], np.pi / 2),
        "K_XY/C_XX": (short.film_stiffness(eps)[0, 1] / short.film_damping(eps)[0, 0], 0.5),
        "σ": (eps * short.modified_sommerfeld(eps), 1 / np.pi),
        "attitude": ((np.pi / 2 - short.attitude_angle(eps)) / eps, 4 / np.pi),
    }


@pytest.mark.parametrize("name", centred_limits(0.01))
def test_centred_limits_are_approached_as_the_square_of_eccentricity(name):
    """All are even in ε: the distance to the limit is aε² + bε⁴, so that of ε/2 is a quarter."""
    (far, limit), (near, _) = centred_limits(0.02)[name], centred_limits(0.01)[name]
    assert near == pytest.approx(limit, rel=2e-3)
    assert (far - limit) / (near - limit) == pytest.approx(4, rel=20 * 0.02**2)


def test_centred_film_has_its_limits_without_dividing_by_zero():
    k, c = short.stiffness(0.0), short.damping(0.0)
    assert k == pytest.approx(np.array([[4 / np.pi, np.inf], [-np.inf, 8 / np.pi]]), rel=4 * EPS)
    assert c == pytest.approx(np.array([[np.inf, 8 / np.pi], [8 / np.pi, np.inf]]), rel=4 * EPS)
    quarter = np.pi / 4
    assert np.array_equal(short.film_stiffness(0.0), [[0, quarter], [-quarter, 0]])  # Eq. 5.37
    assert np.array_equal(short.film_damping(0.0), [[np.pi / 2, 0], [0, np.pi / 2]])
    assert short.added_mass(0.0) == pytest.approx(np.pi / 2 * np.eye(2), abs=4 * EPS)
    assert short.attitude_angle(0.0) == np.pi / 2
    assert short.attitude_angle(1.0) == 0.0


# Pressure, flow, drag, added mass


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_pressure_integrates_to_the_static_force(eps):
    """Eq. 5.26, the parabola along z by a rule that is exact for it."""
    zeta, weights = np.polynomial.legendre.leggauss(3)
    p = short.pressure(eps, HALF_TURN[:, None], zeta / 2) @ (weights / 2)
    radial, tangential = half_turn(p * np.cos(HALF_TURN)), half_turn(p * np.sin(HALF_TURN))
    error = 200 * EPS * (1 - eps) ** -3
    assert short.static_force(eps) == pytest.approx([radial, tangential], abs=error)


def test_pressure_vanishes_at_the_ends_and_in_the_cavitated_half():
    theta = np.linspace(0, 2 * np.pi, 73)
    assert np.all(short.pressure(0.6, theta, 0.5) == 0)
    assert np.all(short.pressure(0.6, theta, -0.5) == 0)
    assert np.all(short.pressure(0.6, theta[37:-1]) == 0)
    assert np.all(short.pressure(0.6, theta[1:36]) > 0)


def test_pressure_is_a_parabola_along_z_and_even():
    zeta = np.linspace(-0.5, 0.5, 11)
    p = short.pressure(0.6, 2.0, zeta)
    assert p == pytest.approx(p[::-1], rel=4 * EPS)
    assert p == pytest.approx(short.pressure(0.6, 2.0) * (1 - 4 * zeta**2), abs=4 * EPS)


def test_peak_pressure_is_the_largest_and_lies_where_the_slope_vanishes():
    theta = np.linspace(0, np.pi, 20001)
    for eps in ECCENTRICITIES:
        over_theta, peak = short.pressure(eps, theta), float(short.peak_pressure(eps))
        place = float(short.peak_position(eps))
        assert np.max(over_theta) <= peak * (1 + 8 * EPS)
        # The grid misses the top by at most half its step: p''/p is below 30/(1−ε)² there.
        assert np.max(over_theta) >= peak * (1 - 15 / (1 - eps) ** 2 * (theta[1] / 2) ** 2)
        slope = (1 + eps * math.cos(place)) * math.cos(place) + 3 * eps * math.sin(place) ** 2
        assert slope == pytest.approx(0.0, abs=32 * EPS)


@pytest.mark.parametrize("zeta", [0.6, -0.51, math.nan])
def test_pressure_outside_the_bearing_is_refused(zeta):
    with pytest.raises(ValueError, match="zeta"):
        short.pressure(0.5, 1.0, zeta)


def test_film_thickness_is_one_plus_eps_cos_theta():
    assert short.film_thickness(0.25, [0.0, np.pi / 2, np.pi]) == pytest.approx([1.25, 1, 0.75])


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_side_flow_is_what_the_pressure_drives_out_at_both_ends(eps):
    """−h³/(12μ) ∂p/∂z at z = ±L/2: H³·4p(0)/12 an end in ΩRLC, for the profile is a parabola."""
    H = short.film_thickness(eps, HALF_TURN)
    an_end = half_turn(H**3 * 4 * short.pressure(eps, HALF_TURN)) / 12
    assert short.side_flow(eps) == pytest.approx(2 * an_end, rel=200 * EPS)


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_side_flow_is_what_the_converging_film_loses(eps):
    """½ΩRL·C·H enters at θ = 0, where the film is thickest, and leaves at π."""
    H = short.film_thickness(eps, [0.0, np.pi])
    assert short.side_flow(eps) == pytest.approx((H[0] - H[1]) / 2, rel=16 * EPS)


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_drag_power_is_all_that_the_film_dissipates(eps):
    """Couette flow dissipates μ(ΩR)²/h over the whole turn, axial Poiseuille h³/(12μ)(∂p/∂z)².

    In μΩ²R³L/C: ∫dθ/H, and (L/R)²/12 ∫∫H³(∂p/∂ζ)² with ∂p/∂ζ = −8ζp(0), ∫ζ²dζ = 1/12.
    """
    ratio = 0.7
    turn = np.concatenate([HALF_TURN, HALF_TURN + np.pi])
    H = short.film_thickness(eps, turn)
    couette = float(np.sum(np.tile(HALF_TURN_WEIGHTS, 2) / H))
    carrying = short.film_thickness(eps, HALF_TURN)
    poiseuille = half_turn(carrying**3 * 64 * short.pressure(eps, HALF_TURN) ** 2) / 12
    dissipated = couette + ratio**2 / 12 * poiseuille
    assert short.drag(eps, length_to_radius=ratio) == pytest.approx(dissipated, rel=400 * EPS)


@pytest.mark.parametrize("eps", [0.001, 0.02, 0.0999, 0.1001, *ECCENTRICITIES])
def test_added_mass_is_the_integral_of_temporal_inertia(eps):
    """∂²p/∂z² = ρ(∂²h/∂t²)/h along z leaves I_ij = ∫ n_i n_j/H dθ over the film that carries."""
    sin, cos, H = np.sin(HALF_TURN), np.cos(HALF_TURN), 1 + eps * np.cos(HALF_TURN)
    cross = half_turn(sin * cos / H)
    radial = [[half_turn(cos**2 / H), cross], [cross, half_turn(sin**2 / H)]]
    fixed = rotate(radial, short.attitude_angle(eps))
    # The closed cross term is a difference of 2/ε and its like: EPS/ε² where it takes over, 0.1.
    assert short.added_mass(eps) == pytest.approx(fixed, abs=100 * EPS * max(1, (1 - eps) ** -1))


# Sommerfeld number and its inverse


def test_sommerfeld_number_falls_steadily_with_eccentricity():
    eps = np.concatenate([np.geomspace(1e-12, 0.5, 4000), 1 - np.geomspace(0.5, 1e-12, 4000)[1:]])
    assert np.all(np.diff(short.modified_sommerfeld(eps)) < 0)


def test_sommerfeld_number_carries_the_load_of_the_static_force():
    f = np.linalg.norm(short.static_force(ECCENTRICITIES), axis=-1)
    assert short.modified_sommerfeld(ECCENTRICITIES) == pytest.approx(0.25 / f, rel=16 * EPS)


def test_inverse_returns_the_sommerfeld_number_over_arrays():
    sigma = np.geomspace(1e-6, 1e6, 20001)
    back = short.modified_sommerfeld(short.eccentricity_ratio(sigma))
    assert np.max(np.abs(back / sigma - 1)) <= 1e-12


@given(st.floats(-6, 6))
def test_inverse_returns_the_sommerfeld_number_of_a_scalar(power):
    sigma = 10.0**power
    eps = short.eccentricity_ratio(sigma)
    assert np.shape(eps) == ()
    assert short.modified_sommerfeld(eps) == pytest.approx(sigma, rel=1e-12)


@given(st.floats(0.0, 0.9999, allow_subnormal=False))
def test_inverse_returns_the_eccentricity(eps):
    # The search is for ln(ε/s), which rounds to EPS of itself.
    rounding = 16 * EPS * (1 - math.log(max(eps, 1e-308)))
    assert short.eccentricity_ratio(short.modified_sommerfeld(eps)) == pytest.approx(
        eps, rel=rounding, abs=1e-308
    )


@pytest.mark.parametrize(("steps", "found"), [(0, False), (1, True)])
def test_one_step_finds_the_eccentricity(monkeypatch, steps, found):
    """It begins so near that no other is needed; a search that has no end is an error."""
    monkeypatch.setattr(static, "_MOST_ITERATIONS", steps)
    with nullcontext() if found else pytest.raises(RuntimeError, match="no eccentricity ratio"):
        short.eccentricity_ratio(np.geomspace(1e-300, 1e300, 20001))


def test_inverse_keeps_the_shape_and_treats_each_element_alone():
    sigma = np.array([[1e-6, 0.3, 0.0], [np.inf, 1e6, 4.0]])
    eps = short.eccentricity_ratio(sigma)
    assert eps.shape == (2, 3)
    alone = [[float(short.eccentricity_ratio(s)) for s in row] for row in sigma]
    assert eps == pytest.approx(np.array(alone), rel=2 * EPS)
    assert short.eccentricity_ratio([]).shape == (0,)


@pytest.mark.parametrize(
    ("sigma", "eps"),
    [
        (0.0, 1.0),
        (1e-300, 1.0),
        (5e-324, 1.0),
        (math.inf, 0.0),
        (1e300, 1 / (math.pi * 1e300)),  # ε → 1/(πσ)
        (1e160, 1 / (math.pi * 1e160)),
    ],
)
def test_inverse_at_the_ends_of_the_number_range(sigma, eps):
    assert float(short.eccentricity_ratio(sigma)) == pytest.approx(eps, rel=1e-12, abs=0)


@pytest.mark.parametrize("bad", [-1.0, -math.inf, math.nan, [1.0, -2.0], "1", None, True, 1j])
def test_an_invalid_sommerfeld_number_is_refused(bad):
    with pytest.raises(ValueError, match="sigma"):
        short.eccentricity_ratio(bad)


OF_ECCENTRICITY = {
    "modified_sommerfeld": (short.modified_sommerfeld, ()),
    "attitude_angle": (short.attitude_angle, ()),
    "side_flow": (short.side_flow, ()),
    "peak_position": (short.peak_position, ()),
    "film_thickness": (lambda eps: short.film_thickness(eps, 1.0), ()),
    "peak_pressure": (short.peak_pressure, ()),
    "pressure": (lambda eps: short.pressure(eps, 1.0), ()),
    "drag": (lambda eps: short.drag(eps, length_to_radius=0.5), ()),
    "static_force": (short.static_force, (2,)),
    "stiffness": (short.stiffness, (2, 2)),
    "damping": (short.damping, (2, 2)),
    "film_stiffness": (short.film_stiffness, (2, 2)),
    "film_damping": (short.film_damping, (2, 2)),
    "radial_stiffness": (short.radial_stiffness, (2, 2)),
    "radial_damping": (short.radial_damping, (2, 2)),
    "added_mass": (short.added_mass, (2, 2)),
}
TO_THE_WALL = list(OF_ECCENTRICITY)[:5]


@pytest.mark.parametrize("name", OF_ECCENTRICITY)
@pytest.mark.parametrize("bad", [-0.1, 1.1, math.nan, math.inf, [0.5, 2.0], "0.5", None, 0.5j])
def test_an_eccentricity_outside_its_range_is_refused(name, bad):
    function, _ = OF_ECCENTRICITY[name]
    with pytest.raises(ValueError, match="eps"):
        function(bad)


@pytest.mark.parametrize("name", OF_ECCENTRICITY)
def test_at_contact_with_the_wall_forces_are_refused_and_positions_given(name):
    function, _ = OF_ECCENTRICITY[name]
    if name in TO_THE_WALL:
        assert np.isfinite(function(1.0))
    else:
        with pytest.raises(ValueError, match="eps = 1"):
            function(1.0)


@pytest.mark.parametrize("name", OF_ECCENTRICITY)
@pytest.mark.parametrize("shape", [(), (3,), (2, 3), (0,)])
def test_leading_axes_are_sweeps(name, shape):
    function, trailing = OF_ECCENTRICITY[name]
    values = function(np.full(shape, 0.4))
    assert np.shape(values) == shape + trailing
    assert np.all(values == function(0.4))


# The state that the seam hands on


@given(st.floats(-6, 6))
def test_state_agrees_with_the_functions_of_eccentricity(power):
    sigma = 10.0**power
    film, eps = film_state(BEARING, sigma), short.eccentricity_ratio(sigma)
    assert film.eccentricity_ratio == pytest.approx(eps, rel=4 * EPS)
    assert film.attitude_angle == pytest.approx(short.attitude_angle(eps), rel=4 * EPS)
    assert film.position == pytest.approx(polar(eps, short.attitude_angle(eps)), rel=4 * EPS)
    # σ and ε agree to 1e-12, and k follows ε as its distance from the wall.
    assert film.k == pytest.approx(short.stiffness(eps), rel=1e-12)
    assert film.c == pytest.approx(short.damping(eps), rel=1e-12)
    assert film.minimum_thickness == 1 - eps
    assert film.side_flow == eps
    assert film.drag == short.drag(eps, length_to_radius=1.0)
    assert film.peak_pressure == short.peak_pressure(eps)


@given(st.floats(-4, 4))
def test_the_states_force_carries_the_load(power):
    film = film_state(BEARING, 10.0**power)
    unit = short.static_force(film.eccentricity_ratio)
    assert film.force == pytest.approx(unit, rel=1e-11)  # ε to 1e-14 of 1, the wall at 1e-2


@given(st.floats(-2, 3))
def test_pressure_around_the_bearing_balances_the_load(power):
    """F = −∫∫ p n dΘ dζ in X and Y: the journal is pushed from where the pressure is."""
    sigma = 10.0**power
    assume(short.eccentricity_ratio(sigma) <= 0.95)
    opposite = film_state(BEARING, sigma).attitude_angle + np.pi
    turn = opposite + HALF_TURN
    zeta, weights = np.polynomial.legendre.leggauss(3)
    p = (
        film_of(BEARING)
        .field(OperatingPoints.at_sommerfeld(BEARING, sigma), angle=turn[:, None], zeta=zeta / 2)
        .pressure
        @ weights
        / 2
    )
    load = 0.25 / sigma
    size = half_turn(p)
    assert -half_turn(p * np.cos(turn)) == pytest.approx(-load, abs=1e-12 * size)
    assert -half_turn(p * np.sin(turn)) == pytest.approx(0.0, abs=1e-12 * size)


def test_an_unloaded_film_is_centred():
    film = film_state(BEARING, np.inf)
    assert np.array_equal(film.position, [0.0, 0.0])
    assert film.attitude_angle == np.pi / 2
    assert film.minimum_thickness == 1
    assert film.side_flow == 0
    assert film.drag == 2 * np.pi
    assert np.array_equal(film.stiffness, short.film_stiffness(0.0))
    assert np.array_equal(film.damping, short.film_damping(0.0))


@pytest.mark.parametrize("sigma", [0.0, -1.0, math.nan, [1.0, 0.0]])
def test_sommerfeld_numbers_must_be_positive(sigma):
    with pytest.raises(ValueError, match=r"sommerfeld = .*: must be positive"):
        film_state(BEARING, sigma)


@pytest.mark.parametrize("sigma", [1e-40, [1.0, 1e-40]])
def test_a_film_thinner_than_the_arithmetic_is_refused(sigma):
    with pytest.raises(ValueError, match=r"sommerfeld = .*too small"):
        film_state(BEARING, sigma)
    with pytest.raises(ValueError, match=r"sommerfeld = .*too small"):
        film_coefficients(BEARING, sigma)


@pytest.mark.parametrize(
    ("position", "velocity", "message"),
    [
        ([1, 2, 3], [1, 2], r"position: must have the shape \(\.\.\., 2\), has \(3,\)"),
        (0.1, [1, 2], r"position: must have the shape"),
        ([0.1, 0.2], 0.2, r"velocity: must have the shape"),
        (np.zeros((2, 2)), np.zeros((3, 2)), r"velocity: has the leading shape \(3,\)"),
    ],
)
def test_positions_and_velocities_of_a_wrong_shape_are_refused(position, velocity, message):
    with pytest.raises(ValueError, match=message):
        short.film_force(position, velocity)
