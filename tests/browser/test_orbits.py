"""The orbits page in a browser: its buttons, its animation, long work that can be cancelled."""

import re

from playwright.sync_api import expect

from tests.browser.app_page import AppPage
from tests.load.replicas import Replica

_NOW = """() => {
  const chart = document.querySelector('.js-plotly-plot');
  const now = chart._fullData.at(-1);  // its arrays decoded
  return [now.x[0], now.y[0], chart.layout.sliders[0].active];
}"""
_FRAMES = "() => document.querySelector('.js-plotly-plot')._transitionData._frames.length"


def press(app: AppPage, label: str) -> None:
    with app.run():
        app.page.get_by_role("button", name=re.compile(f"^{label}")).click()


def test_demonstrations_set_up_machine_kick_and_answer(app: AppPage) -> None:
    app.open("Orbits")
    main = app.page.get_by_test_id("stMain")
    press(app, "5 % above onset")
    expect(main.get_by_text(re.compile("whirls at 0.5.*unstable"))).to_be_visible()
    assert app.query()["u"] == "0"
    press(app, "Subcritical: small kick")
    expect(main.get_by_text(re.compile("decaying|returns to equilibrium"))).to_be_visible()
    press(app, "Subcritical: big kick")
    expect(main.get_by_text(re.compile("up to 0.86.*stable.*too large"))).to_be_visible()
    assert app.query()["mass"] == "660"
    press(app, "5 % below onset")
    expect(main.get_by_text(re.compile("linear theory: stable"))).to_be_visible()


def test_the_orbit_plays_stops_and_is_scrubbed(app: AppPage) -> None:
    app.open("Orbits")
    page = app.page
    assert page.evaluate(_FRAMES) > 100
    chart = app.charts().first
    last = page.evaluate(_NOW)
    assert last[2] == page.evaluate(_FRAMES) - 1
    # Pull the slider to its beginning: the journal is where it was released.
    chart.get_by_text("▶ Play").scroll_into_view_if_needed()
    grip = chart.locator(".slider-grip-rect").bounding_box()
    rail = chart.locator(".slider-rail-rect").bounding_box()
    assert grip is not None
    assert rail is not None
    page.mouse.move(grip["x"] + grip["width"] / 2, grip["y"] + grip["height"] / 2)
    page.mouse.down()
    page.mouse.move(rail["x"], grip["y"] + grip["height"] / 2, steps=8)
    page.mouse.up()
    assert app.changes(lambda: page.evaluate(_NOW)[2], last[2])
    start = page.evaluate(_NOW)
    assert start[2] == 0
    assert start[1] < last[1]  # released above its equilibrium
    chart.get_by_text("▶ Play").click()
    assert app.changes(lambda: page.evaluate(_NOW)[2] > 5, False)
    chart.get_by_text("Stop").click()
    assert app.stands(lambda: page.evaluate(_NOW))
    stopped = page.evaluate(_NOW)
    assert stopped[2] < last[2]


def test_long_work_shows_progress_and_can_be_cancelled(server: Replica, app: AppPage) -> None:
    app.open("Orbits", k="inf")
    app.open_tab("Run-up")
    with server.held():
        app.page.get_by_role("button", name="Run up and down").click()
        expect(app.page.get_by_role("progressbar")).to_be_visible()
        # Nothing stands twice meanwhile, and what stands is not the last run's.
        expect(app.page.get_by_role("tablist")).to_have_count(1)
        expect(app.page.get_by_role("tab", name="Run-up")).to_have_count(1)
        expect(app.page.get_by_role("radio", name="around the onset")).to_have_count(1)
        expect(app.page.get_by_role("button", name="Cancel", exact=True)).to_have_count(1)
        app.page.get_by_role("button", name="Cancel", exact=True).click()
    expect(app.page.get_by_role("button", name="Run up and down")).to_be_enabled()
    app.rest()
    expect(app.charts()).to_have_count(0)
    press(app, "Run up and down")
    expect(app.charts()).to_have_count(1)
    expect(app.page.get_by_role("button", name="Cancel", exact=True)).to_have_count(0)


