"""One speed through all views: what is marked in one chart is marked in all of the page."""

import math
import re

import pytest
from playwright.sync_api import Browser, Locator, expect

import rotorcalc as rc
from tests.browser.app_page import AppPage
from tests.browser.conftest import DESK
from tests.browser.test_live import _drag, _picture
from tests.load.replicas import Replica

RPM = math.pi / 30
PRESET = rc.PRESETS["sheet-1e8"]

# The value that each chart marks, by the chart's key, as it is read.
_LABELS = """() => Object.fromEntries([...window.rotorcalcCharts].map(([key, { view }]) => {
  const label = view.querySelector('.live-cursor > .label');
  const seen = label && getComputedStyle(label).visibility === 'visible';
  return [key.replace('chart_', ''), seen ? label.textContent : ''];
}).filter(([key, words]) => words))"""
# The drawing's readings by their symbols, and where its journal's centre is drawn.
_READ = """() => Object.fromEntries(
  [...window.rotorcalcCharts.get('chart_cross_section').element
    .querySelectorAll('.annotation-text')]
    .map(note => note.textContent.replaceAll('\u200b', '').split(' = ')).filter(row => row[1]))"""
_STOPS = """() => [...document.querySelectorAll('.js-plotly-plot')].map(
  chart => chart.layout.sliders[0].active)"""


def _labels(app: AppPage) -> dict[str, str]:
    return app.page.evaluate(_LABELS)


def _chart(app: AppPage, key: str) -> Locator:
    # Streamlit writes a key's other letters as hyphens.
    name = re.sub("[^a-zA-Z0-9_-]", "-", key)
    return app.page.locator(f".st-key-chart_{name} .live-view")


def _point_at(app: AppPage, key: str, share: float, height: float = 0.5) -> None:
    """Move the pointer to shares of a chart's plot, from its left and top."""
    box = _chart(app, key).locator(".nsewdrag").first.bounding_box()
    assert box
    app.page.mouse.move(box["x"] + share * box["width"], box["y"] + height * box["height"])


def _leave(app: AppPage) -> None:
    app.page.mouse.move(5, 5)


def _stop_of(app: AppPage, key: str) -> Locator:
    """Return the label of a chart's own slider; those of its stops, which are hidden, follow it."""
    return _chart(app, key).locator(".slider-label").first


def _rpm(words: str) -> float:
    return float(words.split(maxsplit=1)[0])


def test_a_speed_under_the_pointer_is_marked_in_all_charts_and_drawn(app: AppPage) -> None:
    app.open("Machine")
    before, picture = app.page.evaluate(_READ), _picture(app)
    asked: list[str] = []
    app.page.on("request", lambda request: asked.append(request.url))
    _point_at(app, "home_response", 0.1)
    assert app.changes(lambda: _labels(app), {})
    labels = _labels(app)
    assert labels.keys() == {"cross_section", "home_locus", "home_threshold", "home_response"}
    (words,) = set(labels.values())
    assert _rpm(words) == pytest.approx(0.1 * PRESET.top_speed / RPM, rel=0.02)
    assert app.changes(lambda: app.page.evaluate(_READ), before)
    there = rc.analyse(PRESET.machine, _rpm(words) * RPM)
    read = app.page.evaluate(_READ)
    assert float(read["φ"].rstrip("°")) == pytest.approx(
        math.degrees(float(there.attitude_angle)), rel=2e-3
    )
    assert float(read["hmin"].split()[0]) == pytest.approx(
        1e6 * float(there.minimum_film_thickness), rel=2e-3
    )
    assert read["pmax"] != before["pmax"]
    assert asked == []
    _leave(app)
    assert app.changes(lambda: bool(_labels(app)), True)
    assert app.page.evaluate(_READ) == before
    for now, then in zip(_picture(app), picture, strict=True):
        assert now == pytest.approx(then, abs=0.1)


