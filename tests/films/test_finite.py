"""The finite film: a second program, derivatives of the force, limits, identities, the table."""

import functools
import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import (
    AxialGrooves,
    Elliptical,
    JournalBearing,
    Lobes,
    Machine,
    MultiDam,
    OffsetHalves,
    PartialArc,
    Plain,
    PressureDam,
    whirl_onset,
)
from rotorcalc.films import film_of, film_state
from rotorcalc.films.finite.equilibrium import settled
from rotorcalc.films.finite.fronts import coefficients
from rotorcalc.films.finite.results import drag, side_flow
from rotorcalc.films.finite.reynolds import films, mesh, solved
from rotorcalc.films.finite.sweeps import settled_pressures
from rotorcalc.films.finite.table import table
from rotorcalc.films.pads import Pad, gap, pads_of
from rotorcalc.films.state import OperatingPoints
from rotorcalc.geometry import Geometry
from rotorcalc.validation.finite import SECOND_PROGRAM
from tests.films import plain_program

DEGREE = math.pi / 180
# Every bore, and some that are loaded otherwise.
BORES = {
    "plain": Plain(),
    "partial arc": PartialArc(),
    "two grooves": AxialGrooves(),
    "four grooves": AxialGrooves(number=4, width=15 * DEGREE),
    "elliptical": Elliptical(),
    "offset halves": OffsetHalves(),
    "three lobes": Lobes(),
    "three lobes, between": Lobes(load="between pads"),
    "four lobes": Lobes(number=4, arc=70 * DEGREE, load="between pads"),
    "tapered lands": Lobes(offset=1.0),
    "pressure dam": PressureDam(),
    "relief track": PressureDam(track_ratio=0.25, preload=0.2),
    "multi dam": MultiDam(),
}
ALL = pytest.mark.parametrize("name", BORES)
DAMS = ("pressure dam", "relief track", "multi dam")


def on(geometry, ratio):
    return JournalBearing(
        diameter=0.1, length=0.1 * ratio, radial_clearance=1e-4, geometry=geometry, film="finite"
    )


def error(found, expected):
    """Return the largest difference over the largest entry."""
    return np.abs(found - expected).max() / np.abs(expected).max()


def converged(bearing, sigma, links, degrees):
    """Return position, stiffness and damping of one state on a mesh of its own, in film units."""
    made = film_of(bearing)._table
    slenderness = made.mesh.slenderness
    grid = mesh(made.mesh.pads, slenderness, links, degrees)
    wet = np.ones((1, *grid.shape), dtype=bool)
    load = np.array([1.0 / (sigma * slenderness)])
    found = settled(grid, load, film_state(bearing, sigma).position[None], wet, steps=80)
    assert found.good.all()
    over = films(grid, found.position)
    K, C = coefficients(over, settled_pressures(over, found.wet))
    return found.position[0], K[0] * slenderness / 4, C[0] * slenderness / 4


# Confirmed by a program other than the two here. k and c in units of the load, C of a pad.
@pytest.mark.parametrize("row", SECOND_PROGRAM, ids=lambda row: row.geometry.kind)
def test_states_that_were_computed_elsewhere(row):
    geometry, ratio, sigma, (eps, phi), k, c = row
    film = film_state(on(geometry, ratio), sigma)
    x, y = eps * math.cos(phi * DEGREE), eps * math.sin(phi * DEGREE)
    assert film.position == pytest.approx([x, y], abs=5e-4)
    assert error(film.k.ravel(), np.array(k)) < 5e-3
    assert error(film.c[[0, 0, 1], [0, 1, 1]], np.array(c)) < 5e-3


def test_a_pressure_dam_that_was_computed_elsewhere():
    film = film_state(on(PressureDam(pocket_arc=120 * DEGREE), 1.0), 0.5)
    assert film.position == pytest.approx([0.404, 0.416], abs=2e-3)
    assert error(film.k.ravel(), np.array([3.15, 3.91, -0.40, 1.78])) < 0.015
    assert error(film.c[[0, 0, 1], [0, 1, 1]], np.array([7.68, 2.15, 2.04])) < 0.015


def plain_pads(bearing):
    return [
        (p.start, p.end, p.a_x, p.a_y, *((p.step, p.depth, p.axial_ratio) if p.depth else ()))
        for p in pads_of(bearing)
    ]


