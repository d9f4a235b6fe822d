"""Criteria, a floating ring's films and recesses in the report, as they are on the pages."""

import html
import re

import pytest

from rotorcalc.criteria import checks
from rotorcalc.units import SI, US, rpm
from ui import criteria
from ui.computed import computed_from
from ui.format import amount
from ui.sharing import address, report
from ui.sharing.labels import Labels
from ui.sharing.report_charts import CRITERIA, RECESSES, RING, charts, sections

CHOSEN = {
    criteria.COUPLING: "stages", criteria.STAGES: "1000_400_20_1.5_c~800_400_20_1_a",
    criteria.SLOWEST: "3000", criteria.GRADE: "G 2.5",
}  # fmt: skip


def text_of(chosen, units=SI, **query):
    """Return a machine, and the text of its report without scripts."""
    shown = computed_from(address.read(query).values)
    page = report.report(shown, [], units, "link", Labels(), chosen).decode()
    return shown, html.unescape(re.sub("<[^>]+>", "|", page[: page.index("<script>")]))


@pytest.mark.parametrize("units", [SI, US], ids=["SI", "US"])
def test_the_report_has_every_criterion_with_its_number_and_what_was_asked(units):
    shown, text = text_of(CHOSEN, units, preset="sheet-1e7")
    asked = criteria.asked_of(CHOSEN)
    Q_A = asked.cross_coupling(shown)
    found = checks(shown.machine, shown.speed, minimum_speed=3000 * rpm, cross_coupling=Q_A,
                   grade="G 2.5")  # fmt: skip
    assert amount(units.stiffness, Q_A) in text
    assert text.count("|✗ not met|") == sum(one.passed is False for one in found)
    for one in found:
        assert f"{one.source}." in text
        if one.kind != "number" and not one.unjudged:
            assert f"|{amount(getattr(units, one.kind), one.value)}|" in text
    assert "Stage 2" in text
    assert "ISO 20816" in text


def test_the_reports_charts_of_criteria_are_the_pages():
    shown = computed_from(address.read({"preset": "sheet-1e7"}).values)
    asked = criteria.asked_of(CHOSEN)
    keys = [figure.key for figure in sections(shown, asked)[CRITERIA]]
    assert keys == ["level_one", "critical_speeds", "campbell"]
    drawn = charts(shown, [], SI, asked)["level_one"]["data"]
    mark = next(one for one in drawn if "at Q" in one["name"] and one["mode"] == "markers")
    assert mark["x"][0] == pytest.approx(1e-6 * asked.cross_coupling(shown))


@pytest.mark.parametrize(
    ("chosen", "said"),
    [
        ({criteria.FASTEST: "abc"}, "Maximum speed: is not a number; instead"),
        ({criteria.SLOWEST: "9000"}, "Minimum speed = 9000 rpm: must be at most"),
    ],
)
def test_what_cannot_be_used_is_named_and_nothing_taken_for_it_in_silence(chosen, said):
    _, text = text_of(chosen)
    assert said in text
    assert "instead, for the running speed alone" in text


def test_a_refused_analysis_is_named(monkeypatch):
    def refuse(*_, **__):
        raise ValueError("no mode was found at 628.318531 rad/s")

    monkeypatch.setattr(criteria, "_checks", refuse)
    monkeypatch.setattr(criteria, "_level", refuse)
    _, text = text_of({})
    assert "Not judged: no mode was found at 6000 rpm." in text
    assert "Left out: Level one. no mode was found" in text


@pytest.mark.parametrize(
    ("kind", "title", "number"), [("floating-ring", RING, 4), ("hydrostatic", RECESSES, 2)]
)
def test_a_bearings_own_charts_are_in_its_report_alone(kind, title, number):
    shown, text = text_of({}, bearing=kind, film="" if kind == "hydrostatic" else "short")
    plain, without = text_of({})
    assert f"|{title}|" in text
    assert f"|{title}|" not in without
    keys = [figure.key for figure in sections(shown)[title]]
    assert len(keys) == number
    drawn = charts(shown, [], US)
    for key in keys:
        assert drawn[key]["data"]
        assert drawn[key]["layout"]["width"] in (334, 680)
    assert not {*keys} & charts(plain, [], SI).keys()
