"""Sentences that depend on what the machine has."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import CoefficientTable, thresholds
from rotorcalc.units import SI
from tests.app.test_bearings import SPEED, TOP
from tests.films.models import BEARINGS
from tests.machines import SHEET
from ui.bearing import defaults_of
from ui.computed import Computed, computed_from
from ui.format import amount
from ui.inputs import PRESET_VALUES, values_of
from ui.results.table import RESULTS
from ui.words import citation, root_locus, stability, validity, verdict


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


@pytest.mark.parametrize(
    ("onset", "frequency", "ends"),
    [
        (0.0, 0.0, "range of whirl, which begins at the slowest speed searched."),
        (math.nan, math.nan, "at which it becomes unstable could not be computed."),
        (100.0, math.nan, "range of whirl, which begins at {}."),
        (900.0, 0.0, "it becomes unstable at {}, 50 % above."),
        (100.0, 50.0, "begins at {}, where it whirls at 477.5 rpm (7.958 Hz), 0.5 of that speed."),
    ],
)
def test_an_onset_without_a_number_is_told_without_one(
    monkeypatch: pytest.MonkeyPatch, onset: float, frequency: float, ends: str
) -> None:
    computed = computed_from(values_of(SHEET, 600.0, TOP))
    assert computed.is_stable
    found = replace(computed.onset, speed=onset, whirl_frequency=frequency)
    monkeypatch.setattr("ui.computed._onset", lambda *_: found)
    told = verdict.verdict(computed, SI).sentence
    assert told.endswith(ends.format(amount(SI.speed, onset)))
    assert "nan" not in told
    assert " 0 rpm" not in told


def test_where_the_search_ended_at_a_speed_no_word_claims_more() -> None:
    values = PRESET_VALUES["sheet-1e8"]
    pads = computed_from(values | defaults_of("tilting-pads", values))
    told = verdict.verdict(pads, SI).sentence
    limit = amount(SI.speed, pads.onset.searched_to)
    assert told.endswith(f"no whirl up to {limit}, the highest speed searched.")
    assert citation.without_onset(pads).startswith("Up to the highest speed searched")
    crossing = root_locus.crossing(pads, pads.onset, SI)
    assert crossing == "No mode crosses the imaginary axis, up to the highest speed searched."
    at_onset = [result.shown(pads, SI) for result in RESULTS.values() if result.at_onset]
    assert {*at_onset} == {"not found"}
    # A film that cannot whirl proves it.
    proved = replace(SHEET, rotor=replace(SHEET.rotor, disk_damping=1e5))
    never = computed_from(values_of(proved, SPEED, TOP))
    assert math.isinf(never.onset.searched_to)
    assert "no speed makes this machine whirl" in verdict.verdict(never, SI).sentence


@pytest.mark.parametrize("speed", [0.8, 1.2, 4.0])
@pytest.mark.parametrize("decays", [False, True])
def test_the_orbit_of_the_onset_decides_only_where_the_growth_rate_does_not_deny_it(
    speed: float, decays: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    onset = shown().onset.speed
    machine = replace(SHEET, bearing=BEARINGS["short"])
    case = computed_from(values_of(machine, speed * onset, max(TOP, speed * onset)))
    found = stability.energies(case)
    lost = found.here.fed_in * (1.1 if decays else 0.9)
    here = replace(found.here, film_loss=lost, disk_loss=0.0 * lost)
    monkeypatch.setattr(stability, "energies", lambda _: replace(found, here=here))
    words = stability.balance(case, SI)
    assert ("the whirl" in words) == (decays == case.is_stable)
    assert ("the whirl decays" in words) == (decays and case.is_stable)
    assert ("on this orbit, that of the onset" in words) == (decays != case.is_stable)


def test_the_caption_of_the_energies_says_no_more_than_the_chart(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    case = shown()
    assert case.onset.speed < case.top_speed
    assert "past the onset more is fed in" in stability.energies_over_speed(case)
    found = stability.energies(case)
    over = replace(found.over, fed_in=0.5 * found.over.fed_in)
    monkeypatch.setattr(stability, "energies", lambda _: replace(found, over=over))
    assert "the orbit of the onset, where the two meet" in stability.energies_over_speed(case)
    assert "more is fed in" not in stability.energies_over_speed(case)


def test_the_headline_names_the_worst_assumption_and_counts_the_others() -> None:
    soft = computed_from(PRESET_VALUES["sheet-1e7"])
    assert validity.headline(soft) == "Model strained: static sag over clearance and 1 more"
    assert validity.headline(computed_from(PRESET_VALUES["sheet-1e8"])) == "Model strained: heat"


def test_a_negative_stiffness_leaves_no_critical_mass() -> None:
    K, C = ((-1e7, 1e7), (-1e7, -1e7)), ((1e5, 0.0), (0.0, 1e5))
    own = CoefficientTable(speed=(100.0, 2000.0), stiffness=(K, K), damping=(C, C))
    case = Computed(replace(SHEET, bearing=own), 600.0, 1000.0)
    assert float(case.point.equivalent_stiffness) < 0.0 < float(case.point.whirl_ratio)
    for key in ("critical_mass", "rigid_critical_mass"):
        assert RESULTS[key].shown(case, SI) == "none"
        assert RESULTS[key].filled(case) == r"\text{none, as }K_{eq}<0"
    assert math.isnan(float(case.point.critical_mass))
    ratios = thresholds.at_each_speed(case.sweep)
    assert np.all(ratios.rigid_mass_ratio == 0.0)
    assert np.all(ratios.flexible_mass_ratio == 0.0)


def test_pads_without_cross_coupling_are_fed_nothing() -> None:
    values = PRESET_VALUES["sheet-1e8"]
    heavy = {"preload": 0.0, "mass": 5000.0, "rpm": 60000.0, "rpm_max": 80000.0}
    pads = computed_from(values | defaults_of("tilting-pads", values) | heavy)
    assert 0.0 < pads.onset.speed < math.inf
    words = stability.balance(pads, SI)
    assert "cross-coupling feeds nothing in, and damping brakes it" in words
    assert "times" not in words
    assert "on this orbit" in words or ("the whirl decays" in words) == pads.is_stable
    assert "more is fed in" not in stability.energies_over_speed(pads)