@pytest.mark.parametrize(
    ("name", "ratio", "sigma"),
    [
        ("elliptical", 0.5, 0.5),
        ("three lobes, between", 1.0, 0.3),
        ("four grooves", 1.0, 1.0),
        ("offset halves", 0.5, 0.2),
        ("partial arc", 1.0, 0.2),
        ("pressure dam", 1.0, 1.0),
        ("multi dam", 1.0, 1.0),
    ],
)
def test_a_second_program_finds_the_same(name, ratio, sigma):
    bearing = on(BORES[name], ratio)
    film = film_state(bearing, sigma)
    pads, unit = plain_pads(bearing), 4 * ratio**2
    # Edges of pockets lie on lines of the grid.
    grid = (150, 20) if name == "multi dam" else (160, 24)
    F = plain_program.force(pads, ratio, film.position, grid=grid) / unit
    assert pytest.approx([-0.25 / sigma, 0.0], abs=0.01 * 0.25 / sigma) == F
    K, C = plain_program.coefficients(pads, ratio, film.position, grid=grid)
    assert error(film.stiffness, K / unit) < 0.01
    assert error(film.damping, C / unit) < 0.01


@ALL
def test_stiffness_and_damping_are_derivatives_of_the_force(name):
    """By central differences, on a fine mesh; the fronts then fall between nodes."""
    bearing = on(BORES[name], 0.5)
    degrees = 6 if name in DAMS else 4
    grid = mesh(pads_of(bearing), 4.0, 240, degrees)
    place, step = film_state(bearing, 0.6).position, 4e-3
    moves = step * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
    still = films(grid, place + moves)
    at = settled_pressures(still, np.ones((5, *grid.shape), dtype=bool))
    K, C = coefficients(films(grid, place[None]), settled_pressures(
        films(grid, place[None]), at.wet[:1]))  # fmt: skip
    assert C[0, 0, 1] == C[0, 1, 0]
    by_place = np.stack([at.force[2] - at.force[1], at.force[4] - at.force[3]], -1) / (2 * step)
    assert error(K[0], by_place) < 0.01
    over, wet = films(grid, place + 0.0 * moves), np.repeat(at.wet[:1], 5, axis=0)
    for _ in range(60):
        moving = solved(over, wet, squeeze=moves)
        wet = moving.next_wet
    F = moving.force
    by_velocity = np.stack([F[2] - F[1], F[4] - F[3]], -1) / (2 * step)
    assert error(C[0], by_velocity) < 0.01


