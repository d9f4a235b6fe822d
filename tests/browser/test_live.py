"""Charts have a preview: sliders send while they move, charts keep their place and zoom."""

import re

import pytest
from playwright.sync_api import Locator, Route, expect

from tests.browser.app_page import AppPage

# Every text that depends on the machine, as it is read: of an equation its TeX.
SAID = """() => Object.fromEntries([...document.querySelectorAll('[class*="st-key-said_"]')]
  .filter(place => place.checkVisibility())
  .map(place => {
    const read = place.cloneNode(true);
    if (read.querySelector('.live-said'))
      [...read.children].forEach(one => one.classList.contains('live-said') || one.remove());
    read.querySelectorAll('.katex').forEach(
      one => one.replaceWith(one.querySelector('annotation').textContent));
    return [place.className.match(/st-key-said_\\S+/)[0],
            read.textContent.replaceAll(/\\s+/g, ' ').trim()];
  }).filter(([, words]) => words))"""


def _drag(app: AppPage, label: str, share: float) -> tuple[float, float]:
    """Press a slider's thumb, move it by a share of its length and hold it; return where it was."""
    slider = app.slider(label)
    slider.hover()  # in view, and at rest: a group above it may be opening
    box = slider.bounding_box()
    assert box
    at = float(slider.input_value())
    low, high = (float(slider.get_attribute(end) or 0) for end in ("min", "max"))
    thumb = 8  # half its width: it stays within the slider
    start = box["x"] + thumb + (box["width"] - 2 * thumb) * (at - low) / (high - low)
    height = box["y"] + box["height"] / 2
    app.page.mouse.move(start, height)
    app.page.mouse.down()
    app.page.mouse.move(start + share * box["width"], height, steps=3)
    return start, height


def _zoom(app: AppPage, chart: Locator) -> list[float]:
    before = _ranges(chart)
    plot = chart.locator(".nsewdrag").first.bounding_box()
    assert plot
    mouse = app.page.mouse
    mouse.move(plot["x"] + 0.3 * plot["width"], plot["y"] + 0.3 * plot["height"])
    mouse.down()
    mouse.move(plot["x"] + 0.6 * plot["width"], plot["y"] + 0.7 * plot["height"], steps=5)
    mouse.up()
    assert app.changes(lambda: _ranges(chart), before)  # Plotly waits for a second click first
    return _ranges(chart)


def _ranges(chart: Locator) -> list[float]:
    return chart.evaluate("gd => [...gd.layout.xaxis.range, ...gd.layout.yaxis.range]")


def test_dragging_changes_charts_and_numbers_and_release_the_address(app: AppPage) -> None:
    app.open("Equilibrium")
    numbers, drawn = app.metrics(), app.drawn()
    _drag(app, "Radial clearance", 0.2)
    assert app.changes(app.metrics, numbers)
    assert app.changes(app.drawn, drawn)
    assert app.query() == {}
    with app.run():
        app.page.mouse.up()
    assert float(app.query()["C"]) > 70


def test_a_slider_dragged_back_leaves_the_page_as_it_was(app: AppPage) -> None:
    """Streamlit then sends nothing: the charts and numbers of the preview must be undone."""
    app.open("Stability")
    numbers, pictures = app.metrics(), _picture(app)
    start = _drag(app, "Radial clearance", 0.2)
    assert app.changes(app.metrics, numbers)
    assert app.changes(lambda: _picture(app), pictures)
    app.page.mouse.move(*start, steps=4)
    with app.run():
        app.page.mouse.up()
    assert app.query() == {}
    assert app.metrics() == numbers
    for now, then in zip(_picture(app), pictures, strict=True):
        assert now == pytest.approx(then, abs=2.0)  # Plotly ends lines at the plot's edge


@pytest.mark.parametrize(("page", "charts"), [("Stability", 2), ("Root locus", 1)])
def test_node_zoom_and_hidden_line_stay_while_the_machine_changes(
    app: AppPage, page: str, charts: int
) -> None:
    app.open(page)
    shown = [app.charts().nth(number) for number in range(charts)]
    hidden = shown[0].locator(".traces[style*='opacity: 0.5']")
    if page == "Stability":
        shown[0].locator(".legendtoggle").first.click()
        expect(hidden).to_have_count(1)
    before = [_ranges(chart) for chart in shown]
    zoomed = [_zoom(app, chart) for chart in shown]
    assert all(now != then for now, then in zip(zoomed, before, strict=True))
    for chart in shown:
        chart.evaluate("gd => { gd.mine = true; }")
    app.press("Radial clearance", "ArrowRight")
    app.press("Running speed", "ArrowRight")
    assert [_ranges(chart) for chart in shown] == zoomed
    assert all(chart.evaluate("gd => gd.mine") for chart in shown)
    expect(hidden).to_have_count(int(page == "Stability"))


