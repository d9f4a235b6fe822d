"""A floating ring on the pages: its films, its two whirls, and what is said beyond their onsets."""

import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc import bifurcation
from rotorcalc.figures import orbits
from rotorcalc.figures import ring as figures
from rotorcalc.nonlinear.continuation import AT_REST
from rotorcalc.numerics.roots import HiddenRootError
from rotorcalc.units import SI
from tests.app.session import (
    HOME,
    NOTES,
    ORBITS,
    charts,
    faults,
    open_part,
    texts,
    tours,
    visit,
)
from ui import ring
from ui.bearing import defaults_of
from ui.computed import Computed, computed_from
from ui.format import amount
from ui.inputs import PRESET_VALUES
from ui.notes import ring as notes
from ui.results.table import RESULTS
from ui.sharing.report_charts import sections
from ui.words import limit_cycles, on_demand, verdict
from ui.words import ring as words

EQUILIBRIUM, STABILITY = "pages/1_Equilibrium.py", "pages/3_Stability.py"
RINGED = {"bearing": "floating-ring"}


def shown(**values: float | str) -> Computed:
    sheet = PRESET_VALUES["sheet-1e8"]
    return computed_from(sheet | defaults_of("floating-ring", sheet) | values)  # type: ignore[operator]


def said(at: AppTest) -> str:
    return "\n".join(texts(at))


def test_both_films_stand_on_the_equilibrium_page_of_a_ring_alone() -> None:
    assert any(tab.label == "Ring" for tab in visit(EQUILIBRIUM, **RINGED).get("tab"))
    assert not any(tab.label == "Ring" for tab in visit(EQUILIBRIUM).get("tab"))
    found, plain = shown(film="short"), computed_from(PRESET_VALUES["sheet-1e8"])
    own = [one for one in RESULTS.values() if one.belongs(found) and not one.belongs(plain)]
    assert len(own) == 6
    assert all(math.isfinite(one.value(found)) and math.isnan(one.value(plain)) for one in own)
    assert {one.cited(found) for one in own} == {
        "Torques on the ring", "Two plain films in series", "The thinner film",
    }  # fmt: skip
    C, C_o = 60e-6, 150e-6
    eps, h = ({key: RESULTS[f"{key}_{what}"].value(found) for key in ("inner", "outer")}
              for what in ("eccentricity", "film"))  # fmt: skip
    assert h["inner"] == pytest.approx(C * (1.0 - eps["inner"]), rel=1e-9)
    assert h["outer"] == pytest.approx(C_o * (1.0 - eps["outer"]), rel=1e-9)


@pytest.mark.parametrize("film", ["short", "finite"])
def test_both_onsets_agree_with_the_verdict_which_points_to_the_orbits(film: str) -> None:
    unstable = shown(film=film, rpm=20000.0, rpm_max=40000.0)
    table = words.whirls(unstable, SI).words
    onset = RESULTS["onset_speed"].shown(unstable, SI).removesuffix(" rpm")
    assert f"| Onset [rpm] | none found | {onset} |" in table
    assert "limit cycle" in table
    assert "has not been computed yet" in table
    told = verdict.verdict(unstable, SI)
    assert told.level == "unstable"
    assert told.sentence.endswith(words.BEYOND)
    whirl = re.search(r"whirls at (\d+) rpm", told.sentence)
    assert whirl is not None
    assert f" {whirl[1]} |" in table
    assert words.BEYOND not in verdict.verdict(shown(film=film), SI).sentence


def test_an_onset_that_rounding_hides_is_said_to_be_missing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def hidden(*_: object) -> float:
        raise HiddenRootError

    monkeypatch.setattr("rotorcalc.onset.ring_modes.narrow_root", hidden)
    for kept in (ring.whirls, ring._onsets):
        kept.cache_clear()
    computed = shown(film="short", rpm=20000.0, rpm_max=40000.0)
    told = words.whirls(computed, SI).words
    assert "| Onset [rpm] | none found | not computed |" in told
    assert "The onset of the whirl in the outer film is missing" in told
    assert "inner film is missing" not in told
    at = visit(STABILITY, **RINGED, film="short", rpm="20000")
    assert not faults(at)
    assert "outer film is missing" in said(at)
    assert not any(
        "onset" in one["name"] for one in figures.whirls(ring.whirls(computed), SI)["data"]
    )
    with pytest.raises(ValueError, match="onset = nan"):
        bifurcation(computed.machine, onset=ring.whirls(computed).onsets[1])
    for kept in (ring.whirls, ring._onsets):
        kept.cache_clear()


