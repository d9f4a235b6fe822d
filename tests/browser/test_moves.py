"""What a visitor does: move a slider, keep a case, change units, save a chart."""

import re

import pytest
from playwright.sync_api import expect

from tests.browser.app_page import MACHINE_PAGES, AppPage

FOCUS = """() => {
  const focus = document.activeElement;
  return `${focus.tagName}: ${focus.getAttribute('aria-label') || focus.innerText}`;
}"""

# Pages with results and charts of the machine.
LIVE = [name for name in MACHINE_PAGES if name not in ("Bearings", "Notes")]


def _move(app: AppPage) -> None:
    """Move a slider, and see that everything follows."""
    link, numbers, drawn = app.query(), app.metrics(), app.drawn()
    app.press("Radial clearance", "PageUp")
    assert app.query().keys() - link.keys() == {"C"}
    assert float(app.query()["C"]) > 60
    assert app.changes(app.metrics, numbers)
    assert app.changes(app.drawn, drawn)


# On all pages: cases in tests/app/test_cases.py, what a slider moves in test_dragging.py.
@pytest.mark.parametrize("name", ["Machine", "Coefficients", "Orbits"])
def test_slider_moves_all_of_a_page_and_a_kept_case_is_drawn_and_compared(
    app: AppPage, name: str
) -> None:
    app.open(name)
    with app.run():
        app.page.get_by_role("button", name="Keep as A").click()
    _move(app)
    assert app.changes(lambda: _ghosts(app), [])
    expect(app.page.get_by_text("vs A").first).to_be_visible()
    expect(app.page.locator("table.cases")).to_contain_text("Radial clearance")
    app.open_popover("Cases")
    with app.run():
        app.page.get_by_role("button", name="Remove").click()
    app.close_popover()
    assert app.changes(lambda: bool(_ghosts(app)), True)
    expect(app.page.get_by_text("vs A")).to_have_count(0)


def _ghosts(app: AppPage) -> list[str]:
    """Return the names of the traces of the case A."""
    return [trace for chart in app.traces() for trace in chart if trace.startswith("A: ")]


def test_units_switch_leaves_the_machine(app: AppPage) -> None:
    app.open("Machine", C="80")
    numbers = app.metrics()
    _choose_units(app, "US")
    assert app.query() == {"C": "80", "units": "US"}
    assert app.metrics().keys() == numbers.keys()
    assert any(value.endswith("mil") for value in app.metrics().values())
    expect(app.slider("Radial clearance")).to_have_attribute("aria-label", re.compile(r"\[mil\]"))
    _choose_units(app, "SI")
    assert app.query() == {"C": "80"}
    assert app.metrics() == numbers


def test_one_switch_reads_amplitudes_peak_to_peak_in_numbers_charts_and_link(
    app: AppPage, elsewhere: AppPage
) -> None:
    app.open("Response")
    before = app.metrics()["Disk orbit"]
    assert before.endswith("µm 0-p")
    app.open_popover("Units and settings")
    with app.run():
        app.page.get_by_role("radio", name="peak to peak").click()
    app.close_popover()
    after = app.metrics()["Disk orbit"]
    assert after.endswith("µm p-p")
    assert float(after.split()[0]) == pytest.approx(2.0 * float(before.split()[0]), rel=1e-3)
    expect(app.charts().first).to_contain_text("[µm p-p]")
    app.go("Orbits")
    assert app.query() == {"amplitude": "p-p"}
    elsewhere.open("Response", **app.query())
    assert elsewhere.metrics()["Disk orbit"] == after


def _choose_units(app: AppPage, units: str) -> None:
    body = app.open_popover("Units and settings")
    with app.run():
        body.get_by_role("radio", name=units, exact=True).click()
    app.close_popover()


def test_preset_brings_its_machine(app: AppPage) -> None:
    app.open("Machine", C="80")
    with app.run():
        app.page.get_by_role("combobox", name=re.compile("Preset")).click()
        app.page.get_by_role("option", name="600 lbf rotor, flexible shaft").click()
    assert app.query() == {"preset": "sheet-1e7"}
    expect(app.page.get_by_test_id("stMain").get_by_text("4627 rpm").first).to_be_visible()


# Streamlit's own charts and sliders: on all other pages in tests/app, without a browser.
@pytest.mark.parametrize("server", ["off"], indirect=True)
def test_streamlits_own_sliders_and_charts_can_be_used_too(app: AppPage) -> None:
    app.open("Equilibrium")
    _by_keyboard(app)
    _move(app)


def test_keyboard_alone_reaches_sliders_and_opens_a_popover(app: AppPage) -> None:
    app.open("Equilibrium")
    _by_keyboard(app)


def _by_keyboard(app: AppPage) -> None:
    """Walk from the page's beginning through slider and button to an explanation, and open it."""
    keyboard = app.page.keyboard
    reached: list[str] = []
    while not (reached and reached[-1].startswith("BUTTON: Eq. 5.8")):
        assert len(reached) < 150, reached
        keyboard.press("Tab")
        reached.append(app.page.evaluate(FOCUS))
    assert any(what.startswith("INPUT: Radial clearance") for what in reached)
    assert any(what.startswith("BUTTON: Keep as A") for what in reached)
    with app.run():
        keyboard.press("Enter")
    expect(app.page.get_by_test_id("stPopoverBody").locator(".katex").first).to_be_visible()
    keyboard.press("Escape")
    expect(app.page.get_by_test_id("stPopoverBody")).to_have_count(0)


@pytest.mark.parametrize("kind", ["png", "svg"])
def test_chart_is_saved_as_a_picture(app: AppPage, kind: str, tmp_path) -> None:
    app.open("Equilibrium")
    if kind == "svg":
        body = app.open_popover("Units and settings")
        with app.run():
            body.get_by_role("radio", name="svg").click()
        app.close_popover()
    chart = app.charts().first
    chart.hover()
    with app.page.expect_download() as started:
        chart.locator(".modebar-btn[data-title*='ownload']").click()
    saved = tmp_path / started.value.suggested_filename
    started.value.save_as(saved)
    assert saved.suffix == f".{kind}"
    start = saved.read_bytes()[:200]
    assert start.startswith(b"\x89PNG") if kind == "png" else b"<svg" in start


def test_zero_load_and_rigid_shaft_are_explained(app: AppPage) -> None:
    app.open("Machine", load="0", k="inf")
    expect(app.page.get_by_test_id("stAlert").first).to_contain_text("without load")
    for name in LIVE:
        if name != "Machine":
            app.go(name)
        expect(app.page.get_by_test_id("stException")).to_have_count(0)
        assert not re.search(
            r"\b(nan|NaN|None|inf)\b", app.page.get_by_test_id("stMain").inner_text()
        )
