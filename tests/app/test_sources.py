"""Of a film's equations pages cite those alone that the film itself names."""

import re
from collections.abc import Iterator
from dataclasses import replace

import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc.films import film_of
from rotorcalc.units import SI
from tests.app.session import (
    BEARINGS_PAGE,
    HOME,
    NOTES,
    ORBITS,
    PAGES,
    YOUR_DATA,
    faults,
    session_of,
    texts,
    tours,
    visit,
)
from tests.app.test_bearings import EVERYWHERE, SPEED, TOP, machine, query, refusal
from tests.films.models import BEARINGS, FINITE, MOVING, PADS, RINGS, SHORT_PADS
from tests.machines import SHEET
from ui.computed import Computed
from ui.inputs import machine_of, values_of
from ui.results.table import RESULTS
from ui.sharing import report
from ui.sharing.labels import Labels
from ui.words.citation import cited

# Balance of forces, definitions, the rotor's equations: they hold on any film.
ON_ANY_FILM = {
    "5.1", "5.3", "5.4", "5.14", "5.32", "5.38", "5.42", "5.45", "5.46", "5.47", "5.50",
}  # fmt: skip
# What holds of a short film in a circular bore alone, whatever it is cited from.
SHORT_ALONE = ("parabola", "C(1 − ε)", "calculation sheet. ", "clearance circle in")
# A name with its index as a program writes it, outside TeX, HTML and links.
STABILITY = "pages/3_Stability.py"
HEAT = "pages/9_Heat.py"
RAW = re.compile(r"\b[A-Za-zα-ω]{1,2}_(?:[A-Za-z]{1,3})\b")


def numbers(text: str) -> set[str]:
    """Return all equation and figure numbers in a text."""
    cited_there = re.findall(r"(?:Eq|Fig)s?\. ((?:5\.\d+(?:, | to | and |–)?)+)", text)
    return {number for found in cited_there for number in re.findall(r"5\.\d+", found)}


def own(name: str) -> set[str]:
    """Return the numbers that a bearing's film names."""
    sources = film_of(BEARINGS[name]).sources.values()
    return {number for one in sources for number in re.findall(r"5\.\d+", one.equation)}


def told(at: AppTest, refused: list[str] | None = None) -> Iterator[str]:
    """Yield every text of a page on every tab, with each result explained and no other fault."""
    popovers = [popover.key for popover in at.get("popover") if popover.key]
    for key in popovers:
        if key.startswith("explain_"):
            at.session_state[key] = True
    for tab in tours(at):
        assert refused is None or faults(at) == refused, tab
        yield from texts(at)
        yield from (popover.proto.popover.label for popover in at.get("popover"))


def test_the_short_film_names_what_the_notes_have() -> None:
    assert {"5.5", "5.7", "5.8", "5.19", "5.25", "5.30", "5.35", "5.37", "5.48"} < own("short")
    assert own("sprung") == own("ringed") == set()


# Films that feed no synchronous whirl.
STEADY = {"sprung", "tilting pads"}


@pytest.mark.usefixtures("coarse_maps")
@pytest.mark.parametrize("path", [page for page in PAGES if page != NOTES])
@pytest.mark.parametrize("name", EVERYWHERE)
def test_every_page_shows_every_film_and_cites_only_what_it_names(path: str, name: str) -> None:
    at = visit(path, **query(name))
    assert machine_of(session_of(at).values).bearing == BEARINGS[name]
    assert not at.warning or path != HOME
    said = list(told(at, []))
    assert any(refusal(path, name) in text for text in said)
    wrong = {text: strange for text in said if (strange := numbers(text) - ON_ANY_FILM - own(name))}
    assert wrong == {}
    if name != "short":
        assert [text for text in said if any(words in text for words in SHORT_ALONE)] == []
    # Orbits need a force in any motion; without one they say so and show nothing to cite. Nor do
    # the notes have an onset on a film known by its impedance alone or on pads that never whirl, or
    # a balance of heat.
    uncited = {
        BEARINGS_PAGE: True, HEAT: True, YOUR_DATA: True, ORBITS: name not in MOVING,
        STABILITY: name in {"lossy", *PADS},
    }  # fmt: skip
    assert any(numbers(text) for text in said) or uncited.get(path)


