"""The force of finite films on a moving journal: a second program, linear theory, symmetry."""

import math
import pickle

import numpy as np
import pytest

from rotorcalc import (
    AxialGrooves,
    Elliptical,
    JournalBearing,
    MultiDam,
    OffsetHalves,
    PartialArc,
    Plain,
    PressureDam,
)
from rotorcalc.films import film_of, film_state, short
from rotorcalc.films.finite import CircleInMotion
from rotorcalc.films.finite.motion import FinitePadsInMotion
from rotorcalc.films.pads import pads_of
from tests.films import plain_program

DEGREE = math.pi / 180
# Pads of 160° all, which share one table.
BORES = {
    "two grooves": AxialGrooves(),
    "elliptical": Elliptical(),
    "offset halves": OffsetHalves(),
    "plain": Plain(),
    "partial arc": PartialArc(arc=160 * DEGREE),
}
# Their pads are solved for each motion.
POCKETS = {"pressure dam": PressureDam(), "multi dam": MultiDam()}
ALL = pytest.mark.parametrize("name", BORES | POCKETS)
STEP = 1e-5


def on(geometry, ratio=0.5):
    return JournalBearing(
        diameter=0.1, length=0.1 * ratio, radial_clearance=1e-4, geometry=geometry, film="finite"
    )


def motion_of(name, ratio=0.5):
    return film_of(on((BORES | POCKETS)[name], ratio)).motion()


def slopes(force, place):
    """Return −∂F/∂x and −∂F/∂x' at rest, (2, 2) each."""
    at = np.array([*place, 0.0, 0.0])
    columns = [
        (np.array(force(*(at - step))) - force(*(at + step))) / (2 * STEP)
        for step in STEP * np.eye(4)
    ]
    return np.stack(columns[:2], axis=-1), np.stack(columns[2:], axis=-1)


@pytest.mark.parametrize(
    ("name", "sigma"),
    [
        *((name, sigma) for name in BORES for sigma in (0.06, 0.15, 0.5, 2.0, 10.0)),
        *((name, sigma) for name in POCKETS for sigma in (0.5, 2.0, 10.0)),
    ],
)
def test_small_motions_are_the_linear_theorys(name, sigma):
    state = film_state(on((BORES | POCKETS)[name]), sigma)
    motion = motion_of(name)
    stiff = np.abs(state.stiffness).max()
    rest = motion.force(*state.position.tolist(), 0.0, 0.0)
    # In a preloaded bore a light load is the small difference of the pads' forces.
    assert rest == pytest.approx((-0.25 / sigma, 0.0), abs=5e-4 * (0.25 / sigma + stiff))
    K, C = slopes(motion.force, state.position.tolist())
    assert np.abs(K - state.stiffness).max() < motion.apart * stiff
    assert np.abs(C - state.damping).max() < motion.apart * np.abs(state.damping).max()


def test_each_motion_names_how_exact_it_is():
    assert {motion_of(name).apart for name in BORES} == {0.005}
    assert {motion_of(name).apart for name in POCKETS} == {0.012}


@ALL
@pytest.mark.parametrize(
    "motion",
    [(0.3, 0.2, 0.1, -0.05), (-0.2, 0.3, -0.2, 0.3), (0.1, -0.35, 0.0, -0.4), (0.45, 0, 0.05, 0.2)],
)
def test_a_second_program_finds_the_same_force(name, motion):
    pads = [
        (p.start, p.end, p.a_x, p.a_y, *((p.step, p.depth, p.axial_ratio) if p.depth else ()))
        for p in pads_of(on((BORES | POCKETS)[name]))
    ]
    if name == "plain":
        pads = [open_circle(motion)]
    expected = plain_program.force(pads, 0.5, motion[:2], motion[2:])
    if name in POCKETS:  # where the film steps along the bearing, its error falls with the step
        finer = plain_program.force(pads, 0.5, motion[:2], motion[2:], grid=(160, 48))
        expected = 2.0 * finer - expected
    found = np.array(motion_of(name).force(*motion))
    assert np.abs(found - expected).max() < 0.01 * np.abs(expected).max()


def open_circle(motion):
    """Return a full circle, cut where wedge and squeeze open the film most."""
    x, y, dx, dy = motion
    beta = np.linspace(0.0, 2 * math.pi, 721)
    cos, sin = np.cos(beta), np.sin(beta)
    cut = float(beta[(6 * (x * sin - y * cos) - 12 * (dx * cos + dy * sin)).argmax()])
    return cut - 2 * math.pi, cut, 0.0, 0.0


def test_a_plain_bore_has_no_direction_of_its_own():
    force = motion_of("plain").force
    one = np.array(force(0.5, -0.3, 0.1, 0.2))
    for turn in (0.7, 2.0, -1.3):
        c, s = math.cos(turn), math.sin(turn)
        T = np.array([[c, -s], [s, c]])
        other = force(*(T @ (0.5, -0.3)).tolist(), *(T @ (0.1, 0.2)).tolist())
        assert other == pytest.approx(T @ one, rel=1e-9)


