"""The orbits page: demonstrations, refusals, long work on demand, words for what happened."""

import re

import pytest
from streamlit.testing.v1 import AppTest

from tests.app.session import charts, faults, open_part, session_of, visit

ORBITS = "pages/6_Orbits.py"


def said(at: AppTest) -> str:
    return " ".join(box.value for box in (*at.success, *at.info, *at.warning, *at.error))


def press(at: AppTest, key: str) -> None:
    at.button(key=key).click().run()
    assert faults(at) == []


@pytest.mark.parametrize(
    ("demo", "words"),
    [
        ("below", "returns to equilibrium|still decaying"),
        ("above", r"whirls at 0\.5\d* of the running speed.*unstable"),
        ("small", "still decaying|returns to equilibrium"),
        ("big", "up to 0.86. C.*stable.*too large"),
    ],
)
def test_demonstrations_set_up_machine_and_kick(demo: str, words: str) -> None:
    at = visit(ORBITS)
    press(at, f"orbits_{demo}")
    assert session_of(at).values["u"] == 0.0
    assert re.search(words, said(at)), said(at)
    assert set(charts(at)) == {"chart_orbits_path", "chart_orbits_time"}


def test_onset_demonstrations_keep_the_machine_and_need_an_onset() -> None:
    at = visit(ORBITS, C="80")
    press(at, "orbits_above")
    assert session_of(at).values["C"] == 80.0
    assert session_of(at).values["rpm"] == pytest.approx(1.05 * 7000, rel=0.3)
    at = visit(ORBITS, cs="100000")
    assert at.button(key="orbits_below").disabled
    assert not at.button(key="orbits_big").disabled


def test_a_kick_out_of_the_clearance_raises_a_valueerror() -> None:
    at = visit(ORBITS)
    at.slider(key="orbits_kick").set_value(1.2).run()
    assert not at.exception
    assert "film has no thickness left" in said(at)
    assert charts(at) == {}


def test_long_work_starts_on_demand_and_is_kept_until_the_machine_changes() -> None:
    at = visit(ORBITS)
    for tab, key, chart in (
        ("Run-up", "orbits_run_up", "chart_orbits_hysteresis"),
        ("Limit cycles", "orbits_cycles", "chart_orbits_cycles"),
    ):
        open_part(at, "orbits_tab", tab)
        assert charts(at) == {}
        press(at, key)
        assert set(charts(at)) == {chart}
        at.run()
        assert set(charts(at)) == {chart}
        assert not [button for button in at.button if button.key == f"{key}_cancel"]
    session_of(at).set_value("C", 61.0)
    at.run()
    assert charts(at) == {}
    assert at.button(key="orbits_cycles")


def test_a_run_up_says_what_comes_what_was_seen_and_why_whirl_is_late() -> None:
    at = visit(ORBITS, tab="Run-up")
    before = " ".join(text.value for text in at.markdown)
    assert re.search(r"rises from 8027 rpm to 9633 rpm within .* about 3\ss", before), before
    assert re.search(r"grows at 1\.\d+ 1/s.*hundredfold.*above the onset", before), before
    press(at, "orbits_run_up")
    expected = re.search(r"reaches C/10 at (\d+) rpm", before)
    seen = re.search(r"Rising, whirl shows from (\d+) rpm", said(at))
    lasts = re.search(r"Falling, it lasts down to (\d+) rpm, (\S+) % below the onset", said(at))
    assert expected, before
    assert seen, said(at)
    assert lasts, said(at)
    assert 8919 < int(seen[1]) == pytest.approx(int(expected[1]), rel=0.01)
    # The fold of the limit cycles is at 8659 rpm.
    assert 8400 < int(lasts[1]) < 8680
    (names,) = [[trace["name"] for trace in one["data"]] for one in charts(at).values()]
    assert {"speed rising ▸", "speed falling ◂", "onset, 8919 rpm"} <= set(names)
    for picture in ("Spectra rising", "Spectra falling"):
        at.segmented_control(key="orbits_picture").set_value(picture).run()
        assert set(charts(at)) == {"chart_orbits_waterfall"}
        assert faults(at) == []
    assert at.query_params == {"tab": "Run-up", "picture": "Spectra falling"}


def test_the_limit_cycles_stand_behind_a_run_up_once_computed() -> None:
    at = visit(ORBITS, tab="Run-up", C="63")
    press(at, "orbits_run_up")
    press(at, "orbits_cycles")
    (chart,) = charts(at).values()
    names = [trace["name"] for trace in chart["data"]]
    assert names[:3] == ["limit cycle, stable", "limit cycle, unstable", "speed rising ▸"]


def test_an_imbalance_that_suppresses_whirl_is_named() -> None:
    at = visit(ORBITS, tab="Run-up", balance="its own")
    press(at, "orbits_run_up")
    assert "No whirl was seen as the speed rose. The imbalance drives the journal" in said(at)


@pytest.mark.parametrize("query", [{"load": "0"}, {"cs": "100000"}])
def test_a_machine_without_an_onset_runs_to_the_top_speed(query: dict[str, str]) -> None:
    at = visit(ORBITS, tab="Run-up", **query)
    assert "from 1200 rpm to 12000 rpm" in " ".join(text.value for text in at.markdown)
    press(at, "orbits_run_up")
    assert set(charts(at)) == {"chart_orbits_hysteresis"}