@functools.cache
def deviations(name, ratio):
    """Return the table's errors in place [C], K and C, (2, 3), against a finer mesh.

    In the middle between two loads of the table, light and heavy.
    """
    bearing = on(BORES[name], ratio)
    made = film_of(bearing)._table
    loads = np.sqrt(made.load[:-1] * made.load[1:])[[4, len(made.load) * 2 // 3]]
    found = []
    for sigma in 0.25 / loads:
        film = film_state(bearing, sigma)
        assert film.minimum_thickness > 0.05
        links, degrees = (160, 12) if name in DAMS else (224, 5)
        position, K, C = converged(bearing, sigma, links, degrees)
        place = np.abs(film.position - position).max()
        found.append([place, error(film.stiffness, K), error(film.damping, C)])
    return np.array(found)


RATIOS = [0.1, 0.5, 2.0]


@ALL
@pytest.mark.parametrize("ratio", RATIOS)
def test_the_table_agrees_with_a_finer_mesh(name, ratio):
    limits = [2e-3, 0.03, 0.03] if name in DAMS else [5e-4, 0.015, 0.015]
    assert np.all(deviations(name, ratio) < limits)


@ALL
def test_the_coarse_mesh_is_good_to_a_few_percent(name):
    fine = on(BORES[name], 0.5)
    coarse = replace(fine, film="coarse")
    sigma = np.geomspace(1.2 * film_of(fine)._table.least_sommerfeld, 10.0, 30)
    found, right = film_state(coarse, sigma), film_state(fine, sigma)
    for here, there in ((found.stiffness, right.stiffness), (found.damping, right.damping)):
        off = np.abs(here - there).max(axis=(1, 2)) / np.abs(there).max(axis=(1, 2))
        assert np.quantile(off, 0.9) < 0.045
    assert np.abs(found.position - right.position).max() < 5e-3
    assert film_of(coarse)._table.wet.size < 0.3 * film_of(fine)._table.wet.size
    with pytest.raises(ValueError, match="film = 'coarsest'"):
        replace(coarse, film="coarsest")


@pytest.mark.parametrize("name", ["plain", "elliptical", "three lobes", "pressure dam"])
def test_the_error_that_is_told_is_of_the_size_of_the_error(name):
    film = film_of(on(BORES[name], 0.5))
    load = film._table.load
    loads = np.sqrt(load[:-1] * load[1:])[[4, len(load) * 2 // 3]]  # as of `deviations`
    for sigma, (_, *true) in zip(0.25 / loads, deviations(name, 0.5), strict=True):
        told = film.accuracy(float(sigma))
        assert max(true) / 5 < max(told.stiffness, told.damping) < 5 * max(true)
        assert f"{film._table.mesh.links} cells" in told.mesh
    assert film.accuracy(math.inf).stiffness < 0.015  # without load


@pytest.mark.parametrize(("dams", "limit"), [(False, 0.005), (True, 0.012)])
def test_nine_states_in_ten_are_exact_to_half_a_percent_and_of_dams_to_more(dams, limit):
    names = [name for name in BORES if (name in DAMS) == dams]
    found = np.concatenate([deviations(name, ratio) for name in names for ratio in RATIOS])
    assert np.all(np.quantile(found[:, 1:], 0.9, axis=0) < limit)


@pytest.mark.parametrize("name", ["partial arc", "elliptical", "pressure dam"])
def test_errors_fall_with_the_mesh(name):
    bearing = on(BORES[name], 0.5)
    zones = 2 if name in DAMS else 1
    _, K, C = converged(bearing, 0.5, 256, 5 * zones)
    found = [converged(bearing, 0.5, links, 5 * zones) for links in (24, 96)]
    (_, rough_K, rough_C), (_, fine_K, fine_C) = found
    # A quarter of the width: a second order would leave a sixteenth.
    assert error(fine_K, K) < error(rough_K, K) / 4
    assert error(fine_C, C) < error(rough_C, C) / 4
    assert error(fine_K, K) < 4e-3


def test_a_shorter_bearing_approaches_the_short_one():
    short = film_state(JournalBearing(diameter=0.1, length=0.05, radial_clearance=1e-4), 0.5)
    errors = []
    for ratio in (0.2, 0.1, 0.05):
        film = film_state(on(Plain(), ratio), 0.5)
        errors.append([
            np.abs(film.position - short.position).max(),
            error(film.stiffness, short.stiffness),
            error(film.damping, short.damping),
        ])  # fmt: skip
    falling = np.array(errors[:-1]) / np.array(errors[1:])
    # The film's ends are changed over a length of the order of L: of first order at least.
    assert np.all(falling[0] > 1.5)
    assert np.all(np.array(errors[-1]) < [5e-3, 0.03, 0.03])


def long_force(pad, e):
    """Return the force on an arc of infinite length: q constant up to the front, where q = 6h."""
    beta = np.linspace(*pad, 200_001)
    h = 1.0 - e[0] * np.cos(beta) - e[1] * np.sin(beta)
    low, high = h.min(), h[0]
    for _ in range(60):
        front = 0.5 * (low + high)
        slope = 6.0 * (h - front) / h**3
        end = np.flatnonzero((h <= front) | (np.arange(h.size) == h.argmin()))
        # The front lies behind the thinnest film, where h has risen to that of the flow.
        behind = np.flatnonzero((np.arange(h.size) > h.argmin()) & (h >= front))
        last = behind[0] if behind.size else end[-1]
        pressure = np.trapezoid(slope[: last + 1], beta[: last + 1])
        low, high = (front, high) if pressure > 0.0 else (low, front)
    p = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(beta))])
    p[last:] = 0.0
    return -np.array([np.trapezoid(p * np.cos(beta), beta), np.trapezoid(p * np.sin(beta), beta)])


def test_a_longer_bearing_approaches_the_long_one():
    arc, e = (-80 * DEGREE, 80 * DEGREE), np.array([0.5, 0.3])
    errors = []
    for ratio in (4.0, 8.0, 16.0):
        grid = mesh((Pad(*arc),), 1.0 / ratio**2, 160, 24)
        over = films(grid, e[None])
        at = settled_pressures(over, np.ones((1, *grid.shape), dtype=bool))
        errors.append(error(at.force[0], long_force(arc, e)))
    # What is lost at the ends is a length of the order of D.
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(2.0, rel=0.1)
    assert errors[2] < 0.05


LIKE = [
    ("elliptical without preload", Elliptical(preload=0.0), AxialGrooves()),
    ("offset halves without offset", OffsetHalves(offset=0.0), AxialGrooves()),
    ("two lobes", Lobes(number=2, arc=160 * DEGREE, preload=0.3), Elliptical(preload=0.3)),
    ("one pad of a circle", PartialArc(arc=340 * DEGREE, centre=20 * DEGREE),
     AxialGrooves(number=1, first=200 * DEGREE)),
    ("a pocket without depth", PressureDam(depth=1e-12), AxialGrooves()),
]  # fmt: skip


@pytest.mark.parametrize(("one", "other"), [case[1:] for case in LIKE], ids=[c[0] for c in LIKE])
def test_bores_that_are_the_same_answer_the_same(one, other):
    sigma = np.array([0.2, 1.0, 8.0])
    a, b = film_state(on(one, 0.5), sigma), film_state(on(other, 0.5), sigma)
    assert a.position == pytest.approx(b.position, abs=5e-4)
    assert a.minimum_thickness == pytest.approx(b.minimum_thickness, abs=5e-4)
    for i in range(3):
        assert error(a.stiffness[i], b.stiffness[i]) < 0.01
        assert error(a.damping[i], b.damping[i]) < 0.01


@ALL
def test_the_field_integrates_to_the_load(name):
    bearing, sigma = on(BORES[name], 0.5), 0.5
    film, state = film_of(bearing), film_state(bearing, sigma)
    angle, zeta = np.linspace(-math.pi, math.pi, 2881), np.linspace(-0.5, 0.5, 81)
    at = OperatingPoints.at_sommerfeld(bearing, sigma)
    field = film.field(at, angle=angle[:, None], zeta=zeta)
    line = np.trapezoid(field.pressure, zeta, axis=1)
    F = -np.array([np.trapezoid(line * n(angle), angle) for n in (np.cos, np.sin)])
    assert pytest.approx([-0.5, 0.0], abs=0.006) == F
    assert field.pressure.max() == pytest.approx(float(state.peak_pressure), rel=0.03)
    assert np.all(field.pressure >= 0.0)
    assert np.all(field.pressure[np.isnan(field.thickness)] == 0.0)
    assert np.nanmin(field.thickness) == pytest.approx(float(state.minimum_thickness), abs=1e-3)
    track = max(pad.track_ratio for pad in pads_of(bearing))
    middle = 0.25 * (1.0 + track) if track else 0.0  # of the bearing, or of a land
    there = film.field(at, angle=state.peak_angle, zeta=middle)
    assert float(there.pressure) == pytest.approx(float(state.peak_pressure), rel=0.03)
    # Grooves are as wide as the record says.
    open_share = 1.0 - sum(p.arc for p in pads_of(bearing)) / (2 * math.pi)
    found = np.isnan(film.field(at, angle=angle, zeta=0.45).thickness).mean()
    assert found == pytest.approx(open_share, abs=5e-3)


@ALL
def test_what_flows_in_flows_out(name):
    """Between the edges: the flow over both, less what the film takes up where it breaks."""
    bearing = on(BORES[name], 0.5)
    grid = mesh(pads_of(bearing), 4.0, 480, 12 if name in DAMS else 8)
    over = films(grid, film_state(bearing, 0.5).position[None])
    at = settled_pressures(over, np.ones((1, *grid.shape), dtype=bool))
    flux = 0.0
    wet = np.pad(at.wet, ((0, 0), (0, 0), (1, 1), (0, 0)), mode="edge")
    p = np.pad(at.pressure, ((0, 0), (0, 0), (1, 1), (0, 0)))
    for z in range(over.I3.shape[2]):
        q = (6 * over.I2[:, :, z, :, None] - np.diff(p, axis=2)) / over.I3[:, :, z, :, None]
        inside = wet[:, :, :-1] | wet[:, :, 1:]
        # Each run of full film: what enters its first cell less what leaves its last.
        enters = inside & ~np.pad(inside, ((0, 0), (0, 0), (1, 0), (0, 0)))[:, :, :-1]
        leaves = inside & ~np.pad(inside, ((0, 0), (0, 0), (0, 1), (0, 0)))[:, :, 1:]
        w = grid.weights[:, z]
        flux += float((q * w * (enters * 1.0 - leaves)).sum()) / 24.0
    # The end rows' share of the entrained flow has no pressure of its own.
    assert float(side_flow(over, at.pressure)[0]) == pytest.approx(flux, rel=0.03)


@pytest.mark.parametrize("name", ["plain", "two grooves", "four grooves"])
def test_the_drag_of_parts_of_one_circle_is_shear_and_half_the_couple_of_the_load(name):
    """T = Σ∫dβ/h + ½ y F_o (L/R)²: the second term is the loss of the pressure flow."""
    bearing, sigma = on(BORES[name], 0.5), 0.4
    film = film_state(bearing, sigma)
    x, y = film.position
    shear = 0.0
    for pad in pads_of(bearing):
        beta = np.linspace(pad.start, pad.end, 20001)
        shear += np.trapezoid(1.0 / (1.0 - x * np.cos(beta) - y * np.sin(beta)), beta)
    assert float(film.drag) == pytest.approx(shear + 0.5 * y * 0.25 / sigma, rel=2e-3)


def test_the_drag_of_a_pocket_is_that_of_its_film():
    """Without load and pressure all is shear: a shallow and a deep pocket over one arc."""
    grid = mesh((Pad(0.0, 2.0, step=1.0, depth=3.0, axial_ratio=0.5),), 1.0, 80, 6)
    over = films(grid, np.zeros((1, 2)))
    nothing = np.zeros((1, *grid.shape))
    assert float(drag(over, nothing)[0]) == pytest.approx(1.0 + 0.5 + 0.5 / 4.0)


@ALL
def test_the_table_goes_on_to_no_load(name):
    bearing = on(BORES[name], 0.5)
    lightest = film_of(bearing)._table.lightest_sommerfeld
    near = film_state(bearing, lightest * np.array([1 - 1e-9, 1 + 1e-9]))
    far = film_state(bearing, np.array([1e3, 1e6, np.inf]) * lightest)
    assert near.stiffness[0] == pytest.approx(near.stiffness[1], abs=1e-7)
    assert near.position[0] == pytest.approx(near.position[1], abs=1e-9)
    size = np.abs(near.stiffness[1]).max()
    assert np.abs(near.stiffness[1] - far.stiffness).max() < 0.15 * size
    assert np.abs(far.stiffness[1] - far.stiffness[2]).max() < 1e-5 * size
    assert far.attitude_angle == pytest.approx(np.full(3, far.attitude_angle[0]), abs=0.01)
    preloaded = not np.allclose(far.peak_pressure[2], 0.0)
    assert preloaded == (name not in ("plain", "partial arc", "two grooves", "four grooves"))
    if not preloaded:
        assert np.all(far.position[2] == 0.0)
        C = far.damping[2]
        half = 0.5 * np.stack([-C[:, 1], C[:, 0]], axis=-1)
        assert far.stiffness[2] == pytest.approx(half, abs=1e-12)


def test_a_light_load_on_a_plain_bore_whirls_at_half_speed():
    film = film_state(on(Plain(), 0.5), np.array([1e2, 1e4, 1e8]))
    onset = whirl_onset(film.k, film.c)
    assert onset.whirl_ratio == pytest.approx([0.5] * 3, abs=2e-3)
    assert onset.equivalent_stiffness[1:] == pytest.approx(
        [float(onset.equivalent_stiffness[0])] * 2, rel=5e-3
    )
    assert film.attitude_angle == pytest.approx([math.pi / 2] * 3, abs=0.03)


def test_without_load_a_preloaded_bore_holds_the_journal():
    """Stiffness in film units; computed elsewhere (three digits)."""
    ellipse = film_state(on(Elliptical(), 0.5), np.inf)
    expected = np.array([[4.10, 1.81], [-2.57, 0.05]])
    assert error(ellipse.stiffness, expected) < 5e-3
    assert np.abs(ellipse.position).max() < 1e-6
    lobes = film_state(on(Lobes(), 0.5), np.inf).stiffness
    assert error(lobes, np.array([[1.58, 2.23], [-2.23, 1.58]])) < 5e-3
    dam = film_state(on(PressureDam(), 1.0), np.inf)
    assert dam.position == pytest.approx([-0.112, 0.252], abs=2e-3)
    assert error(dam.stiffness, np.array([[0.30, 0.70], [-0.06, 0.24]])) < 0.015


@ALL
@pytest.mark.parametrize("ratio", [0.1, 0.5, 2.0])
def test_a_load_too_heavy_is_refused_in_words(name, ratio):
    bearing = on(BORES[name], ratio)
    made = film_of(bearing)._table
    least = made.least_sommerfeld
    film = film_state(bearing, least)
    assert 0.02 < float(film.minimum_thickness) < 0.05
    assert made.thinnest == pytest.approx(float(film.minimum_thickness), abs=1e-6)
    with pytest.raises(ValueError, match=r"sommerfeld = .* the smallest film is 0\.0"):
        film_state(bearing, np.array([1.0, 0.99 * least]))


@ALL
@pytest.mark.parametrize("ratio", [0.1, 1.0, 2.0])
def test_the_journal_nears_the_pad_as_the_load_rises(name, ratio):
    bearing = on(BORES[name], ratio)
    made = film_of(bearing)._table
    film = film_state(bearing, 0.25 / np.geomspace(made.load[0], made.load[-1], 200))
    assert np.all(np.diff(film.position[100:, 0]) > 0.0)  # first it may give way to the side
    assert np.all(film.minimum_thickness > 0.0)
    assert np.all(np.linalg.det(film.stiffness) > 0.0)
    assert np.all(np.linalg.eigvalsh(film.damping) > 0.0)


def test_bores_of_one_shape_share_a_table():
    small, large = on(Elliptical(), 0.5), replace(on(Elliptical(), 0.5), diameter=0.2, length=0.1)
    assert film_of(small)._table is film_of(large)._table
    assert film_of(small).curve == film_of(large).curve != film_of(on(Lobes(), 0.5)).curve


def test_a_film_of_finite_length_says_what_it_does_not_compute():
    film = film_of(on(PressureDam(), 0.5))
    with pytest.raises(ValueError, match="added mass is not computed"):
        film.added_mass(OperatingPoints.at_sommerfeld(film.bearing, 1.0))
    with pytest.raises(ValueError, match="zeta"):
        film.field(OperatingPoints.at_sommerfeld(film.bearing, 1.0), angle=0.0, zeta=0.6)


def test_a_table_is_made_once_and_no_more():
    table.cache_clear()
    bearing = on(Elliptical(preload=0.37), 0.7)
    film_state(bearing, 1.0)
    film_state(replace(bearing, radial_clearance=9e-5), np.array([0.5, 0.7]))
    assert table.cache_info().misses == 1


def test_pads_stand_where_the_field_says():
    """Angles in degrees from the load line."""

    def edges(geometry):
        return [
            (round(pad.start / DEGREE, 6), round(pad.end / DEGREE, 6))
            for pad in pads_of(on(geometry, 1.0))
        ]

    assert edges(AxialGrooves()) == [(-80, 80), (100, 260)]
    assert edges(AxialGrooves(number=4, width=15 * DEGREE))[0] == (-37.5, 37.5)
    assert edges(Elliptical()) == edges(OffsetHalves()) == edges(AxialGrooves())
    assert edges(Lobes()) == [(-50, 50), (70, 170), (190, 290)]
    assert edges(Lobes(load="between pads"))[0] == (10, 110)
    assert edges(PartialArc(centre=10 * DEGREE)) == [(-65, 85)]
    lower, upper = pads_of(on(PressureDam(), 1.0))
    assert (lower.depth, upper.depth, upper.step / DEGREE) == (0.0, 2.0, pytest.approx(230))
    assert [pad.depth for pad in pads_of(on(MultiDam(depth=2.5e-4), 1.0))] == [2.5] * 4
    # At its point of closest approach a leaned pad has the film 1 − m.
    assert float(gap(pads_of(on(Lobes(offset=0.7, preload=0.4), 1.0)), (0.0, 0.0))) == 0.6
    assert on(Elliptical(preload=0.4), 1.0).assembled_clearance == pytest.approx(6e-5)


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (lambda: AxialGrooves(number=6, width=70 * DEGREE), r"width = .*70°.*less than"),
        (lambda: Lobes(number=2.5), "number = 2.5 -: must be a whole number"),
        (lambda: Lobes(number=4), r"arc = .*100°.*for 4 pads.*90°"),
        (lambda: Lobes(load="beside"), "load = 'beside'"),
        (lambda: Elliptical(preload=1.0), "preload = 1.0 -: must be less than 1"),
        (lambda: PressureDam(pocket_arc=3.0), r"pocket_arc = 3 rad.*less than the pad's arc"),
        (lambda: PressureDam(depth=0.0), "depth = 0.0 m: must be positive"),
        (lambda: PartialArc(arc=7.0), "arc = 7.0 rad: must be less than"),
        (lambda: on(PressureDam(), 1.0) and replace(on(PressureDam(), 1.0), film="short"),
         "film = 'short'"),
    ],
)  # fmt: skip
def test_bores_that_cannot_be_are_refused_in_words(made, words):
    with pytest.raises(ValueError, match=words):
        made()