def test_preset_moves_the_live_sliders(app: AppPage) -> None:
    app.open("Equilibrium")
    with app.run():
        app.page.get_by_role("combobox", name=re.compile("Preset")).click()
        app.page.get_by_role("option", name=re.compile("Friswell")).click()
    assert app.value("Radial clearance") == "100"
    app.go("Stability")
    assert app.value("Radial clearance") == "100"


def test_the_validity_panel_judges_a_moved_value_and_the_sidebar_keeps_it_when_the_page_runs(
    app: AppPage,
) -> None:
    """A moved slider draws the page alone: the sidebar's sliders were drawn before it."""
    app.open("Machine")
    verdict = app.page.locator(".st-key-said_verdict")
    panel = app.page.locator(".st-key-said_assumptions")
    with app.run():
        app.page.get_by_text("Where the model holds").click()
    # The example's given temperature leaves 11 kW to a side flow of 0.7 l/min.
    expect(verdict).to_contain_text("Model strained: heat")
    expect(panel).not_to_contain_text("outside")
    app.press("Radial clearance", "End")
    expect(verdict).to_contain_text("The model is outside")
    expect(panel).to_contain_text("outside")
    assert app.query() == {"C": "2000"}
    for button in ("Keep as A", "Keep as B"):
        with app.run():
            app.page.get_by_role("button", name=button).click()
        assert app.value("Radial clearance") == "2000"
    app.press("Radial clearance", "Home")
    assert app.value("Radial clearance") == "3"
    assert app.query()["C"] == "3"


def test_a_slider_without_a_preview_sends_by_itself(app: AppPage) -> None:
    """So does one that is moved before the page has been drawn, or while it computes."""
    app.open("Equilibrium")
    # A token that the server does not know: the slider sends through the page's own run.
    app.page.evaluate("() => { window.rotorcalcPreview.token = 'gone'; }")
    numbers = app.metrics()
    _drag(app, "Radial clearance", 0.2)
    assert app.changes(app.metrics, numbers)
    with app.run():
        app.page.mouse.up()
    assert float(app.query()["C"]) > 70
    numbers, link = app.metrics(), app.query()
    app.page.evaluate("() => { window.rotorcalcPreview = undefined; }")
    app.press("Radial clearance", "ArrowRight")
    assert float(app.query()["C"]) > float(link["C"])
    assert app.metrics() != numbers


def test_a_chart_script_that_fails_to_load_is_reported_on_the_page(stranger: AppPage) -> None:
    stranger.page.route("**/plotly-*.min.js", lambda route: route.abort())
    stranger.page.goto(f"{stranger.url}/Equilibrium")
    message = stranger.page.get_by_role("alert").filter(has_text="Plotly's script did not load")
    expect(message).to_have_count(2)  # both charts have asked for it
    # What the console says of the refused script is this test's own doing.
    stranger.faults[:] = [fault for fault in stranger.faults if "ERR_FAILED" not in fault]


@pytest.mark.parametrize(("page", "tabs"), {
    "Machine": [""],
    "Equilibrium": ["Locus", "Film and pressure", "Forces", "Losses and flow"],
    "Coefficients": ["Against speed", "Against ε", "Against σ", "Added mass"],
    "Stability": ["Threshold", "Figures of the notes", "Follower force", "Map", "Remedies"],
    "Root locus": ["Complex plane", "Mode"],
    "Response": ["Against speed", "Orbits", "What damping and journal mass do"],
}.items())  # fmt: skip
def test_charts_move_in_place_and_a_key_is_answered_before_the_page_runs(
    app: AppPage, page: str, tabs: list[str]
) -> None:
    app.open(page)
    for tab in [*tabs[1:], tabs[0]]:
        if tab:
            app.open_tab(tab)
        _see_charts_move_in_place(app, tab)
        if tab in (tabs[0], "Film and pressure", "Follower force", "Remedies"):
            _see_a_run_change_nothing_that_a_key_has_shown(app)
            app.press("Radial clearance", "ArrowLeft")


def _see_charts_move_in_place(app: AppPage, tab: str) -> None:
    """Plotly would need ten times as long to draw them again."""
    for key, value in (("C", "60.5"), ("rpm", "6050")):
        moved = app.page.evaluate(_MOVED, [key, value])
        assert moved
        assert [chart for chart, in_place in moved.items() if not in_place] == [], tab


def _see_a_run_change_nothing_that_a_key_has_shown(app: AppPage) -> None:
    """Lines, points, notes, shapes, words and numbers stand where they stood before the run."""
    numbers = app.metrics()
    app.page.evaluate(_HOLD_BACK)
    app.slider("Radial clearance").press("ArrowRight")
    app.page.wait_for_function("() => window.heldBack")
    moved, seen, said = _picture(app), app.metrics(), app.page.evaluate(SAID)
    assert seen != numbers
    assert said["st-key-said_changes"] == "Changed from the preset: C."
    with app.run():
        app.page.evaluate("() => window.heldBack()")
    drawn = _picture(app)
    assert [len(part) for part in moved] == [len(part) for part in drawn]
    for previewed, final in zip(moved, drawn, strict=True):
        # Plotly puts words on whole pixels, and ends lines at the plot's edge.
        assert previewed == pytest.approx(final, abs=2.0)
    assert app.metrics() == seen
    assert app.page.evaluate(SAID) == said


