"""The two whirls of a rotor on floating rings, against the eigenvalues themselves."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import (
    Rotor,
    Supply,
    analyse,
    heat,
    mode_onsets,
    modes,
    onset_speed,
    ring_speed,
    ring_whirl,
)
from rotorcalc.onset.judge import is_unstable
from tests.films.models import BEARINGS, RINGS
from tests.films.test_ring import MACHINE, SPEED, UNLIKE, on
from tests.machines import ROTORS, SHEET


def machine_of(name, rotor="massless journals", **changes):
    return replace(SHEET, bearing=RINGS[name], rotor=ROTORS[rotor], **changes)


@pytest.mark.parametrize("bearing", [MACHINE.bearing, UNLIKE], ids=["usual", "unlike"])
@pytest.mark.parametrize("film", ["short", "finite"])
def test_a_light_rotor_whirls_at_half_the_surfaces_speeds(bearing, film):
    """½(Ω + Ω_R) in the inner film, ½Ω_R in the outer one: the smaller the rotor, the closer."""
    off = []
    for load in (1e-1, 1e-2, 1e-3):
        machine = on(replace(bearing, film=film), load=load, rotor=Rotor(mass=0.2 * load))
        whirl = ring_whirl(machine, np.array([500.0, 2000.0]))
        r = ring_speed(machine, whirl.speed) / whirl.speed
        assert whirl.inner_limit == pytest.approx((1.0 + r) / 2.0, rel=1e-14)
        assert whirl.outer_limit == pytest.approx(r / 2.0, rel=1e-14)
        inner = whirl.inner_whirl_ratio - whirl.inner_limit
        outer = whirl.outer_whirl_ratio - whirl.outer_limit
        off.append(np.abs([inner, outer]).max())
    # A load a tenth as heavy leaves a hundredth of the distance, beside what a table errs by.
    error = 0.0 if film == "short" else 3e-7
    assert max(off[1] - error, 0.0) < 0.013 * off[0]
    assert max(off[2] - error, 0.0) < 0.013 * off[1]
    assert off[2] < 3e-7


def test_the_whirls_of_a_small_turbocharger():
    whirl = ring_whirl(MACHINE, SPEED)
    assert float(whirl.inner_limit) == pytest.approx(0.6576, abs=5e-5)
    assert float(whirl.outer_limit) == pytest.approx(0.1576, abs=5e-5)
    assert float(whirl.inner_whirl_ratio) == pytest.approx(0.652, abs=1e-3)
    values = analyse(MACHINE, SPEED).rigid_eigenvalues / SPEED
    for found in (
        complex(whirl.inner_growth, whirl.inner_whirl_ratio),
        complex(whirl.outer_growth, whirl.outer_whirl_ratio),
    ):
        assert np.abs(values - found).min() < 1e-9


@pytest.mark.parametrize("rotor", ROTORS)
@pytest.mark.parametrize("name", RINGS)
def test_the_lower_of_the_two_onsets_is_the_machines(name, rotor):
    machine = machine_of(name, rotor)
    both = mode_onsets(machine)
    assert [one.mode for one in both] == ["inner film", "outer film"]
    onset = onset_speed(machine)
    first = min(both, key=lambda one: one.speed)
    assert first.speed == pytest.approx(onset.speed, rel=1e-9)
    assert first.whirl_frequency == pytest.approx(onset.whirl_frequency, rel=1e-7)
    for one in both:
        if math.isinf(one.speed):
            assert math.isnan(one.whirl_ratio)
            assert one.searched_to == onset.searched_to
            continue
        assert one.whirl_frequency == pytest.approx(one.whirl_ratio * one.speed, rel=1e-12)
        values = analyse(machine, one.speed).flexible_eigenvalues
        on_axis = np.abs(values - 1j * one.whirl_frequency).min()
        assert on_axis < 1e-7 * one.whirl_frequency


def test_both_whirls_may_grow_at_once():
    machine = machine_of("floating ring", "rigid")
    inner, outer = mode_onsets(machine)
    above = 1.05 * max(inner.speed, outer.speed)
    growing = analyse(machine, above).flexible_eigenvalues
    assert np.sum((growing.real > 0.0) & (growing.imag > 0.0)) == 2
    between = 0.5 * (inner.speed + outer.speed)
    assert bool(is_unstable(machine, between))
    whirl = ring_whirl(machine, np.array([between, above]))
    assert whirl.inner_growth[0] > 0.0 > whirl.outer_growth[0]
    assert min(whirl.inner_growth[1], whirl.outer_growth[1]) > 0.0


def test_the_sheet_of_a_ring_so_heavy_that_its_own_mass_unloads_the_journal_is_finite():
    """In synchronous motion a heavy ring leaves a negative stiffness: no threshold but 0."""
    machine = machine_of("floating ring, heavy", "journal mass")
    sweep = analyse(machine, 4750.0)
    assert float(sweep.equivalent_stiffness) < -float(machine.rotor.shaft_stiffness)
    assert float(sweep.rigid_threshold) == float(sweep.flexible_threshold) == 0.0


def test_a_rigid_shaft_may_be_asked_for():
    machine = machine_of("floating ring")
    rigid = mode_onsets(machine_of("floating ring", "rigid"))
    assert [one.speed for one in mode_onsets(machine, flexible=False)] == pytest.approx(
        [one.speed for one in rigid], rel=1e-12
    )


def test_without_load_both_whirls_are_there_at_any_speed():
    both = mode_onsets(machine_of("floating ring", load=0.0))
    assert [one.speed for one in both] == [0.0, 0.0]
    limit = ring_whirl(machine_of("floating ring", load=0.0), 10.0)
    assert both[0].whirl_ratio == pytest.approx(float(limit.inner_limit), rel=1e-4)
    assert both[1].whirl_ratio == pytest.approx(float(limit.outer_limit), rel=1e-3)


def test_with_a_supply_each_onset_is_at_the_temperature_of_its_speed():
    machine = machine_of("floating ring", temperature=None, supply=Supply(temperature=40.0))
    for one in mode_onsets(machine):
        if math.isinf(one.speed):
            continue
        T = float(heat.film_temperature(machine, one.speed))
        given = mode_onsets(replace(machine, temperature=T, supply=None))
        assert one.speed == pytest.approx(
            next(other.speed for other in given if other.mode == one.mode), rel=1e-9
        )


@pytest.mark.parametrize("name", RINGS)
def test_the_whirl_shown_above_an_onset_is_the_one_that_grows(name):
    machine = machine_of(name)
    for one, kind in zip(mode_onsets(machine), ("inner", "outer"), strict=True):
        if math.isinf(one.speed):
            continue
        growth = getattr(
            ring_whirl(machine, one.speed * np.array([0.99, 1.01, 2.0])), f"{kind}_growth"
        )
        assert list(growth > 0.0) == [False, True, True]


def test_a_mode_that_does_not_oscillate_hides_none_that_does():
    """Heavily loaded, the ring's whirl is far from its limit, further than a frequency of zero."""
    machine = machine_of("floating ring", load=5e4)
    whirl = ring_whirl(machine, 600.0)
    found = complex(whirl.outer_growth, whirl.outer_whirl_ratio)
    assert found.imag > 2.0 * float(whirl.outer_limit)
    assert np.abs(analyse(machine, 600.0).flexible_eigenvalues / 600.0 - found).min() < 1e-9