def test_without_load_both_whirls_are_at_their_limits_at_any_speed() -> None:
    free = ring.whirls(shown(film="short", load=0.0, mass=1e-3))
    assert [one.speed for one in free.onsets] == [0.0, 0.0]
    here = free.here
    assert float(here.inner_whirl_ratio) == pytest.approx(float(here.inner_limit), rel=1e-3)
    assert float(here.outer_whirl_ratio) == pytest.approx(float(here.outer_limit), rel=1e-3)
    table = words.whirls(shown(film="short", load=0.0, mass=1e-3), SI).words
    assert table.count("any speed") == 2


def test_the_chart_of_the_whirls_is_red_where_one_grows() -> None:
    names = {
        one["name"]
        for one in figures.whirls(ring.whirls(shown(rpm_max=40000.0)), SI)["data"]
    }  # fmt: skip
    assert {"outer film, growing", "onset, outer film"} <= names
    assert "inner film, growing" not in names


@pytest.mark.parametrize("path", [HOME, EQUILIBRIUM, STABILITY])
@pytest.mark.parametrize("query", [{"load": "0"}, {"load": "5e4"}, {"ring_mass": "12"}])
def test_pages_of_a_ring_at_the_ends_of_load_and_mass(path: str, query: dict[str, str]) -> None:
    at = visit(path, **RINGED, film="short", **query)
    for tab in tours(at) if path == EQUILIBRIUM else [""]:
        assert not at.exception, tab
        assert not faults(at) or "Sommerfeld" in said(at), tab


def test_orbits_follow_a_ring_on_films_of_finite_length_once_asked() -> None:
    at = visit(ORBITS, **RINGED)
    assert not at.error
    assert re.search(r"tabulated once .* about \d+ s", said(at)), said(at)
    assert not re.search(r"tabulated once .*(\bpad|preload)", said(at))
    at.button(key="orbits_slow_release").click().run()
    assert set(charts(at)) == {"chart_orbits_path", "chart_orbits_time"}
    assert not faults(at)
    open_part(at, "orbits_tab", "Limit cycles")
    assert any(button.key == "orbits_cycles" for button in at.button)
    assert re.search(r"size of these cycles .* about 45\s+s", said(at)), said(at)


def test_the_misprint_of_the_two_whirls_is_shown_by_eigenvalues() -> None:
    rows = [line.split("|")[2:-1] for line in notes.whirls().splitlines()[2:]]
    assert len(rows) == 3
    for r, inner, half_of_both, outer, half_of_ring, printed in (
        [*map(float, row)] for row in rows
    ):
        assert (
            inner
            == pytest.approx(half_of_both, abs=2e-5)
            == pytest.approx(0.5 * (1.0 + r), abs=2e-5)
        )
        assert outer == pytest.approx(half_of_ring, abs=2e-5)
        assert abs(outer - printed) > 0.3
    at = visit(NOTES, tab="Misprints")
    assert notes.whirls() in said(at)


def test_the_limit_cycle_of_a_ring_is_told_with_its_sizes_and_its_frequency() -> None:
    computed = shown(film="short", rpm=18200.0, rpm_max=40000.0, u=0.0)
    asked = limit_cycles.branch_of(computed)
    assert asked.onset == ring.onsets(computed)[0]
    assert asked.highest == 1.5
    branch = bifurcation(asked.machine, onset=asked.onset, highest=1.003)
    cycle = branch.held_at(computed.speed)
    assert cycle is not None
    (told,) = limit_cycles.held(branch, computed.speed, SI)
    journal, ring_goes = (1e6 * one for one in (cycle.amplitude, cycle.inner_amplitude))
    words = re.search(r"journal up to ([\d.]+) µm and the ring up to ([\d.]+) µm", told)
    assert words is not None
    assert [float(one) for one in words.groups()] == pytest.approx([journal, ring_goes], rel=1e-3)
    assert "has no cycle" in limit_cycles.held(branch, 0.5 * computed.speed, SI)[0]
    # Where another whirl grows about the cycle it is said.
    two = replace(branch, stable=~branch.stable, beats=~branch.beats)
    assert "a second whirl" in limit_cycles.held(two, computed.speed, SI)[0]
    # Beyond the last cycle none was looked for, unless there the branch came to rest.
    assert "followed up to" in limit_cycles.held(branch, 1.1 * computed.speed, SI)[0]
    gone = replace(branch, ended=AT_REST)
    assert "has no cycle" in limit_cycles.held(gone, 1.1 * computed.speed, SI)[0]
    # Two sweeps, as the machine rests below this onset, and the ring's own line.
    chart = orbits.cycles(branch, on_demand.swept(branch, computed), computed.speed, SI)
    assert next(one["name"] for one in chart["data"]).startswith("the ring")
    early = replace(branch, hopf=replace(branch.hopf, speed=1.1 * branch.hopf.speed))
    assert on_demand.begins_at_rest(branch, computed)
    assert on_demand.swept(early, computed) is None
    plain = orbits.cycles(early, None, computed.speed, SI)
    assert not any("slowly" in one["name"] for one in plain["data"])