@pytest.mark.parametrize(("page", "tabs"), {
    "Equilibrium": [
        ("Film and pressure", "", 2), ("Forces", "forces", 2), ("Losses and flow", "power_loss", 4)
    ],
    "Coefficients": [
        ("Against speed", "stiffness_speed", 2), ("Against σ", "k_σ", 2), ("Against ε", "c_ε", 2),
        ("Why only cross-coupling", "", 1),
    ],
    "Stability": [
        ("Threshold", "threshold", 3), ("Figures of the notes", "whirl_ratio", 4),
        ("Follower force", "energy", 2), ("Map", "", 1), ("Remedies", "solution", 2),
    ],
    "Root locus": [("Against speed", "growth", 5), ("Mode", "", 1)],
    "Response": [
        ("Against speed", "phase", 2), ("What damping and journal mass do", "family_disk", 2)
    ],
}.items())  # fmt: skip
def test_every_chart_marks_a_speed_or_is_drawn_at_it(
    app: AppPage, page: str, tabs: list[tuple[str, str, int]]
) -> None:
    """Under the pointer in a chart over speed; by a key where a tab has none."""
    app.open(page)
    for tab, key, charts in tabs:
        app.open_tab(tab)
        before = _picture(app)
        if key:
            _point_at(app, key, 0.4, 0.55)
        else:
            app.page.get_by_role("slider", name="Cursor, speed").first.press("PageDown")
        assert app.changes(lambda: len(_labels(app)) == charts, False), tab  # noqa: B023
        assert len(set(_labels(app).values())) == 1
        if not key:
            assert _picture(app) != before, tab
        _leave(app)
        app.page.keyboard.press("Escape")
        assert app.changes(lambda: bool(_labels(app)), True), tab
        app.rest()
        for now, then in zip(_picture(app), before, strict=True):
            assert now == pytest.approx(then, abs=2.0), tab  # as lines end at the plot's edge


def test_a_chart_at_one_speed_is_drawn_at_the_speed_under_the_pointer(app: AppPage) -> None:
    app.open("Stability", tab="Follower force")
    bars = _chart(app, "energy_bars")
    expect(bars).to_contain_text("running speed6000 rpm")
    app.page.get_by_role("slider", name="Cursor, speed").last.press("End")
    expect(bars).to_contain_text("running speed12000 rpm")
    film = rc.analyse(PRESET.machine, 12000 * RPM).stiffness
    expect(bars).to_contain_text(f"{float(film[0, 1] - film[1, 0]) / 1e6:.0f}")  # fed in
    _leave(app)
    app.page.keyboard.press("Escape")
    expect(bars).to_contain_text("running speed6000 rpm")
    app.rest()


def test_a_speed_on_the_journals_path_is_marked_too(app: AppPage) -> None:
    app.open("Equilibrium")
    _point_at(app, "position", 0.5)  # over σ, which follows from the speed
    assert app.changes(lambda: _labels(app).keys() == {"locus", "position"}, False)
    with app.run():
        app.page.get_by_role("radio", name="Over speed").click()
    _point_at(app, "position", 0.1)
    assert app.changes(lambda: _labels(app).keys() == {"locus", "position"}, False)
    dot = _chart(app, "locus").locator(".live-cursor > .dot")
    box = dot.bounding_box()
    assert box
    _leave(app)
    assert app.changes(lambda: bool(_labels(app)), True)
    app.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert app.changes(lambda: _labels(app).keys() == {"locus", "position"}, False)
    assert _rpm(_labels(app)["position"]) == pytest.approx(0.1 * PRESET.top_speed / RPM, rel=0.1)


def test_play_moves_every_view_together_and_stops(app: AppPage) -> None:
    app.open("Machine")
    _chart(app, "home_threshold").get_by_role("button", name="Play: speed").click()
    seen: set[float] = set()

    def goes_on() -> bool:
        labels = _labels(app)
        seen.update(_rpm(words) for words in labels.values())
        return len(labels) == 4 and len(set(labels.values())) == 1 and len(seen) > 5

    assert app.changes(goes_on, False)
    _chart(app, "home_threshold").get_by_role("button", name="Stop").click()
    assert app.stands(lambda: _labels(app))
    assert len(_labels(app)) == 4
    _leave(app)
    assert app.changes(lambda: bool(_labels(app)), True)


def test_play_and_the_slider_move_both_orbits(app: AppPage) -> None:
    app.open("Response")
    app.open_tab("Orbits")
    start = app.page.evaluate(_STOPS)
    assert len(set(start)) == 1
    _chart(app, "clearance_orbit").get_by_text("▶ Play").click()
    assert app.changes(lambda: app.page.evaluate(_STOPS)[1], start[1])
    _chart(app, "clearance_orbit").get_by_text("Stop").click()
    assert app.changes(lambda: len(set(app.page.evaluate(_STOPS))), 2)
    left, right = app.page.evaluate(_STOPS)
    assert abs(left - right) <= 1  # a frame may be on its way
    for key in ("clearance_orbit", "orbits"):
        expect(_stop_of(app, key)).to_have_text(re.compile(r"Ω = \d+ rpm"))
    _leave(app)
    assert app.changes(lambda: app.page.evaluate(_STOPS)[1], right)
    assert app.page.evaluate(_STOPS)[1] == start[1]  # it goes back to where its own slider stood