def test_limit_cycles_and_three_onsets_are_drawn(app: AppPage) -> None:
    app.open("Orbits")
    app.open_tab("Limit cycles")
    press(app, "Follow the limit cycles")
    (names,) = app.traces()
    assert {"limit cycle, stable", "limit cycle, unstable"} <= set(names)
    app.open_tab("Onset three ways")
    expect(app.page.get_by_text("They agree")).to_be_visible()
    metrics = app.metrics()
    assert metrics["Closed form"] == metrics["Eigenvalues"] == metrics["Measured growth in time"]


def test_kick_and_length_survive_a_change_of_page(app: AppPage) -> None:
    app.open("Orbits", tab="Spectrum")
    app.press("Initial displacement", "ArrowRight")
    app.go("Notes")
    app.go("Orbits")
    assert app.slider("Initial displacement").input_value() == "0.31"


def test_a_demonstration_is_undone_with_its_release(app: AppPage) -> None:
    link = {"T": "65", "tab": "Spectrum", "kick": "0.5", "revolutions": "60"}
    app.open("Orbits", **link)
    press(app, "Subcritical: big kick")
    assert app.query()["kick"] == "0.25"
    with app.run():
        app.page.get_by_role("button", name="Undo last change").click()
    assert app.query() == link
    assert app.slider("Initial displacement").input_value() == "0.5"
    assert app.slider("Revolutions").input_value() == "60"


_JOURNAL = """() => {
  const chart = [...document.querySelectorAll('.js-plotly-plot')].at(-1);
  const journal = chart._fullData.find(trace => trace.name === 'journal');
  return [journal.fill, journal.x.length, journal.line.width, Math.max(...journal.y)];
}"""
_ZOOM = """range => Plotly.relayout([...document.querySelectorAll('.js-plotly-plot')].at(-1),
  {'xaxis.range': range})"""


def test_a_long_signal_is_an_envelope_and_a_zoom_shows_its_turns(app: AppPage) -> None:
    app.open("Orbits", revolutions="400", u="0", rpm="9500", kick="0.05")
    fill, points, _, top = app.page.evaluate(_JOURNAL)
    assert fill == "toself"
    assert points < 1000
    app.page.evaluate(_ZOOM, [200, 210])
    app.rest()
    assert app.changes(lambda: app.page.evaluate(_JOURNAL)[0], "toself")
    zoomed = app.page.evaluate(_JOURNAL)
    assert zoomed[1] == 400 * 32 + 1
    # The band reaches as far as the signal itself.
    assert abs(zoomed[3] - top) < 1e-4 * top
    app.page.evaluate(_ZOOM, [0, 400])
    assert app.changes(lambda: app.page.evaluate(_JOURNAL)[0] == "toself", False)


def test_a_run_up_and_down_shows_the_hysteresis_before_the_limit_cycles(app: AppPage) -> None:
    app.open("Orbits", tab="Run-up", C="63")
    main = app.page.get_by_test_id("stMain")
    expect(main.get_by_text("The charts will show the journal's amplitude")).to_be_visible()
    expect(main.get_by_text("Why whirl shows late")).to_be_visible()
    press(app, "Run up and down")
    expect(
        main.get_by_text(re.compile("Rising, whirl shows from .*above the onset"))
    ).to_be_visible()
    (names,) = app.traces()
    assert {"speed rising ▸", "speed falling ◂"} <= set(names)
    expect(main.get_by_text("From the onset on, whirl of a constant size")).to_be_visible()
    press(app, "Follow the limit cycles")
    (names,) = app.traces()
    assert "limit cycle, unstable" in names
    with app.run():
        app.page.get_by_role("radio", name="Spectra falling").click()
    expect(app.charts().first).to_contain_text("½×, whirl")
    assert app.query() == {"C": "63", "tab": "Run-up", "picture": "Spectra falling"}


def test_every_tab_says_what_will_come(app: AppPage) -> None:
    app.open("Orbits", tab="Limit cycles")
    expect(
        app.page.get_by_text(re.compile(r"The chart will show the size of these cycles.*15\s+s"))
    ).to_be_visible()
