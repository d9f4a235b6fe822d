"""Sliders: how far a pixel and a key go, their ends, what is typed beside them, on any screen."""

import itertools
import re

import pytest
from playwright.sync_api import Locator, expect

from tests.browser.app_page import AppPage
from ui.inputs import INPUTS, inputs_of
from ui.sharing import address

# The page with the least beside its sidebar: a run of it takes half the processor time.
PAGE = "Notes"

# So many pixels lie between the places at which a drag is looked at.
PIXELS = 6

# Every slider of the page, by its label: values at each pixel of its track, and at its ends.
_TRACKS = """sliders => Object.fromEntries(sliders.map(({ slider }) => {
  const thumb = 16;
  const travel = slider.range.clientWidth - thumb;
  const places = [...Array(travel + 1).keys()].map(pixel => pixel / travel);
  return [slider.data.name, places.map(place => slider.track.value(place))];
}))"""


def _open_all(app: AppPage) -> None:
    for group in ("Oil", "Rotor"):
        app.open_group(group)
    expect(app.slider("Journal mass")).to_be_visible()


def _type(app: AppPage, label: str, word: str) -> Locator:
    field = app.page.get_by_role("textbox", name=re.compile(f"^{label}"))
    field.fill(word)
    with app.run():
        field.press("Enter")
    return field


def _refused(app: AppPage, label: str, word: str, answer: str) -> Locator:
    """Type what is no value for an input, and return its field when the page has said so."""
    field = _type(app, label, word)
    expect(app.page.get_by_test_id("stAlert").filter(has_text=answer)).to_be_visible()
    return field


@pytest.mark.parametrize("units", ["SI", "US"])
def test_a_pixel_of_any_slider_changes_its_input_by_half_a_per_cent(
    app: AppPage, units: str
) -> None:
    supply = {"T_in": "45", "flow": "10", "share": "0.9"} if units == "US" else {}
    query = {"load": "3000", **supply}
    app.open(PAGE, units=units, **query)
    _open_all(app)
    tracks = app.page.locator(".live-slider").evaluate_all(_TRACKS)
    assert tracks.keys() == inputs_of(address.read(query).values).keys()
    for key, values in tracks.items():
        assert len(values) > 300, key
        # A stop at an end of its track is no step on its way: zero, or a rigid shaft.
        numbers = [value for value in values if value not in (0, "rigid")]
        assert len(numbers) > 0.95 * len(values), key
        for before, after in itertools.pairwise(numbers):
            if INPUTS[key].step:  # a temperature, or a share
                assert 0.0 <= after - before <= (0.3 if units == "SI" else 0.5), key
            else:
                assert 0.0 <= after / before - 1.0 <= 0.005, key


def test_a_drag_across_the_track_goes_through_its_values(app: AppPage) -> None:
    app.open(PAGE)
    slider = app.slider("Radial clearance")
    box = slider.bounding_box()
    assert box
    assert box["width"] > 316
    mouse, height = app.page.mouse, box["y"] + box["height"] / 2
    # The test above has the value at every pixel; a drag comes by them in order.
    (track,) = (
        slider.locator("xpath=ancestor::*[contains(@class, 'live-slider')]")
        .evaluate_all(_TRACKS)
        .values()
    )
    mouse.move(box["x"] + 8, height)
    mouse.down()
    seen = []
    pixels = range(0, len(track), PIXELS)
    for pixel in pixels:
        mouse.move(box["x"] + 8 + pixel, height)
        seen.append(float(slider.get_attribute("aria-valuetext") or 0))
    with app.run():
        mouse.up()
    assert seen[0] == pytest.approx(30, rel=0.01)
    assert seen[-1] == pytest.approx(120, rel=0.005 * PIXELS)
    assert seen == pytest.approx([track[pixel] for pixel in pixels], rel=0.005)
    assert float(app.query()["C"]) == seen[-1]
    # Dropped near an end, its track lies about the value again.
    assert slider.input_value() == "50000"
    mouse.move(box["x"] + box["width"] / 2, height)
    mouse.down()
    mouse.move(box["x"] + 8, height, steps=20)
    with app.run():
        mouse.up()  # on the pixel of the preset's value
    assert app.query() == {}


