"""Modes of a ring, of a bearing's parts and of the rotor alone are told apart by what moves."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import TiltingPads, analyse, mode_onsets, ring_whirl
from rotorcalc.mode_names import mode_names
from rotorcalc.modes import ModeShapes
from rotorcalc.units import SI
from tests.films.models import BEARINGS, RINGS
from tests.films.test_ring import MACHINE
from tests.machines import ROTORS, SHEET
from ui.computed import Computed
from ui.sharing import export, report
from ui.sharing.labels import Labels
from ui.words.root_locus import table


def named(machine, speed):
    shapes = analyse(machine, speed).mode_shapes()
    return shapes.eigenvalues / speed, mode_names(machine.bearing, shapes)


def shapes_with(journal, inner, disk=None):
    """Return one mode in which journal and parts move so far, the disk as far as the journal."""
    one = np.array([[1.0 + 0j, 1j]])
    return ModeShapes(
        eigenvalues=np.array([1j]), vectors=np.eye(1, dtype=complex),
        disk=(journal if disk is None else disk) * one,
        journal=journal * one, inner=inner * one,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("journal", "ring", "name"),
    [(1.0, 0.1, ""), (1.0, -0.9, ""), (0.9, 1.0, "ring in the outer film"), (0.2, 1.0, "ring")],
)
def test_a_mode_is_named_by_what_moves_in_it(journal, ring, name):
    assert mode_names(RINGS["floating ring"], shapes_with(journal, ring)) == (name,)
    other = "" if name != "ring" else "bearing's parts"
    assert mode_names(BEARINGS["ringed"], shapes_with(journal, ring)) == (other,)


@pytest.mark.parametrize(
    ("kind", "journal", "parts", "disk"),
    [("floating ring", 0.2, 1.0, 2.1), ("floating ring", 0.9, 1.0, 2.1), ("ringed", 0.2, 1.0, 0.6)],
)
def test_a_mode_in_which_the_disk_moves_far_is_the_rotors(kind, journal, parts, disk):
    bearing = (RINGS | BEARINGS)[kind]
    assert mode_names(bearing, shapes_with(journal, parts, disk)) == ("",)
    assert mode_names(bearing, shapes_with(journal, parts, 0.4)) != ("",)


def test_pads_beside_a_journal_at_rest_do_not_name_the_bending_shaft():
    machine = replace(SHEET, bearing=replace(SHEET.bearing, geometry=TiltingPads()))
    values, names = named(machine, 600.0)
    bending = [name for value, name in zip(values, names, strict=True) if value.imag > 1.0]
    assert set(bending) == {""}
    assert set(names) == {"", "pads"}


@pytest.mark.parametrize("speed", [500.0, 2000.0])
def test_the_whirl_of_the_outer_film_is_named_and_that_of_the_inner_one_is_not(speed):
    values, names = named(MACHINE, speed)
    whirl = ring_whirl(MACHINE, speed)
    for ratio, name in (
        (whirl.outer_whirl_ratio, "ring in the outer film"),
        (whirl.inner_whirl_ratio, ""),
    ):
        assert names[int(np.argmin(np.abs(values.imag - ratio)))] == name


@pytest.mark.parametrize("name", ["finite floating ring", "floating ring, heavy"])
def test_the_mode_at_the_outer_films_onset_is_the_ring_in_that_film(name):
    machine = replace(SHEET, bearing=RINGS[name], rotor=ROTORS["massless journals"])
    outer = mode_onsets(machine)[1]
    values, names = named(machine, outer.speed)
    assert (
        names[int(np.argmin(np.abs(values - 1j * outer.whirl_ratio)))] == "ring in the outer film"
    )


def test_no_mode_of_a_film_without_parts_has_a_name():
    for name in ("short", "lossy"):
        assert set(named(replace(SHEET, bearing=BEARINGS[name]), 600.0)[1]) == {""}


def test_tables_and_files_name_the_modes_of_the_ring():
    shown = Computed(replace(SHEET, bearing=RINGS["floating ring"]), 600.0, 1000.0)
    locus = shown.locus(True)
    place = locus.moving.index("ring in the outer film")
    assert locus.name(place) == f"mode {place + 1}, ring in the outer film"
    assert "| Moving part | " in table(locus, SI)
    assert f"# Mode {place + 1} at the running speed,ring in the outer film" in (
        export.sweep_csv(shown, SI).decode()
    )
    head = export.sweep_csv(shown, SI).decode().splitlines()
    assert any("Ring's speed [rpm],Inner film: eccentricity ratio ε [-]" in line for line in head)
    page = report.report(shown, [], SI, "link", Labels()).decode()
    assert f"<td>{place + 1}, ring in the outer film</td>" in page
    plain = Computed(SHEET, 600.0, 1000.0).locus(True)
    assert "Moving part" not in table(plain, SI)
    assert plain.name(0) == "mode 1"
