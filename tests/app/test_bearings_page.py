"""The page Bearings: every kind on this machine, in a table, in words, and to take over."""

import math
import re
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from types import SimpleNamespace

import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc import compare_bearings
from rotorcalc.comparison import KINDS, BearingResult
from rotorcalc.machine import Supply
from rotorcalc.units import SI, US
from tests.app.session import BEARINGS_PAGE, faults, session_of, visit
from ui.bearing import defaults_of
from ui.bores import NAMES
from ui.inputs import PRESET_VALUES, machine_of, speeds_of
from ui.session import Session
from ui.words import bearings as words

SHEET = PRESET_VALUES["sheet-1e8"]
HEAVY = {"load": "2e6", "D": "30", "L": "10", "C": "200"}


def table(at: AppTest) -> dict[str, list[object]]:
    """Return the columns of the table, none where a cell is empty."""
    (found,) = at.dataframe
    return {
        label: [None if isinstance(cell, float) and math.isnan(cell) else cell for cell in column]
        for label, column in found.value.items()
    }


def computed(visitor: Session) -> list[BearingResult]:
    machine, (speed, _) = machine_of(visitor.values), speeds_of(visitor.values)
    return list(compare_bearings(machine, speed=speed))


@pytest.mark.parametrize(("units", "system"), [("SI", SI), ("US", US)])
def test_the_table_has_every_kind_in_the_units_shown(units: str, system: object) -> None:
    at = visit(BEARINGS_PAGE, units=units, C="80")
    shown, expected = table(at), computed(session_of(at))
    assert shown["Bearing"] == ["This machine", *(NAMES[geometry.kind] for geometry in KINDS)]
    assert any("(plain circular, short bearing)" in one.value for one in at.caption)
    for label, kind, name in (
        ("Onset", "speed", "onset"),
        ("Margin", "percent", "margin"),
        ("Whirl", "number", "whirl_ratio"),
        ("Log dec.", "number", "log_decrement"),
        ("h min", "film", "minimum_film_thickness"),
        ("Power", "power", "power_loss"),
        ("Flow", "flow", "side_flow"),
        ("Peak", "amplitude", "peak_response"),
    ):
        unit = getattr(session_of(at).units, kind)
        (column,) = (key for key in shown if key.startswith(label))
        assert unit.name == "-" or f"[{unit.name}]" in column
        values = [float(unit.of(getattr(one, name))) for one in expected]
        if label == "Whirl":
            assert 0.0 in values  # as of tilting pads, whose film feeds no whirl
            values = [value or math.nan for value in values]
        for cell, value in zip(shown[column][1:], values, strict=True):
            assert cell == (pytest.approx(value, rel=1e-12) if math.isfinite(value) else None)
    assert faults(at) == []


def test_every_row_has_a_picture() -> None:
    shown = table(visit(BEARINGS_PAGE))
    pictures = [str(one) for one in shown["Bore"]]
    assert all(one.startswith("data:image/svg+xml;base64,") for one in pictures)
    # Bores of two kinds look different; the machine's own is a plain one.
    assert len(set(pictures)) == len(KINDS)


@pytest.mark.parametrize("kind", [kind for kind in NAMES if kind != "plain"])
def test_a_bearing_is_taken_over_and_given_back(kind: str) -> None:
    at = visit(BEARINGS_PAGE, D="120", load="4000")
    before = dict(session_of(at).values)
    at.button(key=f"use_{kind}").click().run()
    machine = machine_of(session_of(at).values)
    expected = replace(machine.bearing, diameter=0.120, film=None)
    assert machine.bearing == expected
    if kind != "foil":  # which takes air
        assert machine == replace(machine_of(before), bearing=expected)
    assert machine.bearing.geometry.kind == kind
    assert session_of(at).link()["bearing"] == kind
    assert "film" not in session_of(at).link()
    assert at.button(key=f"use_{kind}").disabled
    assert at.selectbox(key="bearing_kind").value == kind
    at.button(key="undo").click().run()
    assert session_of(at).values == before
    assert faults(at) == []