@pytest.mark.parametrize(
    "bearing",
    [
        on(PartialArc(centre=math.radians(90.0)), 1 / 3),
        # Where loads are carried only beside the pad's bore, and by saddles.
        on(PartialArc(arc=math.radians(100.0), centre=math.radians(-30.0)), 1 / 3),
        on(PartialArc(centre=math.radians(-60.0)), 1 / 3),
        on(OffsetHalves(offset=0.95), 1 / 3),
        on(Lobes(offset=0.0), 1 / 3),
        on(PressureDam(preload=0.95), 1 / 3),
        replace(on(Lobes(offset=0.0), 1 / 3), film="short"),
        replace(on(PartialArc(arc=math.radians(10.0)), 1 / 3), film="short"),
    ],
)
def test_a_bore_that_carries_no_load_is_refused_in_words(bearing):
    with pytest.raises(ValueError, match="no position of the journal was found at which its film"):
        film_state(bearing, 4.0)


# Between narrow pads Newton's method is drawn to where the film is next to nothing.
NARROW = {
    "five grooves at L/D 0.1": (AxialGrooves(number=5, width=0.8529557, first=1.7927927), 0.1),
    "five grooves at L/D 0.5": (AxialGrooves(number=5, width=0.7062687, first=0.4864597), 0.5),
    "six narrow lobes": (Lobes(number=6, arc=10 * DEGREE, preload=0.0, offset=0.4), 1.0),
    "two dams": (MultiDam(number=2, arc=75 * DEGREE, pocket_arc=55 * DEGREE, axial_ratio=0.05),
                 1.0),
}  # fmt: skip


@pytest.mark.parametrize("name", NARROW)
def test_each_state_of_a_table_carries_its_load_and_is_no_saddle(name):
    made = film_of(on(*NARROW[name]))._table
    over = films(made.mesh, made.position)
    force = settled_pressures(over, made.wet).force * made.mesh.slenderness / 4
    astray = np.hypot(force[:, 0] + made.load, force[:, 1])
    assert np.all(astray < 0.1 * made.load)
    assert np.all(np.linalg.det(made.coefficients(0.25 / made.load)[0]) > 0.0)


def test_a_position_inside_a_pad_is_refused_in_words():
    grid = mesh(pads_of(on(PartialArc(), 1.0)), 1.0, 16, 2)
    over = films(grid, np.array([[1.2, 0.0]]))
    with pytest.raises(ValueError, match="must lie inside the bore"):
        solved(over, np.ones((1, *grid.shape), dtype=bool))


def test_every_kind_is_in_a_file_and_back():
    from tests.machines import SHEET

    for geometry in BORES.values():
        assert isinstance(geometry, Geometry)
        machine = replace(SHEET, bearing=on(geometry, 0.5))
        assert Machine.from_json(machine.to_json()) == machine
