"""While a slider is held everything on the page answers, and nothing contradicts anything else."""

import math
import re

import pytest
from playwright.sync_api import Locator, expect

import rotorcalc as rc
from rotorcalc.units import SI
from tests.browser.app_page import MACHINE_PAGES, AppPage
from tests.browser.test_live import SAID, _drag
from tests.browser.test_room import CUT
from ui.computed import computed_from
from ui.inputs import PRESET_VALUES
from ui.words.verdict import verdict

RPM = math.pi / 30
VALUES = PRESET_VALUES["sheet-1e8"]
DIMMED = """() => [...document.querySelectorAll('.live-unknown[class*="st-key-said_"]')]
  .map(place => place.className.match(/st-key-said_\\S+/)[0])"""
# By how many pixels the title of an upright axis is longer than its chart is high.
_TOO_LONG = """() => [...document.querySelectorAll('.js-plotly-plot .ytitle')].map(title =>
  title.closest('.js-plotly-plot').getBoundingClientRect().top - title.getBoundingClientRect().top
).filter(pixels => pixels > 0)"""
_MARKED = """key => window.rotorcalcCharts.get(key).element.data
  .filter(trace => trace.name === 'running speed').map(trace => trace.x.at(-1))"""


def _hold(app: AppPage, label: str, share: float) -> str:
    """Drag a slider, hold it until the page shows its value, and return that."""
    _drag(app, label, share)
    app.page.wait_for_function("() => !document.querySelector('.live-slider[data-busy]')")
    app.page.wait_for_function("() => !document.querySelector('.live-chart[data-moved]')")
    return app.slider(label).get_attribute("aria-valuetext") or ""


def _release(app: AppPage) -> None:
    with app.run():
        app.page.mouse.up()
    app.page.wait_for_function("() => !document.body.classList.contains('rotorcalc-dragging')")


def test_a_thumb_held_beyond_the_onset_is_answered_by_the_whole_page(app: AppPage) -> None:
    app.open("Machine")
    with app.run():
        app.page.get_by_role("button", name="Keep as A").click()
    place = app.page.locator(".st-key-said_verdict")
    expect(place).to_contain_text("Stable at 6000 rpm")
    before = _changes(app)
    rpm = float(_hold(app, "Running speed", 0.33))
    machine = rc.PRESETS["sheet-1e8"].machine
    onset = rc.onset_speed(machine).speed / RPM
    assert rpm > onset  # else the test holds nothing
    mode = max(rc.analyse(machine, rpm * RPM).flexible_eigenvalues, key=lambda value: value.real)

    # The words, and their colour: more red than green.
    expect(place).to_contain_text(f"Unstable at {rpm:.0f} rpm")
    expect(place).to_contain_text(f"whirls at {abs(mode.imag) / RPM:.0f} rpm")
    expect(place).to_contain_text(f"growing at {mode.real:.4g} 1/s")
    red, green, _ = _colour(place.locator(".live-said .stAlertContainer"))
    assert red > green
    expect(app.page.locator(".st-key-said_imbalance")).to_contain_text("if it were stable")
    # Numbers, and their change from the first case.
    margin = 100.0 * (onset / rpm - 1.0)
    numbers = app.metrics()
    assert numbers["Margin to onset"].startswith(f"−{abs(margin):.4g} %")
    changes = _changes(app)
    assert changes[2] not in ("", before[2])
    # The charts' points.
    for chart in ("chart_home_threshold", "chart_home_response"):
        assert set(app.page.evaluate(_MARKED, chart)) == {rpm}

    held = app.page.evaluate(SAID)
    _release(app)
    assert app.page.evaluate(SAID) == held
    assert app.metrics() == numbers
    assert _changes(app) == changes
    assert verdict(computed_from(VALUES | {"rpm": rpm}), SI).sentence in held["st-key-said_verdict"]
    # Changes and a legend of cases take room: nothing is cut for it.
    assert app.page.evaluate(CUT) + app.page.evaluate(_TOO_LONG) == []


def _changes(app: AppPage) -> list[str]:
    """Return the changes from the first case."""
    texts = app.page.get_by_test_id("stMetricDelta").all_inner_texts()
    return [text.strip("\u200b") for text in texts]


def _colour(element: Locator) -> list[float]:
    colour = element.evaluate("one => getComputedStyle(one).backgroundColor")
    return [float(part) for part in re.findall(r"[\d.]+", colour)[:3]]


@pytest.mark.parametrize(
    "page", [page for page in MACHINE_PAGES if page not in ("Orbits", "Bearings", "Notes")]
)
def test_what_is_shown_while_held_is_what_a_run_shows(app: AppPage, page: str) -> None:
    """On every tab, with damping and a case, and with all of the model's assumptions."""
    app.open(page, rpm="8000", cs="500")
    with app.run():
        app.page.get_by_role("button", name="Keep as A").click()
    with app.run():
        app.page.get_by_text("Where the model holds").click()
    for tab in app.tabs() or [""]:
        if tab:
            app.open_tab(tab)
        before = app.page.evaluate(SAID)
        _hold(app, "Film temperature", 0.1)
        held, numbers = app.page.evaluate(SAID), app.metrics()
        # What comes on release is dimmed meanwhile, and says nothing.
        dimmed = set(app.page.evaluate(DIMMED))
        assert held["st-key-said_verdict"] != before["st-key-said_verdict"]
        _release(app)
        said = app.page.evaluate(SAID)
        assert held.keys() == said.keys()
        assert {key for key in said if said[key] != held[key]} <= dimmed, tab
        assert app.metrics() == numbers, tab


def test_an_open_explanation_follows_the_thumb(app: AppPage) -> None:
    app.open("Stability")
    with app.run():
        app.page.locator(".st-key-explain_onset_speed button").click()
    body = app.page.get_by_test_id("stPopoverBody")
    expect(body).to_contain_text("8919 rpm")
    _hold(app, "Radial clearance", 0.1)
    (onset,) = [one for label, one in app.metrics().items() if label.startswith("Onset")]
    expect(body.locator(".live-said")).to_contain_text(onset)
    expect(body.locator(".live-said .katex")).to_have_count(3)
    app.page.mouse.up()


def test_a_release_is_coarse_while_held_and_says_so(app: AppPage) -> None:
    app.open("Orbits")
    outcome = app.page.locator(".st-key-said_outcome")
    expect(outcome).not_to_contain_text("Coarse")
    drawn = app.drawn()
    _hold(app, "Running speed", 0.33)
    assert app.drawn() != drawn
    expect(outcome).to_contain_text("Coarse while dragging, 20 revolutions at most. After 20 rev")
    expect(app.page.locator(".st-key-said_verdict")).to_contain_text("Unstable")
    _release(app)
    expect(outcome).to_contain_text("After 40 revolutions")


def test_a_value_that_makes_no_machine_is_refused_while_held(app: AppPage) -> None:
    app.open("Machine", mass="300", mj="140")
    app.open_group("Rotor")
    verdicts = app.page.locator(".st-key-said_verdict")
    _hold(app, "Journal mass", 0.4)
    expect(verdicts).to_contain_text("Journal mass Mⱼ")
    expect(verdicts.locator(".live-said")).not_to_contain_text("Stable at")
    assert (
        app.page.locator(".stMetric").first.evaluate("one => getComputedStyle(one).opacity") < "1"
    )
    _release(app)
    expect(app.page.get_by_test_id("stAlert").filter(has_text="Journal mass Mⱼ")).to_be_visible()