@pytest.mark.parametrize("load", ["0", "2000"])
@pytest.mark.parametrize("name", EVERYWHERE)
def test_no_verdict_cites_what_the_film_does_not_name(name: str, load: str) -> None:
    # The verdict is the same on every page; what modes are called without load is not.
    for path in (HOME, "pages/4_Root_locus.py") if load == "0" else (HOME,):
        said = list(told(visit(path, **query(name) | {"load": load})))
        assert {text for text in said if numbers(text) - ON_ANY_FILM - own(name)} == set()


@pytest.mark.parametrize("name", BEARINGS)
def test_the_report_cites_what_the_film_names(name: str) -> None:
    shown = Computed(machine(name), SPEED, TOP)
    page = report.report(shown, [], SI, "link", Labels()).decode()
    text = page[: page.index("<script>")]
    assert numbers(text) - ON_ANY_FILM - own(name) == set()
    # The films made for the tests know nothing of pressure, flow or drag.
    gives_all = name in {"short", "hydrostatic", *FINITE, *SHORT_PADS, *RINGS, *PADS}
    assert ("The model of this bearing&#x27;s film does not give it." in text) == (not gives_all)
    assert ("This film cannot whirl" in text) == (name == "sprung")
    assert ('id="power"' in text) == gives_all
    assert ('id="threshold"' in text) == (name not in STEADY)
    assert ("Whatever its load, this film feeds no whirl" in text) == (name in STEADY - {"sprung"})


@pytest.mark.parametrize("path", [page for page in PAGES if page != NOTES])
def test_names_with_an_index_are_typeset(path: str) -> None:
    at = visit(path)
    said = [text for _ in tours(at) for text in texts(at) if text not in _tex(at)]
    plain = (re.sub(r"\$[^$]*\$|`[^`]*`|%\{[^}]*\}", "", text) for text in said)
    assert [text for text in plain if RAW.search(text)] == []


def _tex(at: AppTest) -> set[str]:
    """Return the equations shown on lines of their own."""
    return {one.value for one in (*at.latex, *at.markdown) if one.value.startswith(("$$", "\\"))}


def test_metrics_have_a_true_minus() -> None:
    at = visit(HOME, preset="sheet-1e7", rpm="8000")
    values = [metric.value for metric in at.metric]
    assert any("−" in value for value in values)
    assert not [value for value in values if re.search(r"-\d", value)]


@pytest.mark.parametrize(
    ("rotor", "label"),
    [
        ({}, "Eq. 5.50"),
        ({"disk_damping": 2000.0}, "Eigenvalues"),
        ({"journal_mass": 5.0}, "Force balance"),
    ],
)
def test_an_onset_is_labelled_by_what_was_solved(rotor: dict[str, float], label: str) -> None:
    shown = Computed(replace(SHEET, rotor=replace(SHEET.rotor, **rotor)), SPEED, TOP)
    assert RESULTS["onset_speed"].cited(shown) == label
    at = visit(HOME)
    session_of(at).values = values_of(shown.machine, SPEED, TOP)
    at.session_state["explain_onset_speed"] = True
    at.run()
    labels = [popover.proto.popover.label for popover in at.get("popover")]
    assert label in labels
    assert ("Eq. 5.50" in labels) == (rotor == {})


def test_a_refused_journal_mass_is_named_in_words() -> None:
    (warning,) = [box.value for box in visit(HOME, mj="200", mass="300").warning]
    assert warning.startswith("Journal mass Mⱼ = 200 kg: must be less than half")


def test_citations_are_joined_by_kind_and_sorted() -> None:
    shown = Computed(SHEET, SPEED, TOP)
    assert cited("A.", shown, "attitude", "eccentricity") == "A. Eqs. 5.7, 5.8."
    assert cited("A.", shown, "force") == "A. Eqs. 5.5, 5.6, Fig. 5.2."
    assert cited("", shown, "pressure") == "Eq. 5.25."
    assert cited("A.", shown, "drag", "flow") == "A. The notes' calculation sheet."
    assert cited("A.", shown, "unheard of", rotor="Eqs. 5.45 to 5.50") == "A. Eqs. 5.45 to 5.50."
    assert cited("A.", Computed(machine("sprung"), SPEED, TOP), "attitude") == "A."