def test_a_click_in_the_table_takes_its_bearing_over(monkeypatch: pytest.MonkeyPatch) -> None:
    at = visit(BEARINGS_PAGE)
    # Its own bearing, on the short film, is not among the others.
    assert table(at)["Use"] == ["", *(["Use"] * len(KINDS))]
    visitor = session_of(at)
    monkeypatch.setattr(words, "session", lambda: visitor)
    monkeypatch.setattr(words.st, "session_state", {words._CLICKED: {"row": 4}})
    words._take([one.bearing for one in computed(visitor)])
    monkeypatch.undo()
    at.run()
    kind = KINDS[4].kind
    assert session_of(at).values["bearing"] == kind
    assert table(at)["Use"] == ["", *("" if one.kind == kind else "Use" for one in KINDS)]
    assert faults(at) == []


def judged(at: AppTest) -> list[str]:
    """Return what is said of the kinds and judged by this machine's numbers."""
    lines = (line for one in at.markdown for line in one.value.split("\n\n"))
    return [line for line in lines if "-badge[" in line and "against" in line]


def test_what_is_said_of_a_kind_is_borne_out_by_the_numbers_or_not() -> None:
    at = visit(BEARINGS_PAGE)
    plain, *others = computed(session_of(at))
    later = [one for one in judged(at) if re.search("onset is (not )?higher", one)]
    claimed = [one for one in others if words._LATER in words._JUDGEMENTS[_kind(one)].claims]
    assert len(later) == len(claimed) > 0
    for said, one in zip(later, claimed, strict=True):
        assert said.startswith(":green-badge[borne out]") == (one.onset > plain.onset)
        assert ("is not higher" in said) == (one.onset <= plain.onset)
        whirls = math.isfinite(one.onset)
        own = f"{SI.speed.of(one.onset):.0f} rpm" if whirls else "none found"
        assert f"{own} against {SI.speed.of(plain.onset):.0f} rpm" in said
    (lowest,) = [one for one in judged(at) if "lowest of all" in one]
    assert ("borne out" in lowest) == (plain.onset <= min(one.onset for one in others))
    # What is not so here is denied in words too.
    assert ("is not the lowest of all" in lowest) == ("not here" in lowest)
    friction, *_ = [one for one in judged(at) if re.search("loses? less power", one)]
    assert ("borne out" in friction) == (others[0].power_loss < plain.power_loss)
    (damped,) = [one for one in judged(at) if re.search("response is (not )?lower", one)]
    assert ("borne out" in damped) == (others[2].peak_response < plain.peak_response)


def _kind(one: BearingResult) -> str:
    return one.bearing.geometry.kind


def test_a_film_without_an_answer_says_why() -> None:
    at = visit(BEARINGS_PAGE, **HEAVY)
    shown = table(at)
    assert shown["Onset [rpm]"][1:] == [None] * len(KINDS)
    assert any("No answer at this speed and load" in one.value for one in at.warning)
    reasons = [one.value for one in at.markdown if re.search("must be at (least|most)", one.value)]
    assert len(reasons) == len(KINDS)
    assert faults(at) == []


@pytest.mark.parametrize("case", [False, True])
def test_an_own_bearing_without_an_answer_leaves_the_others_theirs(case: bool) -> None:
    at = visit(BEARINGS_PAGE)
    if case:
        at.button(key="keep").click().run()
    visitor = session_of(at)
    visitor.values |= defaults_of("partial-arc", visitor.values) | {"arc": 100.0, "centre": -30.0}
    at.run()
    (said,) = [one.value for one in at.error]
    assert "no position of the journal was found" in said
    shown = table(at)
    assert shown["Bearing"][0] == "This machine: none"
    assert shown["Onset [rpm]"][0] is None
    onsets = dict(zip(shown["Bearing"], shown["Onset [rpm]"], strict=True))
    assert {name for name, onset in onsets.items() if onset is None} == {
        "This machine: none", NAMES["tilting-pads"], NAMES["foil"],
    }  # fmt: skip
    # The refusal is the machine's own: any other bearing is taken over as ever.
    at.button(key="use_elliptical").click().run()
    assert session_of(at).values["bearing"] == "elliptical"
    assert list(at.error) == []
    assert faults(at) == []


def test_without_load_a_plain_bore_whirls_at_any_speed() -> None:
    at = visit(BEARINGS_PAGE, load="0")
    assert table(at)["Onset [rpm]"][1] == 0.0
    # So do others: neither is lower.
    assert not any("lowest of all" in one for one in judged(at))
    assert faults(at) == []


