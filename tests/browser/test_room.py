"""Nothing is cut at usual widths and zooms; answer and main chart stand above the fold."""

import math

import pytest
from playwright.sync_api import expect

from tests.browser.app_page import MACHINE_PAGES, PATHS, AppPage
from tests.browser.conftest import DESK
from tests.browser.test_access import violations

WIDTHS = (800, 1024, 1152, 1280, 1440, 1680, 1920)
# A browser's zoom makes the window smaller in CSS pixels by so much.
ZOOMS = (1.0, 1.5, 2.0)
HEIGHT = 900
# Criteria has a table first.
CHARTS = [name for name in MACHINE_PAGES if name not in ("Bearings", "Criteria", "Notes")]

# Texts of results, tabs, buttons and links that are wider than their box, and hidden there.
CUT = """() => {
  const cut = [];
  const texts = '.stMetric *, [role=tab] *, .stMain button *, .stMain a *, .live-slider label';
  for (const element of document.querySelectorAll(texts)) {
    if (!element.offsetParent || element.closest('svg, .js-plotly-plot')) continue;
    const style = getComputedStyle(element);
    if (style.overflowX === 'visible' && style.textOverflow !== 'ellipsis') continue;
    if (element.scrollWidth > element.clientWidth + 1 && element.clientWidth > 0)
      cut.push(`${element.innerText}: ${element.scrollWidth} > ${element.clientWidth}`);
  }
  for (const result of document.querySelectorAll('.stMetric')) {
    const box = result.getBoundingClientRect();
    for (const part of result.querySelectorAll('p')) {
      const range = document.createRange();
      range.selectNodeContents(part);
      const text = range.getBoundingClientRect();
      if (text.right > box.right + 1) cut.push(`${part.innerText}: beyond its column`);
    }
  }
  return cut;
}"""

# The lowest edges, in pixels from the top of the page, of what must stand above the fold.
_EDGES = """() => {
  const bottom = (element) => element.getBoundingClientRect().bottom;
  const chart = document.querySelector('.js-plotly-plot');
  const parts = {chart: chart.getBoundingClientRect().top};
  for (const [name, part] of Object.entries({
    verdict: '.st-key-said_verdict', 'x axis': '.xtitle', 'y axis': '.ytitle',
    slider: '.slider-container', buttons: '.updatemenu-container'}))
  {
    const found = (name === 'verdict' ? document : chart).querySelector(part);
    if (found) parts[name] = bottom(found);
  }
  return parts;
}"""


@pytest.mark.parametrize("name", PATHS)
def test_a_page_fits_every_screen(app: AppPage, name: str) -> None:
    """A desk, a presentation there and on a projector, any width and zoom."""
    app.open(name)
    assert violations(app) == []
    if name in CHARTS:
        _see_answer_chart_and_controls_above_the_fold(app)
    _see_nothing_cut_at_any_width_and_zoom(app)


def _see_nothing_cut_at_any_width_and_zoom(app: AppPage) -> None:
    # Texts stand where they stood without the charts, which would be drawn anew at each width.
    hidden = app.page.add_style_tag(content=".live-view {display: none}")
    sizes = sorted(
        {(round(width / zoom), round(HEIGHT / zoom)) for width in WIDTHS for zoom in ZOOMS}
    )
    found: dict[str, list[str]] = {}
    for width, height in [*sizes[1:], sizes[0]]:
        app.page.set_viewport_size({"width": width, "height": height})
        if (width, height) == sizes[0]:  # with the charts, as wide as their columns
            hidden.evaluate("style => style.remove()")
        app.rest()
        faults = app.page.evaluate(CUT)
        if (wide := app.overflow()) > 0:
            faults.append(f"scrolls sideways by {wide} px")
        if faults:
            found[f"{width} x {height}"] = faults
    assert found == {}


def _see_answer_chart_and_controls_above_the_fold(app: AppPage) -> None:
    """On a desk, and in a presentation there and on a projector."""
    assert _below_the_fold(app, HEIGHT, chart=380) == {}
    with app.run():
        app.page.keyboard.press("p")
    assert _below_the_fold(app, HEIGHT, chart=540) == {}
    app.page.set_viewport_size({"width": 1024, "height": 768})
    app.rest()
    _see_a_chart_on_a_projector(app)
    app.page.set_viewport_size(DESK)
    with app.run():
        app.page.keyboard.press("p")


def _see_a_chart_on_a_projector(app: AppPage) -> None:
    assert _below_the_fold(app, 768) == {}
    assert _plot_height(app) > 120
    app.page.set_viewport_size({"width": 960, "height": 600})  # a desk's window at 150 %
    app.rest()
    assert _plot_height(app) > 90


def _plot_height(app: AppPage) -> float:
    plot = app.page.locator(".js-plotly-plot .bglayer, .js-plotly-plot .cartesianlayer").first
    return plot.evaluate("plot => plot.getBoundingClientRect().height")


def _below_the_fold(app: AppPage, fold: float, chart: float = math.inf) -> dict[str, float]:
    """Return the lowest edges beyond the fold; the main chart begins above `chart`."""
    edges = app.page.evaluate(_EDGES)
    assert edges.pop("chart") < chart
    assert "verdict" in edges
    return {part: edge for part, edge in edges.items() if edge > fold}


def test_key_p_presents_one_chart_at_a_time_in_large_type_and_is_in_the_link(app: AppPage) -> None:
    app.open("Stability")
    assert app.charts().count() == 3
    with app.run():
        app.page.keyboard.press("p")
    expect(app.charts()).to_have_count(1)
    assert app.query() == {"present": "1"}
    assert _smallest_type(app) >= 16
    with app.run():
        app.page.get_by_role("radio", name="Critical mass").click()
    expect(app.charts()).to_have_count(1)
    assert app.query() == {"present": "critical_mass"}
    app.open("Stability", present="critical_mass")
    expect(app.page.get_by_role("figure")).to_have_attribute("aria-label", "Critical mass over the "
        "rotor's mass, over running speed; unstable below one.")  # fmt: skip
    with app.run():
        app.page.keyboard.press("p")
    expect(app.charts()).to_have_count(3)
    # A projector's small window enlarges less, and a map's labels are small.
    app.page.set_viewport_size({"width": 1024, "height": 768})
    app.open("Stability", present="1", tab="Map")
    assert app.page.locator(".js-plotly-plot .annotation-text").count() > 3
    assert _smallest_type(app) >= 16


def _smallest_type(app: AppPage) -> float:
    return app.page.evaluate(
        """() => Math.min(...[...document.querySelectorAll('.js-plotly-plot text')]
          .filter(one => one.textContent).map(one => parseFloat(getComputedStyle(one).fontSize)))"""
    )


def test_a_chart_fills_the_screen_with_its_legend_and_large_type(app: AppPage) -> None:
    app.open("Machine")
    chart = app.page.locator(".live-view").nth(2)
    assert chart.locator(".legendtext").count() == 0
    chart.get_by_role("button", name="Full screen").click()
    expect(chart.locator(".legendtext").first).to_be_visible()
    size = chart.locator(".legendtext").first.evaluate(
        "text => parseFloat(getComputedStyle(text).fontSize)"
    )
    assert size >= 16
    chart.get_by_role("button", name="Full screen").click()
    expect(chart.locator(".legendtext")).to_have_count(0)
