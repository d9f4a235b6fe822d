"""Sentences that depend on what the machine has."""

import math
from dataclasses import replace

import pytest

from tests.app.test_bearings import SPEED, TOP
from tests.films.models import BEARINGS
from tests.machines import SHEET
from ui.computed import Computed, computed_from
from ui.inputs import values_of
from ui.words import stability


def shown(bearing: str = "short", **rotor: float) -> Computed:
    machine = replace(SHEET, bearing=BEARINGS[bearing])
    machine = replace(machine, rotor=replace(machine.rotor, **rotor))
    return computed_from(values_of(machine, SPEED, TOP))


@pytest.mark.parametrize("bearing", ["short", "preloaded"])
def test_closed_forms_that_hold_need_no_notice(bearing: str) -> None:
    computed = shown(bearing, disk_damping=0.0, journal_mass=0.0)
    assert stability.bare(computed) is None
    assert stability.crossing(computed).closed_form


@pytest.mark.parametrize(
    ("bearing", "rotor", "named"),
    [
        ("short", {"disk_damping": 500.0}, ["midspan damping"]),
        ("short", {"journal_mass": 5.0}, ["journal mass"]),
        (
            "short",
            {"disk_damping": 500.0, "journal_mass": 5.0},
            ["midspan damping", "journal mass"],
        ),
        ("ringed", {}, ["coefficients change with the whirl's frequency"]),
        ("lossy", {}, ["coefficients change with the whirl's frequency"]),
    ],
)
def test_a_notice_names_what_the_closed_forms_neglect_and_no_more(
    bearing: str, rotor: dict[str, float], named: list[str]
) -> None:
    notice = stability.bare(shown(bearing, **{"disk_damping": 0.0, "journal_mass": 0.0} | rotor))
    assert notice is not None
    every = ["midspan damping", "journal mass", "coefficients change with the whirl's frequency"]
    assert [words for words in every if words in notice.words] == named


def test_a_rigid_rotors_journal_mass_is_part_of_its_mass() -> None:
    rigid = shown(shaft_stiffness=math.inf, journal_mass=5.0, disk_damping=0.0)
    assert stability.bare(rigid) is None


@pytest.mark.parametrize("bearing", ["ringed", "lossy"])
def test_no_end_of_whirl_is_read_from_coefficients_at_another_frequency(bearing: str) -> None:
    computed = shown(bearing)
    assert "none above" not in stability.ends_of_whirl(computed)
    assert stability.lowest_threshold(computed) == ""
    assert stability.film_figure(computed).limit is None