def test_arrow_keys_step_through_an_animation_and_along_an_axis(app: AppPage) -> None:
    app.open("Root locus")
    label = _stop_of(app, "locus")
    expect(label).to_contain_text("6000 rpm")
    keys = app.page.get_by_role("slider", name="Cursor, speed")
    keys.focus()
    (next_stop,) = app.page.evaluate(
        """() => [...document.querySelectorAll('.js-plotly-plot')].map(({ layout }) => {
          const [{ active, steps }] = layout.sliders;
          return steps[active + 1].label;
        })"""
    )
    keys.press("ArrowRight")
    expect(label).to_contain_text(f"{next_stop} rpm")
    keys.press("Home")
    expect(label).to_contain_text("50 rpm")
    app.open("Stability")
    keys = app.page.get_by_role("slider", name="Cursor, speed").first
    keys.focus()
    keys.press("ArrowLeft")
    assert app.changes(lambda: set(_labels(app).values()), set())
    assert set(_labels(app).values()) == {"5880 rpm"}
    assert keys.get_attribute("aria-valuetext") == "5880 rpm"
    keys.press("Escape")
    assert app.changes(lambda: bool(_labels(app)), True)


def test_a_moment_of_an_orbit_is_marked_over_time(app: AppPage) -> None:
    app.open("Orbits")
    chart = _chart(app, "orbits_path")
    chart.get_by_text("▶ Play").click()
    assert app.changes(lambda: _labels(app).keys() == {"orbits_time"}, False)
    chart.get_by_text("Stop").click()
    label = _stop_of(app, "orbits_path")
    assert app.changes(
        lambda: label.text_content().split()[-1] == _labels(app).get("orbits_time", " ").split()[0],
        False,
    )
    assert _labels(app)["orbits_time"].endswith("revolutions")


def test_a_dragged_slider_answers_though_a_speed_was_marked(app: AppPage) -> None:
    app.open("Machine")
    _point_at(app, "home_threshold", 0.1)
    assert app.changes(lambda: _labels(app), {})
    numbers = app.metrics()
    _drag(app, "Radial clearance", 0.1)
    assert app.changes(app.metrics, numbers)
    assert _labels(app) == {}
    app.page.wait_for_function("() => !document.querySelector('.live-slider[data-busy]')")
    with app.run():
        app.page.mouse.up()
    moved, read = _picture(app), app.page.evaluate(_READ)
    app.open("Machine", **app.query())
    assert app.page.evaluate(_READ) == read
    for now, then in zip(_picture(app), moved, strict=True):
        assert now == pytest.approx(then, abs=1.5)


def test_the_journal_turns_and_whirls_when_asked(app: AppPage) -> None:
    app.open("Machine")
    words, button = app.page.locator(".live-slowed"), app.page.get_by_role("button", name="Animate")
    expect(words).to_be_hidden()
    picture = _picture(app)[0]
    button.click()
    expect(words).to_contain_text(re.compile(r"Slowed \d+ ×, film drawn 375 × thicker"))
    mode = max(rc.analyse(PRESET.machine, PRESET.speed).flexible_eigenvalues, key=lambda v: v.real)
    expect(words).to_contain_text(f"{mode.imag / RPM:.0f} rpm, −{-mode.real:.4g} 1/s; it decays")
    assert app.changes(lambda: _picture(app)[0], _picture(app)[0])
    # At the cursor's speed it moves as that speed's mode does.
    _point_at(app, "home_threshold", 0.95)
    expect(words).to_contain_text("it grows")
    _leave(app)
    expect(words).to_contain_text("it decays")
    button.click()
    expect(words).to_be_hidden()
    assert app.changes(lambda: _picture(app)[0] == pytest.approx(picture, abs=0.1), False)


def test_a_visitor_who_wants_no_motion_sees_the_whirls_path(app: AppPage) -> None:
    app.page.emulate_media(reduced_motion="reduce")
    app.open("Machine")
    app.page.get_by_role("button", name="Animate").click()
    expect(app.page.locator(".live-slowed")).to_contain_text("The path of 3 whirls")
    still = _picture(app)
    app.page.wait_for_timeout(300)
    assert _picture(app) == still


def test_a_tap_marks_a_speed_and_a_tap_elsewhere_takes_it_away(
    browser: Browser, server: Replica
) -> None:
    with browser.new_context(viewport=DESK, has_touch=True) as context:
        app = AppPage(context.new_page(), server.address)
        app.open("Stability")
        box = _chart(app, "threshold").locator(".nsewdrag").first.bounding_box()
        assert box
        app.page.touchscreen.tap(box["x"] + 0.3 * box["width"], box["y"] + 0.6 * box["height"])
        assert app.changes(lambda: len(_labels(app)), 0)
        assert len(_labels(app)) == 3
        app.page.get_by_role("heading", name="Stability").tap()
        assert app.changes(lambda: bool(_labels(app)), True)
        assert app.faults == []