def test_bearings_that_do_not_whirl_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    at = visit(BEARINGS_PAGE, bearing="elliptical", preload="0.9")
    assert table(at)["Onset [rpm]"][0] is None
    assert faults(at) == []
    # Tilting pads do not whirl here; the foil does not carry the load.
    results = computed(session_of(at))
    results[3] = replace(results[3], onset=math.inf)
    said: list[str] = []
    monkeypatch.setattr(words.st, "info", said.append)
    words.say_exceptions(results)
    assert said == ["No onset was found on: elliptical (two-lobe), tilting pads."]
    assert any("none found against" in said for said in words.here(results[3], results, SI))


def test_results_are_shown_as_they_come(monkeypatch: pytest.MonkeyPatch) -> None:
    sizes: list[int] = []
    original = words._table
    monkeypatch.setattr(
        words, "_table",
        lambda found, page, done: (sizes.append(len(found)), original(found, page, done=done)),
    )  # fmt: skip
    monkeypatch.setattr(words, "_PATIENCE", 0.0)
    at = visit(BEARINGS_PAGE, C="61.7")
    # A slow kind may be there before its turn, from another process.
    assert sizes[0] == 1
    assert sizes[:-1] == sorted(set(sizes[:-1]))
    assert sizes[-1] == len(KINDS) + 1
    assert len(sizes) >= len(KINDS) - 1
    sizes.clear()
    at.run()
    assert sizes == [len(KINDS) + 1]


@pytest.mark.parametrize("free", [True, False])
def test_the_slow_kinds_come_from_another_process_while_that_is_free(
    free: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    ordered: list[str] = []
    run = words.LONG.run

    def noted(work: object, args: tuple, tell: object) -> object:
        ordered.extend(geometry.kind for _, _, geometry in args[0])
        return run(work, args, tell)

    monkeypatch.setattr(words.LONG, "run", noted)
    monkeypatch.setattr(type(words.LONG), "is_free", free)
    at = visit(BEARINGS_PAGE, C="62.3" if free else "62.4")
    assert ordered == (list(words._SLOW) if free else [])
    shown, expected = table(at), computed(session_of(at))
    assert shown["Power [kW]"][1:-1] == pytest.approx(
        [1e-3 * one.power_loss for one in expected[:-1]]
    )
    assert faults(at) == []


def test_a_slow_first_result_is_awaited_without_looking_all_the_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    looks: list[bool] = []
    helper = threading.Thread(target=time.sleep, args=(0.35,))

    def known(*_: object) -> str | None:
        looks.append(helper.is_alive())
        return None if looks[-1] else "there"

    stand_in = SimpleNamespace(known=known, several=lambda *_: 0)
    monkeypatch.setattr(words, "_results", stand_in)
    monkeypatch.setattr(words, "_helper", lambda _: helper)
    monkeypatch.setattr(words, "_PATIENCE", 0.0)
    helper.start()
    machine, (speed, _) = machine_of(SHEET), speeds_of(SHEET)
    assert words._next(words._asked(machine, speed)[-1:]) == ["there"]
    assert len(looks) < 10


def test_what_no_result_depends_on_makes_nothing_new() -> None:
    """Without a supply of oil that is the heat that it carries; with one all depends on it."""
    visitor = session_of(visit(BEARINGS_PAGE))
    machines = [machine_of(visitor.values | {"cp": heat}) for heat in (1900.0, 2100.0)]
    one, other = (words._asked(machine, 600.0) for machine in machines)
    assert one == other
    supplied = [
        replace(each, temperature=None, supply=Supply(temperature=45.0)) for each in machines
    ]
    one, other = (words._asked(machine, 600.0) for machine in supplied)
    assert one != other


def test_other_pages_have_one_long_turn_while_rows_are_computed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    turns: list[str] = []

    @contextmanager
    def aside() -> Iterator[None]:
        turns.append("aside")
        yield
        turns.append("back")

    monkeypatch.setattr(words, "one_at_a_time", SimpleNamespace(PAGES=SimpleNamespace(aside=aside)))
    monkeypatch.setattr(words, "_PATIENCE", 60.0)
    at = visit(BEARINGS_PAGE, C="61.9")
    assert turns == ["aside", "back"]
    at.run()
    assert turns == ["aside", "back"]


def test_nothing_is_compared_while_a_slider_is_dragged(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROTORCALC_LIVE", "drag")
    visitor = session_of(visit(BEARINGS_PAGE))
    assert visitor.preview is not None
    monkeypatch.setattr(words, "_results", None)
    shown = visitor.preview.at("C", "75")
    assert shown["texts"]["dimmed_bearings"] is None
    assert shown["texts"]["said_verdict"] is not None