@pytest.mark.parametrize("function", [mode_onsets, lambda m: ring_whirl(m, 600.0)])
def test_a_bearing_without_a_ring_is_refused_in_words(function):
    with pytest.raises(ValueError, match="bearing = plain: has no floating ring"):
        function(SHEET)


def test_the_share_of_the_ring_tells_a_whirl_with_it_from_one_in_it():
    """In the outer film's whirl journal and ring move alike, in the inner one's the ring rests."""
    shapes = analyse(MACHINE, SPEED).mode_shapes()
    share = modes.inner_share(shapes)
    assert shapes.inner.shape == (6, 2)
    assert share.shape == (6,)
    whirl = ring_whirl(MACHINE, SPEED)
    at = {
        kind: int(np.argmin(np.abs(shapes.eigenvalues / SPEED - 1j * ratio)))
        for kind, ratio in (("in", whirl.inner_whirl_ratio), ("with", whirl.outer_whirl_ratio))
    }
    assert share[at["in"]] < 0.1
    assert share[at["with"]] == pytest.approx(0.5, abs=0.05)
    some = shapes.ordered(np.array([3, 1]))
    assert modes.inner_share(some) == pytest.approx(share[[3, 1]], rel=1e-15)


@pytest.mark.parametrize("name", ["short", "lossy"])
def test_a_film_without_parts_has_no_share_of_them(name):
    machine = replace(SHEET, bearing=BEARINGS[name])
    assert np.all(modes.inner_share(analyse(machine, 600.0).mode_shapes()) == 0.0)
