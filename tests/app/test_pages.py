"""Every page, at every preset and at both ends of every slider, shows no fault."""

import json
import math
import re
from collections.abc import Iterator

import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc import PRESETS
from rotorcalc.figures.style import HERE
from tests.app.session import (
    BEARINGS_PAGE,
    HOME,
    NOTES,
    ORBITS,
    PAGES,
    TOLERANCES,
    charts,
    faults,
    open_part,
    session_of,
    slider,
    slider_keys,
    tours,
    visit,
)
from ui.inputs import inputs_of

every_page = pytest.mark.parametrize("path", PAGES)
# The page Bearings has a table, and no charts or tabs.
every_drawn_page = pytest.mark.parametrize(
    "path", [path for path in PAGES if path != BEARINGS_PAGE]
)

# Charts that show nothing but the running speed, or no machine at all.
UNMARKED = {
    "energy_bars", "tornado", "orbits", "conventions", "tolerances_ranking", "tolerances_cloud",
}  # fmt: skip

# A quantity with its unit, or in or over another of its kind.
NAMED = re.compile(r"\w.*\[.+\]|\w/\w|, in \w")

# In US units pages show the same machines: one of them is enough.
SHOWN = {"SI": list(PRESETS), "US": list(PRESETS)[:1]}

# Of more choices than these, every third is tried.
MANY = 6

# Every input has its slider only where the load is given.
LOADED = {"load": "3000"}
# Of what is long at both ends of every slider the least, which the page shows as it shows more.
LEAST = {ORBITS: {"revolutions": "20"}, TOLERANCES: {"samples": "40"}}


def _choose(at: AppTest, units: str, typed: bool) -> None:
    """Choose units and kind of input in the settings."""
    open_part(at, "settings")
    at.segmented_control(key="units").set_value(units)
    at.toggle(key="typed").set_value(typed)
    at.run()
    open_part(at, "settings", False)


@every_page
@pytest.mark.parametrize("units", ["SI", "US"])
def test_every_tab_at_every_preset(path: str, units: str) -> None:
    at = visit(path, units=units)
    for preset in SHOWN[units]:
        at.selectbox(key="preset").set_value(preset).run()
        assert session_of(at).preset == preset
        for label in tours(at):
            assert faults(at) == [], (preset, label)


@every_page
@pytest.mark.parametrize("units", ["SI", "US"])
def test_typed_inputs_at_every_preset(path: str, units: str) -> None:
    at = visit(path)
    _choose(at, units, typed=True)
    for preset in SHOWN[units]:
        at.selectbox(key="preset").set_value(preset).run()
        assert faults(at) == [], preset
    assert slider_keys(at) == []
    assert any(field.key == f"input_C_{units}_typed" for field in at.text_input)


@every_page
@pytest.mark.parametrize("units", ["SI", "US"])
def test_every_input_has_a_slider(path: str, units: str) -> None:
    at = visit(path, units=units, **LOADED)
    assert len(slider_keys(at)) == len(inputs_of(session_of(at).values))


# In US units the same sliders move the same machine: one page is enough.
@pytest.mark.usefixtures("coarse_maps")
@pytest.mark.parametrize(("path", "units"), [*((path, "SI") for path in PAGES), (HOME, "US")])
def test_both_ends_of_every_slider(path: str, units: str) -> None:
    at = visit(path, units=units, **LOADED, **LEAST.get(path, {}))
    assert session_of(at).problems == []
    keys = slider_keys(at)
    # What notes say holds for all machines; the tabs of Orbits show one release after the other.
    # Bearings computes nine machines at each end: fewer sliders will do.
    if path == BEARINGS_PAGE:
        keys = [key for key in keys if key.split("_")[1] in ("rpm", "L", "u")]
    tabs = tours(at) if path not in (NOTES, ORBITS) else iter([""])
    for number, label in enumerate(tabs):
        # All of them on the first tab, every third on each of the others, in turn.
        for key, end, shown in _ends(at, keys[number % 3 :: 3] if number else keys):
            assert shown == [] or _no_disk(at), (label, key, end, shown)


def _ends(at: AppTest, keys: list[str]) -> Iterator[tuple[str, float, list[str]]]:
    """Move each slider to both of its ends, put it back, and yield what then was wrong."""
    for key in keys:
        was = slider(at, key)[0].value
        for end in slider(at, key)[1:]:
            slider(at, key)[0].set_value(end).run()
            yield key, end, faults(at)
        slider(at, key)[0].set_value(was)


def _no_disk(at: AppTest) -> bool:
    """Tell whether the journals' mass leaves no disk, and the page says just that."""
    values = session_of(at).values
    said = [error.value for error in at.error]
    return (
        values["mj"] >= values["mass"] / 2
        and len(said) == 1
        and re.search("Journal mass.*no disk is left", said[0]) is not None
        and not at.exception
    )


@every_page
def test_every_choice_on_the_page(path: str) -> None:
    at = visit(path)
    for label in tours(at):
        for kind in ("segmented_control", "pills", "radio", "selectbox", "toggle", "checkbox"):
            for key in [one.key for one in getattr(at.main, kind)]:
                _try_out(at, kind, key, label)


def _try_out(at: AppTest, kind: str, key: str, label: str) -> None:
    control = getattr(at, kind)(key=key)
    was = control.value
    options = [not was] if kind in ("toggle", "checkbox") else control.options
    if len(options) > MANY:
        options = options[::3]
    for option in options:
        if not (found := [one for one in getattr(at, kind) if one.key == key]):
            return  # this choice goes with another one
        found[0].set_value(option).run()
        assert faults(at) == [], (label, key, option)
    if found := [one for one in getattr(at, kind) if one.key == key]:
        found[0].set_value(was).run()


@every_drawn_page
@pytest.mark.parametrize("units", ["SI", "US"])
def test_every_chart_has_named_axes_a_text_alternative_and_the_running_speed(
    path: str, units: str
) -> None:
    at, seen = visit(path, units=units), 0
    for label in tours(at):
        for chart in at.get("plotly_chart"):
            seen += 1
            assert len(chart.proto.alt) > 20, (label, chart.key)
        for key, figure in charts(at).items():
            _see_axes_named_with_fixed_ranges(figure, (label, key))
            if key.removeprefix("chart_") not in UNMARKED:
                assert HERE in json.dumps(figure["data"]), (label, key)
    assert seen


def _see_axes_named_with_fixed_ranges(figure: dict, place: tuple[str, str]) -> None:
    for name, axis in _axes(figure):
        assert len(axis.get("range", ())) == 2, (*place, name)
        assert all(math.isfinite(end) for end in axis["range"]), (*place, name)
        if axis.get("visible", True) and not axis.get("ticktext"):
            title = re.sub("<[^>]+>", "", axis["title"]["text"])
            assert NAMED.search(title), (*place, name)


def _axes(figure: dict) -> Iterator[tuple[str, dict]]:
    for name, axis in figure["layout"].items():
        if re.fullmatch(r"[xy]axis\d*", name):
            yield name, axis


@every_drawn_page
def test_a_tab_computes_only_when_open(path: str) -> None:
    at = visit(path)
    rows = at.get("tab_container")
    assert rows or path == HOME
    for row in rows:
        filled = [tab.label for tab in row.children.values() if tab.children]
        assert filled == [at.session_state[row.key]]