def test_keys_step_through_round_values_to_both_ends(app: AppPage) -> None:
    app.open(PAGE)
    for key, value in (
        ("ArrowRight", "60.5"), ("ArrowUp", "61"), ("ArrowLeft", "60.5"),
        ("Shift+ArrowRight", "60.55"), ("Shift+ArrowLeft", "60.5"), ("PageUp", "65"),
        ("PageDown", "60"), ("End", "2000"), ("ArrowRight", "2000"), ("Home", "3"),
        ("ArrowLeft", "3"), ("PageUp", "3.2"),
    ):  # fmt: skip
        slider = app.slider("Radial clearance")
        slider.focus()
        slider.press(key)
        expect(slider).to_have_attribute("aria-valuetext", value)
    app.rest()
    assert app.query() == {"C": "3.2"}


def test_a_presets_value_is_no_round_one_and_is_reached_all_the_same(app: AppPage) -> None:
    app.open(PAGE)
    _open_all(app)
    app.press("Rotor mass", "ArrowRight")
    assert app.query() == {"mass": "274"}
    app.press("Rotor mass", "ArrowLeft")
    assert app.query() == {}


def test_zero_is_a_stop_of_its_own_and_leads_back(app: AppPage) -> None:
    app.open(PAGE)
    _open_all(app)
    app.press("Imbalance", "Home")
    assert app.query() == {"u": "0"}
    app.press("Imbalance", "ArrowRight")
    assert float(app.query()["u"]) == pytest.approx(6.0, rel=0.01)
    damping = app.slider("Midspan damping")
    assert damping.get_attribute("aria-valuetext") == "0"
    damping.scroll_into_view_if_needed()
    box = damping.bounding_box()
    assert box
    with app.run():
        app.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert 1e3 < float(app.query()["cs"]) < 1e6


def test_shaft_can_be_made_rigid_at_the_sliders_end_and_by_its_word(app: AppPage) -> None:
    app.open(PAGE)
    app.press("Shaft stiffness", "End")
    assert app.query() == {"k": "inf"}
    app.press("Shaft stiffness", "ArrowLeft")
    assert app.query() == {"k": "2e+08"}
    _type(app, "Shaft stiffness", "rigid")
    assert app.query() == {"k": "inf"}


def test_held_past_its_end_a_slider_runs_on(app: AppPage) -> None:
    app.open(PAGE)
    slider = app.slider("Radial clearance")
    box = slider.bounding_box()
    assert box
    mouse, height = app.page.mouse, box["y"] + box["height"] / 2
    mouse.move(box["x"] + box["width"] / 2, height)
    mouse.down()
    mouse.move(box["x"] + box["width"] + 30, height, steps=5)
    app.page.wait_for_function(
        "slider => Number(slider.ariaValueText) > 150", arg=slider.element_handle()
    )
    with app.run():
        mouse.up()
    assert float(app.query()["C"]) > 150


@pytest.mark.parametrize("typed", [False, True])
def test_a_typed_number_is_understood_or_asked_back(app: AppPage, typed: bool) -> None:
    """Beside its slider and in its place, with separators or without."""
    app.open(PAGE)
    if typed:
        body = app.open_popover("Units and settings")
        with app.run():
            body.get_by_text("Type values instead of sliding").click()
        app.close_popover()
    field = _type(app, "Radial clearance", "83.5")
    assert app.query() == {"C": "83.5"}
    expect(field).to_have_value("83.5")
    for word, answer in (
        ("5000", "5000 lies outside 3 to 2000"), ("much", "much' is not a number"),
    ):  # fmt: skip
        expect(_refused(app, "Radial clearance", word, answer)).to_have_value("83.5")
    if not typed:
        assert app.value("Radial clearance") == "83.5"
    _type(app, "Running speed", "5,334.5")
    assert app.query() == {"C": "83.5", "rpm": "5334.5"}
    for word, answer in (
        ("1,334", "can mean 1.334 or 1334: type the one you mean"),
        ("1e400", "is too large a number for this program"),
        ("1e6", "lies outside 10 to 300000 rpm"),
    ):
        expect(_refused(app, "Running speed", word, answer)).to_have_value("5334.5")
    assert app.query() == {"C": "83.5", "rpm": "5334.5"}
    _type(app, "Running speed", "4 000,5")
    assert app.query() == {"C": "83.5", "rpm": "4000.5"}
    expect(app.page.get_by_test_id("stAlert").filter(has_text="can mean")).to_have_count(0)


def test_on_a_phone_a_slider_is_as_wide_as_the_screen(app: AppPage) -> None:
    app.page.set_viewport_size({"width": 390, "height": 844})
    app.open(PAGE)
    app.page.get_by_test_id("stExpandSidebarButton").click()
    slider = app.slider("Radial clearance")
    app.page.wait_for_function(  # the sidebar slides in
        "slider => slider.clientWidth > 316", arg=slider.element_handle()
    )
    assert app.overflow() <= 0
