"""Pads on flexures: the films of one pad over the plane, balances, limits, and pads that snap."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import JournalBearing, Lobes, TiltingPads, analyse, validity
from rotorcalc.films import film_of, film_state
from rotorcalc.films.finite.reynolds import films, mesh
from rotorcalc.films.finite.sweeps import settled_pressures
from rotorcalc.films.finite.table import carried
from rotorcalc.films.pads import gap
from rotorcalc.films.state import OperatingPoints
from rotorcalc.films.tilting import settling
from rotorcalc.films.tilting.family import columns, generic_pad
from rotorcalc.films.tilting.flexure import FlexurePads, films_of
from rotorcalc.films.tilting.pivots import Pivots, pivots_of, places
from rotorcalc.films.tilting.plane import plane
from rotorcalc.films.tilting.rest import FreePads
from tests.films import plain_program
from tests.machines import SHEET

ARC = math.radians(75)
R, C, L = 0.05, 1e-4, 0.05
# μΩRL³/C² at 1 Pa·s and 1 rad/s.
UNIT = R * L**3 / C**2
PIVOTS = Pivots(number=4, on_pad=False, arc=ARC, offset=0.5, preload=0.3)
PADS = FlexurePads(PIVOTS, 4.0, coarse=False)


def on(geometry):
    return JournalBearing(diameter=2 * R, length=L, radial_clearance=C, geometry=geometry)


def flexures(stiffness, **changes):
    return film_of(on(TiltingPads(number=4, arc=ARC, rotational_stiffness=stiffness, **changes)))


def at_load(film, load):
    """Return operating points at loads in units of the film."""
    return OperatingPoints.of(film.bearing, viscosity=1.0, speed=1.0, load=UNIT * load)


@pytest.fixture(scope="module")
def some_places():
    """Places of the journal over a pad with its pivot behind the middle, and films on a fine mesh.

    On twice as many cells as the table's and one pressure more.
    """
    pad = generic_pad(ARC, 0.6)
    random = np.random.default_rng(2)
    e = random.uniform([-1.2, -1.2], [1.0, 1.6], (300, 2))
    e = e[gap((pad,), e) > 0.04][:90]
    rough, fine = mesh((pad,), 4.0, 40, 2), mesh((pad,), 4.0, 160, 4)
    wet = settled_pressures(films(rough, e), np.ones((len(e), *rough.shape), dtype=bool)).wet
    over = films(fine, e)
    at = settled_pressures(over, carried(wet, fine))
    return e, columns(over, at), at.force


def test_the_films_over_the_plane_are_those_of_a_finer_mesh(some_places):
    """Nine in ten to half a per cent; the others are next to nothing, a wedge at one edge."""
    e, expected, force = some_places
    one = plane(ARC, 4.0, coarse=False).turned_to(0.6)
    found, loaded = one.columns(e)
    pressed = expected[:, 11] > 1e-2
    assert np.all(loaded[pressed])
    F, _, _ = one.forces(e)
    assert np.array_equal(found[:, 1], -F[:, 0])
    for value, exact in (
        (F, force),
        (found[:, 2:6], expected[:, 2:6]),
        (found[:, 6:9], expected[:, 6:9]),
    ):
        off = np.abs(value - exact).max(axis=1) / (np.abs(exact).max(axis=1) + 1e-2)
        assert np.quantile(off, 0.9) < 5e-3
        assert off.max() < 2e-2
    assert found[pressed, 9] == pytest.approx(expected[pressed, 9], rel=2e-3)
    assert found[pressed, 11] == pytest.approx(expected[pressed, 11], rel=1e-2)
    assert found[:, 13] == pytest.approx(expected[:, 13], abs=1e-12)


def test_stiffness_is_the_forces_derivative_and_damping_takes_energy(some_places):
    e, _, _ = some_places
    one = plane(ARC, 4.0, coarse=False).turned_to(0.6)
    _, K, damping = one.forces(e)
    step = 1e-4
    slopes = np.stack(
        [(one.forces(e - d)[0] - one.forces(e + d)[0]) / (2 * step) for d in step * np.eye(2)],
        axis=-1,
    )
    off = np.abs(slopes - K).max(axis=(1, 2)) / (np.abs(K).max(axis=(1, 2)) + 1e-2)
    assert np.quantile(off, 0.9) < 1e-2
    assert off.max() < 5e-2
    assert np.linalg.eigvalsh(damping).min() > -1e-14
    # Towards the centre of curvature the film is one of even thickness: its force is as e.
    near = one.forces(1e-5 * e)[0]
    assert near == pytest.approx(10.0 * one.forces(1e-6 * e)[0], rel=1e-3)


def test_forces_and_moments_balance():
    """At many loads and κ at once; each alone is the same."""
    load = np.geomspace(1e-3, 0.9, 24) * PADS.heaviest
    kappa = load * np.geomspace(10.0, 1e-3, 24)
    rest = PADS.at(load, kappa)
    T = PIVOTS.frames
    F, _, _ = films_of(PIVOTS, 4.0, coarse=False).forces(places(PIVOTS, rest.position, rest.tilt))
    assert F[..., 1] == pytest.approx(kappa[:, None] * rest.tilt, abs=1e-7 * load.max())
    force = np.einsum("nai,pna->pi", T, F)
    assert force[:, 0] == pytest.approx(-load, rel=1e-6)
    assert np.abs(force[:, 1]).max() < 1e-6
    alone = PADS.at(load[7:8], kappa[7:8])
    assert alone.tilt[0] == pytest.approx(rest.tilt[7], abs=1e-8)


def test_what_was_asked_before_changes_no_answer():
    """Rests of one machine begin between those already known: not across a snap."""
    known, load = np.geomspace(0.1, 3.0, 16), np.geomspace(0.1, 3.0, 300)
    for ratio in (0.01, 0.1):
        kappa = np.append(ratio * load[:-1], 0.0)  # of no one machine: each from free pads
        expected = PADS.at(load, kappa).tilt[:-1]
        assert np.abs(np.diff(expected, axis=0)).max() > 0.1
        PADS.at(known, ratio * known)
        for some in np.array_split(load[:-1], 4):
            found = PADS.at(some, ratio * some).tilt
            assert found == pytest.approx(expected[np.isin(load[:-1], some)], abs=1e-6)


def test_stiff_flexures_are_fixed_pads_and_soft_ones_tilt():
    sigma = np.array([0.15, 0.5, 5.0])
    fixed = film_state(on(Lobes(number=4, arc=ARC, preload=0.3, load="between pads")), sigma)
    free = film_state(on(TiltingPads(number=4, arc=ARC)), sigma)
    for kappa, other in ((3e-5, free), (1e8, fixed)):
        film = flexures(kappa * UNIT / C * R**2)
        state = film.state(at_load(film, 0.25 / sigma))
        assert state.position == pytest.approx(other.position, abs=2e-3)
        for found, expected in (
            (state.stiffness, other.stiffness),
            (state.damping, other.damping),
        ):
            off = np.abs(found - expected).max(axis=(1, 2)) / np.abs(expected).max(axis=(1, 2))
            assert off.max() < 5e-3


def test_without_load_pads_on_flexures_stand_alike():
    film = flexures(2e4)
    state = film.state(at_load(film, np.zeros(1)))
    tilts = film.tilts(at_load(film, np.zeros(1)))
    assert np.abs(state.position).max() < 1e-8
    assert np.ptp(tilts) < 1e-9 * np.abs(tilts).max()
    assert state.stiffness[0, 0, 0] == pytest.approx(state.stiffness[0, 1, 1], rel=1e-6)
    film = flexures(2e4, preload=0.0)
    with pytest.raises(ValueError, match="preload = 0: without load pads on flexures"):
        film.state(at_load(film, np.zeros(1)))


def test_a_pad_keeps_its_film_while_its_flexure_becomes_stiffer():
    """One load, κ rising: each state is that to which the one before it leads, snaps and all."""
    kappa = np.geomspace(2e-3, 0.2, 40)
    load = np.full_like(kappa, 0.8)
    rest = PADS.at(load, kappa)
    pad = films_of(PIVOTS, 4.0, coarse=False)
    free = FreePads.of(PIVOTS, 4.0, coarse=False).at(load[:1], np.zeros(1))
    at = settling.Settled(free.position, free.tilt, load[:1] < 0.0)
    for i, one in enumerate(kappa):
        at = settling.settled(pad, PIVOTS, settling.Held(load[:1], np.array([one])), at)
        assert at.good.all()
        assert at.tilt[0] == pytest.approx(rest.tilt[i], abs=1e-5)
    jumps = np.abs(np.diff(rest.tilt, axis=0)).max(axis=1) > 0.1
    assert jumps.sum() == 1
    # Before it the pad has two films: left where its flexure holds it, it stays there.
    before = int(np.argmax(jumps))
    dry = int(np.argmax(np.abs(rest.tilt[before + 1] - rest.tilt[before])))
    start = rest.tilt[before].copy()
    start[dry] = 0.0
    other = settling.settled(
        pad, PIVOTS, settling.Held(load[:1], kappa[before : before + 1]),
        settling.Settled(rest.position[before : before + 1], start[None], load[:1] < 0.0),
    )  # fmt: skip
    assert other.good.all()
    assert np.abs(other.tilt[0] - rest.tilt[before])[dry] > 0.1
    twice = PADS.other_films(rest, kappa)
    assert twice[before].tolist() == (np.arange(4) == dry).tolist()
    assert not twice[-1].any()


def test_the_assumptions_name_pads_with_two_possible_films():
    for stiffness, level in ((2e4, "caution"), (2e6, "good")):
        shape = TiltingPads(number=4, arc=ARC, rotational_stiffness=stiffness)
        machine = replace(SHEET, bearing=replace(SHEET.bearing, geometry=shape))
        checks = validity(analyse(machine, np.array([90.0, 300.0])))
        (found,) = (check for check in checks if check.name == "Pads with two possible films")
        assert found.worst == level


def test_where_nothing_holds_the_journal_the_bearing_has_no_answer():
    film = film_of(
        JournalBearing(
            diameter=2 * R, length=2 * R, radial_clearance=C,
            geometry=TiltingPads(number=4, arc=ARC, pivot_offset=0.6, load="on pad", preload=0.05,
                                 rotational_stiffness=0.1035 * 8 * UNIT / C * R**2),
        )
    )  # fmt: skip
    with pytest.raises(ValueError, match="nothing was found to hold the journal"):
        film.state(at_load(film, 8 * np.array([3.4611])))


def test_a_second_program_agrees():
    """Each pad's moment in N·m is k_θ times its tilt in rad; K and C with the tilts eliminated."""
    stiffness, load = 2e4 / (0.0127 * 600.0), 0.25 / 0.15
    film = flexures(stiffness)
    points = at_load(film, load)
    state, tilts, pivots = film.state(points), film.tilts(points), pivots_of(film.bearing)
    pad, kappa = (-ARC / 2, ARC / 2, 0.0, 0.0), stiffness / R**2 / (UNIT / C)
    force, whole = np.zeros(2), np.zeros((2, 2), dtype=complex)
    for T, tilt, empty in zip(pivots.frames, tilts, state.unloaded_pads, strict=True):
        place = T @ state.position + [pivots.preload, tilt * R / C]
        f = plain_program.force([pad], 0.5, place)
        # A pad without a film has no moment and all but no tilt: errors are beside the load's.
        assert f[1] * UNIT * R == pytest.approx(stiffness * tilt, abs=2e-3 * load * UNIT * R)
        force += T.T @ f
        if empty:
            assert np.abs(f).max() < 1e-9
            continue
        k, c = plain_program.coefficients([pad], 0.5, place)
        Z = k + 1j * c
        whole += T.T @ (Z - np.outer(Z[:, 1], Z[1]) / (Z[1, 1] + kappa)) @ T
    assert force == pytest.approx([-load, 0.0], abs=3e-3 * load)
    assert np.abs(whole.real - state.stiffness).max() < 5e-3 * np.abs(whole.real).max()
    assert np.abs(whole.imag - state.damping).max() < 5e-3 * np.abs(whole.imag).max()