def test_a_shorter_plain_bore_approaches_the_short_film():
    """What the pressure flow around the journal takes falls with (L/D)²."""
    states = [(0.3, 0.2, 0.1, -0.05), (-0.2, 0.6, -0.2, 0.1), (0.1, -0.35, 0.0, -0.4)]
    errors = []
    for ratio in (0.2, 0.1):
        force = motion_of("plain", ratio).force
        found, expected = (
            np.array([f(*state) for state in states])
            for f in (force, lambda x, y, dx, dy: short.film_force((x, y), (dx, dy)))
        )
        errors.append(np.abs(found / expected - 1.0).max())
    assert errors[0] < 0.15
    assert errors[1] < 0.4 * errors[0]


def test_a_circles_own_coordinates_give_the_force_of_its_table():
    """A program for pads of any arc reads the same table in three coordinates, point by point."""
    random, bearing = np.random.default_rng(5), on(Plain())
    circle, pads = CircleInMotion(bearing), FinitePadsInMotion(bearing)
    for eps in (0.0, 0.3, 0.9, 0.98):
        angle, velocity = random.uniform(-math.pi, math.pi), random.normal(0.0, 0.5, 2).tolist()
        at = eps * math.cos(angle), eps * math.sin(angle), *velocity
        force = circle.force(*at)
        assert force == pytest.approx(pads.force(*at), rel=1e-12)
        found, expected = circle.answer(*at), np.array(pads._answer(*at))
        assert np.array(found) == pytest.approx(expected, abs=1e-5 * np.abs(expected).max())
        assert circle.velocity(*at[:2], *force) == pytest.approx(velocity, abs=1e-12)
    assert circle.velocity(0.4, -0.2, 0.0, 0.0) == (0.1, 0.2)
    with pytest.raises(ArithmeticError, match="no force"):
        circle.velocity(0.4, -0.2, math.nan, 0.0)
    with pytest.raises(ArithmeticError, match="no film"):
        circle.force(math.inf, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("name", ["plain", "two grooves"])
def test_through_the_centre_the_force_is_smooth(name):
    """There the line of centres turns round at once, and with it all of the table's coordinates."""
    force = motion_of(name).force
    along = np.array([force(s, 0.3 * s, 0.02, 0.05) for s in np.linspace(-0.02, 0.02, 9)])
    assert np.abs(np.diff(along, 3, axis=0)).max() < 5e-4 * np.abs(along).max()


@ALL
def test_the_velocity_is_that_of_the_force(name):
    motion = motion_of(name)
    for x, y, dx, dy in [(0.1, 0.3, 0.1, 0.2), (-0.3, 0.2, -0.4, 0.0), (0.35, -0.1, 1.0, -3.0)]:
        f = motion.force(x, y, dx, dy)
        if math.hypot(*f) < 1e-6:
            continue  # no pad is under pressure: many velocities have that force
        near = []
        found = motion.velocity(x, y, *f, near)
        assert motion.force(x, y, *found) == pytest.approx(f, rel=1e-8, abs=1e-8 * math.hypot(*f))
        again = motion.velocity(x, y, *f, near)
        assert again == pytest.approx(found, abs=1e-9 * math.hypot(*found))


@pytest.mark.parametrize("name", ["elliptical", "pressure dam"])
def test_the_film_never_drives_the_motion_it_resists(name):
    """Its potential is convex: between any two velocities the force opposes their difference."""
    random = np.random.default_rng(7)
    force = motion_of(name).force
    for place in random.uniform(-0.3, 0.3, (40, 2)):
        one, other = random.normal(0.0, 0.5, (2, 2))
        change = np.array(force(*place, *one)) - force(*place, *other)
        assert np.dot(change, one - other) < 0.0


def test_bores_with_the_same_pads_share_tables():
    tables = [motion_of(name).tables for name in ("two grooves", "elliptical", "partial arc")]
    assert tables[0] == tables[1] == tables[2] != motion_of("plain").tables
    assert motion_of("plain").tables != motion_of("plain", 0.2).tables


@pytest.mark.parametrize("name", ["elliptical", "multi dam"])
def test_the_force_passes_to_another_process(name):
    motion = motion_of(name)
    sent = pickle.dumps(motion)
    assert len(sent) < 2000
    state = (0.2, 0.1, 0.0, 0.1)
    assert pickle.loads(sent).force(*state) == motion.force(*state)  # noqa: S301 - our own


@pytest.mark.parametrize("name", POCKETS)
def test_what_was_solved_before_changes_nothing(name):
    """The search for the film's fronts begins at the last ones, and ends at its own."""
    states = [(0.2, 0.1, 0.0, 0.1), (-0.3, 0.3, 1.0, -0.5), (0.4, -0.1, -0.2, 0.6)]
    motion = motion_of(name)
    found = [motion.force(*state) for state in states * 2]
    assert found[:3] == found[3:] == [motion_of(name).force(*state) for state in states]
    x, y, *_ = states[0]
    f = found[0]
    alone = motion_of(name).velocity(x, y, *f)  # by the convex search, from no film at all
    assert motion.velocity(x, y, *f) == pytest.approx(alone, rel=1e-9)