def test_texts_stand_alike_however_late_their_fonts_come(app: AppPage, stranger: AppPage) -> None:
    """A chart's first text in italics is the first need of its font."""

    def late(route: Route) -> None:
        stranger.page.wait_for_timeout(2000)
        route.continue_()

    stranger.page.route("**/*Italic*.woff2", late)
    app.open("Machine")
    stranger.open("Machine")
    assert _picture(stranger) == _picture(app)


# What a slider sends through Streamlit waits until it is let through.
_HOLD_BACK = """() => {
  const preview = window.rotorcalcPreview;
  const { send } = preview;
  window.heldBack = null;
  preview.send = (...message) => {
    window.heldBack = () => { preview.send = send; send(...message); };
  };
}"""


@pytest.mark.parametrize(
    ("page", "key", "rpm"),
    [("Equilibrium, Forces", "balance", "1500"), ("Response, Orbits", "orbits", "7500")],
)
def test_an_arrowhead_turns_as_plotly_would_draw_it(
    app: AppPage, page: str, key: str, rpm: str
) -> None:
    """By 17° and 39°: a chart that is moved in place, and drawn again when the slider rests."""
    name, _, tab = page.partition(", ")
    app.open(name, tab=tab)
    chart = app.page.locator(f".st-key-chart_{key} .live-chart")
    before = chart.locator(_HEADS).evaluate_all(_PLACES)
    app.page.evaluate(_HELD, rpm)
    expect(chart).to_have_attribute("data-moved", "")
    moved = chart.locator(_HEADS).evaluate_all(_PLACES)
    app.page.evaluate("() => document.querySelector('#held').remove()")
    expect(chart).not_to_have_attribute("data-moved", "")
    drawn = chart.locator(_HEADS).evaluate_all(_PLACES)
    assert moved != pytest.approx(before, abs=2.0)
    assert moved == pytest.approx(drawn, abs=1.0)


_HEADS = ".scatterlayer .point"
# Places on their outlines on the screen: the box of what is turned is not its own.
_PLACES = """points => points.flatMap(point => [0, 1, 2, 3].flatMap(part => {
  const place = point.getPointAtLength(point.getTotalLength() * part / 4);
  const { x, y } = place.matrixTransform(point.getScreenCTM());
  return [x, y];
}))"""
# A preview at a running speed, while a slider is held, so that Plotly draws nothing that was moved.
_HELD = """async rpm => {
  const held = document.createElement('div');
  Object.assign(held, { className: 'live-slider', id: 'held', slider: { rest() {} } });
  held.dataset.busy = '';
  document.body.append(held);
  await window.rotorcalcPreview.show('rpm', rpm);
}"""


def test_an_equation_is_as_high_in_a_preview_as_on_the_page(app: AppPage) -> None:
    """Else everything below it jumps when the page has run."""
    app.open("Stability", tab="Figures of the notes")
    caption = app.page.locator(".st-key-said_under_threshold_speed")
    height = caption.evaluate("one => one.getBoundingClientRect().height")
    app.page.evaluate("() => window.rotorcalcPreview.show('C', '60.5')")
    expect(caption.locator(".live-said")).to_be_visible()
    held = caption.evaluate("one => one.getBoundingClientRect().height")
    assert held == pytest.approx(height, abs=0.1)


# Whether each chart shown can be moved in place to what the preview has at an input's value.
_MOVED = """async ([name, value]) => {
  const { address, token } = window.rotorcalcPreview;
  const answer = await fetch(`${address}?${new URLSearchParams({ name, value })}`,
    { headers: { "X-Rotorcalc-Page": token } });
  const moved = {};
  for (const [key, figure] of Object.entries((await answer.json()).charts)) {
    const { element, given, tools } = window.rotorcalcCharts.get(key);
    moved[key] = tools.move(element, given.chart, figure);
    if (moved[key]) tools.move(element, figure, given.chart);
  }
  return moved;
}"""


def _picture(app: AppPage) -> list[list[float]]:
    """Return where on the screen each chart's lines, points, notes and shapes stand."""
    return app.charts().evaluate_all("""charts => charts.map(gd => {
      // A contour chart's first fill covers missing heights, which are clipped away.
      const parts = ".overplot :is(.lines, .fills, .point, .contourfill path + path), "
        + ".annotation-text, .shapelayer path";
      const seen = [...gd.querySelectorAll(parts)].filter(part => part.getAttribute("d") !== "");
      const plot = gd.querySelector(".nsewdrag").getBoundingClientRect();
      return seen.flatMap(part => {
        const box = part.getBoundingClientRect();
        return ["left", "top", "right", "bottom"].map(
          (side, i) => Math.min(Math.max(box[side], plot[i % 2 ? "top" : "left"]),
                                plot[i % 2 ? "bottom" : "right"]) - plot[i % 2 ? "top" : "left"]);
      });
    })""")