def test_a_whirl_that_persists_below_a_supercritical_onset_is_not_said_to_die_out_there(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    computed = shown(film="short", rpm=6000.0)
    branch = bifurcation(computed.machine, lowest=0.999, highest=1.001)
    onset = computed.onset.speed
    told: list[str] = []
    shows = SimpleNamespace(info=told.append, warning=told.append, caption=lambda _: None)
    monkeypatch.setattr(on_demand, "st", shows)

    def say(*shares: float) -> str:
        found = replace(
            branch,
            hopf=replace(branch.hopf, speed=onset, lyapunov=-1.0, lyapunov_error=0.1),
            speed=onset * np.array(shares),
            amplitude=1e-6 * np.arange(1.0, len(shares) + 1.0),
        )
        on_demand.say_cycles(found, computed, SI)
        return told[-1]

    assert "dies out as the speed falls below the onset" in say(1.01, 1.02, 1.03)
    # Parabolas whose tops are 1 % above the onset and 10 % below it.
    for told_of in (say(1.01, 1.0, 0.91, 0.90, 0.91), say(1.01, 1.02, 1.01, 0.91, 0.90, 0.91)):
        assert "dies out" not in told_of
        assert f"persists down to {amount(SI.speed, 0.9 * onset)}, 10 % below the onset" in told_of
    told_of = say(1.01, 1.0, 0.95)
    assert "dies out" not in told_of
    assert f"down to below {amount(SI.speed, 0.95 * onset)}, the end of the branch" in told_of


def test_cycles_known_farther_than_needed_are_not_followed_anew(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    fast = shown(film="short", rpm=39000.0, rpm_max=40000.0)
    assert limit_cycles.branch_of(fast).highest == 3.0
    far = SimpleNamespace(known=lambda *asked: "known" if asked[-1] in {1.5, 4.0} else None)
    monkeypatch.setattr(limit_cycles, "followed", far)
    assert limit_cycles.branch_of(fast).highest == 4.0
    assert limit_cycles.known(fast) == "known"


def test_the_whirls_page_tells_the_cycle_of_whichever_branch_holds_at_the_speed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    computed = shown(film="short", rpm=20000.0, rpm_max=40000.0)
    [outer] = ring.onsets(computed)
    inner = replace(outer, mode="inner film")
    at = computed.speed
    cycle = SimpleNamespace(
        amplitude=4e-5, inner_amplitude=9e-5, whirl_frequency=0.5 * at, thinnest=0.3
    )
    yes, no = np.array([True, True]), np.array([False, False])
    # The chosen whirl's cycles end below the speed, and another whirl grows about some of them.
    ends = SimpleNamespace(
        speed=at * np.array([0.8, 0.9]), stable=no, beats=yes, ended=AT_REST,
        held_at=lambda _: None,
    )  # fmt: skip
    holds = SimpleNamespace(
        speed=at * np.array([0.9, 1.2]), stable=yes, beats=~no, ended="", held_at=lambda _: cycle
    )
    known = {"outer film": ends, "inner film": holds}
    monkeypatch.setattr(ring, "onsets", lambda _: (outer, inner))
    kept = SimpleNamespace(known=lambda _, onset, __: known[onset.mode])
    monkeypatch.setattr(limit_cycles, "followed", kept)
    told = words._cycle(computed, SI)
    assert told.startswith("At 20000 rpm the limit cycle takes the journal up to 40 µm")
    assert "dashed" not in told
    known["inner film"] = None
    assert words._cycle(computed, SI) == (
        "None of the limit cycles followed so far reaches 20000 rpm."
    )
    known["outer film"] = None
    assert "has not been computed yet" in words._cycle(computed, SI)


def test_the_report_says_that_closed_forms_miss_the_onset_of_a_ring() -> None:
    plain = computed_from(PRESET_VALUES["sheet-1e8"])
    for machine, misses in ((shown(), True), (plain, False)):
        (figure,) = [one for one in sections(machine)["Stability"] if one.key == "threshold"]
        assert ("closed forms neglect" in figure.words(machine)) == misses