def test_buttons_say_what_they_change_and_undo_brings_machine_and_release_back() -> None:
    at = visit(ORBITS, T="65")
    at.slider(key="orbits_kick").set_value(0.5).run()
    at.slider(key="orbits_revolutions").set_value(60).run()
    before = session_of(at).preset, dict(session_of(at).values)
    for name in ("below", "above", "small", "big"):
        button = at.button(key=f"orbits_{name}")
        press(at, f"orbits_{name}")
        now = session_of(at).values
        changed = {key for key in now if now[key] != before[1].get(key)}
        assert {"rpm", "u"} <= changed
        assert button.label.endswith("all") == bool(changed - {"rpm", "u"})
        assert re.search("sets (Ω, u, release|all)$", button.label)
        press(at, "orbits_undo")
        assert (session_of(at).preset, session_of(at).values) == before
        assert at.slider(key="orbits_kick").value == 0.5
        assert at.slider(key="orbits_revolutions").value == 60
    at.button(key="redo").click().run()
    assert at.slider(key="orbits_kick").value == 0.25


def test_cancel_ends_the_computation() -> None:
    at = visit(ORBITS)
    open_part(at, "orbits_tab", "Limit cycles")
    press(at, "orbits_cycles")
    session_of(at).ask_no_more("orbits_cycles")  # as the button's callback does
    at.run()
    assert charts(at) == {}
    assert at.button(key="orbits_cycles")


@pytest.mark.parametrize(
    ("query", "words"),
    [({"load": "0"}, "whirls at any speed"), ({"cs": "100000"}, "No speed makes this machine")],
)
def test_machines_without_an_onset_are_explained(query: dict[str, str], words: str) -> None:
    at = visit(ORBITS, **query)
    for tab in ("Limit cycles", "Onset three ways"):
        open_part(at, "orbits_tab", tab)
        assert faults(at) == []
        assert words in said(at)
        assert charts(at) == {}


@pytest.mark.parametrize("query", [{}, {"k": "inf"}, {"mj": "20"}, {"cs": "2000"}])
def test_three_onsets_agree_on_the_page(query: dict[str, str]) -> None:
    at = visit(ORBITS, **query)
    open_part(at, "orbits_tab", "Onset three ways")
    assert "They agree" in said(at)
    metrics = {metric.label: metric.value for metric in at.metric}
    closed = metrics["Closed form"]
    assert (closed == "no closed form") == ("cs" in query)
    assert metrics["Eigenvalues"].split(".")[0] == metrics["Measured growth in time"].split(".")[0]


def test_a_machine_with_fast_modes_is_followed_for_fewer_revolutions() -> None:
    at = visit(ORBITS, rpm="100", load="20000")
    assert faults(at) == []
    assert "only 16 revolutions are computed" in said(at)


def test_a_case_that_allows_no_release_is_left_out() -> None:
    at = visit(ORBITS, rpm="100", load="20000")
    session_of(at).keep("A")
    session_of(at).set_preset("sheet-1e8")
    at.slider(key="orbits_kick").set_value(0.9).run()
    assert not at.exception
    assert charts(at)


def test_a_computation_that_was_interrupted_says_so() -> None:
    at = visit(ORBITS)
    open_part(at, "orbits_tab", "Limit cycles")
    at.button(key="orbits_cycles").click()
    session_of(at).begun.add("orbits_cycles")
    at.run()
    assert "interrupted" not in said(at)  # asked for anew, it begins for the first time
    assert session_of(at).begun == set()


def test_a_computation_that_started_again_says_so_beside_its_result() -> None:
    at = visit(ORBITS)
    open_part(at, "orbits_tab", "Limit cycles")
    at.button(key="orbits_cycles").click().run()
    del at.session_state["orbits_cycles_done"]
    session_of(at).begun.add("orbits_cycles")
    at.run()
    assert "interrupted" in said(at)
    at.run()
    assert "interrupted" not in said(at)


def test_a_film_of_finite_length_says_what_its_tables_cost_and_makes_them_once_asked() -> None:
    at = visit(ORBITS, film="finite")
    words = " ".join(text.value for text in at.markdown)
    assert re.search(r"tabulated once .* about \d+ s", words), words
    assert charts(at) == {}
    press(at, "orbits_slow_release")
    assert set(charts(at)) == {"chart_orbits_path", "chart_orbits_time"}
    assert re.search("After 40 revolutions|returns to equilibrium", said(at)), said(at)
    session_of(at).set_value("rpm", 5800.0)
    at.run()
    assert faults(at) == []
    assert len(charts(at)) == 2  # another speed needs no other tables


def test_pads_with_pockets_say_what_each_release_costs_and_wait_to_be_asked() -> None:
    at = visit(ORBITS, bearing="multi-dam", revolutions="20")
    words = " ".join(text.value for text in at.markdown)
    assert re.search(r"solved at each step\. This release takes about 4 s", words), words
    press(at, "orbits_slow_release")
    assert set(charts(at)) == {"chart_orbits_path", "chart_orbits_time"}
    session_of(at).set_value("rpm", 5800.0)
    at.run()
    assert faults(at) == []
    assert charts(at) == {}  # another speed is another release


def test_another_bore_may_refuse_a_release_after_its_tables() -> None:
    at = visit(ORBITS, film="finite")
    at.slider(key="orbits_kick").set_value(1.2).run()
    at.button(key="orbits_slow_release").click().run()
    assert not at.exception
    assert "film has no thickness left" in said(at)
    assert charts(at) == {}
